-- settlement.sql: a small town with its villages, made by arithmetic.
--
-- Creates, in the first schema of the search_path,
--   settlement_buildings(id, class, block, row_id, geom)  about 1 600 buildings
--   settlement_roads(id, class, geom)                     main, residential, track
--   settlement_blocks(id, geom)                           the faces between the roads, 4 x 3 km together
--   hamlet                                                view: the 41 buildings of block 1
--
-- Everything is drawn with + - * / and sqrt on doubles, and what looks like chance is integer hashing. Directions
-- are rounded to six decimals and points to millimetres, in decimal by the server, before anything is built on
-- them; PostGIS moves no coordinate. So the same bytes come out on every machine, with every PostGIS and GEOS.
-- row_id numbers the rows of houses that the generator laid out (terraces, semi-detached pairs, rows of slabs);
-- it is NULL elsewhere.
--
-- How it works: roads run through control points that they share at junctions, so their faces need no
-- intersection. Buildings come in plots (a house and its garage, a farm, a whole town block), each laid
-- out in metres along and across its road. A plot gives way to roads and to plots with a smaller number.

BEGIN;
SET LOCAL client_min_messages = warning;

-- 0. Tools ---------------------------------------------------------------------------------------------

-- 0 <= chance < 1 from two whole numbers: multiply and fold the high bits down, twice
CREATE FUNCTION pg_temp.chance(number bigint, salt integer) RETURNS float8 LANGUAGE plpgsql IMMUTABLE AS
$$
DECLARE x bigint := (number * 7477 + salt * 104729 + 17) & 4294967295;
BEGIN
	x := (((x >> 16) # x) * 73244475) & 4294967295;
	x := (((x >> 16) # x) * 73244475) & 4294967295;
	RETURN ((x >> 16) # x) / 4294967296.0::float8;
END $$;
CREATE FUNCTION pg_temp.between(low float8, high float8, number bigint, salt integer) RETURNS float8
LANGUAGE sql IMMUTABLE AS
$$ SELECT low + (high - low) * pg_temp.chance(number, salt) $$;

-- to the millimetre; a hair off, since whole and half metres make sixteenths, which would end in a tie
CREATE FUNCTION pg_temp.millimetre(metres float8) RETURNS float8 LANGUAGE sql IMMUTABLE AS
$$ SELECT round(metres::numeric + 0.0000137, 3)::float8 $$;
CREATE FUNCTION pg_temp.point(x float8, y float8) RETURNS geometry LANGUAGE sql IMMUTABLE AS
$$ SELECT ST_MakePoint(pg_temp.millimetre(x), pg_temp.millimetre(y)) $$;
-- one part of a vector of length 1
CREATE FUNCTION pg_temp.direction(part float8) RETURNS float8 LANGUAGE sql IMMUTABLE AS
$$ SELECT round(part::numeric, 6)::float8 $$;

-- local metres to the map: UTM zone 32
CREATE FUNCTION pg_temp.place(shape geometry) RETURNS geometry LANGUAGE sql IMMUTABLE AS
$$ SELECT ST_SetSRID(ST_Translate(shape, 612000, 5486000), 25832) $$;

-- a polygon from pairs s, t: metres along and to the left of direction (ux, uy), seen from (x, y)
CREATE FUNCTION pg_temp.outline(x float8, y float8, ux float8, uy float8, st float8[]) RETURNS geometry
LANGUAGE sql IMMUTABLE AS
$$
	SELECT ST_MakePolygon(ST_MakeLine(
		array_agg(pg_temp.point(x + ux * st[k] - uy * st[k + 1], y + uy * st[k] + ux * st[k + 1]) ORDER BY k)
		|| pg_temp.point(x + ux * st[1] - uy * st[2], y + uy * st[1] + ux * st[2])))
	FROM generate_series(1, array_length(st, 1), 2) AS k
$$;

-- the corners of a rectangle, as st above
CREATE FUNCTION pg_temp.rectangle(s0 float8, t0 float8, s1 float8, t1 float8) RETURNS float8[] LANGUAGE sql IMMUTABLE AS
$$ SELECT ARRAY[s0, t0, s1, t0, s1, t1, s0, t1] $$;

-- a polygon inside a quadrilateral (x00 y00 x10 y10 x11 y11 x01 y01) from pairs u, v in metres of a side
-- w long and h high: straight lines along u and v stay straight, so what is apart in u, v is apart on the map
CREATE FUNCTION pg_temp.inside(q float8[], w float8, h float8, uv float8[]) RETURNS geometry LANGUAGE sql IMMUTABLE AS
$$
	SELECT ST_MakePolygon(ST_AddPoint(line, ST_StartPoint(line)))
	FROM (SELECT ST_MakeLine(pg_temp.point(
			(1 - u) * (1 - v) * q[1] + u * (1 - v) * q[3] + u * v * q[5] + (1 - u) * v * q[7],
			(1 - u) * (1 - v) * q[2] + u * (1 - v) * q[4] + u * v * q[6] + (1 - u) * v * q[8]) ORDER BY k) AS line
		  FROM (SELECT k, uv[k] / w AS u, uv[k + 1] / h AS v
				FROM generate_series(1, array_length(uv, 1), 2) AS k) AS corner) AS ring
$$;

-- 1. Roads ---------------------------------------------------------------------------------------------
-- what: which plots stand along it. Roads meet at control points only.

CREATE TEMP TABLE sketch (id bigint PRIMARY KEY, class text, what text, smooth boolean, path geometry);

INSERT INTO sketch
SELECT id, class, what, true, ST_GeomFromText('LINESTRING(' || path || ')')
FROM (VALUES
	-- the west-east road through the town, and the north-south road
	(1, 'main', 'fields', '0 1180, 130 1195'),
	(2, 'main', 'village', '130 1195, 450 1240, 700 1262, 900 1330'),
	(3, 'main', 'fields', '900 1330, 1120 1400, 1350 1450'),
	(4, 'main', 'suburb', '1350 1450, 1560 1530, 1735 1568'),
	(5, 'main', 'suburb', '2190 1580, 2480 1650, 2720 1712'),
	(6, 'main', 'fields', '2720 1712, 3000 1760, 3500 1850, 4000 1880'),
	(7, 'main', 'fields', '2240 3000, 2200 2600, 2100 2250'),
	(8, 'main', 'suburb', '2100 2250, 2030 1950, 2010 1708'),
	(9, 'main', 'suburb', '2005 1415, 2005 1280, 1990 1100'),
	(10, 'main', 'fields', '1990 1100, 1900 700, 1760 350, 1700 0'),
	-- roads from the town's edge to the quarters
	(11, 'residential', 'suburb', '1780 1688, 1750 1765, 1690 1830'),
	(12, 'residential', 'fields', '1350 1450, 1330 1660, 1300 1900'),
	(13, 'residential', 'fields', '1740 2160, 1880 2040, 2030 1950'),
	(14, 'residential', 'suburb', '2146 1694, 2190 1780, 2260 1850'),
	(15, 'residential', 'suburb', '2700 1930, 2740 1820, 2720 1712'),
	(16, 'residential', 'suburb', '2230 2150, 2170 2210, 2100 2250'),
	(17, 'residential', 'fields', '1390 1270, 1380 1360, 1350 1450'),
	(18, 'residential', 'fields', '1700 1090, 1840 1080, 1990 1100'),
	(19, 'residential', 'suburb', '1690 1300, 1720 1380, 1775 1446'),
	(20, 'residential', 'suburb', '2140 1452, 2270 1420, 2420 1430'),
	(21, 'residential', 'fields', '1990 1100, 2180 1120, 2380 1180'),
	(22, 'residential', 'fields', '3270 1560, 3390 1690, 3500 1850'),
	-- the western village: a second street behind the main road
	(30, 'residential', 'village', '450 1240, 425 1400, 540 1540, 740 1520, 860 1440, 900 1330'),
	(31, 'residential', 'village', '540 1540, 480 1640, 370 1700'),
	-- the southern village: a road that opens around a green
	(40, 'residential', 'fields', '1900 700, 2150 660, 2420 600, 2650 590'),
	(41, 'residential', 'village', '2650 590, 2760 600, 2870 640'),
	(42, 'residential', 'village', '2870 640, 2970 720, 3100 760, 3230 750, 3330 690'),
	(43, 'residential', 'village', '2870 640, 2990 622, 3110 620, 3230 640, 3330 690'),
	(44, 'residential', 'village', '3330 690, 3450 720, 3580 705'),
	(45, 'residential', 'fields', '3580 705, 3800 670, 4000 640'),
	(46, 'residential', 'village', '3110 620, 3130 500, 3080 390'),
	-- the hamlet: a lane without end inside a ring of tracks
	(50, 'residential', 'fields', '900 1330, 900 1620, 830 1900, 740 2120'),
	(51, 'residential', 'hamlet', '740 2120, 700 2240, 610 2340, 592 2375'),
	(52, 'residential', 'hamlet', '610 2340, 700 2390, 770 2400'),
	(53, 'track', NULL,
		'740 2120, 590 2140, 480 2230, 450 2370, 510 2490, 640 2540, 790 2510, 860 2400, 840 2240, 740 2120'),
	-- tracks through the fields
	(60, 'track', NULL, '450 1240, 520 950, 640 640, 900 420, 1300 330, 1760 350'),
	(61, 'track', NULL, '2660 2230, 2950 2450, 3350 2500, 3650 2300, 3500 1850'),
	(62, 'track', NULL, '860 2400, 1120 2370, 1350 2240'),
	(63, 'track', NULL, '3100 760, 3120 1020, 3300 1320'),
	(64, 'track', NULL, '2200 2600, 1800 2680, 1280 2720, 790 2510'),
	(65, 'track', NULL, '3350 2500, 3420 2760, 3600 2880')
) AS road(id, class, what, path);

-- The town core: street corners, row by row from the south, six to a row.
CREATE TEMP TABLE core_node AS
SELECT (k - 1) % 6 AS i, (k - 1) / 6 AS j, x, y
FROM unnest(
	ARRAY[1775, 1850, 1925, 2005, 2080, 2140,  1748, 1832, 1918, 2008, 2095, 2172,  1735, 1825, 1915, 2010, 2105, 2190,
		  1745, 1828, 1918, 2012, 2100, 2176,  1780, 1848, 1925, 2010, 2085, 2146]::float8[],
	ARRAY[1446, 1428, 1418, 1415, 1428, 1452,  1505, 1492, 1485, 1484, 1494, 1512,  1568, 1562, 1558, 1556, 1566, 1580,
		  1632, 1634, 1633, 1634, 1640, 1648,  1688, 1702, 1708, 1708, 1704, 1694]::float8[]
) WITH ORDINALITY AS node(x, y, k);

INSERT INTO sketch
SELECT 100 + j, CASE WHEN j = 2 THEN 'main' ELSE 'residential' END, NULL, false,
	ST_MakeLine(ST_MakePoint(x, y) ORDER BY i)
FROM core_node GROUP BY j
UNION ALL
SELECT 110 + i, CASE WHEN i = 3 THEN 'main' ELSE 'residential' END, NULL, false,
	ST_MakeLine(ST_MakePoint(x, y) ORDER BY j)
FROM core_node GROUP BY i;

-- Quarters: quadrilaterals with rows x columns of streets; bend_x, bend_y bow the streets, the corners stay.
CREATE TEMP TABLE quarter (id bigint PRIMARY KEY, what text, q float8[], rows integer, columns integer,
	bend_x float8, bend_y float8);
INSERT INTO quarter VALUES
	(200, 'house',    '{1300,1900, 1690,1830, 1740,2160, 1350,2240}', 4, 2, -18, 26),
	(220, 'house',    '{2260,1850, 2700,1930, 2660,2230, 2230,2150}', 4, 3, 14, -30),
	(240, 'terrace',  '{1390,1060, 1700,1090, 1690,1300, 1390,1270}', 2, 2, 0, 0),
	(260, 'industry', '{2380,1180, 3300,1320, 3270,1560, 2420,1430}', 2, 3, 0, 0);

CREATE TEMP TABLE quarter_node AS
SELECT id AS quarter, i, j,
	pg_temp.millimetre((1 - u) * (1 - v) * q[1] + u * (1 - v) * q[3] + u * v * q[5] + (1 - u) * v * q[7]
		+ bend_x * 4 * v * (1 - v)) AS x,
	pg_temp.millimetre((1 - u) * (1 - v) * q[2] + u * (1 - v) * q[4] + u * v * q[6] + (1 - u) * v * q[8]
		+ bend_y * 4 * u * (1 - u)) AS y
FROM (SELECT quarter.*, i, j, i::float8 / columns AS u, j::float8 / rows AS v
	  FROM quarter, generate_series(0, columns) AS i, generate_series(0, rows) AS j) AS node;

INSERT INTO sketch
SELECT quarter + j, 'residential', what, true, ST_MakeLine(ST_MakePoint(x, y) ORDER BY i)
FROM quarter_node JOIN quarter ON quarter.id = quarter GROUP BY quarter, j, what
UNION ALL
SELECT quarter + 10 + i, 'residential', NULL, true, ST_MakeLine(ST_MakePoint(x, y) ORDER BY j)
FROM quarter_node GROUP BY quarter, i;

-- Smooth roads are Catmull-Rom curves through their control points, six pieces from one to the next.
CREATE TEMP TABLE road AS
WITH control AS (
	SELECT id, n, smooth, ST_X(p) AS x, ST_Y(p) AS y
	FROM sketch, ST_DumpPoints(path) AS d(k, p), LATERAL (SELECT k[1] AS n) AS number
), span AS (
	SELECT id, n, smooth, x AS x1, y AS y1, lead(x) OVER w AS x2, lead(y) OVER w AS y2,
		coalesce(lag(x) OVER w, x) AS x0, coalesce(lag(y) OVER w, y) AS y0,
		coalesce(lead(x, 2) OVER w, lead(x) OVER w) AS x3, coalesce(lead(y, 2) OVER w, lead(y) OVER w) AS y3
	FROM control WINDOW w AS (PARTITION BY id ORDER BY n)
), point AS (
	SELECT id, n, k, t,
		((-x0 + 3 * x1 - 3 * x2 + x3) * t * t * t + (2 * x0 - 5 * x1 + 4 * x2 - x3) * t * t
			+ (x2 - x0) * t) / 2 + x1 AS x,
		((-y0 + 3 * y1 - 3 * y2 + y3) * t * t * t + (2 * y0 - 5 * y1 + 4 * y2 - y3) * t * t
			+ (y2 - y0) * t) / 2 + y1 AS y
	FROM span, generate_series(0, CASE WHEN smooth THEN 5 ELSE 0 END) AS k,
		LATERAL (SELECT k / 6.0::float8 AS t) AS part
	WHERE x2 IS NOT NULL
	UNION ALL
	SELECT id, n, 0, 0, x1, y1 FROM span WHERE x2 IS NULL
)
SELECT id, class, what, path
FROM (SELECT id, ST_MakeLine(pg_temp.point(x, y) ORDER BY n, k) AS path FROM point GROUP BY id) AS curve
JOIN (SELECT id, class, what FROM sketch) AS sketch USING (id);

CREATE TABLE settlement_roads (id bigint PRIMARY KEY, class text NOT NULL, geom geometry(LineString, 25832) NOT NULL);
INSERT INTO settlement_roads SELECT id, class, pg_temp.place(path) FROM road ORDER BY id;

-- Faces between the roads. The frame passes through the ends of the roads that leave the map.
CREATE TABLE settlement_blocks (id bigint PRIMARY KEY, geom geometry(Polygon, 25832) NOT NULL);
INSERT INTO settlement_blocks
WITH line AS (
	SELECT path FROM road
	UNION ALL
	SELECT ST_GeomFromText('LINESTRING(0 0, 1700 0, 4000 0, 4000 640, 4000 1880, 4000 3000, 2240 3000, 0 3000, 0 1180,
		0 0)')
), face AS (
	SELECT (ST_Dump(ST_Polygonize(piece))).geom AS shape
	FROM line, generate_series(1, ST_NPoints(path) - 1) AS k,
		LATERAL (SELECT ST_MakeLine(ST_PointN(path, k), ST_PointN(path, k + 1)) AS piece) AS pieces
)
SELECT row_number() OVER (ORDER BY ST_Contains(shape, ST_MakePoint(610, 2340)) DESC, ST_YMin(shape), ST_XMin(shape),
		ST_YMax(shape), ST_XMax(shape)),
	pg_temp.place(ST_Normalize(shape))
FROM face;

-- 2. Plots and what stands on them ---------------------------------------------------------------------
-- part 0 is the main building: without it the rest of the plot goes as well

CREATE TEMP TABLE part (plot bigint, part integer, class text, row_id bigint, shape geometry);

-- 2a. The core: closed block edges, four sides and four corners a block. Blocks 7 and 8 (counted from the
-- south-west) are the market place and the church yard, and the outer corners are left open.
CREATE TEMP TABLE core_block AS
SELECT a.j * 5 + a.i AS block, q, w, h, 5::float8 AS e, w - 5 AS we, h - 5 AS he
FROM core_node AS a
JOIN core_node AS b ON (b.i, b.j) = (a.i + 1, a.j)
JOIN core_node AS c ON (c.i, c.j) = (a.i + 1, a.j + 1)
JOIN core_node AS d ON (d.i, d.j) = (a.i, a.j + 1),
LATERAL (SELECT ARRAY[a.x, a.y, b.x, b.y, c.x, c.y, d.x, d.y] AS q,
	(b.x - a.x + c.x - d.x) / 2 AS w, (d.y - a.y + c.y - b.y) / 2 AS h) AS size;

-- the corner houses, L-shaped, arms of 14 m and 9 to 11 m deep
INSERT INTO part
SELECT block, corner, 'town', NULL, pg_temp.inside(q, w, h, ARRAY[
	x, y,  x + sx * 14, y,  x + sx * 14, y + sy * d,
	x + sx * d, y + sy * d,  x + sx * d, y + sy * 14,  x, y + sy * 14])
FROM core_block,
	generate_series(0, 3) AS corner,
	LATERAL (SELECT pg_temp.between(9, 11, block, corner) AS d,
		CASE WHEN corner IN (0, 3) THEN e ELSE we END AS x, CASE WHEN corner IN (0, 3) THEN 1 ELSE -1 END AS sx,
		CASE WHEN corner IN (0, 1) THEN e ELSE he END AS y, CASE WHEN corner IN (0, 1) THEN 1 ELSE -1 END AS sy) AS at
WHERE block NOT IN (6, 7) AND (block, corner) NOT IN ((0, 0), (4, 1), (15, 3), (19, 2));

-- the houses between two corners: u runs along the side, v away from the street; some have a wing at the back
INSERT INTO part
SELECT block, 10 + side * 20 + k, 'town', NULL,
	pg_temp.inside(q, w, h, CASE side
		WHEN 0 THEN ARRAY[u0, e, u1, e, u1, e + d, m, e + d, m, e + d + z, u0, e + d + z]
		WHEN 1 THEN ARRAY[u0, he, u1, he, u1, he - d, m, he - d, m, he - d - z, u0, he - d - z]
		WHEN 2 THEN ARRAY[e, u0, e, u1, e + d, u1, e + d, u0]
		ELSE ARRAY[we, u0, we, u1, we - d, u1, we - d, u0] END)
FROM core_block,
	generate_series(0, 3) AS side,
	LATERAL (SELECT CASE WHEN side < 2 THEN we ELSE he END - 14 AS stop) AS stop,
	LATERAL (SELECT round((stop - 19) / 10.5)::integer AS houses) AS n,
	generate_series(0, houses - 1) AS k,
	LATERAL (SELECT block * 1000 + side * 100 + k AS seed, (stop - 19) / houses AS front) AS one,
	LATERAL (SELECT 19 + front * (k + CASE WHEN k = 0 THEN 0 ELSE pg_temp.between(-0.2, 0.2, seed, 1) END) AS u0,
		19 + front * (k + 1 + CASE WHEN k = houses - 1 THEN 0 ELSE pg_temp.between(-0.2, 0.2, seed + 1, 1) END) AS u1,
		pg_temp.between(9, 13, seed, 2) AS d, side < 2 AND pg_temp.chance(seed, 3) < 0.3 AS wing) AS at,
	LATERAL (SELECT (u0 + u1) / 2 AS m, CASE WHEN wing THEN pg_temp.between(5, 8, seed, 4) ELSE 0 END AS z) AS back
WHERE block NOT IN (6, 7) AND pg_temp.chance(seed, 5) > CASE WHEN block IN (0, 4, 15, 19) THEN 0.3 ELSE 0.05 END;

-- workshops and sheds in the yards
INSERT INTO part
SELECT block, 100, 'yard', NULL,
	pg_temp.inside(q, w, h, pg_temp.rectangle(x, h / 2 - 4, x + pg_temp.between(7, 12, block, 7), h / 2 + 3))
FROM core_block, LATERAL (SELECT w / 2 - pg_temp.between(3, 9, block, 8) AS x) AS at
WHERE block NOT IN (6, 7) AND pg_temp.chance(block, 9) < 0.75;

-- the church with its parsonage, the town hall on the market place
INSERT INTO part
SELECT block, k, class, NULL, pg_temp.inside(q, w, h, uv)
FROM core_block, (VALUES
	(6, 1, 'church', '{22,25, 30,25, 30,28, 46,28, 46,23, 53,23, 53,28, 60,28, 64,32,
		64,36, 60,40, 53,40, 53,45, 46,45, 46,40, 30,40, 30,43, 22,43}'),
	(6, 2, 'house', '{8,50, 21,50, 21,61, 8,61}'), (6, 3, 'house', '{62,53, 76,53, 76,62, 70,62, 70,65, 62,65}'),
	(7, 1, 'public', '{12,44, 38,44, 38,58, 31,58, 31,61, 19,61, 19,58, 12,58}'),
	(7, 2, 'public', '{62,12, 72,12, 72,20, 62,20}')
) AS monument(number, k, class, uv_text), LATERAL (SELECT uv_text::float8[] AS uv) AS uv
WHERE block = number;

-- 2b. The industrial strip: halls in lots, an office in front of some of them; rows of slabs and a school
INSERT INTO part
SELECT plot, piece, CASE WHEN piece = 0 THEN 'hall' ELSE 'office' END, NULL, pg_temp.inside(q, w, h, CASE
	WHEN piece = 1 THEN pg_temp.rectangle(x0 + 2, y1 + 6, x0 + 20, y1 + 17)
	WHEN pg_temp.chance(plot, 1) < 0.4
		THEN ARRAY[x0, y0, x1, y0, x1, y1, x1 - (x1 - x0) / 3, y1,
			x1 - (x1 - x0) / 3, y1 - (y1 - y0) / 3, x0, y1 - (y1 - y0) / 3]
	ELSE pg_temp.rectangle(x0, y0, x1, y1) END)
FROM (SELECT a.quarter * 1000 + (a.i * 2 + a.j) * 10 AS cell, ARRAY[a.x, a.y, b.x, b.y, c.x, c.y, d.x, d.y] AS q,
		(b.x - a.x + c.x - d.x) / 2 AS w, (d.y - a.y + c.y - b.y) / 2 AS h, 3 + (a.i + a.j) % 2 AS lots
	  FROM quarter_node AS a
	  JOIN quarter_node AS b ON (b.quarter, b.i, b.j) = (a.quarter, a.i + 1, a.j)
	  JOIN quarter_node AS c ON (c.quarter, c.i, c.j) = (a.quarter, a.i + 1, a.j + 1)
	  JOIN quarter_node AS d ON (d.quarter, d.i, d.j) = (a.quarter, a.i, a.j + 1)
	  WHERE a.quarter = 260) AS cell,
	generate_series(0, lots - 1) AS lot, generate_series(0, 1) AS piece,
	LATERAL (SELECT cell + lot AS plot, 10 + (w - 20) / lots * lot AS left_, (w - 20) / lots AS lot_width) AS lots_,
	LATERAL (SELECT left_ + pg_temp.between(4, 14, plot, 2) AS x0,
		left_ + lot_width - pg_temp.between(4, 22, plot, 3) AS x1,
		pg_temp.between(12, 22, plot, 4) AS y0, h - pg_temp.between(30, 48, plot, 5) AS y1) AS at
WHERE piece = 0 OR pg_temp.chance(plot, 6) < 0.55;

INSERT INTO part
SELECT 270000 + line, k, 'slab', 270000 + line,
	pg_temp.outline(2085 + 4 * line + 60 * k, 1185 + 66 * line + 9 * k, 0.96, 0.28,
		pg_temp.rectangle(0, 0, 42 + 6 * (line % 2), 11.5))
FROM generate_series(0, 2) AS line, generate_series(0, 3) AS k
UNION ALL
SELECT 271000, 0, 'school', NULL,
	pg_temp.outline(1800, 960, 0.99, 0.14, '{0,0, 62,0, 62,40, 48,40, 48,14, 14,14, 14,34, 0,34}')
UNION ALL
SELECT 271000, 1, 'school', NULL, pg_temp.outline(1800, 905, 0.99, 0.14, pg_temp.rectangle(0, 0, 45, 24));

-- 2c. Along the roads: one plot every so many metres, on either side
CREATE TEMP TABLE spot AS
WITH piece AS (
	SELECT id, what, ST_X(a) AS x, ST_Y(a) AS y,
		pg_temp.direction(dx / length) AS ux, pg_temp.direction(dy / length) AS uy, length,
		sum(length) OVER (PARTITION BY id ORDER BY k) - length AS start, sum(length) OVER (PARTITION BY id) AS total
	FROM road, generate_series(1, ST_NPoints(path) - 1) AS k,
		LATERAL (SELECT ST_PointN(path, k) AS a, ST_PointN(path, k + 1) AS b) AS ends,
		LATERAL (SELECT ST_X(b) - ST_X(a) AS dx, ST_Y(b) - ST_Y(a) AS dy) AS vector,
		-- numeric, so that the sums are exact in any order
		LATERAL (SELECT round(sqrt(dx * dx + dy * dy)::numeric, 3) AS length) AS norm
	WHERE what IN ('house', 'terrace', 'suburb', 'village', 'hamlet')
), habit(what, side, spacing, loose, twist, empty) AS (VALUES
	('house', 0, 26, 0.08, 0.05, 0.04), ('house', 1, 25, 0.08, 0.05, 0.04),
	('terrace', 0, 44, 0, 0, 0), ('terrace', 1, 25, 0, 0, 0),
	('suburb', 0, 29, 0.1, 0.06, 0.1), ('suburb', 1, 31, 0.1, 0.06, 0.1), ('village', 0, 31, 0.1, 0.14, 0.07),
	('village', 1, 29, 0.1, 0.14, 0.07), ('hamlet', 0, 33, 0.12, 0.25, 0.05), ('hamlet', 1, 30, 0.12, 0.25, 0.05)
)
SELECT plot, what, id, side, slot, slot >= total / spacing / 2 AS second_half,
	pg_temp.millimetre(x + ux * (s - start)) AS x, pg_temp.millimetre(y + uy * (s - start)) AS y,
	pg_temp.direction(turn * (ux - angle * uy) / norm) AS ux, pg_temp.direction(turn * (uy + angle * ux) / norm) AS uy
FROM habit JOIN (SELECT DISTINCT id, what, total FROM piece) AS road USING (what),
	generate_series(0, 200) AS slot,
	LATERAL (SELECT id * 1000 + side * 500 + slot AS plot) AS plots,
	LATERAL (SELECT pg_temp.millimetre((slot + 0.5 + pg_temp.between(-loose, loose, plot, 1)) * spacing) AS s,
		pg_temp.between(-twist, twist, plot, 2) AS angle) AS jitter,
	LATERAL (SELECT x, y, ux, uy, start::float8 FROM piece
		WHERE piece.id = road.id AND s >= start AND s < start + length) AS under,
	LATERAL (SELECT CASE side WHEN 0 THEN 1 ELSE -1 END AS turn, sqrt(1 + angle * angle) AS norm) AS direction
WHERE pg_temp.chance(plot, 3) >= empty;

-- single-family houses, some L-shaped, with garages and garden sheds
INSERT INTO part
SELECT plot, piece, (ARRAY['house', 'garage', 'shed'])[piece + 1], NULL, pg_temp.outline(x, y, ux, uy, CASE piece
	WHEN 0 THEN CASE
		WHEN kind < 0.22 THEN ARRAY[-w, b, w, b, w, b + d, w - 4.5, b + d, w - 4.5, b + d + 3.5, -w, b + d + 3.5]
		WHEN kind < 0.34 THEN ARRAY[-w, b, 0, b, 0, b - 2, w, b - 2, w, b + d, -w, b + d]
		ELSE pg_temp.rectangle(-w, b, w, b + d) END
	WHEN 1 THEN pg_temp.rectangle(w + gap, b + 2, w + gap + 3.2, b + 8.4)
	ELSE pg_temp.rectangle(-w + gap, b + d + 9, -w + gap + 3.6, b + d + 11.8) END)
FROM spot, generate_series(0, 2) AS piece,
	LATERAL (SELECT pg_temp.chance(plot, 10) AS kind,
		pg_temp.between(4.4, 6.2, plot, 11) + CASE what WHEN 'suburb' THEN 1 ELSE 0 END AS w,
		pg_temp.between(8.5, 11.5, plot, 12) AS d, pg_temp.between(8.5, 12.5, plot, 13) AS b,
		CASE WHEN pg_temp.chance(plot, 14) < 0.4 THEN 0 ELSE 2.2 END AS gap, pg_temp.chance(plot, 15) AS use) AS size
WHERE (what IN ('house', 'suburb') OR what IN ('village', 'hamlet') AND use >= 0.5)
	AND (piece = 0 OR piece = 1 AND pg_temp.chance(plot, 16) < 0.3 OR piece = 2 AND pg_temp.chance(plot, 17) < 0.1);

-- farms on the village street: the house with its gable to the street, the barn across the back, often a stable
INSERT INTO part
SELECT plot, piece, (ARRAY['farm', 'barn', 'stable'])[piece + 1], NULL, pg_temp.outline(x, y, ux, uy, CASE piece
	WHEN 0 THEN pg_temp.rectangle(-12, b, -3, b + d)
	WHEN 1 THEN pg_temp.rectangle(-12, b + d + 6,
		pg_temp.between(6, 11, plot, 20), b + d + 6 + pg_temp.between(9, 12, plot, 21))
	ELSE pg_temp.rectangle(4.5, b + 2, 11, b + d + 1) END)
FROM spot, generate_series(0, 2) AS piece,
	LATERAL (SELECT pg_temp.chance(plot, 15) AS use, pg_temp.between(7.5, 10, plot, 13) AS b,
		pg_temp.between(13, 17, plot, 22) AS d) AS size
WHERE what IN ('village', 'hamlet') AND use < 0.5 AND (piece < 2 OR pg_temp.chance(plot, 23) < 0.55);

-- terraces on one side of a street, semi-detached houses on the other
INSERT INTO part
SELECT plot, k, 'terrace', CASE side WHEN 0 THEN plot ELSE id * 1000 + 900 + second_half::integer END,
	pg_temp.outline(x, y, ux, uy,
		pg_temp.rectangle((k - units / 2.0) * front, b, (k + 1 - units / 2.0) * front, b + depth))
FROM spot,
	LATERAL (SELECT CASE side WHEN 0 THEN 4 + (slot + id) % 3 ELSE 2 END AS units,
		CASE side WHEN 0 THEN 6.2 ELSE 7.8 END::float8 AS front,
		CASE side WHEN 0 THEN 10.5 ELSE 10 END::float8 AS depth, 10.0::float8 + 2 * (side + slot % 2) AS b) AS size,
	generate_series(0, units - 1) AS k
WHERE what = 'terrace';

-- 2d. Three-sided farms in the fields, the village church, and gardens with huts by the stream
INSERT INTO part
SELECT 300000 + number, piece, (ARRAY['farm', 'barn', 'stable', 'shed'])[piece + 1], NULL::bigint,
	pg_temp.outline(x, y, pg_temp.direction(ux / norm), pg_temp.direction(uy / norm), CASE piece
	WHEN 0 THEN pg_temp.rectangle(0, 0, 18, 11)
	WHEN 1 THEN pg_temp.rectangle(0, 34, 34, 47)
	WHEN 2 THEN pg_temp.rectangle(28, 2, 37, 30)
	ELSE pg_temp.rectangle(-16, 25, -6, 32) END)
FROM (VALUES (1, 470, 690, 3, -2), (2, 1010, 440, 4, 1), (3, 1380, 250, 5, -1), (4, 2960, 2380, 4, 1),
		(5, 3380, 2420, 3, -2), (6, 3560, 2120, 2, 5), (7, 3215, 1010, 1, 3), (8, 1500, 2590, 5, 1),
		(9, 1080, 2460, 3, 1), (10, 3620, 2660, 1, 2), (11, 2380, 800, 4, 1), (12, 240, 700, 2, 1),
		(13, 1000, 1750, 1, 4), (14, 2480, 2700, 3, -1), (15, 3700, 1180, 5, 2)) AS farm(number, x, y, ux, uy),
	LATERAL (SELECT sqrt((ux * ux + uy * uy)::float8) AS norm) AS norm,
	generate_series(0, 3) AS piece
WHERE piece < 3 OR number % 3 > 0
UNION ALL
SELECT 320000, 0, 'church', NULL, pg_temp.outline(3060, 672, 0.995037, 0.099504,
	'{0,3, 7,3, 7,0, 27,0, 31,4, 31,8, 27,12, 7,12, 7,9, 0,9}')
UNION ALL
SELECT 330000 + row_ * 20 + k, 0, 'hut', NULL, pg_temp.outline(
	1500 + 19 * k + pg_temp.between(-3, 3, row_ * 20 + k, 40),
	790 + 26 * row_ + 3 * k + pg_temp.between(-4, 4, row_ * 20 + k, 41), 0.987, 0.16, pg_temp.rectangle(0, 0, 5.5, 4))
FROM generate_series(0, 2) AS row_, generate_series(0, 9) AS k;

-- 3. Who stays -----------------------------------------------------------------------------------------
-- A plot's building gives way to a road whose middle line is nearer than 3.5 m (main roads 4.4 m) and to
-- one of an earlier plot nearer than 3.5 m.

CREATE INDEX ON part USING gist (shape);
CREATE INDEX ON road USING gist (path);
ANALYZE part;

DELETE FROM part USING road
WHERE ST_DWithin(shape, path, CASE road.class WHEN 'main' THEN 4.4 ELSE 3.5 END);
DELETE FROM part USING part AS earlier
WHERE earlier.plot < part.plot AND ST_DWithin(part.shape, earlier.shape, 3.5);
DELETE FROM part
WHERE plot > 1000 AND class <> 'terrace'
	AND NOT EXISTS (SELECT FROM part AS main WHERE main.plot = part.plot AND main.part = 0);
DELETE FROM part
WHERE class = 'terrace' AND 1 = (SELECT count(*) FROM part AS unit WHERE unit.plot = part.plot);

CREATE TABLE settlement_buildings (id bigint PRIMARY KEY, class text NOT NULL, block bigint NOT NULL, row_id bigint,
	geom geometry(Polygon, 25832) NOT NULL);
INSERT INTO settlement_buildings
WITH placed AS (
	SELECT plot, part, class, row_id, pg_temp.place(ST_ForcePolygonCCW(ST_RemoveRepeatedPoints(shape))) AS geom
	FROM part
), assigned AS (
	SELECT placed.*, settlement_blocks.id AS block,
		row_number() OVER (PARTITION BY settlement_blocks.id ORDER BY plot % 1000 % 500, plot, part) AS place_in_block
	-- no building is near a road, so any of its corners tells the face
	FROM placed JOIN settlement_blocks
		ON ST_Contains(settlement_blocks.geom, ST_StartPoint(ST_ExteriorRing(placed.geom)))
)
SELECT row_number() OVER (ORDER BY plot, part), class, block, row_id, geom
FROM assigned
WHERE block > 1 OR place_in_block <= 41;

CREATE VIEW hamlet AS SELECT * FROM settlement_buildings WHERE block = 1;

CREATE INDEX ON settlement_buildings USING gist (geom);
CREATE INDEX ON settlement_roads USING gist (geom);
ANALYZE settlement_buildings;
ANALYZE settlement_roads;
ANALYZE settlement_blocks;

COMMENT ON TABLE settlement_buildings IS 'sample buildings: a town core, quarters, villages, halls, farms';
COMMENT ON COLUMN settlement_buildings.block IS 'face between the roads, settlement_blocks.id; 1 is the hamlet';
COMMENT ON COLUMN settlement_buildings.row_id IS 'row of houses that the generator laid out, NULL elsewhere';
COMMENT ON TABLE settlement_roads IS 'sample roads, class main, residential or track';
COMMENT ON TABLE settlement_blocks IS 'faces between the sample roads and the frame of the map';
COMMENT ON VIEW hamlet IS 'the 41 buildings of block 1';

DROP TABLE sketch, core_node, quarter, quarter_node, road, part, core_block, spot;
DROP FUNCTION pg_temp.inside, pg_temp.rectangle, pg_temp.outline, pg_temp.place, pg_temp.direction, pg_temp.point,
	pg_temp.millimetre, pg_temp.between, pg_temp.chance;

COMMIT;
