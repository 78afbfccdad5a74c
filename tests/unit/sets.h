/*
 * sets.h - the shapes of data that a triangulation or a clustering is known to break on.
 *
 * Small sets are grid positions for the comparison with the reference; large ones are buildings, as a caller has
 * them. Every set is a function of its kind and the generator's state.
 */
#ifndef TY_SETS_H
#define TY_SETS_H

#include "mesh.h"
#include "random.h"

typedef enum small_kind
{
	SMALL_TINY_RANGE, /* coordinates 0 .. 3: everything is degenerate at once */
	SMALL_MODEST_RANGE,
	SMALL_WHOLE_GRID, /* up to 2^30 */
	SMALL_CORNERS,	  /* the four corners of the grid and their neighbours: the largest determinants */
	SMALL_DUPLICATES,
	SMALL_LATTICE,
	SMALL_SHAKEN_LATTICE, /* by one cell */
	SMALL_AXIS_LINE,
	SMALL_DIAGONAL_LINE,
	SMALL_SLANTED_LINE, /* direction (3, 1) */
	SMALL_NEARLY_A_LINE,
	SMALL_CIRCLE, /* exactly cocircular */
	SMALL_RINGS,  /* several circles around one centre */
	SMALL_CLUSTERS_IN_CLUSTERS,
	SMALL_TWO_LINES,
	SMALL_CROSSING_LINES,
	SMALL_HUB_AND_RIM,
	SMALL_PARABOLA,
	SMALL_RECTANGLES, /* rows of houses: equal distances everywhere */
	SMALL_KINDS
} small_kind;

typedef enum large_kind
{
	LARGE_UNIFORM,
	LARGE_CLUSTERED,
	LARGE_HUB,		 /* one point amid a circle of all others */
	LARGE_RING,		 /* a dense crowd amid a wide ring: its outermost points have thousands of neighbours */
	LARGE_TWO_LINES, /* exact, parallel: every vertex of one may see all of the other */
	LARGE_TWIN_ROW,	 /* a row twice, a hair apart: with every merge the whole mesh turns */
	LARGE_SPIRAL,
	LARGE_ONE_POINT,	/* all copies of one */
	LARGE_SLANTED_LINE, /* exactly collinear, not along an axis */
	LARGE_FRACTAL,
	LARGE_SHAKEN_LATTICE,
	LARGE_LATTICE,
	LARGE_KINDS
} large_kind;

extern const char *const small_kind_name[SMALL_KINDS];
extern const char *const large_kind_name[LARGE_KINDS];

/* n positions of the kind, in no order */
void small_set(small_kind kind, random_state *random, ty_position *position, size_t n);
/* sorts into canonical order, as ty_collapse wants it, and gives the keys */
void sort_along_curve(ty_position *position, uint64_t *keys, size_t n);

/* vertices for a mesh, one at each position, and back */
void vertices_at_positions(const ty_position *position, size_t n, ty_vertex *vertex);
void positions_of_vertices(const ty_vertex *vertex, size_t n, ty_position *position);

/* n buildings of the kind with random areas and rectangles and id = index */
void large_set(large_kind kind, random_state *random, ty_building *buildings, size_t n);
/* the same buildings in another order */
void shuffle_buildings(random_state *random, ty_building *buildings, size_t n);

#endif
