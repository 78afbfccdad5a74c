/*
 * barriers.h - the lines of the option barriers, kept once however many groups and rows they are given for.
 *
 * They may be many megabytes. So a group's state refers to a set of them, which is made of the bytes when they are
 * first seen, and told from others by a hash. Where the option is constant for the query a parallel worker sends the
 * hash alone, and the leader takes the bytes from its own copy of the argument; else they travel with every state.
 */
#ifndef TY_BARRIERS_H
#define TY_BARRIERS_H

#include "compat.h"
#include "core/barrier.h"
#include "core/placeholder.h"

typedef struct ty_barrier_set
{
	MemoryContext context; /* of all that the set has */
	struct ty_barrier_set *next;
	struct ty_barrier_cache *cache; /* in which it is listed */
	MemoryContextCallback on_reset;
	ty_barrier_hash hash;
	int32 srid;
	bool constant; /* for the query: whoever has the plan can find it */
	bool indexed;
	size_t size;
	const unsigned char *payload; /* the stored geometry; NULL once indexed */
	unsigned char *copy;		  /* ... where it is the set's own */
	ty_barrier_lines lines;
} ty_barrier_set;

/* the sets that a call has met and that still exist */
typedef struct ty_barrier_cache
{
	ty_barrier_set *first;
	ty_barrier_set *current; /* the one that was used last; NULL when it is gone */
} ty_barrier_cache;

static inline bool
ty_no_barriers(ty_barrier_hash hash)
{
	return hash.low == 0 && hash.high == 0;
}

static inline bool
ty_same_barriers(ty_barrier_hash a, ty_barrier_hash b)
{
	return a.low == b.low && a.high == b.high;
}

/*
 * Refuses what cannot be barriers: types other than lines and polygons, coordinates that are not finite. Returns the
 * hash, which is 0 for an EMPTY geometry.
 */
extern ty_barrier_hash ty_check_barriers(Datum geometry);

/* The set of the cache with this hash that lives as long as the context, or NULL. */
extern ty_barrier_set *ty_find_barriers(const ty_barrier_cache *cache, MemoryContext context, ty_barrier_hash hash);

/* Whether a set has this hash and lives as long as the context. */
extern bool ty_barriers_serve(const ty_barrier_set *set, MemoryContext context, ty_barrier_hash hash);

/* A new set of a copy of the bytes, in a child of the given context; with that it leaves the cache again. */
extern ty_barrier_set *ty_keep_barriers(ty_barrier_cache *cache, MemoryContext context, ty_barrier_hash hash,
										const void *payload, size_t size);

/*
 * The same for a geometry. constant: for the query. lasting: the argument that it is or lies in, where that stays where
 * it is as long as the context (a constant of the plan or a parameter); else 0. Of such a one there is no copy.
 */
extern ty_barrier_set *ty_keep_barriers_datum(ty_barrier_cache *cache, MemoryContext context, ty_barrier_hash hash,
											  Datum geometry, bool constant, Datum lasting);

/* The set's lines; they are read and indexed when a group is first typified with them. NULL for no set. */
extern const ty_barrier_lines *ty_lines_of_barriers(ty_barrier_set *set);

/* Raises the error of barriers and buildings in different reference systems. set may be NULL. */
extern void ty_check_barrier_srid(const ty_barrier_set *set, int32 srid);

#endif
