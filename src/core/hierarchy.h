/*
 * hierarchy.h - the whole merge sequence of one group as a tree of nodes with life spans over the scale (spec 6.1).
 *
 * A node is a vertex of the mesh for as long as it is there. Leaves are the buildings, numbered 0 .. n - 1 in tree
 * order, so that the members of a node are a range of leaves; inner nodes follow in the order in which they appear.
 */
#ifndef TY_HIERARCHY_H
#define TY_HIERARCHY_H

#include "grid.h"
#include "group.h"
#include "mesh.h"

/* Everything in ground units. */
typedef struct ty_node
{
	uint32_t parent;		 /* TY_NONE: a root */
	uint32_t representative; /* index into the caller's buildings */
	uint32_t member_count, first_leaf;
	double x, y;	   /* the vertex; of a leaf its building's very centroid, off the grid */
	double area;	   /* statistic of the members' areas, unscaled; of a kept one its own */
	double ratio;	   /* of the representative, whatever the shape */
	double ux, uy;	   /* of the representative */
	double cost;	   /* greatest cost of a merge up to that which made the node; 0 for leaves */
	double scale_from; /* alive for scale_from <= scale < scale_to */
	double scale_to;   /* INFINITY for roots */
	bool kept;		   /* the representative is kept: the node stands there, and is drawn with its own area */
} ty_node;

/* Flat arrays; ty_hierarchy_node puts a node together. Merge i makes node n + i. */
typedef struct ty_hierarchy
{
	size_t n, merges;
	const ty_building *buildings; /* the caller's */
	const double *importance;	  /* the caller's, by building, or NULL */
	double source_scale;
	ty_grid grid;
	uint32_t *order;		  /* [n] building by rank */
	uint32_t *leaf;			  /* [n] rank by leaf */
	uint32_t *parent;		  /* [n + merges] by rank, then by merge */
	uint32_t *first;		  /* [n + merges] first leaf, likewise */
	uint32_t *count;		  /* [merges] members */
	uint32_t *representative; /* [merges] rank */
	ty_position *position;	  /* [merges] */
	double *area;			  /* [merges] */
	double *cost;			  /* [merges] */
	double *scale;			  /* [merges] from which on the merge has happened */
	uint32_t *stored;		  /* [merges] the order in which they are best stored */
} ty_hierarchy;

/*
 * The whole way of one group, down to a single vertex where the influences let it. p->scale and p->psi are not looked
 * at, outlines neither; p has no min_area and no keep_area. The arrays come from env; ty_hierarchy_free gives them
 * back.
 */
ty_status ty_hierarchy_build(const ty_environment *env, const ty_input *input, const ty_parameters *p, ty_hierarchy *h);
void ty_hierarchy_free(const ty_environment *env, ty_hierarchy *h);

static inline size_t
ty_hierarchy_nodes(const ty_hierarchy *h)
{
	return h->n + h->merges;
}

ty_node ty_hierarchy_node(const ty_hierarchy *h, size_t node);

/*
 * The order in which nodes are best stored, so that a look-up finds in few pages what it needs: the number of the node
 * at each place. Leaves come first, as they are numbered; inner nodes by lifetime, band, then as their leaves are numbered.
 */
static inline size_t
ty_hierarchy_stored(const ty_hierarchy *h, size_t place)
{
	return place < h->n ? place : h->n + h->stored[place - h->n];
}
/* Fetches what the node at a place takes, some time before it is asked for. place may be beyond the last. */
void ty_hierarchy_fetch(const ty_hierarchy *h, size_t place);

/* Life spans by the scale at which they end: two bands for every doubling of the scale, the last one for roots. */
#define TY_ROOT_BAND 63
int ty_band(double scale, double source_scale);

/*
 * Life spans by how many bands they reach into. Most last a doubling of the scale or two, so that of those which end
 * later than a scale half begin later, too: by this they are told apart.
 */
#define TY_LIFETIMES 5
/* the last band that a life span of a class may end in, when it begins in this one or before */
int ty_last_band(int lifetime, int band);
/* Few live long, and bands of theirs are taken together: how many, and the first of those that a band is taken with. */
int ty_bands_together(int lifetime);
int ty_band_together(int lifetime, int band);
int ty_lifetime(double scale_from, double scale_to, double source_scale);

#endif
