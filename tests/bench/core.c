/*
 * core.c - how long the core takes, step by step, without a server.
 *
 *     core phases N RUNS FIGURES SET...    the steps of one group, GEOS's Delaunay beside them
 *     core shapes N RUNS                   shapes known to hurt, beside the uniform set
 *     core instructions N SET...           one run, to be counted by callgrind: a dump at the end of each step
 *
 * N 0 takes all points of a file. A SET is a name that points.c knows, or NAME=FILE of points. FILE lines are what
 * the server's benchmark exports. FIGURES is all, or brief: neither GEOS nor the full hierarchy. Prints
 * "set <tab> figure <tab> value" with values in seconds of the processor's time or bytes, a line a run; report.awk makes tables of them.
 */
#include "clock.h"
#include "collapse.h"
#include "counting.h"
#include "geos.h"
#include "group.h"
#include "points.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#if defined(TY_WITH_VALGRIND)
#include <valgrind/callgrind.h>
#else
#define CALLGRIND_ZERO_STATS
#define CALLGRIND_DUMP_STATS_AT(name)
#endif

#define S_U 0.5

static const ty_parameters at_75000 = {.scale = 75000,
									   .s_u = S_U,
									   .source_scale = TY_DEFAULT_SOURCE_SCALE,
									   .lod200_scale = TY_DEFAULT_LOD200_SCALE,
									   .exponent = TY_DEFAULT_EXPONENT,
									   .psi = TY_DEFAULT_PSI,
									   .law = true};

/* One set, and room for its canonical order and for one collapse. */
typedef struct bench
{
	const char *name;
	ty_building *buildings;
	size_t n;
	uint32_t *order, *distinct;
	ty_position *position, *moved;
	uint64_t *keys;
} bench;

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

static void
say(const bench *b, const char *figure, double value)
{
	printf("%s\t%s\t%.9g\n", b->name, figure, value);
	fflush(stdout);
}

/* "name" or "name=file" */
static void
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

static void
bench_end(bench *b)
{
	free(b->buildings);
	free(b->order);
	free(b->distinct);
	free(b->position);
	free(b->moved);
	free(b->keys);
}

/* ---- the steps; each leaves what the next one needs, and tells how long it took ---- */

static double
order(bench *b)
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

/* uses up the keys */
static double
mesh(bench *b)
{
	double start = clock_seconds(), seconds;
	size_t places = list_distinct(b);
	ty_mesh mesh;

	check(ty_mesh_build(&ty_plain_environment, b->position, b->n, b->distinct, b->keys, places, &mesh), b, "mesh");
	seconds = clock_seconds() - start;
	ty_mesh_free(&mesh);
	return seconds;
}

/* its own mesh included */
static double
collapse(bench *b, double s_u, size_t count)
{
	ty_stop stop = {count < 1 ? 1 : count, 0};
	ty_sequence sequence;
	double start, seconds;

	memcpy(b->moved, b->position, b->n * sizeof *b->moved);
	start = clock_seconds();
	check(ty_collapse(&ty_plain_environment, b->moved, b->n, s_u, stop, false, NULL, NULL, &sequence), b, "collapse");
	seconds = clock_seconds() - start;
	ty_sequence_free(&ty_plain_environment, &sequence);
	return seconds;
}

static double
whole(bench *b)
{
	double start = clock_seconds(), seconds;
	ty_result result;

	check(ty_typify(&ty_plain_environment, b->buildings, b->n, &at_75000, &result), b, "typify");
	seconds = clock_seconds() - start;
	ty_result_free(&ty_plain_environment, &result);
	return seconds;
}

/* bytes a building at the peak of the whole way, the buildings themselves and the result included */
static double
peak(bench *b)
{
	counting counter;
	ty_environment env = counting_environment(&counter);
	ty_result result;

	check(ty_typify(&env, b->buildings, b->n, &at_75000, &result), b, "typify");
	ty_result_free(&env, &result);
	return (double) sizeof *b->buildings + (double) counter.peak / (double) b->n;
}

/* ---- what the program does ---- */

static void
run_phases(bench *b, bool all)
{
	double geos;

	say(b, "core order", order(b));
	say(b, "core mesh", mesh(b));
	say(b, "core collapse to a third", collapse(b, S_U, b->n / 3));
	say(b, "core whole", whole(b));
	if (!all)
		return;
	say(b, "core collapse to one", collapse(b, S_U, 1));
	geos = geos_delaunay_seconds(b->buildings, b->n);
	if (geos >= 0)
		say(b, "GEOS Delaunay", geos);
}

static void
phases(size_t n, size_t runs, bool all, char **sets)
{
	for (; *sets != NULL; sets++)
	{
		bench b;

		bench_begin(&b, *sets, n);
		say(&b, "points", (double) b.n);
		for (size_t run = 0; run < runs; run++)
			run_phases(&b, all);
		say(&b, "core bytes", peak(&b));
		bench_end(&b);
	}
}

/* Sets take turns, so that each is compared with a uniform set of the same time. */
static void
shapes(size_t n, size_t runs)
{
	for (size_t run = 0; run < runs; run++)
		for (const char *const *set = adversarial_sets; *set != NULL; set++)
		{
			bench b;
			double ordered;

			bench_begin(&b, *set, n);
			ordered = order(&b);
			say(&b, "shape to a third", ordered + collapse(&b, S_U, n / 3));
			say(&b, "shape to one, s_u 0", ordered + collapse(&b, 0, 1));
			say(&b, "shape to one, s_u 0.5", ordered + collapse(&b, S_U, 1));
			say(&b, "shape to one, s_u 1", ordered + collapse(&b, 1, 1));
			if (run == 0)
				say(&b, "shape bytes", peak(&b));
			bench_end(&b);
		}
}

static void
instructions(size_t n, char **sets)
{
	for (; *sets != NULL; sets++)
	{
		bench b;

		bench_begin(&b, *sets, n);
		CALLGRIND_ZERO_STATS;
		order(&b);
		CALLGRIND_DUMP_STATS_AT("order");
		mesh(&b);
		CALLGRIND_DUMP_STATS_AT("mesh");
		collapse(&b, S_U, b.n / 3);
		CALLGRIND_DUMP_STATS_AT("collapse to a third");
		collapse(&b, S_U, 1);
		CALLGRIND_DUMP_STATS_AT("collapse to one");
		bench_end(&b);
	}
}

int
main(int argc, char **argv)
{
	size_t n = argc > 2 ? strtoull(argv[2], NULL, 10) : 0;
	size_t runs = argc > 3 ? strtoull(argv[3], NULL, 10) : 0;

	if (argc > 5 && strcmp(argv[1], "phases") == 0)
		phases(n, runs, strcmp(argv[4], "all") == 0, argv + 5);
	else if (argc == 4 && strcmp(argv[1], "shapes") == 0 && n > 0)
		shapes(n, runs);
	else if (argc > 3 && strcmp(argv[1], "instructions") == 0)
		instructions(n, argv + 3);
	else
	{
		fprintf(stderr, "usage: core phases N RUNS all|brief SET... | shapes N RUNS | instructions N SET...\n");
		return 2;
	}
	if (*geos_version() != 0)
		printf("*\tGEOS version\t%s\n", geos_version());
	return 0;
}
