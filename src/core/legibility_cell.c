/*
 * legibility_cell.c - first of all, sites that find no room between lines are joined, without any pushing.
 *
 * On a map of a town with all its streets the symbols of lines leave room to every tenth site or so. What has none as
 * small as it may become, wherever it may go, need not be pushed about in rounds: it becomes one with the nearest in its
 * cell between the lines, as often as it takes for that one to have room; where nobody else is left in the cell, the
 * members go to the nearest across. So rounds begin with a quarter of the sites; they took six times as long with all.
 */
#include "legibility_internal.h"

#include <math.h>

#define STEPS 16	  /* that are walked to find room; half as many save no time and lose 1 % of the sites */
#define STAGNANT 0.97 /* share of what was lacking two steps before, above which a walk leads nowhere */
#define TURNS_BACK 3  /* of half the way, where a step has led across a line */

/* A site on its way from home, as small as it may become. */
typedef struct walk
{
	ty_oblong box;
	double radius; /* half its diagonal */
	ty_point from; /* where the box is at home */
	double bound;  /* how far it may go */
} walk;

static walk
walk_from_home(const ty_ladder *l, uint32_t i)
{
	const ty_site *s = &l->sites[i];
	double factor = s->full.length > 0 ? s->least.length / s->full.length : 1;
	double length = 0.5 * s->least.length, width = 0.5 * s->least.width;
	ty_point from = {s->home.x - l->origin.x + factor * s->shift.x, s->home.y - l->origin.y + factor * s->shift.y};

	return (walk){.box = {from.x, from.y, s->ux, s->uy, length, width},
				  .radius = sqrt(length * length + width * width),
				  .from = from,
				  .bound = fmax(ty_free_way(l, i), length)};
}

/* How far from home lines may be in the way of the walk. */
static double
reach_of_walk(const ty_ladder *l, uint32_t i, const walk *w)
{
	double dx = w->from.x + l->origin.x - l->sites[i].home.x, dy = w->from.y + l->origin.y - l->sites[i].home.y;

	return w->bound + w->radius + 2 * sqrt(dx * dx + dy * dy) + l->line_target;
}

/* Goes on by the way, but not beyond the bound, and not across a line as far as a few turns help. */
static void
step(const ty_ladder *l, uint32_t i, walk *w, double distance, ty_point away)
{
	ty_point way = {w->box.x + distance * away.x - w->from.x, w->box.y + distance * away.y - w->from.y};
	double squared = way.x * way.x + way.y * way.y;
	double share = squared > w->bound * w->bound ? w->bound / sqrt(squared) : 1;

	for (int turn = 0; turn <= TURNS_BACK; turn++, share *= 0.5)
	{
		w->box.x = w->from.x + share * way.x;
		w->box.y = w->from.y + share * way.y;
		if (!ty_is_behind_line(l, i, (ty_point){w->box.x, w->box.y}))
			break;
	}
}

/* Whether the site, whose lines are listed, comes to a place that is far enough from all of them. */
static bool
finds_room(const ty_ladder *l, uint32_t i, walk *w)
{
	double before = INFINITY, lack = INFINITY;

	for (int steps = 0; steps < STEPS; steps++)
	{
		double two_before = before;
		ty_point away;

		before = lack;
		lack = ty_box_line_lack(l, i, &w->box, w->radius, &away);
		if (!ty_is_line_conflict(l, lack) && !ty_is_behind_line(l, i, (ty_point){w->box.x, w->box.y}))
			return true;
		if (lack > STAGNANT * two_before)
			return false;
		step(l, i, w, lack, away);
	}
	return false;
}

/* Finds out whether the site has room; if not, its lines stay listed. */
static ty_status
look_for_room(ty_ladder *l, uint32_t i, bool *room)
{
	const ty_site *s = &l->sites[i];
	walk w = walk_from_home(l, i);
	ty_status status;

	*room = s->fixed || ty_in_row(l, i) || ty_on_rail(s);
	if (*room)
		return TY_OK;
	status = ty_list_lines(l, i, reach_of_walk(l, i, &w));
	*room = status == TY_OK && finds_room(l, i, &w);
	return status;
}

/* Joins the site, which has no room, to the nearest. *kept: what is to be looked at next; TY_NO_SITE: nothing. */
static ty_status
give_up(ty_ladder *l, uint32_t i, uint32_t *kept)
{
	uint32_t nearest;
	bool across;
	ty_status status = ty_nearest_site(l, i, &nearest, &across);

	*kept = TY_NO_SITE;
	if (status == TY_OK && nearest == TY_NO_SITE)
		ty_hide_site(l, i);
	else if (status == TY_OK)
		status = ty_join_sites(l, i, nearest, across ? nearest : TY_NO_SITE, kept);
	return status;
}

/* The site meets the lines that it will be kept away from. */
static ty_status
meet_lines(ty_ladder *l, uint32_t i)
{
	ty_status status;

	l->unmet = false;
	status = ty_enter_site(l, i);
	l->unmet = true;
	return status;
}

/* The site, and what it becomes by being joined, until that has room. */
static ty_status
make_room(ty_ladder *l, uint32_t i)
{
	bool room = false;
	ty_status status = look_for_room(l, i, &room);

	while (status == TY_OK && !room && i != TY_NO_SITE)
	{
		status = give_up(l, i, &i);
		if (status == TY_OK && i != TY_NO_SITE)
			status = look_for_room(l, i, &room);
	}
	return status == TY_OK && room ? meet_lines(l, i) : status;
}

ty_status
ty_thin_cells(ty_ladder *l)
{
	ty_status status = TY_OK;

	if (!l->unmet)
		return TY_OK;
	for (uint32_t i = 0; status == TY_OK && i < l->n; i++)
	{
		if (ty_interrupted_at(l->env, i))
			status = TY_INTERRUPTED;
		else if (ty_is_drawn(l, i))
			status = make_room(l, i);
	}
	l->unmet = false;
	ty_vicinity_fit(&l->near);
	return status;
}
