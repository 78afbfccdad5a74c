/* formulas.c - the formulas alone, for use and for teaching: count law, area factor, psi, rectangle. */
#include "compat.h"

#include <math.h>

#include "backend.h"
#include "core/placeholder.h"
#include "geometry.h"
#include "options.h"
#include "srid.h"

static void
check_finite_above_0(const char *name, double value)
{
	if (!(isfinite(value) && value > 0))
		ty_refuse_value(name, value, "a finite number above 0");
}

static double
check_result(double value)
{
	if (!isfinite(value))
		ereport(ERROR, errcode(ERRCODE_NUMERIC_VALUE_OUT_OF_RANGE), errmsg("value out of range: overflow"));
	return value;
}

/* Parameters of a formula whose scale and options are the arguments `scale` and `scale + 1`. */
static ty_parameters
formula_parameters(FunctionCallInfo fcinfo, int scale)
{
	ty_parameters parameters;
	bool options_null = PG_ARGISNULL(scale + 1);

	ty_resolve_parameters(PG_GETARG_FLOAT8(scale), 0, options_null ? (Datum) 0 : PG_GETARG_DATUM(scale + 1),
						  options_null, &parameters);
	return parameters;
}

PG_FUNCTION_INFO_V1(typify_count);
Datum
typify_count(PG_FUNCTION_ARGS)
{
	int64 n;
	ty_parameters parameters;

	if (PG_ARGISNULL(0) || PG_ARGISNULL(1))
		PG_RETURN_NULL();
	n = PG_GETARG_INT64(0);
	parameters = formula_parameters(fcinfo, 1);
	if (n < 0)
		ereport(ERROR, errcode(ERRCODE_INVALID_PARAMETER_VALUE),
				errmsg("n is %lld, it must be at least 0", (long long) n));
	if (!parameters.law)
		ereport(ERROR, errcode(ERRCODE_INVALID_PARAMETER_VALUE),
				errmsg("min_distance alone says when to stop, so the count depends on the buildings"),
				errhint("Set count, count_rule or exponent as well."));
	/* the mean area is not known here; any that is positive gives the same */
	PG_RETURN_INT64((int64) ty_count((size_t) n, &parameters, 1));
}

PG_FUNCTION_INFO_V1(typify_scale_below);
Datum
typify_scale_below(PG_FUNCTION_ARGS)
{
	ty_parameters parameters;
	bool options_null = PG_ARGISNULL(2);
	int64 n, count;

	if (PG_ARGISNULL(0) || PG_ARGISNULL(1))
		PG_RETURN_NULL();
	n = PG_GETARG_INT64(0);
	count = PG_GETARG_INT64(1);
	ty_resolve_hierarchy_parameters(0, options_null ? (Datum) 0 : PG_GETARG_DATUM(2), options_null, &parameters);
	if (n < 0 || count < 0)
		ereport(ERROR, errcode(ERRCODE_INVALID_PARAMETER_VALUE),
				errmsg("%s is %lld, it must be at least 0", n < 0 ? "n" : "count", (long long) (n < 0 ? n : count)));
	PG_RETURN_FLOAT8(ty_scale_below((size_t) n, (size_t) count, &parameters));
}

PG_FUNCTION_INFO_V1(typify_area_factor);
Datum
typify_area_factor(PG_FUNCTION_ARGS)
{
	ty_parameters parameters;

	if (PG_ARGISNULL(0))
		PG_RETURN_NULL();
	parameters = formula_parameters(fcinfo, 0);
	PG_RETURN_FLOAT8(check_result(ty_area_factor(&parameters)));
}

PG_FUNCTION_INFO_V1(typify_psi);
Datum
typify_psi(PG_FUNCTION_ARGS)
{
	double mean_placeholder_area = PG_GETARG_FLOAT8(0);
	double mean_area_lod200 = PG_GETARG_FLOAT8(1);
	double m25 = PG_GETARG_FLOAT8(2);
	double m200 = PG_GETARG_FLOAT8(3);

	check_finite_above_0("mean_placeholder_area", mean_placeholder_area);
	if (!(isfinite(mean_area_lod200) && mean_area_lod200 >= 0))
		ty_refuse_value("mean_area_lod200", mean_area_lod200, "a finite number of at least 0");
	check_finite_above_0("m25", m25);
	if (!(isfinite(m200) && m200 > m25))
		ty_refuse_value("m200", m200, psprintf("a finite number larger than m25 (%s)", ty_number_text(m25)));
	PG_RETURN_FLOAT8(check_result(ty_psi(mean_placeholder_area, mean_area_lod200, m25, m200)));
}

static ty_srid_cache *
srids_of(FunctionCallInfo fcinfo)
{
	FmgrInfo *function = fcinfo->flinfo;

	if (function->fn_extra == NULL)
	{
		ty_srid_cache *cache = MemoryContextAlloc(function->fn_mcxt, sizeof(ty_srid_cache));

		ty_srid_cache_begin(cache, function->fn_oid, 0, function->fn_mcxt);
		function->fn_extra = cache;
	}
	return function->fn_extra;
}

PG_FUNCTION_INFO_V1(typify_rectangle);
Datum
typify_rectangle(PG_FUNCTION_ARGS)
{
	ty_placeholder placeholder = {.area = PG_GETARG_FLOAT8(1), .ratio = PG_GETARG_FLOAT8(2)};
	double orientation = PG_GETARG_FLOAT8(3);
	ty_point center;
	int32 srid;

	check_finite_above_0("area", placeholder.area);
	if (!(placeholder.ratio > 0 && placeholder.ratio <= 1))
		ty_refuse_value("ratio", placeholder.ratio, "above 0 and at most 1");
	if (!isfinite(orientation))
		ty_refuse_value("orientation", orientation, "a finite number of degrees");
	if (!ty_point_datum(PG_GETARG_DATUM(0), "center", &center, &srid))
		PG_RETURN_NULL();
	ty_check_srid(srids_of(fcinfo), srid);
	placeholder.x = center.x;
	placeholder.y = center.y;
	ty_direction(orientation, &placeholder.ux, &placeholder.uy);
	PG_RETURN_DATUM(ty_write_rectangle(palloc(TY_POLYGON_DATUM_SIZE), &placeholder, srid));
}
