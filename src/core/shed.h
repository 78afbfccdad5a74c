/*
 * shed.h - buildings below min_area (spec 2.5): they add nothing to count, position or mean, and become members of the
 * nearest placeholder. A group of them alone is one placeholder that is not drawn.
 */
#ifndef TY_SHED_H
#define TY_SHED_H

#include "group.h"

typedef struct ty_sheds
{
	const ty_input *input;	/* the caller's */
	ty_input houses;		/* all others; the caller's own input where there are no sheds */
	ty_building *buildings; /* [input's n] houses, then sheds; NULL where there are no sheds */
	double *importance;		/* [houses] or NULL */
	ty_outline **outlines;	/* [houses] or NULL */
	uint32_t *index;		/* [input's n] of a building in the input */
	size_t count;			/* of sheds */
} ty_sheds;

/* Tells houses from sheds: a kept building is no shed. Whatever it returns: ty_sheds_free. */
ty_status ty_sheds_part(const ty_environment *env, const ty_input *input, const ty_parameters *p, ty_sheds *sheds);
/*
 * result: of the houses, empty where there are none. It becomes that of the input: the sheds, at least one, are members
 * of the nearest placeholder that is drawn, on their side of the barriers if one of the 32 nearest is there (of equally
 * near ones the first), behind its houses, by their canonical order.
 */
ty_status ty_sheds_join(const ty_environment *env, ty_sheds *sheds, ty_result *result);
void ty_sheds_free(const ty_environment *env, ty_sheds *sheds);

#endif
