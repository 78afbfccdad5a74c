/*
 * pairing.c - see pairing.h.
 *
 * A pair whose points are each other's nearest is taken by the greedy order before any other pair of either, so such
 * pairs can be taken whenever they are met. They are met by walking: from a point to its nearest of the other set, from
 * there to the nearest of the first, and so on. Each pair of the walk comes earlier in the order than the one before,
 * so it ends at two points that are each other's nearest. When they leave, the rest of the walk still holds and goes
 * on from its end: every step is paid for by a point that leaves, and all pairs together take O(n) searches.
 */
#include "pairing.h"

#include <math.h>

typedef struct walk
{
	ty_nearest sets[2];
	uint32_t *steps; /* of the sets 0, 1, 0, ... in turn */
	size_t count;
} walk;

/* One step on, or one point or pair out of their sets. */
static void
go_on(walk *w, double limit, uint32_t *partner)
{
	size_t side = (w->count - 1) % 2;
	uint32_t last = w->steps[w->count - 1];
	uint32_t nearest = ty_nearest_find(&w->sets[1 - side], w->sets[side].points[last], limit);

	if (nearest == TY_NOBODY)
	{
		ty_nearest_remove(&w->sets[side], last);
		w->count--;
	}
	else if (w->count >= 2 && w->steps[w->count - 2] == nearest)
	{
		ty_nearest_remove(&w->sets[side], last);
		ty_nearest_remove(&w->sets[1 - side], nearest);
		partner[side == 0 ? last : nearest] = side == 0 ? nearest : last;
		w->count -= 2;
	}
	else
		w->steps[w->count++] = nearest;
}

static ty_status
pair_all(const ty_environment *env, walk *w, double limit, uint32_t *partner)
{
	size_t step = 0;

	for (uint32_t i = 0; i < w->sets[0].count; i++)
	{
		if (w->sets[0].gone[i])
			continue;
		w->steps[w->count++] = i;
		while (w->count > 0)
		{
			if (ty_interrupted_at(env, ++step))
				return TY_INTERRUPTED;
			go_on(w, limit, partner);
		}
	}
	return TY_OK;
}

ty_status
ty_pair_points(const ty_environment *env, const ty_point *a, size_t count_a, const ty_point *b, size_t count_b,
			   double limit, uint32_t *partner)
{
	walk w = {.count = 0};
	ty_status status = ty_nearest_build(env, a, count_a, &w.sets[0]);

	for (size_t i = 0; i < count_a; i++)
		partner[i] = TY_NOBODY;
	if (status == TY_OK)
		status = ty_nearest_build(env, b, count_b, &w.sets[1]);
	if (status == TY_OK)
	{
		w.steps = ty_allocate_array(env, count_a + count_b, sizeof(uint32_t));
		status = w.steps == NULL ? TY_NO_MEMORY : pair_all(env, &w, limit, partner);
	}
	ty_release(env, w.steps);
	ty_nearest_free(env, &w.sets[0]);
	ty_nearest_free(env, &w.sets[1]);
	return status;
}

ty_status
ty_nearest_points(const ty_environment *env, const ty_point *a, size_t count_a, const ty_point *b, size_t count_b,
				  uint32_t *nearest)
{
	ty_nearest tree;
	ty_status status = ty_nearest_build(env, b, count_b, &tree);

	for (size_t i = 0; i < count_a && status == TY_OK; i++)
	{
		if (!isfinite(a[i].x) || !isfinite(a[i].y))
			status = TY_NOT_FINITE;
		else if (ty_interrupted_at(env, i + 1))
			status = TY_INTERRUPTED;
		else
			nearest[i] = ty_nearest_find(&tree, a[i], INFINITY);
	}
	ty_nearest_free(env, &tree);
	return status;
}
