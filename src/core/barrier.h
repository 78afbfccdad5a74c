/*
 * barrier.h - lines that nothing is merged across: roads, rivers, railways (spec 2.5 and 4.4).
 *
 * Lines are gathered once, in ground units, and indexed once (ty_barrier_lines). For a group those near its box are
 * brought onto its grid (ty_barriers), where whether one lies between two places is decided by whole numbers alone.
 *
 * Touching. A place on a barrier, and an edge along one, would be on neither side. So places count as moved by an
 * infinitesimal (e, e * e) to the right and up, barriers do not: then no place lies on a barrier, none passes through
 * an end of one, and every edge either crosses or does not. What stands on a line belongs to its right side, of a
 * horizontal line to the upper one. Places that are joined by uncrossed edges lie in one cell, that is on one side of
 * every closed barrier, however many edges in a row.
 */
#ifndef TY_BARRIER_H
#define TY_BARRIER_H

#include <string.h>

#include "barrier_squares.h"
#include "boxes.h"
#include "environment.h"
#include "grid.h"
#include "influence.h"
#include "measure.h"

/* points of one line that follow one another; their coordinates stay with the caller */
typedef struct ty_barrier_run
{
	const unsigned char *xy; /* of the first point, at any alignment */
	uint32_t stride;		 /* bytes from point to point */
	uint32_t points;		 /* 2 .. TY_RUN_POINTS */
} ty_barrier_run;

#define TY_RUN_POINTS 9

static inline ty_point
ty_run_point(const ty_barrier_run *run, uint32_t i)
{
	ty_point p;

	memcpy(&p, run->xy + (size_t) i * run->stride, sizeof p);
	return p;
}

typedef struct ty_barrier_lines
{
	const ty_environment *env;
	ty_point origin;		/* the first point: boxes are relative to it */
	ty_point low, high;		/* of all points */
	size_t segments;		/* of all lines, those without length too */
	size_t count, capacity; /* of runs */
	ty_barrier_run *runs;	/* once ended along the Hilbert curve */
	ty_point *points;		/* of these; none before the end */
	ty_boxes boxes;			/* of the runs; none before the end */
} ty_barrier_lines;

/*
 * Lines are handed over one by one; the coordinates must stay where they are until the end:
 *
 *     ty_barrier_lines_begin(&lines, env);
 *     status = ty_barrier_lines_add(&lines, xy, stride, n); ...	// a polygon ring is a line
 *     status = ty_barrier_lines_end(&lines);
 *     ty_barrier_lines_free(&lines);								// whatever the status
 *
 * TY_NOT_FINITE when a coordinate is not finite. A line of a single point is none.
 */
void ty_barrier_lines_begin(ty_barrier_lines *lines, const ty_environment *env);
ty_status ty_barrier_lines_add(ty_barrier_lines *lines, const void *xy, size_t stride, uint32_t n);
ty_status ty_barrier_lines_end(ty_barrier_lines *lines);
void ty_barrier_lines_free(ty_barrier_lines *lines);

/* ---- on the grid of a group ---- */

struct ty_barriers
{
	const ty_environment *env;
	size_t count, capacity;
	ty_barrier_segment *segments;
	ty_boxes boxes;				/* of TY_BOX_FAN segments each */
	ty_barrier_squares squares; /* for short edges */
};

/*
 * Brings those lines onto the grid that come near the box of the n >= 1 positions: ends are snapped as buildings are;
 * lines that leave the surroundings of the grid are cut off there. Edges between places in the box may be asked for.
 * A function of lines, grid and box alone. Any status: ty_barriers_free.
 */
ty_status ty_barriers_fit(const ty_environment *env, const ty_barrier_lines *lines, const ty_grid *grid,
						  const ty_position *position, size_t n, ty_barriers *barriers);
void ty_barriers_free(ty_barriers *barriers);

/* Whether a barrier lies between two places; the same either way, and false for one place. Exact. */
bool ty_barriers_cross(const ty_barriers *barriers, ty_position a, ty_position b);

/*
 * Whether one lies between a and b, between a and merged, or between merged and b, where merged is on the edge from a
 * to b but for a cell in either coordinate. Exact. As influences want it (influence.h).
 */
bool ty_barriers_bar(const ty_barriers *barriers, ty_position a, ty_position b, ty_position merged);

/* Brings what that looks at into the cache, for all of these edges side by side. As influences want it. */
void ty_barriers_fetch(const ty_barriers *barriers, const ty_edge_ends *edge, size_t count);

/* ---- on the ground ---- */

/* how near the nearest line comes to a shape, and where */
typedef struct ty_barrier_gap
{
	double distance;
	ty_point shape, line; /* the nearest two points; not set where distance is 0 or no line is near */
} ty_barrier_gap;

/*
 * The gap between a convex shape (1 to 8 corners in order, of either direction: a point, a line, a polygon with its
 * inside) and the nearest line, 0 where one meets it. distance is `limit` when none is nearer than that.
 */
ty_barrier_gap ty_barrier_lines_gap(const ty_barrier_lines *lines, const ty_point *corners, int count, double limit);

/* As ty_barriers_cross for any two places on the ground, but for the rounding of floating-point arithmetic. */
bool ty_barrier_lines_cross(const ty_barrier_lines *lines, ty_point a, ty_point b);

/* Segments of lines by number, to be looked at again and again. */
typedef struct ty_segments
{
	uint32_t *number; /* [2 * capacity], the first count from the nearest on, from the environment of the lines ... */
	float *distance;  /* ... as these, which are never too far; the caller's to release */
	size_t count, capacity;
} ty_segments;

/* Lists those that come nearer to a place than limit. TY_TOO_MANY: they cannot be numbered. */
ty_status ty_barrier_lines_near(const ty_barrier_lines *lines, ty_point p, double limit, ty_segments *near);
/* As ty_barrier_lines_cross, where no others can lie between. */
bool ty_barrier_segments_cross(const ty_barrier_lines *lines, const uint32_t *segment, size_t count, ty_point a,
							   ty_point b);

static inline void
ty_segment_ends(const ty_barrier_lines *lines, uint32_t segment, ty_point *a, ty_point *b)
{
	const ty_barrier_run *run = &lines->runs[segment / (TY_RUN_POINTS - 1)];

	*a = ty_run_point(run, segment % (TY_RUN_POINTS - 1));
	*b = ty_run_point(run, segment % (TY_RUN_POINTS - 1) + 1);
}

#endif
