/* collapse.c - see collapse.h. The order of the edges is collapse_queue.c's, hubs are collapse_batch.c's. */
#include "collapse_internal.h"

#define POLL_INTERVAL 512 /* merges between two looks for an interrupt: about a millisecond */

/* ---- merging ---- */

void
ty_record(ty_run *run, uint32_t gone, ty_position to, double cost)
{
	ty_sequence *s = run->sequence;

	s->gone[s->count] = gone;
	if (s->cost != NULL)
	{
		s->cost[s->count] = cost;
		s->place[s->count] = to;
	}
	s->count++;
}

void
ty_retire(ty_run *run, uint32_t kept, uint32_t gone)
{
	run->vertex[gone].size = kept;
	if (run->queue.key != NULL)
		run->queue.key[gone] = TY_NO_KEY;
}

void
ty_show(const ty_run *run, const ty_mesh *mesh)
{
	if (run->after_merge != NULL)
		run->after_merge(run->context, mesh, run->sequence->count);
}

/* sum of all that a vertex represents, in cells */
typedef struct sum
{
	int64_t x, y;
} sum;

static sum
sum_of(const ty_run *run, uint32_t v, ty_position place)
{
	int64_t size = run->vertex[v].size;

	return (sum){size * place.x + run->rest[v].x, size * place.y + run->rest[v].y};
}

/* what is left of a sum when size members stand at the place: at most half a size, where that is their mean */
static ty_position
rest_of(sum s, uint32_t size, ty_position place)
{
	return (ty_position){(int32_t) (s.x - (int64_t) size * place.x), (int32_t) (s.y - (int64_t) size * place.y)};
}

/* sum / count, rounded half up to the grid */
static int32_t
mean(int64_t sum, uint32_t count)
{
	return (int32_t) ((2 * sum + count) / (2 * (int64_t) count));
}

ty_position
ty_merged_place(const ty_run *run, uint32_t a, uint32_t b)
{
	sum s, t;
	uint32_t size;

	if (__builtin_expect(run->importance != NULL, 0))
		return ty_weighted_place(run, a, b);
	s = sum_of(run, a, run->vertex[a].position);
	t = sum_of(run, b, run->vertex[b].position);
	size = run->vertex[a].size + run->vertex[b].size;
	return (ty_position){mean(s.x + t.x, size), mean(s.y + t.y, size)};
}

void
ty_join(ty_run *run, uint32_t kept, uint32_t gone, ty_position former, ty_position to)
{
	if (__builtin_expect(run->importance != NULL, 0))
		ty_join_weighted(run, kept, gone, former, to);
	else
	{
		sum s = sum_of(run, kept, former), t = sum_of(run, gone, run->vertex[gone].position);

		run->rest[kept] = rest_of((sum){s.x + t.x, s.y + t.y}, run->vertex[kept].size + run->vertex[gone].size, to);
	}
	if (__builtin_expect(run->rows != NULL, 0))
		ty_join_rows(run, kept, gone);
	run->vertex[kept].size += run->vertex[gone].size;
}

/* Joins and records; returns the merged place, which the mesh has still to move the kept vertex to. */
static ty_position
merge(ty_run *run, uint32_t kept, uint32_t gone, double cost)
{
	ty_position to = ty_merged_place(run, kept, gone);

	ty_join(run, kept, gone, run->vertex[kept].position, to);
	ty_record(run, gone, to, cost);
	return to;
}

/* Makes room in *array, NULL at first, for so many merges; what is there stays. */
static bool
reserve(const ty_environment *env, void **array, size_t merges, size_t size)
{
	void *grown =
		*array == NULL ? ty_allocate_array(env, merges, size) : ty_reallocate_array(env, *array, merges, size);

	if (grown != NULL)
		*array = grown;
	return grown != NULL;
}

static ty_status
reserve_sequence(ty_run *run, size_t merges)
{
	ty_sequence *s = run->sequence;
	void *gone = s->gone, *cost = s->cost, *place = s->place;
	bool there = reserve(run->env, &gone, merges, sizeof *s->gone) &&
				 (!run->with_cost || (reserve(run->env, &cost, merges, sizeof *s->cost) &&
									  reserve(run->env, &place, merges, sizeof *s->place)));

	s->gone = gone;
	s->cost = cost;
	s->place = place;
	return there ? TY_OK : TY_NO_MEMORY;
}

/* Which vertex went on, of every merge. */
static ty_status
list_kept(ty_run *run)
{
	ty_sequence *s = run->sequence;

	s->kept = ty_allocate_array(run->env, s->count, sizeof *s->kept);
	if (s->kept == NULL)
		return TY_NO_MEMORY;
	for (size_t i = 0; i < s->count; i++)
		s->kept[i] = run->vertex[s->gone[i]].size;
	return TY_OK;
}

/* how many vertices share their place with one before them */
static size_t
count_coincident(const uint64_t *keys, size_t n)
{
	size_t count = 0;

	for (size_t v = 1; v < n; v++)
		count += keys[v] == keys[v - 1];
	return count;
}

/*
 * Merges vertices that share a place from the start: each run of equal positions in turn, at cost 0, until
 * count vertices are left. Lists one vertex of every place, and its key at the front of keys. Of several kept vertices
 * at a place the first takes in all others that are not kept. The rest stay as they are, and outside of the mesh: a
 * kept vertex never moves, so the first holds the place for ever, and whoever comes there is merged with it.
 */
static ty_status
merge_coincident(ty_run *run, size_t count, uint32_t *distinct, uint64_t *keys, size_t *distinct_count)
{
	size_t places = 0;

	for (size_t v = 0; v < run->n; v++)
	{
		if (ty_interrupted_at(run->env, v))
			return TY_INTERRUPTED;
		if (v > 0 && keys[places - 1] == keys[v] && run->n - run->sequence->count > count)
		{
			if (ty_both_kept(run, distinct[places - 1], (uint32_t) v))
				continue;
			merge(run, distinct[places - 1], (uint32_t) v, 0);
			ty_retire(run, distinct[places - 1], (uint32_t) v);
			ty_show(run, NULL);
			continue;
		}
		distinct[places] = (uint32_t) v;
		keys[places++] = keys[v];
	}
	*distinct_count = places;
	return TY_OK;
}

/* ---- minimum distance ---- */

/*
 * Whether two vertices are nearer than the minimum distance. The nearest neighbour of a vertex is a Delaunay
 * neighbour, and vertices do not move: one that has been found to have none so near need not be looked at
 * again unless a new vertex appears, which is then looked at itself. Where influences forbid edges the nearest
 * that may be collapsed can become a neighbour later: then vertices with new edges are looked at as well.
 */
static bool
is_too_short(const ty_run *run, uint32_t v, uint32_t w)
{
	double length = sqrt((double) ty_squared_distance(run->vertex[v].position, run->vertex[w].position));

	return length < run->min_distance && !ty_both_kept(run, v, w) && !ty_is_barred(run, v, w);
}

static bool
is_too_near(const ty_run *run, uint32_t v)
{
	uint32_t first = run->vertex[v].edge, h = first;

	if (first == TY_NONE || run->mesh.live < 2)
		return false;
	do
	{
		uint32_t w = ty_target(&run->mesh, h);

		if (w != TY_GHOST && is_too_short(run, v, w))
			return true;
	} while ((h = ty_next_around(&run->mesh, h)) != first);
	return false;
}

static bool
too_near(ty_run *run)
{
	for (; run->near_count > 0; run->near_count--)
		if (is_too_near(run, run->near[run->near_count - 1]))
			return true;
	for (; run->near_first < run->n; run->near_first++)
		if (is_too_near(run, (uint32_t) run->near_first))
			return true;
	return false;
}

static ty_status
push_near(ty_run *run, uint32_t v)
{
	if (run->near_count == run->near_capacity)
	{
		size_t capacity = 2 * run->near_capacity;
		uint32_t *near = ty_reallocate_array(run->env, run->near, capacity, sizeof *near);

		if (near == NULL)
			return TY_NO_MEMORY;
		run->near = near;
		run->near_capacity = capacity;
	}
	run->near[run->near_count++] = v;
	return TY_OK;
}

/* A vertex from near_first on need not be remembered: its turn is still to come. */
ty_status
ty_look_near(ty_run *run, uint32_t a, uint32_t b)
{
	return a < run->near_first && b < run->near_first && is_too_short(run, a, b) ? push_near(run, a) : TY_OK;
}

/* ---- the loop ---- */

/* how few vertices may be left in the end */
static size_t
least_vertices(ty_stop stop)
{
	return stop.min_distance > 0 || stop.count < 1 ? 1 : stop.count;
}

/* whether merging goes on: too many are left, or two of them are too near */
static bool
goes_on(ty_run *run, ty_stop stop)
{
	return run->n - run->sequence->count > stop.count || (stop.min_distance > 0 && too_near(run));
}

ty_status
ty_enter_merged(ty_run *run, uint32_t kept)
{
	if (run->near != NULL && push_near(run, kept) != TY_OK)
		return TY_NO_MEMORY;
	return run->status == TY_OK ? ty_queue_set(run, ty_least_edge(run, kept)) : run->status;
}

/*
 * Collapses the edge e, of the half-edge h. When the merged vertex comes to lie on another one, the two are the next
 * to merge, at cost 0, unless that would be one merge too many.
 */
static ty_status
collapse_edge(ty_run *run, ty_edge e, uint32_t h, ty_stop stop)
{
	uint32_t kept = ty_smaller(e.owner, e.other), gone = ty_larger(e.owner, e.other), met;
	ty_position to = merge(run, kept, gone, e.cost);
	ty_status status = ty_mesh_collapse(&run->mesh, h, to, &met);

	ty_retire(run, kept, gone);
	while (status == TY_OK && met != TY_NONE)
	{
		uint32_t first = ty_smaller(kept, met), second = ty_larger(kept, met);

		run->vertex[kept].position = to;
		ty_show(run, NULL);
		if (run->n - run->sequence->count <= stop.count && !(stop.min_distance > 0))
			return TY_OK;
		to = merge(run, first, second, 0);
		status = ty_mesh_move(&run->mesh, met, first, to, &met);
		ty_retire(run, first, second);
		kept = first;
	}
	if (status == TY_OK)
		ty_show(run, &run->mesh);
	return status == TY_OK ? ty_enter_merged(run, kept) : status;
}

/* One merge, or a batch of them. *done: the mesh has no edge left to collapse. */
static ty_status
next_merges(ty_run *run, ty_stop stop, bool *done)
{
	size_t merges = run->sequence->count;
	ty_edge least;
	uint32_t h;
	ty_status status;

	status = ty_collapse_batch(run, run->n - merges > stop.count ? run->n - merges - stop.count : 0, stop.min_distance);
	if (status != TY_OK || run->sequence->count > merges)
		return status;
	status = ty_queue_least(run, &least, &h);
	*done = status == TY_OK && least.owner == TY_NONE;
	return status == TY_OK && !*done ? collapse_edge(run, least, h, stop) : status;
}

static ty_status
collapse_all(ty_run *run, ty_stop stop)
{
	ty_status status = TY_OK;
	bool done = false;

	for (size_t step = 1; status == TY_OK && !done && goes_on(run, stop); step++)
	{
		status = next_merges(run, stop, &done);
		if (status == TY_OK && step % POLL_INTERVAL == 0)
		{
			if (ty_interrupted(run->env))
				status = TY_INTERRUPTED;
			ty_progress(run->env, TY_COLLAPSING, run->sequence->count, run->n - least_vertices(stop));
		}
	}
	return status;
}

/* ---- set-up ---- */

/* Builds the mesh over the distinct places, after the merges at cost 0. */
static ty_status
prepare_mesh(ty_run *run, uint64_t *keys, ty_stop stop)
{
	uint32_t *distinct = ty_allocate_array(run->env, run->n, sizeof *distinct);
	size_t least = least_vertices(stop);
	size_t places;
	ty_status status;

	if (distinct == NULL)
		return TY_NO_MEMORY;
	status = reserve_sequence(run, count_coincident(keys, run->n));
	if (status == TY_OK)
		status = merge_coincident(run, least, distinct, keys, &places);
	if (status == TY_OK && run->n - run->sequence->count > least && places > 1)
	{
		status = ty_mesh_build(run->env, run->vertex, run->n, distinct, keys, places, &run->mesh);
		run->mesh.edge_made = ty_cover_edge;
		run->mesh.edge_context = run;
	}
	ty_release(run->env, distinct);
	return status;
}

static ty_status
compute_keys(ty_run *run)
{
	run->keys = ty_allocate_array(run->env, run->n, sizeof *run->keys);
	if (run->keys == NULL)
		return TY_NO_MEMORY;
	for (size_t v = 0; v < run->n; v++)
	{
		if (ty_interrupted_at(run->env, v))
			return TY_INTERRUPTED;
		run->keys[v] = ty_hilbert_key(run->vertex[v].position);
	}
	return TY_OK;
}

static void
free_keys(ty_run *run)
{
	ty_release(run->env, run->keys);
	run->keys = NULL;
}

/* Mesh and queue; none where the merges at cost 0 were enough. */
static ty_status
prepare(ty_run *run, ty_stop stop)
{
	ty_status status = run->keys == NULL ? compute_keys(run) : TY_OK;

	if (status == TY_OK)
		status = prepare_mesh(run, run->keys, stop);
	free_keys(run);
	if (status != TY_OK || run->mesh.env == NULL)
		return status;
	/* only now is there room for what the merges take: at the peak every array counts */
	status = reserve_sequence(run, run->n - least_vertices(stop));
	if (status == TY_OK)
		status = ty_influence_find_rows(run);
	return status == TY_OK ? ty_queue_begin(run) : status;
}

/* The vertices, at their positions. The caller's positions become the rests: there is no more room for either. */
static ty_status
allocate_run(ty_run *run, ty_position *position, bool with_near)
{
	run->rest = position;
	run->vertex = ty_allocate_array(run->env, run->n, sizeof *run->vertex);
	run->near_capacity = 64;
	if (with_near)
		run->near = ty_allocate_array(run->env, run->near_capacity, sizeof *run->near);
	if (run->vertex == NULL || (with_near && run->near == NULL))
		return TY_NO_MEMORY;
	for (size_t v = 0; v < run->n; v++)
	{
		run->vertex[v] = (ty_vertex){position[v], TY_NONE, 1};
		run->rest[v] = (ty_position){0, 0};
	}
	return TY_OK;
}

/* Gives back all but the vertices. */
static void
free_mesh_and_queue(ty_run *run)
{
	if (run->mesh.env != NULL)
		ty_mesh_free(&run->mesh);
	run->mesh.env = NULL;
	ty_queue_free(run);
}

static void
free_run(ty_run *run)
{
	free_mesh_and_queue(run);
	ty_release(run->env, run->vertex);
	ty_release(run->env, run->near);
	ty_influence_free(run);
	free_keys(run);
}

static ty_status
collapse_few(ty_run *run, ty_stop stop)
{
	ty_status status = reserve_sequence(run, run->n - least_vertices(stop));

	if (status == TY_OK)
		ty_collapse_few(run, stop);
	return status;
}

static ty_status
collapse_many(ty_run *run, ty_stop stop)
{
	ty_status status = prepare(run, stop);

	return status == TY_OK && run->mesh.env != NULL ? collapse_all(run, stop) : status;
}

static ty_status
collapse(ty_run *run, ty_position *position, ty_stop stop)
{
	ty_status status = allocate_run(run, position, stop.min_distance > 0);

	if (status == TY_OK && run->influence != NULL)
		status = ty_influence_begin(run, run->influence);
	if (status == TY_OK && run->n <= TY_FEW && run->influence == NULL && run->after_merge == NULL)
		status = collapse_few(run, stop);
	else if (status == TY_OK)
		status = collapse_many(run, stop);
	free_mesh_and_queue(run);
	if (status == TY_OK)
		status = list_kept(run);
	for (size_t v = 0; status == TY_OK && v < run->n; v++)
		position[v] = run->vertex[v].position;
	return status;
}

ty_status
ty_collapse_keyed(const ty_environment *env, ty_position *position, uint64_t *keys, size_t n, double s_u,
				  const ty_influence *influence, ty_stop stop, bool with_cost, ty_after_merge after_merge,
				  void *context, ty_sequence *sequence)
{
	ty_run run = {.env = env,
				  .n = n,
				  .s_u = s_u,
				  .keys = keys,
				  .influence = influence,
				  .min_distance = stop.min_distance,
				  .with_cost = with_cost,
				  .sequence = sequence,
				  .after_merge = after_merge,
				  .context = context};
	ty_status status = n > TY_MAX_VERTICES ? TY_TOO_MANY : TY_OK;

	*sequence = (ty_sequence){0};
	if (status == TY_OK && n > least_vertices(stop))
		status = collapse(&run, position, stop);
	free_run(&run);
	if (status != TY_OK)
		ty_sequence_free(env, sequence);
	return status;
}

ty_status
ty_collapse(const ty_environment *env, ty_position *position, size_t n, double s_u, const ty_influence *influence,
			ty_stop stop, bool with_cost, ty_after_merge after_merge, void *context, ty_sequence *sequence)
{
	return ty_collapse_keyed(env, position, NULL, n, s_u, influence, stop, with_cost, after_merge, context, sequence);
}

void
ty_sequence_free(const ty_environment *env, ty_sequence *sequence)
{
	ty_release(env, sequence->kept);
	ty_release(env, sequence->gone);
	ty_release(env, sequence->cost);
	ty_release(env, sequence->place);
	*sequence = (ty_sequence){0};
}

size_t
ty_sequence_cut(const ty_sequence *sequence, size_t merges, size_t n, uint32_t *label)
{
	size_t count = 0;

	for (size_t rank = 0; rank < n; rank++)
		label[rank] = (uint32_t) rank;
	for (size_t i = 0; i < merges; i++)
		label[sequence->gone[i]] = sequence->kept[i];
	/* the kept rank is always the smaller one, so its number is known by then */
	for (size_t rank = 0; rank < n; rank++)
		label[rank] = label[rank] == rank ? (uint32_t) count++ : label[label[rank]];
	return count;
}
