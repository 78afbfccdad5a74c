/*
 * test_large.c - the fear: a shape of data on which the mesh breaks, never ends or goes quadratic only when there is
 * much of it. Times are printed for information, never asserted.
 */
#include "check.h"
#include "collapse.h"
#include "sets.h"

#include <math.h>
#include <stdlib.h>
#include <time.h>

#define MOST 100000

static ty_building buildings[MOST];
static uint32_t order[MOST];
static ty_position position[MOST];
static uint64_t keys[MOST];

static const double s_us[] = {0, 0.5, 1};

/* Checks the mesh after every so many merges. */
typedef struct watch
{
	size_t n, interval;
	const char *broken;
	size_t step;
} watch;

static void
look_at_mesh(void *context, const ty_mesh *mesh, size_t step)
{
	watch *w = context;

	if (w->broken != NULL || mesh == NULL || (step % w->interval != 0 && step + 3 < w->n))
		return;
	w->broken = ty_mesh_check(mesh);
	w->step = step;
}

static bool
prepare(large_kind kind, size_t n)
{
	random_state random = random_seed(60 + kind);
	ty_grid grid;

	large_set(kind, &random, buildings, n);
	return ty_grid_fit(buildings, n, &grid) == TY_OK &&
		   ty_canonical_order(&ty_plain_environment, buildings, n, &grid, order, position, keys) == TY_OK;
}

/* seconds for a whole collapse; the mesh is looked at every interval merges and at the end */
static double
collapse_watched(large_kind kind, size_t n, double s_u, size_t interval)
{
	const ty_stop to_one = {1, 0};
	watch w = {n, interval, NULL, 0};
	ty_sequence sequence = {0};
	clock_t start;
	ty_status status;

	if (!CHECK(prepare(kind, n), "%s", large_kind_name[kind]))
		return 0;
	start = clock();
	status = ty_collapse(&ty_plain_environment, position, n, s_u, NULL, to_one, true, look_at_mesh, &w, &sequence);
	CHECK(status == TY_OK, "%s, s_u %g: status %d", large_kind_name[kind], s_u, status);
	CHECK(w.broken == NULL, "%s, s_u %g, merge %zu: %s", large_kind_name[kind], s_u, w.step, w.broken);
	CHECK(sequence.count == n - 1, "%s, s_u %g: %zu merges", large_kind_name[kind], s_u, sequence.count);
	ty_sequence_free(&ty_plain_environment, &sequence);
	return (double) (clock() - start) / CLOCKS_PER_SEC;
}

static void
the_mesh_holds_on_the_way_down(void)
{
	for (large_kind kind = 0; kind < LARGE_KINDS; kind++)
		for (size_t i = 0; i < 3; i++)
			collapse_watched(kind, 20000, s_us[i], 1000);
}

static void
shapes_that_are_known_to_hurt_come_to_an_end(void)
{
	double uniform = 0;

	for (large_kind kind = 0; kind < LARGE_KINDS; kind++)
		for (size_t i = 0; i < 3; i += 2)
		{
			size_t n = kind == LARGE_LATTICE ? 90000 : MOST;
			double seconds = collapse_watched(kind, n, s_us[i], n / 4);
			double each = 1e9 * seconds / (double) n;

			if (kind == LARGE_UNIFORM && i == 0)
				uniform = each;
			printf("  information: %s, s_u %g, %zu buildings: %.0f ns each, %.1f times uniform\n",
				   large_kind_name[kind], s_us[i], n, each, each / uniform);
		}
}

/* The nearest partner of larger rank, for each vertex: closest pairs in quadratic time, and no mesh. */
typedef struct nearest_pairs
{
	size_t n;
	int64_t r[MOST], sum_x[MOST], sum_y[MOST]; /* r 0: gone */
	ty_position at[MOST];
	double cost[MOST];
	uint32_t partner[MOST];
} nearest_pairs;

static nearest_pairs pairs;

static double
pair_cost(uint32_t a, uint32_t b)
{
	int64_t dx = (int64_t) pairs.at[a].x - pairs.at[b].x;
	int64_t dy = (int64_t) pairs.at[a].y - pairs.at[b].y;

	return sqrt((double) (dx * dx + dy * dy));
}

static void
consider(uint32_t a, uint32_t b)
{
	double cost = pair_cost(a, b);

	if (cost < pairs.cost[a] || (cost == pairs.cost[a] && b < pairs.partner[a]))
	{
		pairs.cost[a] = cost;
		pairs.partner[a] = b;
	}
}

static void
find_partner(uint32_t a)
{
	pairs.cost[a] = INFINITY;
	for (uint32_t b = a + 1; b < pairs.n; b++)
		if (pairs.r[b] > 0)
			consider(a, b);
}

static void
begin_pairs(size_t n)
{
	pairs.n = n;
	for (uint32_t a = 0; a < n; a++)
	{
		pairs.r[a] = 1;
		pairs.sum_x[a] = position[a].x;
		pairs.sum_y[a] = position[a].y;
		pairs.at[a] = position[a];
	}
	for (uint32_t a = 0; a < n; a++)
		find_partner(a);
}

/* merges the closest pair and returns its smaller rank */
static uint32_t
merge_nearest(uint32_t *gone, double *cost)
{
	uint32_t best = TY_NONE;

	for (uint32_t a = 0; a < pairs.n; a++)
		if (pairs.r[a] > 0 && (best == TY_NONE || pairs.cost[a] < pairs.cost[best]))
			best = a;
	*gone = pairs.partner[best];
	*cost = pairs.cost[best];
	pairs.r[best] += pairs.r[*gone];
	pairs.sum_x[best] += pairs.sum_x[*gone];
	pairs.sum_y[best] += pairs.sum_y[*gone];
	pairs.at[best].x = (int32_t) ((2 * pairs.sum_x[best] + pairs.r[best]) / (2 * pairs.r[best]));
	pairs.at[best].y = (int32_t) ((2 * pairs.sum_y[best] + pairs.r[best]) / (2 * pairs.r[best]));
	pairs.r[*gone] = 0;
	for (uint32_t a = 0; a < pairs.n; a++)
	{
		if (pairs.r[a] == 0)
			continue;
		if (a == best || pairs.partner[a] == best || pairs.partner[a] == *gone)
			find_partner(a);
		else if (a < best)
			consider(a, best);
	}
	return best;
}

static void
two_thousand_buildings_merge_as_nearest_pairs(void)
{
	for (large_kind kind = 0; kind < LARGE_KINDS; kind++)
	{
		const ty_stop to_one = {1, 0};
		ty_sequence sequence;
		size_t n = 2000;

		NEED(prepare(kind, n), "%s", large_kind_name[kind]);
		begin_pairs(n);
		NEED(ty_collapse(&ty_plain_environment, position, n, 0, NULL, to_one, true, NULL, NULL, &sequence) == TY_OK,
			 "%s", large_kind_name[kind]);
		CHECK(sequence.count == n - 1, "%s: %zu merges", large_kind_name[kind], sequence.count);
		for (size_t i = 0; i < sequence.count; i++)
		{
			uint32_t gone;
			double cost;
			uint32_t kept = merge_nearest(&gone, &cost);

			if (!CHECK(sequence.kept[i] == kept && sequence.gone[i] == gone && sequence.cost[i] == cost,
					   "%s, merge %zu: core %u <- %u at %a, nearest %u <- %u at %a", large_kind_name[kind], i + 1,
					   sequence.kept[i], sequence.gone[i], sequence.cost[i], kept, gone, cost))
				break;
		}
		ty_sequence_free(&ty_plain_environment, &sequence);
	}
}

int
main(int argc, char **argv)
{
	check_begin(argc, argv);
	RUN(two_thousand_buildings_merge_as_nearest_pairs);
	RUN(the_mesh_holds_on_the_way_down);
	RUN(shapes_that_are_known_to_hurt_come_to_an_end);
	return check_end();
}
