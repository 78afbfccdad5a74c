/* legibility_line.c - sites and the lines that they keep away from: see the head of legibility.c. */
#include "legibility_internal.h"

#include <float.h>
#include <math.h>

#include "clearance.h"

#define ASKED \
	12 /* so many of the nearest sites are asked whether a line lies between: who is farther is no neighbour */

/*
 * Lists which segments are in reach, with all that a site may come to: so nothing is searched for in the rounds. Most
 * of the time of barriers with gaps was.
 */
static ty_status
find_lines(ty_ladder *l, uint32_t i, double reach)
{
	double limit = reach + l->line_target;
	ty_status status = ty_barrier_lines_near(l->rules->lines, l->sites[i].home, limit, &l->segments);
	const uint32_t *list;

	if (status != TY_OK)
		return status;
	l->line_limit = limit;
	list = ty_lists_keep_with(&l->lines_of, i, l->segments.number, l->segments.distance, l->segments.count);
	l->line_count = l->segments.count;
	l->line_list = list == NULL ? l->segments.number : list + 1;
	l->line_distance = list == NULL ? l->segments.distance : (const float *) (list + 1 + l->line_count);
	return TY_OK;
}

ty_status
ty_meet_lines(ty_ladder *l, uint32_t i, double reach, double reach_by_line)
{
	ty_status status = TY_OK;

	l->by_line[i] = false;
	if (l->rules->lines == NULL || l->sites[i].fixed)
		return TY_OK;
	status = find_lines(l, i, reach_by_line);
	l->by_line[i] = status == TY_OK && l->line_count > 0 && l->line_distance[0] < reach + l->line_target;
	return status;
}

ty_status
ty_recall_lines(ty_ladder *l, uint32_t i)
{
	const uint32_t *list = ty_lists_get(&l->lines_of, i);

	if (list == NULL)
		return find_lines(l, i, l->near.discs[i].radius);
	l->line_limit = l->near.discs[i].radius + l->line_target;
	l->line_count = list[0] / 2;
	l->line_list = list + 1;
	l->line_distance = (const float *) (list + 1 + l->line_count);
	return TY_OK;
}

/* How many of the segments in reach of the site may come nearer to its home than so far. */
static size_t
lines_within(const ty_ladder *l, double distance)
{
	double limit = distance * (1 + 1e-6) + 1e-6 * l->line_target;
	size_t count = 0;

	while (count < l->line_count && l->line_distance[count] <= limit)
		count++;
	return count;
}

static double
length_of(double dx, double dy)
{
	return sqrt(dx * dx + dy * dy);
}

bool
ty_is_behind_line(const ty_ladder *l, uint32_t i, ty_point place)
{
	const ty_site *s = &l->sites[i];
	ty_point to = {l->origin.x + place.x, l->origin.y + place.y};

	return ty_barrier_segments_cross(l->rules->lines, l->line_list,
									 lines_within(l, length_of(to.x - s->home.x, to.y - s->home.y)), s->home, to);
}

bool
ty_is_across(const ty_ladder *l, uint32_t i)
{
	if (!l->by_line[i] || (l->place[i].moved.x == 0 && l->place[i].moved.y == 0 && !l->body[i].shifted))
		return false;
	return ty_is_behind_line(l, i, (ty_point){l->body[i].box.x, l->body[i].box.y});
}

/* ---- how near a line comes ---- */

/* Whether the segment from a to b is farther than reach from where both are counted from. */
static inline bool
is_beyond(double reach, ty_point a, ty_point b)
{
	double dx = b.x - a.x, dy = b.y - a.y, squared = dx * dx + dy * dy;
	double along = -(a.x * dx + a.y * dy), across = a.x * dy - a.y * dx, limit = reach * reach;

	if (along <= 0)
		return a.x * a.x + a.y * a.y > limit;
	if (along >= squared)
		return b.x * b.x + b.y * b.y > limit;
	return across * across > limit * squared;
}

/*
 * How near a line comes to the box, or limit; *away: in which direction it would have to go. radius: half its diagonal.
 * Segments come from the nearest to home on: what is farther than the nearest so far is not looked at, nor is any other
 * once one is nearer than enough.
 */
static inline double
line_distance(const ty_ladder *l, uint32_t i, const ty_oblong *box, double radius, double limit, double enough,
			  ty_point *away)
{
	const ty_point home = l->sites[i].home;
	ty_point centre = {l->origin.x + box->x, l->origin.y + box->y};
	ty_clearance c = {limit * limit, {0, 0}};
	double distance, reach = (radius + limit) * (1 + 1e-6), from_home = length_of(centre.x - home.x, centre.y - home.y);
	size_t count = lines_within(l, reach + from_home);

	for (size_t k = 0; k < count && c.squared > enough * enough; k++)
	{
		double before = c.squared;
		ty_point a, b;

		ty_segment_ends(l->rules->lines, l->line_list[k], &a, &b);
		a = (ty_point){a.x - centre.x, a.y - centre.y};
		b = (ty_point){b.x - centre.x, b.y - centre.y};
		if (is_beyond(reach, a, b))
			continue;
		ty_look_at_segment(box, ty_into_frame(box, a.x, a.y), ty_into_frame(box, b.x, b.y), &c);
		if (c.squared < before)
		{
			reach = (radius + sqrt(c.squared)) * (1 + 1e-6);
			while (count > k && l->line_distance[count - 1] > (reach + from_home) * (1 + 1e-6) + 1e-6 * l->line_target)
				count--;
		}
	}
	distance = sqrt(c.squared);
	if (!(distance < limit))
		return limit;
	if (distance > 0)
		*away = ty_out_of_frame(box, (ty_point){c.way.x / distance, c.way.y / distance});
	return distance;
}

/* A line meets the box: away from the line that is nearest to its centre, by what it takes at least. */
static double
lack_of_crossed(const ty_ladder *l, uint32_t i, const ty_oblong *box, double radius, ty_point *away)
{
	ty_oblong centre = {box->x, box->y, box->ux, box->uy, 0, 0};

	*away = (ty_point){-box->uy, box->ux};
	return box->half_width + l->line_target - line_distance(l, i, &centre, 0, radius + l->line_target, 0, away);
}

double
ty_box_line_lack(const ty_ladder *l, uint32_t i, const ty_oblong *box, double radius, ty_point *away)
{
	double distance = line_distance(l, i, box, radius, l->line_target, 0, away);

	return distance > 0 ? l->line_target - distance : fmax(lack_of_crossed(l, i, box, radius, away), l->line_target);
}

double
ty_line_lack(const ty_ladder *l, uint32_t i, ty_point *away)
{
	return l->by_line[i] ? ty_box_line_lack(l, i, &l->body[i].box, l->body[i].radius, away) : 0;
}

bool
ty_is_by_line(const ty_ladder *l, uint32_t i)
{
	const double limit = l->line_gap, enough = limit * (1 - DBL_EPSILON);
	ty_point away;

	return l->by_line[i] && line_distance(l, i, &l->body[i].box, l->body[i].radius, limit, enough, &away) < limit;
}

bool
ty_fixed_by_line(const ty_ladder *l, uint32_t i)
{
	const ty_oblong *b = &l->body[i].box;
	ty_point along = {b->half_length * b->ux, b->half_length * b->uy};
	ty_point across = {b->half_width * -b->uy, b->half_width * b->ux};
	ty_point centre = {l->origin.x + b->x, l->origin.y + b->y};
	ty_point corners[4] = {{centre.x - along.x - across.x, centre.y - along.y - across.y},
						   {centre.x + along.x - across.x, centre.y + along.y - across.y},
						   {centre.x + along.x + across.x, centre.y + along.y + across.y},
						   {centre.x - along.x + across.x, centre.y - along.y + across.y}};

	return l->rules->lines != NULL &&
		   ty_barrier_lines_gap(l->rules->lines, corners, 4, l->line_gap).distance < l->line_gap;
}

bool
ty_is_line_conflict(const ty_ladder *l, double lack)
{
	return lack > l->line_target - l->line_gap;
}

bool
ty_may_join(const ty_ladder *l, uint32_t a, uint32_t b)
{
	const ty_site *s = &l->sites[a], *t = &l->sites[b];

	return s->group == t->group &&
		   (l->rules->lines == NULL || !ty_barrier_lines_cross(l->rules->lines, s->home, t->home));
}

/* ---- the nearest neighbour ---- */

static double
squared_distance(const ty_ladder *l, uint32_t a, uint32_t b)
{
	double dx = l->place[a].home.x - l->place[b].home.x, dy = l->place[a].home.y - l->place[b].home.y;

	return dx * dx + dy * dy;
}

/* One who was found, and how far away. */
static bool
is_nearer(ty_neighbour a, ty_neighbour b)
{
	return a.squared < b.squared || (a.squared == b.squared && a.number < b.number);
}

/* Lets the neighbour at k sink to where those below it in the heap are no nearer. */
static void
sink(ty_neighbour *heap, size_t count, size_t k)
{
	ty_neighbour sinking = heap[k];

	for (size_t child = 2 * k + 1; child < count; child = 2 * k + 1)
	{
		child += child + 1 < count && is_nearer(heap[child + 1], heap[child]);
		if (!is_nearer(heap[child], sinking))
			break;
		heap[k] = heap[child];
		k = child;
	}
	heap[k] = sinking;
}

/* Lets the last of the neighbours rise to where the one above it in the heap is nearer. */
static void
rise(ty_neighbour *heap, size_t count)
{
	size_t k = count - 1;
	ty_neighbour rising = heap[k];

	for (; k > 0 && is_nearer(rising, heap[(k - 1) / 2]); k = (k - 1) / 2)
		heap[k] = heap[(k - 1) / 2];
	heap[k] = rising;
}

static ty_neighbour
take_nearest(ty_asking *asking)
{
	ty_neighbour nearest = asking->heap[0];

	asking->heap[0] = asking->heap[--asking->count];
	sink(asking->heap, asking->count, 0);
	return nearest;
}

/* Of those found the ones that are farther than who was asked last become neighbours, the nearest on top of the heap. */
static ty_status
add_neighbours(ty_ladder *l, uint32_t i, const uint32_t *found, size_t count)
{
	ty_asking *asking = &l->asking;

	if (asking->capacity < asking->count + count)
	{
		size_t capacity = 2 * (asking->count + count);
		ty_neighbour *heap = asking->heap == NULL ? ty_allocate_array(l->env, capacity, sizeof *heap)
												  : ty_reallocate_array(l->env, asking->heap, capacity, sizeof *heap);

		if (heap == NULL)
			return TY_NO_MEMORY;
		asking->heap = heap;
		asking->capacity = capacity;
	}
	for (size_t m = 0; m < count; m++)
	{
		ty_neighbour n = {squared_distance(l, i, found[m]), found[m]};

		if (found[m] == i || (asking->asked > 0 && !is_nearer(asking->last, n)))
			continue;
		asking->heap[asking->count++] = n;
		rise(asking->heap, asking->count);
	}
	return TY_OK;
}

/*
 * Whether no line lies between the home of the site, which has been surveyed, and the other's. Only what single precision
 * lets through is looked at exactly.
 */
static bool
is_open(const ty_ladder *l, uint32_t i, ty_neighbour n)
{
	const ty_segment_set *near = &l->around.near;
	const ty_point from = l->sites[i].home, to = l->sites[n.number].home;

	return !ty_is_behind(&l->around, (ty_point){to.x - from.x, to.y - from.y}) &&
		   !ty_barrier_segments_cross(l->rules->lines, near->number, near->count, from, to);
}

static bool
is_surveyed(const ty_ladder *l, uint32_t i)
{
	const ty_point home = l->sites[i].home;

	return l->unmet && l->around.home.x == home.x && l->around.home.y == home.y;
}

/* Whether the two may be joined. The lines in reach are at hand: mostly it is one of these that lies between. */
static bool
is_on_its_side(const ty_ladder *l, uint32_t i, ty_neighbour n)
{
	const ty_point from = l->sites[i].home, to = l->sites[n.number].home;
	bool is_near = n.squared * (1 + 1e-6) < l->line_limit * l->line_limit;

	if (l->sites[i].group != l->sites[n.number].group)
		return false;
	if (is_surveyed(l, i))
		return is_open(l, i, n) && (is_near || ty_may_join(l, i, n.number));
	if (l->by_line[i] && ty_barrier_segments_cross(l->rules->lines, l->line_list, l->line_count, from, to))
		return false;
	return (l->by_line[i] && is_near) || ty_may_join(l, i, n.number);
}

/* Asks the neighbours who are no farther than that, from the nearest on. Whether that is all that will be asked. */
static bool
ask(ty_ladder *l, uint32_t i, double within, uint32_t *nearest, bool *across)
{
	ty_asking *asking = &l->asking;

	while (asking->count > 0 && asking->heap[0].squared <= within * within)
	{
		asking->last = take_nearest(asking);
		*across = !is_on_its_side(l, i, asking->last);
		if (asking->asked++ == 0 || !*across)
			*nearest = asking->last.number;
		if (!*across || asking->asked == ASKED)
			return true;
	}
	return false;
}

/* Looks farther and farther around, for one who stands alone. */
static ty_status
ask_far_away(ty_ladder *l, uint32_t i, uint32_t *nearest, bool *across)
{
	const ty_disc *disc = &l->near.discs[i];
	ty_status status = TY_OK;

	for (double radius = TY_MOST_RINGS * l->homes.side; status == TY_OK; radius *= 2)
	{
		bool all;

		status = ty_vicinity_find(&l->near, i, (ty_point){disc->x, disc->y}, radius);
		all = l->near.found_count + 1 >= l->near.there || !(radius < INFINITY);
		l->asking.count = 0;
		if (status == TY_OK)
			status = add_neighbours(l, i, l->near.found, l->near.found_count);
		if (status == TY_OK && (ask(l, i, all ? INFINITY : radius, nearest, across) || all))
			break;
	}
	return status;
}

/* The nearest that it may be joined to, of the ASKED nearest; if there is none, the very nearest. */
ty_status
ty_nearest_site(ty_ladder *l, uint32_t i, uint32_t *nearest, bool *across)
{
	const ty_disc *disc = &l->near.discs[i];
	ty_point place = {disc->x, disc->y};

	*nearest = TY_NO_SITE;
	*across = true;
	l->asking.count = l->asking.asked = 0;
	for (uint32_t ring = 0; ring < TY_MOST_RINGS; ring++)
	{
		ty_status status = ty_squares_ring(&l->homes, place, ring);

		if (status == TY_OK)
			status = add_neighbours(l, i, l->homes.found, l->homes.found_count);
		if (status != TY_OK || ask(l, i, ty_squares_within(&l->homes, place, ring), nearest, across))
			return status;
	}
	return ask_far_away(l, i, nearest, across);
}
