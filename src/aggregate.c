/*
 * aggregate.c - the aggregates typify, typify_placeholders and typify_hierarchy.
 *
 * A state is the measures of a group's buildings, in any order. The transition function measures a row and adds it;
 * combine appends; the final functions put the buildings in canonical order and so give the same answer however
 * the rows came together. A group without a usable row has no state.
 */
#include "compat.h"

#include "catalog/pg_type.h"
#include "miscadmin.h"
#include "utils/memutils.h"

#include "backend.h"
#include "call.h"
#include "core/grid.h"
#include "core/group.h"
#include "core/mesh.h"
#include "geometry.h"
#include "hierarchy.h"
#include "options.h"
#include "progress.h"
#include "row_array.h"

/* The array's first size in bytes, good for nine buildings: there may be 100 000 groups of about that many. */
#define FIRST_SIZE 512

typedef struct state
{
	MemoryContext context; /* of the state and its array */
	ty_parameters parameters;
	uint64 generation; /* of the call's parameters when they were last found equal to these */
	int32 srid;
	double metres_per_unit; /* of the SRID */
	size_t count, capacity;
	ty_building *buildings;
} state;

/*
 * A state as it travels between the processes of one parallel query: this header, then the buildings. Both sides
 * run the same library on the same machine, so values are copied as they are.
 */
typedef struct state_image
{
	uint32 magic;
	uint32 building_size;
	int32 srid;
	uint32 unused;
	uint64 count;
	double metres_per_unit;
	ty_parameters parameters;
} state_image;

#define STATE_MAGIC 0x54590002 /* the last byte is the version */

/* --- states --- */

/* Makes an empty state in the context. */
static state *
state_new(MemoryContext context, const ty_parameters *parameters, int32 srid, double metres_per_unit)
{
	state *s = MemoryContextAlloc(context, sizeof(state));

	s->context = context;
	s->parameters = *parameters;
	s->generation = 0;
	s->srid = srid;
	s->metres_per_unit = metres_per_unit;
	s->count = s->capacity = 0;
	s->buildings = NULL;
	return s;
}

/* Room for more buildings. Sizes are powers of two: that is what a memory context hands out anyway. */
static void
state_reserve(state *s, size_t more)
{
	size_t size = FIRST_SIZE;

	if (more <= s->capacity - s->count)
		return;
	if (more > TY_MAX_VERTICES - s->count)
		ty_check_status(TY_TOO_MANY);
	while (size / sizeof(ty_building) < s->count + more)
		size *= 2;
	if (s->buildings == NULL)
		s->buildings = MemoryContextAllocHuge(s->context, size);
	else
		s->buildings = repalloc_huge(s->buildings, size);
	s->capacity = size / sizeof(ty_building);
}

static void
state_append(state *s, const ty_building *buildings, size_t count)
{
	state_reserve(s, count);
	memcpy(s->buildings + s->count, buildings, count * sizeof(ty_building));
	s->count += count;
}

static void
state_check_srid(const state *s, int32 srid)
{
	if (unlikely(s->srid != srid))
		ty_refuse_two_srids(s->srid, srid);
}

/* Appends a copy of what b holds; b stays as it is. */
static void
state_merge(state *a, const state *b)
{
	state_check_srid(a, b->srid);
	if (!ty_same_parameters(&a->parameters, &b->parameters))
		ty_refuse_varying_parameters();
	state_append(a, b->buildings, b->count);
}

/* In the current context; an error where a bytea cannot hold it. */
static bytea *
state_serialize(const state *s)
{
	size_t size = VARHDRSZ + sizeof(state_image) + s->count * sizeof(ty_building);
	state_image image;
	bytea *value;

	if (!AllocSizeIsValid(size))
		ereport(ERROR, errcode(ERRCODE_PROGRAM_LIMIT_EXCEEDED),
				errmsg("a group of %zu buildings is too large to pass between parallel processes", s->count),
				errhint("SET max_parallel_workers_per_gather = 0"));
	memset(&image, 0, sizeof(image));
	image.magic = STATE_MAGIC;
	image.building_size = sizeof(ty_building);
	image.srid = s->srid;
	image.count = s->count;
	image.metres_per_unit = s->metres_per_unit;
	image.parameters = s->parameters;
	value = palloc(size);
	SET_VARSIZE(value, size);
	memcpy(VARDATA(value), &image, sizeof(image));
	memcpy(VARDATA(value) + sizeof(image), s->buildings, s->count * sizeof(ty_building));
	return value;
}

/* Makes the state in the current context; nothing of the value is kept. */
static state *
state_deserialize(bytea *value)
{
	size_t size = VARSIZE_ANY_EXHDR(value);
	state_image image;
	state *s;

	if (size < sizeof(image))
		ereport(ERROR, errcode(ERRCODE_INVALID_BINARY_REPRESENTATION), errmsg("a typify state is truncated"));
	memcpy(&image, VARDATA_ANY(value), sizeof(image));
	if (image.magic != STATE_MAGIC || image.building_size != sizeof(ty_building) || image.count == 0 ||
		image.count > TY_MAX_VERTICES || size - sizeof(image) != image.count * sizeof(ty_building))
		ereport(ERROR, errcode(ERRCODE_INVALID_BINARY_REPRESENTATION),
				errmsg("a typify state is from another version, or broken"));
	s = state_new(CurrentMemoryContext, &image.parameters, image.srid, image.metres_per_unit);
	state_reserve(s, image.count);
	memcpy(s->buildings, VARDATA_ANY(value) + sizeof(image), image.count * sizeof(ty_building));
	s->count = image.count;
	return s;
}

/* --- rows --- */

/* Where a transition function finds what; 0: it takes none. The state is argument 0, the geometry 1. */
typedef struct row_layout
{
	int id;
	int parameters;
	int importance;
	bool without_scale; /* parameters: where the scale would be */
} row_layout;

static const row_layout geometry_layout = {.parameters = 2};
static const row_layout placeholders_layout = {.id = 2, .parameters = 3, .importance = 6};
static const row_layout hierarchy_layout = {.id = 2, .parameters = 2, .importance = 5, .without_scale = true};

/* The context of states; the one preamble of all five functions. */
static MemoryContext
aggregate_context(FunctionCallInfo fcinfo)
{
	MemoryContext context;

	if (AggCheckCallContext(fcinfo, &context) == 0)
		elog(ERROR, "typify: a support function was called outside of an aggregate");
	return context;
}

static void
check_importance(FunctionCallInfo fcinfo, int argument)
{
	double importance;

	if (argument == 0 || argument >= PG_NARGS() || PG_ARGISNULL(argument))
		return;
	importance = PG_GETARG_FLOAT8(argument);
	if (!(importance >= 1))
		ty_refuse_value("importance", importance, "at least 1");
	if (importance != 1)
		ereport(ERROR, errcode(ERRCODE_FEATURE_NOT_SUPPORTED), errmsg("importance other than 1 is not supported yet"),
				errhint("Leave it out, or set it to NULL."));
}

/* The state of the row's group, with the row's parameters and SRID checked against it. */
static state *
state_for_row(FunctionCallInfo fcinfo, MemoryContext context, const row_layout *layout, int32 srid)
{
	state *s = PG_ARGISNULL(0) ? NULL : (state *) PG_GETARG_POINTER(0);
	ty_call *call = ty_call_of(fcinfo, layout->parameters, 1, !layout->without_scale);
	const ty_parameters *parameters = ty_call_parameters(call, &fcinfo->args[layout->parameters], s == NULL);

	if (s == NULL)
		s = state_new(context, parameters, srid, ty_check_srid(&call->srids, srid));
	else if (unlikely(s->generation != call->generation) && !ty_same_parameters(&s->parameters, parameters))
		ty_refuse_varying_parameters();
	s->generation = call->generation;
	state_check_srid(s, srid);
	return s;
}

/* Adds the row's building; a row without geometry is passed over, and nothing else of it looked at. */
static Datum
add_row(FunctionCallInfo fcinfo, const row_layout *layout)
{
	MemoryContext context = aggregate_context(fcinfo);
	ty_building building;
	int32 srid;
	state *s;

	if (PG_ARGISNULL(1) || !ty_measure_datum(PG_GETARG_DATUM(1), &building, &srid, NULL))
	{
		if (PG_ARGISNULL(0))
			PG_RETURN_NULL();
		PG_RETURN_DATUM(PG_GETARG_DATUM(0));
	}
	s = state_for_row(fcinfo, context, layout, srid);
	if (layout->id != 0 && PG_ARGISNULL(layout->id))
		ty_refuse_null("id");
	building.id = layout->id != 0 ? PG_GETARG_INT64(layout->id) : 0;
	check_importance(fcinfo, layout->importance);
	if (unlikely(s->count == s->capacity))
		state_reserve(s, 1);
	s->buildings[s->count++] = building;
	PG_RETURN_POINTER(s);
}

/* --- results --- */

/* From this many buildings on, what their mesh took is given back before the result's value is made. */
#define LARGE_GROUP 100000

/* Typifies the group; the result is of the current context. The state stays as it is. */
static void
state_typify(const state *s, ty_result *result)
{
	ty_parameters parameters = s->parameters;

	ty_bring_to_ground(&parameters, s->metres_per_unit);
	ty_typify_group(s->buildings, s->count, &parameters, result);
	if (s->count >= LARGE_GROUP)
		ty_trim_memory();
	if (result->undrawn > 0)
		ereport(
			WARNING,
			errmsg_plural("%zu placeholder has no size and is not drawn",
						  "%zu placeholders have no size and are not drawn", result->undrawn, result->undrawn),
			errhint(
				"Points, lines and polygons without area have none; with psi => 1 nothing has from lod200_scale on."));
}

/* Numbers that sort as the ids do. */
static uint64
sortable_id(int64 id)
{
	return (uint64) id ^ UINT64CONST(0x8000000000000000);
}

static int64
id_of_sortable(uint64 number)
{
	return (int64) (number ^ UINT64CONST(0x8000000000000000));
}

/* Ids must differ. What it takes to see that is given back before the group is typified. */
static void
check_ids(const state *s)
{
	uint64 *ids = ty_allocate_array(&ty_backend_environment, s->count, sizeof(uint64));
	uint32 *unused = ty_allocate_array(&ty_backend_environment, s->count, sizeof(uint32));

	for (size_t i = 0; i < s->count; i++)
	{
		ids[i] = sortable_id(s->buildings[i].id);
		unused[i] = 0;
	}
	ty_check_status(ty_sort_keys(&ty_backend_environment, ids, unused, s->count));
	for (size_t i = 1; i < s->count; i++)
		if (ids[i] == ids[i - 1])
			ereport(ERROR, errcode(ERRCODE_INVALID_PARAMETER_VALUE),
					errmsg("id %lld occurs more than once in a group", (long long) id_of_sortable(ids[i])),
					errhint("Pass a key of the buildings as id."));
	pfree(ids);
	pfree(unused);
}

#define MEMBERS_SIZE(count) (ARR_OVERHEAD_NONULLS(1) + (size_t) (count) * sizeof(int64))
/* what a row takes at most besides geometry and members */
#define ROW_SIZE (TY_ROW_OVERHEAD + 6 * sizeof(float8))

/* The array under construction. */
typedef struct row_writer
{
	ty_row_array rows;
	const state *group;
	const ty_result *result;
	void *polygon;		/* TY_POLYGON_DATUM_SIZE bytes, used for every row */
	ArrayType *members; /* room for the largest placeholder's */
	uint32 *unused;		/* as long, zero: what their sort moves along */
} row_writer;

static size_t
rows_size(const ty_result *result)
{
	size_t size = 0;

	for (size_t k = 0; k < result->count; k++)
		size += ROW_SIZE + TY_POLYGON_DATUM_SIZE + MEMBERS_SIZE(result->placeholders[k].count);
	return size;
}

static void
writer_begin(row_writer *writer, FunctionCallInfo fcinfo, const state *s, const ty_result *result)
{
	uint32 most = 0;

	ty_row_array_begin(&writer->rows, fcinfo, TY_PLACEHOLDER_FIELDS, "typify_placeholder", rows_size(result),
					   result->count);
	for (size_t k = 0; k < result->count; k++)
		most = Max(most, result->placeholders[k].count);
	writer->group = s;
	writer->result = result;
	writer->polygon = palloc(TY_POLYGON_DATUM_SIZE);
	writer->members = palloc(MEMBERS_SIZE(most));
	writer->unused = palloc0(most * sizeof(uint32));
}

/* The ids of the placeholder's members, ascending, as an array that the next call overwrites. */
static Datum
writer_members(row_writer *writer, const ty_placeholder *placeholder)
{
	const uint32 *members = writer->result->members + placeholder->first;
	uint64 *ids;

	ty_array_header(writer->members, MEMBERS_SIZE(placeholder->count), INT8OID, (int) placeholder->count);
	ids = (uint64 *) ARR_DATA_PTR(writer->members);
	for (uint32 i = 0; i < placeholder->count; i++)
		ids[i] = sortable_id(writer->group->buildings[members[i]].id);
	ty_check_status(ty_sort_keys(&ty_backend_environment, ids, writer->unused, placeholder->count));
	for (uint32 i = 0; i < placeholder->count; i++)
		ids[i] = (uint64) id_of_sortable(ids[i]);
	return PointerGetDatum(writer->members);
}

static void
writer_add(row_writer *writer, const ty_placeholder *placeholder)
{
	const state *s = writer->group;

	ty_placeholder_values(placeholder, s->buildings[placeholder->representative].id, s->srid, writer->polygon,
						  writer->rows.values, writer->rows.nulls);
	writer->rows.values[TY_PLACEHOLDER_MEMBERS] = writer_members(writer, placeholder);
	writer->rows.nulls[TY_PLACEHOLDER_MEMBERS] = false;
	ty_row_array_add(&writer->rows);
}

static Datum
writer_end(row_writer *writer)
{
	pfree(writer->polygon);
	pfree(writer->members);
	pfree(writer->unused);
	return ty_row_array_end(&writer->rows);
}

static Datum
placeholder_array(FunctionCallInfo fcinfo, const state *s, const ty_result *result)
{
	row_writer writer;

	writer_begin(&writer, fcinfo, s, result);
	for (size_t k = 0; k < result->count; k++)
	{
		CHECK_FOR_INTERRUPTS();
		writer_add(&writer, &result->placeholders[k]);
	}
	return writer_end(&writer);
}

/* --- what SQL calls --- */

PG_FUNCTION_INFO_V1(typify_transition);
Datum
typify_transition(PG_FUNCTION_ARGS)
{
	return add_row(fcinfo, &geometry_layout);
}

PG_FUNCTION_INFO_V1(typify_placeholders_transition);
Datum
typify_placeholders_transition(PG_FUNCTION_ARGS)
{
	return add_row(fcinfo, &placeholders_layout);
}

PG_FUNCTION_INFO_V1(typify_hierarchy_transition);
Datum
typify_hierarchy_transition(PG_FUNCTION_ARGS)
{
	return add_row(fcinfo, &hierarchy_layout);
}

PG_FUNCTION_INFO_V1(typify_combine);
Datum
typify_combine(PG_FUNCTION_ARGS)
{
	MemoryContext context = aggregate_context(fcinfo);
	state *a = PG_ARGISNULL(0) ? NULL : (state *) PG_GETARG_POINTER(0);
	const state *b = PG_ARGISNULL(1) ? NULL : (const state *) PG_GETARG_POINTER(1);

	if (a == NULL && b == NULL)
		PG_RETURN_NULL();
	if (a == NULL)
		a = state_new(context, &b->parameters, b->srid, b->metres_per_unit);
	if (b != NULL)
		state_merge(a, b);
	PG_RETURN_POINTER(a);
}

PG_FUNCTION_INFO_V1(typify_serialize);
Datum
typify_serialize(PG_FUNCTION_ARGS)
{
	aggregate_context(fcinfo);
	PG_RETURN_BYTEA_P(state_serialize((const state *) PG_GETARG_POINTER(0)));
}

PG_FUNCTION_INFO_V1(typify_deserialize);
Datum
typify_deserialize(PG_FUNCTION_ARGS)
{
	aggregate_context(fcinfo);
	PG_RETURN_POINTER(state_deserialize(PG_GETARG_BYTEA_PP(0)));
}

PG_FUNCTION_INFO_V1(typify_final);
Datum
typify_final(PG_FUNCTION_ARGS)
{
	const state *s = PG_ARGISNULL(0) ? NULL : (const state *) PG_GETARG_POINTER(0);
	ty_result result;
	Datum collection;

	aggregate_context(fcinfo);
	if (s == NULL)
		PG_RETURN_NULL();
	state_typify(s, &result);
	collection = ty_collection_datum(&result, s->srid);
	ty_result_free(&ty_backend_environment, &result);
	PG_RETURN_DATUM(collection);
}

PG_FUNCTION_INFO_V1(typify_placeholders_final);
Datum
typify_placeholders_final(PG_FUNCTION_ARGS)
{
	const state *s = PG_ARGISNULL(0) ? NULL : (const state *) PG_GETARG_POINTER(0);
	ty_result result;
	Datum array;

	aggregate_context(fcinfo);
	if (s == NULL)
		PG_RETURN_NULL();
	check_ids(s);
	state_typify(s, &result);
	array = placeholder_array(fcinfo, s, &result);
	ty_result_free(&ty_backend_environment, &result);
	PG_RETURN_DATUM(array);
}

PG_FUNCTION_INFO_V1(typify_hierarchy_final);
Datum
typify_hierarchy_final(PG_FUNCTION_ARGS)
{
	const state *s = PG_ARGISNULL(0) ? NULL : (const state *) PG_GETARG_POINTER(0);

	aggregate_context(fcinfo);
	if (s == NULL)
		PG_RETURN_NULL();
	check_ids(s);
	PG_RETURN_DATUM(ty_node_array(fcinfo, s->buildings, s->count, &s->parameters));
}
