/*
 * progress.h - long statements show life: notices while a large group is typified, where the user asks for them.
 */
#ifndef TY_PROGRESS_H
#define TY_PROGRESS_H

#include "core/group.h"
#include "core/hierarchy.h"

/* Defines the setting typify.progress; called when the library is loaded. */
extern void ty_define_progress(void);

/*
 * ty_typify in the backend's environment; the result is of the current context, a status is raised as its error.
 * With typify.progress on, a group that takes over a second raises a NOTICE about every tenth of its work.
 */
extern void ty_typify_group(const ty_input *input, const ty_parameters *p, ty_result *result);
/* The same for ty_hierarchy_build. */
extern void ty_build_hierarchy(const ty_input *input, const ty_parameters *p, ty_hierarchy *h);

#endif
