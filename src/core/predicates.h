/*
 * predicates.h - exact orientation and in-circle on the grid, with symbolic tie-breaking.
 *
 * Coordinates lie in [0, 2^30] (grid.h), so cross products and squared distances stay below 2^62 and the
 * in-circle determinant below 2^124: exact in 64 and 128-bit integers. Three wide multiplications are
 * cheaper than the conversions of a floating-point filter, so there is none.
 */
#ifndef TY_PREDICATES_H
#define TY_PREDICATES_H

#include "grid.h"

/* > 0: a, b, c turn left (counter-clockwise); 0: collinear; < 0: right. Twice the signed area, exact. */
static inline int64_t
ty_orientation(ty_position a, ty_position b, ty_position c)
{
	return ((int64_t) b.x - a.x) * ((int64_t) c.y - a.y) - ((int64_t) b.y - a.y) * ((int64_t) c.x - a.x);
}

/* squared distance, below 2^62 */
static inline int64_t
ty_squared_distance(ty_position a, ty_position b)
{
	int64_t dx = (int64_t) a.x - b.x;
	int64_t dy = (int64_t) a.y - b.y;

	return dx * dx + dy * dy;
}

static inline bool
ty_same_position(ty_position a, ty_position b)
{
	return a.x == b.x && a.y == b.y;
}

/* The in-circle determinant and its three cofactors, all relative to d. */
typedef struct ty_circle_terms
{
	int64_t bc, ca, ab; /* twice the areas of d-b-c, d-c-a, d-a-b: what lifting a, b, c adds */
	__int128 sum;		/* > 0: d inside the circle through the counter-clockwise a, b, c */
} ty_circle_terms;

static inline ty_circle_terms
ty_circle(ty_position a, ty_position b, ty_position c, ty_position d)
{
	int64_t ax = (int64_t) a.x - d.x, ay = (int64_t) a.y - d.y;
	int64_t bx = (int64_t) b.x - d.x, by = (int64_t) b.y - d.y;
	int64_t cx = (int64_t) c.x - d.x, cy = (int64_t) c.y - d.y;
	ty_circle_terms r;

	r.bc = bx * cy - by * cx;
	r.ca = cx * ay - cy * ax;
	r.ab = ax * by - ay * bx;
	r.sum = (__int128) (ax * ax + ay * ay) * r.bc + (__int128) (bx * bx + by * by) * r.ca +
			(__int128) (cx * cx + cy * cy) * r.ab;
	return r;
}

/* Sign (-1, 0, 1) of: d strictly inside the circle through a, b, c, which must be counter-clockwise. Exact. */
static inline int
ty_in_circle_sign(ty_position a, ty_position b, ty_position c, ty_position d)
{
	__int128 sum = ty_circle(a, b, c, d).sum;

	return (sum > 0) - (sum < 0);
}

/*
 * Whether d counts as inside the circle through the counter-clockwise triangle a, b, c. Cocircular points:
 * of the four the one with the smallest rank counts as lifted by an infinitesimal on the paraboloid (spec
 * 2.2), which makes the Delaunay mesh unique. The ranks must differ, and so must the positions.
 */
static inline bool
ty_in_circle(ty_position a, ty_position b, ty_position c, ty_position d, uint32_t rank_a, uint32_t rank_b,
			 uint32_t rank_c, uint32_t rank_d)
{
	ty_circle_terms t = ty_circle(a, b, c, d);

	if (t.sum != 0)
		return t.sum > 0;
	if (rank_d < rank_a && rank_d < rank_b && rank_d < rank_c)
		return false; /* d is lifted off the circle's plane */
	if (rank_a < rank_b && rank_a < rank_c)
		return t.bc > 0;
	return rank_b < rank_c ? t.ca > 0 : t.ab > 0;
}

#endif
