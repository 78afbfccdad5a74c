/* mesh_check.c - the invariants of the mesh, for tests and assertions. See mesh.h. */
#include "mesh_internal.h"

static bool
is_unused(const ty_mesh *mesh, uint32_t t)
{
	const uint32_t *v = mesh->triangles[t].vertex;

	return v[0] == TY_NONE && v[1] == TY_NONE && v[2] == TY_NONE;
}

static const char *
check_half_edge(const ty_mesh *mesh, uint32_t h)
{
	uint32_t g = ty_opposite(mesh, h);
	uint32_t a = ty_origin(mesh, h), b = ty_target(mesh, h);

	if (g >= ty_half_edge(mesh->used_triangles, 0) || ty_corner_of(g) > 2 || is_unused(mesh, ty_triangle_of(g)))
		return "a half-edge's opposite does not exist";
	if (ty_opposite(mesh, g) != h)
		return "two half-edges do not agree that they are opposite";
	if (ty_origin(mesh, g) != b || ty_target(mesh, g) != a)
		return "opposite half-edges have different ends";
	if (a != TY_GHOST && (a >= mesh->vertices || mesh->vertex[a].edge == TY_NONE))
		return "a triangle has a vertex that is not in the mesh";
	if (ty_mesh_violates(mesh, h))
		return "an edge is not Delaunay, or the hull turns inwards";
	return NULL;
}

/* a hull vertex lies strictly between its neighbours where the hull is straight */
static const char *
check_hull(const ty_mesh *mesh, uint32_t h)
{
	uint32_t v = ty_origin(mesh, h);
	uint32_t before = ty_origin(mesh, ty_previous_in_triangle(h));
	uint32_t after = ty_target(mesh, ty_next_in_triangle(ty_opposite(mesh, h)));
	ty_position b = mesh->vertex[before].position, p = mesh->vertex[v].position, a = mesh->vertex[after].position;

	if (before == after || ty_turn(mesh, before, v, after) != 0)
		return NULL;
	if (((int64_t) p.x - b.x) * ((int64_t) a.x - p.x) + ((int64_t) p.y - b.y) * ((int64_t) a.y - p.y) <= 0)
		return "a straight hull folds back";
	return NULL;
}

static const char *
check_triangle(const ty_mesh *mesh, uint32_t t)
{
	const uint32_t *v = mesh->triangles[t].vertex;
	int ghosts = (v[0] == TY_GHOST) + (v[1] == TY_GHOST) + (v[2] == TY_GHOST);
	const char *fault = NULL;

	if (ghosts > 1)
		return "a triangle has two ghosts";
	if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0])
		return "a triangle has one vertex twice";
	for (uint32_t h = ty_half_edge(t, 0); h <= ty_half_edge(t, 2) && fault == NULL; h++)
	{
		fault = check_half_edge(mesh, h);
		if (fault == NULL && ty_target(mesh, h) == TY_GHOST)
			fault = check_hull(mesh, h);
	}
	if (fault == NULL && ghosts == 0 && ty_turn(mesh, v[0], v[1], v[2]) <= 0)
		fault = "a triangle is not counter-clockwise";
	return fault;
}

static const char *
check_vertices(const ty_mesh *mesh)
{
	size_t live = 0;

	for (size_t v = 0; v < mesh->vertices; v++)
	{
		uint32_t h = mesh->vertex[v].edge;

		if (h == TY_NONE)
			continue;
		live++;
		if (mesh->live > 1 &&
			(h >= ty_half_edge(mesh->used_triangles, 0) || ty_corner_of(h) > 2 || ty_origin(mesh, h) != v))
			return "a vertex names a half-edge that does not start at it";
	}
	return live == mesh->live ? NULL : "the number of live vertices is wrong";
}

const char *
ty_mesh_check(const ty_mesh *mesh)
{
	const char *fault = check_vertices(mesh);
	size_t triangles = 0;

	for (uint32_t t = 0; t < mesh->used_triangles && fault == NULL; t++)
		if (!is_unused(mesh, t))
		{
			triangles++;
			fault = check_triangle(mesh, t);
		}
	if (fault == NULL && triangles != 2 * mesh->live - 2)
		fault = "the number of triangles breaks Euler's formula";
	return fault;
}
