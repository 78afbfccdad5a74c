/* row_array.c - see row_array.h */
#include "row_array.h"

#include "utils/lsyscache.h"
#include "utils/memutils.h"
#include "utils/typcache.h"

#include "geometry.h"
#include "options.h"

/* A value that is kept in a tuple, as a materialized CTE does, has a header more. */
#define LARGEST_ARRAY (MaxAllocSize - 1024)

void
ty_array_header(ArrayType *array, size_t size, Oid element, int count)
{
	SET_VARSIZE(array, size);
	array->ndim = 1;
	array->dataoffset = 0; /* no nulls */
	array->elemtype = element;
	ARR_DIMS(array)[0] = count;
	ARR_LBOUND(array)[0] = 1;
}

void
ty_row_array_begin(ty_row_array *rows, FunctionCallInfo fcinfo, int fields, const char *type, size_t size, size_t count)
{
	Oid element = get_element_type(get_func_rettype(fcinfo->flinfo->fn_oid));

	size += ARR_OVERHEAD_NONULLS(1);
	if (size > LARGEST_ARRAY)
		ty_refuse_size();
	rows->shape = lookup_rowtype_tupdesc(element, -1);
	ty_check_shape(rows->shape, fields, type);
	rows->values = palloc0(rows->shape->natts * sizeof(Datum));
	rows->nulls = palloc0(rows->shape->natts * sizeof(bool));
	memset(rows->nulls + fields, true, rows->shape->natts - fields);
	rows->array = palloc(size);
	ty_array_header(rows->array, size, element, (int) count);
	rows->used = ARR_OVERHEAD_NONULLS(1);
}

/* Rows start aligned; the bytes between them are zero, so that equal arrays are the same bytes. */
void
ty_row_array_add(ty_row_array *rows)
{
	HeapTuple row = heap_form_tuple(rows->shape, rows->values, rows->nulls);
	char *at = (char *) rows->array + rows->used;

	memcpy(at, row->t_data, row->t_len);
	memset(at + row->t_len, 0, MAXALIGN(row->t_len) - row->t_len);
	rows->used += MAXALIGN(row->t_len);
	heap_freetuple(row);
}

Datum
ty_row_array_end(ty_row_array *rows)
{
	ReleaseTupleDesc(rows->shape);
	pfree(rows->values);
	pfree(rows->nulls);
	SET_VARSIZE(rows->array, rows->used);
	return PointerGetDatum(rows->array);
}

void
ty_placeholder_values(const ty_placeholder *placeholder, int64 id, Datum polygon, Datum *values, bool *nulls)
{
	memset(nulls, false, TY_PLACEHOLDER_FIELDS * sizeof(bool));
	nulls[TY_PLACEHOLDER_MEMBERS] = true;
	nulls[TY_PLACEHOLDER_GEOM] = polygon == (Datum) 0;
	values[TY_PLACEHOLDER_ID] = Int64GetDatum(id);
	values[TY_PLACEHOLDER_GEOM] = polygon;
	values[TY_PLACEHOLDER_MEMBER_COUNT] = Int32GetDatum((int32) placeholder->count);
	values[TY_PLACEHOLDER_AREA] = Float8GetDatum(placeholder->area);
	values[TY_PLACEHOLDER_WIDTH] = Float8GetDatum(placeholder->width);
	values[TY_PLACEHOLDER_LENGTH] = Float8GetDatum(placeholder->length);
	values[TY_PLACEHOLDER_ORIENTATION] = Float8GetDatum(ty_orientation_degrees(placeholder->ux, placeholder->uy));
}
