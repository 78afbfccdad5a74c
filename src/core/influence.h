/*
 * influence.h - what else may weigh an edge of the mesh, besides its length and s_u (spec 2.5).
 *
 *   cost = f_a * length * importance factor * row factor
 *
 * Every factor is at least 1. A cost of INFINITY says that there is no such edge: between two kept vertices, and across
 * a barrier. Costs depend on the two ends alone, which is what lets the queue cover an edge by one of them.
 */
#ifndef TY_INFLUENCE_H
#define TY_INFLUENCE_H

#include "alignment.h"

/* lines that no collapse crosses; known to whoever made them */
typedef struct ty_barriers ty_barriers;

typedef struct ty_edge_ends
{
	ty_position a, b;
} ty_edge_ends;

typedef struct ty_influence
{
	/*
	 * [n] by rank, >= 1; INFINITY: kept. NULL: all 1. A vertex has the largest of its members' and weighs as much as
	 * all of them together. The factor is the larger of the two ends'; at a kept end it is the other's, and the kept
	 * one does not move. Two kept vertices are not collapsed even where they share a place.
	 */
	const double *importance;
	/*
	 * Rows of buildings, whose vertices are merged along them; NULL: none. find_rows fills them once the mesh stands,
	 * before anything else is merged than vertices at one place; NULL: they are given. Merges change their spans.
	 */
	ty_rows *rows;
	double alignment; /* finite, >= 0: an edge that leaves a row counts 1 + alignment times as long */
	ty_status (*find_rows)(const void *context, const ty_mesh *mesh, ty_rows *rows);
	const void *context; /* of find_rows */
	/*
	 * Whether the edge from a to b, which differ, crosses a barrier, or one of the two ways to where they would be
	 * merged: that is on the edge, but for rounding. The same with a and b exchanged. NULL: no barriers.
	 */
	bool (*crosses)(const ty_barriers *barriers, ty_position a, ty_position b, ty_position merged);
	/* Brings what crosses looks at into the cache, for edges that it will be asked about. Set where crosses is. */
	void (*fetch)(const ty_barriers *barriers, const ty_edge_ends *edge, size_t count);
	const ty_barriers *barriers;
} ty_influence;

/*
 * What importances weigh: whole multiples of 2^-exponent, so fine that the sum over the group stays just below 2^62
 * (for a million buildings 41 bits for the largest). Sums of them are exact. An importance below the unit counts as
 * one unit; a kept building's weight is never used.
 */
int ty_weight_exponent(const double *importance, size_t n);
int64_t ty_weight(double importance, int exponent);

#endif
