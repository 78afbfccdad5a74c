/*
 * test_memory.c - the fear: some shape of data takes more memory than the README promises. Bytes are counted, not
 * measured, so that every machine sees the same.
 */
#include "check.h"
#include "counting.h"
#include "group.h"
#include "sets.h"

#define MOST 30000
/*
 * Bytes a building at the peak, the building itself included, the result not. More is taken down to one vertex, where
 * merges of hubs are done many at once or with thousands of corners, and by groups of a few thousand, whose queue is a
 * plain heap.
 */
#define PROMISED 150.0
#define PROMISED_TO_ONE 155.0
#define PROMISED_AT_MOST 190.0

static ty_building buildings[MOST];

static const ty_parameters to_a_third = {
	.scale = 75000, .s_u = 0.5, .source_scale = 25000, .lod200_scale = 200000, .exponent = 2, .psi = 0.75, .law = true};

/* bytes a building; what the result holds is not counted */
static double
peak_of(large_kind kind, size_t n, const ty_parameters *p)
{
	random_state random = random_seed(60 + kind);
	counting counter;
	ty_environment env = counting_environment(&counter);
	ty_result result;
	size_t held;
	ty_status status;

	large_set(kind, &random, buildings, n);
	status = ty_typify(&env, &(ty_input){.buildings = buildings, .n = n}, p, &result);
	if (!CHECK(status == TY_OK, "%s: status %d", large_kind_name[kind], status))
		return 0;
	held = counter.used;
	ty_result_free(&env, &result);
	CHECK(counter.used == 0, "%s: %zu bytes were not given back", large_kind_name[kind], counter.used);
	/* while the mesh stands there is no result yet; while the result is made there is no mesh any more */
	return (double) sizeof *buildings + (double) (counter.peak > held ? counter.peak : 0) / (double) n;
}

static void
no_shape_takes_more_memory_than_promised(void)
{
	ty_parameters to_one = to_a_third, by_distance = to_a_third;

	to_one.count = 1;
	by_distance.min_distance = 5;
	by_distance.law = false;
	for (large_kind kind = 0; kind < LARGE_KINDS; kind++)
	{
		double third = peak_of(kind, MOST, &to_a_third);
		double one = peak_of(kind, MOST, &to_one);
		double distance = peak_of(kind, MOST / 10, &by_distance);

		bool hubs = kind == LARGE_RING || kind == LARGE_TWIN_ROW;

		CHECK(third <= (hubs ? PROMISED_AT_MOST : PROMISED), "%s, to a third: %.1f bytes a building",
			  large_kind_name[kind], third);
		CHECK(one <= (hubs ? PROMISED_AT_MOST : PROMISED_TO_ONE), "%s, to one: %.1f bytes a building",
			  large_kind_name[kind], one);
		CHECK(distance <= PROMISED_AT_MOST, "%s, by distance: %.1f bytes a building", large_kind_name[kind], distance);
		printf("  information: %s: %.1f bytes a building to a third, %.1f to one, %.1f by distance\n",
			   large_kind_name[kind], third, one, distance);
	}
}

int
main(int argc, char **argv)
{
	check_begin(argc, argv);
	RUN(no_shape_takes_more_memory_than_promised);
	return check_end();
}
