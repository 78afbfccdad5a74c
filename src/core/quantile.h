/*
 * quantile.h - the k-th smallest of any range of a sequence, after one preparation of the whole: a wavelet matrix
 * (Claude, Navarro and Ordonez 2015). Takes about 0.2 bytes an element and bit of the values.
 */
#ifndef TY_QUANTILE_H
#define TY_QUANTILE_H

#include "environment.h"

typedef struct ty_quantiles
{
	size_t n, words; /* words a level */
	int levels;
	uint64_t *bits;	 /* [levels][words] of every value, in the order of the level, the highest bit first */
	uint32_t *ones;	 /* [levels][words] set bits of the level before the word */
	uint32_t *zeros; /* [levels] */
} ty_quantiles;

/* values below 2^31; they are left in another order. The arrays come from env; ty_quantiles_free gives them back. */
ty_status ty_quantiles_prepare(const ty_environment *env, uint32_t *values, size_t n, ty_quantiles *q);
/* the k-th smallest, counted from 0, of values[first .. first + count); k < count */
uint32_t ty_quantile(const ty_quantiles *q, size_t first, size_t count, size_t k);
void ty_quantiles_free(const ty_environment *env, ty_quantiles *q);

#endif
