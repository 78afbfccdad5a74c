/* compare.h - the core's collapse beside the reference, step by step: for the unit tests and the fuzzer. */
#ifndef TY_COMPARE_H
#define TY_COMPARE_H

#include "reference.h"

/*
 * Collapses n <= REFERENCE_MAX positions, sorted along the curve, with the core and with the reference. NULL when
 * merges, costs, positions and, after each merge, the mesh are the same; else what differs.
 */
const char *compare_with_reference(const ty_position *position, size_t n, double s_u, const ty_influence *influence,
								   ty_stop stop, reference_candidates candidates);

/*
 * Collapses at most REFERENCE_MAX positions once more with nobody watching, when few of them have no mesh. watched is
 * the sequence that somebody watched, end where the positions came to. NULL when both are the same again.
 */
const char *compare_unwatched(const ty_position *position, size_t n, double s_u, const ty_influence *influence,
							  ty_stop stop, const ty_sequence *watched, const ty_position *end);

/*
 * Takes points away from a set that differs while it still does. Returns how many are left; they stay sorted. The
 * count to stop at is held down to what is left. Importances and rows, where there are any, are taken away with them.
 */
size_t compare_minimise(ty_position *position, size_t n, double s_u, const ty_influence *influence, ty_stop stop,
						reference_candidates candidates);

#endif
