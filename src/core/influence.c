/* influence.c - see influence.h */
#include "influence.h"

#include <math.h>

#define WEIGHT_BITS 62 /* of the sum of all weights, with room for rounding each of them up */

/* v < 2^bits_of(v) */
static int
bits_of(double v)
{
	int exponent;

	(void) frexp(v, &exponent);
	return exponent;
}

int
ty_weight_exponent(const double *importance, size_t n)
{
	double largest = 1;

	for (size_t i = 0; i < n; i++)
		if (importance[i] != INFINITY && importance[i] > largest)
			largest = importance[i];
	return WEIGHT_BITS - 1 - bits_of(largest) - bits_of((double) n);
}

int64_t
ty_weight(double importance, int exponent)
{
	double weight = importance == INFINITY ? 0 : floor(ldexp(importance, exponent) + 0.5);

	return weight < 1 ? 1 : (int64_t) weight;
}
