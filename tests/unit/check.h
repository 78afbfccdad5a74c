/*
 * check.h - the smallest harness that tells what failed: one line per test, details indented above it.
 *
 * A test program is one .c file whose main() calls check_begin, RUN for each test, and returns check_end().
 * Its first argument, if any, restricts the run to the tests whose name contains it. Helpers are inline so that
 * no program has to use all of them.
 */
#ifndef TY_CHECK_H
#define TY_CHECK_H

#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#define CHECK_FAILED 10 /* exit status; any other but 0 means that the program died, of a sanitizer for example */
#define CHECK_SHOWN 5	/* failures of one test that are printed; the rest is counted */

static const char *check_filter = "";
static size_t check_failures; /* of the test that runs */
static size_t check_failed;	  /* tests of this program */

/* true when the condition holds; else notes the failure with the printf-like message that tells the values */
#define CHECK(condition, ...) check_note((condition), __FILE__, __LINE__, #condition, __VA_ARGS__)
/* the same, and leaves the test: for conditions without which the rest makes no sense */
#define NEED(condition, ...)                \
	do                                      \
	{                                       \
		if (!CHECK(condition, __VA_ARGS__)) \
			return;                         \
	} while (0)
#define RUN(test) check_run(#test, test)

__attribute__((format(printf, 5, 6))) static inline bool
check_note(bool holds, const char *file, int line, const char *condition, const char *format, ...)
{
	va_list values;

	if (holds)
		return true;
	if (++check_failures > CHECK_SHOWN)
		return false;
	printf("  %s:%d: not true: %s: ", file, line, condition);
	va_start(values, format);
	vprintf(format, values);
	va_end(values);
	printf("\n");
	return false;
}

static inline void
check_begin(int argc, char **argv)
{
	if (argc > 1)
		check_filter = argv[1];
	setvbuf(stdout, NULL, _IOLBF, 0);
}

static inline void
check_run(const char *name, void (*test)(void))
{
	if (strstr(name, check_filter) == NULL)
		return;
	check_failures = 0;
	test();
	if (check_failures > CHECK_SHOWN)
		printf("  ... and %zu more\n", check_failures - CHECK_SHOWN);
	if (check_failures > 0)
		check_failed++;
	printf("%s %s\n", check_failures == 0 ? "ok" : "failed", name);
}

static inline int
check_end(void)
{
	return check_failed == 0 ? 0 : CHECK_FAILED;
}

#endif
