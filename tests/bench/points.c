/* points.c - see points.h */
#include "points.h"

#include "sets.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define TURN 6.283185307179586
#define SPACING 40.0	 /* metres between neighbours, on average */
#define TOWN 2000		 /* buildings of a town, on average */
#define FRACTAL_LEVELS 9 /* 4^9 points, and then copies */

const char *const usual_sets[] = {"uniform", "towns", "jittered grid", NULL};
const char *const adversarial_sets[] = {"uniform",	"hub",			"ring",	   "two lines",	   "spiral",  "one point",
										"twin row", "slanted line", "fractal", "wide fractal", "lattice", NULL};

static double
side_of(size_t n)
{
	return SPACING * sqrt((double) n);
}

/* Few towns are large: the share of the town numbered share * towns falls with the root of its number. */
static void
town_point(random_state *random, size_t n, double *x, double *y)
{
	double share = random_unit(random);
	double town = floor(share * share * (double) (n / TOWN + 1));
	random_state of_town = random_seed((uint64_t) town);
	double radius = SPACING * sqrt(TOWN) * (0.2 + random_unit(&of_town));
	double distance = radius * random_unit(random);
	double angle = TURN * random_unit(random);

	*x = side_of(n) * random_unit(&of_town) + distance * cos(angle);
	*y = side_of(n) * random_unit(&of_town) + distance * sin(angle);
}

static void
jittered_point(random_state *random, size_t i, size_t n, double *x, double *y)
{
	double side = ceil(sqrt((double) n));

	*x = SPACING * (fmod((double) i, side) + 0.5 * random_unit(random));
	*y = SPACING * (floor((double) i / side) + 0.5 * random_unit(random));
}

/* the corners of corners of a square, from 1e6 m down to 1e-6 m: most of it is finer than the grid */
static void
wide_fractal_point(size_t i, double *x, double *y)
{
	double size = 1e6;

	*x = *y = 0;
	for (int level = 0; level < FRACTAL_LEVELS; level++, i /= 4, size *= pow(1e-12, 1.0 / (FRACTAL_LEVELS - 1)))
	{
		*x += i % 2 == 0 ? 0 : size;
		*y += i / 2 % 2 == 0 ? 0 : size;
	}
}

static void
own_set(const char *name, random_state *random, ty_building *buildings, size_t n)
{
	for (size_t i = 0; i < n; i++)
	{
		ty_building *b = &buildings[i];

		*b = (ty_building){.area = 40 + 360 * random_unit(random), .ratio = 0.5, .ux = 1, .id = (int64_t) i};
		if (strcmp(name, "towns") == 0)
			town_point(random, n, &b->x, &b->y);
		else if (strcmp(name, "jittered grid") == 0)
			jittered_point(random, i, n, &b->x, &b->y);
		else
			wide_fractal_point(i, &b->x, &b->y);
	}
}

bool
make_set(const char *name, ty_building *buildings, size_t n)
{
	random_state random = random_seed(2003);

	if (strcmp(name, "towns") == 0 || strcmp(name, "jittered grid") == 0 || strcmp(name, "wide fractal") == 0)
	{
		own_set(name, &random, buildings, n);
		return true;
	}
	for (large_kind kind = 0; kind < LARGE_KINDS; kind++)
		if (strcmp(name, large_kind_name[kind]) == 0)
		{
			large_set(kind, &random, buildings, n);
			return true;
		}
	return false;
}

/* room for one more */
static ty_building *
grown(ty_building *buildings, size_t n, size_t *capacity)
{
	ty_building *larger;

	if (n < *capacity)
		return buildings;
	*capacity = *capacity == 0 ? 65536 : 2 * *capacity;
	larger = realloc(buildings, *capacity * sizeof *buildings);
	if (larger == NULL)
		free(buildings);
	return larger;
}

ty_building *
read_set(const char *path, size_t most, size_t *n)
{
	FILE *file = fopen(path, "r");
	ty_building *buildings = NULL;
	size_t capacity = 0;
	double x, y, area;

	*n = 0;
	if (file == NULL)
	{
		perror(path);
		return NULL;
	}
	while ((most == 0 || *n < most) && fscanf(file, "%lf %lf %lf", &x, &y, &area) == 3)
	{
		buildings = grown(buildings, *n, &capacity);
		if (buildings == NULL)
			break;
		buildings[*n] = (ty_building){.x = x, .y = y, .area = area, .ratio = 0.5, .ux = 1, .id = (int64_t) *n};
		(*n)++;
	}
	fclose(file);
	if (buildings == NULL)
		fprintf(stderr, "%s: no points, or no memory for them\n", path);
	return buildings;
}
