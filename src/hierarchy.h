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

/*
 * A node as it is drawn at a scale, by the arguments of typify_node_placeholder, which the function's first are; false
 * when one of them is NULL.
 */
extern bool ty_draw_node(FunctionCallInfo fcinfo, ty_placeholder *p);

#endif
