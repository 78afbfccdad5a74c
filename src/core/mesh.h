/*
 * mesh.h - the Delaunay mesh of the current vertices, restored locally after every collapse (spec 2.2).
 *
 * Vertices are numbered by rank. Triangles are one flat array; half-edge h = 4 * triangle + corner runs
 * from vertex[corner] to the next corner. Every hull edge carries a ghost triangle whose third vertex is
 * TY_GHOST, so the mesh is a closed surface and no operation has a special case for the hull. A collinear
 * (or two-point) mesh consists of ghosts alone: a chain.
 *
 * Vertices at one position: the mesh holds the smallest rank of them; the others are not in it (the
 * collapse merges them first, at cost 0).
 */
#ifndef TY_MESH_H
#define TY_MESH_H

#include "environment.h"
#include "grid.h"

#define TY_GHOST UINT32_MAX
#define TY_NONE UINT32_MAX
#define TY_MAX_VERTICES ((size_t) 500000000) /* 2 triangles a vertex, whose half-edges are numbered in 32 bits */

typedef struct ty_triangle
{
	uint32_t vertex[3];	  /* counter-clockwise; at most one is TY_GHOST */
	uint32_t adjacent[3]; /* the opposite half-edge of vertex[i] -> vertex[i + 1] */
} ty_triangle;

/* What mesh and collapse look at together, side by side in memory: a collapse waits for memory, not for arithmetic. */
typedef struct ty_vertex
{
	ty_position position;
	uint32_t edge; /* a half-edge that starts there; TY_NONE: not in the mesh; 0: the only vertex */
	uint32_t size; /* r, how many buildings it represents: the collapse's, the mesh leaves it alone */
} ty_vertex;

/* a half-edge from a vertex, and the corner that it goes to */
typedef struct ty_spoke
{
	uint32_t h, corner;
} ty_spoke;

typedef struct ty_mesh
{
	const ty_environment *env;
	ty_vertex *vertex;		 /* [vertices] borrowed from the caller; the mesh changes positions and edges */
	size_t vertices;		 /* length of vertex */
	size_t live;			 /* vertices in the mesh */
	ty_triangle *triangles;	 /* [2 * vertices - 2] */
	uint32_t used_triangles; /* triangles from here on have never been used */
	uint32_t free_triangle;	 /* list of those given back, linked by adjacent[0], vertices TY_NONE */
	uint32_t *stack;		 /* half-edges to examine */
	size_t stack_count, stack_capacity;
	ty_spoke *ring; /* those of a star, see mesh.c */
	size_t ring_count, ring_capacity;
	uint64_t work; /* steps of all changes: corners of stars and holes, flips, vertices built anew */
	/* may be NULL; told of every edge that a change makes between two old vertices (and of some that it unmakes) */
	void (*edge_made)(void *context, uint32_t a, uint32_t b);
	void *edge_context;
} ty_mesh;

/*
 * Builds the mesh over the given vertices by divide and conquer along the Hilbert order (after Guibas and
 * Stolfi 1985). keys[i] is the Hilbert key of vertex list[i], ascending and without repeats; list NULL means
 * 0 .. n-1. vertex holds `vertices` entries, positions filled in, and must outlive the mesh. On any status but TY_OK
 * nothing is to be freed.
 */
ty_status ty_mesh_build(const ty_environment *env, ty_vertex *vertex, size_t vertices, const uint32_t *list,
						const uint64_t *keys, size_t n, ty_mesh *mesh);
void ty_mesh_free(ty_mesh *mesh);

/*
 * Replaces the ends of the half-edge h, s and t, by one vertex at `to` and restores the Delaunay property. The
 * vertex keeps the smaller of the two numbers. Where another vertex w lies at `to` already, s and t leave
 * the mesh and *met = w, to be merged next; otherwise *met = TY_NONE.
 */
ty_status ty_mesh_collapse(ty_mesh *mesh, uint32_t h, ty_position to, uint32_t *met);

/* The vertex moves to `to` (the second half of a merge at distance 0); otherwise as ty_mesh_collapse. */
ty_status ty_mesh_move(ty_mesh *mesh, uint32_t v, uint32_t renamed, ty_position to, uint32_t *met);

/*
 * n collapses at once, by building the mesh anew: kept[i] comes to place[i], gone[i] leaves; place[i] becomes the
 * former place of kept[i]. No two of the 2 n vertices are the same, and no two vertices may end at one place.
 */
ty_status ty_mesh_collapse_many(ty_mesh *mesh, const uint32_t *kept, const uint32_t *gone, ty_position *place,
								size_t n);
/* Undoes ty_mesh_collapse_many, which must have been the last change. */
ty_status ty_mesh_part_many(ty_mesh *mesh, const uint32_t *kept, const uint32_t *gone, const ty_position *place,
							size_t n);

/* half-edges by number: a corner is 0, 1 or 2; the numbers 4 * triangle + 3 are not used */
static inline uint32_t
ty_half_edge(uint32_t triangle, uint32_t corner)
{
	return 4 * triangle + corner;
}

static inline uint32_t
ty_triangle_of(uint32_t h)
{
	return h / 4;
}

static inline uint32_t
ty_corner_of(uint32_t h)
{
	return h % 4;
}

/* for loops over all half-edges, from 0 to ty_half_edge(used_triangles, 0) */
static inline uint32_t
ty_next_half_edge(uint32_t h)
{
	return ty_corner_of(h) == 2 ? h + 2 : h + 1;
}

/* Walk over the neighbours of v: h = mesh->vertex[v].edge; do { ... } while ((h = ty_next_around(mesh, h)) != first) */
static inline uint32_t
ty_next_in_triangle(uint32_t h)
{
	return ty_corner_of(h) == 2 ? h - 2 : h + 1;
}

static inline uint32_t
ty_previous_in_triangle(uint32_t h)
{
	return ty_corner_of(h) == 0 ? h + 2 : h - 1;
}

static inline uint32_t
ty_origin(const ty_mesh *mesh, uint32_t h)
{
	return mesh->triangles[ty_triangle_of(h)].vertex[ty_corner_of(h)];
}

static inline uint32_t
ty_target(const ty_mesh *mesh, uint32_t h)
{
	return ty_origin(mesh, ty_next_in_triangle(h));
}

static inline uint32_t
ty_opposite(const ty_mesh *mesh, uint32_t h)
{
	return mesh->triangles[ty_triangle_of(h)].adjacent[ty_corner_of(h)];
}

/* the next half-edge that starts at the same vertex, counter-clockwise; its target may be TY_GHOST */
static inline uint32_t
ty_next_around(const ty_mesh *mesh, uint32_t h)
{
	return ty_opposite(mesh, ty_previous_in_triangle(h));
}

/*
 * ty_next_around(), with the target of h on the way. The corners after and before it are read off two-bit digits: a
 * choice among three would be made by branches, guessed wrong every other time.
 */
static inline uint32_t
ty_step_around(const ty_mesh *mesh, uint32_t h, uint32_t *target)
{
	const ty_triangle *t = &mesh->triangles[ty_triangle_of(h)];
	uint32_t corner = ty_corner_of(h);

	*target = t->vertex[9 >> 2 * corner & 3];
	return t->adjacent[18 >> 2 * corner & 3];
}

/* the half-edge from s, which is no ghost, to t; TY_NONE when there is none */
static inline uint32_t
ty_mesh_find_edge(const ty_mesh *mesh, uint32_t s, uint32_t t)
{
	uint32_t first = mesh->vertex[s].edge, h = first;

	do
	{
		if (ty_target(mesh, h) == t)
			return h;
	} while ((h = ty_next_around(mesh, h)) != first);
	return TY_NONE;
}

/*
 * Checks every invariant: adjacency is mutual, triangles are counter-clockwise, every edge is locally
 * Delaunay under the tie rule, the hull is convex, Euler's formula holds. NULL when all hold, else what
 * does not. O(vertices).
 */
const char *ty_mesh_check(const ty_mesh *mesh);

#endif
