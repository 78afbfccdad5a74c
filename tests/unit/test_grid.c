/*
 * test_grid.c - the fear: the answer depends on the order of the rows, or a box of absurd size or place makes
 * positions that are off the grid.
 */
#include "check.h"
#include "grid.h"
#include "sets.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

static ty_building
building_at(double x, double y)
{
	ty_building b = {x, y, 100, 0.5, 1, 0, 0};

	return b;
}

static bool
is_power_of_two(double value)
{
	int exponent;

	return value > 0 && frexp(value, &exponent) == 0.5;
}

static double
larger_side(const ty_building *b, size_t n)
{
	double low_x = b->x, high_x = b->x, low_y = b->y, high_y = b->y;

	for (size_t i = 1; i < n; i++)
	{
		low_x = fmin(low_x, b[i].x);
		high_x = fmax(high_x, b[i].x);
		low_y = fmin(low_y, b[i].y);
		high_y = fmax(high_y, b[i].y);
	}
	return fmax(high_x - low_x, high_y - low_y);
}

static void
check_snap(const ty_grid *grid, const ty_building *b)
{
	ty_position p = ty_grid_snap(grid, b->x, b->y);
	double x = ty_grid_x(grid, p.x);
	double y = ty_grid_y(grid, p.y);

	CHECK(p.x >= 0 && p.x <= 1 << 30 && p.y >= 0 && p.y <= 1 << 30, "%a %a is at %d %d", b->x, b->y, p.x, p.y);
	CHECK(fabs(x - b->x) <= grid->cell / 2 && fabs(y - b->y) <= grid->cell / 2, "%a %a came back as %a %a, cell %a",
		  b->x, b->y, x, y, grid->cell);
}

/* Fits a grid, and checks its promises where doubles have room for them. */
static void
check_fit(const ty_building *b, size_t n)
{
	ty_grid grid;
	double side = larger_side(b, n);

	NEED(ty_grid_fit(b, n, &grid) == TY_OK, "first at %a %a", b->x, b->y);
	CHECK(is_power_of_two(grid.cell), "cell %a", grid.cell);
	CHECK(floor(grid.origin_x) == grid.origin_x && floor(grid.origin_y) == grid.origin_y, "origin %a %a", grid.origin_x,
		  grid.origin_y);
	if (side > 1e-290 && side < 1e300)
		CHECK(side / grid.cell >= 536870912.0 && side / grid.cell <= 1073741824.0, "side %a, cell %a", side, grid.cell);
	for (size_t i = 0; i < n; i++)
		check_snap(&grid, &b[i]);
}

static void
snapping_stays_within_half_a_cell(void)
{
	random_state random = random_seed(1);
	ty_building b[40];

	for (size_t set = 0; set < 20000; set++)
	{
		double scale = ldexp(1 + random_unit(&random), (int) random_between(&random, -40, 40));
		double far = set % 2 == 0 ? 0 : scale * 1000;

		for (size_t i = 0; i < 40; i++)
			b[i] = building_at(far + scale * random_unit(&random), scale * random_unit(&random) - far);
		check_fit(b, 1 + set % 40);
	}
}

static void
boxes_of_exactly_a_power_of_two_keep_the_promise(void)
{
	for (int exponent = -300; exponent <= 300; exponent++)
	{
		double side = ldexp(1, exponent);
		ty_building exact[] = {building_at(0, 0), building_at(side, side / 2)};
		ty_building below[] = {building_at(side, 0), building_at(2 * side * (1 - DBL_EPSILON), 0)};
		ty_building above[] = {building_at(0, -side), building_at(0, side * DBL_EPSILON)};

		check_fit(exact, 2);
		check_fit(below, 2);
		check_fit(above, 2);
	}
}

static void
halves_are_rounded_up(void)
{
	ty_building b[] = {building_at(0, 0), building_at((1 << 30) - 1, (1 << 30) - 1)};
	ty_grid grid;
	ty_position p;

	NEED(ty_grid_fit(b, 2, &grid) == TY_OK, "fit");
	CHECK(grid.cell == 1, "cell %a", grid.cell);
	p = ty_grid_snap(&grid, 0.5, 1.5);
	CHECK(p.x == 1 && p.y == 2, "0.5 is %d, 1.5 is %d", p.x, p.y);
	p = ty_grid_snap(&grid, 0.49999999999999994, 1073741822.5);
	CHECK(p.x == 0 && p.y == (1 << 30) - 1, "just below a half is %d, the last half %d", p.x, p.y);
}

static void
absurd_magnitudes_stay_on_the_grid(void)
{
	ty_building sets[][2] = {
		{building_at(1e-300, -1e-300), building_at(2e-300, 1e-300)},
		{building_at(1e300, -1e300), building_at(-1e300, 1e300)},
		{building_at(DBL_MAX, DBL_MAX), building_at(-DBL_MAX, -DBL_MAX)},
		{building_at(DBL_MAX, 0), building_at(DBL_MAX, 1)},
		{building_at(5e-324, 0), building_at(0, 0)},
		{building_at(0, 0), building_at(0, 1e-310)},
		{building_at(1e15, 1e15), building_at(1e15 + 0.125, 1e15)},
		{building_at(1e300, 1e300), building_at(nextafter(1e300, 2e300), 1e300)},
		{building_at(-0.0, 0), building_at(0, -0.0)},
		{building_at(7, 7), building_at(7, 7)},
		{building_at(DBL_MAX, -DBL_MAX), building_at(DBL_MAX, -DBL_MAX)},
		{building_at(1e-300, 1e300), building_at(-1e-300, 1e300)},
		{building_at(5e-324, 5e-324), building_at(5e-324, 5e-324)},
	};

	for (size_t i = 0; i < sizeof sets / sizeof *sets; i++)
	{
		ty_grid grid;
		ty_status status = ty_grid_fit(sets[i], 2, &grid);

		if (!CHECK(status == TY_OK, "set %zu: status %d", i, status))
			continue;
		CHECK(isfinite(grid.cell) && grid.cell > 0, "set %zu: cell %a", i, grid.cell);
		for (size_t k = 0; k < 2; k++)
		{
			ty_position p = ty_grid_snap(&grid, sets[i][k].x, sets[i][k].y);
			double error = fabs(ty_grid_x(&grid, p.x) - sets[i][k].x);

			CHECK(p.x >= 0 && p.x <= 1 << 30 && p.y >= 0 && p.y <= 1 << 30, "set %zu: %d %d", i, p.x, p.y);
			CHECK(error <= grid.cell / 2, "set %zu: off by %a, cell %a", i, error, grid.cell);
		}
	}
}

static void
what_is_not_finite_is_told(void)
{
	const double bad[] = {NAN, INFINITY, -INFINITY};

	for (size_t i = 0; i < 3; i++)
	{
		ty_building b[] = {building_at(0, 0), building_at(bad[i], 0), building_at(1, 1)};
		ty_building only[] = {building_at(0, bad[i])};
		ty_grid grid;

		CHECK(ty_grid_fit(b, 3, &grid) == TY_NOT_FINITE, "x %g", bad[i]);
		CHECK(ty_grid_fit(only, 1, &grid) == TY_NOT_FINITE, "y %g", bad[i]);
	}
}

static bool
share_an_edge(ty_position a, ty_position b, int32_t size)
{
	return abs(a.x - b.x) + abs(a.y - b.y) == size;
}

/*
 * The cells of 2^(31 - level) a side: the top 2 * level bits number them without gaps, and each shares an edge with
 * the next. Two in a row whose shorter prefix is the same are then the half of a square.
 */
static void
hilbert_prefixes_are_squares_and_halves(void)
{
	static ty_position cell[1 << 12];
	random_state random = random_seed(5);

	for (int level = 1; level <= 6; level++)
	{
		int side = 1 << level;
		int32_t size = (int32_t) (INT64_C(1) << (31 - level));

		memset(cell, 0xff, sizeof cell);
		for (int i = 0; i < side * side; i++)
			for (int probe = 0; probe < 8; probe++)
			{
				ty_position corner = {i % side * size, i / side * size};
				ty_position p = {corner.x + (int32_t) random_between(&random, 0, size - 1),
								 corner.y + (int32_t) random_between(&random, 0, size - 1)};
				uint64_t prefix = ty_hilbert_key(p) >> (62 - 2 * level);

				NEED(prefix < (uint64_t) (side * side), "level %d: prefix %llu", level, (unsigned long long) prefix);
				CHECK(cell[prefix].x == -1 || (cell[prefix].x == corner.x && cell[prefix].y == corner.y),
					  "level %d: two cells have prefix %llu", level, (unsigned long long) prefix);
				cell[prefix] = corner;
			}
		for (int i = 1; i < side * side; i++)
			CHECK(share_an_edge(cell[i - 1], cell[i], size), "level %d: cells %d and %d", level, i - 1, i);
	}
}

static int
compare_by_key(const void *a, const void *b)
{
	uint64_t key_a = ty_hilbert_key(*(const ty_position *) a);
	uint64_t key_b = ty_hilbert_key(*(const ty_position *) b);

	return (key_a > key_b) - (key_a < key_b);
}

static void
hilbert_keys_are_dense_and_continuous_to_the_last_bit(void)
{
	random_state random = random_seed(6);
	ty_position block[256];

	for (size_t probe = 0; probe < 2000; probe++)
	{
		int32_t x = (int32_t) random_between(&random, 0, (1 << 26) - 1) * 16;
		int32_t y = (int32_t) random_between(&random, 0, (1 << 26) - 1) * 16;

		for (int i = 0; i < 256; i++)
			block[i] = (ty_position){x + i % 16, y + i / 16};
		qsort(block, 256, sizeof *block, compare_by_key);
		for (int i = 1; i < 256; i++)
			CHECK(ty_hilbert_key(block[i]) == ty_hilbert_key(block[i - 1]) + 1 &&
					  share_an_edge(block[i], block[i - 1], 1),
				  "%d %d and %d %d", block[i - 1].x, block[i - 1].y, block[i].x, block[i].y);
	}
}

/* buildings with so few different values that they tie in every field */
static void
draw_tying(random_state *random, ty_building *b, size_t n)
{
	static const double directions[][2] = {{1, 0}, {0.6, 0.8}, {-0.6, 0.8}};

	for (size_t i = 0; i < n; i++)
	{
		const double *direction = directions[random_between(random, 0, 2)];

		b[i] = building_at((double) random_between(random, 0, 2), (double) random_between(random, 0, 2));
		b[i].area = (double) random_between(random, 0, 2);
		b[i].ratio = (double) random_between(random, 1, 2) / 2;
		b[i].ux = direction[0];
		b[i].uy = direction[1];
		b[i].id = random_between(random, -1, 1);
	}
}

static void
same_values_whatever_the_row_order(void)
{
	enum
	{
		N = 500
	};
	static ty_building b[N], first[N];
	uint32_t order[N];
	ty_position position[N];
	uint64_t keys[N];
	random_state random = random_seed(7);
	ty_grid grid;

	for (size_t set = 0; set < 400; set++)
	{
		size_t n = 1 + set % 8 * set % N;

		draw_tying(&random, b, n);
		for (size_t permutation = 0; permutation < 5; permutation++)
		{
			NEED(ty_grid_fit(b, n, &grid) == TY_OK, "n %zu", n);
			NEED(ty_canonical_order(&ty_plain_environment, b, n, &grid, order, position, keys) == TY_OK, "n %zu", n);
			for (size_t rank = 0; rank < n; rank++)
			{
				ty_building *here = &b[order[rank]];
				ty_position p = ty_grid_snap(&grid, here->x, here->y);

				if (permutation == 0)
					first[rank] = *here;
				CHECK(memcmp(&first[rank], here, sizeof *here) == 0, "n %zu: rank %zu holds another", n, rank);
				CHECK(p.x == position[rank].x && p.y == position[rank].y && keys[rank] == ty_hilbert_key(p),
					  "n %zu: position or key of rank %zu", n, rank);
				CHECK(rank == 0 || keys[rank - 1] <= keys[rank], "n %zu: key of rank %zu descends", n, rank);
			}
			shuffle_buildings(&random, b, n);
		}
	}
}

/* what lies in one cell is ordered by its true coordinates, then area, ratio, ux, uy, id */
static void
ties_are_ordered_field_by_field(void)
{
	ty_building far = building_at(1 << 30, 0);
	ty_building b[8];
	uint32_t order[8];
	ty_position position[8];
	uint64_t keys[8];
	ty_grid grid;

	for (int i = 0; i < 7; i++)
		b[i] = building_at(0.125, 0.125);
	b[5].x = 0.0; /* first of all: the least x */
	b[4].y = 0.0;
	b[3].area = 50;
	b[2].ratio = 0.25;
	b[1].ux = -1; /* not a unit vector that measure gives, but a smaller one */
	b[0].id = -1;
	b[7] = far;
	NEED(ty_grid_fit(b, 8, &grid) == TY_OK, "fit");
	NEED(ty_canonical_order(&ty_plain_environment, b, 8, &grid, order, position, keys) == TY_OK, "order");
	for (uint32_t rank = 0; rank < 6; rank++)
		CHECK(order[rank] == 5 - rank, "rank %u holds %u", rank, order[rank]);
	CHECK(order[6] == 6 && order[7] == 7, "the last two are %u, %u", order[6], order[7]);
}

static void
negative_zero_ties_with_zero(void)
{
	ty_building b[] = {building_at(0.0, 0.0), building_at(-0.0, -0.0)};
	uint32_t order[2];
	ty_position position[2];
	uint64_t keys[2];
	ty_grid grid;

	b[0].id = 2;
	b[1].id = 1;
	NEED(ty_grid_fit(b, 2, &grid) == TY_OK, "fit");
	NEED(ty_canonical_order(&ty_plain_environment, b, 2, &grid, order, position, keys) == TY_OK, "order");
	CHECK(order[0] == 1 && order[1] == 0, "as numbers they are equal, so the id decides: %u, %u", order[0], order[1]);
}

static void
sorting_keys_is_stable_at_every_size(void)
{
	static const size_t sizes[] = {0, 1, 2, 15, 64, 255, 256, 257, 5000, 100000};
	static const uint64_t masks[] = {UINT64_MAX, 3, UINT64_C(3) << 62, 0, UINT64_C(0xff00ff)};
	static uint64_t keys[100000], unsorted[100000];
	static uint32_t values[100000];
	random_state random = random_seed(8);

	for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++)
		for (size_t m = 0; m < sizeof masks / sizeof *masks; m++)
		{
			for (size_t i = 0; i < sizes[s]; i++)
			{
				keys[i] = unsorted[i] = random_next(&random) & masks[m];
				values[i] = (uint32_t) i;
			}
			NEED(ty_sort_keys(&ty_plain_environment, keys, values, sizes[s]) == TY_OK, "n %zu", sizes[s]);
			for (size_t i = 0; i < sizes[s]; i++)
			{
				CHECK(unsorted[values[i]] == keys[i], "n %zu: value %zu is parted from its key", sizes[s], i);
				CHECK(i == 0 || keys[i - 1] < keys[i] || (keys[i - 1] == keys[i] && values[i - 1] < values[i]),
					  "n %zu, mask %zu: %zu is out of order", sizes[s], m, i);
			}
		}
}

int
main(int argc, char **argv)
{
	check_begin(argc, argv);
	RUN(snapping_stays_within_half_a_cell);
	RUN(boxes_of_exactly_a_power_of_two_keep_the_promise);
	RUN(halves_are_rounded_up);
	RUN(absurd_magnitudes_stay_on_the_grid);
	RUN(what_is_not_finite_is_told);
	RUN(hilbert_prefixes_are_squares_and_halves);
	RUN(hilbert_keys_are_dense_and_continuous_to_the_last_bit);
	RUN(same_values_whatever_the_row_order);
	RUN(ties_are_ordered_field_by_field);
	RUN(negative_zero_ties_with_zero);
	RUN(sorting_keys_is_stable_at_every_size);
	return check_end();
}
