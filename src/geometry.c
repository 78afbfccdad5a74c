/* geometry.c - see geometry.h */
#include "geometry.h"

#include <math.h>

#include "common/hashfn.h"
#include "utils/memutils.h"

#include "backend.h"

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

Datum
ty_collection_datum(const ty_result *result, int32 srid)
{
	size_t drawn = count_drawn(result);
	size_t size = VARHDRSZ + TY_COLLECTION_PAYLOAD(drawn);
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
		if (!is_drawn(&result->placeholders[i]))
			continue;
		rectangle_ring(&result->placeholders[i], ring);
		ty_collection_add(&writer, ring);
	}
	ty_collection_end(&writer);
	return PointerGetDatum(value);
}
