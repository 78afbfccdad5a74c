/*
 * legibility_cell.c - first of all, sites that find no room between lines are joined, without any pushing.
 *
 * On a map of a town with all its streets the symbols of lines leave room to every tenth site or so. What has none as
 * small as it may become, wherever it may go, need not be pushed about in rounds: it becomes one with the nearest in its
 * cell between the lines, as often as it takes for that one to have room; where nobody else is left in the cell, the
 * members go to the nearest across. So rounds begin with a fifth of the sites; they took ten times as long with all.
 *
 * Whether there is room is found out by a walk away from the lines, first of the disc in the site, among segments in
 * single precision: three fifths come no farther. Nothing that is promised hangs on it. The place that a site has come to
 * is its seat, where it begins: at true size, and only where that has none at the least. Two seats that are nearly one
 * are not worth a struggle: whoever would sit there are joined as well.
 */
#include "legibility_internal.h"

#include <float.h>
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

/* ---- the disc ---- */

static ty_status
make_room(const ty_environment *env, ty_surroundings *s, size_t count)
{
	size_t capacity = 2 * count;

	if (count <= s->capacity)
		return TY_OK;
	ty_release(env, s->x);
	*s = (ty_surroundings){.x = ty_allocate_array(env, 6 * capacity, sizeof *s->x)};
	if (s->x == NULL)
		return TY_NO_MEMORY;
	s->capacity = capacity;
	s->y = s->x + capacity;
	s->dx = s->y + capacity;
	s->dy = s->dx + capacity;
	s->inverse = s->dy + capacity;
	s->squared = s->inverse + capacity;
	return TY_OK;
}

/* Counts the segments that have been listed from the home of the site, which comes to be that of the surroundings. */
static ty_status
survey(ty_ladder *l, uint32_t i)
{
	const ty_point home = l->sites[i].home;
	ty_surroundings *s = &l->around;
	ty_status status = make_room(l->env, s, l->line_count);

	s->count = 0;
	s->home = home;
	for (size_t k = 0; status == TY_OK && k < l->line_count; k++)
	{
		ty_point a, b;
		float squared;

		ty_segment_ends(l->rules->lines, l->line_list[k], &a, &b);
		s->x[k] = (float) (a.x - home.x);
		s->y[k] = (float) (a.y - home.y);
		s->dx[k] = (float) (b.x - a.x);
		s->dy[k] = (float) (b.y - a.y);
		squared = s->dx[k] * s->dx[k] + s->dy[k] * s->dy[k];
		s->inverse[k] = squared >= FLT_MIN ? 1 / squared : 0;
		s->count++;
	}
	return status;
}

/* the vector from the place to the nearest point of a segment */
static inline float
way_to_segment(const ty_surroundings *s, size_t k, float x, float y, float *way_y)
{
	float from_x = s->x[k] - x, from_y = s->y[k] - y;
	float share = -(from_x * s->dx[k] + from_y * s->dy[k]) * s->inverse[k];

	share = share > 0 ? share : 0;
	share = share < 1 ? share : 1;
	*way_y = from_y + share * s->dy[k];
	return from_x + share * s->dx[k];
}

/* How near the nearest segment comes to the place, and the unit vector away from there. */
static double
nearest_segment(const ty_surroundings *s, ty_point place, ty_point *away)
{
	float x = (float) place.x, y = (float) place.y, least = INFINITY;
	size_t nearest = 0;
	ty_point way;
	float way_y;
	double distance;

	for (size_t k = 0; k < s->count; k++)
	{
		float way_x = way_to_segment(s, k, x, y, &way_y);

		s->squared[k] = way_x * way_x + way_y * way_y;
	}
	for (size_t k = 0; k < s->count; k++)
		if (s->squared[k] < least)
		{
			least = s->squared[k];
			nearest = k;
		}
	if (!(least < INFINITY))
		return INFINITY;
	way.x = -way_to_segment(s, nearest, x, y, &way_y);
	way.y = -way_y;
	distance = sqrt(way.x * way.x + way.y * way.y);
	if (distance > 0)
		*away = (ty_point){way.x / distance, way.y / distance};
	return distance;
}

bool
ty_is_behind(const ty_surroundings *s, ty_point place)
{
	float x = (float) place.x, y = (float) place.y;
	int crossed = 0;

	for (size_t k = 0; k < s->count; k++)
	{
		float home_side = s->y[k] * s->dx[k] - s->x[k] * s->dy[k], way = x * s->dy[k] - y * s->dx[k];
		float from = x * s->y[k] - y * s->x[k];
		/* both below 0 where the ends of each are on different sides of the other */
		float sides = home_side * (home_side + way), ends = from * (from + way), larger = sides > ends ? sides : ends;

		crossed |= larger < 0 ? 1 : 0;
	}
	return crossed != 0;
}

/* Whether the disc that is as wide as the site, as small as it may become, comes to a place with room for it. */
static bool
disc_finds_room(const ty_ladder *l, uint32_t i, ty_point from, double bound)
{
	const ty_surroundings *s = &l->around;
	double radius = 0.5 * l->sites[i].least.width;
	progress p = {INFINITY, INFINITY};
	ty_point place = from, away = {1, 0};

	for (int steps = 0; steps < STEPS; steps++)
	{
		double lack = radius + l->line_target - nearest_segment(s, place, &away), share;
		ty_point way;

		if (!ty_is_line_conflict(l, lack) && !ty_is_behind(s, place))
			return true;
		if (is_stagnant(&p, lack))
			return false;
		way = (ty_point){place.x + lack * away.x - from.x, place.y + lack * away.y - from.y};
		share = share_within(way, bound);
		for (int turn = 0; turn <= TURNS_BACK; turn++, share *= 0.5)
		{
			place = (ty_point){from.x + share * way.x, from.y + share * way.y};
			if (!ty_is_behind(s, place))
				break;
		}
	}
	return false;
}

/* ---- the rectangle ---- */

/* Whether a site of these sides, whose lines are listed, comes to a place far enough from all of them: *moved from home. */
static bool
finds_room(const ty_ladder *l, uint32_t i, ty_sides sides, ty_point *moved)
{
	const ty_site *s = &l->sites[i];
	double factor = s->full.length > 0 ? sides.length / s->full.length : 1;
	double bound = fmax(ty_free_way(l, i), 0.5 * sides.length);
	ty_point from = {l->place[i].home.x + factor * s->shift.x, l->place[i].home.y + factor * s->shift.y};
	ty_oblong box = {from.x, from.y, s->ux, s->uy, 0.5 * sides.length, 0.5 * sides.width};
	double radius = sqrt(box.half_length * box.half_length + box.half_width * box.half_width);
	progress p = {INFINITY, INFINITY};

	*moved = (ty_point){0, 0};
	for (int steps = 0; steps < STEPS; steps++)
	{
		ty_point away, way;
		double lack = ty_box_line_lack(l, i, &box, radius, &away), share;

		if (!ty_is_line_conflict(l, lack) && !ty_is_behind_line(l, i, (ty_point){box.x, box.y}))
			return true;
		if (is_stagnant(&p, lack))
			return false;
		way = (ty_point){moved->x + lack * away.x, moved->y + lack * away.y};
		share = share_within(way, bound);
		for (int turn = 0; turn <= TURNS_BACK; turn++, share *= 0.5)
		{
			*moved = (ty_point){share * way.x, share * way.y};
			box.x = from.x + moved->x;
			box.y = from.y + moved->y;
			if (!ty_is_behind_line(l, i, (ty_point){box.x, box.y}))
				break;
		}
	}
	return false;
}

/* Where its lines, which are listed, are in the way of the site at home, it takes a seat. False: there is none. */
static bool
take_seat(ty_ladder *l, uint32_t i)
{
	ty_site *s = &l->sites[i];
	ty_point away, moved;

	if (!l->by_line[i] || (!ty_is_line_conflict(l, ty_line_lack(l, i, &away)) && !ty_is_across(l, i)))
		return true;
	if (finds_room(l, i, s->own, &moved))
		s->size = fmin(s->size, 1);
	else if (s->least.length < s->own.length && finds_room(l, i, s->least, &moved))
		s->size = 0;
	else
		return false;
	l->place[i].moved = moved;
	ty_place_box(l, i);
	return true;
}

/* ---- sites ---- */

/* The site meets the lines that it will be kept away from. */
static ty_status
meet_lines(ty_ladder *l, uint32_t i)
{
	ty_status status;

	l->unmet = false;
	status = ty_enter_site(l, i);
	l->unmet = true;
	return status;
}

/* Finds out whether the site has room, and so meets its lines; if it has none they stay listed. */
static ty_status
look_for_room(ty_ladder *l, uint32_t i, bool *room)
{
	const ty_site *s = &l->sites[i];
	double factor = s->full.length > 0 ? s->least.length / s->full.length : 1;
	ty_point from = {factor * s->shift.x, factor * s->shift.y};
	double bound = fmax(ty_free_way(l, i), 0.5 * s->least.length);
	ty_status status;

	*room = s->fixed || ty_in_row(l, i) || ty_on_rail(s);
	if (*room)
		return meet_lines(l, i);
	status = ty_list_lines(l, i,
						   bound + 2 * sqrt(from.x * from.x + from.y * from.y) + 0.5 * s->least.width + l->line_target);
	if (status == TY_OK)
		status = survey(l, i);
	if (status != TY_OK || !disc_finds_room(l, i, from, bound))
		return status;
	status = meet_lines(l, i);
	*room = l->body[i].clear = status == TY_OK && take_seat(l, i);
	return status;
}

static inline bool
has_seat(const ty_ladder *l, uint32_t i)
{
	ty_point moved = l->place[i].moved;

	return l->by_line[i] && l->body[i].clear && (moved.x != 0 || moved.y != 0);
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

/* All that are left meet their lines. */
static ty_status
meet_all(ty_ladder *l)
{
	ty_status status = TY_OK;

	for (size_t k = 0; status == TY_OK && k < l->active_count; k++)
	{
		if (ty_interrupted_at(l->env, k))
			status = TY_INTERRUPTED;
		else if (ty_is_drawn(l, l->active[k]))
			status = meet_lines(l, l->active[k]);
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
	l->unmet = false;
	l->around.count = 0;
	ty_vicinity_fit(&l->near);
	ty_release(l->env, changed);
	return status;
}
