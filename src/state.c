/* state.c - see state.h */
#include "state.h"

#include "utils/memutils.h"

#include "call.h"
#include "geometry.h"
#include "options.h"
#include "srid.h"

/* So many of a pool's variants are looked at for one that a group can share: some scales that take turns. */
#define VARIANTS_LOOKED_AT 8

/*
 * A state as it travels between the processes of one parallel query: this header, then the buildings, then their
 * importances if there are any, then the outlines, each behind the number of its building, then the geometry of
 * barriers that are not constant for the query. Both sides run the same library on the same machine, so values are
 * copied as they are.
 */
typedef struct state_image
{
	uint32 magic;
	uint32 building_size;
	int32 srid;
	Oid geometry_type;
	uint64 count, outlines;
	uint64 barriers_size;  /* 0: none, or only their hash */
	uint64 has_importance; /* 0 or 1 */
	double metres_per_unit;
	ty_parameters parameters;
} state_image;

#define STATE_MAGIC 0x54590005 /* the last byte is the version */

/* --- groups and what they are typified with --- */

ty_variant *
ty_variant_like(ty_pool *pool, const ty_variant *like)
{
	ty_variant *v = pool->variants;

	for (int i = 0; v != NULL && i < VARIANTS_LOOKED_AT; i++, v = v->next)
		if (v->srid == like->srid && v->barriers == like->barriers &&
			ty_same_parameters(&v->parameters, &like->parameters))
		{
			v->generation = like->generation;
			return v;
		}
	v = MemoryContextAlloc(pool->context, sizeof(ty_variant));
	*v = *like;
	v->next = pool->variants;
	pool->variants = v;
	return v;
}

ty_state *
ty_state_new(ty_pool *pool, ty_variant *variant)
{
	ty_state *s = MemoryContextAlloc(pool->context, sizeof(ty_state));

	s->pool = pool;
	s->variant = variant;
	s->number = ty_pool_begin_group(pool);
	s->count = 0;
	s->hierarchy = InvalidOid;
	s->group_id = 0;
	return s;
}

#define FETCHED 32 /* buildings: more than a small group has */

/* Groups are read in any order too: all of a small one comes at once. */
static inline void
fetch(const ty_building *buildings, size_t count)
{
	const char *end = (const char *) (buildings + Min(count, FETCHED));

	for (const char *at = (const char *) buildings; at < end; at += PG_CACHE_LINE_SIZE / 2)
		__builtin_prefetch(at);
}

/* A column of importances says more than none only where one is not 1. */
static const double *
importances_of(const double *importance, size_t count)
{
	for (size_t i = 0; importance != NULL && i < count; i++)
		if (importance[i] != 1)
			return importance;
	return NULL;
}

static ty_outline *const *
outlines_of(ty_outline *const *outlines, size_t count)
{
	for (size_t i = 0; outlines != NULL && i < count; i++)
		if (outlines[i] != NULL)
			return outlines;
	return NULL;
}

ty_gathered
ty_gather(const ty_state *s)
{
	ty_pool *pool = s->pool;
	size_t first = ty_pool_gather(pool, s->number);

	fetch(pool->buildings + first, s->count);
	return (ty_gathered){.state = s,
						 .variant = s->variant,
						 .count = s->count,
						 .buildings = pool->buildings + first,
						 .importance =
							 importances_of(pool->importance == NULL ? NULL : pool->importance + first, s->count),
						 .outlines = outlines_of(pool->outlines == NULL ? NULL : pool->outlines + first, s->count)};
}

/* --- outlines --- */

static size_t
outline_bytes(const ty_outline *outline)
{
	return ty_outline_size(outline->rings, outline->points);
}

/* How many outlines a group has, and what they take as they travel. */
static size_t
count_outlines(const ty_gathered *g, size_t *bytes)
{
	size_t count = 0;

	*bytes = 0;
	for (size_t i = 0; g->outlines != NULL && i < g->count; i++)
		if (g->outlines[i] != NULL)
		{
			count++;
			*bytes += sizeof(uint64) + outline_bytes(g->outlines[i]);
		}
	return count;
}

static void
write_outlines(const ty_gathered *g, char *at)
{
	for (size_t i = 0; g->outlines != NULL && i < g->count; i++)
		if (g->outlines[i] != NULL)
		{
			uint64 building = i;

			memcpy(at, &building, sizeof(building));
			memcpy(at + sizeof(building), g->outlines[i], outline_bytes(g->outlines[i]));
			at += sizeof(building) + outline_bytes(g->outlines[i]);
		}
}

/* Of the pool's only group. False when the bytes are not what write_outlines wrote. */
static bool
read_outlines(ty_pool *pool, size_t count, const char *at, size_t left)
{
	for (; count > 0; count--)
	{
		ty_outline head, *outline;
		uint64 building;
		size_t size;

		if (left < sizeof(building) + sizeof(head))
			return false;
		memcpy(&building, at, sizeof(building));
		memcpy(&head, at + sizeof(building), sizeof(head));
		size = outline_bytes(&head);
		left -= sizeof(building);
		if (building >= pool->count || size == 0 || size > left)
			return false;
		outline = MemoryContextAllocHuge(pool->context, size);
		memcpy(outline, at + sizeof(building), size);
		ty_pool_set_outline(pool, building, outline);
		at += sizeof(building) + size;
		left -= size;
	}
	return left == 0;
}

/* --- joining and travelling --- */

void
ty_state_check_srid(const ty_state *s, int32 srid)
{
	if (unlikely(s->variant->srid != srid))
		ty_refuse_two_srids(s->variant->srid, srid);
}

/* Appends copies of buildings. */
static void
append(ty_state *s, const ty_building *buildings, size_t count)
{
	if (count > TY_MAX_VERTICES - s->count)
		ty_check_status(TY_TOO_MANY);
	ty_pool_append(s->pool, s->number, buildings, count);
	s->count += (uint32) count;
}

/* Appends a copy of what b holds; b stays as it is. */
void
ty_state_merge(ty_state *a, const ty_state *b)
{
	ty_gathered added = ty_gather(b);
	ty_pool *pool = a->pool;
	size_t first = pool->count;

	ty_state_check_srid(a, b->variant->srid);
	if (!ty_same_parameters(&a->variant->parameters, &b->variant->parameters))
		ty_refuse_varying_parameters();
	append(a, added.buildings, added.count);
	for (size_t i = 0; added.importance != NULL && i < added.count; i++)
		if (added.importance[i] != 1)
			ty_pool_set_importance(pool, first + i, added.importance[i]);
	for (size_t i = 0; added.outlines != NULL && i < added.count; i++)
		if (added.outlines[i] != NULL)
			ty_pool_set_outline(pool, first + i, ty_copy_outline(added.outlines[i], pool->context));
}

/* In the current context; an error where a bytea cannot hold it. */
bytea *
ty_state_serialize(const ty_state *s)
{
	const ty_variant *v = s->variant;
	ty_gathered g = ty_gather(s);
	size_t outlines_size, outlines = count_outlines(&g, &outlines_size);
	size_t buildings_size = g.count * sizeof(ty_building);
	size_t importance_size = g.importance == NULL ? 0 : g.count * sizeof(double);
	size_t barriers_size = v->barriers == NULL || v->barriers->constant ? 0 : v->barriers->size;
	size_t size = VARHDRSZ + sizeof(state_image) + buildings_size + importance_size + outlines_size + barriers_size;
	state_image image;
	bytea *value;
	char *at;

	if (!AllocSizeIsValid(size))
		ereport(ERROR, errcode(ERRCODE_PROGRAM_LIMIT_EXCEEDED),
				errmsg("a group of %zu buildings is too large to pass between parallel processes", g.count),
				errhint("SET max_parallel_workers_per_gather = 0"));
	memset(&image, 0, sizeof(image));
	image.magic = STATE_MAGIC;
	image.building_size = sizeof(ty_building);
	image.srid = v->srid;
	image.count = g.count;
	image.outlines = outlines;
	image.barriers_size = barriers_size;
	image.has_importance = g.importance != NULL;
	image.metres_per_unit = v->metres_per_unit;
	image.geometry_type = v->geometry_type;
	image.parameters = v->parameters;
	value = palloc(size);
	SET_VARSIZE(value, size);
	at = VARDATA(value);
	memcpy(at, &image, sizeof(image));
	memcpy(at + sizeof(image), g.buildings, buildings_size);
	if (g.importance != NULL)
		memcpy(at + sizeof(image) + buildings_size, g.importance, importance_size);
	write_outlines(&g, at + sizeof(image) + buildings_size + importance_size);
	Assert(barriers_size == 0 || v->barriers->payload != NULL);
	if (barriers_size > 0)
		memcpy(at + size - VARHDRSZ - barriers_size, v->barriers->payload, barriers_size);
	return value;
}

static void
refuse_image(void)
{
	ereport(ERROR, errcode(ERRCODE_INVALID_BINARY_REPRESENTATION),
			errmsg("a typify state is from another version, or broken"));
}

/* Of the header, once what it says has been held against the size of the value. */
static state_image
read_header(const char *at, size_t size)
{
	state_image image;

	if (size < sizeof(image))
		ereport(ERROR, errcode(ERRCODE_INVALID_BINARY_REPRESENTATION), errmsg("a typify state is truncated"));
	memcpy(&image, at, sizeof(image));
	if (image.magic != STATE_MAGIC || image.building_size != sizeof(ty_building) || image.count == 0 ||
		image.count > TY_MAX_VERTICES || image.has_importance > 1)
		refuse_image();
	size -= sizeof(image);
	if (size < image.count * (sizeof(ty_building) + image.has_importance * sizeof(double)) ||
		size - image.count * (sizeof(ty_building) + image.has_importance * sizeof(double)) < image.barriers_size)
		refuse_image();
	return image;
}

/* What an image says of its group, with the barriers that are its last bytes. */
static ty_variant
variant_of_image(const state_image *image, const char *barriers)
{
	ty_variant v = {.srid = image->srid,
					.geometry_type = image->geometry_type,
					.metres_per_unit = image->metres_per_unit,
					.parameters = image->parameters};

	if (image->barriers_size > 0)
		v.barriers = ty_keep_barriers(palloc0(sizeof(ty_barrier_cache)), CurrentMemoryContext,
									  image->parameters.barriers, barriers, image->barriers_size);
	return v;
}

ty_state *
ty_state_deserialize(bytea *value)
{
	size_t left = VARSIZE_ANY_EXHDR(value);
	state_image image = read_header(VARDATA_ANY(value), left);
	const char *at = VARDATA_ANY(value), *barriers = at + left - image.barriers_size;
	ty_pool *pool = ty_pool_new(CurrentMemoryContext);
	ty_variant variant = variant_of_image(&image, barriers);
	ty_state *s = ty_state_new(pool, ty_variant_like(pool, &variant));

	at += sizeof(image);
	append(s, (const ty_building *) at, image.count);
	at += image.count * sizeof(ty_building);
	for (size_t i = 0; image.has_importance && i < image.count; i++, at += sizeof(double))
	{
		double importance;

		memcpy(&importance, at, sizeof(importance));
		ty_pool_set_importance(pool, i, importance);
	}
	if (!read_outlines(pool, image.outlines, at, barriers - at))
		refuse_image();
	return s;
}
