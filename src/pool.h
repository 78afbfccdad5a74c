/*
 * pool.h - the buildings of all groups that an aggregate call has under way, in one log.
 *
 * There may be 100 000 groups of about ten, whose rows come in any order. A group with room of its own is then far away
 * in memory for every row; the end of the log never is. When the first group is read, the log is sorted by group. A
 * million buildings in such groups took 1.28 s with room of their own, and 1.00 s with the log; as one group 1.44 s.
 */
#ifndef TY_POOL_H
#define TY_POOL_H

#include "compat.h"
#include "core/measure.h"
#include "core/outline.h"

typedef struct ty_pool
{
	MemoryContext context; /* of all that the pool has, and of the groups' states */
	size_t count, capacity;
	ty_building *buildings; /* the first ones, or an array of their own */
	uint32 *group;			/* [capacity] the number of each building's group; NULL as long as there is one */
	double *importance;		/* [capacity] of the buildings; NULL as long as all are 1 */
	/* [capacity] what placeholders are drawn with, NULL for a building that has none; NULL while no building has one */
	ty_outline **outlines;
	uint32 groups;				 /* numbered from 0 */
	size_t sorted;				 /* the buildings lie by group if these are all */
	uint32 *start;				 /* [groups + 1] then: the first building of each group */
	struct ty_variant *variants; /* what groups are typified with (state.h), the newest first */
	struct ty_pool *next;
	struct ty_pools *list; /* in which it is; or NULL */
	MemoryContextCallback on_reset;
	ty_building first[FLEXIBLE_ARRAY_MEMBER];
} ty_pool;

/* The pools of one aggregate call: one for each context, of which GROUPING SETS have several at once. */
typedef struct ty_pools
{
	ty_pool *first;
	ty_pool *current; /* the one that was used last; NULL when it is gone */
	MemoryContextCallback on_reset;
} ty_pools;

/*
 * An empty list, which is memory of this context. Where that is gone before the pools are, as under an extension that
 * calls aggregates by itself, they are in no list from then on.
 */
extern void ty_pools_begin(ty_pools *pools, MemoryContext context);

/* An empty pool in the context, in no list. */
extern ty_pool *ty_pool_new(MemoryContext context);

/* The context's pool, which becomes current; made when there is none. It leaves the list with its context. */
extern ty_pool *ty_pool_of(ty_pools *pools, MemoryContext context);

/* Begins a group; returns its number. */
extern uint32 ty_pool_begin_group(ty_pool *pool);

/* Room for more buildings behind the last one. */
extern void ty_pool_reserve(ty_pool *pool, size_t more);

/* Where the next building is written, which ty_pool_add takes in. */
static inline ty_building *
ty_pool_next(ty_pool *pool)
{
	if (unlikely(pool->count == pool->capacity))
		ty_pool_reserve(pool, 1);
	return &pool->buildings[pool->count];
}

static inline void
ty_pool_add(ty_pool *pool, uint32 group)
{
	size_t last = pool->count++;

	if (pool->group != NULL)
		pool->group[last] = group;
	if (unlikely(pool->importance != NULL))
		pool->importance[last] = 1;
	if (unlikely(pool->outlines != NULL))
		pool->outlines[last] = NULL;
}

/* Adds copies of buildings. */
extern void ty_pool_append(ty_pool *pool, uint32 group, const ty_building *buildings, size_t count);

/* Sets the importance of a building, which is 1 otherwise. */
extern void ty_pool_set_importance(ty_pool *pool, size_t building, double importance);

/* Sets the outline of a building, which has none otherwise; it must be of the pool's context. */
extern void ty_pool_set_outline(ty_pool *pool, size_t building, ty_outline *outline);

/* The place of a group's first building, behind which its others lie until one is added. Buildings may move. */
extern size_t ty_pool_gather(ty_pool *pool, uint32 group);

#endif
