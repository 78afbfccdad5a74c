/* surroundings.c - see surroundings.h */
#include "surroundings.h"

#include <float.h>
#include <math.h>

#include "clearance.h"

#define AT_ONCE 32
#define CACHE_LINE 64
#define MANY 2048 /* segments: reading them takes long enough to ask whether to go on */
/*
 * The sides of the square are so many times as far from its middle as is wanted there. A wider one serves more places,
 * but has more segments to pick from: from 1.2 to 1.8 takes the same time, 3 takes a tenth more.
 */
#define WIDTH 1.5
#define MOST_USUAL 2	/* times what is usually wanted; a square for more would burden all others */
#define ROUNDING 1e-5	/* units: what single precision may do to a distance */
#define LONG 16			/* square of the length, in units, above which a segment is cut off ... */
#define BESIDE_MIDDLE 2 /* ... so far from where it is nearest to the middle: no corner is as far */

/*
 * Segments are looked at four at a time, so that no few are left over: behind the last stand up to three that are far
 * away and have no length.
 */
#define AT_A_TIME 4
#define FAR 1e15f

static inline size_t
with_far_ones(const ty_segment_set *set)
{
	return (set->count + AT_A_TIME - 1) & ~(size_t) (AT_A_TIME - 1);
}

static void
add_far_ones(ty_segment_set *set)
{
	for (size_t k = set->count; k < with_far_ones(set); k++)
	{
		set->x[k] = set->y[k] = FAR;
		set->dx[k] = set->dy[k] = set->inverse[k] = 0;
	}
}

void
ty_surroundings_begin(const ty_barrier_lines *lines, double usual, ty_surroundings *s)
{
	*s = (ty_surroundings){.lines = lines, .usual = usual};
}

void
ty_surroundings_free(ty_surroundings *s)
{
	if (s->lines != NULL)
	{
		ty_release(s->lines->env, s->square.x);
		ty_release(s->lines->env, s->near.x);
	}
	*s = (ty_surroundings){.lines = NULL};
}

/* Room for so many segments, of which those that are there stay. */
static ty_status
make_room(const ty_environment *env, size_t capacity, ty_segment_set *set)
{
	ty_segment_set larger = {.count = set->count, .capacity = capacity};
	size_t size = set->count * sizeof *set->x;

	larger.x = ty_allocate_array(env, 7 * capacity, sizeof *larger.x);
	if (larger.x == NULL)
		return TY_NO_MEMORY;
	larger.y = larger.x + capacity;
	larger.dx = larger.y + capacity;
	larger.dy = larger.dx + capacity;
	larger.inverse = larger.dy + capacity;
	larger.squared = larger.inverse + capacity;
	larger.number = (uint32_t *) (larger.squared + capacity);
	if (set->count > 0)
	{
		memcpy(larger.x, set->x, size);
		memcpy(larger.y, set->y, size);
		memcpy(larger.dx, set->dx, size);
		memcpy(larger.dy, set->dy, size);
		memcpy(larger.inverse, set->inverse, size);
		memcpy(larger.number, set->number, size);
	}
	ty_release(env, set->x);
	*set = larger;
	return TY_OK;
}

/* ---- the square ---- */

typedef struct square_search
{
	ty_surroundings *s;
	ty_box box;
	double scale;			 /* units in a unit of the ground */
	uint32_t found[AT_ONCE]; /* runs whose segments are still to be added */
	int found_count;
	ty_status status;
} square_search;

static bool
may_meet_square(const void *context, const ty_box *box)
{
	return ty_box_meets(&((const square_search *) context)->box, box);
}

/* Of a long segment only what is near the square is left: single precision would bend the rest. */
static void
cut_off(ty_point *a, ty_point *b)
{
	double dx = b->x - a->x, dy = b->y - a->y, squared = dx * dx + dy * dy;
	double along = -(a->x * dx + a->y * dy) / squared, beside = BESIDE_MIDDLE / sqrt(squared);
	double from = fmax(0, along - beside), to = fmin(1, along + beside);
	ty_point start = *a;

	*a = (ty_point){start.x + from * dx, start.y + from * dy};
	*b = (ty_point){start.x + to * dx, start.y + to * dy};
}

/* Nothing of a segment lies in the square whose ends are beyond the same side. */
static inline bool
may_lie_in_square(ty_point a, ty_point b)
{
	return !(((a.x > 1) & (b.x > 1)) | ((a.x < -1) & (b.x < -1)) | ((a.y > 1) & (b.y > 1)) | ((a.y < -1) & (b.y < -1)));
}

static inline ty_point
in_units(const square_search *search, ty_point p)
{
	const ty_point middle = search->s->middle;

	return (ty_point){(p.x - middle.x) * search->scale, (p.y - middle.y) * search->scale};
}

/* Every other segment lies in the square: each is written down, and stays if the next one does not take its place. */
static void
add_run(square_search *search, uint32_t number)
{
	const ty_barrier_run *run = &search->s->lines->runs[number];
	ty_segment_set *set = &search->s->square;
	ty_point last = in_units(search, ty_run_point(run, 0));
	size_t count = set->count;

	for (uint32_t i = 1; i < run->points; i++)
	{
		ty_point a = last, b = in_units(search, ty_run_point(run, i));
		double dx = b.x - a.x, dy = b.y - a.y;

		last = b;
		if (dx * dx + dy * dy > LONG)
			cut_off(&a, &b);
		set->x[count] = (float) a.x;
		set->y[count] = (float) a.y;
		set->dx[count] = (float) (b.x - a.x);
		set->dy[count] = (float) (b.y - a.y);
		set->number[count] = number * (TY_RUN_POINTS - 1) + i - 1;
		count += may_lie_in_square(a, b);
	}
	set->count = count;
}

/* The points of all runs that have been found are called for before the first is needed. */
static void
add_found(square_search *search)
{
	ty_segment_set *set = &search->s->square;

	for (int k = 0; k < search->found_count; k++)
	{
		const ty_barrier_run *run = &search->s->lines->runs[search->found[k]];

		for (size_t byte = 0; byte < (size_t) run->points * run->stride; byte += CACHE_LINE)
			__builtin_prefetch(run->xy + byte);
	}
	if (set->capacity - set->count < AT_ONCE * TY_RUN_POINTS + AT_A_TIME)
		search->status =
			make_room(search->s->lines->env, 2 * (set->capacity + AT_ONCE * TY_RUN_POINTS + AT_A_TIME), set);
	for (int k = 0; k < search->found_count && search->status == TY_OK; k++)
		add_run(search, search->found[k]);
	search->found_count = 0;
}

static bool
find_run(void *context, size_t thing)
{
	square_search *search = context;

	__builtin_prefetch(&search->s->lines->runs[thing]);
	search->found[search->found_count++] = (uint32_t) thing;
	if (search->found_count == AT_ONCE)
		add_found(search);
	return search->status == TY_OK;
}

/* One without length has a factor, too, but of 0. */
static void
invert_lengths(ty_segment_set *set)
{
	const float *restrict dx = set->dx, *restrict dy = set->dy;
	float *restrict inverse = set->inverse;
	size_t count = with_far_ones(set);

	for (size_t k = 0; k < count; k++)
		inverse[k] = 1 / (dx[k] * dx[k] + dy[k] * dy[k] + FLT_MIN);
}

/* The segments of the square around a place, with sides that are half_side away from it. */
static ty_status
fill_square(ty_surroundings *s, ty_point middle, double half_side)
{
	const ty_point from = s->lines->origin;
	square_search search = {.s = s, .scale = 1 / half_side, .status = TY_OK};

	if (s->lines->count > UINT32_MAX / (TY_RUN_POINTS - 1))
		return TY_TOO_MANY;
	s->unit = half_side;
	s->middle = middle;
	s->square.count = 0;
	search.box = ty_box_of(middle.x - half_side - from.x, middle.y - half_side - from.y, middle.x + half_side - from.x,
						   middle.y + half_side - from.y);
	if (ty_boxes_search(&s->lines->boxes, may_meet_square, find_run, &search))
		add_found(&search);
	add_far_ones(&s->square);
	invert_lengths(&s->square);
	if (search.status == TY_OK && s->square.count > MANY && ty_interrupted(s->lines->env))
		search.status = TY_INTERRUPTED;
	return search.status;
}

/* Whether all that is nearer to the place than limit lies in the square. */
static inline bool
is_in_square(const ty_surroundings *s, ty_point place, double limit)
{
	return fabs(place.x - s->middle.x) + limit <= s->unit && fabs(place.y - s->middle.y) + limit <= s->unit;
}

/* ---- around a place ---- */

/*
 * The squared distance of every segment from (x, y). What a loop reads and writes is told apart, and there is no branch
 * in it: so four segments are looked at at once.
 */
static void
measure_all(const ty_segment_set *set, float x, float y)
{
	const float *restrict at_x = set->x, *restrict at_y = set->y, *restrict dx = set->dx, *restrict dy = set->dy;
	const float *restrict inverse = set->inverse;
	float *restrict squared = set->squared;
	size_t count = with_far_ones(set);

	for (size_t k = 0; k < count; k++)
	{
		float from_x = at_x[k] - x, from_y = at_y[k] - y;
		float share = -(from_x * dx[k] + from_y * dy[k]) * inverse[k];
		float within = 0.5f * (fabsf(share) - fabsf(share - 1) + 1); /* between 0 and 1, but for rounding */
		float way_x = from_x + within * dx[k], way_y = from_y + within * dy[k];

		squared[k] = way_x * way_x + way_y * way_y;
	}
}

/* the vector from the place to the nearest point of a segment */
static ty_point
way_to_segment(const ty_segment_set *set, size_t k, ty_point place)
{
	double from_x = set->x[k] - place.x, from_y = set->y[k] - place.y, dx = set->dx[k], dy = set->dy[k];
	double share = fmin(fmax(-(from_x * dx + from_y * dy) * set->inverse[k], 0), 1);

	return (ty_point){from_x + share * dx, from_y + share * dy};
}

/* Lists which of so many are nearer than limit; how many there are. picked has room for one more. */
static size_t
list_within(const float *restrict squared, size_t all, float limit, uint32_t *restrict picked)
{
	size_t count = 0;

	for (size_t k = 0; k < all; k++)
	{
		picked[count] = (uint32_t) k;
		count += squared[k] < limit * limit;
	}
	return count;
}

/* Picks from the square what comes as near to home, which is at (x, y) there. */
static void
pick(ty_surroundings *s, float x, float y, float limit)
{
	const ty_segment_set *from = &s->square;
	ty_segment_set *to = &s->near;

	measure_all(from, x, y);
	to->count = list_within(from->squared, from->count, limit, to->number);
	for (size_t m = 0; m < to->count; m++)
	{
		size_t k = to->number[m];

		to->x[m] = from->x[k] - x;
		to->y[m] = from->y[k] - y;
		to->dx[m] = from->dx[k];
		to->dy[m] = from->dy[k];
		to->inverse[m] = from->inverse[k];
		to->number[m] = from->number[k];
	}
	add_far_ones(to);
}

ty_status
ty_survey(ty_surroundings *s, ty_point home, double limit)
{
	bool usual = limit <= MOST_USUAL * s->usual;
	ty_status status = TY_OK;

	s->near.count = 0;
	s->home = home;
	if (!usual || !is_in_square(s, home, limit))
		status = fill_square(s, home, usual ? WIDTH * limit : limit);
	if (status == TY_OK && s->near.capacity < s->square.count + AT_A_TIME)
		status = make_room(s->lines->env, s->square.capacity + AT_A_TIME, &s->near);
	if (status == TY_OK)
		pick(s, (float) ((home.x - s->middle.x) / s->unit), (float) ((home.y - s->middle.y) / s->unit),
			 (float) (limit / s->unit + ROUNDING));
	if (status != TY_OK || !usual)
		s->middle = (ty_point){INFINITY, INFINITY}; /* serves nobody else */
	return status;
}

/* The nearest of those that are measured; count: there is none. */
static size_t
nearest_of(const ty_segment_set *set)
{
	const float *squared = set->squared;
	float least[AT_A_TIME] = {INFINITY, INFINITY, INFINITY, INFINITY};
	size_t count = with_far_ones(set), nearest = 0;

	if (set->count == 0)
		return 0;
	for (size_t k = 0; k < count; k += AT_A_TIME)
		for (int m = 0; m < AT_A_TIME; m++)
		{
			float one = squared[k + m], other = least[m];

			least[m] = one < other ? one : other;
		}
	for (int m = 1; m < AT_A_TIME; m++)
		least[0] = least[m] < least[0] ? least[m] : least[0];
	while (squared[nearest] != least[0])
		nearest++;
	return nearest;
}

double
ty_nearest_segment(ty_surroundings *s, ty_point place, ty_point *away)
{
	ty_point at = {place.x / s->unit, place.y / s->unit}, way;
	double distance;
	size_t nearest;

	measure_all(&s->near, (float) at.x, (float) at.y);
	nearest = nearest_of(&s->near);
	if (nearest == s->near.count)
		return INFINITY;
	way = way_to_segment(&s->near, nearest, at);
	distance = sqrt(way.x * way.x + way.y * way.y);
	if (distance > 0)
		*away = (ty_point){-way.x / distance, -way.y / distance};
	return distance * s->unit;
}

double
ty_lack_beside_segments(ty_surroundings *s, const ty_oblong *box, double radius, double gap, ty_point *away)
{
	const ty_segment_set *near = &s->near;
	ty_point middle_away = {-box->uy, box->ux};
	double to_middle = ty_nearest_segment(s, (ty_point){box->x, box->y}, &middle_away), distance;
	double reach = (radius + gap) / s->unit + ROUNDING;
	ty_clearance c = {gap * gap, {0, 0}};

	for (size_t k = 0; to_middle < radius + gap && k < near->count && c.squared > 0; k++)
	{
		ty_point a, b;

		if (near->squared[k] > reach * reach)
			continue;
		a = (ty_point){near->x[k] * s->unit - box->x, near->y[k] * s->unit - box->y};
		b = (ty_point){near->dx[k] * s->unit + a.x, near->dy[k] * s->unit + a.y};
		ty_look_at_segment(box, ty_into_frame(box, a.x, a.y), ty_into_frame(box, b.x, b.y), &c);
	}
	distance = sqrt(c.squared);
	if (!(distance > 0))
	{
		*away = middle_away;
		return fmax(box->half_width + gap - to_middle, gap);
	}
	if (distance < gap)
		*away = ty_out_of_frame(box, (ty_point){c.way.x / distance, c.way.y / distance});
	return fmax(gap - distance, 0);
}

bool
ty_is_behind(const ty_surroundings *s, ty_point place)
{
	const float *at_x = s->near.x, *at_y = s->near.y, *dx = s->near.dx, *dy = s->near.dy;
	float x = (float) (place.x / s->unit), y = (float) (place.y / s->unit);
	size_t count = with_far_ones(&s->near);
	int crossed = 0;

	for (size_t k = 0; k < count; k++)
	{
		float home_side = at_y[k] * dx[k] - at_x[k] * dy[k];
		float way = x * dy[k] - y * dx[k], from = x * at_y[k] - y * at_x[k];
		/* both below 0 where the ends of each are on different sides of the other */
		float sides = home_side * (home_side + way), ends = from * (from + way), larger = sides > ends ? sides : ends;

		crossed |= larger < 0 ? 1 : 0;
	}
	return crossed != 0;
}
