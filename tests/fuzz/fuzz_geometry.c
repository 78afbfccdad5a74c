/*
 * fuzz_geometry.c - the fear: a corrupt row makes the server read beyond it. Any bytes are read as a stored geometry,
 * at every alignment and from memory that ends where the payload ends; what is accepted must be a sound building.
 */
#include "geometry_format.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void
demand(bool holds)
{
	if (!holds)
		abort();
}

static void
check_building(const ty_building *b)
{
	demand(isfinite(b->x) && isfinite(b->y));
	demand(isfinite(b->area) && b->area >= 0);
	demand(b->ratio > 0 && b->ratio <= 1);
	demand(b->uy > 0 || (b->uy == 0 && b->ux == 1));
	demand(fabs(b->ux * b->ux + b->uy * b->uy - 1) < 1e-9);
	demand(b->id == 0);
}

typedef struct visited
{
	size_t points;
	double sum; /* reads them all */
} visited;

static bool
visit(void *context, const unsigned char *points, size_t stride, uint32_t n)
{
	visited *v = context;

	for (uint32_t i = 0; i < n; i++)
	{
		double xy[2];

		memcpy(xy, points + i * stride, sizeof xy);
		v->sum += xy[0] + xy[1];
	}
	v->points += n;
	return true;
}

static void
check_lines(const unsigned char *payload, size_t size, ty_geometry_status points)
{
	visited v = {0, 0};
	int32_t srid = -1;
	uint32_t type = 0;
	ty_geometry_status status = ty_geometry_visit_lines(payload, size, visit, &v, &srid, &type);

	demand(status <= TY_GEOMETRY_CORRUPT);
	demand(v.points * 2 * sizeof(double) <= size);
	if (status == TY_GEOMETRY_OK)
		demand(points == TY_GEOMETRY_OK && v.points > 0);
	if (status == TY_GEOMETRY_EMPTY)
		demand(points == TY_GEOMETRY_EMPTY && v.points == 0);
	if (status == TY_GEOMETRY_CORRUPT)
		demand(points != TY_GEOMETRY_EMPTY);
}

/* An outline, if there is one, is within its rectangle, and is written and read back as it is. */
static void
check_outline(const unsigned char *payload, size_t size)
{
	ty_outline *outline, *again;
	unsigned char *copy;

	if (ty_geometry_outline(&ty_plain_environment, payload, size, &outline) != TY_GEOMETRY_OK || outline == NULL)
		return;
	demand(outline->area > 0 && outline->low.x <= outline->high.x && outline->low.y <= outline->high.y);
	copy = malloc(ty_outline_payload(outline));
	demand(copy != NULL);
	ty_geometry_write_outline(copy, 0, outline);
	demand(ty_geometry_outline(&ty_plain_environment, copy, ty_outline_payload(outline), &again) == TY_GEOMETRY_OK);
	demand(again != NULL && memcmp(outline, again, ty_outline_size(outline->rings, outline->points)) == 0);
	free(copy);
	free(outline);
	free(again);
}

/* What is told about the payload must fit together. */
static void
check_answers(const unsigned char *payload, size_t size)
{
	ty_building building;
	int32_t srid = -1;
	uint32_t type = 0;
	double value = 0;
	ty_geometry_status status = ty_geometry_read(&ty_plain_environment, payload, size, &building, &srid, &type);
	ty_geometry_status points = ty_geometry_has_points(payload, size);

	demand(status <= TY_GEOMETRY_NOT_FINITE);
	demand(points == TY_GEOMETRY_OK || points == TY_GEOMETRY_EMPTY || points == TY_GEOMETRY_CORRUPT);
	if (status == TY_GEOMETRY_OK)
	{
		check_building(&building);
		demand(points == TY_GEOMETRY_OK);
		demand(type >= TY_GEOMETRY_POINT && type <= TY_GEOMETRY_MULTIPOLYGON);
		demand(!ty_geometry_find_not_finite(payload, size, &value));
		check_outline(payload, size);
	}
	if (status == TY_GEOMETRY_EMPTY)
		demand(points == TY_GEOMETRY_EMPTY);
	if (status == TY_GEOMETRY_NOT_FINITE && ty_geometry_find_not_finite(payload, size, &value))
		demand(!isfinite(value));
	demand(ty_geometry_type_name(type) != NULL);
	check_lines(payload, size, points);
}

int
LLVMFuzzerTestOneInput(const unsigned char *data, size_t size)
{
	size_t shift = size % 8;
	unsigned char *memory = malloc(shift + size + 1);

	demand(memory != NULL);
	memcpy(memory + shift + 1, data, size);
	check_answers(memory + shift + 1, size);
	free(memory);
	return 0;
}
