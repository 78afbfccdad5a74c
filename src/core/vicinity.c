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
	v->disc_around = ty_allocate_array(env, v->around_capacity, sizeof *v->disc_around);
	if (v->discs == NULL || v->found == NULL || v->around == NULL || v->disc_around == NULL)
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
	ty_release(v->env, v->disc_around);
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

/* Makes room for more numbers than so many. */
static ty_status
reserve(const ty_environment *env, size_t count, uint32_t **numbers, size_t *capacity)
{
	size_t wider = *capacity;
	uint32_t *larger;

	if (count < wider)
		return TY_OK;
	while (count >= wider)
		wider *= 2;
	larger = ty_reallocate_array(env, *numbers, wider, sizeof *larger);
	if (larger == NULL)
		return TY_NO_MEMORY;
	*numbers = larger;
	*capacity = wider;
	return TY_OK;
}

static inline bool
touches(const ty_disc *a, const ty_disc *b)
{
	double dx = a->x - b->x, dy = a->y - b->y, reach = b->radius + a->radius;

	return dx * dx + dy * dy <= reach * reach;
}

/* Lists the disc if it touches the one that is looked for. */
static inline bool
consider(void *context, size_t thing)
{
	search *s = context;
	ty_vicinity *v = s->v;

	if (thing == s->number || !touches(&v->discs[thing], &s->disc))
		return true;
	s->status = reserve(v->env, v->found_count, &v->found, &v->found_capacity);
	if (s->status == TY_OK)
		v->found[v->found_count++] = (uint32_t) thing;
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

#define BLOCK 16 /* discs that the tree is searched for at once */

static inline bool
list_around(void *context, size_t thing)
{
	search *s = context;
	ty_vicinity *v = s->v;

	s->status = reserve(v->env, v->around_count, &v->around, &v->around_capacity);
	if (s->status == TY_OK)
		v->around[v->around_count++] = (uint32_t) thing;
	return s->status == TY_OK;
}

/* Searches the tree once for a whole block. */
static ty_status
look_around(ty_vicinity *v, size_t block)
{
	search s = {.v = v, .box = nothing, .status = TY_OK};
	size_t capacity = v->around_capacity;

	for (size_t i = block * BLOCK; i < (block + 1) * BLOCK && i < v->count; i++)
		ty_box_enlarge(&s.box, &v->boxes.box[i]);
	v->around_count = 0;
	v->block = SIZE_MAX;
	ty_boxes_search(&v->boxes, may_touch, list_around, &s);
	if (v->around_capacity > capacity)
	{
		ty_release(v->env, v->disc_around);
		v->disc_around = ty_allocate_array(v->env, v->around_capacity, sizeof *v->disc_around);
	}
	if (s.status == TY_OK && v->disc_around != NULL)
		s.status = reserve(v->env, v->around_count, &v->found, &v->found_capacity);
	if (s.status != TY_OK || v->disc_around == NULL)
		return TY_NO_MEMORY;
	for (size_t i = 0; i < v->around_count; i++)
		v->disc_around[i] = v->discs[v->around[i]];
	v->block = block;
	return TY_OK;
}

/* Without a branch, since nobody can tell which of those around touch. */
ty_status
ty_vicinity_find_touching(ty_vicinity *v, uint32_t number)
{
	ty_status status = v->block == number / BLOCK ? TY_OK : look_around(v, number / BLOCK);
	const ty_disc disc = v->discs[number];
	size_t count = 0;

	for (size_t i = 0; status == TY_OK && i < v->around_count; i++)
	{
		v->found[count] = v->around[i];
		count += touches(&v->disc_around[i], &disc) & (v->around[i] != number);
	}
	v->found_count = count;
	return status;
}
