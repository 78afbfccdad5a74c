/*
 * hierarchy.h - a group's hierarchy as a PostgreSQL value.
 */
#ifndef TY_BACKEND_HIERARCHY_H
#define TY_BACKEND_HIERARCHY_H

#include "compat.h"
#include "utils/geo_decls.h"

#include "core/group.h"
#include "core/hierarchy.h"

/* The fields of the composite typify_node, in order; in the table of nodes they are columns. */
enum
{
	TY_NODE_NODE = 0,
	TY_NODE_PARENT,
	TY_NODE_KEPT,
	TY_NODE_REPRESENTATIVE,
	TY_NODE_MEMBER_COUNT,
	TY_NODE_FIRST_LEAF,
	TY_NODE_X,
	TY_NODE_Y,
	TY_NODE_AREA,
	TY_NODE_RATIO,
	TY_NODE_UX,
	TY_NODE_UY,
	TY_NODE_COST,
	TY_NODE_SCALE_FROM,
	TY_NODE_SCALE_TO,
	TY_NODE_FIELDS
};

/* How many nodes before its turn what a node takes is fetched. */
#define TY_FETCHED_AHEAD 16

/* Sets the fields of a node of this number; of nulls only that of the parent. */
extern void ty_node_values(const ty_hierarchy *h, size_t number, const ty_node *node, Datum *values, bool *nulls);

/* How far a node reaches that is drawn with the area factor 1, in ground units: half the diagonal. */
extern double ty_node_reach(double area, double ratio, double psi);
/* Where a node stands in the index; see hierarchy.c. */
extern Point ty_node_place(double x, double y, double reach, double scale_from, double scale_to, double source_scale);

/* A hash of what a hierarchy takes from a building. */
extern int64 ty_hash_building(const ty_building *building, double importance);

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
