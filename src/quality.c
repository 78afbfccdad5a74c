/*
 * quality.c - what the quality report needs of C: pairs of boxes that meet, the nearest segment, a building's measures.
 */
#include "compat.h"

#include <math.h>

#include "catalog/pg_type.h"
#include "funcapi.h"
#include "miscadmin.h"
#include "utils/array.h"
#include "utils/geo_decls.h"
#include "utils/tuplestore.h"

#include "backend.h"
#include "core/extents.h"
#include "core/nearest.h"
#include "geometry.h"
#include "options.h"
#include "srid.h"

StaticAssertDecl(sizeof(BOX) == sizeof(ty_extent) && offsetof(BOX, low) == offsetof(ty_extent, low),
				 "PostgreSQL's boxes are read as the core's");
StaticAssertDecl(sizeof(LSEG) == sizeof(ty_segment), "PostgreSQL's segments are read as the core's");

/* The doubles of an array of boxes, segments or points, all of them finite. */
static const double *
doubles_of(FunctionCallInfo fcinfo, int argument, const char *name, size_t doubles_each, size_t *count)
{
	ArrayType *array = PG_GETARG_ARRAYTYPE_P(argument);
	const double *values = (const double *) ARR_DATA_PTR(array);

	if (array_contains_nulls(array))
		ereport(ERROR, errcode(ERRCODE_NULL_VALUE_NOT_ALLOWED), errmsg("%s must not contain nulls", name),
				errhint("Leave out rows without a geometry."));
	*count = ArrayGetNItems(ARR_NDIM(array), ARR_DIMS(array));
	for (size_t i = 0; i < *count * doubles_each; i++)
		if (!isfinite(values[i]))
			ty_refuse_value(psprintf("a coordinate of %s", name), values[i], "a finite number");
	return values;
}

/* ---- pairs ---- */

typedef struct pair_writer
{
	Tuplestorestate *store;
	TupleDesc shape;
	uint32_t a;
} pair_writer;

/* Places from 1. */
static void
write_pair(void *context, uint32_t b)
{
	pair_writer *writer = context;
	Datum values[2] = {Int32GetDatum((int32) (writer->a + 1)), Int32GetDatum((int32) (b + 1))};
	bool nulls[2] = {false, false};

	tuplestore_putvalues(writer->store, writer->shape, values, nulls);
}

/* The set that a function returns as a whole, in memory that lasts as long as the query. */
static pair_writer
begin_pairs(FunctionCallInfo fcinfo)
{
	ReturnSetInfo *set = (ReturnSetInfo *) fcinfo->resultinfo;
	pair_writer writer = {0};
	MemoryContext before;

	if (set == NULL || !IsA(set, ReturnSetInfo) || !(set->allowedModes & SFRM_Materialize) ||
		get_call_result_type(fcinfo, NULL, &writer.shape) != TYPEFUNC_COMPOSITE)
		ereport(ERROR, errcode(ERRCODE_FEATURE_NOT_SUPPORTED), errmsg("a set of rows has no place here"),
				errhint("Call the function in FROM."));
	before = MemoryContextSwitchTo(set->econtext->ecxt_per_query_memory);
	writer.shape = CreateTupleDescCopy(writer.shape);
	writer.store = tuplestore_begin_heap(set->allowedModes & SFRM_Materialize_Random, false, work_mem);
	MemoryContextSwitchTo(before);
	set->returnMode = SFRM_Materialize;
	set->setResult = writer.store;
	set->setDesc = writer.shape;
	return writer;
}

PG_FUNCTION_INFO_V1(typify_box_pairs);
Datum
typify_box_pairs(PG_FUNCTION_ARGS)
{
	size_t count_a, count_b;
	const ty_extent *a = (const ty_extent *) doubles_of(fcinfo, 0, "a", 4, &count_a);
	const ty_extent *b = (const ty_extent *) doubles_of(fcinfo, 1, "b", 4, &count_b);
	pair_writer writer = begin_pairs(fcinfo);
	ty_extents tree;

	ty_check_status(ty_extents_build(&ty_backend_environment, b, count_b, &tree));
	for (size_t i = 0; i < count_a; i++)
	{
		CHECK_FOR_INTERRUPTS();
		writer.a = (uint32_t) i;
		ty_extents_meeting(&tree, &a[i], write_pair, &writer);
	}
	ty_extents_free(&ty_backend_environment, &tree);
	return (Datum) 0;
}

/* ---- the nearest segment ---- */

static ty_extent *
boxes_of_segments(const ty_segment *segments, size_t count)
{
	ty_extent *boxes = palloc_extended(Max(count, 1) * sizeof(ty_extent), MCXT_ALLOC_HUGE);

	for (size_t i = 0; i < count; i++)
		boxes[i] = ty_segment_extent(segments[i]);
	return boxes;
}

PG_FUNCTION_INFO_V1(typify_nearest_segments);
Datum
typify_nearest_segments(PG_FUNCTION_ARGS)
{
	size_t count, segment_count;
	const ty_point *points = (const ty_point *) doubles_of(fcinfo, 0, "points", 2, &count);
	const ty_segment *segments = (const ty_segment *) doubles_of(fcinfo, 1, "segments", 4, &segment_count);
	Datum *places = palloc_extended(Max(count, 1) * sizeof(Datum), MCXT_ALLOC_HUGE);
	bool *nulls = palloc_extended(Max(count, 1), MCXT_ALLOC_HUGE);
	int dimension = (int) count, lower = 1;
	ty_extents tree;

	ty_check_status(
		ty_extents_build(&ty_backend_environment, boxes_of_segments(segments, segment_count), segment_count, &tree));
	for (size_t i = 0; i < count; i++)
	{
		uint32_t nearest;

		CHECK_FOR_INTERRUPTS();
		nearest = ty_extents_nearest_segment(&tree, segments, points[i]);
		nulls[i] = nearest == TY_NOBODY;
		places[i] = Int32GetDatum(nulls[i] ? 0 : (int32) (nearest + 1));
	}
	ty_extents_free(&ty_backend_environment, &tree);
	PG_RETURN_ARRAYTYPE_P(construct_md_array(places, nulls, count > 0 ? 1 : 0, &dimension, &lower, INT4OID,
											 sizeof(int32), true, TYPALIGN_INT));
}

/* ---- measures ---- */

/* What is kept from row to row. */
typedef struct measure_call
{
	ty_srid_cache srids;
	TupleDesc shape;
} measure_call;

static measure_call *
measure_call_of(FunctionCallInfo fcinfo)
{
	FmgrInfo *function = fcinfo->flinfo;

	if (function->fn_extra == NULL)
	{
		MemoryContext before = MemoryContextSwitchTo(function->fn_mcxt);
		measure_call *call = palloc0(sizeof(measure_call));

		ty_srid_cache_begin(&call->srids, function->fn_oid, 0, function->fn_mcxt);
		if (get_call_result_type(fcinfo, NULL, &call->shape) != TYPEFUNC_COMPOSITE)
			elog(ERROR, "typify_measures does not return a row");
		call->shape = BlessTupleDesc(CreateTupleDescCopy(call->shape));
		MemoryContextSwitchTo(before);
		function->fn_extra = call;
	}
	return function->fn_extra;
}

PG_FUNCTION_INFO_V1(typify_measures);
Datum
typify_measures(PG_FUNCTION_ARGS)
{
	measure_call *call = measure_call_of(fcinfo);
	bool nulls[6] = {false};
	Datum values[6];
	ty_building building;
	int32 srid;

	if (!ty_measure_datum(PG_GETARG_DATUM(0), &building, &srid, NULL))
		PG_RETURN_NULL();
	ty_check_srid(&call->srids, srid);
	values[0] = Float8GetDatum(building.x);
	values[1] = Float8GetDatum(building.y);
	values[2] = Float8GetDatum(building.area);
	values[3] = Float8GetDatum(building.ratio);
	values[4] = Float8GetDatum(building.ux);
	values[5] = Float8GetDatum(building.uy);
	PG_RETURN_DATUM(HeapTupleGetDatum(heap_form_tuple(call->shape, values, nulls)));
}
