/* group.c - see group.h */
#include "group_internal.h"
#include "shed.h"

#include <math.h>
#include <string.h>

/* ---- exact sums of areas ---- */

/* sum over n buildings; members, if given, are their indices */
static double
sum_areas(const ty_building *buildings, const uint32_t *members, size_t n, ty_area_scale scale)
{
	__int128 sum = 0;

	for (size_t i = 0; i < n; i++)
		sum += ty_area_units(scale, buildings[members == NULL ? i : members[i]].area);
	return ty_area_of_units(scale, sum);
}

double
ty_group_importance(const ty_group *g, uint32_t building)
{
	double importance = g->importance == NULL ? 1 : g->importance[building];

	return ty_is_kept(g->parameters, g->buildings[building].area, importance) ? INFINITY : importance;
}

static double
weighted_mean_area(const ty_group *g, const uint32_t *members, size_t n)
{
	__int128 sum = 0;
	int64_t weights = 0;

	for (size_t i = 0; i < n; i++)
	{
		int64_t weight = ty_weight(ty_group_importance(g, members[i]), g->weight_exponent);

		sum += ty_weighted_area_units(g->scale, g->buildings[members[i]].area, weight);
		weights += weight;
	}
	return ty_weighted_mean_area(g->scale, sum, weights);
}

/* ---- one placeholder ---- */

/* an area whose bits the median has sorted; they ascend as areas do, which are not negative */
static double
area_of_bits(uint64_t bits)
{
	double area;

	memcpy(&area, &bits, sizeof area);
	return area;
}

static ty_status
median_area(const ty_environment *env, const ty_group *g, const uint32_t *members, size_t n, double *median)
{
	ty_status status;

	for (size_t i = 0; i < n; i++)
		memcpy(&g->area_bits[i], &g->buildings[members[i]].area, sizeof *g->area_bits);
	status = ty_sort_keys(env, g->area_bits, g->sorted, n);
	*median = n % 2 == 1 ? area_of_bits(g->area_bits[n / 2])
						 : 0.5 * area_of_bits(g->area_bits[n / 2 - 1]) + 0.5 * area_of_bits(g->area_bits[n / 2]);
	return status;
}

/* the statistic of the members' areas, unscaled (spec 3.2) */
static ty_status
area_statistic(const ty_environment *env, const ty_group *g, const uint32_t *members, size_t n, double *area)
{
	ty_area_statistic statistic = g->parameters->area_statistic;

	if (n == 1)
		*area = g->buildings[members[0]].area;
	else if (statistic == TY_MEDIAN)
		return median_area(env, g, members, n, area);
	else if (statistic == TY_MEAN && g->weight != NULL)
		*area = weighted_mean_area(g, members, n);
	else
		*area = sum_areas(g->buildings, members, n, g->scale) / (statistic == TY_SUM ? 1 : (double) n);
	return TY_OK;
}

/* The direction and the place of the rectangle around an outline whose centre is the vertex. */
static void
fit_outline(const ty_outline *outline, ty_size size, ty_placeholder *p)
{
	ty_point centre = ty_outline_box_centre(outline, sqrt(size.area / outline->area));

	p->ux = outline->ux;
	p->uy = outline->uy;
	p->x += centre.x;
	p->y += centre.y;
}

/*
 * How large the placeholder is drawn, whose place and representative are known: a kept one as if it stood for itself
 * alone.
 */
static void
set_size(const ty_group *g, ty_placeholder *p)
{
	const ty_building *b = &g->buildings[p->representative];
	const ty_outline *outline = g->outlines == NULL ? NULL : g->outlines[p->representative];
	double ratio = g->parameters->shape == TY_SQUARE ? 1 : b->ratio;
	double own = p->kept ? b->area : p->statistic;
	double area = p->kept ? b->area : ty_scaled_area(g->parameters, g->area_factor, p->statistic);
	ty_size size = outline != NULL && area > 0 ? ty_outline_drawn_size(g->parameters, outline, own, area)
											   : ty_drawn_size(g->parameters, own, area, ratio, p->kept ? 1 : p->count);

	p->outlined = outline != NULL && area > 0;
	if (p->outlined)
		fit_outline(outline, size, p);
	p->area = size.area;
	p->ratio = size.ratio;
	p->width = size.width;
	p->length = size.length;
}

/* whether a stands for the two of them: the higher importance, then the larger area */
static bool
represents(const ty_group *g, uint32_t a, uint32_t b)
{
	if (g->weight != NULL)
	{
		double p = ty_group_importance(g, a), q = ty_group_importance(g, b);

		if (p != q)
			return p > q;
	}
	return g->buildings[a].area > g->buildings[b].area;
}

/* of equal ones that with the smallest rank; members ascend by rank */
static uint32_t
representative(const ty_group *g, const uint32_t *members, size_t n)
{
	uint32_t best = members[0];

	for (size_t i = 1; i < n; i++)
		if (represents(g, members[i], best))
			best = members[i];
	return best;
}

#define AHEAD 24 /* members whose buildings are fetched before they are needed: they lie in any order */

/* Fetches the buildings of as many members as the placeholder has, AHEAD of its own. */
static inline __attribute__((always_inline)) void
fetch_ahead(const ty_group *g, const ty_result *result, const ty_placeholder *p, size_t n)
{
	for (size_t i = p->first + AHEAD; i < (size_t) p->first + p->count + AHEAD && i < n; i++)
	{
		__builtin_prefetch(&g->buildings[result->members[i]]);
		__builtin_prefetch(&g->buildings[result->members[i]].uy); /* mostly in the next cache line */
	}
}

ty_status
ty_describe(const ty_environment *env, const ty_group *g, const uint32_t *members, uint32_t rank, ty_placeholder *p)
{
	const ty_building *b;
	ty_status status = area_statistic(env, g, members + p->first, p->count, &p->statistic);

	p->representative = representative(g, members + p->first, p->count);
	p->kept = g->weight != NULL && ty_group_importance(g, p->representative) == INFINITY;
	b = &g->buildings[p->representative];
	/* a building that stands for itself stays exactly where it is, and so does a kept one */
	p->x = p->count == 1 || p->kept ? b->x : ty_grid_x(&g->grid, g->position[rank].x);
	p->y = p->count == 1 || p->kept ? b->y : ty_grid_y(&g->grid, g->position[rank].y);
	p->ux = b->ux;
	p->uy = b->uy;
	set_size(g, p);
	if (status == TY_OK && (!isfinite(p->area) || !isfinite(p->length)))
		status = TY_NOT_FINITE;
	return status;
}

/* ---- the whole group ---- */

void
ty_list_members(const uint32_t *label, const uint32_t *order, size_t n, ty_result *result)
{
	uint32_t first = 0;

	for (size_t i = 0; i < result->count; i++)
		result->placeholders[i].count = 0;
	for (size_t rank = 0; rank < n; rank++)
		result->placeholders[label[rank]].count++;
	for (size_t i = 0; i < result->count; i++)
	{
		result->placeholders[i].first = first;
		first += result->placeholders[i].count;
		result->placeholders[i].count = 0;
	}
	for (size_t rank = 0; rank < n; rank++)
	{
		ty_placeholder *p = &result->placeholders[label[rank]];

		result->members[p->first + p->count++] = order[rank];
	}
}

static uint32_t
most_members(const ty_result *result)
{
	uint32_t most = 1;

	for (size_t i = 0; i < result->count; i++)
		most = result->placeholders[i].count > most ? result->placeholders[i].count : most;
	return most;
}

static ty_status
describe_all(const ty_environment *env, const ty_group *g, const uint32_t *label, size_t n, ty_result *result)
{
	ty_status status = TY_OK;
	size_t next = 0;

	/* labels are numbered by smallest rank: the next new one is met at that rank */
	for (size_t rank = 0; status == TY_OK && rank < n; rank++)
	{
		ty_placeholder *p = &result->placeholders[next];

		if (label[rank] != next)
			continue;
		fetch_ahead(g, result, p, n);
		status = ty_describe(env, g, result->members, (uint32_t) rank, p);
		result->undrawn += !(p->area > 0);
		next++;
		if (ty_interrupted_at(env, next))
			return TY_INTERRUPTED;
		if (next % 65536 == 0)
			ty_progress(env, TY_DRAWING, next, result->count);
	}
	return status;
}

/* room for the median of the placeholder with most members, which may be all where some are joined */
static ty_status
prepare_median(const ty_environment *env, ty_group *g, size_t n, const ty_result *result)
{
	size_t most = g->parameters->min_gap > 0 ? n : most_members(result);

	if (g->parameters->area_statistic != TY_MEDIAN)
		return TY_OK;
	g->area_bits = ty_allocate_array(env, most, sizeof *g->area_bits);
	g->sorted = ty_allocate_array(env, most, sizeof *g->sorted);
	if (g->area_bits == NULL || g->sorted == NULL)
		return TY_NO_MEMORY;
	memset(g->sorted, 0, most * sizeof *g->sorted);
	return TY_OK;
}

/* Lays out what is left of rows. */
static ty_status
lay_out_rows(const ty_environment *env, ty_group *g, const uint32_t *label, size_t n, ty_result *result)
{
	bool kept_apart = g->parameters->min_gap > 0;
	uint32_t *keeper = ty_allocate_array(env, result->count, sizeof *keeper);
	ty_drawn_rows drawn = {.rows = &g->rows,
						   .buildings = g->buildings,
						   .order = g->order,
						   .label = label,
						   .keeper = keeper,
						   .barriers = g->barriers,
						   .pieces = kept_apart ? &g->pieces : NULL,
						   .placeholders = result->count,
						   .n = n};
	size_t next = 0;
	ty_status status = TY_OK;

	if (keeper == NULL)
		return TY_NO_MEMORY;
	if (kept_apart)
		status = ty_pieces_begin(env, &g->rows, result->count, &g->pieces);
	if (status != TY_OK)
	{
		ty_release(env, keeper);
		return status;
	}
	for (size_t rank = 0; rank < n; rank++)
		if (label[rank] == next)
			keeper[next++] = (uint32_t) rank;
	status = ty_rows_lay_out(env, &drawn, result->placeholders);
	ty_release(env, keeper);
	return status;
}

static ty_status
cut_and_describe(const ty_environment *env, ty_group *g, const ty_sequence *sequence, size_t n, ty_result *result)
{
	uint32_t *label = ty_allocate_array(env, n, sizeof *label);
	ty_status status = TY_NO_MEMORY;

	result->members = ty_allocate_array(env, n, sizeof *result->members);
	result->placeholders = ty_allocate_array(env, n - sequence->count, sizeof *result->placeholders);
	if (label != NULL && result->members != NULL && result->placeholders != NULL)
	{
		result->count = ty_sequence_cut(sequence, sequence->count, n, label);
		ty_list_members(label, g->order, n, result);
		status = prepare_median(env, g, n, result);
		if (status == TY_OK)
			status = describe_all(env, g, label, n, result);
		if (status == TY_OK && g->rows.count > 0)
			status = lay_out_rows(env, g, label, n, result);
		if (status == TY_OK && g->parameters->min_gap > 0)
			status = ty_make_group_legible(env, g, label, n, result);
	}
	ty_release(env, label);
	return status;
}

/* what the rows of a group are found with */
typedef struct row_search
{
	const ty_group *group;
	const ty_barriers *barriers;
} row_search;

static bool
barrier_parts(const void *context, ty_position a, ty_position b)
{
	return ty_barriers_cross(context, a, b);
}

/* The rows of the group, found in the mesh of its collapse. */
static ty_status
find_rows(const void *context, const ty_mesh *mesh, ty_rows *rows)
{
	const row_search *search = context;
	const ty_group *g = search->group;
	ty_parting parting = {search->barriers->count > 0 ? barrier_parts : NULL, search->barriers};
	ty_trait *trait = ty_allocate_array(mesh->env, mesh->vertices, sizeof *trait);
	ty_status status;

	if (trait == NULL)
		return TY_NO_MEMORY;
	ty_traits(g->buildings, g->order, mesh, &g->grid, trait);
	status = ty_rows_detect(mesh->env, mesh, trait, parting, rows);
	ty_release(mesh->env, trait);
	return status;
}

/* when to stop, in the core's terms */
static ty_stop
find_stop(const ty_group *g, size_t n)
{
	const ty_parameters *p = g->parameters;
	ty_stop stop = {n, p->min_distance / g->grid.cell};
	double mean_area = 0;

	if (p->count_rule == TY_BLACK_WHITE)
		mean_area = sum_areas(g->buildings, NULL, n, g->scale) / (double) n;
	if (p->law)
		stop.count = ty_count(n, p, mean_area);
	return stop;
}

static ty_status
order_group(const ty_environment *env, ty_group *g, size_t n)
{
	ty_status status = TY_NO_MEMORY;

	g->keys = ty_allocate_array(env, n, sizeof *g->keys);
	g->order = ty_allocate_array(env, n, sizeof *g->order);
	g->position = ty_allocate_array(env, n, sizeof *g->position);
	if (g->keys != NULL && g->order != NULL && g->position != NULL)
		status = ty_canonical_order(env, g->buildings, n, &g->grid, g->order, g->position, g->keys);
	return status;
}

static uint64_t *
take_keys(ty_group *g)
{
	uint64_t *keys = g->keys;

	g->keys = NULL;
	return keys;
}

/* whether a building is to be kept for its size */
static bool
some_are_large(const ty_group *g, size_t n)
{
	for (size_t i = 0; g->parameters->keep_area > 0 && i < n; i++)
		if (ty_is_kept(g->parameters, g->buildings[i].area, 1))
			return true;
	return false;
}

/* Importances by rank, where there is one other than 1. */
static ty_status
weigh_group(const ty_environment *env, ty_group *g, size_t n)
{
	if (g->importance == NULL && !some_are_large(g, n))
		return TY_OK;
	g->weight = ty_allocate_array(env, n, sizeof *g->weight);
	if (g->weight == NULL)
		return TY_NO_MEMORY;
	for (size_t rank = 0; rank < n; rank++)
		g->weight[rank] = ty_group_importance(g, g->order[rank]);
	g->weight_exponent = ty_weight_exponent(g->weight, n);
	return TY_OK;
}

/* whether anything weighs edges besides their lengths */
static bool
weighs(const ty_influence *influence)
{
	return influence->importance != NULL || influence->rows != NULL || influence->crosses != NULL;
}

ty_status
ty_group_begin(const ty_environment *env, const ty_input *input, const ty_parameters *p, ty_group *g)
{
	ty_status status;

	*g = (ty_group){.buildings = input->buildings,
					.outlines = input->outlines,
					.importance = input->importance,
					.barriers = input->barriers,
					.parameters = p,
					.area_factor = ty_area_factor(p)};
	status = ty_grid_fit(g->buildings, input->n, &g->grid);
	if (status != TY_OK)
		return status;
	g->scale = ty_fit_area_scale(g->buildings, input->n);
	status = order_group(env, g, input->n);
	return status == TY_OK ? weigh_group(env, g, input->n) : status;
}

/*
 * Where nothing is merged no rows are found on the way, but those that are to be kept apart stay rows. The canonical
 * order comes out as it is.
 */
static ty_status
find_rows_alone(const ty_environment *env, ty_group *g, const ty_barriers *barriers, size_t n, ty_stop stop)
{
	ty_parting parting = {barriers->count > 0 ? barrier_parts : NULL, barriers};

	if (!(g->parameters->min_gap > 0) || stop.count < n || stop.min_distance > 0)
		return TY_OK;
	return ty_rows_of_group(env, g->buildings, n, parting, g->order, &g->rows);
}

ty_status
ty_group_collapse(const ty_environment *env, ty_group *g, const ty_input *input, ty_stop stop, bool with_cost,
				  ty_sequence *sequence)
{
	ty_barriers barriers = {.env = env};
	ty_influence influence = {.importance = g->weight};
	row_search search = {g, &barriers};
	double alignment = g->parameters->alignment;
	ty_status status = TY_OK;

	if (input->barriers != NULL)
		status = ty_barriers_fit(env, input->barriers, &g->grid, g->position, input->n, &barriers);
	if (barriers.count > 0)
	{
		influence.crosses = ty_barriers_bar;
		influence.fetch = ty_barriers_fetch;
		influence.barriers = &barriers;
	}
	if (alignment > 0)
	{
		influence.rows = &g->rows;
		influence.alignment = alignment;
		influence.find_rows = find_rows;
		influence.context = &search;
		if (status == TY_OK)
			status = find_rows_alone(env, g, &barriers, input->n, stop);
	}
	if (status == TY_OK)
		status = ty_collapse_keyed(env, g->position, take_keys(g), input->n, g->parameters->s_u,
								   weighs(&influence) ? &influence : NULL, stop, with_cost, NULL, NULL, sequence);
	ty_barriers_free(&barriers);
	return status;
}

void
ty_group_free(const ty_environment *env, ty_group *g)
{
	ty_release(env, g->order);
	ty_release(env, g->position);
	ty_release(env, g->keys);
	ty_release(env, g->weight);
	ty_release(env, g->area_bits);
	ty_release(env, g->sorted);
	ty_rows_free(env, &g->rows);
	ty_pieces_free(env, &g->pieces);
	*g = (ty_group){0};
}

/* Typifies buildings that all count. */
static ty_status
typify_houses(const ty_environment *env, const ty_input *input, const ty_parameters *p, ty_result *result)
{
	ty_group g;
	ty_sequence sequence = {0};
	ty_status status = ty_group_begin(env, input, p, &g);

	if (status == TY_OK)
		status = ty_group_collapse(env, &g, input, find_stop(&g, input->n), false, &sequence);
	if (status == TY_OK)
		status = cut_and_describe(env, &g, &sequence, input->n, result);
	ty_sequence_free(env, &sequence);
	ty_group_free(env, &g);
	return status;
}

/* Typifies the houses as if there were no sheds, then adds those. */
static ty_status
typify_with_sheds(const ty_environment *env, const ty_input *input, const ty_parameters *p, ty_result *result)
{
	ty_sheds sheds;
	ty_status status = ty_sheds_part(env, input, p, &sheds);

	if (status == TY_OK && sheds.houses.n > 0)
		status = typify_houses(env, &sheds.houses, p, result);
	if (status == TY_OK && sheds.count > 0)
		status = ty_sheds_join(env, &sheds, result);
	ty_sheds_free(env, &sheds);
	return status;
}

ty_status
ty_typify(const ty_environment *env, const ty_input *input, const ty_parameters *p, ty_result *result)
{
	ty_status status;

	*result = (ty_result){0};
	if (input->n > TY_MAX_VERTICES)
		return TY_TOO_MANY;
	status = p->min_area > 0 ? typify_with_sheds(env, input, p, result) : typify_houses(env, input, p, result);
	if (status != TY_OK)
		ty_result_free(env, result);
	return status;
}

void
ty_result_free(const ty_environment *env, ty_result *result)
{
	ty_release(env, result->placeholders);
	ty_release(env, result->members);
	ty_release(env, result->sites);
	*result = (ty_result){0};
}
