/*
 * test_predicates.c - the fear: one wrong sign in ten million makes a mesh that is none. A million nearly
 * degenerate cases against GMP, whose integers have no limit.
 */
#include "check.h"
#include "predicates.h"
#include "random.h"
#include "reference.h"

#include <gmp.h>

#define CASES 1000000
#define WHOLE (INT64_C(1) << 30)

static mpz_t term, sum, factor[6];

static void
begin_exact(void)
{
	mpz_inits(term, sum, NULL);
	for (size_t i = 0; i < 6; i++)
		mpz_init(factor[i]);
}

static void
end_exact(void)
{
	mpz_clears(term, sum, NULL);
	for (size_t i = 0; i < 6; i++)
		mpz_clear(factor[i]);
}

/* out = twice the signed area of a, b, c */
static void
exact_area(mpz_t out, ty_position a, ty_position b, ty_position c)
{
	mpz_set_si(out, (long) b.x - a.x);
	mpz_mul_si(out, out, (long) c.y - a.y);
	mpz_set_si(term, (long) b.y - a.y);
	mpz_mul_si(term, term, (long) c.x - a.x);
	mpz_sub(out, out, term);
}

/*
 * out = the height of p on the paraboloid, times 2^900, plus 2^(200 * (3 - place)): an infinitesimal that is larger
 * for the smaller ranks by more than all areas and heights (below 2^130) together. place < 0: nothing is added.
 */
static void
exact_lift(mpz_t out, ty_position p, int place)
{
	mpz_set_si(out, p.x);
	mpz_mul(out, out, out);
	mpz_set_si(term, p.y);
	mpz_addmul(out, term, term);
	mpz_mul_2exp(out, out, 900);
	if (place < 0)
		return;
	mpz_set_ui(term, 1);
	mpz_mul_2exp(term, term, (mp_bitcnt_t) (200 * (3 - place)));
	mpz_add(out, out, term);
}

/*
 * Sign of: the lifted p[3] lies below the plane through the lifted p[0], p[1], p[2] (counter-clockwise), which is
 * lift0 [312] + lift1 [032] + lift2 [013] - lift3 [012] > 0 with [] as twice the signed area.
 */
static int
exact_in_circle(const ty_position p[4], const int place[4])
{
	static const int corner[4][3] = {{3, 1, 2}, {0, 3, 2}, {0, 1, 3}, {0, 1, 2}};

	mpz_set_ui(sum, 0);
	for (int i = 0; i < 4; i++)
	{
		exact_area(factor[0], p[corner[i][0]], p[corner[i][1]], p[corner[i][2]]);
		exact_lift(factor[1], p[i], place[i]);
		if (i < 3)
			mpz_addmul(sum, factor[0], factor[1]);
		else
			mpz_submul(sum, factor[0], factor[1]);
	}
	return mpz_sgn(sum);
}

static int32_t
clamped(int64_t value)
{
	return (int32_t) (value < 0 ? 0 : value > WHOLE ? WHOLE : value);
}

static int64_t
draw_range(random_state *random)
{
	return WHOLE >> random_between(random, 1, 29);
}

/* four of the eight images of one vector under the symmetries of the square, around one centre: cocircular */
static void
draw_cocircular(random_state *random, ty_position p[4])
{
	int64_t range = draw_range(random) / 2;
	int64_t vector[2] = {random_between(random, 0, range), random_between(random, 0, range)};
	int64_t x = random_between(random, range, WHOLE - range);
	int64_t y = random_between(random, range, WHOLE - range);

	for (int i = 0; i < 4; i++)
	{
		int64_t bits = random_between(random, 0, 7);

		p[i].x = clamped(x + (bits & 1 ? -1 : 1) * vector[(bits & 4) != 0]);
		p[i].y = clamped(y + (bits & 2 ? -1 : 1) * vector[(bits & 4) == 0]);
	}
}

/* multiples of one vector from one point */
static void
draw_collinear(random_state *random, ty_position p[4])
{
	int64_t range = draw_range(random) / 8;
	int64_t step_x = random_between(random, -range, range);
	int64_t step_y = random_between(random, -range, range);
	int64_t x = random_between(random, 0, WHOLE);
	int64_t y = random_between(random, 0, WHOLE);

	for (int i = 0; i < 4; i++)
	{
		int64_t multiple = random_between(random, -4, 4);

		p[i].x = clamped(x + multiple * step_x);
		p[i].y = clamped(y + multiple * step_y);
	}
}

static void
draw_corners(random_state *random, ty_position p[4])
{
	for (int i = 0; i < 4; i++)
	{
		p[i].x = clamped(random_between(random, 0, 1) * WHOLE + random_between(random, -3, 3));
		p[i].y = clamped(random_between(random, 0, 1) * WHOLE + random_between(random, -3, 3));
	}
}

static void
draw_anything(random_state *random, ty_position p[4])
{
	int64_t range = draw_range(random);
	int64_t x = random_between(random, 0, WHOLE - range);
	int64_t y = random_between(random, 0, WHOLE - range);

	for (int i = 0; i < 4; i++)
	{
		p[i].x = (int32_t) random_between(random, x, x + range);
		p[i].y = (int32_t) random_between(random, y, y + range);
	}
}

/* four positions that are degenerate, or one cell away from it, or anything */
static void
draw_case(random_state *random, size_t i, ty_position p[4])
{
	static void (*const draws[])(random_state *, ty_position[4]) = {draw_cocircular, draw_cocircular, draw_collinear,
																	draw_corners, draw_anything};

	draws[i % 5](random, p);
	if (random_between(random, 0, 1) == 0)
		return;
	p[3].x = clamped(p[3].x + random_between(random, -1, 1));
	p[3].y = clamped(p[3].y + random_between(random, -1, 1));
}

/* makes p[0], p[1], p[2] counter-clockwise; false when they are collinear */
static bool
turn_left(ty_position p[4])
{
	ty_position second = p[1];
	int turn = reference_orientation(p[0], p[1], p[2]);

	if (turn < 0)
	{
		p[1] = p[2];
		p[2] = second;
	}
	return turn != 0;
}

static bool
differ(const ty_position p[4])
{
	for (int i = 0; i < 4; i++)
		for (int k = 0; k < i; k++)
			if (p[i].x == p[k].x && p[i].y == p[k].y)
				return false;
	return true;
}

#define SHOW "{%d, %d} {%d, %d} {%d, %d} {%d, %d}"
#define SHOWN(p) p[0].x, p[0].y, p[1].x, p[1].y, p[2].x, p[2].y, p[3].x, p[3].y

static void
orientation_is_exact(void)
{
	random_state random = random_seed(1);
	ty_position p[4];
	size_t collinear = 0;

	for (size_t i = 0; i < CASES; i++)
	{
		draw_case(&random, i, p);
		exact_area(factor[0], p[0], p[1], p[3]);
		CHECK(mpz_cmp_si(factor[0], ty_orientation(p[0], p[1], p[3])) == 0, SHOW, SHOWN(p));
		CHECK(reference_orientation(p[0], p[1], p[3]) == mpz_sgn(factor[0]), "the reference: " SHOW, SHOWN(p));
		collinear += mpz_sgn(factor[0]) == 0;
	}
	CHECK(collinear > CASES / 20, "only %zu cases were collinear", collinear);
}

static void
in_circle_is_exact(void)
{
	static const int no_place[4] = {-1, -1, -1, -1};
	random_state random = random_seed(2);
	ty_position p[4];
	size_t cocircular = 0;

	for (size_t i = 0; i < CASES; i++)
	{
		int expected;

		do
			draw_case(&random, i, p);
		while (!turn_left(p));
		expected = exact_in_circle(p, no_place);
		CHECK(ty_in_circle_sign(p[0], p[1], p[2], p[3]) == expected, SHOW ": not %d", SHOWN(p), expected);
		cocircular += expected == 0;
	}
	CHECK(cocircular > CASES / 10, "only %zu cases were cocircular", cocircular);
}

/* ranks that differ, and the place of each among the four */
static void
draw_ranks(random_state *random, uint32_t rank[4], int place[4])
{
	for (int i = 0; i < 4; i++)
		rank[i] = (uint32_t) (random_between(random, 0, 1000) * 4 + i);
	for (int i = 0; i < 4; i++)
	{
		uint32_t other = rank[i];
		int k = (int) random_between(random, 0, 3);

		rank[i] = rank[k];
		rank[k] = other;
	}
	for (int i = 0; i < 4; i++)
		place[i] = (rank[0] < rank[i]) + (rank[1] < rank[i]) + (rank[2] < rank[i]) + (rank[3] < rank[i]);
}

static void
cocircular_points_are_decided_as_if_lifted(void)
{
	random_state random = random_seed(3);
	ty_position p[4];
	uint32_t r[4];
	int place[4];

	for (size_t i = 0; i < CASES; i++)
	{
		bool expected;
		ty_position at[4];

		do
			draw_case(&random, i % 3, p);
		while (!differ(p) || !turn_left(p));
		draw_ranks(&random, r, place);
		expected = exact_in_circle(p, place) > 0;
		CHECK(ty_in_circle(p[0], p[1], p[2], p[3], r[0], r[1], r[2], r[3]) == expected,
			  SHOW " ranks %u %u %u %u: not %d", SHOWN(p), r[0], r[1], r[2], r[3], expected);
		for (int k = 0; k < 4; k++)
			at[place[k]] = p[k];
		CHECK(reference_in_circle(at, (uint32_t) place[0], (uint32_t) place[1], (uint32_t) place[2],
								  (uint32_t) place[3]) == expected,
			  "the reference: " SHOW, SHOWN(p));
	}
}

/* of a unit square one diagonal is in the mesh, whichever triangle is asked */
static void
both_triangles_beside_an_edge_agree(void)
{
	random_state random = random_seed(4);
	ty_position p[4];
	uint32_t r[4];
	int place[4];

	for (size_t i = 0; i < CASES / 10; i++)
	{
		do
			draw_cocircular(&random, p);
		while (!differ(p) || !turn_left(p));
		if (reference_orientation(p[0], p[2], p[3]) <= 0 || reference_orientation(p[0], p[1], p[3]) <= 0 ||
			reference_orientation(p[1], p[2], p[3]) <= 0)
			continue;
		draw_ranks(&random, r, place);
		bool one = ty_in_circle(p[0], p[1], p[2], p[3], r[0], r[1], r[2], r[3]);
		bool other = ty_in_circle(p[0], p[2], p[3], p[1], r[0], r[2], r[3], r[1]);
		bool flipped = ty_in_circle(p[1], p[2], p[3], p[0], r[1], r[2], r[3], r[0]);

		CHECK(one == other && one != flipped, SHOW " ranks %u %u %u %u", SHOWN(p), r[0], r[1], r[2], r[3]);
	}
}

int
main(int argc, char **argv)
{
	check_begin(argc, argv);
	begin_exact();
	RUN(orientation_is_exact);
	RUN(in_circle_is_exact);
	RUN(cocircular_points_are_decided_as_if_lifted);
	RUN(both_triangles_beside_an_edge_agree);
	end_exact();
	return check_end();
}
