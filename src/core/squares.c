/* squares.c - see squares.h */
#include "squares.h"

#include <math.h>
#include <string.h>

#define LEAST_BITS 5 /* of a column of the grid: no ring meets itself */
#define MOST_BITS 13
#define FIRST_FOUND 64
#define COLUMNS 4294967296.0

/* the column or row of a coordinate */
static uint32_t
column_of(const ty_squares *s, double value)
{
	double column = floor(value / s->side);

	return (uint32_t) (column - floor(column / COLUMNS) * COLUMNS);
}

static inline uint32_t *
first_in(const ty_squares *s, ty_square square)
{
	return &s->first[(size_t) (square.row & s->mask) * (s->mask + 1) + (square.column & s->mask)];
}

ty_status
ty_squares_begin(const ty_environment *env, size_t count, double side, ty_squares *squares)
{
	int bits = LEAST_BITS;
	size_t all;

	while (bits < MOST_BITS && ((size_t) 1 << 2 * bits) < count)
		bits++;
	all = (size_t) 1 << 2 * bits;
	*squares =
		(ty_squares){.env = env, .side = side, .mask = ((uint32_t) 1 << bits) - 1, .found_capacity = FIRST_FOUND};
	squares->first = ty_allocate_array(env, all, sizeof *squares->first);
	squares->next = ty_allocate_array(env, count, sizeof *squares->next);
	squares->square = ty_allocate_array(env, count, sizeof *squares->square);
	squares->found = ty_allocate_array(env, FIRST_FOUND, sizeof *squares->found);
	if (squares->first == NULL || squares->next == NULL || squares->square == NULL || squares->found == NULL)
		return TY_NO_MEMORY;
	memset(squares->first, 0xff, all * sizeof *squares->first);
	return TY_OK;
}

void
ty_squares_free(ty_squares *squares)
{
	if (squares->env == NULL)
		return;
	ty_release(squares->env, squares->first);
	ty_release(squares->env, squares->next);
	ty_release(squares->env, squares->square);
	ty_release(squares->env, squares->found);
	*squares = (ty_squares){0};
}

void
ty_squares_insert(ty_squares *s, uint32_t number, ty_point place)
{
	ty_square square = {column_of(s, place.x), column_of(s, place.y)};
	uint32_t *first = first_in(s, square);

	s->square[number] = square;
	s->next[number] = *first;
	*first = number;
}

void
ty_squares_remove(ty_squares *s, uint32_t number)
{
	uint32_t *link = first_in(s, s->square[number]);

	while (*link != number)
		link = &s->next[*link];
	*link = s->next[number];
}

/* ---- rings ---- */

static ty_status
list_square(ty_squares *s, uint32_t column, uint32_t row)
{
	for (uint32_t k = *first_in(s, (ty_square){column, row}); k != TY_NO_PLACE; k = s->next[k])
	{
		if (s->square[k].column != column || s->square[k].row != row)
			continue;
		if (s->found_count == s->found_capacity)
		{
			uint32_t *larger = ty_reallocate_array(s->env, s->found, 2 * s->found_capacity, sizeof *larger);

			if (larger == NULL)
				return TY_NO_MEMORY;
			s->found = larger;
			s->found_capacity *= 2;
		}
		s->found[s->found_count++] = k;
	}
	return TY_OK;
}

ty_status
ty_squares_ring(ty_squares *s, ty_point place, uint32_t ring)
{
	uint32_t column = column_of(s, place.x), row = column_of(s, place.y);
	ty_status status = TY_OK;

	s->found_count = 0;
	if (ring == 0)
		return list_square(s, column, row);
	for (uint32_t k = 0; status == TY_OK && k < 2 * ring; k++)
	{
		status = list_square(s, column - ring + k, row - ring);
		if (status == TY_OK)
			status = list_square(s, column + ring, row - ring + k);
		if (status == TY_OK)
			status = list_square(s, column + ring - k, row + ring);
		if (status == TY_OK)
			status = list_square(s, column - ring, row + ring - k);
	}
	return status;
}

/* how far a coordinate is from the sides of its square */
static double
from_sides(const ty_squares *s, double value)
{
	double above = value - floor(value / s->side) * s->side;

	return fmax(fmin(above, s->side - above), 0);
}

double
ty_squares_within(const ty_squares *s, ty_point place, uint32_t ring)
{
	double beyond_ring = ring * s->side + fmin(from_sides(s, place.x), from_sides(s, place.y));

	return beyond_ring * (1 - 1e-9);
}
