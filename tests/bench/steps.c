/* steps.c - see steps.h */
#include "steps.h"

#include "clock.h"
#include "collapse.h"
#include "counting.h"
#include "group.h"
#include "points.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const ty_parameters at_75000 = {.scale = 75000,
									   .s_u = S_U,
									   .source_scale = TY_DEFAULT_SOURCE_SCALE,
									   .lod200_scale = TY_DEFAULT_LOD200_SCALE,
									   .exponent = TY_DEFAULT_EXPONENT,
									   .psi = TY_DEFAULT_PSI,
									   .law = true};

static void *
need(size_t size)
{
	void *memory = malloc(size);

	if (memory == NULL)
	{
		fprintf(stderr, "out of memory\n");
		exit(1);
	}
	return memory;
}

static void
check(ty_status status, const bench *b, const char *step)
{
	if (status == TY_OK)
		return;
	fprintf(stderr, "%s: %s: status %d\n", b->name, step, status);
	exit(1);
}

void
bench_begin(bench *b, const char *set, size_t n)
{
	const char *file = strchr(set, '=');

	*b = (bench){.name = set, .n = n};
	if (file != NULL)
	{
		char *name = need((size_t) (file - set) + 1);

		memcpy(name, set, (size_t) (file - set));
		name[file - set] = 0;
		b->name = name; /* to the program's end */
		b->buildings = read_set(file + 1, n, &b->n);
		if (b->buildings == NULL)
			exit(1);
	}
	else
	{
		b->buildings = need(n * sizeof *b->buildings);
		if (n == 0 || !make_set(set, b->buildings, n))
		{
			fprintf(stderr, "there is no set %s of %zu points\n", set, n);
			exit(1);
		}
	}
	b->order = need(b->n * sizeof *b->order);
	b->distinct = need(b->n * sizeof *b->distinct);
	b->position = need(b->n * sizeof *b->position);
	b->moved = need(b->n * sizeof *b->moved);
	b->keys = need(b->n * sizeof *b->keys);
}

void
bench_end(bench *b)
{
	free(b->buildings);
	free(b->order);
	free(b->distinct);
	free(b->position);
	free(b->moved);
	free(b->keys);
}

double
bench_order(bench *b)
{
	double start = clock_seconds();
	ty_grid grid;

	check(ty_grid_fit(b->buildings, b->n, &grid), b, "grid");
	check(ty_canonical_order(&ty_plain_environment, b->buildings, b->n, &grid, b->order, b->position, b->keys), b,
		  "order");
	return clock_seconds() - start;
}

/* one vertex of each place, and its key at the front of the keys */
static size_t
list_distinct(bench *b)
{
	size_t places = 0;

	for (size_t v = 0; v < b->n; v++)
		if (v == 0 || b->keys[v] != b->keys[places - 1])
		{
			b->keys[places] = b->keys[v];
			b->distinct[places++] = (uint32_t) v;
		}
	return places;
}

double
bench_mesh(bench *b)
{
	double start = clock_seconds(), seconds;
	size_t places = list_distinct(b);
	ty_vertex *vertex = need(b->n * sizeof *vertex);
	ty_mesh mesh;

	for (size_t v = 0; v < b->n; v++)
		vertex[v] = (ty_vertex){b->position[v], TY_NONE, 1};
	check(ty_mesh_build(&ty_plain_environment, vertex, b->n, b->distinct, b->keys, places, &mesh), b, "mesh");
	seconds = clock_seconds() - start;
	ty_mesh_free(&mesh);
	free(vertex);
	return seconds;
}

double
bench_collapse(bench *b, double s_u, size_t count)
{
	ty_stop stop = {count < 1 ? 1 : count, 0};
	ty_sequence sequence;
	double start, seconds;

	memcpy(b->moved, b->position, b->n * sizeof *b->moved);
	start = clock_seconds();
	check(ty_collapse(&ty_plain_environment, b->moved, b->n, s_u, NULL, stop, false, NULL, NULL, &sequence), b,
		  "collapse");
	seconds = clock_seconds() - start;
	ty_sequence_free(&ty_plain_environment, &sequence);
	return seconds;
}

double
bench_whole(bench *b)
{
	double start = clock_seconds(), seconds;
	ty_result result;

	check(ty_typify(&ty_plain_environment, &(ty_input){.buildings = b->buildings, .n = b->n}, &at_75000, &result), b,
		  "typify");
	seconds = clock_seconds() - start;
	ty_result_free(&ty_plain_environment, &result);
	return seconds;
}

double
bench_peak(bench *b)
{
	counting counter;
	ty_environment env = counting_environment(&counter);
	ty_result result;

	check(ty_typify(&env, &(ty_input){.buildings = b->buildings, .n = b->n}, &at_75000, &result), b, "typify");
	ty_result_free(&env, &result);
	return (double) sizeof *b->buildings + (double) counter.peak / (double) b->n;
}
