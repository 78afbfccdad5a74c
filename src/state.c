/* state.c - see state.h */
#include "state.h"

#include "miscadmin.h"
#include "utils/memutils.h"

#include "backend.h"
#include "call.h"
#include "core/mesh.h"
#include "geometry.h"
#include "options.h"
#include "srid.h"

/* The first buildings lie behind the state, in one piece of this size: there may be 100 000 groups of about ten. */
#define STATE_SIZE 1024
#define FIRST_BUILDINGS ((STATE_SIZE - offsetof(ty_state, first)) / sizeof(ty_building))

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

/* Makes an empty state in the context. */
ty_state *
ty_state_new(MemoryContext context, const ty_parameters *parameters, int32 srid, double metres_per_unit,
			 Oid geometry_type)
{
	ty_state *s = MemoryContextAlloc(context, STATE_SIZE);

	s->context = context;
	s->parameters = *parameters;
	s->generation = 0;
	s->srid = srid;
	s->metres_per_unit = metres_per_unit;
	s->geometry_type = geometry_type;
	s->count = 0;
	s->capacity = FIRST_BUILDINGS;
	s->buildings = s->first;
	s->outlines = NULL;
	s->importance = NULL;
	s->hierarchy = InvalidOid;
	s->group_id = 0;
	s->barriers = NULL;
	return s;
}

/* Room for more buildings. Sizes are powers of two: that is what a memory context hands out anyway. */
void
ty_state_reserve(ty_state *s, size_t more)
{
	size_t size = 2 * STATE_SIZE;

	if (more <= s->capacity - s->count)
		return;
	if (more > TY_MAX_VERTICES - s->count)
		ty_check_status(TY_TOO_MANY);
	while (size / sizeof(ty_building) < s->count + more)
		size *= 2;
	if (s->buildings == s->first)
	{
		s->buildings = MemoryContextAllocHuge(s->context, size);
		memcpy(s->buildings, s->first, s->count * sizeof(ty_building));
	}
	else
		s->buildings = repalloc_huge(s->buildings, size);
	s->capacity = size / sizeof(ty_building);
	if (s->outlines != NULL)
		s->outlines = repalloc_huge(s->outlines, s->capacity * sizeof(ty_outline *));
	if (s->importance != NULL)
		s->importance = repalloc_huge(s->importance, s->capacity * sizeof(double));
}

/* --- importances --- */

/* Sets the importances of the buildings from number `from` on to 1. */
static void
clear_importance(ty_state *s, size_t from)
{
	for (size_t i = from; i < s->count; i++)
		s->importance[i] = 1;
}

static void
begin_importance(ty_state *s)
{
	if (s->importance != NULL)
		return;
	s->importance = MemoryContextAllocHuge(s->context, s->capacity * sizeof(double));
	clear_importance(s, 0);
}

void
ty_state_set_importance(ty_state *s, double importance)
{
	begin_importance(s);
	s->importance[s->count - 1] = importance;
}

/* --- outlines --- */

/* Sets the outlines of the buildings from number `from` on to none. */
static void
clear_outlines(ty_state *s, size_t from)
{
	for (size_t i = from; i < s->count; i++)
		s->outlines[i] = NULL;
}

/* From now on every building has an outline or none. */
static void
begin_outlines(ty_state *s)
{
	if (s->outlines != NULL)
		return;
	s->outlines = MemoryContextAllocHuge(s->context, s->capacity * sizeof(ty_outline *));
	clear_outlines(s, 0);
}

static size_t
outline_bytes(const ty_outline *outline)
{
	return ty_outline_size(outline->rings, outline->points);
}

void
ty_state_give_outline(ty_state *s, const ty_outline *outline)
{
	begin_outlines(s);
	s->outlines[s->count - 1] = ty_copy_outline(outline, s->context);
}

/* How many outlines a state has, and what they take as they travel. */
static size_t
count_outlines(const ty_state *s, size_t *bytes)
{
	size_t count = 0;

	*bytes = 0;
	for (size_t i = 0; s->outlines != NULL && i < s->count; i++)
		if (s->outlines[i] != NULL)
		{
			count++;
			*bytes += sizeof(uint64) + outline_bytes(s->outlines[i]);
		}
	return count;
}

static void
write_outlines(const ty_state *s, char *at)
{
	for (size_t i = 0; s->outlines != NULL && i < s->count; i++)
		if (s->outlines[i] != NULL)
		{
			uint64 building = i;

			memcpy(at, &building, sizeof(building));
			memcpy(at + sizeof(building), s->outlines[i], outline_bytes(s->outlines[i]));
			at += sizeof(building) + outline_bytes(s->outlines[i]);
		}
}

/* False when the bytes are not what write_outlines wrote. */
static bool
read_outlines(ty_state *s, size_t count, const char *at, size_t left)
{
	if (count > 0)
		begin_outlines(s);
	for (; count > 0; count--)
	{
		ty_outline head;
		uint64 building;
		size_t size;

		if (left < sizeof(building) + sizeof(head))
			return false;
		memcpy(&building, at, sizeof(building));
		memcpy(&head, at + sizeof(building), sizeof(head));
		size = outline_bytes(&head);
		left -= sizeof(building);
		if (building >= s->count || size == 0 || size > left)
			return false;
		s->outlines[building] = MemoryContextAllocHuge(s->context, size);
		memcpy(s->outlines[building], at + sizeof(building), size);
		at += sizeof(building) + size;
		left -= size;
	}
	return left == 0;
}

/* --- joining and travelling --- */

void
ty_state_check_srid(const ty_state *s, int32 srid)
{
	if (unlikely(s->srid != srid))
		ty_refuse_two_srids(s->srid, srid);
}

static void
ty_state_append(ty_state *s, const ty_building *buildings, size_t count)
{
	ty_state_reserve(s, count);
	memcpy(s->buildings + s->count, buildings, count * sizeof(ty_building));
	s->count += count;
	if (s->outlines != NULL)
		clear_outlines(s, s->count - count);
	if (s->importance != NULL)
		clear_importance(s, s->count - count);
}

/* Sets the importances of the last buildings. */
static void
set_importances(ty_state *s, const void *importance, size_t count)
{
	begin_importance(s);
	memcpy(s->importance + s->count - count, importance, count * sizeof(double));
}

/* Appends a copy of what b holds; b stays as it is. */
void
ty_state_merge(ty_state *a, const ty_state *b)
{
	ty_state_check_srid(a, b->srid);
	if (!ty_same_parameters(&a->parameters, &b->parameters))
		ty_refuse_varying_parameters();
	ty_state_append(a, b->buildings, b->count);
	if (b->importance != NULL)
		set_importances(a, b->importance, b->count);
	if (b->outlines == NULL)
		return;
	begin_outlines(a);
	for (size_t i = 0; i < b->count; i++)
		if (b->outlines[i] != NULL)
			a->outlines[a->count - b->count + i] = ty_copy_outline(b->outlines[i], a->context);
}

/* In the current context; an error where a bytea cannot hold it. */
bytea *
ty_state_serialize(const ty_state *s)
{
	size_t outlines_size, outlines = count_outlines(s, &outlines_size);
	size_t buildings_size = s->count * sizeof(ty_building);
	size_t importance_size = s->importance == NULL ? 0 : s->count * sizeof(double);
	size_t barriers_size = s->barriers == NULL || s->barriers->constant ? 0 : s->barriers->size;
	size_t size = VARHDRSZ + sizeof(state_image) + buildings_size + importance_size + outlines_size + barriers_size;
	state_image image;
	bytea *value;
	char *at;

	if (!AllocSizeIsValid(size))
		ereport(ERROR, errcode(ERRCODE_PROGRAM_LIMIT_EXCEEDED),
				errmsg("a group of %zu buildings is too large to pass between parallel processes", s->count),
				errhint("SET max_parallel_workers_per_gather = 0"));
	memset(&image, 0, sizeof(image));
	image.magic = STATE_MAGIC;
	image.building_size = sizeof(ty_building);
	image.srid = s->srid;
	image.count = s->count;
	image.outlines = outlines;
	image.barriers_size = barriers_size;
	image.has_importance = s->importance != NULL;
	image.metres_per_unit = s->metres_per_unit;
	image.geometry_type = s->geometry_type;
	image.parameters = s->parameters;
	value = palloc(size);
	SET_VARSIZE(value, size);
	at = VARDATA(value);
	memcpy(at, &image, sizeof(image));
	memcpy(at + sizeof(image), s->buildings, buildings_size);
	if (s->importance != NULL)
		memcpy(at + sizeof(image) + buildings_size, s->importance, importance_size);
	write_outlines(s, at + sizeof(image) + buildings_size + importance_size);
	if (barriers_size > 0)
		memcpy(at + size - VARHDRSZ - barriers_size, s->barriers->payload, barriers_size);
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

ty_state *
ty_state_deserialize(bytea *value)
{
	size_t left = VARSIZE_ANY_EXHDR(value);
	state_image image = read_header(VARDATA_ANY(value), left);
	const char *at = VARDATA_ANY(value) + sizeof(image);
	ty_state *s =
		ty_state_new(CurrentMemoryContext, &image.parameters, image.srid, image.metres_per_unit, image.geometry_type);

	ty_state_append(s, (const ty_building *) at, image.count);
	at += image.count * sizeof(ty_building);
	if (image.has_importance)
	{
		set_importances(s, at, image.count);
		at += image.count * sizeof(double);
	}
	left -= at - VARDATA_ANY(value) + image.barriers_size;
	if (!read_outlines(s, image.outlines, at, left))
		refuse_image();
	if (image.barriers_size > 0)
		s->barriers = ty_keep_barriers(palloc0(sizeof(ty_barrier_cache)), CurrentMemoryContext,
									   image.parameters.barriers, at + left, image.barriers_size, false);
	return s;
}
