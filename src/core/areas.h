/*
 * areas.h - exact sums of areas: whatever order they are added in, the sum is the same.
 *
 * Areas are summed as whole multiples of 2^-97 of a power of two above the group's largest, in 128 bits, which
 * TY_MAX_VERTICES of them fit into: exact for every area above 2^-44 of the largest, and in no case dependent on
 * the order. An area below 2^-97 of the largest adds nothing.
 */
#ifndef TY_AREAS_H
#define TY_AREAS_H

#include "measure.h"

#include <math.h>

typedef struct ty_area_scale
{
	double to_units, from_units;
} ty_area_scale;

#define TY_AREA_BITS 97
#define TY_LEAST_AREA_EXPONENT (-900) /* below, 1 / unit would overflow */

static inline ty_area_scale
ty_fit_area_scale(const ty_building *buildings, size_t n)
{
	double largest = 0;
	int exponent;

	for (size_t i = 0; i < n; i++)
		largest = buildings[i].area > largest ? buildings[i].area : largest;
	(void) frexp(largest, &exponent);
	if (exponent < TY_LEAST_AREA_EXPONENT)
		exponent = TY_LEAST_AREA_EXPONENT;
	return (ty_area_scale){ldexp(1, TY_AREA_BITS - exponent), ldexp(1, exponent - TY_AREA_BITS)};
}

static inline __int128
ty_area_units(ty_area_scale scale, double area)
{
	return (__int128) (area * scale.to_units);
}

static inline double
ty_area_of_units(ty_area_scale scale, __int128 units)
{
	return (double) units * scale.from_units;
}

/*
 * With importances: weights sum up to less than 2^62 (influence.h), so areas are taken as whole multiples of 2^-64 of
 * the power of two, for their product to fit.
 */
#define TY_WEIGHTED_AREA_BITS 64

static inline __int128
ty_weighted_area_units(ty_area_scale scale, double area, int64_t weight)
{
	const double coarser = ldexp(1, TY_WEIGHTED_AREA_BITS - TY_AREA_BITS);

	return weight * (__int128) (area * scale.to_units * coarser);
}

static inline double
ty_weighted_mean_area(ty_area_scale scale, __int128 units, int64_t weights)
{
	const double coarser = ldexp(1, TY_WEIGHTED_AREA_BITS - TY_AREA_BITS);

	return (double) units / (double) weights * (scale.from_units / coarser);
}

#endif
