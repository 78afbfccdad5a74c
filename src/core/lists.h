/*
 * lists.h - short lists of numbers, one for each of many owners, that are kept as long as there is room.
 *
 * All are in one piece of memory. When it is full all are forgotten: what is asked for again is found again.
 */
#ifndef TY_LISTS_H
#define TY_LISTS_H

#include "environment.h"

typedef struct ty_lists
{
	const ty_environment *env;
	size_t owners;
	uint32_t *at;	/* [owners] where the list begins in pool: how many, then which */
	uint32_t *pool; /* [capacity], of which `used` are taken */
	size_t used, capacity;
} ty_lists;

/* Room for so many lists of about as many numbers each; none is there yet. Any status: ty_lists_free. */
ty_status ty_lists_begin(const ty_environment *env, size_t owners, size_t numbers_each, ty_lists *lists);
void ty_lists_free(ty_lists *lists);

/* Keeps a list; NULL: it is longer than all the room there is. The result is as ty_lists_get's. */
const uint32_t *ty_lists_keep(ty_lists *lists, uint32_t owner, const uint32_t *numbers, size_t count);
/* Keeps a list and behind it what belongs to each of its numbers: it has twice as many. */
const uint32_t *ty_lists_keep_with(ty_lists *lists, uint32_t owner, const uint32_t *numbers, const float *values,
								   size_t count);
void ty_lists_forget(ty_lists *lists, uint32_t owner);

#define TY_NO_LIST UINT32_MAX

/* How many, then which; true until the next list is kept. NULL: there is none. */
static inline const uint32_t *
ty_lists_get(const ty_lists *lists, uint32_t owner)
{
	return lists->at[owner] == TY_NO_LIST ? NULL : lists->pool + lists->at[owner];
}

#endif
