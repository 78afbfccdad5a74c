/*
 * merges.c - the core's merge sequence for points of one's own: reads "x y" lines, prints "position x y" for each
 * rank, in grid cells, then "merge kept gone cost" for each merge. The argument is s_u. Run by scipy.sh.
 */
#include "collapse.h"

#include <stdio.h>
#include <stdlib.h>

#define MOST 100000

static ty_building buildings[MOST];
static uint32_t order[MOST];
static ty_position position[MOST];
static uint64_t keys[MOST];

int
main(int argc, char **argv)
{
	const ty_environment *env = &ty_plain_environment;
	const ty_stop to_one = {1, 0};
	double s_u = argc > 1 ? atof(argv[1]) : 0;
	size_t n = 0;
	ty_grid grid;
	ty_sequence sequence;

	while (n < MOST && scanf("%lf %lf", &buildings[n].x, &buildings[n].y) == 2)
		n++;
	if (n == 0 || ty_grid_fit(buildings, n, &grid) != TY_OK ||
		ty_canonical_order(env, buildings, n, &grid, order, position, keys) != TY_OK)
		return 1;
	for (size_t rank = 0; rank < n; rank++)
		printf("position %d %d\n", position[rank].x, position[rank].y);
	if (ty_collapse(env, position, n, s_u, NULL, to_one, true, NULL, NULL, &sequence) != TY_OK)
		return 1;
	for (size_t i = 0; i < sequence.count; i++)
		printf("merge %u %u %.17g\n", sequence.kept[i], sequence.gone[i], sequence.cost[i]);
	ty_sequence_free(env, &sequence);
	return 0;
}
