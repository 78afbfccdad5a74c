/* pool.c - see pool.h */
#include "pool.h"

#include "miscadmin.h"
#include "utils/memutils.h"

#include "backend.h"

/*
 * The first buildings lie behind the pool, in one piece of this size: where rows come sorted by group, each group of ten
 * has a pool for itself.
 */
#define POOL_SIZE 1024
#define FIRST_BUILDINGS ((POOL_SIZE - offsetof(ty_pool, first)) / sizeof(ty_building))

/* Buildings are numbered in 32 bits. */
#define MOST_BUILDINGS PG_UINT32_MAX

/* --- pools of a call --- */

ty_pool *
ty_pool_new(MemoryContext context)
{
	ty_pool *pool = MemoryContextAlloc(context, POOL_SIZE);

	memset(pool, 0, offsetof(ty_pool, first));
	pool->context = context;
	pool->capacity = FIRST_BUILDINGS;
	pool->buildings = pool->first;
	return pool;
}

/* A pool that is gone with its context leaves the list, which lives longer. */
static void
forget(void *argument)
{
	ty_pool *pool = argument, **link = &pool->list->first;

	while (*link != pool)
		link = &(*link)->next;
	*link = pool->next;
	if (pool->list->current == pool)
		pool->list->current = NULL;
}

static ty_pool *
add_pool(ty_pools *pools, MemoryContext context)
{
	ty_pool *pool = ty_pool_new(context);

	pool->list = pools;
	pool->next = pools->first;
	pools->first = pool;
	pool->on_reset.func = forget;
	pool->on_reset.arg = pool;
	MemoryContextRegisterResetCallback(context, &pool->on_reset);
	return pool;
}

ty_pool *
ty_pool_of(ty_pools *pools, MemoryContext context)
{
	ty_pool *pool = pools->first;

	while (pool != NULL && pool->context != context)
		pool = pool->next;
	pools->current = pool != NULL ? pool : add_pool(pools, context);
	return pools->current;
}

/* --- columns of the log --- */

/* Sizes are powers of two: that is what a memory context hands out anyway. */
void
ty_pool_reserve(ty_pool *pool, size_t more)
{
	size_t size = 2 * POOL_SIZE;

	if (more <= pool->capacity - pool->count)
		return;
	if (more > MOST_BUILDINGS - pool->count)
		ereport(ERROR, errcode(ERRCODE_PROGRAM_LIMIT_EXCEEDED),
				errmsg("groups that are typified together have more than %u buildings", MOST_BUILDINGS),
				errhint("SET enable_hashagg = off, or typify fewer groups in one statement."));
	while (size / sizeof(ty_building) < pool->count + more)
		size *= 2;
	if (pool->buildings == pool->first)
	{
		pool->buildings = MemoryContextAllocHuge(pool->context, size);
		memcpy(pool->buildings, pool->first, pool->count * sizeof(ty_building));
	}
	else
		pool->buildings = repalloc_huge(pool->buildings, size);
	pool->capacity = size / sizeof(ty_building);
	if (pool->group != NULL)
		pool->group = repalloc_huge(pool->group, pool->capacity * sizeof(uint32));
	if (pool->importance != NULL)
		pool->importance = repalloc_huge(pool->importance, pool->capacity * sizeof(double));
	if (pool->outlines != NULL)
		pool->outlines = repalloc_huge(pool->outlines, pool->capacity * sizeof(ty_outline *));
}

/* Of the buildings from number `from` on. */
static void
clear_importance(ty_pool *pool, size_t from)
{
	for (size_t i = from; i < pool->count; i++)
		pool->importance[i] = 1;
}

static void
clear_outlines(ty_pool *pool, size_t from)
{
	for (size_t i = from; i < pool->count; i++)
		pool->outlines[i] = NULL;
}

void
ty_pool_set_importance(ty_pool *pool, size_t building, double importance)
{
	if (pool->importance == NULL)
	{
		pool->importance = MemoryContextAllocHuge(pool->context, pool->capacity * sizeof(double));
		clear_importance(pool, 0);
	}
	pool->importance[building] = importance;
}

void
ty_pool_set_outline(ty_pool *pool, size_t building, ty_outline *outline)
{
	if (pool->outlines == NULL)
	{
		pool->outlines = MemoryContextAllocHuge(pool->context, pool->capacity * sizeof(ty_outline *));
		clear_outlines(pool, 0);
	}
	pool->outlines[building] = outline;
}

static void
set_groups(ty_pool *pool, size_t from, size_t count, uint32 group)
{
	for (size_t i = from; i < from + count; i++)
		pool->group[i] = group;
}

void
ty_pool_append(ty_pool *pool, uint32 group, const ty_building *buildings, size_t count)
{
	size_t from = pool->count;

	ty_pool_reserve(pool, count);
	memcpy(pool->buildings + from, buildings, count * sizeof(ty_building));
	pool->count += count;
	if (pool->group != NULL)
		set_groups(pool, from, count, group);
	if (pool->importance != NULL)
		clear_importance(pool, from);
	if (pool->outlines != NULL)
		clear_outlines(pool, from);
}

uint32
ty_pool_begin_group(ty_pool *pool)
{
	if (pool->groups == 1)
	{
		pool->group = MemoryContextAllocHuge(pool->context, pool->capacity * sizeof(uint32));
		set_groups(pool, 0, pool->count, 0);
	}
	return pool->groups++;
}

/* --- sorting by group --- */

static void
check_interrupts_at(size_t step)
{
	if (step % 65536 == 0)
		CHECK_FOR_INTERRUPTS();
}

/* Finds where each group is to lie, and gives each place the number of the building that belongs there. */
static void
find_places(ty_pool *pool, uint32 *origin)
{
	uint32 *start = pool->start, sum = 0;

	memset(start, 0, ((size_t) pool->groups + 1) * sizeof(uint32));
	for (size_t i = 0; i < pool->count; i++)
		start[pool->group[i]]++;
	for (size_t g = 0; g <= pool->groups; g++)
		start[g] = sum += start[g];
	/* from behind, so that each group's buildings stay in the order in which they came */
	for (size_t i = pool->count; i-- > 0;)
	{
		check_interrupts_at(i);
		origin[--start[pool->group[i]]] = (uint32) i;
	}
}

/* Takes an element of each column. */
static inline void
move_building(ty_pool *pool, size_t to, size_t from)
{
	pool->buildings[to] = pool->buildings[from];
	if (unlikely(pool->importance != NULL))
		pool->importance[to] = pool->importance[from];
	if (unlikely(pool->outlines != NULL))
		pool->outlines[to] = pool->outlines[from];
}

/* The cycle of the permutation that begins at a place; origin of its places becomes the places themselves. */
static void
follow_cycle(ty_pool *pool, uint32 *origin, uint32 first)
{
	ty_building building = pool->buildings[first];
	double importance = pool->importance != NULL ? pool->importance[first] : 1;
	ty_outline *outline = pool->outlines != NULL ? pool->outlines[first] : NULL;
	uint32 place = first;

	while (origin[place] != first)
	{
		uint32 from = origin[place];

		check_interrupts_at(from);
		move_building(pool, place, from);
		origin[place] = place;
		place = from;
	}
	origin[place] = place;
	pool->buildings[place] = building;
	if (pool->importance != NULL)
		pool->importance[place] = importance;
	if (pool->outlines != NULL)
		pool->outlines[place] = outline;
}

/* In place, since a few groups may be nearly all of the memory there is. After an interrupt nobody reads the pool. */
static void
sort_by_group(ty_pool *pool)
{
	uint32 *origin = MemoryContextAllocHuge(pool->context, pool->count * sizeof(uint32));

	if (pool->start != NULL)
		pfree(pool->start);
	pool->start = NULL;
	pool->start = MemoryContextAllocHuge(pool->context, ((size_t) pool->groups + 1) * sizeof(uint32));
	find_places(pool, origin);
	for (size_t i = 0; i < pool->count; i++)
		if (origin[i] != i)
			follow_cycle(pool, origin, (uint32) i);
	for (size_t g = 0; g < pool->groups; g++)
		set_groups(pool, pool->start[g], pool->start[g + 1] - pool->start[g], (uint32) g);
	pool->sorted = pool->count;
	pfree(origin);
}

size_t
ty_pool_gather(ty_pool *pool, uint32 group)
{
	if (pool->group == NULL)
		return 0;
	if (unlikely(pool->sorted != pool->count))
		sort_by_group(pool);
	return pool->start[group];
}
