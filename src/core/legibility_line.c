/* legibility_line.c - sites and the lines that they keep away from: see the head of legibility.c. */
#include "legibility_internal.h"

#include <math.h>

#define ASKED \
	32 /* so many of the nearest sites are asked whether a line lies between: who is farther is no neighbour */

ty_status
ty_list_lines(ty_ladder *l, uint32_t i, double limit)
{
	ty_status status = ty_barrier_lines_near(l->rules->lines, l->sites[i].home, limit, &l->segments);

	l->line_count = l->segments.count;
	l->line_list = l->segments.number;
	l->line_distance = l->segments.distance;
	l->line_limit = limit;
	return status;
}

/*
 * Lists which segments are in reach, with all that a site may come to: so nothing is searched for in the rounds. Most
 * of the time of barriers with gaps was.
 */
static ty_status
find_lines(ty_ladder *l, uint32_t i, double reach)
{
	ty_status status = ty_list_lines(l, i, reach + l->line_target);
	const uint32_t *list;

	if (status != TY_OK)
		return status;
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
	const ty_site *s = &l->sites[i];

	if (!l->by_line[i] || (s->moved.x == 0 && s->moved.y == 0 && s->shift.x == 0 && s->shift.y == 0))
		return false;
	return ty_is_behind_line(l, i, (ty_point){l->body[i].box.x, l->body[i].box.y});
}

/* ---- how near a line comes ---- */

/* the nearest line so far, in the frame of a rectangle: the squared distance, and the way from the line */
typedef struct clearance
{
	double squared;
	ty_point way;
} clearance;

static ty_point
into_frame(const ty_oblong *box, double dx, double dy)
{
	return (ty_point){dx * box->ux + dy * box->uy, dy * box->ux - dx * box->uy};
}

static inline double
limited(double x, double half)
{
	double above = x > half ? half : x;

	return above < -half ? -half : above;
}

static inline void
note_way(clearance *c, double dx, double dy)
{
	double squared = dx * dx + dy * dy;

	if (squared < c->squared)
		*c = (clearance){squared, {dx, dy}};
}

/*
 * The segment from p to q beside the rectangle around the origin. Unless they meet, the nearest points are an end of the
 * segment or, of the rectangle, the corner that reaches farthest towards the line.
 */
static void
look_at_segment(const ty_oblong *box, ty_point p, ty_point q, clearance *c)
{
	double dx = q.x - p.x, dy = q.y - p.y, turn = p.x * dy - p.y * dx;
	double reach = box->half_length * fabs(dy) + box->half_width * fabs(dx);
	ty_point corner = {(dy > 0) == (turn > 0) ? box->half_length : -box->half_length,
					   (dx > 0) == (turn > 0) ? -box->half_width : box->half_width};
	double along = (corner.x - p.x) * dx + (corner.y - p.y) * dy, squared = dx * dx + dy * dy;

	if (fabs(turn) <= reach && fmin(p.x, q.x) <= box->half_length && fmax(p.x, q.x) >= -box->half_length &&
		fmin(p.y, q.y) <= box->half_width && fmax(p.y, q.y) >= -box->half_width)
	{
		*c = (clearance){0, {0, 0}};
		return;
	}
	note_way(c, limited(p.x, box->half_length) - p.x, limited(p.y, box->half_width) - p.y);
	note_way(c, limited(q.x, box->half_length) - q.x, limited(q.y, box->half_width) - q.y);
	if (along > 0 && along < squared)
		note_way(c, corner.x - (p.x + along / squared * dx), corner.y - (p.y + along / squared * dy));
}

/* Whether the segment from a to b is farther than reach from the place, as far as boxes tell. */
static inline bool
surely_beyond(ty_point place, double reach, ty_point a, ty_point b)
{
	return (a.x > place.x + reach && b.x > place.x + reach) || (a.x < place.x - reach && b.x < place.x - reach) ||
		   (a.y > place.y + reach && b.y > place.y + reach) || (a.y < place.y - reach && b.y < place.y - reach);
}

/*
 * How near a line comes to the box, or limit; *away: in which direction it would have to go. radius: half its diagonal.
 * Segments come from the nearest to home on: what is farther than the nearest so far is not looked at.
 */
static double
line_distance(const ty_ladder *l, uint32_t i, const ty_oblong *box, double radius, double limit, ty_point *away)
{
	const ty_point home = l->sites[i].home;
	ty_point centre = {l->origin.x + box->x, l->origin.y + box->y};
	clearance c = {limit * limit, {0, 0}};
	double distance, reach = (radius + limit) * (1 + 1e-6), from_home = length_of(centre.x - home.x, centre.y - home.y);
	size_t count = lines_within(l, reach + from_home);

	for (size_t k = 0; k < count && c.squared > 0; k++)
	{
		double before = c.squared;
		ty_point a, b;

		ty_segment_ends(l->rules->lines, l->line_list[k], &a, &b);
		if (surely_beyond(centre, reach, a, b))
			continue;
		look_at_segment(box, into_frame(box, a.x - centre.x, a.y - centre.y),
						into_frame(box, b.x - centre.x, b.y - centre.y), &c);
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
		*away = (ty_point){(c.way.x * box->ux - c.way.y * box->uy) / distance,
						   (c.way.x * box->uy + c.way.y * box->ux) / distance};
	return distance;
}

/* A line meets the box: away from the line that is nearest to its centre, by what it takes at least. */
static double
lack_of_crossed(const ty_ladder *l, uint32_t i, const ty_oblong *box, double radius, ty_point *away)
{
	ty_oblong centre = {box->x, box->y, box->ux, box->uy, 0, 0};

	*away = (ty_point){-box->uy, box->ux};
	return box->half_width + l->line_target - line_distance(l, i, &centre, 0, radius + l->line_target, away);
}

double
ty_box_line_lack(const ty_ladder *l, uint32_t i, const ty_oblong *box, double radius, ty_point *away)
{
	double distance = line_distance(l, i, box, radius, l->line_target, away);

	return distance > 0 ? l->line_target - distance : fmax(lack_of_crossed(l, i, box, radius, away), l->line_target);
}

double
ty_line_lack(const ty_ladder *l, uint32_t i, ty_point *away)
{
	return l->by_line[i] ? ty_box_line_lack(l, i, &l->body[i].box, l->body[i].radius, away) : 0;
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
	double dx = l->sites[a].home.x - l->sites[b].home.x, dy = l->sites[a].home.y - l->sites[b].home.y;

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

/* Those found that are farther than `after`, as a heap with the nearest on top. */
static ty_status
gather_neighbours(ty_ladder *l, uint32_t i, ty_neighbour after, size_t *count)
{
	if (l->neighbour_capacity < l->near.found_count)
	{
		ty_release(l->env, l->neighbours);
		l->neighbour_capacity = 0;
		l->neighbours = ty_allocate_array(l->env, l->near.found_capacity, sizeof *l->neighbours);
		if (l->neighbours == NULL)
			return TY_NO_MEMORY;
		l->neighbour_capacity = l->near.found_capacity;
	}
	*count = 0;
	for (size_t m = 0; m < l->near.found_count; m++)
	{
		ty_neighbour n = {squared_distance(l, i, l->near.found[m]), l->near.found[m]};

		if (after.number == TY_NO_SITE || is_nearer(after, n))
			l->neighbours[(*count)++] = n;
	}
	for (size_t k = *count / 2; k-- > 0;)
		sink(l->neighbours, *count, k);
	return TY_OK;
}

/* Whether the two may be joined. The lines in reach are at hand: mostly it is one of these that lies between. */
static bool
is_on_its_side(const ty_ladder *l, uint32_t i, ty_neighbour n)
{
	const ty_point from = l->sites[i].home, to = l->sites[n.number].home;

	if (l->sites[i].group != l->sites[n.number].group)
		return false;
	if (l->by_line[i] && ty_barrier_segments_cross(l->rules->lines, l->line_list, l->line_count, from, to))
		return false;
	if (l->by_line[i] && n.squared * (1 + 1e-6) < l->line_limit * l->line_limit)
		return true;
	return ty_may_join(l, i, n.number);
}

/* The nearest that it may be joined to, of the ASKED nearest; if there is none, the very nearest. */
ty_status
ty_nearest_site(ty_ladder *l, uint32_t i, uint32_t *nearest, bool *across)
{
	const ty_disc *disc = &l->near.discs[i];
	double radius = disc->radius;
	ty_neighbour last = {0, TY_NO_SITE};
	int asked = 0;

	*nearest = TY_NO_SITE;
	*across = true;
	for (bool all = false; !all; radius *= 2)
	{
		ty_status status = ty_vicinity_find(&l->near, i, (ty_point){disc->x, disc->y}, radius);
		size_t count;

		if (status == TY_OK)
			status = gather_neighbours(l, i, last, &count);
		if (status != TY_OK)
			return status;
		all = l->near.found_count + 1 >= l->near.there || !(radius < INFINITY);
		/* who is farther than the radius may not be the next one */
		while (count > 0 && (all || l->neighbours[0].squared <= radius * radius))
		{
			last = l->neighbours[0];
			l->neighbours[0] = l->neighbours[--count];
			sink(l->neighbours, count, 0);
			*nearest = *nearest == TY_NO_SITE ? last.number : *nearest;
			*across = !is_on_its_side(l, i, last);
			if (!*across)
				*nearest = last.number;
			if (!*across || ++asked == ASKED)
				return TY_OK;
		}
	}
	return TY_OK;
}
