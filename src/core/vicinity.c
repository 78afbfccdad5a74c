/* vicinity.c - see vicinity.h */
#include "vicinity.h"

#include <math.h>
#include <string.h>

#define NOBODY UINT32_MAX
#define MOST_CELLS 1073741824.0 /* in a row of level 0, so that their numbers fit 32 bits */
#define FIRST_FOUND 256

static double
cell_side(const ty_vicinity *v, int level)
{
	return ldexp(v->smallest, level);
}

/* A cell is at least half as wide as its discs: measured, fewer discs are looked at than in wider ones. */
static int
level_of(const ty_vicinity *v, double radius)
{
	int level = 0;

	while (level < TY_VICINITY_LEVELS - 1 && cell_side(v, level) < radius)
		level++;
	return level;
}

static int32_t
cell_number(double place, double origin, double side)
{
	double cell = floor((place - origin) / side);

	return (int32_t) fmin(fmax(cell, -MOST_CELLS), MOST_CELLS);
}

static uint32_t *
bucket_of(const ty_vicinity *v, int level, int32_t column, int32_t row)
{
	uint64_t key = (uint64_t) (uint32_t) column << 32 | (uint32_t) row;

	key = (key + (uint64_t) level * UINT64_C(0xD1B54A32D192ED03)) * UINT64_C(0x9E3779B97F4A7C15);
	key ^= key >> 29;
	key *= UINT64_C(0xBF58476D1CE4E5B9);
	return &v->buckets[(key >> 32) & v->mask];
}

ty_status
ty_vicinity_begin(const ty_environment *env, size_t count, ty_point low, ty_point high, double smallest_radius,
				  ty_vicinity *v)
{
	double extent = fmax(high.x - low.x, high.y - low.y);
	uint32_t buckets = 16;

	*v = (ty_vicinity){.env = env, .count = count, .origin = low, .found_capacity = FIRST_FOUND};
	v->smallest = fmax(smallest_radius, extent / MOST_CELLS);
	while (buckets < count && buckets < UINT32_C(1) << 31)
		buckets *= 2;
	v->mask = buckets - 1;
	v->discs = ty_allocate_array(env, count, sizeof *v->discs);
	v->buckets = ty_allocate_array(env, buckets, sizeof *v->buckets);
	v->found = ty_allocate_array(env, v->found_capacity, sizeof *v->found);
	if (v->discs == NULL || v->buckets == NULL || v->found == NULL)
		return TY_NO_MEMORY;
	memset(v->buckets, 0xff, buckets * sizeof *v->buckets);
	memset(v->level_first, 0xff, sizeof v->level_first);
	for (size_t i = 0; i < count; i++)
		v->discs[i].level = -1;
	return TY_OK;
}

void
ty_vicinity_free(ty_vicinity *v)
{
	if (v->env == NULL)
		return;
	ty_release(v->env, v->discs);
	ty_release(v->env, v->buckets);
	ty_release(v->env, v->found);
	*v = (ty_vicinity){0};
}

void
ty_vicinity_insert(ty_vicinity *v, uint32_t number, ty_point center, double radius)
{
	ty_disc *disc = &v->discs[number];
	int level = level_of(v, radius);
	double side = cell_side(v, level);
	uint32_t *bucket, *first = &v->level_first[level];

	*disc = (ty_disc){.x = center.x, .y = center.y, .radius = radius, .level = (int8_t) level};
	disc->column = cell_number(center.x, v->origin.x, side);
	disc->row = cell_number(center.y, v->origin.y, side);
	bucket = bucket_of(v, level, disc->column, disc->row);
	disc->previous = disc->level_previous = NOBODY;
	disc->next = *bucket;
	disc->level_next = *first;
	if (*bucket != NOBODY)
		v->discs[*bucket].previous = number;
	if (*first != NOBODY)
		v->discs[*first].level_previous = number;
	*bucket = *first = number;
	v->level_count[level]++;
	v->level_radius[level] = fmax(v->level_radius[level], radius);
}

void
ty_vicinity_remove(ty_vicinity *v, uint32_t number)
{
	ty_disc *disc = &v->discs[number];

	if (disc->next != NOBODY)
		v->discs[disc->next].previous = disc->previous;
	if (disc->previous != NOBODY)
		v->discs[disc->previous].next = disc->next;
	else
		*bucket_of(v, disc->level, disc->column, disc->row) = disc->next;
	if (disc->level_next != NOBODY)
		v->discs[disc->level_next].level_previous = disc->level_previous;
	if (disc->level_previous != NOBODY)
		v->discs[disc->level_previous].level_next = disc->level_next;
	else
		v->level_first[disc->level] = disc->level_next;
	v->level_count[disc->level]--;
	disc->level = -1;
}

/* Lists the disc if it touches the one that is looked for. */
static ty_status
consider(ty_vicinity *v, uint32_t other, uint32_t number, ty_point center, double radius)
{
	const ty_disc *disc = &v->discs[other];
	double dx = disc->x - center.x, dy = disc->y - center.y, reach = radius + disc->radius;

	if (other == number || dx * dx + dy * dy > reach * reach)
		return TY_OK;
	if (v->found_count == v->found_capacity)
	{
		uint32_t *found = ty_reallocate_array(v->env, v->found, 2 * v->found_capacity, sizeof *found);

		if (found == NULL)
			return TY_NO_MEMORY;
		v->found = found;
		v->found_capacity *= 2;
	}
	v->found[v->found_count++] = other;
	return TY_OK;
}

static ty_status
search_cell(ty_vicinity *v, int level, int32_t column, int32_t row, uint32_t number, ty_point center, double radius)
{
	ty_status status = TY_OK;

	for (uint32_t i = *bucket_of(v, level, column, row); status == TY_OK && i != NOBODY; i = v->discs[i].next)
		if (v->discs[i].level == level && v->discs[i].column == column && v->discs[i].row == row)
			status = consider(v, i, number, center, radius);
	return status;
}

/* Cell by cell, or, where there are more cells than discs, disc by disc. */
static ty_status
search_level(ty_vicinity *v, int level, uint32_t number, ty_point center, double radius)
{
	double side = cell_side(v, level), reach = radius + v->level_radius[level];
	int32_t left = cell_number(center.x - reach, v->origin.x, side);
	int32_t right = cell_number(center.x + reach, v->origin.x, side);
	int32_t low = cell_number(center.y - reach, v->origin.y, side);
	int32_t high = cell_number(center.y + reach, v->origin.y, side);
	ty_status status = TY_OK;

	if (((double) right - left + 1) * ((double) high - low + 1) > (double) v->level_count[level])
	{
		for (uint32_t i = v->level_first[level]; status == TY_OK && i != NOBODY; i = v->discs[i].level_next)
			status = consider(v, i, number, center, radius);
		return status;
	}
	for (int32_t row = low; row <= high; row++)
		for (int32_t column = left; status == TY_OK && column <= right; column++)
			status = search_cell(v, level, column, row, number, center, radius);
	return status;
}

ty_status
ty_vicinity_find(ty_vicinity *v, uint32_t number, ty_point center, double radius)
{
	ty_status status = TY_OK;

	v->found_count = 0;
	for (int level = 0; status == TY_OK && level < TY_VICINITY_LEVELS; level++)
		if (v->level_count[level] > 0)
			status = search_level(v, level, number, center, radius);
	return status;
}
