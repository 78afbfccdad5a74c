/*
 * aggregate.c - the aggregates typify, typify_placeholders and typify_hierarchy.
 *
 * The transition function measures a row and adds it to the group's state; combine appends; the final functions put
 * the buildings in canonical order and so give the same answer however the rows came together. A group without a
 * usable row has no state.
 */
#include "compat.h"

#include "catalog/pg_type.h"
#include "miscadmin.h"
#include "utils/lsyscache.h"

#include "backend.h"
#include "call.h"
#include "core/grid.h"
#include "core/group.h"
#include "geometry.h"
#include "hierarchy.h"
#include "layer.h"
#include "node_table.h"
#include "options.h"
#include "partial.h"
#include "progress.h"
#include "row_array.h"
#include "state.h"

/* --- rows --- */

/* Where a transition function finds what; 0: it takes none. The state is argument 0, the geometry 1. */
typedef struct row_layout
{
	int id;
	int parameters, parameter_count;
	int importance;
	bool without_scale; /* parameters: where the scale would be */
} row_layout;

static const row_layout geometry_layout = {.parameters = 2, .parameter_count = 3};
static const row_layout placeholders_layout = {.id = 2, .parameters = 3, .parameter_count = 3, .importance = 6};
static const row_layout barred_layout = {.id = 2, .parameters = 3, .parameter_count = 4, .importance = 7};
static const row_layout hierarchy_layout = {
	.id = 2, .parameters = 2, .parameter_count = 3, .importance = 5, .without_scale = true};
static const row_layout write_layout = {
	.id = 2, .parameters = 2, .parameter_count = 4, .importance = 6, .without_scale = true};

/* arguments of typify_write_hierarchy's transition function that say where its nodes go */
enum
{
	WRITE_HIERARCHY = 7,
	WRITE_GROUP_ID
};

/* The context of states; the one preamble of all five functions. */
static MemoryContext
aggregate_context(FunctionCallInfo fcinfo)
{
	MemoryContext context;

	if (AggCheckCallContext(fcinfo, &context) == 0)
		elog(ERROR, "typify: a support function was called outside of an aggregate");
	return context;
}

/* NULL of SQL for none. */
static Datum
state_datum(FunctionCallInfo fcinfo, ty_state *s)
{
	fcinfo->isnull = s == NULL;
	return PointerGetDatum(s);
}

/* The state that a support function's argument is, or NULL. */
static ty_state *
state_argument(FunctionCallInfo fcinfo, int argument)
{
	return PG_ARGISNULL(argument) ? NULL : (ty_state *) PG_GETARG_POINTER(argument);
}

/* of the row; 1 where it is NULL or the aggregate takes none */
static double
row_importance(FunctionCallInfo fcinfo, int argument)
{
	double importance;

	if (argument == 0 || argument >= PG_NARGS() || PG_ARGISNULL(argument))
		return 1;
	importance = PG_GETARG_FLOAT8(argument);
	if (!(importance >= 1))
		ty_refuse_value("importance", importance, "at least 1");
	return importance;
}

/* The pool of the row, which mostly is the one of the row before. */
static ty_pool *
pool_for_row(ty_call *call, MemoryContext context, const ty_state *s)
{
	if (unlikely(call->pools.current == NULL || call->pools.current->context != context))
	{
		if (s == NULL)
			return ty_pool_of(&call->pools, context);
		call->pools.current = s->pool;
	}
	return call->pools.current;
}

/* What the group of a row is typified with that is its first. */
static ty_variant *
variant_for_row(ty_call *call, ty_pool *pool, const ty_parameters *parameters, int32 srid)
{
	ty_variant *last = pool->variants;
	ty_variant variant;

	if (last != NULL && last->generation == call->generation && last->srid == srid &&
		last->barriers == call->barriers.current)
		return last;
	variant = (ty_variant){.generation = call->generation,
						   .srid = srid,
						   .geometry_type = call->srids.geometry_type,
						   .barriers = call->barriers.current,
						   .metres_per_unit = ty_check_srid(&call->srids, srid),
						   .parameters = *parameters};
	ty_check_barrier_srid(variant.barriers, srid);
	return ty_variant_like(pool, &variant);
}

/* The state of the row's group, with the row's parameters and SRID checked against it. */
static ty_state *
state_for_row(ty_call *call, ty_pool *pool, ty_state *s, const NullableDatum *arguments, int32 srid)
{
	const ty_parameters *parameters;

	call->group_context = pool->context;
	parameters = ty_call_parameters(call, arguments, s == NULL);
	if (s == NULL)
		return ty_state_new(pool, variant_for_row(call, pool, parameters, srid));
	if (unlikely(s->variant->generation != call->generation) &&
		!ty_same_parameters(&s->variant->parameters, parameters))
		ty_refuse_varying_parameters();
	s->variant->generation = call->generation;
	ty_state_check_srid(s, srid);
	return s;
}

/* The outline of the building added last, with which its placeholder may be drawn. */
static void
add_outline(ty_pool *pool, const ty_variant *v, Datum geometry, double importance)
{
	size_t last = pool->count - 1;
	ty_outline *outline = ty_outline_to_draw(geometry, &pool->buildings[last], importance, &v->parameters,
											 v->metres_per_unit, v->geometry_type);

	if (outline != NULL)
		ty_pool_set_outline(pool, last, ty_copy_outline(outline, pool->context));
}

/* Adds the row's building; a row without geometry is passed over, and nothing else of it looked at. */
static Datum
add_row(FunctionCallInfo fcinfo, const row_layout *layout)
{
	MemoryContext context = aggregate_context(fcinfo);
	ty_call *call = ty_call_of(fcinfo, layout->parameters, layout->parameter_count, 1, !layout->without_scale);
	ty_state *s = state_argument(fcinfo, 0);
	ty_pool *pool;
	ty_building *building;
	double importance;
	int32 srid;

	/* one of many states is far away in memory: it comes while the building is measured */
	__builtin_prefetch(s, 1);
	if (PG_ARGISNULL(1))
		return state_datum(fcinfo, s);
	pool = pool_for_row(call, context, s);
	building = ty_pool_next(pool);
	if (!ty_measure_datum(PG_GETARG_DATUM(1), building, &srid, NULL))
		return state_datum(fcinfo, s);
	s = state_for_row(call, pool, s, &fcinfo->args[layout->parameters], srid);
	if (layout->id != 0 && PG_ARGISNULL(layout->id))
		ty_refuse_null("id");
	building->id = layout->id != 0 ? PG_GETARG_INT64(layout->id) : 0;
	importance = row_importance(fcinfo, layout->importance);
	ty_state_add(s);
	if (unlikely(importance != 1))
		ty_pool_set_importance(pool, pool->count - 1, importance);
	if (unlikely(ty_wants_outline(&s->variant->parameters)))
		add_outline(pool, s->variant, PG_GETARG_DATUM(1), importance);
	PG_RETURN_POINTER(s);
}

/* --- results --- */

/* From this many buildings on, what their mesh took is given back before the result's value is made. */
#define LARGE_GROUP 100000

/* What is not as asked for. */
static void
warn_of_result(const ty_result *result)
{
	size_t undrawn = result->undrawn - result->hidden;

	if (undrawn > 0)
		ereport(
			WARNING,
			errmsg_plural("%zu placeholder has no size and is not drawn",
						  "%zu placeholders have no size and are not drawn", undrawn, undrawn),
			errhint(
				"Points, lines and polygons without area have none; with psi => 1 nothing has from lod200_scale on."));
	if (result->hidden > 0)
		ereport(WARNING,
				errmsg_plural("there is no room for %zu placeholder, which is not drawn",
							  "there is no room for %zu placeholders, which are not drawn", result->hidden,
							  result->hidden),
				errhint("Use a smaller min_side, min_gap or barrier_width, or fewer barriers."));
}

static ty_input
input_of(const ty_gathered *g)
{
	return (ty_input){.buildings = g->buildings,
					  .n = g->count,
					  .importance = g->importance,
					  .outlines = g->outlines,
					  .barriers = ty_lines_of_barriers(g->variant->barriers)};
}

/* Typifies the group; the result is of the current context. The state stays as it is. */
static void
typify_quietly(const ty_gathered *g, ty_result *result)
{
	ty_input input = input_of(g);
	ty_parameters parameters = g->variant->parameters;

	ty_bring_to_ground(&parameters, g->variant->metres_per_unit);
	ty_typify_group(&input, &parameters, result);
	if (g->outlines != NULL)
		ty_check_outlines(result, g->outlines, g->variant->geometry_type);
	if (g->count >= LARGE_GROUP)
		ty_trim_memory();
	warn_of_result(result);
}

/* The same, with the warning of kept buildings in each other's way. */
static void
typify_gathered(const ty_gathered *g, ty_result *result)
{
	const ty_collisions *c = &result->collisions;

	typify_quietly(g, result);
	ty_warn_of_collisions(c, g->buildings[c->first_pair[0]].id, g->buildings[c->first_pair[1]].id,
						  g->buildings[c->first_beside].id);
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
check_ids(const ty_gathered *g)
{
	uint64 *ids = ty_allocate_array(&ty_backend_environment, g->count, sizeof(uint64));
	uint32 *unused = ty_allocate_array(&ty_backend_environment, g->count, sizeof(uint32));

	for (size_t i = 0; i < g->count; i++)
	{
		ids[i] = sortable_id(g->buildings[i].id);
		unused[i] = 0;
	}
	ty_check_status(ty_sort_keys(&ty_backend_environment, ids, unused, g->count));
	for (size_t i = 1; i < g->count; i++)
		if (ids[i] == ids[i - 1])
			ereport(ERROR, errcode(ERRCODE_INVALID_PARAMETER_VALUE),
					errmsg("id %lld occurs more than once in a group", (long long) id_of_sortable(ids[i])),
					errhint("Pass a key of the buildings as id."));
	pfree(ids);
	pfree(unused);
}

#define SITE_ARRAY_SIZE (ARR_OVERHEAD_NONULLS(1) + SITE_NUMBERS * sizeof(float8))
#define SITE_SIZE_BOUND (SITE_ARRAY_SIZE + MAXIMUM_ALIGNOF)
/* the field of the composite typify_site that comes after those of typify_placeholder */
#define FIELD_SITE TY_PLACEHOLDER_FIELDS
#define MEMBERS_SIZE(count) (ARR_OVERHEAD_NONULLS(1) + (size_t) (count) * sizeof(int64))
/* what a row takes at most besides geometry and members */
#define ROW_SIZE (TY_ROW_OVERHEAD + 6 * sizeof(float8))

/* The array under construction. */
typedef struct row_writer
{
	ty_row_array rows;
	const ty_gathered *group;
	const ty_result *result;
	void *polygon;					 /* TY_POLYGON_DATUM_SIZE bytes, used for every row */
	ArrayType *members;				 /* room for the largest placeholder's */
	uint32 *unused;					 /* as long, zero: what their sort moves along */
	const ty_parameters *parameters; /* in ground units, where rows have a site; else NULL */
	ArrayType *site;				 /* its numbers */
} row_writer;

/* of the polygon's value */
static size_t
polygon_size(const ty_gathered *g, const ty_placeholder *placeholder)
{
	return placeholder->outlined ? ty_outline_polygon_size(g->outlines[placeholder->representative])
								 : TY_POLYGON_DATUM_SIZE;
}

static size_t
rows_size(const ty_gathered *g, const ty_result *result)
{
	size_t size = 0;

	for (size_t k = 0; k < result->count; k++)
		size += ROW_SIZE + polygon_size(g, &result->placeholders[k]) + MEMBERS_SIZE(result->placeholders[k].count);
	return size;
}

static void
writer_begin(row_writer *writer, FunctionCallInfo fcinfo, const ty_gathered *g, const ty_result *result,
			 const ty_parameters *site_parameters)
{
	bool sited = site_parameters != NULL;
	uint32 most = 0;

	ty_row_array_begin(&writer->rows, fcinfo, TY_PLACEHOLDER_FIELDS + sited,
					   sited ? "typify_site" : "typify_placeholder",
					   rows_size(g, result) + (sited ? result->count * SITE_SIZE_BOUND : 0), result->count);
	for (size_t k = 0; k < result->count; k++)
		most = Max(most, result->placeholders[k].count);
	writer->group = g;
	writer->result = result;
	writer->polygon = palloc(TY_POLYGON_DATUM_SIZE);
	writer->members = palloc(MEMBERS_SIZE(most));
	writer->unused = palloc0(most * sizeof(uint32));
	writer->parameters = site_parameters;
	writer->site = palloc0(SITE_ARRAY_SIZE);
	ty_array_header(writer->site, SITE_ARRAY_SIZE, FLOAT8OID, SITE_NUMBERS);
}

/* The placeholder's numbers, as an array that the next call overwrites. */
static Datum
writer_site(row_writer *writer, const ty_placeholder *placeholder)
{
	const ty_gathered *g = writer->group;
	ty_input input = input_of(g);
	ty_site site;

	if (writer->result->sites != NULL)
		site = writer->result->sites[placeholder - writer->result->placeholders];
	else
		ty_placeholder_site(writer->parameters, &input, placeholder, &site);
	ty_site_to_numbers(&site, placeholder->outlined, writer->parameters, (double *) ARR_DATA_PTR(writer->site));
	return PointerGetDatum(writer->site);
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

/* An outline is new, a rectangle is overwritten by the next one. */
static Datum
writer_polygon(row_writer *writer, const ty_placeholder *placeholder)
{
	const ty_gathered *g = writer->group;

	if (placeholder->outlined)
		return PointerGetDatum(
			ty_outline_polygon(placeholder, g->outlines[placeholder->representative], g->variant->srid));
	return ty_write_rectangle(writer->polygon, placeholder, g->variant->srid);
}

static void
writer_add(row_writer *writer, const ty_placeholder *placeholder)
{
	const ty_gathered *g = writer->group;
	Datum *values = writer->rows.values;
	Datum polygon = placeholder->area > 0 ? writer_polygon(writer, placeholder) : (Datum) 0;

	ty_placeholder_values(placeholder, g->buildings[placeholder->representative].id, polygon, values,
						  writer->rows.nulls);
	values[TY_PLACEHOLDER_MEMBERS] = writer_members(writer, placeholder);
	writer->rows.nulls[TY_PLACEHOLDER_MEMBERS] = false;
	if (writer->parameters != NULL)
	{
		values[FIELD_SITE] = writer_site(writer, placeholder);
		writer->rows.nulls[FIELD_SITE] = false;
	}
	ty_row_array_add(&writer->rows);
	if (polygon != (Datum) 0 && placeholder->outlined)
		pfree(DatumGetPointer(polygon));
}

static Datum
writer_end(row_writer *writer)
{
	pfree(writer->polygon);
	pfree(writer->members);
	pfree(writer->site);
	pfree(writer->unused);
	return ty_row_array_end(&writer->rows);
}

static Datum
placeholder_array(FunctionCallInfo fcinfo, const ty_gathered *g, const ty_result *result,
				  const ty_parameters *site_parameters)
{
	row_writer writer;

	writer_begin(&writer, fcinfo, g, result, site_parameters);
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

PG_FUNCTION_INFO_V1(typify_barred_transition);
Datum
typify_barred_transition(PG_FUNCTION_ARGS)
{
	return add_row(fcinfo, &barred_layout);
}

PG_FUNCTION_INFO_V1(typify_hierarchy_transition);
Datum
typify_hierarchy_transition(PG_FUNCTION_ARGS)
{
	return add_row(fcinfo, &hierarchy_layout);
}

PG_FUNCTION_INFO_V1(typify_write_hierarchy_transition);
Datum
typify_write_hierarchy_transition(PG_FUNCTION_ARGS)
{
	ty_state *s;

	if (PG_ARGISNULL(WRITE_HIERARCHY))
		ty_refuse_null("hierarchy");
	if (PG_ARGISNULL(WRITE_GROUP_ID))
		ty_refuse_null("group_id");
	s = (ty_state *) DatumGetPointer(add_row(fcinfo, &write_layout));
	if (s == NULL)
		PG_RETURN_NULL();
	s->hierarchy = PG_GETARG_OID(WRITE_HIERARCHY);
	s->group_id = PG_GETARG_INT32(WRITE_GROUP_ID);
	PG_RETURN_POINTER(s);
}

/* what is looked for among the arguments of the workers' aggregate */
typedef struct barrier_search
{
	ty_barrier_cache *cache;
	MemoryContext context, long_context; /* of the group and of the query */
	ty_barrier_hash hash;
	ty_barrier_set *found;
} barrier_search;

/* Barriers come in the options, or as a geometry that is not the first argument. */
static bool
look_for_barriers(void *context, int argument, Datum value, Oid type, bool per_query)
{
	barrier_search *search = context;
	bool options = type_is_rowtype(type);
	Datum lasting = per_query ? value : (Datum) 0;

	if (argument == 0 || (!options && get_typlen(type) != -1))
		return false;
	if (options)
		value = ty_barriers_of_options(value);
	if (value == (Datum) 0 || !ty_same_barriers(ty_check_barriers(value), search->hash))
		return false;
	search->found = ty_keep_barriers_datum(search->cache, per_query ? search->long_context : search->context,
										   search->hash, value, per_query, lasting);
	return true;
}

/* What a combine function remembers between groups. */
typedef struct combine_call
{
	ty_barrier_cache barriers;
	ty_pools pools;
} combine_call;

static combine_call *
combine_call_of(FunctionCallInfo fcinfo)
{
	FmgrInfo *function = fcinfo->flinfo;
	combine_call *call = function->fn_extra;

	if (likely(call != NULL))
		return call;
	call = MemoryContextAllocZero(function->fn_mcxt, sizeof(combine_call));
	ty_pools_begin(&call->pools, function->fn_mcxt);
	function->fn_extra = call;
	return call;
}

/* The barriers that b has or, where a worker sent their hash alone, that the plan has; NULL for none. */
static ty_barrier_set *
find_barriers(FunctionCallInfo fcinfo, MemoryContext context, const ty_variant *b)
{
	ty_barrier_cache *cache = &combine_call_of(fcinfo)->barriers;
	ty_barrier_hash hash = b->parameters.barriers;
	barrier_search search = {.cache = cache, .context = context, .long_context = fcinfo->flinfo->fn_mcxt, .hash = hash};
	ty_barrier_set *set;

	if (ty_no_barriers(hash))
		return NULL;
	set = ty_find_barriers(cache, context, hash);
	if (set == NULL && b->barriers != NULL)
		set = ty_keep_barriers(cache, context, hash, b->barriers->payload, b->barriers->size);
	if (set == NULL && ty_visit_partial_arguments(fcinfo, look_for_barriers, &search))
		set = search.found;
	if (set == NULL)
		ereport(ERROR, errcode(ERRCODE_FEATURE_NOT_SUPPORTED),
				errmsg("the barriers of a parallel query are not in its plan"),
				errhint("SET max_parallel_workers_per_gather = 0"));
	return set;
}

/* An empty state of what b is typified with. */
static ty_state *
state_like(FunctionCallInfo fcinfo, MemoryContext context, const ty_state *b)
{
	ty_pool *pool = ty_pool_of(&combine_call_of(fcinfo)->pools, context);
	ty_variant variant = *b->variant;

	variant.barriers = find_barriers(fcinfo, context, b->variant);
	return ty_state_new(pool, ty_variant_like(pool, &variant));
}

PG_FUNCTION_INFO_V1(typify_combine);
Datum
typify_combine(PG_FUNCTION_ARGS)
{
	MemoryContext context = aggregate_context(fcinfo);
	ty_state *a = state_argument(fcinfo, 0);
	const ty_state *b = state_argument(fcinfo, 1);

	if (b != NULL)
	{
		if (a == NULL)
			a = state_like(fcinfo, context, b);
		ty_state_merge(a, b);
	}
	return state_datum(fcinfo, a);
}

PG_FUNCTION_INFO_V1(typify_serialize);
Datum
typify_serialize(PG_FUNCTION_ARGS)
{
	aggregate_context(fcinfo);
	PG_RETURN_BYTEA_P(ty_state_serialize((const ty_state *) PG_GETARG_POINTER(0)));
}

PG_FUNCTION_INFO_V1(typify_deserialize);
Datum
typify_deserialize(PG_FUNCTION_ARGS)
{
	aggregate_context(fcinfo);
	PG_RETURN_POINTER(ty_state_deserialize(PG_GETARG_BYTEA_PP(0)));
}

/* The group of a final function, to be read; false: it has no rows. */
static bool
final_group(FunctionCallInfo fcinfo, ty_gathered *g)
{
	const ty_state *s = state_argument(fcinfo, 0);

	aggregate_context(fcinfo);
	if (s != NULL)
		*g = ty_gather(s);
	return s != NULL;
}

/* The same, with ids, which must differ. */
static bool
final_group_with_ids(FunctionCallInfo fcinfo, ty_gathered *g)
{
	if (!final_group(fcinfo, g))
		return false;
	check_ids(g);
	return true;
}

PG_FUNCTION_INFO_V1(typify_final);
Datum
typify_final(PG_FUNCTION_ARGS)
{
	ty_gathered g;
	ty_result result;
	Datum collection;

	if (!final_group(fcinfo, &g))
		PG_RETURN_NULL();
	typify_gathered(&g, &result);
	collection = ty_collection_datum(&result, g.outlines, g.variant->srid);
	ty_result_free(&ty_backend_environment, &result);
	PG_RETURN_DATUM(collection);
}

PG_FUNCTION_INFO_V1(typify_placeholders_final);
Datum
typify_placeholders_final(PG_FUNCTION_ARGS)
{
	ty_gathered g;
	ty_result result;
	Datum array;

	if (!final_group_with_ids(fcinfo, &g))
		PG_RETURN_NULL();
	typify_gathered(&g, &result);
	array = placeholder_array(fcinfo, &g, &result, NULL);
	ty_result_free(&ty_backend_environment, &result);
	PG_RETURN_DATUM(array);
}

PG_FUNCTION_INFO_V1(typify_sites_final);
Datum
typify_sites_final(PG_FUNCTION_ARGS)
{
	ty_gathered g;
	ty_parameters parameters;
	ty_result result;
	Datum array;

	if (!final_group_with_ids(fcinfo, &g))
		PG_RETURN_NULL();
	/* of these typify_settle tells, once for all groups */
	typify_quietly(&g, &result);
	parameters = g.variant->parameters;
	ty_bring_to_ground(&parameters, g.variant->metres_per_unit);
	array = placeholder_array(fcinfo, &g, &result, &parameters);
	ty_result_free(&ty_backend_environment, &result);
	PG_RETURN_DATUM(array);
}

PG_FUNCTION_INFO_V1(typify_hierarchy_final);
Datum
typify_hierarchy_final(PG_FUNCTION_ARGS)
{
	ty_gathered g;
	ty_input input;

	if (!final_group_with_ids(fcinfo, &g))
		PG_RETURN_NULL();
	input = input_of(&g);
	PG_RETURN_DATUM(ty_node_array(fcinfo, &input, &g.variant->parameters));
}

PG_FUNCTION_INFO_V1(typify_write_hierarchy_final);
Datum
typify_write_hierarchy_final(PG_FUNCTION_ARGS)
{
	ty_gathered g;
	ty_input input;

	if (!final_group_with_ids(fcinfo, &g))
		PG_RETURN_NULL();
	input = input_of(&g);
	PG_RETURN_DATUM(ty_write_nodes(fcinfo, &g, &input));
}
