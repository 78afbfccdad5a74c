/* compare.c - see compare.h */
#include "compare.h"
#include "sets.h"

#include <stdio.h>
#include <string.h>

typedef struct comparison
{
	reference ref;
	reference_candidates candidates;
	reference_merge merge[REFERENCE_MAX];
	size_t merges;
	const char *difference; /* the first that was found */
} comparison;

static char message[200];

static bool
same(ty_position a, ty_position b)
{
	return a.x == b.x && a.y == b.y;
}

/* the vertices in the mesh; NULL when they are the distinct positions of the live vertices, each once */
static const char *
vertices_of_mesh(const reference *ref, const ty_mesh *mesh, uint32_t *list, size_t *m)
{
	*m = 0;
	for (uint32_t v = 0; v < ref->n; v++)
	{
		if (mesh->vertex[v].edge == TY_NONE)
			continue;
		if (!ref->vertex[v].live)
			return "a vertex that is gone is still in the mesh";
		if (!same(mesh->vertex[v].position, ref->vertex[v].at))
			return "a vertex of the mesh is elsewhere";
		for (size_t i = 0; i < *m; i++)
			if (same(mesh->vertex[list[i]].position, mesh->vertex[v].position))
				return "two vertices of the mesh are at one position";
		list[(*m)++] = v;
	}
	for (uint32_t v = 0; v < ref->n; v++)
	{
		bool found = !ref->vertex[v].live;

		for (size_t i = 0; i < *m && !found; i++)
			found = same(mesh->vertex[list[i]].position, ref->vertex[v].at);
		if (!found)
			return "the position of a live vertex is not in the mesh";
	}
	return NULL;
}

static const char *
compare_edges(const ty_mesh *mesh, const uint32_t *list, size_t m)
{
	reference_edges expected;
	reference_edges found;
	ty_position position[REFERENCE_MAX];

	memset(found, 0, sizeof found);
	for (size_t i = 0; i < m; i++)
	{
		uint32_t first = mesh->vertex[list[i]].edge;
		uint32_t h = first;

		do
		{
			if (ty_origin(mesh, h) != list[i])
				return "walking around a vertex leads away from it";
			if (ty_target(mesh, h) != TY_GHOST)
				found[list[i]][ty_target(mesh, h)] = true;
			h = ty_next_around(mesh, h);
		} while (h != first);
	}
	positions_of_vertices(mesh->vertex, mesh->vertices, position);
	reference_delaunay(position, list, m, expected);
	return memcmp(expected, found, sizeof found) == 0 ? NULL : "the edges are not those of the reference mesh";
}

/* A mesh of one vertex has no half-edge by which it could be known to be in it. */
static const char *
compare_mesh(const reference *ref, const ty_mesh *mesh)
{
	uint32_t list[REFERENCE_MAX];
	size_t m;
	const char *difference = ty_mesh_check(mesh);

	if (difference != NULL || mesh->live <= 1)
		return difference;
	difference = vertices_of_mesh(ref, mesh, list, &m);
	if (difference == NULL && m != mesh->live)
		difference = "the mesh miscounts its vertices";
	return difference != NULL ? difference : compare_edges(mesh, list, m);
}

/* Merges the reference up to this many merges. */
static bool
follow(comparison *c, size_t merges)
{
	while (c->merges < merges && reference_can_go_on(&c->ref))
		c->merge[c->merges++] = reference_step(&c->ref);
	return c->merges == merges;
}

/*
 * Vertices that coincide at the start are merged before there is a mesh. A vertex that has come to lie on another may
 * be merged with it in the same call as the merge that moved it there.
 */
static void
after_merge(void *context, const ty_mesh *mesh, size_t step)
{
	comparison *c = context;

	if (c->difference != NULL)
		return;
	if (!follow(c, step))
		c->difference = "the core merges more than there is";
	else if (mesh != NULL)
		c->difference = compare_mesh(&c->ref, mesh);
	if (c->difference == NULL)
		return;
	snprintf(message, sizeof message, "after merge %zu: %s", step, c->difference);
	c->difference = message;
}

/* bit for bit: no cost is negative zero or NaN */
static bool
same_merge(const ty_sequence *sequence, size_t i, reference_merge expected)
{
	return sequence->kept[i] == expected.kept && sequence->gone[i] == expected.gone &&
		   memcmp(&sequence->cost[i], &expected.cost, sizeof expected.cost) == 0;
}

static const char *
compare_sequence(comparison *c, const ty_sequence *sequence, ty_stop stop)
{
	const char *difference = c->difference; /* as the message may be written anew */

	if (!follow(c, sequence->count))
		return "the sequence is not as long as there were merges";
	for (size_t i = 0; i < c->merges && i < sequence->count; i++)
		if (!same_merge(sequence, i, c->merge[i]))
		{
			snprintf(message, sizeof message, "merge %zu: core %u <- %u at %a, reference %u <- %u at %a", i + 1,
					 sequence->kept[i], sequence->gone[i], sequence->cost[i], c->merge[i].kept, c->merge[i].gone,
					 c->merge[i].cost);
			return message;
		}
	if (difference != NULL)
		return difference;
	return reference_must_go_on(&c->ref, stop) ? "the core stopped too early" : NULL;
}

static const char *
compare_positions(const reference *ref, const ty_position *position)
{
	for (size_t i = 0; i < ref->n; i++)
		if (ref->vertex[i].live && !same(ref->vertex[i].at, position[i]))
			return "a vertex that is left is elsewhere";
	return NULL;
}

/* the merge before the last must have been needed: else the core went on too long */
static const char *
check_need_of_last(const ty_position *position, const comparison *c, double s_u, const ty_influence *influence,
				   ty_stop stop)
{
	reference again;

	reference_begin(&again, position, c->ref.n, s_u, influence, c->candidates);
	for (size_t i = 0; i < c->merges; i++)
	{
		if (!reference_must_go_on(&again, stop))
			return "the core stopped too late";
		reference_step(&again);
	}
	return NULL;
}

const char *
compare_unwatched(const ty_position *position, size_t n, double s_u, const ty_influence *influence, ty_stop stop,
				  const ty_sequence *watched, const ty_position *end)
{
	ty_position moved[REFERENCE_MAX];
	ty_sequence s = {0};
	bool same;

	memcpy(moved, position, n * sizeof *moved);
	if (influence != NULL && influence->rows != NULL)
		reset_rows(influence->rows, n);
	if (ty_collapse(&ty_plain_environment, moved, n, s_u, influence, stop, true, NULL, NULL, &s) != TY_OK)
		return "the core gives an error when nobody watches";
	same = s.count == watched->count && memcmp(moved, end, n * sizeof *moved) == 0;
	if (same && s.count > 0)
		same = memcmp(s.kept, watched->kept, s.count * sizeof *s.kept) == 0 &&
			   memcmp(s.gone, watched->gone, s.count * sizeof *s.gone) == 0 &&
			   memcmp(s.cost, watched->cost, s.count * sizeof *s.cost) == 0;
	ty_sequence_free(&ty_plain_environment, &s);
	return same ? NULL : "the core merges otherwise when nobody watches";
}

const char *
compare_with_reference(const ty_position *position, size_t n, double s_u, const ty_influence *influence, ty_stop stop,
					   reference_candidates candidates)
{
	static comparison c;
	ty_position moved[REFERENCE_MAX];
	ty_sequence sequence = {0};
	ty_status status;
	const char *difference;

	memcpy(moved, position, n * sizeof *moved);
	reference_begin(&c.ref, position, n, s_u, influence, candidates);
	c.candidates = candidates;
	c.merges = 0;
	c.difference = NULL;
	status = ty_collapse(&ty_plain_environment, moved, n, s_u, influence, stop, true, after_merge, &c, &sequence);
	if (status != TY_OK)
		return "the core gives an error";
	difference = compare_sequence(&c, &sequence, stop);
	if (difference == NULL)
		difference = compare_unwatched(position, n, s_u, influence, stop, &sequence, moved);
	ty_sequence_free(&ty_plain_environment, &sequence);
	if (difference == NULL)
		difference = compare_positions(&c.ref, moved);
	if (difference == NULL && stop.min_distance > 0)
		difference = check_need_of_last(position, &c, s_u, influence, stop);
	return difference;
}

/* a set and what the influence says of its vertices */
typedef struct rest
{
	ty_position position[REFERENCE_MAX];
	double importance[REFERENCE_MAX];
	uint32_t row[REFERENCE_MAX];
	given_rows rows;
	ty_influence influence; /* of these arrays */
} rest;

static void
copy_without(rest *to, const rest *from, size_t n, size_t without)
{
	size_t count = 0;

	for (size_t i = 0; i < n; i++)
	{
		if (i == without)
			continue;
		to->position[count] = from->position[i];
		to->importance[count] = from->importance[i];
		to->row[count++] = from->row[i];
	}
	to->influence = from->influence;
	to->influence.importance = from->influence.importance == NULL ? NULL : to->importance;
	to->influence.rows = from->influence.rows == NULL ? NULL : &to->rows.rows;
	if (from->influence.rows != NULL)
		give_rows(&to->rows, to->row, count, (uint32_t) from->influence.rows->count, from->influence.rows->spacing[0]);
}

size_t
compare_minimise(ty_position *position, size_t n, double s_u, const ty_influence *influence, ty_stop stop,
				 reference_candidates candidates)
{
	static rest set, fewer;

	memset(&set, 0, sizeof set);
	memcpy(set.position, position, n * sizeof *position);
	if (influence != NULL)
		set.influence = *influence;
	if (set.influence.importance != NULL)
		memcpy(set.importance, influence->importance, n * sizeof *set.importance);
	if (set.influence.rows != NULL)
		for (size_t r = 0; r < n; r++)
			set.row[r] = TY_NONE;
	for (uint32_t r = 0; set.influence.rows != NULL && r < set.influence.rows->count; r++)
		for (uint32_t i = influence->rows->first[r]; i < influence->rows->first[r + 1]; i++)
			set.row[influence->rows->member[i]] = r;
	for (size_t i = 0; i < n;)
	{
		ty_stop held = stop;

		copy_without(&fewer, &set, n, i);
		held.count = n - 1 > 0 && held.count > n - 1 ? n - 1 : held.count;
		if (n > 1 && compare_with_reference(fewer.position, n - 1, s_u, influence == NULL ? NULL : &fewer.influence,
											held, candidates) != NULL)
		{
			n--;
			copy_without(&set, &fewer, n, n);
			i = 0;
		}
		else
			i++;
	}
	memcpy(position, set.position, n * sizeof *position);
	for (size_t i = 0; influence != NULL && i < n; i++)
		printf("  {%d, %d} importance %g, row %d\n", position[i].x, position[i].y, set.importance[i], (int) set.row[i]);
	return n;
}
