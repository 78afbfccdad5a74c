/*
 * test_vicinity.c - the fear: somebody near, or a line, is not found, so that a placeholder is never compared with it, or
 * a list that is no longer true is taken for one that is.
 */
#include "barrier.h"
#include "check.h"
#include "lists.h"
#include "random.h"
#include "squares.h"
#include "vicinity.h"

#include <math.h>
#include <stdlib.h>

#define MOST 300

/* Discs as they should be, tried one by one. */
typedef struct plain_disc
{
	double x, y, radius; /* radius < 0: not there */
} plain_disc;

static bool
touches(const plain_disc *a, double x, double y, double radius)
{
	double dx = a->x - x, dy = a->y - y, reach = a->radius + radius;

	return a->radius >= 0 && dx * dx + dy * dy <= reach * reach;
}

static plain_disc
random_disc(random_state *r)
{
	double radius = random_between(r, 0, 9) == 0 ? 200 * random_unit(r) : 8 * random_unit(r);

	return (plain_disc){1000 * random_unit(r), 1000 * random_unit(r), radius};
}

/* That found are those of all that touch, ascending. */
static void
check_found(const ty_vicinity *v, const plain_disc *all, size_t n, uint32_t but, plain_disc around, const char *way)
{
	size_t next = 0;

	for (uint32_t i = 0; i < n; i++)
	{
		if (i == but || !touches(&all[i], around.x, around.y, around.radius))
			continue;
		CHECK(next < v->found_count && v->found[next] == i, "%s: %u is number %zu of %zu", way, i, next,
			  v->found_count);
		next++;
	}
	CHECK(next == v->found_count, "%s: %zu found, %zu touch", way, v->found_count, next);
}

static void
check_all(ty_vicinity *v, const plain_disc *all, size_t n, random_state *r)
{
	for (uint32_t i = 0; i < n; i++)
	{
		plain_disc around = random_disc(r);

		if (all[i].radius >= 0)
		{
			NEED(ty_vicinity_find_touching(v, i) == TY_OK, "%u", i);
			check_found(v, all, n, i, all[i], "touching");
		}
		NEED(ty_vicinity_find(v, i, (ty_point){around.x, around.y}, around.radius) == TY_OK, "%u", i);
		check_found(v, all, n, i, around, "anywhere");
	}
}

static void
as_if_every_disc_were_tried(void)
{
	random_state r = random_seed(11);

	for (int set = 0; set < 40 && check_failures < CHECK_SHOWN; set++)
	{
		size_t n = (size_t) random_between(&r, 1, MOST), there = 0;
		plain_disc all[MOST];
		ty_vicinity v;

		NEED(ty_vicinity_begin(&ty_plain_environment, n, &v) == TY_OK, "set %d", set);
		for (uint32_t i = 0; i < n; i++)
		{
			all[i] = random_disc(&r);
			ty_vicinity_insert(&v, i, (ty_point){all[i].x, all[i].y}, all[i].radius);
		}
		check_all(&v, all, n, &r);
		for (size_t change = 0; change < n; change++)
		{
			uint32_t i = (uint32_t) random_between(&r, 0, (int64_t) n - 1);

			all[i] = random_disc(&r);
			if (random_between(&r, 0, 1) == 0)
				ty_vicinity_insert(&v, i, (ty_point){all[i].x, all[i].y}, all[i].radius);
			else
			{
				ty_vicinity_remove(&v, i);
				all[i].radius = -1;
			}
		}
		for (size_t i = 0; i < n; i++)
			there += all[i].radius >= 0;
		CHECK(v.there == there, "set %d: %zu are there, not %zu", set, v.there, there);
		check_all(&v, all, n, &r);
		ty_vicinity_fit(&v);
		check_all(&v, all, n, &r);
		ty_vicinity_free(&v);
	}
}

/* Rings around a place: each who is there once, and nobody missed who is nearer than it is said. */
static void
check_rings(ty_squares *s, const plain_disc *all, size_t n, ty_point place)
{
	int seen[MOST] = {0};

	for (uint32_t ring = 0; ring < TY_MOST_RINGS; ring++)
	{
		double within = ty_squares_within(s, place, ring);

		NEED(ty_squares_ring(s, place, ring) == TY_OK, "ring %u", ring);
		for (size_t k = 0; k < s->found_count; k++)
			seen[s->found[k]]++;
		CHECK(within >= ring * s->side * 0.999, "ring %u: within %g", ring, within);
		for (size_t i = 0; i < n; i++)
		{
			double distance = hypot(all[i].x - place.x, all[i].y - place.y);

			CHECK(seen[i] <= (all[i].radius >= 0), "ring %u: %zu is found %d times", ring, i, seen[i]);
			CHECK(seen[i] == 1 || all[i].radius < 0 || distance > within, "ring %u: %zu is missed at %g", ring, i,
				  distance);
		}
	}
}

static void
rings_of_squares_leave_nobody_out(void)
{
	random_state r = random_seed(14);

	for (int set = 0; set < 60 && check_failures < CHECK_SHOWN; set++)
	{
		size_t n = (size_t) random_between(&r, 1, MOST);
		double side = 2 + 60 * random_unit(&r), base = set % 2 == 0 ? 0 : -7e6;
		plain_disc all[MOST];
		ty_squares s;

		NEED(ty_squares_begin(&ty_plain_environment, n, side, &s) == TY_OK, "set %d", set);
		for (uint32_t i = 0; i < n; i++)
			all[i] = (plain_disc){0, 0, -1};
		for (size_t change = 0; change < 3 * n; change++)
		{
			uint32_t i = (uint32_t) random_between(&r, 0, (int64_t) n - 1);

			if (all[i].radius >= 0)
				ty_squares_remove(&s, i);
			all[i] = random_disc(&r);
			all[i].x += base;
			if (change % 3 == 0)
				all[i].radius = -1;
			else
				ty_squares_insert(&s, i, (ty_point){all[i].x, all[i].y});
		}
		for (int t = 0; t < 20; t++)
			check_rings(&s, all, n, (ty_point){base + 1000 * random_unit(&r), 1000 * random_unit(&r)});
		ty_squares_free(&s);
	}
}

static void
a_list_is_what_was_kept_last_or_none(void)
{
	enum
	{
		OWNERS = 50
	};
	random_state r = random_seed(12);
	uint32_t last[OWNERS] = {0}, numbers[64];
	ty_lists lists;
	size_t known = 0, forgotten = 0;

	NEED(ty_lists_begin(&ty_plain_environment, OWNERS, 4, &lists) == TY_OK, "no memory");
	for (uint32_t step = 1; step < 20000 && check_failures < CHECK_SHOWN; step++)
	{
		uint32_t owner = (uint32_t) random_between(&r, 0, OWNERS - 1);
		const uint32_t *list = ty_lists_get(&lists, owner);

		if (list != NULL)
			CHECK(list[0] == last[owner] % 7 && (list[0] == 0 || list[list[0]] == last[owner] + list[0] - 1),
				  "step %u: %u numbers of owner %u", step, list[0], owner);
		known += list != NULL;
		forgotten += list == NULL;
		last[owner] = step;
		for (uint32_t k = 0; k < step % 7; k++)
			numbers[k] = step + k;
		if (step % 11 == 0)
			ty_lists_forget(&lists, owner);
		else
			CHECK(ty_lists_keep(&lists, owner, numbers, step % 7) != NULL, "step %u", step);
	}
	CHECK(known > 1000 && forgotten > 1000, "%zu known, %zu not", known, forgotten);
	CHECK(ty_lists_keep(&lists, 0, numbers, 4 * OWNERS) == NULL, "a list longer than all the room");
	ty_lists_free(&lists);
}

/* ---- lines ---- */

#define LINES 60
#define POINTS 25

static ty_point line_points[LINES][POINTS];

/* lines that wander, some of them on whole numbers, where they touch */
static void
make_lines(random_state *r, ty_barrier_lines *lines)
{
	ty_barrier_lines_begin(lines, &ty_plain_environment);
	for (int i = 0; i < LINES; i++)
	{
		ty_point at = {1000 * random_unit(r), 1000 * random_unit(r)};

		for (int k = 0; k < POINTS; k++)
		{
			at = (ty_point){at.x + 40 * random_unit(r) - 20, at.y + 40 * random_unit(r) - 20};
			line_points[i][k] = i % 2 ? at : (ty_point){floor(at.x), floor(at.y)};
		}
		NEED(ty_barrier_lines_add(lines, line_points[i], sizeof(ty_point), POINTS) == TY_OK, "line %d", i);
	}
	NEED(ty_barrier_lines_end(lines) == TY_OK, "no memory");
}

/* listed once, segments tell of a place and its surroundings what the tree of all tells */
static void
segments_near_a_place_are_listed(void)
{
	random_state r = random_seed(9);
	ty_barrier_lines lines;
	ty_segments near = {0};
	size_t listed = 0, crossed = 0;

	make_lines(&r, &lines);
	for (int t = 0; t < 5000 && check_failures < CHECK_SHOWN; t++)
	{
		ty_point p =
			t % 2 ? line_points[t % LINES][t % POINTS] : (ty_point){1000 * random_unit(&r), 1000 * random_unit(&r)};
		double limit = t % 50, way = 0.7 * limit;
		ty_point q = {p.x + way * (2 * random_unit(&r) - 1), p.y + way * (2 * random_unit(&r) - 1)};
		bool crosses;

		NEED(ty_barrier_lines_near(&lines, p, limit, &near) == TY_OK, "no memory");
		CHECK((near.count > 0) == (ty_barrier_lines_gap(&lines, &p, 1, limit).distance < limit),
			  "(%g %g) within %g: %zu", p.x, p.y, limit, near.count);
		crosses = ty_barrier_lines_cross(&lines, p, q);
		CHECK(ty_barrier_segments_cross(&lines, near.number, near.count, p, q) == crosses, "(%g %g) to (%g %g)", p.x,
			  p.y, q.x, q.y);
		for (size_t k = 1; k < near.count; k++)
			CHECK(near.distance[k - 1] <= near.distance[k], "(%g %g): %zu is nearer", p.x, p.y, k);
		listed += near.count;
		crossed += crosses;
	}
	CHECK(listed > 5000 && crossed > 500, "%zu listed, %zu crossed", listed, crossed);
	ty_release(&ty_plain_environment, near.number);
	ty_release(&ty_plain_environment, near.distance);
	ty_barrier_lines_free(&lines);
}

int
main(int argc, char **argv)
{
	check_begin(argc, argv);
	RUN(as_if_every_disc_were_tried);
	RUN(rings_of_squares_leave_nobody_out);
	RUN(a_list_is_what_was_kept_last_or_none);
	RUN(segments_near_a_place_are_listed);
	return check_end();
}
