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

#define TY_POLYGON_DATUM_SIZE (VARHDRSZ + TY_POLYGON_PAYLOAD)

/* Writes a placeholder's rectangle as a POLYGON value into memory of TY_POLYGON_DATUM_SIZE bytes. */
extern Datum ty_write_rectangle(void *memory, const ty_placeholder *placeholder, int32 srid);

/* The drawn placeholders as a GEOMETRYCOLLECTION in the current context; an error when it would exceed 1 GB. */
extern Datum ty_collection_datum(const ty_result *result, int32 srid);

/* The error of all results that a value cannot hold. */
extern _Noreturn void ty_refuse_size(void);

#endif
