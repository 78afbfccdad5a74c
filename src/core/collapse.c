/*
 * collapse.c - see collapse.h
 *
 * The order is kept by a lazy covering queue. Every vertex has a key: the cost and other end of an edge. The
 * one invariant is: for every edge of the mesh, the key of one of its ends is not greater than the edge, in
 * the order (cost, smaller rank, larger rank). So the least key is a lower bound for all edges. When it is
 * popped its vertex is looked at again: if its least edge is still that one, it is the least of all; if not,
 * the vertex gets its true key and goes back. A collapse therefore has to give a key to one vertex only, the
 * merged one, which covers all its edges; edges that flips make between two others are covered as they are
 * made.
 *
 * The first keys are sorted once and read in order; only vertices that got a new key enter the heap. Entries
 * are not removed when a key changes: an entry counts only while it equals its vertex's key.
 */
#include "collapse.h"
#include "predicates.h"

#include <math.h>
#include <string.h>

#define POLL_INTERVAL 512 /* merges between two looks for an interrupt: about a millisecond */
#define FIRST_HEAP 64

/* an edge in the queue, owned by the vertex whose key it is */
typedef struct entry
{
	double cost;
	uint32_t owner, other;
} entry;

typedef struct cluster
{
	int64_t sum_x, sum_y; /* of all represented centroids, in grid cells: exact */
} cluster;

typedef struct run
{
	const ty_environment *env;
	ty_position *position;
	size_t n;
	double s_u;
	ty_mesh mesh;
	cluster *cluster;				/* [n] */
	uint32_t *size;					/* [n] r, how many buildings a vertex represents */
	double *key;					/* [n] INFINITY: no edge to cover */
	uint32_t *other;				/* [n] the other end of the key's edge */
	bool *rekeyed;					/* [n] the vertex has had another key than its first */
	uint32_t *first;				/* vertices in the order of their first keys ... */
	size_t first_count, first_next; /* ... of which those before first_next are done */
	entry *heap;
	size_t heap_count, heap_capacity;
	uint32_t *near; /* for min_distance: vertices that may have a neighbour nearer than it; else NULL */
	size_t near_count;
	ty_sequence *sequence;
	ty_after_merge after_merge;
	void *context;	  /* of after_merge */
	ty_status status; /* of what cannot return one: the mesh's edge_made */
} run;

/* ---- cost and order ---- */

/* f_a * distance (paper; symmetric form of spec 2.3) */
static double
edge_cost(const run *run, uint32_t a, uint32_t b)
{
	double length = sqrt((double) ty_squared_distance(run->position[a], run->position[b]));
	double factor = run->s_u * (((double) run->size[a] - 1) + ((double) run->size[b] - 1)) + 1;

	return factor * length;
}

static uint32_t
smaller(uint32_t a, uint32_t b)
{
	return a < b ? a : b;
}

static uint32_t
larger(uint32_t a, uint32_t b)
{
	return a < b ? b : a;
}

/* the total order of edges: cost, smaller rank, larger rank */
static bool
before(entry a, entry b)
{
	if (a.cost != b.cost)
		return a.cost < b.cost;
	if (smaller(a.owner, a.other) != smaller(b.owner, b.other))
		return smaller(a.owner, a.other) < smaller(b.owner, b.other);
	return larger(a.owner, a.other) < larger(b.owner, b.other);
}

static entry
key_of(const run *run, uint32_t v)
{
	return (entry){run->key[v], v, run->other[v]};
}

/* ---- heap: 4-ary, the least on top ---- */

static void
sift_down(entry *heap, size_t count, size_t at)
{
	entry e = heap[at];

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

/* whether the entry is the current key of a vertex that is still there */
static bool
is_current(const run *run, entry e)
{
	return run->mesh.edge[e.owner] != TY_NONE && run->key[e.owner] == e.cost && run->other[e.owner] == e.other;
}

/* Drops entries that no longer count, or finds more room. */
static ty_status
make_room(run *run)
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
		entry *heap = ty_reallocate_array(run->env, run->heap, capacity, sizeof *heap);

		if (heap == NULL)
			return TY_NO_MEMORY;
		run->heap = heap;
		run->heap_capacity = capacity;
	}
	return TY_OK;
}

static ty_status
push(run *run, entry e)
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
pop(run *run)
{
	run->heap[0] = run->heap[--run->heap_count];
	if (run->heap_count > 0)
		sift_down(run->heap, run->heap_count, 0);
}

/* ---- keys ---- */

static ty_status
set_key(run *run, entry e)
{
	run->key[e.owner] = e.cost;
	run->other[e.owner] = e.other;
	run->rekeyed[e.owner] = true;
	return e.cost < INFINITY ? push(run, e) : TY_OK;
}

/* the least edge at v; cost INFINITY when there is none */
static entry
least_edge(const run *run, uint32_t v)
{
	entry least = {INFINITY, v, TY_NONE};
	uint32_t first = run->mesh.edge[v], h = first;

	if (run->mesh.live < 2)
		return least;
	do
	{
		uint32_t w = ty_target(&run->mesh, h);

		if (w != TY_GHOST)
		{
			entry e = {edge_cost(run, v, w), v, w};

			if (before(e, least))
				least = e;
		}
	} while ((h = ty_next_around(&run->mesh, h)) != first);
	return least;
}

/* Covers an edge that a flip has made between two vertices that keep their keys. */
static void
cover_edge(void *context, uint32_t a, uint32_t b)
{
	run *run = context;
	entry e = {edge_cost(run, a, b), a, b};

	if (run->status == TY_OK && before(e, key_of(run, a)) && before(e, key_of(run, b)))
		run->status = set_key(run, e);
}

/* The first keys: every edge is covered by its end of smaller rank. */
static ty_status
first_keys(run *run)
{
	for (uint32_t h = 0; h < 3 * run->mesh.used_triangles; h++)
	{
		uint32_t a = ty_origin(&run->mesh, h), b = ty_target(&run->mesh, h);

		if (ty_interrupted_at(run->env, h))
			return TY_INTERRUPTED;
		if (a < b && b != TY_GHOST)
		{
			entry e = {edge_cost(run, a, b), a, b};

			if (before(e, key_of(run, a)))
			{
				run->key[a] = e.cost;
				run->other[a] = b;
			}
		}
	}
	return TY_OK;
}

/* Sorts the vertices by their first keys. Costs are not negative: their bits ascend as they do. bits: scratch. */
static ty_status
sort_first_keys(run *run, uint64_t *bits)
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
least_key(run *run, entry *least)
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

/* Finds the least edge of the mesh; owner TY_NONE when it has none. */
static ty_status
least_of_all(run *run, entry *least)
{
	while (least_key(run, least))
	{
		entry now = least_edge(run, least->owner);
		ty_status status;

		if (!before(*least, now))
		{
			*least = now;
			return TY_OK;
		}
		status = set_key(run, now); /* the edge has gone or grown: the vertex goes back with what it has */
		if (status != TY_OK)
			return status;
	}
	least->owner = TY_NONE;
	return TY_OK;
}

/* ---- merging ---- */

static void
record(run *run, uint32_t kept, uint32_t gone, double cost)
{
	ty_sequence *s = run->sequence;

	s->kept[s->count] = kept;
	s->gone[s->count] = gone;
	if (s->cost != NULL)
		s->cost[s->count] = cost;
	s->count++;
}

/* for tests: shows the mesh, or NULL while two vertices share a place */
static void
show(const run *run, const ty_mesh *mesh)
{
	if (run->after_merge != NULL)
		run->after_merge(run->context, mesh, run->sequence->count);
}

/* sum / count, rounded half up to the grid */
static int32_t
mean(int64_t sum, uint32_t count)
{
	return (int32_t) ((2 * sum + count) / (2 * (int64_t) count));
}

/* adds gone to kept and records it; returns the mean of all that both represent */
static ty_position
merge(run *run, uint32_t kept, uint32_t gone, double cost)
{
	cluster *c = &run->cluster[kept];

	c->sum_x += run->cluster[gone].sum_x;
	c->sum_y += run->cluster[gone].sum_y;
	run->size[kept] += run->size[gone];
	record(run, kept, gone, cost);
	return (ty_position){mean(c->sum_x, run->size[kept]), mean(c->sum_y, run->size[kept])};
}

/*
 * Merges vertices that share a place from the start: each run of equal positions in turn, at cost 0, until
 * count vertices are left. Lists one vertex of every place, and its key at the front of keys.
 */
static ty_status
merge_coincident(run *run, size_t count, uint32_t *distinct, uint64_t *keys, size_t *distinct_count)
{
	size_t places = 0;

	for (size_t v = 0; v < run->n; v++)
	{
		if (ty_interrupted_at(run->env, v))
			return TY_INTERRUPTED;
		if (v > 0 && keys[places - 1] == keys[v] && run->n - run->sequence->count > count)
		{
			merge(run, distinct[places - 1], (uint32_t) v, 0);
			show(run, NULL);
			continue;
		}
		distinct[places] = (uint32_t) v;
		keys[places++] = keys[v];
	}
	*distinct_count = places;
	return TY_OK;
}

/* ---- minimum distance ---- */

/*
 * Whether two vertices are nearer than the minimum distance. The nearest neighbour of a vertex is a Delaunay
 * neighbour, and vertices do not move: one that has been found to have none so near need not be looked at
 * again unless a new vertex appears, which is then looked at itself.
 */
static bool
too_near(run *run, double min_distance)
{
	while (run->near_count > 0)
	{
		uint32_t v = run->near[run->near_count - 1];
		uint32_t first = run->mesh.edge[v], h = first;

		if (first != TY_NONE && run->mesh.live > 1)
			do
			{
				uint32_t w = ty_target(&run->mesh, h);

				if (w != TY_GHOST &&
					sqrt((double) ty_squared_distance(run->position[v], run->position[w])) < min_distance)
					return true;
			} while ((h = ty_next_around(&run->mesh, h)) != first);
		run->near_count--;
	}
	return false;
}

/* ---- the loop ---- */

/* whether merging goes on: too many are left, or two of them are too near */
static bool
goes_on(run *run, ty_stop stop)
{
	return run->n - run->sequence->count > stop.count || (stop.min_distance > 0 && too_near(run, stop.min_distance));
}

/*
 * Collapses the edge. When the merged vertex comes to lie on another one, the two are the next to merge, at
 * cost 0, unless that would be one merge too many.
 */
static ty_status
collapse_edge(run *run, entry e, ty_stop stop)
{
	uint32_t kept = smaller(e.owner, e.other), gone = larger(e.owner, e.other), met;
	ty_position to = merge(run, kept, gone, e.cost);
	ty_status status = ty_mesh_collapse(&run->mesh, kept, gone, to, &met);

	while (status == TY_OK && met != TY_NONE)
	{
		uint32_t first = smaller(kept, met), second = larger(kept, met);

		run->position[kept] = to;
		show(run, NULL);
		if (run->n - run->sequence->count <= stop.count && !(stop.min_distance > 0))
			return TY_OK;
		to = merge(run, first, second, 0);
		status = ty_mesh_move(&run->mesh, met, first, to, &met);
		kept = first;
	}
	if (status == TY_OK)
		show(run, &run->mesh);
	if (status == TY_OK && run->near != NULL)
		run->near[run->near_count++] = kept;
	if (status == TY_OK && run->status == TY_OK)
		status = set_key(run, least_edge(run, kept));
	return status == TY_OK ? run->status : status;
}

static ty_status
collapse_all(run *run, ty_stop stop)
{
	ty_status status = TY_OK;

	for (size_t step = 1; status == TY_OK && goes_on(run, stop); step++)
	{
		entry least;

		status = least_of_all(run, &least);
		if (status == TY_OK && least.owner == TY_NONE)
			break;
		if (status == TY_OK)
			status = collapse_edge(run, least, stop);
		if (status == TY_OK && step % POLL_INTERVAL == 0 && ty_interrupted(run->env))
			status = TY_INTERRUPTED;
	}
	return status;
}

/* ---- set-up ---- */

/* Builds the mesh over the distinct places, after the merges at cost 0. */
static ty_status
prepare_mesh(run *run, uint64_t *keys, ty_stop stop)
{
	uint32_t *distinct = ty_allocate_array(run->env, run->n, sizeof *distinct);
	size_t least = stop.min_distance > 0 ? 1 : stop.count;
	size_t places;
	ty_status status;

	if (distinct == NULL)
		return TY_NO_MEMORY;
	status = merge_coincident(run, least, distinct, keys, &places);
	if (status == TY_OK && run->n - run->sequence->count > least)
	{
		status = ty_mesh_build(run->env, run->position, run->n, distinct, keys, places, &run->mesh);
		run->mesh.edge_made = cover_edge;
		run->mesh.edge_context = run;
		for (size_t i = 0; status == TY_OK && run->near != NULL && i < places; i++)
			run->near[run->near_count++] = distinct[i];
	}
	ty_release(run->env, distinct);
	return status;
}

static ty_status
allocate_run(run *run, bool with_near)
{
	run->cluster = ty_allocate_array(run->env, run->n, sizeof *run->cluster);
	run->size = ty_allocate_array(run->env, run->n, sizeof *run->size);
	run->key = ty_allocate_array(run->env, run->n, sizeof *run->key);
	run->other = ty_allocate_array(run->env, run->n, sizeof *run->other);
	run->rekeyed = ty_allocate_array(run->env, run->n, sizeof *run->rekeyed);
	run->first = ty_allocate_array(run->env, run->n, sizeof *run->first);
	run->heap = ty_allocate_array(run->env, run->heap_capacity, sizeof *run->heap);
	if (with_near)
		run->near = ty_allocate_array(run->env, 2 * run->n, sizeof *run->near);
	if (run->cluster == NULL || run->size == NULL || run->key == NULL || run->other == NULL || run->rekeyed == NULL ||
		run->first == NULL || run->heap == NULL || (with_near && run->near == NULL))
		return TY_NO_MEMORY;
	for (size_t v = 0; v < run->n; v++)
	{
		run->cluster[v] = (cluster){run->position[v].x, run->position[v].y};
		run->size[v] = 1;
		run->key[v] = INFINITY;
		run->other[v] = TY_NONE;
		run->rekeyed[v] = false;
	}
	return TY_OK;
}

static void
free_run(run *run)
{
	if (run->mesh.env != NULL)
		ty_mesh_free(&run->mesh);
	ty_release(run->env, run->cluster);
	ty_release(run->env, run->size);
	ty_release(run->env, run->key);
	ty_release(run->env, run->other);
	ty_release(run->env, run->rekeyed);
	ty_release(run->env, run->first);
	ty_release(run->env, run->heap);
	ty_release(run->env, run->near);
}

static ty_status
allocate_sequence(const ty_environment *env, size_t merges, bool with_cost, ty_sequence *sequence)
{
	sequence->kept = ty_allocate_array(env, merges, sizeof *sequence->kept);
	sequence->gone = ty_allocate_array(env, merges, sizeof *sequence->gone);
	if (with_cost)
		sequence->cost = ty_allocate_array(env, merges, sizeof *sequence->cost);
	if (sequence->kept == NULL || sequence->gone == NULL || (with_cost && sequence->cost == NULL))
		return TY_NO_MEMORY;
	return TY_OK;
}

ty_status
ty_collapse(const ty_environment *env, ty_position *position, uint64_t *keys, size_t n, double s_u, ty_stop stop,
			bool with_cost, ty_after_merge after_merge, void *context, ty_sequence *sequence)
{
	size_t least = stop.min_distance > 0 || stop.count < 1 ? 1 : stop.count;
	run run = {.env = env,
			   .position = position,
			   .n = n,
			   .s_u = s_u,
			   .heap_capacity = FIRST_HEAP,
			   .sequence = sequence,
			   .after_merge = after_merge,
			   .context = context};
	ty_status status;

	*sequence = (ty_sequence){0};
	if (n > TY_MAX_VERTICES)
		return TY_TOO_MANY;
	status = allocate_sequence(env, n > least ? n - least : 0, with_cost, sequence);
	if (status == TY_OK && n > least)
	{
		status = allocate_run(&run, stop.min_distance > 0);
		if (status == TY_OK)
			status = prepare_mesh(&run, keys, stop);
		if (status == TY_OK && run.mesh.env != NULL)
			status = sort_first_keys(&run, keys); /* the keys have served: their room serves again */
		if (status == TY_OK && run.mesh.env != NULL)
			status = collapse_all(&run, stop);
		free_run(&run);
	}
	if (status != TY_OK)
		ty_sequence_free(env, sequence);
	return status;
}

void
ty_sequence_free(const ty_environment *env, ty_sequence *sequence)
{
	ty_release(env, sequence->kept);
	ty_release(env, sequence->gone);
	ty_release(env, sequence->cost);
	*sequence = (ty_sequence){0};
}

size_t
ty_sequence_cut(const ty_sequence *sequence, size_t merges, size_t n, uint32_t *label)
{
	size_t count = 0;

	for (size_t rank = 0; rank < n; rank++)
		label[rank] = (uint32_t) rank;
	for (size_t i = 0; i < merges; i++)
		label[sequence->gone[i]] = sequence->kept[i];
	/* the kept rank is always the smaller one, so its number is known by then */
	for (size_t rank = 0; rank < n; rank++)
		label[rank] = label[rank] == rank ? (uint32_t) count++ : label[label[rank]];
	return count;
}
