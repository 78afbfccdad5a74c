/* outline.c - see outline.h */
#include "outline.h"

#include <math.h>

size_t
ty_outline_size(size_t rings, size_t points)
{
	size_t entries = rings + rings % 2;

	if (entries > (SIZE_MAX / 4 - sizeof(ty_outline)) / sizeof(uint32_t) || points > SIZE_MAX / 4 / sizeof(ty_point))
		return 0;
	return sizeof(ty_outline) + entries * sizeof(uint32_t) + points * sizeof(ty_point);
}

/* The box of the shell along the direction, from the centre. */
static void
fit_box(ty_outline *outline)
{
	const ty_point *point = ty_outline_points(outline);

	outline->low = (ty_point){INFINITY, INFINITY};
	outline->high = (ty_point){-INFINITY, -INFINITY};
	for (uint32_t i = 0; i < *ty_outline_ring_sizes(outline); i++)
	{
		double x = point[i].x - outline->centre.x, y = point[i].y - outline->centre.y;
		double along = x * outline->ux + y * outline->uy, across = y * outline->ux - x * outline->uy;

		outline->low = (ty_point){fmin(outline->low.x, along), fmin(outline->low.y, across)};
		outline->high = (ty_point){fmax(outline->high.x, along), fmax(outline->high.y, across)};
	}
}

void
ty_outline_set_centre(ty_outline *outline, ty_point centre)
{
	outline->centre = centre;
	fit_box(outline);
}

ty_status
ty_outline_measure(const ty_environment *env, ty_outline *outline, bool *drawable)
{
	const uint32_t *sizes = ty_outline_ring_sizes(outline);
	const ty_point *point = ty_outline_points(outline);
	ty_building building;
	ty_measure m;
	ty_status status;

	*drawable = false;
	ty_measure_begin(&m, env);
	for (uint32_t ring = 0; ring < outline->rings; ring++)
	{
		ty_measure_ring(&m, point, sizeof *point, sizes[ring], ring == 0);
		point += sizes[ring];
	}
	status = ty_measure_end(&m, &building);
	if (status == TY_NOT_FINITE || (status == TY_OK && !(building.area > 0)))
		return TY_OK;
	if (status != TY_OK)
		return status;
	outline->centre = (ty_point){building.x, building.y};
	outline->area = building.area;
	outline->ux = building.ux;
	outline->uy = building.uy;
	fit_box(outline);
	*drawable = true;
	return TY_OK;
}

/* width and length of the minimum-area rectangle */
static ty_point
box_sides(const ty_outline *outline)
{
	double along = outline->high.x - outline->low.x, across = outline->high.y - outline->low.y;

	/* they are equal up to rounding in a square */
	return (ty_point){fmin(along, across), fmax(along, across)};
}

ty_size
ty_outline_drawn_size(const ty_parameters *p, const ty_outline *outline, double statistic, double area)
{
	ty_point sides = box_sides(outline);
	double factor;

	if (p->max_area > 0)
		area = fmax(statistic, fmin(area, p->max_area));
	factor = sqrt(area / outline->area);
	if (factor * sides.x < p->min_side)
		factor = p->min_side / sides.x;
	return (ty_size){factor * factor * outline->area, sides.x / sides.y, factor * sides.x, factor * sides.y};
}

ty_point
ty_outline_box_centre(const ty_outline *outline, double factor)
{
	double along = factor * (outline->low.x + outline->high.x) / 2;
	double across = factor * (outline->low.y + outline->high.y) / 2;

	return (ty_point){along * outline->ux - across * outline->uy, along * outline->uy + across * outline->ux};
}

void
ty_outline_move(ty_outline *outline, ty_point centre, double factor)
{
	ty_point *point = ty_outline_points(outline), from = outline->centre;

	if (factor == 1 && centre.x == from.x && centre.y == from.y)
		return;
	for (uint32_t i = 0; i < outline->points; i++)
		point[i] = (ty_point){centre.x + factor * (point[i].x - from.x), centre.y + factor * (point[i].y - from.y)};
	outline->centre = centre;
	outline->area *= factor * factor;
	outline->low = (ty_point){factor * outline->low.x, factor * outline->low.y};
	outline->high = (ty_point){factor * outline->high.x, factor * outline->high.y};
}
