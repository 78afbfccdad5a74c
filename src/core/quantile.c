/*
 * quantile.c - see quantile.h
 *
 * Every level holds one bit of each value, from the highest to the lowest, and sorts the values stably by it for the
 * next. A range so stays a range: of its zeros, or of its ones, whose places are counted by the ones before them.
 */
#include "quantile.h"

#include <string.h>

/* set bits before place i of a level */
static inline size_t
ones_before(const ty_quantiles *q, int level, size_t i)
{
	size_t word = (size_t) level * q->words + i / 64;

	return q->ones[word] + (size_t) __builtin_popcountll(q->bits[word] & ((UINT64_C(1) << i % 64) - 1));
}

/* One level of the given bit; sorted receives the values in the order of the next. */
static void
prepare_level(ty_quantiles *q, int level, int bit, const uint32_t *values, uint32_t *sorted)
{
	uint64_t *bits = q->bits + (size_t) level * q->words;
	uint32_t *ones = q->ones + (size_t) level * q->words;
	size_t zero = 0, one;

	for (size_t i = 0; i < q->n; i++)
		bits[i / 64] |= (uint64_t) (values[i] >> bit & 1) << i % 64;
	for (size_t word = 1; word < q->words; word++)
		ones[word] = ones[word - 1] + (uint32_t) __builtin_popcountll(bits[word - 1]);
	one = q->zeros[level] = (uint32_t) (q->n - ones_before(q, level, q->n));
	for (size_t i = 0; i < q->n; i++)
		sorted[values[i] >> bit & 1 ? one++ : zero++] = values[i];
}

ty_status
ty_quantiles_prepare(const ty_environment *env, uint32_t *values, size_t n, ty_quantiles *q)
{
	uint32_t *sorted = ty_allocate_array(env, n, sizeof *sorted);
	uint32_t largest = 0;
	size_t all;

	*q = (ty_quantiles){.n = n, .words = n / 64 + 1, .levels = 1};
	for (size_t i = 0; i < n; i++)
		largest = values[i] > largest ? values[i] : largest;
	while (largest >> q->levels > 0)
		q->levels++;
	all = (size_t) q->levels * q->words;
	q->bits = ty_allocate_array(env, all, sizeof *q->bits);
	q->ones = ty_allocate_array(env, all, sizeof *q->ones);
	q->zeros = ty_allocate_array(env, (size_t) q->levels, sizeof *q->zeros);
	if (sorted == NULL || q->bits == NULL || q->ones == NULL || q->zeros == NULL)
	{
		ty_release(env, sorted);
		ty_quantiles_free(env, q);
		return TY_NO_MEMORY;
	}
	memset(q->bits, 0, all * sizeof *q->bits);
	memset(q->ones, 0, all * sizeof *q->ones);
	for (int level = 0; level < q->levels; level++)
	{
		prepare_level(q, level, q->levels - 1 - level, values, sorted);
		memcpy(values, sorted, n * sizeof *values);
	}
	ty_release(env, sorted);
	return TY_OK;
}

uint32_t
ty_quantile(const ty_quantiles *q, size_t first, size_t count, size_t k)
{
	size_t end = first + count;
	uint32_t value = 0;

	for (int level = 0; level < q->levels; level++)
	{
		size_t ones_first = ones_before(q, level, first), ones_end = ones_before(q, level, end);
		size_t zeros = end - first - (ones_end - ones_first);
		bool one = k >= zeros;

		value = value << 1 | one;
		k -= one ? zeros : 0;
		first = one ? q->zeros[level] + ones_first : first - ones_first;
		end = one ? q->zeros[level] + ones_end : end - ones_end;
	}
	return value;
}

void
ty_quantiles_free(const ty_environment *env, ty_quantiles *q)
{
	ty_release(env, q->bits);
	ty_release(env, q->ones);
	ty_release(env, q->zeros);
	*q = (ty_quantiles){0};
}
