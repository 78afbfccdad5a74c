-- blocks.sql: lines cut the plane into blocks, the outside among them, and every building is in exactly one
\set VERBOSITY terse
SET client_min_messages = warning;
CREATE SCHEMA "Typify test";
SET search_path = "Typify test", public;
\i tests/data/error_of.sql

-- four roads that cross without common points, a dead end, an island, a ring elsewhere, one road twice, one without length
CREATE TABLE "Roads" (name text, "Line" geometry);
INSERT INTO "Roads" VALUES
	('south', 'SRID=25832;LINESTRING(-50 0, 250 0)'), ('north', 'SRID=25832;LINESTRING(250 100, -50 100)'),
	('west and east', 'SRID=25832;MULTILINESTRING((0 -50, 0 150), (200 -50, 200 150))'), ('middle', 'SRID=25832;LINESTRING(100 0, 100 100)'),
	('dead end', 'SRID=25832;LINESTRING(100 50, 130 50)'), ('island', 'SRID=25832;LINESTRING(30 30, 60 30, 60 60, 30 60, 30 30)'),
	('elsewhere', 'SRID=25832;LINESTRING Z(1000 -900 7, 1100 -900 7, 1100 -800 7, 1000 -800 7, 1000 -900 7)'), ('twice', 'SRID=25832;LINESTRING(250 0, -50 0)'),
	('a point', 'SRID=25832;LINESTRING(5 5, 5 5)'), ('empty', 'SRID=25832;LINESTRING EMPTY'), ('null', NULL);
CREATE FUNCTION pg_temp.blocks(lines geometry) RETURNS TABLE (block bigint, area numeric, holes integer, south_west text, srid integer) LANGUAGE sql AS
$$
	SELECT number, round(ST_Area(geom)::numeric), ST_NumInteriorRings(geom), round(ST_XMin(geom)) || ' ' || round(ST_YMin(geom)), ST_SRID(geom)
	FROM typify_blocks(lines) WITH ORDINALITY AS b (geom, number) ORDER BY number
$$;
SELECT b.* FROM (SELECT ST_Collect(ST_Force2D("Line")) AS lines FROM "Roads") AS r, pg_temp.blocks(lines) AS b WHERE b.block > 1;
SELECT holes, ST_GeometryType(geom), abs(200001150 * 200001050.0 - 30000 - area) < 100 AS all_the_rest FROM (SELECT ST_Collect(ST_Force2D("Line")) AS lines FROM "Roads") AS r, pg_temp.blocks(lines) AS b, typify_blocks(lines) AS geom
WHERE block = 1 AND ST_XMin(geom) < -9e7;
-- valid, of area, sharing no more than borders
SELECT bool_and(ST_IsValid(a) AND ST_Area(a) > 0) AS valid, bool_and(NOT ST_Overlaps(a, b) AND NOT ST_Contains(a, b)) AS apart
FROM (SELECT array_agg(block ORDER BY n) AS blocks FROM (SELECT ST_Collect(ST_Force2D("Line")) AS lines FROM "Roads") AS r, typify_blocks(lines) WITH ORDINALITY AS t (block, n)) AS t,
	 unnest(blocks) WITH ORDINALITY AS a (a, i), unnest(blocks) WITH ORDINALITY AS b (b, j) WHERE i <> j;
-- the same bytes for any order of the lines
SELECT count(DISTINCT story) AS stories FROM (SELECT turn, (SELECT string_agg(md5(ST_AsEWKB(b)), ' ' ORDER BY n) FROM typify_blocks(lines) WITH ORDINALITY AS t (b, n)) AS story
	FROM (SELECT turn, ST_Collect(ST_Force2D("Line") ORDER BY md5(name || turn)) AS lines FROM "Roads", generate_series(1, 5) AS turn GROUP BY turn) AS r) AS s;
-- lines that enclose nothing, no lines, NULL
SELECT * FROM pg_temp.blocks('SRID=25832;LINESTRING(0 0, 10 0)');
SELECT * FROM pg_temp.blocks('SRID=25832;MULTILINESTRING EMPTY');
SELECT * FROM pg_temp.blocks(NULL);
SELECT pg_temp.error_of(format('SELECT typify_blocks(%L)', lines)) FROM unnest(ARRAY['POLYGON((0 0, 1 0, 1 1, 0 0))', 'POINT(0 0)',
	'GEOMETRYCOLLECTION(LINESTRING(0 0, 1 1), POINT(0 0))', 'CIRCULARSTRING(0 0, 1 1, 2 0)', 'SRID=4326;LINESTRING(0 0, 1 1)', 'LINESTRING(0 0, NaN 1)']) WITH ORDINALITY AS a (lines, n) ORDER BY n;

-- buildings: inside, in the island, across a road (the centroid decides), on a road, on two borders, in the outside near and far
CREATE TABLE "Houses" ("Id" integer PRIMARY KEY, what text, "Geom" geometry, block bigint);
INSERT INTO "Houses" VALUES
	(1, 'west block', ST_MakeEnvelope(10, 10, 20, 20, 25832)), (2, 'island', ST_MakeEnvelope(40, 40, 45, 45, 25832)), (3, 'across, mostly east', ST_MakeEnvelope(98, 80, 106, 90, 25832)),
	(4, 'on the middle road', ST_MakeEnvelope(95, 10, 105, 20, 25832)), (5, 'on the crossing', ST_SetSRID(ST_MakePoint(100, 0), 25832)), (6, 'on the dead end', ST_SetSRID(ST_MakePoint(120, 50), 25832)),
	(7, 'near', ST_MakeEnvelope(-20, 10, -10, 20, 25832)), (8, 'far', ST_MakeEnvelope(5e6, 5e6, 5e6 + 10, 5e6 + 10, 25832)), (9, 'elsewhere', ST_MakeEnvelope(1010, -890, 1020, -880, 25832)),
	(10, 'null', NULL), (11, 'empty', ST_GeomFromText('POLYGON EMPTY', 25832)), (12, 'a ring around the island', ST_GeomFromText('POLYGON((25 25, 65 25, 65 65, 25 65, 25 25), (28 28, 62 28, 62 62, 28 62, 28 28))', 25832));
UPDATE "Houses" AS h SET block = a.block FROM typify_assign_blocks('"Houses"', '"Roads"', 'Id', 'Geom', 'Line') AS a WHERE a.id = h."Id";
SELECT "Id", what, block FROM "Houses" ORDER BY 1;
-- the numbers are those of typify_blocks
SELECT count(*) AS outside_of_theirs FROM "Houses" AS h JOIN (SELECT b.geom, b.number FROM (SELECT ST_Collect(ST_Force2D("Line")) AS lines FROM "Roads") AS r, typify_blocks(lines) WITH ORDINALITY AS b (geom, number)) AS b
	ON b.number = h.block WHERE NOT ST_Intersects(b.geom, ST_SetSRID(typify_centre(h."Geom")::geometry, 25832));
SELECT count(*) AS groups, sum(ST_NumGeometries(t)) AS placeholders FROM (SELECT block, typify("Geom", 50000) AS t FROM "Houses" WHERE ST_Area("Geom") > 0 GROUP BY block) AS q;
-- many blocks of many sizes, against the plain join
CREATE TABLE lines AS SELECT ST_SetSRID(ST_MakeLine(ST_MakePoint(i * i * 0.7, -10), ST_MakePoint(i * i * 0.7 + i % 5 * 20, 900)), 25832) AS geom FROM generate_series(0, 35) AS i
	UNION ALL SELECT ST_SetSRID(ST_MakeLine(ST_MakePoint(-10, i * i * 0.7), ST_MakePoint(900, i * i * 0.7 + i % 4 * 30)), 25832) FROM generate_series(0, 35) AS i;
CREATE TABLE points AS SELECT i AS id, ST_SetSRID(ST_MakePoint(i * 7919 % 9973 / 10.0 - 20, i * 104729 % 9967 / 10.0 - 20), 25832) AS geom FROM generate_series(1, 3000) AS i;
SELECT count(*) AS points, count(*) FILTER (WHERE a.block = j.block) AS same, count(*) FILTER (WHERE a.block = 1) > 0 AS some_outside, count(DISTINCT a.block) > 500 AS many_blocks
FROM typify_assign_blocks('points', 'lines') AS a JOIN (SELECT p.id, coalesce(min(number) FILTER (WHERE number > 1), 1) AS block FROM points AS p
	JOIN (SELECT b.geom, b.number FROM (SELECT ST_Collect(geom) AS lines FROM lines) AS r, typify_blocks(lines) WITH ORDINALITY AS b (geom, number)) AS b ON ST_Intersects(b.geom, p.geom) GROUP BY p.id) AS j USING (id);
-- without any road all is one block; without any building there is none
DELETE FROM "Roads";
SELECT block, count(*) FROM typify_assign_blocks('"Houses"', '"Roads"', 'Id', 'Geom', 'Line') GROUP BY block;
DELETE FROM points;
SELECT count(*) AS none FROM typify_assign_blocks('points', 'lines');

CREATE TABLE wrong (number bigint, text text, areas geometry, swiss geometry, lonlat geometry);
INSERT INTO wrong VALUES (1, '', 'SRID=25832;POLYGON((0 0, 1 0, 1 1, 0 0))', 'SRID=2056;LINESTRING(0 0, 1 1)', 'SRID=4326;LINESTRING(0 0, 1 1)');
INSERT INTO points VALUES (1, 'SRID=25832;POINT(0 0)');
SELECT arguments, pg_temp.error_of(format('SELECT * FROM typify_assign_blocks(%s)', arguments)) FROM unnest(ARRAY[$$'points', 'no_such_table'$$, $$'points', NULL$$, $$NULL, 'lines'$$,
	$$'points', 'wrong'$$, $$'points', 'wrong', lines_geom_column => 'text'$$, $$'points', 'wrong', lines_geom_column => 'areas'$$, $$'points', 'wrong', lines_geom_column => 'swiss'$$,
	$$'points', 'wrong', lines_geom_column => 'lonlat'$$, $$'points', 'lines', 'Id'$$]) WITH ORDINALITY AS a (arguments, n) ORDER BY n;
DROP SCHEMA "Typify test" CASCADE;
