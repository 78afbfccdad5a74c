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

static bool
in_row(const ty_run *run, uint32_t v)
{
	return run->in_row[v / 8] >> v % 8 & 1;
}

static void
set_in_row(ty_run *run, uint32_t v)
{
	uint8_t bit = (uint8_t) (1 << v % 8);

	run->in_row[v / 8] = run->rows->span[v].row != TY_NONE ? run->in_row[v / 8] | bit : run->in_row[v / 8] & ~bit;
}

/* The influence's rows are known. */
static ty_status
take_rows(ty_run *run)
{
	run->in_row = ty_allocate_array(run->env, run->n / 8 + 1, 1);
	if (run->in_row == NULL)
		return TY_NO_MEMORY;
	memset(run->in_row, 0, run->n / 8 + 1);
	run->rows = run->influence->rows;
	for (uint32_t v = 0; v < run->n; v++)
		set_in_row(run, v);
	return TY_OK;
}

ty_status
ty_influence_begin(ty_run *run, const ty_influence *influence)
{
	ty_status status = TY_OK;

	run->influence = influence;
	if (influence->importance != NULL)
		status = copy_importances(run, influence->importance);
	if (status == TY_OK && influence->find_rows == NULL && influence->rows != NULL)
		status = take_rows(run);
	return status;
}

void
ty_influence_free(ty_run *run)
{
	ty_release(run->env, run->importance);
	ty_release(run->env, run->weighted);
	ty_release(run->env, run->in_row);
}

ty_status
ty_influence_find_rows(ty_run *run)
{
	const ty_influence *influence = run->influence;
	ty_status status = TY_OK;

	if (influence == NULL || influence->rows == NULL || influence->find_rows == NULL)
		return TY_OK;
	status = influence->find_rows(influence->context, &run->mesh, influence->rows);
	return status == TY_OK && influence->rows->count > 0 ? take_rows(run) : status;
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

/* how much longer an edge counts for the rows of its ends */
static double
row_factor(const ty_run *run, uint32_t a, uint32_t b)
{
	double length = sqrt((double) ty_squared_distance(run->vertex[a].position, run->vertex[b].position));

	uint64_t size = (uint64_t) run->vertex[a].size + run->vertex[b].size;

	if (!(length > 0))
		return 1;
	return ty_aligned_length(run->rows, run->rows->span[a], run->rows->span[b], size, length,
							 run->influence->alignment) /
		   length;
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
	if (run->rows != NULL && (in_row(run, a) || in_row(run, b)))
		cost *= row_factor(run, a, b);
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

void
ty_join_rows(ty_run *run, uint32_t kept, uint32_t gone)
{
	ty_span *span = run->rows->span;

	if (!in_row(run, kept) && !in_row(run, gone))
		return;
	span[kept] = ty_joined_span(span[kept], span[gone], (uint64_t) run->vertex[kept].size + run->vertex[gone].size);
	set_in_row(run, kept);
}
