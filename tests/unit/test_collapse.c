/*
 * test_collapse.c - the fear: on some shape of data the core merges another pair than the specification says, or
 * its mesh stops being the Delaunay mesh. Every kind of small set is collapsed beside the reference.
 *
 * The environment variable SETS says how many sets of each kind are tried.
 */
#include "check.h"
#include "compare.h"
#include "sets.h"

#include <math.h>
#include <stdlib.h>

#define DEFAULT_SETS 110 /* of each of 19 kinds: 2 090 */

static const double s_us[] = {0.0, 0.3, 0.5, 1.0};

static void
print_set(const ty_position *position, size_t n, double s_u, ty_stop stop)
{
	printf("  s_u %g, count %zu, min_distance %g, %zu positions:", s_u, stop.count, stop.min_distance, n);
	for (size_t i = 0; i < n; i++)
		printf(" {%d, %d}", position[i].x, position[i].y);
	printf("\n");
}

static bool
equals_reference(const char *name, ty_position *position, size_t n, double s_u, ty_stop stop,
				 reference_candidates candidates)
{
	const char *difference = compare_with_reference(position, n, s_u, NULL, stop, candidates);

	if (CHECK(difference == NULL, "%s, n %zu: %s", name, n, difference))
		return true;
	n = compare_minimise(position, n, s_u, NULL, stop, candidates);
	printf("  smallest: %s\n", compare_with_reference(position, n, s_u, NULL, stop, candidates));
	print_set(position, n, s_u, stop);
	return false;
}

/* mostly 5 to 25, seldom up to 60 */
static size_t
draw_size(random_state *random, size_t set)
{
	if (set % 12 == 0)
		return (size_t) random_between(random, 1, 5);
	return (size_t) random_between(random, 5, set % 40 == 1 ? 60 : 25);
}

/* sets of one kind with every s_u, to the last vertex; false at the first that differs */
static bool
sets_of_kind(small_kind kind, size_t sets)
{
	const ty_stop to_one = {1, 0};

	for (size_t set = 0; set < sets; set++)
	{
		random_state random = random_seed(set * SMALL_KINDS + kind);
		ty_position position[REFERENCE_MAX];
		uint64_t keys[REFERENCE_MAX];
		size_t n = draw_size(&random, set);

		small_set(kind, &random, position, n);
		sort_along_curve(position, keys, n);
		for (size_t i = 0; i < sizeof s_us / sizeof *s_us; i++)
			if (!equals_reference(small_kind_name[kind], position, n, s_us[i], to_one, REFERENCE_MESH))
				return false;
		if (!equals_reference(small_kind_name[kind], position, n, 0, to_one, REFERENCE_ALL_PAIRS))
			return false;
	}
	return true;
}

static void
merges_and_meshes_equal_the_reference(void)
{
	size_t sets = getenv("SETS") != NULL ? (size_t) atol(getenv("SETS")) : DEFAULT_SETS;

	for (small_kind kind = 0; kind < SMALL_KINDS; kind++)
		sets_of_kind(kind, sets);
}

static void
stops_where_the_count_and_the_distance_say(void)
{
	for (size_t set = 0; set < 600; set++)
	{
		random_state random = random_seed(1000000 + set);
		small_kind kind = (small_kind) (set % SMALL_KINDS);
		ty_position position[REFERENCE_MAX];
		uint64_t keys[REFERENCE_MAX];
		size_t n = (size_t) random_between(&random, 2, 20);
		ty_stop stop = {(size_t) random_between(&random, 1, (int64_t) n), 0};

		small_set(kind, &random, position, n);
		sort_along_curve(position, keys, n);
		if (set % 3 != 0)
			stop.min_distance = ldexp(1.0, (int) random_between(&random, -1, 29));
		if (!equals_reference(small_kind_name[kind], position, n, s_us[set % 4], stop, REFERENCE_MESH))
			return;
	}
}

static void
a_distance_that_is_just_reached_stops(void)
{
	/* 5 apart: no two are nearer than 5, but they are nearer than 5.0000001 */
	ty_position position[] = {{0, 0}, {3, 4}};
	const ty_stop reached = {2, 5.0};
	const ty_stop not_reached = {2, 5.0000001};

	equals_reference("reached", position, 2, 1, reached, REFERENCE_MESH);
	equals_reference("not reached", position, 2, 1, not_reached, REFERENCE_MESH);
}

static void
distance_alone_may_merge_everything(void)
{
	ty_position position[] = {{0, 0}, {0, 1 << 30}, {1 << 30, 1 << 30}, {1 << 30, 0}};
	const ty_stop never = {4, 1e300};
	uint64_t keys[4];

	sort_along_curve(position, keys, 4);
	equals_reference("far corners", position, 4, 0.5, never, REFERENCE_MESH);
}

static void
count_beyond_the_vertices_merges_nothing(void)
{
	ty_position position[] = {{0, 0}, {0, 0}, {7, 7}};
	uint64_t keys[3];
	const ty_stop stop = {10, 0};

	sort_along_curve(position, keys, 3);
	equals_reference("three", position, 3, 0, stop, REFERENCE_MESH);
}

static void
a_mean_may_land_on_another_vertex(void)
{
	/* the mean of the outer two of the nearest three is where the next one stands; then again */
	ty_position position[] = {{10, 10}, {12, 10}, {11, 10}, {11, 11}, {11, 14}, {30, 30}, {0, 30}};
	const ty_stop to_one = {1, 0};
	uint64_t keys[7];

	sort_along_curve(position, keys, 7);
	for (size_t i = 0; i < sizeof s_us / sizeof *s_us; i++)
		equals_reference("landing", position, 7, s_us[i], to_one, REFERENCE_MESH);
}

static void
cutting_numbers_clusters_by_smallest_rank(void)
{
	uint32_t kept[] = {3, 1, 1, 0};
	uint32_t gone[] = {5, 2, 3, 4};
	ty_sequence sequence = {.count = 4, .kept = kept, .gone = gone};
	const uint32_t expected[5][6] = {
		{0, 1, 2, 3, 4, 5}, {0, 1, 2, 3, 4, 3}, {0, 1, 1, 2, 3, 2}, {0, 1, 1, 1, 2, 1}, {0, 1, 1, 1, 0, 1},
	};
	uint32_t label[6];

	for (size_t merges = 0; merges <= 4; merges++)
	{
		size_t clusters = ty_sequence_cut(&sequence, merges, 6, label);

		CHECK(clusters == 6 - merges, "%zu clusters after %zu merges", clusters, merges);
		CHECK(memcmp(label, expected[merges], sizeof label) == 0, "after %zu merges: %u %u %u %u %u %u", merges,
			  label[0], label[1], label[2], label[3], label[4], label[5]);
	}
}

static void
costs_are_not_kept_unless_asked_for(void)
{
	ty_position position[] = {{0, 0}, {1, 0}};
	uint64_t keys[2];
	const ty_stop stop = {1, 0};
	ty_sequence sequence;

	sort_along_curve(position, keys, 2);
	NEED(ty_collapse(&ty_plain_environment, position, 2, 0, NULL, stop, false, NULL, NULL, &sequence) == TY_OK, "no");
	CHECK(sequence.cost == NULL && sequence.count == 1, "%zu merges", sequence.count);
	ty_sequence_free(&ty_plain_environment, &sequence);
}

int
main(int argc, char **argv)
{
	check_begin(argc, argv);
	RUN(cutting_numbers_clusters_by_smallest_rank);
	RUN(costs_are_not_kept_unless_asked_for);
	RUN(a_distance_that_is_just_reached_stops);
	RUN(distance_alone_may_merge_everything);
	RUN(count_beyond_the_vertices_merges_nothing);
	RUN(a_mean_may_land_on_another_vertex);
	RUN(stops_where_the_count_and_the_distance_say);
	RUN(merges_and_meshes_equal_the_reference);
	return check_end();
}
