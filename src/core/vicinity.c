/* vicinity.c - see vicinity.h */
#include "vicinity.h"

#include <math.h>

#define FIRST_FOUND 256

static const ty_box nothing = {INFINITY, INFINITY, -INFINITY, -INFINITY};

ty_status
ty_vicinity_begin(const ty_environment *env, size_t count, ty_vicinity *v)
{
	ty_status status;

	*v = (ty_vicinity){
		.env = env, .count = count, .found_capacity = FIRST_FOUND, .around_capacity = FIRST_FOUND, .block = SIZE_MAX};
	status = ty_boxes_begin(env, count, &v->boxes);
	if (status != TY_OK)
		return status;
	v->discs = ty_allocate_array(env, count, sizeof *v->discs);
	v->found = ty_allocate_array(env, v->found_capacity, sizeof *v->found);
	v->around = ty_allocate_array(env, v->around_capacity, sizeof *v->around);
	if (v->discs == NULL || v->found == NULL || v->around == NULL)
		return TY_NO_MEMORY;
	for (size_t i = 0; i < count; i++)
	{
		v->discs[i].radius = -1;
		v->boxes.box[i] = nothing;
	}
	ty_boxes_raise(&v->boxes);
	return TY_OK;
}

void
ty_vicinity_free(ty_vicinity *v)
{
	if (v->env == NULL)
		return;
	ty_boxes_free(v->env, &v->boxes);
	ty_release(v->env, v->discs);
	ty_release(v->env, v->found);
	ty_release(v->env, v->around);
	*v = (ty_vicinity){0};
}

void
ty_vicinity_insert(ty_vicinity *v, uint32_t number, ty_point center, double radius)
{
	v->there += v->discs[number].radius < 0;
	v->discs[number] = (ty_disc){center.x, center.y, radius};
	v->boxes.box[number] = ty_box_of(center.x - radius, center.y - radius, center.x + radius, center.y + radius);
	ty_boxes_enlarge(&v->boxes, number);
	v->block = SIZE_MAX;
}

void
ty_vicinity_remove(ty_vicinity *v, uint32_t number)
{
	v->there -= !(v->discs[number].radius < 0);
	v->discs[number].radius = -1;
	v->boxes.box[number] = nothing;
	v->block = SIZE_MAX;
}

void
ty_vicinity_fit(ty_vicinity *v)
{
	ty_boxes_raise(&v->boxes);
}

typedef struct search
{
	ty_vicinity *v;
	ty_box box;
	ty_disc disc;
	uint32_t number;
	ty_status status;
} search;

static inline bool
may_touch(const void *context, const ty_box *box)
{
	return ty_box_meets(&((const search *) context)->box, box);
}

static ty_status
list(const ty_environment *env, uint32_t number, uint32_t **numbers, size_t *count, size_t *capacity)
{
	if (*count == *capacity)
	{
		uint32_t *larger = ty_reallocate_array(env, *numbers, 2 * *capacity, sizeof *larger);

		if (larger == NULL)
			return TY_NO_MEMORY;
		*numbers = larger;
		*capacity *= 2;
	}
	(*numbers)[(*count)++] = number;
	return TY_OK;
}

/* Lists the disc if it touches the one that is looked for. */
static inline bool
consider(void *context, size_t thing)
{
	search *s = context;
	ty_vicinity *v = s->v;
	const ty_disc *disc = &v->discs[thing];
	double dx = disc->x - s->disc.x, dy = disc->y - s->disc.y, reach = s->disc.radius + disc->radius;

	if (thing != s->number && dx * dx + dy * dy <= reach * reach)
		s->status = list(v->env, (uint32_t) thing, &v->found, &v->found_count, &v->found_capacity);
	return s->status == TY_OK;
}

ty_status
ty_vicinity_find(ty_vicinity *v, uint32_t number, ty_point center, double radius)
{
	search s = {.v = v,
				.box = ty_box_of(center.x - radius, center.y - radius, center.x + radius, center.y + radius),
				.disc = {center.x, center.y, radius},
				.number = number,
				.status = TY_OK};

	v->found_count = 0;
	ty_boxes_search(&v->boxes, may_touch, consider, &s);
	return s.status;
}

/* ---- one after the other ---- */

static inline bool
list_around(void *context, size_t thing)
{
	search *s = context;
	ty_vicinity *v = s->v;

	s->status = list(v->env, (uint32_t) thing, &v->around, &v->around_count, &v->around_capacity);
	return s->status == TY_OK;
}

/* Searches the tree once for a whole block. */
static ty_status
look_around(ty_vicinity *v, size_t block)
{
	search s = {.v = v, .box = nothing, .status = TY_OK};

	for (size_t i = block * TY_BOX_FAN; i < (block + 1) * TY_BOX_FAN && i < v->count; i++)
		ty_box_enlarge(&s.box, &v->boxes.box[i]);
	v->around_count = 0;
	ty_boxes_search(&v->boxes, may_touch, list_around, &s);
	v->block = s.status == TY_OK ? block : SIZE_MAX;
	return s.status;
}

ty_status
ty_vicinity_find_touching(ty_vicinity *v, uint32_t number)
{
	search s = {.v = v, .disc = v->discs[number], .number = number};

	s.status = v->block == number / TY_BOX_FAN ? TY_OK : look_around(v, number / TY_BOX_FAN);
	v->found_count = 0;
	for (size_t i = 0; s.status == TY_OK && i < v->around_count; i++)
		consider(&s, v->around[i]);
	return s.status;
}
