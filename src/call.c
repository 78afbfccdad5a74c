/* call.c - see call.h */
#include "call.h"

#include "access/parallel.h"
#include "access/xact.h"
#include "nodes/execnodes.h"
#include "nodes/primnodes.h"
#include "optimizer/optimizer.h"
#include "utils/datum.h"

#include "options.h"

#define SCALE 0
#define S_U 1
#define OPTIONS 2
#define BARRIERS 3

/* Options that come out the same for so many rows, and whose barriers have so many bytes, are worth a notice. */
#define ROWS_BEFORE_NOTICE 10
#define LARGE_BARRIERS 32768

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
 * The least constant of the arguments decides how often they are looked at. Where an aggregate runs as a window
 * function nothing is known of them, and they are compared for every row.
 */
static void
find_constancy(ty_call *call, FunctionCallInfo fcinfo, int first)
{
	bool aggregate = AggGetAggref(fcinfo) != NULL;
	PlannedStmt *statement = aggregate ? ((AggState *) fcinfo->context)->ss.ps.state->es_plannedstmt : NULL;

	call->constancy = TY_PER_QUERY;
	for (int i = 0; i < call->given; i++)
	{
		if (i == SCALE && !call->with_scale)
		{
			call->constant[i] = true;
			continue;
		}

		Node *expression = argument_expression(fcinfo, first + i);
		ty_constancy constancy = expression == NULL ? TY_PER_ROW : ty_constancy_of(expression, statement);

		call->constant[i] = constancy == TY_PER_QUERY;
		if (i == OPTIONS)
			call->options_per_row = expression != NULL && constancy == TY_PER_ROW;
		call->constancy = Min(call->constancy, constancy);
	}
}

/* With ORDER BY or DISTINCT arguments come from the tuples that were sorted, also those that are constant. */
static bool
is_sorted(FunctionCallInfo fcinfo)
{
	Aggref *aggregate = AggGetAggref(fcinfo);

	return aggregate != NULL && (aggregate->aggorder != NIL || aggregate->aggdistinct != NIL);
}

ty_call *
ty_call_of(FunctionCallInfo fcinfo, int first, int given, int geometry, bool with_scale)
{
	FmgrInfo *function = fcinfo->flinfo;
	ty_call *call = function->fn_extra;

	if (likely(call != NULL))
		return call;
	call = MemoryContextAllocZero(function->fn_mcxt, sizeof(ty_call));
	call->context = call->group_context = function->fn_mcxt;
	call->with_scale = with_scale;
	call->given = Min(PG_NARGS() - first, given);
	find_constancy(call, fcinfo, first);
	call->sorted = is_sorted(fcinfo);
	ty_srid_cache_begin(&call->srids, function->fn_oid, geometry, function->fn_mcxt);
	ty_pools_begin(&call->pools, function->fn_mcxt);
	function->fn_extra = call;
	return call;
}

static bool
is_number(int argument)
{
	return argument < OPTIONS;
}

static bool
same_arguments(const ty_call *call, const NullableDatum *arguments)
{
	for (int i = 0; i < call->given; i++)
	{
		const NullableDatum *old = &call->arguments[i], *new = &arguments[i];

		if (call->constant[i])
			continue;
		if (old->isnull != new->isnull)
			return false;
		if (!old->isnull &&
			!datum_image_eq(old->value, new->value, is_number(i), is_number(i) ? (int) sizeof(float8) : -1))
			return false;
	}
	return true;
}

/* Options and barriers are copied as they are, out of line or compressed where they are so. */
static void
keep_arguments(ty_call *call, const NullableDatum *arguments)
{
	MemoryContext old = MemoryContextSwitchTo(call->context);

	for (int i = 0; i < call->given; i++)
	{
		NullableDatum *kept = &call->arguments[i];

		if (call->constant[i])
			continue;
		if (call->parsed && !is_number(i) && !kept->isnull)
			pfree(DatumGetPointer(kept->value));
		*kept = arguments[i];
		if (!is_number(i) && !kept->isnull)
			kept->value = datumCopy(kept->value, false, -1);
	}
	MemoryContextSwitchTo(old);
}

static bool
is_given(const ty_call *call, const NullableDatum *arguments, int argument)
{
	return call->given > argument && !arguments[argument].isnull;
}

/* The hash of the argument barriers, which is not found anew while it cannot change. */
static ty_barrier_hash
hash_of_barriers_argument(ty_call *call, const NullableDatum *arguments)
{
	if (!is_given(call, arguments, BARRIERS))
		return (ty_barrier_hash){0, 0};
	if (!call->parsed || !call->constant[BARRIERS])
		call->barriers_argument = ty_check_barriers(arguments[BARRIERS].value);
	return call->barriers_argument;
}

/* Scale, s_u and options. Options that are constant for the query are looked at once: they may have large barriers. */
static void
resolve(ty_call *call, const NullableDatum *arguments)
{
	bool options_given = is_given(call, arguments, OPTIONS);
	Datum options = options_given ? arguments[OPTIONS].value : (Datum) 0;
	double s_u = call->given > S_U ? DatumGetFloat8(arguments[S_U].value) : 0;

	if (call->with_scale && arguments[SCALE].isnull)
		ty_refuse_null("scale");
	if (call->given > S_U && arguments[S_U].isnull)
		ty_refuse_null("s_u");
	if (call->parsed && call->constant[OPTIONS])
	{
		ty_set_s_u(&call->resolved, s_u);
		if (call->with_scale)
			ty_set_scale(&call->resolved, DatumGetFloat8(arguments[SCALE].value));
	}
	else if (call->with_scale)
		ty_resolve_parameters(DatumGetFloat8(arguments[SCALE].value), s_u, options, !options_given, &call->resolved);
	else
		ty_resolve_hierarchy_parameters(s_u, options, !options_given, &call->resolved);
}

static ty_parameters
parse(ty_call *call, const NullableDatum *arguments)
{
	ty_barrier_hash barriers = hash_of_barriers_argument(call, arguments);
	ty_parameters parameters;

	resolve(call, arguments);
	parameters = call->resolved;
	if (ty_no_barriers(barriers))
		return parameters;
	if (!ty_no_barriers(parameters.barriers))
		ereport(ERROR, errcode(ERRCODE_INVALID_PARAMETER_VALUE),
				errmsg("barriers are given as an option and as an argument"), errhint("Leave one of them out."));
	parameters.barriers = barriers;
	return parameters;
}

/*
 * Makes the barriers of the parameters current. They live as long as the call where they are constant, else as long as
 * the group, so that many of them do not pile up.
 */
static void
find_barriers(ty_call *call, const NullableDatum *arguments)
{
	ty_barrier_hash hash = call->parameters.barriers;
	bool argument = is_given(call, arguments, BARRIERS) && ty_same_barriers(call->barriers_argument, hash);
	int from = argument ? BARRIERS : OPTIONS;
	bool constant = call->constant[from];
	Datum value = arguments[from].value, lasting = constant && !call->sorted ? value : (Datum) 0;
	ty_barrier_set *set = ty_find_barriers(&call->barriers, call->group_context, hash);

	if (set == NULL)
		set = ty_keep_barriers_datum(&call->barriers, constant ? call->context : call->group_context, hash,
									 argument ? value : ty_barriers_of_options(value), constant, lasting);
	call->barriers.current = set;
}

static const ty_parameters *
parameters_with_barriers(ty_call *call, const NullableDatum *arguments)
{
	if (ty_no_barriers(call->parameters.barriers))
		call->barriers.current = NULL;
	else if (call->barriers.current == NULL ||
			 !ty_barriers_serve(call->barriers.current, call->group_context, call->parameters.barriers))
		find_barriers(call, arguments);
	return &call->parameters;
}

/*
 * Tells a user, once a statement, of barriers that the server makes anew for every building: of all roads of a country
 * that takes seconds a building. Of a parallel query one process tells it: the leader, if it takes part.
 */
static void
tell_of_repeated_barriers(const ty_call *call)
{
	static TimestampTz told = 0;
	bool mine = IsParallelWorker() ? ParallelWorkerNumber == 0 && !parallel_leader_participation : true;

	if (!mine || told == GetCurrentStatementStartTimestamp() || call->barriers.current == NULL ||
		call->barriers.current->size < LARGE_BARRIERS)
		return;
	told = GetCurrentStatementStartTimestamp();
	ereport(NOTICE, errmsg("options with barriers are made anew for every building"),
			errhint("Pass them as a sub-select, which is made once: "
					"(SELECT typify_options(barriers => ST_Collect(geom)) FROM roads)"));
}

/* Whether the parameters of the row before are those of this row. */
static bool
parameters_stand(ty_call *call, const NullableDatum *arguments, bool group_begins)
{
	if (!call->parsed)
		return false;
	if (call->constancy == TY_PER_QUERY || (call->constancy == TY_PER_GROUP && !group_begins))
		return true;
	if (!same_arguments(call, arguments))
	{
		call->repeated = 0;
		return false;
	}
	if (unlikely(call->options_per_row) && call->repeated++ >= ROWS_BEFORE_NOTICE)
	{
		call->repeated = ROWS_BEFORE_NOTICE;
		tell_of_repeated_barriers(call);
	}
	return true;
}

const ty_parameters *
ty_call_parameters(ty_call *call, const NullableDatum *arguments, bool group_begins)
{
	ty_parameters parameters;

	if (likely(parameters_stand(call, arguments, group_begins)))
		return parameters_with_barriers(call, arguments);
	parameters = parse(call, arguments);
	if (call->constancy != TY_PER_QUERY)
		keep_arguments(call, arguments);
	if (!call->parsed || !ty_same_parameters(&parameters, &call->parameters))
		call->generation++;
	call->parameters = parameters;
	call->parsed = true;
	return parameters_with_barriers(call, arguments);
}

void
ty_refuse_varying_parameters(void)
{
	ereport(ERROR, errcode(ERRCODE_INVALID_PARAMETER_VALUE), errmsg("parameters that vary inside a group"),
			errhint("Add scale, s_u and options to GROUP BY or PARTITION BY, or pass the same values for all rows."));
}
