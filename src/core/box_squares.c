/* box_squares.c - see box_squares.h */
#include "box_squares.h"

#include <string.h>

#define LEAST_BOXES 64 /* of fewer the tree is as quick */
#define LEAST_BITS 3   /* of a column of the grid */
#define MOST_BITS 12

/* a box as columns and rows */
typedef struct span
{
	uint32_t low_column, low_row, columns, rows;
} span;

static span
span_of(const ty_box_squares *s, const ty_box *box)
{
	uint32_t column = ty_square_column(s, (int64_t) box->low_x), row = ty_square_column(s, (int64_t) box->low_y);

	return (span){column, row, ty_square_column(s, (int64_t) box->high_x) - column + 1,
				  ty_square_column(s, (int64_t) box->high_y) - row + 1};
}

/* A square is as wide as a box is on average, or up to twice that. */
static int
shift_for(const ty_box *box, size_t count)
{
	double sum = 0;
	int shift = 0;

	for (size_t i = 0; i < count; i++)
		sum += (double) box[i].high_x - box[i].low_x + ((double) box[i].high_y - box[i].low_y);
	sum /= 2 * (double) count;
	while (shift < 28 && (double) (1 << shift) < sum)
		shift++;
	return shift;
}

/* Calls for what lies in each square: counts it, or puts the thing where `first` says and moves that on. */
static void
register_box(ty_box_squares *s, const ty_box *box, uint32_t thing)
{
	span at = span_of(s, box);

	for (uint32_t row = 0; row < at.rows; row++)
		for (uint32_t column = 0; column < at.columns; column++)
		{
			size_t square =
				(size_t) ((at.low_row + row) & s->mask) * (s->mask + 1) + ((at.low_column + column) & s->mask);

			if (s->thing == NULL)
				s->first[square + 1]++;
			else
				s->thing[s->first[square]++] = thing;
		}
}

static ty_status
fill(const ty_environment *env, const ty_box *box, size_t count, size_t squares, ty_box_squares *s)
{
	ty_status status = TY_OK;

	memset(s->first, 0, (squares + 1) * sizeof *s->first);
	for (size_t i = 0; i < count; i++)
		register_box(s, &box[i], (uint32_t) i);
	for (size_t k = 0; k < squares; k++)
		s->first[k + 1] += s->first[k];
	s->thing = ty_allocate_array(env, s->first[squares], sizeof *s->thing);
	if (s->thing == NULL)
		return TY_NO_MEMORY;
	for (size_t i = 0; status == TY_OK && i < count; i++)
	{
		register_box(s, &box[i], (uint32_t) i);
		if (ty_interrupted_at(env, i))
			status = TY_INTERRUPTED;
	}
	/* each now says where the next one begins */
	memmove(s->first + 1, s->first, squares * sizeof *s->first);
	s->first[0] = 0;
	return status;
}

ty_status
ty_box_squares_build(const ty_environment *env, const ty_box *box, size_t count, ty_box_squares *s)
{
	int bits = LEAST_BITS;
	size_t squares;
	uint64_t taken = 0;

	*s = (ty_box_squares){0};
	if (count < LEAST_BOXES)
		return TY_OK;
	while (bits < MOST_BITS && ((size_t) 1 << 2 * bits) < 2 * count)
		bits++;
	squares = (size_t) 1 << 2 * bits;
	s->mask = ((uint32_t) 1 << bits) - 1;
	s->shift = shift_for(box, count);
	for (size_t i = 0; i < count; i++)
	{
		span at = span_of(s, &box[i]);

		taken += (uint64_t) at.columns * at.rows;
	}
	if (taken > TY_MOST_SQUARES * (uint64_t) count)
		return TY_OK;
	s->first = ty_allocate_array(env, squares + 1, sizeof *s->first);
	return s->first == NULL ? TY_NO_MEMORY : fill(env, box, count, squares, s);
}

void
ty_box_squares_free(const ty_environment *env, ty_box_squares *squares)
{
	ty_release(env, squares->first);
	ty_release(env, squares->thing);
	*squares = (ty_box_squares){0};
}
