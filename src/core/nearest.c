/* nearest.c - see nearest.h */
#include "nearest.h"

#include <math.h>

#include "grid.h"

#define LEAF_SIZE 8

/* an answer so far, or the best that a box may hold */
typedef struct candidate
{
	double distance;
	uint32_t number;
} candidate;

static double
length(double dx, double dy)
{
	return sqrt(dx * dx + dy * dy);
}

double
ty_distance(ty_point a, ty_point b)
{
	return length(a.x - b.x, a.y - b.y);
}

static bool
better(candidate a, candidate b)
{
	return a.distance < b.distance || (a.distance == b.distance && a.number < b.number);
}

static const ty_nearest_box empty_box = {INFINITY, INFINITY, -INFINITY, -INFINITY, TY_NOBODY};

static void
enlarge(ty_nearest_box *box, const ty_nearest_box *by)
{
	box->low_x = fmin(box->low_x, by->low_x);
	box->low_y = fmin(box->low_y, by->low_y);
	box->high_x = fmax(box->high_x, by->high_x);
	box->high_y = fmax(box->high_y, by->high_y);
	if (by->smallest < box->smallest)
		box->smallest = by->smallest;
}

static ty_nearest_box
box_of_leaf(const ty_nearest *tree, size_t leaf)
{
	ty_nearest_box box = empty_box;

	for (size_t i = leaf * LEAF_SIZE; i < tree->count && i < (leaf + 1) * LEAF_SIZE; i++)
	{
		uint32_t number = tree->order[i];
		ty_point p = tree->points[number];
		ty_nearest_box alone = {p.x, p.y, p.x, p.y, number};

		if (!tree->gone[number])
			enlarge(&box, &alone);
	}
	return box;
}

static void
join_children(ty_nearest *tree, size_t node)
{
	tree->boxes[node] = tree->boxes[2 * node];
	enlarge(&tree->boxes[node], &tree->boxes[2 * node + 1]);
}

int32_t
ty_nearest_cell(double value, double low, double high)
{
	double share = value / 2 - low / 2;
	double side = high / 2 - low / 2;

	return side > 0 ? (int32_t) (share / side * (1 << TY_GRID_BITS)) : 0;
}

static ty_status
sort_points(const ty_environment *env, ty_nearest *tree, uint64_t *keys)
{
	ty_nearest_box all = empty_box;

	for (size_t i = 0; i < tree->count; i++)
	{
		ty_point p = tree->points[i];
		ty_nearest_box alone = {p.x, p.y, p.x, p.y, (uint32_t) i};

		if (!isfinite(p.x) || !isfinite(p.y))
			return TY_NOT_FINITE;
		enlarge(&all, &alone);
	}
	for (size_t i = 0; i < tree->count; i++)
	{
		ty_point p = tree->points[i];
		ty_position position = {ty_nearest_cell(p.x, all.low_x, all.high_x),
								ty_nearest_cell(p.y, all.low_y, all.high_y)};

		keys[i] = ty_hilbert_key(position);
		tree->order[i] = (uint32_t) i;
	}
	return ty_sort_keys(env, keys, tree->order, tree->count);
}

ty_status
ty_nearest_build(const ty_environment *env, const ty_point *points, size_t count, ty_nearest *tree)
{
	uint64_t *keys;
	ty_status status;

	*tree = (ty_nearest){.points = points, .count = count, .leaves = 1};
	if (count >= TY_NOBODY)
		return TY_TOO_MANY;
	while (tree->leaves * LEAF_SIZE < count)
		tree->leaves *= 2;
	tree->order = ty_allocate_array(env, count, sizeof(uint32_t));
	tree->place = ty_allocate_array(env, count, sizeof(uint32_t));
	tree->gone = ty_allocate_array(env, count, sizeof(bool));
	tree->boxes = ty_allocate_array(env, 2 * tree->leaves, sizeof(ty_nearest_box));
	keys = ty_allocate_array(env, count, sizeof(uint64_t));
	status = TY_NO_MEMORY;
	if (tree->order != NULL && tree->place != NULL && tree->gone != NULL && tree->boxes != NULL && keys != NULL)
		status = sort_points(env, tree, keys);
	ty_release(env, keys);
	if (status != TY_OK)
		return status;
	for (size_t i = 0; i < count; i++)
	{
		tree->place[tree->order[i]] = (uint32_t) i;
		tree->gone[i] = false;
	}
	for (size_t leaf = 0; leaf < tree->leaves; leaf++)
		tree->boxes[tree->leaves + leaf] = box_of_leaf(tree, leaf);
	for (size_t node = tree->leaves - 1; node > 0; node--)
		join_children(tree, node);
	return TY_OK;
}

void
ty_nearest_free(const ty_environment *env, ty_nearest *tree)
{
	ty_release(env, tree->order);
	ty_release(env, tree->place);
	ty_release(env, tree->gone);
	ty_release(env, tree->boxes);
}

/* No point of the box is better than this. */
static candidate
best_of_box(const ty_nearest_box *box, ty_point from)
{
	double dx = fmax(fmax(box->low_x - from.x, from.x - box->high_x), 0);
	double dy = fmax(fmax(box->low_y - from.y, from.y - box->high_y), 0);
	candidate best = {length(dx, dy), box->smallest};

	return best;
}

static void
search_leaf(const ty_nearest *tree, size_t leaf, ty_point from, candidate *best)
{
	for (size_t i = leaf * LEAF_SIZE; i < tree->count && i < (leaf + 1) * LEAF_SIZE; i++)
	{
		uint32_t number = tree->order[i];
		candidate c = {ty_distance(from, tree->points[number]), number};

		if (!tree->gone[number] && better(c, *best))
			*best = c;
	}
}

/* As deep as the tree, at most 32 levels. */
static void
search(const ty_nearest *tree, size_t node, ty_point from, candidate *best)
{
	size_t near = 2 * node, far = near + 1;
	candidate at_near, at_far;

	if (node >= tree->leaves)
	{
		search_leaf(tree, node - tree->leaves, from, best);
		return;
	}
	at_near = best_of_box(&tree->boxes[near], from);
	at_far = best_of_box(&tree->boxes[far], from);
	if (better(at_far, at_near))
	{
		candidate swapped = at_near;

		at_near = at_far;
		at_far = swapped;
		near = far;
		far = 2 * node;
	}
	if (better(at_near, *best))
		search(tree, near, from, best);
	if (better(at_far, *best))
		search(tree, far, from, best);
}

uint32_t
ty_nearest_find(const ty_nearest *tree, ty_point from, double limit)
{
	candidate best = {limit, TY_NOBODY};

	if (tree->boxes[1].smallest != TY_NOBODY)
		search(tree, 1, from, &best);
	return best.number;
}

static void
set_gone(ty_nearest *tree, uint32_t number, bool gone)
{
	size_t leaf = tree->place[number] / LEAF_SIZE;

	tree->gone[number] = gone;
	tree->boxes[tree->leaves + leaf] = box_of_leaf(tree, leaf);
	for (size_t node = (tree->leaves + leaf) / 2; node > 0; node /= 2)
		join_children(tree, node);
}

void
ty_nearest_remove(ty_nearest *tree, uint32_t number)
{
	set_gone(tree, number, true);
}

uint32_t
ty_nearest_allowed(ty_nearest *tree, ty_point from, bool (*allows)(const void *context, uint32_t number),
				   const void *context)
{
	uint32_t asked[TY_NEAREST_ASKED], number, best = TY_NOBODY;
	int count = 0;

	while (count < TY_NEAREST_ASKED && best == TY_NOBODY)
	{
		number = ty_nearest_find(tree, from, INFINITY);
		if (number == TY_NOBODY)
			break;
		if (allows(context, number))
			best = number;
		asked[count++] = number;
		if (best == TY_NOBODY)
			set_gone(tree, number, true);
	}
	if (best == TY_NOBODY && count > 0)
		best = asked[0];
	for (int k = 0; k < count; k++)
		if (tree->gone[asked[k]])
			set_gone(tree, asked[k], false);
	return best;
}
