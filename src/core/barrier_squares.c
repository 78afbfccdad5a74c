/* barrier_squares.c - see barrier_squares.h */
#include "barrier_squares.h"

#include <math.h>
#include <string.h>

#define LEAST_SEGMENTS 512 /* of fewer the tree is as quick */
#define LEAST_BITS 3	   /* of a column of the grid */
#define MOST_BITS 12
#define MOST_TAKEN 8 /* squares that a segment lies in, on average */

static ty_barrier_span
span_of(const ty_barrier_squares *s, const ty_barrier_segment *segment)
{
	ty_position a = segment->a, b = segment->b;

	return ty_barrier_span_of(s, (ty_position){ty_least(a.x, b.x), ty_least(a.y, b.y)},
							  (ty_position){ty_most(a.x, b.x), ty_most(a.y, b.y)});
}

/* A square is twice as wide as a segment is on average, or up to four times that. */
static int
shift_for(const ty_barrier_segment *segment, size_t count)
{
	uint64_t sum = 0;
	int shift = 0;

	for (size_t i = 0; i < count; i++)
	{
		ty_position a = segment[i].a, b = segment[i].b;

		sum += (uint64_t) ty_most(a.x, b.x) - ty_least(a.x, b.x) + (ty_most(a.y, b.y) - ty_least(a.y, b.y));
	}
	while (shift < 28 && ((uint64_t) count << shift) < sum)
		shift++;
	return shift;
}

static uint32_t
rows_of(ty_barrier_span span)
{
	return span.high_row - span.low_row + 1;
}

static uint32_t
columns_of(ty_barrier_span span)
{
	return span.high_column - span.low_column + 1;
}

/* where a row begins */
static double
begin_of(const ty_barrier_squares *s, uint32_t row)
{
	return (double) ((int64_t) row << s->shift) - (1 << 29);
}

static uint32_t
column_at(const ty_barrier_squares *s, double x)
{
	return (uint32_t) (x + (1 << 29)) >> s->shift;
}

/* The columns of a row that a segment over several rows passes through, and perhaps one more at either end. */
static ty_barrier_span
part_in_row(const ty_barrier_squares *s, const ty_barrier_segment *segment, ty_barrier_span span, uint32_t row)
{
	ty_position a = segment->a, b = segment->b;
	double slope = ((double) b.x - a.x) / ((double) b.y - a.y);
	double from = fmax(begin_of(s, row), ty_least(a.y, b.y)), to = fmin(begin_of(s, row + 1), ty_most(a.y, b.y));
	double x_from = a.x + (from - a.y) * slope, x_to = a.x + (to - a.y) * slope;
	uint32_t low = column_at(s, fmin(x_from, x_to) - 1), high = column_at(s, fmax(x_from, x_to) + 1);

	span.low_column = low > span.low_column ? low : span.low_column;
	span.high_column = high < span.high_column ? high : span.high_column;
	return span;
}

/* Calls for what lies in each square: counts it, or puts the number where `first` says and moves that on. */
static inline __attribute__((always_inline)) void
register_segment(ty_barrier_squares *s, const ty_barrier_segment *segment, ty_barrier_span span, uint32_t number,
				 bool count)
{
	bool is_long = rows_of(span) > 1 && columns_of(span) > 2;

	for (uint32_t row = span.low_row; row <= span.high_row; row++)
	{
		ty_barrier_span part = is_long ? part_in_row(s, segment, span, row) : span;

		for (uint32_t column = part.low_column; column <= part.high_column; column++)
		{
			size_t square = ty_barrier_square(s, column, row);

			if (count)
				s->first[square + 1]++;
			else
				s->number[s->first[square]++] = number;
		}
	}
}

/* Says of every square in `first` where its numbers begin. False: segments lie in too many. */
static bool
count_segments(const ty_barrier_segment *segment, size_t count, size_t squares, ty_barrier_squares *s)
{
	uint64_t left = (uint64_t) MOST_TAKEN * count;

	left = left < UINT32_MAX ? left : UINT32_MAX;
	memset(s->first, 0, (squares + 1) * sizeof *s->first);
	for (size_t i = 0; i < count; i++)
	{
		ty_barrier_span span = span_of(s, &segment[i]);
		uint64_t most = (uint64_t) 4 * rows_of(span) + columns_of(span);

		most = most < ty_squares_of_span(span) ? most : ty_squares_of_span(span);
		if (most > left)
			return false;
		left -= most;
		register_segment(s, &segment[i], span, (uint32_t) i, true);
	}
	for (size_t k = 0; k < squares; k++)
		s->first[k + 1] += s->first[k];
	return true;
}

static ty_status
list_segments(const ty_environment *env, const ty_barrier_segment *segment, size_t count, size_t squares,
			  ty_barrier_squares *s)
{
	s->number = ty_allocate_array(env, s->first[squares], sizeof *s->number);
	if (s->number == NULL)
		return TY_NO_MEMORY;
	for (size_t i = 0; i < count; i++)
	{
		register_segment(s, &segment[i], span_of(s, &segment[i]), (uint32_t) i, false);
		if (ty_interrupted_at(env, i))
			return TY_INTERRUPTED;
	}
	/* each now says where the next one begins */
	memmove(s->first + 1, s->first, squares * sizeof *s->first);
	s->first[0] = 0;
	return TY_OK;
}

ty_status
ty_barrier_squares_build(const ty_environment *env, const ty_barrier_segment *segment, size_t count,
						 ty_barrier_squares *s)
{
	int bits = LEAST_BITS;
	size_t squares;

	*s = (ty_barrier_squares){0};
	if (count < LEAST_SEGMENTS)
		return TY_OK;
	while (bits < MOST_BITS && ((size_t) 1 << 2 * bits) < count)
		bits++;
	squares = (size_t) 1 << 2 * bits;
	s->mask = ((uint32_t) 1 << bits) - 1;
	s->shift = shift_for(segment, count);
	s->first = ty_allocate_array(env, squares + 1, sizeof *s->first);
	if (s->first == NULL)
		return TY_NO_MEMORY;
	if (count_segments(segment, count, squares, s))
		return list_segments(env, segment, count, squares, s);
	ty_barrier_squares_free(env, s);
	return TY_OK;
}

void
ty_barrier_squares_free(const ty_environment *env, ty_barrier_squares *squares)
{
	ty_release(env, squares->first);
	ty_release(env, squares->number);
	*squares = (ty_barrier_squares){0};
}
