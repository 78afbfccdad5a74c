/*
 * test_failure.c - the fear: out of memory or a cancelled statement leaks, crashes, or is noticed too late. Every
 * single allocation is made to fail, every single poll to interrupt, every single allocation to leave by longjmp.
 */
#include "check.h"
#include "group.h"
#include "hierarchy.h"
#include "sets.h"

#include <math.h>
#include <setjmp.h>
#include <stdlib.h>
#include <time.h>

#define MOST 200000

/* blocks are linked, so that what is left after a longjmp can be freed as PostgreSQL frees a memory context */
typedef struct block
{
	struct block *previous, *next;
	max_align_t memory[];
} block;

typedef struct surroundings
{
	block *first;
	size_t blocks;
	size_t allocations, fail_at; /* fail_at 0: never */
	size_t polls, stop_at;		 /* 0: never */
	bool jump;					 /* instead of giving NULL or true */
	jmp_buf out;
	clock_t last_poll, longest_gap;
} surroundings;

static surroundings around;
static ty_building buildings[MOST];

static void
link_block(block *b)
{
	b->previous = NULL;
	b->next = around.first;
	if (b->next != NULL)
		b->next->previous = b;
	around.first = b;
	around.blocks++;
}

static void
unlink_block(block *b)
{
	if (b->previous != NULL)
		b->previous->next = b->next;
	else
		around.first = b->next;
	if (b->next != NULL)
		b->next->previous = b->previous;
	around.blocks--;
}

static bool
fails(void)
{
	if (++around.allocations != around.fail_at)
		return false;
	if (around.jump)
		longjmp(around.out, 1);
	return true;
}

static void *
allocate(void *context, size_t size)
{
	block *b;

	(void) context;
	CHECK(size > 0, "allocation of 0 bytes");
	if (fails() || (b = malloc(sizeof *b + size)) == NULL)
		return NULL;
	memset(b->memory, 0xa5, size);
	link_block(b);
	return b->memory;
}

static void
release(void *context, void *memory)
{
	(void) context;
	if (memory == NULL)
		return;
	block *b = (block *) ((char *) memory - offsetof(block, memory));
	unlink_block(b);
	free(b);
}

static void *
reallocate(void *context, void *memory, size_t size)
{
	(void) context;
	CHECK(size > 0 && memory != NULL, "reallocation of %p to %zu bytes", memory, size);
	if (fails())
		return NULL;
	block *b = (block *) ((char *) memory - offsetof(block, memory));
	unlink_block(b);
	b = realloc(b, sizeof *b + size);
	if (b == NULL)
		abort();
	link_block(b);
	return b->memory;
}

static bool
interrupted(void *context)
{
	clock_t now = clock();

	(void) context;
	if (around.polls > 0 && now - around.last_poll > around.longest_gap)
		around.longest_gap = now - around.last_poll;
	around.last_poll = now;
	if (++around.polls != around.stop_at)
		return false;
	if (around.jump)
		longjmp(around.out, 1);
	return true;
}

static const ty_environment watched = {allocate, reallocate, release, interrupted, NULL, NULL};

static void
begin(size_t fail_at, size_t stop_at, bool jump)
{
	memset(&around, 0, sizeof around);
	around.fail_at = fail_at;
	around.stop_at = stop_at;
	around.jump = jump;
}

static void
free_blocks(void)
{
	while (around.first != NULL)
		release(NULL, around.first->memory);
}

static ty_parameters
defaults(double s_u)
{
	ty_parameters p = {0};

	p.scale = 150000;
	p.s_u = s_u;
	p.source_scale = TY_DEFAULT_SOURCE_SCALE;
	p.lod200_scale = TY_DEFAULT_LOD200_SCALE;
	p.exponent = TY_DEFAULT_EXPONENT;
	p.psi = TY_DEFAULT_PSI;
	p.area_statistic = TY_MEDIAN;
	p.law = true;
	return p;
}

/* with importances, kept buildings, sheds and gaps as well; by turns in the tests of allocations */
static bool weighed;
static double importance[MOST];

/* the hierarchy of the group instead of its placeholders at a scale */
static bool all_scales;

static ty_status
build_hierarchy(const ty_input *input, ty_parameters p)
{
	ty_hierarchy h;
	ty_status status;

	p.min_area = p.keep_area = 0;
	status = ty_hierarchy_build(&watched, input, &p, &h);
	if (status == TY_OK)
		ty_hierarchy_free(&watched, &h);
	return status;
}

static void
weigh(size_t n, ty_parameters *p)
{
	for (size_t i = 0; i < n; i++)
		importance[i] = i % 40 == 1 ? INFINITY : 1 + (double) (i % 3);
	p->min_area = 80;
	p->keep_area = 395;
	p->min_side = 40;
	p->min_gap = 30;
	p->alignment = 2;
}

/* Typifies with what begin() set up and frees the result; says whether the environment was left by longjmp. */
static ty_status
typify(size_t n, bool *jumped)
{
	ty_input input = {.buildings = buildings, .n = n};
	ty_parameters p = defaults(0.5);
	ty_result result;
	ty_status status;

	*jumped = false;
	if (weighed)
	{
		weigh(n, &p);
		input.importance = importance;
	}
	if (setjmp(around.out) != 0)
	{
		*jumped = true;
		free_blocks();
		return TY_OK;
	}
	if (all_scales)
		return build_hierarchy(&input, p);
	status = ty_typify(&watched, &input, &p, &result);
	if (status == TY_OK)
		ty_result_free(&watched, &result);
	return status;
}

static void
fail_each_allocation(large_kind kind, size_t n)
{
	random_state random = random_seed(51);
	bool jumped;

	large_set(kind, &random, buildings, n);
	for (size_t k = 1;; k++)
	{
		ty_status status;

		begin(k, 0, false);
		status = typify(n, &jumped);
		CHECK(around.blocks == 0, "%s, n %zu, allocation %zu failed: %zu blocks are left", large_kind_name[kind], n, k,
			  around.blocks);
		if (around.allocations < k)
			break;
		CHECK(status == TY_NO_MEMORY, "%s, n %zu, allocation %zu failed: status %d", large_kind_name[kind], n, k,
			  status);
		free_blocks();
	}
	CHECK(around.allocations > 0, "no allocation at all");
}

static void
every_allocation_may_fail(void)
{
	for (large_kind kind = 0; kind < LARGE_KINDS; kind++)
	{
		weighed = kind % 2 == 1;
		fail_each_allocation(kind, 1);
		fail_each_allocation(kind, 7);
		fail_each_allocation(kind, 60);
		fail_each_allocation(kind, 3000);
	}
	weighed = false;
}

static void
every_allocation_may_leave_by_longjmp(void)
{
	static const size_t sizes[] = {1, 7, 60, 3000};
	random_state random = random_seed(52);
	bool jumped = true;

	for (size_t s = 0; s < 4; s++)
	{
		weighed = s % 2 == 0;
		large_set(LARGE_CLUSTERED, &random, buildings, sizes[s]);
		jumped = true;
		for (size_t k = 1; jumped; k++)
		{
			begin(k, 0, true);
			CHECK(typify(sizes[s], &jumped) == TY_OK, "n %zu, jump from allocation %zu", sizes[s], k);
			CHECK(around.blocks == 0, "n %zu, jump from allocation %zu: %zu blocks", sizes[s], k, around.blocks);
		}
	}
	weighed = false;
}

/* number of polls of a whole run */
static size_t
count_polls(size_t n)
{
	bool jumped;

	begin(0, 0, false);
	CHECK(typify(n, &jumped) == TY_OK, "n %zu", n);
	return around.polls;
}

static void
interrupt_each_poll(large_kind kind, size_t n)
{
	random_state random = random_seed(53);
	size_t polls, step;
	bool jumped;

	large_set(kind, &random, buildings, n);
	polls = count_polls(n);
	step = 1 + polls / 60;
	CHECK(polls > 0, "%s, n %zu: never asked", large_kind_name[kind], n);
	for (size_t k = 1; k <= polls; k += step)
	{
		ty_status status;

		begin(0, k, false);
		status = typify(n, &jumped);
		CHECK(status == TY_INTERRUPTED, "%s, n %zu, poll %zu of %zu: status %d", large_kind_name[kind], n, k, polls,
			  status);
		CHECK(around.blocks == 0, "%s, n %zu, poll %zu of %zu: %zu blocks are left", large_kind_name[kind], n, k, polls,
			  around.blocks);
		CHECK(around.polls == k, "%s, n %zu: asked again after poll %zu said to stop", large_kind_name[kind], n, k);
		free_blocks();
		begin(0, k, true);
		typify(n, &jumped);
		CHECK(jumped, "%s, n %zu: the jump from poll %zu got lost", large_kind_name[kind], n, k);
	}
}

static void
every_poll_may_interrupt(void)
{
	interrupt_each_poll(LARGE_UNIFORM, 20000);
	interrupt_each_poll(LARGE_ONE_POINT, 20000);
	interrupt_each_poll(LARGE_SLANTED_LINE, 20000);
	interrupt_each_poll(LARGE_HUB, 20000);
	interrupt_each_poll(LARGE_LATTICE, 20000);
	weighed = true;
	interrupt_each_poll(LARGE_CLUSTERED, 20000);
	weighed = false;
}

static void
hierarchies_fail_and_stop_as_cleanly(void)
{
	all_scales = true;
	for (size_t n = 1; n <= 1000; n = 9 * n + 1)
	{
		fail_each_allocation(LARGE_ONE_POINT, n);
		weighed = true;
		fail_each_allocation(LARGE_CLUSTERED, n);
		weighed = false;
	}
	interrupt_each_poll(LARGE_CLUSTERED, 5000);
	all_scales = false;
}

/* each building is work: it is ordered at least, so one poll per 4096 of them is the least */
static void
polls_are_frequent(void)
{
	for (large_kind kind = 0; kind < LARGE_KINDS; kind++)
	{
		random_state random = random_seed(54);
		size_t polls;

		large_set(kind, &random, buildings, MOST);
		polls = count_polls(MOST);
		CHECK(polls >= MOST / 4096, "%s: %zu polls for %d buildings", large_kind_name[kind], polls, MOST);
		printf("  information: %s, %d buildings: %zu polls, at most %.1f ms between two\n", large_kind_name[kind], MOST,
			   polls, 1000.0 * (double) around.longest_gap / CLOCKS_PER_SEC);
	}
}

static void
a_long_ring_without_memory_is_told(void)
{
	static ty_point points[1000];
	ty_measure m;
	ty_building b;

	for (size_t i = 0; i < 1000; i++)
		points[i] = (ty_point){(double) i, (double) (i * i)};
	for (size_t k = 1; k <= 3; k++)
	{
		ty_status status;

		begin(k, 0, false);
		ty_measure_begin(&m, &watched);
		ty_measure_ring(&m, points, sizeof *points, 100, true);
		ty_measure_ring(&m, points, sizeof *points, 1000, true);
		ty_measure_line(&m, points, sizeof *points, 1000);
		status = ty_measure_end(&m, &b);
		CHECK(status == (around.allocations < k ? TY_OK : TY_NO_MEMORY), "allocation %zu failed: status %d", k, status);
		CHECK(around.blocks == 0, "allocation %zu failed: %zu blocks are left", k, around.blocks);
	}
}

static void
a_measure_of_few_points_allocates_nothing(void)
{
	ty_point points[] = {{0, 0}, {1, 0}, {1, 1}, {0, 0}};
	ty_measure m;
	ty_building b;

	begin(0, 0, false);
	ty_measure_begin(&m, &watched);
	for (size_t i = 0; i < 16; i++)
		ty_measure_ring(&m, points, sizeof *points, 4, true);
	CHECK(ty_measure_end(&m, &b) == TY_OK, "end");
	CHECK(around.allocations == 0, "%zu allocations for 64 points", around.allocations);
}

static void
array_sizes_do_not_overflow(void)
{
	CHECK(ty_allocate_array(&ty_plain_environment, SIZE_MAX / 2, 3) == NULL, "wrapped around");
	CHECK(ty_allocate_array(&ty_plain_environment, SIZE_MAX / 8 + 1, 8) == NULL, "wrapped around to 0");
	ty_release(&ty_plain_environment, NULL);
}

int
main(int argc, char **argv)
{
	check_begin(argc, argv);
	RUN(array_sizes_do_not_overflow);
	RUN(a_measure_of_few_points_allocates_nothing);
	RUN(a_long_ring_without_memory_is_told);
	RUN(every_allocation_may_fail);
	RUN(every_allocation_may_leave_by_longjmp);
	RUN(every_poll_may_interrupt);
	RUN(hierarchies_fail_and_stop_as_cleanly);
	RUN(polls_are_frequent);
	return check_end();
}
