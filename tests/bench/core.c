/*
 * core.c - how long the core takes, step by step, without a server.
 *
 *     core phases N RUNS FIGURES SET...    the steps of one group, GEOS's Delaunay beside them
 *     core shapes N RUNS                   shapes known to hurt, beside the uniform set
 *     core instructions N SET...           one run, to be counted by callgrind: a dump at the end of each step
 *
 * N 0 takes all points of a file. A SET is a name that points.c knows, or NAME=FILE of points. FILE lines are what
 * the server's benchmark exports. FIGURES is all, or brief: order, mesh and collapse to a third alone. Prints
 * "set <tab> figure <tab> value", a line a run, with values in seconds of the processor's time or in bytes;
 * report.awk makes tables of them.
 */
#include "geos.h"
#include "points.h"
#include "steps.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#if defined(TY_WITH_VALGRIND)
#include <valgrind/callgrind.h>
#else
#define CALLGRIND_ZERO_STATS
#define CALLGRIND_DUMP_STATS_AT(name)
#endif

static void
say(const bench *b, const char *figure, double value)
{
	printf("%s\t%s\t%.9g\n", b->name, figure, value);
	fflush(stdout);
}

static void
run_phases(bench *b, bool all)
{
	double geos;

	say(b, "core order", bench_order(b));
	say(b, "core mesh", bench_mesh(b));
	say(b, "core collapse to a third", bench_collapse(b, S_U, b->n / 3));
	if (!all)
		return;
	say(b, "core whole", bench_whole(b));
	say(b, "core collapse to one", bench_collapse(b, S_U, 1));
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
		say(&b, "core bytes", bench_peak(&b));
		bench_end(&b);
	}
}

/* Sets take turns, so that each is compared with a uniform set of the same time. */
static void
shapes(size_t n, size_t runs)
{
	printf("shapes\tn\t%zu\n", n);
	for (size_t run = 0; run < runs; run++)
		for (const char *const *set = adversarial_sets; *set != NULL; set++)
		{
			bench b;
			double ordered;

			bench_begin(&b, *set, n);
			ordered = bench_order(&b);
			say(&b, "shape to a third", ordered + bench_collapse(&b, S_U, n / 3));
			say(&b, "shape to one, s_u 0", ordered + bench_collapse(&b, 0, 1));
			say(&b, "shape to one, s_u 0.5", ordered + bench_collapse(&b, S_U, 1));
			say(&b, "shape to one, s_u 1", ordered + bench_collapse(&b, 1, 1));
			if (run == 0)
				say(&b, "shape bytes", bench_peak(&b));
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
		bench_order(&b);
		CALLGRIND_DUMP_STATS_AT("order");
		bench_mesh(&b);
		CALLGRIND_DUMP_STATS_AT("mesh");
		bench_collapse(&b, S_U, b.n / 3);
		CALLGRIND_DUMP_STATS_AT("collapse to a third");
		bench_collapse(&b, S_U, 1);
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
