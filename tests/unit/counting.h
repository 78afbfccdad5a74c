/* counting.h - an environment over malloc that knows how much memory is in use, and was at most; it can fail. */
#ifndef TY_COUNTING_H
#define TY_COUNTING_H

#include "environment.h"

typedef struct counting
{
	size_t used, peak;	/* bytes as asked for, without what malloc adds */
	size_t allocations; /* how often memory has been asked for */
	size_t failing;		/* which of these times there is none; 0: never. To be set after counting_environment */
} counting;

/* the counter must outlive what is allocated */
ty_environment counting_environment(counting *counter);

#endif
