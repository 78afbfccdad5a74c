/*
 * test_surroundings.c - the fear: a segment is passed over because the square that serves was made for another place,
 * or because single precision bends what is long, far from the origin, or in tiny units; so a site sits on a road.
 */
#include "check.h"
#include "counting.h"
#include "random.h"
#include "surroundings.h"

#include <math.h>

#define LINES 60
#define POINTS 12
#define SIDE 1000
#define TOLERANCE 1e-4 /* of what was asked for */

static ty_point points[LINES][POINTS];

/* where the settlement lies, and in which units */
typedef struct frame
{
	ty_point origin;
	double unit;
} frame;

static const frame frames[] = {{{0, 0}, 1}, {{4.5e6, 5.7e6}, 1}, {{12, 51}, 1e-5}, {{-1e12, 1e13}, 1e9}};

static ty_point
placed(const frame *f, double x, double y)
{
	return (ty_point){f->origin.x + f->unit * x, f->origin.y + f->unit * y};
}

/* Lines that wander; every seventh has a stretch a thousand times as long, every fifth one stands still for a while. */
static void
make_lines(random_state *r, const frame *f, ty_barrier_lines *lines)
{
	ty_barrier_lines_begin(lines, &ty_plain_environment);
	for (int i = 0; i < LINES; i++)
	{
		double x = SIDE * random_unit(r), y = SIDE * random_unit(r);

		for (int k = 0; k < POINTS; k++)
		{
			double step = i % 7 == 0 && k == POINTS / 2 ? 1000 : 1;

			if (i % 5 > 0 || k % 3 > 0)
			{
				x += step * (80 * random_unit(r) - 40);
				y += step * (80 * random_unit(r) - 40);
			}
			points[i][k] = placed(f, x, y);
		}
		NEED(ty_barrier_lines_add(lines, points[i], sizeof(ty_point), POINTS) == TY_OK, "line %d", i);
	}
	NEED(ty_barrier_lines_end(lines) == TY_OK, "no memory");
}

static bool
is_picked(const ty_segment_set *set, uint32_t number)
{
	for (size_t k = 0; k < set->count; k++)
		if (set->number[k] == number)
			return true;
	return false;
}

/* whatever is near was picked, each once, and little else */
static void
check_picked(const ty_surroundings *s, ty_point home, double limit)
{
	const ty_barrier_lines *lines = s->lines;
	ty_segments near = {0};

	NEED(ty_barrier_lines_near(lines, home, limit, &near) == TY_OK, "no memory");
	for (size_t k = 0; k < near.count; k++)
		CHECK(is_picked(&s->near, near.number[k]), "segment %u at %g of %g", near.number[k], (double) near.distance[k],
			  limit);
	near.count = 0;
	NEED(ty_barrier_lines_near(lines, home, limit * (1 + TOLERANCE), &near) == TY_OK, "no memory");
	CHECK(s->near.count <= near.count, "%zu picked, %zu near", s->near.count, near.count);
	ty_release(&ty_plain_environment, near.number);
	ty_release(&ty_plain_environment, near.distance);
}

/* As the tree of all lines says it: the nearest to a place, and whether one lies on the way there. */
static bool
check_place(ty_surroundings *s, ty_point home, ty_point way, double limit)
{
	ty_point place = {home.x + way.x, home.y + way.y}, away = {0, 0};
	double distance = ty_barrier_lines_gap(s->lines, &place, 1, limit).distance;
	double found = fmin(ty_nearest_segment(s, way, &away), limit), tolerance = TOLERANCE * limit;
	bool crosses = ty_barrier_lines_cross(s->lines, home, place);

	/* what is as far as limit from the place may be farther than limit from home */
	if (distance + sqrt(way.x * way.x + way.y * way.y) < limit)
		CHECK(fabs(found - distance) <= tolerance, "%g instead of %g", found, distance);
	if (distance > tolerance && ty_barrier_lines_gap(s->lines, &home, 1, limit).distance > tolerance)
		CHECK(ty_is_behind(s, way) == crosses, "crossed %d", (int) crosses);
	if (distance > tolerance && distance < 0.3 * limit && found < limit)
	{
		ty_point farther = {place.x + 0.5 * distance * away.x, place.y + 0.5 * distance * away.y};

		CHECK(ty_barrier_lines_gap(s->lines, &farther, 1, limit).distance > 0.4 * distance, "the way leads nearer");
	}
	return crosses;
}

/* A rectangle beside lines: as ty_barrier_lines_gap says it. */
static bool
check_rectangle(ty_surroundings *s, ty_point home, ty_point way, double limit, double angle)
{
	ty_oblong box = {way.x, way.y, cos(angle), sin(angle), 0.2 * limit, 0.1 * limit};
	double radius = sqrt(0.05) * limit, gap = 0.3 * limit, distance, lack;
	ty_point corners[4], away;

	for (int c = 0; c < 4; c++)
	{
		double along = c == 1 || c == 2 ? box.half_length : -box.half_length;
		double across = c > 1 ? box.half_width : -box.half_width;

		corners[c] = (ty_point){home.x + box.x + along * box.ux - across * box.uy,
								home.y + box.y + along * box.uy + across * box.ux};
	}
	distance = ty_barrier_lines_gap(s->lines, corners, 4, gap).distance;
	lack = ty_lack_beside_segments(s, &box, radius, gap, &away);
	if (distance > TOLERANCE * limit)
		CHECK(fabs(gap - distance - lack) <= TOLERANCE * limit, "lacks %g, %g away", lack, distance);
	else
		CHECK(lack >= gap - TOLERANCE * limit && lack <= (0.1 + 0.3 + TOLERANCE) * limit, "lacks %g, is crossed", lack);
	return !(distance > 0);
}

static void
walk_about(const frame *f)
{
	random_state r = random_seed(23);
	ty_barrier_lines lines;
	ty_surroundings s;
	size_t behind = 0, crossed = 0;
	double x = SIDE / 2, y = SIDE / 2;

	make_lines(&r, f, &lines);
	ty_surroundings_begin(&lines, 30 * f->unit, &s);
	for (int t = 0; t < 4000 && check_failures < CHECK_SHOWN; t++)
	{
		/* mostly what is usual, near the one before; now and then far away, or much farther around */
		double limit = f->unit * (t % 31 == 0 ? 400 : 20 + 20 * random_unit(&r)), angle = 6 * random_unit(&r);
		double reach = 0.6 * limit;
		ty_point home, way = {reach * (2 * random_unit(&r) - 1), reach * (2 * random_unit(&r) - 1)};

		x = t % 17 == 0 ? SIDE * random_unit(&r) : x + 20 * random_unit(&r) - 10;
		y = t % 17 == 0 ? SIDE * random_unit(&r) : y + 20 * random_unit(&r) - 10;
		home = placed(f, x, y);
		NEED(ty_survey(&s, home, limit) == TY_OK, "no memory");
		check_picked(&s, home, limit);
		behind += check_place(&s, home, way, limit);
		way = (ty_point){0.3 * way.x, 0.3 * way.y};
		crossed += check_rectangle(&s, home, way, limit, angle);
	}
	CHECK(behind > 500 && crossed > 500, "behind %zu, crossed %zu", behind, crossed);
	ty_surroundings_free(&s);
	ty_barrier_lines_free(&lines);
}

static void
as_the_tree_of_all_lines_says(void)
{
	for (size_t i = 0; i < sizeof frames / sizeof *frames; i++)
		walk_about(&frames[i]);
}

/* Lines of a single road, from one end to the other. */
static void
one_road(const ty_point *road, ty_barrier_lines *lines)
{
	ty_barrier_lines_begin(lines, &ty_plain_environment);
	CHECK(ty_barrier_lines_add(lines, road, sizeof *road, 2) == TY_OK, "add");
	CHECK(ty_barrier_lines_end(lines) == TY_OK, "end");
}

/* a road from horizon to horizon is as near as it is */
static void
a_long_segment_is_not_bent(void)
{
	ty_point road[2] = {{-3e8, -1e8}, {6e8, 2e8}}, place = {30, 0}, away;
	ty_barrier_lines lines;
	ty_surroundings s;

	one_road(road, &lines);
	ty_surroundings_begin(&lines, 20, &s);
	NEED(ty_survey(&s, place, 20) == TY_OK, "no memory");
	CHECK(fabs(ty_nearest_segment(&s, (ty_point){0, 0}, &away) - 30 / sqrt(10)) < 1e-3, "%g",
		  ty_nearest_segment(&s, (ty_point){0, 0}, &away));
	CHECK(!ty_is_behind(&s, (ty_point){0, 9.9}) && ty_is_behind(&s, (ty_point){0, 10.1}), "the side");
	ty_surroundings_free(&s);
	ty_barrier_lines_free(&lines);
}

static void
where_there_is_nothing(void)
{
	ty_point road[2] = {{0, 0}, {10, 0}}, away = {7, 7};
	ty_barrier_lines lines;
	ty_surroundings s;

	one_road(road, &lines);
	ty_surroundings_begin(&lines, 20, &s);
	NEED(ty_survey(&s, (ty_point){1000, 1000}, 20) == TY_OK, "no memory");
	CHECK(!(ty_nearest_segment(&s, (ty_point){0, 0}, &away) < INFINITY) && away.x == 7, "%g", away.x);
	CHECK(!ty_is_behind(&s, (ty_point){-2000, -3000}), "behind");
	ty_surroundings_free(&s);
	ty_surroundings_free(&s);
	ty_barrier_lines_free(&lines);
}

/* Where memory fails once, be it in the middle of a search, there is no survey that lacks something. */
static void
every_allocation_may_fail(void)
{
	random_state r = random_seed(24);
	ty_barrier_lines lines;
	size_t failed = 0, all = 0;
	bool all_went_well = false;

	make_lines(&r, &frames[0], &lines);
	for (size_t failing = 1; !all_went_well; failing++)
	{
		counting counter;
		ty_environment env = counting_environment(&counter);
		ty_barrier_lines same = lines;
		ty_surroundings s;
		ty_status status;

		same.env = &env;
		counter.failing = failing;
		ty_surroundings_begin(&same, SIDE, &s);
		status = ty_survey(&s, (ty_point){SIDE / 2, SIDE / 2}, SIDE);
		CHECK(status == (counter.allocations < failing ? TY_OK : TY_NO_MEMORY), "status %d, allocation %zu of %zu",
			  status, failing, counter.allocations);
		all_went_well = status == TY_OK;
		failed += status == TY_NO_MEMORY;
		all = s.near.count;
		ty_surroundings_free(&s);
		CHECK(counter.used == 0, "%zu bytes left", counter.used);
	}
	CHECK(failed >= 3 && all > 600, "%zu failures, %zu segments", failed, all);
	ty_barrier_lines_free(&lines);
}

int
main(int argc, char **argv)
{
	check_begin(argc, argv);
	RUN(as_the_tree_of_all_lines_says);
	RUN(a_long_segment_is_not_bent);
	RUN(where_there_is_nothing);
	RUN(every_allocation_may_fail);
	return check_end();
}
