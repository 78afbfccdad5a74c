/* pairing.c - what links and blocks need of C: the centre of a building, pairs of points, the nearest point. */
#include "compat.h"

#include <math.h>

#include "catalog/pg_type.h"
#include "utils/array.h"
#include "utils/geo_decls.h"

#include "backend.h"
#include "core/pairing.h"
#include "geometry.h"
#include "options.h"
#include "srid.h"

StaticAssertDecl(sizeof(Point) == sizeof(ty_point) && offsetof(Point, y) == offsetof(ty_point, y),
				 "PostgreSQL's points are read as the core's");

/* Which reference systems passed, from row to row. */
static ty_srid_cache *
srids_of(FunctionCallInfo fcinfo)
{
	FmgrInfo *function = fcinfo->flinfo;

	if (function->fn_extra == NULL)
	{
		function->fn_extra = MemoryContextAlloc(function->fn_mcxt, sizeof(ty_srid_cache));
		ty_srid_cache_begin(function->fn_extra, function->fn_oid, 0, function->fn_mcxt);
	}
	return function->fn_extra;
}

PG_FUNCTION_INFO_V1(typify_centre);
Datum
typify_centre(PG_FUNCTION_ARGS)
{
	Point *centre;
	ty_building building;
	int32 srid;

	if (!ty_measure_datum(PG_GETARG_DATUM(0), &building, &srid, NULL))
		PG_RETURN_NULL();
	ty_check_srid(srids_of(fcinfo), srid);
	centre = palloc(sizeof(Point));
	centre->x = building.x;
	centre->y = building.y;
	PG_RETURN_POINT_P(centre);
}

typedef struct points_argument
{
	const ty_point *points;
	size_t count;
} points_argument;

static points_argument
points_of(FunctionCallInfo fcinfo, int argument, const char *name)
{
	ArrayType *array = PG_GETARG_ARRAYTYPE_P(argument);
	points_argument points = {(const ty_point *) ARR_DATA_PTR(array), ArrayGetNItems(ARR_NDIM(array), ARR_DIMS(array))};

	if (array_contains_nulls(array))
		ereport(ERROR, errcode(ERRCODE_NULL_VALUE_NOT_ALLOWED), errmsg("%s must not contain nulls", name),
				errhint("Leave out rows without a point."));
	for (size_t i = 0; i < points.count; i++)
	{
		if (!isfinite(points.points[i].x) || !isfinite(points.points[i].y))
			ty_refuse_value(psprintf("a coordinate of %s", name),
							isfinite(points.points[i].x) ? points.points[i].y : points.points[i].x, "a finite number");
	}
	return points;
}

/* Numbers from 0 become places from 1, and nobody NULL. */
static Datum
places_datum(const uint32 *numbers, size_t count)
{
	Datum *places = palloc_extended(Max(count, 1) * sizeof(Datum), MCXT_ALLOC_HUGE);
	bool *nulls = palloc(Max(count, 1));
	int dimension = (int) count, lower = 1;

	for (size_t i = 0; i < count; i++)
	{
		nulls[i] = numbers[i] == TY_NOBODY;
		places[i] = Int32GetDatum(nulls[i] ? 0 : (int32) (numbers[i] + 1));
	}
	return PointerGetDatum(construct_md_array(places, nulls, count > 0 ? 1 : 0, &dimension, &lower, INT4OID,
											  sizeof(int32), true, TYPALIGN_INT));
}

PG_FUNCTION_INFO_V1(typify_pairs);
Datum
typify_pairs(PG_FUNCTION_ARGS)
{
	points_argument a = points_of(fcinfo, 0, "a");
	points_argument b = points_of(fcinfo, 1, "b");
	double max_distance = PG_GETARG_FLOAT8(2);
	uint32 *partner = palloc_extended(Max(a.count, 1) * sizeof(uint32), MCXT_ALLOC_HUGE);

	if (!(isfinite(max_distance) && max_distance >= 0))
		ty_refuse_value("max_distance", max_distance, "a finite number of at least 0");
	ty_check_status(
		ty_pair_points(&ty_backend_environment, a.points, a.count, b.points, b.count, max_distance, partner));
	PG_RETURN_DATUM(places_datum(partner, a.count));
}

PG_FUNCTION_INFO_V1(typify_nearest);
Datum
typify_nearest(PG_FUNCTION_ARGS)
{
	points_argument a = points_of(fcinfo, 0, "a");
	points_argument b = points_of(fcinfo, 1, "b");
	uint32 *nearest = palloc_extended(Max(a.count, 1) * sizeof(uint32), MCXT_ALLOC_HUGE);

	ty_check_status(ty_nearest_points(&ty_backend_environment, a.points, a.count, b.points, b.count, nearest));
	PG_RETURN_DATUM(places_datum(nearest, a.count));
}
