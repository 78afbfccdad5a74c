/*
 * tile.c - polygons in the units of a vector tile. A tile holds thousands of placeholders, each a rectangle: to project
 * and clip them one by one (ST_Transform, ST_AsMVTGeom) takes several times as long as all the rest. So the corners of
 * a lattice are projected in one call, and polygons are placed between them; core/tile.h says why that does no harm.
 *
 *     lattice := typify_tile_lattice(box of the polygons);		a LINESTRING
 *     frame := typify_tile_frame(lattice, ST_Transform(lattice, 3857), z, x, y);
 *     typify_tile_node(..., frame), for each node
 */
#include "compat.h"

#include <math.h>

#include "backend.h"
#include "core/tile.h"
#include "geometry.h"
#include "hierarchy.h"
#include "options.h"

/* As many as a tile that shows a continent may need; far more than that is a mistake. */
#define MOST_CORNERS 1000000

#define MERCATOR_SRID 3857

/* The argument of typify_tile_node after those of typify_node_placeholder. */
#define TILE_NODE_FRAME 14

/* A frame is a bytea of this and of the corners in Web Mercator; it lives as long as the statement that makes it. */
typedef struct tile_frame
{
	int32 header; /* varlena */
	int32 corners;
	ty_tile tile;
	int32 padding;
	ty_lattice lattice;
	ty_point places[FLEXIBLE_ARRAY_MEMBER];
} tile_frame;

static void
check_tile(int zoom, int x, int y)
{
	int64 tiles = INT64CONST(1) << Min(Max(zoom, 0), TY_TILE_MAX_ZOOM);

	if (zoom < 0 || zoom > TY_TILE_MAX_ZOOM)
		ereport(ERROR, errcode(ERRCODE_INVALID_PARAMETER_VALUE), errmsg("there is no tile %d/%d/%d", zoom, x, y),
				errhint("Zoom z is 0 to %d.", TY_TILE_MAX_ZOOM));
	if (x < 0 || x >= tiles || y < 0 || y >= tiles)
		ereport(ERROR, errcode(ERRCODE_INVALID_PARAMETER_VALUE), errmsg("there is no tile %d/%d/%d", zoom, x, y),
				errhint("At zoom %d, x and y are 0 to %lld.", zoom, (long long) tiles - 1));
}

PG_FUNCTION_INFO_V1(typify_tile_area);
Datum
typify_tile_area(PG_FUNCTION_ARGS)
{
	ty_tile tile = {PG_GETARG_INT32(0), PG_GETARG_INT32(1), PG_GETARG_INT32(2)};
	ty_point low = {PG_GETARG_FLOAT8(3), PG_GETARG_FLOAT8(4)}, high = {PG_GETARG_FLOAT8(5), PG_GETARG_FLOAT8(6)};
	ty_point ring[TY_TILE_OUTLINE];

	check_tile(tile.zoom, tile.x, tile.y);
	if (!ty_tile_outline(&tile, low, high, ring))
		PG_RETURN_NULL();
	PG_RETURN_DATUM(ty_ring_datum(ring, TY_TILE_OUTLINE, MERCATOR_SRID));
}

PG_FUNCTION_INFO_V1(typify_tile_lattice);
Datum
typify_tile_lattice(PG_FUNCTION_ARGS)
{
	ty_point low = {PG_GETARG_FLOAT8(0), PG_GETARG_FLOAT8(1)}, high = {PG_GETARG_FLOAT8(2), PG_GETARG_FLOAT8(3)};
	int32 srid = PG_GETARG_INT32(4), zoom = PG_GETARG_INT32(5);
	double metres_per_unit = PG_GETARG_FLOAT8(6);
	ty_lattice lattice;
	ty_point *corners;
	Datum line;

	if (zoom < 0 || zoom > TY_TILE_MAX_ZOOM)
		ty_refuse_value("z", zoom, psprintf("0 to %d", TY_TILE_MAX_ZOOM));
	if (!(isfinite(metres_per_unit) && metres_per_unit > 0))
		ty_refuse_value("metres_per_unit", metres_per_unit, "a finite number above 0");
	if (!ty_lattice_cover(low, high, ty_lattice_step(zoom, metres_per_unit), MOST_CORNERS, &lattice))
		ereport(ERROR, errcode(ERRCODE_INVALID_PARAMETER_VALUE),
				errmsg("the box from %s %s to %s %s is too large for a tile of zoom %d", ty_number_text(low.x),
					   ty_number_text(low.y), ty_number_text(high.x), ty_number_text(high.y), zoom),
				errhint("Give the box of what the tile shows, in units of its coordinate system."));
	line = ty_line_datum(srid, (uint32) (lattice.columns * lattice.rows), &corners);
	ty_lattice_corners(&lattice, corners);
	PG_RETURN_DATUM(line);
}

static bool
all_finite(const ty_point *points, uint32 n)
{
	for (uint32 i = 0; i < n; i++)
		if (!isfinite(points[i].x) || !isfinite(points[i].y))
			return false;
	return true;
}

/* The lattice that its corners show; false when they are none. */
static bool
read_lattice(const ty_point *corners, uint32 n, ty_lattice *lattice)
{
	uint32 columns = 1;

	while (columns < n && corners[columns].y == corners[0].y)
		columns++;
	if (n < 4 || columns < 2 || n / columns < 2 || n % columns != 0 || !(corners[1].x > corners[0].x))
		return false;
	return ty_lattice_cover(corners[0], (ty_point){corners[columns - 2].x, corners[n - columns - 1].y},
							corners[1].x - corners[0].x, MOST_CORNERS, lattice) &&
		   lattice->columns == columns && lattice->rows * columns == n;
}

PG_FUNCTION_INFO_V1(typify_tile_frame);
Datum
typify_tile_frame(PG_FUNCTION_ARGS)
{
	ty_tile tile = {PG_GETARG_INT32(2), PG_GETARG_INT32(3), PG_GETARG_INT32(4)};
	uint32 n, projected_n;
	size_t size;
	ty_point *corners, *places;
	tile_frame *frame;
	ty_lattice lattice;

	check_tile(tile.zoom, tile.x, tile.y);
	corners = ty_line_points(PG_GETARG_DATUM(0), &n);
	places = ty_line_points(PG_GETARG_DATUM(1), &projected_n);
	if (corners == NULL || places == NULL || n != projected_n || !read_lattice(corners, n, &lattice) ||
		!all_finite(places, n))
		ereport(ERROR, errcode(ERRCODE_INVALID_PARAMETER_VALUE), errmsg("lattice and projected do not belong together"),
				errhint("Give what typify_tile_lattice returns, and its ST_Transform to 3857."));
	size = offsetof(tile_frame, places) + n * sizeof(ty_point);
	frame = palloc0(size);
	SET_VARSIZE(frame, size);
	frame->corners = (int32) n;
	frame->tile = tile;
	frame->lattice = lattice;
	memcpy(frame->places, places, n * sizeof(ty_point));
	PG_RETURN_BYTEA_P(frame);
}

static const tile_frame *
frame_argument(Datum datum)
{
	/* what a function returned is aligned, and neither short nor compressed */
	const tile_frame *frame = (const tile_frame *) PG_DETOAST_DATUM(datum);

	if (VARSIZE(frame) < offsetof(tile_frame, places) ||
		VARSIZE(frame) != offsetof(tile_frame, places) + (size_t) frame->corners * sizeof(ty_point) ||
		frame->lattice.columns < 2 || frame->lattice.rows < 2 || frame->lattice.columns > frame->corners ||
		frame->lattice.rows > frame->corners || frame->lattice.columns * frame->lattice.rows != frame->corners ||
		!(frame->lattice.step > 0) || frame->tile.zoom < 0 || frame->tile.zoom > TY_TILE_MAX_ZOOM)
		ereport(ERROR, errcode(ERRCODE_INVALID_PARAMETER_VALUE), errmsg("frame is no frame of a tile"),
				errhint("Give what typify_tile_frame returns in the same statement."));
	return frame;
}

PG_FUNCTION_INFO_V1(typify_tile_node);
Datum
typify_tile_node(PG_FUNCTION_ARGS)
{
	const tile_frame *frame;
	ty_placeholder p;
	ty_point ring[5];
	uint32 n;

	if (PG_ARGISNULL(TILE_NODE_FRAME) || !ty_draw_node(fcinfo, &p) || !(p.area > 0))
		PG_RETURN_NULL();
	frame = frame_argument(PG_GETARG_DATUM(TILE_NODE_FRAME));
	ty_rectangle((ty_point){p.x, p.y}, p.area, p.ratio, p.ux, p.uy, ring);
	for (int i = 0; i < 5; i++)
		ring[i] = ty_tile_units(&frame->tile, ty_lattice_interpolate(&frame->lattice, frame->places, ring[i]));
	if (!ty_tile_shows(ring, 5))
		PG_RETURN_NULL();
	n = (uint32) ty_tile_tidy_ring(ring, 5);
	if (n == 0)
		PG_RETURN_NULL();
	PG_RETURN_DATUM(ty_ring_datum(ring, n, 0));
}

static ty_point
to_mercator(const void *context, ty_point p)
{
	const tile_frame *frame = context;

	return ty_lattice_interpolate(&frame->lattice, frame->places, p);
}

PG_FUNCTION_INFO_V1(typify_tile_project);
Datum
typify_tile_project(PG_FUNCTION_ARGS)
{
	const tile_frame *frame = frame_argument(PG_GETARG_DATUM(1));

	PG_RETURN_DATUM(ty_move_datum(PG_GETARG_DATUM(0), MERCATOR_SRID, to_mercator, frame));
}
