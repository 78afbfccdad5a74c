/*
 * squares.h - places that come, go and move, in squares: who is near, from ring to ring.
 *
 * A grid of squares repeats itself over the plane, so that it needs no bounds and little memory; those who stand in a
 * square but belong to another one, far away, are passed over.
 */
#ifndef TY_SQUARES_H
#define TY_SQUARES_H

#include "environment.h"
#include "measure.h"

/* a square of the plane; columns and rows are counted modulo 2^32 */
typedef struct ty_square
{
	uint32_t column, row;
} ty_square;

typedef struct ty_squares
{
	const ty_environment *env;
	double side;
	uint32_t mask;	   /* squares in a row of the grid, less 1 */
	uint32_t *first;   /* [(mask + 1)^2] who stands there; TY_NO_PLACE: nobody */
	uint32_t *next;	   /* [count] in the same square of the grid */
	ty_square *square; /* [count] of the plane */
	uint32_t *found;   /* [found_count] in the last ring, in no particular order */
	size_t found_count, found_capacity;
} ty_squares;

#define TY_NO_PLACE UINT32_MAX

/* Room for count places, numbered from 0, in squares of that side; none is there yet. Any status: ty_squares_free. */
ty_status ty_squares_begin(const ty_environment *env, size_t count, double side, ty_squares *squares);
void ty_squares_free(ty_squares *squares);
/* One that is not there comes, or one that is goes. */
void ty_squares_insert(ty_squares *squares, uint32_t number, ty_point place);
void ty_squares_remove(ty_squares *squares, uint32_t number);

#define TY_MOST_RINGS 8

/*
 * Lists in squares->found those who stand in a ring of squares around a place: ring 0 is its own square, each of the
 * next ones, below TY_MOST_RINGS, goes around the one before.
 */
ty_status ty_squares_ring(ty_squares *squares, ty_point place, uint32_t ring);
/* Nobody who stands in a later ring is nearer to the place than this. */
double ty_squares_within(const ty_squares *squares, ty_point place, uint32_t ring);

#endif
