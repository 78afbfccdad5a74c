/*
 * reference.h - typification as slowly and plainly as the specification words it (sections 2.2 to 2.4).
 *
 * It shares nothing with the core but the type of a position. After every merge the whole mesh is found anew by
 * trying all triples of vertices, with exact integers; the edge to collapse is found by looking at all of them.
 */
#ifndef TY_REFERENCE_H
#define TY_REFERENCE_H

#include "collapse.h"

#define REFERENCE_UNIT 1024 /* importances are whole multiples of its inverse */
#define REFERENCE_MAX 72	/* vertices; the work grows with the fourth power */

typedef bool reference_edges[REFERENCE_MAX][REFERENCE_MAX]; /* symmetric, by rank */

typedef struct reference_vertex
{
	bool live;
	int64_t r;			   /* centroids that it represents */
	bool kept;			   /* one of them is kept; then it stays at */
	double importance;	   /* the largest of them */
	__int128 weight;	   /* REFERENCE_UNIT * sum of their importances; 1 each where there are none */
	__int128 sum_x, sum_y; /* of the centroids, weighted */
	ty_span span;		   /* what it stands for of a row */
	ty_position at;		   /* their mean, rounded half up */
} reference_vertex;

typedef enum reference_candidates
{
	REFERENCE_MESH,		/* the edges of the mesh may be collapsed */
	REFERENCE_ALL_PAIRS /* any two vertices: the same for s_u = 0, because the closest two always share an edge */
} reference_candidates;

typedef struct reference
{
	size_t n, live;
	double s_u;
	const ty_influence *influence; /* or NULL */
	reference_candidates candidates;
	reference_vertex vertex[REFERENCE_MAX];
} reference;

typedef struct reference_merge
{
	uint32_t kept, gone;
	double cost;
} reference_merge;

/* Rows for an influence. */
typedef struct given_rows
{
	ty_rows rows; /* of the other arrays */
	uint32_t first[REFERENCE_MAX + 1], member[REFERENCE_MAX];
	double spacing[REFERENCE_MAX];
	ty_span span[REFERENCE_MAX];
} given_rows;

/* Makes the rows 0 .. count - 1 of the vertices whose row that is, by rank, at the given spacing. TY_NONE: in no row. */
void give_rows(given_rows *given, const uint32_t *row, size_t n, uint32_t count, double spacing);

/* As they were given, whatever merges have made of them. */
void reset_rows(ty_rows *rows, size_t n);

/* The rows of the influence are as they were given, whatever merges have made of them. */
void reference_begin(reference *ref, const ty_position *position, size_t n, double s_u, const ty_influence *influence,
					 reference_candidates candidates);
bool reference_must_go_on(const reference *ref, ty_stop stop);
/* whether there is an edge that may be collapsed */
bool reference_can_go_on(const reference *ref);
/* merges once; there must be such an edge */
reference_merge reference_step(reference *ref);

/* > 0 left, 0 collinear, < 0 right */
int reference_orientation(ty_position a, ty_position b, ty_position c);
/* d inside the circle of a, b, c (counter-clockwise) when the point of the smallest rank is lifted a very little */
bool reference_in_circle(const ty_position *at, uint32_t a, uint32_t b, uint32_t c, uint32_t d);
/* The Delaunay edges of the m vertices in list, whose positions differ; at[rank]. */
void reference_delaunay(const ty_position *at, const uint32_t *list, size_t m, reference_edges edge);

#endif
