/* separation.c - see separation.h */
#include "separation.h"

#include <math.h>

/* b as it lies in the frame of a: the centre, and b's own direction as cosine and sine */
typedef struct relation
{
	double along, across;
	double cosine, sine;
} relation;

/* the vector (along, across) of the frame of a, in the plane */
static ty_point
in_the_plane(const ty_oblong *a, double along, double across)
{
	return (ty_point){along * a->ux - across * a->uy, along * a->uy + across * a->ux};
}

/* How far b is beyond the sides of a, along and across it. */
static inline void
beyond_sides(const ty_oblong *a, const ty_oblong *b, const relation *r, double *along, double *across)
{
	double cosine = fabs(r->cosine), sine = fabs(r->sine);

	*along = fabs(r->along) - (a->half_length + b->half_length * cosine + b->half_width * sine);
	*across = fabs(r->across) - (a->half_width + b->half_length * sine + b->half_width * cosine);
}

static inline double
larger(double a, double b)
{
	return a > b ? a : b;
}

/* The unit vector in which b leaves a (or, with sign -1, a leaves b) across the end of a, or across its long side. */
static inline ty_point
way_across_side(const ty_oblong *a, const relation *r, bool along, double sign)
{
	sign = (along ? r->along : r->across) < 0 ? -sign : sign;
	return along ? (ty_point){sign * a->ux, sign * a->uy} : (ty_point){-sign * a->uy, sign * a->ux};
}

/* how far x is outside of -half .. half, 0 inside */
static inline double
outside(double x, double half)
{
	double above = x - half > 0 ? x - half : 0, below = x + half < 0 ? x + half : 0;

	return above + below;
}

/* The corner of b that is nearest to a, which does not overlap it: squared distance, and the way there from a. */
static inline double
nearest_corner(const ty_oblong *a, const ty_oblong *b, const relation *r, ty_point *way)
{
	double length_along = b->half_length * r->cosine, length_across = b->half_length * r->sine;
	double width_along = b->half_width * r->sine, width_across = b->half_width * r->cosine;
	double least = INFINITY, along[4], across[4];
	int nearest = 0;

	for (int corner = 0; corner < 4; corner++)
	{
		double length = corner & 1 ? 1 : -1, width = corner & 2 ? 1 : -1;

		along[corner] = outside(r->along + length * length_along - width * width_along, a->half_length);
		across[corner] = outside(r->across + length * length_across + width * width_across, a->half_width);
	}
	for (int corner = 0; corner < 4; corner++)
	{
		double squared = along[corner] * along[corner] + across[corner] * across[corner];

		nearest = squared < least ? corner : nearest;
		least = squared < least ? squared : least;
	}
	*way = in_the_plane(a, along[nearest], across[nearest]);
	return least;
}

/* Of two that do not overlap, the nearest points are a corner of one and a point of the other. */
static double
corner_distance(const ty_oblong *a, const ty_oblong *b, const relation *ab, const relation *ba, ty_point *away)
{
	ty_point back;
	double squared = nearest_corner(a, b, ab, away), other = nearest_corner(b, a, ba, &back);
	double distance;

	if (other < squared)
	{
		squared = other;
		*away = (ty_point){-back.x, -back.y};
	}
	distance = sqrt(squared);
	if (distance > 0)
		*away = (ty_point){away->x / distance, away->y / distance};
	return distance;
}

/*
 * Whether the corner of b that is nearest to the side of a, along or across it, lies before that side: then it is as far
 * from a as from the line through the side. beyond: along rather than across.
 */
static inline bool
stands_before_side(const ty_oblong *a, const ty_oblong *b, const relation *r, bool along)
{
	double towards = along ? r->along : r->across;
	double length = (along ? r->cosine : r->sine) * towards > 0 ? -b->half_length : b->half_length;
	double width = (along ? -r->sine : r->cosine) * towards > 0 ? -b->half_width : b->half_width;

	if (along)
		return fabs(r->across + length * r->sine + width * r->cosine) <= a->half_width;
	return fabs(r->along + length * r->cosine - width * r->sine) <= a->half_length;
}

double
ty_lack(const ty_oblong *a, const ty_oblong *b, double gap, ty_point *away)
{
	double dx = b->x - a->x, dy = b->y - a->y;
	double cosine = a->ux * b->ux + a->uy * b->uy, sine = a->ux * b->uy - a->uy * b->ux;
	relation ab = {dx * a->ux + dy * a->uy, dy * a->ux - dx * a->uy, cosine, sine};
	relation ba = {-(dx * b->ux + dy * b->uy), -(dy * b->ux - dx * b->uy), cosine, -sine};
	double along_a, across_a, along_b, across_b, distance, exact;
	bool from_b, along;
	ty_point way;

	beyond_sides(a, b, &ab, &along_a, &across_a);
	beyond_sides(b, a, &ba, &along_b, &across_b);
	from_b = larger(along_b, across_b) > larger(along_a, across_a);
	distance = from_b ? larger(along_b, across_b) : larger(along_a, across_a);
	if (distance >= gap)
		return 0;
	along = from_b ? along_b > across_b : along_a > across_a;
	*away = from_b ? way_across_side(b, &ba, along, -1) : way_across_side(a, &ab, along, 1);
	if (!(distance > 0) || (from_b ? stands_before_side(b, a, &ba, along) : stands_before_side(a, b, &ab, along)))
		return gap - distance;
	exact = corner_distance(a, b, &ab, &ba, &way);
	if (exact > distance)
	{
		distance = exact;
		*away = way;
	}
	return distance >= gap ? 0 : gap - distance;
}

double
ty_extent(const ty_oblong *box, ty_point n)
{
	return box->half_length * fabs(n.x * box->ux + n.y * box->uy) +
		   box->half_width * fabs(n.y * box->ux - n.x * box->uy);
}
