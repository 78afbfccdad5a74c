/*
 * mesh.c - see mesh.h
 *
 * mesh_build.c builds the mesh; this file changes it, mesh_hole.c takes vertices out; mesh_check.c checks it. A
 * collapse goes one of three ways:
 *
 *   contract  both stars lie inside the hull and stay star-shaped seen from the new place: the two triangles
 *             at the edge vanish, the rest is renamed, flips restore the Delaunay property. Nearly always.
 *   refill    otherwise both ends are removed, their holes are filled with Delaunay triangles, and the new
 *             vertex is inserted.
 *   rebuild   what is left when the mesh changes between a chain and a surface.
 *
 * Ghost triangles follow the same rules with orientation in the place of in-circle.
 */
#include "mesh_internal.h"

/* ---- flips ---- */

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

void
ty_mesh_flip(ty_mesh *mesh, uint32_t h, uint32_t corner[4])
{
	uint32_t g = ty_opposite(mesh, h);
	uint32_t t0 = ty_triangle_of(h), t1 = ty_triangle_of(g);
	uint32_t a = ty_origin(mesh, h), b = ty_origin(mesh, g);
	uint32_t c = ty_origin(mesh, ty_previous_in_triangle(h)), d = ty_origin(mesh, ty_previous_in_triangle(g));
	uint32_t bc = ty_opposite(mesh, ty_next_in_triangle(h)), ca = ty_opposite(mesh, ty_previous_in_triangle(h));
	uint32_t ad = ty_opposite(mesh, ty_next_in_triangle(g)), db = ty_opposite(mesh, ty_previous_in_triangle(g));

	mesh->triangles[t0] = (ty_triangle){{a, d, c}, {0, 0, 0}};
	mesh->triangles[t1] = (ty_triangle){{d, b, c}, {0, 0, 0}};
	ty_mesh_bond(mesh, ty_half_edge(t0, 0), ad);
	ty_mesh_bond(mesh, ty_half_edge(t0, 1), ty_half_edge(t1, 2));
	ty_mesh_bond(mesh, ty_half_edge(t0, 2), ca);
	ty_mesh_bond(mesh, ty_half_edge(t1, 0), db);
	ty_mesh_bond(mesh, ty_half_edge(t1, 1), bc);
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

	if (c == TY_GHOST || d == TY_GHOST)
		return false; /* an edge of the hull */
	if (a == TY_GHOST)
		return ty_turn(mesh, c, b, d) < 0; /* hull c -> b -> d must not turn inwards */
	if (b == TY_GHOST)
		return ty_turn(mesh, d, a, c) < 0;
	return ty_circle_holds(mesh, a, b, c, d);
}

/* Flips the edge and queues the four around it; tells of a new edge that does not end at `fresh`. */
static ty_status
flip_and_push(ty_mesh *mesh, uint32_t h, uint32_t fresh)
{
	uint32_t t0 = ty_triangle_of(h), t1 = ty_triangle_of(ty_opposite(mesh, h));
	uint32_t corner[4];
	ty_status status;

	ty_mesh_flip(mesh, h, corner);
	ty_set_edge(mesh, corner[0], ty_half_edge(t0, 0));
	ty_set_edge(mesh, corner[1], ty_half_edge(t0, 1));
	ty_set_edge(mesh, corner[2], ty_half_edge(t1, 1));
	ty_set_edge(mesh, corner[3], ty_half_edge(t1, 2));
	if (corner[1] != fresh && corner[3] != fresh)
		ty_tell_edge(mesh, corner[1], corner[3]);
	if ((status = push(mesh, ty_half_edge(t0, 0))) != TY_OK || (status = push(mesh, ty_half_edge(t0, 2))) != TY_OK ||
		(status = push(mesh, ty_half_edge(t1, 0))) != TY_OK || (status = push(mesh, ty_half_edge(t1, 1))) != TY_OK)
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
 * The stars of both ends of h, without the two triangles at h: together the star of the vertex that they merge to.
 * ring[i].h is the half-edge from an end to the i-th corner, in the triangle of the corners i and i + 1,
 * counter-clockwise. Read once, so that all tests run over an array instead of from triangle to triangle.
 */
static ty_status
read_ring(ty_mesh *mesh, uint32_t h, bool *has_ghost)
{
	uint32_t side[2] = {h, ty_opposite(mesh, h)};

	mesh->ring_count = 0;
	*has_ghost = false;
	for (int i = 0; i < 2; i++)
	{
		uint32_t spoke = ty_next_around(mesh, side[i]), next, corner;

		for (; spoke != side[i]; spoke = next)
		{
			next = ty_step_around(mesh, spoke, &corner);
			if (next == side[i])
				break; /* the last spoke's triangle is at the edge */
			if (mesh->ring_count == mesh->ring_capacity)
			{
				size_t capacity = 2 * mesh->ring_capacity;
				ty_spoke *ring = ty_reallocate_array(mesh->env, mesh->ring, capacity, sizeof *ring);

				if (ring == NULL)
					return TY_NO_MEMORY;
				mesh->ring = ring;
				mesh->ring_capacity = capacity;
			}
			mesh->ring[mesh->ring_count++] = (ty_spoke){spoke, corner};
			*has_ghost |= corner == TY_GHOST;
		}
	}
	return TY_OK;
}

/* the i-th corner of the ring, counted around it */
static uint32_t
ring_corner(const ty_mesh *mesh, size_t i)
{
	return mesh->ring[i < mesh->ring_count ? i : i - mesh->ring_count].corner;
}

/* Whether the ring, which has no ghost, is star-shaped seen from `to`: the ends can be merged by renaming. */
static bool
ring_allows(const ty_mesh *mesh, ty_position to)
{
	int turns = 0; /* how often it crosses the level of `to` upwards: it must go round exactly once */
	ty_position b = mesh->vertex[ring_corner(mesh, 0)].position;

	for (size_t i = 0; i < mesh->ring_count; i++)
	{
		ty_position c = mesh->vertex[ring_corner(mesh, i + 1)].position;

		if (ty_orientation(to, b, c) <= 0)
			return false;
		turns += b.y < to.y && c.y >= to.y;
		b = c;
	}
	return turns == 1;
}

/* Closes the triangle of h (from one merged end to the other) up: its two other edges become one. */
static void
close_triangle(ty_mesh *mesh, uint32_t h)
{
	uint32_t left = ty_opposite(mesh, ty_next_in_triangle(h));		/* apex -> target of h */
	uint32_t right = ty_opposite(mesh, ty_previous_in_triangle(h)); /* origin of h -> apex */

	ty_mesh_bond(mesh, left, right);
	ty_set_edge(mesh, ty_origin(mesh, left), left);
	ty_set_edge(mesh, ty_origin(mesh, right), right);
	ty_give_triangle(mesh, ty_triangle_of(h));
}

/* Contracts the half-edge h, whose ends are kept and gone and have the ring; kept comes to `to`. Topology only. */
static void
contract(ty_mesh *mesh, uint32_t h, uint32_t kept, uint32_t gone, ty_position to)
{
	uint32_t g = ty_opposite(mesh, h);

	for (size_t i = 0; i < mesh->ring_count; i++)
		mesh->triangles[ty_triangle_of(mesh->ring[i].h)].vertex[ty_corner_of(mesh->ring[i].h)] = kept;
	close_triangle(mesh, h);
	close_triangle(mesh, g);
	mesh->vertex[gone].edge = TY_NONE;
	mesh->vertex[kept].position = to;
	mesh->live--;
}

/* A vertex as seen from the merged one, with its squared distance. */
typedef struct seen
{
	uint32_t vertex;
	int64_t x, y, lift;
} seen;

static inline seen
look_at(const ty_mesh *mesh, uint32_t from, uint32_t vertex)
{
	ty_position o = mesh->vertex[from].position, p = mesh->vertex[vertex].position;
	int64_t x = (int64_t) p.x - o.x, y = (int64_t) p.y - o.y;

	return (seen){vertex, x, y, x * x + y * y};
}

static inline int64_t
cross(seen a, seen b)
{
	return a.x * b.y - a.y * b.x;
}

/*
 * ty_circle_holds(v, a, b, d), with the determinant taken relative to v: seen from there each corner of a ring is in
 * six of them, so that nearly half of the products are there already. ab, bd and da are the cross products.
 */
static inline bool
circle_holds_seen(const ty_mesh *mesh, uint32_t v, seen a, seen b, seen d, int64_t ab, int64_t bd, int64_t da)
{
	__int128 sum = (__int128) a.lift * bd + (__int128) b.lift * da + (__int128) d.lift * ab;

	return sum != 0 ? sum < 0 : ty_circle_holds(mesh, v, a.vertex, b.vertex, d.vertex);
}

/* Queues the spokes and outer edges of the ring of v that are not Delaunay. */
static ty_status
push_ring(ty_mesh *mesh, uint32_t v)
{
	seen a = look_at(mesh, v, ring_corner(mesh, mesh->ring_count - 1)), b = look_at(mesh, v, ring_corner(mesh, 0));
	int64_t ab = cross(a, b);
	ty_status status = TY_OK;

	for (size_t i = 0; i < mesh->ring_count && status == TY_OK; i++)
	{
		seen c = look_at(mesh, v, ring_corner(mesh, i + 1));
		int64_t bc = cross(b, c);
		uint32_t edge = ty_next_in_triangle(mesh->ring[i].h);
		uint32_t beyond = ty_origin(mesh, ty_previous_in_triangle(ty_opposite(mesh, edge)));

		if (circle_holds_seen(mesh, v, a, b, c, ab, bc, cross(c, a)))
			status = push(mesh, mesh->ring[i].h);
		if (status == TY_OK && beyond != TY_GHOST)
		{
			seen d = look_at(mesh, v, beyond);

			if (circle_holds_seen(mesh, v, b, c, d, bc, cross(c, d), cross(d, b)))
				status = push(mesh, edge);
		}
		a = b;
		b = c;
		ab = bc;
	}
	mesh->work += 2 * mesh->ring_count;
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
	*at = (location){ty_half_edge(t, 0), false, TY_NONE};
	for (uint32_t h = ty_half_edge(t, 0); h <= ty_half_edge(t, 2); h++)
	{
		ty_position a = mesh->vertex[ty_origin(mesh, h)].position, b = mesh->vertex[ty_target(mesh, h)].position;
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
	uint32_t first = mesh->vertex[v].edge, h = first;

	do
	{
		if (!ty_mesh_is_ghost(mesh, ty_triangle_of(h)))
			return ty_triangle_of(h);
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

		t = ty_triangle_of(beyond);
		if (ty_mesh_is_ghost(mesh, t))
			return (location){beyond, false, TY_NONE};
	}
	return at;
}

/* Splits the triangle of h into three at v; the caller queues and restores. */
static ty_status
split_triangle(ty_mesh *mesh, uint32_t h, uint32_t v)
{
	uint32_t t0 = ty_triangle_of(h), t1 = ty_take_triangle(mesh), t2 = ty_take_triangle(mesh);
	uint32_t a = mesh->triangles[t0].vertex[0], b = mesh->triangles[t0].vertex[1], c = mesh->triangles[t0].vertex[2];
	uint32_t ab = mesh->triangles[t0].adjacent[0], bc = mesh->triangles[t0].adjacent[1];
	uint32_t ca = mesh->triangles[t0].adjacent[2];
	ty_status status;

	ty_set_triangle(mesh, t0, a, b, v);
	ty_set_triangle(mesh, t1, b, c, v);
	ty_set_triangle(mesh, t2, c, a, v);
	ty_mesh_bond(mesh, ty_half_edge(t0, 0), ab);
	ty_mesh_bond(mesh, ty_half_edge(t1, 0), bc);
	ty_mesh_bond(mesh, ty_half_edge(t2, 0), ca);
	ty_mesh_bond(mesh, ty_half_edge(t0, 1), ty_half_edge(t1, 2));
	ty_mesh_bond(mesh, ty_half_edge(t1, 1), ty_half_edge(t2, 2));
	ty_mesh_bond(mesh, ty_half_edge(t2, 1), ty_half_edge(t0, 2));
	if ((status = push(mesh, ty_half_edge(t0, 0))) != TY_OK || (status = push(mesh, ty_half_edge(t1, 0))) != TY_OK)
		return status;
	return push(mesh, ty_half_edge(t2, 0));
}

/* Inserts v at the place that was located. */
static ty_status
insert_vertex(ty_mesh *mesh, uint32_t v, ty_position to, location at)
{
	uint32_t beyond = ty_opposite(mesh, at.h);
	ty_status status;

	mesh->vertex[v].position = to;
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
	for (uint32_t h = 0; h < ty_half_edge(mesh->used_triangles, 0); h = ty_next_half_edge(h))
		if (ty_origin(mesh, h) < ty_target(mesh, h))
			ty_tell_edge(mesh, ty_origin(mesh, h), ty_target(mesh, h));
}

/* lists the vertices of the mesh with their keys; returns how many */
static size_t
list_live(const ty_mesh *mesh, uint32_t *list, uint64_t *keys)
{
	size_t n = 0;

	for (size_t v = 0; v < mesh->vertices; v++)
		if (mesh->vertex[v].edge != TY_NONE)
		{
			list[n] = (uint32_t) v;
			keys[n++] = ty_hilbert_key(mesh->vertex[v].position);
		}
	return n;
}

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
		mesh->work += TY_WORK_OF_BUILDING * n;
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
		mesh->vertex[c->leaving[i]].edge = TY_NONE;
	*met = TY_NONE;
	for (size_t v = 0; v < mesh->vertices; v++)
		if (mesh->vertex[v].edge != TY_NONE && ty_same_position(mesh->vertex[v].position, c->to))
			*met = (uint32_t) v;
	if (*met == TY_NONE)
	{
		mesh->vertex[c->fresh].position = c->to;
		mesh->vertex[c->fresh].edge = 0;
	}
	return rebuild_live(mesh);
}

/* a neighbour of the leaving vertices that stays; there is one while more live than leave */
static uint32_t
staying_neighbour(const ty_mesh *mesh, const change *c)
{
	for (int i = 0; i < c->count; i++)
	{
		uint32_t first = mesh->vertex[c->leaving[i]].edge, h = first;

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

		if (real_triangle(mesh, v) == TY_NONE)
			return rebuild(mesh, c, met);
		status = ty_mesh_remove(mesh, v);
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

ty_status
ty_mesh_collapse(ty_mesh *mesh, uint32_t h, ty_position to, uint32_t *met)
{
	uint32_t s = ty_origin(mesh, h), t = ty_target(mesh, h);
	uint32_t kept = s < t ? s : t, gone = s < t ? t : s;
	change c = {{kept, gone}, 2, kept, to};
	bool has_ghost, chain;
	ty_status status = read_ring(mesh, h, &has_ghost);

	*met = TY_NONE;
	if (status != TY_OK)
		return status;
	if (mesh->live == 2)
		return rebuild(mesh, &c, met);
	chain = has_ghost && real_triangle(mesh, kept) == TY_NONE;
	if (chain && ty_orientation(mesh->vertex[s].position, mesh->vertex[t].position, to) != 0)
		return rebuild(mesh, &c, met); /* rounding has left the line */
	if (!chain && (has_ghost || !ring_allows(mesh, to)))
		return refill(mesh, &c, met);
	contract(mesh, h, kept, gone, to);
	if (chain)
		return TY_OK;
	status = push_ring(mesh, kept);
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
		ty_position former = mesh->vertex[kept[i]].position;

		mesh->vertex[kept[i]].position = place[i];
		mesh->vertex[gone[i]].edge = TY_NONE;
		place[i] = former;
	}
	return rebuild_live(mesh);
}

ty_status
ty_mesh_part_many(ty_mesh *mesh, const uint32_t *kept, const uint32_t *gone, const ty_position *place, size_t n)
{
	for (size_t i = 0; i < n; i++)
	{
		mesh->vertex[kept[i]].position = place[i];
		mesh->vertex[gone[i]].edge = 0;
	}
	mesh->live += n;
	return rebuild_live(mesh);
}
