/* extents.c - see extents.h */
#include "extents.h"

#include <math.h>

#include "grid.h"
#include "nearest.h"

#define LEAF_SIZE 8

static const ty_extent no_box = {{-INFINITY, -INFINITY}, {INFINITY, INFINITY}};

static ty_extent
joined(ty_extent a, ty_extent b)
{
	return (ty_extent){{fmax(a.high.x, b.high.x), fmax(a.high.y, b.high.y)},
					   {fmin(a.low.x, b.low.x), fmin(a.low.y, b.low.y)}};
}

ty_extent
ty_segment_extent(ty_segment segment)
{
	return joined((ty_extent){segment.a, segment.a}, (ty_extent){segment.b, segment.b});
}

static bool
is_finite(const ty_extent *box)
{
	return isfinite(box->low.x) && isfinite(box->low.y) && isfinite(box->high.x) && isfinite(box->high.y);
}

static ty_status
sort_boxes(const ty_environment *env, ty_extents *tree, uint64_t *keys)
{
	ty_extent all = no_box;

	for (size_t i = 0; i < tree->count; i++)
	{
		if (!is_finite(&tree->boxes[i]))
			return TY_NOT_FINITE;
		all = joined(all, tree->boxes[i]);
	}
	for (size_t i = 0; i < tree->count; i++)
	{
		ty_extent box = tree->boxes[i];
		ty_position centre = {ty_nearest_cell(box.low.x / 2 + box.high.x / 2, all.low.x, all.high.x),
							  ty_nearest_cell(box.low.y / 2 + box.high.y / 2, all.low.y, all.high.y)};

		keys[i] = ty_hilbert_key(centre);
		tree->order[i] = (uint32_t) i;
	}
	return ty_sort_keys(env, keys, tree->order, tree->count);
}

static void
box_nodes(ty_extents *tree)
{
	for (size_t leaf = 0; leaf < tree->leaves; leaf++)
	{
		ty_extent box = no_box;

		for (size_t i = leaf * LEAF_SIZE; i < tree->count && i < (leaf + 1) * LEAF_SIZE; i++)
			box = joined(box, tree->boxes[tree->order[i]]);
		tree->nodes[tree->leaves + leaf] = box;
	}
	for (size_t node = tree->leaves - 1; node > 0; node--)
		tree->nodes[node] = joined(tree->nodes[2 * node], tree->nodes[2 * node + 1]);
}

ty_status
ty_extents_build(const ty_environment *env, const ty_extent *boxes, size_t count, ty_extents *tree)
{
	ty_status status = TY_NO_MEMORY;
	uint64_t *keys;

	*tree = (ty_extents){.boxes = boxes, .count = count, .leaves = 1};
	if (count >= TY_NOBODY)
		return TY_TOO_MANY;
	while (tree->leaves * LEAF_SIZE < count)
		tree->leaves *= 2;
	tree->order = ty_allocate_array(env, count, sizeof(uint32_t));
	tree->nodes = ty_allocate_array(env, 2 * tree->leaves, sizeof(ty_extent));
	keys = ty_allocate_array(env, count, sizeof(uint64_t));
	if (tree->order != NULL && tree->nodes != NULL && keys != NULL)
		status = sort_boxes(env, tree, keys);
	ty_release(env, keys);
	if (status == TY_OK)
		box_nodes(tree);
	return status;
}

void
ty_extents_free(const ty_environment *env, ty_extents *tree)
{
	ty_release(env, tree->order);
	ty_release(env, tree->nodes);
}

static bool
meet(const ty_extent *a, const ty_extent *b)
{
	return a->low.x <= b->high.x && b->low.x <= a->high.x && a->low.y <= b->high.y && b->low.y <= a->high.y;
}

/* As deep as the tree, at most 32 levels. */
static void
find_meeting(const ty_extents *tree, size_t node, const ty_extent *box, ty_extent_found found, void *context)
{
	size_t leaf;

	if (!meet(&tree->nodes[node], box))
		return;
	if (node < tree->leaves)
	{
		find_meeting(tree, 2 * node, box, found, context);
		find_meeting(tree, 2 * node + 1, box, found, context);
		return;
	}
	leaf = node - tree->leaves;
	for (size_t i = leaf * LEAF_SIZE; i < tree->count && i < (leaf + 1) * LEAF_SIZE; i++)
		if (meet(&tree->boxes[tree->order[i]], box))
			found(context, tree->order[i]);
}

void
ty_extents_meeting(const ty_extents *tree, const ty_extent *box, ty_extent_found found, void *context)
{
	find_meeting(tree, 1, box, found, context);
}

static double
square_of_box(const ty_extent *box, ty_point from)
{
	double dx = fmax(fmax(box->low.x - from.x, from.x - box->high.x), 0);
	double dy = fmax(fmax(box->low.y - from.y, from.y - box->high.y), 0);

	return dx * dx + dy * dy;
}

static double
square_of_segment(ty_segment segment, ty_point from)
{
	double dx = segment.b.x - segment.a.x, dy = segment.b.y - segment.a.y;
	double x = from.x - segment.a.x, y = from.y - segment.a.y;
	double along = x * dx + y * dy, whole = dx * dx + dy * dy;
	double share = whole > 0 ? fmax(0, fmin(1, along / whole)) : 0;

	x -= share * dx;
	y -= share * dy;
	return x * x + y * y;
}

typedef struct nearest_segment
{
	const ty_extents *tree;
	const ty_segment *segments;
	ty_point from;
	double square;
	uint32_t number;
} nearest_segment;

static void
search_leaf(nearest_segment *best, size_t leaf)
{
	for (size_t i = leaf * LEAF_SIZE; i < best->tree->count && i < (leaf + 1) * LEAF_SIZE; i++)
	{
		uint32_t number = best->tree->order[i];
		double square = square_of_segment(best->segments[number], best->from);

		if (square < best->square || (square == best->square && number < best->number))
		{
			best->square = square;
			best->number = number;
		}
	}
}

/* As deep as the tree; the nearer child first. Equals are looked at as well, so that the smallest number wins. */
static void
search(nearest_segment *best, size_t node)
{
	const ty_extents *tree = best->tree;
	double left, right;
	bool right_first;

	if (node >= tree->leaves)
	{
		search_leaf(best, node - tree->leaves);
		return;
	}
	left = square_of_box(&tree->nodes[2 * node], best->from);
	right = square_of_box(&tree->nodes[2 * node + 1], best->from);
	right_first = right < left;
	if ((right_first ? right : left) <= best->square)
		search(best, 2 * node + right_first);
	if ((right_first ? left : right) <= best->square)
		search(best, 2 * node + !right_first);
}

uint32_t
ty_extents_nearest_segment(const ty_extents *tree, const ty_segment *segments, ty_point from)
{
	nearest_segment best = {tree, segments, from, INFINITY, TY_NOBODY};

	search(&best, 1);
	return best.number;
}
