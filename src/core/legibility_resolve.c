/*
 * legibility_resolve.c - conflicts that no round has settled: see the head of legibility.c.
 *
 * Of every neighbourhood the worst is resolved: two are joined, or one is joined to its nearest or hidden.
 */
#include "legibility_internal.h"

#include "grid.h"

#include <math.h>
#include <string.h>

#define SPARSE 64 /* of so many sites one in a conflict is few */

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
	ty_status status = ty_find_near(l, i);
	ty_point away;
	double lack = 0;

	if (status == TY_OK && !l->body[i].clear)
	{
		lack = ty_line_lack(l, i, &away);
		l->body[i].clear = !ty_is_line_conflict(l, lack) && !ty_is_across(l, i);
		if (!l->body[i].clear)
			status = note_conflict(l, i, i, lack);
	}
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
ty_status
ty_collect_conflicts(ty_ladder *l)
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
	l->place[i].moved = l->start[i];
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

/* What is done to the sites of conflicts in one go. */
typedef enum touch
{
	UNTOUCHED = 0,
	WAITING, /* in a conflict with one that is to be resolved: that may help */
	CHOSEN,	 /* the conflict is to be resolved ... */
	RESOLVED /* ... and has been */
} touch;

/* Joins the site to its nearest neighbour on its side of the lines or, if it has none there, across. */
static ty_status
join_nearest(ty_ladder *l, uint32_t i, uint8_t *touched)
{
	uint32_t nearest, kept;
	bool across;
	ty_status status = l->by_line[i] ? ty_recall_lines(l, i) : TY_OK;

	if (status == TY_OK)
		status = ty_nearest_site(l, i, &nearest, &across);
	if (status == TY_OK && nearest != TY_NO_SITE)
	{
		status = ty_join_sites(l, i, nearest, across ? nearest : TY_NO_SITE, &kept);
		touched[kept] = RESOLVED;
		ty_activate(l, kept);
	}
	else if (status == TY_OK)
		ty_hide_site(l, i);
	return status;
}

/* A conflict of two sites, or of one with a line (a and b are the same). */
static ty_status
resolve(ty_ladder *l, uint32_t a, uint32_t b, uint8_t *touched)
{
	uint32_t goes = a == b ? a : lesser(l, a, b);
	ty_point way;
	ty_status status;

	/* rows that have given way may have been moved as a whole, or laid out anew */
	if (a != b && l->rules->rows != NULL && !ty_is_conflict(l, ty_sites_lack(l, a, b, &way)))
		return TY_OK;
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
	return join_nearest(l, goes, touched);
}

/*
 * Of every neighbourhood the worst conflict, in the order of the first of its two sites: so what is resolved one after
 * the other lies together. What is chosen and how many stand first in order.
 */
static ty_status
choose_worst(ty_ladder *l, uint32_t *order, uint8_t *touched, size_t *chosen)
{
	uint64_t *keys = ty_allocate_array(l->env, l->conflict_count, sizeof *keys);
	ty_status status = keys == NULL ? TY_NO_MEMORY : TY_OK;

	*chosen = 0;
	for (size_t k = 0; status == TY_OK && k < l->conflict_count; k++)
	{
		const ty_conflict *c = &l->conflicts[order[k]];

		if (touched[c->a] == UNTOUCHED && touched[c->b] == UNTOUCHED)
		{
			touched[c->a] = touched[c->b] = CHOSEN;
			keys[*chosen] = c->a;
			order[(*chosen)++] = order[k];
		}
		else if (touched[c->a] == CHOSEN && touched[c->b] == UNTOUCHED)
			touched[c->b] = WAITING;
		else if (touched[c->b] == CHOSEN && touched[c->a] == UNTOUCHED)
			touched[c->a] = WAITING;
	}
	if (status == TY_OK)
		status = ty_sort_keys(l->env, keys, order, *chosen);
	ty_release(l->env, keys);
	return status;
}

/* A site that was joined to the nearest in the meantime is another one by now. */
static ty_status
resolve_chosen(ty_ladder *l, const uint32_t *order, size_t chosen, uint8_t *touched)
{
	ty_status status = TY_OK;

	for (size_t k = 0; status == TY_OK && k < chosen; k++)
	{
		const ty_conflict *c = &l->conflicts[order[k]];

		if (ty_interrupted_at(l->env, k + 1))
			return TY_INTERRUPTED;
		if (touched[c->a] == RESOLVED || touched[c->b] == RESOLVED || !ty_is_drawn(l, c->a) || !ty_is_drawn(l, c->b))
			continue;
		touched[c->a] = touched[c->b] = RESOLVED;
		status = resolve(l, c->a, c->b, touched);
	}
	return status;
}

/* Lists next in ascending order where that does not take longer than to look at those that stand in it. */
static void
sort_next(ty_ladder *l)
{
	if (l->next_count < l->n / SPARSE)
		return;
	l->next_count = 0;
	for (size_t i = 0; i < l->n; i++)
		if (l->listed[i])
			l->next[l->next_count++] = (uint32_t) i;
}

/* Resolves the worst conflict of every neighbourhood. What is active next is everybody who is in a conflict. */
ty_status
ty_resolve_worst(ty_ladder *l, uint8_t *touched)
{
	uint32_t *order = ty_allocate_array(l->env, l->conflict_count, sizeof *order);
	ty_status status = order == NULL ? TY_NO_MEMORY : sort_conflicts(l, order);
	size_t chosen = 0;

	l->next_count = 0;
	for (size_t k = 0; k < l->conflict_count; k++)
	{
		ty_activate(l, l->conflicts[k].a);
		ty_activate(l, l->conflicts[k].b);
		l->degree[l->conflicts[k].a]++;
		l->degree[l->conflicts[k].b]++;
	}
	if (status == TY_OK)
		status = choose_worst(l, order, touched, &chosen);
	if (status == TY_OK)
		status = resolve_chosen(l, order, chosen, touched);
	if (status == TY_OK)
		status = ty_lay_out_rows(l);
	for (size_t k = 0; k < l->next_count; k++)
	{
		touched[l->next[k]] = UNTOUCHED;
		l->degree[l->next[k]] = 0;
	}
	sort_next(l);
	ty_release(l->env, order);
	return status;
}
