/*
 * legibility_settle.c - rounds of shrinking and displacing, and what is taken back in the end.
 *
 * A round is a sweep over the active sites, each of which settles with whoever is too near at that moment; who had to
 * do something, and whom it was done to, is active in the next one. Crowds so spread until there is room, or until
 * everybody stands at its bound.
 */
#include "legibility_internal.h"

#include <math.h>

/* ---- shrinking ---- */

#define SHRINK_STEPS 12 /* of at most a quarter of the way from full to own, or from own to least */
#define SHRINK_STEP 0.25

/* how many times larger than at the floor, 1 for own and 0 for least, the site is now */
static inline double
growth(const ty_ladder *l, uint32_t i, int floor_size)
{
	const ty_site *s = &l->sites[i];
	const ty_sides *least = floor_size >= 1 ? &s->own : &s->least;
	const ty_oblong *now = &l->body[i].box;

	if (l->body[i].fixed || l->body[i].stages <= floor_size)
		return 0;
	return 4 * now->half_width * now->half_length / (least->width * least->length);
}

/* The size below which a site that was moved would stand too far from home for its longer side. */
static double
least_size(const ty_ladder *l, uint32_t i, int floor_size)
{
	const ty_site *s = &l->sites[i];
	ty_point way = l->place[i].moved;
	double moved = sqrt(way.x * way.x + way.y * way.y);
	ty_sides high = floor_size >= 1 ? s->full : s->own, low = floor_size >= 1 ? s->own : s->least;
	double span = high.length - low.length;

	if (moved <= ty_free_way(l, i) || 0.5 * low.length >= moved)
		return floor_size;
	return span > 0 ? floor_size + fmin((2 * moved - low.length) / span, 1) : s->size;
}

/* by how much less the site takes up along n at the floor than one stage above it */
static double
span_of_stage(const ty_ladder *l, uint32_t i, ty_point n, int floor_size)
{
	const ty_site *s = &l->sites[i];
	ty_sides high = floor_size >= 1 ? s->full : s->own, low = floor_size >= 1 ? s->own : s->least;
	ty_oblong box = l->body[i].box;

	box.half_length = 0.5 * (high.length - low.length);
	box.half_width = 0.5 * (high.width - low.width);
	return ty_extent(&box, n);
}

/*
 * Shrinks the site by what is lacking along n, in one step, and not below the floor; one that stands too far from home
 * for its longer side then comes back, unless it is to stay. Whether it became smaller.
 */
static bool
shrink(ty_ladder *l, uint32_t i, double lack, ty_point n, int floor_size)
{
	ty_site *s = &l->sites[i];
	double size = s->size, least, span;

	if (l->body[i].stages <= floor_size)
		return false;
	least = l->frozen[i] ? least_size(l, i, floor_size) : floor_size;
	span = span_of_stage(l, i, n, floor_size);
	if (!(size > least))
		return false;
	s->size = fmax(least, size - (span > 0 ? fmin(SHRINK_STEP, lack / span) : SHRINK_STEP));
	ty_place_box(l, i);
	ty_keep_in_bound(l, i);
	return s->size < size;
}

/* Shrinks two sites as far as needed and as the floor allows, the one that has grown more first. What still lacks. */
static double
shrink_pair(ty_ladder *l, uint32_t a, uint32_t b, double lack, ty_point *n, int floor_size)
{
	for (int step = 0; step < SHRINK_STEPS && lack > 0; step++)
	{
		double growth_a = growth(l, a, floor_size), growth_b = growth(l, b, floor_size);
		uint32_t first = growth_a >= growth_b ? a : b, second = first == a ? b : a;

		if (growth_a == 0 && growth_b == 0)
			break;
		if (!shrink(l, first, lack, *n, floor_size) && !shrink(l, second, lack, *n, floor_size))
			break;
		lack = ty_sites_lack(l, a, b, n);
	}
	return lack;
}

/* ---- displacing ---- */

/*
 * How much farther than they lack two are pushed apart as long as nobody is below its true size: successive
 * over-relaxation (Young 1954), which as there is best a little below 2. Of a million buildings at 1:75 000 settling
 * takes half the time and 1 % more sites are left; with 3 it is 4 % fewer. What went too far comes back in the end.
 */
#define PUSH 1.8
#define STAGNANT 0.97 /* share of what was lacking a round before, above which another round is not worth its time */

/* The way from home of a site on a rail: off its line but a little. */
static ty_point
on_rail(const ty_ladder *l, uint32_t i, ty_point way)
{
	const ty_site *s = &l->sites[i];
	double along = way.x * s->axis.x + way.y * s->axis.y, across = way.y * s->axis.x - way.x * s->axis.y;
	double play = ty_play(l, s);

	along = ty_before_end(l, i, along);
	across = fmax(fmin(across, s->rail + play), s->rail - play);
	return (ty_point){along * s->axis.x - across * s->axis.y, along * s->axis.y + across * s->axis.x};
}

/* Moves the site, within its bound. How far it came along n. */
static double
displace(ty_ladder *l, uint32_t i, double distance, ty_point n)
{
	ty_point from = l->place[i].moved, to = {from.x + distance * n.x, from.y + distance * n.y};
	double bound = l->body[i].box.half_length, squared;

	if (l->body[i].fixed || l->frozen[i])
		return 0;
	if (l->body[i].railed)
		to = on_rail(l, i, to);
	squared = to.x * to.x + to.y * to.y;
	if (squared > bound * bound)
		bound = fmax(bound, ty_free_way(l, i));
	if (squared > bound * bound)
	{
		double factor = bound / sqrt(squared);

		to = (ty_point){to.x * factor, to.y * factor};
	}
	l->place[i].moved = to;
	ty_move_box(l, i);
	return (to.x - from.x) * n.x + (to.y - from.y) * n.y;
}

void
ty_keep_in_bound(ty_ladder *l, uint32_t i)
{
	double bound = l->body[i].box.half_length;
	ty_point moved = l->place[i].moved;

	if (moved.x * moved.x + moved.y * moved.y > bound * bound)
		displace(l, i, 0, (ty_point){0, 0});
}

/*
 * Pushes b away from a along n, and a from b, half and half, or first the one in no row; what one cannot do the other
 * does.
 */
static void
push_apart(ty_ladder *l, uint32_t a, uint32_t b, double lack, ty_point n)
{
	ty_point back = {-n.x, -n.y};
	bool a_stays = l->body[a].railed && !l->body[b].railed, b_stays = l->body[b].railed && !l->body[a].railed;

	if (!a_stays)
		lack -= displace(l, a, b_stays ? lack : 0.5 * lack, back);
	lack -= displace(l, b, lack, n);
	if (lack > 0)
		displace(l, a, lack, back);
}

static void
settle_pair(ty_ladder *l, uint32_t a, uint32_t b, double lack, ty_point n, bool below)
{
	l->lacking += lack;
	lack = shrink_pair(l, a, b, lack, &n, 1);
	if (lack > 0 && below)
		lack = shrink_pair(l, a, b, lack, &n, 0);
	if (lack > 0)
		push_apart(l, a, b, below ? lack : PUSH * lack, n);
	ty_activate(l, a);
	ty_activate(l, b);
}

/* Takes the site away from a line that it is too near to, and back from the other side of one. */
static void
settle_by_line(ty_ladder *l, uint32_t i, bool below)
{
	ty_point n;
	double lack;

	if (!l->by_line[i] || l->frozen[i] || l->body[i].clear)
		return;
	if (ty_is_across(l, i))
	{
		l->place[i].moved = (ty_point){0, 0};
		ty_place_box(l, i);
		ty_activate(l, i);
	}
	lack = ty_line_lack(l, i, &n);
	if (!ty_is_line_conflict(l, lack))
	{
		l->body[i].clear = true;
		return;
	}
	l->lacking += lack;
	for (int stage = 1; stage >= (below ? 0 : 1); stage--)
		for (int step = 0; step < SHRINK_STEPS && lack > 0 && growth(l, i, stage) > 0; step++)
		{
			if (!shrink(l, i, lack, n, stage))
				break;
			lack = ty_line_lack(l, i, &n);
		}
	if (lack > 0)
		displace(l, i, lack, n);
	ty_activate(l, i);
}

static ty_status
settle_site(ty_ladder *l, uint32_t i, bool below)
{
	ty_status status = ty_find_near(l, i);

	if (status == TY_OK)
		settle_by_line(l, i, below);
	/* the last first: a sweep goes up, so that those pushed ahead are still to come; it saves 0.3 % of the sites */
	for (size_t m = l->list_count; status == TY_OK && m-- > 0;)
	{
		uint32_t j = l->list[m], a = i < j ? i : j, b = i < j ? j : i;
		ty_point n;
		double lack = ty_sites_lack(l, a, b, &n);

		if (ty_is_conflict(l, lack))
			settle_pair(l, a, b, lack, n, below);
	}
	return status;
}

ty_status
ty_settle(ty_ladder *l, int rounds, bool below)
{
	ty_status status = TY_OK;
	double before = INFINITY;

	for (int round = 0; status == TY_OK && round < rounds && l->active_count > 0; round++)
	{
		l->lacking = 0;
		for (size_t k = 0; status == TY_OK && k < l->active_count; k++)
		{
			if (ty_interrupted_at(l->env, k))
				return TY_INTERRUPTED;
			uint32_t i = l->active[k];
			if (ty_is_drawn(l, i))
				status = settle_site(l, i, below);
		}
		ty_next_round(l);
		if (l->lacking > STAGNANT * before)
			break;
		before = l->lacking;
	}
	return status;
}

/* ---- taking back ---- */

#define RELENT_PASSES 2 /* one may be in the other's way home */
#define RELENT_STEPS 4	/* of halving the way */

static bool
is_in_the_way(const ty_ladder *l, uint32_t i, uint32_t j)
{
	ty_point n;

	return ty_is_conflict(l, ty_sites_lack(l, i < j ? i : j, i < j ? j : i, &n));
}

/*
 * Whether the site, as it is now, is in no conflict with one of those that were found near it. *obstacle: who was in the
 * way the last time, and so is asked first; TY_NO_SITE: nobody was.
 */
static bool
has_room(const ty_ladder *l, uint32_t i, uint32_t *obstacle)
{
	if (*obstacle != TY_NO_SITE && is_in_the_way(l, i, *obstacle))
		return false;
	if (ty_is_by_line(l, i) || ty_is_across(l, i))
		return false;
	for (size_t m = 0; m < l->list_count; m++)
		if (is_in_the_way(l, i, l->list[m]))
		{
			*obstacle = l->list[m];
			return false;
		}
	return true;
}

/* All the way home, or as much of it as there is room for. */
static void
go_home(ty_ladder *l, uint32_t i)
{
	ty_point moved = l->place[i].moved, rest = ty_rest(&l->sites[i]);
	double share = 0;
	uint32_t obstacle = TY_NO_SITE;

	for (int step = 0; step < RELENT_STEPS; step++)
	{
		l->place[i].moved = (ty_point){rest.x + share * (moved.x - rest.x), rest.y + share * (moved.y - rest.y)};
		ty_move_box(l, i);
		ty_keep_in_bound(l, i);
		if (has_room(l, i, &obstacle))
			return;
		share = 0.5 * (share + 1);
	}
	l->place[i].moved = moved;
	ty_move_box(l, i);
}

/* As large as there is room for, up to its true size and then up to its full one. */
static void
grow_again(ty_ladder *l, uint32_t i)
{
	ty_site *s = &l->sites[i];
	double size = s->size, high = 2;
	uint32_t obstacle = TY_NO_SITE;

	for (int step = 0; step < RELENT_STEPS; step++)
	{
		s->size = high;
		ty_place_box(l, i);
		if (has_room(l, i, &obstacle))
			return;
		high = 0.5 * (size + high);
	}
	s->size = size;
	ty_place_box(l, i);
}

ty_status
ty_relent(ty_ladder *l)
{
	ty_status status = TY_OK;

	for (int pass = 0; pass < RELENT_PASSES; pass++)
		for (uint32_t i = 0; status == TY_OK && i < l->n; i++)
		{
			ty_site *s = &l->sites[i];
			ty_point rest = ty_rest(s), moved = l->place[i].moved;
			bool away = moved.x != rest.x || moved.y != rest.y, small = s->size < 2;

			if (ty_interrupted_at(l->env, i))
				return TY_INTERRUPTED;
			if (s->state != TY_DRAWN || s->fixed || !(away || small))
				continue;
			status = ty_find_near(l, i);
			if (status == TY_OK && away)
				go_home(l, i);
			if (status == TY_OK && small)
				grow_again(l, i);
		}
	return status;
}
