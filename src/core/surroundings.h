/*
 * surroundings.h - the segments of lines around a place, at hand for a walk from there: in single precision, all of
 * them looked at in each step.
 *
 * Places that are asked for one after the other are mostly near one another: the segments of a square around the first
 * one are kept, and those near the next ones are picked from them.
 */
#ifndef TY_SURROUNDINGS_H
#define TY_SURROUNDINGS_H

#include "barrier.h"
#include "separation.h"

/* Segments counted from a place, from (x, y) by (dx, dy); no longer than it takes to pass by. */
typedef struct ty_segment_set
{
	size_t count, capacity;
	float *x, *y, *dx, *dy;
	float *inverse;	  /* of the squared length */
	float *squared;	  /* distance from the place that was asked for last */
	uint32_t *number; /* as ty_segment_ends knows it */
} ty_segment_set;

typedef struct ty_surroundings
{
	const ty_barrier_lines *lines; /* NULL: there are none */
	double usual;				   /* how far around a place segments are usually wanted */
	double unit;				   /* of single precision, in units of the ground: half the side of the square */
	ty_point middle;			   /* of the square */
	ty_segment_set square;
	ty_point home; /* the place that was asked for last */
	ty_segment_set near;
} ty_surroundings;

/* Nothing is at hand yet. Whatever follows: ty_surroundings_free. */
void ty_surroundings_begin(const ty_barrier_lines *lines, double usual, ty_surroundings *s);
void ty_surroundings_free(ty_surroundings *s);

/*
 * Picks the segments that come nearer to home than limit, and maybe a few that come as near but for a thousandth.
 * TY_TOO_MANY: they cannot be numbered.
 */
ty_status ty_survey(ty_surroundings *s, ty_point home, double limit);

/* Of those picked, places counted from home: how near the nearest comes, and the unit vector away from there. */
double ty_nearest_segment(ty_surroundings *s, ty_point place, ty_point *away);
/*
 * By how much a rectangle with that half diagonal is nearer to the nearest than gap, and the unit vector away from it.
 * Where one crosses it: by what it takes to get across the line nearest to its centre.
 */
double ty_lack_beside_segments(ty_surroundings *s, const ty_oblong *box, double radius, double gap, ty_point *away);
/* Whether one lies between home and the place. */
bool ty_is_behind(const ty_surroundings *s, ty_point place);

#endif
