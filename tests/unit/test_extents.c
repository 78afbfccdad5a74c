/*
 * test_extents.c - the fear: a pair of boxes that meet is missed, above all where they only touch, coincide or differ
 * much in size, or the segment found is not the nearest. A slow reference looks at all of them.
 */
#include "extents.h"
#include "check.h"
#include "nearest.h"
#include "random.h"

#include <math.h>
#include <stdlib.h>

#define MOST 200

static ty_extent boxes[MOST];
static ty_segment segments[MOST];
static bool is_found[MOST];

static void
note(void *context, uint32_t number)
{
	size_t *twice = context;

	*twice += is_found[number];
	is_found[number] = true;
}

/* on a small grid, so that boxes touch and coincide; some of them large, some without extent */
static ty_extent
random_box(random_state *r)
{
	int64_t most = random_between(r, 0, 9) == 0 ? 30 : 2;
	double x = (double) random_between(r, 0, 40), y = (double) random_between(r, 0, 40);

	return (ty_extent){{x + (double) random_between(r, 0, most), y + (double) random_between(r, 0, most)}, {x, y}};
}

static bool
meet(ty_extent a, ty_extent b)
{
	return !(a.high.x < b.low.x || b.high.x < a.low.x || a.high.y < b.low.y || b.high.y < a.low.y);
}

static void
check_meeting(const ty_extents *tree, ty_extent box)
{
	size_t twice = 0;

	memset(is_found, 0, sizeof is_found);
	ty_extents_meeting(tree, &box, note, &twice);
	CHECK(twice == 0, "%zu boxes told twice", twice);
	for (size_t i = 0; i < tree->count; i++)
		CHECK(is_found[i] == meet(box, boxes[i]), "%zu boxes, box %zu found: %d", tree->count, i, is_found[i]);
}

static void
test_all_that_meet_are_found(void)
{
	for (size_t count = 0; count <= MOST; count += count < 20 ? 1 : 45)
	{
		random_state r = random_seed(count);
		ty_extents tree;

		for (size_t i = 0; i < count; i++)
			boxes[i] = random_box(&r);
		NEED(ty_extents_build(&ty_plain_environment, boxes, count, &tree) == TY_OK, "%zu boxes", count);
		for (int look = 0; look < 50; look++)
			check_meeting(&tree, random_box(&r));
		ty_extents_free(&ty_plain_environment, &tree);
	}
}

/* by the closest of many points along the segment: never below the true distance, and above it by little */
static double
distance_slowly(ty_segment s, ty_point from)
{
	double least = INFINITY;

	for (int i = 0; i <= 1000; i++)
	{
		ty_point p = {s.a.x + (s.b.x - s.a.x) * i / 1000, s.a.y + (s.b.y - s.a.y) * i / 1000};

		least = fmin(least, ty_distance(p, from));
	}
	return least;
}

static void
check_nearest(const ty_extents *tree, ty_point from)
{
	uint32_t nearest = ty_extents_nearest_segment(tree, segments, from);
	double found = distance_slowly(segments[nearest], from);

	for (size_t i = 0; i < tree->count; i++)
	{
		double other = distance_slowly(segments[i], from);

		CHECK(found <= other + 0.05, "%zu segments: %u at %g, but %zu at %g", tree->count, nearest, found, i, other);
	}
}

static void
test_the_nearest_segment_is_found(void)
{
	for (size_t count = 1; count <= 60; count += count < 10 ? 1 : 25)
	{
		random_state r = random_seed(count);
		ty_extents tree;

		for (size_t i = 0; i < count; i++)
		{
			ty_extent box = random_box(&r);

			segments[i] = (ty_segment){box.high, {box.low.x, random_between(&r, 0, 1) == 0 ? box.low.y : box.high.y}};
			boxes[i] = ty_segment_extent(segments[i]);
		}
		NEED(ty_extents_build(&ty_plain_environment, boxes, count, &tree) == TY_OK, "%zu segments", count);
		for (int look = 0; look < 20; look++)
			check_nearest(&tree, (ty_point){40 * random_unit(&r), 60 * random_unit(&r)});
		ty_extents_free(&ty_plain_environment, &tree);
	}
}

static void
test_equally_near_ones_go_by_number(void)
{
	ty_point centre = {5, 5};
	ty_extents tree;

	for (size_t i = 0; i < 40; i++)
	{
		segments[i] = (ty_segment){{i % 2 == 0 ? 0 : 10, -(double) i}, {i % 2 == 0 ? 0 : 10, 20}};
		boxes[i] = ty_segment_extent(segments[i]);
	}
	segments[0] = (ty_segment){{0, 100}, {0, 200}};
	boxes[0] = ty_segment_extent(segments[0]);
	NEED(ty_extents_build(&ty_plain_environment, boxes, 40, &tree) == TY_OK, "40 segments");
	CHECK(ty_extents_nearest_segment(&tree, segments, centre) == 1, "nearest is %u",
		  ty_extents_nearest_segment(&tree, segments, centre));
	ty_extents_free(&ty_plain_environment, &tree);
}

static void
test_none_and_not_finite(void)
{
	ty_status status;
	ty_extents tree;

	NEED(ty_extents_build(&ty_plain_environment, boxes, 0, &tree) == TY_OK, "no box");
	CHECK(ty_extents_nearest_segment(&tree, segments, (ty_point){0, 0}) == TY_NOBODY, "a segment of none");
	ty_extents_free(&ty_plain_environment, &tree);
	boxes[0] = (ty_extent){{1, NAN}, {0, 0}};
	status = ty_extents_build(&ty_plain_environment, boxes, 1, &tree);
	CHECK(status == TY_NOT_FINITE, "status %d", status);
	ty_extents_free(&ty_plain_environment, &tree);
}

int
main(int argc, char **argv)
{
	check_begin(argc, argv);
	RUN(test_all_that_meet_are_found);
	RUN(test_the_nearest_segment_is_found);
	RUN(test_equally_near_ones_go_by_number);
	RUN(test_none_and_not_finite);
	return check_end();
}
