/*
 * extents.h - which of many boxes meet a box, and which of many segments is the nearest to a point.
 *
 * A binary tree of boxes over the boxes in Hilbert order of their centres, built once and then only read.
 */
#ifndef TY_EXTENTS_H
#define TY_EXTENTS_H

#include "environment.h"
#include "measure.h"

typedef struct ty_extent
{
	ty_point high, low;
} ty_extent;

typedef struct ty_segment
{
	ty_point a, b;
} ty_segment;

typedef struct ty_extents
{
	const ty_extent *boxes; /* the caller's, numbered from 0 */
	size_t count;
	size_t leaves;	  /* a power of two; node i has the children 2i and 2i + 1, leaf k is node leaves + k */
	uint32_t *order;  /* [count] numbers in Hilbert order, leaf by leaf */
	ty_extent *nodes; /* [2 * leaves] */
} ty_extents;

ty_extent ty_segment_extent(ty_segment segment);

/*
 * TY_NOT_FINITE when a coordinate is not finite; TY_TOO_MANY above 2^32 - 2 boxes. After any result: ty_extents_free.
 */
ty_status ty_extents_build(const ty_environment *env, const ty_extent *boxes, size_t count, ty_extents *tree);
void ty_extents_free(const ty_environment *env, ty_extents *tree);

/* Tells the number of every box that meets the given one, borders included. */
typedef void (*ty_extent_found)(void *context, uint32_t number);
void ty_extents_meeting(const ty_extents *tree, const ty_extent *box, ty_extent_found found, void *context);

/* The segment nearest to a point, where the tree is that of the segments' boxes; TY_NOBODY when there is none. */
uint32_t ty_extents_nearest_segment(const ty_extents *tree, const ty_segment *segments, ty_point from);

#endif
