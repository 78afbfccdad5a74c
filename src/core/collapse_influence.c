/*
 * collapse_influence.c - what influences change in the collapse: costs, and where merged vertices come to.
 *
 * Weights are whole numbers (influence.h): sums and rests are exact, so that a mean does not depend on the order of
 * adding. Costs take the importances as they are given.
 */
#include "collapse_internal.h"

#include <float.h>
#include <string.h>

typedef __int128 wide;

static ty_status
copy_importances(ty_run *run, const double *importance)
{
	int exponent = ty_weight_exponent(importance, run->n);

	run->importance = ty_allocate_array(run->env, run->n, sizeof *run->importance);
	run->weighted = ty_allocate_array(run->env, run->n, sizeof *run->weighted);
	if (run->importance == NULL || run->weighted == NULL)
		return TY_NO_MEMORY;
	memcpy(run->importance, importance, run->n * sizeof *importance);
	for (size_t v = 0; v < run->n; v++)
		run->weighted[v] = (ty_weighted){ty_weight(importance[v], exponent), 0, 0};
	return TY_OK;
}

ty_status
ty_influence_begin(ty_run *run, const ty_influence *influence)
{
	ty_status status = TY_OK;

	run->influence = influence;
	if (influence->importance != NULL)
		status = copy_importances(run, influence->importance);
	if (status == TY_OK && influence->row != NULL)
	{
		run->row = ty_allocate_array(run->env, run->n, sizeof *run->row);
		if (run->row == NULL)
			return TY_NO_MEMORY;
		memcpy(run->row, influence->row, run->n * sizeof *run->row);
	}
	return status;
}

void
ty_influence_free(ty_run *run)
{
	ty_release(run->env, run->importance);
	ty_release(run->env, run->weighted);
	ty_release(run->env, run->row);
}

/* ---- costs ---- */

/* INFINITY between two kept ends; with one of them it does not count */
static double
importance_factor(double a, double b)
{
	if (a == INFINITY)
		return b;
	return b == INFINITY || b < a ? a : b;
}

double
ty_influenced_cost(const ty_run *run, uint32_t a, uint32_t b, double cost)
{
	if (run->importance != NULL)
	{
		double factor = importance_factor(run->importance[a], run->importance[b]);

		if (factor == INFINITY)
			return INFINITY;
		cost *= factor;
	}
	if (run->row != NULL && run->row[a] != run->row[b])
		cost *= 1 + run->influence->alignment;
	return cost < DBL_MAX ? cost : DBL_MAX;
}

/* ---- merging ---- */

/* sum of weight * centroid, in one coordinate, of a vertex at the place */
static wide
moment(int64_t weight, int32_t place, int64_t rest)
{
	return (wide) weight * place + rest;
}

/* moment / weight, rounded half up to the grid */
static int32_t
weighted_mean(wide moment, int64_t weight)
{
	return (int32_t) ((2 * moment + weight) / (2 * (wide) weight));
}

ty_position
ty_weighted_place(const ty_run *run, uint32_t a, uint32_t b)
{
	ty_position p = run->vertex[a].position, q = run->vertex[b].position;
	const ty_weighted *v = &run->weighted[a], *w = &run->weighted[b];

	if (run->importance[a] == INFINITY)
		return p;
	if (run->importance[b] == INFINITY)
		return q;
	return (ty_position){
		weighted_mean(moment(v->weight, p.x, v->rest_x) + moment(w->weight, q.x, w->rest_x), v->weight + w->weight),
		weighted_mean(moment(v->weight, p.y, v->rest_y) + moment(w->weight, q.y, w->rest_y), v->weight + w->weight)};
}

void
ty_join_weighted(ty_run *run, uint32_t kept, uint32_t gone, ty_position former, ty_position to)
{
	ty_weighted *v = &run->weighted[kept];
	const ty_weighted *w = &run->weighted[gone];
	ty_position q = run->vertex[gone].position;
	int64_t weight = v->weight + w->weight;

	if (run->importance[gone] > run->importance[kept])
		run->importance[kept] = run->importance[gone];
	if (run->importance[kept] == INFINITY)
		return; /* it stays where it is, whatever is added */
	*v = (ty_weighted){
		weight,
		(int64_t) (moment(v->weight, former.x, v->rest_x) + moment(w->weight, q.x, w->rest_x) - (wide) weight * to.x),
		(int64_t) (moment(v->weight, former.y, v->rest_y) + moment(w->weight, q.y, w->rest_y) - (wide) weight * to.y)};
}

/* A vertex of one row, alone or with buildings of none, goes on in it. */
void
ty_join_rows(ty_run *run, uint32_t kept, uint32_t gone)
{
	if (run->row[kept] == TY_NO_ROW)
		run->row[kept] = run->row[gone];
	else if (run->row[gone] != TY_NO_ROW && run->row[gone] != run->row[kept])
		run->row[kept] = TY_NO_ROW;
}
