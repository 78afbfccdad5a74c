/* lists.c - see lists.h */
#include "lists.h"

#include <string.h>

ty_status
ty_lists_begin(const ty_environment *env, size_t owners, size_t numbers_each, ty_lists *lists)
{
	*lists = (ty_lists){.env = env, .owners = owners};
	lists->capacity = owners < UINT32_MAX / numbers_each ? numbers_each * owners : UINT32_MAX - 1;
	lists->at = ty_allocate_array(env, owners, sizeof *lists->at);
	lists->pool = ty_allocate_array(env, lists->capacity, sizeof *lists->pool);
	if (lists->at == NULL || lists->pool == NULL)
		return TY_NO_MEMORY;
	memset(lists->at, 0xff, owners * sizeof *lists->at);
	return TY_OK;
}

void
ty_lists_free(ty_lists *lists)
{
	if (lists->env == NULL)
		return;
	ty_release(lists->env, lists->at);
	ty_release(lists->env, lists->pool);
	*lists = (ty_lists){0};
}

/* Room for a list of so many numbers. */
static uint32_t *
take(ty_lists *lists, uint32_t owner, size_t count)
{
	uint32_t *list;

	if (count >= lists->capacity)
		return NULL;
	if (lists->capacity - lists->used <= count)
	{
		memset(lists->at, 0xff, lists->owners * sizeof *lists->at);
		lists->used = 0;
	}
	list = lists->pool + lists->used;
	lists->at[owner] = (uint32_t) lists->used;
	lists->used += count + 1;
	list[0] = (uint32_t) count;
	return list;
}

const uint32_t *
ty_lists_keep(ty_lists *lists, uint32_t owner, const uint32_t *numbers, size_t count)
{
	uint32_t *list = take(lists, owner, count);

	if (list != NULL && count > 0)
		memcpy(list + 1, numbers, count * sizeof *list);
	return list;
}

const uint32_t *
ty_lists_keep_with(ty_lists *lists, uint32_t owner, const uint32_t *numbers, const float *values, size_t count)
{
	uint32_t *list = take(lists, owner, 2 * count);

	if (list == NULL || count == 0)
		return list;
	memcpy(list + 1, numbers, count * sizeof *numbers);
	memcpy(list + 1 + count, values, count * sizeof *values);
	return list;
}

void
ty_lists_forget(ty_lists *lists, uint32_t owner)
{
	lists->at[owner] = TY_NO_LIST;
}
