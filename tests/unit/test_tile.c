/*
 * test_tile.c - the fear: a polygon jumps from one tile to the next, or lies where the projection would not put it.
 * The projection is a stand-in as curved as the real ones: transverse to Web Mercator on a sphere.
 */
#include "check.h"
#include "random.h"
#include "tile.h"

#include <math.h>

#define RADIUS 6378137.0
#define MOST 1000000

static ty_point corners[MOST], places[MOST];

/* Transverse Mercator at 9 degrees east to Web Mercator, both of the sphere. */
static ty_point
project(ty_point p)
{
	double x = p.x / RADIUS, y = p.y / RADIUS;
	double latitude = asin(sin(y) / cosh(x)), longitude = 9 * M_PI / 180 + atan2(sinh(x), cos(y));

	return (ty_point){RADIUS * longitude, RADIUS * log(tan(M_PI / 4 + latitude / 2))};
}

static bool
lay_out(ty_point low, ty_point high, int zoom, ty_lattice *lattice)
{
	if (!CHECK(ty_lattice_cover(low, high, ty_lattice_step(zoom, 1), MOST, lattice), "box at %g %g, zoom %d", low.x,
			   low.y, zoom))
		return false;
	ty_lattice_corners(lattice, corners);
	for (int64_t i = 0; i < lattice->columns * lattice->rows; i++)
		places[i] = project(corners[i]);
	return true;
}

/* the tile that a place lies in */
static ty_tile
tile_at(ty_point mercator, int zoom)
{
	double side = ldexp(2 * TY_MERCATOR_HALF, -zoom);

	return (ty_tile){zoom, (int) floor((mercator.x + TY_MERCATOR_HALF) / side),
					 (int) floor((TY_MERCATOR_HALF - mercator.y) / side)};
}

static void
places_are_those_of_the_projection_to_less_than_a_unit(void)
{
	random_state r = random_seed(1);
	double worst = 0;

	for (int round = 0; round < 400; round++)
	{
		int zoom = (int) random_between(&r, 3, 20);
		double size = ldexp(2e7, -zoom);
		ty_point low = {random_unit(&r) * 4e5 - 2e5, 4.5e6 + random_unit(&r) * 2e6};
		ty_lattice lattice;
		double unit = ldexp(2 * TY_MERCATOR_HALF, -zoom) / TY_TILE_UNITS;

		NEED(lay_out(low, (ty_point){low.x + size, low.y + size}, zoom, &lattice), "round %d", round);
		for (int i = 0; i < 100; i++)
		{
			ty_point p = {low.x + random_unit(&r) * size, low.y + random_unit(&r) * size}, exact = project(p);
			ty_point place = ty_lattice_interpolate(&lattice, places, p);

			worst = fmax(worst, hypot(place.x - exact.x, place.y - exact.y) / unit);
		}
	}
	CHECK(worst < 1, "off by %g units", worst);
}

static void
neighbouring_tiles_have_the_same_polygon(void)
{
	random_state r = random_seed(2);

	for (int round = 0; round < 2000; round++)
	{
		int zoom = (int) random_between(&r, 6, 16);
		double size = ldexp(2e7, -zoom);
		ty_point p = {random_unit(&r) * 4e5 - 2e5, 4.5e6 + random_unit(&r) * 2e6}, a, b;
		ty_point low = {p.x - random_unit(&r) * size, p.y - random_unit(&r) * size};
		ty_point other = {p.x - random_unit(&r) * size, p.y - random_unit(&r) * size};
		ty_lattice lattice;
		ty_tile left, right;

		NEED(lay_out(low, (ty_point){low.x + size, low.y + size}, zoom, &lattice), "round %d", round);
		a = ty_lattice_interpolate(&lattice, places, p);
		left = tile_at(a, zoom);
		right = (ty_tile){zoom, left.x + 1, left.y - 1};
		NEED(lay_out(other, (ty_point){other.x + size, other.y + size}, zoom, &lattice), "round %d", round);
		b = ty_lattice_interpolate(&lattice, places, p);
		CHECK(a.x == b.x && a.y == b.y, "%.17g %.17g and %.17g %.17g", a.x, a.y, b.x, b.y);
		a = ty_tile_units(&left, a);
		b = ty_tile_units(&right, b);
		CHECK(a.x == b.x + TY_TILE_UNITS && a.y == b.y - TY_TILE_UNITS, "%g %g beside %g %g", a.x, a.y, b.x, b.y);
		CHECK(a.x >= 0 && a.x <= TY_TILE_UNITS && a.y >= 0 && a.y <= TY_TILE_UNITS, "%g %g is not in its tile", a.x,
			  a.y);
	}
}

static void
outside_the_lattice_its_nearest_cell_goes_on(void)
{
	ty_lattice lattice;
	ty_point in, near, beyond;

	NEED(lay_out((ty_point){0, 5e6}, (ty_point){4000, 5004000}, 12, &lattice), "a small box");
	in = ty_lattice_interpolate(&lattice, places, (ty_point){100, 5000100});
	near = ty_lattice_interpolate(&lattice, places, (ty_point){-3000, 4990000});
	beyond = ty_lattice_interpolate(&lattice, places, (ty_point){9000, 5009000});
	CHECK(fabs(near.x - project((ty_point){-3000, 4990000}).x) < 5, "%.17g", near.x);
	CHECK(fabs(near.y - project((ty_point){-3000, 4990000}).y) < 20, "%.17g", near.y);
	CHECK(near.x < in.x && in.x < beyond.x && near.y < in.y && in.y < beyond.y, "order of %g, %g, %g", near.y, in.y,
		  beyond.y);
	in = ty_lattice_interpolate(&lattice, places, (ty_point){NAN, 5e6});
	CHECK(isnan(in.x), "%g", in.x);
}

static void
cells_follow_the_unit(void)
{
	CHECK(ty_lattice_step(10, 1) == 2048, "%g m", ty_lattice_step(10, 1));
	CHECK(ty_lattice_step(10, 0.3048) == 4096 * 2.0, "%g feet", ty_lattice_step(10, 0.3048));
	CHECK(ty_lattice_step(10, 1000) == 4, "%g km", ty_lattice_step(10, 1000));
	CHECK(ty_lattice_step(0, 1) == ty_lattice_step(6, 1), "%g m at zoom 0", ty_lattice_step(0, 1));
}

static void
boxes_that_no_lattice_covers_are_refused(void)
{
	ty_lattice lattice;

	CHECK(!ty_lattice_cover((ty_point){NAN, 0}, (ty_point){1, 1}, 1, MOST, &lattice), "NaN");
	CHECK(!ty_lattice_cover((ty_point){0, 0}, (ty_point){INFINITY, 1}, 1, MOST, &lattice), "infinite");
	CHECK(!ty_lattice_cover((ty_point){1e300, 0}, (ty_point){1e300, 1}, 1, MOST, &lattice), "1e300");
	CHECK(!ty_lattice_cover((ty_point){0, 0}, (ty_point){1e6, 1e6}, 1, MOST, &lattice), "too many corners");
	CHECK(!ty_lattice_cover((ty_point){2, 2}, (ty_point){-2, -2}, 1, MOST, &lattice), "low above high");
	NEED(ty_lattice_cover((ty_point){-1, -1}, (ty_point){1, 1}, 1, MOST, &lattice), "a small box");
	CHECK(lattice.columns == 4 && lattice.rows == 4, "%lld x %lld corners", (long long) lattice.columns,
		  (long long) lattice.rows);
}

static void
check_ring(ty_point *ring, size_t n, size_t expected)
{
	size_t kept = ty_tile_tidy_ring(ring, n);
	double area = 0;

	CHECK(kept == expected, "%zu of %zu points are kept, not %zu", kept, n, expected);
	for (size_t i = 1; i < kept; i++)
		area += ring[i - 1].x * ring[i].y - ring[i].x * ring[i - 1].y;
	CHECK(kept == 0 || area > 0, "area %g", area);
	CHECK(kept == 0 || (ring[0].x == ring[kept - 1].x && ring[0].y == ring[kept - 1].y), "it is open");
}

static void
rings_are_closed_turn_right_and_have_an_area(void)
{
	ty_point square[] = {{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}}, turned[] = {{0, 0}, {0, 4}, {4, 4}, {4, 0}, {0, 0}};
	ty_point triangle[] = {{0, 0}, {4, 0}, {4, 4}, {4, 4}, {0, 0}}, flat[] = {{0, 0}, {4, 0}, {4, 0}, {0, 0}, {0, 0}};
	ty_point dot[] = {{1, 1}, {1, 1}, {1, 1}, {1, 1}, {1, 1}};

	check_ring(square, 5, 5);
	check_ring(turned, 5, 5);
	check_ring(triangle, 5, 4);
	check_ring(flat, 5, 0);
	check_ring(dot, 5, 0);
	check_ring(dot, 0, 0);
}

static void
a_tile_shows_what_reaches_into_its_buffer(void)
{
	ty_point in[] = {{-70, 0}, {-64, 0}, {-64, 4}}, out[] = {{-70, 0}, {-65, 0}, {-65, 4}};
	ty_point below[] = {{0, 4161}, {4, 4161}, {4, 4170}}, around[] = {{-9000, -9000}, {9000, -9000}, {9000, 9000}};

	CHECK(ty_tile_shows(in, 3), "64 units off");
	CHECK(!ty_tile_shows(out, 3), "65 units off");
	CHECK(!ty_tile_shows(below, 3), "65 units below");
	CHECK(ty_tile_shows(around, 3), "all around it");
}

static void
a_tiles_outline_is_cut_to_the_box(void)
{
	ty_tile world = {0, 0, 0}, tile = {1, 1, 0};
	ty_point ring[TY_TILE_OUTLINE], low = {1e6, 5e6}, high = {2e6, 7e6};

	NEED(ty_tile_outline(&world, low, high, ring), "the world meets everything");
	CHECK(ring[0].x == low.x && ring[0].y == low.y && ring[16].x == high.x && ring[16].y == high.y, "%g %g to %g %g",
		  ring[0].x, ring[0].y, ring[16].x, ring[16].y);
	CHECK(ring[32].x == ring[0].x && ring[32].y == ring[0].y, "it is open");
	NEED(ty_tile_outline(&tile, low, high, ring), "the north-eastern quarter");
	CHECK(!ty_tile_outline(&tile, (ty_point){-7e6, -7e6}, (ty_point){-6e6, -6e6}, ring), "the south-west");
}

int
main(int argc, char **argv)
{
	check_begin(argc, argv);
	RUN(places_are_those_of_the_projection_to_less_than_a_unit);
	RUN(neighbouring_tiles_have_the_same_polygon);
	RUN(outside_the_lattice_its_nearest_cell_goes_on);
	RUN(cells_follow_the_unit);
	RUN(boxes_that_no_lattice_covers_are_refused);
	RUN(rings_are_closed_turn_right_and_have_an_area);
	RUN(a_tile_shows_what_reaches_into_its_buffer);
	RUN(a_tiles_outline_is_cut_to_the_box);
	return check_end();
}
