/*
 * hierarchy.c - see hierarchy.h
 *
 * The merge sequence is replayed: forwards for what a node is made of, backwards for the numbers of the leaves below
 * it, and once more for its life span. While it is being made a leaf goes by its rank.
 */
#include "hierarchy.h"

#include "group_internal.h"
#include "quantile.h"

#include <math.h>
#include <string.h>

/* what a vertex stands for at some step, kept at its rank: as much as a line of the cache */
typedef struct cluster
{
	__int128 area;				/* sum, in units of the area scale; weighted where there are weights */
	int64_t weight;				/* sum, where there are weights */
	double importance, largest; /* importance, 1 without weights, and area of the representative */
	uint32_t count;
	uint32_t representative; /* rank */
	uint32_t node;
} cluster;

#define AHEAD 16 /* steps whose clusters or nodes are fetched before they are needed: they lie in any order */

/* the two nodes that a merge joins: that of the kept rank, that of the one which is gone */
typedef struct children
{
	uint32_t kept, gone;
} children;

typedef struct replay
{
	const ty_environment *env;
	const ty_parameters *parameters;
	ty_hierarchy *h;
	group group;
	bool weighted; /* means are weighted */
	ty_sequence sequence;
	cluster *clusters;	/* [n] */
	children *children; /* [merges] */
} replay;

static bool
allocate(const ty_environment *env, ty_hierarchy *h)
{
	h->leaf = ty_allocate_array(env, h->n, sizeof *h->leaf);
	h->parent = ty_allocate_array(env, h->n + h->merges, sizeof *h->parent);
	h->first = ty_allocate_array(env, h->n + h->merges, sizeof *h->first);
	h->count = ty_allocate_array(env, h->merges, sizeof *h->count);
	h->representative = ty_allocate_array(env, h->merges, sizeof *h->representative);
	h->position = ty_allocate_array(env, h->merges, sizeof *h->position);
	h->area = ty_allocate_array(env, h->merges, sizeof *h->area);
	h->cost = ty_allocate_array(env, h->merges, sizeof *h->cost);
	h->scale = ty_allocate_array(env, h->merges, sizeof *h->scale);
	return h->leaf != NULL && h->parent != NULL && h->first != NULL && h->count != NULL && h->representative != NULL &&
		   h->position != NULL && h->area != NULL && h->cost != NULL && h->scale != NULL;
}

static const ty_building *
building_of_rank(const ty_hierarchy *h, uint32_t rank)
{
	return &h->buildings[h->order[rank]];
}

static bool
is_kept(const ty_hierarchy *h, uint32_t rank)
{
	return h->importance != NULL && h->importance[h->order[rank]] == INFINITY;
}

/* ---- forwards: what a node is made of ---- */

static cluster
single_building(const replay *r, uint32_t rank)
{
	const group *g = &r->group;
	double area = building_of_rank(r->h, rank)->area;
	cluster c = {.importance = 1, .largest = area, .count = 1, .representative = rank, .node = rank};

	if (g->weight != NULL)
		c.importance = g->weight[rank];
	if (r->weighted)
		c.weight = ty_weight(c.importance, g->weight_exponent);
	c.area = r->weighted ? ty_weighted_area_units(g->scale, area, c.weight) : ty_area_units(g->scale, area);
	return c;
}

static void
begin_clusters(replay *r)
{
	for (uint32_t rank = 0; rank < r->h->n; rank++)
	{
		r->clusters[rank] = single_building(r, rank);
		r->h->parent[rank] = TY_NONE;
	}
}

/* The representative has the higher importance, then the larger area, then the smaller rank. */
static void
take_representative(cluster *c, const cluster *other)
{
	bool stays = c->representative < other->representative;

	if (c->importance != other->importance)
		stays = c->importance > other->importance;
	else if (c->largest != other->largest)
		stays = c->largest > other->largest;
	if (stays)
		return;
	c->importance = other->importance;
	c->largest = other->largest;
	c->representative = other->representative;
}

/* sum or mean; the median is found later. A kept representative's own. */
static double
area_of(const replay *r, const cluster *c)
{
	if (c->importance == INFINITY)
		return c->largest;
	if (r->weighted)
		return ty_weighted_mean_area(r->group.scale, c->area, c->weight);
	return ty_area_of_units(r->group.scale, c->area) /
		   (r->parameters->area_statistic == TY_SUM ? 1 : (double) c->count);
}

static void
join(replay *r, size_t step)
{
	ty_hierarchy *h = r->h;
	cluster *kept = &r->clusters[r->sequence.kept[step]];
	const cluster *gone = &r->clusters[r->sequence.gone[step]];
	uint32_t node = (uint32_t) (h->n + step);

	r->children[step] = (children){kept->node, gone->node};
	h->parent[kept->node] = h->parent[gone->node] = node;
	h->parent[node] = TY_NONE;
	kept->area += gone->area;
	kept->weight += gone->weight;
	kept->count += gone->count;
	take_representative(kept, gone);
	kept->node = node;
	h->count[step] = kept->count;
	h->representative[step] = kept->representative;
	h->position[step] = r->sequence.place[step];
	h->area[step] = area_of(r, kept);
}

static ty_status
join_all(replay *r)
{
	double greatest = 0;

	for (size_t step = 0; step < r->h->merges; step++)
	{
		if (ty_interrupted_at(r->env, step))
			return TY_INTERRUPTED;
		if (step + AHEAD < r->h->merges)
		{
			__builtin_prefetch(&r->clusters[r->sequence.kept[step + AHEAD]]);
			__builtin_prefetch(&r->clusters[r->sequence.gone[step + AHEAD]]);
		}
		join(r, step);
		greatest = fmax(greatest, r->sequence.cost[step]);
		r->h->cost[step] = greatest * r->h->grid.cell;
		if (!isfinite(r->h->area[step]))
			return TY_NOT_FINITE;
	}
	return TY_OK;
}

/* ---- backwards: the leaves ---- */

/* Trees stand in the order of their smallest ranks; below a node what was kept comes before what is gone. */
static void
number_leaves(replay *r)
{
	ty_hierarchy *h = r->h;
	uint32_t next = 0;

	for (uint32_t rank = 0; rank < h->n; rank++)
	{
		const cluster *c = &r->clusters[rank];

		if (h->parent[c->node] != TY_NONE)
			continue;
		h->first[c->node] = next;
		next += c->count;
	}
	for (size_t step = h->merges; step-- > 0;)
	{
		children below = r->children[step];
		uint32_t first = h->first[h->n + step];

		if (step >= AHEAD)
		{
			__builtin_prefetch(&h->first[r->children[step - AHEAD].kept], 1);
			__builtin_prefetch(&h->first[r->children[step - AHEAD].gone], 1);
		}
		h->first[below.kept] = first;
		h->first[below.gone] = first + (below.kept < h->n ? 1 : h->count[below.kept - h->n]);
	}
	for (uint32_t rank = 0; rank < h->n; rank++)
		h->leaf[h->first[rank]] = rank;
}

/* ---- medians ---- */

/* Sorts the areas of the leaves; values[leaf] becomes the place of its area. Areas ascend as their bits do. */
static ty_status
sort_areas(const replay *r, uint64_t *areas, uint32_t *values)
{
	const ty_hierarchy *h = r->h;
	uint32_t *leaves = ty_allocate_array(r->env, h->n, sizeof *leaves);
	ty_status status;

	if (leaves == NULL)
		return TY_NO_MEMORY;
	for (uint32_t leaf = 0; leaf < h->n; leaf++)
	{
		memcpy(&areas[leaf], &building_of_rank(h, h->leaf[leaf])->area, sizeof *areas);
		leaves[leaf] = leaf;
	}
	status = ty_sort_keys(r->env, areas, leaves, h->n);
	for (uint32_t place = 0; status == TY_OK && place < h->n; place++)
		values[leaves[place]] = place;
	ty_release(r->env, leaves);
	return status;
}

static double
area_at(const uint64_t *areas, const ty_quantiles *q, uint32_t first, uint32_t count, uint32_t k)
{
	double area;

	memcpy(&area, &areas[ty_quantile(q, first, count, k)], sizeof area);
	return area;
}

static ty_status
find_medians(replay *r)
{
	ty_hierarchy *h = r->h;
	uint64_t *areas = ty_allocate_array(r->env, h->n, sizeof *areas);
	uint32_t *values = ty_allocate_array(r->env, h->n, sizeof *values);
	ty_quantiles q = {0};
	ty_status status = areas == NULL || values == NULL ? TY_NO_MEMORY : sort_areas(r, areas, values);

	if (status == TY_OK)
		status = ty_quantiles_prepare(r->env, values, h->n, &q);
	for (size_t step = 0; status == TY_OK && step < h->merges; step++)
	{
		uint32_t first = h->first[h->n + step], count = h->count[step];
		double upper;

		if (is_kept(h, h->representative[step]))
			continue;
		upper = area_at(areas, &q, first, count, count / 2);
		h->area[step] = count % 2 == 1 ? upper : 0.5 * area_at(areas, &q, first, count, count / 2 - 1) + 0.5 * upper;
		if (ty_interrupted_at(r->env, step))
			status = TY_INTERRUPTED;
	}
	ty_quantiles_free(r->env, &q);
	ty_release(r->env, values);
	ty_release(r->env, areas);
	return status;
}

/* ---- life spans ---- */

static ty_status
find_scales(replay *r)
{
	ty_hierarchy *h = r->h;

	for (size_t step = 0; step < h->merges; step++)
	{
		if (ty_interrupted_at(r->env, step))
			return TY_INTERRUPTED;
		/* before the merge there are n - step */
		h->scale[step] = ty_scale_below(h->n, h->n - step, r->parameters);
		if (step % 65536 == 0)
			ty_progress(r->env, TY_DRAWING, step, h->merges);
	}
	return TY_OK;
}

/* ---- the order in which nodes are best stored ---- */

/* Merges by lifetime and band, then by first leaf: what is drawn at a scale, and near one another, is stored together. */
static ty_status
find_storage_order(replay *r)
{
	ty_hierarchy *h = r->h;
	uint64_t *keys = ty_allocate_array(r->env, h->merges, sizeof *keys);
	ty_status status = TY_NO_MEMORY;

	h->stored = ty_allocate_array(r->env, h->merges, sizeof *h->stored);
	if (keys != NULL && h->stored != NULL)
	{
		for (size_t step = 0; step < h->merges; step++)
		{
			uint32_t parent = h->parent[h->n + step];
			double scale_to = parent == TY_NONE ? INFINITY : h->scale[parent - h->n];
			int lifetime = ty_lifetime(h->scale[step], scale_to, h->source_scale);
			int band = ty_band_together(lifetime, ty_band(scale_to, h->source_scale));

			keys[step] = (uint64_t) lifetime << 40 | (uint64_t) band << 32 | h->first[h->n + step];
			h->stored[step] = (uint32_t) step;
		}
		status = ty_sort_keys(r->env, keys, h->stored, h->merges);
	}
	ty_release(r->env, keys);
	return status;
}

/* ---- the whole group ---- */

static ty_status
replay_sequence(replay *r)
{
	ty_status status = TY_NO_MEMORY;

	r->h->merges = r->sequence.count;
	r->clusters = ty_allocate_array(r->env, r->h->n, sizeof *r->clusters);
	r->children = ty_allocate_array(r->env, r->h->merges, sizeof *r->children);
	if (allocate(r->env, r->h) && r->clusters != NULL && r->children != NULL)
	{
		begin_clusters(r);
		status = join_all(r);
	}
	if (status == TY_OK)
		number_leaves(r);
	ty_release(r->env, r->clusters);
	ty_release(r->env, r->children);
	if (status == TY_OK && r->parameters->area_statistic == TY_MEDIAN)
		status = find_medians(r);
	if (status == TY_OK)
		status = find_scales(r);
	return status == TY_OK ? find_storage_order(r) : status;
}

/* The canonical order goes from the group to the hierarchy. */
static void
take_order(replay *r)
{
	r->h->grid = r->group.grid;
	r->h->order = r->group.order;
	r->group.order = NULL;
}

ty_status
ty_hierarchy_build(const ty_environment *env, const ty_input *input, const ty_parameters *p, ty_hierarchy *h)
{
	replay r = {.env = env, .parameters = p, .h = h};
	ty_stop stop = {.count = 1};
	ty_status status;

	*h = (ty_hierarchy){
		.n = input->n, .buildings = input->buildings, .importance = input->importance, .source_scale = p->source_scale};
	if (input->n > TY_MAX_VERTICES)
		return TY_TOO_MANY;
	status = ty_group_begin(env, input, p, &r.group);
	r.weighted = r.group.weight != NULL && p->area_statistic == TY_MEAN;
	if (status == TY_OK)
		status = ty_group_collapse(env, &r.group, input, stop, true, &r.sequence);
	take_order(&r);
	if (status == TY_OK)
		status = replay_sequence(&r);
	ty_sequence_free(env, &r.sequence);
	ty_group_free(env, &r.group);
	if (status != TY_OK)
		ty_hierarchy_free(env, h);
	return status;
}

void
ty_hierarchy_free(const ty_environment *env, ty_hierarchy *h)
{
	ty_release(env, h->order);
	ty_release(env, h->leaf);
	ty_release(env, h->parent);
	ty_release(env, h->first);
	ty_release(env, h->count);
	ty_release(env, h->representative);
	ty_release(env, h->position);
	ty_release(env, h->area);
	ty_release(env, h->cost);
	ty_release(env, h->scale);
	ty_release(env, h->stored);
	*h = (ty_hierarchy){0};
}

/* what leaves and inner nodes have alike */
static ty_node
common_node(const ty_hierarchy *h, uint32_t slot, uint32_t representative)
{
	const ty_building *b = building_of_rank(h, representative);
	uint32_t parent = h->parent[slot];

	return (ty_node){.parent = parent,
					 .representative = h->order[representative],
					 .first_leaf = h->first[slot],
					 .ratio = b->ratio,
					 .ux = b->ux,
					 .uy = b->uy,
					 .scale_to = parent == TY_NONE ? INFINITY : h->scale[parent - h->n],
					 .kept = is_kept(h, representative)};
}

int
ty_band(double scale, double source_scale)
{
	double enlargement = scale / source_scale;
	int exponent;

	if (isinf(scale))
		return TY_ROOT_BAND;
	(void) frexp(enlargement * enlargement, &exponent);
	exponent = isinf(enlargement * enlargement) ? TY_ROOT_BAND : exponent;
	return exponent < 1 ? 0 : exponent < TY_ROOT_BAND ? exponent - 1 : TY_ROOT_BAND - 1;
}

/*
 * By how many bands the life spans of a class end at most after the one that they begin in, and how many bands are taken
 * together. Of a million real buildings the first two classes have four fifths of all nodes, the last two 2 %.
 */
static const struct
{
	int longest, together;
} lifetimes[TY_LIFETIMES] = {{1, 1}, {2, 1}, {3, 1}, {7, 4}, {TY_ROOT_BAND, 8}};

int
ty_last_band(int lifetime, int band)
{
	int last = band + lifetimes[lifetime].longest;

	return last < TY_ROOT_BAND ? last : TY_ROOT_BAND;
}

int
ty_bands_together(int lifetime)
{
	return lifetimes[lifetime].together;
}

int
ty_band_together(int lifetime, int band)
{
	return band == TY_ROOT_BAND ? band : band - band % lifetimes[lifetime].together;
}

/* Roots are in the last class, wherever they begin. */
int
ty_lifetime(double scale_from, double scale_to, double source_scale)
{
	int first = ty_band(scale_from, source_scale), last = ty_band(scale_to, source_scale), lifetime = 0;

	if (last == TY_ROOT_BAND)
		return TY_LIFETIMES - 1;
	while (last - first > lifetimes[lifetime].longest)
		lifetime++;
	return lifetime;
}

void
ty_hierarchy_fetch(const ty_hierarchy *h, size_t place)
{
	if (place < h->n)
		__builtin_prefetch(building_of_rank(h, h->leaf[place]));
	else if (place < ty_hierarchy_nodes(h))
		__builtin_prefetch(building_of_rank(h, h->representative[h->stored[place - h->n]]));
}

ty_node
ty_hierarchy_node(const ty_hierarchy *h, size_t number)
{
	uint32_t rank = number < h->n ? h->leaf[number] : 0;
	size_t step = number - h->n;
	const ty_building *b;
	ty_node node;

	if (number < h->n)
	{
		node = common_node(h, rank, rank);
		b = &h->buildings[node.representative];
		node.member_count = 1;
		node.x = b->x;
		node.y = b->y;
		node.area = b->area;
		node.scale_from = h->source_scale;
		return node;
	}
	node = common_node(h, (uint32_t) number, h->representative[step]);
	node.member_count = h->count[step];
	b = &h->buildings[node.representative];
	node.x = node.kept ? b->x : ty_grid_x(&h->grid, h->position[step].x);
	node.y = node.kept ? b->y : ty_grid_y(&h->grid, h->position[step].y);
	node.area = h->area[step];
	node.cost = h->cost[step];
	node.scale_from = h->scale[step];
	return node;
}
