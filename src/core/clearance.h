/* clearance.h - how near segments come to a rectangle: one after the other, the nearest so far is kept. */
#ifndef TY_CLEARANCE_H
#define TY_CLEARANCE_H

#include <math.h>
#include <stdbool.h>

#include "separation.h"

/* the nearest segment so far, in the frame of a rectangle: the squared distance, and the way from the segment */
typedef struct ty_clearance
{
	double squared;
	ty_point way;
} ty_clearance;

/* a vector as it is seen along the length of the rectangle and across, and back */
static inline ty_point
ty_into_frame(const ty_oblong *box, double dx, double dy)
{
	return (ty_point){dx * box->ux + dy * box->uy, dy * box->ux - dx * box->uy};
}

static inline ty_point
ty_out_of_frame(const ty_oblong *box, ty_point way)
{
	return (ty_point){way.x * box->ux - way.y * box->uy, way.x * box->uy + way.y * box->ux};
}

static inline double
ty_limited(double x, double half)
{
	double above = x > half ? half : x;

	return above < -half ? -half : above;
}

static inline void
ty_note_way(ty_clearance *c, double dx, double dy)
{
	double squared = dx * dx + dy * dy;

	if (squared < c->squared)
		*c = (ty_clearance){squared, {dx, dy}};
}

/*
 * The segment from p to q beside the rectangle around the origin. Unless they meet, the nearest points are an end of
 * the segment or, of the rectangle, the corner that reaches farthest towards the line.
 */
static inline void
ty_look_at_segment(const ty_oblong *box, ty_point p, ty_point q, ty_clearance *c)
{
	double dx = q.x - p.x, dy = q.y - p.y, turn = p.x * dy - p.y * dx;
	double reach = box->half_length * fabs(dy) + box->half_width * fabs(dx);
	ty_point corner = {(dy > 0) == (turn > 0) ? box->half_length : -box->half_length,
					   (dx > 0) == (turn > 0) ? -box->half_width : box->half_width};
	double along = (corner.x - p.x) * dx + (corner.y - p.y) * dy, squared = dx * dx + dy * dy;

	if (fabs(turn) <= reach && (p.x <= box->half_length || q.x <= box->half_length) &&
		(p.x >= -box->half_length || q.x >= -box->half_length) && (p.y <= box->half_width || q.y <= box->half_width) &&
		(p.y >= -box->half_width || q.y >= -box->half_width))
	{
		*c = (ty_clearance){0, {0, 0}};
		return;
	}
	ty_note_way(c, ty_limited(p.x, box->half_length) - p.x, ty_limited(p.y, box->half_width) - p.y);
	ty_note_way(c, ty_limited(q.x, box->half_length) - q.x, ty_limited(q.y, box->half_width) - q.y);
	if (along > 0 && along < squared)
		ty_note_way(c, corner.x - (p.x + along / squared * dx), corner.y - (p.y + along / squared * dy));
}

#endif
