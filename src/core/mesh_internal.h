/* mesh_internal.h - what the files of the mesh share */
#ifndef TY_MESH_INTERNAL_H
#define TY_MESH_INTERNAL_H

#include "mesh.h"
#include "predicates.h"

/* makes two half-edges the two sides of one edge */
static inline void
ty_mesh_bond(ty_mesh *mesh, uint32_t h, uint32_t g)
{
	mesh->triangles[h / 3].adjacent[h % 3] = g;
	mesh->triangles[g / 3].adjacent[g % 3] = h;
}

static inline bool
ty_mesh_is_ghost(const ty_mesh *mesh, uint32_t t)
{
	const uint32_t *v = mesh->triangles[t].vertex;

	return v[0] == TY_GHOST || v[1] == TY_GHOST || v[2] == TY_GHOST;
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

#endif
