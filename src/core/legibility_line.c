/* legibility_line.c - sites and the lines that they keep away from: see the head of legibility.c. */
#include "legibility_internal.h"

#include <math.h>

#define ASKED \
	32 /* so many of the nearest sites are asked whether a line lies between: who is farther is no neighbour */

/* the four corners, where they are on the ground */
static void
corners_of(const ty_ladder *l, uint32_t i, ty_point corners[4])
{
	const ty_oblong *b = &l->box[i];
	ty_point along = {b->half_length * b->ux, b->half_length * b->uy};
	ty_point across = {b->half_width * -b->uy, b->half_width * b->ux};
	ty_point centre = {l->origin.x + b->x, l->origin.y + b->y};

	corners[0] = (ty_point){centre.x - along.x - across.x, centre.y - along.y - across.y};
	corners[1] = (ty_point){centre.x + along.x - across.x, centre.y + along.y - across.y};
	corners[2] = (ty_point){centre.x + along.x + across.x, centre.y + along.y + across.y};
	corners[3] = (ty_point){centre.x - along.x + across.x, centre.y - along.y + across.y};
}

bool
ty_line_in_reach(const ty_ladder *l, uint32_t i, double reach)
{
	const ty_site *s = &l->sites[i];
	double limit;

	if (l->rules->lines == NULL || s->fixed)
		return false;
	limit = reach + l->line_target;
	return ty_barrier_lines_gap(l->rules->lines, &s->home, 1, limit).distance < limit;
}

bool
ty_is_across(const ty_ladder *l, uint32_t i)
{
	const ty_site *s = &l->sites[i];
	ty_point centre = {l->origin.x + l->box[i].x, l->origin.y + l->box[i].y};

	return l->by_line[i] && ty_barrier_lines_cross(l->rules->lines, s->home, centre);
}

static ty_point
unit_vector(ty_point from, ty_point to, double length)
{
	return (ty_point){(to.x - from.x) / length, (to.y - from.y) / length};
}

/* A line meets the site: away from the line that is nearest to its centre. */
static double
lack_of_crossed(const ty_ladder *l, uint32_t i, ty_point *away)
{
	ty_point centre = {l->origin.x + l->box[i].x, l->origin.y + l->box[i].y};
	double limit = l->radius[i] + l->line_target;
	ty_barrier_gap gap = ty_barrier_lines_gap(l->rules->lines, &centre, 1, limit);

	*away = (ty_point){-l->box[i].uy, l->box[i].ux};
	if (gap.distance > 0 && gap.distance < limit)
		*away = unit_vector(gap.line, gap.shape, gap.distance);
	return ty_extent(&l->box[i], *away) + l->line_target - fmin(gap.distance, limit);
}

double
ty_line_lack(const ty_ladder *l, uint32_t i, ty_point *away)
{
	ty_point corners[4];
	ty_barrier_gap gap;

	if (!l->by_line[i])
		return 0;
	corners_of(l, i, corners);
	gap = ty_barrier_lines_gap(l->rules->lines, corners, 4, l->line_target);
	if (gap.distance >= l->line_target)
		return 0;
	if (gap.distance <= 0)
		return fmax(lack_of_crossed(l, i, away), l->line_target);
	*away = unit_vector(gap.line, gap.shape, gap.distance);
	return l->line_target - gap.distance;
}

bool
ty_fixed_by_line(const ty_ladder *l, uint32_t i)
{
	double limit = l->line_gap;
	ty_point corners[4];

	if (l->rules->lines == NULL)
		return false;
	corners_of(l, i, corners);
	return ty_barrier_lines_gap(l->rules->lines, corners, 4, limit).distance < limit;
}

bool
ty_is_line_conflict(const ty_ladder *l, double lack)
{
	return lack > l->line_target - l->line_gap;
}

bool
ty_may_join(const ty_ladder *l, uint32_t a, uint32_t b)
{
	const ty_site *s = &l->sites[a], *t = &l->sites[b];

	return s->group == t->group &&
		   (l->rules->lines == NULL || !ty_barrier_lines_cross(l->rules->lines, s->home, t->home));
}

/* ---- the nearest neighbour ---- */

static double
squared_distance(const ty_ladder *l, uint32_t a, uint32_t b)
{
	double dx = l->sites[a].home.x - l->sites[b].home.x, dy = l->sites[a].home.y - l->sites[b].home.y;

	return dx * dx + dy * dy;
}

/* The nearest of those found that is farther than `beyond`, or as far with a greater number; TY_NO_SITE: none. */
static uint32_t
next_nearest(const ty_ladder *l, uint32_t i, double beyond, uint32_t after)
{
	uint32_t best = TY_NO_SITE;
	double least = INFINITY;

	for (size_t m = 0; m < l->near.found_count; m++)
	{
		uint32_t j = l->near.found[m];
		double d = squared_distance(l, i, j);

		if (d < beyond || (d == beyond && after != TY_NO_SITE && j <= after))
			continue;
		if (d < least || (d == least && j < best))
		{
			least = d;
			best = j;
		}
	}
	return best;
}

/* Finds ASKED sites at least, or all there are. */
static ty_status
find_some(ty_ladder *l, uint32_t i)
{
	const ty_disc *disc = &l->near.discs[i];
	double radius = 2 * disc->radius;
	size_t all = 0, before = 0;
	ty_status status = TY_OK;

	for (int level = 0; level < TY_VICINITY_LEVELS; level++)
		all += l->near.level_count[level];
	for (bool enough = false; status == TY_OK && !enough; radius *= 2)
	{
		status = ty_vicinity_find(&l->near, i, (ty_point){disc->x, disc->y}, radius);
		before = l->near.found_count;
		enough = before > ASKED || before + 1 >= all || !(radius < INFINITY);
	}
	return status;
}

ty_status
ty_nearest_site(ty_ladder *l, uint32_t i, uint32_t *nearest, bool *across)
{
	ty_status status = find_some(l, i);
	uint32_t j = next_nearest(l, i, 0, TY_NO_SITE);

	*nearest = j;
	*across = true;
	for (int asked = 0; status == TY_OK && asked < ASKED && j != TY_NO_SITE; asked++)
	{
		if (ty_may_join(l, i, j))
		{
			*nearest = j;
			*across = false;
			break;
		}
		j = next_nearest(l, i, squared_distance(l, i, j), j);
	}
	return status;
}
