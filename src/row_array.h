/*
 * row_array.h - a result that is an array of composites, written row by row into one value; the fields of a
 * placeholder.
 */
#ifndef TY_ROW_ARRAY_H
#define TY_ROW_ARRAY_H

#include "compat.h"
#include "access/htup_details.h"
#include "access/tupdesc.h"
#include "utils/array.h"

#include "core/group.h"

typedef struct ty_row_array
{
	TupleDesc shape;
	Datum *values; /* of a row, with dropped attributes behind the fields */
	bool *nulls;
	ArrayType *array; /* room for the most it can take; what is not written takes no memory */
	size_t used;
} ty_row_array;

/* header with null bitmap and alignment: what a row of up to 16 fields takes at most besides these */
#define TY_ROW_OVERHEAD (MAXALIGN(SizeofHeapTupleHeader + 2) + 2 * MAXIMUM_ALIGNOF)

/*
 * Begins the array that the function returns, of so many rows of so many fields, whose type is called type. size: what
 * they take at most; ty_refuse_size where a value cannot hold it. Memory is of the current context.
 */
extern void ty_row_array_begin(ty_row_array *rows, FunctionCallInfo fcinfo, int fields, const char *type, size_t size,
							   size_t count);
/* Appends values and nulls as a row. */
extern void ty_row_array_add(ty_row_array *rows);
/* The array; everything else is given back. */
extern Datum ty_row_array_end(ty_row_array *rows);

/* The fields of the composite typify_placeholder, in order. */
enum
{
	TY_PLACEHOLDER_ID = 0,
	TY_PLACEHOLDER_GEOM,
	TY_PLACEHOLDER_MEMBER_COUNT,
	TY_PLACEHOLDER_MEMBERS,
	TY_PLACEHOLDER_AREA,
	TY_PLACEHOLDER_WIDTH,
	TY_PLACEHOLDER_LENGTH,
	TY_PLACEHOLDER_ORIENTATION,
	TY_PLACEHOLDER_FIELDS
};

/* Sets all but the members, which are NULL. polygon: 0 where there is none. */
extern void ty_placeholder_values(const ty_placeholder *placeholder, int64 id, Datum polygon, Datum *values,
								  bool *nulls);

/* The header of an array of one dimension without nulls. */
extern void ty_array_header(ArrayType *array, size_t size, Oid element, int count);

#endif
