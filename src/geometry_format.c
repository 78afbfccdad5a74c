/*
 * geometry_format.c - see geometry_format.h.
 *
 * A stored geometry: 3 bytes of SRID, 1 byte of flags, in version 2 optionally 8 bytes of further flags,
 * optionally a box of floats, then the geometry. A geometry is a type, a count and what is counted: points; rings
 * (their sizes, padded to 8 bytes, then their points); or geometries, each again with type and count.
 */
#include "geometry_format.h"

#include <float.h>
#include <math.h>
#include <string.h>

#define FLAG_Z 0x01
#define FLAG_M 0x02
#define FLAG_BOX 0x04
#define FLAG_GEODETIC 0x08
#define FLAG_EXTENDED 0x10 /* version 2 only: 8 bytes of further flags */
#define FLAG_VERSION_2 0x40

#define HEADER_SIZE 4
#define BOX_SIZE (4 * sizeof(float))
#define RING_POINTS 5

/* types as the grammar of the body sees them */
typedef enum body_kind
{
	BODY_UNKNOWN = 0,
	BODY_POINTS,
	BODY_RINGS,
	BODY_GEOMETRIES
} body_kind;

typedef struct type_entry
{
	const char *name;
	body_kind kind;
} type_entry;

static const type_entry types[] = {
	{"unknown", BODY_UNKNOWN},		   {"Point", BODY_POINTS},
	{"LineString", BODY_POINTS},	   {"Polygon", BODY_RINGS},
	{"MultiPoint", BODY_GEOMETRIES},   {"MultiLineString", BODY_GEOMETRIES},
	{"MultiPolygon", BODY_GEOMETRIES}, {"GeometryCollection", BODY_GEOMETRIES},
	{"CircularString", BODY_POINTS},   {"CompoundCurve", BODY_GEOMETRIES},
	{"CurvePolygon", BODY_GEOMETRIES}, {"MultiCurve", BODY_GEOMETRIES},
	{"MultiSurface", BODY_GEOMETRIES}, {"PolyhedralSurface", BODY_GEOMETRIES},
	{"Triangle", BODY_POINTS},		   {"Tin", BODY_GEOMETRIES},
};

#define TYPE_COUNT (sizeof(types) / sizeof(types[0]))

/* what is still unread; stride is the size of one point */
typedef struct cursor
{
	const unsigned char *at, *end;
	size_t stride;
} cursor;

static size_t
left(const cursor *c)
{
	return (size_t) (c->end - c->at);
}

static bool
take_number(cursor *c, uint32_t *number)
{
	if (left(c) < sizeof(*number))
		return false;
	memcpy(number, c->at, sizeof(*number));
	c->at += sizeof(*number);
	return true;
}

static bool
take_bytes(cursor *c, size_t size, const unsigned char **bytes)
{
	if (left(c) < size)
		return false;
	*bytes = c->at;
	c->at += size;
	return true;
}

static bool
take_points(cursor *c, uint32_t n, const unsigned char **points)
{
	return n <= left(c) / c->stride && take_bytes(c, n * c->stride, points);
}

static bool
take_type_and_count(cursor *c, uint32_t *type, uint32_t *count)
{
	return take_number(c, type) && take_number(c, count) && *type > 0 && *type < TYPE_COUNT;
}

/* The table of ring sizes, padded to an even number of entries. */
static bool
take_ring_sizes(cursor *c, uint32_t rings, const unsigned char **sizes)
{
	size_t entries = (size_t) rings + (rings & 1);

	return entries <= left(c) / sizeof(uint32_t) && take_bytes(c, entries * sizeof(uint32_t), sizes);
}

static uint32_t
ring_size(const unsigned char *sizes, uint32_t ring)
{
	uint32_t n;

	memcpy(&n, sizes + ring * sizeof(n), sizeof(n));
	return n;
}

/* 21 bits, signed; 0 stands for unknown */
static int32_t
unpack_srid(const unsigned char *payload)
{
	int32_t srid = (payload[0] << 16 | payload[1] << 8 | payload[2]) & 0x1fffff;

	return srid >= 0x100000 ? srid - 0x200000 : srid;
}

static void
pack_header(unsigned char *payload, int32_t srid, unsigned char flags)
{
	payload[0] = (unsigned char) ((uint32_t) srid >> 16 & 0x1f);
	payload[1] = (unsigned char) ((uint32_t) srid >> 8);
	payload[2] = (unsigned char) srid;
	payload[3] = flags;
}

/* Places the cursor on the body's type. */
static bool
open_payload(const unsigned char *payload, size_t size, cursor *c, int32_t *srid)
{
	const unsigned char *skipped;
	unsigned flags, dimensions;
	size_t skip = 0;

	if (size < HEADER_SIZE)
		return false;
	*srid = unpack_srid(payload);
	flags = payload[3];
	dimensions = 2u + (flags & FLAG_Z ? 1 : 0) + (flags & FLAG_M ? 1 : 0);
	c->at = payload + HEADER_SIZE;
	c->end = payload + size;
	c->stride = dimensions * sizeof(double);
	if ((flags & FLAG_VERSION_2) && (flags & FLAG_EXTENDED))
		skip += 8;
	if (flags & FLAG_BOX)
		skip += 2 * (flags & FLAG_GEODETIC ? 3 : dimensions) * sizeof(float);
	return take_bytes(c, skip, &skipped);
}

static bool
walk_rings(cursor *c, uint32_t rings, ty_points_visitor visit, void *context, bool *go_on)
{
	const unsigned char *sizes, *points;

	if (!take_ring_sizes(c, rings, &sizes))
		return false;
	for (uint32_t ring = 0; ring < rings && *go_on; ring++)
	{
		/* without a shell the polygon counts as empty, whatever holes it has */
		bool counts = ring_size(sizes, 0) > 0;

		if (!take_points(c, ring_size(sizes, ring), &points))
			return false;
		*go_on = !counts || visit(context, points, c->stride, ring_size(sizes, ring));
	}
	return true;
}

/* Visits all points of a geometry of any type. False: corrupt. Pending geometries are counted, not stacked. */
static bool
walk_points(const unsigned char *payload, size_t size, ty_points_visitor visit, void *context)
{
	const unsigned char *points;
	uint32_t type, count;
	uint64_t pending = 1;
	int32_t srid;
	bool go_on = true;
	cursor c;

	if (!open_payload(payload, size, &c, &srid))
		return false;
	for (; pending > 0 && go_on; pending--)
	{
		if (!take_type_and_count(&c, &type, &count))
			return false;
		if (types[type].kind == BODY_GEOMETRIES)
			pending += count;
		else if (types[type].kind == BODY_RINGS)
		{
			if (!walk_rings(&c, count, visit, context, &go_on))
				return false;
		}
		else if (!take_points(&c, count, &points))
			return false;
		else
			go_on = visit(context, points, c.stride, count);
	}
	return true;
}

/* The lines of a geometry that is no collection; *found where it has a point. */
static bool
visit_part(cursor *c, uint32_t type, uint32_t count, ty_points_visitor visit, void *context, bool *found, bool *go_on)
{
	const unsigned char *points;

	if (type == TY_GEOMETRY_POLYGON)
	{
		cursor rings = *c;

		*found = *found || (count > 0 && take_ring_sizes(&rings, count, &points) && ring_size(points, 0) > 0);
		return walk_rings(c, count, visit, context, go_on);
	}
	if (!take_points(c, count, &points))
		return false;
	*found = *found || count > 0;
	if (type == TY_GEOMETRY_LINE && count > 0)
		*go_on = visit(context, points, c->stride, count);
	return true;
}

ty_geometry_status
ty_geometry_visit_lines(const unsigned char *payload, size_t size, ty_points_visitor visit, void *context,
						int32_t *srid, uint32_t *type)
{
	uint32_t part, count;
	uint64_t pending = 1;
	bool found_points = false, found_lines = false, go_on = true, first = true;
	cursor c;

	if (!open_payload(payload, size, &c, srid))
		return TY_GEOMETRY_CORRUPT;
	for (; pending > 0 && go_on; pending--, first = false)
	{
		if (!take_type_and_count(&c, &part, &count))
			return TY_GEOMETRY_CORRUPT;
		if (first)
			*type = part;
		if (part > TY_GEOMETRY_COLLECTION && count > 0)
		{
			*type = part;
			return TY_GEOMETRY_UNSUPPORTED;
		}
		if (types[part].kind == BODY_GEOMETRIES)
			pending += count;
		else if (!visit_part(&c, part, count, visit, context, part == TY_GEOMETRY_POINT ? &found_points : &found_lines,
							 &go_on))
			return TY_GEOMETRY_CORRUPT;
	}
	if (found_lines)
		return TY_GEOMETRY_OK;
	return found_points ? TY_GEOMETRY_UNSUPPORTED : TY_GEOMETRY_EMPTY;
}

static bool
note_points(void *context, const unsigned char *points, size_t stride, uint32_t n)
{
	bool *found = context;

	(void) points;
	(void) stride;
	*found = n > 0;
	return !*found;
}

ty_geometry_status
ty_geometry_has_points(const unsigned char *payload, size_t size)
{
	bool found = false;

	if (!walk_points(payload, size, note_points, &found))
		return TY_GEOMETRY_CORRUPT;
	return found ? TY_GEOMETRY_OK : TY_GEOMETRY_EMPTY;
}

typedef struct not_finite
{
	bool found;
	double value;
} not_finite;

static bool
note_not_finite(void *context, const unsigned char *points, size_t stride, uint32_t n)
{
	not_finite *search = context;

	for (uint32_t i = 0; i < n && !search->found; i++)
		for (size_t axis = 0; axis < 2 && !search->found; axis++)
		{
			memcpy(&search->value, points + i * stride + axis * sizeof(double), sizeof(double));
			search->found = !isfinite(search->value);
		}
	return !search->found;
}

bool
ty_geometry_find_not_finite(const unsigned char *payload, size_t size, double *value)
{
	not_finite search = {false, 0};

	if (!walk_points(payload, size, note_not_finite, &search) || !search.found)
		return false;
	*value = search.value;
	return true;
}

static bool
measure_polygon(cursor *c, uint32_t rings, ty_measure *m)
{
	const unsigned char *sizes, *points;

	if (!take_ring_sizes(c, rings, &sizes))
		return false;
	for (uint32_t ring = 0; ring < rings; ring++)
	{
		if (!take_points(c, ring_size(sizes, ring), &points))
			return false;
		if (ring_size(sizes, 0) > 0 && ring_size(sizes, ring) > 0)
			ty_measure_ring(m, points, c->stride, ring_size(sizes, ring), ring == 0);
	}
	return true;
}

/* A point, line or polygon whose type and count have been read. */
static bool
measure_part(cursor *c, uint32_t type, uint32_t count, ty_measure *m)
{
	const unsigned char *points;

	if (type == TY_GEOMETRY_POLYGON)
		return measure_polygon(c, count, m);
	if (!take_points(c, count, &points))
		return false;
	if (type == TY_GEOMETRY_LINE && count > 0)
		ty_measure_line(m, points, c->stride, count);
	else if (type == TY_GEOMETRY_POINT)
	{
		if (count > 1)
			return false;
		if (count == 1)
			ty_measure_point(m, points);
	}
	return true;
}

/* The parts of a multi geometry are of its single type: 4, 5, 6 hold 1, 2, 3. */
static bool
measure_parts(cursor *c, uint32_t type, uint32_t count, ty_measure *m)
{
	uint32_t part_type, part_count;

	if (type <= TY_GEOMETRY_POLYGON)
		return measure_part(c, type, count, m);
	for (uint32_t part = 0; part < count && m->status == TY_OK; part++)
		if (!take_type_and_count(c, &part_type, &part_count) || part_type != type - 3 ||
			!measure_part(c, part_type, part_count, m))
			return false;
	return true;
}

static ty_geometry_status
status_of(ty_status status)
{
	switch (status)
	{
		case TY_OK:
			return TY_GEOMETRY_OK;
		case TY_NOT_FINITE:
			return TY_GEOMETRY_NOT_FINITE;
		case TY_INTERRUPTED:
			return TY_GEOMETRY_INTERRUPTED;
		default:
			return TY_GEOMETRY_NO_MEMORY;
	}
}

ty_geometry_status
ty_geometry_read(const ty_environment *env, const unsigned char *payload, size_t size, ty_building *building,
				 int32_t *srid, uint32_t *type)
{
	cursor c, parts;
	ty_measure m;
	uint32_t count;
	bool well_formed;
	ty_status status;

	if (!open_payload(payload, size, &c, srid) || !take_type_and_count(&c, type, &count))
		return TY_GEOMETRY_CORRUPT;
	if (*type >= TY_GEOMETRY_COLLECTION)
	{
		ty_geometry_status points = ty_geometry_has_points(payload, size);

		return points == TY_GEOMETRY_OK ? TY_GEOMETRY_UNSUPPORTED : points;
	}
	parts = c;
	ty_measure_begin(&m, env);
	ty_measure_skip_lengths(&m);
	well_formed = measure_parts(&c, *type, count, &m);
	if (well_formed && m.status == TY_OK && ty_measure_lacks_lengths(&m))
	{
		ty_measure_abandon(&m);
		ty_measure_begin(&m, env);
		well_formed = measure_parts(&parts, *type, count, &m);
	}
	if (m.count == 0 && m.status == TY_OK)
		return well_formed ? TY_GEOMETRY_EMPTY : TY_GEOMETRY_CORRUPT;
	status = ty_measure_end(&m, building);
	if (!well_formed)
		return TY_GEOMETRY_CORRUPT;
	building->id = 0;
	return status_of(status);
}

bool
ty_geometry_line(const unsigned char *payload, size_t size, const unsigned char **points, size_t *stride, uint32_t *n)
{
	cursor c;
	uint32_t type;
	int32_t srid;

	if (!open_payload(payload, size, &c, &srid) || !take_type_and_count(&c, &type, n) || type != TY_GEOMETRY_LINE)
		return false;
	*stride = c.stride;
	return *n > 0 && take_points(&c, *n, points);
}

/* ---- outlines ---- */

/* The points of all rings of a polygon whose number of rings has been read; the cursor stays. */
static bool
count_polygon(cursor c, uint32_t rings, size_t *count)
{
	const unsigned char *sizes, *points;

	*count = 0;
	if (!take_ring_sizes(&c, rings, &sizes))
		return false;
	for (uint32_t ring = 0; ring < rings; ring++)
	{
		if (!take_points(&c, ring_size(sizes, ring), &points))
			return false;
		*count += ring_size(sizes, ring);
	}
	return *count <= UINT32_MAX;
}

/* Copies a polygon into an outline that has room for it, and moves the cursor behind it. */
static bool
copy_polygon(cursor *c, uint32_t rings, ty_outline *outline)
{
	const unsigned char *sizes, *points;
	ty_point *to;

	outline->rings = rings;
	to = ty_outline_points(outline);
	if (!take_ring_sizes(c, rings, &sizes))
		return false;
	for (uint32_t ring = 0; ring < rings; ring++)
	{
		uint32_t n = ring_size(sizes, ring);

		ty_outline_ring_sizes(outline)[ring] = n;
		if (!take_points(c, n, &points))
			return false;
		for (uint32_t i = 0; i < n; i++)
			memcpy(to++, points + i * c->stride, sizeof(ty_point));
	}
	outline->points = (uint32_t) (to - ty_outline_points(outline));
	return true;
}

/* The outline of the polygon at the cursor, which is moved behind it; NULL where it cannot be drawn. */
static ty_geometry_status
take_outline(const ty_environment *env, cursor *c, uint32_t rings, ty_outline **outline)
{
	bool drawable = false;
	size_t points, size;
	ty_status status;

	*outline = NULL;
	if (!count_polygon(*c, rings, &points))
		return TY_GEOMETRY_CORRUPT;
	size = ty_outline_size(rings, points);
	*outline = size == 0 ? NULL : ty_allocate_array(env, size, 1);
	if (*outline == NULL)
		return TY_GEOMETRY_NO_MEMORY;
	status = copy_polygon(c, rings, *outline) && rings > 0 && *ty_outline_ring_sizes(*outline) > 0
				 ? ty_outline_measure(env, *outline, &drawable)
				 : TY_OK;
	if (!drawable)
	{
		ty_release(env, *outline);
		*outline = NULL;
	}
	return status_of(status);
}

ty_geometry_status
ty_geometry_outline(const ty_environment *env, const unsigned char *payload, size_t size, ty_outline **outline)
{
	ty_geometry_status status = TY_GEOMETRY_OK;
	uint32_t type, count, part_type, rings;
	ty_outline *found;
	int32_t srid;
	cursor c;

	*outline = NULL;
	if (!open_payload(payload, size, &c, &srid) || !take_type_and_count(&c, &type, &count))
		return TY_GEOMETRY_CORRUPT;
	if (type == TY_GEOMETRY_POLYGON)
		return take_outline(env, &c, count, outline);
	if (type != TY_GEOMETRY_MULTIPOLYGON)
		return TY_GEOMETRY_OK;
	for (uint32_t part = 0; part < count && status == TY_GEOMETRY_OK; part++)
	{
		if (!take_type_and_count(&c, &part_type, &rings) || part_type != TY_GEOMETRY_POLYGON)
			return TY_GEOMETRY_CORRUPT;
		status = take_outline(env, &c, rings, &found);
		if (found != NULL && (*outline == NULL || found->area > (*outline)->area))
		{
			ty_release(env, *outline);
			*outline = found;
		}
		else
			ty_release(env, found);
	}
	return status;
}

/* ---- types and writing ---- */

const char *
ty_geometry_type_name(uint32_t type)
{
	return types[type < TYPE_COUNT ? type : 0].name;
}

static void
put_number(unsigned char **at, uint32_t number)
{
	memcpy(*at, &number, sizeof(number));
	*at += sizeof(number);
}

/* the largest float not above d, and the smallest not below it: boxes enclose what they are the box of */
static float
float_below(double d)
{
	float f;

	if (d > FLT_MAX)
		return FLT_MAX;
	if (d <= -FLT_MAX)
		return -FLT_MAX;
	f = (float) d;
	return f <= d ? f : nextafterf(f, -FLT_MAX);
}

static float
float_above(double d)
{
	return -float_below(-d);
}

/* x and y take turns: low x, high x, low y, high y */
static void
put_box(unsigned char *at, ty_point low, ty_point high)
{
	float box[4] = {float_below(low.x), float_above(high.x), float_below(low.y), float_above(high.y)};

	memcpy(at, box, sizeof(box));
}

static void
put_polygon(unsigned char **at, const ty_point *ring, uint32_t n)
{
	put_number(at, TY_GEOMETRY_POLYGON);
	put_number(at, 1);
	put_number(at, n);
	put_number(at, 0); /* padding */
	memcpy(*at, ring, n * sizeof(ty_point));
	*at += n * sizeof(ty_point);
}

static void
widen_box(ty_point *low, ty_point *high, const ty_point *point, size_t n)
{
	for (size_t i = 0; i < n; i++)
	{
		low->x = fmin(low->x, point[i].x);
		low->y = fmin(low->y, point[i].y);
		high->x = fmax(high->x, point[i].x);
		high->y = fmax(high->y, point[i].y);
	}
}

size_t
ty_outline_payload_in_collection(const ty_outline *outline)
{
	size_t entries = (size_t) outline->rings + outline->rings % 2;

	return (2 + entries) * sizeof(uint32_t) + outline->points * sizeof(ty_point);
}

size_t
ty_outline_payload(const ty_outline *outline)
{
	return HEADER_SIZE + BOX_SIZE + ty_outline_payload_in_collection(outline);
}

static void
put_outline(unsigned char **at, const ty_outline *outline)
{
	put_number(at, TY_GEOMETRY_POLYGON);
	put_number(at, outline->rings);
	for (uint32_t ring = 0; ring < outline->rings; ring++)
		put_number(at, ty_outline_ring_sizes(outline)[ring]);
	if (outline->rings % 2 == 1)
		put_number(at, 0); /* padding */
	memcpy(*at, ty_outline_points(outline), outline->points * sizeof(ty_point));
	*at += outline->points * sizeof(ty_point);
}

void
ty_geometry_write_outline(unsigned char *payload, int32_t srid, const ty_outline *outline)
{
	unsigned char *at = payload + HEADER_SIZE + BOX_SIZE;
	const ty_point *point = ty_outline_points(outline);
	ty_point low = point[0], high = point[0];

	widen_box(&low, &high, point, *ty_outline_ring_sizes(outline));
	pack_header(payload, srid, FLAG_VERSION_2 | FLAG_BOX);
	put_box(payload + HEADER_SIZE, low, high);
	put_outline(&at, outline);
}

void
ty_geometry_write_ring(unsigned char *payload, int32_t srid, const ty_point *ring, uint32_t n)
{
	unsigned char *at = payload + HEADER_SIZE + BOX_SIZE;
	ty_point low = ring[0], high = ring[0];

	widen_box(&low, &high, ring, n);
	pack_header(payload, srid, FLAG_VERSION_2 | FLAG_BOX);
	put_box(payload + HEADER_SIZE, low, high);
	put_polygon(&at, ring, n);
}

void
ty_geometry_write_polygon(unsigned char *payload, int32_t srid, const ty_point ring[5])
{
	ty_geometry_write_ring(payload, srid, ring, RING_POINTS);
}

void
ty_geometry_begin_line(unsigned char *payload, int32_t srid, uint32_t n)
{
	unsigned char *at = payload + HEADER_SIZE;

	pack_header(payload, srid, FLAG_VERSION_2);
	put_number(&at, TY_GEOMETRY_LINE);
	put_number(&at, n);
}

void
ty_collection_begin(ty_collection_writer *writer, unsigned char *payload, int32_t srid, uint32_t polygons)
{
	bool empty = polygons == 0;

	pack_header(payload, srid, empty ? FLAG_VERSION_2 : FLAG_VERSION_2 | FLAG_BOX);
	writer->payload = payload;
	writer->at = payload + HEADER_SIZE + (empty ? 0 : BOX_SIZE);
	writer->polygons = polygons;
	writer->low = (ty_point){INFINITY, INFINITY};
	writer->high = (ty_point){-INFINITY, -INFINITY};
	put_number(&writer->at, TY_GEOMETRY_COLLECTION);
	put_number(&writer->at, polygons);
}

void
ty_collection_add(ty_collection_writer *writer, const ty_point ring[5])
{
	widen_box(&writer->low, &writer->high, ring, RING_POINTS);
	put_polygon(&writer->at, ring, RING_POINTS);
}

void
ty_collection_add_outline(ty_collection_writer *writer, const ty_outline *outline)
{
	widen_box(&writer->low, &writer->high, ty_outline_points(outline), *ty_outline_ring_sizes(outline));
	put_outline(&writer->at, outline);
}

void
ty_collection_end(ty_collection_writer *writer)
{
	if (writer->polygons > 0)
		put_box(writer->payload + HEADER_SIZE, writer->low, writer->high);
}
