/* tile.c - see tile.h */
#include "tile.h"

#include <math.h>

/* coordinates that are whole multiples of a step up to here stay exact */
#define LARGEST_INDEX 9007199254740992.0

/* 2^21 m is a tile's side divided by 19 at zoom 0: a sixteenth, as a power of two */
#define STEP_EXPONENT 21
#define LEAST_ZOOM 6

double
ty_lattice_step(int zoom, double metres_per_unit)
{
	int unit;

	frexp(metres_per_unit, &unit);
	return ldexp(1, STEP_EXPONENT - (zoom < LEAST_ZOOM ? LEAST_ZOOM : zoom) - (unit - 1));
}

bool
ty_lattice_cover(ty_point low, ty_point high, double step, int64_t most, ty_lattice *lattice)
{
	double first_column = floor(low.x / step), first_row = floor(low.y / step);
	double columns = floor(high.x / step) - first_column + 2, rows = floor(high.y / step) - first_row + 2;

	/* written so that what is not a number fails */
	if (!(fabs(first_column) < LARGEST_INDEX && fabs(first_row) < LARGEST_INDEX && columns >= 2 && rows >= 2 &&
		  columns * rows <= (double) most))
		return false;
	*lattice = (ty_lattice){step, (int64_t) first_column, (int64_t) first_row, (int64_t) columns, (int64_t) rows};
	return true;
}

void
ty_lattice_corners(const ty_lattice *lattice, ty_point *corners)
{
	for (int64_t row = 0; row < lattice->rows; row++)
		for (int64_t column = 0; column < lattice->columns; column++)
			*corners++ = (ty_point){(double) (lattice->column + column) * lattice->step,
									(double) (lattice->row + row) * lattice->step};
}

static double
between(double a, double b, double part)
{
	return a + (b - a) * part;
}

/* The cell of a coordinate, the nearest one where it is in none. */
static int64_t
cell(double index, int64_t corners)
{
	return index >= 0 ? index < (double) (corners - 1) ? (int64_t) index : corners - 2 : 0;
}

ty_point
ty_lattice_interpolate(const ty_lattice *lattice, const ty_point *places, ty_point p)
{
	int64_t column = cell(floor(p.x / lattice->step) - (double) lattice->column, lattice->columns);
	int64_t row = cell(floor(p.y / lattice->step) - (double) lattice->row, lattice->rows);
	double u = p.x / lattice->step - (double) (lattice->column + column);
	double v = p.y / lattice->step - (double) (lattice->row + row);
	const ty_point *low = places + row * lattice->columns + column, *high = low + lattice->columns;

	return (ty_point){between(between(low[0].x, low[1].x, u), between(high[0].x, high[1].x, u), v),
					  between(between(low[0].y, low[1].y, u), between(high[0].y, high[1].y, u), v)};
}

bool
ty_tile_outline(const ty_tile *tile, ty_point low, ty_point high, ty_point ring[TY_TILE_OUTLINE])
{
	double side = ldexp(2 * TY_MERCATOR_HALF, -tile->zoom), buffer = side * TY_TILE_BUFFER / TY_TILE_UNITS;
	double left = tile->x * side - TY_MERCATOR_HALF, top = TY_MERCATOR_HALF - tile->y * side;
	int steps = (TY_TILE_OUTLINE - 1) / 4;

	low = (ty_point){fmax(low.x, left - buffer), fmax(low.y, top - side - buffer)};
	high = (ty_point){fmin(high.x, left + side + buffer), fmin(high.y, top + buffer)};
	if (!(low.x < high.x && low.y < high.y))
		return false;
	for (int i = 0; i < steps; i++)
	{
		double part = (double) i / steps;

		ring[i] = (ty_point){between(low.x, high.x, part), low.y};
		ring[steps + i] = (ty_point){high.x, between(low.y, high.y, part)};
		ring[2 * steps + i] = (ty_point){between(high.x, low.x, part), high.y};
		ring[3 * steps + i] = (ty_point){low.x, between(high.y, low.y, part)};
	}
	ring[4 * steps] = ring[0];
	return true;
}

ty_point
ty_tile_units(const ty_tile *tile, ty_point mercator)
{
	double per_metre = ldexp(TY_TILE_UNITS, tile->zoom) / (2 * TY_MERCATOR_HALF);

	return (ty_point){floor((mercator.x + TY_MERCATOR_HALF) * per_metre + 0.5) - (double) tile->x * TY_TILE_UNITS,
					  floor((TY_MERCATOR_HALF - mercator.y) * per_metre + 0.5) - (double) tile->y * TY_TILE_UNITS};
}

static double
twice_the_area(const ty_point *ring, size_t n)
{
	double sum = 0;

	for (size_t i = 1; i + 2 < n; i++)
		sum += (ring[i].x - ring[0].x) * (ring[i + 1].y - ring[0].y) -
			   (ring[i + 1].x - ring[0].x) * (ring[i].y - ring[0].y);
	return sum;
}

static void
reverse(ty_point *ring, size_t n)
{
	for (size_t i = 0, j = n - 1; i < j; i++, j--)
	{
		ty_point other = ring[i];

		ring[i] = ring[j];
		ring[j] = other;
	}
}

size_t
ty_tile_tidy_ring(ty_point *ring, size_t n)
{
	size_t kept = n > 0;
	double area;

	for (size_t i = 1; i < n; i++)
		if (ring[i].x != ring[kept - 1].x || ring[i].y != ring[kept - 1].y)
			ring[kept++] = ring[i];
	area = twice_the_area(ring, kept);
	if (!(fabs(area) > 0))
		return 0;
	if (area < 0)
		reverse(ring, kept);
	return kept;
}

bool
ty_tile_shows(const ty_point *ring, size_t n)
{
	ty_point low = ring[0], high = ring[0];

	for (size_t i = 1; i < n; i++)
	{
		low = (ty_point){fmin(low.x, ring[i].x), fmin(low.y, ring[i].y)};
		high = (ty_point){fmax(high.x, ring[i].x), fmax(high.y, ring[i].y)};
	}
	return low.x <= TY_TILE_UNITS + TY_TILE_BUFFER && high.x >= -TY_TILE_BUFFER &&
		   low.y <= TY_TILE_UNITS + TY_TILE_BUFFER && high.y >= -TY_TILE_BUFFER;
}
