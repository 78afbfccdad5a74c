/* mesh_internal.h - what the files of the mesh share */
#ifndef TY_MESH_INTERNAL_H
#define TY_MESH_INTERNAL_H

#include "mesh.h"
#include "predicates.h"

/* Building a mesh takes this many times the work of a corner or flip, per vertex. */
#define TY_WORK_OF_BUILDING 8

/* makes two half-edges the two sides of one edge */
static inline void
ty_mesh_bond(ty_mesh *mesh, uint32_t h, uint32_t g)
{
	mesh->triangles[ty_triangle_of(h)].adjacent[ty_corner_of(h)] = g;
	mesh->triangles[ty_triangle_of(g)].adjacent[ty_corner_of(g)] = h;
}

static inline uint32_t
ty_take_triangle(ty_mesh *mesh)
{
	uint32_t t = mesh->free_triangle;

	if (t == TY_NONE)
		return mesh->used_triangles++;
	mesh->free_triangle = mesh->triangles[t].adjacent[0];
	return t;
}

static inline void
ty_give_triangle(ty_mesh *mesh, uint32_t t)
{
	mesh->triangles[t].vertex[0] = TY_NONE;
	mesh->triangles[t].vertex[1] = TY_NONE;
	mesh->triangles[t].vertex[2] = TY_NONE;
	mesh->triangles[t].adjacent[0] = mesh->free_triangle;
	mesh->free_triangle = t;
}

static inline void
ty_set_edge(ty_mesh *mesh, uint32_t v, uint32_t h)
{
	if (v != TY_GHOST)
		mesh->vertex[v].edge = h;
}

/* names the corners of a triangle and makes it known to them */
static inline void
ty_set_triangle(ty_mesh *mesh, uint32_t t, uint32_t a, uint32_t b, uint32_t c)
{
	mesh->triangles[t].vertex[0] = a;
	mesh->triangles[t].vertex[1] = b;
	mesh->triangles[t].vertex[2] = c;
	ty_set_edge(mesh, a, ty_half_edge(t, 0));
	ty_set_edge(mesh, b, ty_half_edge(t, 1));
	ty_set_edge(mesh, c, ty_half_edge(t, 2));
}

static inline void
ty_tell_edge(const ty_mesh *mesh, uint32_t a, uint32_t b)
{
	if (mesh->edge_made != NULL && a != TY_GHOST && b != TY_GHOST)
		mesh->edge_made(mesh->edge_context, a, b);
}

static inline bool
ty_mesh_is_ghost(const ty_mesh *mesh, uint32_t t)
{
	const uint32_t *v = mesh->triangles[t].vertex;

	return v[0] == TY_GHOST || v[1] == TY_GHOST || v[2] == TY_GHOST;
}

/* orientation of three vertices, see ty_orientation */
static inline int64_t
ty_turn(const ty_mesh *mesh, uint32_t a, uint32_t b, uint32_t c)
{
	return ty_orientation(mesh->vertex[a].position, mesh->vertex[b].position, mesh->vertex[c].position);
}

/* whether the circle through a, b, c holds d, see ty_in_circle */
static inline bool
ty_circle_holds(const ty_mesh *mesh, uint32_t a, uint32_t b, uint32_t c, uint32_t d)
{
	return ty_in_circle(mesh->vertex[a].position, mesh->vertex[b].position, mesh->vertex[c].position,
						mesh->vertex[d].position, a, b, c, d);
}

/*
 * Flips the edge of h = a -> b with the triangles a, b, c and b, a, d: they become a, d, c (in the place of
 * h's) and d, b, c, each starting with the corner named first. corner receives a, d, b, c. edge[] is left.
 */
void ty_mesh_flip(ty_mesh *mesh, uint32_t h, uint32_t corner[4]);

/* Whether the edge of h breaks the Delaunay rule, or for an edge to the ghost, whether the hull turns inwards. */
bool ty_mesh_violates(const ty_mesh *mesh, uint32_t h);

/* Fills an empty mesh with triangles over n >= 1 vertices; list and keys as in ty_mesh_build. */
ty_status ty_mesh_triangulate(ty_mesh *mesh, const uint32_t *list, const uint64_t *keys, size_t n);

/* Takes a vertex out of a mesh that is not a chain, and fills the hole with Delaunay triangles. In mesh_hole.c. */
ty_status ty_mesh_remove(ty_mesh *mesh, uint32_t v);

#endif
