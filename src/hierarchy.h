/*
 * hierarchy.h - a group's hierarchy as a PostgreSQL value.
 */
#ifndef TY_BACKEND_HIERARCHY_H
#define TY_BACKEND_HIERARCHY_H

#include "compat.h"
#include "core/group.h"

/*
 * The nodes of a group of buildings as the array of typify_node that the function returns, in the current context. An
 * error when it would exceed 1 GB, before anything is built.
 */
extern Datum ty_node_array(FunctionCallInfo fcinfo, const ty_input *input, const ty_parameters *p);

#endif
