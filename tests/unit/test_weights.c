/*
 * test_weights.c - the fear: a kept building moves, changes its size or is not there; a mean is not the weighted one; a
 * shed changes a placeholder, or is lost; the answer depends on the order of the rows.
 */
#include "check.h"
#include "group.h"
#include "sets.h"

#include <math.h>
#include <stdlib.h>

#define MOST 1200
#define CELL 4e-5 /* ground units, of the largest of the sets, which are 20 km wide: at most that */

static ty_building buildings[MOST];
static double importance[MOST];
static uint32_t placeholder_of[MOST];

static const double scales[] = {25000, 50000, 75000, 100000, 200000, 500000, 1000000};

static ty_parameters
at(double scale, double s_u)
{
	ty_parameters p = {.scale = scale,
					   .s_u = s_u,
					   .source_scale = TY_DEFAULT_SOURCE_SCALE,
					   .lod200_scale = TY_DEFAULT_LOD200_SCALE,
					   .exponent = TY_DEFAULT_EXPONENT,
					   .psi = TY_DEFAULT_PSI,
					   .law = true};

	return p;
}

static ty_result
typify(size_t n, bool weighed, const ty_parameters *p)
{
	ty_result result = {0};
	ty_input input = {.buildings = buildings, .n = n, .importance = weighed ? importance : NULL};
	ty_status status = ty_typify(&ty_plain_environment, &input, p, &result);

	CHECK(status == TY_OK, "n %zu: status %d", n, status);
	return result;
}

static void
free_result(ty_result *result)
{
	ty_result_free(&ty_plain_environment, result);
}

/* Nobody is lost; notes who is where. */
static bool
number_members(const ty_result *result, size_t n)
{
	size_t next = 0;

	memset(placeholder_of, 0xff, sizeof placeholder_of);
	for (size_t k = 0; k < result->count; k++)
	{
		const ty_placeholder *p = &result->placeholders[k];

		if (!CHECK(p->first == next && p->count > 0 && next + p->count <= n, "placeholder %zu: members %u + %u", k,
				   p->first, p->count))
			return false;
		for (uint32_t i = 0; i < p->count; i++, next++)
			placeholder_of[result->members[next]] = (uint32_t) k;
		CHECK(placeholder_of[p->representative] == k, "placeholder %zu: the representative is no member", k);
	}
	for (size_t i = 0; i < n; i++)
		CHECK(placeholder_of[i] != UINT32_MAX, "building %zu is lost", i);
	return CHECK(next == n, "%zu members of %zu", next, n);
}

static void
draw_importances(random_state *random, size_t n, int64_t kept_of_hundred)
{
	for (size_t i = 0; i < n; i++)
	{
		importance[i] = random_between(random, 0, 2) > 0 ? 1 : 1 + 5 * random_unit(random);
		if (random_between(random, 1, 100) <= kept_of_hundred)
			importance[i] = INFINITY;
	}
}

/* ---- kept buildings ---- */

static void
check_kept(const ty_result *result, uint32_t building)
{
	const ty_placeholder *p = &result->placeholders[placeholder_of[building]];
	const ty_building *b = &buildings[building];

	CHECK(p->kept && p->representative == building, "building %u: kept %d, representative %u", building, p->kept,
		  p->representative);
	CHECK(p->x == b->x && p->y == b->y, "building %u has moved to %.17g %.17g", building, p->x, p->y);
	CHECK(p->area == b->area, "building %u: area %.17g instead of %.17g", building, p->area, b->area);
	CHECK(p->ratio == b->ratio && p->ux == b->ux && p->uy == b->uy, "building %u is turned", building);
}

static void
kept_buildings_are_there_in_place_and_in_size_at_every_scale(void)
{
	random_state random = random_seed(70);

	for (size_t set = 0; set < 12 * LARGE_KINDS; set++)
	{
		size_t n = (size_t) random_between(&random, 1, set % 12 == 0 ? MOST : 200), kept = 0;
		bool by_area = set % 3 == 2;

		large_set((large_kind) (set % LARGE_KINDS), &random, buildings, n);
		shuffle_buildings(&random, buildings, n);
		draw_importances(&random, n, by_area ? 0 : (int64_t) (set % 4) * 10);
		for (size_t s = 0; s < sizeof scales / sizeof *scales; s++)
		{
			ty_parameters p = at(scales[s], (double) (set % 3) / 2);
			ty_result result;

			p.keep_area = by_area ? 390 : 0;
			p.alignment = set % 5 == 0 ? 2 : 0;
			result = typify(n, true, &p);
			kept = 0;
			if (!number_members(&result, n))
				return;
			for (uint32_t i = 0; i < n; i++)
				if (importance[i] == INFINITY || (by_area && buildings[i].area >= 390))
				{
					check_kept(&result, i);
					kept++;
				}
			for (size_t k = 0; k < result.count; k++)
				kept -= result.placeholders[k].kept;
			CHECK(kept == 0, "%zu kept placeholders too few", kept);
			CHECK(result.count >= ty_count(n, &p, 200), "%zu placeholders", result.count);
			free_result(&result);
		}
	}
}

static void
where_all_are_kept_all_are_there(void)
{
	random_state random = random_seed(71);

	for (large_kind kind = 0; kind < LARGE_KINDS; kind++)
	{
		ty_parameters p = at(1000000, 0);
		ty_result result;

		large_set(kind, &random, buildings, 300);
		p.keep_area = 1;
		p.min_distance = 50;
		result = typify(300, false, &p);
		CHECK(result.count == 300, "%s: %zu", large_kind_name[kind], result.count);
		free_result(&result);
	}
}

/* ---- means ---- */

static double
relative_difference(double a, double b)
{
	return fabs(a - b) / fmax(1, fabs(b));
}

/* a placeholder of members without a kept one, computed anew */
static void
check_means(const ty_result *result, const ty_placeholder *p, double area_factor)
{
	const uint32_t *members = result->members + p->first;
	double weight = 0, x = 0, y = 0, area = 0, highest = 0;

	for (uint32_t i = 0; i < p->count; i++)
	{
		const ty_building *b = &buildings[members[i]];

		weight += importance[members[i]];
		x += importance[members[i]] * b->x;
		y += importance[members[i]] * b->y;
		area += importance[members[i]] * b->area;
		highest = fmax(highest, importance[members[i]]);
	}
	CHECK(fabs(p->x - x / weight) < CELL && fabs(p->y - y / weight) < CELL, "at %.17g %.17g instead of %.17g %.17g",
		  p->x, p->y, x / weight, y / weight);
	CHECK(relative_difference(p->area, area_factor * area / weight) < 1e-12, "area %.17g instead of %.17g", p->area,
		  area_factor * area / weight);
	CHECK(importance[p->representative] == highest, "representative of importance %g instead of %g",
		  importance[p->representative], highest);
	for (uint32_t i = 0; i < p->count; i++)
		CHECK(importance[members[i]] < highest || buildings[members[i]].area <= buildings[p->representative].area,
			  "a larger one of importance %g", highest);
}

static void
means_are_weighted(void)
{
	random_state random = random_seed(72);

	for (size_t set = 0; set < 6 * LARGE_KINDS; set++)
	{
		size_t n = (size_t) random_between(&random, 2, 300);
		ty_parameters p = at(scales[set % 7], (double) (set % 4) / 3);
		ty_result result;

		large_set((large_kind) (set % LARGE_KINDS), &random, buildings, n);
		draw_importances(&random, n, 5);
		result = typify(n, true, &p);
		number_members(&result, n);
		for (size_t k = 0; k < result.count; k++)
			if (!result.placeholders[k].kept)
				check_means(&result, &result.placeholders[k], ty_area_factor(&p));
		free_result(&result);
	}
}

/* ---- the order of rows ---- */

/* by the row's number in the beginning, which is the id */
static double importance_of_id[MOST];

static void
row_order_changes_no_bit(void)
{
	static ty_placeholder first[MOST];
	static uint32_t first_of_id[MOST];
	random_state random = random_seed(73);

	for (size_t set = 0; set < 3 * LARGE_KINDS; set++)
	{
		size_t n = (size_t) random_between(&random, 2, 250);
		ty_parameters p = at(scales[set % 7], (double) (set % 4) / 3);

		large_set((large_kind) (set % LARGE_KINDS), &random, buildings, n);
		draw_importances(&random, n, 10);
		memcpy(importance_of_id, importance, sizeof importance);
		p.min_area = set % 2 == 0 ? 90 : 0;
		p.keep_area = set % 3 == 0 ? 395 : 0;
		for (size_t permutation = 0; permutation < 12; permutation++)
		{
			ty_result result;

			for (size_t i = 0; i < n; i++)
				importance[i] = importance_of_id[buildings[i].id];
			result = typify(n, true, &p);
			number_members(&result, n);
			for (size_t k = 0; k < result.count; k++)
			{
				ty_placeholder drawn = result.placeholders[k];

				drawn.representative = (uint32_t) buildings[drawn.representative].id;
				if (permutation == 0)
					first[k] = drawn;
				CHECK(memcmp(&first[k], &drawn, offsetof(ty_placeholder, kept)) == 0 && first[k].kept == drawn.kept,
					  "%s, n %zu, permutation %zu: %zu", large_kind_name[set % LARGE_KINDS], n, permutation, k);
			}
			for (size_t i = 0; i < n; i++)
			{
				if (permutation == 0)
					first_of_id[buildings[i].id] = placeholder_of[i];
				CHECK(first_of_id[buildings[i].id] == placeholder_of[i], "building %lld", (long long) buildings[i].id);
			}
			free_result(&result);
			shuffle_buildings(&random, buildings, n);
		}
	}
}

/* ---- sheds ---- */

static double
squared_distance(const ty_building *b, const ty_placeholder *p)
{
	return (b->x - p->x) * (b->x - p->x) + (b->y - p->y) * (b->y - p->y);
}

/* the houses of a set come first, then the sheds; returns how many houses there are */
static size_t
houses_first(size_t n, double min_area)
{
	size_t houses = 0;

	for (size_t i = 0; i < n; i++)
		if (buildings[i].area >= min_area)
		{
			ty_building swapped = buildings[houses];

			buildings[houses++] = buildings[i];
			buildings[i] = swapped;
		}
	return houses;
}

static void
sheds_join_the_nearest_and_change_nothing(void)
{
	random_state random = random_seed(74);

	for (size_t set = 0; set < 10 * LARGE_KINDS; set++)
	{
		size_t n = (size_t) random_between(&random, 2, 300), houses;
		ty_parameters p = at(scales[set % 7], (double) (set % 4) / 3);
		ty_result with, without;

		large_set((large_kind) (set % LARGE_KINDS), &random, buildings, n);
		houses = houses_first(n, 150);
		if (houses == 0)
			continue;
		without = typify(houses, false, &p);
		p.min_area = 150;
		with = typify(n, false, &p);
		NEED(with.count == without.count, "%zu and %zu", with.count, without.count);
		for (size_t k = 0; k < with.count; k++)
		{
			const ty_placeholder *a = &with.placeholders[k], *b = &without.placeholders[k];

			CHECK(a->x == b->x && a->y == b->y && a->area == b->area && a->width == b->width && a->ux == b->ux &&
					  a->representative == b->representative && a->count >= b->count,
				  "placeholder %zu", k);
			CHECK(memcmp(with.members + a->first, without.members + b->first, b->count * sizeof *with.members) == 0,
				  "placeholder %zu: its houses come first", k);
		}
		number_members(&with, n);
		for (size_t i = houses; i < n; i++)
			for (size_t k = 0; k < with.count; k++)
				CHECK(squared_distance(&buildings[i], &with.placeholders[placeholder_of[i]]) <=
						  squared_distance(&buildings[i], &with.placeholders[k]) * (1 + 1e-12),
					  "shed %zu is nearer to %zu", i, k);
		free_result(&with);
		free_result(&without);
	}
}

static void
a_shed_between_two_joins_the_first(void)
{
	ty_parameters p = at(25000, 0);
	ty_result result;

	buildings[0] = (ty_building){10, 0, 5, 1, 1, 0, 1};
	buildings[1] = (ty_building){20, 0, 100, 1, 1, 0, 2};
	buildings[2] = (ty_building){0, 0, 100, 1, 1, 0, 3};
	p.min_area = 10;
	result = typify(3, false, &p);
	NEED(result.count == 2, "%zu", result.count);
	CHECK(result.placeholders[0].count == 2 && result.placeholders[1].count == 1, "%u and %u members",
		  result.placeholders[0].count, result.placeholders[1].count);
	free_result(&result);
}

static void
sheds_alone_are_one_that_is_not_drawn(void)
{
	random_state random = random_seed(75);
	ty_parameters p = at(50000, 0);
	ty_result result;

	large_set(LARGE_UNIFORM, &random, buildings, 40);
	buildings[17].area = 401;
	p.min_area = 1000;
	result = typify(40, false, &p);
	number_members(&result, 40);
	NEED(result.count == 1, "%zu", result.count);
	CHECK(result.placeholders->area == 0 && result.placeholders->representative == 17 && result.undrawn == 0,
		  "area %g, representative %u, %zu undrawn", result.placeholders->area, result.placeholders->representative,
		  result.undrawn);
	free_result(&result);
}

static void
a_kept_building_is_no_shed(void)
{
	ty_parameters p = at(50000, 0);
	ty_result result;

	for (size_t i = 0; i < 3; i++)
	{
		buildings[i] = (ty_building){10.0 * (double) i, 0, 5, 1, 1, 0, (int64_t) i};
		importance[i] = i == 1 ? INFINITY : 1;
	}
	p.min_area = 10;
	result = typify(3, true, &p);
	NEED(result.count == 1, "%zu", result.count);
	CHECK(result.placeholders->area == 5 && result.placeholders->representative == 1 && result.placeholders->count == 3,
		  "area %g", result.placeholders->area);
	free_result(&result);
}

int
main(int argc, char **argv)
{
	check_begin(argc, argv);
	RUN(a_shed_between_two_joins_the_first);
	RUN(a_kept_building_is_no_shed);
	RUN(sheds_alone_are_one_that_is_not_drawn);
	RUN(sheds_join_the_nearest_and_change_nothing);
	RUN(where_all_are_kept_all_are_there);
	RUN(means_are_weighted);
	RUN(kept_buildings_are_there_in_place_and_in_size_at_every_scale);
	RUN(row_order_changes_no_bit);
	return check_end();
}
