/*
 * steps.h - the core's steps over one set, one by one: each leaves what the next one needs, and tells how many seconds
 * it took. What fails ends the program.
 */
#ifndef TY_BENCH_STEPS_H
#define TY_BENCH_STEPS_H

#include "grid.h"

#define S_U 0.5

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

/* n points of a generated set, or of a file given as NAME=FILE: there n is the most that is read, 0 for all */
void bench_begin(bench *b, const char *set, size_t n);
void bench_end(bench *b);

double bench_order(bench *b);
/* after the order, whose keys it uses up */
double bench_mesh(bench *b);
/* after the order; its own mesh included */
double bench_collapse(bench *b, double s_u, size_t count);
/* all of it, from buildings to placeholders at 1:75 000 */
double bench_whole(bench *b);
/* bytes a building at the peak of the whole, the buildings themselves and the result included */
double bench_peak(bench *b);

#endif
