/* progress.c - see progress.h */
#include "compat.h"

#include "utils/guc.h"
#include "utils/timestamp.h"

#include "backend.h"
#include "progress.h"

#define QUIET_MILLISECONDS 1000

static bool show_progress = false;

/* What a phase is called, and the share of the whole work at which it ends (measured: a million buildings). */
static const struct
{
	const char *name;
	double end;
} phases[] = {
	[TY_ORDERING] = {"ordering", 0.10},
	[TY_MESHING] = {"building the mesh", 0.25},
	[TY_COLLAPSING] = {"collapsing", 0.85},
	[TY_DRAWING] = {"drawing", 1.00},
};

typedef struct report
{
	size_t buildings;
	TimestampTz begin;
	int tenths; /* shown so far */
} report;

/* The core's word of progress. It may fall back: a mesh is built anew while collapsing. */
static void
show(void *context, ty_phase phase, double share)
{
	report *r = context;
	double begin = phase == TY_ORDERING ? 0 : phases[phase - 1].end;
	int tenths = (int) (10 * (begin + share * (phases[phase].end - begin)));

	if (tenths <= r->tenths || !TimestampDifferenceExceeds(r->begin, GetCurrentTimestamp(), QUIET_MILLISECONDS))
		return;
	r->tenths = tenths;
	ereport(NOTICE, errmsg("typifying a group of %zu buildings: %s, %d %% done", r->buildings, phases[phase].name,
						   10 * tenths));
}

void
ty_define_progress(void)
{
	DefineCustomBoolVariable("typify.progress", "Shows how far the typification of a large group is.",
							 "A group that takes over a second raises a NOTICE about every tenth of its work.",
							 &show_progress, false, PGC_USERSET, 0, NULL, NULL, NULL);
	ty_reserve_settings("typify");
}

/* The backend's environment, with notices where the user asks for them. */
static ty_environment
watched_environment(report *r, size_t n)
{
	ty_environment env = ty_backend_environment;

	*r = (report){.buildings = n};
	if (show_progress)
	{
		r->begin = GetCurrentTimestamp();
		env.progress = show;
		env.context = r;
	}
	return env;
}

void
ty_typify_group(const ty_input *input, const ty_parameters *p, ty_result *result)
{
	report r;
	ty_environment env = watched_environment(&r, input->n);

	ty_check_status(ty_typify(&env, input, p, result));
}

void
ty_build_hierarchy(const ty_input *input, const ty_parameters *p, ty_hierarchy *h)
{
	report r;
	ty_environment env = watched_environment(&r, input->n);

	ty_check_status(ty_hierarchy_build(&env, input, p, h));
}
