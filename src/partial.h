/*
 * partial.h - what the leader of a parallel query knows of the arguments of an aggregate that its workers run.
 */
#ifndef TY_PARTIAL_H
#define TY_PARTIAL_H

#include "compat.h"

/*
 * An argument's number from 0, its value, its type, and whether it stays the same for the query. True ends the search.
 */
typedef bool (*ty_argument_visit)(void *context, int argument, Datum value, Oid type, bool per_query);

/*
 * For a combine function: visits the arguments of the partial aggregates that are in the leader's plan, are constant at
 * least until another scan of it, and not NULL. False when no visit ended the search.
 */
extern bool ty_visit_partial_arguments(FunctionCallInfo fcinfo, ty_argument_visit visit, void *context);

#endif
