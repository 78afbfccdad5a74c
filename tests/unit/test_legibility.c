/*
 * test_legibility.c - the fear: two placeholders overlap or come nearer than the gap, or one to a barrier, somebody is
 * lost, one is moved farther or drawn smaller than allowed, or a kept one is touched. Distances are measured anew here,
 * edge by edge. Groups have rows, kept buildings and barriers by turns.
 *
 * The environment variable SETS says how many random groups are made legible.
 */
#include "barrier.h"
#include "check.h"
#include "group.h"
#include "legibility.h"
#include "random.h"

#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#define TOLERANCE 1e-6
#define ROUNDING 1e-5 /* metres: room for it is part of the gap */
#define GROUPS 100000
#define MOST 40
#define LINES 3

/* a group, with what may be said of it */
typedef struct set
{
	size_t n;
	ty_building b[MOST];
	double importance[MOST];
	ty_parameters p;
	ty_point line[LINES][2];
	ty_barrier_lines lines; /* with barriers; else none */
	bool weighed, barred;
	char name[256];
} set;

/* ---- distances, the plain way ---- */

static double
point_to_segment(ty_point p, ty_point a, ty_point b)
{
	double dx = b.x - a.x, dy = b.y - a.y, square = dx * dx + dy * dy;
	double t = square > 0 ? ((p.x - a.x) * dx + (p.y - a.y) * dy) / square : 0;

	t = t < 0 ? 0 : t > 1 ? 1 : t;
	return hypot(p.x - a.x - t * dx, p.y - a.y - t * dy);
}

static double
side_of(ty_point a, ty_point b, ty_point p)
{
	return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

static bool
edges_cross(ty_point a, ty_point b, ty_point c, ty_point d)
{
	return side_of(a, b, c) * side_of(a, b, d) < 0 && side_of(c, d, a) * side_of(c, d, b) < 0;
}

static bool
inside(const ty_point ring[5], ty_point p)
{
	for (int i = 0; i < 4; i++)
		if (side_of(ring[i], ring[i + 1], p) < 0)
			return false;
	return true;
}

static double
ring_distance(const ty_point a[5], const ty_point b[5])
{
	double least = INFINITY;

	if (inside(a, b[0]) || inside(b, a[0]))
		return 0;
	for (int i = 0; i < 4; i++)
		for (int j = 0; j < 4; j++)
		{
			if (edges_cross(a[i], a[i + 1], b[j], b[j + 1]))
				return 0;
			least = fmin(least, point_to_segment(a[i], b[j], b[j + 1]));
			least = fmin(least, point_to_segment(b[j], a[i], a[i + 1]));
		}
	return least;
}

/* relative to the first placeholder, for precision */
static void
ring_of(const ty_placeholder *p, const ty_placeholder *origin, ty_point ring[5])
{
	ty_rectangle((ty_point){p->x - origin->x, p->y - origin->y}, p->area, p->ratio, p->ux, p->uy, ring);
}

/* ---- what every result must be ---- */

static void
describe(set *s, uint64_t number)
{
	const ty_parameters *p = &s->p;

	snprintf(s->name, sizeof s->name,
			 "set %llu, %zu buildings at %g, s_u %g, side %g, area %g, gap %g, alignment %g, keep %g, shape %d, "
			 "statistic %d%s%s",
			 (unsigned long long) number, s->n, p->scale, p->s_u, p->min_side, p->max_area, p->min_gap, p->alignment,
			 p->keep_area, (int) p->shape, (int) p->area_statistic, s->weighed ? ", importances" : "",
			 s->barred ? ", barriers" : "");
}

static bool
surely_apart(const ty_placeholder *a, const ty_placeholder *b, double gap)
{
	return fmax(fabs(a->x - b->x), fabs(a->y - b->y)) > a->length + b->length + gap;
}

static void
check_apart(const ty_result *r, const ty_parameters *p, const char *set)
{
	for (size_t i = 1; i < r->count; i++)
		for (size_t j = 0; j < i; j++)
		{
			ty_point a[5], b[5];
			double distance;

			if (!(r->placeholders[i].area > 0) || !(r->placeholders[j].area > 0) ||
				surely_apart(&r->placeholders[i], &r->placeholders[j], p->min_gap) ||
				(r->placeholders[i].kept && r->placeholders[j].kept))
				continue;
			ring_of(&r->placeholders[i], &r->placeholders[0], a);
			ring_of(&r->placeholders[j], &r->placeholders[0], b);
			distance = ring_distance(a, b);
			CHECK(distance >= p->min_gap * (1 - TOLERANCE), "%s: %zu and %zu are %.17g apart", set, i, j, distance);
		}
}

/* Nobody but kept ones is nearer to a line than half its symbol and the gap. */
static void
check_lines(const set *s, const ty_result *r)
{
	double limit = s->p.min_gap + 0.5 * s->p.barrier_width;

	for (size_t i = 0; s->barred && i < r->count; i++)
		for (int k = 0; k < LINES; k++)
		{
			const ty_placeholder *q = &r->placeholders[i];
			ty_point ring[5], a = {s->line[k][0].x - q->x, s->line[k][0].y - q->y};
			ty_point b = {s->line[k][1].x - q->x, s->line[k][1].y - q->y};
			double distance = INFINITY;

			if (!(q->area > 0) || q->kept)
				continue;
			ring_of(q, q, ring);
			if (inside(ring, a))
				distance = 0;
			for (int e = 0; e < 4; e++)
			{
				if (edges_cross(ring[e], ring[e + 1], a, b))
					distance = 0;
				distance = fmin(distance, point_to_segment(ring[e], a, b));
				distance = fmin(distance, point_to_segment(a, ring[e], ring[e + 1]));
				distance = fmin(distance, point_to_segment(b, ring[e], ring[e + 1]));
			}
			CHECK(distance >= limit * (1 - TOLERANCE), "%s: %zu is %.17g from line %d", s->name, i, distance, k);
		}
}

/* Every kept building is drawn, where it is, and as large as it is or as wide as can be seen. */
static void
check_kept(const set *s, const ty_result *r)
{
	for (size_t i = 0; i < s->n; i++)
	{
		const ty_building *b = &s->b[i];
		bool drawn = false;

		if (!(b->area > 0) || !ty_is_kept(&s->p, b->area, s->weighed ? s->importance[i] : 1))
			continue;
		for (size_t k = 0; k < r->count && !drawn; k++)
		{
			const ty_placeholder *q = &r->placeholders[k];

			drawn = q->representative == i && q->kept && q->x == b->x && q->y == b->y &&
					q->area >= b->area * (1 - TOLERANCE) &&
					(q->area <= b->area * (1 + TOLERANCE) || q->width <= s->p.min_side * (1 + TOLERANCE));
		}
		CHECK(drawn, "%s: kept building %zu is not in place and in size", s->name, i);
	}
}

/* Nobody is farther from home than the gap or half its longer side; beside a line, than takes it off the symbol. */
static void
check_moves(const set *s, const ty_result *r)
{
	for (size_t k = 0; r->sites != NULL && k < r->count; k++)
	{
		const ty_site *site = &r->sites[k];
		double moved = sqrt(site->moved.x * site->moved.x + site->moved.y * site->moved.y);
		double bound = fmax(s->p.min_gap, 0.5 * ty_site_sides(site).length);

		if (s->barred)
			bound = fmax(bound, s->p.min_gap + 0.5 * s->p.barrier_width + 0.5 * site->least.length);
		CHECK(site->state != TY_DRAWN || moved <= bound + ROUNDING, "%s: %zu is %.17g from home, not %.17g", s->name, k,
			  moved, bound);
	}
}

/* the mean of the members' places, and so where an unmoved placeholder would be */
static ty_point
mean_place(const ty_building *b, const uint32_t *members, size_t count)
{
	double x = 0, y = 0;

	for (size_t i = 0; i < count; i++)
	{
		x += b[members[i]].x - b[members[0]].x;
		y += b[members[i]].y - b[members[0]].y;
	}
	return (ty_point){b[members[0]].x + x / (double) count, b[members[0]].y + y / (double) count};
}

static void
check_sizes(const set *s, const ty_result *r)
{
	const ty_building *b = s->b;
	const ty_parameters *p = &s->p;
	const char *set = s->name;

	for (size_t i = 0; i < r->count; i++)
	{
		const ty_placeholder *q = &r->placeholders[i];
		ty_point home = mean_place(b, r->members + q->first, q->count);
		double moved = hypot(q->x - home.x, q->y - home.y), rounding = 1e-9 * (fabs(home.x) + fabs(home.y) + 1e5);
		double limit =
			p->max_area > 0 ? fmax(p->max_area, fmax(q->statistic, 1.5 * p->min_side * p->min_side)) : INFINITY;

		if (!(q->area > 0))
			continue;
		if (s->weighed || s->barred || p->alignment > 0 || p->keep_area > 0)
			moved = 0;
		if (q->kept)
			limit = INFINITY;
		CHECK(q->width >= p->min_side * (1 - TOLERANCE), "%s: %zu is %.17g wide", set, i, q->width);
		CHECK(q->width <= q->length * (1 + TOLERANCE), "%s: %zu is %.17g by %.17g", set, i, q->width, q->length);
		CHECK(q->area <= limit * (1 + TOLERANCE), "%s: %zu is as large as %.17g", set, i, q->area);
		CHECK(moved <= fmax(p->min_gap, 0.5 * q->length) * (1 + TOLERANCE) + rounding, "%s: %zu, %g long, moved %g",
			  set, i, q->length, moved);
	}
}

static void
check_nobody_lost(const ty_result *r, size_t n, const char *set)
{
	bool seen[MOST] = {false};
	size_t total = 0;

	for (size_t i = 0; i < r->count; i++)
	{
		const ty_placeholder *q = &r->placeholders[i];

		CHECK(q->first == total, "%s: members of %zu begin at %u", set, i, q->first);
		total += q->count;
		for (size_t k = 0; k < q->count; k++)
		{
			uint32_t m = r->members[q->first + k];

			CHECK(m < n && !seen[m], "%s: building %u", set, m);
			seen[m] = true;
		}
	}
	CHECK(total == n, "%s: %zu members", set, total);
}

/* ---- random groups ---- */

static void
random_place(random_state *r, int kind, size_t i, double span, ty_building *b)
{
	switch (kind)
	{
		case 0: /* anywhere */
			b->x = span * random_unit(r);
			b->y = span * random_unit(r);
			break;
		case 1: /* a row */
			b->x = span * (double) i / MOST;
			b->y = 0.3 * b->x;
			break;
		case 2: /* few places */
			b->x = span * (double) random_between(r, 0, 2);
			b->y = span * (double) random_between(r, 0, 1);
			break;
		case 3: /* a lattice */
			b->x = span / 6 * (double) (i % 6);
			b->y = span / 6 * (double) (i / 6);
			break;
		case 5: /* three rows of equal houses, not far from each other */
			b->x = span / MOST * 3 * (double) (i / 3);
			b->y = span / MOST * 5 * (double) (i % 3) + span / MOST * 0.1 * random_unit(r);
			break;
		default: /* dense in the middle */
			b->x = span * random_unit(r) * random_unit(r) * random_unit(r);
			b->y = span * random_unit(r) * random_unit(r) * random_unit(r);
	}
}

static void
random_buildings(random_state *r, set *s, double span, double origin)
{
	int kind = (int) random_between(r, 0, 5);

	for (size_t i = 0; i < s->n; i++)
	{
		double angle = 3.14159 * random_unit(r);
		ty_building *b = &s->b[i];

		random_place(r, kind, i, span, b);
		b->x += origin;
		b->y += origin;
		b->area = random_between(r, 0, 9) == 0 ? 0 : pow(10, 1 + 3 * random_unit(r));
		b->ratio = b->area > 0 ? 0.02 + 0.98 * random_unit(r) : 1;
		b->ux = kind == 5 || random_between(r, 0, 2) == 0 ? 1 : cos(angle);
		b->uy = b->ux == 1 ? 0 : sin(angle);
		b->id = (int64_t) i;
		if (kind == 5)
		{
			b->area = 120;
			b->ratio = 0.7;
		}
		s->importance[i] = random_between(r, 0, 5) == 0 ? INFINITY : 1 + (double) random_between(r, 0, 2);
	}
}

static void
random_lines(random_state *r, set *s, double span, double origin)
{
	ty_barrier_lines_begin(&s->lines, &ty_plain_environment);
	for (int k = 0; k < LINES; k++)
	{
		for (int end = 0; end < 2; end++)
			s->line[k][end] =
				(ty_point){origin + span * (1.4 * random_unit(r) - 0.2), origin + span * (1.4 * random_unit(r) - 0.2)};
		NEED(ty_barrier_lines_add(&s->lines, s->line[k], sizeof(ty_point), 2) == TY_OK, "line %d", k);
	}
	NEED(ty_barrier_lines_end(&s->lines) == TY_OK, "lines");
}

static void
random_group(random_state *r, uint64_t number, set *s)
{
	static const double spans[] = {1, 50, 300, 1000, 3000};
	static const double origins[] = {0, -4000, 2.7e6, 1e9};
	double span = spans[random_between(r, 0, 4)], origin = origins[random_between(r, 0, 3)];
	ty_parameters *p = &s->p;

	*s = (set){.n = (size_t) random_between(r, 1, MOST)};
	random_buildings(r, s, span, origin);
	*p = (ty_parameters){.scale = 25000 * (1 + floor(20 * random_unit(r) * random_unit(r))),
						 .s_u = 0.5 * (double) random_between(r, 0, 2),
						 .source_scale = TY_DEFAULT_SOURCE_SCALE,
						 .lod200_scale = TY_DEFAULT_LOD200_SCALE,
						 .exponent = 2 * random_unit(r),
						 .psi = random_unit(r),
						 .law = true,
						 .area_statistic = (ty_area_statistic) random_between(r, 0, 2),
						 .shape = (ty_shape) random_between(r, 0, 1)};
	p->min_side = 0.35 * (double) random_between(r, 0, 2);
	p->max_area = p->min_side * p->min_side * (double) random_between(r, 0, 2);
	p->min_gap = 0.05 * (double) random_between(r, 1, 8);
	p->alignment = 5 * (double) random_between(r, 0, 1);
	p->keep_area = random_between(r, 0, 5) == 0 ? 0.5 : 0;
	p->barrier_width = 0.25 * (double) random_between(r, 0, 2);
	s->weighed = random_between(r, 0, 3) == 0;
	s->barred = random_between(r, 0, 2) == 0;
	if (s->barred)
		random_lines(r, s, span, origin);
	ty_bring_to_ground(p, 1);
	describe(s, number);
}

static ty_input
input_of(const set *s)
{
	return (ty_input){.buildings = s->b,
					  .n = s->n,
					  .importance = s->weighed ? s->importance : NULL,
					  .barriers = s->barred ? &s->lines : NULL};
}

static void
free_group(set *s)
{
	if (s->barred)
		ty_barrier_lines_free(&s->lines);
}

static void
random_small_groups_have_no_violation(void)
{
	random_state r = random_seed(4);
	set s;
	size_t groups = getenv("SETS") != NULL ? (size_t) atol(getenv("SETS")) : GROUPS;
	size_t asked = 0, left = 0, collisions = 0, beside = 0;

	for (uint64_t k = 0; k < groups && check_failures < CHECK_SHOWN; k++)
	{
		ty_input input;
		ty_result result;
		ty_status status;

		random_group(&r, k, &s);
		input = input_of(&s);
		status = ty_typify(&ty_plain_environment, &input, &s.p, &result);
		NEED(status == TY_OK, "%s: status %d", s.name, (int) status);
		asked += ty_count(s.n, &s.p, 1);
		left += result.count;
		collisions += result.collisions.pairs;
		beside += result.collisions.beside_lines;
		check_apart(&result, &s.p, s.name);
		check_lines(&s, &result);
		check_sizes(&s, &result);
		check_kept(&s, &result);
		check_moves(&s, &result);
		check_nobody_lost(&result, s.n, s.name);
		ty_result_free(&ty_plain_environment, &result);
		free_group(&s);
	}
	printf(
		"  information: %zu groups, the law leaves %zu placeholders, %zu are legible; of kept ones %zu pairs collide, "
		"%zu are beside a line\n",
		groups, asked, left, collisions, beside);
}

static int
compare_places(const void *a, const void *b)
{
	return memcmp(a, b, offsetof(ty_placeholder, representative));
}

static void
shuffle(random_state *r, set *s)
{
	for (size_t i = s->n; i > 1; i--)
	{
		size_t j = (size_t) random_between(r, 0, (int64_t) i - 1);
		ty_building swap = s->b[i - 1];
		double importance = s->importance[i - 1];

		s->b[i - 1] = s->b[j];
		s->b[j] = swap;
		s->importance[i - 1] = s->importance[j];
		s->importance[j] = importance;
	}
}

static void
the_order_of_buildings_does_not_matter(void)
{
	random_state r = random_seed(5);
	set s;

	for (uint64_t k = 0; k < 2000 && check_failures < CHECK_SHOWN; k++)
	{
		ty_result one, other;
		ty_input input;

		random_group(&r, k, &s);
		input = input_of(&s);
		NEED(ty_typify(&ty_plain_environment, &input, &s.p, &one) == TY_OK, "%s", s.name);
		shuffle(&r, &s);
		NEED(ty_typify(&ty_plain_environment, &input, &s.p, &other) == TY_OK, "%s shuffled", s.name);
		CHECK(one.count == other.count, "%s: %zu and %zu", s.name, one.count, other.count);
		for (size_t i = 0; i < one.count && i < other.count; i++)
			CHECK(compare_places(&one.placeholders[i], &other.placeholders[i]) == 0, "%s: %zu", s.name, i);
		ty_result_free(&ty_plain_environment, &one);
		ty_result_free(&ty_plain_environment, &other);
		free_group(&s);
	}
}

/* ---- the ladder, step by step ---- */

static ty_parameters
at_100000(void)
{
	ty_parameters p = {.scale = 100000,
					   .source_scale = TY_DEFAULT_SOURCE_SCALE,
					   .lod200_scale = TY_DEFAULT_LOD200_SCALE,
					   .exponent = 0,
					   .psi = TY_DEFAULT_PSI,
					   .law = true};

	p.min_side = 35;
	p.max_area = 2450;
	p.min_gap = 20;
	return p;
}

static ty_building
house(double x, double area)
{
	return (ty_building){.x = x, .area = area, .ratio = 1, .ux = 1, .id = (int64_t) x};
}

static void
typify(const ty_building *b, size_t n, const ty_parameters *p, ty_result *result)
{
	ty_input input = {.buildings = b, .n = n};
	ty_status status = ty_typify(&ty_plain_environment, &input, p, result);

	CHECK(status == TY_OK, "status %d", (int) status);
}

static void
where_there_is_room_nothing_changes(void)
{
	ty_building b[] = {house(0, 100), house(200, 400), house(400, 100)};
	ty_parameters p = at_100000(), plain = p;
	ty_result legible, as_before;

	plain.min_gap = 0;
	typify(b, 3, &p, &legible);
	typify(b, 3, &plain, &as_before);
	CHECK(legible.count == 3 && as_before.count == 3, "%zu and %zu", legible.count, as_before.count);
	for (size_t i = 0; i < 3; i++)
		CHECK(compare_places(&legible.placeholders[i], &as_before.placeholders[i]) == 0, "%zu", i);
	ty_result_free(&ty_plain_environment, &legible);
	ty_result_free(&ty_plain_environment, &as_before);
}

/* two of 400 are drawn 49.5 wide: at 60 apart both can be 40, which is more than the minimum side and true size */
static void
growth_is_taken_back_before_anybody_moves(void)
{
	ty_building b[] = {house(0, 400), house(62, 400)};
	ty_parameters p = at_100000();
	ty_result r;

	typify(b, 2, &p, &r);
	CHECK(r.count == 2 && r.placeholders[0].x == 0 && r.placeholders[1].x == 62, "%zu at %g and %g", r.count,
		  r.placeholders[0].x, r.placeholders[1].x);
	CHECK(r.placeholders[0].width < 49 && r.placeholders[0].width >= 35, "%g wide", r.placeholders[0].width);
	CHECK(r.placeholders[0].width + r.placeholders[1].width > 83, "shrunk more than needed: %g and %g",
		  r.placeholders[0].width, r.placeholders[1].width);
	ty_result_free(&ty_plain_environment, &r);
}

/* halls of 60 by 60 are not drawn smaller while they can move: 70 apart they need 80 */
static void
nobody_is_drawn_below_true_size_while_it_can_move(void)
{
	ty_building b[] = {house(0, 3600), house(70, 3600)};
	ty_parameters p = at_100000();
	ty_result r;

	typify(b, 2, &p, &r);
	CHECK(r.count == 2 && r.placeholders[0].width == 60 && r.placeholders[1].width == 60, "%g and %g wide",
		  r.placeholders[0].width, r.placeholders[1].width);
	CHECK(r.placeholders[0].x < 0 && r.placeholders[1].x > 70, "at %g and %g", r.placeholders[0].x,
		  r.placeholders[1].x);
	CHECK(r.placeholders[1].x - r.placeholders[0].x < 82, "moved more than needed: at %g and %g", r.placeholders[0].x,
		  r.placeholders[1].x);
	ty_result_free(&ty_plain_environment, &r);
}

/* between two others there is no room to move, so the halls become smaller, not fewer */
static void
then_it_is_shrunk_below_true_size(void)
{
	ty_building b[] = {house(0, 3600), house(50, 3600), house(100, 3600), house(150, 3600)};
	ty_parameters p = at_100000();
	ty_result r;
	size_t shrunk = 0;

	typify(b, 4, &p, &r);
	CHECK(r.count == 4, "%zu are left", r.count);
	for (size_t i = 0; i < r.count; i++)
	{
		CHECK(r.placeholders[i].width >= 35, "%g wide", r.placeholders[i].width);
		shrunk += r.placeholders[i].width < 60;
	}
	CHECK(shrunk > 0, "none is shrunk");
	ty_result_free(&ty_plain_environment, &r);
}

static void
at_last_two_are_joined(void)
{
	ty_building b[] = {house(0, 100), house(10, 400), house(20, 100), house(30, 100)};
	ty_parameters p = at_100000();
	ty_result r;
	size_t members = 0;

	typify(b, 4, &p, &r);
	CHECK(r.count == 2, "%zu are left", r.count);
	for (size_t i = 0; i < r.count; i++)
		members += r.placeholders[i].count;
	CHECK(members == 4, "%zu members", members);
	ty_result_free(&ty_plain_environment, &r);
}

/* ---- cells between lines ---- */

static ty_building
house_at(double x, double y)
{
	ty_building b = house(x, 400);

	b.y = y;
	return b;
}

/* That those drawn between two columns have so many members. */
static void
check_cell(const ty_result *r, double low, double high, uint32_t members)
{
	uint32_t found = 0;

	for (size_t i = 0; i < r->count; i++)
		if (r->placeholders[i].x > low && r->placeholders[i].x < high)
			found += r->placeholders[i].count;
	CHECK(found == members, "%u members between %g and %g", found, low, high);
}

/*
 * With 35 for a side and 20 for a gap a cell must be 75 wide. Of streets at 0, 60, 260 and a yard from 400 to 500 the
 * first cell holds nobody, the second two, who are pushed off the streets, and the yard one in its middle.
 */
static void
cells_without_room_hand_on_their_members(void)
{
	const ty_point streets[3][2] = {{{0, -900}, {0, 900}}, {{60, -900}, {60, 900}}, {{260, -900}, {260, 900}}};
	const ty_point yard[5] = {{400, 0}, {500, 0}, {500, 80}, {400, 80}, {400, 0}};
	ty_building b[] = {house_at(30, 0),	 house_at(25, 30),	house_at(35, 60), house_at(80, 10),
					   house_at(240, 0), house_at(420, 38), house_at(480, 42)};
	ty_parameters p = at_100000();
	ty_barrier_lines lines;
	ty_result r;

	ty_barrier_lines_begin(&lines, &ty_plain_environment);
	for (int k = 0; k < 3; k++)
		NEED(ty_barrier_lines_add(&lines, streets[k], sizeof(ty_point), 2) == TY_OK, "street %d", k);
	NEED(ty_barrier_lines_add(&lines, yard, sizeof(ty_point), 5) == TY_OK, "yard");
	NEED(ty_barrier_lines_end(&lines) == TY_OK, "lines");
	NEED(ty_typify(&ty_plain_environment, &(ty_input){.buildings = b, .n = 7, .barriers = &lines}, &p, &r) == TY_OK,
		 "typify");
	CHECK(r.count == 3 && r.hidden == 0, "%zu are left, %zu hidden", r.count, r.hidden);
	check_cell(&r, 97, 160, 4);
	check_cell(&r, 160, 223, 1);
	check_cell(&r, 437, 463, 2);
	check_apart(&r, &p, "cells");
	check_nobody_lost(&r, 7, "cells");
	ty_result_free(&ty_plain_environment, &r);
	ty_barrier_lines_free(&lines);
}

/* ---- crowds ---- */

/* everybody at one place, and everybody close together */
static void
crowds_end_soon(void)
{
	enum
	{
		CROWDED = 20000
	};
	ty_building *b = malloc(CROWDED * sizeof *b);
	random_state r = random_seed(6);

	for (int kind = 0; kind < 3; kind++)
		for (int statistic = TY_MEAN; statistic <= TY_MEDIAN; statistic++)
		{
			ty_parameters p = at_100000();
			ty_result result;

			for (size_t i = 0; i < CROWDED; i++)
			{
				b[i] = house(kind == 0 ? 5 : 300 * random_unit(&r), 100 + (double) (i % 7));
				b[i].y = kind == 2 ? 300 * random_unit(&r) : 5;
				b[i].id = (int64_t) i;
			}
			p.area_statistic = (ty_area_statistic) statistic;
			typify(b, CROWDED, &p, &result);
			CHECK(result.count >= 1 && result.count < 60, "kind %d: %zu are left", kind, result.count);
			check_apart(&result, &p, "crowd");
			ty_result_free(&ty_plain_environment, &result);
		}
	free(b);
}

int
main(int argc, char **argv)
{
	check_begin(argc, argv);
	RUN(where_there_is_room_nothing_changes);
	RUN(growth_is_taken_back_before_anybody_moves);
	RUN(nobody_is_drawn_below_true_size_while_it_can_move);
	RUN(then_it_is_shrunk_below_true_size);
	RUN(at_last_two_are_joined);
	RUN(cells_without_room_hand_on_their_members);
	RUN(the_order_of_buildings_does_not_matter);
	RUN(crowds_end_soon);
	RUN(random_small_groups_have_no_violation);
	return check_end();
}
