/*
 * state.h - what an aggregate keeps of a group: the measures of its buildings, in any order.
 */
#ifndef TY_STATE_H
#define TY_STATE_H

#include "backend.h"
#include "barriers.h"
#include "compat.h"
#include "core/mesh.h"
#include "core/outline.h"
#include "core/placeholder.h"
#include "pool.h"

/* What a group is typified with; groups with the same share it. */
typedef struct ty_variant
{
	struct ty_variant *next; /* of the pool */
	uint64 generation;		 /* of the call's parameters when they were last found equal to these */
	int32 srid;
	Oid geometry_type;
	ty_barrier_set *barriers; /* of the parameters; NULL too in a state that another process sent without them */
	double metres_per_unit;	  /* of the SRID */
	ty_parameters parameters;
} ty_variant;

/* What the aggregate passes around. Small: it lies beside the server's own entry of the group. */
typedef struct ty_state
{
	ty_pool *pool;
	ty_variant *variant;
	uint32 number;	/* in the pool */
	uint32 count;	/* buildings */
	Oid hierarchy;	/* table in which typify_write_hierarchy puts the nodes, */
	int32 group_id; /* those of this group */
} ty_state;

/* A group's buildings side by side; good until a building is added to its pool. */
typedef struct ty_gathered
{
	const ty_state *state;
	const ty_variant *variant;
	size_t count;
	const ty_building *buildings;
	const double *importance;	 /* NULL: all are 1 */
	ty_outline *const *outlines; /* NULL: there are none */
} ty_gathered;

/* The pool's variant with the parameters, SRID and barriers of this one, made as a copy of it where there is none. */
extern ty_variant *ty_variant_like(ty_pool *pool, const ty_variant *like);

/* Makes the state of a group that begins. */
extern ty_state *ty_state_new(ty_pool *pool, ty_variant *variant);

/* Takes in the building that was written to the pool's next place. */
static inline void
ty_state_add(ty_state *s)
{
	if (unlikely(s->count == TY_MAX_VERTICES))
		ty_check_status(TY_TOO_MANY);
	s->count++;
	ty_pool_add(s->pool, s->number);
}

/* Raises the error of two SRIDs in a group where the state's is another. */
extern void ty_state_check_srid(const ty_state *s, int32 srid);

/* Appends a copy of what b holds but for its barriers, which a must have; b stays as it is. */
extern void ty_state_merge(ty_state *a, const ty_state *b);

extern ty_gathered ty_gather(const ty_state *s);

/* In the current context; an error where a bytea cannot hold it. */
extern bytea *ty_state_serialize(const ty_state *s);

/* Makes the state in the current context; nothing of the value is kept. */
extern ty_state *ty_state_deserialize(bytea *value);

#endif
