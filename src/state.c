/* state.c - see state.h */
#include "state.h"

#include "miscadmin.h"
#include "utils/memutils.h"

#include "backend.h"
#include "call.h"
#include "core/mesh.h"
#include "options.h"
#include "srid.h"

/* The array's first size in bytes, good for nine buildings: there may be 100 000 groups of about that many. */
#define FIRST_SIZE 512

/*
 * A state as it travels between the processes of one parallel query: this header, then the buildings. Both sides
 * run the same library on the same machine, so values are copied as they are.
 */
typedef struct state_image
{
	uint32 magic;
	uint32 building_size;
	int32 srid;
	uint32 unused;
	uint64 count;
	double metres_per_unit;
	ty_parameters parameters;
} state_image;

#define STATE_MAGIC 0x54590002 /* the last byte is the version */

/* Makes an empty state in the context. */
ty_state *
ty_state_new(MemoryContext context, const ty_parameters *parameters, int32 srid, double metres_per_unit)
{
	ty_state *s = MemoryContextAlloc(context, sizeof(ty_state));

	s->context = context;
	s->parameters = *parameters;
	s->generation = 0;
	s->srid = srid;
	s->metres_per_unit = metres_per_unit;
	s->count = s->capacity = 0;
	s->buildings = NULL;
	return s;
}

/* Room for more buildings. Sizes are powers of two: that is what a memory context hands out anyway. */
void
ty_state_reserve(ty_state *s, size_t more)
{
	size_t size = FIRST_SIZE;

	if (more <= s->capacity - s->count)
		return;
	if (more > TY_MAX_VERTICES - s->count)
		ty_check_status(TY_TOO_MANY);
	while (size / sizeof(ty_building) < s->count + more)
		size *= 2;
	if (s->buildings == NULL)
		s->buildings = MemoryContextAllocHuge(s->context, size);
	else
		s->buildings = repalloc_huge(s->buildings, size);
	s->capacity = size / sizeof(ty_building);
}

static void
ty_state_append(ty_state *s, const ty_building *buildings, size_t count)
{
	ty_state_reserve(s, count);
	memcpy(s->buildings + s->count, buildings, count * sizeof(ty_building));
	s->count += count;
}

void
ty_state_check_srid(const ty_state *s, int32 srid)
{
	if (unlikely(s->srid != srid))
		ty_refuse_two_srids(s->srid, srid);
}

/* Appends a copy of what b holds; b stays as it is. */
void
ty_state_merge(ty_state *a, const ty_state *b)
{
	ty_state_check_srid(a, b->srid);
	if (!ty_same_parameters(&a->parameters, &b->parameters))
		ty_refuse_varying_parameters();
	ty_state_append(a, b->buildings, b->count);
}

/* In the current context; an error where a bytea cannot hold it. */
bytea *
ty_state_serialize(const ty_state *s)
{
	size_t size = VARHDRSZ + sizeof(state_image) + s->count * sizeof(ty_building);
	state_image image;
	bytea *value;

	if (!AllocSizeIsValid(size))
		ereport(ERROR, errcode(ERRCODE_PROGRAM_LIMIT_EXCEEDED),
				errmsg("a group of %zu buildings is too large to pass between parallel processes", s->count),
				errhint("SET max_parallel_workers_per_gather = 0"));
	memset(&image, 0, sizeof(image));
	image.magic = STATE_MAGIC;
	image.building_size = sizeof(ty_building);
	image.srid = s->srid;
	image.count = s->count;
	image.metres_per_unit = s->metres_per_unit;
	image.parameters = s->parameters;
	value = palloc(size);
	SET_VARSIZE(value, size);
	memcpy(VARDATA(value), &image, sizeof(image));
	memcpy(VARDATA(value) + sizeof(image), s->buildings, s->count * sizeof(ty_building));
	return value;
}

/* Makes the state in the current context; nothing of the value is kept. */
ty_state *
ty_state_deserialize(bytea *value)
{
	size_t size = VARSIZE_ANY_EXHDR(value);
	state_image image;
	ty_state *s;

	if (size < sizeof(image))
		ereport(ERROR, errcode(ERRCODE_INVALID_BINARY_REPRESENTATION), errmsg("a typify state is truncated"));
	memcpy(&image, VARDATA_ANY(value), sizeof(image));
	if (image.magic != STATE_MAGIC || image.building_size != sizeof(ty_building) || image.count == 0 ||
		image.count > TY_MAX_VERTICES || size - sizeof(image) != image.count * sizeof(ty_building))
		ereport(ERROR, errcode(ERRCODE_INVALID_BINARY_REPRESENTATION),
				errmsg("a typify state is from another version, or broken"));
	s = ty_state_new(CurrentMemoryContext, &image.parameters, image.srid, image.metres_per_unit);
	ty_state_reserve(s, image.count);
	memcpy(s->buildings, VARDATA_ANY(value) + sizeof(image), image.count * sizeof(ty_building));
	s->count = image.count;
	return s;
}
