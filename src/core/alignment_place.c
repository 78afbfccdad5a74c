/*
 * alignment_place.c - where the placeholders of rows stand, see alignment.h.
 *
 * Merges leave gaps of different lengths in a row: a pair beside a single house is half as far again from it as two
 * single ones are apart. So what is left of a row is laid out anew along the line through its placeholders, each of
 * which stands for the mean of its members in the row; the ends stay where they are.
 */
#include "alignment.h"
#include "barrier.h"
#include "group.h"

#include <math.h>

#define MOST_SPACINGS 4.0

/* placeholders that follow each other in a row */
typedef struct piece
{
	uint32_t row_members;	/* of the whole row */
	const uint32_t *member; /* of the row, of which the piece has those from first to last */
	uint32_t first, last;
	uint32_t count;
	uint32_t merged; /* how many of them stand for more than one building */
	uint32_t *label;
	ty_point *mean;
	double *along; /* of the means, along the line through them */
} piece;

/* the mean of the members first .. last of a row */
static ty_point
mean_of_members(const ty_drawn_rows *drawn, const uint32_t *member, uint32_t first, uint32_t last)
{
	const ty_building *base = &drawn->buildings[drawn->order[member[first]]];
	ty_point sum = {0, 0};

	for (uint32_t i = first; i <= last; i++)
	{
		const ty_building *b = &drawn->buildings[drawn->order[member[i]]];

		sum.x += b->x - base->x;
		sum.y += b->y - base->y;
	}
	return (ty_point){base->x + sum.x / (last - first + 1), base->y + sum.y / (last - first + 1)};
}

static double
distance(ty_point a, ty_point b)
{
	double dx = a.x - b.x, dy = a.y - b.y;

	return sqrt(dx * dx + dy * dy);
}

/* the point of the line that is `along` it, between the means at and at + 1 */
static ty_point
point_between(const piece *p, uint32_t at, double along)
{
	ty_point a = p->mean[at], b = p->mean[at + 1];
	double length = p->along[at + 1] - p->along[at], share = length > 0 ? (along - p->along[at]) / length : 0;

	return (ty_point){a.x + (b.x - a.x) * share, a.y + (b.y - a.y) * share};
}

/*
 * Lays a piece out between its ends. Nobody goes farther than MOST_SPACINGS: merges in their turn need less, of a
 * thousand members 2.5, but others may have taken members away.
 */
static void
lay_out(const piece *p, ty_placeholder *placeholders)
{
	uint32_t last = p->count - 1, at = 0;
	double spacing, most;

	p->along[0] = 0;
	for (uint32_t i = 1; i <= last; i++)
		p->along[i] = p->along[i - 1] + distance(p->mean[i - 1], p->mean[i]);
	spacing = p->along[last] / last;
	most = MOST_SPACINGS * spacing;
	for (uint32_t i = 0; i <= last; i++)
	{
		double along = fmax(fmin(spacing * i, p->along[i] + most), p->along[i] - most);
		ty_point to = p->mean[i];

		while (at + 1 < last && p->along[at + 1] <= along)
			at++;
		if (i > 0 && i < last)
			to = point_between(p, at, along);
		placeholders[p->label[i]].x = to.x;
		placeholders[p->label[i]].y = to.y;
	}
}

static ty_point
place_of(const ty_drawn_rows *drawn, uint32_t rank)
{
	const ty_building *b = &drawn->buildings[drawn->order[rank]];

	return (ty_point){b->x, b->y};
}

/* Adds a piece to those that are to stay rows. */
static void
keep_piece(const ty_drawn_rows *drawn, const piece *p, const ty_placeholder *placeholders)
{
	ty_site_rows *pieces = drawn->pieces;
	uint32_t first = pieces->first[pieces->count], bent = pieces->bent[pieces->count];

	for (uint32_t m = p->first; m <= p->last; m++)
		pieces->line[bent++] = place_of(drawn, p->member[m]);
	pieces->bent[pieces->count + 1] = bent;
	pieces->weight[pieces->count] = 0;
	for (uint32_t i = 0; i < p->count; i++)
	{
		pieces->site[first + i] = p->label[i];
		pieces->weight[pieces->count] += placeholders[p->label[i]].count;
	}
	pieces->left[pieces->count] = p->count;
	pieces->dirty[pieces->count] = false;
	pieces->moves[pieces->count] = 0;
	pieces->first[++pieces->count] = first + p->count;
}

/* A piece is complete: lays it out where there is anything to even, and begins the next. */
static void
end_piece(const ty_drawn_rows *drawn, piece *p, ty_placeholder *placeholders)
{
	if (p->count > 1 && p->merged > 0)
		lay_out(p, placeholders);
	if (p->count > 1 && drawn->pieces != NULL && p->row_members * drawn->placeholders >= 2 * drawn->n)
		keep_piece(drawn, p, placeholders);
	p->count = p->merged = 0;
}

static bool
is_barred(const ty_drawn_rows *drawn, ty_point a, ty_point b)
{
	return drawn->barriers != NULL && ty_barrier_lines_cross(drawn->barriers, a, b);
}

/* Adds a placeholder, for the mean of its members in the row, to a piece. */
static void
add_to_piece(const ty_drawn_rows *drawn, uint32_t label, ty_span span, piece *p, ty_placeholder *placeholders)
{
	ty_point mean = mean_of_members(drawn, p->member, span.first, span.last);
	ty_placeholder *placeholder = &placeholders[label];

	if (p->count > 0 && is_barred(drawn, p->mean[p->count - 1], mean))
		end_piece(drawn, p, placeholders);
	if (is_barred(drawn, (ty_point){placeholder->x, placeholder->y}, mean))
	{
		end_piece(drawn, p, placeholders);
		return;
	}
	if (p->count == 0)
		p->first = span.first;
	p->last = span.last;
	p->label[p->count] = label;
	p->mean[p->count++] = mean;
	p->merged += placeholder->count > 1;
}

#define ASIDE 16 /* members before and behind those of a placeholder: it is hardly farther from its own mean */

static double
distance_to_stretch(ty_point p, ty_point a, ty_point b)
{
	double dx = b.x - a.x, dy = b.y - a.y, square = dx * dx + dy * dy;
	double share = square > 0 ? ((p.x - a.x) * dx + (p.y - a.y) * dy) / square : 0;

	share = fmax(fmin(share, 1), 0);
	return distance(p, (ty_point){a.x + share * dx, a.y + share * dy});
}

/* How far from the line along its members the placeholders of the row stand, at most, that are on it. */
static double
bend_of(const ty_drawn_rows *drawn, uint32_t row, const ty_placeholder *placeholders)
{
	const ty_rows *rows = drawn->rows;
	const uint32_t *member = rows->member + rows->first[row];
	uint32_t k = rows->first[row + 1] - rows->first[row];
	double most = 0;

	for (uint32_t i = 0; i < k; i++)
	{
		const ty_placeholder *p = &placeholders[drawn->label[member[i]]];
		ty_span span = rows->span[drawn->keeper[drawn->label[member[i]]]];
		double least = INFINITY;

		if (span.row != row || span.first != i)
			continue;
		for (uint32_t m = i > ASIDE ? i - ASIDE : 0; m + 1 < k && m < span.last + ASIDE; m++)
			least = fmin(least, distance_to_stretch((ty_point){p->x, p->y}, place_of(drawn, member[m]),
													place_of(drawn, member[m + 1])));
		most = fmax(most, least);
	}
	return most;
}

static void
lay_row(const ty_drawn_rows *drawn, uint32_t row, piece *p, ty_placeholder *placeholders)
{
	const ty_rows *rows = drawn->rows;
	const uint32_t *member = rows->member + rows->first[row];
	uint32_t k = rows->first[row + 1] - rows->first[row];
	size_t pieces = drawn->pieces == NULL ? 0 : drawn->pieces->count;
	double bend = 0;

	p->row_members = k;
	p->member = member;
	for (uint32_t i = 0; i < k; i++)
	{
		uint32_t label = drawn->label[member[i]];
		ty_span span = rows->span[drawn->keeper[label]];

		/* a kept building does not move, so the row ends at it and begins again */
		if (span.row != row || span.first != i || placeholders[label].kept)
		{
			end_piece(drawn, p, placeholders);
			continue;
		}
		add_to_piece(drawn, label, span, p, placeholders);
		i = span.last;
	}
	end_piece(drawn, p, placeholders);
	if (drawn->pieces != NULL && drawn->pieces->count > pieces)
		bend = bend_of(drawn, row, placeholders);
	for (; drawn->pieces != NULL && pieces < drawn->pieces->count; pieces++)
		drawn->pieces->bend[pieces] = bend;
}

static uint32_t
most_members(const ty_rows *rows)
{
	uint32_t most = 1;

	for (size_t r = 0; r < rows->count; r++)
		most = rows->first[r + 1] - rows->first[r] > most ? rows->first[r + 1] - rows->first[r] : most;
	return most;
}

ty_status
ty_rows_lay_out(const ty_environment *env, const ty_drawn_rows *drawn, ty_placeholder *placeholders)
{
	uint32_t most = most_members(drawn->rows);
	piece p = {.label = ty_allocate_array(env, most, sizeof *p.label),
			   .mean = ty_allocate_array(env, most, sizeof *p.mean),
			   .along = ty_allocate_array(env, most, sizeof *p.along)};
	ty_status status = p.label != NULL && p.mean != NULL && p.along != NULL ? TY_OK : TY_NO_MEMORY;

	for (size_t row = 0; row < drawn->rows->count && status == TY_OK; row++)
	{
		lay_row(drawn, (uint32_t) row, &p, placeholders);
		if (ty_interrupted_at(env, row))
			status = TY_INTERRUPTED;
	}
	ty_release(env, p.label);
	ty_release(env, p.mean);
	ty_release(env, p.along);
	return status;
}

ty_status
ty_pieces_begin(const ty_environment *env, const ty_rows *rows, size_t placeholders, ty_site_rows *pieces)
{
	*pieces = (ty_site_rows){.first = ty_allocate_array(env, placeholders / 2 + 1, sizeof *pieces->first),
							 .site = ty_allocate_array(env, placeholders, sizeof *pieces->site),
							 .bent = ty_allocate_array(env, placeholders / 2 + 1, sizeof *pieces->bent),
							 .line = ty_allocate_array(env, rows->first[rows->count], sizeof *pieces->line),
							 .left = ty_allocate_array(env, placeholders / 2 + 1, sizeof *pieces->left),
							 .bend = ty_allocate_array(env, placeholders / 2 + 1, sizeof *pieces->bend),
							 .weight = ty_allocate_array(env, placeholders / 2 + 1, sizeof *pieces->weight),
							 .dirty = ty_allocate_array(env, placeholders / 2 + 1, sizeof *pieces->dirty),
							 .moves = ty_allocate_array(env, placeholders / 2 + 1, sizeof *pieces->moves)};
	if (pieces->first == NULL || pieces->bent == NULL || pieces->site == NULL || pieces->line == NULL ||
		pieces->left == NULL || pieces->bend == NULL || pieces->weight == NULL || pieces->dirty == NULL ||
		pieces->moves == NULL)
		return TY_NO_MEMORY;
	pieces->first[0] = pieces->bent[0] = 0;
	return TY_OK;
}

void
ty_pieces_free(const ty_environment *env, ty_site_rows *pieces)
{
	ty_release(env, pieces->first);
	ty_release(env, pieces->site);
	ty_release(env, pieces->bent);
	ty_release(env, pieces->line);
	ty_release(env, pieces->left);
	ty_release(env, pieces->bend);
	ty_release(env, pieces->weight);
	ty_release(env, pieces->dirty);
	ty_release(env, pieces->moves);
	*pieces = (ty_site_rows){0};
}
