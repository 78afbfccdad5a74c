/*
 * mesh_build.c - Delaunay mesh by divide and conquer.
 *
 * Vertices come in Hilbert order, so the first bit in which the keys of a range differ splits it into two
 * ranges that a grid line separates: the recursion needs no sorting of its own, and works on what is near in
 * memory. n vertices take the triangles 2 * first .. 2 * (first + n) - 3; joining two meshes adds two. Each
 * part is closed by ghosts: joining turns the ghosts of the valley between the parts into the triangles that
 * fill it, from the lower common tangent upwards, and flips away the hull edges that are in the way (Guibas
 * and Stolfi 1985; ghosts as in Shewchuk 1996).
 *
 * While building, edge[v] of a corner of a part's hull is the half-edge v -> ghost in the ghost of the hull
 * edge that starts at v. Vertices inside a chain are passed twice on the way round it, so they have none.
 */
#include "mesh_internal.h"

#define POLL_RANGE 2048 /* vertices: smaller parts are joined without a look for an interrupt (0.5 ms) */

/*
 * One part: the corners of its hull with extreme coordinates. Of several the lowest counts for left and right,
 * the rightmost for bottom and top (the lowest when the plane is turned clockwise): from there the lower
 * tangent is found by going down.
 */
typedef struct part
{
	uint32_t left, right, bottom, top;
	bool single; /* one vertex, no triangles */
} part;

typedef struct builder
{
	ty_mesh *mesh;
	const uint32_t *list;
	const uint64_t *keys;
	size_t n;
} builder;

static uint32_t
vertex_at(const builder *b, size_t i)
{
	return b->list == NULL ? (uint32_t) i : b->list[i];
}

static void
make_triangle(ty_mesh *mesh, uint32_t t, uint32_t a, uint32_t b, uint32_t c)
{
	mesh->triangles[t] = (ty_triangle){{a, b, c}, {TY_NONE, TY_NONE, TY_NONE}};
}

/* Given v -> ghost in the ghost of the hull edge that starts at v, the same for the hull's next vertex clockwise ... */
static uint32_t
clockwise(const ty_mesh *mesh, uint32_t h)
{
	return ty_previous_in_triangle(ty_opposite(mesh, h));
}

/* ... and counter-clockwise. */
static uint32_t
counter_clockwise(const ty_mesh *mesh, uint32_t h)
{
	return ty_opposite(mesh, ty_next_in_triangle(h));
}

/*
 * Moves from l and r, corners that see each other, down to the lower common tangent. left and right are their
 * half-edges to the ghost; TY_NONE for a single vertex.
 */
static void
lower_tangent(const builder *b, uint32_t *l, uint32_t *r, uint32_t *left, uint32_t *right)
{
	const ty_mesh *mesh = b->mesh;
	bool moved = true;

	while (moved)
	{
		uint32_t h;

		moved = false;
		while (*left != TY_NONE && ty_turn(mesh, *l, *r, ty_origin(mesh, h = clockwise(mesh, *left))) < 0)
		{
			*left = h;
			*l = ty_origin(mesh, h);
			moved = true;
		}
		while (*right != TY_NONE && ty_turn(mesh, *l, *r, ty_origin(mesh, h = counter_clockwise(mesh, *right))) < 0)
		{
			*right = h;
			*r = ty_origin(mesh, h);
			moved = true;
		}
	}
}

/* The seam between two parts: its current top edge l - r, and the ghosts beside it. */
typedef struct seam
{
	uint32_t l, r;
	uint32_t base;		  /* half-edge r -> l below the next triangle */
	uint32_t left_ghost;  /* half-edge l -> ghost, beside the next hull edge up on the left; TY_NONE: single */
	uint32_t right_ghost; /* half-edge ghost -> r, the same on the right */
	uint32_t top;		  /* the ghost above closes the surface at any time: l -> r, r -> ghost, ghost -> l */
} seam;

/* Upper end of the left part's next hull edge; flips away what is no Delaunay edge. TY_NONE: none above the base. */
static uint32_t
left_candidate(const builder *b, seam *s)
{
	ty_mesh *mesh = b->mesh;
	uint32_t a;

	if (s->left_ghost == TY_NONE)
		return TY_NONE;
	a = ty_origin(mesh, ty_previous_in_triangle(s->left_ghost));
	if (ty_turn(mesh, s->l, s->r, a) <= 0)
		return TY_NONE;
	for (;;)
	{
		uint32_t h = ty_opposite(mesh, ty_previous_in_triangle(s->left_ghost)); /* l -> a */
		uint32_t apex = ty_origin(mesh, ty_previous_in_triangle(h));
		uint32_t corner[4];

		if (apex == TY_GHOST || !ty_circle_holds(mesh, s->l, s->r, a, apex))
			return a;
		ty_mesh_flip(mesh, h, corner);
		s->left_ghost = ty_half_edge(ty_triangle_of(h), 0); /* l -> ghost */
		a = apex;
	}
}

static uint32_t
right_candidate(const builder *b, seam *s)
{
	ty_mesh *mesh = b->mesh;
	uint32_t c;

	if (s->right_ghost == TY_NONE)
		return TY_NONE;
	c = ty_origin(mesh, ty_previous_in_triangle(s->right_ghost));
	if (ty_turn(mesh, s->l, s->r, c) <= 0)
		return TY_NONE;
	for (;;)
	{
		uint32_t h = ty_opposite(mesh, ty_next_in_triangle(s->right_ghost)); /* c -> r */
		uint32_t apex = ty_origin(mesh, ty_previous_in_triangle(h));
		uint32_t g = ty_opposite(mesh, h);
		uint32_t corner[4];

		if (apex == TY_GHOST || !ty_circle_holds(mesh, s->l, s->r, c, apex))
			return c;
		ty_mesh_flip(mesh, h, corner);
		s->right_ghost = ty_half_edge(ty_triangle_of(g), 0); /* ghost -> r */
		c = apex;
	}
}

/* turns the left ghost into the triangle l, r, a */
static void
close_left(ty_mesh *mesh, seam *s, uint32_t a)
{
	uint32_t h = s->left_ghost, next = ty_next_in_triangle(h);

	s->left_ghost = ty_opposite(mesh, next); /* a -> ghost */
	ty_mesh_bond(mesh, s->left_ghost, s->top + 2);
	mesh->triangles[ty_triangle_of(next)].vertex[ty_corner_of(next)] = s->r;
	ty_mesh_bond(mesh, h, s->base);
	s->base = next;
	s->l = a;
}

/* turns the right ghost into the triangle l, r, c */
static void
close_right(ty_mesh *mesh, seam *s, uint32_t c)
{
	uint32_t h = s->right_ghost, previous = ty_previous_in_triangle(h);

	s->right_ghost = ty_opposite(mesh, previous); /* ghost -> c */
	ty_mesh_bond(mesh, s->right_ghost, s->top + 1);
	mesh->triangles[ty_triangle_of(h)].vertex[ty_corner_of(h)] = s->l;
	ty_mesh_bond(mesh, h, s->base);
	s->base = previous;
	s->r = c;
}

/* Fills the valley from the base upwards until neither side has anything above it. */
static ty_status
sew(const builder *b, seam *s)
{
	ty_mesh *mesh = b->mesh;

	for (size_t steps = 1;; steps++)
	{
		uint32_t a = left_candidate(b, s);
		uint32_t c = right_candidate(b, s);

		if (a == TY_NONE && c == TY_NONE)
			return TY_OK;
		if (c == TY_NONE || (a != TY_NONE && !ty_circle_holds(mesh, s->l, s->r, a, c)))
			close_left(mesh, s, a);
		else
			close_right(mesh, s, c);
		if (steps % POLL_RANGE == 0 && ty_interrupted(mesh->env))
			return TY_INTERRUPTED;
	}
}

/* Joins two parts that a line separates; l and r are their vertices nearest to it. t is the first of two triangles. */
static ty_status
join(const builder *b, const part *left, const part *right, uint32_t l, uint32_t r, uint32_t t)
{
	ty_mesh *mesh = b->mesh;
	uint32_t bottom = ty_half_edge(t, 0);
	uint32_t left_hull = left->single ? TY_NONE : mesh->vertex[l].edge;
	uint32_t right_hull = right->single ? TY_NONE : mesh->vertex[r].edge;
	seam s;
	ty_status status;

	lower_tangent(b, &l, &r, &left_hull, &right_hull);
	s = (seam){l, r, bottom, left_hull, TY_NONE, ty_half_edge(t + 1, 0)};
	make_triangle(mesh, t, r, l, TY_GHOST); /* the ghost below: r -> l, l -> ghost, ghost -> r */
	make_triangle(mesh, t + 1, l, r, TY_GHOST);
	ty_mesh_bond(mesh, bottom + 1, left->single ? s.top + 2 : ty_opposite(mesh, left_hull));
	if (!left->single)
		ty_mesh_bond(mesh, s.left_ghost, s.top + 2);
	if (!right->single)
		s.right_ghost = ty_opposite(mesh, right_hull);
	ty_mesh_bond(mesh, bottom + 2, right->single ? s.top + 1 : right_hull);
	if (!right->single)
		ty_mesh_bond(mesh, s.right_ghost, s.top + 1);
	mesh->vertex[l].edge = bottom + 1;
	status = sew(b, &s);
	mesh->triangles[t + 1].vertex[0] = s.l;
	mesh->triangles[t + 1].vertex[1] = s.r;
	ty_mesh_bond(mesh, s.top, s.base);
	mesh->vertex[s.r].edge = s.top + 1;
	return status;
}

/* whether a comes before b when the first coordinate counts most */
static bool
less(int64_t a, int64_t b, int64_t second_a, int64_t second_b)
{
	return a != b ? a < b : second_a < second_b;
}

static part
unite(const ty_vertex *p, const part *a, const part *b)
{
	part u = *a;

	u.single = false;
	if (less(p[b->left].position.x, p[a->left].position.x, p[b->left].position.y, p[a->left].position.y))
		u.left = b->left;
	if (less(-p[b->right].position.x, -p[a->right].position.x, p[b->right].position.y, p[a->right].position.y))
		u.right = b->right;
	if (less(p[b->bottom].position.y, p[a->bottom].position.y, -p[b->bottom].position.x, -p[a->bottom].position.x))
		u.bottom = b->bottom;
	if (less(-p[b->top].position.y, -p[a->top].position.y, -p[b->top].position.x, -p[a->top].position.x))
		u.top = b->top;
	return u;
}

/* The chain of two vertices, by itself: so many joins are of this kind that it pays. */
static void
join_two(ty_mesh *mesh, uint32_t v, uint32_t w, uint32_t t, part *result)
{
	part first = {v, v, v, v, true}, second = {w, w, w, w, true};

	mesh->triangles[t] =
		(ty_triangle){{w, v, TY_GHOST}, {ty_half_edge(t + 1, 0), ty_half_edge(t + 1, 2), ty_half_edge(t + 1, 1)}};
	mesh->triangles[t + 1] =
		(ty_triangle){{v, w, TY_GHOST}, {ty_half_edge(t, 0), ty_half_edge(t, 2), ty_half_edge(t, 1)}};
	mesh->vertex[v].edge = ty_half_edge(t, 1);
	mesh->vertex[w].edge = ty_half_edge(t + 1, 1);
	*result = unite(mesh->vertex, &first, &second);
}

/* first index in [low, high) whose key has the bit; the keys ascend and differ there first */
static size_t
split_point(const uint64_t *keys, size_t low, size_t high)
{
	uint64_t differ = keys[low] ^ keys[high - 1];
	uint64_t bit = UINT64_C(1) << (63 - __builtin_clzll(differ));

	while (high - low > 1)
	{
		size_t middle = low + (high - low) / 2;

		if (keys[middle] & bit)
			high = middle;
		else
			low = middle;
	}
	return high;
}

/* Builds the mesh of the vertices [low, high); the recursion is at most as deep as a key has bits. */
static ty_status
build(const builder *b, size_t low, size_t high, part *result)
{
	const ty_vertex *p = b->mesh->vertex;
	part first, second;
	size_t middle;
	uint32_t t;
	ty_status status;

	if (high - low == 1)
	{
		uint32_t v = vertex_at(b, low);

		*result = (part){v, v, v, v, true};
		return TY_OK;
	}
	if (high - low == 2)
	{
		join_two(b->mesh, vertex_at(b, low), vertex_at(b, low + 1), (uint32_t) (2 * low), result);
		return TY_OK;
	}
	middle = split_point(b->keys, low, high);
	if ((status = build(b, low, middle, &first)) != TY_OK || (status = build(b, middle, high, &second)) != TY_OK)
		return status;
	if (high - low > POLL_RANGE)
	{
		if (ty_interrupted(b->mesh->env))
			return TY_INTERRUPTED;
		ty_progress(b->mesh->env, TY_MESHING, high, b->n);
	}
	t = (uint32_t) (2 * middle - 2);
	/* seen so that the separating line is upright: for a level one the plane is turned by 90 degrees */
	if (p[first.right].position.x < p[second.left].position.x)
		status = join(b, &first, &second, first.right, second.left, t);
	else if (p[second.right].position.x < p[first.left].position.x)
		status = join(b, &second, &first, second.right, first.left, t);
	else if (p[first.top].position.y < p[second.bottom].position.y)
		status = join(b, &first, &second, first.top, second.bottom, t);
	else
		status = join(b, &second, &first, second.top, first.bottom, t);
	*result = unite(p, &first, &second);
	return status;
}

/* gives every vertex a half-edge of its own */
static void
index_edges(ty_mesh *mesh)
{
	for (uint32_t t = 0; t < mesh->used_triangles; t++)
		for (uint32_t i = 0; i < 3; i++)
		{
			uint32_t v = mesh->triangles[t].vertex[i];

			if (v != TY_GHOST)
				mesh->vertex[v].edge = ty_half_edge(t, i);
		}
}

ty_status
ty_mesh_triangulate(ty_mesh *mesh, const uint32_t *list, const uint64_t *keys, size_t n)
{
	builder b = {mesh, list, keys, n};
	part whole;
	ty_status status = build(&b, 0, n, &whole);

	mesh->live = n;
	mesh->used_triangles = (uint32_t) (2 * n - 2);
	mesh->free_triangle = TY_NONE;
	mesh->stack_count = 0;
	if (n == 1)
		mesh->vertex[vertex_at(&b, 0)].edge = 0;
	else if (status == TY_OK)
		index_edges(mesh);
	return status;
}

ty_status
ty_mesh_build(const ty_environment *env, ty_vertex *vertex, size_t vertices, const uint32_t *list, const uint64_t *keys,
			  size_t n, ty_mesh *mesh)
{
	ty_status status = TY_NO_MEMORY;

	*mesh = (ty_mesh){.env = env, .vertex = vertex, .vertices = vertices, .stack_capacity = 64, .ring_capacity = 64};
	if (vertices > TY_MAX_VERTICES)
		return TY_TOO_MANY;
	mesh->triangles = ty_allocate_array(env, 2 * n - 2, sizeof *mesh->triangles);
	mesh->stack = ty_allocate_array(env, mesh->stack_capacity, sizeof *mesh->stack);
	mesh->ring = ty_allocate_array(env, mesh->ring_capacity, sizeof *mesh->ring);
	if (mesh->triangles != NULL && mesh->stack != NULL && mesh->ring != NULL)
	{
		for (size_t v = 0; v < vertices; v++)
			mesh->vertex[v].edge = TY_NONE;
		status = ty_mesh_triangulate(mesh, list, keys, n);
	}
	if (status != TY_OK)
		ty_mesh_free(mesh);
	return status;
}

void
ty_mesh_free(ty_mesh *mesh)
{
	ty_release(mesh->env, mesh->triangles);
	ty_release(mesh->env, mesh->stack);
	ty_release(mesh->env, mesh->ring);
	mesh->triangles = NULL;
	mesh->stack = NULL;
	mesh->ring = NULL;
}
