/*
 * group.h - the whole way of one group, from buildings to placeholders: the orchestrator of the core.
 */
#ifndef TY_GROUP_H
#define TY_GROUP_H

#include "barrier.h"
#include "environment.h"
#include "legibility.h"
#include "measure.h"
#include "outline.h"
#include "placeholder.h"

/* What a group is made of. Only read. */
typedef struct ty_input
{
	const ty_building *buildings; /* [n] in any order */
	size_t n;					  /* >= 1 */
	/* [n] those with which placeholders are drawn, NULL for a building that has none; or NULL as a whole */
	ty_outline *const *outlines;
	const ty_barrier_lines *barriers; /* NULL: none */
	/*
	 * [n] >= 1, INFINITY: kept (spec 2.5); NULL: all 1. Buildings that are the same in all else, id included, should
	 * have the same, or which of them has which is not a matter of the set alone.
	 */
	const double *importance;
} ty_input;

typedef struct ty_placeholder
{
	/*
	 * centre of the rectangle, ground units: the vertex; of a single or kept building its very centroid, off the grid;
	 * min_gap may have moved it
	 */
	double x, y;
	double area; /* what is drawn, ground units; 0: no size, not drawn */
	/*
	 * of the rectangle; where the representative has an outline, of the one around it, whose centre is not the vertex
	 */
	double width, length;
	double statistic;		 /* of the members' areas, unscaled */
	double ratio;			 /* width / length; of the representative unless min_side changed it, 1 for squares */
	double ux, uy;			 /* of the representative */
	uint32_t representative; /* index into the caller's buildings */
	uint32_t first, count;	 /* members: ty_result.members[first .. first + count) */
	bool outlined;			 /* drawn with the representative's outline, not as a rectangle */
	bool kept;				 /* the representative is kept: in place, with its own area */
} ty_placeholder;

typedef struct ty_result
{
	size_t count;
	ty_placeholder *placeholders; /* [count] in canonical order: by smallest rank of the members */
	uint32_t *members; /* [n] indices into the caller's buildings, by placeholder, then by rank, sheds last */
	ty_site *sites; /* [count] with min_gap: the placeholders as sites (legibility.h), as they are drawn; else NULL */
	size_t undrawn; /* placeholders without size; one of sheds alone has none and does not count */
	size_t hidden;	/* for which there was no room */
	ty_collisions collisions; /* of kept buildings that are too near to each other or a barrier, as indices */
} ty_result;

/*
 * The whole way of one group: canonical order, mesh, collapse, cut, placeholders; sheds (shed.h) join those.
 * Lengths of p are ground units (ty_bring_to_ground).
 * The result's arrays come from env; ty_result_free gives them back. TY_NOT_FINITE when a sum of areas overflows.
 */
ty_status ty_typify(const ty_environment *env, const ty_input *input, const ty_parameters *p, ty_result *result);
/*
 * The placeholder as a site (legibility.h) to which nothing has been done. p, input: as its group was typified with;
 * the site's group is 0.
 */
void ty_placeholder_site(const ty_parameters *p, const ty_input *input, const ty_placeholder *placeholder,
						 ty_site *site);

void ty_result_free(const ty_environment *env, ty_result *result);

#endif
