/*
 * srid.h - what spatial_ref_sys says: which coordinate systems are not planar (neither degrees nor places in space
 * are ground units), and how many metres their unit has.
 */
#ifndef TY_SRID_H
#define TY_SRID_H

#include "compat.h"

typedef struct ty_known_srid
{
	int32 srid;
	double metres_per_unit;
} ty_known_srid;

/* SRIDs that passed the check, so that each is looked up once a query. */
typedef struct ty_srid_cache
{
	MemoryContext context;
	Oid geometry_type;
	ty_known_srid *passed;
	int count, capacity;
} ty_srid_cache;

/* function takes a geometry as its argument number `argument`; the cache's memory comes from context */
extern void ty_srid_cache_begin(ty_srid_cache *cache, Oid function, int argument, MemoryContext context);

/*
 * Raises an error when the SRID is known as geographic or geocentric (spatial_ref_sys of the schema that PostGIS
 * lives in). Else says how many metres its unit has, as SQL's typify_metres_per_unit does; an unknown SRID is taken as
 * metres.
 */
extern double ty_check_srid(ty_srid_cache *cache, int32 srid);

extern _Noreturn void ty_refuse_two_srids(int32 a, int32 b);

/* of a type that is there */
extern Oid ty_schema_of_type(Oid type);

#endif
