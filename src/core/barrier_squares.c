/* barrier_squares.c - see barrier_squares.h */
#include "barrier_squares.h"

#include <string.h>

#define LEAST_SEGMENTS 512 /* of fewer the tree is as quick */
#define LEAST_BITS 3	   /* of a column of the grid */
#define MOST_BITS 12

static int32_t
least(int32_t a, int32_t b)
{
	return a < b ? a : b;
}

static int32_t
most(int32_t a, int32_t b)
{
	return a > b ? a : b;
}

static ty_barrier_span
span_of(const ty_barrier_squares *s, const ty_barrier_segment *segment)
{
	ty_position a = segment->a, b = segment->b;

	return ty_barrier_span_of(s, (ty_position){least(a.x, b.x), least(a.y, b.y)},
							  (ty_position){most(a.x, b.x), most(a.y, b.y)});
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

		sum += (uint64_t) most(a.x, b.x) - least(a.x, b.x) + (most(a.y, b.y) - least(a.y, b.y));
	}
	while (shift < 28 && ((uint64_t) count << shift) < sum)
		shift++;
	return shift;
}

/* Calls for what lies in each square: counts it, or puts the number where `first` says and moves that on. */
static inline __attribute__((always_inline)) void
register_segment(ty_barrier_squares *s, const ty_barrier_segment *segment, uint32_t number, bool count)
{
	ty_barrier_span span = span_of(s, segment);

	for (uint32_t row = span.low_row; row <= span.high_row; row++)
		for (uint32_t column = span.low_column; column <= span.high_column; column++)
		{
			size_t square = ty_barrier_square(s, column, row);

			if (count)
				s->first[square + 1]++;
			else
				s->number[s->first[square]++] = number;
		}
}

static ty_status
fill(const ty_environment *env, const ty_barrier_segment *segment, size_t count, size_t squares, ty_barrier_squares *s)
{
	ty_status status = TY_OK;

	memset(s->first, 0, (squares + 1) * sizeof *s->first);
	for (size_t i = 0; i < count; i++)
		register_segment(s, &segment[i], (uint32_t) i, true);
	for (size_t k = 0; k < squares; k++)
		s->first[k + 1] += s->first[k];
	s->number = ty_allocate_array(env, s->first[squares], sizeof *s->number);
	if (s->number == NULL)
		return TY_NO_MEMORY;
	for (size_t i = 0; status == TY_OK && i < count; i++)
	{
		register_segment(s, &segment[i], (uint32_t) i, false);
		if (ty_interrupted_at(env, i))
			status = TY_INTERRUPTED;
	}
	/* each now says where the next one begins */
	memmove(s->first + 1, s->first, squares * sizeof *s->first);
	s->first[0] = 0;
	return status;
}

ty_status
ty_barrier_squares_build(const ty_environment *env, const ty_barrier_segment *segment, size_t count,
						 ty_barrier_squares *s)
{
	int bits = LEAST_BITS;
	size_t squares;
	uint64_t taken = 0;

	*s = (ty_barrier_squares){0};
	if (count < LEAST_SEGMENTS)
		return TY_OK;
	while (bits < MOST_BITS && ((size_t) 1 << 2 * bits) < count)
		bits++;
	squares = (size_t) 1 << 2 * bits;
	s->mask = ((uint32_t) 1 << bits) - 1;
	s->shift = shift_for(segment, count);
	for (size_t i = 0; i < count; i++)
		taken += ty_squares_of_span(span_of(s, &segment[i]));
	if (taken > TY_MOST_SQUARES * (uint64_t) count || taken > UINT32_MAX)
		return TY_OK;
	s->first = ty_allocate_array(env, squares + 1, sizeof *s->first);
	return s->first == NULL ? TY_NO_MEMORY : fill(env, segment, count, squares, s);
}

void
ty_barrier_squares_free(const ty_environment *env, ty_barrier_squares *squares)
{
	ty_release(env, squares->first);
	ty_release(env, squares->number);
	*squares = (ty_barrier_squares){0};
}
