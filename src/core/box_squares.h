/*
 * box_squares.h - which of many boxes may meet a small one: squares of whole numbers, each with the boxes that meet it.
 *
 * For boxes that do not differ much in size, and much quicker then than their tree (boxes.h), which serves all others. A
 * grid of squares repeats itself over the plane: boxes from far away may be among those found.
 */
#ifndef TY_BOX_SQUARES_H
#define TY_BOX_SQUARES_H

#include "boxes.h"

typedef struct ty_box_squares
{
	int shift;	   /* a square is 2^shift wide */
	uint32_t mask; /* squares in a row of the grid, less 1 */
	uint32_t
		*first; /* [(mask + 1)^2 + 1] of a square in thing; NULL: there are none, for few boxes or very uneven ones */
	uint32_t *thing;
} ty_box_squares;

/* Coordinates of boxes are whole, between -2^29 and 2^31 - 2^29. Any status: ty_box_squares_free. */
ty_status ty_box_squares_build(const ty_environment *env, const ty_box *box, size_t count, ty_box_squares *squares);
void ty_box_squares_free(const ty_environment *env, ty_box_squares *squares);

#define TY_MOST_SQUARES 16 /* that are searched, or that a box lies in */

/* The columns or rows from low to high. */
static inline uint32_t
ty_square_column(const ty_box_squares *squares, int64_t value)
{
	return (uint32_t) (value + (1 << 29)) >> squares->shift;
}

/* Whether a box is small enough to be looked for. */
static inline bool
ty_box_squares_serve(const ty_box_squares *squares, int64_t low_x, int64_t low_y, int64_t high_x, int64_t high_y)
{
	uint64_t columns, rows;

	if (squares->first == NULL)
		return false;
	columns = ty_square_column(squares, high_x) - ty_square_column(squares, low_x) + (uint64_t) 1;
	rows = ty_square_column(squares, high_y) - ty_square_column(squares, low_y) + (uint64_t) 1;
	return columns * rows <= TY_MOST_SQUARES;
}

/* The things in a square, from *from up to *to in squares->thing. */
static inline void
ty_box_squares_at(const ty_box_squares *squares, uint32_t column, uint32_t row, uint32_t *from, uint32_t *to)
{
	size_t square = (size_t) (row & squares->mask) * (squares->mask + 1) + (column & squares->mask);

	*from = squares->first[square];
	*to = squares->first[square + 1];
}

#endif
