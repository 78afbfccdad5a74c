/*
 * collapse_queue.c - the priority order of the edges: a lazy covering queue.
 *
 * Entries of the queue are edges, or lower bounds for the edges of a vertex. The one invariant is: for every edge
 * of the mesh there is an entry of one of its ends that is not greater, in the order (cost, smaller rank, larger
 * rank), a bound coming before all edges of its cost. So the least entry is a lower bound for all edges. If it is
 * an edge that still exists, it is the least of all; if not, its vertex is looked at again and gets another entry.
 * A collapse therefore has to give an entry to one vertex only, the merged one; edges that flips make between two
 * others are covered as they are made.
 *
 * A vertex that gets an entry leaves edges aside that their other ends cover: its entry is the least of the rest, none
 * where there is no rest. So the invariant holds, whatever the order, for an end that gets a greater entry later is
 * answerable for the edge then. To enter the least of all its edges meant to look again half as often more.
 *
 * A vertex's key is the cost of its entry, rounded down to a float. Entries are not removed when a vertex gets
 * another: one that differs from the key counts no longer. (One that equals it by chance does no harm: it is
 * checked like any other.)
 *
 * Whether a barrier is in the way of an edge is asked when its entry is the least of all. If so, the next edge of its
 * vertex takes its place: none before it is left to collapse, or an entry would come before.
 *
 * Entries of least cost are in a heap, all others wait in buckets by their keys, as bounds (collapse_bucket.c).
 */
#include "collapse_internal.h"

#include <string.h>

/* From this many vertices on there are buckets; fewer and their heap fit into a cache. Tests set it. */
#ifndef TY_LEAST_BUCKETED
#define TY_LEAST_BUCKETED 2048
#endif
#define FIRST_HEAP 64

/* ---- cost and order ---- */

/* with what influences make of it, barriers aside */
static inline double
edge_cost(const ty_run *run, uint32_t a, uint32_t b)
{
	double cost = ty_plain_cost(run, a, b);

	return __builtin_expect(run->influence == NULL, 1) ? cost : ty_influenced_cost(run, a, b, cost);
}

/* bits of the largest float that is not above a cost; they ascend as costs do, which are not negative */
static int32_t
key_of_cost(double cost)
{
	float rounded = (float) cost;
	int32_t bits;

	memcpy(&bits, &rounded, sizeof bits);
	return bits - ((double) rounded > cost); /* no branch: it would be guessed wrong every other time */
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
			if (ty_before(heap[i], heap[least]))
				least = i;
		if (!ty_before(heap[least], e))
			break;
		heap[at] = heap[least];
		at = least;
	}
	heap[at] = e;
}

static void
heapify(ty_queue *queue)
{
	for (size_t i = queue->heap_count / 4 + 1; i-- > 0 && queue->heap_count > 0;)
		sift_down(queue->heap, queue->heap_count, i);
}

/* whether an entry is still its vertex's; one that is gone has no key */
static bool
is_current(const ty_run *run, ty_edge e)
{
	return run->queue.key[e.owner] == key_of_cost(e.cost);
}

/* Drops entries that no longer count, or finds more room. */
static ty_status
make_room(ty_run *run)
{
	ty_queue *queue = &run->queue;
	size_t count = 0;

	for (size_t i = 0; i < queue->heap_count; i++)
		if (is_current(run, queue->heap[i]))
			queue->heap[count++] = queue->heap[i];
	queue->heap_count = count;
	heapify(queue);
	if (count > queue->heap_capacity / 4 * 3)
	{
		size_t capacity = queue->heap_capacity + queue->heap_capacity / 4;
		ty_edge *heap = ty_reallocate_array(run->env, queue->heap, capacity, sizeof *heap);

		if (heap == NULL)
			return TY_NO_MEMORY;
		queue->heap = heap;
		queue->heap_capacity = capacity;
	}
	return TY_OK;
}

static ty_status
push(ty_run *run, ty_edge e)
{
	ty_queue *queue = &run->queue;
	size_t at;

	if (queue->heap_count == queue->heap_capacity)
	{
		ty_status status = make_room(run);

		if (status != TY_OK)
			return status;
	}
	for (at = queue->heap_count++; at > 0 && ty_before(e, queue->heap[(at - 1) / 4]); at = (at - 1) / 4)
		queue->heap[at] = queue->heap[(at - 1) / 4];
	queue->heap[at] = e;
	return TY_OK;
}

static void
pop(ty_queue *queue)
{
	queue->heap[0] = queue->heap[--queue->heap_count];
	if (queue->heap_count > 0)
		sift_down(queue->heap, queue->heap_count, 0);
}

/* ---- keys ---- */

ty_status
ty_queue_set(ty_run *run, ty_edge e)
{
	ty_queue *queue = &run->queue;

	queue->key[e.owner] = key_of_cost(e.cost);
	if (e.cost == INFINITY)
		return TY_OK;
	return ty_is_near(queue, e) ? push(run, e) : ty_bucket_add(run, e.owner);
}

ty_status
ty_queue_settle(ty_run *run, ty_edge e)
{
	ty_queue *queue = &run->queue;

	if (queue->sorted_count == TY_SORTED || e.other == TY_NONE || !ty_is_near(queue, e))
		return ty_queue_set(run, e);
	queue->key[e.owner] = key_of_cost(e.cost);
	queue->sorted[TY_SORTED + queue->sorted_count++] = e;
	return TY_OK;
}

/* A partner's key is negative: below all costs, and unlike any entry's. */
void
ty_queue_part(ty_run *run, uint32_t a, uint32_t b)
{
	run->queue.key[a] = (int32_t) (b | 0x80000000);
	run->queue.key[b] = (int32_t) (a | 0x80000000);
}

bool
ty_queue_partners(const ty_run *run, uint32_t a, uint32_t b)
{
	return run->queue.key[a] == (int32_t) (b | 0x80000000);
}

/*
 * Whether w has an entry that is not greater than an edge of its at that cost. Where the keys are alike the entry may
 * be the greater one, but not if the edge lies beyond what is near: w's is near then, or waits in a bucket and counts
 * as a bound of the key's own cost, or is about to be looked at again. Partners' keys are below all others.
 */
static inline bool
covers(const ty_queue *queue, uint32_t w, double cost)
{
	return queue->key[w] < key_of_cost(cost) + (cost > queue->limit.cost);
}

/* The least edge at v above one, by ty_before's order, which among edges of one vertex is that of the other ends. */
static __attribute__((noinline)) ty_edge
compare_exactly(const ty_run *run, uint32_t v, ty_edge above, bool uncovered)
{
	uint32_t first = run->vertex[v].edge, h = first, w;
	ty_edge least = {INFINITY, v, TY_NONE};

	do
	{
		ty_edge e;

		h = ty_step_around(&run->mesh, h, &w);
		if (w == TY_GHOST)
			continue;
		e = (ty_edge){ty_plain_cost(run, v, w), v, w};
		if (!ty_before(e, least)) /* then influences, which only lengthen it, need not be asked */
			continue;
		if (run->influence != NULL)
			e.cost = ty_influenced_cost(run, v, w, e.cost);
		if (ty_before(e, least) && ty_before(above, e) && !(uncovered && covers(&run->queue, w, e.cost)))
			least = e;
	} while (h != first);
	return least;
}

/* how far rounding may bring apart the square of a cost and what is computed without its root */
#define NEARLY (1 + 1e-14)

static inline int64_t
bits_of(double number)
{
	int64_t bits;

	memcpy(&bits, &number, sizeof bits);
	return bits;
}

static inline double
number_of(int64_t bits)
{
	double number;

	memcpy(&number, &bits, sizeof number);
	return number;
}

/* whether w covers an edge with that square of a cost, for certain; beyond: it lies beyond what is near */
static inline bool
covers_squared(const ty_queue *queue, uint32_t w, double squared, bool beyond)
{
	int32_t above = queue->key[w] + !beyond; /* no larger key than w's has a cost of this or more */
	float cost;

	memcpy(&cost, &above, sizeof cost);
	return (double) cost * cost * NEARLY <= squared;
}

/*
 * The hottest loop of all. Which edge is the least would be guessed wrong twice a star, so there is no branch: squared
 * costs, which are not negative, compare as their bits do. They are not exact; so where two are nearly alike, or one is
 * nearly as the bound that it has to be above, all are compared once more. Roots would take as long as all the rest.
 */
static inline __attribute__((always_inline)) ty_edge
least_plain_edge(const ty_run *run, uint32_t v, ty_edge above, bool uncovered)
{
	const ty_vertex *p = &run->vertex[v];
	uint32_t first = p->edge, h = first, other = TY_NONE, w;
	int64_t least = INT64_MAX, second = INT64_MAX;
	double limit = run->queue.limit.cost * run->queue.limit.cost * NEARLY;
	double bound = above.cost * above.cost / NEARLY;
	double factor_less_w = run->s_u * ((double) p->size - 2) + 1;

	do
	{
		h = ty_step_around(&run->mesh, h, &w);
		if (w != TY_GHOST)
		{
			const ty_vertex *q = &run->vertex[w];
			double dx = q->position.x - p->position.x, dy = q->position.y - p->position.y;
			double factor = factor_less_w + run->s_u * (double) (int32_t) q->size;
			double squared = factor * factor * (dx * dx + dy * dy);
			int64_t bits = bits_of(squared), larger;

			if (uncovered)
				bits |= covers_squared(&run->queue, w, squared, squared > limit) ? INT64_MAX : 0;
			if (above.cost > 0)
				bits |= squared < bound ? INT64_MAX : 0;
			other ^= (other ^ w) & -(uint32_t) (bits < least); /* gcc makes a branch of ?: here */
			larger = bits < least ? least : bits;
			least = bits < least ? bits : least;
			second = larger < second ? larger : second;
		}
	} while (h != first);
	if (other == TY_NONE)
		return (ty_edge){INFINITY, v, TY_NONE};
	if (number_of(second) <= number_of(least) * NEARLY || number_of(least) <= bound * NEARLY * NEARLY)
		return compare_exactly(run, v, above, uncovered);
	return (ty_edge){ty_plain_cost(run, v, other), v, other};
}

static const ty_edge below_all = {0, 0, TY_NONE};

/* The least edge at v above a bound, or above an edge of its; uncovered: of those that their other ends do not cover. */
static inline __attribute__((always_inline)) ty_edge
least_edge(const ty_run *run, uint32_t v, ty_edge above, bool uncovered)
{
	if (run->mesh.live < 2)
		return (ty_edge){INFINITY, v, TY_NONE};
	if (run->influence == NULL)
		return least_plain_edge(run, v, below_all, uncovered);
	if (run->importance != NULL || run->rows != NULL || above.other != TY_NONE)
		return compare_exactly(run, v, above, uncovered);
	return least_plain_edge(run, v, above, uncovered);
}

ty_edge
ty_next_edge(const ty_run *run, uint32_t v, ty_edge above)
{
	return least_edge(run, v, above, true);
}

/* Covered ones too: waiting vertices cover each other's. */
ty_edge
ty_waiting_edge(const ty_run *run, uint32_t v)
{
	return least_edge(run, v, ty_waiting_floor(run, v), false);
}

ty_edge
ty_least_edge(const ty_run *run, uint32_t v)
{
	return ty_next_edge(run, v, below_all);
}

/* Not the key's bound alone: then an edge of a cost like its key's, once found barred, would come again and again. */
ty_edge
ty_waiting_floor(const ty_run *run, uint32_t v)
{
	ty_edge passed = run->queue.passed, entry = {0, v, TY_NONE};
	float cost;

	memcpy(&cost, &run->queue.key[v], sizeof cost);
	entry.cost = cost;
	return ty_before(entry, passed) ? passed : entry;
}

/* An end whose key is as large as the edge's covers it only perhaps: keys are rounded. */
void
ty_cover_edge(void *context, uint32_t a, uint32_t b)
{
	ty_run *run = context;
	ty_edge e = {edge_cost(run, a, b), a, b};
	int32_t key = key_of_cost(e.cost);

	if (run->status == TY_OK && run->queue.key[a] >= key && run->queue.key[b] >= key)
		run->status = ty_queue_set(run, e); /* whether a barrier is in the way is asked when its turn comes */
	if (run->influence != NULL && run->near != NULL && run->status == TY_OK)
		run->status = ty_look_near(run, a, b);
}

/* ---- the first entries: every edge is covered by its end of smaller rank ---- */

/*
 * Keys are lower bounds: what importances and barriers make of an edge is asked when its turn comes. What rows make of
 * it is asked here, where their spans are near in memory.
 */
static ty_status
fill_buckets(ty_run *run)
{
	ty_queue *queue = &run->queue;
	ty_status status = TY_OK;

	for (uint32_t h = 0; h < ty_half_edge(run->mesh.used_triangles, 0); h = ty_next_half_edge(h))
	{
		uint32_t a = ty_origin(&run->mesh, h), b = ty_target(&run->mesh, h);
		int32_t key;

		if (ty_interrupted_at(run->env, h))
			return TY_INTERRUPTED;
		if (a == TY_GHOST || b == TY_GHOST)
			continue;
		/* every edge comes twice; to skip one of them would be guessed wrong half the time */
		key = key_of_cost(run->rows == NULL || a > b ? ty_plain_cost(run, a, b) : edge_cost(run, a, b));
		key = a < b ? key : TY_NO_KEY;
		queue->key[a] = key < queue->key[a] ? key : queue->key[a];
	}
	for (uint32_t v = 0; v < run->n && status == TY_OK; v++)
		if (queue->key[v] != TY_NO_KEY)
			status = ty_bucket_add(run, v);
	return status;
}

/* The heap has room for an entry of every vertex. */
static void
fill_heap(ty_run *run)
{
	ty_queue *queue = &run->queue;

	for (uint32_t v = 0; v < run->n; v++)
		queue->heap[v] = (ty_edge){INFINITY, v, TY_NONE};
	for (uint32_t h = 0; h < ty_half_edge(run->mesh.used_triangles, 0); h = ty_next_half_edge(h))
	{
		uint32_t a = ty_origin(&run->mesh, h), b = ty_target(&run->mesh, h);

		if (a < b && b != TY_GHOST)
		{
			ty_edge e = {edge_cost(run, a, b), a, b};

			if (ty_before(e, queue->heap[a]))
				queue->heap[a] = e;
		}
	}
	for (uint32_t v = 0; v < run->n; v++)
		if (queue->heap[v].other != TY_NONE)
		{
			queue->key[v] = key_of_cost(queue->heap[v].cost);
			queue->heap[queue->heap_count++] = queue->heap[v];
		}
	heapify(queue);
}

ty_status
ty_queue_begin(ty_run *run)
{
	ty_queue *queue = &run->queue;
	bool bucketed = run->mesh.live >= TY_LEAST_BUCKETED;

	queue->heap_capacity = bucketed ? FIRST_HEAP : run->n + 1;
	queue->limit = (ty_edge){INFINITY, 0, 0};
	queue->key = ty_allocate_array(run->env, run->n, sizeof *queue->key);
	queue->heap = ty_allocate_array(run->env, queue->heap_capacity, sizeof *queue->heap);
	if (queue->key == NULL || queue->heap == NULL)
		return TY_NO_MEMORY;
	for (size_t v = 0; v < run->n; v++)
		queue->key[v] = TY_NO_KEY;
	if (bucketed)
	{
		ty_status status = ty_bucket_begin(run);

		return status == TY_OK ? fill_buckets(run) : status;
	}
	fill_heap(run);
	return TY_OK;
}

void
ty_queue_free(ty_run *run)
{
	ty_release(run->env, run->queue.key);
	ty_release(run->env, run->queue.heap);
	ty_release(run->env, run->queue.sorted);
	ty_release(run->env, run->queue.bucket);
	ty_release(run->env, run->queue.chunk);
	run->queue = (ty_queue){0};
}

/* ---- the least ---- */

#define SLOTS 256

/*
 * The entries of a bucket lie in a narrow range: they are sorted by where they are in it, and the few that this leaves
 * in disorder by insertion. A heap took four times as long.
 */
void
ty_queue_sort(ty_run *run, double low)
{
	ty_queue *queue = &run->queue;
	ty_edge *from = queue->sorted + TY_SORTED, *to = queue->sorted;
	double scale = SLOTS / (queue->limit.cost - low);
	uint32_t start[SLOTS + 1] = {0};
	uint8_t slot[TY_SORTED];

	queue->sorted_next = 0;
	for (size_t i = 0; i < queue->sorted_count; i++)
	{
		double place = (from[i].cost - low) * scale;

		slot[i] = place >= SLOTS - 1 ? SLOTS - 1 : place > 0 ? (uint8_t) place : 0;
		start[slot[i] + 1]++;
	}
	for (size_t i = 1; i < SLOTS; i++)
		start[i] += start[i - 1];
	for (size_t i = 0; i < queue->sorted_count; i++)
		to[start[slot[i]]++] = from[i];
	for (size_t i = 1; i < queue->sorted_count; i++)
	{
		ty_edge e = to[i];
		size_t j = i;

		for (; j > 0 && ty_before(e, to[j - 1]); j--)
			to[j] = to[j - 1];
		to[j] = e;
	}
}

/* the half-edge of an edge, if the mesh still has it at its cost and no barrier is in its way; else TY_NONE */
static uint32_t
half_edge_of(const ty_run *run, ty_edge e)
{
	uint32_t h;

	if (e.other == TY_NONE || run->mesh.live < 2)
		return TY_NONE;
	h = ty_mesh_find_edge(&run->mesh, e.owner, e.other);
	return h != TY_NONE && edge_cost(run, e.owner, e.other) == e.cost && !ty_is_barred(run, e.owner, e.other) ? h
																											  : TY_NONE;
}

/* Takes the least entry out of the queue, once it has been looked at. */
static void
drop_least(ty_queue *queue, bool is_sorted)
{
	if (is_sorted)
		queue->sorted_next++;
	else
		pop(queue);
}

ty_status
ty_queue_least(ty_run *run, ty_edge *least, uint32_t *h)
{
	ty_queue *queue = &run->queue;
	ty_status status = TY_OK;
	bool found = true;

	while (status == TY_OK && found)
	{
		bool is_sorted = queue->sorted_next < queue->sorted_count;

		if (!is_sorted && queue->heap_count == 0)
		{
			status = ty_bucket_drain(run, &found);
			continue;
		}
		if (is_sorted && queue->heap_count > 0)
			is_sorted = ty_before(queue->sorted[queue->sorted_next], queue->heap[0]);
		*least = is_sorted ? queue->sorted[queue->sorted_next] : queue->heap[0];
		if (!is_current(run, *least))
			drop_least(queue, is_sorted);
		else if ((*h = half_edge_of(run, *least)) != TY_NONE)
			return TY_OK;
		else
		{
			drop_least(queue, is_sorted);
			status = ty_queue_set(run, ty_next_edge(run, least->owner, *least));
		}
	}
	least->owner = TY_NONE;
	return status;
}
