/*
 * mesh.c - see mesh.h
 *
 * Three files make the mesh. mesh_build.c builds it; this one changes it; mesh_check.c checks it. A collapse
 * goes one of three ways:
 *
 *   contract  both stars lie inside the hull and stay star-shaped seen from the new place: the two triangles
 *             at the edge vanish, the rest is renamed, flips restore the Delaunay property. Nearly always.
 *   refill    otherwise both ends are removed, their holes are filled with Delaunay triangles, and the new
 *             vertex is inserted.
 *   rebuild   what is left when the mesh changes between a chain and a surface, or a hole is so large that
 *             building anew is cheaper.
 *
 * Ghost triangles follow the same rules with orientation in the place of in-circle.
 */
#include "mesh_internal.h"

/* Filling a hole of d corners takes d^2 tests; this many times the live vertices cost as much as building anew. */
#define REBUILD_RATIO 32

/* ---- triangles ---- */

static uint32_t
take_triangle(ty_mesh *mesh)
{
	uint32_t t = mesh->free_triangle;

	if (t == TY_NONE)
		return mesh->used_triangles++;
	mesh->free_triangle = mesh->triangles[t].adjacent[0];
	return t;
}

static void
give_triangle(ty_mesh *mesh, uint32_t t)
{
	mesh->triangles[t].vertex[0] = TY_NONE;
	mesh->triangles[t].vertex[1] = TY_NONE;
	mesh->triangles[t].vertex[2] = TY_NONE;
	mesh->triangles[t].adjacent[0] = mesh->free_triangle;
	mesh->free_triangle = t;
}

static void
set_edge(ty_mesh *mesh, uint32_t v, uint32_t h)
{
	if (v != TY_GHOST)
		mesh->edge[v] = h;
}

/* names the corners of a triangle and makes it known to them */
static void
set_triangle(ty_mesh *mesh, uint32_t t, uint32_t a, uint32_t b, uint32_t c)
{
	mesh->triangles[t].vertex[0] = a;
	mesh->triangles[t].vertex[1] = b;
	mesh->triangles[t].vertex[2] = c;
	set_edge(mesh, a, 3 * t);
	set_edge(mesh, b, 3 * t + 1);
	set_edge(mesh, c, 3 * t + 2);
}

static ty_status
push(ty_mesh *mesh, uint32_t h)
{
	if (mesh->stack_count == mesh->stack_capacity)
	{
		size_t capacity = 2 * mesh->stack_capacity;
		uint32_t *stack = ty_reallocate_array(mesh->env, mesh->stack, capacity, sizeof *stack);

		if (stack == NULL)
			return TY_NO_MEMORY;
		mesh->stack = stack;
		mesh->stack_capacity = capacity;
	}
	mesh->stack[mesh->stack_count++] = h;
	return TY_OK;
}

static void
tell_edge(const ty_mesh *mesh, uint32_t a, uint32_t b)
{
	if (mesh->edge_made != NULL && a != TY_GHOST && b != TY_GHOST)
		mesh->edge_made(mesh->edge_context, a, b);
}

/* ---- flips ---- */

void
ty_mesh_flip(ty_mesh *mesh, uint32_t h, uint32_t corner[4])
{
	uint32_t g = ty_opposite(mesh, h);
	uint32_t t0 = h / 3, t1 = g / 3;
	uint32_t a = ty_origin(mesh, h), b = ty_origin(mesh, g);
	uint32_t c = ty_origin(mesh, ty_previous_in_triangle(h)), d = ty_origin(mesh, ty_previous_in_triangle(g));
	uint32_t bc = ty_opposite(mesh, ty_next_in_triangle(h)), ca = ty_opposite(mesh, ty_previous_in_triangle(h));
	uint32_t ad = ty_opposite(mesh, ty_next_in_triangle(g)), db = ty_opposite(mesh, ty_previous_in_triangle(g));

	mesh->triangles[t0] = (ty_triangle){{a, d, c}, {0, 0, 0}};
	mesh->triangles[t1] = (ty_triangle){{d, b, c}, {0, 0, 0}};
	ty_mesh_bond(mesh, 3 * t0, ad);
	ty_mesh_bond(mesh, 3 * t0 + 1, 3 * t1 + 2);
	ty_mesh_bond(mesh, 3 * t0 + 2, ca);
	ty_mesh_bond(mesh, 3 * t1, db);
	ty_mesh_bond(mesh, 3 * t1 + 1, bc);
	corner[0] = a;
	corner[1] = d;
	corner[2] = b;
	corner[3] = c;
}

bool
ty_mesh_violates(const ty_mesh *mesh, uint32_t h)
{
	uint32_t g = ty_opposite(mesh, h);
	uint32_t a = ty_origin(mesh, h), b = ty_origin(mesh, g);
	uint32_t c = ty_origin(mesh, ty_previous_in_triangle(h)), d = ty_origin(mesh, ty_previous_in_triangle(g));
	const ty_position *p = mesh->position;

	if (c == TY_GHOST || d == TY_GHOST)
		return false; /* an edge of the hull */
	if (a == TY_GHOST)
		return ty_orientation(p[c], p[b], p[d]) < 0; /* hull c -> b -> d must not turn inwards */
	if (b == TY_GHOST)
		return ty_orientation(p[d], p[a], p[c]) < 0;
	return ty_in_circle(p[a], p[b], p[c], p[d], a, b, c, d);
}

/* Flips the edge and queues the four around it; tells of a new edge that does not end at `fresh`. */
static ty_status
flip_and_push(ty_mesh *mesh, uint32_t h, uint32_t fresh)
{
	uint32_t t0 = h / 3, t1 = ty_opposite(mesh, h) / 3;
	uint32_t corner[4];
	ty_status status;

	ty_mesh_flip(mesh, h, corner);
	set_edge(mesh, corner[0], 3 * t0);
	set_edge(mesh, corner[1], 3 * t0 + 1);
	set_edge(mesh, corner[2], 3 * t1 + 1);
	set_edge(mesh, corner[3], 3 * t1 + 2);
	if (corner[1] != fresh && corner[3] != fresh)
		tell_edge(mesh, corner[1], corner[3]);
	if ((status = push(mesh, 3 * t0)) != TY_OK || (status = push(mesh, 3 * t0 + 2)) != TY_OK ||
		(status = push(mesh, 3 * t1)) != TY_OK || (status = push(mesh, 3 * t1 + 1)) != TY_OK)
		return status;
	return TY_OK;
}

/* Lawson's flips until every queued edge is Delaunay; `fresh` is the vertex that has just moved. */
static ty_status
restore(ty_mesh *mesh, uint32_t fresh)
{
	while (mesh->stack_count > 0)
	{
		uint32_t h = mesh->stack[--mesh->stack_count];

		mesh->work++;
		if (ty_mesh_violates(mesh, h))
		{
			ty_status status = flip_and_push(mesh, h, fresh);

			if (status != TY_OK)
				return status;
		}
	}
	return TY_OK;
}

/* ---- contraction ---- */

/*
 * Whether the star of v, but for the triangles at the edge v - other, stays counter-clockwise when v moves to
 * `to`, and has no ghosts. Adds to *turns how often its outline crosses the level of `to` upwards.
 */
static bool
star_allows(const ty_mesh *mesh, uint32_t v, uint32_t other, ty_position to, int *turns)
{
	uint32_t first = mesh->edge[v], h = first;

	do
	{
		uint32_t b = ty_target(mesh, h), c = ty_origin(mesh, ty_previous_in_triangle(h));

		if (b == TY_GHOST || c == TY_GHOST)
			return false;
		if (b != other && c != other)
		{
			ty_position pb = mesh->position[b], pc = mesh->position[c];

			if (ty_orientation(to, pb, pc) <= 0)
				return false;
			*turns += pb.y < to.y && pc.y >= to.y;
		}
	} while ((h = ty_next_around(mesh, h)) != first);
	return true;
}

/* the half-edge from s to t; TY_NONE when there is none */
static uint32_t
find_edge(const ty_mesh *mesh, uint32_t s, uint32_t t)
{
	uint32_t first = mesh->edge[s], h = first;

	do
	{
		if (ty_target(mesh, h) == t)
			return h;
	} while ((h = ty_next_around(mesh, h)) != first);
	return TY_NONE;
}

/* Closes the triangle of h (from one merged end to the other) up: its two other edges become one. */
static void
close_triangle(ty_mesh *mesh, uint32_t h)
{
	uint32_t left = ty_opposite(mesh, ty_next_in_triangle(h));		/* apex -> target of h */
	uint32_t right = ty_opposite(mesh, ty_previous_in_triangle(h)); /* origin of h -> apex */

	ty_mesh_bond(mesh, left, right);
	set_edge(mesh, ty_origin(mesh, left), left);
	set_edge(mesh, ty_origin(mesh, right), right);
	give_triangle(mesh, h / 3);
}

/* Contracts the half-edge h, whose ends are kept and gone; afterwards kept stands at `to`. Topology only. */
static void
contract(ty_mesh *mesh, uint32_t h, uint32_t kept, uint32_t gone, ty_position to)
{
	uint32_t g = ty_opposite(mesh, h);
	uint32_t first = mesh->edge[gone], around = first;

	do
		mesh->triangles[around / 3].vertex[around % 3] = kept;
	while ((around = ty_next_around(mesh, around)) != first);
	close_triangle(mesh, h);
	close_triangle(mesh, g);
	mesh->edge[gone] = TY_NONE;
	mesh->position[kept] = to;
	mesh->live--;
}

/* queues the spokes and the outline of v's star */
static ty_status
push_star(ty_mesh *mesh, uint32_t v)
{
	uint32_t first = mesh->edge[v], h = first;
	ty_status status;

	do
	{
		if ((status = push(mesh, ty_next_in_triangle(h))) != TY_OK || (status = push(mesh, h)) != TY_OK)
			return status;
	} while ((h = ty_next_around(mesh, h)) != first);
	return TY_OK;
}

/* ---- removal ---- */

/* A corner of a hole, and the edge from it to the next corner as seen from outside the hole. */
typedef struct corner
{
	uint32_t vertex;
	uint32_t outside; /* half-edge from the next corner to this one */
	uint32_t next;
} corner;

/* The hole that a removed vertex leaves, split into smaller holes as triangles fill it. */
typedef struct hole
{
	corner *corners;
	size_t count;
	uint32_t *open; /* first corners of the holes still to fill */
	size_t open_count;
} hole;

/* The stars of most vertices have 6 corners; room for these needs no allocation. */
#define HOLE_INLINE 24

/* Takes v's star out of the mesh and lists the corners of the hole, counter-clockwise. */
static void
open_hole(ty_mesh *mesh, uint32_t v, hole *hole)
{
	uint32_t first = mesh->edge[v], h = first;

	hole->count = 0;
	do
	{
		uint32_t outside = ty_opposite(mesh, ty_next_in_triangle(h));

		hole->corners[hole->count] = (corner){ty_target(mesh, h), outside, (uint32_t) hole->count + 1};
		hole->count++;
		set_edge(mesh, ty_origin(mesh, outside), outside); /* the next corner holds on to the mesh outside */
	} while ((h = ty_next_around(mesh, h)) != first);
	hole->corners[hole->count - 1].next = 0;
	for (size_t i = 0; i < hole->count; i++)
		give_triangle(mesh, ty_opposite(mesh, hole->corners[i].outside) / 3);
	mesh->edge[v] = TY_NONE;
	mesh->live--;
}

/* The corner whose triangle with a -> b belongs to the Delaunay mesh: no other corner lies inside its circle. */
static uint32_t
delaunay_apex(const ty_mesh *mesh, const corner *corners, uint32_t a, uint32_t b)
{
	uint32_t va = corners[a].vertex, vb = corners[b].vertex;
	uint32_t apex = TY_NONE, ghost = TY_NONE;
	const ty_position *p = mesh->position;

	for (uint32_t i = corners[b].next; i != a; i = corners[i].next)
	{
		uint32_t v = corners[i].vertex;

		if (v == TY_GHOST)
			ghost = i;
		else if (ty_orientation(p[va], p[vb], p[v]) > 0 &&
				 (apex == TY_NONE ||
				  ty_in_circle(p[va], p[vb], p[corners[apex].vertex], p[v], va, vb, corners[apex].vertex, v)))
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
	uint32_t t = take_triangle(mesh);
	uint32_t copy = (uint32_t) hole->count++; /* of the apex, which is a corner of both holes */
	uint32_t last = b;

	set_triangle(mesh, t, va, vb, vc);
	ty_mesh_bond(mesh, 3 * t, corners[a].outside);
	while (corners[last].next != apex)
		last = corners[last].next;
	if (last != b)
		tell_edge(mesh, vb, vc);
	if (corners[apex].next != a)
		tell_edge(mesh, vc, va);
	corners[copy] = (corner){vc, 3 * t + 1, b};
	corners[last].next = copy;
	corners[a].next = apex;
	corners[a].outside = 3 * t + 2;
	hole->open[hole->open_count++] = b;
	hole->open[hole->open_count++] = a;
}

/* Fills the hole with Delaunay triangles. */
static ty_status
fill_hole(ty_mesh *mesh, hole *hole)
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
		if (hole->count > 2 * HOLE_INLINE && ty_interrupted(mesh->env))
			return TY_INTERRUPTED; /* a hub's hole may take 0.1 s to fill */
		split_hole(mesh, hole, a, corners[a].next, apex);
		mesh->work += hole->count;
	}
	return TY_OK;
}

static size_t
degree(const ty_mesh *mesh, uint32_t v)
{
	uint32_t first = mesh->edge[v], h = first;
	size_t n = 0;

	do
		n++;
	while ((h = ty_next_around(mesh, h)) != first);
	return n;
}

/* whether filling the hole that v would leave costs less than building the mesh anew */
static bool
worth_filling(const ty_mesh *mesh, size_t degree)
{
	return degree <= HOLE_INLINE || degree * degree / REBUILD_RATIO <= mesh->live;
}

/* Takes v, of the given degree, out of a mesh that is not a chain. */
static ty_status
remove_vertex(ty_mesh *mesh, uint32_t v, size_t degree)
{
	corner corners[2 * HOLE_INLINE];
	uint32_t open[HOLE_INLINE];
	hole hole = {corners, 0, open, 0};
	ty_status status = TY_NO_MEMORY;

	if (degree > HOLE_INLINE)
	{
		hole.corners = ty_allocate_array(mesh->env, 2 * degree, sizeof *hole.corners);
		hole.open = ty_allocate_array(mesh->env, degree, sizeof *hole.open);
	}
	if (hole.corners != NULL && hole.open != NULL)
	{
		open_hole(mesh, v, &hole);
		status = fill_hole(mesh, &hole);
	}
	if (degree > HOLE_INLINE)
	{
		ty_release(mesh->env, hole.corners);
		ty_release(mesh->env, hole.open);
	}
	return status;
}

/* ---- insertion ---- */

/* Where a point lies. */
typedef struct location
{
	uint32_t h;		 /* a half-edge of the triangle that holds it, or of the ghost whose edge it lies beyond */
	bool on_edge;	 /* it lies on the edge of h */
	uint32_t vertex; /* the vertex at the very place, or TY_NONE */
} location;

/* Whether p lies in the real triangle t; if not, *out is a half-edge beyond which it lies. */
static bool
triangle_holds(const ty_mesh *mesh, uint32_t t, ty_position p, location *at, uint32_t *out)
{
	*at = (location){3 * t, false, TY_NONE};
	for (uint32_t h = 3 * t; h < 3 * t + 3; h++)
	{
		ty_position a = mesh->position[ty_origin(mesh, h)], b = mesh->position[ty_target(mesh, h)];
		int64_t side = ty_orientation(a, b, p);

		if (side < 0)
		{
			*out = h;
			return false;
		}
		if (side == 0)
			at->h = h, at->on_edge = true;
		if (ty_same_position(a, p))
			at->vertex = ty_origin(mesh, h);
	}
	return true;
}

/* a real triangle at v; TY_NONE in a chain */
static uint32_t
real_triangle(const ty_mesh *mesh, uint32_t v)
{
	uint32_t first = mesh->edge[v], h = first;

	do
	{
		if (!ty_mesh_is_ghost(mesh, h / 3))
			return h / 3;
	} while ((h = ty_next_around(mesh, h)) != first);
	return TY_NONE;
}

/* Walks from a real triangle to the one that holds p, or to the ghost of a hull edge that p lies beyond. */
static location
locate(const ty_mesh *mesh, uint32_t t, ty_position p)
{
	location at;
	uint32_t out;

	/* a visibility walk: in a Delaunay mesh it cannot go in circles (De Floriani et al. 1991) */
	while (!triangle_holds(mesh, t, p, &at, &out))
	{
		uint32_t beyond = ty_opposite(mesh, out);

		t = beyond / 3;
		if (ty_mesh_is_ghost(mesh, t))
			return (location){beyond, false, TY_NONE};
	}
	return at;
}

/* Splits the triangle of h into three at v; the caller queues and restores. */
static ty_status
split_triangle(ty_mesh *mesh, uint32_t h, uint32_t v)
{
	uint32_t t0 = h / 3, t1 = take_triangle(mesh), t2 = take_triangle(mesh);
	uint32_t a = mesh->triangles[t0].vertex[0], b = mesh->triangles[t0].vertex[1], c = mesh->triangles[t0].vertex[2];
	uint32_t ab = mesh->triangles[t0].adjacent[0], bc = mesh->triangles[t0].adjacent[1];
	uint32_t ca = mesh->triangles[t0].adjacent[2];
	ty_status status;

	set_triangle(mesh, t0, a, b, v);
	set_triangle(mesh, t1, b, c, v);
	set_triangle(mesh, t2, c, a, v);
	ty_mesh_bond(mesh, 3 * t0, ab);
	ty_mesh_bond(mesh, 3 * t1, bc);
	ty_mesh_bond(mesh, 3 * t2, ca);
	ty_mesh_bond(mesh, 3 * t0 + 1, 3 * t1 + 2);
	ty_mesh_bond(mesh, 3 * t1 + 1, 3 * t2 + 2);
	ty_mesh_bond(mesh, 3 * t2 + 1, 3 * t0 + 2);
	if ((status = push(mesh, 3 * t0)) != TY_OK || (status = push(mesh, 3 * t1)) != TY_OK)
		return status;
	return push(mesh, 3 * t2);
}

/* Inserts v at the place that was located. */
static ty_status
insert_vertex(ty_mesh *mesh, uint32_t v, ty_position to, location at)
{
	uint32_t beyond = ty_opposite(mesh, at.h);
	ty_status status;

	mesh->position[v] = to;
	mesh->live++;
	status = split_triangle(mesh, at.h, v);
	/* on an edge the split leaves a flat triangle there: flipping that edge makes two good ones */
	if (status == TY_OK && at.on_edge)
		status = flip_and_push(mesh, beyond, v);
	return status == TY_OK ? restore(mesh, v) : status;
}

/* ---- the three ways ---- */

/* What a change replaces: one or two vertices that leave, and the one that comes for them. */
typedef struct change
{
	uint32_t leaving[2];
	int count;
	uint32_t fresh; /* may be one of those that leave */
	ty_position to;
} change;

static void
tell_all_edges(const ty_mesh *mesh)
{
	for (uint32_t h = 0; h < 3 * mesh->used_triangles; h++)
		if (ty_origin(mesh, h) < ty_target(mesh, h))
			tell_edge(mesh, ty_origin(mesh, h), ty_target(mesh, h));
}

/* lists the vertices of the mesh with their keys; returns how many */
static size_t
list_live(const ty_mesh *mesh, uint32_t *list, uint64_t *keys)
{
	size_t n = 0;

	for (size_t v = 0; v < mesh->vertices; v++)
		if (mesh->edge[v] != TY_NONE)
		{
			list[n] = (uint32_t) v;
			keys[n++] = ty_hilbert_key(mesh->position[v]);
		}
	return n;
}

/* Building anew takes this many times the work of a corner or flip, per vertex. */
#define WORK_OF_REBUILDING 8

/* Builds the mesh of the vertices whose edge is not TY_NONE, wherever they now are. */
static ty_status
rebuild_live(ty_mesh *mesh)
{
	ty_status status = TY_NO_MEMORY;
	uint32_t *list = ty_allocate_array(mesh->env, mesh->live + 1, sizeof *list);
	uint64_t *keys = ty_allocate_array(mesh->env, mesh->live + 1, sizeof *keys);

	if (list != NULL && keys != NULL)
	{
		size_t n = list_live(mesh, list, keys);

		status = ty_sort_keys(mesh->env, keys, list, n);
		if (status == TY_OK)
			status = ty_mesh_triangulate(mesh, list, keys, n);
		if (status == TY_OK)
			tell_all_edges(mesh);
		mesh->work += WORK_OF_REBUILDING * n;
	}
	ty_release(mesh->env, list);
	ty_release(mesh->env, keys);
	return status;
}

/* Makes the change by building the mesh anew. */
static ty_status
rebuild(ty_mesh *mesh, const change *c, uint32_t *met)
{
	for (int i = 0; i < c->count; i++)
		mesh->edge[c->leaving[i]] = TY_NONE;
	*met = TY_NONE;
	for (size_t v = 0; v < mesh->vertices; v++)
		if (mesh->edge[v] != TY_NONE && ty_same_position(mesh->position[v], c->to))
			*met = (uint32_t) v;
	if (*met == TY_NONE)
	{
		mesh->position[c->fresh] = c->to;
		mesh->edge[c->fresh] = 0;
	}
	return rebuild_live(mesh);
}

/* a neighbour of the leaving vertices that stays; there is one while more live than leave */
static uint32_t
staying_neighbour(const ty_mesh *mesh, const change *c)
{
	for (int i = 0; i < c->count; i++)
	{
		uint32_t first = mesh->edge[c->leaving[i]], h = first;

		do
		{
			uint32_t v = ty_target(mesh, h);

			if (v != TY_GHOST && v != c->leaving[0] && v != c->leaving[c->count - 1])
				return v;
		} while ((h = ty_next_around(mesh, h)) != first);
	}
	return TY_NONE;
}

/* Removes what leaves, fills the holes, inserts what comes. */
static ty_status
refill(ty_mesh *mesh, const change *c, uint32_t *met)
{
	uint32_t near = staying_neighbour(mesh, c);
	uint32_t t;
	location at;

	for (int i = 0; i < c->count; i++)
	{
		uint32_t v = c->leaving[i];
		ty_status status;
		size_t d;

		if (real_triangle(mesh, v) == TY_NONE || !worth_filling(mesh, d = degree(mesh, v)))
			return rebuild(mesh, c, met);
		status = remove_vertex(mesh, v, d);
		if (status != TY_OK)
			return status;
	}
	t = near == TY_NONE ? TY_NONE : real_triangle(mesh, near);
	if (t == TY_NONE)
		return rebuild(mesh, c, met);
	at = locate(mesh, t, c->to);
	*met = at.vertex;
	return at.vertex == TY_NONE ? insert_vertex(mesh, c->fresh, c->to, at) : TY_OK;
}

/* Whether both stars can be merged by renaming, seen from `to`: see star_allows. */
static bool
can_contract(const ty_mesh *mesh, uint32_t s, uint32_t t, ty_position to)
{
	int turns = 0; /* the merged star's outline must go round `to` exactly once */

	return star_allows(mesh, s, t, to, &turns) && star_allows(mesh, t, s, to, &turns) && turns == 1;
}

ty_status
ty_mesh_collapse(ty_mesh *mesh, uint32_t s, uint32_t t, ty_position to, uint32_t *met)
{
	uint32_t kept = s < t ? s : t, gone = s < t ? t : s;
	change c = {{kept, gone}, 2, kept, to};
	bool chain;
	ty_status status;

	*met = TY_NONE;
	if (mesh->live == 2)
		return rebuild(mesh, &c, met);
	chain = real_triangle(mesh, kept) == TY_NONE;
	if (chain && ty_orientation(mesh->position[s], mesh->position[t], to) != 0)
		return rebuild(mesh, &c, met); /* rounding has left the line */
	if (!chain && !can_contract(mesh, kept, gone, to))
		return refill(mesh, &c, met);
	contract(mesh, find_edge(mesh, kept, gone), kept, gone, to);
	if (chain)
		return TY_OK;
	status = push_star(mesh, kept); /* whose corners are counted as work when they are popped */
	return status == TY_OK ? restore(mesh, kept) : status;
}

ty_status
ty_mesh_move(ty_mesh *mesh, uint32_t v, uint32_t renamed, ty_position to, uint32_t *met)
{
	change c = {{v, v}, 1, renamed, to};

	*met = TY_NONE;
	return mesh->live <= 3 ? rebuild(mesh, &c, met) : refill(mesh, &c, met);
}

ty_status
ty_mesh_collapse_many(ty_mesh *mesh, const uint32_t *kept, const uint32_t *gone, ty_position *place, size_t n)
{
	for (size_t i = 0; i < n; i++)
	{
		ty_position former = mesh->position[kept[i]];

		mesh->position[kept[i]] = place[i];
		mesh->edge[gone[i]] = TY_NONE;
		place[i] = former;
	}
	return rebuild_live(mesh);
}

ty_status
ty_mesh_part_many(ty_mesh *mesh, const uint32_t *kept, const uint32_t *gone, const ty_position *place, size_t n)
{
	for (size_t i = 0; i < n; i++)
	{
		mesh->position[kept[i]] = place[i];
		mesh->edge[gone[i]] = 0;
	}
	mesh->live += n;
	return rebuild_live(mesh);
}
