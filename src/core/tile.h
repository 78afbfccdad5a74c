/*
 * tile.h - polygons in the units of a vector tile (4 096 to its side, y downwards), by few control points.
 *
 * A map projection is smooth. So only the corners of a lattice are projected to Web Mercator, and what lies in a cell
 * goes by its four corners (bilinear). Cells are a sixteenth of a tile or smaller and stand at multiples of their side,
 * a power of two that the zoom gives: whatever tile asks, a point is interpolated between the same four corners and is
 * rounded on one grid for the whole world. So a polygon is the same in all tiles that show it.
 *
 * A cell of side s is off by s^2 / 8 times the curvature of the projection: that of Mercator at 50 degrees, a quarter
 * of a unit at zoom 6 (a unit is an eighth of a pixel) and half as much at every further one. Smaller zooms take the
 * cells of zoom 6.
 */
#ifndef TY_TILE_H
#define TY_TILE_H

#include "environment.h"
#include "measure.h"

#define TY_TILE_UNITS 4096
#define TY_TILE_BUFFER 64 /* what a tile shows beyond its sides, so that outlines are drawn whole */
#define TY_TILE_MAX_ZOOM 30

/* Cells with their first corner at (column * step, row * step), columns x rows corners, row by row. */
typedef struct ty_lattice
{
	double step;
	int64_t column, row;
	int64_t columns, rows;
} ty_lattice;

/* Half of Web Mercator's world in metres. */
#define TY_MERCATOR_HALF 20037508.342789244

/* Cells' side in ground units: a power of two. zoom: 0 .. TY_TILE_MAX_ZOOM; metres_per_unit > 0. */
double ty_lattice_step(int zoom, double metres_per_unit);
/*
 * The cells that cover a box. False when there are more than most corners, or none because a coordinate is not finite
 * or too large.
 */
bool ty_lattice_cover(ty_point low, ty_point high, double step, int64_t most, ty_lattice *lattice);
/* The corners in ground units; corners: columns * rows of them. */
void ty_lattice_corners(const ty_lattice *lattice, ty_point *corners);
/* The place of p among the corners' new places; outside the lattice by its nearest cell. */
ty_point ty_lattice_interpolate(const ty_lattice *lattice, const ty_point *places, ty_point p);

typedef struct ty_tile
{
	int zoom, x, y;
} ty_tile;

/*
 * The tile with its buffer, cut to a box of Web Mercator: a closed ring with as many points on each side as bend where
 * it is projected. False where the two do not meet.
 */
#define TY_TILE_OUTLINE 33
bool ty_tile_outline(const ty_tile *tile, ty_point low, ty_point high, ty_point ring[TY_TILE_OUTLINE]);

/* A place in Web Mercator to whole units of a tile. */
ty_point ty_tile_units(const ty_tile *tile, ty_point mercator);
/*
 * Tidies a closed ring of whole units in place: no point twice in a row, area positive where y points downwards (what
 * the vector tile specification asks of an outer ring). Returns its new size, 0 for a ring without area.
 */
size_t ty_tile_tidy_ring(ty_point *ring, size_t n);
/* Whether the box of a ring, n > 0, meets the tile with its buffer. */
bool ty_tile_shows(const ty_point *ring, size_t n);

#endif
