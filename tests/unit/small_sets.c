/* small_sets.c - see sets.h */
#include "sets.h"

#include <stdlib.h>

#define WHOLE (INT64_C(1) << 30)

const char *const small_kind_name[SMALL_KINDS] = {
	"tiny range", "modest range",	"whole grid",	"corners",		 "duplicates", "lattice", "shaken lattice",
	"axis line",  "diagonal line",	"slanted line", "nearly a line", "circle",	   "rings",	  "clusters in clusters",
	"two lines",  "crossing lines", "hub and rim",	"parabola",		 "rectangles",
};

/* nearest position on the grid */
static ty_position
at(int64_t x, int64_t y)
{
	ty_position p;

	p.x = (int32_t) (x < 0 ? 0 : x > WHOLE ? WHOLE : x);
	p.y = (int32_t) (y < 0 ? 0 : y > WHOLE ? WHOLE : y);
	return p;
}

static ty_position
anywhere(random_state *random, int64_t range)
{
	int64_t x = random_between(random, 0, range);

	return at(x, random_between(random, 0, range));
}

static ty_position
corner(random_state *random)
{
	int64_t x = random_between(random, 0, 1) * WHOLE + random_between(random, -2, 2);

	return at(x, random_between(random, 0, 1) * WHOLE + random_between(random, -2, 2));
}

/* a multiple of (step_x, step_y), from near the middle or from the origin */
static ty_position
on_line(random_state *random, int64_t origin, int64_t step_x, int64_t step_y, size_t n)
{
	int64_t i = random_between(random, 0, (int64_t) (2 * n));

	return at(origin + i * step_x, origin + i * step_y);
}

/* whole numbers with x^2 + y^2 = 5525^2 * factor^2: 5525 = 5^2 * 13 * 17 has 180 of them, here in the first octant */
static const int64_t circle_5525[][2] = {
	{0, 5525},	  {235, 5520},	{525, 5500},  {612, 5491},	{845, 5460},  {1036, 5427}, {1131, 5408}, {1320, 5365},
	{1360, 5355}, {1547, 5304}, {2044, 5133}, {2125, 5100}, {2163, 5084}, {2340, 5005}, {2600, 4875}, {2805, 4760},
	{2880, 4715}, {3124, 4557}, {3315, 4420}, {3468, 4301}, {3500, 4275}, {3720, 4085}, {3861, 3952},
};

static ty_position
on_circle(random_state *random, int64_t centre, int64_t factor)
{
	size_t octants = sizeof circle_5525 / sizeof circle_5525[0];
	const int64_t *p = circle_5525[random_between(random, 0, (int64_t) octants - 1)];
	bool swap = random_between(random, 0, 1) == 1;
	int64_t x = random_between(random, 0, 1) == 1 ? p[swap] : -p[swap];
	int64_t y = random_between(random, 0, 1) == 1 ? p[!swap] : -p[!swap];

	return at(centre + factor * x, centre + factor * y);
}

/* each level a few offsets around the level above, sixteen times smaller */
static ty_position
in_clusters(random_state *random)
{
	int64_t x = 0;
	int64_t y = 0;

	for (int64_t size = WHOLE / 4; size > 0; size /= 16)
	{
		x += size * random_between(random, 0, 2);
		y += size * random_between(random, 0, 2);
		if (random_between(random, 0, 3) == 0)
			break;
	}
	return at(x, y);
}

static ty_position
lattice(random_state *random, int64_t step_x, int64_t step_y, size_t n)
{
	int64_t side = 2;

	while (side * side < (int64_t) n)
		side++;
	int64_t column = random_between(random, 0, side);
	int64_t row = random_between(random, 0, side);

	return at(100 + step_x * column, 100 + step_y * row);
}

static ty_position
shaken(random_state *random, ty_position p)
{
	int64_t x = p.x + random_between(random, -1, 1);

	return at(x, p.y + random_between(random, -1, 1));
}

/* What all points of a set share, drawn once. */
typedef struct recipe
{
	int64_t step, factor, origin;
	bool along_x;
} recipe;

static recipe
draw_recipe(random_state *random)
{
	static const int64_t steps[] = {1, 2, 3, 7, 1000, 1 << 20};
	static const int64_t factors[] = {1, 2, 10, 90000};
	recipe r;

	r.step = steps[random_between(random, 0, 5)];
	r.factor = factors[random_between(random, 0, 3)];
	r.origin = random_between(random, 0, 1) == 0 ? 0 : WHOLE / 2 - random_between(random, 0, 9);
	r.along_x = random_between(random, 0, 1) == 1;
	return r;
}

static ty_position
on_one_of_two_lines(random_state *random, const recipe *r, size_t n)
{
	int64_t i = random_between(random, 0, (int64_t) n);
	int64_t apart = random_between(random, 0, 1) * r->factor * 3;

	return r->along_x ? at(1000 + i * r->step, 1000 + apart) : at(1000 + apart + i * r->step, 1000 + i * r->step);
}

static ty_position
on_a_cross(random_state *random, const recipe *r, size_t n)
{
	int64_t i = random_between(random, -(int64_t) n, (int64_t) n) * r->step;
	bool second = random_between(random, 0, 1) == 1;

	if (r->along_x)
		return second ? at(WHOLE / 2 + i, WHOLE / 2) : at(WHOLE / 2, WHOLE / 2 + i);
	return second ? at(WHOLE / 2 + i, WHOLE / 2 + i) : at(WHOLE / 2 + i, WHOLE / 2 - i);
}

static ty_position
on_parabola(random_state *random, size_t n)
{
	int64_t i = random_between(random, -(int64_t) n, (int64_t) n);

	return at(WHOLE / 2 + i, i * i);
}

static ty_position
small_point(small_kind kind, random_state *random, const recipe *r, size_t n, size_t i)
{
	int64_t apart = WHOLE / 2;

	switch (kind)
	{
		case SMALL_TINY_RANGE:
			return anywhere(random, r->along_x ? 3 : 2);
		case SMALL_MODEST_RANGE:
			return anywhere(random, r->along_x ? 20 : 1000);
		case SMALL_WHOLE_GRID:
			return anywhere(random, WHOLE);
		case SMALL_CORNERS:
			return corner(random);
		case SMALL_LATTICE:
			return lattice(random, r->step, r->step, n);
		case SMALL_SHAKEN_LATTICE:
			return shaken(random, lattice(random, r->step, r->step, n));
		case SMALL_AXIS_LINE:
			return on_line(random, r->origin, r->along_x ? r->step : 0, r->along_x ? 0 : r->step, n);
		case SMALL_DIAGONAL_LINE:
			return on_line(random, r->origin, r->step, r->step, n);
		case SMALL_SLANTED_LINE:
			return on_line(random, r->origin, 3 * r->step, r->step, n);
		case SMALL_NEARLY_A_LINE:
			return shaken(random, on_line(random, r->origin, 3 * r->step, r->step, n));
		case SMALL_CIRCLE:
			return on_circle(random, apart, r->factor);
		case SMALL_RINGS:
			return on_circle(random, apart, r->factor << (i % 3 == 0 ? 0 : 1));
		case SMALL_CLUSTERS_IN_CLUSTERS:
			return in_clusters(random);
		case SMALL_TWO_LINES:
			return on_one_of_two_lines(random, r, n);
		case SMALL_CROSSING_LINES:
			return on_a_cross(random, r, n);
		case SMALL_HUB_AND_RIM:
			return i == 0 ? at(apart, apart) : on_circle(random, apart, r->factor);
		case SMALL_PARABOLA:
			return on_parabola(random, n);
		case SMALL_RECTANGLES:
			return lattice(random, r->step, 2 * r->step, n);
		case SMALL_DUPLICATES:
		case SMALL_KINDS:
			break;
	}
	return anywhere(random, WHOLE);
}

void
small_set(small_kind kind, random_state *random, ty_position *position, size_t n)
{
	recipe r = draw_recipe(random);
	size_t distinct = kind == SMALL_DUPLICATES ? 1 + n / 3 : n;

	for (size_t i = 0; i < n; i++)
	{
		if (i < distinct)
			position[i] = small_point(kind, random, &r, n, i);
		else
			position[i] = position[random_between(random, 0, (int64_t) distinct - 1)];
	}
}

static int
compare_keys(const void *a, const void *b)
{
	uint64_t key_a = ty_hilbert_key(*(const ty_position *) a);
	uint64_t key_b = ty_hilbert_key(*(const ty_position *) b);

	return (key_a > key_b) - (key_a < key_b);
}

void
sort_along_curve(ty_position *position, uint64_t *keys, size_t n)
{
	qsort(position, n, sizeof *position, compare_keys);
	for (size_t i = 0; i < n; i++)
		keys[i] = ty_hilbert_key(position[i]);
}

void
vertices_at_positions(const ty_position *position, size_t n, ty_vertex *vertex)
{
	for (size_t i = 0; i < n; i++)
		vertex[i] = (ty_vertex){position[i], TY_NONE, 1};
}

void
positions_of_vertices(const ty_vertex *vertex, size_t n, ty_position *position)
{
	for (size_t i = 0; i < n; i++)
		position[i] = vertex[i].position;
}
