/*
 * measure.h - what typify keeps of a building: area, centroid, minimum-area rectangle.
 *
 * A geometry is handed over part by part, in any order of types; coordinates are read with memcpy, so
 * they may be unaligned and interleaved with Z and M. Usage:
 *
 *     ty_measure_begin(&m, env);
 *     ty_measure_ring(&m, xy, stride, n, true); ...
 *     status = ty_measure_end(&m, &building);    // frees what the measure holds
 */
#ifndef TY_MEASURE_H
#define TY_MEASURE_H

#include "environment.h"

/* A building boiled down to its measures. Ground units (the SRID's), 56 bytes, compared by value. */
typedef struct ty_building
{
	double x, y;   /* centroid, as ST_Centroid defines it; inside the geometry's own box */
	double area;   /* absolute shoelace sum of the shells less that of the holes, >= 0 */
	double ratio;  /* short side / long side of the minimum-area bounding rectangle, (0, 1]; 0/0 and 0 count as 1 */
	double ux, uy; /* unit vector of its longer side, direction in [0, 180): uy > 0, or uy == 0 and ux == 1 */
	int64_t id;	   /* the caller's; 0 where the form takes none */
} ty_building;

typedef struct ty_point
{
	double x, y;
} ty_point;

/* weighted sum of points, for one dimension of the centroid */
typedef struct ty_moment
{
	double weight, x, y;
} ty_moment;

#define TY_HULL_INLINE 64 /* points kept without allocation: 99.9 % of buildings have fewer */

typedef struct ty_measure
{
	const ty_environment *env;
	ty_status status;
	ty_point base;					 /* first point; everything is summed relative to it */
	ty_point low, high;				 /* the box */
	ty_moment areal, linear, puntal; /* the highest dimension with a weight gives the centroid */
	bool skips_lengths, lacks_lengths;
	double area;
	size_t count, capacity; /* points of shells, lines and points: the outline that carries the rectangle */
	ty_point *points;
	ty_point inline_points[2 * TY_HULL_INLINE + 1]; /* the outline, then room for its hull */
} ty_measure;

void ty_measure_begin(ty_measure *m, const ty_environment *env);
/*
 * For speed: leaves out the lengths of rings, which count only where all areas come to 0. Where they do,
 * ty_measure_lacks_lengths says so before the end, and the geometry is to be handed over again without skipping.
 */
void ty_measure_skip_lengths(ty_measure *m);
bool ty_measure_lacks_lengths(const ty_measure *m);
/* Gives up a measure that is not ended. */
void ty_measure_abandon(ty_measure *m);
/* n points of a polygon's ring, closed or not, of either direction; holes are rings with shell = false */
void ty_measure_ring(ty_measure *m, const void *xy, size_t stride, uint32_t n, bool shell);
void ty_measure_line(ty_measure *m, const void *xy, size_t stride, uint32_t n);
void ty_measure_point(ty_measure *m, const void *xy);
/*
 * Fills the building but for its id. TY_NOT_FINITE when a coordinate is NaN or infinite or the area
 * overflows; at least one point must have been given.
 */
ty_status ty_measure_end(ty_measure *m, ty_building *building);

/*
 * Minimum-area bounding rectangle of n >= 1 points by rotating calipers over their convex hull (Toussaint
 * 1983); reorders the points, uses hull as scratch for n + 1 of them. Gives ratio and direction as
 * ty_building has them.
 */
void ty_minimum_rectangle(ty_point *points, size_t n, ty_point *hull, double *ratio, double *ux, double *uy);

#endif
