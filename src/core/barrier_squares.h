/*
 * barrier_squares.h - which of many segments may meet a small box: squares of whole numbers, each with the segments
 * that pass through it, and some beside it.
 *
 * For segments that do not differ much in size, and much quicker then than a tree of boxes (boxes.h), which serves all
 * others. A grid of squares repeats itself over the plane: segments from far away may be among those found.
 */
#ifndef TY_BARRIER_SQUARES_H
#define TY_BARRIER_SQUARES_H

#include "environment.h"
#include "grid.h"

static inline int32_t
ty_least(int32_t a, int32_t b)
{
	return a < b ? a : b;
}

static inline int32_t
ty_most(int32_t a, int32_t b)
{
	return a > b ? a : b;
}

typedef struct ty_barrier_segment
{
	ty_position a, b; /* they differ; a little outside of the grid where the line goes on */
} ty_barrier_segment;

typedef struct ty_barrier_squares
{
	int shift;	   /* a square is 2^shift wide */
	uint32_t mask; /* squares in a row of the grid, less 1 */
	/* [(mask + 1)^2 + 1] of a square in number; NULL: there are none, for few segments or very uneven ones */
	uint32_t *first;
	uint32_t *number; /* of segments */
} ty_barrier_squares;

/* Coordinates are between -2^29 and 2^31 - 2^29. Any status: ty_barrier_squares_free. */
ty_status ty_barrier_squares_build(const ty_environment *env, const ty_barrier_segment *segment, size_t count,
								   ty_barrier_squares *squares);
void ty_barrier_squares_free(const ty_environment *env, ty_barrier_squares *squares);

#define TY_MOST_SQUARES 16 /* that are searched */

/* columns and rows, those at both ends too */
typedef struct ty_barrier_span
{
	uint32_t low_column, high_column, low_row, high_row;
} ty_barrier_span;

static inline uint32_t
ty_barrier_column(const ty_barrier_squares *squares, int32_t value)
{
	return ((uint32_t) value + (1 << 29)) >> squares->shift;
}

static inline ty_barrier_span
ty_barrier_span_of(const ty_barrier_squares *squares, ty_position low, ty_position high)
{
	return (ty_barrier_span){ty_barrier_column(squares, low.x), ty_barrier_column(squares, high.x),
							 ty_barrier_column(squares, low.y), ty_barrier_column(squares, high.y)};
}

static inline uint64_t
ty_squares_of_span(ty_barrier_span span)
{
	return (span.high_column - span.low_column + (uint64_t) 1) * (span.high_row - span.low_row + (uint64_t) 1);
}

/* Whether a box is small enough to be looked for; not where the grid begins anew within it. */
static inline bool
ty_barrier_squares_serve(const ty_barrier_squares *squares, ty_barrier_span span)
{
	return squares->first != NULL && ty_squares_of_span(span) <= TY_MOST_SQUARES &&
		   (span.low_column & squares->mask) <= (span.high_column & squares->mask);
}

static inline size_t
ty_barrier_square(const ty_barrier_squares *squares, uint32_t column, uint32_t row)
{
	return (size_t) (row & squares->mask) * (squares->mask + 1) + (column & squares->mask);
}

/* Where squares->first says what lies in a row of squares that serve: from *from up to where *to says. */
static inline void
ty_barrier_row(const ty_barrier_squares *squares, ty_barrier_span span, uint32_t row, const uint32_t **from,
			   const uint32_t **to)
{
	*from = &squares->first[ty_barrier_square(squares, span.low_column, row)];
	*to = *from + (span.high_column - span.low_column) + 1;
}

#endif
