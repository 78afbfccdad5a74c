/*
 * call.h - what one aggregate or window call in a query remembers between rows and groups: its parameters, parsed
 * as rarely as its arguments can change, and the SRIDs it has looked up.
 */
#ifndef TY_CALL_H
#define TY_CALL_H

#include "barriers.h"
#include "compat.h"
#include "constancy.h"
#include "core/placeholder.h"
#include "pool.h"
#include "srid.h"

/*
 * scale, s_u, options, barriers; all but scale may not be given. Barriers may be an option or, for wrappers, an
 * argument.
 */
#define TY_CALL_ARGUMENTS 4

typedef struct ty_call
{
	MemoryContext context;			  /* lives as long as the plan node */
	MemoryContext group_context;	  /* of the group that asks; set by whoever calls ty_call_parameters */
	ty_constancy constancy;			  /* the least of the arguments' */
	bool constant[TY_CALL_ARGUMENTS]; /* for the query */
	bool sorted;					  /* a constant argument does not stay where it is from row to row */
	bool options_per_row;			  /* the plan makes them anew for every row */
	int repeated;					  /* rows on end for which that gave the same */
	int given;						  /* 1 .. TY_CALL_ARGUMENTS */
	bool with_scale;				  /* false: a hierarchy's, whose first argument is not looked at */
	bool parsed;
	NullableDatum arguments[TY_CALL_ARGUMENTS]; /* what parameters were parsed from; unused where constant */
	ty_parameters resolved;						/* once parsed: scale, s_u and options, without the argument barriers */
	ty_parameters parameters;
	ty_barrier_cache barriers;		   /* current: those of the parameters, if they have any */
	ty_barrier_hash barriers_argument; /* once parsed */
	uint64 generation;				   /* counts how often parameters changed */
	ty_srid_cache srids;
	ty_pools pools; /* of an aggregate */
} ty_call;

/*
 * The call of an aggregate's transition function or of a window function, made when asked for the first time.
 * The parameters, at most `given` of them, start at argument `first`, the scale's place, also where there is none; the
 * geometry is argument `geometry`.
 */
extern ty_call *ty_call_of(FunctionCallInfo fcinfo, int first, int given, int geometry, bool with_scale);

/*
 * The parameters for a row, and in call->barriers.current the barriers that go with them; arguments holds call->given
 * values. They stay where they are: another generation means that their values changed.
 */
extern const ty_parameters *ty_call_parameters(ty_call *call, const NullableDatum *arguments, bool group_begins);

extern _Noreturn void ty_refuse_varying_parameters(void);

#endif
