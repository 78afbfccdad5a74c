/* counting.h - an environment over malloc that knows how much memory is in use, and was at most. */
#ifndef TY_COUNTING_H
#define TY_COUNTING_H

#include "environment.h"

typedef struct counting
{
	size_t used, peak; /* bytes as asked for, without what malloc adds */
} counting;

/* the counter must outlive what is allocated */
ty_environment counting_environment(counting *counter);

#endif
