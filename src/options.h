/*
 * options.h - the composite typify_options and its way into the core's parameters, with every check.
 */
#ifndef TY_OPTIONS_H
#define TY_OPTIONS_H

#include "compat.h"
#include "access/tupdesc.h"
#include "core/placeholder.h"

/*
 * Resolves scale, s_u and options (a typify_options composite, or options_null) to parameters: every value is
 * checked, however the composite was made, then defaults are applied. Lengths on the map stay millimetres: see
 * ty_bring_to_ground.
 */
extern void ty_resolve_parameters(double scale, double s_u, Datum options, bool options_null,
								  ty_parameters *parameters);

/*
 * The same for a hierarchy, which is one for all scales: the scale becomes source_scale, and options that depend on it
 * are refused.
 */
extern void ty_resolve_hierarchy_parameters(double s_u, Datum options, bool options_null, ty_parameters *parameters);

/* Another scale or s_u for parameters that were resolved and not brought to the ground; checked like the first. */
extern void ty_set_scale(ty_parameters *p, double scale);
extern void ty_set_s_u(ty_parameters *p, double s_u);

/* The lines of options whose parameters have barriers. */
extern Datum ty_barriers_of_options(Datum options);

extern bool ty_same_parameters(const ty_parameters *a, const ty_parameters *b);

/*
 * Raises an error unless the composite has the given fields, whose number this library was built for, and after them
 * none but dropped ones.
 */
extern void ty_check_shape(TupleDesc shape, int fields, const char *type);

/* The errors that all arguments share: "NAME is VALUE, it must be ALLOWED" and "NAME must not be null". */
extern _Noreturn void ty_refuse_value(const char *name, double value, const char *allowed);
extern _Noreturn void ty_refuse_null(const char *name);

#endif
