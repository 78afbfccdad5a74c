/*
 * alignment.h - rows of buildings: found before the collapse, kept in it, laid out evenly after it (spec 2.5).
 *
 * A row is a chain of neighbouring buildings of similar size and orientation, at regular spacing along a straight or
 * gently curved line. Each building is in at most one row. Nothing here depends on the scale.
 */
#ifndef TY_ALIGNMENT_H
#define TY_ALIGNMENT_H

#include "mesh.h"

/* Where a building stands and what makes two of them alike: small, since a search looks at millions. */
typedef struct ty_trait
{
	ty_position place;
	float area;	  /* in square grid cells; 0: in no row */
	float ratio;  /* short side / long side, (0, 1] */
	float ux, uy; /* unit vector of the longer side */
} ty_trait;

/* Which members of which row a vertex of the mesh stands for: all from the first to the last place along the row. */
typedef struct ty_span
{
	uint32_t row; /* TY_NONE: none, then the places mean nothing */
	uint32_t first, last;
} ty_span;

typedef struct ty_rows
{
	size_t count;
	uint32_t *first;  /* [count + 1] where the members of a row begin */
	uint32_t *member; /* ranks, row by row, in the order along the row; it begins at the end of smaller rank */
	double *spacing;  /* [count] mean distance between neighbours, in cells */
	ty_span *span; /* [n] by rank. Rows are numbered by the smallest rank among their members. Merges change spans. */
} ty_rows;

/* What no row leads across: whether something lies between two places. */
typedef struct ty_parting
{
	bool (*parts)(const void *context, ty_position a, ty_position b); /* the same for b and a; NULL: nothing does */
	const void *context;
} ty_parting;

/*
 * Finds the rows among the vertices of a mesh that nothing has been merged in yet. trait: [mesh->vertices] by rank.
 * The result's arrays are the caller's, to be freed with ty_rows_free. O(vertices log vertices).
 */
ty_status ty_rows_detect(const ty_environment *env, const ty_mesh *mesh, const ty_trait *trait, ty_parting parting,
						 ty_rows *rows);
void ty_rows_free(const ty_environment *env, ty_rows *rows);

/* What the buildings that the vertices of a mesh stand for are like; order[rank] = index of the building. */
void ty_traits(const ty_building *buildings, const uint32_t *order, const ty_mesh *mesh, const ty_grid *grid,
			   ty_trait *trait);

/*
 * The rows of a group by themselves: its canonical order, its mesh, its rows. n >= 1; order holds n entries of the
 * caller's. The rows are the same as the collapse of the group finds.
 */
ty_status ty_rows_of_group(const ty_environment *env, const ty_building *buildings, size_t n, ty_parting parting,
						   uint32_t *order, ty_rows *rows);

/* ---- in the collapse ---- */

/*
 * The length that counts of an edge between two vertices, at least the true one.
 *
 * Two vertices that follow each other in a row are inside it. They are merged in the order of a tree that halves the
 * row again and again, so that at any time no vertex stands for more than twice as many members as another and one, and
 * large and small ones alternate. For that the edge counts as long as the row's vertices are apart, on average, when
 * its turn has come: as many of them are left by then as the tree says. (Were the shortest edge to go first, equal
 * spacings would be thinned from one end.) What stands beside a member, like its garage, in no row and nearer than the
 * spacing, is inside as well, as long as the merged vertex goes on in the row. Every other edge at a vertex of a row
 * leaves it, and is lengthened by 1 + alignment. size: buildings of both together.
 */
double ty_aligned_length(const ty_rows *rows, ty_span a, ty_span b, uint64_t size, double length, double alignment);

/*
 * What the vertex made of two stands for. size: buildings of both together. Two that follow each other in a row go on
 * as one; a vertex of a row goes on in it beside buildings of no row, as long as they are no more than its own members.
 * Any other one is in no row from then on: then the members before and behind it are rows of their own.
 */
ty_span ty_joined_span(ty_span a, ty_span b, uint64_t size);

/* ---- at drawing ---- */

/* Rows whose members have become placeholders. */
typedef struct ty_drawn_rows
{
	const ty_rows *rows;
	const ty_building *buildings;
	const uint32_t *order;					 /* [n] building by rank */
	const uint32_t *label;					 /* [n] placeholder by rank */
	const uint32_t *keeper;					 /* [placeholders] the rank that each vertex went on under */
	const struct ty_barrier_lines *barriers; /* on the ground, that nobody is laid across; NULL: none */
	/*
	 * Gets what is laid out as a row, or would be, of rows of which the law leaves two at least: in proportion to those
	 * of all n buildings. Of others who stands on the line is chance. NULL: nobody asks.
	 */
	struct ty_site_rows *pieces;
	size_t placeholders, n;
} ty_drawn_rows;

struct ty_placeholder;
struct ty_barrier_lines;
struct ty_site_rows;

/*
 * Lays out the placeholders of each row, once they have places: on the line through the means of their members in the
 * row, at equal spacing along it, the ends at their means; nobody farther from its own mean than four of these. Rows
 * whose placeholders are all single buildings stay as they are. A row is laid out in pieces where it comes to a kept
 * building, or where a barrier lies between two placeholders or between one and the mean of its members in the row.
 * Room for drawn->pieces: ty_pieces_begin.
 */
ty_status ty_rows_lay_out(const ty_environment *env, const ty_drawn_rows *drawn, struct ty_placeholder *placeholders);

/* Room for what so many placeholders are of these rows. What it returns: ty_pieces_free. */
ty_status ty_pieces_begin(const ty_environment *env, const ty_rows *rows, size_t placeholders,
						  struct ty_site_rows *pieces);
void ty_pieces_free(const ty_environment *env, struct ty_site_rows *pieces);

#endif
