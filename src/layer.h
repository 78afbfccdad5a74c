/*
 * layer.h - the numbers by which a placeholder travels as a row to where a whole layer is made legible: the array
 * `site` of the composite typify_site.
 */
#ifndef TY_LAYER_H
#define TY_LAYER_H

#include "compat.h"
#include "core/legibility.h"
#include "core/placeholder.h"

enum
{
	SITE_HOME_X = 0,
	SITE_HOME_Y,
	SITE_UX,
	SITE_UY,
	SITE_FULL_WIDTH,
	SITE_FULL_LENGTH,
	SITE_OWN_WIDTH,
	SITE_OWN_LENGTH,
	SITE_LEAST_WIDTH,
	SITE_LEAST_LENGTH,
	SITE_SHIFT_X,
	SITE_SHIFT_Y,
	SITE_MOVED_X,
	SITE_MOVED_Y,
	SITE_SIZE,
	SITE_AXIS_X,
	SITE_AXIS_Y,
	SITE_RAIL,
	SITE_BEND,
	SITE_FIXED,
	SITE_OUTLINED,
	SITE_GAP,
	SITE_LINE_GAP,
	SITE_NUMBERS
};

/* p: in ground units */
extern void ty_site_to_numbers(const ty_site *site, bool outlined, const ty_parameters *p,
							   double numbers[SITE_NUMBERS]);

/* Kept buildings that are too near to each other, the first two by their ids, or to a barrier, the first by its id. */
extern void ty_warn_of_collisions(const ty_collisions *collisions, int64 a, int64 b, int64 beside);

#endif
