/* partial.c - see partial.h */
#include "partial.h"

#include "executor/executor.h"
#include "miscadmin.h"
#include "nodes/execnodes.h"
#include "nodes/nodeFuncs.h"
#include "nodes/plannodes.h"

#include "constancy.h"

/* The call among those of an Agg node whose states are the ones that `finish` joins. */
static Aggref *
partial_call(const Agg *node, const Aggref *finish)
{
	ListCell *cell;

	foreach (cell, node->plan.targetlist)
	{
		Aggref *call = (Aggref *) lfirst_node(TargetEntry, cell)->expr;

		if (IsA(call, Aggref) && DO_AGGSPLIT_SERIALIZE(call->aggsplit) && call->aggfnoid == finish->aggfnoid &&
			call->aggtransno == finish->aggtransno)
			return call;
	}
	return NULL;
}

/* The partial aggregate lies straight below the one that finishes it, with sorting and gathering in between. */
static Aggref *
find_partial_call(Plan *plan, const Aggref *finish)
{
	Aggref *call = NULL;

	while (plan != NULL && call == NULL)
	{
		if (IsA(plan, Agg))
			call = partial_call((Agg *) plan, finish);
		if (IsA(plan, Append) && ((Append *) plan)->appendplans != NIL)
			plan = linitial(((Append *) plan)->appendplans);
		else if (IsA(plan, MergeAppend) && ((MergeAppend *) plan)->mergeplans != NIL)
			plan = linitial(((MergeAppend *) plan)->mergeplans);
		else
			plan = plan->lefttree;
	}
	return call;
}

bool
ty_visit_partial_arguments(FunctionCallInfo fcinfo, ty_argument_visit visit, void *context)
{
	Aggref *finish = AggGetAggref(fcinfo);
	AggState *node = (AggState *) fcinfo->context;
	Aggref *call = finish == NULL ? NULL : find_partial_call(node->ss.ps.plan->lefttree, finish);
	bool found = false;

	for (int i = 0; call != NULL && i < list_length(call->args) && !found; i++)
	{
		Expr *argument = list_nth_node(TargetEntry, call->args, i)->expr;
		ty_constancy constancy = ty_constancy_of((Node *) argument, node->ss.ps.state->es_plannedstmt);
		Datum value;
		bool isnull;

		if (constancy == TY_PER_ROW)
			continue;
		value = ExecEvalExprSwitchContext(ExecInitExpr(argument, &node->ss.ps), node->ss.ps.ps_ExprContext, &isnull);
		if (!isnull)
			found = visit(context, i, value, exprType((Node *) argument), constancy == TY_PER_QUERY);
	}
	return found;
}
