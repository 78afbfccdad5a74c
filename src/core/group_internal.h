/*
 * group_internal.h - a group on its way, as group.c, group_legible.c and hierarchy.c go it.
 */
#ifndef TY_GROUP_INTERNAL_H
#define TY_GROUP_INTERNAL_H

#include "alignment.h"
#include "areas.h"
#include "collapse.h"
#include "grid.h"
#include "group.h"

typedef struct ty_group
{
	const ty_building *buildings;
	ty_outline *const *outlines;
	const ty_parameters *parameters;
	const double *importance;		  /* by building, or NULL */
	const ty_barrier_lines *barriers; /* or NULL */
	ty_grid grid;
	ty_area_scale scale;
	double area_factor;
	uint32_t *order;	   /* [n] building by rank */
	ty_position *position; /* [n] by rank */
	uint64_t *keys;		   /* [n] by rank, until the collapse takes them */
	double *weight;		   /* [n] importance by rank, INFINITY: kept; NULL where nothing is weighed or kept */
	int weight_exponent;   /* of weight (influence.h) */
	uint64_t *area_bits;   /* [largest number of members] scratch of the median ... */
	uint32_t *sorted;	   /* ... and what its sort moves along */
	ty_rows rows;		   /* with alignment; else none */
	ty_site_rows pieces;   /* with min_gap: of these rows, what is drawn; else none */
} ty_group;

typedef ty_group group;

/* Grid, canonical order and importances. Whatever it returns: ty_group_free. */
ty_status ty_group_begin(const ty_environment *env, const ty_input *input, const ty_parameters *p, ty_group *g);
/* The merge sequence, under what weighs edges besides their lengths. Once. */
ty_status ty_group_collapse(const ty_environment *env, ty_group *g, const ty_input *input, ty_stop stop, bool with_cost,
							ty_sequence *sequence);
void ty_group_free(const ty_environment *env, ty_group *g);

/* of a building, by its index; INFINITY: kept, for itself or for its size */
double ty_group_importance(const ty_group *g, uint32_t building);

/*
 * Fills in a placeholder whose members are known, ascending by rank. rank: the smallest of them, where the vertex
 * is kept.
 */
ty_status ty_describe(const ty_environment *env, const ty_group *g, const uint32_t *members, uint32_t rank,
					  ty_placeholder *p);

/* Sorts the ranks by label, stably; first and count of the placeholders, and members as buildings. */
void ty_list_members(const uint32_t *label, const uint32_t *order, size_t n, ty_result *result);

/*
 * Keeps the placeholders apart by min_gap (group_legible.c): some come to lie elsewhere, or smaller, and some are
 * joined; label[rank] as ty_sequence_cut gives it, and then anew.
 */
ty_status ty_make_group_legible(const ty_environment *env, ty_group *g, uint32_t *label, size_t n, ty_result *result);

#endif
