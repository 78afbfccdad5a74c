/*
 * separation.h - how far two rectangles are apart, and which way they would have to go.
 *
 * Outlines of any other form are kept apart by the rectangle around them: that is never too near.
 */
#ifndef TY_SEPARATION_H
#define TY_SEPARATION_H

#include "measure.h"

/* A rectangle in any direction: centre, unit vector along the length, and half of both sides. */
typedef struct ty_oblong
{
	double x, y;
	double ux, uy;
	double half_length, half_width;
} ty_oblong;

/*
 * By how much two rectangles are nearer than gap > 0: 0 where their distance is gap or more, else at most what it
 * takes to bring them that far apart, along *away, the unit vector in which b leaves a. Rectangles that overlap are
 * taken apart across a side, where that is shortest.
 */
double ty_lack(const ty_oblong *a, const ty_oblong *b, double gap, ty_point *away);

/* half of what the rectangle takes up along the unit vector n */
double ty_extent(const ty_oblong *box, ty_point n);

#endif
