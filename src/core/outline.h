/*
 * outline.h - a building's own outline, for placeholders that are drawn with it (spec 3.1 and 4.3).
 *
 * An outline is one polygon in one piece of memory, so that it is copied and sent as bytes: this head, the sizes of
 * its rings, padded to 8 bytes, then their points. Ground units.
 */
#ifndef TY_OUTLINE_H
#define TY_OUTLINE_H

#include "environment.h"
#include "measure.h"
#include "placeholder.h"

typedef struct ty_outline
{
	uint32_t rings; /* >= 1, the shell first, each closed, of at least four points */
	uint32_t points;
	ty_point centre; /* centroid */
	double area;	 /* > 0, of the shell less its holes */
	double ux, uy;	 /* unit vector along the longer side of the minimum-area bounding rectangle */
	ty_point low;	 /* that rectangle from the centre: x along that side, y to the left of it */
	ty_point high;
} ty_outline;

/* size of an outline in bytes; 0 where it would overflow */
size_t ty_outline_size(size_t rings, size_t points);

static inline uint32_t *
ty_outline_ring_sizes(const ty_outline *outline)
{
	return (uint32_t *) (outline + 1);
}

static inline ty_point *
ty_outline_points(const ty_outline *outline)
{
	return (ty_point *) (ty_outline_ring_sizes(outline) + outline->rings + outline->rings % 2);
}

/*
 * Fills in the head of an outline whose rings and points are there. False when it has no area or is not finite; then
 * it cannot be drawn.
 */
ty_status ty_outline_measure(const ty_environment *env, ty_outline *outline, bool *drawable);

/*
 * How large an outline is drawn that stands for members of this statistic and A_n (see ty_drawn_size): scaled as a
 * whole, so that its area is A_n, at most max_area, and its rectangle's short side at least min_side. area: of the
 * outline; width and length: of its minimum-area rectangle.
 */
ty_size ty_outline_drawn_size(const ty_parameters *p, const ty_outline *outline, double statistic, double area);

/* The centre of the minimum-area rectangle, from the outline's centre, when lengths are scaled by factor. */
ty_point ty_outline_box_centre(const ty_outline *outline, double factor);

/* Takes another point for the centre, about which the outline is placed and scaled. */
void ty_outline_set_centre(ty_outline *outline, ty_point centre);

/*
 * Moves the outline's centre to a place and scales it about it, lengths by factor > 0. A factor of 1 at its own
 * centre leaves every point as it is.
 */
void ty_outline_move(ty_outline *outline, ty_point centre, double factor);

#endif
