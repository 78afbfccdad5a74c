/* clock.h - the processor's time of this process, which other work on the machine disturbs least. */
#ifndef TY_BENCH_CLOCK_H
#define TY_BENCH_CLOCK_H

#include <time.h>

static inline double
clock_seconds(void)
{
	struct timespec now;

	clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
	return (double) now.tv_sec + 1e-9 * (double) now.tv_nsec;
}

#endif
