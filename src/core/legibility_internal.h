/* legibility_internal.h - what the files of legibility share. */
#ifndef TY_LEGIBILITY_INTERNAL_H
#define TY_LEGIBILITY_INTERNAL_H

#include "legibility.h"
#include "lists.h"
#include "separation.h"
#include "squares.h"
#include "surroundings.h"
#include "vicinity.h"

/* Two sites that are too near to each other. */
typedef struct ty_conflict
{
	uint32_t a, b; /* a < b; or the same: a site that is too near to a line */
	double lack;
} ty_conflict;

/* A site as another one sees it. */
typedef struct ty_neighbour
{
	double squared; /* distance from home to home */
	uint32_t number;
} ty_neighbour;

/* Who of its neighbours a site may be joined to. */
typedef struct ty_asking
{
	ty_neighbour *heap; /* [count] of those still to be asked, the nearest on top */
	size_t count, capacity;
	int asked;
	ty_neighbour last; /* who was asked */
} ty_asking;

/* What of a site tells whether another is too near: no more than a cache line, since millions of pairs are looked at. */
typedef struct ty_body
{
	ty_oblong box;
	double radius; /* half its diagonal */
	bool drawn, fixed;
	bool shifted;	/* its centre is not where its vertex is */
	bool railed;	/* stays on the line of its row */
	uint8_t stages; /* of shrinking that are left: 2 above its own size, 1 above the least, 0 */
	bool clear;		/* is known to be near no line and across none, as it is now */
} ty_body;

/* Where a site belongs, from the ladder's origin, and how far from there it has been moved. */
typedef struct ty_place
{
	ty_point home, moved;
} ty_place;

typedef struct ty_ladder
{
	const ty_environment *env;
	const ty_legibility *rules;
	ty_site *sites;
	size_t n;
	ty_point origin;	/* places are counted from here, for precision */
	double gap;			/* that must be kept, with room for rounding */
	double target;		/* that is made, a bit more, so that it is reached in finite time */
	double line_target; /* the same for lines; 0: there are none */
	double line_gap;
	bool *by_line;		/* [n] whether a line is in reach of the site */
	bool unmet;			/* lines are not looked for yet: all sites count as if one were in reach */
	ty_body *body;		/* [n] where each is now: cache lines of ... */
	void *body_memory;	/* ... this, which begins a little before */
	ty_place *place;	/* [n] what pushing needs of the sites beside their bodies; theirs is stale until the end */
	ty_point *start;	/* [n] moved, as given */
	double *start_size; /* [n] */
	bool *frozen;		/* [n] is back at its start and stays there */
	ty_vicinity near;	/* homes, with all that can be reached from there */
	ty_squares homes;	/* with lines: of those in the vicinity; else none */
	ty_asking asking;
	ty_lists near_of;	  /* by site: who stands near, if that is known */
	ty_lists lines_of;	  /* by site: which segments of lines are in reach (barrier.h), if that is known */
	ty_segments segments; /* those last found */
	const uint32_t *list; /* [list_count] what ty_find_near found; some may be gone by now */
	size_t list_count;
	const uint32_t *line_list;	/* [line_count] segments in reach of the same site, where it is by_line */
	const float *line_distance; /* ... from the nearest to its home on */
	size_t line_count;
	double line_limit;		/* there are no others as near to its home as this */
	ty_surroundings around; /* while lines are unmet: of the site whose room was looked for last */
	uint32_t *active;		/* [active_count] sites that may be in a conflict: at least one of the two of each */
	uint32_t *next;			/* those of the next round */
	size_t active_count, next_count;
	bool *listed;			/* [n] stands in next */
	uint32_t *degree;		/* [n] in how many conflicts it is, while some are being resolved */
	ty_conflict *conflicts; /* [conflict_count] */
	size_t conflict_count, conflict_capacity;
	double lacking; /* in this round, by all conflicts that were met */
} ty_ladder;

/* Whether the site is drawn. */
static inline bool
ty_is_drawn(const ty_ladder *l, uint32_t i)
{
	return l->body[i].drawn;
}

/* by how much a and b, two different sites, are nearer than target; 0 between two that both
 * stay in any case, and where one is gone */
static inline double
ty_sites_lack(const ty_ladder *l, uint32_t a, uint32_t b, ty_point *away)
{
	const ty_body *p = &l->body[a], *q = &l->body[b];
	double dx = q->box.x - p->box.x, dy = q->box.y - p->box.y, reach = p->radius + q->radius + l->target;

	if (dx * dx + dy * dy > reach * reach || !p->drawn || !q->drawn || (p->fixed && q->fixed))
		return 0;
	return ty_lack(&p->box, &q->box, l->target, away);
}

/* whether that is a conflict, and not only less than was aimed at */
static inline bool
ty_is_conflict(const ty_ladder *l, double lack)
{
	return lack > l->target - l->gap;
}

/* How far the site may be moved in any case: by the gap, and beside a line as far as it takes to get off its symbol. */
static inline double
ty_free_way(const ty_ladder *l, uint32_t i)
{
	return l->by_line[i] ? l->line_gap + 0.5 * l->sites[i].least.length : l->gap;
}

/* The body of a site anew, from its place and size. */
void ty_place_box(ty_ladder *l, uint32_t i);
/* The same where its size is what it was. */
void ty_move_box(ty_ladder *l, uint32_t i);
/* The site enters the vicinity, leaves it, or leaves it for good. */
ty_status ty_enter_site(ty_ladder *l, uint32_t i);
void ty_remove_site(ty_ladder *l, uint32_t i);
void ty_hide_site(ty_ladder *l, uint32_t i);
/* Joins two sites; which of the numbers goes on. in_place: as for the rules' join. */
ty_status ty_join_sites(ty_ladder *l, uint32_t a, uint32_t b, uint32_t in_place, uint32_t *kept);
/* Whether two sites belong to one group and no line lies between them. */
bool ty_may_join(const ty_ladder *l, uint32_t a, uint32_t b);
/*
 * legibility_line.c: by how much the site is nearer to a line than it should be, along *away; all of it where it lies
 * across one.
 */
double ty_line_lack(const ty_ladder *l, uint32_t i, ty_point *away);
/* The same for it as the box, whose half diagonal is the radius. */
double ty_box_line_lack(const ty_ladder *l, uint32_t i, const ty_oblong *box, double radius, ty_point *away);
bool ty_is_line_conflict(const ty_ladder *l, double lack);
/* Whether a line is nearer to the site than it may be. */
bool ty_is_by_line(const ty_ladder *l, uint32_t i);
/* Whether a fixed site, which does not yield, is too near to a line. */
bool ty_fixed_by_line(const ty_ladder *l, uint32_t i);
/*
 * Finds out whether a line is in reach of the site, which reaches so far, and if so which are, as it then reaches farther;
 * lists them again in l->line_list.
 */
ty_status ty_meet_lines(ty_ladder *l, uint32_t i, double reach, double reach_by_line);
ty_status ty_recall_lines(ty_ladder *l, uint32_t i);
/* Whether a line lies between the site's home and a place, counted from the origin; or where it has come to lie. */
bool ty_is_behind_line(const ty_ladder *l, uint32_t i, ty_point place);
/* Whether the site has come to lie on the other side of a line. */
bool ty_is_across(const ty_ladder *l, uint32_t i);
/* The nearest that is drawn: of those that it may be joined to or, if there is none near, of all. */
ty_status ty_nearest_site(ty_ladder *l, uint32_t i, uint32_t *nearest, bool *across);
/* Lists in l->list who may touch the site, wherever both may go, and in l->line_list the lines. Then, of this site: */
ty_status ty_find_near(ty_ladder *l, uint32_t i);
/* What was listed by ty_activate becomes active. */
void ty_next_round(ty_ladder *l);
/* All that are drawn are active, and none is listed. */
void ty_activate_all(ty_ladder *l);
/* The site is looked at in the next round. */
void ty_activate(ty_ladder *l, uint32_t i);

/* The site belongs elsewhere from now on. */
ty_status ty_rehome_site(ty_ladder *l, uint32_t i, ty_point home);

/* legibility_row.c: first of all, rows become ones that fit on their lines. */
ty_status ty_thin_rows(ty_ladder *l);
/* Lays out evenly the rows that have become fewer since. */
ty_status ty_lay_out_rows(ty_ladder *l);
/* Resolves a conflict in which a site of a row would have to yield. False: it is none. */
bool ty_resolve_rows(ty_ladder *l, uint32_t a, uint32_t b, ty_status *status);
/* Which of two stays where it is when they are joined, because it is in a row; TY_NO_SITE: neither is. */
uint32_t ty_stays_in_row(const ty_ladder *l, uint32_t a, uint32_t b);
/* The site takes the place in a row of what it has been joined from. */
void ty_take_place(ty_ladder *l, uint32_t i, const ty_site *before);
/* So far along its row that the site does not leave the end of its line behind. */
double ty_before_end(const ty_ladder *l, uint32_t i, double along);
/* The site is in no row any more; or none of its row is. */
void ty_leave_row(ty_ladder *l, uint32_t i);
void ty_dissolve_row(ty_ladder *l, uint32_t i);
/* Whether the site stands in a row that may be changed, and whether it is on a rail in any case. */
static inline bool
ty_in_row(const ty_ladder *l, uint32_t i)
{
	return l->rules->rows != NULL && l->sites[i].row != TY_NO_ROW;
}

static inline bool
ty_on_rail(const ty_site *s)
{
	return s->axis.x != 0 || s->axis.y != 0;
}

/* From home, where the site stands as long as nobody pushes it. */
static inline ty_point
ty_rest(const ty_site *s)
{
	return (ty_point){-s->rail * s->axis.y, s->rail * s->axis.x};
}

#define TY_OFF_LINE 0.48  /* of the gap: how far from the line along its buildings a site of a row may be pushed, ... */
#define TY_LEAST_PLAY 0.1 /* ... but as far as this from its rail in any case */

/* How far a site may stand beside its rail. */
static inline double
ty_play(const ty_ladder *l, const ty_site *s)
{
	double play = TY_OFF_LINE * l->gap - s->bend, least = TY_LEAST_PLAY * l->gap;

	return play > least ? play : least;
}

/* legibility_resolve.c: lists in l->conflicts those of the active sites, each once. */
ty_status ty_collect_conflicts(ty_ladder *l);
/*
 * Resolves the worst of these in every neighbourhood. What is active next is everybody who is in one. touched: [n], all
 * 0 before and after.
 */
ty_status ty_resolve_worst(ty_ladder *l, uint8_t *touched);

/* legibility_thin.c: joins or hides where so many sites crowd that nothing else can help. */
ty_status ty_thin_out(ty_ladder *l);
/* legibility_cell.c: joins what finds no room between lines; all sites meet theirs. */
ty_status ty_thin_cells(ty_ladder *l);
/* legibility_settle.c: rounds of shrinking and displacing; below: also below true size. */
ty_status ty_settle(ty_ladder *l, int rounds, bool below);
/* legibility_settle.c: the site comes back where it stands farther from home than it may at its present size. */
void ty_keep_in_bound(ty_ladder *l, uint32_t i);
/* legibility_settle.c: takes back what was not needed. */
ty_status ty_relent(ty_ladder *l);

#endif
