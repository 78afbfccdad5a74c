/*
 * test_influence.c - the fear: under importances, rows or barriers the core merges another pair than the specification
 * says, moves or loses a kept building, or never ends. Every kind of small set is collapsed beside the reference, with
 * random influences.
 *
 * The environment variable SETS says how many sets of each kind are tried. Test_influence_batch is the same with
 * batches of merges tried before every single one.
 */
#include "check.h"
#include "compare.h"
#include "sets.h"

#include <math.h>
#include <stdlib.h>

#define DEFAULT_SETS 60 /* of each of 19 kinds, each with 4 drawings of influences */

static const double s_us[] = {0.0, 0.3, 0.5, 1.0};

/* ---- influences by chance ---- */

/* Lines x = place or y = place. What lies on one belongs to the side of larger coordinates. */
struct ty_barriers
{
	size_t count;
	bool upright[3];
	int32_t place[3];
};

static bool
crosses(const ty_barriers *barriers, ty_position a, ty_position b, ty_position merged)
{
	(void) merged; /* nothing between two places on one side of a line is on the other */
	for (size_t i = 0; i < barriers->count; i++)
	{
		int32_t place = barriers->place[i];

		if (barriers->upright[i] ? (a.x < place) != (b.x < place) : (a.y < place) != (b.y < place))
			return true;
	}
	return false;
}

typedef struct drawing
{
	double importance[REFERENCE_MAX];
	given_rows rows;
	ty_barriers barriers;
	ty_influence influence; /* of these */
} drawing;

static double
draw_importance(random_state *random, int64_t kept_of_ten)
{
	static const double usual[] = {1, 1, 1, 1, 1.5, 2, 3, 10.25, 1000};

	if (random_between(random, 1, 10) <= kept_of_ten)
		return INFINITY;
	return usual[random_between(random, 0, 8)];
}

static void
draw_barriers(random_state *random, const ty_position *position, size_t n, ty_barriers *barriers)
{
	barriers->count = (size_t) random_between(random, 1, 3);
	for (size_t i = 0; i < barriers->count; i++)
	{
		const ty_position *p = &position[random_between(random, 0, (int64_t) n - 1)];

		barriers->upright[i] = random_between(random, 0, 1) == 1;
		barriers->place[i] = barriers->upright[i] ? p->x : p->y;
	}
}

static void
draw(random_state *random, const ty_position *position, size_t n, drawing *d)
{
	static const double alignments[] = {0, 0.5, 3};
	static const int64_t shares[] = {0, 1, 3, 10};
	uint32_t row[REFERENCE_MAX];
	int64_t what = random_between(random, 1, 7), kept_of_ten = shares[random_between(random, 0, 3)];

	memset(d, 0, sizeof *d);
	for (size_t i = 0; i < n; i++)
	{
		d->importance[i] = draw_importance(random, kept_of_ten);
		row[i] = random_between(random, 0, 1) == 0 ? TY_NONE : (uint32_t) random_between(random, 0, 2);
	}
	draw_barriers(random, position, n, &d->barriers);
	d->influence.importance = what & 1 ? d->importance : NULL;
	give_rows(&d->rows, row, n, 3, ldexp(1.0, (int) random_between(random, 0, 29)));
	d->influence.rows = what & 2 ? &d->rows.rows : NULL;
	d->influence.alignment = alignments[random_between(random, 0, 2)];
	d->influence.crosses = what & 4 ? crosses : NULL;
	d->influence.barriers = &d->barriers;
}

static bool
equals_reference(const char *name, ty_position *position, size_t n, double s_u, const ty_influence *influence,
				 ty_stop stop)
{
	const char *difference = compare_with_reference(position, n, s_u, influence, stop, REFERENCE_MESH);

	if (CHECK(difference == NULL, "%s, n %zu: %s", name, n, difference))
		return true;
	printf("  s_u %g, count %zu, min_distance %g, alignment %g, %zu barriers; smallest:\n", s_u, stop.count,
		   stop.min_distance, influence->alignment, influence->crosses == NULL ? 0 : influence->barriers->count);
	compare_minimise(position, n, s_u, influence, stop, REFERENCE_MESH);
	return false;
}

static size_t
sets_of_each_kind(void)
{
	return getenv("SETS") != NULL ? (size_t) atol(getenv("SETS")) : DEFAULT_SETS;
}

static bool
set_equals_reference(small_kind kind, uint64_t seed, bool to_the_last)
{
	random_state random = random_seed(seed);
	size_t n = (size_t) random_between(&random, 2, seed % 40 == 1 ? 50 : 22);
	ty_position position[REFERENCE_MAX];
	uint64_t keys[REFERENCE_MAX];
	ty_stop stop = {1, 0};
	static drawing d;

	small_set(kind, &random, position, n);
	sort_along_curve(position, keys, n);
	for (size_t i = 0; i < 4; i++)
	{
		draw(&random, position, n, &d);
		if (!to_the_last)
		{
			stop.count = (size_t) random_between(&random, 1, (int64_t) n);
			stop.min_distance = i == 0 ? 0 : ldexp(1.0, (int) random_between(&random, -1, 29));
		}
		if (!equals_reference(small_kind_name[kind], position, n, s_us[i], &d.influence, stop))
			return false;
	}
	return true;
}

static void
merges_and_meshes_equal_the_reference(void)
{
	for (small_kind kind = 0; kind < SMALL_KINDS; kind++)
		for (size_t set = 0; set < sets_of_each_kind(); set++)
			if (!set_equals_reference(kind, 7000000 + set * SMALL_KINDS + kind, true))
				break;
}

static void
stops_where_the_count_and_the_distance_say(void)
{
	for (small_kind kind = 0; kind < SMALL_KINDS; kind++)
		for (size_t set = 0; set < sets_of_each_kind(); set++)
			if (!set_equals_reference(kind, 9000000 + set * SMALL_KINDS + kind, false))
				break;
}

/* ---- what the specification says, in numbers ---- */

static ty_sequence
collapse(ty_position *position, size_t n, const ty_influence *influence, ty_stop stop)
{
	ty_sequence sequence;

	CHECK(ty_collapse(&ty_plain_environment, position, n, 0, influence, stop, true, NULL, NULL, &sequence) == TY_OK,
		  "collapse");
	return sequence;
}

static void
importances_of_1_change_nothing(void)
{
	static double ones[REFERENCE_MAX];
	const ty_influence influence = {.importance = ones};
	const ty_stop to_one = {1, 0};

	for (size_t i = 0; i < REFERENCE_MAX; i++)
		ones[i] = 1;
	for (small_kind kind = 0; kind < SMALL_KINDS; kind++)
	{
		random_state random = random_seed(400 + kind);
		ty_position plain[REFERENCE_MAX], weighted[REFERENCE_MAX];
		uint64_t keys[REFERENCE_MAX];
		ty_sequence a, b;

		small_set(kind, &random, plain, REFERENCE_MAX);
		sort_along_curve(plain, keys, REFERENCE_MAX);
		memcpy(weighted, plain, sizeof weighted);
		a = collapse(plain, REFERENCE_MAX, NULL, to_one);
		b = collapse(weighted, REFERENCE_MAX, &influence, to_one);
		CHECK(a.count == b.count && memcmp(a.gone, b.gone, a.count * sizeof *a.gone) == 0 &&
				  memcmp(a.cost, b.cost, a.count * sizeof *a.cost) == 0 && memcmp(plain, weighted, sizeof plain) == 0,
			  "%s: %zu and %zu merges", small_kind_name[kind], a.count, b.count);
		ty_sequence_free(&ty_plain_environment, &a);
		ty_sequence_free(&ty_plain_environment, &b);
	}
}

static void
a_vertex_lies_at_the_weighted_mean(void)
{
	ty_position position[] = {{0, 0}, {100, 40}};
	const double importance[] = {3, 1};
	const ty_influence influence = {.importance = importance};
	ty_sequence sequence = collapse(position, 2, &influence, (ty_stop){1, 0});

	CHECK(position[0].x == 25 && position[0].y == 10, "at %d, %d", position[0].x, position[0].y);
	CHECK(fabs(sequence.cost[0] - 3 * hypot(100, 40)) < 1e-9, "cost %g", sequence.cost[0]);
	ty_sequence_free(&ty_plain_environment, &sequence);
}

static void
kept_twins_at_one_place_all_stay(void)
{
	ty_position position[] = {{5, 5}, {5, 5}, {5, 5}, {5, 5}, {9, 5}};
	const double importance[] = {INFINITY, 1, INFINITY, INFINITY, 1};
	const ty_influence influence = {.importance = importance};
	uint32_t label[5];
	ty_sequence sequence = collapse(position, 5, &influence, (ty_stop){1, 0});

	CHECK(sequence.count == 2, "%zu merges", sequence.count);
	CHECK(ty_sequence_cut(&sequence, sequence.count, 5, label) == 3, "%u %u %u %u %u", label[0], label[1], label[2],
		  label[3], label[4]);
	CHECK(label[1] == 0 && label[4] == 0 && label[2] == 1 && label[3] == 2, "%u %u %u %u %u", label[0], label[1],
		  label[2], label[3], label[4]);
	CHECK(position[0].x == 5 && position[0].y == 5, "at %d, %d", position[0].x, position[0].y);
	ty_sequence_free(&ty_plain_environment, &sequence);
}

static void
where_all_are_kept_nothing_is_merged(void)
{
	for (small_kind kind = 0; kind < SMALL_KINDS; kind++)
	{
		random_state random = random_seed(600 + kind);
		ty_position position[40];
		double importance[40];
		const ty_influence influence = {.importance = importance};
		uint64_t keys[40];
		ty_sequence sequence;

		small_set(kind, &random, position, 40);
		sort_along_curve(position, keys, 40);
		for (size_t i = 0; i < 40; i++)
			importance[i] = INFINITY;
		sequence = collapse(position, 40, &influence, (ty_stop){1, 1e9});
		CHECK(sequence.count == 0, "%s: %zu merges", small_kind_name[kind], sequence.count);
		ty_sequence_free(&ty_plain_environment, &sequence);
	}
}

/*
 * Two houses that may be merged have two others between them, beyond barriers on either side. They become neighbours,
 * too near to one another, when one of those moves away. Their ranks depend on how the picture is turned.
 */
static void
neighbours_that_others_parted_are_seen_to_be_too_near(void)
{
	static const int32_t picture[5][2] = {{-10, 0}, {10, 0}, {0, 6}, {0, -6}, {0, 30}};

	for (int turn = 0; turn < 8; turn++)
	{
		ty_position position[5];
		uint64_t keys[5];
		ty_barriers barriers = {2, {turn % 2 == 1, turn % 2 == 1}, {95, 106}};
		const ty_influence influence = {.crosses = crosses, .barriers = &barriers};
		const ty_stop stop = {5, 25};
		ty_sequence sequence;

		for (int i = 0; i < 5; i++)
		{
			int32_t x = 100 + (turn & 2 ? -1 : 1) * picture[i][0], y = 100 + (turn & 4 ? -1 : 1) * picture[i][1];

			position[i] = turn % 2 == 1 ? (ty_position){y, x} : (ty_position){x, y};
		}
		sort_along_curve(position, keys, 5);
		equals_reference("parted", position, 5, 0, &influence, stop);
		sequence = collapse(position, 5, &influence, stop);
		CHECK(sequence.count == 2, "turn %d: %zu merges", turn, sequence.count);
		ty_sequence_free(&ty_plain_environment, &sequence);
	}
}

static void
immense_importances_are_edges_all_the_same(void)
{
	ty_position position[] = {{0, 0}, {1 << 30, 0}, {1 << 30, 1 << 30}};
	const double importance[] = {1e308, 1, 1.7e308};
	uint32_t row[] = {0, 1, 2};
	given_rows rows;
	const ty_influence influence = {.importance = importance, .rows = &rows.rows, .alignment = 1e300};
	ty_sequence sequence;

	give_rows(&rows, row, 3, 3, 1);
	sequence = collapse(position, 3, &influence, (ty_stop){1, 0});
	CHECK(sequence.count == 2, "%zu merges", sequence.count);
	for (size_t i = 0; i < sequence.count; i++)
		CHECK(isfinite(sequence.cost[i]), "cost %g", sequence.cost[i]);
	ty_sequence_free(&ty_plain_environment, &sequence);
}

static void
weights_leave_room_for_their_sum(void)
{
	const double one[] = {1}, kept[] = {INFINITY}, spread[] = {1, 1e300, 4096.5, INFINITY};
	const size_t counts[] = {1, 2, 3, 1000, 1000000, 500000000};
	int exponent = ty_weight_exponent(spread, 4);

	for (size_t i = 0; i < sizeof counts / sizeof *counts; i++)
	{
		/* as if there were so many of it */
		int bits = ty_weight_exponent(one, 1) - (int) ceil(log2((double) counts[i] + 1)) + 1;

		CHECK((double) counts[i] * (double) ty_weight(1, bits) < ldexp(1, 62), "%zu", counts[i]);
	}
	CHECK(ty_weight_exponent(kept, 1) == ty_weight_exponent(one, 1), "%d", ty_weight_exponent(kept, 1));
	CHECK(ty_weight(1, exponent) == 1, "%lld", (long long) ty_weight(1, exponent));
	CHECK(ty_weight(1e300, exponent) > INT64_C(1) << 57, "%lld", (long long) ty_weight(1e300, exponent));
	CHECK(ty_weight(INFINITY, exponent) == 1, "%lld", (long long) ty_weight(INFINITY, exponent));
	CHECK(ty_weight(1.25, 2) == 5 && ty_weight(1.3, 0) == 1 && ty_weight(1.5, 0) == 2, "rounding");
}

int
main(int argc, char **argv)
{
	check_begin(argc, argv);
	RUN(a_vertex_lies_at_the_weighted_mean);
	RUN(weights_leave_room_for_their_sum);
	RUN(importances_of_1_change_nothing);
	RUN(kept_twins_at_one_place_all_stay);
	RUN(where_all_are_kept_nothing_is_merged);
	RUN(neighbours_that_others_parted_are_seen_to_be_too_near);
	RUN(immense_importances_are_edges_all_the_same);
	RUN(stops_where_the_count_and_the_distance_say);
	RUN(merges_and_meshes_equal_the_reference);
	return check_end();
}
