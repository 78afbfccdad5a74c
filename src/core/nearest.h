/*
 * nearest.h - the nearest of a set of points, and points leaving the set.
 *
 * A binary tree of boxes over the points in Hilbert order. Every box is the tight one of the points that are still
 * there, and knows their smallest number: equal distances go to the smaller number without looking at all of them.
 */
#ifndef TY_NEAREST_H
#define TY_NEAREST_H

#include "environment.h"
#include "measure.h"

#define TY_NOBODY UINT32_MAX

/* what stands in a leaf, or below an inner node */
typedef struct ty_nearest_box
{
	double low_x, low_y, high_x, high_y;
	uint32_t smallest; /* number of a point; TY_NOBODY: nobody is left */
} ty_nearest_box;

typedef struct ty_nearest
{
	const ty_point *points; /* the caller's, numbered from 0 */
	size_t count;
	size_t leaves;		   /* a power of two; node i has the children 2i and 2i + 1, leaf k is node leaves + k */
	uint32_t *order;	   /* [count] numbers in Hilbert order, leaf by leaf */
	uint32_t *place;	   /* [count] of a number in order */
	bool *gone;			   /* [count] */
	ty_nearest_box *boxes; /* [2 * leaves] */
} ty_nearest;

/*
 * A whole number of [0, 2^30] that grows with the coordinate from low to high, for a Hilbert key; how it rounds is only
 * a matter of speed.
 */
int32_t ty_nearest_cell(double value, double low, double high);

/* sqrt(dx^2 + dy^2), rounded after each operation: it never shrinks when dx or dy grows */
double ty_distance(ty_point a, ty_point b);

/* TY_NOT_FINITE when a coordinate is not finite; TY_TOO_MANY above 2^32 - 2 points. Any result: ty_nearest_free. */
ty_status ty_nearest_build(const ty_environment *env, const ty_point *points, size_t count, ty_nearest *tree);
void ty_nearest_free(const ty_environment *env, ty_nearest *tree);

/* The nearest point that is still there, at most limit away, the smallest number of equals; else TY_NOBODY. */
uint32_t ty_nearest_find(const ty_nearest *tree, ty_point from, double limit);
void ty_nearest_remove(ty_nearest *tree, uint32_t number);

#define TY_NEAREST_ASKED 32
/* The nearest of at most TY_NEAREST_ASKED that is allowed; else the very nearest, TY_NOBODY of none. */
uint32_t ty_nearest_allowed(ty_nearest *tree, ty_point from, bool (*allows)(const void *context, uint32_t number),
							const void *context);

#endif
