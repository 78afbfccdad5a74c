/*
 * srid.c - see srid.h.
 *
 * spatial_ref_sys is read directly, as a catalog is: that needs no search_path, no privilege and no plan, and
 * works alike in parallel workers.
 */
#include "srid.h"

#include <ctype.h>
#include <math.h>

#include "access/genam.h"
#include "access/htup_details.h"
#include "access/table.h"
#include "catalog/pg_index.h"
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

Oid
ty_schema_of_type(Oid type)
{
	HeapTuple tuple = SearchSysCache1(TYPEOID, ObjectIdGetDatum(type));
	Oid schema;

	if (!HeapTupleIsValid(tuple))
		return InvalidOid;
	schema = ((Form_pg_type) GETSTRUCT(tuple))->typnamespace;
	ReleaseSysCache(tuple);
	return schema;
}

typedef enum crs_kind
{
	CRS_UNKNOWN = 0,
	CRS_PLANAR,
	CRS_GEOGRAPHIC,
	CRS_GEOCENTRIC
} crs_kind;

/* What is known of an SRID. */
typedef struct crs
{
	crs_kind kind;
	double metres_per_unit;
} crs;

/* Any form that PROJ knows for degrees; rotated poles ("+o_proj=longlat") among them. */
static crs_kind
proj4_kind(const char *text)
{
	if (strstr(text, "proj=longlat") || strstr(text, "proj=latlon") || strstr(text, "proj=lonlat"))
		return CRS_GEOGRAPHIC;
	if (strstr(text, "proj=geocent"))
		return CRS_GEOCENTRIC;
	return strstr(text, "proj=") ? CRS_PLANAR : CRS_UNKNOWN;
}

/* Feet, kilometres, and whatever +to_meter says; anything else counts as metres. */
static double
proj4_metres(const char *text)
{
	const char *to_meter = strstr(text, "+to_meter=");
	double metres = to_meter == NULL ? 0 : strtod(to_meter + strlen("+to_meter="), NULL);

	if (isfinite(metres) && metres > 0)
		return metres;
	if (strstr(text, "+units=us-ft"))
		return 1200 / 3937.0;
	if (strstr(text, "+units=ft"))
		return 0.3048;
	return strstr(text, "+units=km") ? 1000 : 1;
}

/* The keyword at or after *text, which comes to stand behind it; what is in quotes is passed over. 0: no more. */
static size_t
next_keyword(const char **text)
{
	const char *c = *text;
	size_t length = 0;
	bool quoted = false;

	for (; *c != '\0' && (quoted || !(isalpha((unsigned char) *c) || *c == '_')); c++)
		quoted ^= *c == '"';
	while (isalnum((unsigned char) c[length]) || c[length] == '_')
		length++;
	*text = c + length;
	return length;
}

/*
 * Keywords of WKT 1 and 2 that decide. A projected system comes before the geographic one it is based on, as does
 * the horizontal part of a compound one, so the first decides.
 */
static const struct
{
	const char *keyword;
	crs_kind kind;
} keywords[] = {
	{"PROJCS", CRS_PLANAR},			{"PROJCRS", CRS_PLANAR},
	{"PROJECTEDCRS", CRS_PLANAR},	{"DERIVEDPROJCRS", CRS_PLANAR},
	{"LOCAL_CS", CRS_PLANAR},		{"ENGCRS", CRS_PLANAR},
	{"ENGINEERINGCRS", CRS_PLANAR}, {"GEOGCS", CRS_GEOGRAPHIC},
	{"GEOGCRS", CRS_GEOGRAPHIC},	{"GEOGRAPHICCRS", CRS_GEOGRAPHIC},
	{"GEODCRS", CRS_GEOGRAPHIC},	{"GEODETICCRS", CRS_GEOGRAPHIC},
	{"GEOCCS", CRS_GEOCENTRIC},
};

static crs_kind
keyword_kind(const char *keyword, size_t length)
{
	for (size_t i = 0; i < lengthof(keywords); i++)
		if (strlen(keywords[i].keyword) == length && pg_strncasecmp(keyword, keywords[i].keyword, length) == 0)
			return keywords[i].kind;
	return CRS_UNKNOWN;
}

/* GEODCRS stands for both kinds; its axes tell. */
static crs_kind
wkt_kind(const char *text)
{
	crs_kind kind = CRS_UNKNOWN;
	size_t length;

	while ((length = next_keyword(&text)) > 0 && (kind == CRS_UNKNOWN || kind == CRS_GEOGRAPHIC))
		if (kind == CRS_UNKNOWN)
			kind = keyword_kind(text - length, length);
		else if (length == strlen("Cartesian") && pg_strncasecmp(text - length, "Cartesian", length) == 0)
			kind = CRS_GEOCENTRIC;
	return kind;
}

/* The column's text, or an empty one where there is none. */
static const char *
text_of_column(Relation relation, HeapTuple tuple, const char *column)
{
	AttrNumber number = get_attnum(RelationGetRelid(relation), column);
	bool null = true;
	Datum value = (Datum) 0;

	if (number != InvalidAttrNumber)
		value = heap_getattr(tuple, number, RelationGetDescr(relation), &null);
	return null ? "" : TextDatumGetCString(value);
}

/* The code that "+init=epsg:4326" names, else 0. */
static int32
named_code(const char *proj4)
{
	const char *name = strstr(proj4, "init=");

	if (name == NULL || pg_strncasecmp(name, "init=epsg:", strlen("init=epsg:")) != 0)
		return 0;
	return (int32) strtol(name + strlen("init=epsg:"), NULL, 10);
}

/* Whichever of the two texts refuses; *named receives a code that stands in for both, else 0. */
static crs
crs_of_row(Relation relation, HeapTuple tuple, int32 *named)
{
	const char *proj4 = text_of_column(relation, tuple, "proj4text");
	crs found = {wkt_kind(text_of_column(relation, tuple, "srtext")), proj4_metres(proj4)};

	if (found.kind <= CRS_PLANAR)
		found.kind = Max(found.kind, proj4_kind(proj4));
	*named = found.kind == CRS_UNKNOWN ? named_code(proj4) : 0;
	return found;
}

/* The primary key's index where its first column is this one: others cannot be searched by it. */
static Oid
index_on(Relation relation, AttrNumber column)
{
	Oid index = ty_primary_key_of(relation);
	HeapTuple tuple = OidIsValid(index) ? SearchSysCache1(INDEXRELID, ObjectIdGetDatum(index)) : NULL;

	if (!HeapTupleIsValid(tuple))
		return InvalidOid;
	if (((Form_pg_index) GETSTRUCT(tuple))->indkey.values[0] != column)
		index = InvalidOid;
	ReleaseSysCache(tuple);
	return index;
}

static crs
crs_of_srid(Relation relation, AttrNumber column, int32 srid, int32 *named)
{
	Oid index = index_on(relation, column);
	SysScanDesc scan;
	ScanKeyData key;
	HeapTuple tuple;
	crs found = {CRS_UNKNOWN, 1};

	*named = 0;
	ScanKeyInit(&key, column, BTEqualStrategyNumber, F_INT4EQ, Int32GetDatum(srid));
	scan = systable_beginscan(relation, index, OidIsValid(index), GetActiveSnapshot(), 1, &key);
	while ((tuple = systable_getnext(scan)) != NULL && found.kind <= CRS_PLANAR)
	{
		crs row = crs_of_row(relation, tuple, named);

		if (row.kind >= found.kind)
			found = row;
	}
	systable_endscan(scan);
	return found;
}

/* A row that only names another code (PostGIS numbers rows as EPSG does) is what that one is. */
static crs
look_up(Oid geometry_type, int32 srid)
{
	Oid table = get_relname_relid("spatial_ref_sys", ty_schema_of_type(geometry_type));
	AttrNumber column = OidIsValid(table) ? get_attnum(table, "srid") : InvalidAttrNumber;
	Relation relation;
	crs found = {CRS_UNKNOWN, 1};
	int32 named;

	if (column == InvalidAttrNumber || get_rel_relkind(table) != RELKIND_RELATION ||
		get_atttype(table, column) != INT4OID)
		return found;
	relation = table_open(table, AccessShareLock);
	found = crs_of_srid(relation, column, srid, &named);
	if (found.kind == CRS_UNKNOWN && named > 0)
		found = crs_of_srid(relation, column, named, &named);
	table_close(relation, AccessShareLock);
	return found;
}

static void
remember(ty_srid_cache *cache, int32 srid, double metres_per_unit)
{
	if (cache->count == cache->capacity)
	{
		cache->capacity = cache->capacity == 0 ? 4 : 2 * cache->capacity;
		cache->passed = cache->passed == NULL
							? MemoryContextAlloc(cache->context, cache->capacity * sizeof(ty_known_srid))
							: repalloc(cache->passed, cache->capacity * sizeof(ty_known_srid));
	}
	cache->passed[cache->count++] = (ty_known_srid){srid, metres_per_unit};
}

static void
refuse_kind(crs_kind kind, int32 srid)
{
	if (kind <= CRS_PLANAR)
		return;
	ereport(ERROR, errcode(ERRCODE_INVALID_PARAMETER_VALUE),
			kind == CRS_GEOGRAPHIC ? errmsg("SRID %d is geographic, its coordinates are degrees", srid)
								   : errmsg("SRID %d is geocentric, its coordinates are places in space", srid),
			errhint("Use ST_Transform to bring the geometries into a projected coordinate system in metres."));
}

double
ty_check_srid(ty_srid_cache *cache, int32 srid)
{
	crs found;

	if (srid <= 0)
		return 1;
	for (int i = 0; i < cache->count; i++)
		if (cache->passed[i].srid == srid)
			return cache->passed[i].metres_per_unit;
	found = look_up(cache->geometry_type, srid);
	refuse_kind(found.kind, srid);
	remember(cache, srid, found.metres_per_unit);
	return found.metres_per_unit;
}

void
ty_refuse_two_srids(int32 a, int32 b)
{
	ereport(ERROR, errcode(ERRCODE_INVALID_PARAMETER_VALUE),
			errmsg("the geometries of a group have two SRIDs, %d and %d", Min(a, b), Max(a, b)),
			errhint("Use ST_Transform to bring them into one coordinate system."));
}
