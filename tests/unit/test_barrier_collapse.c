/*
 * test_barrier_collapse.c - the fear: a merge carries somebody across a barrier: along the edge, over the merged place,
 * or bit by bit.
 */
#include "barrier_world.h"
#include "compare.h"
#include "sets.h"

/* a place at most a cell off the edge */
static ty_position
near_the_edge(random_state *random, ty_position a, ty_position b, double side)
{
	double share = random_unit(random);

	return (ty_position){
		on_side(floor(a.x + share * ((double) b.x - a.x)) + (double) random_between(random, 0, 1), side),
		on_side(floor(a.y + share * ((double) b.y - a.y)) + (double) random_between(random, 0, 1), side)};
}

static void
the_way_over_the_merged_place(void)
{
	random_state random = random_seed(10);
	const double sides[] = {12, 40, 1000, (double) SIDE};
	size_t only_the_way = 0;

	for (size_t k = 0; k < 80; k++)
	{
		double side = sides[k % 4];
		ty_position corners[2] = {{0, 0}, {(int32_t) side, (int32_t) side}};
		ty_grid grid = grid_of(1, 0, 0);
		ty_barrier_lines lines;
		ty_barriers barriers;

		make_lines(&random, k % 4 == 0 ? 45 : 100, side);
		gather(&ty_plain_environment, &lines);
		CHECK(ty_barriers_fit(&ty_plain_environment, &lines, &grid, corners, 2, &barriers) == TY_OK, "fit");
		for (int t = 0; t < 1000; t++)
		{
			ty_point p = somewhere(&random, side), q = somewhere(&random, side);
			ty_position a = {(int32_t) p.x, (int32_t) p.y}, b = {(int32_t) q.x, (int32_t) q.y}, m;
			bool edge, way;

			if (t % 2)
				b = (ty_position){on_side(a.x + (double) random_between(&random, -5, 5), side),
								  on_side(a.y + (double) random_between(&random, -5, 5), side)};
			m = near_the_edge(&random, a, b, side);
			edge = reference_cross_any(a, b);
			way = reference_cross_any(a, m) || reference_cross_any(m, b);
			if (a.x == b.x && a.y == b.y)
				continue;
			CHECK(ty_barriers_bar(&barriers, a, b, m) == (edge || way), "(%d %d, %d %d) over (%d %d): %d %d", a.x, a.y,
				  b.x, b.y, m.x, m.y, edge, way);
			CHECK(ty_barriers_bar(&barriers, b, a, m) == (edge || way), "not the same way back");
			only_the_way += way && !edge;
		}
		free_both(&lines, &barriers);
	}
	CHECK(only_the_way > 100, "only %zu bars by rounding", only_the_way);
}

/* lines through and between the positions, dangling ends and closed rings among them */
static void
make_lines_among(random_state *random, const ty_position *position, size_t n)
{
	uint32_t lines = (uint32_t) random_between(random, 1, 6);

	all.lines = all.used = 0;
	for (uint32_t l = 0; l < lines; l++)
	{
		uint32_t points = (uint32_t) random_between(random, 2, 5);

		all.first[all.lines] = (uint32_t) all.used;
		all.count[all.lines++] = points;
		for (uint32_t i = 0; i < points; i++)
		{
			const ty_position *p = &position[random_between(random, 0, (int64_t) n - 1)];
			const ty_position *q = &position[random_between(random, 0, (int64_t) n - 1)];

			all.points[all.used++] = random_between(random, 0, 2) == 0 ? (ty_point){p->x, p->y}
																	   : (ty_point){floor(((double) p->x + q->x) / 2),
																					floor(((double) p->y + q->y) / 2)};
		}
	}
}

static void
merges_equal_the_reference(void)
{
	random_state random = random_seed(11);
	ty_grid grid = grid_of(1, 0, 0);
	const double s_us[] = {0, 0.5, 1};

	for (small_kind kind = 0; kind < SMALL_KINDS; kind++)
		for (int round = 0; round < 30; round++)
		{
			size_t n = (size_t) random_between(&random, 2, 20);
			ty_position position[REFERENCE_MAX];
			uint64_t keys[REFERENCE_MAX];
			ty_stop stop = {(size_t) random_between(&random, 1, (int64_t) n), 0};
			ty_barrier_lines lines;
			ty_barriers barriers;
			ty_influence influence = {.crosses = ty_barriers_bar, .fetch = ty_barriers_fetch, .barriers = &barriers};
			const char *difference;

			small_set(kind, &random, position, n);
			sort_along_curve(position, keys, n);
			make_lines_among(&random, position, n);
			gather(&ty_plain_environment, &lines);
			NEED(ty_barriers_fit(&ty_plain_environment, &lines, &grid, position, n, &barriers) == TY_OK, "fit");
			if (round % 2)
				stop.min_distance = ldexp(1.0, (int) random_between(&random, 0, 29));
			difference = compare_with_reference(position, n, s_us[round % 3], &influence, stop, REFERENCE_MESH);
			CHECK(difference == NULL, "%s, n %zu: %s", small_kind_name[kind], n, difference);
			free_both(&lines, &barriers);
		}
}

#define FLOCK 3000

/* Every merge of a large group, as the specification says where it goes: no way of a member crosses a barrier. */
static void
no_member_is_carried_across(void)
{
	static ty_position position[FLOCK], place[FLOCK];
	static uint64_t keys[FLOCK];
	static int64_t sum_x[FLOCK], sum_y[FLOCK], size[FLOCK];
	random_state random = random_seed(12);
	ty_grid grid = grid_of(1, 0, 0);
	ty_barrier_lines lines;
	ty_barriers barriers;
	ty_influence influence = {.crosses = ty_barriers_bar, .fetch = ty_barriers_fetch, .barriers = &barriers};
	ty_sequence sequence;
	double side = 20000;

	for (size_t i = 0; i < FLOCK; i++)
	{
		ty_point p = somewhere(&random, side);

		position[i] = (ty_position){(int32_t) p.x, (int32_t) p.y};
	}
	sort_along_curve(position, keys, FLOCK);
	make_lines(&random, 1500, side);
	gather(&ty_plain_environment, &lines);
	NEED(ty_barriers_fit(&ty_plain_environment, &lines, &grid, position, FLOCK, &barriers) == TY_OK, "fit");
	for (size_t i = 0; i < FLOCK; i++)
	{
		place[i] = position[i];
		sum_x[i] = position[i].x;
		sum_y[i] = position[i].y;
		size[i] = 1;
	}
	NEED(ty_collapse(&ty_plain_environment, position, FLOCK, 0.5, &influence, (ty_stop){1, 0}, false, NULL, NULL,
					 &sequence) == TY_OK,
		 "collapse");
	CHECK(sequence.count > FLOCK / 2 && sequence.count < FLOCK - 10, "%zu merges", sequence.count);
	for (size_t i = 0; i < sequence.count; i++)
	{
		uint32_t a = sequence.kept[i], b = sequence.gone[i];
		ty_position m;

		sum_x[a] += sum_x[b];
		sum_y[a] += sum_y[b];
		size[a] += size[b];
		m = (ty_position){(int32_t) ((2 * sum_x[a] + size[a]) / (2 * size[a])),
						  (int32_t) ((2 * sum_y[a] + size[a]) / (2 * size[a]))};
		CHECK(!reference_cross_any(place[a], m) && !reference_cross_any(place[b], m), "merge %zu crosses", i);
		place[a] = m;
	}
	ty_sequence_free(&ty_plain_environment, &sequence);
	free_both(&lines, &barriers);
}

int
main(int argc, char **argv)
{
	check_begin(argc, argv);
	RUN(the_way_over_the_merged_place);
	RUN(merges_equal_the_reference);
	RUN(no_member_is_carried_across);
	return check_end();
}
