/*
 * collapse_bucket.c - the buckets of the queue: vertices whose entries are not among the least yet.
 *
 * A collapse of a large group touches two stars somewhere in memory, and waits for each of their cache lines: at a
 * million vertices two thirds of the time. The vertices of a bucket are the ones to collapse next, so their stars
 * are fetched side by side before they are needed: many walks advance by one step each in turn, and while one waits
 * the others do. The order of the collapses stays what it is.
 */
#include "collapse_internal.h"

/*
 * Vertices a bucket, about, when costs spread over two octaves: few enough for their stars (some 2 kB each) to stay
 * in the second-level cache until they are collapsed. Tests set it.
 */
#ifndef TY_BUCKET_VERTICES
#define TY_BUCKET_VERTICES 256
#endif
#define OCTAVES 63 /* costs are below 2^30.5 cells * 2^31 */

#define ABREAST \
	24 /* walks side by side: more than the memory requests a core has under way at a time (measured: 16 to 48) */
#define STEPS 16 /* a walk goes no farther: most stars have 6 corners */

/* ---- buckets ---- */

ty_status
ty_bucket_begin(ty_run *run)
{
	ty_queue *queue = &run->queue;
	int digits = 0;

	while (digits < 16 && run->mesh.live >> (digits + 1) >= TY_BUCKET_VERTICES)
		digits++;
	queue->shift = 23 - digits;
	queue->buckets = (uint32_t) OCTAVES << digits;
	queue->next = 0;
	queue->free_chunk = TY_NONE;
	queue->chunk_capacity = run->n / 8 + queue->buckets / 8;
	queue->bucket = ty_allocate_array(run->env, queue->buckets, sizeof *queue->bucket);
	queue->chunk = ty_allocate_array(run->env, queue->chunk_capacity, sizeof *queue->chunk);
	if (queue->bucket == NULL || queue->chunk == NULL)
		return TY_NO_MEMORY;
	for (uint32_t b = 0; b < queue->buckets; b++)
		queue->bucket[b] = (ty_bucket){TY_NONE, TY_CHUNK_VERTICES};
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
			size_t capacity = queue->chunk_capacity + queue->chunk_capacity / 4 + 1;
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

ty_status
ty_bucket_add(ty_run *run, uint32_t v)
{
	ty_bucket *b = &run->queue.bucket[ty_bucket_of(&run->queue, run->queue.key[v])];

	if (b->count == TY_CHUNK_VERTICES)
	{
		uint32_t c = take_chunk(run, b->first);

		if (c == TY_NONE)
			return TY_NO_MEMORY;
		*b = (ty_bucket){c, 0};
	}
	run->queue.chunk[b->first].vertex[b->count++] = v;
	return TY_OK;
}

/* ---- fetching stars side by side ---- */

/*
 * Brings the stars of count <= ABREAST vertices into the cache, with the triangles around them. Always inline: gcc
 * drops calls of a function that does nothing but prefetch.
 */
static inline __attribute__((always_inline)) void
fetch_stars(const ty_run *run, const uint32_t *v, size_t count)
{
	const ty_triangle *triangles = run->mesh.triangles;
	uint32_t first[ABREAST], at[ABREAST], outer[ABREAST];
	size_t walks = 0;

	for (size_t i = 0; i < count; i++)
	{
		__builtin_prefetch(&run->vertex[v[i]]);
		__builtin_prefetch(&run->rest[v[i]]);
		__builtin_prefetch(&run->queue.key[v[i]]);
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
			uint32_t h = at[i], w = ty_target(&run->mesh, h);
			uint32_t apex = ty_origin(&run->mesh, ty_previous_in_triangle(outer[i])); /* fetched one step ago */
			uint32_t beyond = ty_opposite(&run->mesh, ty_next_in_triangle(h));

			if (w != TY_GHOST)
				__builtin_prefetch(&run->vertex[w]);
			if (apex != TY_GHOST)
				__builtin_prefetch(&run->vertex[apex]);
			__builtin_prefetch(&triangles[ty_triangle_of(beyond)]);
			h = ty_next_around(&run->mesh, h);
			if (h == first[i])
				continue;
			__builtin_prefetch(&triangles[ty_triangle_of(h)]);
			first[going] = first[i];
			at[going] = h;
			outer[going] = beyond;
			going++;
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

/* Gives the vertices their least edges as keys, and forgets them. */
static ty_status
look_again(ty_run *run, lookout *looked)
{
	uint32_t other[ABREAST];
	size_t others = 0;
	ty_status status = TY_OK;

	fetch_stars(run, looked->vertex, looked->count);
	for (size_t i = 0; i < looked->count && status == TY_OK; i++)
	{
		ty_edge least = ty_least_edge(run, looked->vertex[i]);

		status = ty_queue_set(run, least);
		if (least.other != TY_NONE && ty_bucket_of(&run->queue, run->queue.key[least.owner]) < run->queue.next)
			other[others++] = least.other;
	}
	fetch_stars(run, other, others);
	looked->count = 0;
	return status;
}

/* Takes a chunk's vertices to `looked`, and looks at each full house of them; those that have another key now are out. */
static ty_status
drain_chunk(ty_run *run, uint32_t b, const ty_chunk *chunk, uint32_t vertices, lookout *looked)
{
	ty_status status = TY_OK;

	for (uint32_t i = 0; i < vertices; i++)
	{
		__builtin_prefetch(&run->vertex[chunk->vertex[i]]);
		__builtin_prefetch(&run->queue.key[chunk->vertex[i]]);
	}
	for (uint32_t i = 0; i < vertices && status == TY_OK; i++)
	{
		uint32_t v = chunk->vertex[i];

		if (run->vertex[v].edge == TY_NONE || ty_bucket_of(&run->queue, run->queue.key[v]) != b)
			continue;
		looked->vertex[looked->count++] = v;
		if (looked->count == ABREAST)
			status = look_again(run, looked);
	}
	return status;
}

ty_status
ty_bucket_drain(ty_run *run, bool *found)
{
	ty_queue *queue = &run->queue;
	uint32_t b = queue->next;
	ty_bucket bucket;
	lookout looked = {.count = 0};
	ty_status status = TY_OK;

	while (b < queue->buckets && queue->bucket[b].first == TY_NONE)
		b++;
	*found = b < queue->buckets;
	if (!*found)
		return TY_OK;
	queue->next = b + 1;
	bucket = queue->bucket[b];
	queue->bucket[b] = (ty_bucket){TY_NONE, TY_CHUNK_VERTICES};
	while (bucket.first != TY_NONE && status == TY_OK)
	{
		ty_chunk chunk = queue->chunk[bucket.first]; /* a copy: others may take its place */

		if (chunk.next != TY_NONE)
			__builtin_prefetch(&queue->chunk[chunk.next]);
		queue->chunk[bucket.first].next = queue->free_chunk;
		queue->free_chunk = bucket.first;
		status = drain_chunk(run, b, &chunk, bucket.count, &looked);
		bucket = (ty_bucket){chunk.next, TY_CHUNK_VERTICES};
	}
	return status == TY_OK ? look_again(run, &looked) : status;
}
