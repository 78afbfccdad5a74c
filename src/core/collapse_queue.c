/*
 * collapse_queue.c - the priority order of the edges: a lazy covering queue.
 *
 * Every vertex has a key: the cost and other end of an edge. The one invariant is: for every edge of the mesh,
 * the key of one of its ends is not greater than the edge, in the order (cost, smaller rank, larger rank). So
 * the least key is a lower bound for all edges. When it is popped its vertex is looked at again: if its least
 * edge is still that one, it is the least of all; if not, the vertex gets its true key and goes back. A collapse
 * therefore has to give a key to one vertex only, the merged one, which covers all its edges; edges that flips
 * make between two others are covered as they are made.
 *
 * The first keys are sorted once and read in order; only vertices that got a new key enter the heap. Entries
 * are not removed when a key changes: an entry counts only while it equals its vertex's key.
 */
#include "collapse_internal.h"

#include <math.h>
#include <string.h>

/* ---- cost and order ---- */

/* f_a * distance (paper; symmetric form of spec 2.3) */
static double
edge_cost(const ty_run *run, uint32_t a, uint32_t b)
{
	double length = sqrt((double) ty_squared_distance(run->position[a], run->position[b]));
	double factor = run->s_u * (((double) run->size[a] - 1) + ((double) run->size[b] - 1)) + 1;

	return factor * length;
}

/* the total order of edges: cost, smaller rank, larger rank */
static bool
before(ty_edge a, ty_edge b)
{
	if (a.cost != b.cost)
		return a.cost < b.cost;
	if (ty_smaller(a.owner, a.other) != ty_smaller(b.owner, b.other))
		return ty_smaller(a.owner, a.other) < ty_smaller(b.owner, b.other);
	return ty_larger(a.owner, a.other) < ty_larger(b.owner, b.other);
}

static ty_edge
key_of(const ty_run *run, uint32_t v)
{
	return (ty_edge){run->key[v], v, run->other[v]};
}

/* ---- heap: 4-ary, the least on top ---- */

static void
sift_down(ty_edge *heap, size_t count, size_t at)
{
	ty_edge e = heap[at];

	for (;;)
	{
		size_t child = 4 * at + 1, least = child;

		if (child >= count)
			break;
		for (size_t i = child + 1; i < child + 4 && i < count; i++)
			if (before(heap[i], heap[least]))
				least = i;
		if (!before(heap[least], e))
			break;
		heap[at] = heap[least];
		at = least;
	}
	heap[at] = e;
}

/* whether the ty_edge is the current key of a vertex that is still there */
static bool
is_current(const ty_run *run, ty_edge e)
{
	return run->mesh.edge[e.owner] != TY_NONE && run->key[e.owner] == e.cost && run->other[e.owner] == e.other;
}

/* Drops entries that no longer count, or finds more room. */
static ty_status
make_room(ty_run *run)
{
	size_t count = 0;

	for (size_t i = 0; i < run->heap_count; i++)
		if (is_current(run, run->heap[i]))
			run->heap[count++] = run->heap[i];
	run->heap_count = count;
	for (size_t i = count / 4 + 1; i-- > 0 && count > 0;)
		sift_down(run->heap, count, i);
	if (count > run->heap_capacity / 2)
	{
		size_t capacity = 2 * run->heap_capacity;
		ty_edge *heap = ty_reallocate_array(run->env, run->heap, capacity, sizeof *heap);

		if (heap == NULL)
			return TY_NO_MEMORY;
		run->heap = heap;
		run->heap_capacity = capacity;
	}
	return TY_OK;
}

static ty_status
push(ty_run *run, ty_edge e)
{
	size_t at;

	if (run->heap_count == run->heap_capacity)
	{
		ty_status status = make_room(run);

		if (status != TY_OK)
			return status;
	}
	for (at = run->heap_count++; at > 0 && before(e, run->heap[(at - 1) / 4]); at = (at - 1) / 4)
		run->heap[at] = run->heap[(at - 1) / 4];
	run->heap[at] = e;
	return TY_OK;
}

static void
pop(ty_run *run)
{
	run->heap[0] = run->heap[--run->heap_count];
	if (run->heap_count > 0)
		sift_down(run->heap, run->heap_count, 0);
}

/* ---- keys ---- */

ty_status
ty_queue_set(ty_run *run, ty_edge e)
{
	run->key[e.owner] = e.cost;
	run->other[e.owner] = e.other;
	run->rekeyed[e.owner] = true;
	return e.cost < INFINITY ? push(run, e) : TY_OK;
}

ty_edge
ty_least_edge(const ty_run *run, uint32_t v)
{
	ty_edge least = {INFINITY, v, TY_NONE};
	uint32_t first = run->mesh.edge[v], h = first;

	if (run->mesh.live < 2)
		return least;
	do
	{
		uint32_t w = ty_target(&run->mesh, h);

		if (w != TY_GHOST)
		{
			ty_edge e = {edge_cost(run, v, w), v, w};

			if (before(e, least))
				least = e;
		}
	} while ((h = ty_next_around(&run->mesh, h)) != first);
	return least;
}

void
ty_cover_edge(void *context, uint32_t a, uint32_t b)
{
	ty_run *run = context;
	ty_edge e = {edge_cost(run, a, b), a, b};

	if (run->status == TY_OK && before(e, key_of(run, a)) && before(e, key_of(run, b)))
		run->status = ty_queue_set(run, e);
}

/* The first keys: every edge is covered by its end of smaller rank. */
static ty_status
first_keys(ty_run *run)
{
	for (uint32_t h = 0; h < 3 * run->mesh.used_triangles; h++)
	{
		uint32_t a = ty_origin(&run->mesh, h), b = ty_target(&run->mesh, h);

		if (ty_interrupted_at(run->env, h))
			return TY_INTERRUPTED;
		if (a < b && b != TY_GHOST)
		{
			ty_edge e = {edge_cost(run, a, b), a, b};

			if (before(e, key_of(run, a)))
			{
				run->key[a] = e.cost;
				run->other[a] = b;
			}
		}
	}
	return TY_OK;
}

/* Costs are not negative: their bits ascend as they do. */
ty_status
ty_queue_begin(ty_run *run, uint64_t *bits)
{
	ty_status status = first_keys(run);
	size_t count = 0;

	for (size_t v = 0; v < run->n; v++)
		if (run->key[v] < INFINITY)
		{
			memcpy(&bits[count], &run->key[v], sizeof *bits);
			run->first[count++] = (uint32_t) v;
		}
	run->first_count = count;
	return status == TY_OK ? ty_sort_keys(run->env, bits, run->first, count) : status;
}

/* The least current key of the sorted ones and of the heap; false when there is none. */
static bool
least_key(ty_run *run, ty_edge *least)
{
	bool found = false;

	while (run->first_next < run->first_count)
	{
		uint32_t v = run->first[run->first_next];

		if (run->mesh.edge[v] != TY_NONE && !run->rekeyed[v])
		{
			*least = key_of(run, v);
			found = true;
			break;
		}
		run->first_next++;
	}
	while (run->heap_count > 0 && !is_current(run, run->heap[0]))
		pop(run);
	if (run->heap_count > 0 && (!found || before(run->heap[0], *least)))
	{
		*least = run->heap[0];
		found = true;
	}
	return found;
}

ty_status
ty_queue_least(ty_run *run, ty_edge *least)
{
	while (least_key(run, least))
	{
		ty_edge now = ty_least_edge(run, least->owner);
		ty_status status;

		if (!before(*least, now))
		{
			*least = now;
			return TY_OK;
		}
		status = ty_queue_set(run, now); /* the edge has gone or grown: the vertex goes back with what it has */
		if (status != TY_OK)
			return status;
	}
	least->owner = TY_NONE;
	return TY_OK;
}
