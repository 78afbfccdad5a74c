/*
 * options.c - see options.h.
 *
 * A composite is taken apart into one Datum a field. The table below says for every field what it is and which values
 * it may have. Values are checked when typify_options() makes a composite and again at every use, since
 * ROW(...)::typify_options and tables bring composites of any content.
 */
#include "options.h"

#include <math.h>

#include "access/htup_details.h"
#include "funcapi.h"
#include "utils/builtins.h"
#include "utils/typcache.h"

#include "backend.h"
#include "barriers.h"

/* in the order of the composite's fields */
typedef enum option
{
	OPTION_SOURCE_SCALE = 0,
	OPTION_LOD200_SCALE,
	OPTION_EXPONENT,
	OPTION_PSI,
	OPTION_COUNT,
	OPTION_MIN_DISTANCE,
	OPTION_COUNT_RULE,
	OPTION_AREA_STATISTIC,
	OPTION_SHAPE,
	OPTION_MIN_AREA,
	OPTION_MIN_SIDE,
	OPTION_MAX_AREA,
	OPTION_KEEP_AREA,
	OPTION_MIN_GAP,
	OPTION_ALIGNMENT,
	OPTION_BARRIERS,
	OPTION_BARRIER_WIDTH,
	OPTIONS
} option;

typedef enum option_kind
{
	NUMBER_ABOVE_0,
	NUMBER_FROM_0,
	NUMBER_TO_1,
	INTEGER_FROM_1,
	WORD,
	LINES
} option_kind;

typedef struct option_entry
{
	const char *name;
	option_kind kind;
	const char *words[4]; /* of a WORD, in the order of the core's enumeration */
	const char *choice;	  /* the words as prose */
} option_entry;

static const option_entry entries[OPTIONS] = {
	{.name = "source_scale", .kind = NUMBER_ABOVE_0},
	{.name = "lod200_scale", .kind = NUMBER_ABOVE_0},
	{.name = "exponent", .kind = NUMBER_FROM_0},
	{.name = "psi", .kind = NUMBER_TO_1},
	{.name = "count", .kind = INTEGER_FROM_1},
	{.name = "min_distance", .kind = NUMBER_FROM_0},
	{.name = "count_rule", .kind = WORD, .words = {"radical", "black_white"}, .choice = "radical or black_white"},
	{.name = "area_statistic", .kind = WORD, .words = {"mean", "median", "sum"}, .choice = "mean, median or sum"},
	{.name = "shape",
	 .kind = WORD,
	 .words = {"rectangle", "square", "footprint", "auto"},
	 .choice = "rectangle, square, footprint or auto"},
	{.name = "min_area", .kind = NUMBER_FROM_0},
	{.name = "min_side", .kind = NUMBER_FROM_0},
	{.name = "max_area", .kind = NUMBER_FROM_0},
	{.name = "keep_area", .kind = NUMBER_FROM_0},
	{.name = "min_gap", .kind = NUMBER_FROM_0},
	{.name = "alignment", .kind = NUMBER_FROM_0},
	{.name = "barriers", .kind = LINES},
	{.name = "barrier_width", .kind = NUMBER_FROM_0},
};

typedef struct option_values
{
	Datum value[OPTIONS];
	bool null[OPTIONS];
	ty_barrier_hash barriers; /* once checked */
} option_values;

void
ty_refuse_value(const char *name, double value, const char *allowed)
{
	ereport(ERROR, errcode(ERRCODE_INVALID_PARAMETER_VALUE),
			errmsg("%s is %s, it must be %s", name, ty_number_text(value), allowed));
}

void
ty_refuse_null(const char *name)
{
	ereport(ERROR, errcode(ERRCODE_NULL_VALUE_NOT_ALLOWED), errmsg("%s must not be null", name));
}

/* An attribute that was added and dropped again stays in the shape, as dropped. */
void
ty_check_shape(TupleDesc shape, int fields, const char *type)
{
	bool fits = shape->natts >= fields;

	for (int i = 0; fits && i < shape->natts; i++)
		fits = TupleDescAttr(shape, i)->attisdropped == (i >= fields);
	if (!fits)
		ereport(ERROR, errcode(ERRCODE_DATATYPE_MISMATCH),
				errmsg("type %s does not have the %d attributes that the extension gave it", type, fields),
				errhint("Use ALTER TYPE %s DROP ATTRIBUTE on what was added, or drop and create the extension again.",
						type));
}

static void
check_number(const option_entry *entry, double value)
{
	if (entry->kind == NUMBER_ABOVE_0 && !(isfinite(value) && value > 0))
		ty_refuse_value(entry->name, value, "a finite number above 0");
	if (entry->kind == NUMBER_FROM_0 && !(isfinite(value) && value >= 0))
		ty_refuse_value(entry->name, value, "a finite number of at least 0");
	if (entry->kind == NUMBER_TO_1 && !(isfinite(value) && value <= 1))
		ty_refuse_value(entry->name, value, "a finite number of at most 1");
}

/* The word's place in the entry's list, which is the value of the core's enumeration. */
static int
word_index(const option_entry *entry, Datum value)
{
	char *word = TextDatumGetCString(value);

	for (int i = 0; i < (int) lengthof(entry->words) && entry->words[i] != NULL; i++)
		if (strcmp(word, entry->words[i]) == 0)
			return i;
	ereport(ERROR, errcode(ERRCODE_INVALID_PARAMETER_VALUE),
			errmsg("%s is \"%s\", it must be %s", entry->name, word, entry->choice));
}

static void
check_value(const option_entry *entry, Datum value, option_values *options)
{
	switch (entry->kind)
	{
		case INTEGER_FROM_1:
			if (DatumGetInt64(value) < 1)
				ereport(ERROR, errcode(ERRCODE_INVALID_PARAMETER_VALUE),
						errmsg("%s is %lld, it must be at least 1", entry->name, (long long) DatumGetInt64(value)));
			break;
		case WORD:
			word_index(entry, value);
			break;
		case LINES:
			options->barriers = ty_check_barriers(value);
			break;
		default:
			check_number(entry, DatumGetFloat8(value));
	}
}

static double
number_or(const option_values *options, option field, double unset)
{
	return options->null[field] ? unset : DatumGetFloat8(options->value[field]);
}

static int
word_or(const option_values *options, option field, int unset)
{
	return options->null[field] ? unset : word_index(&entries[field], options->value[field]);
}

/* Every value by itself, then the two scales against one another. */
static void
check_options(option_values *options)
{
	double source = number_or(options, OPTION_SOURCE_SCALE, TY_DEFAULT_SOURCE_SCALE);
	double lod200 = number_or(options, OPTION_LOD200_SCALE, TY_DEFAULT_LOD200_SCALE);

	options->barriers = (ty_barrier_hash){0, 0};
	for (int field = 0; field < OPTIONS; field++)
		if (!options->null[field])
			check_value(&entries[field], options->value[field], options);
	if (!(lod200 > source))
		ty_refuse_value("lod200_scale", lod200, psprintf("larger than source_scale (%s)", ty_number_text(source)));
}

/* Fields that a composite of an older shape lacks are unset. */
static void
take_apart(Datum composite, option_values *options)
{
	HeapTupleHeader header = DatumGetHeapTupleHeader(composite);
	TupleDesc shape =
		lookup_rowtype_tupdesc_domain(HeapTupleHeaderGetTypeId(header), HeapTupleHeaderGetTypMod(header), false);
	HeapTupleData tuple = {.t_len = HeapTupleHeaderGetDatumLength(header), .t_data = header};
	int fields = shape->natts;
	Datum *values = palloc(fields * sizeof(Datum));
	bool *nulls = palloc(fields * sizeof(bool));

	ItemPointerSetInvalid(&tuple.t_self);
	heap_deform_tuple(&tuple, shape, values, nulls);
	for (int field = 0; field < OPTIONS; field++)
	{
		options->null[field] = field >= fields || nulls[field];
		options->value[field] = options->null[field] ? (Datum) 0 : values[field];
	}
	ReleaseTupleDesc(shape);
	pfree(values);
	pfree(nulls);
}

/* min_distance of 0 is no condition: nothing is nearer. */
static void
apply_options(const option_values *options, ty_parameters *p)
{
	p->source_scale = number_or(options, OPTION_SOURCE_SCALE, TY_DEFAULT_SOURCE_SCALE);
	p->lod200_scale = number_or(options, OPTION_LOD200_SCALE, TY_DEFAULT_LOD200_SCALE);
	p->exponent = number_or(options, OPTION_EXPONENT, TY_DEFAULT_EXPONENT);
	p->psi = number_or(options, OPTION_PSI, TY_DEFAULT_PSI);
	p->min_distance = number_or(options, OPTION_MIN_DISTANCE, 0);
	p->count = options->null[OPTION_COUNT] ? 0 : DatumGetInt64(options->value[OPTION_COUNT]);
	p->law = p->min_distance == 0 || !options->null[OPTION_COUNT] || !options->null[OPTION_COUNT_RULE] ||
			 !options->null[OPTION_EXPONENT];
	p->count_rule = (ty_count_rule) word_or(options, OPTION_COUNT_RULE, TY_RADICAL);
	p->area_statistic = (ty_area_statistic) word_or(options, OPTION_AREA_STATISTIC, TY_MEAN);
	p->shape = (ty_shape) word_or(options, OPTION_SHAPE, TY_RECTANGLE);
	p->min_area = number_or(options, OPTION_MIN_AREA, 0);
	p->alignment = number_or(options, OPTION_ALIGNMENT, 0);
	p->min_side = number_or(options, OPTION_MIN_SIDE, 0);
	p->max_area = number_or(options, OPTION_MAX_AREA, TY_DEFAULT_MAX_AREA_SIDES * p->min_side * p->min_side);
	p->min_gap = number_or(options, OPTION_MIN_GAP, 0);
	p->barrier_width = number_or(options, OPTION_BARRIER_WIDTH, 0);
	p->barriers = options->barriers;
	p->keep_area = number_or(options, OPTION_KEEP_AREA, 0);
}

Datum
ty_barriers_of_options(Datum composite)
{
	option_values options;

	take_apart(composite, &options);
	return options.value[OPTION_BARRIERS];
}

void
ty_set_s_u(ty_parameters *p, double s_u)
{
	if (!(s_u >= 0 && s_u <= 1))
		ty_refuse_value("s_u", s_u, "between 0 and 1");
	p->s_u = s_u;
}

/* All but the scale. */
static void
resolve_options(double s_u, Datum composite, bool composite_null, ty_parameters *p)
{
	option_values options;

	memset(options.null, true, sizeof(options.null));
	options.barriers = (ty_barrier_hash){0, 0};
	if (!composite_null)
	{
		take_apart(composite, &options);
		check_options(&options);
	}
	memset(p, 0, sizeof(*p));
	apply_options(&options, p);
	ty_set_s_u(p, s_u);
}

void
ty_set_scale(ty_parameters *p, double scale)
{
	if (!isfinite(scale) || scale < p->source_scale)
		ty_refuse_value("scale", scale,
						psprintf("a finite number of at least source_scale (%s)", ty_number_text(p->source_scale)));
	p->scale = scale;
	if (!isfinite(ty_area_factor(p)))
		ereport(ERROR, errcode(ERRCODE_NUMERIC_VALUE_OUT_OF_RANGE),
				errmsg("the area factor of scale %s with psi %s and source_scale %s is out of range",
					   ty_number_text(scale), ty_number_text(p->psi), ty_number_text(p->source_scale)),
				errhint("Use a smaller scale denominator, or a psi between 0 and 1."));
}

void
ty_resolve_parameters(double scale, double s_u, Datum composite, bool composite_null, ty_parameters *p)
{
	resolve_options(s_u, composite, composite_null, p);
	ty_set_scale(p, scale);
}

static void
refuse_for_hierarchy(bool given, const char *option, const char *hint)
{
	if (given)
		ereport(ERROR, errcode(ERRCODE_INVALID_PARAMETER_VALUE),
				errmsg("a hierarchy holds all scales, but %s makes it depend on one", option), errhint("%s", hint));
}

void
ty_resolve_hierarchy_parameters(double s_u, Datum composite, bool composite_null, ty_parameters *p)
{
	resolve_options(s_u, composite, composite_null, p);
	p->scale = p->source_scale;
	refuse_for_hierarchy(p->count > 0, "count", "Leave it out: typify_at takes the scale, and exponent says how many.");
	refuse_for_hierarchy(p->min_distance > 0, "min_distance", "Leave it out, or use typify_create_scale.");
	refuse_for_hierarchy(p->count_rule == TY_BLACK_WHITE, "count_rule => 'black_white'",
						 "Leave it out, or use typify_create_scale; exponent says how many.");
	refuse_for_hierarchy(p->keep_area > 0, "keep_area",
						 "Leave it out, or give what is to be kept importance => 'Infinity'.");
	refuse_for_hierarchy(p->min_area > 0, "min_area", "Leave it out, or pass a view without such buildings.");
	refuse_for_hierarchy(p->alignment > 0, "alignment", "Leave it out, or use typify_create_scale.");
	if (ty_wants_outline(p))
		ereport(ERROR, errcode(ERRCODE_FEATURE_NOT_SUPPORTED),
				errmsg("a hierarchy keeps no outlines, so that shape must be rectangle or square"),
				errhint("Leave shape out, or use typify_create_scale."));
}

bool
ty_same_parameters(const ty_parameters *a, const ty_parameters *b)
{
	return a->scale == b->scale && a->s_u == b->s_u && a->source_scale == b->source_scale &&
		   a->lod200_scale == b->lod200_scale && a->exponent == b->exponent && a->psi == b->psi &&
		   a->min_distance == b->min_distance && a->count == b->count && a->law == b->law &&
		   a->count_rule == b->count_rule && a->area_statistic == b->area_statistic && a->shape == b->shape &&
		   a->min_area == b->min_area && a->alignment == b->alignment && a->min_side == b->min_side &&
		   a->max_area == b->max_area && a->keep_area == b->keep_area && a->min_gap == b->min_gap &&
		   a->barrier_width == b->barrier_width && a->barriers.low == b->barriers.low &&
		   a->barriers.high == b->barriers.high;
}

/* Dropped attributes, which the shape may have behind the fields, are null. */
static Datum
compose(TupleDesc shape, const option_values *options)
{
	Datum *values = palloc0(shape->natts * sizeof(Datum));
	bool *nulls = palloc(shape->natts * sizeof(bool));

	memset(nulls, true, shape->natts * sizeof(bool));
	memcpy(values, options->value, sizeof(options->value));
	memcpy(nulls, options->null, sizeof(options->null));
	return HeapTupleGetDatum(heap_form_tuple(BlessTupleDesc(shape), values, nulls));
}

PG_FUNCTION_INFO_V1(typify_options);
Datum
typify_options(PG_FUNCTION_ARGS)
{
	option_values options;
	TupleDesc shape;

	if (PG_NARGS() != OPTIONS || get_call_result_type(fcinfo, NULL, &shape) != TYPEFUNC_COMPOSITE)
		elog(ERROR, "typify_options is not declared as this library expects");
	ty_check_shape(shape, OPTIONS, "typify_options");
	for (int field = 0; field < OPTIONS; field++)
	{
		options.null[field] = PG_ARGISNULL(field);
		options.value[field] = options.null[field] ? (Datum) 0 : PG_GETARG_DATUM(field);
	}
	check_options(&options);
	PG_RETURN_DATUM(compose(shape, &options));
}
