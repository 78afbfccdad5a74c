/* group_internal.h - what the files of the group share. */
#ifndef TY_GROUP_INTERNAL_H
#define TY_GROUP_INTERNAL_H

#include "alignment.h"
#include "grid.h"
#include "group.h"

/* see the head of group.c */
typedef struct ty_area_scale
{
	double to_units, from_units;
} ty_area_scale;

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
} ty_group;

/*
 * Fills in a placeholder whose members are known, ascending by rank. rank: the smallest of them, where the vertex
 * is kept.
 */
ty_status ty_describe(const ty_environment *env, const ty_group *g, const uint32_t *members, uint32_t rank,
					  ty_placeholder *p);

/* The importance of a building; INFINITY: kept, for itself or for its size. */
double ty_importance_of(const ty_group *g, uint32_t building);

/* Sorts the ranks by label, stably; first and count of the placeholders, and members as buildings. */
void ty_list_members(const uint32_t *label, const uint32_t *order, size_t n, ty_result *result);

/*
 * Keeps the placeholders apart by min_gap (group_legible.c): some come to lie elsewhere, or smaller, and some are
 * joined; label[rank] as ty_sequence_cut gives it, and then anew.
 */
ty_status ty_make_group_legible(const ty_environment *env, ty_group *g, uint32_t *label, size_t n, ty_result *result);

#endif
