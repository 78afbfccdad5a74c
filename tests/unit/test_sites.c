/*
 * test_sites.c - the fear: sites that are not of one group are joined, or lost where they could stay; fixed ones move; a
 * cell without room takes time that grows with its square.
 */
#include "check.h"
#include "legibility.h"

#include <math.h>
#include <stddef.h>

#define TOLERANCE 1e-6

/* ---- sites of groups that are not joined ---- */

static ty_site
square_site(double x, double side, uint32_t group, uint32_t weight)
{
	return (ty_site){.home = {x, 0},
					 .ux = 1,
					 .full = {side, side},
					 .own = {side, side},
					 .least = {10, 10},
					 .weight = weight,
					 .group = group,
					 .row = TY_NO_ROW,
					 .size = 2};
}

static void
sites_of_different_groups_are_hidden_last(void)
{
	ty_site s[] = {square_site(0, 10, 0, 3), square_site(1, 10, 1, 2), square_site(2, 10, 2, 1)};
	ty_legibility rules = {.gap = 8};
	ty_status status = ty_make_legible(&ty_plain_environment, &rules, s, 3);

	CHECK(status == TY_OK, "status %d", (int) status);
	CHECK(s[0].state == TY_DRAWN && s[1].state == TY_HIDDEN && s[2].state == TY_DRAWN, "states %d %d %d",
		  (int) s[0].state, (int) s[1].state, (int) s[2].state);
}

/* three of one group, just far enough apart as they came, pushed together from both sides */
static void
sites_of_one_group_go_back_to_where_they_were_apart(void)
{
	ty_site s[] = {square_site(0, 10, 0, 1), square_site(18, 10, 0, 1), square_site(36, 10, 0, 1),
				   square_site(-12, 10, 1, 1), square_site(48, 10, 2, 1)};
	ty_legibility rules = {.gap = 8};
	ty_status status;

	s[3].fixed = s[4].fixed = true;
	status = ty_make_legible(&ty_plain_environment, &rules, s, 5);
	CHECK(status == TY_OK && s[1].state == TY_DRAWN && s[3].state == TY_DRAWN && s[4].state == TY_DRAWN,
		  "status %d, states %d %d %d", (int) status, (int) s[0].state, (int) s[1].state, (int) s[2].state);
	for (int i = 1; i < 5; i++)
		for (int j = 0; j < i; j++)
			if (s[i].state == TY_DRAWN && s[j].state == TY_DRAWN)
				CHECK(fabs(s[i].home.x + s[i].moved.x - s[j].home.x - s[j].moved.x) >= 18 * (1 - TOLERANCE) ||
						  fabs(s[i].moved.y - s[j].moved.y) >= 18 * (1 - TOLERANCE),
					  "%d and %d", i, j);
}

static void
fixed_sites_stay_and_the_others_yield(void)
{
	ty_site s[] = {square_site(0, 30, 0, 1), square_site(20, 10, 1, 9), square_site(4, 30, 2, 1),
				   square_site(40, 10, 3, 1)};
	ty_legibility rules = {.gap = 8};
	ty_status status;

	s[0].fixed = s[2].fixed = true;
	status = ty_make_legible(&ty_plain_environment, &rules, s, 4);
	CHECK(status == TY_OK && s[0].state == TY_DRAWN && s[2].state == TY_DRAWN, "status %d", (int) status);
	CHECK(s[0].moved.x == 0 && s[0].size == 2 && s[2].moved.x == 0 && s[2].size == 2, "moved %g, %g", s[0].moved.x,
		  s[2].moved.x);
	CHECK(s[1].state == TY_HIDDEN || s[1].home.x + s[1].moved.x > 19 + 8 + 4.9, "the second at %g",
		  s[1].home.x + s[1].moved.x);
	CHECK(s[3].state == TY_DRAWN, "the last is gone");
}

/* ---- cells ---- */

#define IN_ROW 60

/* what joins have to handle: the members of both */
typedef struct handled
{
	ty_site *sites;
	double members;
} handled;

static ty_status
join_squares(void *context, uint32_t kept, uint32_t gone, uint32_t in_place, ty_site *site)
{
	handled *h = context;
	ty_point a = h->sites[kept].home, b = h->sites[gone].home;
	uint32_t weight = h->sites[kept].weight + h->sites[gone].weight;

	h->members += weight;
	*site = square_site(0, 10, 0, weight);
	site->home = in_place != TY_NO_SITE ? h->sites[in_place].home : (ty_point){0.5 * (a.x + b.x), 0.5 * (a.y + b.y)};
	return TY_OK;
}

/* Lines everywhere leave room to nobody: the members of 3 600 sites come together without being handled 3 600 times. */
static void
where_nobody_has_room_all_become_one_two_by_two(void)
{
	static ty_site sites[IN_ROW * IN_ROW];
	static ty_point across[IN_ROW + 2][2];
	ty_barrier_lines lines;
	handled h = {sites, 0};
	ty_legibility rules = {.gap = 8, .lines = &lines, .line_gap = 13, .join = join_squares, .context = &h};
	size_t drawn = 0;
	ty_status status;

	ty_barrier_lines_begin(&lines, &ty_plain_environment);
	for (int k = 0; k < IN_ROW + 2; k++)
	{
		across[k][0] = (ty_point){-20, 10 * k - 5};
		across[k][1] = (ty_point){10 * IN_ROW + 10, 10 * k - 5};
		CHECK(ty_barrier_lines_add(&lines, across[k], sizeof *across[k], 2) == TY_OK, "add");
	}
	CHECK(ty_barrier_lines_end(&lines) == TY_OK, "end");
	for (int i = 0; i < IN_ROW * IN_ROW; i++)
	{
		sites[i] = square_site(10 * (i % IN_ROW) + 0.1 * (i / IN_ROW % 7), 10, 0, 1);
		sites[i].home.y = 10 * (i / IN_ROW);
	}
	status = ty_make_legible(&ty_plain_environment, &rules, sites, IN_ROW * IN_ROW);
	for (int i = 0; i < IN_ROW * IN_ROW; i++)
		drawn += sites[i].state == TY_DRAWN;
	CHECK(status == TY_OK && drawn <= 1, "status %d, %zu are drawn", (int) status, drawn);
	CHECK(h.members <= 60.0 * IN_ROW * IN_ROW, "%g times were members handled, each %g times", h.members,
		  h.members / (IN_ROW * IN_ROW));
	ty_barrier_lines_free(&lines);
}

int
main(int argc, char **argv)
{
	check_begin(argc, argv);
	RUN(sites_of_different_groups_are_hidden_last);
	RUN(sites_of_one_group_go_back_to_where_they_were_apart);
	RUN(fixed_sites_stay_and_the_others_yield);
	RUN(where_nobody_has_room_all_become_one_two_by_two);
	return check_end();
}
