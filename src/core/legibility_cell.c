/*
 * legibility_cell.c - first of all, sites that find no room between lines are joined, without any pushing.
 *
 * On a map of a town with all its streets the symbols of lines leave room to every tenth site or so. What has none, as
 * small as it may become, wherever it may go, need not be pushed about in rounds: it becomes one with the nearest in
 * its cell between the lines, as often as it takes for that one to have room; where nobody else is left in the cell,
 * the members go to the nearest across. So rounds begin with a fifth of the sites; with all they took ten times as
 * long.
 *
 * Whether there is room is found out by a walk away from the lines (surroundings.h), first of the disc in the site:
 * more than half come no farther. Nothing that is promised hangs on it. The place that a site has come to is its seat,
 * where it begins: at true size, and only where that has none at the least. Two seats that are nearly one are not worth
 * a struggle: whoever would sit there are joined as well.
 */
#include "legibility_internal.h"

#include <math.h>
#include <string.h>

#define STEPS 16	  /* that are walked to find room; half as many save no time and lose 1 % of the sites */
#define STAGNANT 0.97 /* share of what was lacking two steps before, above which a walk leads nowhere */
#define TURNS_BACK 3  /* of half the way, where a step has led across a line */
/*
 * Share of what keeps two apart below which their seats are one. At 0.9 a tenth of the time is saved, but 3 % of the
 * sites are lost where there is more room; at 0.5 none are.
 */
#define ONE_SEAT 0.6
#define RIVALS_RING 1 /* of squares, each twice as wide as a site: seats are seldom farther from home */

/* What is lacking gets less from step to step, or at least from two steps to the next two. */
typedef struct progress
{
	double last, before;
} progress;

static inline double
length_of(double dx, double dy)
{
	return sqrt(dx * dx + dy * dy);
}

static inline bool
is_stagnant(progress *p, double lack)
{
	bool stagnant = lack > STAGNANT * p->before;

	p->before = p->last;
	p->last = lack;
	return stagnant;
}

/* The share of the way from home that does not lead beyond the bound. */
static inline double
share_within(ty_point way, double bound)
{
	double squared = way.x * way.x + way.y * way.y;

	return squared > bound * bound ? bound / sqrt(squared) : 1;
}

/* ---- the walk ---- */

/* What looks for room: a disc, or a rectangle, which stands where it begins, counted from home. */
typedef struct walker
{
	ty_oblong box;
	double radius; /* of the disc, or half the diagonal */
	double bound;  /* how far it may go */
	bool is_disc;
} walker;

static double
lack_of(ty_ladder *l, const walker *w, ty_point moved, ty_point *away)
{
	ty_oblong box = w->box;

	box.x += moved.x;
	box.y += moved.y;
	if (w->is_disc)
		return w->radius + l->line_target - ty_nearest_segment(&l->around, (ty_point){box.x, box.y}, away);
	return ty_lack_beside_segments(&l->around, &box, w->radius, l->line_target, away);
}

static inline bool
is_behind(const ty_ladder *l, const walker *w, ty_point moved)
{
	return ty_is_behind(&l->around, (ty_point){w->box.x + moved.x, w->box.y + moved.y});
}

static bool
stands_clear(ty_ladder *l, const walker *w)
{
	ty_point away, here = {0, 0};

	return !ty_is_line_conflict(l, lack_of(l, w, here, &away)) && !is_behind(l, w, here);
}

/* Whether it comes to a place far enough from all segments that have been picked: *moved from where it begins. */
static bool
finds_room(ty_ladder *l, const walker *w, ty_point *moved)
{
	progress p = {INFINITY, INFINITY};
	ty_point away = {1, 0};

	*moved = (ty_point){0, 0};
	for (int steps = 0; steps < STEPS; steps++)
	{
		double lack = lack_of(l, w, *moved, &away), share;
		ty_point way;

		if (!ty_is_line_conflict(l, lack) && !is_behind(l, w, *moved))
			return true;
		if (is_stagnant(&p, lack))
			return false;
		way = (ty_point){moved->x + lack * away.x, moved->y + lack * away.y};
		share = share_within(way, w->bound);
		for (int turn = 0; turn <= TURNS_BACK; turn++, share *= 0.5)
		{
			*moved = (ty_point){share * way.x, share * way.y};
			if (!is_behind(l, w, *moved))
				break;
		}
	}
	return false;
}

/* ---- seats ---- */

/* The site as large as that. */
static walker
walker_of(const ty_ladder *l, uint32_t i, ty_sides sides)
{
	const ty_site *s = &l->sites[i];
	double factor = s->full.length > 0 ? sides.length / s->full.length : 1;
	walker w = {.box = {factor * s->shift.x, factor * s->shift.y, s->ux, s->uy, 0.5 * sides.length, 0.5 * sides.width},
				.bound = fmax(ty_free_way(l, i), 0.5 * sides.length)};

	w.radius = length_of(w.box.half_length, w.box.half_width);
	return w;
}

/* The site as it has been entered. */
static walker
walker_at_home(const ty_ladder *l, uint32_t i)
{
	walker w = {.box = l->body[i].box, .radius = l->body[i].radius};

	w.box.x -= l->place[i].home.x;
	w.box.y -= l->place[i].home.y;
	return w;
}

/* how far from home it may come to lie */
static double
reach_of(const walker *w)
{
	return w->bound + length_of(w->box.x, w->box.y) + w->radius;
}

/* Picks the segments that matter to whoever reaches so far from the home of the site. */
static ty_status
survey(ty_ladder *l, uint32_t i, double reach)
{
	l->line_limit = reach + l->line_target;
	return ty_survey(&l->around, l->sites[i].home, l->line_limit);
}

/* Whether there is room for the disc that is as wide as the site, as small as it may become. */
static bool
disc_finds_room(ty_ladder *l, const walker *least)
{
	walker disc = *least;
	ty_point moved;

	disc.radius = least->box.half_width;
	disc.is_disc = true;
	return finds_room(l, &disc, &moved);
}

/* Where lines are in the way of the site at home, it takes a seat. False: there is none. */
static bool
take_seat(ty_ladder *l, uint32_t i, const walker *home, const walker *own, const walker *least)
{
	ty_site *s = &l->sites[i];
	ty_point moved;

	if (stands_clear(l, home))
		return true;
	if (finds_room(l, own, &moved))
		s->size = fmin(s->size, 1);
	else if (s->least.length < s->own.length && finds_room(l, least, &moved))
		s->size = 0;
	else
		return false;
	l->place[i].moved = moved;
	ty_place_box(l, i);
	return true;
}

/* Whether the site has room. */
static ty_status
look_for_room(ty_ladder *l, uint32_t i, bool *room)
{
	const ty_site *s = &l->sites[i];
	walker home = walker_at_home(l, i), own = walker_of(l, i, s->own), least = walker_of(l, i, s->least);
	ty_status status;

	*room = s->fixed || ty_in_row(l, i) || ty_on_rail(s);
	if (*room)
		return TY_OK;
	status = survey(l, i, fmax(reach_of(&home), fmax(reach_of(&own), reach_of(&least))));
	*room = status == TY_OK && disc_finds_room(l, &least) && take_seat(l, i, &home, &own, &least);
	l->body[i].clear = *room;
	return status;
}

static inline bool
has_seat(const ty_ladder *l, uint32_t i)
{
	ty_point moved = l->place[i].moved;

	return l->body[i].clear && (moved.x != 0 || moved.y != 0);
}

/* Who else would sit where the site does: the nearest that it may be joined to; TY_NO_SITE: nobody. */
static ty_status
find_rival(ty_ladder *l, uint32_t i, uint32_t *rival)
{
	const ty_disc *home = &l->near.discs[i];
	double least = INFINITY;
	ty_status status = TY_OK;

	*rival = TY_NO_SITE;
	for (uint32_t ring = 0; status == TY_OK && ring <= RIVALS_RING && has_seat(l, i); ring++)
	{
		status = ty_squares_ring(&l->homes, (ty_point){home->x, home->y}, ring);
		for (size_t k = 0; status == TY_OK && k < l->homes.found_count; k++)
		{
			uint32_t j = l->homes.found[k];
			double dx = l->body[j].box.x - l->body[i].box.x, dy = l->body[j].box.y - l->body[i].box.y;
			double apart = 0.5 * (l->sites[i].least.width + l->sites[j].least.width) + l->target;
			double squared = dx * dx + dy * dy;

			if (j == i || squared > ONE_SEAT * apart * (ONE_SEAT * apart) || !has_seat(l, j))
				continue;
			if ((squared < least || (squared == least && j < *rival)) && ty_may_join(l, i, j))
			{
				least = squared;
				*rival = j;
			}
		}
	}
	return status;
}

/* ---- sweeps ---- */

/*
 * What two sites have become is looked at again at once as long as it has few members, and else in the next sweep, and
 * so is whoever would join it before: a cell with thousands of buildings and no room becomes one site two by two.
 * Bit by bit it would be looked at with all its members each time; in sweeps alone most are looked at twice.
 */
#define FEW_MEMBERS 32
#define MOST_SWEEPS 32 /* a town with all its streets takes 15; what is left then is left to the rounds */

/* Where a site goes that has no room: to the nearest; TY_NO_SITE: it stands alone. in_place: as for ty_join_sites. */
static ty_status
find_refuge(ty_ladder *l, uint32_t i, uint32_t *refuge, uint32_t *in_place)
{
	bool across;
	ty_status status = ty_nearest_site(l, i, refuge, &across);

	*in_place = across ? *refuge : TY_NO_SITE;
	return status;
}

/* Who is to be joined to the site, as it has no room, or not to itself; TY_NO_SITE: nobody. It may be hidden then. */
static ty_status
find_other(ty_ladder *l, uint32_t i, uint32_t *other, uint32_t *in_place)
{
	bool room;
	ty_status status = look_for_room(l, i, &room);

	*other = *in_place = TY_NO_SITE;
	if (status == TY_OK)
		status = room ? find_rival(l, i, other) : find_refuge(l, i, other, in_place);
	if (status == TY_OK && !room && *other == TY_NO_SITE)
		ty_hide_site(l, i);
	return status;
}

/*
 * Looks at the site, and at what it becomes by being joined, until that has room to itself or is to wait for the next
 * sweep. changed: [n] the sweep in which a site became another.
 */
static ty_status
sweep_site(ty_ladder *l, uint32_t i, uint8_t sweep, uint8_t *changed)
{
	uint32_t other, in_place;
	ty_status status;

	while ((status = find_other(l, i, &other, &in_place)) == TY_OK && other != TY_NO_SITE)
	{
		bool waits = changed[other] == sweep && l->sites[other].weight > FEW_MEMBERS;

		if (!waits)
		{
			status = ty_join_sites(l, i, other, in_place, &i);
			changed[i] = sweep;
		}
		if (status != TY_OK)
			return status;
		if (waits || l->sites[i].weight > FEW_MEMBERS)
		{
			ty_activate(l, i);
			break;
		}
	}
	return status;
}

/* All that are left meet the lines that they will be kept away from. */
static ty_status
meet_all(ty_ladder *l)
{
	ty_status status = TY_OK;

	l->unmet = false;
	for (size_t i = 0; status == TY_OK && i < l->n; i++)
	{
		if (ty_interrupted_at(l->env, i))
			status = TY_INTERRUPTED;
		else if (ty_is_drawn(l, (uint32_t) i))
			status = ty_enter_site(l, (uint32_t) i);
	}
	return status;
}

ty_status
ty_thin_cells(ty_ladder *l)
{
	uint8_t *changed;
	ty_status status = TY_OK;

	if (!l->unmet)
		return TY_OK;
	changed = ty_allocate_array(l->env, l->n, sizeof *changed);
	if (changed == NULL)
		return TY_NO_MEMORY;
	memset(changed, 0, l->n * sizeof *changed);
	ty_activate_all(l);
	for (uint8_t sweep = 1; status == TY_OK && sweep <= MOST_SWEEPS && l->active_count > 0; sweep++)
	{
		for (size_t k = 0; status == TY_OK && k < l->active_count; k++)
		{
			uint32_t i = l->active[k];

			if (ty_interrupted_at(l->env, k))
				status = TY_INTERRUPTED;
			else if (ty_is_drawn(l, i) && changed[i] != sweep)
				status = sweep_site(l, i, sweep, changed);
		}
		ty_next_round(l);
	}
	if (status == TY_OK)
		status = meet_all(l);
	ty_surroundings_free(&l->around);
	ty_vicinity_fit(&l->near);
	ty_release(l->env, changed);
	return status;
}
