/*
 * legibility.c - see legibility.h.
 *
 * The ladder of spec 4.4. Sites that may be in a conflict are active. In rounds (legibility_settle.c) every active
 * site looks at who is near: growth is taken back, then both are pushed apart, each by at most its bound; what is
 * left over is tried again with sizes below the true one. Of what no round has settled the worst conflicts, one in
 * a neighbourhood, are resolved by joining the two, and everything around is looked at again. Every time there is
 * one site less to be in a conflict, so it ends. Where sites are not joined (a layer whose groups have been made
 * legible before) one of the two is hidden; two of one group go back to where they came from, where they were apart.
 * Where there are lines a site is joined to one on its side; if there is none, its members go to the nearest across.
 * At the end, what was moved or shrunk but need not have been is put back as far as there is room.
 */
#include "legibility_internal.h"

#include "grid.h"

#include <float.h>
#include <math.h>
#include <string.h>

#define SLACK 0.01		  /* of the gap: what is aimed at beyond it, so that pushing comes to an end */
#define ROUNDING_STEPS 16 /* units in the last place of coordinates and sides: what drawing may round away */
#define ROUNDS 8		  /* of pushing before the next step of the ladder; three times as many save 1 % more sites */
#define POOL_PER_SITE 32  /* numbers; a site in a town has 20 near it, of which 2 are in its way */
#define NOT_CACHED UINT32_MAX

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

ty_point
ty_site_centre(const ty_site *s)
{
	double factor = s->size >= 2 || !(s->full.length > 0) ? 1 : ty_site_sides(s).length / s->full.length;

	return (ty_point){s->home.x + s->moved.x + factor * s->shift.x, s->home.y + s->moved.y + factor * s->shift.y};
}

void
ty_place_box(ty_ladder *l, uint32_t i)
{
	const ty_site *s = &l->sites[i];
	ty_sides sides = ty_site_sides(s);
	double factor = s->size >= 2 || !(s->full.length > 0) ? 1 : sides.length / s->full.length;

	l->box[i] = (ty_oblong){s->home.x - l->origin.x + s->moved.x + factor * s->shift.x,
							s->home.y - l->origin.y + s->moved.y + factor * s->shift.y,
							s->ux,
							s->uy,
							0.5 * sides.length,
							0.5 * sides.width};
	l->radius[i] = half_diagonal(sides);
}

/* how far from home any of the site can come to lie, and half of the target */
static double
reach_of(const ty_ladder *l, uint32_t i)
{
	const ty_site *s = &l->sites[i];
	double bound = s->fixed ? 0 : fmax(ty_free_way(l, i), 0.5 * fmax(s->full.length, s->full.width));

	return half_diagonal(s->full) + sqrt(s->shift.x * s->shift.x + s->shift.y * s->shift.y) + bound + 0.5 * l->target;
}

void
ty_enter_site(ty_ladder *l, uint32_t i)
{
	const ty_site *s = &l->sites[i];

	ty_place_box(l, i);
	l->by_line[i] = false;
	l->by_line[i] = ty_line_in_reach(l, i, reach_of(l, i));
	ty_vicinity_insert(&l->near, i, (ty_point){s->home.x - l->origin.x, s->home.y - l->origin.y}, reach_of(l, i));
}

void
ty_hide_site(ty_ladder *l, uint32_t i)
{
	l->sites[i].state = TY_HIDDEN;
	ty_vicinity_remove(&l->near, i);
}

/*
 * Keeps what was found near the site: as long as no disc comes to touch its own, it stays true, for discs are about
 * homes and hold all that can be reached from there. A full pool is emptied. False: there is more than the pool holds.
 */
static bool
cache(ty_ladder *l, uint32_t i)
{
	size_t count = l->near.found_count;

	if (l->pool_count + count + 1 > l->pool_capacity)
	{
		memset(l->cached, 0xff, l->n * sizeof *l->cached);
		l->pool_count = 0;
	}
	if (count + 1 > l->pool_capacity)
		return false;
	l->cached[i] = (uint32_t) l->pool_count;
	l->pool[l->pool_count] = (uint32_t) count;
	memcpy(l->pool + l->pool_count + 1, l->near.found, count * sizeof *l->pool);
	l->pool_count += count + 1;
	return true;
}

/* What is known to be near others that the site may touch now is no longer all. */
static ty_status
forget_near(ty_ladder *l, uint32_t i)
{
	const ty_disc *disc = &l->near.discs[i];
	ty_status status;

	if (l->pool_count == 0)
		return TY_OK;
	status = ty_vicinity_find(&l->near, i, (ty_point){disc->x, disc->y}, disc->radius);
	l->cached[i] = NOT_CACHED;
	for (size_t m = 0; status == TY_OK && m < l->near.found_count; m++)
		l->cached[l->near.found[m]] = NOT_CACHED;
	return status;
}

ty_status
ty_join_sites(ty_ladder *l, uint32_t a, uint32_t b, uint32_t in_place, uint32_t *kept)
{
	uint32_t gone = a < b ? b : a, stays = in_place == TY_NO_SITE ? ty_stays_in_row(l, a, b) : in_place;
	ty_site before = {.row = TY_NO_ROW};
	ty_status status;

	*kept = a < b ? a : b;
	ty_vicinity_remove(&l->near, a);
	ty_vicinity_remove(&l->near, b);
	if (stays != TY_NO_SITE)
	{
		ty_leave_row(l, stays == a ? b : a);
		before = l->sites[stays];
	}
	status = l->rules->join(l->rules->context, *kept, gone, stays, &l->sites[*kept]);
	ty_take_place(l, *kept, &before);
	l->sites[gone].state = TY_JOINED;
	l->sites[gone].into = *kept;
	l->start[*kept] = (ty_point){0, 0};
	l->start_size[*kept] = 2;
	ty_enter_site(l, *kept);
	return status == TY_OK ? forget_near(l, *kept) : status;
}

ty_status
ty_rehome_site(ty_ladder *l, uint32_t i, ty_point home)
{
	ty_vicinity_remove(&l->near, i);
	l->sites[i].home = home;
	l->sites[i].moved = l->start[i] = ty_rest(&l->sites[i]);
	l->sites[i].relaid = true;
	ty_enter_site(l, i);
	return forget_near(l, i);
}

ty_status
ty_find_near(ty_ladder *l, uint32_t i)
{
	const ty_disc *disc = &l->near.discs[i];
	ty_status status = TY_OK;

	if (l->cached[i] == NOT_CACHED)
	{
		status = ty_vicinity_find(&l->near, i, (ty_point){disc->x, disc->y}, disc->radius);
		if (status != TY_OK || !cache(l, i))
		{
			l->list = l->near.found;
			l->list_count = l->near.found_count;
			return status;
		}
	}
	l->list = l->pool + l->cached[i] + 1;
	l->list_count = l->pool[l->cached[i]];
	return TY_OK;
}

double
ty_sites_lack(const ty_ladder *l, uint32_t a, uint32_t b, ty_point *away)
{
	double dx = l->box[b].x - l->box[a].x, dy = l->box[b].y - l->box[a].y;
	double reach = l->radius[a] + l->radius[b] + l->target;

	if (dx * dx + dy * dy > reach * reach || !ty_is_drawn(l, a) || !ty_is_drawn(l, b) ||
		(l->sites[a].fixed && l->sites[b].fixed))
		return 0;
	return ty_lack(&l->box[a], &l->box[b], l->target, away);
}

void
ty_activate(ty_ladder *l, uint32_t i)
{
	if (l->listed[i])
		return;
	l->listed[i] = true;
	l->next[l->next_count++] = i;
}

/* ---- conflicts that no round has settled ---- */

static ty_status
note_conflict(ty_ladder *l, uint32_t a, uint32_t b, double lack)
{
	if (l->conflict_count == l->conflict_capacity)
	{
		size_t capacity = 2 * l->conflict_capacity;
		ty_conflict *conflicts = ty_reallocate_array(l->env, l->conflicts, capacity, sizeof *conflicts);

		if (conflicts == NULL)
			return TY_NO_MEMORY;
		l->conflicts = conflicts;
		l->conflict_capacity = capacity;
	}
	l->conflicts[l->conflict_count++] = (ty_conflict){a, b, lack};
	return TY_OK;
}

/* The conflicts of one active site; of two active sites the smaller lists theirs. */
static ty_status
collect_of_site(ty_ladder *l, uint32_t i)
{
	ty_point away;
	double lack = ty_line_lack(l, i, &away);
	ty_status status = ty_find_near(l, i);

	if (status == TY_OK && (ty_is_line_conflict(l, lack) || ty_is_across(l, i)))
		status = note_conflict(l, i, i, lack);
	for (size_t m = 0; status == TY_OK && m < l->list_count; m++)
	{
		uint32_t j = l->list[m];

		lack = l->listed[j] && j < i ? 0 : ty_sites_lack(l, i < j ? i : j, i < j ? j : i, &away);
		if (ty_is_conflict(l, lack))
			status = note_conflict(l, i < j ? i : j, i < j ? j : i, lack);
	}
	return status;
}

/* The conflicts of the active sites, each once. */
static ty_status
collect_conflicts(ty_ladder *l)
{
	ty_status status = TY_OK;

	l->conflict_count = 0;
	for (size_t k = 0; k < l->active_count; k++)
		l->listed[l->active[k]] = true;
	for (size_t k = 0; status == TY_OK && k < l->active_count; k++)
	{
		if (ty_interrupted_at(l->env, k))
			status = TY_INTERRUPTED;
		else if (ty_is_drawn(l, l->active[k]))
			status = collect_of_site(l, l->active[k]);
	}
	for (size_t k = 0; k < l->active_count; k++)
		l->listed[l->active[k]] = false;
	return status;
}

/* Lists the conflicts by what they lack, the worst first. */
static ty_status
sort_conflicts(ty_ladder *l, uint32_t *order)
{
	uint64_t *keys = ty_allocate_array(l->env, l->conflict_count, sizeof *keys);
	ty_status status = TY_NO_MEMORY;

	if (keys != NULL)
	{
		for (size_t k = 0; k < l->conflict_count; k++)
		{
			memcpy(&keys[k], &l->conflicts[k].lack, sizeof *keys);
			keys[k] = ~keys[k];
			order[k] = (uint32_t) k;
		}
		status = ty_sort_keys(l->env, keys, order, l->conflict_count);
	}
	ty_release(l->env, keys);
	return status;
}

/* Back to where it came from, and not to move again. */
static void
freeze(ty_ladder *l, uint32_t i)
{
	l->frozen[i] = true;
	l->sites[i].moved = l->start[i];
	l->sites[i].size = fmin(l->sites[i].size, l->start_size[i]);
	ty_place_box(l, i);
}

/* Which of two goes where one has to: not the fixed one, not one of a row, the one with more conflicts, the lighter, the later. */
static uint32_t
lesser(const ty_ladder *l, uint32_t a, uint32_t b)
{
	const ty_site *s = &l->sites[a], *t = &l->sites[b];

	if (s->fixed != t->fixed)
		return s->fixed ? b : a;
	if (ty_on_rail(s) != ty_on_rail(t))
		return ty_on_rail(s) ? b : a;
	if (l->degree[a] != l->degree[b])
		return l->degree[a] > l->degree[b] ? a : b;
	return s->weight < t->weight ? a : b;
}

/* Joins the site to its nearest neighbour on its side of the lines or, if it has none there, across. */
static ty_status
join_nearest(ty_ladder *l, uint32_t i)
{
	uint32_t nearest, kept;
	bool across;
	ty_status status = ty_nearest_site(l, i, &nearest, &across);

	if (status == TY_OK && nearest != TY_NO_SITE)
	{
		status = ty_join_sites(l, i, nearest, across ? nearest : TY_NO_SITE, &kept);
		ty_activate(l, kept);
	}
	else if (status == TY_OK)
		ty_hide_site(l, i);
	return status;
}

/* A conflict of two sites, or of one with a line (a and b are the same). */
static ty_status
resolve(ty_ladder *l, uint32_t a, uint32_t b)
{
	uint32_t goes = a == b ? a : lesser(l, a, b);
	ty_status status;

	if (ty_resolve_rows(l, a, b, &status))
		return status;
	if (l->rules->join == NULL)
	{
		if (l->sites[a].group == l->sites[b].group && !(l->frozen[a] && l->frozen[b]))
		{
			freeze(l, a);
			freeze(l, b);
		}
		else
			ty_hide_site(l, goes);
		return TY_OK;
	}
	if (a != b && ty_may_join(l, a, b))
	{
		status = ty_join_sites(l, a, b, TY_NO_SITE, &goes);
		ty_activate(l, goes);
		return status;
	}
	return join_nearest(l, goes);
}

/* What is done to the sites of conflicts in one go. */
typedef enum touch
{
	UNTOUCHED = 0,
	WAITING, /* in a conflict with one that was resolved: that may have helped */
	RESOLVED
} touch;

static ty_status
resolve_in_order(ty_ladder *l, const uint32_t *order, uint8_t *touched)
{
	ty_status status = TY_OK;

	for (size_t k = 0; status == TY_OK && k < l->conflict_count; k++)
	{
		const ty_conflict *c = &l->conflicts[order[k]];

		if (touched[c->a] == UNTOUCHED && touched[c->b] == UNTOUCHED)
		{
			if (ty_is_drawn(l, c->a) && ty_is_drawn(l, c->b))
				status = resolve(l, c->a, c->b);
			touched[c->a] = touched[c->b] = RESOLVED;
		}
		else if (touched[c->a] == RESOLVED && touched[c->b] == UNTOUCHED)
			touched[c->b] = WAITING;
		else if (touched[c->b] == RESOLVED && touched[c->a] == UNTOUCHED)
			touched[c->a] = WAITING;
	}
	return status;
}

/* Resolves the worst conflict of every neighbourhood. What is active next is everybody who is in a conflict. */
static ty_status
resolve_worst(ty_ladder *l, uint8_t *touched)
{
	uint32_t *order = ty_allocate_array(l->env, l->conflict_count, sizeof *order);
	ty_status status = order == NULL ? TY_NO_MEMORY : sort_conflicts(l, order);

	l->next_count = 0;
	for (size_t k = 0; k < l->conflict_count; k++)
	{
		ty_activate(l, l->conflicts[k].a);
		ty_activate(l, l->conflicts[k].b);
		l->degree[l->conflicts[k].a]++;
		l->degree[l->conflicts[k].b]++;
	}
	if (status == TY_OK)
		status = resolve_in_order(l, order, touched);
	if (status == TY_OK)
		status = ty_lay_out_rows(l);
	for (size_t k = 0; k < l->conflict_count; k++)
	{
		touched[l->conflicts[k].a] = touched[l->conflicts[k].b] = UNTOUCHED;
		l->degree[l->conflicts[k].a] = l->degree[l->conflicts[k].b] = 0;
	}
	ty_release(l->env, order);
	return status;
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

static void
activate_all(ty_ladder *l)
{
	ty_next_round(l);
	for (size_t i = 0; i < l->n; i++)
		if (l->sites[i].state == TY_DRAWN)
			ty_activate(l, (uint32_t) i);
	ty_next_round(l);
}

/* Until no active site is in a conflict. */
static ty_status
climb(ty_ladder *l, uint8_t *touched)
{
	ty_status status = TY_OK;

	while (status == TY_OK && l->active_count > 0)
	{
		status = ty_settle(l, ROUNDS, false);
		if (status == TY_OK)
			status = ty_settle(l, ROUNDS, true);
		if (status == TY_OK)
			status = collect_conflicts(l);
		if (status != TY_OK || l->conflict_count == 0)
			break;
		status = resolve_worst(l, touched);
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
				ty_is_conflict(l, ty_lack(&l->box[i], &l->box[j], l->target, &away)))
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
	for (bool again = true, relented = false; status == TY_OK && again;)
	{
		activate_all(l);
		status = climb(l, touched);
		if (status == TY_OK && !relented)
			status = ty_relent(l);
		relented = true;
		activate_all(l);
		if (status == TY_OK)
			status = collect_conflicts(l);
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
	l->conflict_capacity = 256;
	l->pool_capacity = l->n < UINT32_MAX / POOL_PER_SITE ? POOL_PER_SITE * l->n : UINT32_MAX - 1;
	l->box = ty_allocate_array(l->env, l->n, sizeof *l->box);
	l->radius = ty_allocate_array(l->env, l->n, sizeof *l->radius);
	l->start = ty_allocate_array(l->env, l->n, sizeof *l->start);
	l->start_size = ty_allocate_array(l->env, l->n, sizeof *l->start_size);
	l->frozen = ty_allocate_array(l->env, l->n, sizeof *l->frozen);
	l->active = ty_allocate_array(l->env, l->n, sizeof *l->active);
	l->cached = ty_allocate_array(l->env, l->n, sizeof *l->cached);
	l->by_line = ty_allocate_array(l->env, l->n, sizeof *l->by_line);
	l->pool = ty_allocate_array(l->env, l->pool_capacity, sizeof *l->pool);
	l->next = ty_allocate_array(l->env, l->n, sizeof *l->next);
	l->listed = ty_allocate_array(l->env, l->n, sizeof *l->listed);
	l->degree = ty_allocate_array(l->env, l->n, sizeof *l->degree);
	l->conflicts = ty_allocate_array(l->env, l->conflict_capacity, sizeof *l->conflicts);
	if (l->box == NULL || l->radius == NULL || l->start == NULL || l->start_size == NULL || l->frozen == NULL ||
		l->active == NULL || l->next == NULL || l->cached == NULL || l->by_line == NULL || l->pool == NULL ||
		l->listed == NULL || l->degree == NULL || l->conflicts == NULL)
		return TY_NO_MEMORY;
	memset(l->cached, 0xff, l->n * sizeof *l->cached);
	memset(l->frozen, 0, l->n * sizeof *l->frozen);
	memset(l->degree, 0, l->n * sizeof *l->degree);
	memset(l->listed, 0, l->n * sizeof *l->listed);
	return TY_OK;
}

static void
free_ladder(ty_ladder *l)
{
	ty_vicinity_free(&l->near);
	ty_release(l->env, l->box);
	ty_release(l->env, l->radius);
	ty_release(l->env, l->start);
	ty_release(l->env, l->start_size);
	ty_release(l->env, l->frozen);
	ty_release(l->env, l->active);
	ty_release(l->env, l->cached);
	ty_release(l->env, l->by_line);
	ty_release(l->env, l->pool);
	ty_release(l->env, l->next);
	ty_release(l->env, l->listed);
	ty_release(l->env, l->degree);
	ty_release(l->env, l->conflicts);
}

/* The box of the sites that are drawn, and the smallest and largest reach. TY_NOT_FINITE: of what no map is made. */
static ty_status
measure_sites(ty_ladder *l, ty_point *high, double *smallest)
{
	double largest = 0, place = 0, rounding;

	*smallest = INFINITY;
	l->origin = (ty_point){INFINITY, INFINITY};
	*high = (ty_point){-INFINITY, -INFINITY};
	for (size_t i = 0; i < l->n; i++)
	{
		const ty_site *s = &l->sites[i];
		double reach = half_diagonal(s->full);

		if (s->state != TY_DRAWN)
			continue;
		*smallest = fmin(*smallest, reach);
		largest = fmax(largest, reach);
		l->origin = (ty_point){fmin(l->origin.x, s->home.x), fmin(l->origin.y, s->home.y)};
		*high = (ty_point){fmax(high->x, s->home.x), fmax(high->y, s->home.y)};
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
	*smallest += 1.5 * l->target;
	return isfinite(4 * (place + largest + l->target)) ? TY_OK : TY_NOT_FINITE;
}

static ty_status
enter_all(ty_ladder *l)
{
	ty_point high;
	double smallest;
	ty_status status = measure_sites(l, &high, &smallest);

	if (status == TY_OK)
		status = ty_vicinity_begin(l->env, l->n, (ty_point){0, 0},
								   (ty_point){high.x - l->origin.x, high.y - l->origin.y}, smallest, &l->near);
	for (size_t i = 0; status == TY_OK && i < l->n; i++)
	{
		l->start[i] = l->sites[i].moved;
		l->start_size[i] = l->sites[i].size;
		if (l->sites[i].state == TY_DRAWN)
			ty_enter_site(l, (uint32_t) i);
	}
	return status;
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
	free_ladder(&l);
	return status;
}
