/*
 * measure.c - see measure.h
 *
 * Everything is summed relative to the first point, so that a house at coordinates of millions of metres
 * loses no digits. The centroid follows ST_Centroid: by area where there is one, else by length, else the
 * mean of the points.
 */
#include "measure.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static ty_point
read_point(const void *xy, size_t stride, uint32_t i)
{
	ty_point p;

	memcpy(&p, (const unsigned char *) xy + i * stride, sizeof p);
	return p;
}

void
ty_measure_begin(ty_measure *m, const ty_environment *env)
{
	/* field by field: the inline points are large and need no clearing */
	m->env = env;
	m->status = TY_OK;
	m->areal = m->linear = m->puntal = (ty_moment){0, 0, 0};
	m->area = 0;
	m->low = (ty_point){INFINITY, INFINITY};
	m->high = (ty_point){-INFINITY, -INFINITY};
	m->count = 0;
	m->capacity = TY_HULL_INLINE;
	m->points = m->inline_points;
	m->base = (ty_point){NAN, NAN};
	m->skips_lengths = m->lacks_lengths = false;
}

void
ty_measure_skip_lengths(ty_measure *m)
{
	m->skips_lengths = true;
}

bool
ty_measure_lacks_lengths(const ty_measure *m)
{
	return m->lacks_lengths && m->areal.weight == 0;
}

void
ty_measure_abandon(ty_measure *m)
{
	if (m->points != m->inline_points)
		ty_release(m->env, m->points);
	m->points = m->inline_points;
}

static size_t convex_hull(ty_point *points, size_t n, ty_point *hull);

/* An outline of more points is replaced by its hull whenever it has grown full: that is all that counts of it. */
#define LONG_OUTLINE 4096

/* Room for one more point of the outline; behind the capacity there is as much again for the hull. */
static bool
make_room(ty_measure *m)
{
	size_t capacity = 4 * m->capacity;
	ty_point *points;

	if (m->count >= LONG_OUTLINE)
	{
		size_t count = convex_hull(m->points, m->count, m->points + m->capacity);

		memcpy(m->points, m->points + m->capacity, count * sizeof *m->points);
		m->count = count;
		if (count <= m->capacity / 2)
			return true;
	}
	points = ty_allocate_array(m->env, 2 * capacity + 1, sizeof *points);
	if (points == NULL)
	{
		m->status = TY_NO_MEMORY;
		return false;
	}
	memcpy(points, m->points, m->count * sizeof *points);
	if (m->points != m->inline_points)
		ty_release(m->env, m->points);
	m->points = points;
	m->capacity = capacity;
	return true;
}

/* takes the point into the box; false when it is not finite */
static bool
extend_box(ty_measure *m, ty_point p)
{
	if (!isfinite(p.x) || !isfinite(p.y))
	{
		m->status = TY_NOT_FINITE;
		return false;
	}
	if (isnan(m->base.x))
		m->base = p;
	m->low.x = p.x < m->low.x ? p.x : m->low.x;
	m->low.y = p.y < m->low.y ? p.y : m->low.y;
	m->high.x = p.x > m->high.x ? p.x : m->high.x;
	m->high.y = p.y > m->high.y ? p.y : m->high.y;
	return true;
}

static void
add_moment(ty_moment *moment, double weight, double x, double y)
{
	moment->weight += weight;
	moment->x += weight * x;
	moment->y += weight * y;
}

/* takes the path's points into the box and, if they are of the outline, into that; false when that ended the measure */
static bool
add_points(ty_measure *m, const void *xy, size_t stride, uint32_t n, bool outline)
{
	for (uint32_t i = 0; i < n; i++)
	{
		ty_point p = read_point(xy, stride, i);

		if (!extend_box(m, p) || (outline && m->count == m->capacity && !make_room(m)))
			return false;
		if (i > 0 && ty_interrupted_at(m->env, i))
		{
			m->status = TY_INTERRUPTED;
			return false;
		}
		if (outline)
			m->points[m->count++] = (ty_point){p.x - m->base.x, p.y - m->base.y};
	}
	return true;
}

/* length-weighted sum of a path's segments; a path without length counts as its first point */
static void
add_lengths(ty_measure *m, const void *xy, size_t stride, uint32_t n)
{
	double length = 0;
	ty_point before = {0, 0}, first = {0, 0};

	for (uint32_t i = 0; i < n; i++)
	{
		ty_point p = read_point(xy, stride, i);

		p.x -= m->base.x;
		p.y -= m->base.y;
		if (i == 0)
			first = p;
		else
		{
			double dx = p.x - before.x, dy = p.y - before.y;
			double segment = sqrt(dx * dx + dy * dy);

			length += segment;
			add_moment(&m->linear, segment, 0.5 * (before.x + p.x), 0.5 * (before.y + p.y));
		}
		before = p;
	}
	if (n > 0 && !(length > 0))
		add_moment(&m->puntal, 1, first.x, first.y);
}

/* the ring's shoelace sum and area-weighted centroid, relative to the base */
static void
add_area(ty_measure *m, const void *xy, size_t stride, uint32_t n, bool shell)
{
	double twice = 0, x = 0, y = 0, sign;
	ty_point before = read_point(xy, stride, n - 1);

	before.x -= m->base.x;
	before.y -= m->base.y;
	for (uint32_t i = 0; i < n; i++)
	{
		ty_point p = read_point(xy, stride, i);
		double cross;

		p.x -= m->base.x;
		p.y -= m->base.y;
		cross = before.x * p.y - p.x * before.y;
		twice += cross;
		x += (before.x + p.x) * cross;
		y += (before.y + p.y) * cross;
		before = p;
	}
	sign = (twice < 0) == shell ? -1 : 1; /* either direction counts alike; holes count against the shell */
	m->area += 0.5 * sign * twice;
	m->areal.weight += 3 * sign * twice;
	m->areal.x += sign * x;
	m->areal.y += sign * y;
}

void
ty_measure_ring(ty_measure *m, const void *xy, size_t stride, uint32_t n, bool shell)
{
	if (m->status != TY_OK || n == 0 || !add_points(m, xy, stride, n, shell))
		return;
	if (m->skips_lengths)
		m->lacks_lengths = true;
	else
		add_lengths(m, xy, stride, n);
	add_area(m, xy, stride, n, shell);
}

void
ty_measure_line(ty_measure *m, const void *xy, size_t stride, uint32_t n)
{
	if (m->status == TY_OK && add_points(m, xy, stride, n, true))
		add_lengths(m, xy, stride, n);
}

void
ty_measure_point(ty_measure *m, const void *xy)
{
	ty_measure_line(m, xy, sizeof(ty_point), 1);
}

/* The centroid by the highest dimension that has a weight. */
static void
find_centroid(const ty_measure *m, double *x, double *y)
{
	const ty_moment *moment = m->areal.weight != 0 ? &m->areal : m->linear.weight != 0 ? &m->linear : &m->puntal;

	*x = moment->x / moment->weight + m->base.x;
	*y = moment->y / moment->weight + m->base.y;
	/* bow-ties and slivers throw the centroid anywhere; written so that NaN is caught too */
	if (!(*x >= m->low.x && *x <= m->high.x && *y >= m->low.y && *y <= m->high.y))
	{
		*x = 0.5 * m->low.x + 0.5 * m->high.x;
		*y = 0.5 * m->low.y + 0.5 * m->high.y;
	}
	*x += 0.0; /* no negative zero: equal buildings are the same bytes */
	*y += 0.0;
}

ty_status
ty_measure_end(ty_measure *m, ty_building *building)
{
	if (m->status == TY_OK)
	{
		building->area = fabs(m->area);
		building->id = 0;
		find_centroid(m, &building->x, &building->y);
		if (!isfinite(building->area))
			m->status = TY_NOT_FINITE;
		else
			ty_minimum_rectangle(m->points, m->count, m->points + m->capacity, &building->ratio, &building->ux,
								 &building->uy);
	}
	ty_measure_abandon(m);
	return m->status;
}

/* ---- minimum-area rectangle ---- */

static int
compare_points(const void *a, const void *b)
{
	const ty_point *p = a, *q = b;

	if (p->x != q->x)
		return p->x < q->x ? -1 : 1;
	return (p->y > q->y) - (p->y < q->y);
}

static void
sort_points(ty_point *points, size_t n)
{
	if (n > TY_HULL_INLINE)
	{
		qsort(points, n, sizeof *points, compare_points);
		return;
	}
	for (size_t i = 1; i < n; i++)
	{
		ty_point p = points[i];
		size_t j = i;

		for (; j > 0 && compare_points(&points[j - 1], &p) > 0; j--)
			points[j] = points[j - 1];
		points[j] = p;
	}
}

/* positive when a, b, c turn left */
static double
turn(ty_point a, ty_point b, ty_point c)
{
	return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/* sorts the points and drops repeats; returns how many are left */
static size_t
distinct_points(ty_point *points, size_t n)
{
	size_t count = 1;

	sort_points(points, n);
	for (size_t i = 1; i < n; i++)
		if (compare_points(&points[i], &points[count - 1]) != 0)
			points[count++] = points[i];
	return count;
}

/* takes the point as the next of a counter-clockwise chain that may shrink back to `least` points */
static size_t
extend_chain(ty_point *hull, size_t count, size_t least, ty_point p)
{
	while (count > least && turn(hull[count - 2], hull[count - 1], p) <= 0)
		count--;
	hull[count++] = p;
	return count;
}

/*
 * Convex hull, counter-clockwise, by Andrew's monotone chain (1979): lower chain, then upper. Returns its size; of two
 * points or more the first follows the last once more.
 */
static size_t
convex_hull(ty_point *points, size_t n, ty_point *hull)
{
	size_t count = 0, lower;

	n = distinct_points(points, n);
	for (size_t i = 0; i < n; i++)
		count = extend_chain(hull, count, 1, points[i]);
	lower = count;
	for (size_t i = n - 1; i-- > 0;)
		count = extend_chain(hull, count, lower, points[i]);
	return n > 1 ? count - 1 : count;
}

/*
 * Whether the points are a closed ring of four clearly convex corners, as most buildings are. Then they are their own
 * hull, and convex_hull would give the same: no three corners span less than the least three neighbours do.
 */
static bool
is_quadrilateral(const ty_point *p, size_t n, ty_point *hull)
{
	double limit, a, b, c, d;
	bool left, right;
	size_t first = 0;

	if (n != 5 || p[0].x != p[4].x || p[0].y != p[4].y)
		return false;
	limit = fabs(p[2].x - p[0].x) + fabs(p[2].y - p[0].y) + fabs(p[3].x - p[1].x) + fabs(p[3].y - p[1].y);
	limit *= 1e-12 * limit; /* what rounding takes from a turn is less than a thousandth of it */
	a = turn(p[0], p[1], p[2]);
	b = turn(p[1], p[2], p[3]);
	c = turn(p[2], p[3], p[0]);
	d = turn(p[3], p[0], p[1]);
	left = (a > limit) & (b > limit) & (c > limit) & (d > limit);
	right = (a < -limit) & (b < -limit) & (c < -limit) & (d < -limit);
	for (size_t i = 1; i < 4; i++)
		first = (p[i].x < p[first].x) | ((p[i].x == p[first].x) & (p[i].y < p[first].y)) ? i : first;
	for (size_t i = 0; i < 5; i++)
		hull[i] = p[(first + (left ? i : 4 - i)) & 3];
	return left | right;
}

static double
along(ty_point e, ty_point a, ty_point b)
{
	return e.x * (b.x - a.x) + e.y * (b.y - a.y);
}

/* From a corner on, the one that lies farthest in a direction: steps on while the hull still rises that way. */
static size_t
farthest(const ty_point *hull, size_t n, size_t corner, ty_point direction)
{
	for (size_t steps = 0; steps < n; steps++)
	{
		if (!(along(direction, hull[corner], hull[corner + 1]) > 0))
			break;
		corner = corner + 1 < n ? corner + 1 : 0;
	}
	return corner;
}

static ty_point
from_to(ty_point a, ty_point b)
{
	return (ty_point){b.x - a.x, b.y - a.y};
}

static ty_point
turned_left(ty_point e)
{
	return (ty_point){-e.y, e.x};
}

static ty_point
unit(ty_point e)
{
	double wide = fabs(e.x), high = fabs(e.y);
	double largest = wide > high || isnan(high) ? wide : high; /* fmax(), which is a call of the C library */
	double length;

	e.x /= largest; /* first, so that no square over- or underflows */
	e.y /= largest;
	length = sqrt(e.x * e.x + e.y * e.y);
	return (ty_point){e.x / length, e.y / length};
}

/* a rectangle around a hull: unit vector of an edge of it, the sides along that and across */
typedef struct rectangle
{
	ty_point e;
	double side, height;
} rectangle;

/*
 * Hulls of few corners: every corner is looked at for every edge, without a branch and without unit vectors. For four
 * corners, what three of four buildings have, this takes a third of the time of calipers, whose steps are guessed wrong.
 */
#define FEW_CORNERS 16

/* false where edges are so long or short that products of four leave the range of a double, or there is no area */
static inline __attribute__((always_inline)) bool
least_of_few(const ty_point *hull, size_t n, rectangle *least)
{
	double least_area = INFINITY;

	*least = (rectangle){{1, 0}, 1, 1};
	for (size_t i = 0; i < n; i++)
	{
		ty_point e = from_to(hull[i], hull[i + 1]), across = turned_left(e);
		double low = 0, high = 0, height = 0, area;
		bool less;

		for (size_t k = 0; k < n; k++)
		{
			double onward = along(e, hull[i], hull[k]), upward = along(across, hull[i], hull[k]);

			low = onward < low ? onward : low;
			high = onward > high ? onward : high;
			height = upward > height ? upward : height;
		}
		area = (high - low) * height / (e.x * e.x + e.y * e.y);
		less = area < least_area;
		least_area = less ? area : least_area;
		least->e.x = less ? e.x : least->e.x;
		least->e.y = less ? e.y : least->e.y;
		least->side = less ? high - low : least->side;
		least->height = less ? height : least->height;
	}
	least->e = unit(least->e);
	return least_area > 1e-100 && least_area < 1e100;
}

/* by rotating calipers: the corners farthest along an edge, across it, and against it, one edge after the other */
static rectangle
least_of_many(const ty_point *hull, size_t n)
{
	rectangle least = {{1, 0}, 1, 1};
	double least_area = INFINITY;
	size_t front = 0, top = 0, back = 0;

	for (size_t i = 0; i < n; i++)
	{
		ty_point e = unit(from_to(hull[i], hull[i + 1])), across = turned_left(e);
		double side, height;

		front = farthest(hull, n, front, e);
		top = farthest(hull, n, i == 0 ? front : top, across);
		back = farthest(hull, n, i == 0 ? top : back, turned_left(across));
		side = along(e, hull[back], hull[front]);
		height = along(across, hull[i], hull[top]);
		if (side * height < least_area)
		{
			least_area = side * height;
			least = (rectangle){e, side, height};
		}
	}
	return least;
}

static rectangle
least_rectangle(const ty_point *hull, size_t n)
{
	rectangle least;

	if (n == 4 ? least_of_few(hull, 4, &least) : n <= FEW_CORNERS && least_of_few(hull, n, &least))
		return least;
	return least_of_many(hull, n);
}

/* the longer side's direction, turned into [0, 180) */
static void
set_direction(ty_point e, double *ux, double *uy)
{
	bool turned = e.y < 0 || (e.y == 0 && e.x < 0);

	*ux = turned ? -e.x : e.x;
	*uy = turned ? -e.y : e.y;
	if (*uy == 0)
		*ux = 1, *uy = 0; /* no negative zero */
	if (*ux == 0)
		*ux = 0;
}

void
ty_minimum_rectangle(ty_point *points, size_t n, ty_point *hull, double *ratio, double *ux, double *uy)
{
	*ratio = 1;
	*ux = 1;
	*uy = 0;
	n = is_quadrilateral(points, n, hull) ? 4 : convex_hull(points, n, hull);
	if (n > 1)
	{
		rectangle least = least_rectangle(hull, n);
		bool lengthwise = least.side >= least.height;

		*ratio = lengthwise ? least.height / least.side : least.side / least.height;
		set_direction(lengthwise ? least.e : turned_left(least.e), ux, uy);
	}
	if (!(*ratio > 0 && *ratio <= 1))
		*ratio = 1; /* a line or a point */
}
