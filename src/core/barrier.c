/* barrier.c - see barrier.h */
#include "barrier.h"

#include <float.h>
#include <math.h>

#include "predicates.h"

#define FIRST_RUNS 64
#define FIRST_SEGMENTS 32
/* Of so many more segments than places the tree is as quick: squares would take longer than all that is asked. */
#define MOST_A_PLACE 64

/* ---- lines ---- */

void
ty_barrier_lines_begin(ty_barrier_lines *lines, const ty_environment *env)
{
	*lines = (ty_barrier_lines){.env = env};
}

/* A box of finite points grows to hold one. */
static inline void
enlarge(ty_point *low, ty_point *high, ty_point p)
{
	low->x = p.x < low->x ? p.x : low->x;
	low->y = p.y < low->y ? p.y : low->y;
	high->x = p.x > high->x ? p.x : high->x;
	high->y = p.y > high->y ? p.y : high->y;
}

static ty_status
add_run(ty_barrier_lines *lines, const unsigned char *xy, size_t stride, uint32_t points)
{
	if (lines->count == lines->capacity)
	{
		size_t capacity = lines->capacity == 0 ? FIRST_RUNS : lines->capacity + lines->capacity / 2;
		ty_barrier_run *runs = lines->runs == NULL
								   ? ty_allocate_array(lines->env, capacity, sizeof *runs)
								   : ty_reallocate_array(lines->env, lines->runs, capacity, sizeof *runs);

		if (runs == NULL)
			return TY_NO_MEMORY;
		lines->runs = runs;
		lines->capacity = capacity;
	}
	lines->runs[lines->count++] = (ty_barrier_run){xy, (uint32_t) stride, points};
	lines->segments += points - 1;
	return TY_OK;
}

ty_status
ty_barrier_lines_add(ty_barrier_lines *lines, const void *xy, size_t stride, uint32_t n)
{
	const unsigned char *at = xy;
	ty_barrier_run all = {at, (uint32_t) stride, n};
	ty_status status = TY_OK;

	for (uint32_t i = 0; i < n; i++)
	{
		ty_point p = ty_run_point(&all, i);

		if (!isfinite(p.x) || !isfinite(p.y))
			return TY_NOT_FINITE;
		if (lines->count == 0 && i == 0)
			lines->origin = lines->low = lines->high = p;
		if (n > 1)
			enlarge(&lines->low, &lines->high, p);
		if (ty_interrupted_at(lines->env, i + 1))
			return TY_INTERRUPTED;
	}
	/* a run begins with the last point of the one before it */
	for (uint32_t first = 0; first + 1 < n && status == TY_OK; first += TY_RUN_POINTS - 1)
		status = add_run(lines, at + first * stride, stride, n - first < TY_RUN_POINTS ? n - first : TY_RUN_POINTS);
	if (status == TY_OK && ty_interrupted_at(lines->env, lines->count))
		status = TY_INTERRUPTED;
	return status;
}

static void
box_of_run(const ty_barrier_run *run, ty_point *low, ty_point *high)
{
	*low = *high = ty_run_point(run, 0);
	for (uint32_t i = 1; i < run->points; i++)
		enlarge(low, high, ty_run_point(run, i));
}

/* A whole number of [0, 2^30] that grows with the coordinate; how it rounds is only a matter of speed. */
static int32_t
place_between(double value, double low, double high)
{
	double side = high / 2 - low / 2;

	return side > 0 ? (int32_t) ((value / 2 - low / 2) / side * (1 << TY_GRID_BITS)) : 0;
}

/* a box on the ground as the tree has it */
static ty_box
relative_box(const ty_barrier_lines *lines, ty_point low, ty_point high)
{
	return ty_box_of(low.x - lines->origin.x, low.y - lines->origin.y, high.x - lines->origin.x,
					 high.y - lines->origin.y);
}

/* runs on their way into order */
typedef struct run_order
{
	uint64_t *key;	 /* along the Hilbert curve, of the middle */
	uint32_t *order; /* by key */
	ty_box *box;
	ty_barrier_run *sorted;
	ty_point *points; /* of all runs, one after the other */
} run_order;

#define AHEAD 8 /* runs: they follow one another on the ground, but lie anywhere in memory */

static inline void
fetch_run(const ty_barrier_run *run)
{
	__builtin_prefetch(run->xy);
	__builtin_prefetch(run->xy + (size_t) (run->points - 1) * run->stride);
}

static bool
allocate_order(const ty_barrier_lines *lines, run_order *o)
{
	o->key = ty_allocate_array(lines->env, lines->count, sizeof *o->key);
	o->order = ty_allocate_array(lines->env, lines->count, sizeof *o->order);
	o->box = ty_allocate_array(lines->env, lines->count, sizeof *o->box);
	o->sorted = ty_allocate_array(lines->env, lines->count, sizeof *o->sorted);
	o->points = ty_allocate_array(lines->env, lines->segments + lines->count, sizeof *o->points);
	return o->points != NULL && o->key != NULL && o->order != NULL && o->box != NULL && o->sorted != NULL;
}

/* Points are read once, in the order in which they lie in memory. */
static ty_status
measure_runs(const ty_barrier_lines *lines, run_order *o)
{
	ty_point all_low = lines->low, all_high = lines->high, low, high;

	for (size_t i = 0; i < lines->count; i++)
	{
		if (ty_interrupted_at(lines->env, i))
			return TY_INTERRUPTED;
		box_of_run(&lines->runs[i], &low, &high);
		o->box[i] = relative_box(lines, low, high);
		o->key[i] = ty_hilbert_key((ty_position){place_between(low.x / 2 + high.x / 2, all_low.x, all_high.x),
												 place_between(low.y / 2 + high.y / 2, all_low.y, all_high.y)});
		o->order[i] = (uint32_t) i;
	}
	return TY_OK;
}

/* Runs that are near one another on the ground are so in memory from now on, with their points. */
static void
arrange_runs(ty_barrier_lines *lines, run_order *o)
{
	ty_barrier_run *unsorted = lines->runs;
	ty_point *to = o->points;

	for (size_t i = 0; i < lines->count; i++)
	{
		const ty_barrier_run *run = &unsorted[o->order[i]];

		if (i + AHEAD < lines->count)
			fetch_run(&unsorted[o->order[i + AHEAD]]);
		o->sorted[i] = (ty_barrier_run){(const unsigned char *) to, sizeof *to, run->points};
		for (uint32_t k = 0; k < run->points; k++)
			*to++ = ty_run_point(run, k);
		lines->boxes.box[i] = o->box[o->order[i]];
	}
	lines->runs = o->sorted;
	lines->points = o->points;
	lines->capacity = lines->count;
	o->points = NULL;
	o->sorted = unsorted;
}

ty_status
ty_barrier_lines_end(ty_barrier_lines *lines)
{
	run_order o = {0};
	ty_status status = TY_OK;

	if (lines->count >= UINT32_MAX)
		status = TY_TOO_MANY;
	else if (!allocate_order(lines, &o))
		status = TY_NO_MEMORY;
	if (status == TY_OK)
		status = measure_runs(lines, &o);
	if (status == TY_OK)
		status = ty_sort_keys(lines->env, o.key, o.order, lines->count);
	if (status == TY_OK)
		status = ty_boxes_begin(lines->env, lines->count, &lines->boxes);
	if (status == TY_OK)
	{
		arrange_runs(lines, &o);
		ty_boxes_raise(&lines->boxes);
	}
	ty_release(lines->env, o.key);
	ty_release(lines->env, o.order);
	ty_release(lines->env, o.box);
	ty_release(lines->env, o.sorted);
	ty_release(lines->env, o.points);
	return status;
}

void
ty_barrier_lines_free(ty_barrier_lines *lines)
{
	ty_release(lines->env, lines->runs);
	ty_release(lines->env, lines->points);
	ty_boxes_free(lines->env, &lines->boxes);
	*lines = (ty_barrier_lines){.env = lines->env};
}

/* ---- onto the grid ---- */

/*
 * How far beyond the grid lines go on, in cells. Within it orientations stay below 2^63, and a line that is cut off
 * there is bent by the rounding of its new end by less than a cell inside of the grid.
 */
#define SURROUNDINGS ((double) (1 << 28))
#define GRID_SIDE ((double) (1 << TY_GRID_BITS))

typedef struct fitting
{
	const ty_barrier_lines *lines;
	const ty_grid *grid;
	ty_barriers *barriers;
	ty_position low, high; /* box of the positions */
	ty_box box;			   /* ... on the ground, a little larger */
	ty_status status;
} fitting;

/* The end of a line: where it is in cells, not rounded, and where the grid has it. */
typedef struct line_end
{
	ty_point cells;
	ty_position position; /* only of an end in the surroundings of the grid */
} line_end;

static bool
is_in_surroundings(ty_point p)
{
	return p.x >= -SURROUNDINGS && p.x <= GRID_SIDE + SURROUNDINGS && p.y >= -SURROUNDINGS &&
		   p.y <= GRID_SIDE + SURROUNDINGS;
}

/* Far beyond any grid it does not matter how far, but differences must not overflow. */
static double
in_cells(double value, double cell, double origin)
{
	return fmin(fmax(value / cell, -DBL_MAX / 8), DBL_MAX / 8) - origin;
}

static line_end
end_on_grid(const ty_grid *grid, ty_point p)
{
	line_end end = {{in_cells(p.x, grid->cell, grid->origin_x), in_cells(p.y, grid->cell, grid->origin_y)}, {0, 0}};

	if (is_in_surroundings(end.cells))
		end.position = ty_grid_snap(grid, p.x, p.y);
	return end;
}

static int32_t
nearest_cell(double cells)
{
	return (int32_t) floor(fmin(fmax(cells, -SURROUNDINGS), GRID_SIDE + SURROUNDINGS) + 0.5);
}

/* Of the line from p to q the shares from *from to *to are left: cuts them at low <= value <= high. False: none. */
static bool
cut(double p, double q, double low, double high, double *from, double *to)
{
	double at_low, at_high;

	if (p == q)
		return low <= p && p <= high;
	at_low = (low - p) / (q - p);
	at_high = (high - p) / (q - p);
	*from = fmax(*from, fmin(at_low, at_high));
	*to = fmin(*to, fmax(at_low, at_high));
	return *from <= *to;
}

static ty_position
place_on_line(ty_point p, ty_point q, double share)
{
	return (ty_position){nearest_cell(p.x + share * (q.x - p.x)), nearest_cell(p.y + share * (q.y - p.y))};
}

/* The part of a line within the surroundings of the grid. */
static bool
clip(line_end p, line_end q, ty_barrier_segment *s)
{
	double from = 0, to = 1, low = -SURROUNDINGS, high = GRID_SIDE + SURROUNDINGS;
	bool p_in = is_in_surroundings(p.cells), q_in = is_in_surroundings(q.cells);

	if (!(p_in && q_in) &&
		!(cut(p.cells.x, q.cells.x, low, high, &from, &to) && cut(p.cells.y, q.cells.y, low, high, &from, &to)))
		return false;
	s->a = p_in ? p.position : place_on_line(p.cells, q.cells, from);
	s->b = q_in ? q.position : place_on_line(p.cells, q.cells, to);
	return true;
}

/* Whether a segment may lie between two places in the box. */
static bool
meets_box(const fitting *f, ty_barrier_segment s)
{
	return ty_most(s.a.x, s.b.x) >= f->low.x && ty_least(s.a.x, s.b.x) <= f->high.x &&
		   ty_most(s.a.y, s.b.y) >= f->low.y && ty_least(s.a.y, s.b.y) <= f->high.y;
}

static ty_status
add_segment(ty_barriers *barriers, ty_barrier_segment s)
{
	if (barriers->count == barriers->capacity)
	{
		size_t capacity = barriers->capacity == 0 ? FIRST_SEGMENTS : barriers->capacity + barriers->capacity / 2;
		ty_barrier_segment *segments =
			barriers->segments == NULL
				? ty_allocate_array(barriers->env, capacity, sizeof *segments)
				: ty_reallocate_array(barriers->env, barriers->segments, capacity, sizeof *segments);

		if (segments == NULL)
			return TY_NO_MEMORY;
		barriers->segments = segments;
		barriers->capacity = capacity;
	}
	barriers->segments[barriers->count++] = s;
	return TY_OK;
}

static bool
fit_run(void *context, size_t thing)
{
	fitting *f = context;
	const ty_barrier_run *run = &f->lines->runs[thing];
	line_end last = end_on_grid(f->grid, ty_run_point(run, 0));

	for (uint32_t i = 1; i < run->points && f->status == TY_OK; i++)
	{
		line_end next = end_on_grid(f->grid, ty_run_point(run, i));
		ty_barrier_segment s;

		if (clip(last, next, &s) && !ty_same_position(s.a, s.b) && meets_box(f, s))
			f->status = add_segment(f->barriers, s);
		last = next;
	}
	if (f->status == TY_OK && ty_interrupted_at(f->barriers->env, f->barriers->count))
		f->status = TY_INTERRUPTED;
	return f->status == TY_OK;
}

static bool
may_fit(const void *context, const ty_box *box)
{
	return ty_box_meets(&((const fitting *) context)->box, box);
}

/* The box of the positions, and on the ground: larger by what rounding of coordinates and to cells may do. */
static void
find_box(fitting *f, const ty_position *position, size_t n)
{
	const ty_grid *grid = f->grid;
	ty_point low, high;

	f->low = f->high = position[0];
	for (size_t i = 1; i < n; i++)
	{
		f->low = (ty_position){ty_least(f->low.x, position[i].x), ty_least(f->low.y, position[i].y)};
		f->high = (ty_position){ty_most(f->high.x, position[i].x), ty_most(f->high.y, position[i].y)};
	}
	low = (ty_point){ty_grid_x(grid, f->low.x), ty_grid_y(grid, f->low.y)};
	high = (ty_point){ty_grid_x(grid, f->high.x), ty_grid_y(grid, f->high.y)};
	low.x -= 4 * grid->cell + fabs(low.x) * 4 * DBL_EPSILON;
	low.y -= 4 * grid->cell + fabs(low.y) * 4 * DBL_EPSILON;
	high.x += 4 * grid->cell + fabs(high.x) * 4 * DBL_EPSILON;
	high.y += 4 * grid->cell + fabs(high.y) * 4 * DBL_EPSILON;
	f->box = relative_box(f->lines, low, high);
}

/*
 * The tree over the segments, which are in the order of their lines: near one another along the Hilbert curve. Where
 * there are many places, their squares, too.
 */
static ty_status
raise_boxes(ty_barriers *barriers, size_t places)
{
	size_t count = (barriers->count + TY_BOX_FAN - 1) / TY_BOX_FAN;
	ty_status status = ty_boxes_begin(barriers->env, count, &barriers->boxes);

	for (size_t i = 0; i < count && status == TY_OK; i++)
	{
		ty_position low = barriers->segments[i * TY_BOX_FAN].a, high = low;

		for (size_t j = i * TY_BOX_FAN; j < (i + 1) * TY_BOX_FAN && j < barriers->count; j++)
		{
			const ty_barrier_segment *s = &barriers->segments[j];

			low = (ty_position){ty_least(low.x, ty_least(s->a.x, s->b.x)), ty_least(low.y, ty_least(s->a.y, s->b.y))};
			high = (ty_position){ty_most(high.x, ty_most(s->a.x, s->b.x)), ty_most(high.y, ty_most(s->a.y, s->b.y))};
		}
		barriers->boxes.box[i] = ty_box_of(low.x, low.y, high.x, high.y);
		if (ty_interrupted_at(barriers->env, i))
			status = TY_INTERRUPTED;
	}
	if (status == TY_OK)
		ty_boxes_raise(&barriers->boxes);
	if (status == TY_OK && barriers->count / MOST_A_PLACE <= places)
		status = ty_barrier_squares_build(barriers->env, barriers->segments, barriers->count, &barriers->squares);
	return status;
}

ty_status
ty_barriers_fit(const ty_environment *env, const ty_barrier_lines *lines, const ty_grid *grid,
				const ty_position *position, size_t n, ty_barriers *barriers)
{
	fitting f = {.lines = lines, .grid = grid, .barriers = barriers, .status = TY_OK};

	*barriers = (ty_barriers){.env = env};
	find_box(&f, position, n);
	ty_boxes_search(&lines->boxes, may_fit, fit_run, &f);
	return f.status == TY_OK ? raise_boxes(barriers, n) : f.status;
}

void
ty_barriers_free(ty_barriers *barriers)
{
	ty_release(barriers->env, barriers->segments);
	ty_boxes_free(barriers->env, &barriers->boxes);
	ty_barrier_squares_free(barriers->env, &barriers->squares);
	*barriers = (ty_barriers){.env = barriers->env};
}

/* ---- crossing ---- */

/* The side of the line along (dx, dy), which is not (0, 0), that a move by (e, e * e) leads to: 1 left, -1 right. */
static inline int
side_of_move(int64_t dx, int64_t dy)
{
	if (dy != 0)
		return dy < 0 ? 1 : -1;
	return dx > 0 ? 1 : -1;
}

/* an edge that is looked for: its ends count as moved */
typedef struct edge
{
	const ty_barrier_segment *segments;
	size_t count; /* of all segments */
	ty_position a, b;
	ty_position via; /* a place near the edge, over which the way from a to b leads as well; else a or b */
	int64_t near;	 /* twice the area of a triangle over the edge as high as a line that the way over it may meet */
	ty_position low, high;
	ty_box box;
} edge;

static inline bool
is_left(int64_t turn, ty_position from, ty_position to, bool line_is_moved)
{
	if (turn != 0)
		return turn > 0;
	return (side_of_move((int64_t) to.x - from.x, (int64_t) to.y - from.y) > 0) != line_is_moved;
}

/* whether the segment lies between two places; to_a, to_b: how its ends turn from the line through them */
static inline bool
lies_between(const ty_barrier_segment *s, ty_position p, ty_position q, int64_t to_a, int64_t to_b)
{
	return is_left(to_a, p, q, true) != is_left(to_b, p, q, true) &&
		   is_left(ty_orientation(s->a, s->b, p), s->a, s->b, false) !=
			   is_left(ty_orientation(s->a, s->b, q), s->a, s->b, false);
}

static inline bool
lies_on_way(const ty_barrier_segment *s, ty_position p, ty_position q)
{
	return !ty_same_position(p, q) && lies_between(s, p, q, ty_orientation(p, q, s->a), ty_orientation(p, q, s->b));
}

static inline bool
bars(const edge *e, const ty_barrier_segment *s)
{
	int64_t to_a = ty_orientation(e->a, e->b, s->a), to_b = ty_orientation(e->a, e->b, s->b);

	if ((to_a > e->near && to_b > e->near) || (to_a < -e->near && to_b < -e->near))
		return false;
	return lies_between(s, e->a, e->b, to_a, to_b) || lies_on_way(s, e->a, e->via) || lies_on_way(s, e->via, e->b);
}

/* Whether a box holds a place near the line of the edge, by what dx * y - dy * x comes to in its corners. */
static inline bool
edge_may_meet(const void *context, const ty_box *box)
{
	const edge *e = context;
	int64_t dx = (int64_t) e->b.x - e->a.x, dy = (int64_t) e->b.y - e->a.y;
	int64_t low_x, high_x, low_y, high_y;

	if (!ty_box_meets(&e->box, box))
		return false;
	/* boxes of whole numbers are whole, rounded outwards to floats as well */
	low_x = (int64_t) (dy > 0 ? box->high_x : box->low_x) - e->a.x;
	high_x = (int64_t) (dy > 0 ? box->low_x : box->high_x) - e->a.x;
	low_y = (int64_t) (dx > 0 ? box->low_y : box->high_y) - e->a.y;
	high_y = (int64_t) (dx > 0 ? box->high_y : box->low_y) - e->a.y;
	return dx * low_y - dy * low_x <= e->near && dx * high_y - dy * high_x >= -e->near;
}

/*
 * Whether a segment leaves the edge and the way alone. Most do, and on which of four sides they are would be guessed
 * wrong: so there is one branch. Differences of coordinates are below 2^31.
 */
static inline bool
passes(const edge *e, const ty_barrier_segment *s)
{
	int32_t beyond = (ty_most(s->a.x, s->b.x) - e->low.x) | (e->high.x - ty_least(s->a.x, s->b.x)) |
					 (ty_most(s->a.y, s->b.y) - e->low.y) | (e->high.y - ty_least(s->a.y, s->b.y));

	return beyond < 0 || !bars(e, s);
}

/* Eight segments; false, which ends the search, when one lies on the edge or on the way. */
static inline bool
edge_passes(void *context, size_t thing)
{
	const edge *e = context;
	size_t from = thing * TY_BOX_FAN, to = from + TY_BOX_FAN < e->count ? from + TY_BOX_FAN : e->count;

	for (size_t i = from; i < to; i++)
		if (!passes(e, &e->segments[i]))
			return false;
	return true;
}

/* The same search where squares serve, as they do for nearly all edges of a mesh. */
static bool
edge_passes_squares(const ty_barrier_squares *squares, ty_barrier_span span, const edge *e)
{
	for (uint32_t row = span.low_row; row <= span.high_row; row++)
	{
		const uint32_t *from, *to;

		ty_barrier_row(squares, span, row, &from, &to);
		for (uint32_t k = *from; k < *to; k++)
			if (!passes(e, &e->segments[squares->number[k]]))
				return false;
	}
	return true;
}

static int64_t
magnitude(int64_t v)
{
	return v < 0 ? -v : v;
}

bool
ty_barriers_bar(const ty_barriers *barriers, ty_position a, ty_position b, ty_position merged)
{
	edge e = {.segments = barriers->segments, .count = barriers->count, .a = a, .b = b, .via = merged};
	ty_barrier_span span;

	if (barriers->count == 0 || ty_same_position(a, b))
		return false;
	/* a place off the edge by a cell in either coordinate turns by no more than half of this */
	e.near = 2 * (magnitude((int64_t) b.x - a.x) + magnitude((int64_t) b.y - a.y));
	/* a move by an infinitesimal reaches no whole number: nothing beyond the box of the places is met */
	e.low = (ty_position){ty_least(ty_least(a.x, b.x), merged.x), ty_least(ty_least(a.y, b.y), merged.y)};
	e.high = (ty_position){ty_most(ty_most(a.x, b.x), merged.x), ty_most(ty_most(a.y, b.y), merged.y)};
	span = ty_barrier_span_of(&barriers->squares, e.low, e.high);
	if (ty_barrier_squares_serve(&barriers->squares, span))
		return !edge_passes_squares(&barriers->squares, span, &e);
	e.box = ty_box_of(e.low.x, e.low.y, e.high.x, e.high.y);
	return !ty_boxes_search(&barriers->boxes, edge_may_meet, edge_passes, &e);
}

bool
ty_barriers_cross(const ty_barriers *barriers, ty_position a, ty_position b)
{
	return ty_barriers_bar(barriers, a, b, a);
}

/* ---- fetching ---- */

enum
{
	SQUARES,
	NUMBERS,
	SEGMENTS,
	FETCHES
};

static inline void
fetch_row(const ty_barriers *barriers, const uint32_t *from, const uint32_t *to, int what)
{
	const ty_barrier_squares *squares = &barriers->squares;

	if (what == SQUARES)
		__builtin_prefetch(from);
	else if (what == NUMBERS)
		__builtin_prefetch(&squares->number[*from]);
	else
		for (uint32_t k = *from; k < *to; k++)
			__builtin_prefetch(&barriers->segments[squares->number[k]]);
}

/* Each has to be waited for before it says where the next is: all of a kind are called for together. */
void
ty_barriers_fetch(const ty_barriers *barriers, const ty_edge_ends *edge, size_t count)
{
	const ty_barrier_squares *squares = &barriers->squares;

	for (int what = SQUARES; what < FETCHES; what++)
		for (size_t i = 0; i < count; i++)
		{
			ty_position a = edge[i].a, b = edge[i].b;
			ty_barrier_span span = ty_barrier_span_of(squares, (ty_position){ty_least(a.x, b.x), ty_least(a.y, b.y)},
													  (ty_position){ty_most(a.x, b.x), ty_most(a.y, b.y)});

			if (!ty_barrier_squares_serve(squares, span))
				continue;
			for (uint32_t row = span.low_row; row <= span.high_row; row++)
			{
				const uint32_t *from, *to;

				ty_barrier_row(squares, span, row, &from, &to);
				fetch_row(barriers, from, to, what);
			}
		}
}
