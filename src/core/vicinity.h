/*
 * vicinity.h - which of many discs may touch a disc: a packed tree of boxes over the discs by number.
 *
 * Discs whose numbers are near should be near in place, as in the canonical order; large and small ones may be mixed.
 * Discs may come and go: boxes above them grow with those that come, and are fitted anew when told.
 */
#ifndef TY_VICINITY_H
#define TY_VICINITY_H

#include "boxes.h"
#include "environment.h"
#include "measure.h"

typedef struct ty_disc
{
	double x, y, radius; /* radius < 0: not there */
} ty_disc;

typedef struct ty_vicinity
{
	const ty_environment *env;
	ty_disc *discs; /* [count] by number */
	size_t count;
	size_t there;	 /* how many are */
	ty_boxes boxes;	 /* around the discs; empty where there is none */
	uint32_t *found; /* [found_count] what was found, ascending */
	size_t found_count, found_capacity;
	uint32_t *around;	  /* [around_count] whose boxes meet that of the block of discs ... */
	ty_disc *disc_around; /* [around_count] these, which come together here */
	size_t around_count, around_capacity;
	size_t block; /* ... of this number; SIZE_MAX: of none, as after every change */
} ty_vicinity;

/* Room for count discs, numbered from 0; none is there yet. */
ty_status ty_vicinity_begin(const ty_environment *env, size_t count, ty_vicinity *vicinity);
void ty_vicinity_free(ty_vicinity *vicinity);

/* The disc comes, or another takes its place. */
void ty_vicinity_insert(ty_vicinity *vicinity, uint32_t number, ty_point center, double radius);
void ty_vicinity_remove(ty_vicinity *vicinity, uint32_t number);
/* Fits the boxes to what is there: for speed, after many have come and gone. */
void ty_vicinity_fit(ty_vicinity *vicinity);
/* Lists in vicinity->found the discs, but `number` itself, that a disc around center would touch. */
ty_status ty_vicinity_find(ty_vicinity *vicinity, uint32_t number, ty_point center, double radius);
/* Those that the disc touches; cheaper for one after the other. */
ty_status ty_vicinity_find_touching(ty_vicinity *vicinity, uint32_t number);

#endif
