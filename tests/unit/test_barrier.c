/*
 * test_barrier.c - the fear: a barrier is crossed, by an edge that only touches it, through the joint of two lines, at
 * the end of the index or of the grid; or one that is far away costs or bars.
 */
#include "barrier_world.h"
#include "counting.h"

#include <math.h>
#include <stdlib.h>

/* ---- the reference: exact, slow, and with real moves in place of infinitesimal ones ---- */

/* coordinates below 40: a move by (1/1000, 1/1000000) passes nothing that an infinitesimal one would not */
static wide_point
scaled(ty_position p, bool moved)
{
	return (wide_point){(wide) p.x * 1000000 + (moved ? 1000 : 0), (wide) p.y * 1000000 + (moved ? 1 : 0)};
}

/* proper crossing; *touch is set where the two meet without one, which must not happen */
static bool
cross_properly(ty_position a, ty_position b, ty_position c, ty_position d, bool *touch)
{
	wide_point p = scaled(a, true), q = scaled(b, true), u = scaled(c, false), v = scaled(d, false);
	int u_side = sign_of_turn(p, q, u), v_side = sign_of_turn(p, q, v);
	int p_side = sign_of_turn(u, v, p), q_side = sign_of_turn(u, v, q);

	*touch = u_side * v_side * p_side * q_side == 0;
	return u_side * v_side < 0 && p_side * q_side < 0;
}

/* ---- one segment ---- */

static void
fit_points(const ty_point *points, uint32_t n, const ty_position *box, size_t box_count, ty_barrier_lines *lines,
		   ty_barriers *barriers)
{
	ty_grid grid = grid_of(1, 0, 0);

	ty_barrier_lines_begin(lines, &ty_plain_environment);
	CHECK(ty_barrier_lines_add(lines, points, sizeof *points, n) == TY_OK, "add");
	CHECK(ty_barrier_lines_end(lines) == TY_OK, "end");
	CHECK(ty_barriers_fit(&ty_plain_environment, lines, &grid, box, box_count, barriers) == TY_OK, "fit");
}

/* every edge against every segment of a lattice: touching, along it, through its ends, on its end */
static void
every_case_on_a_small_lattice(void)
{
	enum
	{
		N = 4
	};
	const ty_position corners[2] = {{0, 0}, {N - 1, N - 1}};
	size_t crossed = 0;

	for (int s = 0; s < N * N * N * N; s++)
	{
		ty_position c = {s % N, s / N % N}, d = {s / (N * N) % N, s / (N * N * N)};
		ty_point ends[2] = {{c.x, c.y}, {d.x, d.y}};
		ty_barrier_lines lines;
		ty_barriers barriers;

		fit_points(ends, 2, corners, 2, &lines, &barriers);
		for (int e = 0; e < N * N * N * N; e++)
		{
			ty_position a = {e % N, e / N % N}, b = {e / (N * N) % N, e / (N * N * N)};
			bool touch, expected = cross_properly(a, b, c, d, &touch);
			bool same = (a.x == b.x && a.y == b.y) || (c.x == d.x && c.y == d.y);

			CHECK(same || !touch, "touching after the move: %d", e);
			CHECK(ty_barriers_cross(&barriers, a, b) == (expected && !same),
				  "(%d %d, %d %d) across (%d %d, %d %d), expected %d", a.x, a.y, b.x, b.y, c.x, c.y, d.x, d.y,
				  expected);
			CHECK(ty_barriers_cross(&barriers, b, a) == ty_barriers_cross(&barriers, a, b), "not the same way back");
			crossed += expected;
		}
		free_both(&lines, &barriers);
	}
	CHECK(crossed > 5000, "only %zu crossings", crossed);
}

/* closed lines part what is inside from what is outside: an edge crosses them an odd number of times, or an even one */
static void
nothing_leaks_through_joints(void)
{
	random_state random = random_seed(1);

	for (int round = 0; round < 300; round++)
	{
		ty_point ring[LINE_MOST + 1];
		ty_position corners[2] = {{0, 0}, {12, 12}};
		uint32_t n = (uint32_t) random_between(&random, 3, LINE_MOST);
		ty_barrier_lines lines[LINE_MOST];
		ty_barriers barriers[LINE_MOST];

		for (uint32_t i = 0; i < n; i++)
			ring[i] = (ty_point){(double) random_between(&random, 0, 12), (double) random_between(&random, 0, 12)};
		ring[n] = ring[0];
		for (uint32_t i = 0; i < n; i++)
			fit_points(ring + i, 2, corners, 2, &lines[i], &barriers[i]);
		for (int t = 0; t < 100; t++)
		{
			ty_position p[3];
			int crossings = 0;

			for (int i = 0; i < 3; i++)
				p[i] =
					(ty_position){(int32_t) random_between(&random, 0, 12), (int32_t) random_between(&random, 0, 12)};
			for (uint32_t i = 0; i < n; i++)
				for (int k = 0; k < 3; k++)
					crossings += ty_barriers_cross(&barriers[i], p[k], p[(k + 1) % 3]);
			CHECK(crossings % 2 == 0, "%d crossings on the way around (%d %d, %d %d, %d %d)", crossings, p[0].x, p[0].y,
				  p[1].x, p[1].y, p[2].x, p[2].y);
		}
		for (uint32_t i = 0; i < n; i++)
			free_both(&lines[i], &barriers[i]);
	}
}

/* ---- many segments ---- */

#define PLACES 500 /* enough of them for squares */

static void
as_if_every_segment_were_tried(void)
{
	random_state random = random_seed(2);
	const size_t sizes[] = {41, 60, 200, 1000, MOST_POINTS};
	const double sides[] = {30, 1000, (double) (1 << 20), (double) SIDE};
	size_t crossed = 0, asked = 0, by_squares = 0;

	for (size_t k = 0; k < 20; k++)
	{
		double side = sides[k % 4];
		ty_position places[PLACES] = {{0, 0}, {(int32_t) side, (int32_t) side}};
		ty_grid grid = grid_of(1, 0, 0);
		ty_barrier_lines lines;
		ty_barriers barriers;

		make_lines(&random, sizes[k / 4], side);
		gather(&ty_plain_environment, &lines);
		CHECK(ty_barriers_fit(&ty_plain_environment, &lines, &grid, places, PLACES, &barriers) == TY_OK, "fit");
		for (int t = 0; t < 3000; t++)
		{
			double step = side * pow(2, -(double) random_between(&random, 0, 14));
			ty_point from = somewhere(&random, side);
			ty_position a = {(int32_t) from.x, (int32_t) from.y}, b;
			bool expected;

			if (t % 3 == 0) /* on a barrier's end */
				a = (ty_position){(int32_t) all.points[t % all.used].x, (int32_t) all.points[t % all.used].y};
			b = (ty_position){on_side(a.x + (random_unit(&random) - 0.5) * step, side),
							  on_side(a.y + (random_unit(&random) - 0.5) * step, side)};
			expected = reference_cross_any(a, b);
			CHECK(ty_barriers_cross(&barriers, a, b) == expected, "set %zu: (%d %d, %d %d), expected %d", k, a.x, a.y,
				  b.x, b.y, expected);
			crossed += expected;
			by_squares += ty_barrier_squares_serve(
				&barriers.squares,
				ty_barrier_span_of(&barriers.squares, (ty_position){a.x < b.x ? a.x : b.x, a.y < b.y ? a.y : b.y},
								   (ty_position){a.x < b.x ? b.x : a.x, a.y < b.y ? b.y : a.y}));
			asked++;
		}
		free_both(&lines, &barriers);
	}
	CHECK(crossed > asked / 10 && crossed < asked - asked / 10, "%zu of %zu crossed", crossed, asked);
	CHECK(by_squares > asked / 10 && by_squares < asked / 2, "%zu of %zu were looked for in squares", by_squares,
		  asked);
}

/* Many segments that are about as far from a place as one another are listed in order, too. */
static void
many_on_one_spot(void)
{
	enum
	{
		LINES = 30000
	};
	random_state random = random_seed(7);
	ty_point *ends = malloc(2 * LINES * sizeof *ends);
	ty_barrier_lines lines;
	ty_segments near = {0};
	size_t unsorted = 0;

	ty_barrier_lines_begin(&lines, &ty_plain_environment);
	for (size_t l = 0; l < LINES; l++)
	{
		ends[2 * l] = (ty_point){1000 + random_unit(&random), random_unit(&random)};
		ends[2 * l + 1] = (ty_point){1001 + random_unit(&random), random_unit(&random)};
		CHECK(ty_barrier_lines_add(&lines, ends + 2 * l, sizeof *ends, 2) == TY_OK, "line %zu", l);
	}
	CHECK(ty_barrier_lines_end(&lines) == TY_OK, "end");
	CHECK(ty_barrier_lines_near(&lines, (ty_point){0, 0}, 2000, &near) == TY_OK, "near");
	CHECK(near.count == LINES, "%zu of %d are listed", near.count, LINES);
	for (size_t k = 1; k < near.count; k++)
		unsorted += near.distance[k] < near.distance[k - 1];
	CHECK(unsorted == 0, "%zu are nearer than the one before", unsorted);
	CHECK(near.distance[0] >= 999 && near.distance[LINES - 1] <= 1002, "from %g to %g", near.distance[0],
		  near.distance[LINES - 1]);
	ty_release(lines.env, near.number);
	ty_release(lines.env, near.distance);
	ty_barrier_lines_free(&lines);
	free(ends);
}

/* Lines that go far beyond the grid: what crosses clearly still does, and nothing else. */
static void
lines_beyond_the_grid(void)
{
	random_state random = random_seed(3);
	const double reach[] = {30, 100, 1e6, 1e12, 1e30, 1e290};
	size_t crossed = 0;

	for (int round = 0; round < 3000; round++)
	{
		double r = reach[round % 6] * (double) SIDE;
		ty_point m = somewhere(&random, (double) SIDE), end[2];
		double dx = random_unit(&random) - 0.5, dy = random_unit(&random) - 0.5;
		ty_position corners[2] = {{0, 0}, {(int32_t) SIDE, (int32_t) SIDE}}, a, b;
		ty_barrier_lines lines;
		ty_barriers barriers;
		ty_point p = somewhere(&random, (double) SIDE), q = somewhere(&random, (double) SIDE);
		double at_p = (p.y - m.y) * dx - (p.x - m.x) * dy, at_q = (q.y - m.y) * dx - (q.x - m.x) * dy;

		end[0] = (ty_point){m.x - r * dx, m.y - r * dy};
		end[1] = (ty_point){m.x + r * dx, m.y + r * dy};
		a = (ty_position){(int32_t) p.x, (int32_t) p.y};
		b = (ty_position){(int32_t) q.x, (int32_t) q.y};
		fit_points(end, 2, corners, 2, &lines, &barriers);
		/* ends as far away as 1e30 do not tell where the line passes */
		if (round % 6 < 4 && fabs(at_p) > 1e-3 * (double) SIDE * 0.5 && fabs(at_q) > 1e-3 * (double) SIDE * 0.5 &&
			fabs(dx) + fabs(dy) > 0.1)
		{
			CHECK(barriers.count == 1, "%zu segments", barriers.count);
			CHECK(ty_barriers_cross(&barriers, a, b) == ((at_p > 0) != (at_q > 0)), "round %d", round);
			crossed += (at_p > 0) != (at_q > 0);
		}
		else
			ty_barriers_cross(&barriers, a, b);
		free_both(&lines, &barriers);
	}
	CHECK(crossed > 200, "only %zu crossings", crossed);
}

/* a group's box keeps off what is elsewhere; what is kept answers as all would */
static void
the_box_of_the_group(void)
{
	random_state random = random_seed(4);
	ty_grid grid = grid_of(0.25, 500000, 5000000);
	ty_barrier_lines lines;
	ty_barriers barriers;
	ty_position box[2] = {{1000, 2000}, {1400, 2100}};

	make_lines(&random, MOST_POINTS, 4000);
	for (size_t i = 0; i < all.used; i++)
		all.points[i] = (ty_point){500000 + all.points[i].x / 4, 5000000 + all.points[i].y / 4};
	gather(&ty_plain_environment, &lines);
	NEED(ty_barriers_fit(&ty_plain_environment, &lines, &grid, box, 2, &barriers) == TY_OK, "fit");
	CHECK(barriers.count > 0 && barriers.count < lines.segments / 4, "%zu of %zu segments", barriers.count,
		  lines.segments);
	for (size_t i = 0; i < all.used; i++)
		all.points[i] = (ty_point){(all.points[i].x - 500000) * 4, (all.points[i].y - 5000000) * 4};
	for (int t = 0; t < 3000; t++)
	{
		ty_position a = {(int32_t) random_between(&random, 1000, 1400), (int32_t) random_between(&random, 2000, 2100)};
		ty_position b = {(int32_t) random_between(&random, 1000, 1400), (int32_t) random_between(&random, 2000, 2100)};

		CHECK(ty_barriers_cross(&barriers, a, b) == reference_cross_any(a, b), "(%d %d, %d %d)", a.x, a.y, b.x, b.y);
	}
	free_both(&lines, &barriers);
	box[0] = box[1] = (ty_position){1 << 29, 1 << 29};
	gather(&ty_plain_environment, &lines);
	NEED(ty_barriers_fit(&ty_plain_environment, &lines, &grid, box, 2, &barriers) == TY_OK, "fit");
	CHECK(barriers.count == 0, "%zu segments far away", barriers.count);
	CHECK(!ty_barriers_cross(&barriers, box[0], (ty_position){0, 0}), "crossed nothing");
	free_both(&lines, &barriers);
}

/* ---- what is handed over ---- */

static void
the_order_of_lines_does_not_matter(void)
{
	random_state random = random_seed(5);
	ty_grid grid = grid_of(1, 0, 0);
	ty_position corners[2] = {{0, 0}, {1 << 20, 1 << 20}};
	ty_barrier_lines forth, back;
	ty_barriers a, b;
	size_t different = 0;

	make_lines(&random, MOST_POINTS, 1 << 20);
	gather(&ty_plain_environment, &forth);
	ty_barrier_lines_begin(&back, &ty_plain_environment);
	for (size_t l = all.lines; l-- > 0;)
		CHECK(ty_barrier_lines_add(&back, all.points + all.first[l], sizeof(ty_point), all.count[l]) == TY_OK, "add");
	CHECK(ty_barrier_lines_end(&back) == TY_OK, "end");
	CHECK(ty_barriers_fit(&ty_plain_environment, &forth, &grid, corners, 2, &a) == TY_OK, "fit");
	CHECK(ty_barriers_fit(&ty_plain_environment, &back, &grid, corners, 2, &b) == TY_OK, "fit");
	CHECK(a.count == b.count, "%zu and %zu segments", a.count, b.count);
	for (int t = 0; t < 10000; t++)
	{
		ty_position p = {(int32_t) random_between(&random, 0, 1 << 20), (int32_t) random_between(&random, 0, 1 << 20)};
		ty_position q = {(int32_t) random_between(&random, 0, 1 << 20), (int32_t) random_between(&random, 0, 1 << 20)};

		different += ty_barriers_cross(&a, p, q) != ty_barriers_cross(&b, p, q);
	}
	CHECK(different == 0, "%zu answers differ", different);
	free_both(&forth, &a);
	free_both(&back, &b);
}

static void
strides_and_alignment(void)
{
	unsigned char bytes[1 + 3 * 32];
	const double river[3][4] = {{0, 5, NAN, 1}, {4, 5, INFINITY, 2}, {10, 6, 3, 3}};
	ty_grid grid = grid_of(1, 0, 0);
	ty_position corners[2] = {{0, 0}, {10, 10}};
	ty_barrier_lines lines;
	ty_barriers barriers;

	memcpy(bytes + 1, river, sizeof river);
	ty_barrier_lines_begin(&lines, &ty_plain_environment);
	CHECK(ty_barrier_lines_add(&lines, bytes + 1, 32, 3) == TY_OK, "Z and M may be anything");
	CHECK(ty_barrier_lines_end(&lines) == TY_OK, "end");
	CHECK(ty_barriers_fit(&ty_plain_environment, &lines, &grid, corners, 2, &barriers) == TY_OK, "fit");
	CHECK(ty_barriers_cross(&barriers, (ty_position){2, 4}, (ty_position){2, 6}), "not crossed at 2");
	CHECK(ty_barriers_cross(&barriers, (ty_position){8, 4}, (ty_position){8, 7}), "not crossed at 8");
	CHECK(!ty_barriers_cross(&barriers, (ty_position){2, 4}, (ty_position){8, 4}), "crossed below");
	free_both(&lines, &barriers);
}

static void
not_finite_and_nothing(void)
{
	const ty_point wrong[3] = {{0, 0}, {1, NAN}, {2, 2}}, far[2] = {{0, 0}, {-INFINITY, 2}};
	ty_position box = {0, 0};
	ty_grid grid = grid_of(1, 0, 0);
	ty_barrier_lines lines;
	ty_barriers barriers;

	ty_barrier_lines_begin(&lines, &ty_plain_environment);
	CHECK(ty_barrier_lines_add(&lines, wrong, sizeof *wrong, 3) == TY_NOT_FINITE, "NaN");
	CHECK(ty_barrier_lines_add(&lines, far, sizeof *far, 2) == TY_NOT_FINITE, "-Infinity");
	CHECK(ty_barrier_lines_add(&lines, wrong, sizeof *wrong, 1) == TY_OK, "one point");
	CHECK(ty_barrier_lines_add(&lines, wrong, sizeof *wrong, 0) == TY_OK, "no point");
	CHECK(ty_barrier_lines_end(&lines) == TY_OK && lines.segments == 0, "%zu segments", lines.segments);
	CHECK(ty_barriers_fit(&ty_plain_environment, &lines, &grid, &box, 1, &barriers) == TY_OK, "fit");
	CHECK(!ty_barriers_cross(&barriers, box, (ty_position){5, 5}), "crossed");
	CHECK(ty_barrier_lines_gap(&lines, wrong, 1, 7).distance == 7, "a gap to nothing");
	free_both(&lines, &barriers);
}

/* ---- gaps ---- */

static double
point_to_line(ty_point p, ty_point a, ty_point b)
{
	double dx = b.x - a.x, dy = b.y - a.y, l = dx * dx + dy * dy;
	double t = l > 0 ? fmin(fmax(((p.x - a.x) * dx + (p.y - a.y) * dy) / l, 0), 1) : 0;

	return hypot(p.x - a.x - t * dx, p.y - a.y - t * dy);
}

static double
side_of(ty_point a, ty_point b, ty_point c)
{
	return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

static double
reference_gap(const ty_point *corner, int count, ty_point a, ty_point b)
{
	double gap = INFINITY;
	bool inside = count > 2;

	for (int i = 0; i < count; i++)
	{
		ty_point c = corner[i], d = corner[(i + 1) % count];

		gap = fmin(gap, fmin(fmin(point_to_line(a, c, d), point_to_line(b, c, d)), point_to_line(c, a, b)));
		if (side_of(a, b, c) * side_of(a, b, d) < 0 && side_of(c, d, a) * side_of(c, d, b) < 0)
			gap = 0;
		inside = inside && side_of(c, d, a) > 0;
	}
	return inside ? 0 : gap;
}

static void
gaps_as_if_every_segment_were_measured(void)
{
	random_state random = random_seed(6);
	ty_barrier_lines lines;
	size_t zero = 0, beyond = 0;

	make_lines(&random, MOST_POINTS, 10000);
	gather(&ty_plain_environment, &lines);
	for (int t = 0; t < 2000; t++)
	{
		ty_point m = somewhere(&random, 10000), corner[4];
		double ux = random_unit(&random), uy = sqrt(1 - ux * ux), w = 60 * random_unit(&random),
			   h = 30 * random_unit(&random);
		int count = t % 4 == 3 ? 4 : t % 4 == 2 ? 3 : t % 4 + 1;
		double limit = 10 + 150 * random_unit(&random), expected = limit;
		ty_barrier_gap gap;

		corner[0] = (ty_point){m.x - ux * w + uy * h, m.y - uy * w - ux * h};
		corner[1] = (ty_point){m.x + ux * w + uy * h, m.y + uy * w - ux * h};
		corner[2] = (ty_point){m.x + ux * w - uy * h, m.y + uy * w + ux * h};
		corner[3] = (ty_point){m.x - ux * w - uy * h, m.y - uy * w + ux * h};
		for (size_t l = 0; l < all.lines; l++)
			for (uint32_t i = 1; i < all.count[l]; i++)
				expected = fmin(expected, reference_gap(corner, count, all.points[all.first[l] + i - 1],
														all.points[all.first[l] + i]));
		gap = ty_barrier_lines_gap(&lines, corner, count, limit);
		CHECK(fabs(gap.distance - expected) <= 1e-9 * 10000, "%d corners: %.17g, expected %.17g", count, gap.distance,
			  expected);
		if (gap.distance > 0 && gap.distance < limit)
		{
			CHECK(fabs(hypot(gap.shape.x - gap.line.x, gap.shape.y - gap.line.y) - gap.distance) < 1e-9,
				  "points apart");
		}
		zero += gap.distance == 0;
		beyond += gap.distance == limit;
	}
	CHECK(zero > 100 && beyond > 100 && zero + beyond < 1900, "%zu meet, %zu are beyond", zero, beyond);
	ty_barrier_lines_free(&lines);
}

static void
on_the_ground_as_on_the_grid(void)
{
	random_state random = random_seed(7);
	ty_position corners[2] = {{0, 0}, {10000, 10000}};
	ty_grid grid = grid_of(1, 0, 0);
	ty_barrier_lines lines;
	ty_barriers barriers;

	make_lines(&random, MOST_POINTS, 10000);
	gather(&ty_plain_environment, &lines);
	NEED(ty_barriers_fit(&ty_plain_environment, &lines, &grid, corners, 2, &barriers) == TY_OK, "fit");
	for (int t = 0; t < 5000; t++)
	{
		ty_point p = t % 2 ? all.points[t % all.used] : somewhere(&random, 10000), q = somewhere(&random, 10000);
		ty_position a = {(int32_t) p.x, (int32_t) p.y}, b;

		if (t % 3)
			q = (ty_point){fmin(p.x + t % 100, 10000), fmin(p.y + t % 77, 10000)};
		b = (ty_position){(int32_t) q.x, (int32_t) q.y};
		CHECK(ty_barrier_lines_cross(&lines, p, q) == ty_barriers_cross(&barriers, a, b), "(%d %d, %d %d)", a.x, a.y,
			  b.x, b.y);
	}
	free_both(&lines, &barriers);
}

/* ---- cost ---- */

static void
memory_is_given_back(void)
{
	random_state random = random_seed(8);
	counting counter;
	ty_environment env = counting_environment(&counter);
	ty_position places[PLACES] = {{0, 0}, {1000, 1000}};
	ty_grid grid = grid_of(1, 0, 0);
	ty_barrier_lines lines;
	ty_barriers barriers;
	size_t of_lines;

	make_lines(&random, MOST_POINTS, 1000);
	gather(&env, &lines);
	of_lines = counter.used;
	CHECK(of_lines < 32 * lines.segments, "%zu bytes for %zu segments", of_lines, lines.segments);
	CHECK(ty_barriers_fit(&env, &lines, &grid, places, PLACES, &barriers) == TY_OK, "fit");
	CHECK(counter.used - of_lines < 32 * lines.segments, "%zu bytes for %zu segments", counter.used - of_lines,
		  lines.segments);
	free_both(&lines, &barriers);
	CHECK(counter.used == 0, "%zu bytes left", counter.used);
}

static void
every_allocation_may_fail(void)
{
	random_state random = random_seed(9);
	ty_position places[PLACES] = {{0, 0}, {1000, 1000}};
	ty_grid grid = grid_of(1, 0, 0);
	size_t failed = 0;
	bool all_went_well = false;

	make_lines(&random, MOST_POINTS, 1000);
	for (size_t failing = 1; !all_went_well; failing++)
	{
		counting counter;
		ty_environment env = counting_environment(&counter);
		ty_barrier_lines lines;
		ty_barriers barriers = {.env = &env};
		ty_status status = TY_OK;

		counter.failing = failing;
		ty_barrier_lines_begin(&lines, &env);
		for (size_t l = 0; l < all.lines && status == TY_OK; l++)
			status = ty_barrier_lines_add(&lines, all.points + all.first[l], sizeof(ty_point), all.count[l]);
		if (status == TY_OK)
			status = ty_barrier_lines_end(&lines);
		if (status == TY_OK)
			status = ty_barriers_fit(&env, &lines, &grid, places, PLACES, &barriers);
		CHECK(status == TY_OK || status == TY_NO_MEMORY, "status %d", status);
		all_went_well = status == TY_OK;
		failed += status == TY_NO_MEMORY;
		free_both(&lines, &barriers);
		CHECK(counter.used == 0, "%zu bytes left", counter.used);
	}
	CHECK(failed > 10, "only %zu failures", failed);
}

int
main(int argc, char **argv)
{
	check_begin(argc, argv);
	RUN(every_case_on_a_small_lattice);
	RUN(nothing_leaks_through_joints);
	RUN(as_if_every_segment_were_tried);
	RUN(many_on_one_spot);
	RUN(lines_beyond_the_grid);
	RUN(the_box_of_the_group);
	RUN(the_order_of_lines_does_not_matter);
	RUN(strides_and_alignment);
	RUN(not_finite_and_nothing);
	RUN(gaps_as_if_every_segment_were_measured);
	RUN(on_the_ground_as_on_the_grid);
	RUN(memory_is_given_back);
	RUN(every_allocation_may_fail);
	return check_end();
}
