/*
 * boxes.h - a packed tree of boxes over things in a given order: which of them may lie where one looks.
 *
 * Eight things that follow one another share a box, eight such boxes one of the next level, up to a single one. Things
 * near in the order should be near in place; then a search costs about the logarithm of their number. Boxes are floats,
 * rounded outwards: a box that does not meet a place holds nothing that does.
 */
#ifndef TY_BOXES_H
#define TY_BOXES_H

#include "environment.h"

typedef struct ty_box
{
	float low_x, low_y, high_x, high_y;
} ty_box;

#define TY_BOX_FAN 8
#define TY_BOX_LEVELS 12 /* 8^11 is more than can be numbered in 32 bits */

typedef struct ty_boxes
{
	size_t count;				 /* things, below 2^32 */
	int levels;					 /* 0 for no things */
	size_t first[TY_BOX_LEVELS]; /* of each level in box; the things are level 0, the last level is one box */
	size_t size[TY_BOX_LEVELS];	 /* boxes of each level */
	ty_box *box;
} ty_boxes;

/* The smallest box of floats that holds these two corners, which may be infinite but not NaN. */
ty_box ty_box_of(double low_x, double low_y, double high_x, double high_y);

/* The box grows to hold another. */
void ty_box_enlarge(ty_box *box, const ty_box *by);

/* Room for the boxes of so many things; the caller fills in box[0 .. count), then calls ty_boxes_raise. */
ty_status ty_boxes_begin(const ty_environment *env, size_t count, ty_boxes *boxes);
/* Builds the levels above the things. */
void ty_boxes_raise(ty_boxes *boxes);
/* The box of a thing has changed: those above it grow to hold it. */
void ty_boxes_enlarge(ty_boxes *boxes, size_t thing);
void ty_boxes_free(const ty_environment *env, ty_boxes *boxes);

static inline bool
ty_box_meets(const ty_box *a, const ty_box *b)
{
	return a->low_x <= b->high_x && b->low_x <= a->high_x && a->low_y <= b->high_y && b->low_y <= a->high_y;
}

/* Whether what is looked for may lie in a box. */
typedef bool (*ty_box_test)(const void *context, const ty_box *box);
/* Called for every thing whose box passed; false ends the search. */
typedef bool (*ty_box_visit)(void *context, size_t thing);

/* Searches the tree; the order of visits is that of the things. False when a visit ended it. */
static inline __attribute__((always_inline)) bool
ty_boxes_search(const ty_boxes *boxes, ty_box_test test, ty_box_visit visit, void *context)
{
	struct
	{
		uint32_t node;
		int level;
	} open[TY_BOX_LEVELS * TY_BOX_FAN];
	int count = 0;

	if (boxes->levels == 0 || !test(context, &boxes->box[boxes->first[boxes->levels - 1]]))
		return true;
	open[count].node = 0;
	open[count++].level = boxes->levels - 1;
	while (count > 0)
	{
		size_t node = open[--count].node;
		int level = open[count].level;
		size_t from, to;

		if (level == 0)
		{
			if (!visit(context, node))
				return false;
			continue;
		}
		level--;
		from = node * TY_BOX_FAN;
		to = from + TY_BOX_FAN < boxes->size[level] ? from + TY_BOX_FAN : boxes->size[level];
		while (to-- > from)
			if (test(context, &boxes->box[boxes->first[level] + to]))
			{
				open[count].node = (uint32_t) to;
				open[count++].level = level;
			}
	}
	return true;
}

#endif
