/*
 * alignment.c - rows of buildings, see alignment.h.
 *
 * After Christophe and Ruas ("Detecting building alignments for generalisation purposes", 2002), who look for buildings
 * along straight lines and keep the groups that are regular in spacing, size and orientation. Here a row is put
 * together of triples: a building with one neighbour on either side, such that the three are alike, evenly spaced and
 * nearly on a line. So a row may curve gently, and no template lines have to be tried. Neighbours are those in the
 * Delaunay mesh, as in Zhang, Ai, Stoter, Kraak and Molenaar ("Building pattern recognition in topographic data",
 * 2013); a small building, like a garage, is looked past.
 *
 *   1. Every building chooses the best triple that it is the middle of.
 *   2. Two neighbours that chose one another are linked: at most two links a building.
 *   3. Chains grow at their ends, the best continuations first.
 *   4. Chains of four are rows, and chains of three if they are very regular.
 *
 * All comparisons are between numbers that depend on the three buildings alone, and equal ones go by ranks.
 */
#include "alignment.h"

#include "predicates.h"

#include <math.h>
#include <string.h>

/*
 * The limits were chosen by what they find in the sample settlement, whose rows are known, and by looking at rows in
 * Liechtenstein and Leipzig. Lengths are multiples of the smaller building's side, the square root of its area.
 */
#define REACH 4.5			   /* neighbours' centres are no farther apart: houses in gardens have 2 to 3.5 */
#define BESIDE 2.25			   /* a small building that is looked past is no farther, half the reach ... */
#define BESIDE_SIZE 3.0		   /* ... and the building is so many times as large */
#define SIZE_RATIO 2.0		   /* of areas of neighbours */
#define ORIENTATION 0.939	   /* cosine: 20 degrees between neighbours */
#define SQUARE_RATIO 0.5	   /* of two ratios multiplied: from here on the longer side may be either */
#define STRAIGHT 0.93		   /* cosine: a row turns by 21.5 degrees at a building */
#define SPACING_RATIO 1.8	   /* of the spacings on either side ... */
#define SPACING_DIFFERENCE 1.1 /* ... or they differ by no more sides than this: pairs of houses alternate */
#define OFF_AXIS 0.5		   /* sine: 30 degrees between the row and the nearer axis of the building */
#define NEIGHBOURS 12		   /* the nearest alike ones that are looked at */
#define MANY_NEIGHBOURS 16	   /* past a small building with more of them nobody looks */

/* of three in a row, which could be chance */
#define THREE_STRAIGHT 0.985 /* 10 degrees */
#define THREE_SPACING 1.25
#define THREE_SIZE 1.3

/* what a triple's irregularities add to its length, as shares of it */
#define TURN_WEIGHT 4.0	   /* times 1 - cosine */
#define SPACING_WEIGHT 0.4 /* times ratio - 1 */
#define SIZE_WEIGHT 0.2	   /* times ratio - 1 */
#define AXIS_WEIGHT 1.0	   /* times sine */

#define AHEAD 16 /* buildings and stars that are fetched before they are needed */

typedef struct neighbour
{
	double length;
	double x, y; /* from the building, in cells */
	uint32_t rank;
} neighbour;

typedef struct neighbourhood
{
	size_t count;
	neighbour list[NEIGHBOURS]; /* by length, then rank */
} neighbourhood;

/* two places in a chain beside a building */
typedef struct links
{
	uint32_t to[2]; /* the first is taken first; TY_NONE: free */
} links;

/* a chain that may grow: from an end, which has one link, to a new member; or begin, with what the middle chose */
typedef struct growth
{
	double cost;
	uint32_t end;	 /* or the middle */
	uint32_t member; /* TY_NONE: a new chain */
} growth;

typedef struct search
{
	const ty_environment *env;
	const ty_mesh *mesh;
	const ty_trait *trait;
	ty_parting parting;
	links *choice; /* [n] the neighbours of the triple that each building chose */
	links *link;   /* [n] */
	growth *growths;
	size_t growth_count, growth_capacity;
} search;

/* ---- alike ---- */

static double
ratio_above_1(double a, double b)
{
	return a < b ? b / a : a / b;
}

static bool
same_size(const ty_trait *a, const ty_trait *b)
{
	return (double) a->area <= SIZE_RATIO * b->area && (double) b->area <= SIZE_RATIO * a->area;
}

/* Rectangles that are nearly squares may be turned by a right angle. */
static bool
same_orientation(const ty_trait *a, const ty_trait *b)
{
	double cosine = fabs((double) a->ux * b->ux + (double) a->uy * b->uy);
	double sine = fabs((double) a->ux * b->uy - (double) a->uy * b->ux);

	return cosine >= ORIENTATION || (sine >= ORIENTATION && (double) a->ratio * b->ratio >= SQUARE_RATIO);
}

/* ---- neighbours ---- */

static bool
is_nearer(const neighbour *a, const neighbour *b)
{
	return a->length != b->length ? a->length < b->length : a->rank < b->rank;
}

static void
insert_neighbour(neighbourhood *near, neighbour n)
{
	size_t at = near->count;

	for (size_t i = 0; i < near->count; i++)
		if (near->list[i].rank == n.rank)
			return;
	if (at == NEIGHBOURS)
	{
		if (!is_nearer(&n, &near->list[NEIGHBOURS - 1]))
			return;
		at--;
	}
	else
		near->count++;
	for (; at > 0 && is_nearer(&n, &near->list[at - 1]); at--)
		near->list[at] = near->list[at - 1];
	near->list[at] = n;
}

/* Adds w, which is as large as v, to v's neighbours if it is near and turned as v is. */
static void
consider(const search *s, const ty_trait *of, uint32_t w, neighbourhood *near)
{
	const ty_trait *t = &s->trait[w];
	neighbour n = {.x = (double) t->place.x - of->place.x, .y = (double) t->place.y - of->place.y, .rank = w};
	double squared = n.x * n.x + n.y * n.y;

	if (squared > REACH * REACH * fmin(of->area, t->area) || !same_orientation(of, t))
		return;
	n.length = sqrt(squared);
	insert_neighbour(near, n);
}

/* whether a building is smaller and so near that the next house of a row may stand behind it */
static bool
is_beside(const ty_trait *of, const ty_trait *small)
{
	double x = (double) small->place.x - of->place.x, y = (double) small->place.y - of->place.y;

	return BESIDE_SIZE * small->area < of->area && x * x + y * y <= BESIDE * BESIDE * of->area;
}

/* Adds what is beside the small building `small` to v's neighbours. */
static void
look_past(const search *s, uint32_t v, uint32_t small, neighbourhood *near)
{
	uint32_t first = s->mesh->vertex[small].edge, h = first, count = 0;
	uint32_t beside[MANY_NEIGHBOURS];

	do
	{
		if (count == MANY_NEIGHBOURS)
			return;
		beside[count++] = ty_target(s->mesh, h);
	} while ((h = ty_next_around(s->mesh, h)) != first);
	for (uint32_t i = 0; i < count; i++)
		if (beside[i] != TY_GHOST && beside[i] != v && same_size(&s->trait[v], &s->trait[beside[i]]))
			consider(s, &s->trait[v], beside[i], near);
}

static void
find_neighbours(const search *s, uint32_t v, neighbourhood *near)
{
	uint32_t first = s->mesh->vertex[v].edge, h = first;
	const ty_trait *of = &s->trait[v];

	near->count = 0;
	if (first == TY_NONE || !(of->area > 0) || s->mesh->live < 3)
		return;
	do
	{
		uint32_t w = ty_target(s->mesh, h);

		if (w == TY_GHOST)
			continue;
		if (same_size(of, &s->trait[w]))
			consider(s, of, w, near);
		else if (is_beside(of, &s->trait[w]))
			look_past(s, v, w, near);
	} while ((h = ty_next_around(s->mesh, h)) != first);
}

/* ---- triples ---- */

/* The cost of the triple a - v - b; INFINITY when it is none. */
static double
triple_cost(const search *s, uint32_t v, const neighbour *a, const neighbour *b)
{
	const ty_trait *t = &s->trait[v], *ta = &s->trait[a->rank], *tb = &s->trait[b->rank];
	double along = a->x * b->x + a->y * b->y, lengths = a->length * b->length;
	double x, y, off_axis, length, turn, spacing, size, most = SPACING_DIFFERENCE * sqrt(t->area);

	if (!(along <= -STRAIGHT * lengths) || !same_size(ta, tb))
		return INFINITY;
	spacing = ratio_above_1(a->length, b->length);
	if (spacing > SPACING_RATIO && fabs(a->length - b->length) > most)
		return INFINITY;
	x = b->x - a->x;
	y = b->y - a->y;
	length = sqrt(x * x + y * y);
	off_axis = fmin(fabs(x * t->ux + y * t->uy), fabs(x * t->uy - y * t->ux)) / length;
	if (!(off_axis <= OFF_AXIS))
		return INFINITY;
	turn = 1 + along / lengths; /* 1 - cosine */
	size = ratio_above_1(ta->area, t->area) * ratio_above_1(tb->area, t->area);
	return (a->length + b->length) * (1 + TURN_WEIGHT * turn + SPACING_WEIGHT * (spacing - 1) +
									  SIZE_WEIGHT * (size - 1) + AXIS_WEIGHT * off_axis);
}

/* Every building's choice. Neighbours come by length and rank, so that of equal triples the first is kept. */
static ty_status
choose_triples(search *s)
{
	for (uint32_t v = 0; v < s->mesh->vertices; v++)
	{
		neighbourhood near;
		double least = INFINITY;

		if (ty_interrupted_at(s->env, v))
			return TY_INTERRUPTED;
		if (v + AHEAD < s->mesh->vertices && s->mesh->vertex[v + AHEAD].edge != TY_NONE)
			__builtin_prefetch(&s->mesh->triangles[ty_triangle_of(s->mesh->vertex[v + AHEAD].edge)]);
		s->choice[v] = s->link[v] = (links){{TY_NONE, TY_NONE}};
		find_neighbours(s, v, &near);
		for (size_t i = 1; i < near.count; i++)
			for (size_t j = 0; j < i; j++)
			{
				double cost = triple_cost(s, v, &near.list[j], &near.list[i]);

				if (cost < least)
				{
					least = cost;
					s->choice[v] = (links){{near.list[j].rank, near.list[i].rank}};
				}
			}
	}
	return TY_OK;
}

/* ---- chains ---- */

static bool
holds(links l, uint32_t v)
{
	return l.to[0] == v || l.to[1] == v;
}

static void
add_link(search *s, uint32_t v, uint32_t w)
{
	s->link[v].to[s->link[v].to[0] == TY_NONE ? 0 : 1] = w;
}

static void
join(search *s, uint32_t v, uint32_t w)
{
	add_link(s, v, w);
	add_link(s, w, v);
}

/* Asked of links only, which are few. */
static bool
is_parted(const search *s, uint32_t v, uint32_t w)
{
	return s->parting.parts != NULL && s->parting.parts(s->parting.context, s->trait[v].place, s->trait[w].place);
}

static void
link_mutual(search *s)
{
	for (uint32_t v = 0; v < s->mesh->vertices; v++)
		for (int i = 0; i < 2; i++)
		{
			uint32_t w = s->choice[v].to[i];

			if (w != TY_NONE && holds(s->choice[w], v) && !is_parted(s, v, w))
				add_link(s, v, w);
		}
}

static neighbour
neighbour_of(const search *s, uint32_t v, uint32_t w)
{
	ty_position p = s->trait[v].place, q = s->trait[w].place;
	neighbour n = {.x = (double) q.x - p.x, .y = (double) q.y - p.y, .rank = w};

	n.length = sqrt(n.x * n.x + n.y * n.y);
	return n;
}

static bool
is_end(const search *s, uint32_t v)
{
	return s->link[v].to[0] != TY_NONE && s->link[v].to[1] == TY_NONE;
}

/* whether a link from the end v to w keeps w a member of a chain at most */
static bool
fits(const search *s, uint32_t v, uint32_t w)
{
	neighbour to_v, on;

	if (s->link[w].to[0] == TY_NONE)
		return !is_parted(s, v, w);
	if (s->link[w].to[1] != TY_NONE || s->link[w].to[0] == v || is_parted(s, v, w))
		return false;
	to_v = neighbour_of(s, w, v);
	on = neighbour_of(s, w, s->link[w].to[0]);
	return triple_cost(s, w, &to_v, &on) < INFINITY;
}

static ty_status
note_growth(search *s, growth g)
{
	if (s->growth_count == s->growth_capacity)
	{
		size_t capacity = 2 * s->growth_capacity + 64;
		growth *growths = s->growths == NULL ? ty_allocate_array(s->env, capacity, sizeof *growths)
											 : ty_reallocate_array(s->env, s->growths, capacity, sizeof *growths);

		if (growths == NULL)
			return TY_NO_MEMORY;
		s->growths = growths;
		s->growth_capacity = capacity;
	}
	s->growths[s->growth_count++] = g;
	return TY_OK;
}

/* how the chain could grow at its end v */
static ty_status
find_growths_at(search *s, uint32_t v)
{
	neighbour back = neighbour_of(s, v, s->link[v].to[0]);
	neighbourhood near;
	ty_status status = TY_OK;

	find_neighbours(s, v, &near);
	for (size_t i = 0; i < near.count && status == TY_OK; i++)
	{
		growth g = {triple_cost(s, v, &back, &near.list[i]), v, near.list[i].rank};

		if (g.cost < INFINITY && fits(s, v, g.member))
			status = note_growth(s, g);
	}
	return status;
}

/* whether three are so regular that they need no fourth */
static bool
is_regular_three(const search *s, const uint32_t *member)
{
	const ty_trait *a = &s->trait[member[0]], *b = &s->trait[member[1]], *c = &s->trait[member[2]];
	neighbour p = neighbour_of(s, member[1], member[0]), q = neighbour_of(s, member[1], member[2]);
	double least = fmin(fmin(a->area, b->area), c->area), most = fmax(fmax(a->area, b->area), c->area);

	return p.x * q.x + p.y * q.y <= -THREE_STRAIGHT * p.length * q.length &&
		   ratio_above_1(p.length, q.length) <= THREE_SPACING && most <= THREE_SIZE * least;
}

/* whether v is the middle of a new chain of three, or lengthens or joins chains */
static bool
could_begin(const search *s, uint32_t v)
{
	links choice = s->choice[v];
	uint32_t three[3] = {choice.to[0], v, choice.to[1]};

	if (s->link[v].to[0] != TY_NONE || three[0] == TY_NONE || !fits(s, v, three[0]) || !fits(s, v, three[2]))
		return false;
	return is_end(s, three[0]) || is_end(s, three[2]) || is_regular_three(s, three);
}

static ty_status
find_growths(search *s)
{
	ty_status status = TY_OK;

	s->growth_count = 0;
	for (uint32_t v = 0; v < s->mesh->vertices && status == TY_OK; v++)
	{
		if (ty_interrupted_at(s->env, v))
			return TY_INTERRUPTED;
		if (is_end(s, v))
			status = find_growths_at(s, v);
		else if (could_begin(s, v))
		{
			neighbour a = neighbour_of(s, v, s->choice[v].to[0]), b = neighbour_of(s, v, s->choice[v].to[1]);

			status = note_growth(s, (growth){triple_cost(s, v, &a, &b), v, TY_NONE});
		}
	}
	return status;
}

/* Growths by cost; what is noted by rank stays so among equals. */
static ty_status
sort_growths(search *s, uint32_t **order)
{
	uint64_t *keys = ty_allocate_array(s->env, s->growth_count, sizeof *keys);
	ty_status status = TY_NO_MEMORY;

	*order = ty_allocate_array(s->env, s->growth_count, sizeof **order);
	if (keys != NULL && *order != NULL)
	{
		for (size_t i = 0; i < s->growth_count; i++)
		{
			memcpy(&keys[i], &s->growths[i].cost, sizeof keys[i]); /* bits of numbers that are not negative ascend */
			(*order)[i] = (uint32_t) i;
		}
		status = ty_sort_keys(s->env, keys, *order, s->growth_count);
	}
	ty_release(s->env, keys);
	return status;
}

static void
grow(search *s, growth g)
{
	links choice = s->choice[g.end];

	if (g.member != TY_NONE && is_end(s, g.end) && fits(s, g.end, g.member))
		join(s, g.end, g.member);
	else if (g.member == TY_NONE && could_begin(s, g.end))
	{
		join(s, g.end, choice.to[0]);
		join(s, g.end, choice.to[1]);
	}
}

/* Lets chains begin, or grow at their ends by one member, the best first. */
static ty_status
grow_chains(search *s)
{
	uint32_t *order = NULL;
	ty_status status = find_growths(s);

	if (status == TY_OK && s->growth_count > 0)
		status = sort_growths(s, &order);
	for (size_t i = 0; i < s->growth_count && status == TY_OK; i++)
		grow(s, s->growths[order[i]]);
	ty_release(s->env, order);
	return status;
}

/* ---- rows ---- */

/* the member after v, coming from `from`; TY_NONE at the end */
static uint32_t
next_member(const search *s, uint32_t v, uint32_t from)
{
	links l = s->link[v];

	return l.to[0] == from ? l.to[1] : l.to[0];
}

/* Cuts a chain that closes, which starts and ends at v, before v. */
static void
open_ring(search *s, uint32_t v)
{
	uint32_t last = s->link[v].to[1];

	s->link[v].to[1] = TY_NONE;
	if (s->link[last].to[0] == v)
		s->link[last].to[0] = s->link[last].to[1];
	s->link[last].to[1] = TY_NONE;
}

/* Lists the chain from its end v on; makes it a row if it is good enough. */
static void
take_row(const search *s, uint32_t v, ty_rows *rows)
{
	uint32_t first = rows->first[rows->count], end = first, from = TY_NONE;
	double length = 0;

	while (v != TY_NONE)
	{
		uint32_t next = next_member(s, v, from);

		rows->member[end++] = v;
		from = v;
		v = next;
	}
	if (end - first < 3 || (end - first == 3 && !is_regular_three(s, rows->member + first)))
		return;
	for (uint32_t i = first; i < end; i++)
	{
		rows->span[rows->member[i]] = (ty_span){(uint32_t) rows->count, i - first, i - first};
		if (i > first)
			length += neighbour_of(s, rows->member[i - 1], rows->member[i]).length;
	}
	rows->spacing[rows->count] = length / (end - first - 1);
	rows->first[++rows->count] = end;
}

/*
 * The chain of v from its end of smaller rank, once it is met at its smallest rank. Each chain is walked once: its
 * members are marked with row TY_NONE - 1 while it has not been taken.
 */
static uint32_t
end_of_chain(search *s, uint32_t v, ty_rows *rows)
{
	uint32_t end[2];

	for (int i = 0; i < 2; i++)
	{
		uint32_t at = v, from = s->link[v].to[1 - i], next;

		rows->span[v].row = TY_NONE;
		while ((next = next_member(s, at, from)) != TY_NONE && next != v)
		{
			from = at;
			at = next;
			rows->span[at].row = TY_NONE;
		}
		if (next == v)
		{
			open_ring(s, v);
			return v;
		}
		end[i] = at;
	}
	return end[0] < end[1] ? end[0] : end[1];
}

#define NOT_MET (TY_NONE - 1)

static ty_status
take_rows(search *s, ty_rows *rows)
{
	size_t n = s->mesh->vertices;

	rows->first[0] = 0;
	for (size_t v = 0; v < n; v++)
		rows->span[v].row = s->link[v].to[0] == TY_NONE ? TY_NONE : NOT_MET;
	for (uint32_t v = 0; v < n; v++)
	{
		if (ty_interrupted_at(s->env, v))
			return TY_INTERRUPTED;
		if (rows->span[v].row == NOT_MET)
			take_row(s, end_of_chain(s, v, rows), rows);
	}
	return TY_OK;
}

static ty_status
allocate_rows(const ty_environment *env, size_t n, ty_rows *rows)
{
	*rows = (ty_rows){0};
	rows->first = ty_allocate_array(env, n / 3 + 2, sizeof *rows->first);
	rows->member = ty_allocate_array(env, n, sizeof *rows->member);
	rows->spacing = ty_allocate_array(env, n / 3 + 1, sizeof *rows->spacing);
	rows->span = ty_allocate_array(env, n, sizeof *rows->span);
	return rows->first != NULL && rows->member != NULL && rows->spacing != NULL && rows->span != NULL ? TY_OK
																									  : TY_NO_MEMORY;
}

ty_status
ty_rows_detect(const ty_environment *env, const ty_mesh *mesh, const ty_trait *trait, ty_parting parting, ty_rows *rows)
{
	search s = {.env = env, .mesh = mesh, .trait = trait, .parting = parting};
	ty_status status = allocate_rows(env, mesh->vertices, rows);

	s.choice = ty_allocate_array(env, mesh->vertices, sizeof *s.choice);
	s.link = ty_allocate_array(env, mesh->vertices, sizeof *s.link);
	if (s.choice == NULL || s.link == NULL)
		status = TY_NO_MEMORY;
	if (status == TY_OK)
		status = choose_triples(&s);
	if (status == TY_OK)
		link_mutual(&s);
	for (int round = 0; round < 2 && status == TY_OK; round++)
		status = grow_chains(&s);
	if (status == TY_OK)
		status = take_rows(&s, rows);
	ty_release(env, s.choice);
	ty_release(env, s.link);
	ty_release(env, s.growths);
	if (status != TY_OK)
		ty_rows_free(env, rows);
	return status;
}

void
ty_rows_free(const ty_environment *env, ty_rows *rows)
{
	ty_release(env, rows->first);
	ty_release(env, rows->member);
	ty_release(env, rows->spacing);
	ty_release(env, rows->span);
	*rows = (ty_rows){0};
}

/* ---- a group by itself ---- */

void
ty_traits(const ty_building *buildings, const uint32_t *order, const ty_mesh *mesh, const ty_grid *grid,
		  ty_trait *trait)
{
	for (size_t rank = 0; rank < mesh->vertices; rank++)
	{
		const ty_building *b = &buildings[order[rank]];

		if (rank + AHEAD < mesh->vertices)
			__builtin_prefetch(&buildings[order[rank + AHEAD]]);
		trait[rank] = (ty_trait){.place = mesh->vertex[rank].position,
								 .area = (float) (b->area / grid->cell / grid->cell),
								 .ratio = (float) b->ratio,
								 .ux = (float) b->ux,
								 .uy = (float) b->uy};
	}
}

/* What a search in a group needs, all of which goes with it. */
typedef struct ground
{
	ty_position *position;
	uint64_t *keys;
	ty_vertex *vertex;
	uint32_t *distinct;
	ty_trait *trait;
	ty_mesh mesh;
} ground;

static ty_status
allocate_ground(const ty_environment *env, size_t n, ground *g)
{
	g->position = ty_allocate_array(env, n, sizeof *g->position);
	g->keys = ty_allocate_array(env, n, sizeof *g->keys);
	g->vertex = ty_allocate_array(env, n, sizeof *g->vertex);
	g->distinct = ty_allocate_array(env, n, sizeof *g->distinct);
	g->trait = ty_allocate_array(env, n, sizeof *g->trait);
	return g->position != NULL && g->keys != NULL && g->vertex != NULL && g->distinct != NULL && g->trait != NULL
			   ? TY_OK
			   : TY_NO_MEMORY;
}

static void
free_ground(const ty_environment *env, ground *g)
{
	if (g->mesh.env != NULL)
		ty_mesh_free(&g->mesh);
	ty_release(env, g->position);
	ty_release(env, g->keys);
	ty_release(env, g->vertex);
	ty_release(env, g->distinct);
	ty_release(env, g->trait);
}

/* The mesh over the places of the buildings; of several at one place the first. */
static ty_status
mesh_ground(const ty_environment *env, size_t n, ground *g)
{
	size_t places = 0;

	for (size_t v = 0; v < n; v++)
	{
		g->vertex[v] = (ty_vertex){g->position[v], TY_NONE, 1};
		if (places > 0 && g->keys[places - 1] == g->keys[v])
			continue;
		g->distinct[places] = (uint32_t) v;
		g->keys[places++] = g->keys[v];
	}
	return ty_mesh_build(env, g->vertex, n, g->distinct, g->keys, places, &g->mesh);
}

ty_status
ty_rows_of_group(const ty_environment *env, const ty_building *buildings, size_t n, ty_parting parting, uint32_t *order,
				 ty_rows *rows)
{
	ground g = {0};
	ty_grid grid;
	ty_status status = n > TY_MAX_VERTICES ? TY_TOO_MANY : ty_grid_fit(buildings, n, &grid);

	*rows = (ty_rows){0};
	if (status == TY_OK)
		status = allocate_ground(env, n, &g);
	if (status == TY_OK)
		status = ty_canonical_order(env, buildings, n, &grid, order, g.position, g.keys);
	if (status == TY_OK)
		status = mesh_ground(env, n, &g);
	if (status == TY_OK)
	{
		ty_traits(buildings, order, &g.mesh, &grid, g.trait);
		status = ty_rows_detect(env, &g.mesh, g.trait, parting, rows);
	}
	free_ground(env, &g);
	return status;
}
