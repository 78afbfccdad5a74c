/*
 * legibility_thin.c - joins or hides where so many sites crowd that nothing else can help.
 *
 * Squares not much wider than a site with its gap hold one, and a few more where their neighbours are empty. In squares
 * with more than CROWD sites the closest two are joined until no more are left, without any pushing: else the
 * work would grow with the square of the crowd.
 */
#include "legibility_internal.h"

#include "grid.h"

#include <math.h>

#define CROWD 8		 /* sites in a square one to two times as wide as each needs: four times what can stand there */
#define CLOSE_UP 32	 /* as many at most are compared each with each; of more, neighbours in order are joined first */
#define LEVEL_BITS 6 /* of a square's key; column and row have 29 each */
#define MOST_SQUARES 268435456.0 /* in a row of level 0 */

/* The width below which a site is of the first level: of the least, but not so narrow that numbers would not do. */
static double
narrowest(const ty_ladder *l)
{
	double least = INFINITY, extent = 0;

	for (size_t i = 0; i < l->n; i++)
		if (ty_is_drawn(l, (uint32_t) i))
		{
			least = fmin(least, l->sites[i].least.width + l->gap);
			extent = fmax(extent, fmax(l->body[i].box.x, l->body[i].box.y));
		}
	return fmax(least, extent / MOST_SQUARES);
}

/* The square: the level whose squares are wide enough, then column and row. */
static uint64_t
square_key(const ty_ladder *l, uint32_t i, double side)
{
	const ty_site *s = &l->sites[i];
	uint64_t level = 0;

	while (side < s->least.width + l->gap && level < (1 << LEVEL_BITS) - 1)
	{
		side *= 2;
		level++;
	}
	return (level << 29 | (uint64_t) fmax((s->home.x - l->origin.x) / side, 0)) << 29 |
		   (uint64_t) fmax((s->home.y - l->origin.y) / side, 0);
}

/* Joins neighbours in the list. How many are left; as many as before when none could be joined. */
static ty_status
join_neighbours(ty_ladder *l, uint32_t *list, size_t *count)
{
	size_t left = 0;
	ty_status status = TY_OK;

	for (size_t k = 0; status == TY_OK && k < *count; k++)
	{
		if (k + 1 < *count && ty_may_join(l, list[k], list[k + 1]))
		{
			status = ty_join_sites(l, list[k], list[k + 1], TY_NO_SITE, &list[left++]);
			k++;
		}
		else
			list[left++] = list[k];
	}
	*count = left;
	return status;
}

/* Joins the two whose homes are closest. */
static ty_status
join_closest(ty_ladder *l, uint32_t *list, size_t *count)
{
	double least = INFINITY;
	size_t a = 0, b = 0;
	ty_status status;

	for (size_t j = 1; j < *count; j++)
		for (size_t i = 0; i < j; i++)
		{
			double dx = l->sites[list[i]].home.x - l->sites[list[j]].home.x;
			double dy = l->sites[list[i]].home.y - l->sites[list[j]].home.y;

			if (dx * dx + dy * dy < least && ty_may_join(l, list[i], list[j]))
			{
				least = dx * dx + dy * dy;
				a = i;
				b = j;
			}
		}
	if (a == b)
		return TY_OK;
	status = ty_join_sites(l, list[a], list[b], TY_NO_SITE, &list[a]);
	list[b] = list[--*count];
	return status;
}

/* Where none are joined the heaviest stay. */
static ty_status
hide_lightest(ty_ladder *l, uint32_t *list, size_t count)
{
	uint64_t *keys = ty_allocate_array(l->env, count, sizeof *keys);
	ty_status status = TY_NO_MEMORY;

	if (keys != NULL)
	{
		for (size_t k = 0; k < count; k++)
			keys[k] = UINT32_MAX - l->sites[list[k]].weight;
		status = ty_sort_keys(l->env, keys, list, count);
	}
	for (size_t k = CROWD; status == TY_OK && k < count; k++)
		ty_hide_site(l, list[k]);
	ty_release(l->env, keys);
	return status;
}

/* One square. Fixed sites stay in any case, and those of rows, unless these crowd. */
static ty_status
thin_square(ty_ladder *l, uint32_t *list, size_t count)
{
	size_t free = 0, railed = 0, before;
	ty_status status = TY_OK;

	for (size_t k = 0; k < count; k++)
		railed += ty_in_row(l, list[k]);
	for (size_t k = 0; railed > CROWD && k < count; k++)
		ty_dissolve_row(l, list[k]);
	for (size_t k = 0; k < count; k++)
		if (!l->sites[list[k]].fixed && !ty_in_row(l, list[k]))
			list[free++] = list[k];
	if (free <= CROWD)
		return TY_OK;
	if (l->rules->join == NULL)
		return hide_lightest(l, list, free);
	do
	{
		before = free;
		status = free > CLOSE_UP ? join_neighbours(l, list, &free) : join_closest(l, list, &free);
	} while (status == TY_OK && free > CROWD && free < before);
	return status;
}

/* How many of the sorted keys from the first on are the same. */
static size_t
run_length(const uint64_t *keys, size_t n)
{
	size_t count = 1;

	while (count < n && keys[count] == keys[0])
		count++;
	return count;
}

ty_status
ty_thin_out(ty_ladder *l)
{
	uint64_t *keys = ty_allocate_array(l->env, l->n, sizeof *keys);
	uint32_t *list = ty_allocate_array(l->env, l->n, sizeof *list);
	double side = narrowest(l);
	size_t drawn = 0, run;
	ty_status status = TY_NO_MEMORY;

	if (keys != NULL && list != NULL)
	{
		for (uint32_t i = 0; i < l->n; i++)
			if (ty_is_drawn(l, i))
			{
				keys[drawn] = square_key(l, i, side);
				list[drawn++] = i;
			}
		status = ty_sort_keys(l->env, keys, list, drawn);
	}
	for (size_t first = 0; status == TY_OK && first < drawn; first += run)
	{
		run = run_length(keys + first, drawn - first);
		if (ty_interrupted_at(l->env, first))
			status = TY_INTERRUPTED;
		else if (run > CROWD)
			status = thin_square(l, list + first, run);
	}
	ty_release(l->env, keys);
	ty_release(l->env, list);
	return status;
}
