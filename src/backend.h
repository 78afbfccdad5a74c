/*
 * backend.h - the core's environment inside PostgreSQL, and its status as an error.
 */
#ifndef TY_BACKEND_H
#define TY_BACKEND_H

#include "core/environment.h"

/*
 * Memory of the context that is current when asked, in chunks of any size; lack of memory and a cancelled
 * statement leave by ereport, so the core never sees them as a status.
 */
extern const ty_environment ty_backend_environment;

/* Raises the error that a status of the core stands for; returns for TY_OK. */
extern void ty_check_status(ty_status status);

/* Gives memory that was freed back to the system; takes milliseconds, so only after a large group. */
extern void ty_trim_memory(void);

/* A number as PostgreSQL prints it: the shortest that reads back the same. */
extern char *ty_number_text(double number);

#endif
