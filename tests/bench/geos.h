/* geos.h - GEOS's Delaunay triangulation, the yardstick of ours. */
#ifndef TY_BENCH_GEOS_H
#define TY_BENCH_GEOS_H

#include "measure.h"

/* Seconds that GEOS takes to triangulate the centroids, its own input aside; negative: not built with GEOS. */
double geos_delaunay_seconds(const ty_building *buildings, size_t n);
/* "" when not built with GEOS */
const char *geos_version(void);

#endif
