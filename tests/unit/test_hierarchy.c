/*
 * test_hierarchy.c - the fear: the nodes alive at some scale are not the placeholders that the group has there, a life
 * span ends a rounding too early or too late, or a quantile is that of another range.
 */
#include "check.h"
#include "hierarchy.h"
#include "quantile.h"
#include "sets.h"

#include <math.h>
#include <stdlib.h>

#define MOST 400

static ty_building buildings[MOST];
static double importance[MOST];

static ty_parameters
defaults(double s_u)
{
	return (ty_parameters){.scale = TY_DEFAULT_SOURCE_SCALE,
						   .s_u = s_u,
						   .source_scale = TY_DEFAULT_SOURCE_SCALE,
						   .lod200_scale = TY_DEFAULT_LOD200_SCALE,
						   .exponent = TY_DEFAULT_EXPONENT,
						   .psi = TY_DEFAULT_PSI,
						   .law = true};
}

static ty_hierarchy
build(const ty_input *input, const ty_parameters *p)
{
	ty_hierarchy h = {0};
	ty_status status = ty_hierarchy_build(&ty_plain_environment, input, p, &h);

	CHECK(status == TY_OK, "n %zu: status %d", input->n, status);
	return h;
}

static bool
has_member(const ty_hierarchy *h, ty_node node, uint32_t building)
{
	for (uint32_t leaf = 0; leaf < node.member_count; leaf++)
		if (ty_hierarchy_node(h, node.first_leaf + leaf).representative == building)
			return true;
	return false;
}

/* whether a node is what a placeholder shows: place, size before enlargement, representative and members */
static bool
is_same(const ty_hierarchy *h, ty_node node, const ty_result *result, const ty_placeholder *p)
{
	if (node.representative != p->representative || node.member_count != p->count || node.x != p->x || node.y != p->y ||
		node.area != p->area || node.ratio != p->ratio || node.ux != p->ux || node.uy != p->uy || node.kept != p->kept)
		return false;
	for (uint32_t i = 0; i < p->count; i++)
		if (!has_member(h, node, result->members[p->first + i]))
			return false;
	return true;
}

/* The alive nodes at a scale beside the placeholders there. The sum, so that areas are what they are at every scale. */
static void
compare_at(const ty_hierarchy *h, const ty_input *input, ty_parameters p, double scale)
{
	ty_result result;
	size_t alive = 0, found = 0;

	p.scale = scale;
	NEED(ty_typify(&ty_plain_environment, input, &p, &result) == TY_OK, "scale %.17g", scale);
	for (size_t number = 0; number < ty_hierarchy_nodes(h); number++)
	{
		ty_node node = ty_hierarchy_node(h, number);

		if (!(node.scale_from <= scale && scale < node.scale_to))
			continue;
		alive++;
		for (size_t k = 0; k < result.count; k++)
			found += is_same(h, node, &result, &result.placeholders[k]);
	}
	CHECK(alive == result.count && found == result.count, "scale %.17g: %zu alive, %zu placeholders, %zu the same",
		  scale, alive, result.count, found);
	ty_result_free(&ty_plain_environment, &result);
}

/* from all buildings to one; psi 0 at the source scale, and sums, leave areas unscaled */
static void
compare_all(size_t n, double s_u, const double *weights, ty_area_statistic statistic)
{
	ty_input input = {.buildings = buildings, .n = n, .importance = weights};
	ty_parameters p = defaults(s_u);
	ty_hierarchy h;

	p.area_statistic = statistic;
	h = build(&input, &p);
	for (size_t step = 0; step < h.merges; step++)
		if (statistic == TY_SUM)
			compare_at(&h, &input, p, h.scale[step]);
	compare_at(&h, &input, p, p.source_scale);
	CHECK(weights != NULL || h.merges == n - 1, "n %zu: %zu merges", n, h.merges);
	ty_hierarchy_free(&ty_plain_environment, &h);
}

static void
alive_nodes_are_the_placeholders_at_every_count(void)
{
	for (large_kind kind = 0; kind < LARGE_KINDS; kind++)
	{
		random_state random = random_seed(7 + kind);

		for (size_t n = 1; n <= 65; n = n < 4 ? n + 1 : 2 * n - 1)
		{
			large_set(kind, &random, buildings, n);
			for (size_t i = 0; i < n; i++)
				importance[i] = i % 11 == 3 ? INFINITY : i % 5 == 0 ? 2.5 : 1;
			for (double s_u = 0; s_u <= 1; s_u += 0.5)
			{
				compare_all(n, s_u, NULL, TY_SUM);
				compare_all(n, s_u, importance, TY_SUM);
			}
			compare_all(n, 0, NULL, TY_MEAN);
			compare_all(n, 0, NULL, TY_MEDIAN);
		}
	}
}

/* A mean or median that a placeholder has, found at a scale that leaves a few, with psi 1 - 1 / enlargement^2 ... 0. */
static void
statistics_are_those_of_the_members(void)
{
	random_state random = random_seed(5);
	ty_input input = {.buildings = buildings, .n = 300};

	large_set(LARGE_CLUSTERED, &random, buildings, 300);
	for (ty_area_statistic statistic = TY_MEAN; statistic <= TY_SUM; statistic++)
	{
		ty_parameters p = defaults(0.5);
		ty_hierarchy h;
		ty_result result;

		p.area_statistic = statistic;
		h = build(&input, &p);
		p.count = 37;
		NEED(ty_typify(&ty_plain_environment, &input, &p, &result) == TY_OK, "statistic %d", statistic);
		for (size_t k = 0; k < result.count; k++)
		{
			size_t found = 0;

			for (size_t number = 0; number < ty_hierarchy_nodes(&h); number++)
				found += is_same(&h, ty_hierarchy_node(&h, number), &result, &result.placeholders[k]);
			CHECK(found == 1, "statistic %d, placeholder %zu: %zu nodes", statistic, k, found);
		}
		ty_result_free(&ty_plain_environment, &result);
		ty_hierarchy_free(&ty_plain_environment, &h);
	}
}

static void
leaves_parents_and_costs_make_a_tree(void)
{
	random_state random = random_seed(11);
	ty_input input = {.buildings = buildings, .n = MOST};
	ty_parameters p = defaults(0.5);
	ty_hierarchy h;
	double before = 0;

	large_set(LARGE_UNIFORM, &random, buildings, MOST);
	h = build(&input, &p);
	for (size_t number = 0; number < ty_hierarchy_nodes(&h); number++)
	{
		ty_node node = ty_hierarchy_node(&h, number);

		if (number < MOST)
			CHECK(node.first_leaf == number && node.member_count == 1 && node.cost == 0, "leaf %zu", number);
		if (node.parent == TY_NONE)
		{
			CHECK(number == 2 * MOST - 2 && isinf(node.scale_to), "root %zu", number);
			continue;
		}
		ty_node parent = ty_hierarchy_node(&h, node.parent);

		CHECK(node.parent > number && parent.scale_from == node.scale_to && parent.first_leaf <= node.first_leaf &&
				  parent.first_leaf + parent.member_count >= node.first_leaf + node.member_count,
			  "node %zu below %u", number, node.parent);
		CHECK(number < MOST || node.cost >= before, "cost %g after %g", node.cost, before);
		before = number < MOST ? 0 : node.cost;
	}
	ty_hierarchy_free(&ty_plain_environment, &h);
}

static void
every_node_is_stored_once(void)
{
	random_state random = random_seed(13);
	ty_input input = {.buildings = buildings, .n = MOST};
	ty_parameters p = defaults(0);
	ty_hierarchy h;
	size_t seen[2 * MOST] = {0};

	large_set(LARGE_CLUSTERED, &random, buildings, MOST);
	h = build(&input, &p);
	for (size_t place = 0; place < ty_hierarchy_nodes(&h); place++)
		seen[ty_hierarchy_stored(&h, place)]++;
	for (size_t number = 0; number < ty_hierarchy_nodes(&h); number++)
		CHECK(seen[number] == 1, "node %zu is stored %zu times", number, seen[number]);
	ty_hierarchy_free(&ty_plain_environment, &h);
}

/* The bands in which a look-up searches a class hold whatever of it is alive. */
static void
what_is_alive_is_searched_for(void)
{
	random_state random = random_seed(17);
	size_t of_class[TY_LIFETIMES] = {0};

	for (int i = 0; i < 200000; i++)
	{
		double from = 25000 * exp2(12 * random_unit(&random) * random_unit(&random));
		double to = i % 50 == 0 ? INFINITY : from * exp2(7 * random_unit(&random) * random_unit(&random));
		double scale = i % 7 == 0 ? from : from + (fmin(to, 1e12) - from) * random_unit(&random) * 0.999999;
		int lifetime = ty_lifetime(from, to, 25000), asked = ty_band(scale, 25000);
		int band = ty_band_together(lifetime, ty_band(to, 25000));

		if (!(from <= scale && scale < to))
			continue;
		of_class[lifetime]++;
		CHECK(lifetime == TY_LIFETIMES - 1 || to < INFINITY, "a root is of lifetime %d", lifetime);
		CHECK(to == INFINITY ? band == TY_ROOT_BAND
							 : band >= ty_band_together(lifetime, asked) && band <= ty_last_band(lifetime, asked) &&
								   band % ty_bands_together(lifetime) == 0,
			  "%g to %g, lifetime %d, is in band %d, but at %g bands %d to %d are asked", from, to, lifetime, band,
			  scale, ty_band_together(lifetime, asked), ty_last_band(lifetime, asked));
	}
	for (int lifetime = 0; lifetime < TY_LIFETIMES; lifetime++)
		CHECK(of_class[lifetime] > 1000, "only %zu of lifetime %d", of_class[lifetime], lifetime);
}

static void
the_count_falls_at_the_very_scale(void)
{
	static const double exponents[] = {0, 0.3, 1, 1.7, 2, 4, 9.5};

	for (size_t e = 0; e < sizeof exponents / sizeof *exponents; e++)
		for (size_t n = 2; n <= 3000000; n = 5 * n + 3)
			for (size_t count = n; count >= 2; count -= count / 7 + 1)
			{
				ty_parameters p = defaults(0);

				p.exponent = exponents[e];
				p.scale = ty_scale_below(n, count, &p);
				CHECK(ty_count(n, &p, 1) < count, "exponent %g, %zu of %zu at %.17g", p.exponent, count, n, p.scale);
				p.scale = nextafter(p.scale, 0);
				CHECK(p.scale < p.source_scale || ty_count(n, &p, 1) >= count, "exponent %g, %zu of %zu before %.17g",
					  p.exponent, count, n, p.scale);
			}
}

static void
counts_without_a_scale(void)
{
	ty_parameters p = defaults(0);

	CHECK(isinf(ty_scale_below(40, 1, &p)) && isinf(ty_scale_below(0, 0, &p)), "of one");
	CHECK(ty_scale_below(0, 1, &p) == p.source_scale, "of none");
	CHECK(ty_scale_below(3, 4, &p) == p.source_scale, "more than there are");
}

static int
compare_values(const void *a, const void *b)
{
	uint32_t left = *(const uint32_t *) a, right = *(const uint32_t *) b;

	return (left > right) - (left < right);
}

static void
quantiles_are_those_of_the_range(void)
{
	static uint32_t values[MOST], scratch[MOST];
	random_state random = random_seed(17);

	for (size_t n = 1; n <= MOST; n += 1 + n / 3)
		for (uint32_t range = 1; range < 5000; range *= 7)
		{
			ty_quantiles q;

			for (size_t i = 0; i < n; i++)
				scratch[i] = values[i] = (uint32_t) (random_unit(&random) * range);
			NEED(ty_quantiles_prepare(&ty_plain_environment, scratch, n, &q) == TY_OK, "n %zu", n);
			for (size_t first = 0; first < n; first += 1 + n / 9)
				for (size_t count = 1; first + count <= n; count += 1 + count / 2)
				{
					memcpy(scratch, values + first, count * sizeof *scratch);
					qsort(scratch, count, sizeof *scratch, compare_values);
					for (size_t k = 0; k < count; k += 1 + count / 5)
						CHECK(ty_quantile(&q, first, count, k) == scratch[k], "n %zu, [%zu, +%zu), %zu: %u, not %u", n,
							  first, count, k, ty_quantile(&q, first, count, k), scratch[k]);
				}
			ty_quantiles_free(&ty_plain_environment, &q);
		}
}

int
main(int argc, char **argv)
{
	check_begin(argc, argv);
	RUN(alive_nodes_are_the_placeholders_at_every_count);
	RUN(statistics_are_those_of_the_members);
	RUN(leaves_parents_and_costs_make_a_tree);
	RUN(every_node_is_stored_once);
	RUN(what_is_alive_is_searched_for);
	RUN(the_count_falls_at_the_very_scale);
	RUN(counts_without_a_scale);
	RUN(quantiles_are_those_of_the_range);
	return check_end();
}
