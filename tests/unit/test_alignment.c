/*
 * test_alignment.c - the fear: a row of houses is not seen, or one is seen where there is none, or what is seen
 * depends on the order of the buildings.
 */
#include "alignment.h"
#include "check.h"
#include "sets.h"

#include <math.h>

#define MOST 4000

static ty_building buildings[MOST];
static size_t count;
static uint32_t order[MOST];

/* A house of the given sides whose longer one has the direction of the angle. */
static void
build(double x, double y, double width, double length, double angle)
{
	double ux = cos(angle), uy = sin(angle);

	if (uy < 0 || (uy == 0 && ux < 0))
	{
		ux = -ux;
		uy = -uy;
	}
	buildings[count] = (ty_building){x, y, width * length, width / length, ux, uy, (int64_t) count};
	count++;
}

/* k equal houses, 8 x 11 m, `spacing` apart, from (x, y) on; the row turns by `turn` at each of them. */
static void
build_row(size_t k, double x, double y, double spacing, double angle, double turn)
{
	for (size_t i = 0; i < k; i++)
	{
		build(x, y, 8, 11, angle);
		x += spacing * cos(angle);
		y += spacing * sin(angle);
		angle += turn;
	}
}

static ty_rows
find(void)
{
	ty_rows rows;
	ty_status status = ty_rows_of_group(&ty_plain_environment, buildings, count, (ty_parting){0}, order, &rows);

	CHECK(status == TY_OK, "status %d", status);
	return rows;
}

static void
release(ty_rows *rows)
{
	ty_rows_free(&ty_plain_environment, rows);
}

/* whether the buildings first .. first + k - 1 are one row, in this order or back, and nobody else is in it */
static bool
is_row(const ty_rows *rows, size_t first, size_t k)
{
	static uint32_t rank_of[MOST];
	uint32_t row, begin;
	bool forth = true, back = true;

	for (uint32_t rank = 0; rank < count; rank++)
		rank_of[order[rank]] = rank;
	row = rows->span[rank_of[first]].row;
	if (row == TY_NONE || rows->first[row + 1] - rows->first[row] != k)
		return false;
	begin = rows->first[row];
	for (size_t i = 0; i < k; i++)
	{
		forth = forth && rows->member[begin + i] == rank_of[first + i];
		back = back && rows->member[begin + i] == rank_of[first + k - 1 - i];
	}
	return forth || back;
}

static void
straight_rows_are_found_in_every_direction(void)
{
	for (size_t k = 3; k <= 40; k++)
		for (int direction = 0; direction < 24; direction++)
		{
			ty_rows rows;

			count = 0;
			build_row(k, 500000, 5000000, 12 + (double) (k % 5) * 5, direction * 0.2618, 0);
			rows = find();
			CHECK(rows.count == 1 && is_row(&rows, 0, k), "%zu houses, direction %d: %zu rows", k, direction,
				  rows.count);
			release(&rows);
		}
}

static void
gently_curved_rows_are_found_and_circles_too(void)
{
	for (int degrees = 1; degrees <= 18; degrees++)
	{
		size_t k = 12;
		ty_rows rows;

		count = 0;
		build_row(k, 0, 0, 20, 0.3, degrees * 0.0174533);
		rows = find();
		CHECK(rows.count == 1 && is_row(&rows, 0, k), "turning by %d degrees: %zu rows", degrees, rows.count);
		release(&rows);
	}
	count = 0;
	build_row(36, 0, 0, 20, 0, 0.174533); /* all around */
	{
		ty_rows rows = find();

		CHECK(rows.count == 1 && rows.first[1] == 36, "circle: %zu rows, the first of %u", rows.count, rows.first[1]);
		release(&rows);
	}
}

static void
both_sides_of_a_street_are_rows_of_their_own(void)
{
	ty_rows rows;

	count = 0;
	build_row(15, 0, 0, 22, 0.5, 0);
	build_row(14, -12, 18, 23, 0.5, 0);
	rows = find();
	CHECK(rows.count == 2 && is_row(&rows, 0, 15) && is_row(&rows, 15, 14), "%zu rows", rows.count);
	release(&rows);
}

static void
garages_between_the_houses_do_not_matter(void)
{
	ty_rows rows;

	count = 0;
	build_row(10, 0, 0, 24, 0.5, 0);
	for (size_t i = 0; i < 9; i += 2)
		build(24 * cos(0.5) * ((double) i + 0.5), 24 * sin(0.5) * ((double) i + 0.5), 3, 6, 0.5);
	rows = find();
	CHECK(rows.count == 1 && is_row(&rows, 0, 10), "%zu rows", rows.count);
	release(&rows);
}

static void
a_gap_a_turned_house_and_a_large_one_end_a_row(void)
{
	ty_rows rows;

	count = 0;
	build_row(5, 0, 0, 20, 0, 0);
	build_row(5, 5 * 20 + 25, 0, 20, 0, 0); /* after a gap of 45 m */
	rows = find();
	CHECK(rows.count == 2 && is_row(&rows, 0, 5) && is_row(&rows, 5, 5), "gap: %zu rows", rows.count);
	release(&rows);
	count = 0;
	build_row(5, 0, 0, 20, 0, 0);
	build(100, 0, 8, 11, 0.7854);
	build_row(5, 120, 0, 20, 0, 0);
	rows = find();
	CHECK(rows.count == 2 && is_row(&rows, 0, 5) && is_row(&rows, 6, 5), "turned: %zu rows", rows.count);
	release(&rows);
	count = 0;
	build_row(5, 0, 0, 20, 0, 0);
	build(105, 0, 14, 18, 0);
	build_row(5, 130, 0, 20, 0, 0);
	rows = find();
	CHECK(rows.count == 2 && is_row(&rows, 0, 5) && is_row(&rows, 6, 5), "large: %zu rows", rows.count);
	release(&rows);
}

static void
chance_makes_few_rows(void)
{
	random_state random = random_seed(7);
	ty_rows rows;
	size_t in_rows;

	for (count = 0; count < MOST;)
		build(random_unit(&random) * 1600, random_unit(&random) * 1600, 7 + 4 * random_unit(&random),
			  11 + 6 * random_unit(&random), random_unit(&random) * 3.14159);
	rows = find();
	in_rows = rows.first[rows.count];
	printf("  information: of %zu scattered buildings %zu are in %zu rows\n", count, in_rows, rows.count);
	CHECK(in_rows < count / 25, "%zu of %zu", in_rows, count);
	release(&rows);
}

/* The rows as a number that tells them apart. */
static uint64_t
fingerprint(const ty_rows *rows)
{
	uint64_t hash = rows->count;

	for (size_t r = 0; r < rows->count; r++)
		for (uint32_t i = rows->first[r]; i < rows->first[r + 1]; i++)
			hash = (hash ^ rows->member[i] ^ (uint64_t) r << 32) * UINT64_C(0x9E3779B97F4A7C15);
	return hash;
}

static void
invariants_hold_and_the_order_of_buildings_does_not_matter(void)
{
	for (large_kind kind = 0; kind < LARGE_KINDS; kind++)
	{
		random_state random = random_seed(100 + kind);
		uint64_t first;
		uint32_t smallest = 0;
		ty_rows rows;

		count = 3000;
		large_set(kind, &random, buildings, count);
		rows = find();
		first = fingerprint(&rows);
		for (size_t r = 0; r < rows.count; r++)
		{
			uint32_t least = TY_NONE;

			CHECK(rows.first[r + 1] - rows.first[r] >= 3, "%s: row %zu", large_kind_name[kind], r);
			for (uint32_t i = rows.first[r]; i < rows.first[r + 1]; i++)
			{
				least = rows.member[i] < least ? rows.member[i] : least;
				CHECK(rows.span[rows.member[i]].row == r && rows.span[rows.member[i]].first == i - rows.first[r],
					  "%s: row %zu, member %u", large_kind_name[kind], r, i);
			}
			CHECK(r == 0 || least > smallest, "%s: row %zu begins at %u", large_kind_name[kind], r, least);
			smallest = least;
		}
		release(&rows);
		shuffle_buildings(&random, buildings, count);
		rows = find();
		CHECK(fingerprint(&rows) == first, "%s: another order of rows", large_kind_name[kind]);
		release(&rows);
	}
}

int
main(int argc, char **argv)
{
	check_begin(argc, argv);
	RUN(straight_rows_are_found_in_every_direction);
	RUN(gently_curved_rows_are_found_and_circles_too);
	RUN(both_sides_of_a_street_are_rows_of_their_own);
	RUN(garages_between_the_houses_do_not_matter);
	RUN(a_gap_a_turned_house_and_a_large_one_end_a_row);
	RUN(chance_makes_few_rows);
	RUN(invariants_hold_and_the_order_of_buildings_does_not_matter);
	return check_end();
}
