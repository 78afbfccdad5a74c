/*
 * environment.h - what the core needs from its surroundings, passed in and never global.
 *
 * The core is pure C11. It asks its environment for memory and, in every long loop, whether it should
 * stop. Either call may return failure or leave by longjmp (PostgreSQL does the latter); the core keeps
 * nothing outside the environment's memory, so both are safe.
 */
#ifndef TY_ENVIRONMENT_H
#define TY_ENVIRONMENT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#if !defined(__SIZEOF_INT128__)
#error "typify needs a compiler with 128-bit integers (gcc or clang on a 64-bit machine)"
#endif

typedef enum ty_status
{
	TY_OK = 0,
	TY_NO_MEMORY,	/* an allocation failed */
	TY_INTERRUPTED, /* the environment asked to stop */
	TY_TOO_MANY,	/* more vertices than the mesh can number (TY_MAX_VERTICES) */
	TY_NOT_FINITE,	/* a coordinate or an area is NaN or infinite */
	TY_BROKEN		/* an invariant does not hold: a fault of ours */
} ty_status;

/* What the core is about, in this order. */
typedef enum ty_phase
{
	TY_ORDERING,
	TY_MESHING,
	TY_COLLAPSING,
	TY_DRAWING
} ty_phase;

typedef struct ty_environment
{
	/* size > 0; memory is aligned for any type and not cleared; NULL when there is none */
	void *(*allocate)(void *context, size_t size);
	/* grows or shrinks what allocate returned; NULL leaves the old memory as it was */
	void *(*reallocate)(void *context, void *memory, size_t size);
	/* memory may be NULL */
	void (*release)(void *context, void *memory);
	/* true: stop as soon as possible. May be NULL. */
	bool (*interrupted)(void *context);
	/* told now and then, a few thousand steps apart, which share (0 .. 1) of a phase is done. May be NULL. */
	void (*progress)(void *context, ty_phase phase, double share);
	void *context;
} ty_environment;

/* malloc, realloc, free and no interrupts: for tests, fuzzing and benchmarks. */
extern const ty_environment ty_plain_environment;

/* count * size bytes, checked for overflow; NULL when there is no memory. A count of 0 allocates one element. */
void *ty_allocate_array(const ty_environment *env, size_t count, size_t size);
void *ty_reallocate_array(const ty_environment *env, void *memory, size_t count, size_t size);
void ty_release(const ty_environment *env, void *memory);

static inline bool
ty_interrupted(const ty_environment *env)
{
	return env->interrupted != NULL && env->interrupted(env->context);
}

static inline void
ty_progress(const ty_environment *env, ty_phase phase, size_t done, size_t all)
{
	if (env->progress != NULL)
		env->progress(env->context, phase, (double) done / (double) all);
}

/* For long loops of small steps: looks at every 4096th step only, a fraction of a millisecond. */
static inline bool
ty_interrupted_at(const ty_environment *env, size_t step)
{
	return step % 4096 == 0 && ty_interrupted(env);
}

#endif
