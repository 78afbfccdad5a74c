/*
 * collapse.h - the priority order and the loop that yields the merge sequence (spec 2.3).
 *
 * Vertices are ranks. A merge joins two vertices; the one with the smaller rank goes on, at the mean of all
 * centroids that both represent, the other is gone. Costs are in grid cells. A result at any scale is the
 * sequence cut at a count.
 */
#ifndef TY_COLLAPSE_H
#define TY_COLLAPSE_H

#include "environment.h"
#include "influence.h"
#include "mesh.h"

typedef struct ty_stop
{
	size_t count;		 /* go on until this many vertices are left (>= 1) ... */
	double min_distance; /* ... and no edge is shorter than this, in grid cells; 0: no such condition */
} ty_stop;

typedef struct ty_sequence
{
	size_t count;		/* merges; where there are none the arrays may be NULL */
	uint32_t *kept;		/* [count] smaller rank of the two */
	uint32_t *gone;		/* [count] larger rank; every rank is gone at most once */
	double *cost;		/* [count] or NULL unless asked for */
	ty_position *place; /* [count] where the merged vertex stands; goes with cost */
} ty_sequence;

/* For tests: called after every merge with the mesh as it then is, or NULL while two vertices share a place. */
typedef void (*ty_after_merge)(void *context, const ty_mesh *mesh, size_t step);

/*
 * Collapses n >= 1 vertices, position[rank] in canonical order (grid.h). position ends as the positions of the
 * vertices that are left. 0 <= s_u <= 1. influence may be NULL; with one there may be no edge left to collapse before
 * the stop is reached. The sequence is the caller's to free with ty_sequence_free.
 */
ty_status ty_collapse(const ty_environment *env, ty_position *position, size_t n, double s_u,
					  const ty_influence *influence, ty_stop stop, bool with_cost, ty_after_merge after_merge,
					  void *context, ty_sequence *sequence);
/*
 * The same for whom already has the positions' Hilbert keys: an array of env, which the collapse frees when it needs it
 * no longer, whatever comes of it.
 */
ty_status ty_collapse_keyed(const ty_environment *env, ty_position *position, uint64_t *keys, size_t n, double s_u,
							const ty_influence *influence, ty_stop stop, bool with_cost, ty_after_merge after_merge,
							void *context, ty_sequence *sequence);
void ty_sequence_free(const ty_environment *env, ty_sequence *sequence);

/*
 * Cuts the sequence after `merges` of its merges: label[rank] = number of the rank's cluster, numbered from 0
 * by smallest rank. Returns the number of clusters.
 */
size_t ty_sequence_cut(const ty_sequence *sequence, size_t merges, size_t n, uint32_t *label);

#endif
