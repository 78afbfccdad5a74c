/*
 * constancy.c - see constancy.h.
 *
 * A scalar sub-select that depends on nothing is an "initplan": it runs once, and its value reaches the argument as
 * an executor parameter. Parameters of a nested loop or of a correlated sub-select look the same but take a
 * new value with every scan. So the plan is searched for the initplan that sets the parameter. In a parallel
 * worker that initplan is with the leader; there the parameters that the worker's plan gets from outside are
 * constant, since another scan starts other workers.
 */
#include "constancy.h"

#include "miscadmin.h"
#include "nodes/primnodes.h"

static bool plan_sets_once(Plan *plan, PlannedStmt *statement, int parameter);

static bool
plans_set_once(List *plans, PlannedStmt *statement, int parameter)
{
	ListCell *cell;

	foreach (cell, plans)
		if (plan_sets_once(lfirst(cell), statement, parameter))
			return true;
	return false;
}

/* An initplan that itself depends on parameters may run again. */
static bool
initplan_sets_once(List *initplans, PlannedStmt *statement, int parameter)
{
	ListCell *cell;

	foreach (cell, initplans)
	{
		SubPlan *initplan = lfirst_node(SubPlan, cell);
		Plan *plan = list_nth(statement->subplans, initplan->plan_id - 1);

		if (list_member_int(initplan->setParam, parameter))
			return plan != NULL && bms_is_empty(plan->extParam);
	}
	return false;
}

static bool
plan_sets_once(Plan *plan, PlannedStmt *statement, int parameter)
{
	if (plan == NULL)
		return false;
	check_stack_depth();
	if (initplan_sets_once(plan->initPlan, statement, parameter) ||
		plan_sets_once(plan->lefttree, statement, parameter) || plan_sets_once(plan->righttree, statement, parameter))
		return true;
	if (IsA(plan, Append))
		return plans_set_once(((Append *) plan)->appendplans, statement, parameter);
	if (IsA(plan, MergeAppend))
		return plans_set_once(((MergeAppend *) plan)->mergeplans, statement, parameter);
	if (IsA(plan, SubqueryScan))
		return plan_sets_once(((SubqueryScan *) plan)->subplan, statement, parameter);
	return false;
}

static bool
set_once(PlannedStmt *statement, int parameter)
{
	if (statement == NULL)
		return false;
	return bms_is_member(parameter, statement->planTree->extParam) ||
		   plan_sets_once(statement->planTree, statement, parameter) ||
		   plans_set_once(statement->subplans, statement, parameter);
}

ty_constancy
ty_constancy_of(Node *argument, PlannedStmt *statement)
{
	while (IsA(argument, RelabelType))
		argument = (Node *) ((RelabelType *) argument)->arg;
	if (IsA(argument, Const))
		return TY_PER_QUERY;
	if (!IsA(argument, Param))
		return TY_PER_ROW;
	if (((Param *) argument)->paramkind == PARAM_EXTERN)
		return TY_PER_QUERY;
	if (((Param *) argument)->paramkind != PARAM_EXEC)
		return TY_PER_ROW;
	return set_once(statement, ((Param *) argument)->paramid) ? TY_PER_QUERY : TY_PER_GROUP;
}
