/* geometry.c - see geometry.h */
#include "geometry.h"

#include <math.h>

#include "common/hashfn.h"
#include "miscadmin.h"
#include "utils/memutils.h"

#include "backend.h"
#include "postgis.h"

/* A geometry's bytes; the value itself where it is neither compressed nor stored elsewhere, else a copy. */
typedef struct detoasted
{
	struct varlena *value;
	const unsigned char *payload;
	size_t size;
	bool copied;
} detoasted;

static detoasted
detoast(Datum geometry)
{
	detoasted d;

	d.value = PG_DETOAST_DATUM_PACKED(geometry);
	d.payload = (const unsigned char *) VARDATA_ANY(d.value);
	d.size = VARSIZE_ANY_EXHDR(d.value);
	d.copied = (Pointer) d.value != DatumGetPointer(geometry);
	return d;
}

static void
release(detoasted *d)
{
	if (d->copied)
		pfree(d->value);
}

static void
refuse_type(uint32_t type)
{
	const char *hint = type == TY_GEOMETRY_COLLECTION
						   ? "Use ST_CollectionExtract(geom, 3) to get the polygons of a collection."
						   : "Use ST_CurveToLine to turn curves into polygons, or ST_CollectionExtract for surfaces.";

	ereport(ERROR, errcode(ERRCODE_FEATURE_NOT_SUPPORTED),
			errmsg("geometry type %s is not supported", ty_geometry_type_name(type)), errhint("%s", hint));
}

/* area: what the coordinates gave, unless one of them is at fault */
static void
refuse_not_finite(const detoasted *d, double area)
{
	double value;

	if (ty_geometry_find_not_finite(d->payload, d->size, &value))
		ereport(ERROR, errcode(ERRCODE_INVALID_PARAMETER_VALUE),
				errmsg("a coordinate of the geometry is %s, it must be a finite number", ty_number_text(value)));
	ereport(ERROR, errcode(ERRCODE_INVALID_PARAMETER_VALUE),
			errmsg("the area of the geometry is %s, it must be a finite number", ty_number_text(area)));
}

/* Returns for TY_GEOMETRY_OK and TY_GEOMETRY_EMPTY. */
static void
check_geometry(ty_geometry_status status, const detoasted *d, uint32_t type, const ty_building *building)
{
	switch (status)
	{
		case TY_GEOMETRY_OK:
		case TY_GEOMETRY_EMPTY:
			return;
		case TY_GEOMETRY_UNSUPPORTED:
			refuse_type(type);
			return;
		case TY_GEOMETRY_NOT_FINITE:
			refuse_not_finite(d, building->area);
			return;
		case TY_GEOMETRY_CORRUPT:
			ereport(ERROR, errcode(ERRCODE_DATA_CORRUPTED), errmsg("the geometry is truncated or corrupt"));
		case TY_GEOMETRY_NO_MEMORY:
			ty_check_status(TY_NO_MEMORY);
			return;
		case TY_GEOMETRY_INTERRUPTED:
			ty_check_status(TY_INTERRUPTED);
			return;
	}
}

bool
ty_measure_datum(Datum geometry, ty_building *building, int32 *srid, uint64 *hash)
{
	detoasted d = detoast(geometry);
	uint32_t type = 0;
	ty_geometry_status status = ty_geometry_read(&ty_backend_environment, d.payload, d.size, building, srid, &type);

	check_geometry(status, &d, type, building);
	if (hash != NULL)
		*hash = hash_bytes_extended(d.payload, (int) d.size, 0);
	release(&d);
	return status == TY_GEOMETRY_OK;
}

bool
ty_point_datum(Datum geometry, const char *argument, ty_point *point, int32 *srid)
{
	detoasted d = detoast(geometry);
	ty_building building;
	uint32_t type = 0;
	ty_geometry_status status = ty_geometry_read(&ty_backend_environment, d.payload, d.size, &building, srid, &type);

	if (status != TY_GEOMETRY_CORRUPT && type != TY_GEOMETRY_POINT)
		ereport(ERROR, errcode(ERRCODE_INVALID_PARAMETER_VALUE),
				errmsg("%s is a %s, it must be a Point", argument, ty_geometry_type_name(type)),
				errhint("Use ST_Centroid to get a point."));
	check_geometry(status, &d, type, &building);
	release(&d);
	if (status == TY_GEOMETRY_EMPTY)
		return false;
	*point = (ty_point){building.x, building.y};
	return true;
}

bool
ty_geometry_datum_has_points(Datum geometry)
{
	detoasted d = detoast(geometry);
	ty_geometry_status status = ty_geometry_has_points(d.payload, d.size);

	check_geometry(status, &d, 0, NULL);
	release(&d);
	return status == TY_GEOMETRY_OK;
}

ty_point *
ty_line_points(Datum geometry, uint32 *n)
{
	detoasted d = detoast(geometry);
	const unsigned char *bytes;
	size_t stride;
	ty_point *points = NULL;

	if (ty_geometry_line(d.payload, d.size, &bytes, &stride, n))
	{
		points = palloc(*n * sizeof(ty_point));
		for (uint32 i = 0; i < *n; i++)
			memcpy(&points[i], bytes + i * stride, sizeof(ty_point));
	}
	release(&d);
	return points;
}

Datum
ty_ring_datum(const ty_point *ring, uint32 n, int32 srid)
{
	size_t size = VARHDRSZ + TY_RING_PAYLOAD(n);
	struct varlena *value = palloc(size);

	SET_VARSIZE(value, size);
	ty_geometry_write_ring((unsigned char *) VARDATA(value), srid, ring, n);
	return PointerGetDatum(value);
}

Datum
ty_line_datum(int32 srid, uint32 n, ty_point **points)
{
	size_t size = VARHDRSZ + TY_LINE_PAYLOAD(n);
	struct varlena *value = palloc(size);

	SET_VARSIZE(value, size);
	ty_geometry_begin_line((unsigned char *) VARDATA(value), srid, n);
	/* a payload begins 4 bytes after the value does, and its points 12 further on: they are aligned */
	*points = (ty_point *) ((char *) value + size - n * sizeof(ty_point));
	return PointerGetDatum(value);
}

static void
rectangle_ring(const ty_placeholder *placeholder, ty_point ring[5])
{
	ty_rectangle((ty_point){placeholder->x, placeholder->y}, placeholder->area, placeholder->ratio, placeholder->ux,
				 placeholder->uy, ring);
	for (int i = 0; i < 5; i++)
		if (!isfinite(ring[i].x) || !isfinite(ring[i].y))
			ereport(ERROR, errcode(ERRCODE_NUMERIC_VALUE_OUT_OF_RANGE),
					errmsg("a placeholder of area %s and ratio %s is too large for double precision",
						   ty_number_text(placeholder->area), ty_number_text(placeholder->ratio)),
					errhint("Use a smaller area, that is a smaller scale denominator, or a ratio nearer to 1."));
}

Datum
ty_write_rectangle(void *memory, const ty_placeholder *placeholder, int32 srid)
{
	ty_point ring[5];

	rectangle_ring(placeholder, ring);
	SET_VARSIZE(memory, TY_POLYGON_DATUM_SIZE);
	ty_geometry_write_polygon((unsigned char *) VARDATA(memory), srid, ring);
	return PointerGetDatum(memory);
}

void
ty_refuse_size(void)
{
	ereport(ERROR, errcode(ERRCODE_PROGRAM_LIMIT_EXCEEDED), errmsg("the result would be larger than 1 GB"),
			errhint("Use GROUP BY to typify smaller groups, such as blocks or settlements."));
}

/* ---- outlines ---- */

static ty_outline *
read_outline(Datum geometry)
{
	detoasted d = detoast(geometry);
	ty_outline *outline = NULL;
	ty_geometry_status status = ty_geometry_outline(&ty_backend_environment, d.payload, d.size, &outline);

	check_geometry(status, &d, TY_GEOMETRY_POLYGON, NULL);
	release(&d);
	return outline;
}

ty_outline *
ty_copy_outline(const ty_outline *outline, MemoryContext context)
{
	size_t size = ty_outline_size(outline->rings, outline->points);
	ty_outline *copy = MemoryContextAllocHuge(context, size);

	memcpy(copy, outline, size);
	return copy;
}

/* A copy of the outline, so large that its rectangle is the placeholder's, and at that one's place. */
static ty_outline *
fitted_outline(const ty_outline *outline, const ty_placeholder *placeholder)
{
	double factor = sqrt(placeholder->area / outline->area);
	ty_point box = ty_outline_box_centre(outline, factor);
	ty_outline *fitted = ty_copy_outline(outline, CurrentMemoryContext);

	ty_outline_move(fitted, (ty_point){placeholder->x - box.x, placeholder->y - box.y}, factor);
	return fitted;
}

size_t
ty_outline_polygon_size(const ty_outline *outline)
{
	return VARHDRSZ + ty_outline_payload(outline);
}

static struct varlena *
polygon_of_outline(const ty_outline *outline, int32 srid)
{
	size_t size = ty_outline_polygon_size(outline);
	struct varlena *polygon = palloc(size);

	SET_VARSIZE(polygon, size);
	ty_geometry_write_outline((unsigned char *) VARDATA(polygon), srid, outline);
	return polygon;
}

/* Shorter detours of an outline are not seen: half of what the smallest gap between buildings is, 0.2 mm. */
#define LEAST_DETOUR 0.1

/*
 * The outline without detours below the tolerance, where it is a valid polygon; else none. Its centre stays the
 * building's: simplified or not, it is drawn in the same place.
 */
static ty_outline *
simplified_outline(Datum geometry, double tolerance, Oid geometry_type)
{
	ty_outline *outline = read_outline(geometry), *simple;
	struct varlena *polygon;

	if (outline == NULL)
		return NULL;
	polygon = polygon_of_outline(outline, 0);
	if (!ty_is_valid(PointerGetDatum(polygon), geometry_type))
		return NULL;
	simple = read_outline(ty_simplified(PointerGetDatum(polygon), tolerance, geometry_type));
	if (simple == NULL)
		return outline;
	ty_outline_set_centre(simple, outline->centre);
	pfree(outline);
	return simple;
}

ty_outline *
ty_outline_to_draw(Datum geometry, const ty_building *building, double importance, const ty_parameters *p,
				   double metres_per_unit, Oid geometry_type)
{
	ty_parameters ground = *p;

	if (p->shape == TY_FOOTPRINT)
		return read_outline(geometry);
	ty_bring_to_ground(&ground, metres_per_unit);
	if (p->shape != TY_AUTO || !ty_is_kept(&ground, building->area, importance))
		return NULL;
	return simplified_outline(geometry, LEAST_DETOUR / 1000 * p->scale / metres_per_unit, geometry_type);
}

struct varlena *
ty_outline_polygon(const ty_placeholder *placeholder, const ty_outline *outline, int32 srid)
{
	ty_outline *fitted = fitted_outline(outline, placeholder);
	struct varlena *polygon = polygon_of_outline(fitted, srid);

	pfree(fitted);
	return polygon;
}

void
ty_check_outlines(ty_result *result, ty_outline *const *outlines, Oid geometry_type)
{
	for (size_t i = 0; i < result->count; i++)
	{
		ty_placeholder *placeholder = &result->placeholders[i];
		struct varlena *polygon;

		CHECK_FOR_INTERRUPTS();
		if (!placeholder->outlined)
			continue;
		polygon = polygon_of_outline(outlines[placeholder->representative], 0);
		if (!ty_is_valid(PointerGetDatum(polygon), geometry_type))
		{
			placeholder->outlined = false;
			placeholder->area = placeholder->width * placeholder->length;
		}
		pfree(polygon);
	}
}

/* ---- collections ---- */

static bool
is_drawn(const ty_placeholder *placeholder)
{
	return placeholder->area > 0;
}

static size_t
count_drawn(const ty_result *result)
{
	size_t drawn = 0;

	for (size_t i = 0; i < result->count; i++)
		drawn += is_drawn(&result->placeholders[i]);
	return drawn;
}

static size_t
collection_size(const ty_result *result, ty_outline *const *outlines, size_t drawn)
{
	size_t size = VARHDRSZ + TY_COLLECTION_PAYLOAD(drawn);

	for (size_t i = 0; outlines != NULL && i < result->count; i++)
		if (result->placeholders[i].outlined)
			size += ty_outline_payload_in_collection(outlines[result->placeholders[i].representative]) -
					TY_RECTANGLE_IN_COLLECTION;
	return size;
}

Datum
ty_collection_datum(const ty_result *result, ty_outline *const *outlines, int32 srid)
{
	size_t drawn = count_drawn(result);
	size_t size = collection_size(result, outlines, drawn);
	ty_collection_writer writer;
	struct varlena *value;
	ty_point ring[5];

	if (!AllocSizeIsValid(size))
		ty_refuse_size();
	value = palloc(size);
	SET_VARSIZE(value, size);
	ty_collection_begin(&writer, (unsigned char *) VARDATA(value), srid, (uint32_t) drawn);
	for (size_t i = 0; i < result->count; i++)
	{
		const ty_placeholder *placeholder = &result->placeholders[i];

		if (!is_drawn(placeholder))
			continue;
		if (placeholder->outlined)
		{
			ty_outline *fitted = fitted_outline(outlines[placeholder->representative], placeholder);

			ty_collection_add_outline(&writer, fitted);
			pfree(fitted);
			continue;
		}
		rectangle_ring(placeholder, ring);
		ty_collection_add(&writer, ring);
	}
	ty_collection_end(&writer);
	return PointerGetDatum(value);
}
