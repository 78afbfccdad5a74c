/*
 * test_measure.c - the fear: a building is measured otherwise when its ring starts elsewhere, runs the other way,
 * lies far from the origin, repeats points, crosses itself or is no polygon at all.
 */
#include "check.h"
#include "measure.h"
#include "random.h"

#include <math.h>
#include <stdlib.h>

#define MAX_POINTS 512
#define NEAR(value, expected, tolerance) \
	CHECK(fabs((value) - (expected)) <= (tolerance), "%.17g instead of %.17g", (double) (value), (double) (expected))

static ty_measure measure;

static void
begin(void)
{
	ty_measure_begin(&measure, &ty_plain_environment);
}

static void
ring(const ty_point *points, size_t n, bool shell)
{
	ty_measure_ring(&measure, points, sizeof *points, (uint32_t) n, shell);
}

static ty_building
end(void)
{
	ty_building b = {0, 0, 0, 0, 0, 0, 0};
	ty_status status = ty_measure_end(&measure, &b);

	CHECK(status == TY_OK, "status %d", status);
	return b;
}

static ty_building
measure_shell(const ty_point *points, size_t n)
{
	begin();
	ring(points, n, true);
	return end();
}

#define POINTS(...) (const ty_point[]){__VA_ARGS__}, sizeof((const ty_point[]){__VA_ARGS__}) / sizeof(ty_point)
#define SHELL(...) measure_shell(POINTS(__VA_ARGS__))
#define HOLE(...) ring(POINTS(__VA_ARGS__), false)

static void
check_building(const char *what, ty_building b, double x, double y, double area, double ratio, double ux, double uy)
{
	CHECK(fabs(b.x - x) < 1e-9 && fabs(b.y - y) < 1e-9, "%s: centroid %.17g %.17g", what, b.x, b.y);
	CHECK(fabs(b.area - area) < 1e-9, "%s: area %.17g", what, b.area);
	CHECK(fabs(b.ratio - ratio) < 1e-12, "%s: ratio %.17g", what, b.ratio);
	CHECK(fabs(b.ux - ux) < 1e-12 && fabs(b.uy - uy) < 1e-12, "%s: direction %.17g %.17g", what, b.ux, b.uy);
	CHECK(b.uy > 0 || (b.uy == 0 && b.ux == 1), "%s: direction %.17g %.17g is not in [0, 180)", what, b.ux, b.uy);
	CHECK(b.ratio > 0 && b.ratio <= 1, "%s: ratio %.17g", what, b.ratio);
}

static void
plain_shapes(void)
{
	check_building("4 x 2", SHELL({0, 0}, {4, 0}, {4, 2}, {0, 2}, {0, 0}), 2, 1, 8, 0.5, 1, 0);
	check_building("2 x 4", SHELL({0, 0}, {2, 0}, {2, 4}, {0, 4}, {0, 0}), 1, 2, 8, 0.5, 0, 1);
	check_building("not closed", SHELL({0, 0}, {4, 0}, {4, 2}, {0, 2}), 2, 1, 8, 0.5, 1, 0);
	check_building("clockwise", SHELL({0, 0}, {0, 2}, {4, 2}, {4, 0}, {0, 0}), 2, 1, 8, 0.5, 1, 0);
	check_building("turned by (3, 4)", SHELL({0, 0}, {6, 8}, {2, 11}, {-4, 3}, {0, 0}), 1, 5.5, 50, 0.5, 0.6, 0.8);
	check_building("turned by (-4, 3)", SHELL({0, 0}, {-8, 6}, {-11, 2}, {-3, -4}, {0, 0}), -5.5, 1, 50, 0.5, -0.8,
				   0.6);
	check_building("L", SHELL({0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 3}, {0, 3}, {0, 0}), 1.5, 1, 6, 0.75, 1, 0);
}

static void
a_square_has_a_direction_of_its_own_whatever_the_start(void)
{
	const ty_point square[] = {{0, 0}, {3, 4}, {-1, 7}, {-4, 3}, {0, 0}, {3, 4}, {-1, 7}, {-4, 3}};
	ty_building first = measure_shell(square, 4);

	for (size_t start = 1; start < 4; start++)
	{
		ty_building b = measure_shell(square + start, 4);

		CHECK(b.ratio == first.ratio && b.ux == first.ux && b.uy == first.uy, "from %zu: %a %a, from 0: %a %a", start,
			  b.ux, b.uy, first.ux, first.uy);
	}
	NEAR(first.ratio, 1, 1e-12);
	NEAR(fabs(first.ux), 0.6 * (fabs(first.uy) > 0.7) + 0.8 * (fabs(first.uy) < 0.7), 1e-12);
}

static void
holes_are_taken_away_whichever_way_they_run(void)
{
	for (int way = 0; way < 2; way++)
	{
		begin();
		ring((const ty_point[]){{0, 0}, {10, 0}, {10, 10}, {0, 10}, {0, 0}}, 5, true);
		if (way == 0)
			HOLE({1, 1}, {6, 1}, {6, 6}, {1, 6}, {1, 1});
		else
			HOLE({1, 1}, {1, 6}, {6, 6}, {6, 1}, {1, 1});
		/* (100 * 5 - 25 * 3.5) / 75 */
		check_building("holed", end(), 5.5, 5.5, 75, 1, 1, 0);
	}
}

static void
a_hole_larger_than_its_shell_does_not_make_area_negative(void)
{
	ty_building b;

	begin();
	ring((const ty_point[]){{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}}, 5, true);
	HOLE({0, 0}, {9, 0}, {9, 9}, {0, 9}, {0, 0});
	b = end();
	CHECK(b.area >= 0, "area %.17g", b.area);
	CHECK(isfinite(b.x) && isfinite(b.y), "centroid %.17g %.17g", b.x, b.y);
}

static void
parts_add_up_even_of_opposite_directions(void)
{
	begin();
	ring((const ty_point[]){{0, 0}, {2, 0}, {2, 2}, {0, 2}, {0, 0}}, 5, true);
	ring((const ty_point[]){{10, 0}, {10, 2}, {12, 2}, {12, 0}, {10, 0}}, 5, true);
	check_building("two squares", end(), 6, 1, 8, 2.0 / 12, 1, 0);
}

static void
the_highest_dimension_gives_the_centroid(void)
{
	const ty_point line[] = {{100, 0}, {104, 0}};
	const ty_point point = {-50, 0};
	ty_building b;

	begin();
	ty_measure_point(&measure, &point);
	ty_measure_line(&measure, line, sizeof *line, 2);
	b = end();
	CHECK(b.x == 102 && b.y == 0 && b.area == 0, "line before point: %g %g", b.x, b.y);
	begin();
	ty_measure_point(&measure, &point);
	ty_measure_line(&measure, line, sizeof *line, 2);
	ring((const ty_point[]){{0, 0}, {2, 0}, {2, 2}, {0, 2}, {0, 0}}, 5, true);
	b = end();
	NEAR(b.x, 1, 1e-12);
	NEAR(b.y, 1, 1e-12);
	NEAR(b.area, 4, 1e-12);
}

static void
points_weigh_the_same_each(void)
{
	const ty_point points[] = {{0, 0}, {0, 0}, {3, 6}};

	begin();
	for (size_t i = 0; i < 3; i++)
		ty_measure_point(&measure, &points[i]);
	ty_building b = end();
	NEAR(b.x, 1, 1e-12);
	NEAR(b.y, 2, 1e-12);
	CHECK(b.area == 0 && b.ratio == 1, "area %g, ratio %g: 0 / anything counts as 1", b.area, b.ratio);
	begin();
	ty_measure_point(&measure, &points[2]);
	check_building("one point", end(), 3, 6, 0, 1, 1, 0);
}

static void
lines_weigh_by_length(void)
{
	const ty_point line[] = {{0, 0}, {3, 0}, {3, 1}};

	begin();
	ty_measure_line(&measure, line, sizeof *line, 3);
	ty_building b = end();
	NEAR(b.x, (3 * 1.5 + 1 * 3) / 4, 1e-12);
	NEAR(b.y, (1 * 0.5) / 4, 1e-12);
	CHECK(b.area == 0, "area %g", b.area);
	/* a line without length is a point */
	begin();
	ty_measure_line(&measure, (const ty_point[]){{5, 5}, {5, 5}}, sizeof *line, 2);
	check_building("no length", end(), 5, 5, 0, 1, 1, 0);
}

static void
polygons_without_area_are_lines_and_those_without_length_points(void)
{
	ty_building b = SHELL({0, 0}, {6, 8}, {3, 4}, {0, 0});

	NEAR(b.x, 3, 1e-12);
	NEAR(b.y, 4, 1e-12);
	NEAR(b.ux, 0.6, 1e-12);
	NEAR(b.uy, 0.8, 1e-12);
	CHECK(b.area == 0 && b.ratio == 1, "area %g, ratio %g: 0 counts as 1", b.area, b.ratio);
	check_building("all equal", SHELL({7, 7}, {7, 7}, {7, 7}, {7, 7}), 7, 7, 0, 1, 1, 0);
	check_building("one point", SHELL({7, 7}), 7, 7, 0, 1, 1, 0);
	/* the mean along the ring, which is run through there and back */
	b = SHELL({0, 0}, {1, 0}, {4, 0}, {0, 0});
	NEAR(b.x, 2, 1e-12);
}

static void
a_bow_tie_keeps_its_centroid_in_its_box(void)
{
	/* nearly balanced lobes: the quotient of the shoelace sums lies far outside */
	ty_building b = SHELL({0, 0}, {10, 10}, {10, 0}, {0, 10.1}, {0, 0});

	CHECK(b.x >= 0 && b.x <= 10 && b.y >= 0 && b.y <= 10.1, "centroid %g %g", b.x, b.y);
	CHECK(b.area >= 0, "area %g", b.area);
	b = SHELL({0, 0}, {10, 10}, {10, 0}, {0, 12}, {0, 0});
	CHECK(b.x >= 0 && b.x <= 10 && b.y >= 0 && b.y <= 12, "centroid %g %g", b.x, b.y);
	/* exactly balanced: no area, so its outline counts */
	b = SHELL({0, 0}, {10, 10}, {10, 0}, {0, 10}, {0, 0});
	CHECK(b.area == 0, "area %g", b.area);
	NEAR(b.x, 5, 1e-12);
	NEAR(b.y, 5, 1e-12);
}

static void
a_centroid_outside_the_box_becomes_the_boxes_centre(void)
{
	/* areas +0.5 and -0.495: the quotient is 100 times as far as either lobe */
	ty_building b = SHELL({0, 0}, {1, 1}, {2, 0.01}, {2, 0.99}, {1, 0}, {0, 1}, {0, 0});

	CHECK(b.x >= 0 && b.x <= 2 && b.y >= 0 && b.y <= 1, "centroid %g %g", b.x, b.y);
	/* two triangles, the second run the other way and smaller by a hair */
	b = SHELL({0, 0}, {4, 0}, {0, 4}, {0, 0}, {100, 0}, {100, 3.999}, {104, 0}, {100, 0}, {0, 0});
	NEAR(b.x, 52, 1e-9);
	NEAR(b.y, 2, 1e-9);
}

static void
repeated_and_collinear_points_change_nothing(void)
{
	check_building("repeated", SHELL({0, 0}, {0, 0}, {4, 0}, {4, 0}, {4, 2}, {4, 2}, {0, 2}, {0, 0}, {0, 0}), 2, 1, 8,
				   0.5, 1, 0);
	check_building("collinear", SHELL({0, 0}, {1, 0}, {3, 0}, {4, 0}, {4, 1}, {4, 2}, {2, 2}, {0, 2}, {0, 0}), 2, 1, 8,
				   0.5, 1, 0);
	check_building("spike", SHELL({0, 0}, {4, 0}, {4, 2}, {4, 1}, {4, 2}, {0, 2}, {0, 0}), 2, 1, 8, 0.5, 1, 0);
}

static void
far_from_the_origin_nothing_is_lost(void)
{
	const double far = 4.0e6;
	ty_building b = SHELL({far, far}, {far + 0.5, far}, {far + 0.5, far + 0.25}, {far, far + 0.25}, {far, far});

	CHECK(b.area == 0.125, "area %.17g", b.area);
	CHECK(b.x == far + 0.25 && b.y == far + 0.125, "centroid %.17g %.17g", b.x, b.y);
	CHECK(b.ratio == 0.5 && b.ux == 1, "ratio %.17g", b.ratio);
}

static void
coordinates_may_be_unaligned_and_interleaved(void)
{
	static const ty_point points[] = {{0, 0}, {6, 8}, {2, 11}, {-4, 3}, {0, 0}};
	static char buffer[5 * 32 + 8];

	for (size_t stride = 16; stride <= 32; stride += 8)
		for (size_t shift = 0; shift < 8; shift++)
		{
			memset(buffer, 0xff, sizeof buffer); /* Z and M are NaN */
			for (size_t i = 0; i < 5; i++)
				memcpy(buffer + shift + i * stride, &points[i], sizeof *points);
			begin();
			ty_measure_ring(&measure, buffer + shift, stride, 5, true);
			check_building("interleaved", end(), 1, 5.5, 50, 0.5, 0.6, 0.8);
		}
}

static void
what_is_not_finite_is_told(void)
{
	static const double bad[] = {NAN, INFINITY, -INFINITY};
	ty_building b;

	for (size_t i = 0; i < 6; i++)
	{
		ty_point points[] = {{0, 0}, {4, 0}, {4, 2}, {0, 0}};

		*(i % 2 == 0 ? &points[i / 2].x : &points[i / 2].y) = bad[i / 2];
		begin();
		ring(points, 4, true);
		CHECK(ty_measure_end(&measure, &b) == TY_NOT_FINITE, "ring, case %zu", i);
		begin();
		ty_measure_line(&measure, points, sizeof *points, 4);
		CHECK(ty_measure_end(&measure, &b) == TY_NOT_FINITE, "line, case %zu", i);
		begin();
		ty_measure_point(&measure, &points[i / 2]);
		CHECK(ty_measure_end(&measure, &b) == TY_NOT_FINITE, "point, case %zu", i);
	}
	begin();
	ring((const ty_point[]){{-1e300, -1e300}, {1e300, -1e300}, {1e300, 1e300}, {-1e300, -1e300}}, 4, true);
	CHECK(ty_measure_end(&measure, &b) == TY_NOT_FINITE, "the area overflows");
}

static void
a_hole_that_is_not_finite_is_told(void)
{
	ty_building b;

	begin();
	ring((const ty_point[]){{0, 0}, {4, 0}, {4, 4}, {0, 0}}, 4, true);
	HOLE({1, 1}, {2, NAN}, {2, 2}, {1, 1});
	CHECK(ty_measure_end(&measure, &b) == TY_NOT_FINITE, "NaN in a hole");
}

/* differences of finite coordinates may overflow: then the measures are finite all the same, or the status tells */
static void
no_measure_is_nan_however_far_apart_the_points(void)
{
	const ty_point points[] = {{-1.7e308, 1e308}, {1.7e308, -1.7e308}, {1e-300, 5e-324}, {1e-300, 1.7e308}};

	for (size_t first = 0; first < 4; first++)
		for (size_t kind = 0; kind < 3; kind++)
		{
			ty_building b;

			begin();
			for (size_t i = 0; i < 4 && kind == 0; i++)
				ty_measure_point(&measure, &points[(first + i) % 4]);
			if (kind == 1)
				ty_measure_line(&measure, points + first, sizeof *points, (uint32_t) (4 - first));
			if (kind == 2)
				ring(points + first, 4 - first, true);
			if (ty_measure_end(&measure, &b) != TY_OK)
				continue;
			CHECK(isfinite(b.x) && isfinite(b.y) && isfinite(b.area), "case %zu %zu: %g %g, area %g", first, kind, b.x,
				  b.y, b.area);
			CHECK(b.ratio > 0 && b.ratio <= 1 && fabs(b.ux) <= 1 && b.uy >= 0,
				  "case %zu %zu: ratio %g, direction %g %g", first, kind, b.ratio, b.ux, b.uy);
		}
}

/* a star-shaped ring of n points around a centre, on a fine lattice so that sums of products are exact */
static void
draw_star(random_state *random, ty_point *points, size_t n)
{
	for (size_t i = 0; i < n; i++)
	{
		double angle = 6.283185307179586 * (double) i / (double) n;
		double distance = 10 + 90 * random_unit(random);

		points[i].x = round(distance * cos(angle) * 64) / 64 + 1000;
		points[i].y = round(distance * sin(angle) * 64) / 64 - 3000;
	}
}

static void
start_and_direction_of_the_ring_do_not_matter(void)
{
	random_state random = random_seed(11);
	ty_point points[MAX_POINTS], turned[MAX_POINTS];

	for (size_t set = 0; set < 2000; set++)
	{
		size_t n = (size_t) random_between(&random, 3, set % 100 == 0 ? 300 : 30);
		size_t start = (size_t) random_between(&random, 0, (int64_t) n - 1);
		ty_building first, b;

		draw_star(&random, points, n);
		for (size_t i = 0; i < n; i++)
			turned[i] = points[(set % 2 == 0 ? start + i : start + n - i) % n];
		turned[n] = turned[0];
		first = measure_shell(points, n);
		b = measure_shell(turned, n + 1);
		CHECK(fabs(b.area - first.area) <= 1e-12 * first.area, "set %zu: area %a, then %a", set, first.area, b.area);
		CHECK(hypot(b.x - first.x, b.y - first.y) < 1e-9, "set %zu: centroid %a %a", set, b.x, b.y);
		CHECK(fabs(b.ratio - first.ratio) < 1e-12, "set %zu: ratio %a, then %a", set, first.ratio, b.ratio);
	}
}

/* extents of the points along a direction (unit vector) and across it */
static void
extents(const ty_point *points, size_t n, double ux, double uy, double *along, double *across)
{
	double low = INFINITY, high = -INFINITY, left = INFINITY, right = -INFINITY;

	for (size_t i = 0; i < n; i++)
	{
		double x = points[i].x - points[0].x;
		double y = points[i].y - points[0].y;

		low = fmin(low, x * ux + y * uy);
		high = fmax(high, x * ux + y * uy);
		left = fmin(left, y * ux - x * uy);
		right = fmax(right, y * ux - x * uy);
	}
	*along = high - low;
	*across = right - left;
}

/* the least area over the directions of all pairs of points, among which are all edges of the hull */
static double
least_rectangle(const ty_point *points, size_t n)
{
	double least = INFINITY;

	for (size_t i = 0; i < n; i++)
		for (size_t k = 0; k < i; k++)
		{
			double length = hypot(points[k].x - points[i].x, points[k].y - points[i].y);
			double along, across;

			if (length == 0)
				continue;
			extents(points, n, (points[k].x - points[i].x) / length, (points[k].y - points[i].y) / length, &along,
					&across);
			least = fmin(least, along * across);
		}
	return least;
}

static void
check_rectangle(const ty_point *points, size_t n, const char *what)
{
	ty_point copy[MAX_POINTS], hull[MAX_POINTS + 1];
	double ratio, ux, uy, along, across, least;

	memcpy(copy, points, n * sizeof *points);
	ty_minimum_rectangle(copy, n, hull, &ratio, &ux, &uy);
	extents(points, n, ux, uy, &along, &across);
	least = least_rectangle(points, n);
	CHECK(fabs(ux * ux + uy * uy - 1) < 1e-14, "%s: direction %a %a is no unit vector", what, ux, uy);
	CHECK(uy > 0 || (uy == 0 && ux == 1), "%s: direction %a %a is not in [0, 180)", what, ux, uy);
	CHECK(ratio > 0 && ratio <= 1, "%s: ratio %a", what, ratio);
	CHECK(along >= across * (1 - 1e-12), "%s: %.17g along the longer side, %.17g across", what, along, across);
	if (!isfinite(least) || least <= 1e-12 * along * along)
		return;
	CHECK(along * across <= least * (1 + 1e-11), "%s: area %.17g, there is one of %.17g", what, along * across, least);
	CHECK(fabs(ratio - across / along) < 1e-11, "%s: ratio %.17g, sides %.17g and %.17g", what, ratio, across, along);
}

static void
minimum_rectangle_equals_brute_force(void)
{
	random_state random = random_seed(12);
	ty_point points[MAX_POINTS];

	for (size_t set = 0; set < 3000; set++)
	{
		size_t n = (size_t) random_between(&random, 1, set % 100 == 0 ? 150 : 24);
		int64_t range = set % 3 == 0 ? 4 : set % 3 == 1 ? 50 : 100000;

		for (size_t i = 0; i < n; i++)
		{
			points[i].x = (double) random_between(&random, 0, range) / 8 + 1000;
			points[i].y = (double) random_between(&random, 0, set % 5 == 0 ? 1 : range) / 8;
		}
		check_rectangle(points, n, set % 5 == 0 ? "flat" : "any");
		draw_star(&random, points, n);
		check_rectangle(points, n, "star");
	}
}

static void
minimum_rectangle_does_not_depend_on_the_order_of_points(void)
{
	random_state random = random_seed(13);
	ty_point points[MAX_POINTS], copy[MAX_POINTS], hull[MAX_POINTS + 1];

	for (size_t set = 0; set < 3000; set++)
	{
		size_t n = (size_t) random_between(&random, 1, 20);
		double first[3], again[3];

		for (size_t i = 0; i < n; i++)
			points[i] = (ty_point){(double) random_between(&random, 0, 6), (double) random_between(&random, 0, 6)};
		memcpy(copy, points, sizeof copy);
		ty_minimum_rectangle(copy, n, hull, &first[0], &first[1], &first[2]);
		for (size_t i = n; i > 1; i--)
		{
			size_t other = (size_t) random_between(&random, 0, (int64_t) i - 1);
			ty_point p = points[i - 1];

			points[i - 1] = points[other];
			points[other] = p;
		}
		memcpy(copy, points, sizeof copy);
		ty_minimum_rectangle(copy, n, hull, &again[0], &again[1], &again[2]);
		CHECK(memcmp(first, again, sizeof first) == 0, "set %zu: ratio %a, direction %a %a; then %a, %a %a", set,
			  first[0], first[1], first[2], again[0], again[1], again[2]);
	}
}

/* Rings of four corners, which are looked at as they are, and the corners alone, whose hull is sought. */
static void
a_ring_of_four_corners_is_what_its_corners_are(void)
{
	random_state random = random_seed(14);

	for (size_t set = 0; set < 20000; set++)
	{
		ty_point ring[5], corners[5], hull[6];
		double first[3], again[3];

		for (size_t i = 0; i < 4; i++)
			ring[i] = (ty_point){(double) random_between(&random, 0, 9), (double) random_between(&random, 0, 9)};
		ring[4] = ring[0];
		memcpy(corners, ring, sizeof ring);
		corners[1] = ring[2]; /* across: no ring of four convex corners any more */
		corners[2] = ring[1];
		ty_minimum_rectangle(ring, 5, hull, &first[0], &first[1], &first[2]);
		ty_minimum_rectangle(corners, 4, hull, &again[0], &again[1], &again[2]);
		CHECK(memcmp(first, again, sizeof first) == 0, "set %zu: ratio %a, direction %a %a; then %a, %a %a", set,
			  first[0], first[1], first[2], again[0], again[1], again[2]);
	}
}

/* Areas beyond the range of doubles too: what overflows is looked at in another way. */
static void
minimum_rectangle_does_not_depend_on_size(void)
{
	random_state random = random_seed(15);

	for (int power = -300; power <= 300; power += 20)
	{
		ty_point points[5] = {{0, 0}, {8, 6}, {5, 10}, {-3, 4}, {0, 0}}, corners[40], hull[41];
		double ratio, ux, uy, factor = ldexp(1, power);

		for (size_t i = 0; i < 5; i++)
			points[i] = (ty_point){factor * points[i].x, factor * points[i].y};
		ty_minimum_rectangle(points, 5, hull, &ratio, &ux, &uy);
		CHECK(fabs(ratio - 0.5) + fabs(ux - 0.8) + fabs(uy - 0.6) < 1e-15, "2^%d: ratio %a, direction %a %a", power,
			  ratio, ux, uy);
		for (size_t i = 0; i < 40; i++) /* in a rectangle, its corners among them */
			corners[i] = i < 4 ? (ty_point){factor * (double) (i % 2) * 9, factor * (double) (i / 2) * 5}
							   : (ty_point){factor * (double) random_between(&random, 0, 9),
											factor * (double) random_between(&random, 0, 5)};
		ty_minimum_rectangle(corners, 40, hull, &ratio, &ux, &uy);
		CHECK(fabs(ratio - 5.0 / 9) < 1e-15 && ux == 1 && uy == 0, "2^%d: ratio %a, direction %a %a", power, ratio, ux,
			  uy);
	}
}

int
main(int argc, char **argv)
{
	check_begin(argc, argv);
	RUN(plain_shapes);
	RUN(a_square_has_a_direction_of_its_own_whatever_the_start);
	RUN(holes_are_taken_away_whichever_way_they_run);
	RUN(a_hole_larger_than_its_shell_does_not_make_area_negative);
	RUN(parts_add_up_even_of_opposite_directions);
	RUN(the_highest_dimension_gives_the_centroid);
	RUN(points_weigh_the_same_each);
	RUN(lines_weigh_by_length);
	RUN(polygons_without_area_are_lines_and_those_without_length_points);
	RUN(a_bow_tie_keeps_its_centroid_in_its_box);
	RUN(a_centroid_outside_the_box_becomes_the_boxes_centre);
	RUN(repeated_and_collinear_points_change_nothing);
	RUN(far_from_the_origin_nothing_is_lost);
	RUN(coordinates_may_be_unaligned_and_interleaved);
	RUN(what_is_not_finite_is_told);
	RUN(a_hole_that_is_not_finite_is_told);
	RUN(no_measure_is_nan_however_far_apart_the_points);
	RUN(start_and_direction_of_the_ring_do_not_matter);
	RUN(minimum_rectangle_equals_brute_force);
	RUN(minimum_rectangle_does_not_depend_on_the_order_of_points);
	RUN(a_ring_of_four_corners_is_what_its_corners_are);
	RUN(minimum_rectangle_does_not_depend_on_size);
	return check_end();
}
