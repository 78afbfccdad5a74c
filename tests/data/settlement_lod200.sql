-- settlement_lod200.sql: the coarse building layer of the town of settlement.sql, for a map at 1:200 000.
--
-- Needs the tables of settlement.sql and creates beside them
--   settlement_lod200(id, class, geom)   about 200 built-up areas, halls, farms and monuments
--
-- Drawn by a cartographer's rules, not by typify: small town blocks are filled, neighbouring halls and slabs are
-- drawn as one, along a road stands a rectangle for every 100 m with houses on a side, a lone farm is a square,
-- churches and schools are enlarged, garden huts are left out. What is less important gives way: nothing stands
-- nearer than 10 m to something more important, nor on a road.
--
-- As in settlement.sql everything is + - * / and sqrt on doubles, directions are rounded to six decimals and points
-- to millimetres, and PostGIS moves no coordinate: the same bytes come out on every machine.

BEGIN;
SET LOCAL client_min_messages = warning;

-- a rectangle around (x, y): direction (ux, uy) of its frontage, sides in metres. A hair off, against ties.
CREATE FUNCTION pg_temp.bar(x float8, y float8, ux float8, uy float8, frontage float8, depth float8) RETURNS geometry
LANGUAGE sql IMMUTABLE AS
$$
	SELECT ST_SetSRID(ST_MakePolygon(ST_MakeLine(array_agg(ST_MakePoint(
		round((x + (s * ux * frontage - t * uy * depth) / 2)::numeric + 0.0000137, 3)::float8,
		round((y + (s * uy * frontage + t * ux * depth) / 2)::numeric + 0.0000137, 3)::float8) ORDER BY k))), 25832)
	FROM (VALUES (1, -1, -1), (2, 1, -1), (3, 1, 1), (4, -1, 1), (5, -1, -1)) AS corner(k, s, t)
$$;
CREATE FUNCTION pg_temp.within(low float8, number float8, high float8) RETURNS float8 LANGUAGE sql IMMUTABLE AS
$$ SELECT greatest(low, least(number, high)) $$;

CREATE TEMP TABLE corner AS
SELECT id, class, block, row_id, ST_X(p.geom) AS x, ST_Y(p.geom) AS y, p.path[2] AS n
FROM settlement_buildings, ST_DumpPoints(geom) AS p;
CREATE TEMP TABLE small_block AS SELECT id AS block, geom FROM settlement_blocks WHERE ST_Area(geom) < 20000;

-- 1. What is drawn together, and in which direction ------------------------------------------------------
-- importance: 1 first; direction (ux, uy), of any length; sides in metres: inset on both sides, least and most

CREATE TEMP TABLE subject (importance integer, class text, key bigint, buildings bigint[], ux float8, uy float8,
	inset float8, least float8, most float8);

-- a building's direction: its longest edge
CREATE TEMP TABLE edge AS
SELECT DISTINCT ON (id) id, ux, uy
FROM (SELECT id, n, lead(x) OVER w - x AS ux, lead(y) OVER w - y AS uy
	  FROM corner WINDOW w AS (PARTITION BY id ORDER BY n)) AS side
WHERE ux IS NOT NULL
ORDER BY id, round((ux * ux + uy * uy)::numeric, 1) DESC, n;

-- monuments; halls two by two; slabs of a row two by two
INSERT INTO subject
SELECT CASE class WHEN 'hall' THEN 2 WHEN 'slab' THEN 3 ELSE 1 END, class, min(id), array_agg(id ORDER BY id),
	(array_agg(ux ORDER BY id))[1], (array_agg(uy ORDER BY id))[1],
	CASE class WHEN 'hall' THEN 5 ELSE 0 END, CASE class WHEN 'hall' THEN 55 WHEN 'slab' THEN 40 ELSE 38 END, 140
FROM (SELECT id, class, CASE WHEN class IN ('hall', 'slab')
			THEN block * 100 + (row_number() OVER (PARTITION BY block, class, row_id ORDER BY id) - 1) / 2
				+ coalesce(row_id % 100, 0) * 10
			ELSE -id END AS pair
	  FROM settlement_buildings
	  WHERE class IN ('church', 'school', 'hall', 'slab') OR class = 'public' AND ST_Area(geom) > 100) AS numbered
JOIN edge USING (id)
GROUP BY class, pair;

-- filled blocks: those of less than 2 ha without a monument, in the core some two and two. The ring of a block turns
-- sharply at four corners; its axis runs between the middles of the two shorter of its four sides, that of a pair
-- from one to the other. A long block is cut in two.
CREATE TEMP TABLE pair AS
SELECT * FROM (VALUES (26, 24), (25, 29), (32, 35), (38, 36), (37, 40), (43, 44), (45, 46)) AS pair(block, other);

INSERT INTO subject
WITH point AS (
	SELECT block, p.path[2] AS n, ST_X(p.geom) AS x, ST_Y(p.geom) AS y
	FROM small_block, ST_DumpPoints(small_block.geom) AS p
	WHERE p.path[2] < ST_NPoints(small_block.geom)
), turn AS (
	SELECT block, n, x, y,
		x - coalesce(lag(x) OVER w, last_value(x) OVER w) AS ax,
		y - coalesce(lag(y) OVER w, last_value(y) OVER w) AS ay,
		coalesce(lead(x) OVER w, first_value(x) OVER w) - x AS bx,
		coalesce(lead(y) OVER w, first_value(y) OVER w) - y AS by
	FROM point
	WINDOW w AS (PARTITION BY block ORDER BY n ROWS BETWEEN UNBOUNDED PRECEDING AND UNBOUNDED FOLLOWING)
), sharp AS (
	SELECT block, x[1] + x[2] + x[3] + x[4] AS sx, y[1] + y[2] + y[3] + y[4] AS sy,
		x[2] + x[3] - x[1] - x[4] AS px, y[2] + y[3] - y[1] - y[4] AS py,
		x[3] + x[4] - x[1] - x[2] AS qx, y[3] + y[4] - y[1] - y[2] AS qy
	FROM (SELECT block, array_agg(x ORDER BY n) AS x, array_agg(y ORDER BY n) AS y
		  FROM turn
		  WHERE ax * bx + ay * by < 0.9 * sqrt((ax * ax + ay * ay) * (bx * bx + by * by))
		  GROUP BY block HAVING count(*) = 4) AS four
), axis AS (
	SELECT a.block, CASE WHEN other IS NOT NULL THEN b.sx - a.sx WHEN long THEN a.px ELSE a.qx END AS ux,
		CASE WHEN other IS NOT NULL THEN b.sy - a.sy WHEN long THEN a.py ELSE a.qy END AS uy
	FROM sharp AS a LEFT JOIN pair USING (block) LEFT JOIN sharp AS b ON b.block = other,
		LATERAL (SELECT a.px * a.px + a.py * a.py >= a.qx * a.qx + a.qy * a.qy AS long) AS longer
), along AS (
	SELECT axis.block, id, ux, uy, min(x * ux + y * uy) AS s0, max(x * ux + y * uy) AS s1
	FROM corner LEFT JOIN pair ON other = corner.block JOIN axis ON axis.block = coalesce(pair.block, corner.block)
	WHERE class IN ('town', 'house', 'terrace')
	GROUP BY axis.block, id, ux, uy
), reach AS (
	SELECT *, min(s0) OVER (PARTITION BY block) AS a, max(s1) OVER (PARTITION BY block) AS b FROM along
)
SELECT 4, 'block', block * 10 + half, array_agg(id ORDER BY id), ux, uy, 11, 34, 150
FROM reach, LATERAL (SELECT CASE
	WHEN b - a < 180 * sqrt(ux * ux + uy * uy) THEN 0 WHEN s0 + s1 < a + b THEN 1 ELSE 2 END AS half) AS halves
WHERE block NOT IN (SELECT block FROM settlement_buildings WHERE class IN ('church', 'public'))
GROUP BY block, half, ux, uy;

-- 2. Rectangles around them ------------------------------------------------------------------------------

CREATE TEMP TABLE sketch (importance integer, class text, key bigint, shape geometry);
INSERT INTO sketch
SELECT importance, class, key, pg_temp.bar(
	(s0 + s1) / 2 * vx - (t0 + t1) / 2 * vy, (s0 + s1) / 2 * vy + (t0 + t1) / 2 * vx, vx, vy,
	pg_temp.within(least, s1 - s0 - 2 * inset, most), pg_temp.within(least, t1 - t0 - 2 * inset, most))
FROM (
	SELECT subject.importance, subject.class, key, inset, least, most, vx, vy,
		min(x * vx + y * vy) AS s0, max(x * vx + y * vy) AS s1, min(y * vx - x * vy) AS t0, max(y * vx - x * vy) AS t1
	FROM subject JOIN corner ON corner.id = ANY (buildings),
		LATERAL (SELECT round((ux / sqrt(ux * ux + uy * uy))::numeric, 6)::float8 AS vx,
			round((uy / sqrt(ux * ux + uy * uy))::numeric, 6)::float8 AS vy) AS direction
	GROUP BY subject.importance, subject.class, key, inset, least, most, vx, vy
) AS extent;

CREATE TEMP TABLE piece AS
SELECT id, class, k, x, y, least(x, x + dx) - 130 AS x0, greatest(x, x + dx) + 130 AS x1,
	least(y, y + dy) - 130 AS y0, greatest(y, y + dy) + 130 AS y1, round((dx / length)::numeric, 6)::float8 AS ux,
	round((dy / length)::numeric, 6)::float8 AS uy, length,
	(sum(length) OVER (PARTITION BY id ORDER BY k) - length)::float8 AS start
FROM settlement_roads, generate_series(1, ST_NPoints(geom) - 1) AS k,
	LATERAL (SELECT ST_X(a) AS x, ST_Y(a) AS y, ST_X(b) - ST_X(a) AS dx, ST_Y(b) - ST_Y(a) AS dy
		FROM (SELECT ST_PointN(geom, k) AS a, ST_PointN(geom, k + 1) AS b) AS ends) AS vector,
	-- numeric, so that the sums are exact in any order
	LATERAL (SELECT round(sqrt(dx * dx + dy * dy)::numeric, 3) AS length) AS norm
WHERE class <> 'track';

-- each building's place at the nearest road, if one is nearer than 130 m: s metres along it, t metres to the left
CREATE TEMP TABLE frontage AS
SELECT DISTINCT ON (middle.id) middle.*, piece.id AS road, piece.class AS road_class, start + s AS s, t, distance
FROM (SELECT id, class, block, (min(x) + max(x)) / 2 AS x, (min(y) + max(y)) / 2 AS y
	  FROM corner GROUP BY id, class, block) AS middle,
	piece,
	LATERAL (SELECT pg_temp.within(0, (middle.x - piece.x) * ux + (middle.y - piece.y) * uy, length) AS s,
		(middle.y - piece.y) * ux - (middle.x - piece.x) * uy AS t) AS foot,
	LATERAL (SELECT middle.x - piece.x - s * ux AS ex, middle.y - piece.y - s * uy AS ey) AS away,
	LATERAL (SELECT round(sqrt(ex * ex + ey * ey)::numeric, 3) AS distance) AS far
WHERE middle.x BETWEEN x0 AND x1 AND middle.y BETWEEN y0 AND y1
ORDER BY middle.id, distance, piece.id, k;

-- lone farms: more than 120 m from the roads
INSERT INTO sketch
SELECT 5, 'farm', id, pg_temp.bar((min(x) + max(x)) / 2, (min(y) + max(y)) / 2, round((ux / norm)::numeric, 6)::float8,
	round((uy / norm)::numeric, 6)::float8, 60, 60)
FROM corner JOIN edge USING (id), LATERAL (SELECT sqrt(ux * ux + uy * uy) AS norm) AS norm
WHERE class = 'farm' AND id NOT IN (SELECT id FROM frontage WHERE distance <= 120)
GROUP BY id, ux, uy, norm;

-- 3. Along the roads: a rectangle for every 100 m with two houses or more on a side -----------------------

INSERT INTO sketch
SELECT CASE road_class WHEN 'main' THEN 6 ELSE 7 END, 'houses', road * 1000 + side * 500 + slot,
	pg_temp.bar(x + ux * (middle - start) - uy * turn * away, y + uy * (middle - start) + ux * turn * away, ux, uy,
		long, deep)
FROM (
	SELECT road, road_class, (t < 0)::integer AS side, floor(s / 100) AS slot, count(*) AS houses,
		(min(s) + max(s)) / 2 AS middle, max(s) - min(s) AS reach
	FROM frontage
	WHERE distance <= 60 AND class IN ('house', 'farm', 'barn', 'terrace')
		AND block NOT IN (SELECT block FROM small_block)
	GROUP BY road, road_class, side, slot HAVING count(*) > 1
) AS run,
	LATERAL (SELECT x, y, ux, uy, start FROM piece WHERE piece.id = road AND start <= middle
		ORDER BY start DESC LIMIT 1) AS under,
	LATERAL (SELECT pg_temp.within(45, reach + 10, 75) AS long, pg_temp.within(40, 32.0 + 4 * houses, 60) AS deep,
		CASE side WHEN 0 THEN 1 ELSE -1 END AS turn) AS sides,
	LATERAL (SELECT deep / 2 + CASE road_class WHEN 'main' THEN 15 ELSE 12 END AS away) AS offset_;

-- 4. Who stays -------------------------------------------------------------------------------------------

CREATE TABLE settlement_lod200 (id bigint PRIMARY KEY, class text NOT NULL, geom geometry(Polygon, 25832) NOT NULL);
CREATE INDEX ON settlement_lod200 USING gist (geom);

DO $$
DECLARE one record;
BEGIN
	FOR one IN SELECT * FROM sketch ORDER BY importance, class COLLATE "C", key LOOP
		INSERT INTO settlement_lod200
		SELECT (SELECT count(*) + 1 FROM settlement_lod200), one.class, one.shape
		WHERE NOT EXISTS (SELECT FROM settlement_lod200 WHERE ST_DWithin(settlement_lod200.geom, one.shape, 10))
			AND (one.importance < 6
				OR NOT EXISTS (SELECT FROM settlement_roads WHERE class <> 'track' AND ST_DWithin(geom, one.shape, 6)));
	END LOOP;
END $$;
ANALYZE settlement_lod200;

COMMENT ON TABLE settlement_lod200 IS 'sample buildings for 1:200 000: filled blocks, halls, farms, monuments';

DROP TABLE corner, small_block, pair, subject, edge, sketch, piece, frontage;
DROP FUNCTION pg_temp.bar, pg_temp.within;

COMMIT;
