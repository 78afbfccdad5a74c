/* geos.c - see geos.h. Without GEOS's development files it says so, and the rest of the benchmark runs. */
#include "geos.h"

#if defined(TY_WITH_GEOS)

#include "clock.h"

#include <geos_c.h>

static GEOSGeometry *
points_of(GEOSContextHandle_t geos, const ty_building *buildings, size_t n)
{
	GEOSCoordSequence *sequence = GEOSCoordSeq_create_r(geos, (unsigned int) n, 2);

	for (size_t i = 0; sequence != NULL && i < n; i++)
		GEOSCoordSeq_setXY_r(geos, sequence, (unsigned int) i, buildings[i].x, buildings[i].y);
	/* one geometry of many points: a line takes the least memory, and the triangulation reads the points alone */
	return sequence == NULL ? NULL : GEOSGeom_createLineString_r(geos, sequence);
}

double
geos_delaunay_seconds(const ty_building *buildings, size_t n)
{
	GEOSContextHandle_t geos = GEOS_init_r();
	GEOSGeometry *points = points_of(geos, buildings, n), *triangles;
	double start, seconds;

	start = clock_seconds();
	triangles = points == NULL ? NULL : GEOSDelaunayTriangulation_r(geos, points, 0, 0);
	seconds = triangles == NULL ? -1 : clock_seconds() - start;
	GEOSGeom_destroy_r(geos, triangles);
	GEOSGeom_destroy_r(geos, points);
	GEOS_finish_r(geos);
	return seconds;
}

const char *
geos_version(void)
{
	return GEOSversion();
}

#else

double
geos_delaunay_seconds(const ty_building *buildings, size_t n)
{
	(void) buildings;
	(void) n;
	return -1;
}

const char *
geos_version(void)
{
	return "";
}

#endif
