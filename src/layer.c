/*
 * layer.c - the aggregate typify_settle: the placeholders of all groups of a layer, each group legible by itself, are
 * made legible together.
 *
 * Sites of different groups are not joined. Of one that does not fit the members go to the nearest of its group that is
 * drawn, which stays where it is. The answer lists the placeholders that something was done to; the others stay as they
 * are.
 */
#include "layer.h"

#include "access/htup_details.h"
#include "catalog/pg_type.h"
#include "funcapi.h"
#include "miscadmin.h"
#include "utils/array.h"
#include "utils/lsyscache.h"
#include "utils/typcache.h"

#include "backend.h"
#include "barriers.h"
#include "core/grid.h"
#include "core/nearest.h"
#include "geometry.h"
#include "options.h"

typedef struct layer_row
{
	ty_site site;
	int64 id;
	bool outlined;
} layer_row;

typedef struct layer
{
	MemoryContext context;
	int32 srid;
	double gap, line_gap;
	ty_barrier_cache barriers;
	ty_barrier_set *set; /* NULL: no barriers */
	size_t count, capacity;
	layer_row *rows;
} layer;

/* The fields of the composite typify_settled, in order. */
enum
{
	SETTLED_ID = 0,
	SETTLED_DRAWN,
	SETTLED_GEOM,
	SETTLED_WIDTH,
	SETTLED_LENGTH,
	SETTLED_FACTOR,
	SETTLED_X,
	SETTLED_Y,
	SETTLED_HEIR,
	SETTLED_FIELDS
};

void
ty_site_to_numbers(const ty_site *s, bool outlined, const ty_parameters *p, double n[SITE_NUMBERS])
{
	n[SITE_HOME_X] = s->home.x;
	n[SITE_HOME_Y] = s->home.y;
	n[SITE_UX] = s->ux;
	n[SITE_UY] = s->uy;
	n[SITE_FULL_WIDTH] = s->full.width;
	n[SITE_FULL_LENGTH] = s->full.length;
	n[SITE_OWN_WIDTH] = s->own.width;
	n[SITE_OWN_LENGTH] = s->own.length;
	n[SITE_LEAST_WIDTH] = s->least.width;
	n[SITE_LEAST_LENGTH] = s->least.length;
	n[SITE_SHIFT_X] = s->shift.x;
	n[SITE_SHIFT_Y] = s->shift.y;
	n[SITE_MOVED_X] = s->moved.x;
	n[SITE_MOVED_Y] = s->moved.y;
	n[SITE_SIZE] = s->size;
	n[SITE_AXIS_X] = s->axis.x;
	n[SITE_AXIS_Y] = s->axis.y;
	n[SITE_RAIL] = s->rail;
	n[SITE_BEND] = s->bend;
	n[SITE_FIXED] = s->fixed;
	n[SITE_OUTLINED] = outlined;
	n[SITE_GAP] = p->min_gap;
	n[SITE_LINE_GAP] = p->min_gap + 0.5 * p->barrier_width;
}

static ty_site
site_of_numbers(const double *n)
{
	return (ty_site){.home = {n[SITE_HOME_X], n[SITE_HOME_Y]},
					 .ux = n[SITE_UX],
					 .uy = n[SITE_UY],
					 .full = {n[SITE_FULL_WIDTH], n[SITE_FULL_LENGTH]},
					 .own = {n[SITE_OWN_WIDTH], n[SITE_OWN_LENGTH]},
					 .least = {n[SITE_LEAST_WIDTH], n[SITE_LEAST_LENGTH]},
					 .shift = {n[SITE_SHIFT_X], n[SITE_SHIFT_Y]},
					 .moved = {n[SITE_MOVED_X], n[SITE_MOVED_Y]},
					 .size = n[SITE_SIZE],
					 .axis = {n[SITE_AXIS_X], n[SITE_AXIS_Y]},
					 .rail = n[SITE_RAIL],
					 .bend = n[SITE_BEND],
					 .row = TY_NO_ROW,
					 .fixed = n[SITE_FIXED] != 0};
}

/* --- rows --- */

static MemoryContext
layer_context(FunctionCallInfo fcinfo)
{
	MemoryContext context;

	if (AggCheckCallContext(fcinfo, &context) == 0)
		elog(ERROR, "typify: a support function was called outside of an aggregate");
	return context;
}

static layer *
layer_new(MemoryContext context)
{
	layer *l = MemoryContextAllocZero(context, sizeof(layer));

	l->context = context;
	l->capacity = 64;
	l->rows = MemoryContextAllocHuge(context, l->capacity * sizeof(layer_row));
	return l;
}

static const double *
numbers_of(Datum value)
{
	ArrayType *array = DatumGetArrayTypeP(value);

	if (ARR_NDIM(array) != 1 || ARR_DIMS(array)[0] != SITE_NUMBERS || ARR_HASNULL(array) ||
		ARR_ELEMTYPE(array) != FLOAT8OID)
		ereport(ERROR, errcode(ERRCODE_INVALID_PARAMETER_VALUE),
				errmsg("a site must be an array of %d numbers", SITE_NUMBERS),
				errhint("Pass the field site of what typify_sites returns."));
	return (const double *) ARR_DATA_PTR(array);
}

/* The barriers are those of the first row: they are the same for all. */
static void
take_barriers(layer *l, Datum geometry, int32 srid)
{
	ty_barrier_hash hash = ty_check_barriers(geometry);

	if (ty_no_barriers(hash) || l->set != NULL)
		return;
	l->set = ty_keep_barriers_datum(&l->barriers, l->context, hash, geometry, false, (Datum) 0);
	ty_check_barrier_srid(l->set, srid);
}

PG_FUNCTION_INFO_V1(typify_settle_transition);
Datum
typify_settle_transition(PG_FUNCTION_ARGS)
{
	layer *l = PG_ARGISNULL(0) ? layer_new(layer_context(fcinfo)) : (layer *) PG_GETARG_POINTER(0);
	const double *numbers;
	layer_row *row;

	if (l->count == 0 && !PG_ARGISNULL(6))
		take_barriers(l, PG_GETARG_DATUM(6), PG_ARGISNULL(4) ? 0 : PG_GETARG_INT32(4));
	if (PG_ARGISNULL(1) || PG_ARGISNULL(2) || PG_ARGISNULL(3) || PG_ARGISNULL(4) || PG_ARGISNULL(5))
		PG_RETURN_POINTER(l);
	if (l->count == l->capacity)
	{
		l->capacity *= 2;
		l->rows = repalloc_huge(l->rows, l->capacity * sizeof(layer_row));
	}
	numbers = numbers_of(PG_GETARG_DATUM(5));
	row = &l->rows[l->count++];
	row->site = site_of_numbers(numbers);
	row->id = PG_GETARG_INT64(1);
	row->site.group = (uint32_t) PG_GETARG_INT32(2);
	row->site.weight = (uint32_t) PG_GETARG_INT32(3);
	row->outlined = numbers[SITE_OUTLINED] != 0;
	l->gap = Max(l->gap, numbers[SITE_GAP]);
	l->line_gap = Max(l->line_gap, numbers[SITE_LINE_GAP]);
	l->srid = PG_GETARG_INT32(4);
	PG_RETURN_POINTER(l);
}

/* --- results --- */

void
ty_warn_of_collisions(const ty_collisions *collisions, int64 a, int64 b, int64 beside)
{
	if (collisions->pairs > 0)
		ereport(WARNING,
				errmsg_plural("%zu pair of kept buildings is nearer to each other than min_gap",
							  "%zu pairs of kept buildings are nearer to each other than min_gap", collisions->pairs,
							  collisions->pairs),
				errdetail("The first are %lld and %lld.", (long long) a, (long long) b));
	if (collisions->beside_lines > 0)
		ereport(WARNING,
				errmsg_plural("%zu kept building is nearer to a barrier than its symbol and min_gap allow",
							  "%zu kept buildings are nearer to a barrier than its symbol and min_gap allow",
							  collisions->beside_lines, collisions->beside_lines),
				errdetail("The first is %lld.", (long long) beside));
}

/* The order in which sites are settled: that of buildings at their homes, with their ids. */
static uint32_t *
settling_order(const layer *l)
{
	const ty_environment *env = &ty_backend_environment;
	ty_building *buildings = ty_allocate_array(env, l->count, sizeof *buildings);
	uint32_t *order = ty_allocate_array(env, l->count, sizeof *order);
	ty_position *position = ty_allocate_array(env, l->count, sizeof *position);
	uint64_t *keys = ty_allocate_array(env, l->count, sizeof *keys);
	ty_grid grid;

	for (size_t i = 0; i < l->count; i++)
		buildings[i] = (ty_building){
			.x = l->rows[i].site.home.x, .y = l->rows[i].site.home.y, .ratio = 1, .ux = 1, .id = l->rows[i].id};
	ty_check_status(ty_grid_fit(buildings, l->count, &grid));
	ty_check_status(ty_canonical_order(env, buildings, l->count, &grid, order, position, keys));
	pfree(buildings);
	pfree(position);
	pfree(keys);
	return order;
}

static void
collide(void *context, uint32_t a, uint32_t b)
{
	ty_note_collision(context, a, b);
}

static ty_site *
settled_sites(const layer *l, const uint32_t *order, ty_collisions *collisions)
{
	ty_legibility rules = {.gap = l->gap,
						   .lines = ty_lines_of_barriers(l->set),
						   .line_gap = l->line_gap,
						   .collide = collide,
						   .context = collisions};
	ty_site *sites = ty_allocate_array(&ty_backend_environment, l->count, sizeof *sites);

	for (size_t i = 0; i < l->count; i++)
		sites[i] = l->rows[order[i]].site;
	ty_check_status(ty_make_legible(&ty_backend_environment, &rules, sites, l->count));
	return sites;
}

static bool
is_changed(const ty_site *before, const ty_site *after)
{
	return after->state != TY_DRAWN || after->size != before->size || after->moved.x != before->moved.x ||
		   after->moved.y != before->moved.y;
}

/* --- who is not drawn --- */

/* The drawn sites of a group, which may take over the members of its hidden ones. */
typedef struct heirs
{
	const ty_site *sites;
	const ty_barrier_lines *lines;
	uint32_t *site; /* [count] */
	ty_point *centre;
	size_t count;
	ty_point hidden;
} heirs;

/* whether no barrier lies between the hidden site and another */
static bool
on_its_side(const void *context, uint32_t number)
{
	const heirs *h = context;

	return h->lines == NULL || !ty_barrier_lines_cross(h->lines, h->hidden, h->sites[h->site[number]].home);
}

/* The heirs of the hidden sites among those of one group. */
static void
find_heirs_in_group(heirs *h, const uint32_t *group, size_t count, uint32_t *heir)
{
	const ty_environment *env = &ty_backend_environment;
	ty_nearest tree;

	h->count = 0;
	for (size_t i = 0; i < count; i++)
		if (h->sites[group[i]].state == TY_DRAWN)
		{
			h->centre[h->count] = ty_site_centre(&h->sites[group[i]]);
			h->site[h->count++] = group[i];
		}
	if (h->count == 0 || h->count == count)
		return;
	ty_check_status(ty_nearest_build(env, h->centre, h->count, &tree));
	for (size_t i = 0; i < count; i++)
	{
		if (h->sites[group[i]].state == TY_DRAWN)
			continue;
		CHECK_FOR_INTERRUPTS();
		h->hidden = h->sites[group[i]].home;
		heir[group[i]] = h->site[ty_nearest_allowed(&tree, h->hidden, on_its_side, h)];
	}
	ty_nearest_free(env, &tree);
}

/* For every hidden site the nearest of its group that is drawn, on its side of the barriers if there is one near. */
static uint32_t *
find_heirs(const layer *l, const ty_site *sites)
{
	const ty_environment *env = &ty_backend_environment;
	uint32_t *heir = ty_allocate_array(env, l->count, sizeof *heir);
	uint32_t *order = ty_allocate_array(env, l->count, sizeof *order);
	uint64_t *keys = ty_allocate_array(env, l->count, sizeof *keys);
	heirs h = {.sites = sites,
			   .lines = ty_lines_of_barriers(l->set),
			   .site = ty_allocate_array(env, l->count, sizeof(uint32_t)),
			   .centre = ty_allocate_array(env, l->count, sizeof(ty_point))};
	size_t run;

	for (size_t i = 0; i < l->count; i++)
	{
		heir[i] = TY_NO_SITE;
		order[i] = (uint32_t) i;
		keys[i] = sites[i].group;
	}
	ty_check_status(ty_sort_keys(env, keys, order, l->count));
	for (size_t first = 0; first < l->count; first += run)
	{
		run = 1;
		while (first + run < l->count && keys[first + run] == keys[first])
			run++;
		find_heirs_in_group(&h, order + first, run, heir);
	}
	pfree(order);
	pfree(keys);
	pfree(h.site);
	pfree(h.centre);
	return heir;
}

/* A rectangle is drawn anew; an outline by the scale and the shift that take the old place to the new one. */
static HeapTuple
settled_row(TupleDesc shape, const layer *l, const layer_row *before, const ty_site *after, const layer_row *heir,
			void *polygon)
{
	ty_sides sides = ty_site_sides(after), old = ty_site_sides(&before->site);
	ty_point centre = ty_site_centre(after), from = ty_site_centre(&before->site);
	double factor = old.length > 0 ? sides.length / old.length : 1;
	ty_placeholder p = {
		.x = centre.x, .y = centre.y, .area = sides.width * sides.length, .ux = after->ux, .uy = after->uy};
	bool drawn = after->state == TY_DRAWN;
	Datum values[SETTLED_FIELDS];
	bool nulls[SETTLED_FIELDS] = {false};

	p.ratio = sides.width / sides.length;
	nulls[SETTLED_GEOM] = !drawn || before->outlined;
	nulls[SETTLED_HEIR] = heir == NULL;
	values[SETTLED_ID] = Int64GetDatum(before->id);
	values[SETTLED_DRAWN] = BoolGetDatum(drawn);
	values[SETTLED_GEOM] = nulls[SETTLED_GEOM] ? (Datum) 0 : ty_write_rectangle(polygon, &p, l->srid);
	values[SETTLED_WIDTH] = Float8GetDatum(drawn ? sides.width : 0);
	values[SETTLED_LENGTH] = Float8GetDatum(drawn ? sides.length : 0);
	values[SETTLED_FACTOR] = Float8GetDatum(factor);
	values[SETTLED_X] = Float8GetDatum(centre.x - factor * from.x);
	values[SETTLED_Y] = Float8GetDatum(centre.y - factor * from.y);
	values[SETTLED_HEIR] = heir == NULL ? (Datum) 0 : Int64GetDatum(heir->id);
	return heap_form_tuple(shape, values, nulls);
}

static Datum
settled_array(FunctionCallInfo fcinfo, const layer *l, const uint32_t *order, const ty_site *sites,
			  const uint32_t *heir, size_t *hidden)
{
	Oid element = get_element_type(get_func_rettype(fcinfo->flinfo->fn_oid));
	TupleDesc shape = lookup_rowtype_tupdesc(element, -1);
	void *polygon = palloc(TY_POLYGON_DATUM_SIZE);
	ArrayBuildState *array = initArrayResult(element, CurrentMemoryContext, false);

	ty_check_shape(shape, SETTLED_FIELDS, "typify_settled");
	*hidden = 0;
	for (size_t i = 0; i < l->count; i++)
	{
		const layer_row *row = &l->rows[order[i]];
		HeapTuple tuple;

		CHECK_FOR_INTERRUPTS();
		*hidden += sites[i].state != TY_DRAWN && heir[i] == TY_NO_SITE;
		if (!is_changed(&row->site, &sites[i]))
			continue;
		tuple = settled_row(shape, l, row, &sites[i], heir[i] == TY_NO_SITE ? NULL : &l->rows[order[heir[i]]], polygon);
		array = accumArrayResult(array, heap_copy_tuple_as_datum(tuple, shape), false, element, CurrentMemoryContext);
		heap_freetuple(tuple);
	}
	ReleaseTupleDesc(shape);
	pfree(polygon);
	return makeArrayResult(array, CurrentMemoryContext);
}

PG_FUNCTION_INFO_V1(typify_settle_final);
Datum
typify_settle_final(PG_FUNCTION_ARGS)
{
	const layer *l = PG_ARGISNULL(0) ? NULL : (const layer *) PG_GETARG_POINTER(0);
	uint32_t *order, *heir;
	ty_site *sites;
	size_t hidden;
	ty_collisions collisions = {0};
	Datum array;

	layer_context(fcinfo);
	if (l == NULL || l->count == 0 || !(l->gap > 0))
		PG_RETURN_NULL();
	order = settling_order(l);
	sites = settled_sites(l, order, &collisions);
	heir = find_heirs(l, sites);
	array = settled_array(fcinfo, l, order, sites, heir, &hidden);
	ty_warn_of_collisions(&collisions, l->rows[order[collisions.first_pair[0]]].id,
						  l->rows[order[collisions.first_pair[1]]].id, l->rows[order[collisions.first_beside]].id);
	pfree(order);
	pfree(sites);
	pfree(heir);
	if (hidden > 0)
		ereport(WARNING,
				errmsg_plural("%zu placeholder does not fit between those of other groups and is not drawn",
							  "%zu placeholders do not fit between those of other groups and are not drawn", hidden,
							  hidden),
				errhint("Use larger groups, a smaller min_side or min_gap, or a larger exponent, which leaves fewer."));
	PG_RETURN_DATUM(array);
}
