/*
 * points.h - the sets that the core is measured on: generated ones, or centroids from a file.
 *
 * Generated sets are a function of name and n alone. Besides those of this file there are all large sets of the unit
 * tests, named as there.
 */
#ifndef TY_BENCH_POINTS_H
#define TY_BENCH_POINTS_H

#include "measure.h"

/* The usual set of each kind, and the shapes that a triangulation or a clustering is known to suffer from. */
extern const char *const usual_sets[];		 /* closed by NULL */
extern const char *const adversarial_sets[]; /* the same; the first one is uniform, to compare with */

/* n buildings of the set; false when there is no such set */
bool make_set(const char *name, ty_building *buildings, size_t n);
/*
 * Reads lines "x y area" as PostgreSQL's COPY writes them, at most `most` of them (0: all). The array is the caller's
 * to free; NULL, with a word on stderr, when the file cannot be read.
 */
ty_building *read_set(const char *path, size_t most, size_t *n);

#endif
