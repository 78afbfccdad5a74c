/*
 * legibility.c - see legibility.h.
 *
 * The ladder of spec 4.4. What finds no room between lines is joined first (legibility_cell.c). Sites that may be in a
 * conflict are active. In rounds (legibility_settle.c) every active site looks at who is near: growth is taken back,
 * then both are pushed apart, each by at most its bound; what is left over is tried again with sizes below the true
 * one. Of what no round has settled the worst conflicts, one in a neighbourhood, are resolved by joining the two, and
 * everything around is looked at again. Every time there is one site less to be in a conflict, so it ends. Where sites
 * are not joined (a layer whose groups have been made legible before) one of the two is hidden; two of one group go
 * back to where they came from, where they were apart. Where there are lines a site is joined to one on its side; if
 * there is none, its members go to the nearest across. At the end, what was moved or shrunk but need not have been is
 * put back as far as there is room.
 */
#include "legibility_internal.h"

#include <float.h>
#include <math.h>
#include <string.h>

#define SLACK 0.01		  /* of the gap: what is aimed at beyond it, so that pushing comes to an end */
#define ROUNDING_STEPS 16 /* units in the last place of coordinates and sides: what drawing may round away */
/*
 * Rounds of pushing before the next step of the ladder, and half as many below true size. More leave more sites: of a
 * million buildings three and two 2 % more than two and one, in a tenth more time. So few sites have more of them; and
 * where none are joined, since there each that finds no room is lost from the map.
 */
#define LEAST_ROUNDS 2
#define MOST_ROUNDS 8
#define BY_LINES 2 /* times as many where there are lines: what has no room is gone by then, and rounds cost little */
#define PATIENCE 262144 /* sites that are looked at in those rounds, but for the least and the most */
#define NEAR_EACH 32	/* sites that are kept in mind; one in a town has 20 near it, of which 2 are in its way */
#define LINES_EACH 80	/* two for a segment that is kept in mind; in a town with all its ways there are 20 in reach */
#define SQUARE 2		/* times as wide as what a site takes up: neighbours are mostly found in nine squares */

/* ---- sites ---- */

static double
between(double least, double own, double full, double size)
{
	return size > 1 ? own + (full - own) * (size - 1) : least + (own - least) * size;
}

ty_sides
ty_site_sides(const ty_site *s)
{
	if (s->size >= 2)
		return s->full;
	return (ty_sides){between(s->least.width, s->own.width, s->full.width, s->size),
					  between(s->least.length, s->own.length, s->full.length, s->size)};
}

/* half the diagonal */
static double
half_diagonal(ty_sides sides)
{
	return 0.5 * sqrt(sides.width * sides.width + sides.length * sides.length);
}

/* how much of its shift a site of this length has */
static double
share_of_shift(const ty_site *s, double length)
{
	return s->size >= 2 || !(s->full.length > 0) ? 1 : length / s->full.length;
}

ty_point
ty_site_centre(const ty_site *s)
{
	double factor = share_of_shift(s, ty_site_sides(s).length);

	return (ty_point){s->home.x + s->moved.x + factor * s->shift.x, s->home.y + s->moved.y + factor * s->shift.y};
}

void
ty_place_box(ty_ladder *l, uint32_t i)
{
	const ty_site *s = &l->sites[i];
	ty_sides sides = ty_site_sides(s);
	bool shifted = s->shift.x != 0 || s->shift.y != 0;
	double factor = shifted ? share_of_shift(s, sides.length) : 0;
	const ty_place *p = &l->place[i];
	ty_oblong box = {p->home.x + p->moved.x + factor * s->shift.x,
					 p->home.y + p->moved.y + factor * s->shift.y,
					 s->ux,
					 s->uy,
					 0.5 * sides.length,
					 0.5 * sides.width};

	l->body[i] = (ty_body){.box = box,
						   .radius = half_diagonal(sides),
						   .drawn = s->state == TY_DRAWN,
						   .fixed = s->fixed,
						   .shifted = shifted,
						   .railed = ty_on_rail(s),
						   .stages = (uint8_t) (s->size > 1 ? 2 : s->size > 0)};
}

void
ty_move_box(ty_ladder *l, uint32_t i)
{
	const ty_place *p = &l->place[i];

	if (l->body[i].shifted)
	{
		ty_place_box(l, i);
		return;
	}
	l->body[i].clear = false;
	l->body[i].box.x = p->home.x + p->moved.x;
	l->body[i].box.y = p->home.y + p->moved.y;
}

/* how far from home any of the site can come to lie, and half of the target */
static double
reach_of(const ty_ladder *l, uint32_t i)
{
	const ty_site *s = &l->sites[i];
	double bound = s->fixed ? 0 : fmax(ty_free_way(l, i), 0.5 * fmax(s->full.length, s->full.width));

	return half_diagonal(s->full) + sqrt(s->shift.x * s->shift.x + s->shift.y * s->shift.y) + bound + 0.5 * l->target;
}

static void
remove_home(ty_ladder *l, uint32_t i)
{
	if (l->homes.env != NULL && !(l->near.discs[i].radius < 0))
		ty_squares_remove(&l->homes, i);
}

ty_status
ty_enter_site(ty_ladder *l, uint32_t i)
{
	const ty_site *s = &l->sites[i];
	double reach;
	ty_status status;

	l->place[i].home = (ty_point){s->home.x - l->origin.x, s->home.y - l->origin.y};
	ty_place_box(l, i);
	l->by_line[i] = false;
	reach = reach_of(l, i);
	l->by_line[i] = true; /* which has a longer way, off the line */
	status = l->unmet ? TY_OK : ty_meet_lines(l, i, reach, reach_of(l, i));
	remove_home(l, i);
	ty_vicinity_insert(&l->near, i, l->place[i].home, reach_of(l, i));
	if (l->homes.env != NULL)
		ty_squares_insert(&l->homes, i, l->place[i].home);
	ty_keep_in_bound(l, i); /* its row may have been moved farther than this one may be */
	return status;
}

void
ty_remove_site(ty_ladder *l, uint32_t i)
{
	remove_home(l, i);
	ty_vicinity_remove(&l->near, i);
}

void
ty_hide_site(ty_ladder *l, uint32_t i)
{
	l->sites[i].state = TY_HIDDEN;
	l->body[i].drawn = false;
	ty_remove_site(l, i);
}

/* What is known to be near others that the site may touch now is no longer all. */
static ty_status
forget_near(ty_ladder *l, uint32_t i)
{
	const ty_disc *disc = &l->near.discs[i];
	ty_status status;

	if (l->near_of.used == 0)
		return TY_OK;
	status = ty_vicinity_find(&l->near, i, (ty_point){disc->x, disc->y}, disc->radius);
	ty_lists_forget(&l->near_of, i);
	for (size_t m = 0; status == TY_OK && m < l->near.found_count; m++)
		ty_lists_forget(&l->near_of, l->near.found[m]);
	return status;
}

ty_status
ty_join_sites(ty_ladder *l, uint32_t a, uint32_t b, uint32_t in_place, uint32_t *kept)
{
	uint32_t gone = a < b ? b : a, stays = in_place == TY_NO_SITE ? ty_stays_in_row(l, a, b) : in_place;
	ty_site before = {.row = TY_NO_ROW};
	ty_status status;

	*kept = a < b ? a : b;
	ty_remove_site(l, a);
	ty_remove_site(l, b);
	if (stays != TY_NO_SITE)
	{
		ty_leave_row(l, stays == a ? b : a);
		before = l->sites[stays];
	}
	status = l->rules->join(l->rules->context, *kept, gone, stays, &l->sites[*kept]);
	ty_take_place(l, *kept, &before);
	l->sites[gone].state = TY_JOINED;
	l->sites[gone].into = *kept;
	l->body[gone].drawn = false;
	l->start[*kept] = (ty_point){0, 0};
	l->start_size[*kept] = 2;
	if (status == TY_OK)
		status = ty_enter_site(l, *kept);
	return status == TY_OK ? forget_near(l, *kept) : status;
}

ty_status
ty_rehome_site(ty_ladder *l, uint32_t i, ty_point home)
{
	ty_status status;

	ty_remove_site(l, i);
	l->sites[i].home = home;
	l->place[i].moved = l->start[i] = ty_rest(&l->sites[i]);
	l->sites[i].relaid = true;
	status = ty_enter_site(l, i);
	return status == TY_OK ? forget_near(l, i) : status;
}

/*
 * What was found is kept: as long as no disc comes to touch the site's own, it stays true, for discs are about homes
 * and hold all that can be reached from there.
 */
ty_status
ty_find_near(ty_ladder *l, uint32_t i)
{
	const uint32_t *list = ty_lists_get(&l->near_of, i);

	if (list == NULL)
	{
		ty_status status = ty_vicinity_find_touching(&l->near, i);

		if (status != TY_OK)
			return status;
		list = ty_lists_keep(&l->near_of, i, l->near.found, l->near.found_count);
	}
	l->list = list == NULL ? l->near.found : list + 1;
	l->list_count = list == NULL ? l->near.found_count : list[0];
	return l->by_line[i] ? ty_recall_lines(l, i) : TY_OK;
}

void
ty_activate(ty_ladder *l, uint32_t i)
{
	if (l->listed[i])
		return;
	l->listed[i] = true;
	l->next[l->next_count++] = i;
}

/* What stands in next becomes active. */
void
ty_next_round(ty_ladder *l)
{
	uint32_t *swap = l->active;

	l->active = l->next;
	l->active_count = l->next_count;
	l->next = swap;
	l->next_count = 0;
	for (size_t k = 0; k < l->active_count; k++)
		l->listed[l->active[k]] = false;
}

/* ---- the ladder ---- */

void
ty_activate_all(ty_ladder *l)
{
	ty_next_round(l);
	for (size_t i = 0; i < l->n; i++)
		if (l->sites[i].state == TY_DRAWN)
		{
			l->body[i].clear = false;
			ty_activate(l, (uint32_t) i);
		}
	ty_next_round(l);
}

static int
rounds_to_settle(const ty_ladder *l)
{
	size_t rounds = PATIENCE / (l->active_count + 1);

	rounds = rounds < LEAST_ROUNDS ? LEAST_ROUNDS : rounds;
	rounds *= l->rules->lines == NULL ? 1 : BY_LINES;
	return l->rules->join == NULL || rounds > MOST_ROUNDS ? MOST_ROUNDS : (int) rounds;
}

/* Until no active site is in a conflict. */
static ty_status
climb(ty_ladder *l, uint8_t *touched)
{
	ty_status status = TY_OK;

	while (status == TY_OK && l->active_count > 0)
	{
		int rounds = rounds_to_settle(l);

		status = ty_settle(l, rounds, false);
		if (status == TY_OK)
			status = ty_settle(l, rounds / 2, true);
		if (status == TY_OK)
			status = ty_collect_conflicts(l);
		if (status != TY_OK || l->conflict_count == 0)
			break;
		status = ty_resolve_worst(l, touched);
		ty_vicinity_fit(&l->near);
		ty_next_round(l);
	}
	return status;
}

/* Tells of fixed sites that are too near to each other, or to a line. */
static ty_status
tell_collisions(ty_ladder *l)
{
	ty_status status = TY_OK;

	for (uint32_t i = 0; status == TY_OK && l->rules->collide != NULL && i < l->n; i++)
	{
		if (!ty_is_drawn(l, i) || !l->sites[i].fixed)
			continue;
		if (ty_fixed_by_line(l, i))
			l->rules->collide(l->rules->context, i, i);
		status = ty_find_near(l, i);
		for (size_t m = 0; status == TY_OK && m < l->list_count; m++)
		{
			uint32_t j = l->list[m];
			ty_point away;

			if (j > i && ty_is_drawn(l, j) && l->sites[j].fixed &&
				ty_is_conflict(l, ty_lack(&l->body[i].box, &l->body[j].box, l->target, &away)))
				l->rules->collide(l->rules->context, i, j);
		}
	}
	return status;
}

/* Everything is looked at once more in the end: what is promised does not hang on what was active. */
static ty_status
run(ty_ladder *l)
{
	uint8_t *touched = ty_allocate_array(l->env, l->n, sizeof *touched);
	ty_status status = touched == NULL ? TY_NO_MEMORY : ty_thin_rows(l);

	if (touched != NULL)
		memset(touched, 0, l->n * sizeof *touched);
	if (status == TY_OK)
		status = ty_thin_out(l);
	if (status == TY_OK)
		status = ty_thin_cells(l);
	for (bool again = true, relented = false; status == TY_OK && again;)
	{
		ty_activate_all(l);
		status = climb(l, touched);
		if (status == TY_OK && !relented)
			status = ty_relent(l);
		relented = true;
		ty_activate_all(l);
		if (status == TY_OK)
			status = ty_collect_conflicts(l);
		again = l->conflict_count > 0;
	}
	ty_release(l->env, touched);
	return status;
}

void
ty_note_collision(ty_collisions *collisions, uint32_t a, uint32_t b)
{
	if (a == b)
	{
		if (collisions->beside_lines++ == 0)
			collisions->first_beside = a;
	}
	else if (collisions->pairs++ == 0)
	{
		collisions->first_pair[0] = a;
		collisions->first_pair[1] = b;
	}
}

/* ---- set-up ---- */

static ty_status
allocate_ladder(ty_ladder *l)
{
	ty_status status = ty_lists_begin(l->env, l->n, NEAR_EACH, &l->near_of);

	if (status == TY_OK && l->rules->lines != NULL)
		status = ty_lists_begin(l->env, l->n, LINES_EACH, &l->lines_of);
	l->conflict_capacity = 256;
	l->body_memory = ty_allocate_array(l->env, l->n + 1, sizeof *l->body);
	l->place = ty_allocate_array(l->env, l->n, sizeof *l->place);
	l->start = ty_allocate_array(l->env, l->n, sizeof *l->start);
	l->start_size = ty_allocate_array(l->env, l->n, sizeof *l->start_size);
	l->frozen = ty_allocate_array(l->env, l->n, sizeof *l->frozen);
	l->active = ty_allocate_array(l->env, l->n, sizeof *l->active);
	l->by_line = ty_allocate_array(l->env, l->n, sizeof *l->by_line);
	l->next = ty_allocate_array(l->env, l->n, sizeof *l->next);
	l->listed = ty_allocate_array(l->env, l->n, sizeof *l->listed);
	l->degree = ty_allocate_array(l->env, l->n, sizeof *l->degree);
	l->conflicts = ty_allocate_array(l->env, l->conflict_capacity, sizeof *l->conflicts);
	if (l->body_memory == NULL || l->place == NULL || l->start == NULL || l->start_size == NULL || l->frozen == NULL ||
		l->active == NULL || l->next == NULL || l->by_line == NULL || l->listed == NULL || l->degree == NULL ||
		l->conflicts == NULL)
		return TY_NO_MEMORY;
	l->body = (ty_body *) (((uintptr_t) l->body_memory + sizeof *l->body - 1) / sizeof *l->body * sizeof *l->body);
	memset(l->frozen, 0, l->n * sizeof *l->frozen);
	memset(l->degree, 0, l->n * sizeof *l->degree);
	memset(l->listed, 0, l->n * sizeof *l->listed);
	return status;
}

static void
free_ladder(ty_ladder *l)
{
	ty_vicinity_free(&l->near);
	ty_squares_free(&l->homes);
	ty_release(l->env, l->body_memory);
	ty_release(l->env, l->place);
	ty_release(l->env, l->start);
	ty_release(l->env, l->start_size);
	ty_release(l->env, l->frozen);
	ty_release(l->env, l->active);
	ty_release(l->env, l->by_line);
	ty_lists_free(&l->near_of);
	ty_lists_free(&l->lines_of);
	ty_release(l->env, l->segments.number);
	ty_release(l->env, l->segments.distance);
	ty_release(l->env, l->asking.heap);
	ty_surroundings_free(&l->around);
	ty_release(l->env, l->next);
	ty_release(l->env, l->listed);
	ty_release(l->env, l->degree);
	ty_release(l->env, l->conflicts);
}

/* Where the sites that are drawn begin, and with what room for rounding. TY_NOT_FINITE: of what no map is made. */
static ty_status
measure_sites(ty_ladder *l)
{
	double largest = 0, place = 0, rounding;

	l->origin = (ty_point){INFINITY, INFINITY};
	for (size_t i = 0; i < l->n; i++)
	{
		const ty_site *s = &l->sites[i];

		if (s->state != TY_DRAWN)
			continue;
		largest = fmax(largest, half_diagonal(s->full));
		l->origin = (ty_point){fmin(l->origin.x, s->home.x), fmin(l->origin.y, s->home.y)};
		place = fmax(place, fmax(fabs(s->home.x), fabs(s->home.y)));
	}
	rounding = ROUNDING_STEPS * DBL_EPSILON * (place + largest);
	l->gap = l->rules->gap * (1 + 1e-9) + rounding;
	l->target = l->gap * (1 + SLACK);
	if (l->rules->lines != NULL)
	{
		l->line_gap = l->rules->line_gap * (1 + 1e-9) + rounding;
		l->line_target = l->line_gap * (1 + SLACK);
	}
	return isfinite(4 * (place + largest + l->target)) ? TY_OK : TY_NOT_FINITE;
}

/* of the sites as small as they may become: the square of the mean square root, which one giant does not matter to */
static double
usual_length(const ty_ladder *l)
{
	double sum = 0, mean;
	size_t count = 0;

	for (size_t i = 0; i < l->n; i++)
		if (l->sites[i].state == TY_DRAWN)
		{
			sum += sqrt(l->sites[i].least.length);
			count++;
		}
	mean = sum / (double) count;
	return mean * mean;
}

static ty_status
enter_all(ty_ladder *l)
{
	ty_status status = measure_sites(l);

	l->unmet = l->rules->lines != NULL && l->rules->join != NULL;
	if (status == TY_OK)
		status = ty_vicinity_begin(l->env, l->n, &l->near);
	if (status == TY_OK && l->unmet)
	{
		double length = usual_length(l);

		ty_surroundings_begin(l->rules->lines, length + l->line_gap + l->line_target, &l->around);
		status = ty_squares_begin(l->env, l->n, SQUARE * (length + l->target), &l->homes);
	}
	for (size_t i = 0; status == TY_OK && i < l->n; i++)
	{
		l->start[i] = l->place[i].moved = l->sites[i].moved;
		l->start_size[i] = l->sites[i].size;
		l->body[i].drawn = false;
		if (l->sites[i].state == TY_DRAWN)
			status = ty_enter_site(l, (uint32_t) i);
	}
	return status;
}

/* What the rules' caller is told of where sites have come to stand. */
static void
return_places(ty_ladder *l)
{
	for (size_t i = 0; i < l->n; i++)
		l->sites[i].moved = l->place[i].moved;
}

static size_t
count_drawn(const ty_site *sites, size_t n)
{
	size_t drawn = 0;

	for (size_t i = 0; i < n; i++)
		drawn += sites[i].state == TY_DRAWN;
	return drawn;
}

ty_status
ty_make_legible(const ty_environment *env, const ty_legibility *rules, ty_site *sites, size_t n)
{
	ty_ladder l = {.env = env, .rules = rules, .sites = sites, .n = n};
	ty_status status;

	if (n > UINT32_MAX - 1)
		return TY_TOO_MANY;
	if (count_drawn(sites, n) < (rules->lines == NULL ? 2 : 1))
		return TY_OK;
	status = allocate_ladder(&l);
	if (status == TY_OK)
		status = enter_all(&l);
	if (status == TY_OK)
		status = run(&l);
	if (status == TY_OK)
		status = tell_collisions(&l);
	if (status == TY_OK)
		return_places(&l);
	free_ladder(&l);
	return status;
}
