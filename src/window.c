/*
 * window.c - the window function typify_cluster.
 *
 * All numbers of a partition are computed when its first row asks, and kept with the partition. A building's id is a
 * hash of its geometry's bytes, so that rows whose measures are equal but whose bytes are not are told apart
 * whatever order they come in. Copies of the same bytes are interchangeable: which of them gets which number, where
 * they are not all merged into one placeholder, depends on the order of the rows.
 */
#include "compat.h"

#include "miscadmin.h"
#include "utils/memutils.h"
#include "windowapi.h"

#include "backend.h"
#include "call.h"
#include "core/group.h"
#include "core/mesh.h"
#include "geometry.h"
#include "progress.h"

#define GEOMETRY 0
#define PARAMETERS 1
#define PARAMETER_COUNT 3

#define NO_CLUSTER (-1) /* a row without geometry */

/* lives with the partition, zero at first */
typedef struct partition
{
	bool done;
	int32 *cluster; /* by row */
} partition;

/* The buildings of a partition while they are gathered. */
typedef struct gathering
{
	ty_call *call;
	int64 rows;
	ty_parameters parameters;
	uint64 generation; /* of the call's parameters at the first building; 0: there is none yet */
	int32 srid;
	double metres_per_unit; /* of the SRID */
	ty_barrier_set *barriers;
	size_t count;
	ty_building *buildings; /* [rows], of which count are taken */
	ty_outline **outlines;	/* [rows] of the buildings; NULL as a whole where the shape needs none */
	bool *usable;			/* [rows] whether the row has a building */
	MemoryContext context;	/* of all that */
} gathering;

static NullableDatum
argument_at(WindowObject window, int argument, int64 row)
{
	NullableDatum value;
	bool outside;

	value.value =
		WinGetFuncArgInPartition(window, argument, (int) row, WINDOW_SEEK_HEAD, false, &value.isnull, &outside);
	return value;
}

/* Parameters and SRID of a row that has a building, checked against those of the first. */
static void
check_row(gathering *g, WindowObject window, int64 row, int32 srid)
{
	ty_call *call = g->call;
	bool first = g->generation == 0;
	NullableDatum arguments[TY_CALL_ARGUMENTS];

	if (first || call->constancy == TY_PER_ROW)
	{
		for (int i = 0; i < call->given; i++)
			arguments[i] = argument_at(window, PARAMETERS + i, row);
		ty_call_parameters(call, arguments, first);
	}
	if (first)
	{
		g->metres_per_unit = ty_check_srid(&call->srids, srid);
		g->parameters = call->parameters;
		g->generation = call->generation;
		g->srid = srid;
		g->barriers = call->barriers.current;
		ty_check_barrier_srid(g->barriers, srid);
	}
	if (g->generation != call->generation)
		ty_refuse_varying_parameters();
	if (g->srid != srid)
		ty_refuse_two_srids(g->srid, srid);
}

/* The next building's outline: how much room its placeholder needs is what tells who is merged for want of it. */
static void
gather_outline(gathering *g, Datum geometry)
{
	ty_outline *outline = ty_outline_to_draw(geometry, &g->buildings[g->count], 1, &g->parameters, g->metres_per_unit,
											 g->call->srids.geometry_type);

	if (g->outlines == NULL)
		g->outlines = MemoryContextAllocHuge(g->context, g->rows * sizeof(ty_outline *));
	g->outlines[g->count] = outline == NULL ? NULL : ty_copy_outline(outline, g->context);
}

/* Takes the row's building in; false when it has none. */
static bool
gather_row(gathering *g, WindowObject window, int64 row)
{
	NullableDatum geometry = argument_at(window, GEOMETRY, row);
	ty_building building;
	uint64 hash;
	int32 srid;

	if (geometry.isnull || !ty_measure_datum(geometry.value, &building, &srid, &hash))
		return false;
	building.id = (int64) hash;
	check_row(g, window, row, srid);
	g->buildings[g->count] = building;
	if (unlikely(ty_wants_outline(&g->parameters)))
		gather_outline(g, geometry.value);
	g->count++;
	return true;
}

/* Gathers the buildings of all rows that have one. What a row leaves behind goes with the row. */
static void
gather(gathering *g, WindowObject window, int64 rows)
{
	MemoryContext scratch = AllocSetContextCreate(CurrentMemoryContext, "typify_cluster row", ALLOCSET_SMALL_SIZES);

	for (int64 row = 0; row < rows; row++)
	{
		MemoryContext old = MemoryContextSwitchTo(scratch);

		CHECK_FOR_INTERRUPTS();
		g->usable[row] = gather_row(g, window, row);
		MemoryContextSwitchTo(old);
		MemoryContextReset(scratch);
	}
	MemoryContextDelete(scratch);
}

/* Typifies what was gathered, and frees it, for there may be much of it. */
static void
typify_gathered(gathering *g, ty_result *result)
{
	*result = (ty_result){0};
	if (g->count > 0)
	{
		ty_bring_to_ground(&g->parameters, g->metres_per_unit);
		ty_typify_group(&(ty_input){.buildings = g->buildings,
									.n = g->count,
									.outlines = g->outlines,
									.barriers = ty_lines_of_barriers(g->barriers)},
						&g->parameters, result);
	}
	pfree(g->buildings);
}

/*
 * The numbers of the buildings, in the order of their rows, come first; then they move up to their rows, the last
 * one first.
 */
static void
number_rows(const gathering *g, const ty_result *result, int64 rows, int32 *cluster)
{
	size_t building = g->count;

	for (size_t k = 0; k < result->count; k++)
		for (uint32 i = 0; i < result->placeholders[k].count; i++)
			cluster[result->members[result->placeholders[k].first + i]] = (int32) k;
	for (int64 row = rows; row-- > 0;)
		cluster[row] = g->usable[row] ? cluster[--building] : NO_CLUSTER;
}

/* The cluster number of every row, in the given context. */
static int32 *
cluster_partition(ty_call *call, WindowObject window, MemoryContext context)
{
	int64 rows = WinGetPartitionRowCount(window);
	gathering g = {.call = call, .rows = rows, .context = CurrentMemoryContext};
	ty_result result;
	int32 *cluster;

	if (rows > (int64) TY_MAX_VERTICES)
		ty_check_status(TY_TOO_MANY);
	g.buildings = ty_allocate_array(&ty_backend_environment, rows, sizeof(ty_building));
	g.usable = ty_allocate_array(&ty_backend_environment, rows, sizeof(bool));
	gather(&g, window, rows);
	typify_gathered(&g, &result);
	cluster = MemoryContextAllocHuge(context, rows * sizeof(int32));
	number_rows(&g, &result, rows, cluster);
	ty_result_free(&ty_backend_environment, &result);
	pfree(g.usable);
	return cluster;
}

PG_FUNCTION_INFO_V1(typify_cluster);
Datum
typify_cluster(PG_FUNCTION_ARGS)
{
	WindowObject window = PG_WINDOW_OBJECT();
	partition *p;
	int32 cluster;

	if (!WindowObjectIsValid(window))
		elog(ERROR, "typify_cluster was called outside of a window");
	p = WinGetPartitionLocalMemory(window, sizeof(partition));
	if (!p->done)
	{
		ty_call *call = ty_call_of(fcinfo, PARAMETERS, PARAMETER_COUNT, GEOMETRY, true);

		call->group_context = GetMemoryChunkContext(p);
		p->cluster = cluster_partition(call, window, GetMemoryChunkContext(p));
		p->done = true;
	}
	cluster = p->cluster[WinGetCurrentPosition(window)];
	if (cluster == NO_CLUSTER)
		PG_RETURN_NULL();
	PG_RETURN_INT32(cluster);
}
