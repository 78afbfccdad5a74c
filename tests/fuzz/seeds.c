/* seeds.c - writes the inputs from which a fuzz target starts: seeds TARGET DIRECTORY. */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- stored geometries, after PostGIS's gserialized_v1.txt and gserialized_v2.txt ---- */

#define FLAG_Z 1
#define FLAG_M 2
#define FLAG_BOX 4
#define FLAG_GEODETIC 8
#define FLAG_EXTENDED 16
#define FLAG_VERSION_2 64

typedef struct payload
{
	unsigned char bytes[4096];
	size_t size;
	int dimensions;
} payload;

static void
put(payload *p, const void *bytes, size_t size)
{
	memcpy(p->bytes + p->size, bytes, size);
	p->size += size;
}

static void
put_number(payload *p, uint32_t number)
{
	put(p, &number, sizeof number);
}

/* SRID 25832 in three bytes, flags, then what they promise */
static payload
begin_payload(int flags)
{
	payload p = {{0}, 0, 2 + (flags & FLAG_Z) / FLAG_Z + (flags & FLAG_M) / FLAG_M};
	const unsigned char head[] = {0, 25832 >> 8, 25832 & 255, (unsigned char) flags};
	float box[8] = {-1, 9, -1, 9, -1, 9, -1, 9};

	put(&p, head, sizeof head);
	if (flags & FLAG_VERSION_2 && flags & FLAG_EXTENDED)
		put(&p, "\1\0\0\0\0\0\0\0", 8);
	if (flags & FLAG_BOX)
		put(&p, box, sizeof *box * 2 * (size_t) (flags & FLAG_GEODETIC ? 3 : p.dimensions));
	return p;
}

static void
put_points(payload *p, size_t n)
{
	static const double square[][2] = {{0, 0}, {8, 0}, {8, 4}, {0, 4}, {0, 0}};

	for (size_t i = 0; i < n; i++)
		for (int d = 0; d < p->dimensions; d++)
		{
			double value = d < 2 ? square[i % 5][d] : 1.5;

			put(p, &value, sizeof value);
		}
}

static void
put_simple(payload *p, uint32_t type, uint32_t points)
{
	put_number(p, type);
	put_number(p, points);
	put_points(p, points);
}

/* ring counts are padded to 8 bytes */
static void
put_polygon(payload *p, uint32_t rings)
{
	put_number(p, 3);
	put_number(p, rings);
	for (uint32_t i = 0; i < rings + rings % 2; i++)
		put_number(p, i < rings ? 5 : 0);
	put_points(p, 5 * rings);
}

static void
put_shape(payload *p, int shape)
{
	switch (shape)
	{
		case 0:
			put_simple(p, 1, 1);
			break;
		case 1:
			put_simple(p, 2, 4);
			break;
		case 2:
			put_polygon(p, 1);
			break;
		case 3:
			put_polygon(p, 2);
			break;
		case 4:
			put_simple(p, 4, 0); /* empty */
			break;
		case 5:
			put_simple(p, 8, 3); /* a curve */
			break;
		case 6: /* MULTIPOLYGON */
			put_number(p, 6);
			put_number(p, 2);
			put_polygon(p, 1);
			put_polygon(p, 3);
			break;
		default: /* a collection in a collection */
			put_number(p, 7);
			put_number(p, 2);
			put_number(p, 7);
			put_number(p, 0);
			put_simple(p, 1, 1);
			break;
	}
}

static void
write_seed(const char *directory, int number, const void *bytes, size_t size)
{
	char path[1000];
	FILE *file;

	snprintf(path, sizeof path, "%s/seed-%03d", directory, number);
	file = fopen(path, "wb");
	if (file == NULL || fwrite(bytes, 1, size, file) != size || fclose(file) != 0)
	{
		perror(path);
		exit(1);
	}
}

static void
write_geometries(const char *directory)
{
	static const int flags[] = {0,
								FLAG_BOX,
								FLAG_Z,
								FLAG_Z | FLAG_M | FLAG_BOX,
								FLAG_GEODETIC | FLAG_BOX,
								FLAG_VERSION_2,
								FLAG_VERSION_2 | FLAG_BOX,
								FLAG_VERSION_2 | FLAG_EXTENDED | FLAG_M};
	int number = 0;

	for (size_t i = 0; i < sizeof flags / sizeof *flags; i++)
		for (int shape = 0; shape < 8; shape++)
		{
			payload p = begin_payload(flags[i]);

			put_shape(&p, shape);
			write_seed(directory, number++, p.bytes, p.size);
		}
}

/* ---- sets of points, as fuzz_mesh.c reads them ---- */

static void
write_point_sets(const char *directory)
{
	for (int number = 0; number < 48; number++)
	{
		unsigned char bytes[5 + 2 * 256] = {(unsigned char) number, 0, 0, (unsigned char) (number % 23), 0};
		size_t n = number % 3 == 0 ? 9 : number % 3 == 1 ? 12 : 100;

		for (size_t i = 0; i < n; i++)
		{
			size_t x = number % 4 == 0 ? i % 4 : number % 4 == 1 ? i : number % 4 == 2 ? i * i : 3 * i;
			size_t y = number % 4 == 0 ? i / 4 : number % 4 == 1 ? i * i : number % 4 == 2 ? i * 37 : i;

			bytes[5 + 2 * i] = (unsigned char) x;
			bytes[5 + 2 * i + 1] = (unsigned char) y;
		}
		write_seed(directory, number, bytes, 5 + 2 * n);
	}
}

int
main(int argc, char **argv)
{
	if (argc != 3)
		return 1;
	if (strcmp(argv[1], "fuzz_geometry") == 0)
		write_geometries(argv[2]);
	else
		write_point_sets(argv[2]);
	return 0;
}
