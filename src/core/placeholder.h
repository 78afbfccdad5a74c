/*
 * placeholder.h - how many placeholders, how large, which rectangle (spec 2.1 and 3).
 */
#ifndef TY_PLACEHOLDER_H
#define TY_PLACEHOLDER_H

#include "environment.h"
#include "measure.h"

#include <math.h>

typedef enum ty_count_rule
{
	TY_RADICAL = 0, /* radical law with exponent (Toepfer and Pillewizer 1966) */
	TY_BLACK_WHITE	/* keeps the black-white ratio (paper) */
} ty_count_rule;

typedef enum ty_area_statistic
{
	TY_MEAN = 0,
	TY_MEDIAN,
	TY_SUM /* the members' plain sum, without the area factor */
} ty_area_statistic;

typedef enum ty_shape
{
	TY_RECTANGLE = 0, /* ratio and direction of the representative */
	TY_SQUARE,
	TY_FOOTPRINT, /* the representative's own outline */
	TY_AUTO		  /* its outline where it is kept or large, else a rectangle */
} ty_shape;

/* Tells barriers apart, whose lines are part of the input (ty_input); both 0: none. */
typedef struct ty_barrier_hash
{
	uint64_t low, high;
} ty_barrier_hash;

/* Every value resolved: defaults applied, checks done by the caller. */
typedef struct ty_parameters
{
	double scale;		 /* m_r, denominator, >= source_scale */
	double s_u;			 /* 0 .. 1 */
	double source_scale; /* m25 > 0 */
	double lod200_scale; /* m200 > source_scale */
	double exponent;	 /* x >= 0 */
	double psi;			 /* <= 1 */
	double min_distance; /* ground units, 0: unset */
	int64_t count;		 /* 0: unset */
	bool law;			 /* the law's count must be reached; false when min_distance alone says when to stop */
	ty_count_rule count_rule;
	ty_area_statistic area_statistic;
	ty_shape shape;
	double min_area;  /* square ground units, 0: off; a smaller building is a shed */
	double alignment; /* how much longer an edge counts that leaves a row of buildings; 0: rows are not looked for */
	/* legibility, 0: off. Millimetres on the map as options say them, ground units after ty_bring_to_ground. */
	double min_side;	  /* shortest side that is drawn */
	double max_area;	  /* nothing is enlarged beyond it */
	double min_gap;		  /* between placeholders */
	double keep_area;	  /* buildings of this true area are kept */
	double barrier_width; /* of the symbol of the barriers */
	ty_barrier_hash barriers;
} ty_parameters;

/* Whether a building is kept (spec 2.5 and 4.3), for itself or for its size. p: in ground units. */
static inline bool
ty_is_kept(const ty_parameters *p, double area, double importance)
{
	return importance == INFINITY || (p->keep_area > 0 && area >= p->keep_area);
}

/* whether buildings' outlines are needed */
static inline bool
ty_wants_outline(const ty_parameters *p)
{
	return p->shape == TY_FOOTPRINT || p->shape == TY_AUTO;
}

#define TY_DEFAULT_SOURCE_SCALE 25000.0
#define TY_DEFAULT_LOD200_SCALE 200000.0
#define TY_DEFAULT_EXPONENT 2.0 /* repeats the paper's figures: 41 buildings give 20, 13, 10, 5 */
#define TY_DEFAULT_PSI 0.75		/* smallest legible square at 1:200 000 for a mean building of 300 m2 (spec 3.2) */

/* What is drawn for a vertex, ground units. All 0 where there is no size. */
typedef struct ty_size
{
	double area, ratio, width, length; /* ratio: width / length, in (0, 1]; 1 where there is no size */
} ty_size;

#define TY_DEFAULT_MAX_AREA_SIDES 2.0 /* max_area in squares of min_side, where that one is set (spec 4.2) */

/* Turns the lengths and areas of legibility into ground units, whose unit has so many metres. Once. */
void ty_bring_to_ground(ty_parameters *p, double metres_per_unit);

/* A_n of spec 3.2 for the unscaled statistic of the members' areas; area_factor: ty_area_factor(p) */
double ty_scaled_area(const ty_parameters *p, double area_factor, double statistic);
/*
 * The size that is drawn (spec 3.2, 4.1, 4.2). statistic: of the members' areas, unscaled; area: A_n, or what is
 * drawn instead; ratio: of the representative, 1 for squares; members: how many. Without min_side and max_area it is
 * a rectangle of that area and ratio.
 */
ty_size ty_drawn_size(const ty_parameters *p, double statistic, double area, double ratio, size_t members);
/* The smallest that is still legible: no side shorter than min_side. All 0 without min_side. */
ty_size ty_least_size(const ty_parameters *p, double ratio, size_t members);

/* f_area (paper, section on size): ground units; 1 at the source scale */
double ty_area_factor(const ty_parameters *p);
/* psi = 1 - (m25^2 / m200^2) * mean_area_lod200 / mean_placeholder_area */
double ty_psi(double mean_placeholder_area, double mean_area_lod200, double source_scale, double lod200_scale);
/*
 * How many of n buildings remain at p->scale by the law or p->count: at least 1 (0 for n = 0), at most n.
 * mean_area: of the group's buildings, for the black-white rule; n stays where it is 0.
 */
size_t ty_count(size_t n, const ty_parameters *p, double mean_area);

/*
 * The smallest scale of at least p->source_scale at which ty_count of n buildings is below count: found by the law's
 * inverse, then among the doubles next to it. INFINITY: there is none, as for a count of 1. For the radical law,
 * without p->count; p->scale is not looked at.
 */
double ty_scale_below(size_t n, size_t count, const ty_parameters *p);

/* Ring, counter-clockwise and closed. ratio = width / length in (0, 1]; ux, uy: unit vector along the length. */
void ty_rectangle(ty_point center, double area, double ratio, double ux, double uy, ty_point ring[5]);
/* the two sides; NaN-free for area >= 0 and ratio in (0, 1] */
void ty_rectangle_sides(double area, double ratio, double *width, double *length);
/* degrees in [0, 180), counter-clockwise from the x axis; by atan2, the one value exempt from spec 2.4 */
double ty_orientation_degrees(double ux, double uy);
/* unit vector of degrees, normalised to direction in [0, 180) */
void ty_direction(double degrees, double *ux, double *uy);

#endif
