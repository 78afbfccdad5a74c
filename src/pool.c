/* pool.c - see pool.h */
#include "pool.h"

#include "miscadmin.h"
#include "utils/memutils.h"

#include "backend.h"

/*
 * The first buildings lie behind the pool, in one piece of this size: where rows come sorted by group, each group has a
 * pool for itself, of which there may be 100 000 one after the other.
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

/* Pools whose list goes stay where they are. */
static void
forget_list(void *argument)
{
	ty_pools *pools = argument;

	for (ty_pool *pool = pools->first; pool != NULL; pool = pool->next)
		pool->list = NULL;
}

void
ty_pools_begin(ty_pools *pools, MemoryContext context)
{
	pools->first = pools->current = NULL;
	pools->on_reset.func = forget_list;
	pools->on_reset.arg = pools;
	MemoryContextRegisterResetCallback(context, &pools->on_reset);
}

/* A pool that is gone with its context leaves the list, which mostly lives longer. */
static void
forget(void *argument)
{
	ty_pool *pool = argument, **link;

	if (pool->list == NULL)
		return;
	link = &pool->list->first;
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

/* Finds where each group is to lie. False: they lie there already, as where the table is in the order of groups. */
static bool
find_starts(const ty_pool *pool, uint32 *start)
{
	bool in_order = true;
	uint32 sum = 0;

	memset(start, 0, ((size_t) pool->groups + 1) * sizeof(uint32));
	for (size_t i = 0; i < pool->count; i++)
	{
		in_order &= i == 0 || pool->group[i - 1] <= pool->group[i];
		start[pool->group[i] + 1]++;
	}
	for (size_t g = 0; g <= pool->groups; g++)
		start[g] = sum += start[g];
	return !in_order;
}

/* Gives each place the number of the building that belongs there; those of a group stay in the order they came in. */
static void
find_origins(const ty_pool *pool, uint32 *start, uint32 *origin)
{
	for (size_t i = 0; i < pool->count; i++)
	{
		if (i % 65536 == 0)
			CHECK_FOR_INTERRUPTS();
		origin[start[pool->group[i]]++] = (uint32) i;
	}
	/* each has come to where the next one starts */
	memmove(start + 1, start, pool->groups * sizeof(uint32));
	start[0] = 0;
}

/*
 * Buildings change places along the cycles of a permutation, where each step waits for memory to say where the next one
 * leads. So this many paths are followed side by side: a million buildings in groups of ten took 57 ms, and take 30.
 */
#define PATHS 32

/* A path begins at a place whose building is held, and ends where that of a path is wanted. */
typedef struct path
{
	uint32 first;
	uint32 place; /* free */
	uint32 from;  /* of the building that belongs there */
	ty_building building;
	double importance;
	ty_outline *outline;
} path;

static inline void
move_building(ty_pool *pool, uint32 place, uint32 from)
{
	pool->buildings[place] = pool->buildings[from];
	if (unlikely(pool->importance != NULL))
		pool->importance[place] = pool->importance[from];
	if (unlikely(pool->outlines != NULL))
		pool->outlines[place] = pool->outlines[from];
}

/* Puts in the building that a path holds. */
static void
put_building(ty_pool *pool, uint32 place, const path *holder)
{
	pool->buildings[place] = holder->building;
	if (pool->importance != NULL)
		pool->importance[place] = holder->importance;
	if (pool->outlines != NULL)
		pool->outlines[place] = holder->outline;
}

/* origin of places whose building is there, or held, is the place itself */
static void
begin_path(const ty_pool *pool, uint32 *origin, uint32 place, path *p)
{
	p->first = p->place = place;
	p->from = origin[place];
	origin[place] = place;
	p->building = pool->buildings[place];
	p->importance = pool->importance != NULL ? pool->importance[place] : 1;
	p->outline = pool->outlines != NULL ? pool->outlines[place] : NULL;
}

/* False at the end of the path. */
static inline bool
follow_path(ty_pool *pool, uint32 *origin, path *p, const path *all)
{
	uint32 from = p->from, next = origin[from];

	if (unlikely(next == from))
	{
		while (all->first != from)
			all++;
		put_building(pool, p->place, all);
		return false;
	}
	move_building(pool, p->place, from);
	__builtin_prefetch(&origin[next]);
	__builtin_prefetch(&pool->buildings[next], 1);
	__builtin_prefetch(&pool->buildings[next].uy, 1); /* mostly in the next cache line */
	origin[from] = from;
	p->place = from;
	p->from = next;
	return true;
}

static void
follow_paths(ty_pool *pool, uint32 *origin, path *paths, int count)
{
	path *open[PATHS];

	for (int i = 0; i < count; i++)
		open[i] = &paths[i];
	for (int left = count; left > 0;)
	{
		CHECK_FOR_INTERRUPTS();
		for (int i = left; i-- > 0;)
			if (!follow_path(pool, origin, open[i], paths))
				open[i] = open[--left];
	}
}

/* Brings each building to its place. */
static void
permute(ty_pool *pool, uint32 *origin)
{
	path paths[PATHS];
	int count = 0;

	for (size_t place = 0; place < pool->count; place++)
	{
		if (origin[place] != place)
			begin_path(pool, origin, (uint32) place, &paths[count++]);
		if (count == PATHS || place == pool->count - 1)
		{
			follow_paths(pool, origin, paths, count);
			count = 0;
		}
	}
}

/* In place, since a few groups may be nearly all of the memory there is. After an interrupt nobody reads the pool. */
static void
bring_together(ty_pool *pool)
{
	uint32 *origin = MemoryContextAllocHuge(pool->context, pool->count * sizeof(uint32));

	find_origins(pool, pool->start, origin);
	permute(pool, origin);
	for (size_t g = 0; g < pool->groups; g++)
		set_groups(pool, pool->start[g], pool->start[g + 1] - pool->start[g], (uint32) g);
	pfree(origin);
}

static void
sort_by_group(ty_pool *pool)
{
	if (pool->start != NULL)
		pfree(pool->start);
	pool->start = NULL;
	pool->start = MemoryContextAllocHuge(pool->context, ((size_t) pool->groups + 1) * sizeof(uint32));
	if (find_starts(pool, pool->start))
		bring_together(pool);
	pool->sorted = pool->count;
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
