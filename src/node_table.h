/*
 * node_table.h - the nodes of a hierarchy written into its table.
 */
#ifndef TY_NODE_TABLE_H
#define TY_NODE_TABLE_H

#include "compat.h"
#include "core/group.h"
#include "state.h"

/*
 * Builds the hierarchy of a group and adds its nodes to the table that the state says. Returns a typify_hierarchy_made.
 * Raises an error, before anything is built, for a table that is not as typify_build_hierarchy makes it, or that the
 * user may not insert into.
 */
extern Datum ty_write_nodes(FunctionCallInfo fcinfo, const ty_gathered *g, const ty_input *input);

#endif
