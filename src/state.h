/*
 * state.h - what an aggregate keeps of a group: the measures of its buildings, in any order.
 */
#ifndef TY_STATE_H
#define TY_STATE_H

#include "barriers.h"
#include "compat.h"
#include "core/measure.h"
#include "core/outline.h"
#include "core/placeholder.h"

typedef struct ty_state
{
	/* what a row needs is in one cache line: the rows of many small groups come in any order and wait for memory */
	size_t count, capacity;
	ty_building *buildings; /* the first ones, or an array of their own */
	uint64 generation;		/* of the call's parameters when they were last found equal to these */
	int32 srid;
	Oid geometry_type;
	/* [capacity] what placeholders are drawn with, NULL for a building that has none; NULL while no building has one */
	ty_outline **outlines;
	double *importance;		/* [capacity] of the buildings; NULL as long as all are 1 */
	MemoryContext context;	/* of the state and its arrays */
	double metres_per_unit; /* of the SRID */
	ty_parameters parameters;
	Oid hierarchy;			  /* table in which typify_write_hierarchy puts the nodes, */
	int32 group_id;			  /* those of this group */
	ty_barrier_set *barriers; /* of the parameters; NULL too in a state that another process sent without them */
	ty_building first[FLEXIBLE_ARRAY_MEMBER];
} ty_state;

/* Makes an empty state in the context. */
extern ty_state *ty_state_new(MemoryContext context, const ty_parameters *parameters, int32 srid,
							  double metres_per_unit, Oid geometry_type);

/* Room for more buildings behind the last one. */
extern void ty_state_reserve(ty_state *s, size_t more);

/* The state's last building is drawn with a copy of this outline. */
extern void ty_state_give_outline(ty_state *s, const ty_outline *outline);

/* Sets the importance of the last building, which is 1 otherwise. */
extern void ty_state_set_importance(ty_state *s, double importance);

static inline void
ty_state_add(ty_state *s, const ty_building *building)
{
	if (unlikely(s->count == s->capacity))
		ty_state_reserve(s, 1);
	s->buildings[s->count++] = *building;
	if (unlikely(s->outlines != NULL))
		s->outlines[s->count - 1] = NULL;
	if (unlikely(s->importance != NULL))
		s->importance[s->count - 1] = 1;
}

/* Raises the error of two SRIDs in a group where the state's is another. */
extern void ty_state_check_srid(const ty_state *s, int32 srid);

/* Appends a copy of what b holds but for its barriers, which a must have; b stays as it is. */
extern void ty_state_merge(ty_state *a, const ty_state *b);

/* In the current context; an error where a bytea cannot hold it. */
extern bytea *ty_state_serialize(const ty_state *s);

/* Makes the state in the current context; nothing of the value is kept. */
extern ty_state *ty_state_deserialize(bytea *value);

#endif
