/*
 * compat.h - PostgreSQL as all files of this side include it; every difference between versions 14 to 18 is here.
 */
#ifndef TY_COMPAT_H
#define TY_COMPAT_H

#include "postgres.h"
#include "fmgr.h"

#if PG_VERSION_NUM < 140000
#error "typify needs PostgreSQL 14 or later"
#endif

#if PG_VERSION_NUM >= 160000
#include "varatt.h"
#endif

/* 18 asks whether a deferrable key will do */
#if PG_VERSION_NUM >= 180000
#define ty_primary_key_of(relation) RelationGetPrimaryKeyIndex(relation, false)
#else
#define ty_primary_key_of(relation) RelationGetPrimaryKeyIndex(relation)
#endif

/* 16 can leave out indexes that only sum up */
#if PG_VERSION_NUM >= 160000
#define ty_insert_index_tuples(target, slot, estate) \
	list_free(ExecInsertIndexTuples(target, slot, estate, false, false, NULL, NIL, false))
#else
#define ty_insert_index_tuples(target, slot, estate) \
	list_free(ExecInsertIndexTuples(target, slot, estate, false, false, NULL, NIL))
#endif

/* 15 refuses unknown settings of a name, where 14 warns */
#if PG_VERSION_NUM >= 150000
#define ty_reserve_settings(name) MarkGUCPrefixReserved(name)
#else
#define ty_reserve_settings(name) EmitWarningsOnPlaceholders(name)
#endif

#endif
