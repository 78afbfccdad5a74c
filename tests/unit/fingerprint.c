/*
 * fingerprint.c - prints one number over everything that the core computes from generated data. Two builds of the
 * core that print different numbers break the promise "same answer, always" (spec 2.4). Run by determinism.sh.
 */
#include "collapse.h"
#include "group.h"
#include "sets.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

#define MOST 3000
#define ROW_ORDERS 50

static ty_building buildings[MOST];

/* FNV-1a of 64 bits */
static uint64_t
hash_bytes(uint64_t hash, const void *bytes, size_t size)
{
	for (size_t i = 0; i < size; i++)
		hash = (hash ^ ((const unsigned char *) bytes)[i]) * UINT64_C(0x100000001b3);
	return hash;
}

#define HASH(hash, value) hash_bytes(hash, &(value), sizeof(value))
#define HASH_START UINT64_C(0xcbf29ce484222325)

static void
stop_on(ty_status status, const char *where)
{
	if (status == TY_OK)
		return;
	printf("%s: status %d\n", where, status);
	exit(1);
}

static ty_parameters
draw_parameters(size_t i)
{
	static const double scales[] = {30000, 50000, 75000, 200000, 300000};
	ty_parameters p = {0};

	p.scale = scales[i % 5];
	p.s_u = (double) (i % 4) / 3;
	p.source_scale = TY_DEFAULT_SOURCE_SCALE;
	p.lod200_scale = TY_DEFAULT_LOD200_SCALE;
	p.exponent = i % 3 == 0 ? 1.3 : TY_DEFAULT_EXPONENT;
	p.psi = TY_DEFAULT_PSI;
	p.law = true;
	p.min_distance = i % 6 == 5 ? 77.7 : 0;
	p.count_rule = i % 7 == 3 ? TY_BLACK_WHITE : TY_RADICAL;
	p.area_statistic = (ty_area_statistic) (i % 3);
	p.shape = i % 5 == 4 ? TY_SQUARE : TY_RECTANGLE;
	p.alignment = i % 4 == 2 ? 3 : 0;
	return p;
}

/* rows may have been shuffled: a building is known by its values */
static uint64_t
hash_placeholder(uint64_t hash, const ty_result *result, const ty_placeholder *drawn)
{
	ty_point ring[5];

	hash = HASH(hash, drawn->x);
	hash = HASH(hash, drawn->y);
	hash = HASH(hash, drawn->area);
	hash = HASH(hash, drawn->width);
	hash = HASH(hash, drawn->length);
	hash = HASH(hash, buildings[drawn->representative].id);
	for (uint32_t k = 0; k < drawn->count; k++)
		hash = HASH(hash, buildings[result->members[drawn->first + k]].id);
	ty_rectangle((ty_point){drawn->x, drawn->y}, drawn->area, drawn->ratio, drawn->ux, drawn->uy, ring);
	return HASH(hash, ring);
}

static uint64_t
hash_group(uint64_t hash, size_t n, const ty_parameters *p)
{
	ty_result result;

	stop_on(ty_typify(&ty_plain_environment, &(ty_input){.buildings = buildings, .n = n}, p, &result), "ty_typify");
	hash = HASH(hash, result.count);
	for (size_t i = 0; i < result.count; i++)
		hash = hash_placeholder(hash, &result, &result.placeholders[i]);
	ty_result_free(&ty_plain_environment, &result);
	return hash;
}

static uint64_t
hash_small_sets(uint64_t hash)
{
	const ty_stop to_one = {1, 0};

	for (size_t set = 0; set < 400; set++)
	{
		random_state random = random_seed(set);
		ty_position position[60];
		uint64_t keys[60];
		ty_sequence sequence;

		small_set((small_kind) (set % SMALL_KINDS), &random, position, 60);
		sort_along_curve(position, keys, 60);
		stop_on(ty_collapse(&ty_plain_environment, position, 60, (double) (set % 4) / 3, NULL, to_one, true, NULL, NULL,
							&sequence),
				"ty_collapse");
		hash = hash_bytes(hash, sequence.kept, sequence.count * sizeof *sequence.kept);
		hash = hash_bytes(hash, sequence.gone, sequence.count * sizeof *sequence.gone);
		hash = hash_bytes(hash, sequence.cost, sequence.count * sizeof *sequence.cost);
		ty_sequence_free(&ty_plain_environment, &sequence);
	}
	return hash;
}

static uint64_t
hash_measures(uint64_t hash)
{
	random_state random = random_seed(3);
	ty_point ring[40];

	for (size_t set = 0; set < 5000; set++)
	{
		size_t n = (size_t) random_between(&random, 1, 40);
		ty_measure m;
		ty_building b;

		for (size_t i = 0; i < n; i++)
		{
			ring[i].x = 500000 + 100 * random_unit(&random);
			ring[i].y = 5500000 + 100 * random_unit(&random);
		}
		ty_measure_begin(&m, &ty_plain_environment);
		ty_measure_ring(&m, ring, sizeof *ring, (uint32_t) n, true);
		stop_on(ty_measure_end(&m, &b), "ty_measure_end");
		hash = HASH(hash, b);
	}
	return hash;
}

/* the same group in many row orders; every member has an id of its own */
static void
check_row_orders(large_kind kind, random_state *random)
{
	ty_parameters p = draw_parameters((size_t) kind + 1);
	uint64_t first = 0;

	for (size_t i = 0; i < ROW_ORDERS; i++)
	{
		uint64_t hash = hash_group(HASH_START, MOST / 3, &p);

		if (i == 0)
			first = hash;
		if (hash != first)
		{
			printf("%s: row order %zu gives another answer\n", large_kind_name[kind], i);
			exit(1);
		}
		shuffle_buildings(random, buildings, MOST / 3);
	}
}

int
main(void)
{
	uint64_t hash = hash_measures(hash_small_sets(HASH_START));

	for (large_kind kind = 0; kind < LARGE_KINDS; kind++)
	{
		random_state random = random_seed(1 + kind);

		for (size_t i = 0; i < 8; i++)
		{
			ty_parameters p = draw_parameters(i);

			large_set(kind, &random, buildings, MOST);
			hash = hash_group(hash, MOST, &p);
		}
		large_set(kind, &random, buildings, MOST / 3);
		check_row_orders(kind, &random);
	}
	printf("%016" PRIx64 "\n", hash);
	return 0;
}
