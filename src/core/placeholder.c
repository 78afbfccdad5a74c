/* placeholder.c - see placeholder.h */
#include "placeholder.h"

#include <float.h>
#include <math.h>
#include <string.h>

#define DEGREES_PER_RADIAN 57.29577951308232087680
#define RADIANS_PER_DEGREE 0.017453292519943295769

/* Beyond m200 placeholders keep their size on the map: a smaller exponent would make the share of ink grow. */
#define LEAST_EXPONENT_BEYOND_LOD200 4.0
/* lets a count that is whole in the reals survive the rounding of the law */
#define COUNT_TOLERANCE 1e-12

/* pow, but free of the C library in the cases that matter, so that they are the same everywhere */
static double
power(double base, double exponent)
{
	if (exponent == 0)
		return 1;
	if (exponent == 0.5)
		return sqrt(base);
	if (exponent == 1)
		return base;
	if (exponent == 2)
		return base * base;
	return pow(base, exponent);
}

/* area factor at an arbitrary scale */
static double
area_factor(const ty_parameters *p, double scale)
{
	double enlargement = scale / p->source_scale;
	double fraction = (scale - p->source_scale) / (p->lod200_scale - p->source_scale);
	double reduction = 1 - p->psi * fmin(fraction, 1);

	return reduction == 0 ? 0 : enlargement * enlargement * reduction; /* however large the first factor is */
}

double
ty_area_factor(const ty_parameters *p)
{
	return area_factor(p, p->scale);
}

double
ty_psi(double mean_placeholder_area, double mean_area_lod200, double source_scale, double lod200_scale)
{
	double reduction = source_scale / lod200_scale;

	return 1 - reduction * reduction * (mean_area_lod200 / mean_placeholder_area);
}

/* share of the buildings that the radical law leaves */
static double
radical_share(const ty_parameters *p)
{
	double nearer = fmin(p->scale, p->lod200_scale);
	double share = power(p->source_scale / nearer, p->exponent / 2);

	if (p->scale > p->lod200_scale)
		share *= power(p->lod200_scale / p->scale, fmax(p->exponent, LEAST_EXPONENT_BEYOND_LOD200) / 2);
	return share;
}

/*
 * Greatest area factor over [m25, m_r]: the share of the black-white rule is its inverse, which so never grows
 * with the scale. Up to m200 the factor is a cubic with at most one maximum; beyond it rises.
 */
static double
greatest_area_factor(const ty_parameters *p)
{
	double slope = p->psi / (p->lod200_scale - p->source_scale);
	double greatest = fmax(1, area_factor(p, p->scale));

	greatest = fmax(greatest, area_factor(p, fmin(p->scale, p->lod200_scale)));
	if (slope > 0)
	{
		double summit = 2 * (1 + slope * p->source_scale) / (3 * slope);

		if (summit < fmin(p->scale, p->lod200_scale))
			greatest = fmax(greatest, area_factor(p, summit));
	}
	return greatest;
}

size_t
ty_count(size_t n, const ty_parameters *p, double mean_area)
{
	double count = (double) n;

	if (n == 0)
		return 0;
	if (p->count > 0)
		count = (double) p->count;
	else if (p->count_rule == TY_RADICAL)
		count *= radical_share(p);
	else if (mean_area > 0)
		count /= greatest_area_factor(p);
	count = floor(count * (1 + COUNT_TOLERANCE));
	if (!(count >= 1))
		return 1;
	return count < (double) n ? (size_t) count : n;
}

/* ---- the law the other way round ---- */

/* Up to one or a few roundings the scale at which the radical law leaves a share, in (0, 1], of the buildings. */
static double
scale_of_share(const ty_parameters *p, double share)
{
	double beyond = fmax(p->exponent, LEAST_EXPONENT_BEYOND_LOD200);
	double nearer = p->exponent > 0 ? p->source_scale * pow(share, -2 / p->exponent) : INFINITY;
	double at_lod200 = power(p->source_scale / p->lod200_scale, p->exponent / 2);

	return nearer <= p->lod200_scale ? nearer : p->lod200_scale * pow(share / at_lod200, -2 / beyond);
}

/* Positive doubles ascend as their bits do. */
static uint64_t
bits_of_scale(double scale)
{
	uint64_t bits;

	memcpy(&bits, &scale, sizeof bits);
	return bits;
}

static double
scale_of_bits(uint64_t bits)
{
	double scale;

	memcpy(&scale, &bits, sizeof scale);
	return scale;
}

/* n buildings, of which the law leaves fewer than count from some scale on; p->scale is scratch */
typedef struct threshold
{
	size_t n, count;
	ty_parameters p;
} threshold;

static bool
is_below_at(threshold *t, uint64_t bits)
{
	t->p.scale = scale_of_bits(bits);
	return ty_count(t->n, &t->p, 1) < t->count;
}

/*
 * Walks away from the guess in growing steps, until one end is below and the other, from least on, is not. False:
 * nothing is below up to most.
 */
static bool
bracket(threshold *t, uint64_t least, uint64_t guess, uint64_t most, uint64_t *not_below, uint64_t *below)
{
	bool down = is_below_at(t, guess);

	*not_below = *below = guess;
	for (uint64_t step = 1; down; step *= 2)
	{
		*below = *not_below;
		*not_below = *below - least > step ? *below - step : least;
		down = is_below_at(t, *not_below);
		if (!down)
			return true;
	}
	for (uint64_t step = 1; *not_below < most; step *= 2)
	{
		*below = most - *not_below > step ? *not_below + step : most;
		if (is_below_at(t, *below))
			return true;
		*not_below = *below;
	}
	return false;
}

double
ty_scale_below(size_t n, size_t count, const ty_parameters *p)
{
	threshold t = {n, count, *p};
	uint64_t least = bits_of_scale(p->source_scale), most = bits_of_scale(DBL_MAX), not_below, below;
	double guess;

	if (count == 0 || (count == 1 && n > 0))
		return INFINITY;
	if (is_below_at(&t, least))
		return p->source_scale;
	guess = fmin(fmax(scale_of_share(p, (double) count / (double) n), p->source_scale), DBL_MAX);
	if (!bracket(&t, least, bits_of_scale(guess), most, &not_below, &below))
		return INFINITY;
	while (below - not_below > 1)
	{
		uint64_t middle = not_below + (below - not_below) / 2;

		if (is_below_at(&t, middle))
			below = middle;
		else
			not_below = middle;
	}
	return scale_of_bits(below);
}

/* ---- sizes on the map ---- */

#define MILLIMETRES_PER_METRE 1000.0
#define LEAST_RATIO_OF_SEVERAL (1.0 / 3) /* no stripe stands for several buildings */
#define LEAST_LENGTH_IN_SIDES 1.5		 /* of what was enlarged to min_side, unless it is nearer to a square itself */

void
ty_bring_to_ground(ty_parameters *p, double metres_per_unit)
{
	double length = p->scale / MILLIMETRES_PER_METRE / metres_per_unit;

	p->min_side *= length;
	p->max_area *= length * length;
	p->min_gap *= length;
	p->barrier_width *= length;
	p->keep_area *= length * length;
}

double
ty_scaled_area(const ty_parameters *p, double area_factor, double statistic)
{
	return p->area_statistic == TY_SUM ? statistic : statistic * area_factor;
}

/*
 * Enlarges the short side to min_side. The long side stays what it is, as far as the area does not come to exceed
 * limit, and is long enough in any case that not everything turns square.
 */
static void
enlarge(ty_size *size, double min_side, double limit)
{
	double longest = limit / min_side;

	size->width = min_side;
	size->length = fmin(size->length, longest);
	size->length = fmax(size->length, min_side * fmin(1 / size->ratio, LEAST_LENGTH_IN_SIDES));
	size->area = size->width * size->length;
	size->ratio = size->width / size->length;
}

static double
drawn_ratio(const ty_parameters *p, double ratio, size_t members)
{
	return p->min_side > 0 && members > 1 ? fmax(ratio, LEAST_RATIO_OF_SEVERAL) : ratio;
}

ty_size
ty_least_size(const ty_parameters *p, double ratio, size_t members)
{
	ty_size size = {.ratio = drawn_ratio(p, ratio, members)};

	if (p->min_side > 0)
		enlarge(&size, p->min_side, 0);
	return size;
}

ty_size
ty_drawn_size(const ty_parameters *p, double statistic, double area, double ratio, size_t members)
{
	double limit = INFINITY;
	ty_size size = {.area = area, .ratio = drawn_ratio(p, ratio, members)};

	if (p->max_area > 0)
	{
		limit = fmax(statistic, p->max_area);
		size.area = fmax(statistic, fmin(area, p->max_area));
	}
	ty_rectangle_sides(size.area, size.ratio, &size.width, &size.length);
	if (size.width < p->min_side)
		enlarge(&size, p->min_side, limit);
	return size;
}

void
ty_rectangle_sides(double area, double ratio, double *width, double *length)
{
	*width = sqrt(area * ratio);
	*length = sqrt(area / ratio);
}

void
ty_rectangle(ty_point center, double area, double ratio, double ux, double uy, ty_point ring[5])
{
	double width, length;
	ty_point along, across;

	ty_rectangle_sides(area, ratio, &width, &length);
	along = (ty_point){0.5 * length * ux, 0.5 * length * uy};
	across = (ty_point){0.5 * width * -uy, 0.5 * width * ux};
	ring[0] = (ty_point){center.x - along.x - across.x, center.y - along.y - across.y};
	ring[1] = (ty_point){center.x + along.x - across.x, center.y + along.y - across.y};
	ring[2] = (ty_point){center.x + along.x + across.x, center.y + along.y + across.y};
	ring[3] = (ty_point){center.x - along.x + across.x, center.y - along.y + across.y};
	ring[4] = ring[0];
}

double
ty_orientation_degrees(double ux, double uy)
{
	double degrees = atan2(uy, ux) * DEGREES_PER_RADIAN;

	return degrees >= 180 || degrees < 0 ? 0 : degrees;
}

void
ty_direction(double degrees, double *ux, double *uy)
{
	double turned = fmod(degrees, 180);

	if (turned < 0)
		turned += 180;
	*ux = turned == 90 ? 0 : cos(turned * RADIANS_PER_DEGREE);
	*uy = turned == 0 || turned >= 180 ? 0 : sin(turned * RADIANS_PER_DEGREE);
	if (*uy == 0)
		*ux = 1;
}
