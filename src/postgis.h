/*
 * postgis.h - functions of PostGIS, and so of GEOS, that are called from C. They are found by the schema of the type
 * geometry, whatever the search_path.
 */
#ifndef TY_POSTGIS_H
#define TY_POSTGIS_H

#include "compat.h"

/* Whether a polygon is valid, without the notice of ST_IsValid. */
extern bool ty_is_valid(Datum polygon, Oid geometry_type);

/* ST_SimplifyPreserveTopology: a valid polygon with fewer points, none of which is new. */
extern Datum ty_simplified(Datum polygon, double tolerance, Oid geometry_type);

#endif
