/* counting.c - see counting.h. Every block is preceded by its size. */
#include "counting.h"

#include <stdlib.h>

typedef struct block
{
	size_t size;
	max_align_t memory[];
} block;

static block *
block_of(void *memory)
{
	return (block *) ((char *) memory - offsetof(block, memory));
}

static void
add(counting *counter, size_t size)
{
	counter->used += size;
	if (counter->used > counter->peak)
		counter->peak = counter->used;
}

static bool
fails(counting *counter)
{
	return ++counter->allocations == counter->failing;
}

static void *
count_allocate(void *context, size_t size)
{
	block *b = fails(context) ? NULL : malloc(sizeof *b + size);

	if (b == NULL)
		return NULL;
	b->size = size;
	add(context, size);
	return b->memory;
}

static void *
count_reallocate(void *context, void *memory, size_t size)
{
	counting *counter = context;
	size_t before = block_of(memory)->size;
	block *b = fails(counter) ? NULL : realloc(block_of(memory), sizeof *b + size);

	if (b == NULL)
		return NULL;
	b->size = size;
	counter->used -= before;
	add(counter, size);
	return b->memory;
}

static void
count_release(void *context, void *memory)
{
	counting *counter = context;

	if (memory == NULL)
		return;
	counter->used -= block_of(memory)->size;
	free(block_of(memory));
}

ty_environment
counting_environment(counting *counter)
{
	*counter = (counting){0};
	return (ty_environment){count_allocate, count_reallocate, count_release, NULL, NULL, counter};
}
