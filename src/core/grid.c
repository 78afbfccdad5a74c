/* grid.c - see grid.h */
#include "grid.h"

#include <float.h>
#include <math.h>
#include <string.h>

#define HILBERT_LEVELS (TY_GRID_BITS + 1) /* coordinates reach 2^30 itself */
#define MAX_CELLS_EXPONENT 1000			  /* coordinates stay below 2^this cells, so that dividing cannot overflow */
#define MIN_CELL_EXPONENT (-1000)		  /* nor underflow */
#define AHEAD 16						  /* positions fetched before they are needed */
#define PROGRESS_INTERVAL 65536			  /* buildings between two words of progress */
#define POLL_INTERVAL 65536				  /* copies of one place that are sorted without a look for an interrupt */

/* from here on every double is a whole number */
#define ALL_WHOLE 4503599627370496.0 /* 2^52 */

/*
 * Nearest whole number, halves up; exact for every finite v. By conversion to an integer and back: floor() is a call
 * of the C library, which took 20 ns a building.
 */
static inline double
round_half_up(double v)
{
	double whole;

	if (!(fabs(v) < ALL_WHOLE))
		return v;
	whole = (double) (int64_t) v; /* towards 0 */
	whole -= v < whole;
	return v - whole >= 0.5 ? whole + 1 : whole;
}

/* v < 2^exponent_of(v) */
static int
exponent_of(double v)
{
	int exponent;

	(void) frexp(v, &exponent);
	return exponent;
}

static int
larger(int a, int b)
{
	return a > b ? a : b;
}

/* exponent e of the cell 2^e for a box of the given half side (halved, so that it cannot overflow) */
static int
cell_exponent(double half_side, double magnitude)
{
	int exponent = half_side > 0 ? exponent_of(half_side) + 1 - TY_GRID_BITS
								 : exponent_of(magnitude) - 53; /* one place only: as fine as its coordinates */

	return larger(exponent, larger(exponent_of(magnitude) - MAX_CELLS_EXPONENT, MIN_CELL_EXPONENT));
}

ty_status
ty_grid_fit(const ty_building *buildings, size_t n, ty_grid *grid)
{
	double low_x = buildings[0].x, high_x = low_x;
	double low_y = buildings[0].y, high_y = low_y;
	double half_side, magnitude;

	for (size_t i = 0; i < n; i++)
	{
		const ty_building *b = &buildings[i];

		if (!isfinite(b->x) || !isfinite(b->y))
			return TY_NOT_FINITE;
		low_x = b->x < low_x ? b->x : low_x;
		high_x = b->x > high_x ? b->x : high_x;
		low_y = b->y < low_y ? b->y : low_y;
		high_y = b->y > high_y ? b->y : high_y;
	}
	half_side = fmax(high_x * 0.5 - low_x * 0.5, high_y * 0.5 - low_y * 0.5);
	magnitude = fmax(fmax(fabs(low_x), fabs(high_x)), fmax(fabs(low_y), fabs(high_y)));
	grid->cell = ldexp(1.0, cell_exponent(half_side, magnitude));
	grid->origin_x = round_half_up(low_x / grid->cell);
	grid->origin_y = round_half_up(low_y / grid->cell);
	return TY_OK;
}

ty_position
ty_grid_snap(const ty_grid *grid, double x, double y)
{
	/* division by a power of two is exact, and so is the difference of two whole numbers this near */
	ty_position p = {(int32_t) (round_half_up(x / grid->cell) - grid->origin_x),
					 (int32_t) (round_half_up(y / grid->cell) - grid->origin_y)};

	return p;
}

/* the last cell may reach beyond the largest double */
static double
held_finite(double v)
{
	return fmin(fmax(v, -DBL_MAX), DBL_MAX);
}

double
ty_grid_x(const ty_grid *grid, int32_t x)
{
	return held_finite((grid->origin_x + x) * grid->cell);
}

double
ty_grid_y(const ty_grid *grid, int32_t y)
{
	return held_finite((grid->origin_y + y) * grid->cell);
}

/* the bits of v at the even places of the result */
static uint64_t
spread_bits(uint32_t v)
{
	uint64_t bits = v;

	bits = (bits | bits << 16) & UINT64_C(0x0000ffff0000ffff);
	bits = (bits | bits << 8) & UINT64_C(0x00ff00ff00ff00ff);
	bits = (bits | bits << 4) & UINT64_C(0x0f0f0f0f0f0f0f0f);
	bits = (bits | bits << 2) & UINT64_C(0x3333333333333333);
	return (bits | bits << 1) & UINT64_C(0x5555555555555555);
}

/*
 * From level to level the curve is flipped (both coordinates complemented) or swapped. With D = x ^ y of a level's raw
 * bits and g = flip ^ swap, the curve's rules come to: where D is set, flip ^= g ^ x, else g ^= flip ^ ~x. That is
 * affine over the bits, so the states before all levels are the prefixes of a product of affine maps, (a b; c d) and
 * the vector (u, v), which five doublings compute for all levels at once, a bit of each word a level.
 */
uint64_t
ty_hilbert_key(ty_position p)
{
	const uint32_t levels = (UINT32_C(1) << HILBERT_LEVELS) - 1;
	uint32_t x = (uint32_t) p.x, differ = x ^ (uint32_t) p.y;
	uint32_t a = UINT32_MAX, b = differ, c = ~differ & levels, d = UINT32_MAX;
	uint32_t u = x & differ, v = ~x & c;
	uint32_t flip, swap;

	for (int shift = 1; shift < 32; shift *= 2)
	{
		uint32_t above = ~(UINT32_MAX >> shift); /* beyond the first level the map is the identity */
		uint32_t a1 = a >> shift | above, b1 = b >> shift, c1 = c >> shift, d1 = d >> shift | above;
		uint32_t u1 = u >> shift, v1 = v >> shift;

		u ^= (a & u1) ^ (b & v1);
		v ^= (c & u1) ^ (d & v1);
		b1 = (a & b1) ^ (b & d1);
		d1 = (c & (b >> shift)) ^ (d & d1);
		a1 = (a & a1) ^ (b & c1);
		c1 = (c & (a >> shift | above)) ^ (d & c1);
		a = a1;
		b = b1;
		c = c1;
		d = d1;
	}
	flip = u >> 1;
	swap = flip ^ v >> 1;
	return spread_bits(x ^ flip ^ (swap & differ)) << 1 | spread_bits(differ);
}

/* ---- sorting ---- */

#define INSERTION_LIMIT 48 /* below, moving a few pairs beats counting digits */
#define LARGE_SORT 8192	   /* from here on 11-bit digits save more passes than their counters cost */

static void
insertion_sort(uint64_t *keys, uint32_t *values, size_t n)
{
	for (size_t i = 1; i < n; i++)
	{
		uint64_t key = keys[i];
		uint32_t value = values[i];
		size_t j = i;

		for (; j > 0 && keys[j - 1] > key; j--)
		{
			keys[j] = keys[j - 1];
			values[j] = values[j - 1];
		}
		keys[j] = key;
		values[j] = value;
	}
}

/* one stable counting pass over the digit at shift; false when all digits are equal and nothing moved */
static bool
radix_pass(const uint64_t *from_keys, const uint32_t *from_values, uint64_t *to_keys, uint32_t *to_values, size_t n,
		   int shift, uint32_t digits)
{
	uint32_t start[2048];
	uint32_t total = 0;

	memset(start, 0, digits * sizeof *start);
	for (size_t i = 0; i < n; i++)
		start[from_keys[i] >> shift & (digits - 1)]++;
	if (start[from_keys[0] >> shift & (digits - 1)] == n)
		return false;
	for (uint32_t d = 0; d < digits; d++)
	{
		uint32_t count = start[d];

		start[d] = total;
		total += count;
	}
	for (size_t i = 0; i < n; i++)
	{
		uint32_t to = start[from_keys[i] >> shift & (digits - 1)]++;

		to_keys[to] = from_keys[i];
		to_values[to] = from_values[i];
	}
	return true;
}

/* Sorts by the bits of the keys from `lowest` to the one before `end`, stably. */
static ty_status
radix_sort(const ty_environment *env, uint64_t *keys, uint32_t *values, size_t n, uint64_t *other_keys,
		   uint32_t *other_values, int lowest, int end)
{
	uint64_t *from_keys = keys, *to_keys = other_keys;
	uint32_t *from_values = values, *to_values = other_values;
	int width = n < LARGE_SORT ? 8 : 11;

	for (int shift = lowest; shift < end; shift += width)
	{
		if (ty_interrupted(env))
			return TY_INTERRUPTED;
		if (radix_pass(from_keys, from_values, to_keys, to_values, n, shift, 1u << width))
		{
			uint64_t *k = from_keys;
			uint32_t *v = from_values;

			from_keys = to_keys;
			from_values = to_values;
			to_keys = k;
			to_values = v;
		}
	}
	if (from_keys != keys)
	{
		memcpy(keys, from_keys, n * sizeof *keys);
		memcpy(values, from_values, n * sizeof *values);
	}
	return TY_OK;
}

/* Bits below this one are seldom looked at: the bits above tell the keys of nearly all buildings apart. */
#define LOW_BITS 31

/* Sorts each run of keys that are alike but for their low bits. */
static ty_status
sort_runs(const ty_environment *env, uint64_t *keys, uint32_t *values, size_t n, uint64_t *other_keys,
		  uint32_t *other_values)
{
	ty_status status = TY_OK;

	for (size_t first = 0, next; first < n && status == TY_OK; first = next)
	{
		for (next = first + 1; next < n && keys[next] >> LOW_BITS == keys[first] >> LOW_BITS; next++)
			;
		if (next - first <= INSERTION_LIMIT)
			insertion_sort(keys + first, values + first, next - first);
		else
			status = radix_sort(env, keys + first, values + first, next - first, other_keys, other_values, 0, LOW_BITS);
		if (ty_interrupted_at(env, first))
			status = TY_INTERRUPTED;
	}
	return status;
}

ty_status
ty_sort_keys(const ty_environment *env, uint64_t *keys, uint32_t *values, size_t n)
{
	ty_status status = TY_NO_MEMORY;
	uint64_t *other_keys;
	uint32_t *other_values;

	if (n <= INSERTION_LIMIT)
	{
		insertion_sort(keys, values, n);
		return TY_OK;
	}
	other_keys = ty_allocate_array(env, n, sizeof *other_keys);
	other_values = ty_allocate_array(env, n, sizeof *other_values);
	if (other_keys != NULL && other_values != NULL)
	{
		bool split = n >= LARGE_SORT;

		status = radix_sort(env, keys, values, n, other_keys, other_values, split ? LOW_BITS : 0, 64);
		if (status == TY_OK && split)
			status = sort_runs(env, keys, values, n, other_keys, other_values);
	}
	ty_release(env, other_keys);
	ty_release(env, other_values);
	return status;
}

/* ---- canonical order ---- */

static int
compare_double(double a, double b)
{
	return (a > b) - (a < b);
}

/* the order of buildings at one grid position */
static int
compare_buildings(const ty_building *a, const ty_building *b)
{
	int c;

	if ((c = compare_double(a->x, b->x)) != 0 || (c = compare_double(a->y, b->y)) != 0 ||
		(c = compare_double(a->area, b->area)) != 0 || (c = compare_double(a->ratio, b->ratio)) != 0 ||
		(c = compare_double(a->ux, b->ux)) != 0 || (c = compare_double(a->uy, b->uy)) != 0)
		return c;
	return (a->id > b->id) - (a->id < b->id);
}

/* merges the sorted runs [0, middle) and [middle, n) of order; scratch holds n entries */
static void
merge_runs(const ty_building *buildings, uint32_t *order, size_t middle, size_t n, uint32_t *scratch)
{
	size_t i = 0, j = middle, k = 0;

	if (compare_buildings(&buildings[order[middle - 1]], &buildings[order[middle]]) <= 0)
		return; /* in order already: so that copies of one building cost O(n) */
	while (i < middle && j < n)
		scratch[k++] = compare_buildings(&buildings[order[j]], &buildings[order[i]]) < 0 ? order[j++] : order[i++];
	memcpy(scratch + k, order + i, (middle - i) * sizeof *order);
	memcpy(order, scratch, (k + middle - i) * sizeof *order);
}

static ty_status
merge_sort(const ty_environment *env, const ty_building *buildings, uint32_t *order, size_t n, uint32_t *scratch)
{
	ty_status status;

	if (n < 2)
		return TY_OK;
	if (n > POLL_INTERVAL && ty_interrupted(env))
		return TY_INTERRUPTED;
	status = merge_sort(env, buildings, order, n / 2, scratch);
	if (status == TY_OK)
		status = merge_sort(env, buildings, order + n / 2, n - n / 2, scratch);
	if (status == TY_OK)
		merge_runs(buildings, order, n / 2, n, scratch);
	return status;
}

/* sorts each run of equal keys by the buildings themselves */
static ty_status
order_equal_keys(const ty_environment *env, const ty_building *buildings, const uint64_t *keys, uint32_t *order,
				 size_t n)
{
	uint32_t *scratch = NULL;
	ty_status status = TY_OK;

	for (size_t first = 0, end; status == TY_OK && first < n; first = end)
	{
		for (end = first + 1; end < n && keys[end] == keys[first]; end++)
			;
		if (ty_interrupted_at(env, first))
			status = TY_INTERRUPTED;
		if (status != TY_OK || end - first < 2)
			continue;
		if (scratch == NULL && (scratch = ty_allocate_array(env, n - first, sizeof *scratch)) == NULL)
			return TY_NO_MEMORY;
		status = merge_sort(env, buildings, order + first, end - first, scratch);
	}
	ty_release(env, scratch);
	return status;
}

/* Snaps the buildings, as they come, and computes their keys. */
static ty_status
snap_all(const ty_environment *env, const ty_building *buildings, size_t n, const ty_grid *grid, ty_position *snapped,
		 uint64_t *keys)
{
	for (size_t i = 0; i < n; i++)
	{
		if (ty_interrupted_at(env, i))
			return TY_INTERRUPTED;
		if (i % PROGRESS_INTERVAL == 0)
			ty_progress(env, TY_ORDERING, i, 2 * n);
		snapped[i] = ty_grid_snap(grid, buildings[i].x, buildings[i].y);
		keys[i] = ty_hilbert_key(snapped[i]);
	}
	return TY_OK;
}

/* Puts the positions in order. */
static ty_status
arrange(const ty_environment *env, const ty_position *snapped, const uint32_t *order, size_t n, ty_position *position)
{
	for (size_t rank = 0; rank < n; rank++)
	{
		if (ty_interrupted_at(env, rank))
			return TY_INTERRUPTED;
		if (rank % PROGRESS_INTERVAL == 0)
			ty_progress(env, TY_ORDERING, n + rank, 2 * n);
		/* the rows came in any order: fetch ahead, or each would be waited for */
		if (rank + AHEAD < n)
			__builtin_prefetch(&snapped[order[rank + AHEAD]]);
		position[rank] = snapped[order[rank]];
	}
	return TY_OK;
}

ty_status
ty_canonical_order(const ty_environment *env, const ty_building *buildings, size_t n, const ty_grid *grid,
				   uint32_t *order, ty_position *position, uint64_t *keys)
{
	/* put in order by themselves: fetching each building anew and snapping it took a fifth of the whole ordering */
	ty_position *snapped = ty_allocate_array(env, n, sizeof *snapped);
	ty_status status = snapped == NULL ? TY_NO_MEMORY : snap_all(env, buildings, n, grid, snapped, keys);

	for (size_t i = 0; i < n; i++)
		order[i] = (uint32_t) i;
	if (status == TY_OK)
		status = ty_sort_keys(env, keys, order, n);
	if (status == TY_OK)
		status = order_equal_keys(env, buildings, keys, order, n);
	if (status == TY_OK)
		status = arrange(env, snapped, order, n, position);
	ty_release(env, snapped);
	return status;
}
