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

#include "grid.h"

#define TY_NO_ROW UINT32_MAX

/* lines that no collapse crosses; known to whoever made them */
typedef struct ty_barriers ty_barriers;

typedef struct ty_influence
{
	/*
	 * [n] by rank, >= 1; INFINITY: kept. NULL: all 1. A vertex has the largest of its members' and weighs as much as all
	 * of them together. The factor is the larger of the two ends'; at a kept end it is the other's, and the kept one does
	 * not move. Two kept vertices are not collapsed even where they share a place.
	 */
	const double *importance;
	/* [n] by rank, the row of the building or TY_NO_ROW. NULL: no rows. An edge between two rows, or into one: 1 + alignment. */
	const uint32_t *row;
	double alignment; /* finite, >= 0 */
	/* Whether the segment from a to b, which differ, crosses a barrier; the same for b to a. NULL: no barriers. */
	bool (*crosses)(const ty_barriers *barriers, ty_position a, ty_position b);
	const ty_barriers *barriers;
} ty_influence;

/*
 * What importances weigh: whole multiples of 2^-exponent, so fine that the sum over the group stays just below 2^62 (for
 * a million buildings 41 bits for the largest). Sums of them are exact. An importance below the unit counts as one
 * unit; a kept building's weight is never used.
 */
int ty_weight_exponent(const double *importance, size_t n);
int64_t ty_weight(double importance, int exponent);

#endif
