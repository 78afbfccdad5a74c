/*
 * collapse_bucket.c - the buckets of the queue: vertices whose entries are not among the least yet.
 *
 * A collapse of a large group touches two stars somewhere in memory, and waits for each of their cache lines: at a
 * million vertices two thirds of the time. The vertices of a bucket are the ones to collapse next, so their stars
 * are fetched side by side before they are needed: many walks advance by one step each in turn, and while one waits
 * the others do. The order of the collapses stays what it is.
 */
#include "collapse_internal.h"

#include <stdlib.h>
#include <string.h>

/*
 * Vertices a bucket, about, when costs spread over two octaves: few enough for their stars (some 2 kB each) to stay
 * in the second-level cache until they are collapsed. Tests set it.
 */
#ifndef TY_BUCKET_VERTICES
#define TY_BUCKET_VERTICES 256
#endif
#define OCTAVES 63			   /* costs are below 2^30.5 cells * 2^31 ... */
#define INFLUENCED_OCTAVES 128 /* ... but influences may lengthen them: all of a float's from 1 on */

/* Walks side by side: more than the memory requests that a core has under way at a time (measured: 16 to 64). */
#define ABREAST 32
#define SLICE 512 /* vertices of a bucket whose keys are fetched side by side */
#define STEPS 16  /* a walk goes no farther: most stars have 6 corners */

/*
 * Where all distances are alike one bucket holds nearly all vertices, and a heap of them would take as much memory as
 * half a mesh. Such a bucket is emptied in parts: its least entries, up to a limit that a sample of it gives.
 */
#define GIANT(n) ((n) / 4)
#define PART(n) ((n) / 8)
#define SAMPLE 256

/* ---- buckets ---- */

ty_status
ty_bucket_begin(ty_run *run)
{
	ty_queue *queue = &run->queue;
	int digits = 0;

	while (digits < 16 && run->mesh.live >> (digits + 1) >= TY_BUCKET_VERTICES)
		digits++;
	queue->shift = 23 - digits;
	queue->buckets = (uint32_t) (run->influence == NULL ? OCTAVES : INFLUENCED_OCTAVES) << digits;
	queue->next = 0;
	queue->free_chunk = TY_NONE;
	queue->limit = (ty_edge){0, 0, 0};
	queue->chunk_capacity = run->n / 14 + 64;
	queue->sorted = ty_allocate_array(run->env, 2 * TY_SORTED, sizeof *queue->sorted);
	queue->bucket = ty_allocate_array(run->env, queue->buckets, sizeof *queue->bucket);
	queue->chunk = ty_allocate_array(run->env, queue->chunk_capacity, sizeof *queue->chunk);
	if (queue->sorted == NULL || queue->bucket == NULL || queue->chunk == NULL)
		return TY_NO_MEMORY;
	for (uint32_t b = 0; b < queue->buckets; b++)
		queue->bucket[b] = (ty_bucket){TY_NONE, 0};
	return TY_OK;
}

/* a chunk to put before `next`; TY_NONE when there is no memory */
static uint32_t
take_chunk(ty_run *run, uint32_t next)
{
	ty_queue *queue = &run->queue;
	uint32_t taken = queue->free_chunk;

	if (taken != TY_NONE)
		queue->free_chunk = queue->chunk[taken].next;
	else
	{
		if (queue->used_chunks == queue->chunk_capacity)
		{
			size_t capacity = queue->chunk_capacity + queue->chunk_capacity / 16 + 1;
			ty_chunk *chunk = ty_reallocate_array(run->env, queue->chunk, capacity, sizeof *chunk);

			if (chunk == NULL)
				return TY_NONE;
			queue->chunk = chunk;
			queue->chunk_capacity = capacity;
		}
		taken = queue->used_chunks++;
	}
	queue->chunk[taken].next = next;
	return taken;
}

/* Puts a vertex into its bucket. */
static ty_status
put(ty_run *run, ty_addition a)
{
	ty_bucket *b = &run->queue.bucket[a.bucket];

	if (b->count % TY_CHUNK_VERTICES == 0)
	{
		uint32_t c = take_chunk(run, b->first);

		if (c == TY_NONE)
			return TY_NO_MEMORY;
		b->first = c;
	}
	run->queue.chunk[b->first].vertex[b->count++ % TY_CHUNK_VERTICES] = a.vertex;
	return TY_OK;
}

/* Puts into their buckets what has been added. */
static ty_status
put_added(ty_run *run)
{
	ty_queue *queue = &run->queue;
	ty_status status = TY_OK;

	for (size_t i = 0; i < queue->added_count; i++)
	{
		uint32_t c = queue->bucket[queue->added[i].bucket].first;

		if (c != TY_NONE)
			__builtin_prefetch(&queue->chunk[c], 1);
	}
	for (size_t i = 0; i < queue->added_count && status == TY_OK; i++)
		status = put(run, queue->added[i]);
	queue->added_count = 0;
	return status;
}

/* A bucket and its chunk have to be waited for one after the other: many are fetched side by side. */
ty_status
ty_bucket_add(ty_run *run, uint32_t v)
{
	ty_queue *queue = &run->queue;
	uint32_t b = ty_bucket_of(queue, queue->key[v]);

	__builtin_prefetch(&queue->bucket[b], 1);
	queue->added[queue->added_count++] = (ty_addition){v, b};
	return queue->added_count < TY_ADDED ? TY_OK : put_added(run);
}

/* how many vertices the first chunk of a bucket holds */
static uint32_t
first_count(const ty_bucket *bucket)
{
	return bucket->count == 0 ? 0 : (bucket->count - 1) % TY_CHUNK_VERTICES + 1;
}

/* whether a vertex in bucket b still has that key; one that is gone has none */
static bool
is_waiting(const ty_run *run, uint32_t v, uint32_t b)
{
	return ty_bucket_of(&run->queue, run->queue.key[v]) == b;
}

/* ---- fetching stars side by side ---- */

/*
 * Brings the stars of count <= ABREAST vertices into the cache; for a collapse also what lies around them. Always
 * inline: gcc drops calls of a function that does nothing but prefetch.
 */
static inline __attribute__((always_inline)) void
fetch_stars(const ty_run *run, const uint32_t *v, size_t count, bool to_collapse)
{
	const ty_triangle *triangles = run->mesh.triangles;
	const ty_span *span = run->rows == NULL ? NULL : run->rows->span;
	uint32_t first[ABREAST], at[ABREAST], outer[ABREAST];
	size_t walks = 0;

	for (size_t i = 0; i < count; i++)
	{
		__builtin_prefetch(&run->vertex[v[i]]);
		if (to_collapse)
			__builtin_prefetch(&run->rest[v[i]]);
	}
	for (size_t i = 0; i < count; i++)
	{
		uint32_t h = run->vertex[v[i]].edge;

		if (h == TY_NONE)
			continue;
		__builtin_prefetch(&triangles[ty_triangle_of(h)]);
		first[walks] = at[walks] = outer[walks] = h;
		walks++;
	}
	for (int step = 0; step < STEPS && walks > 0; step++)
	{
		size_t going = 0;

		for (size_t i = 0; i < walks; i++)
		{
			uint32_t h = at[i], w, beyond = ty_opposite(&run->mesh, ty_next_in_triangle(h));

			h = ty_step_around(&run->mesh, h, &w);
			__builtin_prefetch(&run->vertex[w]); /* whatever it is: no address is wrong here */
			__builtin_prefetch(&run->queue.key[w]);
			if (span != NULL && !to_collapse)
				__builtin_prefetch(&span[w]);
			if (to_collapse)
			{
				uint32_t apex = ty_origin(&run->mesh, ty_previous_in_triangle(outer[i])); /* fetched one step ago */

				__builtin_prefetch(&run->vertex[apex]);
				__builtin_prefetch(&triangles[ty_triangle_of(beyond)]);
			}
			__builtin_prefetch(&triangles[ty_triangle_of(h)]);
			at[going] = h;
			outer[going] = beyond;
			first[going] = first[i];
			going += h != first[going];
		}
		walks = going;
	}
}

/* vertices whose keys are to be looked at again */
typedef struct lookout
{
	size_t count;
	uint32_t vertex[ABREAST];
} lookout;

/* Fetches what the barriers will be asked for edges that are due. */
static void
fetch_barriers(const ty_run *run, const uint32_t *owner, const uint32_t *other, size_t count)
{
	const ty_influence *influence = run->influence;
	ty_edge_ends edge[ABREAST];

	if (influence == NULL || influence->fetch == NULL)
		return;
	for (size_t i = 0; i < count; i++)
		edge[i] = (ty_edge_ends){run->vertex[owner[i]].position, run->vertex[other[i]].position};
	influence->fetch(influence->barriers, edge, count);
}

/* Gives the vertices, which wait in bucket b, their least edges as keys, and forgets them. */
static ty_status
look_again(ty_run *run, uint32_t b, lookout *looked)
{
	uint32_t owner[ABREAST], other[ABREAST];
	size_t near = 0, others = 0;
	ty_status status = TY_OK;

	fetch_stars(run, looked->vertex, looked->count, false);
	for (size_t i = 0; i < looked->count && status == TY_OK; i++)
	{
		ty_edge least = ty_next_edge(run, looked->vertex[i], ty_waiting_floor(run, looked->vertex[i]));

		status = ty_queue_settle(run, least);
		if (least.other == TY_NONE || !ty_is_near(&run->queue, least))
			continue;
		owner[near] = least.owner;
		other[near++] = least.other;
		__builtin_prefetch(&run->queue.key[least.other]);
	}
	fetch_stars(run, owner, near, true);
	fetch_barriers(run, owner, other, near);
	for (size_t i = 0; i < near; i++)
		if (!is_waiting(run, other[i], b)) /* else its own turn comes, or has come */
			other[others++] = other[i];
	fetch_stars(run, other, others, true);
	looked->count = 0;
	return status;
}

/* Looks at those of a slice of bucket b that still have their key. */
static ty_status
look_at_slice(ty_run *run, uint32_t b, const uint32_t *slice, size_t count)
{
	lookout looked = {.count = 0};
	ty_status status = TY_OK;

	for (size_t i = 0; i < count; i++) /* all of the slice, so that no walk has to begin by waiting */
		if (is_waiting(run, slice[i], b))
			__builtin_prefetch(&run->vertex[slice[i]]);
	for (size_t i = 0; i < count && status == TY_OK; i++)
	{
		if (is_waiting(run, slice[i], b))
			looked.vertex[looked.count++] = slice[i];
		if (looked.count == ABREAST)
			status = look_again(run, b, &looked);
	}
	return status == TY_OK ? look_again(run, b, &looked) : status;
}

/* ---- limits ---- */

static int
compare_edges(const void *a, const void *b)
{
	const ty_edge *e = a, *f = b;

	return ty_before(*f, *e) - ty_before(*e, *f);
}

/* the upper end of bucket b: above all its entries, not above any of the next one's */
static ty_edge
end_of_bucket(const ty_queue *queue, uint32_t b)
{
	uint32_t bits = TY_LEAST_KEY + ((b + 1) << queue->shift);
	float end;

	memcpy(&end, &bits, sizeof end);
	return (ty_edge){end, 0, TY_NONE};
}

/*
 * The edge at which v, of a bucket, is to be looked at: the least of all, also of those that its other ends cover, for
 * waiting vertices cover each other's. But not one below the limit so far, of a partner while a batch is gathered: the
 * limit would stay where it is, and nothing below it be found.
 */
static ty_edge
edge_to_wait_for(const ty_run *run, uint32_t v)
{
	ty_edge e = ty_waiting_edge(run, v);

	return ty_is_near(&run->queue, e) ? ty_next_edge(run, v, ty_waiting_floor(run, v)) : e;
}

/*
 * The limit below which about PART of the vertices of bucket b lie, between its ends and not below the limit so far;
 * the upper end where that cannot be found out. (While a batch is gathered there may be edges below a bucket.)
 */
static ty_edge
limit_of_part(const ty_run *run, uint32_t b)
{
	const ty_queue *queue = &run->queue;
	ty_edge begin = end_of_bucket(queue, b - 1), end = end_of_bucket(queue, b), part;
	ty_edge sample[SAMPLE];
	size_t samples = 0, met = 0;
	size_t every = queue->bucket[b].count / SAMPLE + 1;

	for (uint32_t c = queue->bucket[b].first, i = first_count(&queue->bucket[b]); c != TY_NONE;
		 c = queue->chunk[c].next, i = TY_CHUNK_VERTICES)
		while (i-- > 0)
		{
			uint32_t v = queue->chunk[c].vertex[i];

			if (met++ % every == 0 && is_waiting(run, v, b))
				sample[samples++] = edge_to_wait_for(run, v);
		}
	if (samples == 0)
		return end;
	qsort(sample, samples, sizeof *sample, compare_edges);
	part = sample[samples * PART(run->n) / queue->bucket[b].count];
	begin = ty_before(begin, queue->limit) ? queue->limit : begin;
	part = ty_before(part, begin) ? begin : part;
	return ty_before(part, end) ? part : end;
}

ty_status
ty_bucket_drain(ty_run *run, bool *found)
{
	ty_queue *queue = &run->queue;
	uint32_t b = queue->next, vertices;
	uint32_t slice[SLICE];
	size_t count = 0;
	ty_bucket bucket;
	ty_status status = put_added(run);

	while (b < queue->buckets && queue->bucket[b].first == TY_NONE)
		b++;
	*found = b < queue->buckets;
	if (!*found || status != TY_OK)
		return status;
	queue->next = b;
	queue->passed = queue->limit;
	queue->limit = queue->bucket[b].count > GIANT(run->n) ? limit_of_part(run, b) : end_of_bucket(queue, b);
	queue->sorted_count = 0;
	bucket = queue->bucket[b];
	vertices = first_count(&bucket);
	queue->bucket[b] = (ty_bucket){TY_NONE, 0};
	while (bucket.first != TY_NONE && status == TY_OK)
	{
		uint32_t c = bucket.first;

		for (uint32_t i = 0; i < vertices; i++)
		{
			slice[count++] = queue->chunk[c].vertex[i];
			__builtin_prefetch(&queue->key[slice[count - 1]]);
		}
		bucket.first = queue->chunk[c].next;
		queue->chunk[c].next = queue->free_chunk;
		queue->free_chunk = c;
		vertices = TY_CHUNK_VERTICES;
		if (count + TY_CHUNK_VERTICES <= SLICE && bucket.first != TY_NONE)
			continue;
		status = look_at_slice(run, b, slice, count);
		count = 0;
		if (status == TY_OK && ty_interrupted(run->env))
			status = TY_INTERRUPTED;
	}
	ty_queue_sort(run, end_of_bucket(queue, b - 1).cost);
	return status;
}
