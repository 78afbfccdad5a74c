/*
 * legibility_row.c - rows of buildings among the sites (alignment.h): they stay rows.
 *
 * A site of a row is on a rail: it may go along the row, but off its line only by a part of the gap. Of two sites in
 * each other's way the one in no row yields; of two rows the one with fewer buildings, unless the end of the other can
 * be given up. A row that is too dense by itself becomes one of fewer sites, as many as fit, evenly along the same
 * line; one whose way is barred at some place does without that place. What is left when neither helps are sites in no
 * row.
 */
#include "legibility_internal.h"

#include <math.h>

static ty_site_rows *
rows_of(const ty_ladder *l)
{
	return l->rules->rows;
}

/* ---- leaving a row ---- */

static void
set_free(ty_ladder *l, uint32_t i)
{
	ty_site *s = &l->sites[i];

	s->row = TY_NO_ROW;
	s->axis = (ty_point){0, 0};
	s->rail = 0;
	l->body[i].railed = false;
	ty_activate(l, i);
}

static void
dissolve(ty_ladder *l, uint32_t row)
{
	ty_site_rows *rows = rows_of(l);

	for (uint32_t k = rows->first[row]; k < rows->first[row + 1]; k++)
		if (rows->site[k] != TY_NO_SITE)
		{
			set_free(l, rows->site[k]);
			rows->site[k] = TY_NO_SITE;
		}
	rows->left[row] = 0;
}

void
ty_leave_row(ty_ladder *l, uint32_t i)
{
	ty_site_rows *rows = rows_of(l);
	uint32_t row = l->sites[i].row;

	if (!ty_in_row(l, i))
		return;
	rows->site[rows->first[row] + l->sites[i].place] = TY_NO_SITE;
	rows->left[row]--;
	set_free(l, i);
	if (rows->left[row] < 2)
		dissolve(l, row);
}

void
ty_dissolve_row(ty_ladder *l, uint32_t i)
{
	if (ty_in_row(l, i))
		dissolve(l, l->sites[i].row);
}

uint32_t
ty_stays_in_row(const ty_ladder *l, uint32_t a, uint32_t b)
{
	if (!ty_in_row(l, a) && !ty_in_row(l, b))
		return TY_NO_SITE;
	if (ty_in_row(l, a) && ty_in_row(l, b))
		return l->sites[a].weight < l->sites[b].weight ? b : a;
	return ty_in_row(l, a) ? a : b;
}

void
ty_take_place(ty_ladder *l, uint32_t i, const ty_site *before)
{
	ty_site *s = &l->sites[i];

	s->row = before->row;
	s->place = before->place;
	s->axis = before->axis;
	s->rail = before->rail;
	s->bend = before->bend;
	l->place[i].moved = ty_rest(s);
	s->relaid = before->relaid;
	if (ty_in_row(l, i))
		rows_of(l)->site[rows_of(l)->first[s->row] + s->place] = i;
}

/* ---- along the line ---- */

static double
distance(ty_point a, ty_point b)
{
	double dx = b.x - a.x, dy = b.y - a.y;

	return sqrt(dx * dx + dy * dy);
}

/* from each point of the row's line to the next, summed up */
static double
length_of(const ty_site_rows *rows, uint32_t row)
{
	double length = 0;

	for (uint32_t i = rows->bent[row] + 1; i < rows->bent[row + 1]; i++)
		length += distance(rows->line[i - 1], rows->line[i]);
	return length;
}

double
ty_before_end(const ty_ladder *l, uint32_t i, double along)
{
	const ty_site_rows *rows = rows_of(l);
	const ty_site *s = &l->sites[i];
	double beyond = TY_LEAST_PLAY * l->gap;

	if (!ty_in_row(l, i))
		return along;
	along = fmin(along, distance(s->home, rows->line[rows->bent[s->row + 1] - 1]) + beyond);
	return fmax(along, -distance(s->home, rows->line[rows->bent[s->row]]) - beyond);
}

/* A place on a line, and the stretch of it that it is on: from the point `at` to the next, which is `step` long. */
typedef struct ty_walk
{
	const ty_point *line;
	uint32_t points, at;
	double behind, step;
} ty_walk;

static void
walk_to(ty_walk *w, double along)
{
	while (w->at + 2 < w->points && w->behind + w->step <= along)
	{
		w->behind += w->step;
		w->at++;
		w->step = distance(w->line[w->at], w->line[w->at + 1]);
	}
}

/* The site goes to where the walk is, `along` the line. */
static ty_status
put_on_line(ty_ladder *l, uint32_t i, const ty_walk *w, double along)
{
	ty_point a = w->line[w->at], b = w->line[w->at + 1];
	double share = fmin((along - w->behind) / w->step, 1);

	l->sites[i].axis = (ty_point){(b.x - a.x) / w->step, (b.y - a.y) / w->step};
	return ty_rehome_site(l, i, (ty_point){a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)});
}

/* Lays out the sites that are left of a row evenly along its line, from end to end. */
static ty_status
lay_out(ty_ladder *l, uint32_t row)
{
	ty_site_rows *rows = rows_of(l);
	const ty_point *line = rows->line + rows->bent[row];
	ty_walk w = {line, rows->bent[row + 1] - rows->bent[row], 0, 0, distance(line[0], line[1])};
	double spacing = length_of(rows, row) / (rows->left[row] - 1);
	uint32_t next = 0;
	ty_status status = TY_OK;

	for (uint32_t k = rows->first[row]; status == TY_OK && k < rows->first[row + 1]; k++)
	{
		uint32_t i = rows->site[k];

		if (i == TY_NO_SITE)
			continue;
		walk_to(&w, spacing * next);
		if (w.step > 0)
			status = put_on_line(l, i, &w, spacing * next);
		ty_activate(l, i);
		next++;
	}
	rows->dirty[row] = false;
	return status;
}

ty_status
ty_lay_out_rows(ty_ladder *l)
{
	ty_site_rows *rows = rows_of(l);
	ty_status status = TY_OK;

	for (uint32_t row = 0; rows != NULL && status == TY_OK && row < rows->count; row++)
		if (rows->dirty[row] && rows->left[row] >= 2)
			status = lay_out(l, row);
	return status;
}

/* ---- as many as fit ---- */

/* half of what the smallest that the site may become takes up along its row */
static double
least_extent(const ty_ladder *l, uint32_t i)
{
	const ty_site *s = &l->sites[i];
	ty_oblong box = {0, 0, s->ux, s->uy, 0.5 * s->least.length, 0.5 * s->least.width};

	return ty_extent(&box, s->axis);
}

/* How much room the sites of a row need along it, from the first to the last. */
static double
room_needed(const ty_ladder *l, uint32_t row)
{
	const ty_site_rows *rows = rows_of(l);
	double needed = 0;

	for (uint32_t k = rows->first[row] + 1; k < rows->first[row + 1]; k++)
		needed += least_extent(l, rows->site[k - 1]) + least_extent(l, rows->site[k]) + l->target;
	return needed;
}

/* How much they have. */
static double
room_taken(const ty_ladder *l, uint32_t row)
{
	const ty_site_rows *rows = rows_of(l);
	double taken = 0;

	for (uint32_t k = rows->first[row] + 1; k < rows->first[row + 1]; k++)
		taken += distance(l->sites[rows->site[k - 1]].home, l->sites[rows->site[k]].home);
	return taken;
}

/* How many sites fit on the line of a row, on average as wide as they are; the ends hardly go out of it. */
static uint32_t
places_on(const ty_ladder *l, uint32_t row, double needed)
{
	const ty_site_rows *rows = rows_of(l);
	uint32_t count = rows->first[row + 1] - rows->first[row];
	double length = length_of(rows, row) + 2 * TY_LEAST_PLAY * l->gap,
		   places = floor(length * (count - 1) / needed) + 1;

	return needed > length && places < count ? (uint32_t) places : count;
}

/* Joins neighbours of a row until so many are left, with as many members each as can be. */
static ty_status
thin_row(ty_ladder *l, uint32_t row, uint32_t places)
{
	ty_site_rows *rows = rows_of(l);
	uint32_t first = rows->first[row], count = rows->first[row + 1] - first, keeper = TY_NO_SITE;
	uint64_t sum = 0, block = 0;
	ty_status status = TY_OK;

	for (uint32_t k = 0; status == TY_OK && k < count; k++)
	{
		uint32_t i = rows->site[first + k];
		uint64_t twice = 2 * sum + l->sites[i].weight, of = twice * places / (2 * rows->weight[row]);

		sum += l->sites[i].weight;
		if (keeper != TY_NO_SITE && of == block)
			status = ty_join_sites(l, keeper, i, keeper, &keeper);
		else
			keeper = i;
		block = of;
	}
	return status;
}

ty_status
ty_thin_rows(ty_ladder *l)
{
	ty_site_rows *rows = rows_of(l);
	ty_status status = TY_OK;

	for (uint32_t row = 0; rows != NULL && status == TY_OK && row < rows->count; row++)
	{
		double needed = room_needed(l, row);
		uint32_t places = places_on(l, row, needed);

		rows->dirty[row] = needed > room_taken(l, row);
		if (ty_interrupted_at(l->env, row))
			status = TY_INTERRUPTED;
		else if (places < 2)
			dissolve(l, row);
		else if (places < rows->left[row])
			status = thin_row(l, row, places);
	}
	return status == TY_OK ? ty_lay_out_rows(l) : status;
}

/* ---- conflicts ---- */

/* The nearest in its row that the site may be joined to, before or behind it; TY_NO_SITE: none. */
static uint32_t
neighbour_in_row(const ty_ladder *l, uint32_t i)
{
	const ty_site_rows *rows = rows_of(l);
	const ty_site *s = &l->sites[i];
	uint32_t first = rows->first[s->row], count = rows->first[s->row + 1] - first, best = TY_NO_SITE;

	for (uint32_t k = s->place; k-- > 0 && best == TY_NO_SITE;)
		best = rows->site[first + k];
	for (uint32_t k = s->place + 1; k < count; k++)
	{
		uint32_t j = rows->site[first + k];

		if (j == TY_NO_SITE)
			continue;
		if (best == TY_NO_SITE || distance(l->sites[j].home, s->home) < distance(l->sites[best].home, s->home))
			best = j;
		break;
	}
	return best != TY_NO_SITE && ty_may_join(l, i, best) ? best : TY_NO_SITE;
}

/* whether nobody of its row is before the site, or nobody behind */
static bool
is_end(const ty_ladder *l, uint32_t i)
{
	const ty_site_rows *rows = rows_of(l);
	const ty_site *s = &l->sites[i];
	uint32_t first = rows->first[s->row], count = rows->first[s->row + 1] - first;
	bool before = false, behind = false;

	for (uint32_t k = 0; k < s->place && !before; k++)
		before = rows->site[first + k] != TY_NO_SITE;
	for (uint32_t k = s->place + 1; k < count && !behind; k++)
		behind = rows->site[first + k] != TY_NO_SITE;
	return !before || !behind;
}

#define MOST_MOVES 6	 /* of a row as a whole */
#define LEAST_MOVE 0.01	 /* of the gap */
#define LEAST_ACROSS 0.3 /* what the push must have across the row, for the row to be moved by it */
#define MOST_BY_ROW 0.48 /* of the gap: how far from their line sites come to stand for another row */

/* How far to the left of where it is the row of the site would have to go, within its bound, to give way along n. */
static double
way_of_row(const ty_ladder *l, uint32_t i, double lack, ty_point n, double bound)
{
	const ty_site *s = &l->sites[i];
	double across = n.y * s->axis.x - n.x * s->axis.y, most = fmax(bound - ty_play(l, s) - s->bend, 0);

	if (fabs(across) < LEAST_ACROSS)
		return 0;
	return fmax(fmin(s->rail + lack / across, most), -most) - s->rail;
}

/* Moves the row as a whole. Whether it came farther. */
static bool
move_row(ty_ladder *l, uint32_t i, double lack, ty_point n, double bound)
{
	ty_site_rows *rows = rows_of(l);
	uint32_t row = l->sites[i].row;
	double way = way_of_row(l, i, lack, n, bound);

	if (rows->moves[row] >= MOST_MOVES || fabs(way) < LEAST_MOVE * l->gap)
		return false;
	rows->moves[row]++;
	for (uint32_t k = rows->first[row]; k < rows->first[row + 1]; k++)
	{
		ty_site *s;
		ty_point *moved;

		if (rows->site[k] == TY_NO_SITE)
			continue;
		s = &l->sites[rows->site[k]];
		s->rail += way;
		moved = &l->place[rows->site[k]].moved;
		*moved = (ty_point){moved->x - way * s->axis.y, moved->y + way * s->axis.x};
		ty_place_box(l, rows->site[k]);
		ty_keep_in_bound(l, rows->site[k]);
		ty_activate(l, rows->site[k]);
	}
	return true;
}

/* The row does without the site's place; or, where only two are left, it is none any more. */
static ty_status
give_up_place(ty_ladder *l, uint32_t i)
{
	uint32_t neighbour = rows_of(l)->left[l->sites[i].row] > 2 ? neighbour_in_row(l, i) : TY_NO_SITE;
	ty_status status = TY_OK;

	if (neighbour == TY_NO_SITE)
		ty_dissolve_row(l, i);
	else
	{
		status = ty_join_sites(l, i, neighbour, neighbour, &neighbour);
		ty_activate(l, neighbour);
	}
	return status;
}

/* Of two sites of different rows: which row has fewer buildings, or comes later. */
static uint32_t
of_lesser_row(const ty_ladder *l, uint32_t a, uint32_t b)
{
	const ty_site_rows *rows = rows_of(l);
	uint32_t p = l->sites[a].row, q = l->sites[b].row;

	if (rows->weight[p] != rows->weight[q])
		return rows->weight[p] < rows->weight[q] ? a : b;
	return p > q ? a : b;
}

static ty_status
part_rows(ty_ladder *l, uint32_t a, uint32_t b)
{
	const ty_site_rows *rows = rows_of(l);
	uint32_t lesser = of_lesser_row(l, a, b), greater = lesser == a ? b : a;
	ty_point n;
	double lack = ty_sites_lack(l, a, b, &n);

	if (!ty_is_conflict(l, lack) ||
		move_row(l, lesser, lack, lesser == b ? n : (ty_point){-n.x, -n.y}, MOST_BY_ROW * l->gap))
		return TY_OK;
	if (rows->left[l->sites[lesser].row] > 2 && is_end(l, lesser))
		return give_up_place(l, lesser);
	if (rows->left[l->sites[greater].row] > 2 && is_end(l, greater))
		return give_up_place(l, greater);
	ty_dissolve_row(l, lesser);
	return TY_OK;
}

static ty_status
join_in_row(ty_ladder *l, uint32_t a, uint32_t b)
{
	uint32_t row = l->sites[a].row, kept;
	ty_status status = ty_join_sites(l, a, b, TY_NO_SITE, &kept);

	rows_of(l)->dirty[row] = true;
	ty_activate(l, kept);
	return status;
}

/* The site is too near to a line. */
static ty_status
give_way_to_line(ty_ladder *l, uint32_t i)
{
	ty_status status = ty_recall_lines(l, i);
	ty_point n;
	double lack;

	if (status != TY_OK)
		return status;
	if (ty_is_across(l, i))
		return give_up_place(l, i);
	lack = ty_line_lack(l, i, &n);
	return !ty_is_line_conflict(l, lack) || move_row(l, i, lack, n, ty_free_way(l, i)) ? TY_OK : give_up_place(l, i);
}

/* The site is too near to a fixed one. */
static ty_status
give_way(ty_ladder *l, uint32_t i, uint32_t to)
{
	ty_point n;
	double lack = ty_sites_lack(l, to, i, &n);

	return !ty_is_conflict(l, lack) || move_row(l, i, lack, n, ty_free_way(l, i)) ? TY_OK : give_up_place(l, i);
}

bool
ty_resolve_rows(ty_ladder *l, uint32_t a, uint32_t b, ty_status *status)
{
	*status = TY_OK;
	if (!ty_in_row(l, a) && !ty_in_row(l, b))
		return false;
	if (a != b && ty_in_row(l, a) && ty_in_row(l, b))
		*status = l->sites[a].row == l->sites[b].row ? join_in_row(l, a, b) : part_rows(l, a, b);
	else if (a == b)
		*status = give_way_to_line(l, a);
	else if (l->sites[ty_in_row(l, a) ? b : a].fixed)
		*status = give_way(l, ty_in_row(l, a) ? a : b, ty_in_row(l, a) ? b : a);
	else
		return false;
	return true;
}
