/* collapse_internal.h - what the files of the collapse share */
#ifndef TY_COLLAPSE_INTERNAL_H
#define TY_COLLAPSE_INTERNAL_H

#include "collapse.h"
#include "predicates.h"

#include <math.h>

/* an edge in the queue, owned by the vertex whose key it is */
typedef struct ty_edge
{
	double cost;
	uint32_t owner, other; /* other TY_NONE: no edge but a lower bound for the owner's edges */
} ty_edge;

#define TY_LEAST_KEY 0x3f800000 /* of cost 1: no two vertices are nearer than a cell */
#define TY_NO_KEY 0x7f800000	/* INFINITY: nothing to cover, or gone */

#define TY_SORTED 512 /* entries of a bucket that are sorted; more of them go into the heap */

/* vertices that wait in a bucket; a cache line */
#define TY_CHUNK_VERTICES 15
typedef struct ty_chunk
{
	uint32_t next;
	uint32_t vertex[TY_CHUNK_VERTICES];
} ty_chunk;

/* All chunks but the first are full. */
typedef struct ty_bucket
{
	uint32_t first; /* chunk; TY_NONE: empty */
	uint32_t count; /* of vertices: not in the chunk, which would have to be waited for */
} ty_bucket;

/* a vertex on its way into a bucket */
typedef struct ty_addition
{
	uint32_t vertex, bucket;
} ty_addition;

#define TY_ADDED 32 /* put into their buckets together, before the next bucket is emptied at the latest */

/* The priority order of the edges: see the head of collapse_queue.c. */
typedef struct ty_queue
{
	int32_t *key; /* [n] bits of a float not above the costs of the edges that the vertex covers */
	/* The least entry of all is the next of `sorted`, whose second half is not in order yet, or on top of the heap. */
	ty_edge *sorted; /* [2 * TY_SORTED] */
	size_t sorted_next, sorted_count;
	ty_edge *heap;
	size_t heap_count, heap_capacity;
	ty_edge limit;	   /* entries up to this one are sorted or in the heap, all others in buckets */
	ty_edge passed;	   /* the limit before: entries in buckets are above it */
	ty_bucket *bucket; /* [buckets] those before `next` are empty */
	uint32_t buckets, next;
	ty_addition added[TY_ADDED]; /* not in their buckets yet */
	size_t added_count;
	int shift; /* a key's bits below a bucket's number */
	ty_chunk *chunk;
	uint32_t used_chunks, free_chunk;
	size_t chunk_capacity;
} ty_queue;

/* A vertex whose members have importances. Sums of weights and of weighted positions are exact. */
typedef struct ty_weighted
{
	int64_t weight;			/* of all members; a kept vertex's counts for nothing */
	int64_t rest_x, rest_y; /* sum of weight * centroid less the vertex's weight * position */
} ty_weighted;

typedef struct ty_run
{
	const ty_environment *env;
	size_t n;
	double s_u;
	ty_mesh mesh;
	ty_vertex *vertex; /* [n] the mesh's */
	ty_position *rest; /* [n] sum of the represented centroids less size * position, per coordinate: exact */
	uint64_t *keys;	   /* [n] of the positions, until there is a mesh */
	ty_queue queue;
	const ty_influence *influence; /* NULL: none; then the next three are NULL as well */
	double *importance;			   /* [n] largest of the members'; INFINITY: kept. NULL: all 1 */
	ty_weighted *weighted;		   /* [n] where there are importances: then it stands for rest */
	ty_rows *rows;				   /* the influence's, once they are known. NULL: none */
	uint8_t *in_row; /* a bit a vertex: whether it stands for members of a row. Few do, and spans are far in memory. */
	double min_distance; /* the stop's */
	uint32_t *near;		 /* for min_distance: merged vertices that may have a neighbour nearer than it; else NULL */
	size_t near_count, near_capacity;
	size_t near_first; /* those before it are no nearer than that to one another, but for the ones in near */
	bool with_cost;
	ty_sequence *sequence;
	int64_t surplus; /* of the mesh's work, when a batch was last looked for (collapse_batch.c) */
	ty_after_merge after_merge;
	void *context;	  /* of after_merge */
	ty_status status; /* of what cannot return one: the mesh's edge_made */
} ty_run;

/* f_a * distance (paper; symmetric form of spec 2.3) */
static inline double
ty_plain_cost(const ty_run *run, uint32_t a, uint32_t b)
{
	const ty_vertex *p = &run->vertex[a], *q = &run->vertex[b];
	double length = sqrt((double) ty_squared_distance(p->position, q->position));
	double factor = run->s_u * (((double) p->size - 1) + ((double) q->size - 1)) + 1;

	return factor * length;
}

static inline uint32_t
ty_smaller(uint32_t a, uint32_t b)
{
	return a < b ? a : b;
}

static inline uint32_t
ty_larger(uint32_t a, uint32_t b)
{
	return a < b ? b : a;
}

/* the total order of entries: cost, bounds first, smaller rank, larger rank */
static inline bool
ty_before(ty_edge a, ty_edge b)
{
	if (a.cost != b.cost)
		return a.cost < b.cost;
	if (a.other == TY_NONE || b.other == TY_NONE)
		return a.other == TY_NONE && b.other != TY_NONE;
	if (ty_smaller(a.owner, a.other) != ty_smaller(b.owner, b.other))
		return ty_smaller(a.owner, a.other) < ty_smaller(b.owner, b.other);
	return ty_larger(a.owner, a.other) < ty_larger(b.owner, b.other);
}

/* ---- collapse_queue.c ---- */

/* Makes the queue of a new mesh. */
ty_status ty_queue_begin(ty_run *run);
void ty_queue_free(ty_run *run);
/* Gives the owner a key, and with it its place in the queue; a cost of INFINITY is none. */
ty_status ty_queue_set(ty_run *run, ty_edge e);
/* The least edge of the mesh, and its half-edge; owner TY_NONE when there is none. It stays in the queue. */
ty_status ty_queue_least(ty_run *run, ty_edge *least, uint32_t *h);
/* Takes both ends out of the queue, as partners, until they are given keys again; their edges count as covered. */
void ty_queue_part(ty_run *run, uint32_t a, uint32_t b);
/* whether a and b have been taken out as partners */
bool ty_queue_partners(const ty_run *run, uint32_t a, uint32_t b);
/* the least edge at v, barriers and what its other end covers aside; cost INFINITY when there is none */
ty_edge ty_least_edge(const ty_run *run, uint32_t v);
/* What takes the place of an entry of v: with influences the least of its edges after that, else as ty_least_edge. */
ty_edge ty_next_edge(const ty_run *run, uint32_t v, ty_edge above);
/* the least edge that the entry of a vertex in a bucket may stand for */
ty_edge ty_waiting_edge(const ty_run *run, uint32_t v);
/* what comes before the entry of a vertex in a bucket */
ty_edge ty_waiting_floor(const ty_run *run, uint32_t v);
/* the mesh's edge_made: covers an edge between two vertices that keep their keys */
void ty_cover_edge(void *context, uint32_t a, uint32_t b);

/* While a bucket is emptied: as ty_queue_set, but what is near may have to wait for ty_queue_sort. */
ty_status ty_queue_settle(ty_run *run, ty_edge e);
/* Ends the emptying of a bucket whose costs begin at low. */
void ty_queue_sort(ty_run *run, double low);

/* ---- collapse_bucket.c ---- */

/* Makes empty buckets for n vertices. */
ty_status ty_bucket_begin(ty_run *run);
/* Adds a vertex to the bucket of its key. */
ty_status ty_bucket_add(ty_run *run, uint32_t v);
/* Empties the next bucket that is not: its vertices get their least edges as keys, and so a place in the queue. */
ty_status ty_bucket_drain(ty_run *run, bool *found);

/* whether an entry belongs into the heap */
static inline bool
ty_is_near(const ty_queue *queue, ty_edge e)
{
	return !ty_before(queue->limit, e);
}

/* the number of a key's bucket */
static inline uint32_t
ty_bucket_of(const ty_queue *queue, int32_t key)
{
	return ((uint32_t) key - TY_LEAST_KEY) >> queue->shift; /* beyond all buckets for keys that stand for no cost */
}

/* ---- collapse.c ---- */

/* Where a merge brings the two: to the mean of all that both represent. */
ty_position ty_merged_place(const ty_run *run, uint32_t a, uint32_t b);
/* Adds gone to kept, which comes from `former` to their merged place. */
void ty_join(ty_run *run, uint32_t kept, uint32_t gone, ty_position former, ty_position to);
/* Records a merge that has been joined. */
void ty_record(ty_run *run, uint32_t gone, ty_position to, double cost);
/* Remembers, once gone is out of the mesh, into which vertex it went (in its size, until there is room for a list). */
void ty_retire(ty_run *run, uint32_t kept, uint32_t gone);
/* What is left to do once a merged vertex is in the mesh. */
ty_status ty_enter_merged(ty_run *run, uint32_t kept);
/* For tests: shows the mesh, or NULL while it is behind the merges. */
void ty_show(const ty_run *run, const ty_mesh *mesh);

/* With influences and a min_distance: remembers a new edge between two old vertices, if it is too short. */
ty_status ty_look_near(ty_run *run, uint32_t a, uint32_t b);

/* ---- collapse_influence.c ---- */

/* Copies of what the influence says of the vertices, to be changed by merges. */
ty_status ty_influence_begin(ty_run *run, const ty_influence *influence);
void ty_influence_free(ty_run *run);
/* a cost with the factors of importances and rows; INFINITY between two kept vertices, else finite */
double ty_influenced_cost(const ty_run *run, uint32_t a, uint32_t b, double cost);
/* ty_merged_place and ty_join where there are importances */
ty_position ty_weighted_place(const ty_run *run, uint32_t a, uint32_t b);
void ty_join_weighted(ty_run *run, uint32_t kept, uint32_t gone, ty_position former, ty_position to);
/* Finds the rows in the mesh, where that is asked for. */
ty_status ty_influence_find_rows(ty_run *run);
/* What of a row a merged vertex stands for; before its size is known. */
void ty_join_rows(ty_run *run, uint32_t kept, uint32_t gone);

static inline bool
ty_both_kept(const ty_run *run, uint32_t a, uint32_t b)
{
	return run->importance != NULL && run->importance[a] == INFINITY && run->importance[b] == INFINITY;
}

/* whether a barrier keeps two vertices from being merged */
static inline bool
ty_is_barred(const ty_run *run, uint32_t a, uint32_t b)
{
	const ty_influence *influence = run->influence;

	return influence != NULL && influence->crosses != NULL &&
		   influence->crosses(influence->barriers, run->vertex[a].position, run->vertex[b].position,
							  ty_merged_place(run, a, b));
}

/* ---- collapse_batch.c ---- */

/*
 * Merges many edges at once where single collapses have become expensive: at most `most` of them, the next ones
 * of the sequence, or as many as are shorter than min_distance. Does nothing where it does not pay.
 */
ty_status ty_collapse_batch(ty_run *run, size_t most, double min_distance);

/* ---- collapse_few.c ---- */

/*
 * Up to so many vertices all pairs are looked at. Down to a third that takes 1.1 us for 10 where a mesh takes 7.8, 8 us
 * for 32 (28), 17 for 48 (41); where many places coincide the mesh is as fast from 50 on. At most 64, bits of a word.
 */
#define TY_FEW 48

/* Collapses at most TY_FEW vertices without a mesh, with the merges that it would give. */
void ty_collapse_few(ty_run *run, ty_stop stop);

#endif
