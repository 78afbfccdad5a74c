/* call.c - see call.h */
#include "call.h"

#include "nodes/execnodes.h"
#include "nodes/primnodes.h"
#include "utils/datum.h"

#include "options.h"

#define SCALE 0
#define S_U 1
#define OPTIONS 2

/* The planned expression of an argument, or NULL where the caller's context does not tell. */
static Node *
argument_expression(FunctionCallInfo fcinfo, int argument)
{
	Aggref *aggregate = AggGetAggref(fcinfo);
	Node *call = fcinfo->flinfo->fn_expr;

	/* an aggregate's own arguments come after the state */
	if (aggregate != NULL)
		return (Node *) list_nth_node(TargetEntry, aggregate->args, argument - 1)->expr;
	if (call != NULL && IsA(call, WindowFunc))
		return list_nth(((WindowFunc *) call)->args, argument);
	return NULL;
}

/*
 * The least constant of the arguments decides. Where an aggregate runs as a window function nothing is known of
 * them, and they are compared for every row.
 */
static ty_constancy
call_constancy(FunctionCallInfo fcinfo, int first, int given, bool with_scale)
{
	bool aggregate = AggGetAggref(fcinfo) != NULL;
	PlannedStmt *statement = aggregate ? ((AggState *) fcinfo->context)->ss.ps.state->es_plannedstmt : NULL;
	ty_constancy least = TY_PER_QUERY;

	for (int i = with_scale ? SCALE : S_U; i < given; i++)
	{
		Node *expression = argument_expression(fcinfo, first + i);

		least = Min(least, expression == NULL ? TY_PER_ROW : ty_constancy_of(expression, statement));
	}
	return least;
}

ty_call *
ty_call_of(FunctionCallInfo fcinfo, int first, int geometry, bool with_scale)
{
	FmgrInfo *function = fcinfo->flinfo;
	ty_call *call = function->fn_extra;

	if (likely(call != NULL))
		return call;
	call = MemoryContextAllocZero(function->fn_mcxt, sizeof(ty_call));
	call->context = function->fn_mcxt;
	call->with_scale = with_scale;
	call->given = Min(PG_NARGS() - first, TY_CALL_ARGUMENTS);
	call->constancy = call_constancy(fcinfo, first, call->given, with_scale);
	ty_srid_cache_begin(&call->srids, function->fn_oid, geometry, function->fn_mcxt);
	function->fn_extra = call;
	return call;
}

static bool
same_arguments(const ty_call *call, const NullableDatum *arguments)
{
	for (int i = call->with_scale ? SCALE : S_U; i < call->given; i++)
	{
		const NullableDatum *old = &call->arguments[i], *new = &arguments[i];
		bool number = i != OPTIONS;

		if (old->isnull != new->isnull)
			return false;
		if (!old->isnull && !datum_image_eq(old->value, new->value, number, number ? (int) sizeof(float8) : -1))
			return false;
	}
	return true;
}

/* Options are copied as they are, out of line or compressed where they are so. */
static void
keep_arguments(ty_call *call, const NullableDatum *arguments)
{
	NullableDatum *options = &call->arguments[OPTIONS];

	if (call->parsed && call->given > OPTIONS && !options->isnull)
		pfree(DatumGetPointer(options->value));
	memcpy(call->arguments, arguments, call->given * sizeof(NullableDatum));
	if (call->given > OPTIONS && !options->isnull)
	{
		MemoryContext old = MemoryContextSwitchTo(call->context);

		options->value = datumCopy(options->value, false, -1);
		MemoryContextSwitchTo(old);
	}
}

static ty_parameters
parse(const ty_call *call, const NullableDatum *arguments)
{
	bool options_given = call->given > OPTIONS && !arguments[OPTIONS].isnull;
	Datum options = options_given ? arguments[OPTIONS].value : (Datum) 0;
	double s_u = call->given > S_U ? DatumGetFloat8(arguments[S_U].value) : 0;
	ty_parameters parameters;

	if (call->with_scale && arguments[SCALE].isnull)
		ty_refuse_null("scale");
	if (call->given > S_U && arguments[S_U].isnull)
		ty_refuse_null("s_u");
	if (call->with_scale)
		ty_resolve_parameters(DatumGetFloat8(arguments[SCALE].value), s_u, options, !options_given, &parameters);
	else
		ty_resolve_hierarchy_parameters(s_u, options, !options_given, &parameters);
	return parameters;
}

const ty_parameters *
ty_call_parameters(ty_call *call, const NullableDatum *arguments, bool group_begins)
{
	ty_parameters parameters;

	if (likely(call->parsed))
		if (call->constancy == TY_PER_QUERY || (call->constancy == TY_PER_GROUP && !group_begins) ||
			same_arguments(call, arguments))
			return &call->parameters;
	parameters = parse(call, arguments);
	if (call->constancy != TY_PER_QUERY)
		keep_arguments(call, arguments);
	if (!call->parsed || !ty_same_parameters(&parameters, &call->parameters))
		call->generation++;
	call->parameters = parameters;
	call->parsed = true;
	return &call->parameters;
}

void
ty_refuse_varying_parameters(void)
{
	ereport(ERROR, errcode(ERRCODE_INVALID_PARAMETER_VALUE), errmsg("parameters that vary inside a group"),
			errhint("Add scale, s_u and options to GROUP BY or PARTITION BY, or pass the same values for all rows."));
}
