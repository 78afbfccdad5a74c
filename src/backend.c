/* backend.c - see backend.h */
#include "compat.h"

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "miscadmin.h"
#include "utils/float.h"
#include "utils/memutils.h"

#include "backend.h"
#include "core/mesh.h"

static void *
backend_allocate(void *context, size_t size)
{
	(void) context;
	return MemoryContextAllocHuge(CurrentMemoryContext, size);
}

static void *
backend_reallocate(void *context, void *memory, size_t size)
{
	(void) context;
	return repalloc_huge(memory, size);
}

static void
backend_release(void *context, void *memory)
{
	(void) context;
	if (memory != NULL)
		pfree(memory);
}

static bool
backend_interrupted(void *context)
{
	(void) context;
	CHECK_FOR_INTERRUPTS();
	return false;
}

const ty_environment ty_backend_environment = {
	backend_allocate, backend_reallocate, backend_release, backend_interrupted, NULL, NULL};

/* glibc keeps tens of megabytes of freed arrays below any that is still in use. */
void
ty_trim_memory(void)
{
#ifdef __GLIBC__
	malloc_trim(0);
#endif
}

void
ty_check_status(ty_status status)
{
	switch (status)
	{
		case TY_OK:
			return;
		case TY_NO_MEMORY:
			ereport(ERROR, errcode(ERRCODE_OUT_OF_MEMORY), errmsg("out of memory"));
		case TY_INTERRUPTED:
			ereport(ERROR, errcode(ERRCODE_QUERY_CANCELED), errmsg("typify was interrupted"));
		case TY_TOO_MANY:
			ereport(ERROR, errcode(ERRCODE_PROGRAM_LIMIT_EXCEEDED),
					errmsg("a group has more than %zu buildings", TY_MAX_VERTICES),
					errhint("Use GROUP BY to typify smaller groups, such as blocks or settlements."));
		case TY_NOT_FINITE:
			ereport(ERROR, errcode(ERRCODE_NUMERIC_VALUE_OUT_OF_RANGE),
					errmsg("coordinates or areas of a group are too large for double precision"),
					errhint("Use coordinates in metres and a smaller scale denominator."));
		case TY_BROKEN:
			break;
	}
	elog(ERROR, "typify: an invariant of the mesh does not hold");
}

char *
ty_number_text(double number)
{
	return float8out_internal(number);
}
