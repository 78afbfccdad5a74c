/*
 * node_table.c - see node_table.h
 *
 * Two million nodes as an array, taken apart again and inserted one by one, cost twice as much as making them. So they
 * go to the table as those of COPY do: rows are gathered and written a page at a time. COPY's other services are not
 * there, so a table that has use for them (triggers, row security, checks, columns with defaults) is refused.
 */
#include "node_table.h"

#include <math.h>

#include "access/heapam.h"
#include "access/relation.h"
#include "access/tableam.h"
#include "access/xact.h"
#include "catalog/pg_class.h"
#include "catalog/pg_type.h"
#include "executor/executor.h"
#include "funcapi.h"
#include "miscadmin.h"
#include "utils/acl.h"
#include "utils/geo_decls.h"
#include "utils/lsyscache.h"
#include "utils/memutils.h"
#include "utils/rel.h"
#include "utils/rls.h"

#include "backend.h"
#include "core/hierarchy.h"
#include "hierarchy.h"
#include "options.h"
#include "progress.h"

/* Columns of the table: group_id, the fields of typify_node, place. */
enum
{
	COLUMN_GROUP_ID = 0,
	COLUMN_NODE,
	COLUMN_PLACE = COLUMN_NODE + TY_NODE_FIELDS,
	COLUMNS
};

/* Fields of the composite typify_hierarchy_made. */
enum
{
	MADE_COUNT = 0,
	MADE_STATE,
	MADE_REACH,
	MADE_WEST,
	MADE_SOUTH,
	MADE_EAST,
	MADE_NORTH,
	MADE_FIELDS
};

/* Rows that are written together; COPY's number, about 150 kB of them. */
#define ROWS_TOGETHER 1000

typedef struct node_table
{
	Relation relation;
	EState *estate;
	ResultRelInfo *target;
	BulkInsertState bulk;
	CommandId command;
	int waiting; /* rows in slots */
	TupleTableSlot *slots[ROWS_TOGETHER];
	Point places[ROWS_TOGETHER];
} node_table;

/* --- whether the table may be written to --- */

static void
check_column(const node_table *t, int column, Oid type, bool nullable)
{
	TupleDesc shape = RelationGetDescr(t->relation);

	if (column >= shape->natts || TupleDescAttr(shape, column)->attisdropped ||
		TupleDescAttr(shape, column)->atttypid != type || (nullable && TupleDescAttr(shape, column)->attnotnull))
		ereport(ERROR, errcode(ERRCODE_WRONG_OBJECT_TYPE),
				errmsg("the columns of \"%s\" are not those of a hierarchy", RelationGetRelationName(t->relation)),
				errhint("Columns of a hierarchy stay as typify_build_hierarchy makes them; build it anew."));
}

/* What the user added may stay as long as it takes NULL. */
static void
check_columns(const node_table *t)
{
	static const Oid types[TY_NODE_FIELDS] = {INT4OID,	 INT4OID,	BOOLOID,   INT8OID,	  INT4OID,
											  INT4OID,	 FLOAT8OID, FLOAT8OID, FLOAT8OID, FLOAT8OID,
											  FLOAT8OID, FLOAT8OID, FLOAT8OID, FLOAT8OID, FLOAT8OID};
	TupleDesc shape = RelationGetDescr(t->relation);

	check_column(t, COLUMN_GROUP_ID, INT4OID, false);
	for (int i = 0; i < TY_NODE_FIELDS; i++)
		check_column(t, COLUMN_NODE + i, types[i], i == TY_NODE_PARENT);
	check_column(t, COLUMN_PLACE, POINTOID, false);
	for (int i = COLUMNS; i < shape->natts; i++)
		if (!TupleDescAttr(shape, i)->attisdropped &&
			(TupleDescAttr(shape, i)->attnotnull || TupleDescAttr(shape, i)->atthasdef))
			ereport(ERROR, errcode(ERRCODE_FEATURE_NOT_SUPPORTED),
					errmsg("column \"%s\" of \"%s\" has a default or is NOT NULL",
						   NameStr(TupleDescAttr(shape, i)->attname), RelationGetRelationName(t->relation)),
					errhint("Columns that are added to a hierarchy must take NULL: drop the default, or NOT NULL."));
}

/* Rows are written past what the server does for those of an INSERT. */
static void
check_plain(Relation relation)
{
	const TupleConstr *constraints = RelationGetDescr(relation)->constr;
	const TriggerDesc *triggers = relation->trigdesc;
	const char *thing = NULL;

	if (triggers != NULL && (triggers->trig_insert_before_row || triggers->trig_insert_after_row ||
							 triggers->trig_insert_before_statement || triggers->trig_insert_after_statement))
		thing = "triggers on INSERT";
	else if (check_enable_rls(RelationGetRelid(relation), InvalidOid, false) == RLS_ENABLED)
		thing = "row-level security";
	else if (constraints != NULL && constraints->num_check > 0)
		thing = "CHECK constraints";
	if (thing != NULL)
		ereport(ERROR, errcode(ERRCODE_FEATURE_NOT_SUPPORTED),
				errmsg("\"%s\" has %s, which a hierarchy cannot have", RelationGetRelationName(relation), thing),
				errhint("Remove them, or put them on a table that is made from the hierarchy."));
}

static void
check_table(const node_table *t)
{
	Relation relation = t->relation;
	AclResult granted = pg_class_aclcheck(RelationGetRelid(relation), GetUserId(), ACL_INSERT);

	if (relation->rd_rel->relkind != RELKIND_RELATION)
		ereport(ERROR, errcode(ERRCODE_WRONG_OBJECT_TYPE),
				errmsg("\"%s\" is not a table", RelationGetRelationName(relation)),
				errhint("Nodes are written to the table that typify_build_hierarchy made."));
	if (granted != ACLCHECK_OK)
		aclcheck_error(granted, OBJECT_TABLE, RelationGetRelationName(relation));
	check_columns(t);
	check_plain(relation);
}

/* --- writing --- */

static void
open_table(node_table *t, Oid table)
{
	PreventCommandIfReadOnly("typify_build_hierarchy");
	PreventCommandIfParallelMode("typify_build_hierarchy");
	memset(t, 0, sizeof(*t));
	t->relation = try_relation_open(table, RowExclusiveLock);
	if (t->relation == NULL)
		ereport(ERROR, errcode(ERRCODE_UNDEFINED_TABLE), errmsg("hierarchy is a table that does not exist"),
				errhint("Name the table that typify_build_hierarchy made."));
	check_table(t);
	t->estate = CreateExecutorState();
	t->target = makeNode(ResultRelInfo);
	InitResultRelInfo(t->target, t->relation, 1, NULL, 0);
	ExecOpenIndices(t->target, false);
	t->bulk = GetBulkInsertState();
	t->command = GetCurrentCommandId(true);
}

static TupleTableSlot *
next_slot(node_table *t)
{
	if (t->slots[t->waiting] == NULL)
		t->slots[t->waiting] = table_slot_create(t->relation, NULL);
	return t->slots[t->waiting];
}

static void
add_to_indexes(node_table *t)
{
	for (int i = 0; i < t->waiting; i++)
	{
		ty_insert_index_tuples(t->target, t->slots[i], t->estate);
		ResetPerTupleExprContext(t->estate);
	}
}

/* The server may leave garbage behind in the current context. */
static void
write_waiting(node_table *t)
{
	MemoryContext old = MemoryContextSwitchTo(GetPerTupleMemoryContext(t->estate));

	CHECK_FOR_INTERRUPTS();
	table_multi_insert(t->relation, t->slots, t->waiting, t->command, 0, t->bulk);
	MemoryContextSwitchTo(old);
	ResetPerTupleExprContext(t->estate);
	if (t->target->ri_NumIndices > 0)
		add_to_indexes(t);
	for (int i = 0; i < t->waiting; i++)
		ExecClearTuple(t->slots[i]);
	t->waiting = 0;
}

static void
close_table(node_table *t)
{
	write_waiting(t);
	for (int i = 0; i < ROWS_TOGETHER && t->slots[i] != NULL; i++)
		ExecDropSingleTupleTableSlot(t->slots[i]);
	FreeBulkInsertState(t->bulk);
	table_finish_bulk_insert(t->relation, 0);
	ExecCloseIndices(t->target);
	FreeExecutorState(t->estate);
	relation_close(t->relation, NoLock);
}

static void
add_node(node_table *t, const ty_gathered *g, const ty_hierarchy *h, size_t number, const ty_node *node, double reach)
{
	TupleTableSlot *slot = next_slot(t);
	Point *place = &t->places[t->waiting];
	int columns = slot->tts_tupleDescriptor->natts;

	ExecClearTuple(slot);
	memset(slot->tts_isnull, false, COLUMNS * sizeof(bool));
	memset(slot->tts_isnull + COLUMNS, true, (columns - COLUMNS) * sizeof(bool));
	slot->tts_values[COLUMN_GROUP_ID] = Int32GetDatum(g->state->group_id);
	ty_node_values(h, number, node, slot->tts_values + COLUMN_NODE, slot->tts_isnull + COLUMN_NODE);
	*place =
		ty_node_place(node->x, node->y, reach, node->scale_from, node->scale_to, g->variant->parameters.source_scale);
	slot->tts_values[COLUMN_PLACE] = PointPGetDatum(place);
	ExecStoreVirtualTuple(slot);
	t->waiting++;
	if (t->waiting == ROWS_TOGETHER)
		write_waiting(t);
}

/* --- what the groups' table says of them --- */

typedef struct summary
{
	double reach, west, south, east, north;
} summary;

static void
sum_up(summary *made, const ty_node *node, double reach)
{
	made->reach = fmax(made->reach, reach);
	made->west = fmin(made->west, node->x);
	made->south = fmin(made->south, node->y);
	made->east = fmax(made->east, node->x);
	made->north = fmax(made->north, node->y);
}

static int64
state_of(const ty_gathered *g)
{
	int64 hash = 0;

	for (size_t i = 0; i < g->count; i++)
		hash ^= ty_hash_building(&g->buildings[i], g->importance == NULL ? 1 : g->importance[i]);
	return hash;
}

static Datum
made_datum(FunctionCallInfo fcinfo, const ty_gathered *g, const summary *made)
{
	TupleDesc shape;
	Datum values[MADE_FIELDS];
	bool nulls[MADE_FIELDS] = {false};

	if (get_call_result_type(fcinfo, NULL, &shape) != TYPEFUNC_COMPOSITE)
		elog(ERROR, "typify_write_hierarchy is not declared as this library expects");
	shape = BlessTupleDesc(shape);
	if (shape->natts != MADE_FIELDS)
		elog(ERROR, "typify_hierarchy_made is not declared as this library expects");
	values[MADE_COUNT] = Int64GetDatum((int64) g->count);
	values[MADE_STATE] = Int64GetDatum(state_of(g));
	values[MADE_REACH] = Float8GetDatum(made->reach);
	values[MADE_WEST] = Float8GetDatum(made->west);
	values[MADE_SOUTH] = Float8GetDatum(made->south);
	values[MADE_EAST] = Float8GetDatum(made->east);
	values[MADE_NORTH] = Float8GetDatum(made->north);
	return HeapTupleGetDatum(heap_form_tuple(shape, values, nulls));
}

Datum
ty_write_nodes(FunctionCallInfo fcinfo, const ty_gathered *g, const ty_input *input)
{
	summary made = {0, INFINITY, INFINITY, -INFINITY, -INFINITY};
	node_table *t = palloc(sizeof(node_table));
	ty_hierarchy h;

	open_table(t, g->state->hierarchy);
	ty_build_hierarchy(input, &g->variant->parameters, &h);
	for (size_t place = 0; place < ty_hierarchy_nodes(&h); place++)
	{
		size_t number = ty_hierarchy_stored(&h, place);
		ty_node node;
		double reach;

		ty_hierarchy_fetch(&h, place + TY_FETCHED_AHEAD);
		node = ty_hierarchy_node(&h, number);
		reach = ty_node_reach(node.area, node.ratio, g->variant->parameters.psi);
		sum_up(&made, &node, reach);
		add_node(t, g, &h, number, &node, reach);
	}
	ty_hierarchy_free(&ty_backend_environment, &h);
	close_table(t);
	pfree(t);
	return made_datum(fcinfo, g, &made);
}
