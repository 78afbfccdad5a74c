/*
 * grid.h - the integer grid over a group's box, the Hilbert key, and the canonical order.
 *
 * All geometry of the mesh happens on integers in [0, 2^30]: the larger side of the group's box is split
 * into at least 2^29 and at most 2^30 cells whose size is a power of two. Snapping is therefore exact
 * arithmetic, and so is everything after it (spec 2.2).
 */
#ifndef TY_GRID_H
#define TY_GRID_H

#include "environment.h"
#include "measure.h"

#define TY_GRID_BITS 30

/* a position on the grid, 0 <= x, y <= 2^30 */
typedef struct ty_position
{
	int32_t x, y;
} ty_position;

typedef struct ty_grid
{
	double cell;			   /* ground units a cell, a power of two */
	double origin_x, origin_y; /* of grid point (0, 0), in cells: whole numbers */
} ty_grid;

/* The grid over n >= 1 buildings' centroids. TY_NOT_FINITE when a centroid is not finite. */
ty_status ty_grid_fit(const ty_building *buildings, size_t n, ty_grid *grid);
/* nearest grid point, halves up */
ty_position ty_grid_snap(const ty_grid *grid, double x, double y);
/* back to ground units */
double ty_grid_x(const ty_grid *grid, int32_t x);
double ty_grid_y(const ty_grid *grid, int32_t y);

/*
 * Place along the Hilbert curve over the square [0, 2^31)^2. Every prefix of an even number of bits is a
 * square cell, of an odd number the half of one: the mesh's divide and conquer relies on it.
 */
uint64_t ty_hilbert_key(ty_position p);

/*
 * Canonical order (spec 2.4): by Hilbert key of the grid position, then by x, y, area, ratio, ux, uy, id as
 * numbers. Buildings that still compare equal are the same in everything. order[rank] = index of the
 * building, position[rank] its grid position, keys[rank] its key; all three hold n entries of the
 * caller's.
 */
ty_status ty_canonical_order(const ty_environment *env, const ty_building *buildings, size_t n, const ty_grid *grid,
							 uint32_t *order, ty_position *position, uint64_t *keys);

/* Sorts n (key, value) pairs by key, stably (least significant digit first; a plain sort for small n). */
ty_status ty_sort_keys(const ty_environment *env, uint64_t *keys, uint32_t *values, size_t n);

#endif
