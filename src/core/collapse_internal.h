/* collapse_internal.h - what the files of the collapse share */
#ifndef TY_COLLAPSE_INTERNAL_H
#define TY_COLLAPSE_INTERNAL_H

#include "collapse.h"
#include "predicates.h"

/* an edge in the queue, owned by the vertex whose key it is */
typedef struct ty_edge
{
	double cost;
	uint32_t owner, other;
} ty_edge;

typedef struct ty_cluster
{
	int64_t sum_x, sum_y; /* of all represented centroids, in grid cells: exact */
} ty_cluster;

typedef struct ty_run
{
	const ty_environment *env;
	ty_position *position;
	size_t n;
	double s_u;
	ty_mesh mesh;
	ty_cluster *cluster;			/* [n] */
	uint32_t *size;					/* [n] r, how many buildings a vertex represents */
	double *key;					/* [n] INFINITY: no edge to cover */
	uint32_t *other;				/* [n] the other end of the key's edge */
	bool *rekeyed;					/* [n] the vertex has had another key than its first */
	uint32_t *first;				/* vertices in the order of their first keys ... */
	size_t first_count, first_next; /* ... of which those before first_next are done */
	ty_edge *heap;
	size_t heap_count, heap_capacity;
	uint32_t *near; /* for min_distance: vertices that may have a neighbour nearer than it; else NULL */
	size_t near_count;
	ty_sequence *sequence;
	int64_t surplus; /* of the mesh's work, when a batch was last looked for (collapse_batch.c) */
	ty_after_merge after_merge;
	void *context;	  /* of after_merge */
	ty_status status; /* of what cannot return one: the mesh's edge_made */
} ty_run;

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

/* ---- collapse_queue.c ---- */

/* Sorts the first keys of a new mesh; scratch holds n entries. */
ty_status ty_queue_begin(ty_run *run, uint64_t *scratch);
/* Gives the owner a key, and with it its place in the queue; a cost of INFINITY is none. */
ty_status ty_queue_set(ty_run *run, ty_edge e);
/* The least edge of the mesh that a key covers; owner TY_NONE when there is none. It stays in the queue. */
ty_status ty_queue_least(ty_run *run, ty_edge *least);
/* the least edge at v; cost INFINITY when there is none */
ty_edge ty_least_edge(const ty_run *run, uint32_t v);
/* the mesh's edge_made: covers an edge between two vertices that keep their keys */
void ty_cover_edge(void *context, uint32_t a, uint32_t b);

/* ---- collapse.c ---- */

/* Where the vertex goes that two vertices merge to: the mean of all that both represent. */
ty_position ty_merged_place(const ty_run *run, uint32_t a, uint32_t b);
/* Adds gone to kept and records the merge; returns their merged place. */
ty_position ty_merge(ty_run *run, uint32_t kept, uint32_t gone, double cost);
/* What is left to do once a merged vertex is in the mesh. */
ty_status ty_enter_merged(ty_run *run, uint32_t kept);
/* For tests: shows the mesh, or NULL while it is behind the merges. */
void ty_show(const ty_run *run, const ty_mesh *mesh);

/* ---- collapse_batch.c ---- */

/*
 * Merges many edges at once where single collapses have become expensive: at most `most` of them, the next ones
 * of the sequence. Does nothing where it does not pay.
 */
ty_status ty_collapse_batch(ty_run *run, size_t most);

#endif
