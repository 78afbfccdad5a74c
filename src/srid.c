/*
 * srid.c - see srid.h.
 *
 * spatial_ref_sys is read directly, as a catalog is: that needs no search_path, no privilege and no plan, and
 * works alike in parallel workers.
 */
#include "srid.h"

#include "access/genam.h"
#include "access/htup_details.h"
#include "access/table.h"
#include "catalog/pg_type.h"
#include "utils/builtins.h"
#include "utils/fmgroids.h"
#include "utils/lsyscache.h"
#include "utils/rel.h"
#include "utils/relcache.h"
#include "utils/snapmgr.h"
#include "utils/syscache.h"

void
ty_srid_cache_begin(ty_srid_cache *cache, Oid function, int argument, MemoryContext context)
{
	Oid *types;
	int count;

	get_func_signature(function, &types, &count);
	cache->context = context;
	cache->geometry_type = types[argument];
	cache->passed = NULL;
	cache->count = cache->capacity = 0;
}

static Oid
schema_of_type(Oid type)
{
	HeapTuple tuple = SearchSysCache1(TYPEOID, ObjectIdGetDatum(type));
	Oid schema;

	if (!HeapTupleIsValid(tuple))
		return InvalidOid;
	schema = ((Form_pg_type) GETSTRUCT(tuple))->typnamespace;
	ReleaseSysCache(tuple);
	return schema;
}

/* Any form that PROJ knows for degrees; rotated poles ("+o_proj=longlat") among them. */
static bool
proj4_is_geographic(const char *text)
{
	return strstr(text, "proj=longlat") || strstr(text, "proj=latlon") || strstr(text, "proj=lonlat");
}

/* WKT 1 and 2; a projected system names its geographic base inside */
static bool
wkt_is_geographic(const char *text)
{
	return (strstr(text, "GEOGCS") || strstr(text, "GEOGCRS") || strstr(text, "GEOGRAPHICCRS")) &&
		   !strstr(text, "PROJCS") && !strstr(text, "PROJCRS") && !strstr(text, "PROJECTEDCRS");
}

static bool
column_matches(Relation relation, HeapTuple tuple, const char *column, bool (*is_geographic)(const char *))
{
	AttrNumber number = get_attnum(RelationGetRelid(relation), column);
	bool null = true;
	Datum value = (Datum) 0;

	if (number != InvalidAttrNumber)
		value = heap_getattr(tuple, number, RelationGetDescr(relation), &null);
	return !null && is_geographic(TextDatumGetCString(value));
}

static bool
row_is_geographic(Relation relation, int32 srid)
{
	SysScanDesc scan;
	ScanKeyData key;
	HeapTuple tuple;
	bool geographic = false;
	Oid index = ty_primary_key_of(relation);

	ScanKeyInit(&key, get_attnum(RelationGetRelid(relation), "srid"), BTEqualStrategyNumber, F_INT4EQ,
				Int32GetDatum(srid));
	scan = systable_beginscan(relation, index, OidIsValid(index), GetActiveSnapshot(), 1, &key);
	while ((tuple = systable_getnext(scan)) != NULL && !geographic)
		geographic = column_matches(relation, tuple, "srtext", wkt_is_geographic) ||
					 column_matches(relation, tuple, "proj4text", proj4_is_geographic);
	systable_endscan(scan);
	return geographic;
}

static bool
srid_is_geographic(Oid geometry_type, int32 srid)
{
	Oid table = get_relname_relid("spatial_ref_sys", schema_of_type(geometry_type));
	Relation relation;
	bool geographic;

	if (!OidIsValid(table) || get_rel_relkind(table) != RELKIND_RELATION ||
		get_atttype(table, get_attnum(table, "srid")) != INT4OID)
		return false;
	relation = table_open(table, AccessShareLock);
	geographic = row_is_geographic(relation, srid);
	table_close(relation, AccessShareLock);
	return geographic;
}

static void
remember(ty_srid_cache *cache, int32 srid)
{
	if (cache->count == cache->capacity)
	{
		cache->capacity = cache->capacity == 0 ? 4 : 2 * cache->capacity;
		cache->passed = cache->passed == NULL ? MemoryContextAlloc(cache->context, cache->capacity * sizeof(int32))
											  : repalloc(cache->passed, cache->capacity * sizeof(int32));
	}
	cache->passed[cache->count++] = srid;
}

void
ty_check_srid(ty_srid_cache *cache, int32 srid)
{
	if (srid <= 0)
		return;
	for (int i = 0; i < cache->count; i++)
		if (cache->passed[i] == srid)
			return;
	if (srid_is_geographic(cache->geometry_type, srid))
		ereport(ERROR, errcode(ERRCODE_INVALID_PARAMETER_VALUE),
				errmsg("SRID %d is geographic, its coordinates are degrees", srid),
				errhint("Use ST_Transform to bring the geometries into a projected coordinate system in metres."));
	remember(cache, srid);
}

void
ty_refuse_two_srids(int32 a, int32 b)
{
	ereport(ERROR, errcode(ERRCODE_INVALID_PARAMETER_VALUE),
			errmsg("the geometries of a group have two SRIDs, %d and %d", Min(a, b), Max(a, b)),
			errhint("Use ST_Transform to bring them into one coordinate system."));
}
