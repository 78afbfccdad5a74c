/* reference.c - see reference.h */
#include "reference.h"

#include <math.h>
#include <string.h>

typedef __int128 wide;

static int
sign(wide value)
{
	return (value > 0) - (value < 0);
}

static wide
cross(ty_position a, ty_position b, ty_position c)
{
	return ((wide) b.x - a.x) * ((wide) c.y - a.y) - ((wide) b.y - a.y) * ((wide) c.x - a.x);
}

int
reference_orientation(ty_position a, ty_position b, ty_position c)
{
	return sign(cross(a, b, c));
}

/* squared distance, the height of a point on the paraboloid over d */
static wide
lift(ty_position p, ty_position d)
{
	wide x = (wide) p.x - d.x;
	wide y = (wide) p.y - d.y;

	return x * x + y * y;
}

/*
 * The plane through the lifted a, b, c stands over d at height (lift(a) * [dbc] + lift(b) * [adc] + lift(c) *
 * [abd]) / [abc], where [] is twice the signed area; d itself is at height 0. d is inside when the plane is above it.
 */
static int
height_over(ty_position a, ty_position b, ty_position c, ty_position d)
{
	return sign(lift(a, d) * cross(d, b, c) + lift(b, d) * cross(a, d, c) + lift(c, d) * cross(a, b, d));
}

bool
reference_in_circle(const ty_position *at, uint32_t a, uint32_t b, uint32_t c, uint32_t d)
{
	int height = height_over(at[a], at[b], at[c], at[d]);

	if (height != 0)
		return height > 0;
	if (d < a && d < b && d < c)
		return false; /* d itself rises above the plane */
	if (a < b && a < c)
		return cross(at[d], at[b], at[c]) > 0;
	if (b < c)
		return cross(at[a], at[d], at[c]) > 0;
	return cross(at[a], at[b], at[d]) > 0;
}

static void
join(reference_edges edge, uint32_t a, uint32_t b)
{
	edge[a][b] = true;
	edge[b][a] = true;
}

static bool
triangle_is_empty(const ty_position *at, const uint32_t *list, size_t m, uint32_t a, uint32_t b, uint32_t c)
{
	for (size_t i = 0; i < m; i++)
	{
		uint32_t d = list[i];

		if (d != a && d != b && d != c && reference_in_circle(at, a, b, c, d))
			return false;
	}
	return true;
}

static bool
all_collinear(const ty_position *at, const uint32_t *list, size_t m)
{
	for (size_t i = 2; i < m; i++)
		if (reference_orientation(at[list[0]], at[list[1]], at[list[i]]) != 0)
			return false;
	return true;
}

static bool
lies_between(ty_position a, ty_position b, ty_position p)
{
	bool between_x = (a.x <= p.x && p.x <= b.x) || (b.x <= p.x && p.x <= a.x);
	bool between_y = (a.y <= p.y && p.y <= b.y) || (b.y <= p.y && p.y <= a.y);

	return between_x && between_y;
}

/* Neighbours along the line are those with nobody between them. */
static void
join_along_line(const ty_position *at, const uint32_t *list, size_t m, reference_edges edge)
{
	for (size_t i = 0; i < m; i++)
		for (size_t k = i + 1; k < m; k++)
		{
			bool neighbours = true;

			for (size_t other = 0; other < m; other++)
				if (other != i && other != k && lies_between(at[list[i]], at[list[k]], at[list[other]]))
					neighbours = false;
			if (neighbours)
				join(edge, list[i], list[k]);
		}
}

static void
join_triangle_if_empty(const ty_position *at, const uint32_t *list, size_t m, uint32_t a, uint32_t b, uint32_t c,
					   reference_edges edge)
{
	int turn = reference_orientation(at[a], at[b], at[c]);

	if (turn == 0 || !triangle_is_empty(at, list, m, a, turn > 0 ? b : c, turn > 0 ? c : b))
		return;
	join(edge, a, b);
	join(edge, b, c);
	join(edge, c, a);
}

void
reference_delaunay(const ty_position *at, const uint32_t *list, size_t m, reference_edges edge)
{
	memset(edge, 0, sizeof(reference_edges));
	if (all_collinear(at, list, m))
	{
		join_along_line(at, list, m, edge);
		return;
	}
	for (size_t i = 0; i < m; i++)
		for (size_t k = i + 1; k < m; k++)
			for (size_t l = k + 1; l < m; l++)
				join_triangle_if_empty(at, list, m, list[i], list[k], list[l], edge);
}

void
reset_rows(ty_rows *rows, size_t n)
{
	for (size_t i = 0; i < n; i++)
		rows->span[i] = (ty_span){TY_NONE, 0, 0};
	for (uint32_t r = 0; r < rows->count; r++)
		for (uint32_t i = rows->first[r]; i < rows->first[r + 1]; i++)
			rows->span[rows->member[i]] = (ty_span){r, i - rows->first[r], i - rows->first[r]};
}

void
give_rows(given_rows *given, const uint32_t *row, size_t n, uint32_t count, double spacing)
{
	uint32_t members = 0;

	given->rows = (ty_rows){count, given->first, given->member, given->spacing, given->span};
	for (uint32_t r = 0; r < count; r++)
	{
		given->first[r] = members;
		given->spacing[r] = spacing;
		for (uint32_t i = 0; i < n; i++)
			if (row[i] == r)
				given->member[members++] = i;
	}
	given->first[count] = members;
	reset_rows(&given->rows, n);
}

void
reference_begin(reference *ref, const ty_position *position, size_t n, double s_u, const ty_influence *influence,
				reference_candidates candidates)
{
	ref->n = ref->live = n;
	ref->s_u = s_u;
	ref->influence = influence;
	ref->candidates = candidates;
	if (influence != NULL && influence->rows != NULL)
		reset_rows(influence->rows, n);
	for (size_t i = 0; i < n; i++)
	{
		bool weighted = influence != NULL && influence->importance != NULL;
		double importance = weighted ? influence->importance[i] : 1;
		bool kept = isinf(importance) != 0;
		wide weight = kept ? 0 : (wide) (importance * REFERENCE_UNIT);

		ref->vertex[i] = (reference_vertex){
			.live = true,
			.r = 1,
			.kept = kept,
			.importance = importance,
			.weight = weight,
			.sum_x = weight * position[i].x,
			.sum_y = weight * position[i].y,
			.span = influence != NULL && influence->rows != NULL ? influence->rows->span[i] : (ty_span){TY_NONE, 0, 0},
			.at = position[i]};
	}
}

static bool
same_position(ty_position a, ty_position b)
{
	return a.x == b.x && a.y == b.y;
}

static double
true_length(const reference *ref, uint32_t a, uint32_t b)
{
	int64_t dx = (int64_t) ref->vertex[a].at.x - ref->vertex[b].at.x;
	int64_t dy = (int64_t) ref->vertex[a].at.y - ref->vertex[b].at.y;

	return sqrt((double) (dx * dx + dy * dy));
}

/* sum / count rounded half up; sums are not negative */
static int32_t
rounded_mean(wide sum, wide count)
{
	return (int32_t) ((2 * sum + count) / (2 * count));
}

static ty_position
merged_place(const reference_vertex *s, const reference_vertex *t)
{
	if (s->kept || t->kept)
		return s->kept ? s->at : t->at;
	return (ty_position){rounded_mean(s->sum_x + t->sum_x, s->weight + t->weight),
						 rounded_mean(s->sum_y + t->sum_y, s->weight + t->weight)};
}

/* INFINITY: there is no such edge */
static double
cost_of(const reference *ref, uint32_t a, uint32_t b)
{
	const reference_vertex *s = &ref->vertex[a], *t = &ref->vertex[b];
	const ty_influence *influence = ref->influence;
	double f_a = ref->s_u * (double) ((s->r - 1) + (t->r - 1)) + 1.0;
	double cost = f_a * true_length(ref, a, b);

	if (s->kept && t->kept)
		return INFINITY;
	if (influence != NULL && influence->crosses != NULL && !same_position(s->at, t->at) &&
		influence->crosses(influence->barriers, s->at, t->at, merged_place(s, t)))
		return INFINITY;
	cost *= s->kept ? t->importance : t->kept ? s->importance : fmax(s->importance, t->importance);
	if (influence != NULL && influence->rows != NULL && true_length(ref, a, b) > 0)
		cost *= ty_aligned_length(influence->rows, s->span, t->span, (uint64_t) (s->r + t->r), true_length(ref, a, b),
								  influence->alignment) /
				true_length(ref, a, b);
	return cost;
}

/*
 * All vertices at one position are joined by edges of length 0, which cost least and therefore go first; the mesh
 * of the distinct positions, over the smallest rank of each, decides only when no two vertices coincide.
 */
static void
current_edges(const reference *ref, reference_edges edge)
{
	ty_position at[REFERENCE_MAX] = {{0, 0}};
	uint32_t list[REFERENCE_MAX] = {0};
	size_t m = 0;

	for (uint32_t a = 0; a < ref->n; a++)
	{
		bool first = ref->vertex[a].live;

		at[a] = ref->vertex[a].at;
		for (uint32_t b = 0; b < a; b++)
			if (ref->vertex[b].live && same_position(at[a], at[b]))
				first = false;
		if (first)
			list[m++] = a;
	}
	reference_delaunay(at, list, m, edge);
	for (uint32_t a = 0; a < ref->n; a++)
		for (uint32_t b = 0; b < a; b++)
			if (ref->vertex[a].live && ref->vertex[b].live && same_position(at[a], at[b]))
				join(edge, a, b);
}

bool
reference_must_go_on(const reference *ref, ty_stop stop)
{
	reference_edges edge;

	if (!reference_can_go_on(ref))
		return false;
	if (ref->live > stop.count)
		return true;
	current_edges(ref, edge);
	for (uint32_t a = 0; a < ref->n; a++)
		for (uint32_t b = a + 1; b < ref->n; b++)
			if (edge[a][b] && cost_of(ref, a, b) != INFINITY && true_length(ref, a, b) < stop.min_distance)
				return true;
	return false;
}

/* least cost, then smaller rank, then larger rank: the order in which the pairs are looked at */
static reference_merge
least_edge(const reference *ref)
{
	reference_merge least = {0, 0, INFINITY};
	reference_edges edge;

	if (ref->candidates == REFERENCE_MESH)
		current_edges(ref, edge);
	for (uint32_t a = 0; a < ref->n; a++)
		for (uint32_t b = a + 1; b < ref->n; b++)
		{
			if (!ref->vertex[a].live || !ref->vertex[b].live)
				continue;
			if (ref->candidates == REFERENCE_MESH && !edge[a][b])
				continue;
			if (cost_of(ref, a, b) < least.cost)
				least = (reference_merge){a, b, cost_of(ref, a, b)};
		}
	return least;
}

bool
reference_can_go_on(const reference *ref)
{
	/* without influences every edge may be */
	return ref->live > 1 && (ref->influence == NULL || least_edge(ref).cost != INFINITY);
}

reference_merge
reference_step(reference *ref)
{
	reference_merge merge = least_edge(ref);
	reference_vertex *kept = &ref->vertex[merge.kept];
	reference_vertex *gone = &ref->vertex[merge.gone];

	kept->at = merged_place(kept, gone);
	kept->kept |= gone->kept;
	kept->r += gone->r;
	kept->importance = fmax(kept->importance, gone->importance);
	kept->weight += gone->weight;
	kept->sum_x += gone->sum_x;
	kept->sum_y += gone->sum_y;
	kept->span = ty_joined_span(kept->span, gone->span, (uint64_t) kept->r);
	gone->live = false;
	ref->live--;
	return merge;
}
