/* shed.c - see shed.h */
#include "shed.h"

#include "grid.h"
#include "nearest.h"

#include <math.h>

/* ---- houses and sheds ---- */

static bool
is_shed(const ty_input *input, const ty_parameters *p, size_t i)
{
	double area = input->buildings[i].area;

	return area < p->min_area && !ty_is_kept(p, area, input->importance == NULL ? 1 : input->importance[i]);
}

/* Copies the buildings, houses first. */
static void
part_buildings(const ty_parameters *p, ty_sheds *sheds)
{
	const ty_input *input = sheds->input;
	size_t house = 0, shed = input->n - sheds->count;

	for (size_t i = 0; i < input->n; i++)
	{
		bool is_house = !is_shed(input, p, i);
		size_t at = is_house ? house++ : shed++;

		sheds->buildings[at] = input->buildings[i];
		sheds->index[at] = (uint32_t) i;
		if (is_house && sheds->importance != NULL)
			sheds->importance[at] = input->importance[i];
		if (is_house && sheds->outlines != NULL)
			sheds->outlines[at] = input->outlines[i];
	}
}

ty_status
ty_sheds_part(const ty_environment *env, const ty_input *input, const ty_parameters *p, ty_sheds *sheds)
{
	*sheds = (ty_sheds){.input = input, .houses = *input};
	for (size_t i = 0; i < input->n; i++)
		sheds->count += is_shed(input, p, i);
	if (sheds->count == 0)
		return TY_OK;
	sheds->buildings = ty_allocate_array(env, input->n, sizeof *sheds->buildings);
	sheds->index = ty_allocate_array(env, input->n, sizeof *sheds->index);
	if (input->importance != NULL)
		sheds->importance = ty_allocate_array(env, input->n - sheds->count, sizeof *sheds->importance);
	if (input->outlines != NULL)
		sheds->outlines = ty_allocate_array(env, input->n - sheds->count, sizeof(ty_outline *));
	if (sheds->buildings == NULL || sheds->index == NULL || (input->importance != NULL && sheds->importance == NULL) ||
		(input->outlines != NULL && sheds->outlines == NULL))
		return TY_NO_MEMORY;
	part_buildings(p, sheds);
	sheds->houses.buildings = sheds->buildings;
	sheds->houses.n = input->n - sheds->count;
	sheds->houses.importance = sheds->importance;
	sheds->houses.outlines = sheds->outlines;
	return TY_OK;
}

void
ty_sheds_free(const ty_environment *env, ty_sheds *sheds)
{
	ty_release(env, sheds->buildings);
	ty_release(env, sheds->importance);
	ty_release(env, sheds->outlines);
	ty_release(env, sheds->index);
}

/* ---- members ---- */

/* order[k] = number of the shed with rank k */
static ty_status
order_sheds(const ty_environment *env, const ty_building *shed, size_t count, uint32_t *order)
{
	ty_position *position = ty_allocate_array(env, count, sizeof *position);
	uint64_t *keys = ty_allocate_array(env, count, sizeof *keys);
	ty_grid grid;
	ty_status status = position != NULL && keys != NULL ? ty_grid_fit(shed, count, &grid) : TY_NO_MEMORY;

	if (status == TY_OK)
		status = ty_canonical_order(env, shed, count, &grid, order, position, keys);
	ty_release(env, position);
	ty_release(env, keys);
	return status;
}

/* those that a shed may join: the ones that are drawn, or all where none is */
typedef struct candidates
{
	size_t count;
	uint32_t *placeholder;
	ty_point *center;
	const ty_barrier_lines *lines;
	ty_point shed;
} candidates;

static ty_status
list_candidates(const ty_environment *env, const ty_result *result, candidates *c)
{
	bool all = result->undrawn == result->count;

	c->placeholder = ty_allocate_array(env, result->count, sizeof *c->placeholder);
	c->center = ty_allocate_array(env, result->count, sizeof *c->center);
	if (c->placeholder == NULL || c->center == NULL)
		return TY_NO_MEMORY;
	for (size_t i = 0; i < result->count; i++)
		if (all || result->placeholders[i].area > 0)
		{
			c->center[c->count] = (ty_point){result->placeholders[i].x, result->placeholders[i].y};
			c->placeholder[c->count++] = (uint32_t) i;
		}
	return TY_OK;
}

/* whether no barrier lies between the shed and a placeholder */
static bool
on_its_side(const void *context, uint32_t number)
{
	const candidates *c = context;

	return c->lines == NULL || !ty_barrier_lines_cross(c->lines, c->shed, c->center[number]);
}

/* The placeholder of each shed, in the order given. */
static ty_status
find_placeholders(const ty_environment *env, const ty_sheds *sheds, const ty_building *shed, const uint32_t *order,
				  const ty_result *result, uint32_t *placeholder)
{
	candidates c = {.lines = sheds->input->barriers};
	ty_nearest tree = {0};
	ty_status status = list_candidates(env, result, &c);

	if (status == TY_OK)
	{
		status = ty_nearest_build(env, c.center, c.count, &tree);
		for (size_t k = 0; k < sheds->count && status == TY_OK; k++)
		{
			const ty_building *b = &shed[order[k]];

			c.shed = (ty_point){b->x, b->y};
			placeholder[k] = c.placeholder[ty_nearest_allowed(&tree, c.shed, on_its_side, &c)];
			if (ty_interrupted_at(env, k))
				status = TY_INTERRUPTED;
		}
		ty_nearest_free(env, &tree);
	}
	ty_release(env, c.placeholder);
	ty_release(env, c.center);
	return status;
}

/* The kept buildings that collide, as indices into the caller's input. */
static void
number_collisions(const uint32_t *index, ty_collisions *collisions)
{
	if (collisions->pairs > 0)
		for (int i = 0; i < 2; i++)
			collisions->first_pair[i] = index[collisions->first_pair[i]];
	if (collisions->beside_lines > 0)
		collisions->first_beside = index[collisions->first_beside];
}

/* Takes sheds among the members: members[] becomes those of the whole input. */
static void
join_members(const ty_sheds *sheds, const uint32_t *order, const uint32_t *placeholder, uint32_t *members,
			 ty_result *result)
{
	const uint32_t *shed_index = sheds->index + sheds->houses.n;
	size_t next = 0;

	number_collisions(sheds->index, &result->collisions);
	for (size_t k = 0; k < sheds->count; k++)
		result->placeholders[placeholder[k]].count++;
	for (size_t i = 0, house = 0; i < result->count; i++)
	{
		ty_placeholder *p = &result->placeholders[i];
		size_t houses = (i + 1 < result->count ? result->placeholders[i + 1].first : sheds->houses.n) - p->first;
		size_t first = next;

		for (size_t end = house + houses; house < end; house++)
			members[next++] = sheds->index[result->members[house]];
		p->representative = sheds->index[p->representative];
		next = first + p->count;
		p->count = (uint32_t) houses;
		p->first = (uint32_t) first;
	}
	for (size_t k = 0; k < sheds->count; k++)
	{
		ty_placeholder *p = &result->placeholders[placeholder[k]];

		members[p->first + p->count++] = shed_index[order[k]];
	}
}

/* ---- sheds alone ---- */

/* the number of the shed with the highest importance, then the largest area, then the smallest rank */
static uint32_t
first_of_sheds(const ty_sheds *sheds, const uint32_t *order)
{
	const double *importance = sheds->input->importance;
	uint32_t best = order[0];

	for (size_t k = 1; k < sheds->count; k++)
	{
		double p = importance == NULL ? 1 : importance[sheds->index[order[k]]];
		double q = importance == NULL ? 1 : importance[sheds->index[best]];

		if (p > q || (p == q && sheds->buildings[order[k]].area > sheds->buildings[best].area))
			best = order[k];
	}
	return best;
}

/* One placeholder without size. */
static ty_status
describe_sheds(const ty_environment *env, const ty_sheds *sheds, const uint32_t *order, uint32_t *members,
			   ty_result *result)
{
	uint32_t best = first_of_sheds(sheds, order);
	const ty_building *b = &sheds->buildings[best];

	result->placeholders = ty_allocate_array(env, 1, sizeof *result->placeholders);
	if (result->placeholders == NULL)
		return TY_NO_MEMORY;
	result->count = 1;
	result->placeholders[0] = (ty_placeholder){.x = b->x,
											   .y = b->y,
											   .ratio = b->ratio,
											   .ux = b->ux,
											   .uy = b->uy,
											   .representative = sheds->index[best],
											   .count = (uint32_t) sheds->count};
	for (size_t k = 0; k < sheds->count; k++)
		members[k] = sheds->index[order[k]];
	return TY_OK;
}

/* order and placeholder: [sheds] scratch */
static ty_status
join(const ty_environment *env, const ty_sheds *sheds, uint32_t *order, uint32_t *placeholder, uint32_t *members,
	 ty_result *result)
{
	const ty_building *shed = sheds->buildings + sheds->houses.n;
	ty_status status = order_sheds(env, shed, sheds->count, order);

	if (status != TY_OK)
		return status;
	if (sheds->houses.n == 0)
		return describe_sheds(env, sheds, order, members, result);
	status = find_placeholders(env, sheds, shed, order, result, placeholder);
	if (status == TY_OK)
		join_members(sheds, order, placeholder, members, result);
	return status;
}

ty_status
ty_sheds_join(const ty_environment *env, ty_sheds *sheds, ty_result *result)
{
	uint32_t *order = ty_allocate_array(env, sheds->count, sizeof *order);
	uint32_t *placeholder = ty_allocate_array(env, sheds->count, sizeof *placeholder);
	uint32_t *members = ty_allocate_array(env, sheds->input->n, sizeof *members);
	ty_status status = TY_NO_MEMORY;

	if (order != NULL && placeholder != NULL && members != NULL)
		status = join(env, sheds, order, placeholder, members, result);
	if (status == TY_OK)
	{
		ty_release(env, result->members);
		result->members = members;
		members = NULL;
	}
	ty_release(env, order);
	ty_release(env, placeholder);
	ty_release(env, members);
	return status;
}
