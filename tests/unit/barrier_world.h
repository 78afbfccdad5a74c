/*
 * barrier_world.h - random lines for tests of barriers, and the reference that looks at each of their segments.
 */
#ifndef TY_BARRIER_WORLD_H
#define TY_BARRIER_WORLD_H

#include "barrier.h"
#include "check.h"
#include "random.h"

#include <math.h>

#define MOST_POINTS 4000
#define LINE_MOST 40
#define SIDE (INT64_C(1) << TY_GRID_BITS)

/* the grid whose point (0, 0) is at (x, y) */
static inline ty_grid
grid_of(double cell, double x, double y)
{
	return (ty_grid){cell, x / cell, y / cell};
}

static inline void
free_both(ty_barrier_lines *lines, ty_barriers *barriers)
{
	ty_barriers_free(barriers);
	ty_barrier_lines_free(lines);
}

typedef __int128 wide;

typedef struct wide_point
{
	wide x, y;
} wide_point;

static inline int
sign_of_turn(wide_point a, wide_point b, wide_point c)
{
	wide t = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);

	return (t > 0) - (t < 0);
}

typedef struct world
{
	ty_point points[MOST_POINTS];
	uint32_t first[MOST_POINTS], count[MOST_POINTS];
	size_t lines, used;
} world;

static world all;

static inline ty_point
somewhere(random_state *random, double side)
{
	return (ty_point){floor(random_unit(random) * side), floor(random_unit(random) * side)};
}

/* lines of random length and step: streets, long straight ones, crowds */
static inline void
make_lines(random_state *random, size_t points, double side)
{
	all.lines = all.used = 0;
	while (all.used + LINE_MOST < points)
	{
		uint32_t n = (uint32_t) random_between(random, 1, LINE_MOST);
		double step = side * pow(2, -(double) random_between(random, 0, 12));
		ty_point at = somewhere(random, side);

		all.first[all.lines] = (uint32_t) all.used;
		all.count[all.lines++] = n;
		for (uint32_t i = 0; i < n; i++)
		{
			all.points[all.used++] = at;
			at.x = fmin(fmax(floor(at.x + (random_unit(random) - 0.5) * step), 0), side);
			at.y = fmin(fmax(floor(at.y + (random_unit(random) - 0.5) * step), 0), side);
		}
	}
}

static inline void
gather(const ty_environment *env, ty_barrier_lines *lines)
{
	ty_barrier_lines_begin(lines, env);
	for (size_t l = 0; l < all.lines; l++)
		CHECK(ty_barrier_lines_add(lines, all.points + all.first[l], sizeof(ty_point), all.count[l]) == TY_OK,
			  "line %zu", l);
	CHECK(ty_barrier_lines_end(lines) == TY_OK, "end");
}

/* large coordinates leave no room for a real move: what lies on a line is settled by the rule */
static inline int
settled(int sign, int64_t dx, int64_t dy, int factor)
{
	if (sign != 0)
		return sign;
	return factor * (dy != 0 ? (dy < 0 ? 1 : -1) : (dx > 0 ? 1 : -1));
}

static inline bool
reference_cross(ty_position a, ty_position b, ty_point c, ty_point d)
{
	wide_point p = {a.x, a.y}, q = {b.x, b.y};
	wide_point u = {(wide) c.x, (wide) c.y}, v = {(wide) d.x, (wide) d.y};
	int64_t dx = (int64_t) (v.x - u.x), dy = (int64_t) (v.y - u.y);

	if ((dx == 0 && dy == 0) || (a.x == b.x && a.y == b.y))
		return false;
	return settled(sign_of_turn(p, q, u), (int64_t) b.x - a.x, (int64_t) b.y - a.y, -1) !=
			   settled(sign_of_turn(p, q, v), (int64_t) b.x - a.x, (int64_t) b.y - a.y, -1) &&
		   settled(sign_of_turn(u, v, p), dx, dy, 1) != settled(sign_of_turn(u, v, q), dx, dy, 1);
}

static inline bool
reference_cross_any(ty_position a, ty_position b)
{
	for (size_t l = 0; l < all.lines; l++)
		for (uint32_t i = 1; i < all.count[l]; i++)
			if (reference_cross(a, b, all.points[all.first[l] + i - 1], all.points[all.first[l] + i]))
				return true;
	return false;
}

static inline int32_t
on_side(double v, double side)
{
	return (int32_t) fmin(fmax(v, 0), side);
}

#endif
