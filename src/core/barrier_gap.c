/* barrier_gap.c - barriers on the ground: how near they come to a shape, whether one lies between two points. */
#include "barrier.h"

#include <math.h>
#include <string.h>

static double
length(ty_point a, ty_point b)
{
	double dx = b.x - a.x, dy = b.y - a.y;

	return sqrt(dx * dx + dy * dy);
}

/* twice the area of a, b, c: above 0 where they turn left */
static double
turn(ty_point a, ty_point b, ty_point c)
{
	return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/* ---- gap ---- */

typedef struct gap_search
{
	const ty_barrier_lines *lines;
	const ty_point *corners;
	int count;
	ty_point low, high; /* of the corners */
	ty_barrier_gap gap; /* so far */
	ty_box box;			/* of the shape, larger by the distance so far */
} gap_search;

/* the point of the line from a to b that is nearest to p */
static ty_point
nearest_on_line(ty_point a, ty_point b, ty_point p)
{
	double dx = b.x - a.x, dy = b.y - a.y, squared = dx * dx + dy * dy;
	double share = squared > 0 ? ((p.x - a.x) * dx + (p.y - a.y) * dy) / squared : 0;

	if (share <= 0)
		return a;
	if (share >= 1)
		return b;
	return (ty_point){a.x + share * dx, a.y + share * dy};
}

static void
note_gap(gap_search *search, ty_point shape, ty_point line)
{
	double distance = length(shape, line);

	if (distance < search->gap.distance)
		search->gap = (ty_barrier_gap){distance, shape, line};
}

/* whether two lines cross or touch */
static bool
lines_meet(ty_point a, ty_point b, ty_point c, ty_point d)
{
	double at_c = turn(a, b, c), at_d = turn(a, b, d), at_a = turn(c, d, a), at_b = turn(c, d, b);

	return ((at_c > 0) != (at_d > 0) || at_c == 0) && ((at_a > 0) != (at_b > 0) || at_a == 0) &&
		   !(at_c == 0 && at_d == 0);
}

static bool
shape_holds(const gap_search *search, ty_point p)
{
	bool left = false, right = false;

	if (search->count < 3)
		return false;
	for (int i = 0; i < search->count; i++)
	{
		double side = turn(search->corners[i], search->corners[(i + 1) % search->count], p);

		left |= side > 0;
		right |= side < 0;
	}
	return !(left && right);
}

/* the gap to the line from a to b */
static void
look_at_line(gap_search *search, ty_point a, ty_point b)
{
	int sides = search->count < 3 ? 1 : search->count;

	if (shape_holds(search, a))
		search->gap.distance = 0;
	for (int i = 0; i < sides && search->gap.distance > 0; i++)
	{
		ty_point c = search->corners[i], d = search->corners[(i + 1) % search->count];

		if (lines_meet(a, b, c, d))
		{
			search->gap.distance = 0;
			return;
		}
		note_gap(search, c, nearest_on_line(a, b, c));
		note_gap(search, d, nearest_on_line(a, b, d));
		note_gap(search, nearest_on_line(c, d, a), a);
		note_gap(search, nearest_on_line(c, d, b), b);
	}
}

/* what may be nearer than what was found so far */
static void
fit_search_box(gap_search *search)
{
	const ty_point origin = search->lines->origin;
	double limit = search->gap.distance;

	search->box = ty_box_of(search->low.x - limit - origin.x, search->low.y - limit - origin.y,
							search->high.x + limit - origin.x, search->high.y + limit - origin.y);
}

static bool
may_be_nearer(const void *context, const ty_box *box)
{
	return ty_box_meets(&((const gap_search *) context)->box, box);
}

static bool
look_at_run(void *context, size_t thing)
{
	gap_search *search = context;
	const ty_barrier_run *run = &search->lines->runs[thing];
	double before = search->gap.distance;
	ty_point last = ty_run_point(run, 0);

	for (uint32_t i = 1; i < run->points && search->gap.distance > 0; i++)
	{
		ty_point next = ty_run_point(run, i);
		double limit = search->gap.distance;

		if (fmax(last.x, next.x) >= search->low.x - limit && fmin(last.x, next.x) <= search->high.x + limit &&
			fmax(last.y, next.y) >= search->low.y - limit && fmin(last.y, next.y) <= search->high.y + limit)
			look_at_line(search, last, next);
		last = next;
	}
	if (search->gap.distance < before)
		fit_search_box(search);
	return search->gap.distance > 0;
}

ty_barrier_gap
ty_barrier_lines_gap(const ty_barrier_lines *lines, const ty_point *corners, int count, double limit)
{
	gap_search search = {.lines = lines,
						 .corners = corners,
						 .count = count,
						 .low = corners[0],
						 .high = corners[0],
						 .gap.distance = limit};

	for (int i = 1; i < count; i++)
	{
		search.low = (ty_point){fmin(search.low.x, corners[i].x), fmin(search.low.y, corners[i].y)};
		search.high = (ty_point){fmax(search.high.x, corners[i].x), fmax(search.high.y, corners[i].y)};
	}
	fit_search_box(&search);
	ty_boxes_search(&lines->boxes, may_be_nearer, look_at_run, &search);
	return search.gap;
}

/* ---- crossing ---- */

typedef struct path
{
	const ty_barrier_lines *lines;
	ty_point a, b;
	ty_box box;
} path;

static bool
path_may_meet(const void *context, const ty_box *box)
{
	return ty_box_meets(&((const path *) context)->box, box);
}

/* where a, b count as moved: see barrier.h */
static bool
is_left_of_path(const path *p, ty_point end)
{
	double side = turn(p->a, p->b, end);

	if (side != 0)
		return side > 0;
	return p->b.y != p->a.y ? p->b.y > p->a.y : p->b.x < p->a.x;
}

static bool
is_left_of_line(ty_point a, ty_point b, ty_point moved)
{
	double side = turn(a, b, moved);

	if (side != 0)
		return side > 0;
	return b.y != a.y ? b.y < a.y : b.x > a.x;
}

static inline bool
lies_on_path(const path *p, ty_point from, ty_point to)
{
	return is_left_of_path(p, from) != is_left_of_path(p, to) &&
		   is_left_of_line(from, to, p->a) != is_left_of_line(from, to, p->b);
}

static bool
path_passes(void *context, size_t thing)
{
	const path *p = context;
	const ty_barrier_run *run = &p->lines->runs[thing];
	ty_point last = ty_run_point(run, 0);

	for (uint32_t i = 1; i < run->points; i++)
	{
		ty_point next = ty_run_point(run, i);

		if (lies_on_path(p, last, next))
			return false;
		last = next;
	}
	return true;
}

bool
ty_barrier_lines_cross(const ty_barrier_lines *lines, ty_point a, ty_point b)
{
	path p = {.lines = lines, .a = a, .b = b};

	if (a.x == b.x && a.y == b.y)
		return false;
	p.box = ty_box_of(fmin(a.x, b.x) - lines->origin.x, fmin(a.y, b.y) - lines->origin.y,
					  fmax(a.x, b.x) - lines->origin.x, fmax(a.y, b.y) - lines->origin.y);
	return !ty_boxes_search(&lines->boxes, path_may_meet, path_passes, &p);
}

bool
ty_barrier_segments_cross(const ty_barrier_lines *lines, const uint32_t *segment, size_t count, ty_point a, ty_point b)
{
	path p = {.lines = lines, .a = a, .b = b};
	ty_point low = {fmin(a.x, b.x), fmin(a.y, b.y)}, high = {fmax(a.x, b.x), fmax(a.y, b.y)};

	if (a.x == b.x && a.y == b.y)
		return false;
	for (size_t i = 0; i < count; i++)
	{
		ty_point from, to;

		ty_segment_ends(lines, segment[i], &from, &to);
		if ((from.x > high.x && to.x > high.x) || (from.x < low.x && to.x < low.x) ||
			(from.y > high.y && to.y > high.y) || (from.y < low.y && to.y < low.y))
			continue;
		if (lies_on_path(&p, from, to))
			return true;
	}
	return false;
}

/* ---- what is near a place ---- */

#define FIRST_NEAR 64

typedef struct near_search
{
	const ty_barrier_lines *lines;
	ty_point place;
	double limit;
	ty_box box;
	ty_segments *near;
	ty_status status;
} near_search;

static bool
may_be_near(const void *context, const ty_box *box)
{
	return ty_box_meets(&((const near_search *) context)->box, box);
}

/* Twice as much room as before; each array has as much again, for sorting. */
static ty_status
make_room(const ty_environment *env, ty_segments *near)
{
	size_t capacity = near->capacity == 0 ? FIRST_NEAR : 2 * near->capacity;
	uint32_t *numbers = near->capacity == 0 ? ty_allocate_array(env, 2 * capacity, sizeof *numbers)
											: ty_reallocate_array(env, near->number, 2 * capacity, sizeof *numbers);
	float *distances;

	if (numbers == NULL)
		return TY_NO_MEMORY;
	near->number = numbers;
	distances = near->capacity == 0 ? ty_allocate_array(env, 2 * capacity, sizeof *distances)
									: ty_reallocate_array(env, near->distance, 2 * capacity, sizeof *distances);
	if (distances == NULL)
		return TY_NO_MEMORY;
	near->distance = distances;
	near->capacity = capacity;
	return TY_OK;
}

/* The squared distance of p from the line from a to b, but for rounding. */
static inline double
squared_distance(ty_point a, ty_point b, ty_point p)
{
	double dx = b.x - a.x, dy = b.y - a.y, px = p.x - a.x, py = p.y - a.y, squared = dx * dx + dy * dy;
	double along = px * dx + py * dy, across = px * dy - py * dx;

	if (along <= 0)
		return px * px + py * py;
	if (along >= squared)
		return (p.x - b.x) * (p.x - b.x) + (p.y - b.y) * (p.y - b.y);
	return across / squared * across;
}

static bool
list_of_run(void *context, size_t thing)
{
	near_search *search = context;
	const ty_barrier_run *run = &search->lines->runs[thing];
	ty_segments *near = search->near;
	ty_point last = ty_run_point(run, 0);

	if (near->capacity - near->count < TY_RUN_POINTS)
		search->status = make_room(search->lines->env, near);
	for (uint32_t i = 1; i < run->points && search->status == TY_OK; i++)
	{
		ty_point next = ty_run_point(run, i);
		double squared = squared_distance(last, next, search->place);

		if (squared < search->limit * search->limit)
		{
			near->number[near->count] = (uint32_t) thing * (TY_RUN_POINTS - 1) + i - 1;
			near->distance[near->count++] = (float) (sqrt(squared) * (1 - 1e-6));
		}
		last = next;
	}
	return search->status == TY_OK;
}

#define BANDS 32
#define MANY 2048 /* segments; of so many a band may hold too many to be sorted by insertion */

/* Which band of distances, of the same width each. */
static inline uint32_t
band_of(float distance, float bands_per_unit)
{
	float band = distance * bands_per_unit;

	return band < BANDS - 1 ? (uint32_t) band : BANDS - 1;
}

/* Sorts what was listed into the second half of the arrays, band by band ... */
static void
sort_by_band(ty_segments *near, float limit)
{
	uint32_t first[BANDS + 1] = {0};
	float bands_per_unit = limit > 0 && limit < INFINITY ? BANDS / limit : 0;
	uint32_t *number = near->number + near->capacity;
	float *distance = near->distance + near->capacity;

	for (size_t k = 0; k < near->count; k++)
		first[band_of(near->distance[k], bands_per_unit) + 1]++;
	for (int band = 0; band < BANDS; band++)
		first[band + 1] += first[band];
	for (size_t k = 0; k < near->count; k++)
	{
		uint32_t to = first[band_of(near->distance[k], bands_per_unit)]++;

		number[to] = near->number[k];
		distance[to] = near->distance[k];
	}
}

/* ... and from there back, where each goes behind those that are no farther. */
static void
sort_within_bands(ty_segments *near)
{
	const uint32_t *number = near->number + near->capacity;
	const float *distance = near->distance + near->capacity;

	for (size_t i = 0; i < near->count; i++)
	{
		size_t k = i;

		for (; k > 0 && near->distance[k - 1] > distance[i]; k--)
		{
			near->number[k] = near->number[k - 1];
			near->distance[k] = near->distance[k - 1];
		}
		near->number[k] = number[i];
		near->distance[k] = distance[i];
	}
}

/* segments with their distances, as they are listed */
typedef struct listed
{
	uint32_t *number;
	float *distance;
} listed;

/* Merges the sorted runs of a width by twos: of two that are as far the first one stays before the other. */
static void
merge_runs(listed from, listed to, size_t count, size_t width)
{
	for (size_t begin = 0; begin < count; begin += 2 * width)
	{
		size_t middle = begin + width < count ? begin + width : count;
		size_t end = middle + width < count ? middle + width : count, a = begin, b = middle;

		for (size_t k = begin; k < end; k++)
		{
			bool second = a == middle || (b < end && from.distance[b] < from.distance[a]);
			size_t next = second ? b++ : a++;

			to.number[k] = from.number[next];
			to.distance[k] = from.distance[next];
		}
	}
}

/* As by bands, to the same order, however many are about as far as one another. */
static void
sort_many(ty_segments *near)
{
	listed from = {near->number, near->distance};
	listed to = {near->number + near->capacity, near->distance + near->capacity};

	for (size_t width = 1; width < near->count; width *= 2)
	{
		listed merged = to;

		merge_runs(from, to, near->count, width);
		to = from;
		from = merged;
	}
	if (from.number != near->number)
	{
		memcpy(near->number, from.number, near->count * sizeof *from.number);
		memcpy(near->distance, from.distance, near->count * sizeof *from.distance);
	}
}

ty_status
ty_barrier_lines_near(const ty_barrier_lines *lines, ty_point p, double limit, ty_segments *near)
{
	const ty_point origin = lines->origin;
	near_search search = {.lines = lines, .place = p, .limit = limit, .near = near, .status = TY_OK};

	near->count = 0;
	if (lines->count > UINT32_MAX / (TY_RUN_POINTS - 1))
		return TY_TOO_MANY;
	search.box =
		ty_box_of(p.x - limit - origin.x, p.y - limit - origin.y, p.x + limit - origin.x, p.y + limit - origin.y);
	ty_boxes_search(&lines->boxes, may_be_near, list_of_run, &search);
	if (search.status == TY_OK && near->count > MANY)
	{
		sort_many(near);
		return ty_interrupted(lines->env) ? TY_INTERRUPTED : TY_OK;
	}
	if (search.status == TY_OK && near->count > 1)
	{
		sort_by_band(near, (float) limit);
		sort_within_bands(near);
	}
	return search.status;
}
