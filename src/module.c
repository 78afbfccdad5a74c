/* module.c - what makes the library loadable. There is no state to set up: everything lives with its call. */
#include "compat.h"

PG_MODULE_MAGIC;
