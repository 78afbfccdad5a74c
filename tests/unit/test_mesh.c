/*
 * test_mesh.c - the fear: the mesh that divide and conquer builds is not the Delaunay mesh under the tie rule, or
 * the invariant checker does not see a broken one.
 */
#include "check.h"
#include "mesh.h"
#include "reference.h"
#include "sets.h"

/* distinct positions along the curve */
static size_t
drop_repeats(ty_position *position, uint64_t *keys, size_t n)
{
	size_t kept = 0;

	for (size_t i = 0; i < n; i++)
		if (i == 0 || keys[i] != keys[kept - 1])
		{
			position[kept] = position[i];
			keys[kept++] = keys[i];
		}
	return kept;
}

static bool
edges_equal(const ty_mesh *mesh, const uint32_t *list, size_t n)
{
	static reference_edges expected, found;
	ty_position position[REFERENCE_MAX];

	memset(found, 0, sizeof found);
	for (size_t i = 0; i < n && n > 1; i++)
	{
		uint32_t h = mesh->vertex[list[i]].edge;

		do
			if (ty_target(mesh, h) != TY_GHOST)
				found[list[i]][ty_target(mesh, h)] = true;
		while ((h = ty_next_around(mesh, h)) != mesh->vertex[list[i]].edge);
	}
	positions_of_vertices(mesh->vertex, mesh->vertices, position);
	reference_delaunay(position, list, n, expected);
	return memcmp(expected, found, sizeof found) == 0;
}

static void
built_mesh_equals_all_triples(void)
{
	uint32_t list[REFERENCE_MAX];
	ty_position position[REFERENCE_MAX];
	ty_vertex vertex[REFERENCE_MAX];
	uint64_t keys[REFERENCE_MAX];

	for (uint32_t i = 0; i < REFERENCE_MAX; i++)
		list[i] = i;
	for (size_t set = 0; set < 3000; set++)
	{
		random_state random = random_seed(5000 + set);
		small_kind kind = (small_kind) (set % SMALL_KINDS);
		size_t n = (size_t) random_between(&random, 1, set % 50 == 0 ? REFERENCE_MAX : 30);
		ty_mesh mesh;
		const char *broken;

		small_set(kind, &random, position, n);
		sort_along_curve(position, keys, n);
		n = drop_repeats(position, keys, n);
		vertices_at_positions(position, n, vertex);
		NEED(ty_mesh_build(&ty_plain_environment, vertex, n, set % 2 == 0 ? NULL : list, keys, n, &mesh) == TY_OK,
			 "%s, set %zu", small_kind_name[kind], set);
		broken = ty_mesh_check(&mesh);
		NEED(broken == NULL, "%s, set %zu, n %zu: %s", small_kind_name[kind], set, n, broken);
		CHECK(mesh.live == n, "%s, set %zu: %zu vertices of %zu", small_kind_name[kind], set, mesh.live, n);
		CHECK(edges_equal(&mesh, list, n), "%s, set %zu, n %zu: other edges", small_kind_name[kind], set, n);
		ty_mesh_free(&mesh);
	}
}

static void
a_mesh_over_a_part_of_the_vertices(void)
{
	ty_position position[REFERENCE_MAX];
	ty_vertex vertex[REFERENCE_MAX];
	uint64_t keys[REFERENCE_MAX], part_keys[REFERENCE_MAX];
	uint32_t part[REFERENCE_MAX];
	random_state random = random_seed(31);

	for (size_t set = 0; set < 300; set++)
	{
		size_t n, m = 0;
		ty_mesh mesh;

		small_set((small_kind) (set % SMALL_KINDS), &random, position, 40);
		sort_along_curve(position, keys, 40);
		n = drop_repeats(position, keys, 40);
		vertices_at_positions(position, n, vertex);
		for (uint32_t i = 0; i < n; i++)
			if (m == 0 || random_between(&random, 0, 2) > 0)
			{
				part[m] = i;
				part_keys[m++] = keys[i];
			}
		NEED(ty_mesh_build(&ty_plain_environment, vertex, n, part, part_keys, m, &mesh) == TY_OK, "set %zu", set);
		NEED(ty_mesh_check(&mesh) == NULL, "set %zu: %s", set, ty_mesh_check(&mesh));
		CHECK(edges_equal(&mesh, part, m), "set %zu: other edges", set);
		ty_mesh_free(&mesh);
	}
}

static ty_mesh
mesh_of_kind(small_kind kind, random_state *random, ty_vertex *vertex)
{
	ty_position position[REFERENCE_MAX];
	uint64_t keys[REFERENCE_MAX];
	size_t n;
	ty_mesh mesh;

	small_set(kind, random, position, 30);
	sort_along_curve(position, keys, 30);
	n = drop_repeats(position, keys, 30);
	vertices_at_positions(position, n, vertex);
	CHECK(ty_mesh_build(&ty_plain_environment, vertex, n, NULL, keys, n, &mesh) == TY_OK, "n %zu", n);
	return mesh;
}

/* A checker that accepts everything would make all other tests worthless. */
static void
the_checker_sees_damage(void)
{
	random_state random = random_seed(32);
	ty_vertex vertex[REFERENCE_MAX];
	size_t seen = 0, swapped = 0, moved = 0;

	for (size_t i = 0; i < 100; i++)
	{
		ty_mesh mesh = mesh_of_kind(SMALL_MODEST_RANGE, &random, vertex);
		uint32_t h = vertex[5].edge;
		uint32_t opposite = ty_opposite(&mesh, h);
		ty_position before = vertex[7].position;
		uint32_t *corner = mesh.triangles[ty_triangle_of(h)].vertex;

		mesh.triangles[ty_triangle_of(h)].adjacent[ty_corner_of(h)] = ty_next_in_triangle(h);
		seen += ty_mesh_check(&mesh) != NULL;
		mesh.triangles[ty_triangle_of(h)].adjacent[ty_corner_of(h)] = opposite;
		vertex[7].position = (ty_position){1 << 29, 1 << 29};
		moved += ty_mesh_check(&mesh) != NULL;
		vertex[7].position = before;
		*corner ^= 1;
		swapped += ty_mesh_check(&mesh) != NULL;
		*corner ^= 1;
		CHECK(ty_mesh_check(&mesh) == NULL, "repaired: %s", ty_mesh_check(&mesh));
		ty_mesh_free(&mesh);
	}
	CHECK(seen == 100 && moved == 100 && swapped == 100, "of 100: adjacency %zu, moved %zu, renamed %zu", seen, moved,
		  swapped);
}

/* Renames every vertex to the next around a square of four, positions and all: nothing changes but the ranks. */
static void
rename_around(ty_mesh *mesh)
{
	ty_vertex last = mesh->vertex[3];

	for (uint32_t v = 3; v > 0; v--)
		mesh->vertex[v] = mesh->vertex[v - 1];
	mesh->vertex[0] = last;
	for (uint32_t h = 0; h < ty_half_edge(2 * 4 - 2, 0); h = ty_next_half_edge(h))
		if (ty_origin(mesh, h) != TY_GHOST)
			mesh->triangles[ty_triangle_of(h)].vertex[ty_corner_of(h)] = (ty_origin(mesh, h) + 1) % 4;
}

/* Of a square one diagonal is in the mesh: the other one is Delaunay too, but a trace of history. */
static void
the_checker_sees_the_other_diagonal(void)
{
	ty_position square[] = {{0, 0}, {0, 10}, {10, 10}, {10, 0}};
	ty_vertex vertex[4];
	uint64_t keys[4];
	ty_mesh mesh;

	sort_along_curve(square, keys, 4);
	vertices_at_positions(square, 4, vertex);
	NEED(ty_mesh_build(&ty_plain_environment, vertex, 4, NULL, keys, 4, &mesh) == TY_OK, "build");
	CHECK(ty_mesh_check(&mesh) == NULL, "%s", ty_mesh_check(&mesh));
	rename_around(&mesh);
	CHECK(ty_mesh_check(&mesh) != NULL, "the wrong diagonal passed");
	rename_around(&mesh);
	CHECK(ty_mesh_check(&mesh) == NULL, "renamed twice the right one is back: %s", ty_mesh_check(&mesh));
	ty_mesh_free(&mesh);
}

int
main(int argc, char **argv)
{
	check_begin(argc, argv);
	RUN(built_mesh_equals_all_triples);
	RUN(a_mesh_over_a_part_of_the_vertices);
	RUN(the_checker_sees_damage);
	RUN(the_checker_sees_the_other_diagonal);
	return check_end();
}
