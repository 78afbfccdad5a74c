/*
 * geometry_format.h - how PostGIS stores a geometry, both ways, on plain bytes.
 *
 * Payload means the stored geometry after its varlena header. Reading understands both serialization
 * versions (gserialized_v1 up to PostGIS 2.5, gserialized_v2 since 3.0), any flags, Z and M, at any
 * alignment, and never reads beyond the given size. Nothing here recurses: nesting of any depth is walked
 * in one flat pass. Writing gives version 2, byte for byte as PostGIS writes the same geometry.
 *
 * Knows no PostgreSQL, so that it can be fuzzed alone.
 */
#ifndef TY_GEOMETRY_FORMAT_H
#define TY_GEOMETRY_FORMAT_H

#include "core/environment.h"
#include "core/measure.h"
#include "core/outline.h"

typedef enum ty_geometry_status
{
	TY_GEOMETRY_OK = 0,
	TY_GEOMETRY_EMPTY,		 /* no point at all, of whatever type */
	TY_GEOMETRY_UNSUPPORTED, /* a curve, TIN, triangle, polyhedral surface or collection that is not empty */
	TY_GEOMETRY_CORRUPT,	 /* truncated, or not a stored geometry */
	TY_GEOMETRY_NOT_FINITE,	 /* a coordinate is NaN or infinite, or the area overflows */
	TY_GEOMETRY_NO_MEMORY,	 /* the environment had none */
	TY_GEOMETRY_INTERRUPTED	 /* the environment asked to stop */
} ty_geometry_status;

/* type numbers as stored; 8 and up are curves, surfaces and TINs */
#define TY_GEOMETRY_POINT 1
#define TY_GEOMETRY_LINE 2
#define TY_GEOMETRY_POLYGON 3
#define TY_GEOMETRY_MULTIPOINT 4
#define TY_GEOMETRY_MULTILINE 5
#define TY_GEOMETRY_MULTIPOLYGON 6
#define TY_GEOMETRY_COLLECTION 7

/*
 * Measures the geometry; building->id is set to 0. *srid (0: unknown) and *type are set whenever the status is
 * not TY_GEOMETRY_CORRUPT; *building only with TY_GEOMETRY_OK. With TY_GEOMETRY_NOT_FINITE building->area is what
 * overflowed, unless a coordinate is at fault.
 */
ty_geometry_status ty_geometry_read(const ty_environment *env, const unsigned char *payload, size_t size,
									ty_building *building, int32_t *srid, uint32_t *type);

/* Whether a geometry of any type has a point: TY_GEOMETRY_OK, TY_GEOMETRY_EMPTY or TY_GEOMETRY_CORRUPT. */
ty_geometry_status ty_geometry_has_points(const unsigned char *payload, size_t size);

/* Called for n points that follow one another, `stride` bytes apart, x and y first. False ends the walk. */
typedef bool (*ty_points_visitor)(void *context, const unsigned char *points, size_t stride, uint32_t n);

/*
 * Visits the lines and rings of lines and polygons, single, multi or in collections of any depth, whose points are
 * passed over. TY_GEOMETRY_EMPTY when there is nothing at all; TY_GEOMETRY_UNSUPPORTED, with its *type, for a curve, a
 * surface or TIN anywhere, and where all there is are points. *srid and *type are set unless the status is
 * TY_GEOMETRY_CORRUPT. The lines before what is wrong have been visited.
 */
ty_geometry_status ty_geometry_visit_lines(const unsigned char *payload, size_t size, ty_points_visitor visit,
										   void *context, int32_t *srid, uint32_t *type);

/*
 * For error messages: the first x or y that is NaN or infinite. False when there is none, that is when
 * TY_GEOMETRY_NOT_FINITE came from the area.
 */
bool ty_geometry_find_not_finite(const unsigned char *payload, size_t size, double *value);

/*
 * The points of a LINESTRING: where the first lies (at any alignment), the bytes from one to the next, and how many.
 * False when it has none, for another type and for corrupt bytes.
 */
bool ty_geometry_line(const unsigned char *payload, size_t size, const unsigned char **points, size_t *stride,
					  uint32_t *n);

/*
 * The outline of a POLYGON, or of the largest polygon, the first of equals, of a MULTIPOLYGON: *outline, to be given
 * back with ty_release; NULL where there is none that could be drawn. The geometry has been read before.
 */
ty_geometry_status ty_geometry_outline(const ty_environment *env, const unsigned char *payload, size_t size,
									   ty_outline **outline);

/*
 * A copy of a geometry of any type with every point moved in x and y, with another SRID and without a box. copy: room
 * for size bytes; *copy_size: how many it takes. False: corrupt.
 */
bool ty_geometry_move(const unsigned char *payload, size_t size, int32_t srid,
					  ty_point (*move)(const void *context, ty_point p), const void *context, unsigned char *copy,
					  size_t *copy_size);

/* "Polygon" for 3 and so on; "unknown" for numbers that PostGIS does not use */
const char *ty_geometry_type_name(uint32_t type);

/* payload sizes of what the writers write */
#define TY_RING_PAYLOAD(points) (36 + sizeof(ty_point) * (size_t) (points))
#define TY_POLYGON_PAYLOAD TY_RING_PAYLOAD(5)
#define TY_LINE_PAYLOAD(points) (12 + sizeof(ty_point) * (size_t) (points))
#define TY_RECTANGLE_IN_COLLECTION ((size_t) 96)
#define TY_COLLECTION_PAYLOAD(polygons) \
	((polygons) == 0 ? (size_t) 12 : 28 + TY_RECTANGLE_IN_COLLECTION * (size_t) (polygons))

size_t ty_outline_payload(const ty_outline *outline);				/* of a POLYGON */
size_t ty_outline_payload_in_collection(const ty_outline *outline); /* of it as a member of a collection */

/* An outline as a POLYGON. payload: ty_outline_payload(outline) bytes, at any alignment. */
void ty_geometry_write_outline(unsigned char *payload, int32_t srid, const ty_outline *outline);

/* A POLYGON of one closed ring of five points. payload: TY_POLYGON_PAYLOAD bytes, at any alignment. */
void ty_geometry_write_polygon(unsigned char *payload, int32_t srid, const ty_point ring[5]);

/* A POLYGON of one closed ring of n points, n > 0. payload: TY_RING_PAYLOAD(n) bytes, at any alignment. */
void ty_geometry_write_ring(unsigned char *payload, int32_t srid, const ty_point *ring, uint32_t n);

/*
 * All of a LINESTRING of n points but these: TY_LINE_PAYLOAD(n) bytes, at any alignment, that end with them. Without a
 * box, as PostGIS allows.
 */
void ty_geometry_begin_line(unsigned char *payload, int32_t srid, uint32_t n);

/*
 * A GEOMETRYCOLLECTION of such polygons and of outlines, written one after the other. It takes
 * TY_COLLECTION_PAYLOAD(polygons) bytes where all are such polygons; an outline takes
 * ty_outline_payload_in_collection bytes in place of TY_RECTANGLE_IN_COLLECTION.
 *
 *     ty_collection_begin(&writer, payload, srid, polygons);
 *     ty_collection_add(&writer, ring); ...					// as often as said
 *     ty_collection_end(&writer);
 */
typedef struct ty_collection_writer
{
	unsigned char *payload, *at;
	uint32_t polygons;
	ty_point low, high; /* the box */
} ty_collection_writer;

void ty_collection_begin(ty_collection_writer *writer, unsigned char *payload, int32_t srid, uint32_t polygons);
void ty_collection_add(ty_collection_writer *writer, const ty_point ring[5]);
void ty_collection_add_outline(ty_collection_writer *writer, const ty_outline *outline);
void ty_collection_end(ty_collection_writer *writer);

#endif
