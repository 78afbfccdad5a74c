/*
 * constancy.h - how often an argument can change, so that what is made from it is made no more often.
 */
#ifndef TY_CONSTANCY_H
#define TY_CONSTANCY_H

#include "compat.h"
#include "nodes/plannodes.h"

typedef enum ty_constancy
{
	TY_PER_ROW = 0,
	TY_PER_GROUP, /* one value for all rows of a group; another scan of the same plan may bring another */
	TY_PER_QUERY
} ty_constancy;

/* statement may be NULL: then a scalar sub-select counts as constant for a group only */
extern ty_constancy ty_constancy_of(Node *argument, PlannedStmt *statement);

#endif
