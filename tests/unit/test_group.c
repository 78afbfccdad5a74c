/*
 * test_group.c - the fear: a building is lost or counted twice on the way of a group, or the answer depends on the
 * order of its rows.
 */
#include "check.h"
#include "collapse.h"
#include "group.h"
#include "sets.h"

#include <math.h>
#include <stdlib.h>

#define MOST 3000

static ty_building buildings[MOST];
static uint32_t order[MOST], rank_of[MOST];
static ty_position position[MOST];
static uint64_t keys[MOST];

static ty_parameters
defaults(double scale, double s_u)
{
	ty_parameters p = {0};

	p.scale = scale;
	p.s_u = s_u;
	p.source_scale = TY_DEFAULT_SOURCE_SCALE;
	p.lod200_scale = TY_DEFAULT_LOD200_SCALE;
	p.exponent = TY_DEFAULT_EXPONENT;
	p.psi = TY_DEFAULT_PSI;
	p.law = true;
	return p;
}

static ty_result
typify(size_t n, const ty_parameters *p)
{
	ty_result result = {0};
	ty_status status = ty_typify(&ty_plain_environment, &(ty_input){.buildings = buildings, .n = n}, p, &result);

	CHECK(status == TY_OK, "n %zu: status %d", n, status);
	return result;
}

static void
free_result(ty_result *result)
{
	ty_result_free(&ty_plain_environment, result);
}

/* rank and grid position of every building */
static ty_grid
find_ranks(size_t n)
{
	ty_grid grid = {1, 0, 0};

	CHECK(ty_grid_fit(buildings, n, &grid) == TY_OK, "n %zu", n);
	CHECK(ty_canonical_order(&ty_plain_environment, buildings, n, &grid, order, position, keys) == TY_OK, "n %zu", n);
	for (uint32_t rank = 0; rank < n; rank++)
		rank_of[order[rank]] = rank;
	return grid;
}

static int
compare_numbers(const void *a, const void *b)
{
	double left = *(const double *) a;
	double right = *(const double *) b;

	return (left > right) - (left < right);
}

static double
statistic(const uint32_t *members, size_t count, ty_area_statistic which)
{
	static double areas[MOST];
	double sum = 0;

	for (size_t i = 0; i < count; i++)
		sum += areas[i] = buildings[members[i]].area;
	if (which == TY_SUM)
		return sum;
	if (which == TY_MEAN)
		return sum / (double) count;
	qsort(areas, count, sizeof *areas, compare_numbers);
	return (areas[(count - 1) / 2] + areas[count / 2]) / 2;
}

/* the largest, of equal ones that with the smallest rank */
static uint32_t
expected_representative(const uint32_t *members, size_t count)
{
	uint32_t best = members[0];

	for (size_t i = 1; i < count; i++)
	{
		double more = buildings[members[i]].area - buildings[best].area;

		if (more > 0 || (more == 0 && rank_of[members[i]] < rank_of[best]))
			best = members[i];
	}
	return best;
}

static int32_t
rounded_mean(int64_t sum, int64_t count)
{
	return (int32_t) ((2 * sum + count) / (2 * count));
}

static void
check_placeholder(const ty_result *result, size_t i, const ty_parameters *p, const ty_grid *grid)
{
	const ty_placeholder *drawn = &result->placeholders[i];
	const uint32_t *members = result->members + drawn->first;
	const ty_building *expected = &buildings[expected_representative(members, drawn->count)];
	double factor = p->area_statistic == TY_SUM ? 1 : ty_area_factor(p);
	double area = statistic(members, drawn->count, p->area_statistic) * factor;
	double ratio = p->shape == TY_SQUARE ? 1 : expected->ratio;
	int64_t sum_x = 0, sum_y = 0;

	for (size_t k = 0; k < drawn->count; k++)
	{
		sum_x += position[rank_of[members[k]]].x;
		sum_y += position[rank_of[members[k]]].y;
		CHECK(k == 0 || rank_of[members[k - 1]] < rank_of[members[k]], "placeholder %zu: members not by rank", i);
	}
	if (drawn->count == 1)
		CHECK(drawn->x == expected->x && drawn->y == expected->y, "placeholder %zu of one building has moved", i);
	else
		CHECK(drawn->x == ty_grid_x(grid, rounded_mean(sum_x, drawn->count)) &&
				  drawn->y == ty_grid_y(grid, rounded_mean(sum_y, drawn->count)),
			  "placeholder %zu at %.17g %.17g is not the mean of its members", i, drawn->x, drawn->y);
	CHECK(fabs(drawn->area - area) <= 1e-12 * area, "placeholder %zu: area %.17g instead of %.17g", i, drawn->area,
		  area);
	CHECK(&buildings[drawn->representative] == expected, "placeholder %zu: representative %u", i,
		  drawn->representative);
	CHECK(drawn->ratio == ratio && drawn->ux == expected->ux && drawn->uy == expected->uy,
		  "placeholder %zu: ratio %g, direction %g %g", i, drawn->ratio, drawn->ux, drawn->uy);
	CHECK(fabs(drawn->width * drawn->length - area) <= 1e-12 * area &&
			  fabs(drawn->width - ratio * drawn->length) <= 1e-12 * drawn->length,
		  "placeholder %zu: %g by %g", i, drawn->width, drawn->length);
}

/* every building once, placeholders by the smallest rank of their members */
static void
check_members(const ty_result *result, size_t n)
{
	static bool seen[MOST];
	size_t next = 0;

	memset(seen, 0, sizeof seen);
	for (size_t i = 0; i < result->count; i++)
	{
		const ty_placeholder *drawn = &result->placeholders[i];

		NEED(drawn->first == next && drawn->count > 0 && next + drawn->count <= n, "placeholder %zu: members %u + %u",
			 i, drawn->first, drawn->count);
		next += drawn->count;
		if (i > 0)
			CHECK(rank_of[result->members[result->placeholders[i - 1].first]] < rank_of[result->members[drawn->first]],
				  "placeholder %zu is out of order", i);
	}
	CHECK(next == n, "%zu members of %zu", next, n);
	for (size_t i = 0; i < next; i++)
	{
		NEED(result->members[i] < n, "member %u of %zu", result->members[i], n);
		CHECK(!seen[result->members[i]], "building %u twice", result->members[i]);
		seen[result->members[i]] = true;
	}
}

/* which building is with which: as the merge sequence says, cut at this count */
static void
check_clusters(const ty_result *result, size_t n, double s_u)
{
	static uint32_t label[MOST];
	const ty_stop stop = {result->count, 0};
	ty_sequence sequence;

	NEED(ty_collapse(&ty_plain_environment, position, n, s_u, NULL, stop, false, NULL, NULL, &sequence) == TY_OK,
		 "collapse");
	ty_sequence_cut(&sequence, n - result->count, n, label);
	ty_sequence_free(&ty_plain_environment, &sequence);
	for (size_t i = 0; i < result->count; i++)
		for (uint32_t k = 0; k < result->placeholders[i].count; k++)
			CHECK(label[rank_of[result->members[result->placeholders[i].first + k]]] == i,
				  "member %u of placeholder %zu", k, i);
}

static void
check_group(size_t n, const ty_parameters *p)
{
	ty_result result = typify(n, p);
	ty_grid grid = find_ranks(n);
	size_t expected = ty_count(n, p, 200);

	if (p->law && p->count_rule == TY_RADICAL && p->min_distance == 0)
		CHECK(result.count == expected, "n %zu at %g: %zu placeholders instead of %zu", n, p->scale, result.count,
			  expected);
	check_members(&result, n);
	for (size_t i = 0; i < result.count; i++)
		check_placeholder(&result, i, p, &grid);
	if (p->min_distance == 0)
		check_clusters(&result, n, p->s_u);
	free_result(&result);
}

static void
nobody_is_lost(void)
{
	static const double s_us[] = {0, 0.3, 0.5, 1};
	static const double scales[] = {25000, 26000, 50000, 75000, 200000, 400000};
	random_state random = random_seed(41);

	for (size_t set = 0; set < 360; set++)
	{
		size_t n = (size_t) random_between(&random, 1, set % 30 == 0 ? MOST : 150);
		ty_parameters p = defaults(scales[set % 6], s_us[set / 6 % 4]);

		large_set((large_kind) (set % LARGE_KINDS), &random, buildings, n);
		shuffle_buildings(&random, buildings, n);
		p.area_statistic = (ty_area_statistic) (set % 3);
		p.shape = set % 7 == 0 ? TY_SQUARE : TY_RECTANGLE;
		p.count_rule = set % 11 == 0 ? TY_BLACK_WHITE : TY_RADICAL;
		if (set % 13 == 0)
			p.count = random_between(&random, 1, 40);
		check_group(n, &p);
	}
}

static void
one_building_stays_as_it_is_at_the_source_scale(void)
{
	ty_parameters p = defaults(25000, 0.5);
	ty_result result;

	buildings[0] = (ty_building){3500000.25, 5500000.75, 120, 0.5, 0.6, 0.8, 42};
	result = typify(1, &p);
	NEED(result.count == 1, "%zu", result.count);
	CHECK(result.placeholders->x == buildings->x && result.placeholders->y == buildings->y, "%.17g %.17g",
		  result.placeholders->x, result.placeholders->y);
	CHECK(result.placeholders->area == 120 && result.undrawn == 0, "area %g", result.placeholders->area);
	free_result(&result);
}

static void
row_order_changes_no_bit(void)
{
	static ty_placeholder first[MOST];
	const size_t used = offsetof(ty_placeholder, count) + sizeof first->count; /* padding follows */
	random_state random = random_seed(42);

	for (size_t set = 0; set < 40; set++)
	{
		size_t n = (size_t) random_between(&random, 2, 400);
		ty_parameters p = defaults(75000, (double) (set % 4) / 3);

		large_set((large_kind) (set % LARGE_KINDS), &random, buildings, n);
		for (size_t i = n / 2; i < n; i++)
			buildings[i].id = 0; /* many are the same in everything but the row */
		for (size_t permutation = 0; permutation < 12; permutation++)
		{
			ty_result result = typify(n, &p);

			/* rows have other numbers now: a representative is known by its values, members by how many they are */
			for (size_t i = 0; i < result.count; i++)
			{
				ty_placeholder *drawn = &result.placeholders[i];

				drawn->representative = (uint32_t) buildings[drawn->representative].id;
			}
			for (size_t i = 0; i < result.count; i++)
			{
				if (permutation == 0)
					first[i] = result.placeholders[i];
				CHECK(memcmp(&first[i], &result.placeholders[i], used) == 0, "%s, n %zu, permutation %zu: %zu",
					  large_kind_name[set % LARGE_KINDS], n, permutation, i);
			}
			free_result(&result);
			shuffle_buildings(&random, buildings, n);
		}
	}
}

static void
calibrated_psi_gives_the_coarse_layers_mean_area(void)
{
	random_state random = random_seed(43);
	ty_parameters p = defaults(200000, 0.5);
	double unscaled = 0, mean = 0;
	ty_result result;

	large_set(LARGE_CLUSTERED, &random, buildings, 2000);
	p.psi = 0;
	result = typify(2000, &p);
	for (size_t i = 0; i < result.count; i++)
		unscaled += result.placeholders[i].area / ty_area_factor(&p) / (double) result.count;
	free_result(&result);
	p.psi = ty_psi(unscaled, 5000, p.source_scale, p.lod200_scale);
	result = typify(2000, &p);
	for (size_t i = 0; i < result.count; i++)
		mean += result.placeholders[i].area / (double) result.count;
	CHECK(fabs(mean - 5000) < 1e-8, "mean area %.17g", mean);
	free_result(&result);
}

static double
least_distance(const ty_result *result)
{
	double least = INFINITY;

	for (size_t i = 0; i < result->count; i++)
		for (size_t k = 0; k < i; k++)
			least = fmin(least, hypot(result->placeholders[i].x - result->placeholders[k].x,
									  result->placeholders[i].y - result->placeholders[k].y));
	return least;
}

static void
no_two_are_nearer_than_the_minimum_distance(void)
{
	random_state random = random_seed(44);

	for (size_t set = 0; set < 60; set++)
	{
		ty_parameters p = defaults(50000, (double) (set % 4) / 3);
		size_t n = 300;
		ty_result result;

		large_set((large_kind) (set % LARGE_KINDS), &random, buildings, n);
		p.min_distance = 0.5 * (double) random_between(&random, 1, 2000);
		p.law = set % 2 == 0;
		result = typify(n, &p);
		find_ranks(n);
		check_members(&result, n);
		CHECK(least_distance(&result) >= p.min_distance * (1 - 1e-12), "%s: %.17g is nearer than %g",
			  large_kind_name[set % LARGE_KINDS], least_distance(&result), p.min_distance);
		if (p.law)
			CHECK(result.count <= ty_count(n, &p, 200), "the count holds too: %zu", result.count);
		free_result(&result);
	}
}

static void
distance_alone_keeps_buildings_that_are_far_enough(void)
{
	ty_parameters p = defaults(200000, 0);
	ty_result result;

	for (size_t i = 0; i < 9; i++)
		buildings[i] = (ty_building){100.0 * (double) (i % 3), 100.0 * (double) (i / 3), 50, 1, 1, 0, (int64_t) i};
	p.law = false;
	p.min_distance = 100;
	result = typify(9, &p);
	CHECK(result.count == 9, "just far enough: %zu of 9 are left", result.count);
	free_result(&result);
	p.min_distance = 100.001;
	result = typify(9, &p);
	CHECK(result.count < 9, "%zu of 9 are left", result.count);
	free_result(&result);
}

static void
buildings_without_area_are_members_of_undrawn_placeholders(void)
{
	ty_parameters p = defaults(50000, 0);
	ty_result result;
	size_t empty = 0;

	for (size_t i = 0; i < 40; i++)
		buildings[i] = (ty_building){(double) (i * i), 0, i < 20 ? 0 : 100, 1, 1, 0, (int64_t) i};
	result = typify(40, &p);
	find_ranks(40);
	check_members(&result, 40);
	for (size_t i = 0; i < result.count; i++)
		empty += result.placeholders[i].area == 0;
	CHECK(empty == result.undrawn && empty > 0 && empty < result.count, "%zu without area, %zu undrawn, %zu in all",
		  empty, result.undrawn, result.count);
	free_result(&result);
}

static void
infinite_sums_of_areas_do_not_pass_unseen(void)
{
	ty_parameters p = defaults(200000, 0);
	ty_result result = {0};

	p.count = 1;
	for (size_t i = 0; i < 4; i++)
		buildings[i] = (ty_building){(double) i, 0, 1.5e308, 1, 1, 0, (int64_t) i};
	if (ty_typify(&ty_plain_environment, &(ty_input){.buildings = buildings, .n = 4}, &p, &result) != TY_OK)
		return;
	CHECK(isfinite(result.placeholders->area) && isfinite(result.placeholders->length), "area %g, length %g",
		  result.placeholders->area, result.placeholders->length);
	free_result(&result);
}

static void
what_is_not_finite_is_told(void)
{
	ty_parameters p = defaults(50000, 0);
	ty_result result;

	for (size_t i = 0; i < 10; i++)
		buildings[i] = (ty_building){(double) i, 0, 100, 1, 1, 0, (int64_t) i};
	buildings[7].y = NAN;
	CHECK(ty_typify(&ty_plain_environment, &(ty_input){.buildings = buildings, .n = 10}, &p, &result) == TY_NOT_FINITE,
		  "NaN");
	buildings[7].y = INFINITY;
	CHECK(ty_typify(&ty_plain_environment, &(ty_input){.buildings = buildings, .n = 10}, &p, &result) == TY_NOT_FINITE,
		  "infinity");
}

int
main(int argc, char **argv)
{
	check_begin(argc, argv);
	RUN(nobody_is_lost);
	RUN(one_building_stays_as_it_is_at_the_source_scale);
	RUN(row_order_changes_no_bit);
	RUN(calibrated_psi_gives_the_coarse_layers_mean_area);
	RUN(no_two_are_nearer_than_the_minimum_distance);
	RUN(distance_alone_keeps_buildings_that_are_far_enough);
	RUN(buildings_without_area_are_members_of_undrawn_placeholders);
	RUN(infinite_sums_of_areas_do_not_pass_unseen);
	RUN(what_is_not_finite_is_told);
	return check_end();
}
