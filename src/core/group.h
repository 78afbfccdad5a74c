/*
 * group.h - the whole way of one group, from buildings to placeholders: the orchestrator of the core.
 */
#ifndef TY_GROUP_H
#define TY_GROUP_H

#include "environment.h"
#include "measure.h"
#include "placeholder.h"

/* What a group is made of. Only read. */
typedef struct ty_input
{
	const ty_building *buildings; /* [n] in any order */
	size_t n;					  /* >= 1 */
} ty_input;

typedef struct ty_placeholder
{
	double x,
		y; /* the vertex, ground units; of a single building its very centroid, off the grid; unless min_gap moved it */
	double area; /* what is drawn, ground units; 0: no size, not drawn */
	double width, length;
	double statistic;		 /* of the members' areas, unscaled */
	double ratio;			 /* width / length; of the representative unless min_side changed it, 1 for squares */
	double ux, uy;			 /* of the representative */
	uint32_t representative; /* index into the caller's buildings */
	uint32_t first, count;	 /* members: ty_result.members[first .. first + count) */
} ty_placeholder;

typedef struct ty_result
{
	size_t count;
	ty_placeholder *placeholders; /* [count] in canonical order: by smallest rank of the members */
	uint32_t *members;			  /* [n] indices into the caller's buildings, by placeholder, then by rank */
	size_t undrawn;				  /* placeholders without size */
} ty_result;

/*
 * The whole way of one group: canonical order, mesh, collapse, cut, placeholders.
 * Lengths of p are ground units (ty_bring_to_ground).
 * The result's arrays come from env; ty_result_free gives them back. TY_NOT_FINITE when a sum of areas overflows.
 */
ty_status ty_typify(const ty_environment *env, const ty_input *input, const ty_parameters *p, ty_result *result);
void ty_result_free(const ty_environment *env, ty_result *result);

#endif
