/*
 * fuzz_mesh.c - the fear: some set of points breaks the mesh or makes the core merge another pair than it should.
 *
 * Bytes: s_u, stop count, minimum distance, step and origin of the coordinates, then two bytes a point. The mesh is
 * checked after every merge; sets of at most 12 points are compared with the slow reference too. The origin's byte also
 * says whether there are importances, and a barrier.
 */
#include "compare.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#define HEADER 5
#define MOST 64		/* points */
#define COMPARED 12 /* points that the reference is given */

typedef struct input
{
	double s_u;
	ty_stop stop;
	size_t n;
	ty_position position[MOST];
	double importance[MOST];
	ty_influence influence; /* of it, and of the barrier */
} input;

/* The line x = place; what lies on it belongs to its right side. */
struct ty_barriers
{
	int32_t place;
};

static input in;
static ty_barriers barrier;

static bool
crosses(const ty_barriers *barriers, ty_position a, ty_position b, ty_position merged)
{
	(void) merged; /* it lies between them */
	return (a.x < barriers->place) != (b.x < barriers->place);
}

static void
give_up(const char *difference)
{
	fprintf(stderr, "%s: s_u %g, count %zu, min_distance %g, barrier %d:", difference, in.s_u, in.stop.count,
			in.stop.min_distance, in.influence.crosses == NULL ? -1 : barrier.place);
	for (size_t i = 0; i < in.n; i++)
		fprintf(stderr, " {%d, %d} of %g", in.position[i].x, in.position[i].y, in.importance[i]);
	fprintf(stderr, "\n");
	abort();
}

static void
check_after_merge(void *context, const ty_mesh *mesh, size_t step)
{
	const char *broken = mesh == NULL ? NULL : ty_mesh_check(mesh);

	(void) context;
	(void) step;
	if (broken != NULL)
		give_up(broken);
}

static int
compare_by_key(const void *a, const void *b)
{
	uint64_t key_a = ty_hilbert_key(*(const ty_position *) a);
	uint64_t key_b = ty_hilbert_key(*(const ty_position *) b);

	return (key_a > key_b) - (key_a < key_b);
}

/* NULL: none */
static const ty_influence *
influence(void)
{
	return in.influence.importance != NULL || in.influence.crosses != NULL ? &in.influence : NULL;
}

static void
read_influence(const unsigned char *data)
{
	static const double importances[] = {1, 1, 1.5, 3, 20, INFINITY};

	for (size_t i = 0; i < in.n; i++)
		in.importance[i] = importances[(data[HEADER + 2 * i] + data[HEADER + 2 * i + 1]) % 6];
	barrier.place = in.position[data[1] % in.n].x;
	in.influence = (ty_influence){.importance = data[4] & 2 ? in.importance : NULL,
								  .crosses = data[4] & 4 ? crosses : NULL,
								  .barriers = &barrier};
}

/* steps are powers of two, so that 256 of them never leave the grid of 2^30 */
static void
read_input(const unsigned char *data, size_t size)
{
	int shift = data[3] % 23;
	int32_t origin = data[4] % 2 == 0 ? 0 : (1 << 30) - (255 << shift);

	in.s_u = data[0] % 5 == 0 ? data[0] / 255.0 : (double) (data[0] % 4) / 3;
	in.n = (size - HEADER) / 2 < MOST ? (size - HEADER) / 2 : MOST;
	in.stop.count = 1 + data[1] % in.n;
	in.stop.min_distance = data[2] < 128 ? 0 : ldexp((double) (data[2] - 128), shift);
	for (size_t i = 0; i < in.n; i++)
	{
		in.position[i].x = origin + (int32_t) data[HEADER + 2 * i] * (1 << shift);
		in.position[i].y = origin + (int32_t) data[HEADER + 2 * i + 1] * (1 << shift);
	}
	qsort(in.position, in.n, sizeof *in.position, compare_by_key);
	read_influence(data);
}

int
LLVMFuzzerTestOneInput(const unsigned char *data, size_t size)
{
	static ty_position moved[MOST];
	ty_sequence sequence;
	const char *difference;

	if (size < HEADER + 2)
		return 0;
	read_input(data, size);
	if (in.n <= COMPARED)
	{
		difference = compare_with_reference(in.position, in.n, in.s_u, influence(), in.stop, REFERENCE_MESH);
		if (difference != NULL)
			give_up(difference);
		return 0;
	}
	for (size_t i = 0; i < in.n; i++)
		moved[i] = in.position[i];
	if (ty_collapse(&ty_plain_environment, moved, in.n, in.s_u, influence(), in.stop, true, check_after_merge, NULL,
					&sequence) != TY_OK)
		give_up("no success");
	difference = compare_unwatched(in.position, in.n, in.s_u, influence(), in.stop, &sequence, moved);
	if (difference != NULL)
		give_up(difference);
	ty_sequence_free(&ty_plain_environment, &sequence);
	return 0;
}
