/* alignment_merge.c - rows in the collapse, see alignment.h */
#include "alignment.h"

#include <math.h>

/* whether b follows a in a row */
static bool
follows(ty_span a, ty_span b)
{
	return a.row != TY_NONE && a.row == b.row && a.last + 1 == b.first;
}

/*
 * A row of k members is halved, the left half getting the floor, and the halves again. Of the nodes at a depth D the
 * one whose way from the root is read backwards as the number t (a step to the right is a 1) has
 * floor((k + t) / 2^D) members. From the top down the nodes of a depth are split from the largest t on, larger ones
 * first and neighbours far apart; before t's turn there are 2^D + (2^D - 1 - t) vertices, so that its merge, the other
 * way round, finds 2^(D + 1) - t of them. The mean spacing is then that of the members times k over this number. Where
 * the two do not make up a node, since others have left the row, it is the spacing of vertices of that many members:
 * no less than for any node as large.
 */
static double
due_spacing(uint32_t k, double spacing, uint32_t first, uint32_t middle, uint32_t last)
{
	uint32_t low = 0, high = k;
	uint64_t step = 1, turn = 0;

	for (;; step *= 2)
	{
		uint32_t half = low + (high - low) / 2;

		if (low == first && high == last + 1 && half == middle)
			return spacing * k / (double) (2 * step - turn);
		if (last < half)
			high = half;
		else if (first >= half)
		{
			low = half;
			turn += step;
		}
		else
			return spacing * (double) (last - first + 1);
	}
}

static uint64_t
members_of(ty_span s)
{
	return (uint64_t) s.last - s.first + 1;
}

/* whether a vertex of a row stays in it with what is added to make it of that size */
static bool
stays(ty_span s, uint64_t size)
{
	return s.row != TY_NONE && 2 * members_of(s) >= size;
}

double
ty_aligned_length(const ty_rows *rows, ty_span a, ty_span b, uint64_t size, double length, double alignment)
{
	ty_span before = a.first < b.first ? a : b, after = a.first < b.first ? b : a, alone = a.row == TY_NONE ? b : a;
	uint32_t row = before.row;

	if (alone.row == TY_NONE)
		return length;
	if (follows(before, after))
		return fmax(length, due_spacing(rows->first[row + 1] - rows->first[row], rows->spacing[row], before.first,
										after.first, after.last));
	if ((a.row == TY_NONE || b.row == TY_NONE) && length < rows->spacing[alone.row] && stays(alone, size))
		return length;
	return length * (1 + alignment);
}

ty_span
ty_joined_span(ty_span a, ty_span b, uint64_t size)
{
	ty_span none = {TY_NONE, 0, 0}, alone = a.row == TY_NONE ? b : a;

	if (follows(a, b))
		return (ty_span){a.row, a.first, b.last};
	if (follows(b, a))
		return (ty_span){a.row, b.first, a.last};
	return (a.row == TY_NONE || b.row == TY_NONE) && stays(alone, size) ? alone : none;
}
