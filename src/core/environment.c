/* environment.c - see environment.h */
#include "environment.h"

#include <stdlib.h>

static void *
plain_allocate(void *context, size_t size)
{
	(void) context;
	return malloc(size);
}

static void *
plain_reallocate(void *context, void *memory, size_t size)
{
	(void) context;
	return realloc(memory, size);
}

static void
plain_release(void *context, void *memory)
{
	(void) context;
	free(memory);
}

const ty_environment ty_plain_environment = {plain_allocate, plain_reallocate, plain_release, NULL, NULL, NULL};

/* bytes of an array, or 0 when they do not fit a size_t */
static size_t
array_size(size_t count, size_t size)
{
	if (count == 0)
		count = 1;
	return count > SIZE_MAX / size ? 0 : count * size;
}

void *
ty_allocate_array(const ty_environment *env, size_t count, size_t size)
{
	size_t bytes = array_size(count, size);

	return bytes == 0 ? NULL : env->allocate(env->context, bytes);
}

void *
ty_reallocate_array(const ty_environment *env, void *memory, size_t count, size_t size)
{
	size_t bytes = array_size(count, size);

	return bytes == 0 ? NULL : env->reallocate(env->context, memory, bytes);
}

void
ty_release(const ty_environment *env, void *memory)
{
	if (memory != NULL)
		env->release(env->context, memory);
}
