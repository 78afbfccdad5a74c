/* random.h - a small deterministic generator: xorshift64* (Vigna 2016), the same numbers on every machine. */
#ifndef TY_RANDOM_H
#define TY_RANDOM_H

#include <stdint.h>

typedef struct random_state
{
	uint64_t word; /* never 0 */
} random_state;

static inline random_state
random_seed(uint64_t seed)
{
	random_state r = {(seed + 1) * UINT64_C(0x9E3779B97F4A7C15) | 1};

	return r;
}

static inline uint64_t
random_next(random_state *r)
{
	r->word ^= r->word >> 12;
	r->word ^= r->word << 25;
	r->word ^= r->word >> 27;
	return r->word * UINT64_C(0x2545F4914F6CDD1D);
}

/* whole number in low .. high, both included */
static inline int64_t
random_between(random_state *r, int64_t low, int64_t high)
{
	return low + (int64_t) ((random_next(r) >> 2) % (uint64_t) (high - low + 1));
}

/* in [0, 1) */
static inline double
random_unit(random_state *r)
{
	return (double) (random_next(r) >> 11) / 9007199254740992.0;
}

#endif
