/* vicinity.c - see vicinity.h */
#include "vicinity.h"

#include <math.h>

#define FIRST_FOUND 256

static const ty_box nothing = {INFINITY, INFINITY, -INFINITY, -INFINITY};

ty_status
ty_vicinity_begin(const ty_environment *env, size_t count, ty_vicinity *v)
{
	ty_status status;

	*v = (ty_vicinity){.env = env, .count = count, .found_capacity = FIRST_FOUND};
	status = ty_boxes_begin(env, count, &v->boxes);
	if (status != TY_OK)
		return status;
	v->discs = ty_allocate_array(env, count, sizeof *v->discs);
	v->found = ty_allocate_array(env, v->found_capacity, sizeof *v->found);
	if (v->discs == NULL || v->found == NULL)
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
	*v = (ty_vicinity){0};
}

void
ty_vicinity_insert(ty_vicinity *v, uint32_t number, ty_point center, double radius)
{
	v->there += v->discs[number].radius < 0;
	v->discs[number] = (ty_disc){center.x, center.y, radius};
	v->boxes.box[number] = ty_box_of(center.x - radius, center.y - radius, center.x + radius, center.y + radius);
	ty_boxes_enlarge(&v->boxes, number);
}

void
ty_vicinity_remove(ty_vicinity *v, uint32_t number)
{
	v->there -= !(v->discs[number].radius < 0);
	v->discs[number].radius = -1;
	v->boxes.box[number] = nothing;
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
make_room(ty_vicinity *v)
{
	uint32_t *found = ty_reallocate_array(v->env, v->found, 2 * v->found_capacity, sizeof *found);

	if (found == NULL)
		return TY_NO_MEMORY;
	v->found = found;
	v->found_capacity *= 2;
	return TY_OK;
}

/* Lists the disc if it touches the one that is looked for. */
static inline bool
consider(void *context, size_t thing)
{
	search *s = context;
	const ty_disc *disc = &s->v->discs[thing];
	double dx = disc->x - s->disc.x, dy = disc->y - s->disc.y, reach = s->disc.radius + disc->radius;

	if (thing == s->number || dx * dx + dy * dy > reach * reach)
		return true;
	if (s->v->found_count == s->v->found_capacity)
		s->status = make_room(s->v);
	if (s->status == TY_OK)
		s->v->found[s->v->found_count++] = (uint32_t) thing;
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
