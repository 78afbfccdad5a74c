/*
 * geometry.h - geometries as PostgreSQL values: from Datum to measures, from placeholders to Datum. How the bytes
 * are laid out is geometry_format's to know.
 */
#ifndef TY_GEOMETRY_H
#define TY_GEOMETRY_H

#include "compat.h"
#include "core/group.h"
#include "core/measure.h"
#include "geometry_format.h"

/*
 * Measures a geometry; false when it is EMPTY. Raises an error for what cannot be measured. hash may be NULL;
 * else it receives a hash of the geometry's bytes. Keeps nothing of the geometry and no memory.
 */
extern bool ty_measure_datum(Datum geometry, ty_building *building, int32 *srid, uint64 *hash);

/* The place of a POINT; any other type is an error that names the argument. */
extern bool ty_point_datum(Datum geometry, const char *argument, ty_point *point, int32 *srid);

/* Whether a geometry of any type has any point. */
extern bool ty_geometry_datum_has_points(Datum geometry);

/* The points of a LINESTRING in the current context; NULL when it has none, and for any other type. */
extern ty_point *ty_line_points(Datum geometry, uint32 *n);

/* A geometry with every point moved, of another SRID, in the current context. */
extern Datum ty_move_datum(Datum geometry, int32 srid, ty_point (*move)(const void *context, ty_point p),
						   const void *context);

/* A closed ring as a POLYGON, and a LINESTRING whose n points *points are still to be set. */
extern Datum ty_ring_datum(const ty_point *ring, uint32 n, int32 srid);
extern Datum ty_line_datum(int32 srid, uint32 n, ty_point **points);

/*
 * The outline that a building, which has been measured, is drawn with when it represents others, in the current
 * context; NULL for a rectangle. footprint: that of a POLYGON or of the largest polygon of a MULTIPOLYGON. auto: that
 * of a kept building, without what is too small to see. p: lengths in millimetres.
 */
extern ty_outline *ty_outline_to_draw(Datum geometry, const ty_building *building, double importance,
									  const ty_parameters *p, double metres_per_unit, Oid geometry_type);

extern ty_outline *ty_copy_outline(const ty_outline *outline, MemoryContext context);

#define TY_POLYGON_DATUM_SIZE (VARHDRSZ + TY_POLYGON_PAYLOAD)

/* Writes a placeholder's rectangle as a POLYGON value into memory of TY_POLYGON_DATUM_SIZE bytes. */
extern Datum ty_write_rectangle(void *memory, const ty_placeholder *placeholder, int32 srid);

/* An outline as it is drawn for a placeholder, as a POLYGON in the current context; how many bytes that takes. */
extern struct varlena *ty_outline_polygon(const ty_placeholder *placeholder, const ty_outline *outline, int32 srid);
extern size_t ty_outline_polygon_size(const ty_outline *outline);

/*
 * Placeholders whose outline (outlines: of the group's buildings) is no valid polygon are drawn as the rectangle
 * around it instead.
 */
extern void ty_check_outlines(ty_result *result, ty_outline *const *outlines, Oid geometry_type);

/*
 * The drawn placeholders as a GEOMETRYCOLLECTION in the current context; an error when it would exceed 1 GB. outlines:
 * of the group's buildings, or NULL.
 */
extern Datum ty_collection_datum(const ty_result *result, ty_outline *const *outlines, int32 srid);

/* The error of all results that a value cannot hold. */
extern _Noreturn void ty_refuse_size(void);

#endif
