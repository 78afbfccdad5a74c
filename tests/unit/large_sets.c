/* large_sets.c - see sets.h */
#include "sets.h"

#include <math.h>

const char *const large_kind_name[LARGE_KINDS] = {
	"uniform", "clustered", "hub",			"ring",	   "two lines",		 "twin row",
	"spiral",  "one point", "slanted line", "fractal", "shaken lattice", "lattice",
};

#define SIDE 10000.0 /* ground units of the box, about */
#define TURN 6.283185307179586

static void
clustered(random_state *random, double *x, double *y)
{
	double village = (double) random_between(random, 0, 19);
	double distance = 300.0 * random_unit(random) * random_unit(random);
	double angle = TURN * random_unit(random);

	*x = 2000.0 * fmod(village, 5.0) + distance * cos(angle);
	*y = 2500.0 * floor(village / 5.0) + distance * sin(angle);
}

/* the corners of corners of corners of a square: distances of every size, equal at every size */
static void
fractal(size_t i, double *x, double *y)
{
	*x = *y = 0;
	for (double size = SIDE; i > 0; i /= 4, size /= 3)
	{
		*x += i % 2 == 0 ? 0 : size;
		*y += i / 2 % 2 == 0 ? 0 : size;
	}
}

static void
large_point(large_kind kind, random_state *random, size_t i, size_t n, double *x, double *y)
{
	double share = (double) i / (double) n;
	double side = ceil(sqrt((double) n));
	double shake = kind == LARGE_SHAKEN_LATTICE ? 0.01 : 0.0;

	switch (kind)
	{
		case LARGE_CLUSTERED:
			clustered(random, x, y);
			break;
		case LARGE_HUB:
			*x = i == 0 ? 0 : SIDE * cos(TURN * share);
			*y = i == 0 ? 0 : SIDE * sin(TURN * share);
			break;
		case LARGE_RING:
			*x = i % 2 == 0 ? random_unit(random) : SIDE * cos(TURN * share);
			*y = i % 2 == 0 ? random_unit(random) : SIDE * sin(TURN * share);
			break;
		case LARGE_TWO_LINES:
			*x = (double) (i / 2);
			*y = i % 2 == 0 ? 0 : SIDE;
			break;
		case LARGE_TWIN_ROW:
			*x = (double) (i / 2);
			*y = i % 2 == 0 ? 0 : 0.001;
			break;
		case LARGE_SPIRAL:
			*x = SIDE * share * cos(30 * TURN * share);
			*y = SIDE * share * sin(30 * TURN * share);
			break;
		case LARGE_ONE_POINT:
			*x = *y = 1234.5;
			break;
		case LARGE_SLANTED_LINE:
			*x = 3.0 * (double) i;
			*y = 1.0 * (double) i;
			break;
		case LARGE_FRACTAL:
			fractal(i, x, y);
			break;
		case LARGE_SHAKEN_LATTICE:
		case LARGE_LATTICE:
			*x = fmod((double) i, side) + shake * random_unit(random);
			*y = floor((double) i / side) + shake * random_unit(random);
			break;
		case LARGE_UNIFORM:
		case LARGE_KINDS:
			*x = SIDE * random_unit(random);
			*y = SIDE * random_unit(random);
			break;
	}
}

void
large_set(large_kind kind, random_state *random, ty_building *buildings, size_t n)
{
	static const double directions[][2] = {{1, 0}, {0, 1}, {0.6, 0.8}, {-0.8, 0.6}, {0.8, 0.6}};

	for (size_t i = 0; i < n; i++)
	{
		ty_building *b = &buildings[i];
		const double *direction = directions[random_between(random, 0, 4)];

		large_point(kind, random, i, n, &b->x, &b->y);
		b->area = (double) random_between(random, 40, 400);
		b->ratio = (double) random_between(random, 1, 8) / 8;
		b->ux = direction[0];
		b->uy = direction[1];
		b->id = (int64_t) i;
	}
}

void
shuffle_buildings(random_state *random, ty_building *buildings, size_t n)
{
	for (size_t i = n; i > 1; i--)
	{
		size_t other = (size_t) random_between(random, 0, (int64_t) i - 1);
		ty_building swapped = buildings[i - 1];

		buildings[i - 1] = buildings[other];
		buildings[other] = swapped;
	}
}
