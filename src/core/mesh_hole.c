/*
 * mesh_hole.c - taking a vertex out of the mesh: its star leaves a hole, which Delaunay triangles fill.
 *
 * A small hole is filled edge by edge: of all corners the apex is found whose circle holds no other. That takes
 * d^2 tests, and some data has hubs of thousands of corners (a crowd amid a wide ring), which vertex after vertex
 * leaves. So for a large hole the mesh of its corners alone is built by divide and conquer. The triangles that the
 * hole lacks are Delaunay in the whole mesh, hence also among fewer vertices: they are in that mesh, and are what
 * lies on the hole's side of its edges.
 */
#include "mesh_internal.h"

#include <string.h>

/*
 * Most stars have 6 corners. Up to this many d^2 tests cost less than divide and conquer (measured: 6 us each way).
 * Tests set it.
 */
#ifndef TY_SMALL_HOLE
#define TY_SMALL_HOLE 24
#endif

/* A corner of a hole, and the edge from it to the next corner as seen from outside the hole. */
typedef struct corner
{
	uint32_t vertex;
	uint32_t outside; /* half-edge from the next corner to this one */
	uint32_t next;
} corner;

/* The hole that a removed vertex leaves. A small one is split into smaller holes as triangles fill it. */
typedef struct hole
{
	corner *corners;
	size_t count;
	uint32_t open[TY_SMALL_HOLE]; /* first corners of the holes still to fill */
	size_t open_count;
} hole;

/* Takes v's star out of the mesh and lists the corners of the hole, counter-clockwise. */
static void
open_hole(ty_mesh *mesh, uint32_t v, hole *hole)
{
	uint32_t first = mesh->vertex[v].edge, h = first;

	hole->count = 0;
	do
	{
		uint32_t outside = ty_opposite(mesh, ty_next_in_triangle(h));

		hole->corners[hole->count] = (corner){ty_target(mesh, h), outside, (uint32_t) hole->count + 1};
		hole->count++;
		ty_set_edge(mesh, ty_origin(mesh, outside), outside); /* the next corner holds on to the mesh outside */
	} while ((h = ty_next_around(mesh, h)) != first);
	hole->corners[hole->count - 1].next = 0;
	for (size_t i = 0; i < hole->count; i++)
		ty_give_triangle(mesh, ty_triangle_of(ty_opposite(mesh, hole->corners[i].outside)));
	mesh->vertex[v].edge = TY_NONE;
	mesh->live--;
}

/* ---- a small hole ---- */

/* The corner whose triangle with a -> b belongs to the Delaunay mesh: no other corner lies inside its circle. */
static uint32_t
delaunay_apex(const ty_mesh *mesh, const corner *corners, uint32_t a, uint32_t b)
{
	uint32_t va = corners[a].vertex, vb = corners[b].vertex;
	uint32_t apex = TY_NONE, ghost = TY_NONE;

	for (uint32_t i = corners[b].next; i != a; i = corners[i].next)
	{
		uint32_t v = corners[i].vertex;

		if (v == TY_GHOST)
			ghost = i;
		else if (ty_turn(mesh, va, vb, v) > 0 &&
				 (apex == TY_NONE || ty_circle_holds(mesh, va, vb, corners[apex].vertex, v)))
			apex = i;
	}
	return apex != TY_NONE ? apex : ghost;
}

/* the first edge of the hole from a corner on whose two ends are real; TY_NONE if there is none */
static uint32_t
real_edge(const corner *corners, uint32_t start)
{
	uint32_t a = start;

	do
	{
		if (corners[a].vertex != TY_GHOST && corners[corners[a].next].vertex != TY_GHOST)
			return a;
	} while ((a = corners[a].next) != start);
	return TY_NONE;
}

/* Puts the triangle a, b, apex into the hole, which leaves the holes b .. apex and apex .. a. */
static void
split_hole(ty_mesh *mesh, hole *hole, uint32_t a, uint32_t b, uint32_t apex)
{
	corner *corners = hole->corners;
	uint32_t va = corners[a].vertex, vb = corners[b].vertex, vc = corners[apex].vertex;
	uint32_t t = ty_take_triangle(mesh);
	uint32_t copy = (uint32_t) hole->count++; /* of the apex, which is a corner of both holes */
	uint32_t last = b;

	ty_set_triangle(mesh, t, va, vb, vc);
	ty_mesh_bond(mesh, ty_half_edge(t, 0), corners[a].outside);
	while (corners[last].next != apex)
		last = corners[last].next;
	if (last != b)
		ty_tell_edge(mesh, vb, vc);
	if (corners[apex].next != a)
		ty_tell_edge(mesh, vc, va);
	corners[copy] = (corner){vc, ty_half_edge(t, 1), b};
	corners[last].next = copy;
	corners[a].next = apex;
	corners[a].outside = ty_half_edge(t, 2);
	hole->open[hole->open_count++] = b;
	hole->open[hole->open_count++] = a;
}

static ty_status
fill_small_hole(ty_mesh *mesh, hole *hole)
{
	corner *corners = hole->corners;

	hole->open[0] = 0;
	hole->open_count = 1;
	while (hole->open_count > 0)
	{
		uint32_t start = hole->open[--hole->open_count];
		uint32_t second = corners[start].next, a, apex;

		if (corners[second].next == start)
		{
			ty_mesh_bond(mesh, corners[start].outside, corners[second].outside);
			continue;
		}
		a = real_edge(corners, start);
		apex = a == TY_NONE ? TY_NONE : delaunay_apex(mesh, corners, a, corners[a].next);
		if (apex == TY_NONE)
			return TY_BROKEN;
		split_hole(mesh, hole, a, corners[a].next, apex);
		mesh->work += hole->count;
	}
	return TY_OK;
}

/* ---- a large hole ---- */

#define UNVISITED UINT32_MAX

/* The mesh of a hole's corners, and what of it goes into the hole. */
typedef struct patch
{
	ty_mesh mesh;	   /* its vertices are the whole mesh's, their half-edges those of the patch as long as it lives */
	uint32_t *list;	   /* [corners] vertices of the corners but the ghost, ... */
	uint64_t *keys;	   /* ... along the Hilbert curve */
	uint32_t *edge_of; /* [half-edges] 1 + the corner where the hole has this edge; 0: it is none of the hole's */
	uint32_t *becomes; /* [triangles] the triangle of the whole mesh; UNVISITED: it is none of the hole's */
	uint32_t *visited; /* [triangles] those in the hole, in the order they are met */
	size_t visits;
} patch;

static ty_status
allocate_patch(const ty_mesh *mesh, size_t corners, patch *p)
{
	*p = (patch){0};
	p->mesh = (ty_mesh){.env = mesh->env, .vertex = mesh->vertex, .vertices = mesh->vertices};
	p->mesh.triangles = ty_allocate_array(mesh->env, 2 * corners, sizeof *p->mesh.triangles);
	p->list = ty_allocate_array(mesh->env, corners, sizeof *p->list);
	p->keys = ty_allocate_array(mesh->env, corners, sizeof *p->keys);
	p->edge_of = ty_allocate_array(mesh->env, 8 * corners, sizeof *p->edge_of);
	p->becomes = ty_allocate_array(mesh->env, 2 * corners, sizeof *p->becomes);
	p->visited = ty_allocate_array(mesh->env, 2 * corners, sizeof *p->visited);
	if (p->mesh.triangles == NULL || p->list == NULL || p->keys == NULL || p->edge_of == NULL || p->becomes == NULL ||
		p->visited == NULL)
		return TY_NO_MEMORY;
	memset(p->edge_of, 0, 8 * corners * sizeof *p->edge_of);
	memset(p->becomes, 0xff, 2 * corners * sizeof *p->becomes);
	return TY_OK;
}

static void
free_patch(patch *p)
{
	ty_release(p->mesh.env, p->mesh.triangles);
	ty_release(p->mesh.env, p->list);
	ty_release(p->mesh.env, p->keys);
	ty_release(p->mesh.env, p->edge_of);
	ty_release(p->mesh.env, p->becomes);
	ty_release(p->mesh.env, p->visited);
}

static ty_status
build_patch(patch *p, const hole *hole)
{
	size_t n = 0;
	ty_status status;

	for (size_t i = 0; i < hole->count; i++)
		if (hole->corners[i].vertex != TY_GHOST)
		{
			p->list[n] = hole->corners[i].vertex;
			p->keys[n++] = ty_hilbert_key(p->mesh.vertex[hole->corners[i].vertex].position);
		}
	status = ty_sort_keys(p->mesh.env, p->keys, p->list, n);
	return status == TY_OK ? ty_mesh_triangulate(&p->mesh, p->list, p->keys, n) : status;
}

/* Marks the half-edges of the patch that are the hole's edges, seen from inside; false when one is missing. */
static bool
mark_edges(patch *p, const hole *hole)
{
	for (size_t i = 0; i < hole->count; i++)
	{
		uint32_t a = hole->corners[i].vertex, b = hole->corners[hole->corners[i].next].vertex;
		uint32_t h = a == TY_GHOST ? ty_mesh_find_edge(&p->mesh, b, a) : ty_mesh_find_edge(&p->mesh, a, b);

		if (h == TY_NONE)
			return false;
		p->edge_of[a == TY_GHOST ? ty_opposite(&p->mesh, h) : h] = (uint32_t) i + 1;
	}
	return true;
}

static void
visit(ty_mesh *mesh, patch *p, uint32_t t)
{
	p->becomes[t] = ty_take_triangle(mesh);
	p->visited[p->visits++] = t;
}

/* Visits the triangles inside the hole's edges, as many as the hole has room for. */
static bool
visit_inside(ty_mesh *mesh, patch *p, const hole *hole)
{
	size_t room = hole->count - 2;
	uint32_t first = 0;

	while (p->edge_of[first] == 0)
		first++;
	visit(mesh, p, ty_triangle_of(first));
	for (size_t i = 0; i < p->visits; i++)
		for (uint32_t h = ty_half_edge(p->visited[i], 0); h <= ty_half_edge(p->visited[i], 2); h++)
		{
			uint32_t t = ty_triangle_of(ty_opposite(&p->mesh, h));

			if (p->edge_of[h] != 0 || p->becomes[t] != UNVISITED)
				continue;
			if (p->visits == room)
				return false;
			visit(mesh, p, t);
		}
	return p->visits == room;
}

/* Puts what was visited into the hole. */
static void
move_in(ty_mesh *mesh, const patch *p, const hole *hole)
{
	for (size_t i = 0; i < p->visits; i++)
	{
		uint32_t t = p->visited[i];
		const uint32_t *v = p->mesh.triangles[t].vertex;

		ty_set_triangle(mesh, p->becomes[t], v[0], v[1], v[2]);
		for (uint32_t h = ty_half_edge(t, 0); h <= ty_half_edge(t, 2); h++)
		{
			uint32_t g = ty_opposite(&p->mesh, h), moved = ty_half_edge(p->becomes[t], ty_corner_of(h));

			if (p->edge_of[h] != 0)
				ty_mesh_bond(mesh, moved, hole->corners[p->edge_of[h] - 1].outside);
			else
			{
				ty_mesh_bond(mesh, moved, ty_half_edge(p->becomes[ty_triangle_of(g)], ty_corner_of(g)));
				if (h < g)
					ty_tell_edge(mesh, ty_origin(&p->mesh, h), ty_origin(&p->mesh, g));
			}
		}
	}
}

static ty_status
fill_large_hole(ty_mesh *mesh, const hole *hole)
{
	patch p;
	ty_status status = allocate_patch(mesh, hole->count, &p);

	if (status == TY_OK)
		status = build_patch(&p, hole);
	if (status == TY_OK && !(mark_edges(&p, hole) && visit_inside(mesh, &p, hole)))
		status = TY_BROKEN;
	if (status == TY_OK)
		move_in(mesh, &p, hole);
	mesh->work += TY_WORK_OF_BUILDING * hole->count;
	free_patch(&p);
	return status;
}

/* ---- removal ---- */

static size_t
degree(const ty_mesh *mesh, uint32_t v)
{
	uint32_t first = mesh->vertex[v].edge, h = first;
	size_t n = 0;

	do
		n++;
	while ((h = ty_next_around(mesh, h)) != first);
	return n;
}

ty_status
ty_mesh_remove(ty_mesh *mesh, uint32_t v)
{
	corner corners[2 * TY_SMALL_HOLE];
	size_t corner_count = degree(mesh, v);
	hole hole = {.corners = corners};
	ty_status status;

	if (corner_count <= TY_SMALL_HOLE)
	{
		open_hole(mesh, v, &hole);
		return fill_small_hole(mesh, &hole);
	}
	hole.corners = ty_allocate_array(mesh->env, corner_count, sizeof *hole.corners);
	if (hole.corners == NULL)
		return TY_NO_MEMORY;
	open_hole(mesh, v, &hole);
	status = fill_large_hole(mesh, &hole);
	ty_release(mesh->env, hole.corners);
	return status;
}
