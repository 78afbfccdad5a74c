/*
 * aggregate.c - the aggregates typify and typify_placeholders.
 *
 * A state is the measures of a group's buildings, in any order. The transition function measures a row and adds it;
 * combine appends; the final functions put the buildings in canonical order and so give the same answer however
 * the rows came together. A group without a usable row has no state.
 */
#include "compat.h"

#include "access/htup_details.h"
#include "catalog/pg_type.h"
#include "funcapi.h"
#include "miscadmin.h"
#include "utils/array.h"
#include "utils/lsyscache.h"
#include "utils/memutils.h"
#include "utils/typcache.h"

#include "backend.h"
#include "call.h"
#include "core/grid.h"
#include "core/group.h"
#include "core/mesh.h"
#include "geometry.h"
#include "options.h"

/* The array's first size in bytes, good for nine buildings: there may be 100 000 groups of about that many. */
#define FIRST_SIZE 512

typedef struct state
{
	MemoryContext context; /* of the state and its array */
	ty_parameters parameters;
	uint64 generation; /* of the call's parameters when they were last found equal to these */
	int32 srid;
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
	ty_parameters parameters;
} state_image;

#define STATE_MAGIC 0x54590001 /* the last byte is the version */

/* --- states --- */

/* Makes an empty state in the context. */
static state *
state_new(MemoryContext context, const ty_parameters *parameters, int32 srid)
{
	state *s = MemoryContextAlloc(context, sizeof(state));

	s->context = context;
	s->parameters = *parameters;
	s->generation = 0;
	s->srid = srid;
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
	s = state_new(CurrentMemoryContext, &image.parameters, image.srid);
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
} row_layout;

static const row_layout geometry_layout = {.parameters = 2};
static const row_layout placeholders_layout = {.id = 2, .parameters = 3, .importance = 6};

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
	ty_call *call = ty_call_of(fcinfo, layout->parameters, 1);
	const ty_parameters *parameters = ty_call_parameters(call, &fcinfo->args[layout->parameters], s == NULL);

	if (s == NULL)
	{
		ty_check_srid(&call->srids, srid);
		s = state_new(context, parameters, srid);
	}
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

/* Typifies the group; the result is of the current context. The state stays as it is. */
static void
state_typify(const state *s, ty_result *result)
{
	ty_check_status(ty_typify(&ty_backend_environment, s->buildings, s->count, &s->parameters, result));
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

/* by_id receives the buildings' indices in ascending order of ids, which must differ. */
static void
sort_by_id(const state *s, uint32 *by_id)
{
	uint64 *keys = ty_allocate_array(&ty_backend_environment, s->count, sizeof(uint64));

	for (size_t i = 0; i < s->count; i++)
	{
		keys[i] = sortable_id(s->buildings[i].id);
		by_id[i] = (uint32) i;
	}
	ty_check_status(ty_sort_keys(&ty_backend_environment, keys, by_id, s->count));
	for (size_t i = 1; i < s->count; i++)
		if (keys[i] == keys[i - 1])
			ereport(ERROR, errcode(ERRCODE_INVALID_PARAMETER_VALUE),
					errmsg("id %lld occurs more than once in a group", (long long) s->buildings[by_id[i]].id),
					errhint("Pass a key of the buildings as id."));
	pfree(keys);
}

/*
 * The ids of all members, placeholder by placeholder as in result->members, ascending in each: the buildings are
 * dealt out in the order of their ids.
 */
static int64 *
member_ids(const state *s, const ty_result *result, const uint32 *by_id)
{
	uint32 *owner = ty_allocate_array(&ty_backend_environment, s->count, sizeof(uint32));
	uint32 *dealt = ty_allocate_array(&ty_backend_environment, result->count, sizeof(uint32));
	int64 *ids = ty_allocate_array(&ty_backend_environment, s->count, sizeof(int64));

	for (size_t k = 0; k < result->count; k++)
	{
		dealt[k] = result->placeholders[k].first;
		for (uint32 i = 0; i < result->placeholders[k].count; i++)
			owner[result->members[result->placeholders[k].first + i]] = (uint32) k;
	}
	for (size_t i = 0; i < s->count; i++)
		ids[dealt[owner[by_id[i]]]++] = s->buildings[by_id[i]].id;
	pfree(owner);
	pfree(dealt);
	return ids;
}

/* The fields of the composite typify_placeholder, in order. */
enum
{
	FIELD_ID = 0,
	FIELD_GEOM,
	FIELD_MEMBER_COUNT,
	FIELD_MEMBERS,
	FIELD_AREA,
	FIELD_WIDTH,
	FIELD_LENGTH,
	FIELD_ORIENTATION,
	FIELDS
};

#define MEMBERS_SIZE(count) (ARR_OVERHEAD_NONULLS(1) + (size_t) (count) * sizeof(int64))
/* header with null bitmap, fixed fields, alignment: what a row takes at most besides geometry and members */
#define ROW_OVERHEAD (MAXALIGN(SizeofHeapTupleHeader + 1) + 6 * sizeof(float8) + 3 * MAXIMUM_ALIGNOF)

/* The array under construction. */
typedef struct row_writer
{
	TupleDesc shape;
	int32 srid;
	ArrayType *array;
	size_t used;
	void *polygon;		/* TY_POLYGON_DATUM_SIZE bytes, used for every row */
	ArrayType *members; /* room for the largest placeholder's */
} row_writer;

static size_t
array_size_bound(const ty_result *result)
{
	size_t size = ARR_OVERHEAD_NONULLS(1);

	for (size_t k = 0; k < result->count; k++)
		size += ROW_OVERHEAD + TY_POLYGON_DATUM_SIZE + MEMBERS_SIZE(result->placeholders[k].count);
	return size;
}

static void
array_header(ArrayType *array, size_t size, Oid element, int count)
{
	SET_VARSIZE(array, size);
	array->ndim = 1;
	array->dataoffset = 0;
	array->elemtype = element;
	ARR_DIMS(array)[0] = count;
	ARR_LBOUND(array)[0] = 1;
}

static void
writer_begin(row_writer *writer, FunctionCallInfo fcinfo, const ty_result *result, int32 srid)
{
	Oid element = get_element_type(get_func_rettype(fcinfo->flinfo->fn_oid));
	size_t size = array_size_bound(result);
	uint32 most = 0;

	if (!AllocSizeIsValid(size))
		ty_refuse_size();
	for (size_t k = 0; k < result->count; k++)
		most = Max(most, result->placeholders[k].count);
	writer->shape = lookup_rowtype_tupdesc(element, -1);
	if (writer->shape->natts != FIELDS)
		elog(ERROR, "typify_placeholder is not declared as this library expects");
	writer->srid = srid;
	writer->array = palloc0(size);
	array_header(writer->array, size, element, (int) result->count);
	writer->used = ARR_OVERHEAD_NONULLS(1);
	writer->polygon = palloc(TY_POLYGON_DATUM_SIZE);
	writer->members = palloc0(MEMBERS_SIZE(most));
}

static void
writer_add(row_writer *writer, const ty_placeholder *placeholder, int64 id, const int64 *members)
{
	Datum values[FIELDS];
	bool nulls[FIELDS] = {false};
	HeapTuple row;

	nulls[FIELD_GEOM] = !(placeholder->area > 0);
	array_header(writer->members, MEMBERS_SIZE(placeholder->count), INT8OID, (int) placeholder->count);
	memcpy(ARR_DATA_PTR(writer->members), members, placeholder->count * sizeof(int64));
	values[FIELD_ID] = Int64GetDatum(id);
	values[FIELD_GEOM] = nulls[FIELD_GEOM] ? (Datum) 0 : ty_write_rectangle(writer->polygon, placeholder, writer->srid);
	values[FIELD_MEMBER_COUNT] = Int32GetDatum((int32) placeholder->count);
	values[FIELD_MEMBERS] = PointerGetDatum(writer->members);
	values[FIELD_AREA] = Float8GetDatum(placeholder->area);
	values[FIELD_WIDTH] = Float8GetDatum(placeholder->width);
	values[FIELD_LENGTH] = Float8GetDatum(placeholder->length);
	values[FIELD_ORIENTATION] = Float8GetDatum(ty_orientation_degrees(placeholder->ux, placeholder->uy));
	row = heap_form_tuple(writer->shape, values, nulls);
	memcpy((char *) writer->array + writer->used, row->t_data, row->t_len);
	writer->used += MAXALIGN(row->t_len);
	heap_freetuple(row);
}

static Datum
writer_end(row_writer *writer)
{
	ReleaseTupleDesc(writer->shape);
	pfree(writer->polygon);
	pfree(writer->members);
	SET_VARSIZE(writer->array, writer->used);
	return PointerGetDatum(writer->array);
}

static Datum
placeholder_array(FunctionCallInfo fcinfo, const state *s, const ty_result *result, const int64 *ids)
{
	row_writer writer;

	writer_begin(&writer, fcinfo, result, s->srid);
	for (size_t k = 0; k < result->count; k++)
	{
		const ty_placeholder *placeholder = &result->placeholders[k];

		CHECK_FOR_INTERRUPTS();
		writer_add(&writer, placeholder, s->buildings[placeholder->representative].id, ids + placeholder->first);
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
		a = state_new(context, &b->parameters, b->srid);
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
	uint32 *by_id;
	int64 *ids;
	Datum array;

	aggregate_context(fcinfo);
	if (s == NULL)
		PG_RETURN_NULL();
	by_id = ty_allocate_array(&ty_backend_environment, s->count, sizeof(uint32));
	sort_by_id(s, by_id);
	state_typify(s, &result);
	ids = member_ids(s, &result, by_id);
	pfree(by_id);
	array = placeholder_array(fcinfo, s, &result, ids);
	pfree(ids);
	ty_result_free(&ty_backend_environment, &result);
	PG_RETURN_DATUM(array);
}
