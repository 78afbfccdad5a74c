/*
 * group_legible.c - the placeholders of a group as sites that are made legible.
 *
 * Where two are joined they become what one more collapse would have made of them: all members together, the vertex
 * at the mean of their places, area and representative by the same rules. The ranks of the members of every
 * placeholder are a list, ascending, so that two are one list after a walk along both.
 */
#include "group_internal.h"

#include "influence.h"
#include "legibility.h"

#include <math.h>
#include <string.h>

#define NO_RANK UINT32_MAX
#define AHEAD 8 /* so many placeholders later is a building needed that is called for now */

/* Grid positions, each as often as it weighs; weights sum up to less than 2^62 (influence.h). */
typedef struct ty_sum
{
	__int128 x, y;
	int64_t weight;
} ty_sum;

typedef struct joining
{
	const ty_environment *env;
	ty_group *group;
	const ty_input *input;
	ty_result *result;
	ty_site *sites;	   /* [result->count] */
	uint32_t *first;   /* [result->count] smallest rank */
	uint32_t *next;	   /* [n] rank, by rank */
	bool *handed;	   /* [result->count] has members from across a line */
	ty_sum *sum;	   /* [result->count] of the members' places; of no weight: not summed up yet */
	uint32_t *members; /* [n] scratch: buildings */
} joining;

static ty_sides
sides_of(ty_size size)
{
	return (ty_sides){size.width, size.length};
}

static ty_sides
not_above(ty_sides sides, ty_sides limit)
{
	return (ty_sides){fmin(sides.width, limit.width), fmin(sides.length, limit.length)};
}

/* An outline is scaled as a whole, down to where its shorter side is the minimum one. */
static void
set_outline_sides(const ty_parameters *p, const ty_outline *outline, const ty_placeholder *q, ty_site *site)
{
	double area = ty_scaled_area(p, ty_area_factor(p), q->statistic), factor;
	ty_size full = ty_outline_drawn_size(p, outline, q->statistic, area);
	ty_size own = ty_outline_drawn_size(p, outline, q->statistic, q->statistic);

	site->full = sides_of(full);
	site->own = not_above(sides_of(own), site->full);
	site->least = site->own;
	factor = site->own.width > 0 ? fmin(p->min_side / site->own.width, 1) : 1;
	if (p->min_side > 0)
		site->least = (ty_sides){factor * site->own.width, factor * site->own.length};
	site->shift = ty_outline_box_centre(outline, sqrt(full.area / outline->area));
}

/* Without a minimum side nothing says how far a placeholder may be shrunk below its true size: not at all. */
static void
set_rectangle_sides(const ty_parameters *p, const ty_building *b, const ty_placeholder *q, ty_site *site)
{
	double ratio = p->shape == TY_SQUARE ? 1 : b->ratio, area = ty_scaled_area(p, ty_area_factor(p), q->statistic);

	site->full = sides_of(ty_drawn_size(p, q->statistic, area, ratio, q->count));
	site->own = not_above(sides_of(ty_drawn_size(p, q->statistic, q->statistic, ratio, q->count)), site->full);
	site->least = site->own;
	if (p->min_side > 0)
		site->least = not_above(sides_of(ty_least_size(p, ratio, q->count)), site->own);
}

/* One that is drawn otherwise than its size says (an outline that turned out to be none) is not shrunk any more. */
static void
keep_size(const ty_placeholder *q, ty_site *site)
{
	site->full = site->own = site->least = (ty_sides){q->width, q->length};
	site->size = 2;
}

void
ty_placeholder_site(const ty_parameters *p, const ty_input *input, const ty_placeholder *q, ty_site *site)
{
	*site = (ty_site){.ux = q->ux, .uy = q->uy, .weight = q->count, .row = TY_NO_ROW, .size = 2};
	site->state = q->area > 0 ? TY_DRAWN : TY_HIDDEN;
	site->fixed = q->kept;
	if (q->kept)
		keep_size(q, site);
	else if (q->outlined)
		set_outline_sides(p, input->outlines[q->representative], q, site);
	else
		set_rectangle_sides(p, &input->buildings[q->representative], q, site);
	if (fabs(ty_site_sides(site).length - q->length) > 1e-9 * q->length)
		keep_size(q, site);
	site->home = (ty_point){q->x, q->y};
	site->home = (ty_point){2 * q->x - ty_site_centre(site).x, 2 * q->y - ty_site_centre(site).y};
}

/* Makes one ascending list of two. */
static uint32_t
merge_lists(uint32_t *next, uint32_t a, uint32_t b)
{
	uint32_t head = a < b ? a : b, *end = &head;

	while (a != NO_RANK && b != NO_RANK)
	{
		uint32_t *smaller = a < b ? &a : &b;

		*end = *smaller;
		end = &next[*smaller];
		*smaller = *end;
	}
	*end = a != NO_RANK ? a : b;
	return head;
}

/* The buildings of a site's members, which lie anywhere in memory, come all at a time. */
static void
fetch_members(const joining *j, uint32_t site)
{
	for (uint32_t rank = j->first[site]; rank != NO_RANK; rank = j->next[rank])
		__builtin_prefetch(&j->group->buildings[j->group->order[rank]]);
}

/* Sums up the members of a site, by rank, unless that has been done. */
static void
sum_up(const joining *j, uint32_t site)
{
	const ty_group *g = j->group;
	ty_sum *sum = &j->sum[site];

	if (sum->weight > 0)
		return;
	for (uint32_t rank = j->first[site]; rank != NO_RANK; rank = j->next[rank])
	{
		uint32_t member = g->order[rank];
		ty_position at = ty_grid_snap(&g->grid, g->buildings[member].x, g->buildings[member].y);
		int64_t weight = g->weight == NULL ? 1 : ty_weight(ty_group_importance(g, member), g->weight_exponent);

		sum->x += (__int128) weight * at.x;
		sum->y += (__int128) weight * at.y;
		sum->weight += weight;
	}
}

/* the whole number nearest to the quotient of two others, of which the dividend is not negative; halves up */
static int32_t
rounded_quotient(__int128 dividend, int64_t divisor)
{
	__int128 twice = 2 * dividend + divisor;

	/* mostly both fit into 64 bits, which are divided several times faster */
	if (twice <= INT64_MAX && divisor <= INT64_MAX / 2)
		return (int32_t) ((int64_t) twice / (2 * divisor));
	return (int32_t) (twice / (2 * (__int128) divisor));
}

/* The exact mean of the places of the members of two sites, which are those of the first from now on. */
static ty_position
joint_position(const joining *j, uint32_t kept, uint32_t gone)
{
	ty_sum *sum = &j->sum[kept];

	fetch_members(j, kept);
	fetch_members(j, gone);
	sum_up(j, kept);
	sum_up(j, gone);
	sum->x += j->sum[gone].x;
	sum->y += j->sum[gone].y;
	sum->weight += j->sum[gone].weight;
	return (ty_position){rounded_quotient(sum->x, sum->weight), rounded_quotient(sum->y, sum->weight)};
}

/*
 * Where members were handed across a line the vertex is no longer the mean of their places, but of the two sites', each
 * as often as it has members; or it stays where that of in_place is.
 */
static ty_point
joint_home(const joining *j, uint32_t kept, uint32_t gone, uint32_t in_place)
{
	const ty_site *a = &j->sites[kept], *b = &j->sites[gone];
	double weight = (double) b->weight / ((double) a->weight + b->weight);

	if (in_place != TY_NO_SITE)
		return j->sites[in_place].home;
	return (ty_point){a->home.x + weight * (b->home.x - a->home.x), a->home.y + weight * (b->home.y - a->home.y)};
}

/* The rectangle of an outline is not about the vertex, but goes along with it. */
static void
move_vertex(const joining *j, uint32_t rank, ty_point home, ty_placeholder *p)
{
	const ty_group *g = j->group;
	double x = p->count == 1 ? g->buildings[p->representative].x : ty_grid_x(&g->grid, g->position[rank].x);
	double y = p->count == 1 ? g->buildings[p->representative].y : ty_grid_y(&g->grid, g->position[rank].y);

	p->x += home.x - x;
	p->y += home.y - y;
}

static ty_status
join(void *context, uint32_t kept, uint32_t gone, uint32_t in_place, ty_site *site)
{
	joining *j = context;
	ty_placeholder *p = &j->result->placeholders[kept];
	ty_point home = joint_home(j, kept, gone, in_place);
	bool handed = in_place != TY_NO_SITE || j->handed[kept] || j->handed[gone];
	ty_position position = joint_position(j, kept, gone);
	uint32_t rank = merge_lists(j->next, j->first[kept], j->first[gone]);
	ty_status status;

	j->first[kept] = rank;
	j->group->position[rank] = position;
	p->first = p->count = 0;
	for (uint32_t r = rank; r != NO_RANK; r = j->next[r])
		j->members[p->count++] = j->group->order[r];
	status = ty_describe(j->env, j->group, j->members, rank, p);
	j->handed[kept] = handed;
	if (handed && !p->kept)
		move_vertex(j, rank, home, p);
	ty_placeholder_site(j->group->parameters, j->input, p, site);
	return status;
}

/* The placeholder as its site has come to lie; one that nothing was done to stays what it is to the last bit. */
static void
take_over(ty_placeholder *p, const ty_site *site)
{
	ty_sides sides = ty_site_sides(site);
	ty_point centre = ty_site_centre(site);

	if (site->state == TY_HIDDEN)
		p->area = p->width = p->length = 0;
	if (site->state == TY_HIDDEN || (site->size >= 2 && site->moved.x == 0 && site->moved.y == 0 && !site->relaid))
		return;
	p->x = centre.x;
	p->y = centre.y;
	if (site->size >= 2)
		return;
	p->area =
		p->outlined ? p->area * (sides.length / p->length) * (sides.length / p->length) : sides.width * sides.length;
	p->width = sides.width;
	p->length = sides.length;
	p->ratio = sides.width / sides.length;
}

static void
collide(void *context, uint32_t a, uint32_t b)
{
	joining *j = context;

	ty_note_collision(&j->result->collisions, j->result->placeholders[a].representative,
					  j->result->placeholders[b].representative);
}

/* Numbers those that are left, and labels and lists the members anew. */
static ty_status
renumber(const joining *j, uint32_t *label, size_t n)
{
	ty_result *result = j->result;
	uint32_t *number = ty_allocate_array(j->env, result->count, sizeof *number), left = 0;

	if (number == NULL)
		return TY_NO_MEMORY;
	result->undrawn = 0;
	/* a site is joined to one with a smaller number, which has its new one by then */
	for (size_t k = 0; k < result->count; k++)
	{
		if (j->sites[k].state == TY_JOINED)
		{
			number[k] = number[j->sites[k].into];
			continue;
		}
		result->hidden += result->placeholders[k].area > 0 && j->sites[k].state == TY_HIDDEN;
		take_over(&result->placeholders[k], &j->sites[k]);
		result->undrawn += !(result->placeholders[k].area > 0);
		result->placeholders[left] = result->placeholders[k];
		j->sites[left] = j->sites[k];
		number[k] = left++;
	}
	for (size_t rank = 0; rank < n; rank++)
		label[rank] = number[label[rank]];
	result->count = left;
	ty_list_members(label, j->group->order, n, result);
	ty_release(j->env, number);
	return TY_OK;
}

/* The unit vector from one end of a stretch to the other; 0 where both are the same. */
static ty_point
direction_between(ty_point a, ty_point b)
{
	double dx = b.x - a.x, dy = b.y - a.y, length = sqrt(dx * dx + dy * dy);

	return length > 0 ? (ty_point){dx / length, dy / length} : (ty_point){0, 0};
}

/* Tells the sites of rows which, and which way their row goes: from the one before to the one behind. */
static void
put_in_rows(const ty_site_rows *rows, ty_site *sites)
{
	for (uint32_t row = 0; row < rows->count; row++)
	{
		uint32_t first = rows->first[row], count = rows->first[row + 1] - first;

		for (uint32_t k = 0; k < count; k++)
		{
			ty_site *s = &sites[rows->site[first + k]];

			s->row = row;
			s->place = k;
			s->bend = rows->bend[row];
			s->axis = direction_between(sites[rows->site[first + (k > 0 ? k - 1 : 0)]].home,
										sites[rows->site[first + (k + 1 < count ? k + 1 : k)]].home);
		}
	}
}

static ty_status
prepare(joining *j, const uint32_t *label, size_t n)
{
	j->sites = ty_allocate_array(j->env, j->result->count, sizeof *j->sites);
	j->first = ty_allocate_array(j->env, j->result->count, sizeof *j->first);
	j->next = ty_allocate_array(j->env, n, sizeof *j->next);
	j->handed = ty_allocate_array(j->env, j->result->count, sizeof *j->handed);
	j->sum = ty_allocate_array(j->env, j->result->count, sizeof *j->sum);
	j->members = ty_allocate_array(j->env, n, sizeof *j->members);
	if (j->sites == NULL || j->first == NULL || j->next == NULL || j->members == NULL || j->handed == NULL ||
		j->sum == NULL)
		return TY_NO_MEMORY;
	memset(j->sum, 0, j->result->count * sizeof *j->sum);
	memset(j->handed, 0, j->result->count * sizeof *j->handed);
	memset(j->first, 0xff, j->result->count * sizeof *j->first);
	for (size_t rank = n; rank-- > 0;)
	{
		j->next[rank] = j->first[label[rank]];
		j->first[label[rank]] = (uint32_t) rank;
	}
	for (size_t k = 0; k < j->result->count; k++)
	{
		if (k + AHEAD < j->result->count)
			__builtin_prefetch(&j->input->buildings[j->result->placeholders[k + AHEAD].representative].ratio);
		ty_placeholder_site(j->group->parameters, j->input, &j->result->placeholders[k], &j->sites[k]);
	}
	put_in_rows(&j->group->pieces, j->sites);
	return TY_OK;
}

ty_status
ty_make_group_legible(const ty_environment *env, ty_group *g, uint32_t *label, size_t n, ty_result *result)
{
	ty_input input = {.buildings = g->buildings, .n = n, .outlines = g->outlines};
	joining j = {.env = env, .group = g, .input = &input, .result = result};
	ty_legibility rules = {.gap = g->parameters->min_gap,
						   .lines = g->barriers,
						   .line_gap = 0.5 * g->parameters->barrier_width + g->parameters->min_gap,
						   .rows = g->pieces.count > 0 ? &g->pieces : NULL,
						   .join = join,
						   .collide = collide,
						   .context = &j};
	ty_status status = prepare(&j, label, n);

	if (status == TY_OK)
		status = ty_make_legible(env, &rules, j.sites, result->count);
	if (status == TY_OK)
		status = renumber(&j, label, n);
	if (status == TY_OK)
		result->sites = j.sites;
	else
		ty_release(env, j.sites);
	ty_release(env, j.first);
	ty_release(env, j.next);
	ty_release(env, j.members);
	ty_release(env, j.handed);
	ty_release(env, j.sum);
	return status;
}
