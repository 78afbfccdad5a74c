/*
 * hierarchy.c - nodes of a hierarchy: as the value of the aggregate, as placeholders at a scale, and where they stand
 * in the index.
 *
 * The index is a GiST index over points of the plane, which is built by sorting. What is asked of it is a place, a
 * scale between scale_from and scale_to, and as much more room as a polygon reaches from its vertex. So nodes stand in
 * copies of the plane, beside one another by BAND_SHIFT: in x by the band in which their life spans end, in y by how
 * many bands these last and, for each of that, by size. A look-up asks, of each class of sizes and lifetimes, the bands
 * from that of the scale to the last in which a life span that has begun may end, for the box widened by what the
 * largest of the class reaches at the scale. Two thirds of what it finds is alive; that is checked, and the polygon
 * itself against the box.
 */
#include "compat.h"

#include <float.h>
#include <math.h>

#include "catalog/pg_type.h"
#include "common/hashfn.h"
#include "funcapi.h"
#include "miscadmin.h"
#include "utils/datum.h"
#include "utils/geo_decls.h"

#include "backend.h"
#include "core/group.h"
#include "core/hierarchy.h"
#include "geometry.h"
#include "hierarchy.h"
#include "options.h"
#include "progress.h"
#include "row_array.h"

/* --- the aggregate's value --- */

/* exactly, but for what the null bitmap of a root takes */
#define NODE_SIZE (MAXALIGN(SizeofHeapTupleHeader + 2) + 6 * sizeof(int32) + sizeof(int64) + 9 * sizeof(float8))

void
ty_node_values(const ty_hierarchy *h, size_t number, const ty_node *node, Datum *values, bool *nulls)
{
	values[TY_NODE_NODE] = Int32GetDatum((int32) number);
	nulls[TY_NODE_PARENT] = node->parent == TY_NONE;
	values[TY_NODE_PARENT] = Int32GetDatum((int32) node->parent);
	values[TY_NODE_KEPT] = BoolGetDatum(node->kept);
	values[TY_NODE_REPRESENTATIVE] = Int64GetDatum(h->buildings[node->representative].id);
	values[TY_NODE_MEMBER_COUNT] = Int32GetDatum((int32) node->member_count);
	values[TY_NODE_FIRST_LEAF] = Int32GetDatum((int32) node->first_leaf);
	values[TY_NODE_X] = Float8GetDatum(node->x);
	values[TY_NODE_Y] = Float8GetDatum(node->y);
	values[TY_NODE_AREA] = Float8GetDatum(node->area);
	values[TY_NODE_RATIO] = Float8GetDatum(node->ratio);
	values[TY_NODE_UX] = Float8GetDatum(node->ux);
	values[TY_NODE_UY] = Float8GetDatum(node->uy);
	values[TY_NODE_COST] = Float8GetDatum(node->cost);
	values[TY_NODE_SCALE_FROM] = Float8GetDatum(node->scale_from);
	values[TY_NODE_SCALE_TO] = Float8GetDatum(node->scale_to);
}

Datum
ty_node_array(FunctionCallInfo fcinfo, const ty_input *input, const ty_parameters *p)
{
	size_t n = input->n;
	ty_row_array rows;
	ty_hierarchy h;

	ty_row_array_begin(&rows, fcinfo, TY_NODE_FIELDS, "typify_node", 2 * n * NODE_SIZE, 2 * n - 1);
	ty_build_hierarchy(input, p, &h);
	ARR_DIMS(rows.array)[0] = (int) ty_hierarchy_nodes(&h);
	for (size_t place = 0; place < ty_hierarchy_nodes(&h); place++)
	{
		ty_node node;

		CHECK_FOR_INTERRUPTS();
		ty_hierarchy_fetch(&h, place + TY_FETCHED_AHEAD);
		node = ty_hierarchy_node(&h, ty_hierarchy_stored(&h, place));
		ty_node_values(&h, ty_hierarchy_stored(&h, place), &node, rows.values, rows.nulls);
		ty_row_array_add(&rows);
	}
	ty_hierarchy_free(&ty_backend_environment, &h);
	return ty_row_array_end(&rows);
}

/* --- what a leaf was made of --- */

/* A building's measures have no bytes between them. */
StaticAssertDecl(sizeof(ty_building) == 6 * sizeof(double) + sizeof(int64), "ty_building is padded");

int64
ty_hash_building(const ty_building *building, double importance)
{
	uint64 seed = 0;

	if (importance != 1)
		memcpy(&seed, &importance, sizeof(seed));
	return (int64) hash_bytes_extended((const unsigned char *) building, sizeof(*building), seed);
}

PG_FUNCTION_INFO_V1(typify_building_hash);
Datum
typify_building_hash(PG_FUNCTION_ARGS)
{
	ty_building building;
	int32 srid;

	if (!ty_measure_datum(PG_GETARG_DATUM(0), &building, &srid, NULL))
		PG_RETURN_NULL();
	building.id = PG_GETARG_INT64(1);
	PG_RETURN_INT64(ty_hash_building(&building, PG_GETARG_FLOAT8(2)));
}

PG_FUNCTION_INFO_V1(typify_leaf_hash);
Datum
typify_leaf_hash(PG_FUNCTION_ARGS)
{
	ty_building building = {.id = PG_GETARG_INT64(0),
							.x = PG_GETARG_FLOAT8(1),
							.y = PG_GETARG_FLOAT8(2),
							.area = PG_GETARG_FLOAT8(3),
							.ratio = PG_GETARG_FLOAT8(4),
							.ux = PG_GETARG_FLOAT8(5),
							.uy = PG_GETARG_FLOAT8(6)};

	PG_RETURN_INT64(ty_hash_building(&building, 1));
}

/* --- places in the index --- */

/* One copy of the plane beside the other: far more than coordinates come to. Where they do, places coincide. */
#define BAND_SHIFT 268435456.0
/* Classes hold what reaches less than 16, 128, 1024 ... units: few, of a factor that a tile hardly notices. */
#define LEAST_CLASS_BITS 4
#define CLASS_BITS 3
#define MOST_CLASS 20
/* Reaches are measured with this psi; one that draws larger counts as reaching further. */
#define REACH_PSI TY_DEFAULT_PSI

static int
class_of(double reach)
{
	int exponent;

	(void) frexp(reach, &exponent);
	return exponent <= LEAST_CLASS_BITS ? 0
										: Min((exponent - LEAST_CLASS_BITS + CLASS_BITS - 1) / CLASS_BITS, MOST_CLASS);
}

double
ty_node_reach(double area, double ratio, double psi)
{
	return 0.5 * sqrt(area * (ratio + 1 / ratio)) * sqrt(fmax(1, (1 - psi) / (1 - REACH_PSI)));
}

/* in y: the copies of a class stand together */
static double
row_shift(int class, int lifetime)
{
	return BAND_SHIFT * (class * TY_LIFETIMES + lifetime);
}

Point
ty_node_place(double x, double y, double reach, double scale_from, double scale_to, double source_scale)
{
	int lifetime = ty_lifetime(scale_from, scale_to, source_scale);
	int band = ty_band_together(lifetime, ty_band(scale_to, source_scale));

	return (Point){x + BAND_SHIFT * band, y + row_shift(class_of(reach), lifetime)};
}

PG_FUNCTION_INFO_V1(typify_reach);
Datum
typify_reach(PG_FUNCTION_ARGS)
{
	PG_RETURN_FLOAT8(ty_node_reach(PG_GETARG_FLOAT8(0), PG_GETARG_FLOAT8(1), PG_GETARG_FLOAT8(2)));
}

PG_FUNCTION_INFO_V1(typify_place);
Datum
typify_place(PG_FUNCTION_ARGS)
{
	Point *place = palloc(sizeof(Point));

	*place = ty_node_place(PG_GETARG_FLOAT8(0), PG_GETARG_FLOAT8(1), PG_GETARG_FLOAT8(2), PG_GETARG_FLOAT8(3),
						   PG_GETARG_FLOAT8(4), PG_GETARG_FLOAT8(5));
	PG_RETURN_POINT_P(place);
}

/* what a look-up is about; scales from low to high */
typedef struct search
{
	BOX box;
	double low, high;
	double reach, top; /* greatest in the table; top: of those scale_to that are finite */
	double source_scale, lod200_scale;
	double min_side; /* ground units at the high scale */
} search;

/* By how much the box is widened for nodes of this reach; a little more than need be, for what is rounded. */
static double
widening(const search *s, double reach)
{
	const double of_min_side = 0.90138781886599728; /* half the diagonal of 1 by 1.5, the most it adds */
	ty_parameters p = {
		.scale = s->low, .source_scale = s->source_scale, .lod200_scale = s->lod200_scale, .psi = REACH_PSI};
	double fraction = fmin((s->low - s->source_scale) / (s->lod200_scale - s->source_scale), 1);
	double enlargement = s->high / s->source_scale;
	double factor = fmax(1, enlargement * enlargement * (1 - p.psi * fraction));
	double farthest =
		fmax(fmax(fabs(s->box.low.x), fabs(s->box.high.x)), fmax(fabs(s->box.low.y), fabs(s->box.high.y)));

	return (reach * sqrt(factor) + of_min_side * s->min_side) * (1 + 1e-9) + farthest * 8 * DBL_EPSILON;
}

/* The box, wider, in a copy of the plane. */
static BOX
shifted_box(const search *s, int band, int class, int lifetime, double wider)
{
	BOX box;

	box.low.x = s->box.low.x - wider + BAND_SHIFT * band;
	box.high.x = s->box.high.x + wider + BAND_SHIFT * band;
	box.low.y = s->box.low.y - wider + row_shift(class, lifetime);
	box.high.y = s->box.high.y + wider + row_shift(class, lifetime);
	return box;
}

/* Whether no point can lie in the boxes of two copies. */
static bool
copies_are_apart(const search *s, double wider)
{
	double width = s->box.high.x - s->box.low.x + 2 * wider, height = s->box.high.y - s->box.low.y + 2 * wider;
	double farthest =
		fmax(fmax(fabs(s->box.low.x), fabs(s->box.high.x)), fmax(fabs(s->box.low.y), fabs(s->box.high.y)));

	return width < BAND_SHIFT - 1 && height < BAND_SHIFT - 1 && farthest < 1e15;
}

/* a box that holds those of all copies */
static BOX
box_of_all(const search *s, int most_class, double wider)
{
	BOX box = shifted_box(s, 0, 0, 0, wider), last = shifted_box(s, TY_ROOT_BAND, most_class, TY_LIFETIMES - 1, wider);

	box.high = last.high;
	return box;
}

static Datum
box_datum(BOX box)
{
	BOX *copy = palloc(sizeof(BOX));

	*copy = box;
	return BoxPGetDatum(copy);
}

/* Of a class and lifetime: the bands in which what is alive at these scales may end. */
static int
list_bands(const search *s, int class, int lifetime, double wider, Datum *boxes)
{
	int first = ty_band(s->low, s->source_scale), greatest = ty_band(s->top, s->source_scale);
	int last = Min(ty_last_band(lifetime, ty_band(s->high, s->source_scale)), greatest);
	int count = 0;

	for (int band = ty_band_together(lifetime, first); band <= last && band < TY_ROOT_BAND;
		 band += ty_bands_together(lifetime))
		boxes[count++] = box_datum(shifted_box(s, band, class, lifetime, wider));
	if (lifetime == TY_LIFETIMES - 1)
		boxes[count++] = box_datum(shifted_box(s, TY_ROOT_BAND, class, lifetime, wider));
	return count;
}

static int
list_boxes(const search *s, int most_class, Datum *boxes)
{
	int count = 0;

	for (int class = 0; class <= most_class; class ++)
	{
		double limit = ldexp(1, LEAST_CLASS_BITS + CLASS_BITS * class);
		double wider = widening(s, class == most_class ? s->reach : limit);

		for (int lifetime = 0; lifetime < TY_LIFETIMES; lifetime++)
			count += list_bands(s, class, lifetime, wider, boxes + count);
	}
	return count;
}

PG_FUNCTION_INFO_V1(typify_search);
Datum
typify_search(PG_FUNCTION_ARGS)
{
	search s = {.box = *PG_GETARG_BOX_P(0),
				.low = PG_GETARG_FLOAT8(1),
				.high = PG_GETARG_FLOAT8(2),
				.reach = PG_GETARG_FLOAT8(3),
				.top = PG_GETARG_FLOAT8(4),
				.source_scale = PG_GETARG_FLOAT8(5),
				.lod200_scale = PG_GETARG_FLOAT8(6),
				.min_side = PG_GETARG_FLOAT8(7)};
	int most_class = class_of(s.reach), count = 1;
	Datum *boxes = palloc(sizeof(Datum) * (most_class + 1) * TY_LIFETIMES * (TY_ROOT_BAND + 1));
	double widest = widening(&s, s.reach);

	if (copies_are_apart(&s, widest))
		count = list_boxes(&s, most_class, boxes);
	else
		boxes[0] = box_datum(box_of_all(&s, most_class, widest));
	PG_RETURN_ARRAYTYPE_P(construct_array(boxes, count, BOXOID, sizeof(BOX), false, TYPALIGN_DOUBLE));
}

/* --- placeholders at a scale --- */

/* Arguments of typify_node_placeholder that say how to draw. */
enum
{
	DRAW_KEPT = 8,
	DRAW_SCALE,
	DRAW_OPTIONS,
	DRAW_PSI,
	DRAW_SRID,
	DRAW_METRES
};

/* What is kept from row to row. */
typedef struct drawing
{
	MemoryContext context;
	bool parsed;
	bool options_null;
	bool stable; /* options are the same for all rows */
	Datum options;
	double scale, metres_per_unit, psi;
	double own_psi;			/* of the options */
	ty_parameters resolved; /* lengths in millimetres */
	ty_parameters parameters;
	double area_factor;
	TupleDesc shape; /* of typify_placeholder, NULL until it is needed */
} drawing;

static drawing *
drawing_of(FunctionCallInfo fcinfo)
{
	FmgrInfo *function = fcinfo->flinfo;
	drawing *d = function->fn_extra;
	MemoryContext old;

	if (likely(d != NULL))
		return d;
	old = MemoryContextSwitchTo(function->fn_mcxt);
	d = palloc0(sizeof(drawing));
	d->context = function->fn_mcxt;
	d->stable = get_fn_expr_arg_stable(function, DRAW_OPTIONS);
	function->fn_extra = d;
	MemoryContextSwitchTo(old);
	return d;
}

static void
find_shape(FunctionCallInfo fcinfo, drawing *d)
{
	MemoryContext old = MemoryContextSwitchTo(d->context);

	if (get_call_result_type(fcinfo, NULL, &d->shape) != TYPEFUNC_COMPOSITE)
		elog(ERROR, "typify_node_placeholder is not declared as this library expects");
	d->shape = BlessTupleDesc(d->shape);
	ty_check_shape(d->shape, TY_PLACEHOLDER_FIELDS, "typify_placeholder");
	MemoryContextSwitchTo(old);
}

static bool
same_options(const drawing *d, const NullableDatum *args)
{
	return d->parsed &&
		   (d->stable || (d->options_null == args[DRAW_OPTIONS].isnull &&
						  (d->options_null || datum_image_eq(d->options, args[DRAW_OPTIONS].value, false, -1))));
}

/* Everything but the psi that a group may have of its own. */
static void
parse_drawing(drawing *d, const NullableDatum *args)
{
	bool null = args[DRAW_OPTIONS].isnull;
	MemoryContext old = MemoryContextSwitchTo(d->context);

	d->parsed = false;
	ty_resolve_parameters(DatumGetFloat8(args[DRAW_SCALE].value), 0, null ? (Datum) 0 : args[DRAW_OPTIONS].value, null,
						  &d->resolved);
	if (d->options != (Datum) 0)
		pfree(DatumGetPointer(d->options));
	d->options_null = null;
	d->options = null ? (Datum) 0 : datumCopy(args[DRAW_OPTIONS].value, false, -1);
	d->own_psi = d->resolved.psi;
	d->scale = 0;
	d->parsed = true;
	MemoryContextSwitchTo(old);
}

/* Each group of a tile has its own scale, so that it changes often. */
static void
set_scale(drawing *d, double scale, double metres_per_unit)
{
	if (scale == d->scale && metres_per_unit == d->metres_per_unit)
		return;
	d->scale = 0;
	d->parameters = d->resolved;
	ty_set_scale(&d->parameters, scale);
	d->scale = scale;
	d->metres_per_unit = metres_per_unit;
	d->psi = d->own_psi;
	d->area_factor = ty_area_factor(&d->parameters);
	ty_bring_to_ground(&d->parameters, metres_per_unit);
}

static void
set_psi(drawing *d, double psi)
{
	if (psi == d->psi)
		return;
	if (!(isfinite(psi) && psi <= 1))
		ty_refuse_value("psi", psi, "a finite number of at most 1");
	d->psi = d->parameters.psi = psi;
	d->area_factor = ty_area_factor(&d->parameters);
}

/* A kept node is drawn as if it stood for its building alone. */
static ty_placeholder
placeholder_of(const drawing *d, const NullableDatum *args)
{
	double statistic = DatumGetFloat8(args[3].value);
	double ratio = d->parameters.shape == TY_SQUARE ? 1 : DatumGetFloat8(args[4].value);
	bool kept = DatumGetBool(args[DRAW_KEPT].value);
	int32 members = DatumGetInt32(args[7].value);
	double area = kept ? statistic : ty_scaled_area(&d->parameters, d->area_factor, statistic);
	ty_size size = ty_drawn_size(&d->parameters, statistic, area, ratio, kept ? 1 : Max(members, 1));

	return (ty_placeholder){.x = DatumGetFloat8(args[1].value),
							.y = DatumGetFloat8(args[2].value),
							.area = size.area,
							.width = size.width,
							.length = size.length,
							.ratio = size.ratio,
							.ux = DatumGetFloat8(args[5].value),
							.uy = DatumGetFloat8(args[6].value),
							.count = members};
}

bool
ty_draw_node(FunctionCallInfo fcinfo, ty_placeholder *p)
{
	drawing *d = drawing_of(fcinfo);

	for (int i = 0; i <= DRAW_METRES; i++)
		if (PG_ARGISNULL(i) && i != DRAW_OPTIONS && i != DRAW_PSI)
			return false;
	if (!same_options(d, fcinfo->args))
		parse_drawing(d, fcinfo->args);
	set_scale(d, PG_GETARG_FLOAT8(DRAW_SCALE), PG_GETARG_FLOAT8(DRAW_METRES));
	set_psi(d, PG_ARGISNULL(DRAW_PSI) ? d->own_psi : PG_GETARG_FLOAT8(DRAW_PSI));
	*p = placeholder_of(d, fcinfo->args);
	return true;
}

PG_FUNCTION_INFO_V1(typify_node_placeholder);
Datum
typify_node_placeholder(PG_FUNCTION_ARGS)
{
	drawing *d = drawing_of(fcinfo);
	ty_placeholder p;
	Datum polygon, *values;
	bool *nulls;

	if (!ty_draw_node(fcinfo, &p))
		PG_RETURN_NULL();
	if (d->shape == NULL)
		find_shape(fcinfo, d);
	values = palloc0(d->shape->natts * sizeof(Datum));
	nulls = palloc(d->shape->natts * sizeof(bool));
	memset(nulls, true, d->shape->natts * sizeof(bool));
	polygon =
		p.area > 0 ? ty_write_rectangle(palloc(TY_POLYGON_DATUM_SIZE), &p, PG_GETARG_INT32(DRAW_SRID)) : (Datum) 0;
	ty_placeholder_values(&p, PG_GETARG_INT64(0), polygon, values, nulls);
	PG_RETURN_DATUM(HeapTupleGetDatum(heap_form_tuple(d->shape, values, nulls)));
}
