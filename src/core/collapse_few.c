/*
 * collapse_few.c - the collapse of a group so small that looking at all pairs costs less than a mesh.
 *
 * Only edges of the Delaunay mesh are collapsed, and they are among all pairs. So the pairs are taken in the order of
 * the edges, and the first that the mesh has is the one: it has it where an empty circle passes through both ends,
 * which is found out exactly, ties included, by the same predicates that make the mesh. With s_u = 0 costs are
 * distances, and there is nothing to find out: the nearest pair is always an edge, since the disc over it is empty.
 * Two vertices at one place come first, at cost 0, as they do beside a mesh.
 */
#include "collapse_internal.h"

#include <math.h>

/* Pairs of a vertex are those with the later ones. Vertices are bits of a word. */
typedef struct few
{
	ty_run *run;
	uint64_t live;
	uint64_t barred[TY_FEW]; /* those that the mesh has no edge to, as far as that has been found out */
	double cost[TY_FEW];	 /* of the vertex's least pair that is not barred; INFINITY: there is none */
	uint32_t other[TY_FEW];
} few;

static uint64_t
bit_of(uint32_t v)
{
	return UINT64_C(1) << v;
}

/* the first vertex of a set, which is not empty; it leaves the set */
static uint32_t
take_first(uint64_t *set)
{
	uint32_t v = (uint32_t) __builtin_ctzll(*set);

	*set &= *set - 1;
	return v;
}

/* Finds the vertex's least pair anew. */
static void
find_pair(few *f, uint32_t v)
{
	uint64_t later = f->live & ~f->barred[v] & ~(bit_of(v) | (bit_of(v) - 1));

	f->cost[v] = INFINITY;
	f->other[v] = TY_NONE;
	while (later != 0)
	{
		uint32_t w = take_first(&later);
		double cost = ty_plain_cost(f->run, v, w);

		f->other[v] = cost < f->cost[v] ? w : f->other[v];
		f->cost[v] = cost < f->cost[v] ? cost : f->cost[v];
	}
}

/* the vertex with the least pair of all: of those at one cost the first, as ty_before has it */
static uint32_t
least_pair(const few *f)
{
	uint64_t set = f->live;
	uint32_t least = take_first(&set);

	while (set != 0)
	{
		uint32_t v = take_first(&set);

		least = f->cost[v] < f->cost[least] ? v : least;
	}
	return least;
}

/* > 0: the angle at w under which a and b are seen is acute, so w lies outside of the disc over them */
static int64_t
opening(const ty_vertex *p, uint32_t a, uint32_t b, uint32_t w)
{
	ty_position o = p[w].position;

	return ((int64_t) p[a].position.x - o.x) * ((int64_t) p[b].position.x - o.x) +
		   ((int64_t) p[a].position.y - o.y) * ((int64_t) p[b].position.y - o.y);
}

static bool
circle_holds(const ty_vertex *p, uint32_t a, uint32_t b, uint32_t c, uint32_t d)
{
	return ty_in_circle(p[a].position, p[b].position, p[c].position, p[d].position, a, b, c, d);
}

/* whether the disc over a and b holds no other vertex, not even on its rim */
static bool
disc_is_empty(const few *f, uint32_t a, uint32_t b)
{
	uint64_t others = f->live & ~bit_of(a) & ~bit_of(b);
	bool empty = true;

	while (others != 0)
		empty &= opening(f->run->vertex, a, b, take_first(&others)) > 0;
	return empty;
}

/*
 * Whether the mesh has an edge between two vertices, no two being at one place. On either side the triangle at the
 * edge would have as its apex the vertex whose circle through a and b holds no other of that side.
 */
static bool
is_edge(const few *f, uint32_t a, uint32_t b)
{
	const ty_vertex *p = f->run->vertex;
	uint64_t others = f->live & ~bit_of(a) & ~bit_of(b);
	uint32_t left = TY_NONE, right = TY_NONE;

	while (others != 0)
	{
		uint32_t w = take_first(&others);
		int64_t side = ty_orientation(p[a].position, p[b].position, p[w].position);

		if (side == 0 && opening(p, a, b, w) < 0)
			return false; /* between them */
		if (side > 0 && (left == TY_NONE || circle_holds(p, a, b, left, w)))
			left = w;
		if (side < 0 && (right == TY_NONE || circle_holds(p, b, a, right, w)))
			right = w;
	}
	return left == TY_NONE || right == TY_NONE || !circle_holds(p, a, b, left, right);
}

static bool
may_merge(const few *f, uint32_t a, uint32_t b)
{
	return f->run->s_u == 0 || f->cost[a] == 0 || disc_is_empty(f, a, b) || is_edge(f, a, b);
}

/* Finds the pairs of a vertex after a has come to another place, b has gone and the mesh has changed. */
static void
look_again(few *f, uint32_t v, uint32_t a, uint32_t b)
{
	if (v == a || f->other[v] == a || f->other[v] == b || f->barred[v] != 0)
	{
		f->barred[v] = 0;
		find_pair(f, v);
	}
	else if (v < a)
	{
		double cost = ty_plain_cost(f->run, v, a);

		if (cost < f->cost[v] || (cost == f->cost[v] && a < f->other[v]))
		{
			f->cost[v] = cost;
			f->other[v] = a;
		}
	}
}

/* Merges b into a, which is the smaller one. */
static void
merge_pair(few *f, uint32_t a, uint32_t b)
{
	ty_run *run = f->run;
	ty_position to = ty_merged_place(run, a, b);

	ty_join(run, a, b, run->vertex[a].position, to);
	run->vertex[a].position = to;
	ty_record(run, b, to, f->cost[a]);
	ty_retire(run, a, b);
	f->live &= ~bit_of(b);
	for (uint64_t set = f->live; set != 0;)
		look_again(f, take_first(&set), a, b);
}

/* whether any two vertices are nearer than the minimum distance */
static bool
are_too_near(const few *f, double min_distance)
{
	const ty_vertex *p = f->run->vertex;

	for (uint64_t set = f->live; set != 0;)
	{
		uint32_t v = take_first(&set);

		for (uint64_t later = set; later != 0;)
			if (sqrt((double) ty_squared_distance(p[v].position, p[take_first(&later)].position)) < min_distance)
				return true;
	}
	return false;
}

void
ty_collapse_few(ty_run *run, ty_stop stop)
{
	few f = {.run = run, .live = UINT64_MAX >> (64 - run->n)};

	for (uint32_t v = 0; v < run->n; v++)
		find_pair(&f, v);
	while (run->n - run->sequence->count > 1 && (run->n - run->sequence->count > stop.count ||
												 (stop.min_distance > 0 && are_too_near(&f, stop.min_distance))))
	{
		uint32_t a = least_pair(&f), b = f.other[a];

		if (may_merge(&f, a, b))
			merge_pair(&f, a, b);
		else
		{
			f.barred[a] |= bit_of(b);
			find_pair(&f, a);
		}
	}
}
