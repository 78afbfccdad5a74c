/* legibility_line.c - sites and the lines that they keep away from: see the head of legibility.c. */
#include "legibility_internal.h"

#include <math.h>

#define ASKED \
	32 /* so many of the nearest sites are asked whether a line lies between: who is farther is no neighbour */

/*
 * Lists which segments are in reach, with all that a site may come to: so nothing is searched for in the rounds. Most
 * of the time of barriers with gaps was.
 */
static ty_status
find_lines(ty_ladder *l, uint32_t i, double reach)
{
	ty_status status = ty_barrier_lines_near(l->rules->lines, l->sites[i].home, reach + l->line_target, &l->segments);
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
ty_is_across(const ty_ladder *l, uint32_t i)
{
	const ty_site *s = &l->sites[i];
	ty_point centre = {l->origin.x + l->body[i].box.x, l->origin.y + l->body[i].box.y};

	if (!l->by_line[i] || (l->place[i].moved.x == 0 && l->place[i].moved.y == 0 && !l->body[i].shifted))
		return false;
	return ty_barrier_segments_cross(l->rules->lines, l->line_list,
									 lines_within(l, length_of(centre.x - s->home.x, centre.y - s->home.y)), s->home,
									 centre);
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

/* How near a line comes to the box, or limit; *away: in which direction it would have to go. radius: half its diagonal. */
static double
line_distance(const ty_ladder *l, uint32_t i, const ty_oblong *box, double radius, double limit, ty_point *away)
{
	const ty_point home = l->sites[i].home;
	ty_point centre = {l->origin.x + box->x, l->origin.y + box->y};
	clearance c = {limit * limit, {0, 0}};
	double distance, reach = (radius + limit) * (1 + 1e-6);
	size_t count = lines_within(l, reach + length_of(centre.x - home.x, centre.y - home.y));

	for (size_t k = 0; k < count && c.squared > 0; k++)
	{
		ty_point a, b;

		ty_segment_ends(l->rules->lines, l->line_list[k], &a, &b);
		if (!surely_beyond(centre, reach, a, b))
			look_at_segment(box, into_frame(box, a.x - centre.x, a.y - centre.y),
							into_frame(box, b.x - centre.x, b.y - centre.y), &c);
	}
	distance = sqrt(c.squared);
	if (!(distance < limit))
		return limit;
	if (distance > 0)
		*away = (ty_point){(c.way.x * box->ux - c.way.y * box->uy) / distance,
						   (c.way.x * box->uy + c.way.y * box->ux) / distance};
	return distance;
}

/* A line meets the site: away from the line that is nearest to its centre. */
static double
lack_of_crossed(const ty_ladder *l, uint32_t i, ty_point *away)
{
	const ty_oblong *box = &l->body[i].box;
	ty_oblong centre = {box->x, box->y, box->ux, box->uy, 0, 0};

	*away = (ty_point){-box->uy, box->ux};
	return ty_extent(box, *away) + l->line_target -
		   line_distance(l, i, &centre, 0, l->body[i].radius + l->line_target, away);
}

double
ty_line_lack(const ty_ladder *l, uint32_t i, ty_point *away)
{
	double distance;

	if (!l->by_line[i])
		return 0;
	distance = line_distance(l, i, &l->body[i].box, l->body[i].radius, l->line_target, away);
	if (distance > 0)
		return l->line_target - distance;
	return fmax(lack_of_crossed(l, i, away), l->line_target);
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

/* The nearest of those found that is farther than `beyond`, or as far with a greater number; TY_NO_SITE: none. */
static uint32_t
next_nearest(const ty_ladder *l, uint32_t i, double beyond, uint32_t after)
{
	uint32_t best = TY_NO_SITE;
	double least = INFINITY;

	for (size_t m = 0; m < l->near.found_count; m++)
	{
		uint32_t j = l->near.found[m];
		double d = squared_distance(l, i, j);

		if (d < beyond || (d == beyond && after != TY_NO_SITE && j <= after))
			continue;
		if (d < least || (d == least && j < best))
		{
			least = d;
			best = j;
		}
	}
	return best;
}

/* Whether one of the lines in reach lies between: mostly it is one of these, and they are at hand. */
static bool
is_behind_near_line(const ty_ladder *l, uint32_t i, uint32_t j)
{
	return l->by_line[i] &&
		   ty_barrier_segments_cross(l->rules->lines, l->line_list, l->line_count, l->sites[i].home, l->sites[j].home);
}

/* The nearest that it may be joined to, of the ASKED nearest; if there is none, the very nearest. */
ty_status
ty_nearest_site(ty_ladder *l, uint32_t i, uint32_t *nearest, bool *across)
{
	const ty_disc *disc = &l->near.discs[i];
	double radius = disc->radius, at = 0;
	uint32_t j = TY_NO_SITE;
	int asked = 0;

	*nearest = TY_NO_SITE;
	*across = true;
	if (l->by_line[i] && ty_recall_lines(l, i) != TY_OK)
		return TY_NO_MEMORY;
	for (bool all = false; !all; radius *= 2)
	{
		ty_status status = ty_vicinity_find(&l->near, i, (ty_point){disc->x, disc->y}, radius);
		uint32_t next;

		if (status != TY_OK)
			return status;
		all = l->near.found_count + 1 >= l->near.there || !(radius < INFINITY);
		/* who is farther than the radius may not be the next one */
		while ((next = next_nearest(l, i, at, j)) != TY_NO_SITE &&
			   (all || squared_distance(l, i, next) <= radius * radius))
		{
			j = next;
			at = squared_distance(l, i, j);
			*nearest = *nearest == TY_NO_SITE ? j : *nearest;
			*across = is_behind_near_line(l, i, j) || !ty_may_join(l, i, j);
			if (!*across)
				*nearest = j;
			if (!*across || ++asked == ASKED)
				return TY_OK;
		}
	}
	return TY_OK;
}
