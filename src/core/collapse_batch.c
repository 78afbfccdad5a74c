/*
 * collapse_batch.c - many merges at once, where hubs make single ones expensive.
 *
 * Some inputs change a large part of the mesh with every collapse: in a row of houses that was digitised twice,
 * all merged vertices lie on a line and see the next pair, so that each merge turns a fan as long as the row.
 * One after the other would be quadratic. Such merges can be done together, and the mesh be built anew once.
 *
 * Which ones. Take the next m edges in the order, C the cost of the last. They are the next m merges, in that
 * order, if, with 4 cells for the rounding to the grid,
 *
 *   (1) every mesh edge that is not longer than C is one of them,
 *   (2) no end of any of them has another neighbour, its partner aside, within C + 4,
 *   (3) the place of its merged vertex has none of those neighbours of both ends within C + 4, and
 *   (4) the mesh after all of them has no edge within C.
 *
 * For: the nearest neighbour of a vertex is a neighbour in the mesh; the nearest but one is a neighbour of it or
 * of the first, since the disc over the two holds no other vertex. So by (1) and (2) no two vertices are within
 * C of each other but the m pairs. The vertex nearest to a merged place, the two ends aside, is a neighbour of
 * one of them: shrink the disc around the place, touching that vertex, until no end lies inside; if none did,
 * that vertex were within C of both ends, against (2). So by (3) no unmerged vertex is within C of a merged one,
 * and by (4) no merged one of another. After any of the m merges, then, no two vertices are within C but the
 * pairs still to come. Costs are not less than distances (f_a >= 1): nothing comes before those pairs, and each
 * of them, being mutual nearest neighbours, is an edge of the mesh all the while. What holds for m merges holds
 * for the first of them: the count may stop them anywhere.
 */
#include "collapse_internal.h"

/*
 * A merge usually takes 40 to 60 steps of work in the mesh. What exceeds ALLOWANCE of them is saved up; when it
 * has become a few times the live vertices a batch is looked for, which costs about as much: so looking never
 * more than doubles the time. Tests set these to try batches everywhere.
 */
#ifndef TY_BATCH_ALLOWANCE
#define TY_BATCH_ALLOWANCE 128
#define TY_BATCH_PATIENCE(live) (4 * (live) + 1024)
#define TY_LEAST_BATCH 8
#endif

typedef struct batch
{
	uint32_t *kept, *gone;
	ty_position *to;
	double *cost;
	size_t count, capacity;
} batch;

/* the work that merges took beyond what they usually do */
static int64_t
surplus(const ty_run *run)
{
	return (int64_t) run->mesh.work - TY_BATCH_ALLOWANCE * (int64_t) run->sequence->count;
}

static double
distance(ty_position a, ty_position b)
{
	return sqrt((double) ty_squared_distance(a, b));
}

static double
length(const ty_run *run, uint32_t a, uint32_t b)
{
	return distance(run->vertex[a].position, run->vertex[b].position);
}

/* The least of the distances that (2) and (3) speak of. */
static double
isolation(const ty_run *run, ty_edge e)
{
	double nearest = INFINITY;
	ty_position merged = ty_merged_place(run, e.owner, e.other);
	uint32_t end[2] = {e.owner, e.other};

	for (int i = 0; i < 2; i++)
	{
		uint32_t first = run->vertex[end[i]].edge, h = first;

		do
		{
			uint32_t w = ty_target(&run->mesh, h);

			if (w == TY_GHOST || w == end[1 - i])
				continue;
			nearest = fmin(nearest, distance(run->vertex[end[i]].position, run->vertex[w].position));
			nearest = fmin(nearest, distance(merged, run->vertex[w].position));
		} while ((h = ty_next_around(&run->mesh, h)) != first);
	}
	return nearest;
}

#define FIRST_BATCH 64

static ty_status
allocate_batch(const ty_run *run, batch *b)
{
	b->capacity = FIRST_BATCH;
	b->kept = ty_allocate_array(run->env, b->capacity, sizeof *b->kept);
	b->gone = ty_allocate_array(run->env, b->capacity, sizeof *b->gone);
	b->cost = ty_allocate_array(run->env, b->capacity, sizeof *b->cost);
	return b->kept != NULL && b->gone != NULL && b->cost != NULL ? TY_OK : TY_NO_MEMORY;
}

/* room for one more edge */
static ty_status
reserve(const ty_run *run, batch *b)
{
	size_t capacity = 2 * b->capacity;
	uint32_t *kept, *gone;
	double *cost;

	if (b->count < b->capacity)
		return TY_OK;
	if ((kept = ty_reallocate_array(run->env, b->kept, capacity, sizeof *kept)) != NULL)
		b->kept = kept;
	if ((gone = ty_reallocate_array(run->env, b->gone, capacity, sizeof *gone)) != NULL)
		b->gone = gone;
	if ((cost = ty_reallocate_array(run->env, b->cost, capacity, sizeof *cost)) != NULL)
		b->cost = cost;
	if (kept == NULL || gone == NULL || cost == NULL)
		return TY_NO_MEMORY;
	b->capacity = capacity;
	return TY_OK;
}

/*
 * Takes edges out of the queue in order as long as (2) and (3) hold for all of them. The ends of those taken have no
 * keys until they get them back.
 */
static ty_status
gather(ty_run *run, batch *b)
{
	double nearest = INFINITY;

	for (;;)
	{
		ty_edge e;
		uint32_t h;
		ty_status status = ty_queue_least(run, &e, &h);

		if (status == TY_OK && e.owner == TY_NONE)
			return TY_OK;
		if (status == TY_OK && ty_interrupted_at(run->env, b->count))
			status = TY_INTERRUPTED;
		if (status == TY_OK)
			status = reserve(run, b);
		if (status != TY_OK)
			return status;
		nearest = fmin(nearest, isolation(run, e));
		if (!(nearest > e.cost + 4))
			return TY_OK;
		b->kept[b->count] = ty_smaller(e.owner, e.other);
		b->gone[b->count] = ty_larger(e.owner, e.other);
		b->cost[b->count++] = e.cost;
		ty_queue_part(run, e.owner, e.other);
	}
}

/* the length of the shortest edge of the mesh that joins no pair of the batch */
static double
shortest_outside(const ty_run *run)
{
	double shortest = INFINITY;

	for (uint32_t h = 0; h < ty_half_edge(run->mesh.used_triangles, 0); h = ty_next_half_edge(h))
	{
		uint32_t a = ty_origin(&run->mesh, h), b = ty_target(&run->mesh, h);

		if (a < b && b != TY_GHOST && !ty_queue_partners(run, a, b))
			shortest = fmin(shortest, length(run, a, b));
	}
	return shortest;
}

/* Gives the pairs from `first` on back to the queue. */
static ty_status
put_back(ty_run *run, batch *b, size_t first)
{
	ty_status status = TY_OK;

	for (size_t i = first; i < b->count && status == TY_OK; i++)
	{
		status = ty_queue_set(run, ty_least_edge(run, b->kept[i]));
		if (status == TY_OK)
			status = ty_queue_set(run, ty_least_edge(run, b->gone[i]));
	}
	if (first < b->count)
		b->count = first;
	return status;
}

/*
 * Keeps of the batch what (1) holds for, and of that at most `most`, or as many as are shorter than min_distance: while
 * the next pair is so, merging goes on. Nothing if it is too little to pay.
 */
static ty_status
trim(ty_run *run, size_t most, double min_distance, batch *b)
{
	double shortest = b->count >= TY_LEAST_BATCH ? shortest_outside(run) : 0;
	size_t count = b->count;

	while (count > 0 && !(b->cost[count - 1] < shortest))
	{
		count--;
		shortest = fmin(shortest, length(run, b->kept[count], b->gone[count])); /* it is outside now */
	}
	count = count < TY_LEAST_BATCH ? 0 : count;
	while (most < count && length(run, b->kept[most], b->gone[most]) < min_distance)
		most++;
	return put_back(run, b, count < most ? count : most);
}

/* Changes the mesh; *valid tells whether (4) holds. The places in b->to become the former ones of b->kept. */
static ty_status
try_batch(ty_run *run, batch *b, bool *valid)
{
	ty_status status;

	b->to = ty_allocate_array(run->env, b->count, sizeof *b->to);
	if (b->to == NULL)
		return TY_NO_MEMORY;
	for (size_t i = 0; i < b->count; i++)
		b->to[i] = ty_merged_place(run, b->kept[i], b->gone[i]);
	status = ty_mesh_collapse_many(&run->mesh, b->kept, b->gone, b->to, b->count);
	*valid = status == TY_OK && shortest_outside(run) > b->cost[b->count - 1];
	return status;
}

/* Records the merges of a batch that the mesh has gone through. */
static ty_status
enter_batch(ty_run *run, const batch *b)
{
	ty_status status = TY_OK;

	for (size_t i = 0; i < b->count; i++)
	{
		ty_position to = run->vertex[b->kept[i]].position;

		ty_join(run, b->kept[i], b->gone[i], b->to[i], to);
		ty_record(run, b->gone[i], to, b->cost[i]);
		ty_retire(run, b->kept[i], b->gone[i]);
		ty_show(run, i + 1 < b->count ? NULL : &run->mesh);
	}
	for (size_t i = 0; i < b->count && status == TY_OK; i++)
		status = ty_enter_merged(run, b->kept[i]);
	return status;
}

static ty_status
merge_batch(ty_run *run, batch *b)
{
	bool valid = false;
	ty_status status = try_batch(run, b, &valid);

	if (status != TY_OK || valid)
		return status == TY_OK ? enter_batch(run, b) : status;
	status = ty_mesh_part_many(&run->mesh, b->kept, b->gone, b->to, b->count);
	return status == TY_OK ? put_back(run, b, 0) : status;
}

ty_status
ty_collapse_batch(ty_run *run, size_t most, double min_distance)
{
	batch b = {0};
	ty_status status;

	if (surplus(run) <= run->surplus + TY_BATCH_PATIENCE((int64_t) run->mesh.live))
		return TY_OK;
	status = allocate_batch(run, &b);
	if (status == TY_OK)
		status = gather(run, &b);
	if (status == TY_OK)
		status = trim(run, most, min_distance, &b);
	if (status == TY_OK && b.count > 0)
		status = merge_batch(run, &b);
	run->surplus = surplus(run);
	ty_release(run->env, b.kept);
	ty_release(run->env, b.gone);
	ty_release(run->env, b.cost);
	ty_release(run->env, b.to);
	return status;
}
