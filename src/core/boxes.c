/* boxes.c - see boxes.h */
#include "boxes.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* the largest float not above d; whether that is rounded up is guessed wrong every other time: so without a branch */
static inline float
float_below(double d)
{
	float f;
	int32_t bits;

	if (d > FLT_MAX)
		return FLT_MAX;
	if (d < -FLT_MAX)
		return -INFINITY;
	f = (float) d;
	/* the bits of the next one below: what is negative or -0 goes up, as its magnitude does */
	memcpy(&bits, &f, sizeof bits);
	bits += (1 - 2 * (bits >= 0)) & -(f > d);
	memcpy(&f, &bits, sizeof f);
	return f;
}

ty_box
ty_box_of(double low_x, double low_y, double high_x, double high_y)
{
	return (ty_box){float_below(low_x), float_below(low_y), -float_below(-high_x), -float_below(-high_y)};
}

void
ty_box_enlarge(ty_box *box, const ty_box *by)
{
	box->low_x = by->low_x < box->low_x ? by->low_x : box->low_x;
	box->low_y = by->low_y < box->low_y ? by->low_y : box->low_y;
	box->high_x = by->high_x > box->high_x ? by->high_x : box->high_x;
	box->high_y = by->high_y > box->high_y ? by->high_y : box->high_y;
}

ty_status
ty_boxes_begin(const ty_environment *env, size_t count, ty_boxes *boxes)
{
	size_t all = 0;

	*boxes = (ty_boxes){.count = count};
	if (count >= UINT32_MAX)
		return TY_TOO_MANY;
	for (size_t size = count; size > 0; size = size == 1 ? 0 : (size + TY_BOX_FAN - 1) / TY_BOX_FAN)
	{
		boxes->first[boxes->levels] = all;
		boxes->size[boxes->levels++] = size;
		all += size;
	}
	boxes->box = ty_allocate_array(env, all, sizeof *boxes->box);
	return boxes->box == NULL ? TY_NO_MEMORY : TY_OK;
}

void
ty_boxes_raise(ty_boxes *boxes)
{
	for (int level = 1; level < boxes->levels; level++)
	{
		const ty_box *below = boxes->box + boxes->first[level - 1];
		ty_box *box = boxes->box + boxes->first[level];

		for (size_t i = 0; i < boxes->size[level - 1]; i++)
			if (i % TY_BOX_FAN == 0)
				box[i / TY_BOX_FAN] = below[i];
			else
				ty_box_enlarge(&box[i / TY_BOX_FAN], &below[i]);
	}
}

void
ty_boxes_enlarge(ty_boxes *boxes, size_t thing)
{
	const ty_box *box = &boxes->box[thing];

	for (int level = 1; level < boxes->levels; level++)
	{
		ty_box *above = &boxes->box[boxes->first[level] + (thing /= TY_BOX_FAN)];

		if (above->low_x <= box->low_x && above->low_y <= box->low_y && above->high_x >= box->high_x &&
			above->high_y >= box->high_y)
			return;
		ty_box_enlarge(above, box);
	}
}

void
ty_boxes_free(const ty_environment *env, ty_boxes *boxes)
{
	ty_release(env, boxes->box);
	*boxes = (ty_boxes){0};
}
