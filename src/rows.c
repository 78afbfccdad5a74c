/*
 * rows.c - the window function typify_rows: which buildings stand in rows.
 *
 * All rows of a partition are found when its first row asks, and kept with the partition.
 */
#include "compat.h"

#include "access/htup_details.h"
#include "funcapi.h"
#include "miscadmin.h"
#include "utils/memutils.h"
#include "windowapi.h"

#include "backend.h"
#include "core/alignment.h"
#include "geometry.h"
#include "srid.h"

#define GEOMETRY 0

/* fields of the composite typify_row_place, in order */
enum
{
	FIELD_ROW = 0,
	FIELD_PLACE,
	FIELDS
};

/* lives with the partition, zero at first */
typedef struct partition
{
	bool done;
	uint32 *row, *place; /* by row of the partition; TY_NONE: in no row of buildings */
} partition;

/* the buildings of a partition while they are gathered */
typedef struct gathering
{
	ty_srid_cache *srids;
	int32 srid;
	size_t count;
	ty_building *buildings; /* [rows of the partition], of which count are taken */
	uint32 *origin;			/* [rows] the row that each came from */
} gathering;

/* Takes the row's building in, if it has one. */
static void
gather_row(gathering *g, WindowObject window, int64 row)
{
	bool null, outside;
	Datum geometry = WinGetFuncArgInPartition(window, GEOMETRY, (int) row, WINDOW_SEEK_HEAD, false, &null, &outside);
	ty_building building;
	uint64 hash;
	int32 srid;

	if (null || !ty_measure_datum(geometry, &building, &srid, &hash))
		return;
	if (g->count == 0)
	{
		ty_check_srid(g->srids, srid);
		g->srid = srid;
	}
	if (g->srid != srid)
		ty_refuse_two_srids(g->srid, srid);
	building.id = (int64) hash;
	g->origin[g->count] = (uint32) row;
	g->buildings[g->count++] = building;
}

/* What a row leaves behind goes with the row. */
static void
gather(gathering *g, WindowObject window, int64 rows)
{
	MemoryContext scratch = AllocSetContextCreate(CurrentMemoryContext, "typify_rows row", ALLOCSET_SMALL_SIZES);

	for (int64 row = 0; row < rows; row++)
	{
		MemoryContext old = MemoryContextSwitchTo(scratch);

		CHECK_FOR_INTERRUPTS();
		gather_row(g, window, row);
		MemoryContextSwitchTo(old);
		MemoryContextReset(scratch);
	}
	MemoryContextDelete(scratch);
}

/* Finds the rows of what was gathered, and tells each building its own. */
static void
number_buildings(const gathering *g, partition *p)
{
	uint32 *order = ty_allocate_array(&ty_backend_environment, g->count, sizeof(uint32));
	ty_rows rows;

	ty_check_status(ty_rows_of_group(&ty_backend_environment, g->buildings, g->count, (ty_parting){0}, order, &rows));
	for (size_t rank = 0; rank < g->count; rank++)
	{
		p->row[g->origin[order[rank]]] = rows.span[rank].row;
		p->place[g->origin[order[rank]]] = rows.span[rank].first;
	}
	ty_rows_free(&ty_backend_environment, &rows);
	pfree(order);
}

static void
find_rows(ty_srid_cache *srids, WindowObject window, MemoryContext context, partition *p)
{
	int64 rows = WinGetPartitionRowCount(window);
	gathering g = {.srids = srids};

	if (rows > (int64) TY_MAX_VERTICES)
		ty_check_status(TY_TOO_MANY);
	g.buildings = ty_allocate_array(&ty_backend_environment, rows, sizeof(ty_building));
	g.origin = ty_allocate_array(&ty_backend_environment, rows, sizeof(uint32));
	p->row = MemoryContextAllocHuge(context, rows * sizeof(uint32));
	p->place = MemoryContextAllocHuge(context, rows * sizeof(uint32));
	memset(p->row, 0xff, rows * sizeof(uint32));
	gather(&g, window, rows);
	if (g.count > 0)
		number_buildings(&g, p);
	pfree(g.buildings);
	pfree(g.origin);
}

static ty_srid_cache *
srids_of(FunctionCallInfo fcinfo)
{
	FmgrInfo *function = fcinfo->flinfo;

	if (function->fn_extra == NULL)
	{
		ty_srid_cache *srids = MemoryContextAllocZero(function->fn_mcxt, sizeof(ty_srid_cache));

		ty_srid_cache_begin(srids, function->fn_oid, GEOMETRY, function->fn_mcxt);
		function->fn_extra = srids;
	}
	return function->fn_extra;
}

PG_FUNCTION_INFO_V1(typify_rows);
Datum
typify_rows(PG_FUNCTION_ARGS)
{
	WindowObject window = PG_WINDOW_OBJECT();
	TupleDesc shape;
	Datum values[FIELDS];
	bool nulls[FIELDS] = {false, false};
	partition *p;
	int64 at;

	if (!WindowObjectIsValid(window))
		elog(ERROR, "typify_rows was called outside of a window");
	p = WinGetPartitionLocalMemory(window, sizeof(partition));
	if (!p->done)
	{
		find_rows(srids_of(fcinfo), window, GetMemoryChunkContext(p), p);
		p->done = true;
	}
	at = WinGetCurrentPosition(window);
	if (p->row[at] == TY_NONE)
		PG_RETURN_NULL();
	if (get_call_result_type(fcinfo, NULL, &shape) != TYPEFUNC_COMPOSITE || shape->natts != FIELDS)
		elog(ERROR, "typify_rows is not declared as this library expects");
	values[FIELD_ROW] = Int32GetDatum((int32) p->row[at]);
	values[FIELD_PLACE] = Int32GetDatum((int32) p->place[at]);
	PG_RETURN_DATUM(HeapTupleGetDatum(heap_form_tuple(BlessTupleDesc(shape), values, nulls)));
}
