/*
 * test_pairing.c - the fear: pairs are not those of the greedy order where distances tie or points coincide, or a set
 * that lies badly takes quadratic time. A slow reference sorts all pairs.
 */
#include "check.h"
#include "pairing.h"
#include "random.h"

#include <math.h>
#include <stdlib.h>
#include <time.h>

#define MOST 60
#define MANY 100000

typedef struct pair
{
	double distance;
	uint32_t a, b;
} pair;

static ty_point a[MANY], b[MANY];
static uint32_t partner[MANY];

static int
compare_pairs(const void *left, const void *right)
{
	const pair *l = left, *r = right;

	if (l->distance != r->distance)
		return l->distance < r->distance ? -1 : 1;
	if (l->a != r->a)
		return l->a < r->a ? -1 : 1;
	return (l->b > r->b) - (l->b < r->b);
}

/* partner as the definition says it */
static void
pair_slowly(size_t count_a, size_t count_b, double limit, uint32_t *slow)
{
	static pair pairs[MOST * MOST];
	bool taken[MOST] = {false};
	size_t count = 0;

	for (uint32_t i = 0; i < count_a; i++)
	{
		slow[i] = TY_NOBODY;
		for (uint32_t j = 0; j < count_b; j++)
			pairs[count++] = (pair){ty_distance(a[i], b[j]), i, j};
	}
	qsort(pairs, count, sizeof(pair), compare_pairs);
	for (size_t k = 0; k < count && pairs[k].distance <= limit; k++)
		if (slow[pairs[k].a] == TY_NOBODY && !taken[pairs[k].b])
		{
			slow[pairs[k].a] = pairs[k].b;
			taken[pairs[k].b] = true;
		}
}

static size_t
paired(size_t count)
{
	size_t pairs = 0;

	for (size_t i = 0; i < count; i++)
		pairs += partner[i] != TY_NOBODY;
	return pairs;
}

/* on a small grid, so that distances tie and points coincide; sometimes far apart, sometimes off the grid */
static ty_point
random_point(random_state *r, int64_t side, double step)
{
	ty_point p = {random_between(r, 0, side) * step, random_between(r, 0, side) * step};

	if (random_between(r, 0, 9) == 0)
		p.x += random_unit(r);
	return p;
}

static void
test_pairs_are_those_of_the_greedy_order(void)
{
	static const double steps[] = {1, 0.1, 1e-170, 1e150, 1e300};
	random_state r = random_seed(4);

	for (size_t set = 0; set < 20000; set++)
	{
		size_t count_a = random_between(&r, 0, set % 10 == 0 ? MOST : 12);
		size_t count_b = random_between(&r, 0, set % 10 == 0 ? MOST : 12);
		int64_t side = random_between(&r, 0, 12);
		double step = steps[random_between(&r, 0, 4)];
		double limit = random_between(&r, 0, 8) * step;
		uint32_t slow[MOST];

		for (size_t i = 0; i < count_a; i++)
			a[i] = random_point(&r, side, step);
		for (size_t i = 0; i < count_b; i++)
			b[i] = random_point(&r, side, step);
		NEED(ty_pair_points(&ty_plain_environment, a, count_a, b, count_b, limit, partner) == TY_OK, "set %zu", set);
		pair_slowly(count_a, count_b, limit, slow);
		for (size_t i = 0; i < count_a; i++)
			NEED(partner[i] == slow[i], "set %zu of %zu and %zu, step %g, limit %g: %zu is paired with %u, not %u", set,
				 count_a, count_b, step, limit, i, partner[i], slow[i]);
	}
}

static void
test_the_nearest_is_the_nearest(void)
{
	random_state r = random_seed(5);

	for (size_t set = 0; set < 5000; set++)
	{
		size_t count_b = random_between(&r, 0, MOST);
		uint32_t found;

		a[0] = random_point(&r, 9, 1);
		for (size_t i = 0; i < count_b; i++)
			b[i] = random_point(&r, 9, 1);
		NEED(ty_nearest_points(&ty_plain_environment, a, 1, b, count_b, &found) == TY_OK, "set %zu", set);
		NEED((found == TY_NOBODY) == (count_b == 0), "set %zu: %u of %zu", set, found, count_b);
		for (uint32_t i = 0; i < count_b; i++)
			NEED(ty_distance(a[0], b[i]) > ty_distance(a[0], b[found]) ||
					 (ty_distance(a[0], b[i]) == ty_distance(a[0], b[found]) && i >= found),
				 "set %zu: %u is nearer than %u", set, i, found);
	}
}

static void
test_what_is_not_finite_is_refused(void)
{
	static const double values[] = {NAN, INFINITY, -INFINITY};

	for (size_t i = 0; i < 3; i++)
	{
		ty_point good = {0, 0}, bad = {i, values[i]};

		CHECK(ty_pair_points(&ty_plain_environment, &good, 1, &bad, 1, 1, partner) == TY_NOT_FINITE, "b %zu", i);
		CHECK(ty_pair_points(&ty_plain_environment, &bad, 1, &good, 1, 1, partner) == TY_NOT_FINITE, "a %zu", i);
		CHECK(ty_nearest_points(&ty_plain_environment, &bad, 1, &good, 1, partner) == TY_NOT_FINITE, "near %zu", i);
	}
}

static double
seconds_to_pair(double limit)
{
	clock_t start = clock();

	CHECK(ty_pair_points(&ty_plain_environment, a, MANY, b, MANY, limit, partner) == TY_OK, "limit %g", limit);
	return (double) (clock() - start) / CLOCKS_PER_SEC;
}

/* All of one place, two heaps far apart, a line whose distances shrink (the longest walk), and scattered ones. */
static void
test_a_hundred_thousand_pairs_of_any_layout_take_seconds(void)
{
	static const char *layouts[] = {"one place", "two heaps", "shrinking line", "scattered"};
	random_state r = random_seed(6);

	for (size_t layout = 0; layout < 4; layout++)
	{
		double seconds;

		for (size_t i = 0; i < MANY; i++)
		{
			double u = random_unit(&r), v = random_unit(&r);

			a[i] = layout == 0 ? (ty_point){1, 1} : layout == 2 ? (ty_point){sqrt(2 * i + 1.0), 0} : (ty_point){u, v};
			b[i] = layout == 0	 ? (ty_point){1, 1}
				   : layout == 1 ? (ty_point){100 + v, u}
				   : layout == 2 ? (ty_point){sqrt(2 * i + 2.0), 0}
								 : (ty_point){random_unit(&r), random_unit(&r)};
		}
		seconds = seconds_to_pair(1000);
		CHECK(seconds < 20, "%s: %g s", layouts[layout], seconds);
		CHECK(paired(MANY) == MANY, "%s: %zu pairs", layouts[layout], paired(MANY));
	}
}

int
main(int argc, char **argv)
{
	check_begin(argc, argv);
	RUN(test_pairs_are_those_of_the_greedy_order);
	RUN(test_the_nearest_is_the_nearest);
	RUN(test_what_is_not_finite_is_refused);
	RUN(test_a_hundred_thousand_pairs_of_any_layout_take_seconds);
	return check_end();
}
