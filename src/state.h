/*
 * state.h - what an aggregate keeps of a group: the measures of its buildings, in any order.
 */
#ifndef TY_STATE_H
#define TY_STATE_H

#include "compat.h"
#include "core/measure.h"
#include "core/outline.h"
#include "core/placeholder.h"

typedef struct ty_state
{
	MemoryContext context; /* of the state and its array */
	ty_parameters parameters;
	uint64 generation; /* of the call's parameters when they were last found equal to these */
	int32 srid;
	Oid geometry_type;
	double metres_per_unit; /* of the SRID */
	size_t count, capacity;
	ty_building *buildings;
	/* [capacity] what placeholders are drawn with, NULL for a building that has none; NULL while no building has one */
	ty_outline **outlines;
} ty_state;

/* Makes an empty state in the context. */
extern ty_state *ty_state_new(MemoryContext context, const ty_parameters *parameters, int32 srid,
							  double metres_per_unit, Oid geometry_type);

/* Room for more buildings behind the last one. */
extern void ty_state_reserve(ty_state *s, size_t more);

/* The state's last building has an outline, or NULL: memory of the state's context, which from now on is its own. */
extern void ty_state_give_outline(ty_state *s, ty_outline *outline);

static inline void
ty_state_add(ty_state *s, const ty_building *building)
{
	if (unlikely(s->count == s->capacity))
		ty_state_reserve(s, 1);
	s->buildings[s->count++] = *building;
	if (unlikely(s->outlines != NULL))
		s->outlines[s->count - 1] = NULL;
}

/* Raises the error of two SRIDs in a group where the state's is another. */
extern void ty_state_check_srid(const ty_state *s, int32 srid);

/* Appends a copy of what b holds; b stays as it is. */
extern void ty_state_merge(ty_state *a, const ty_state *b);

/* In the current context; an error where a bytea cannot hold it. */
extern bytea *ty_state_serialize(const ty_state *s);

/* Makes the state in the current context; nothing of the value is kept. */
extern ty_state *ty_state_deserialize(bytea *value);

#endif
