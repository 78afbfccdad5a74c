/*
 * pairing.h - two sets of points paired one to one, the closest first.
 */
#ifndef TY_PAIRING_H
#define TY_PAIRING_H

#include "nearest.h"

/*
 * As if all pairs at most limit apart were taken in the order of (distance, number in a, number in b), each that finds
 * both of its points still free. partner[i] becomes the number in b of a's point i, or TY_NOBODY; it is the caller's,
 * with count_a entries. TY_NOT_FINITE when a coordinate is not finite.
 */
ty_status ty_pair_points(const ty_environment *env, const ty_point *a, size_t count_a, const ty_point *b,
						 size_t count_b, double limit, uint32_t *partner);

/* The number in b that is nearest to each point of a, the smallest of equals; TY_NOBODY where b is empty. */
ty_status ty_nearest_points(const ty_environment *env, const ty_point *a, size_t count_a, const ty_point *b,
							size_t count_b, uint32_t *nearest);

#endif
