/*
 * vicinity.h - which of many discs may touch a disc: cells of squares, as wide as what lies in them.
 *
 * Discs of like size share a level of cells, so that a town of houses with a few halls in it costs no more than a
 * town of houses. Discs may come and go. What is found comes in no order that means anything, but always the same.
 */
#ifndef TY_VICINITY_H
#define TY_VICINITY_H

#include "environment.h"
#include "measure.h"

#define TY_VICINITY_LEVELS 48

typedef struct ty_disc
{
	double x, y, radius;
	int32_t column, row;				 /* of its cell */
	int8_t level;						 /* -1: not there */
	uint32_t next, previous;			 /* in its cell's bucket */
	uint32_t level_next, level_previous; /* on its level */
} ty_disc;

typedef struct ty_vicinity
{
	const ty_environment *env;
	ty_point origin;
	double smallest;   /* side of a cell of level 0, doubled from level to level */
	ty_disc *discs;	   /* [count] by number */
	uint32_t *buckets; /* [mask + 1] first disc */
	uint32_t mask;
	size_t count;
	uint32_t level_first[TY_VICINITY_LEVELS];
	size_t level_count[TY_VICINITY_LEVELS];
	double level_radius[TY_VICINITY_LEVELS]; /* no disc of the level was ever larger */
	uint32_t *found;						 /* [found_count] what ty_vicinity_find found */
	size_t found_count, found_capacity;
} ty_vicinity;

/* Room for count discs, numbered from 0, around points between low and high; none is there yet. */
ty_status ty_vicinity_begin(const ty_environment *env, size_t count, ty_point low, ty_point high,
							double smallest_radius, ty_vicinity *vicinity);
void ty_vicinity_free(ty_vicinity *vicinity);

void ty_vicinity_insert(ty_vicinity *vicinity, uint32_t number, ty_point center, double radius);
void ty_vicinity_remove(ty_vicinity *vicinity, uint32_t number);
/* Lists in vicinity->found the discs, but `number` itself, that a disc around center would touch. */
ty_status ty_vicinity_find(ty_vicinity *vicinity, uint32_t number, ty_point center, double radius);

#endif
