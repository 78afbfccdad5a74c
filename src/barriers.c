/* barriers.c - see barriers.h */
#include "barriers.h"

#include <math.h>

#include "common/hashfn.h"
#include "utils/memutils.h"

#include "backend.h"
#include "geometry_format.h"

/* ---- checks ---- */

static bool
pass_over(void *context, const unsigned char *points, size_t stride, uint32_t n)
{
	bool *finite = context;

	for (uint32_t i = 0; i < n; i++)
	{
		double xy[2];

		memcpy(xy, points + (size_t) i * stride, sizeof(xy));
		*finite = *finite && isfinite(xy[0]) && isfinite(xy[1]);
	}
	return true;
}

static _Noreturn void
refuse_type(uint32_t type)
{
	if (type == TY_GEOMETRY_POINT || type == TY_GEOMETRY_MULTIPOINT || type == TY_GEOMETRY_COLLECTION)
		ereport(ERROR, errcode(ERRCODE_INVALID_PARAMETER_VALUE),
				errmsg("barriers is a %s without lines, it must have lines or polygons", ty_geometry_type_name(type)),
				errhint("Collect the lines of roads, rivers or railways: ST_Collect(geom)."));
	ereport(ERROR, errcode(ERRCODE_FEATURE_NOT_SUPPORTED),
			errmsg("barriers of geometry type %s are not supported", ty_geometry_type_name(type)),
			errhint("Use ST_CurveToLine to turn curves into lines, or ST_Boundary for surfaces."));
}

static _Noreturn void
refuse_not_finite(const unsigned char *payload, size_t size)
{
	double value = NAN;

	ty_geometry_find_not_finite(payload, size, &value);
	ereport(ERROR, errcode(ERRCODE_INVALID_PARAMETER_VALUE),
			errmsg("a coordinate of barriers is %s, it must be a finite number", ty_number_text(value)));
}

#define LANES 4

/*
 * Many megabytes at the speed of memory: four lanes take a word each in turn, none of which gets lost, and what they
 * come to is hashed with the rest and the size.
 */
static ty_barrier_hash
hash_of(const unsigned char *payload, size_t size)
{
	struct
	{
		uint64 lane[LANES], size;
		unsigned char rest[LANES * sizeof(uint64)];
	} sum = {{1, 2, 3, 4}, size, {0}};
	size_t whole = size - size % sizeof(sum.rest);
	ty_barrier_hash hash;

	for (size_t at = 0; at < whole; at += sizeof(sum.rest))
		for (int i = 0; i < LANES; i++)
		{
			uint64 word;

			memcpy(&word, payload + at + i * sizeof(word), sizeof(word));
			word = (sum.lane[i] ^ word) * UINT64CONST(0x9e3779b97f4a7c15);
			sum.lane[i] = word << 29 | word >> 35;
		}
	memcpy(sum.rest, payload + whole, size - whole);
	hash.low = hash_bytes_extended((const unsigned char *) &sum, sizeof(sum), 0);
	hash.high = hash_bytes_extended((const unsigned char *) &sum, sizeof(sum), 1) | 1; /* never 0 */
	return hash;
}

/* Raises an error where the payload cannot be barriers. False: it is EMPTY. */
static bool
check_payload(const unsigned char *payload, size_t size)
{
	bool finite = true;
	int32 srid;
	uint32_t type;

	switch (ty_geometry_visit_lines(payload, size, pass_over, &finite, &srid, &type))
	{
		case TY_GEOMETRY_OK:
			if (!finite)
				refuse_not_finite(payload, size);
			return true;
		case TY_GEOMETRY_EMPTY:
			return false;
		case TY_GEOMETRY_UNSUPPORTED:
			refuse_type(type);
		default:
			ereport(ERROR, errcode(ERRCODE_DATA_CORRUPTED), errmsg("the geometry is truncated or corrupt"));
	}
}

ty_barrier_hash
ty_check_barriers(Datum geometry)
{
	struct varlena *value = PG_DETOAST_DATUM_PACKED(geometry);
	const unsigned char *payload = (const unsigned char *) VARDATA_ANY(value);
	size_t size = VARSIZE_ANY_EXHDR(value);
	ty_barrier_hash hash = {0, 0};

	if (check_payload(payload, size))
		hash = hash_of(payload, size);
	if ((Pointer) value != DatumGetPointer(geometry))
		pfree(value);
	return hash;
}

void
ty_check_barrier_srid(const ty_barrier_set *set, int32 srid)
{
	if (set != NULL && set->srid != srid)
		ereport(ERROR, errcode(ERRCODE_INVALID_PARAMETER_VALUE),
				errmsg("barriers have SRID %d, but the buildings have SRID %d", set->srid, srid),
				errhint("Use ST_Transform to bring them into one coordinate system."));
}

/* ---- sets ---- */

/* With GROUPING SETS a row belongs to groups of different lives, so the parent counts too. */
bool
ty_barriers_serve(const ty_barrier_set *set, MemoryContext context, ty_barrier_hash hash)
{
	return ty_same_barriers(set->hash, hash) && (set->constant || MemoryContextGetParent(set->context) == context);
}

ty_barrier_set *
ty_find_barriers(const ty_barrier_cache *cache, MemoryContext context, ty_barrier_hash hash)
{
	ty_barrier_set *set = cache->first;

	while (set != NULL && !ty_barriers_serve(set, context, hash))
		set = set->next;
	return set;
}

/* A set that is gone with its context leaves the cache, which lives longer. */
static void
forget(void *argument)
{
	ty_barrier_set *set = argument, **link = &set->cache->first;

	while (*link != set)
		link = &(*link)->next;
	*link = set->next;
	if (set->cache->current == set)
		set->cache->current = NULL;
}

static bool
add_line(void *context, const unsigned char *points, size_t stride, uint32_t n)
{
	ty_check_status(ty_barrier_lines_add(context, points, stride, n));
	return true;
}

static bool
pass_by(void *context, const unsigned char *points, size_t stride, uint32_t n)
{
	(void) context;
	(void) points;
	(void) stride;
	(void) n;
	return false;
}

/* A set of bytes that stay where they are as long as it does, or else are copied. */
static ty_barrier_set *
new_set(ty_barrier_cache *cache, MemoryContext context, ty_barrier_hash hash, const unsigned char *payload, size_t size,
		bool copy)
{
	MemoryContext own = AllocSetContextCreate(context, "typify barriers", ALLOCSET_DEFAULT_SIZES);
	ty_barrier_set *set = MemoryContextAllocZero(own, sizeof(ty_barrier_set));
	uint32_t type;

	set->context = own;
	set->hash = hash;
	set->size = size;
	set->copy = copy ? memcpy(MemoryContextAllocHuge(own, size), payload, size) : NULL;
	set->payload = copy ? set->copy : payload;
	ty_geometry_visit_lines(set->payload, size, pass_by, NULL, &set->srid, &type);
	set->cache = cache;
	set->next = cache->first;
	cache->first = set;
	set->on_reset.func = forget;
	set->on_reset.arg = set;
	MemoryContextRegisterResetCallback(own, &set->on_reset);
	return set;
}

ty_barrier_set *
ty_keep_barriers(ty_barrier_cache *cache, MemoryContext context, ty_barrier_hash hash, const void *payload, size_t size)
{
	return new_set(cache, context, hash, payload, size, true);
}

/* Whether bytes are part of a value as it is, which is not compressed or out of line then. */
static bool
lie_inside(const unsigned char *payload, size_t size, Datum value)
{
	const unsigned char *begin = (const unsigned char *) DatumGetPointer(value);

	return begin != NULL && payload >= begin && payload + size <= begin + VARSIZE_ANY(begin);
}

ty_barrier_set *
ty_keep_barriers_datum(ty_barrier_cache *cache, MemoryContext context, ty_barrier_hash hash, Datum geometry,
					   bool constant, Datum lasting)
{
	struct varlena *value = PG_DETOAST_DATUM_PACKED(geometry);
	const unsigned char *payload = (const unsigned char *) VARDATA_ANY(value);
	size_t size = VARSIZE_ANY_EXHDR(value);
	ty_barrier_set *set = new_set(cache, context, hash, payload, size, !lie_inside(payload, size, lasting));

	set->constant = constant;
	if ((Pointer) value != DatumGetPointer(geometry))
		pfree(value);
	return set;
}

/* What a failure leaves behind is freed with the set's context, at the latest with the query's. */
const ty_barrier_lines *
ty_lines_of_barriers(ty_barrier_set *set)
{
	MemoryContext old;
	int32 srid;
	uint32_t type;

	if (set == NULL || set->indexed)
		return set == NULL ? NULL : &set->lines;
	old = MemoryContextSwitchTo(set->context);
	ty_barrier_lines_begin(&set->lines, &ty_backend_environment);
	ty_geometry_visit_lines(set->payload, set->size, add_line, &set->lines, &srid, &type);
	ty_check_status(ty_barrier_lines_end(&set->lines));
	MemoryContextSwitchTo(old);
	/* lines have points of their own, and a state is not sent to another process once a group of its is typified */
	if (set->copy != NULL)
		pfree(set->copy);
	set->payload = set->copy = NULL;
	set->indexed = true;
	return &set->lines;
}
