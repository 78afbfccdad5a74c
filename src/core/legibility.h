/*
 * legibility.h - no two placeholders nearer than a gap (spec 4.4): shrink, displace, shrink further, join, hide.
 *
 * A site is a placeholder on its way to where it is drawn. It is a rectangle (of any other outline the one around
 * it) whose sides lie between three pairs: full, as drawn when there is room; own, its true size; least, what is
 * still legible. It leaves its vertex by at most the gap or half its longer side; beside a line by what it takes to get
 * off its symbol.
 */
#ifndef TY_LEGIBILITY_H
#define TY_LEGIBILITY_H

#include "barrier.h"
#include "environment.h"
#include "measure.h"

typedef struct ty_sides
{
	double width, length;
} ty_sides;

typedef enum ty_site_state
{
	TY_DRAWN = 0,
	TY_JOINED, /* to the site `into` */
	TY_HIDDEN  /* not drawn: nothing else was left */
} ty_site_state;

#define TY_NO_ROW UINT32_MAX

typedef struct ty_site
{
	/* what pushing looks at stands together: there may be millions of sites, and they wait for memory */
	ty_point home;	/* the vertex */
	ty_point moved; /* given and returned: from home */
	ty_point axis; /* of the row it stands in, a unit vector: off that line it goes but a part of the gap; 0: in none */
	double size;   /* given and returned: 2: full, 1: own, 0: least, and in between */
	ty_site_state state; /* given and returned */
	uint32_t into;

	double ux, uy;			   /* unit vector along the length */
	ty_sides full, own, least; /* full >= own >= least, side by side */
	ty_point shift;			   /* of the rectangle's centre from the vertex at full size; in proportion to the length */
	double rail;			   /* how far to the left of the axis its row has been moved as a whole ... */
	double bend;			   /* ... and how far the axis lies beside the buildings that its row stands for, at most */
	uint32_t row, place;	   /* in ty_legibility.rows; TY_NO_ROW */
	uint32_t weight;		   /* members: where one of two has to go, it is the lighter */
	uint32_t group;			   /* only sites of one group are joined */
	bool fixed;				   /* is not moved, shrunk, joined to another nor hidden; the others yield */
	bool relaid;			   /* returned: home has been changed without a join */
} ty_site;

#define TY_NO_SITE UINT32_MAX

/* Rows of sites (alignment.h), each along a line through the buildings that they stand for. */
typedef struct ty_site_rows
{
	size_t count;
	uint32_t *first;  /* [count + 1] of a row, in site */
	uint32_t *site;	  /* along the row; TY_NO_SITE: has left it */
	uint32_t *bent;	  /* [count + 1] where the line of a row begins, ... */
	ty_point *line;	  /* ... which has two points at least, from end to end */
	uint32_t *left;	  /* [count] sites that are still in the row */
	double *bend;	  /* [count] how far from the line along its buildings a site stands, at most */
	uint64_t *weight; /* [count] of all sites that it had */
	bool *dirty;	  /* [count] is to be laid out anew */
	uint8_t *moves;	  /* [count] how often it has been moved as a whole */
} ty_site_rows;

typedef struct ty_legibility
{
	double gap;					   /* > 0 */
	const ty_barrier_lines *lines; /* NULL: none. No site comes to lie across one, or nearer to it than ... */
	double line_gap;			   /* ... this, but for fixed ones */
	ty_site_rows *rows;			   /* NULL: none */
	/*
	 * Makes the site `kept` what both are together, at home and at full size: one more collapse. in_place: TY_NO_SITE,
	 * or that of the two whose home stays what it is, because the other comes from across a line. NULL: none are
	 * joined, as where the sites of each group have been made legible before; then a group's sites stay apart as they
	 * came.
	 */
	ty_status (*join)(void *context, uint32_t kept, uint32_t gone, uint32_t in_place, ty_site *site);
	/*
	 * Told of two fixed sites that are nearer than the gap, or of one (a and b are the same) that is too near to a line:
	 * they stay. May be NULL.
	 */
	void (*collide)(void *context, uint32_t a, uint32_t b);
	void *context;
} ty_legibility;

/* How many fixed sites are too near to each other or to a line, and the first of them. */
typedef struct ty_collisions
{
	size_t pairs, beside_lines;
	uint32_t first_pair[2], first_beside;
} ty_collisions;

/* Counts what rules->collide is told of. */
void ty_note_collision(ty_collisions *collisions, uint32_t a, uint32_t b);

/*
 * Makes n sites legible: in the end none that is drawn is nearer to another than the gap, but for two fixed ones.
 * The sites come in an order that depends on nothing but what they are. TY_JOINED and TY_HIDDEN ones are left alone.
 */
ty_status ty_make_legible(const ty_environment *env, const ty_legibility *rules, ty_site *sites, size_t n);

/* where the rectangle's centre is */
ty_point ty_site_centre(const ty_site *site);
/* the sides at the site's present size */
ty_sides ty_site_sides(const ty_site *site);

#endif
