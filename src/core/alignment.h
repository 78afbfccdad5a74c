/*
 * alignment.h - rows of buildings: found before the collapse, kept in it, laid out evenly after it (spec 2.5).
 *
 * A row is a chain of neighbouring buildings of similar size and orientation, at regular spacing along a straight or
 * gently curved line. Each building is in at most one row. Nothing here depends on the scale.
 */
#ifndef TY_ALIGNMENT_H
#define TY_ALIGNMENT_H

#include "mesh.h"

/* What makes two buildings alike. */
typedef struct ty_trait
{
	double side;   /* square root of the area, in grid cells; 0: in no row */
	double ratio;  /* short side / long side, (0, 1] */
	double ux, uy; /* unit vector of the longer side */
} ty_trait;

typedef struct ty_rows
{
	size_t count;
	uint32_t *first;  /* [count + 1] where the members of a row begin */
	uint32_t *member; /* ranks, row by row, in the order along the row; it begins at the end of smaller rank */
	uint32_t *row;	  /* [n] by rank; TY_NONE: in no row. Rows are numbered by the smallest rank among their members. */
	uint32_t *place;  /* [n] by rank: from 0 along the row; undefined where row is TY_NONE */
} ty_rows;

/*
 * Finds the rows among the vertices of a mesh that nothing has been merged in yet. trait: [mesh->vertices] by rank.
 * The result's arrays are the caller's, to be freed with ty_rows_free. O(vertices log vertices).
 */
ty_status ty_rows_detect(const ty_environment *env, const ty_mesh *mesh, const ty_trait *trait, ty_rows *rows);
void ty_rows_free(const ty_environment *env, ty_rows *rows);

/* What the buildings are like, by rank; order[rank] = index of the building. */
void ty_traits(const ty_building *buildings, const uint32_t *order, size_t n, const ty_grid *grid, ty_trait *trait);

/*
 * The rows of a group by themselves: its canonical order, its mesh, its rows. n >= 1; order holds n entries of the
 * caller's. The rows are the same as the collapse of the group finds.
 */
ty_status ty_rows_of_group(const ty_environment *env, const ty_building *buildings, size_t n, uint32_t *order,
						   ty_rows *rows);

#endif
