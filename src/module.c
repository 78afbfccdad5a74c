/* module.c - what makes the library loadable */
#include "compat.h"

#include "progress.h"

PG_MODULE_MAGIC;

void _PG_init(void);

void
_PG_init(void)
{
	ty_define_progress();
}
