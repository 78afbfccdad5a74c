-- dissolve.sql: touching parts become one building, with the map of ids; what stands alone stays as it is
\set VERBOSITY terse
SET client_min_messages = warning;
CREATE SCHEMA "Typify test";
SET search_path = "Typify test", public;
\i tests/data/error_of.sql

CREATE TABLE "Parts" ("Id" integer, "Geom" geometry);
INSERT INTO "Parts" VALUES
	(1, ST_MakeEnvelope(0, 0, 10, 10, 25832)), (2, ST_MakeEnvelope(10, 0, 20, 12, 25832)), (3, ST_MakeEnvelope(20.25, 0, 30, 10, 25832)), -- a row of houses, a gap in it
	(4, ST_MakeEnvelope(100, 0, 140, 40, 25832)), (5, ST_MakeEnvelope(110, 10, 120, 20, 25832)),										   -- a tower on a building
	(6, ST_MakeEnvelope(200, 0, 210, 10, 25832)), (7, ST_MakeEnvelope(210, 10, 220, 20, 25832)),										   -- a corner
	(8, ST_GeomFromText('POLYGON((300 0, 310 10, 310 0, 300 10, 300 0))', 25832)), (9, ST_MakeEnvelope(310, 0, 320, 10, 25832)),		   -- a bow-tie at a wall
	(10, ST_GeomFromText('POLYGON Z((400 0 5, 410 0 5, 410 10 5, 400 10 5, 400 0 5))', 25832)),											   -- alone
	(11, ST_GeomFromText('POINT(405 5)', 25832)), (12, ST_GeomFromText('LINESTRING(400 5, 420 5)', 25832)),								   -- not polygons
	(13, NULL), (14, ST_GeomFromText('POLYGON EMPTY', 25832)),
	(15, ST_GeomFromText('MULTIPOLYGON(((500 0, 510 0, 510 10, 500 10, 500 0)), ((520 0, 530 0, 530 10, 520 10, 520 0)))', 25832)), (16, ST_MakeEnvelope(510, 0, 520, 10, 25832)),
	(17, ST_GeomFromText('POLYGON((600 0, 600 5, 600 0, 600 0))', 25832)), (18, ST_GeomFromText('POLYGON((600 0, 600 9, 600 0, 600 0))', 25832));	-- no area
CREATE FUNCTION pg_temp.houses(tolerance float8) RETURNS TABLE (id bigint, parts bigint[], type text, area numeric, valid boolean) LANGUAGE sql AS
$$
	SELECT id, parts, GeometryType(geom), round(ST_Area(geom)::numeric, 3), ST_IsValid(geom)
	FROM typify_dissolve_table('"Parts"', tolerance, 'Id', 'Geom') ORDER BY id
$$;
SELECT * FROM pg_temp.houses(0);
-- a quarter of a metre closes the gap
SELECT * FROM pg_temp.houses(0.25) WHERE parts && ARRAY[1, 6, 10]::bigint[];
-- everybody once; alone, the very same bytes
SELECT count(*) AS parts, count(DISTINCT part) AS different FROM typify_dissolve_table('"Parts"', 0.5, 'Id', 'Geom') AS d, unnest(parts) AS part;
SELECT count(*) AS alone, count(*) FILTER (WHERE ST_AsEWKB(d.geom) = ST_AsEWKB(p."Geom")) AS same
FROM typify_dissolve_table('"Parts"', 0.5, 'Id', 'Geom') AS d JOIN "Parts" AS p ON p."Id" = d.id WHERE cardinality(parts) = 1;
-- any order of rows
CREATE TABLE expected AS SELECT * FROM typify_dissolve_table('"Parts"', 0.25, 'Id', 'Geom');
CREATE VIEW turned AS SELECT * FROM "Parts" ORDER BY "Id" * 7919 % 101;
SELECT count(*) AS differ FROM (SELECT id, ST_AsEWKB(geom), parts FROM expected
	EXCEPT SELECT id, ST_AsEWKB(geom), parts FROM typify_dissolve_table('turned', 0.25, 'Id', 'Geom')) AS d;

-- a collection: the same, parts being places in it; a multipolygon in it is one part
SELECT string_agg((e.parts = d.parts::bigint[])::text, ' ') AS same_parts,
	   bool_and(ST_AsEWKB(ST_Force2D(e.geom)) = ST_AsEWKB(d.building)) AS same_geometries
FROM (SELECT ST_Collect(ST_Force2D("Geom") ORDER BY "Id") AS geom FROM "Parts" WHERE "Id" < 13) AS c, typify_dissolve(c.geom, 0.25) AS d
JOIN expected AS e ON e.parts[1] = d.parts[1];
SELECT parts, ST_Area(building) AS area FROM typify_dissolve((SELECT ST_Collect("Geom" ORDER BY "Id") FROM "Parts" WHERE "Id" IN (15, 16)), 0) ORDER BY parts;
SELECT parts, ST_AsText(building) FROM typify_dissolve('POLYGON((0 0, 1 0, 1 1, 0 1, 0 0))', 0);
SELECT count(*) AS none FROM typify_dissolve(NULL, 0);
SELECT count(*) AS none FROM typify_dissolve('GEOMETRYCOLLECTION EMPTY', 0);
-- a courtyard stays, a hole as narrow as the tolerance does not
SELECT ST_NumInteriorRings(building) AS holes, round(ST_Area(building)::numeric, 3) AS area
FROM typify_dissolve(ST_GeomFromText('MULTIPOLYGON(((0 0, 9 0, 9 1, 1 1, 1 9, 0 9, 0 0)), ((0 9, 9 9, 9 1, 8 1, 8 8, 0 8, 0 9)), ((20 0, 24 0, 24 1, 21 1, 21 4, 20 4, 20 0)), ((20 4, 24 4, 24 1, 21.3 1, 21.3 3, 20 3, 20 4)))'), 0.4)
ORDER BY ST_XMin(building);

-- errors
SELECT arguments, pg_temp.error_of(format('SELECT * FROM typify_dissolve(%s)', arguments)) FROM unnest(ARRAY[
	$$'POINT(0 0)', NULL$$, $$'POINT(0 0)', -1$$, $$'POINT(0 0)', 'NaN'$$, $$'POINT(0 0)', 'Infinity'$$, $$'SRID=4326;POINT(0 0)', 1$$, $$'POINT(NaN 0)', 1$$,
	$$'CURVEPOLYGON(CIRCULARSTRING(0 0, 4 0, 4 4, 0 4, 0 0))', 1$$]) WITH ORDINALITY AS a (arguments, n) ORDER BY n;
SELECT arguments, pg_temp.error_of(format('SELECT * FROM typify_dissolve_table(%s)', arguments)) FROM unnest(ARRAY[
	$$'no_such_table'$$, $$NULL$$, $$'"Parts"'$$, $$'"Parts"', 0, 'Geom', 'Geom'$$, $$'"Parts"', 0, 'Id', 'Id'$$, $$'"Parts"', -1, 'Id', 'Geom'$$, $$'"Parts"', NULL, 'Id', 'Geom'$$]) WITH ORDINALITY AS a (arguments, n) ORDER BY n;
INSERT INTO "Parts" VALUES (1, ST_SetSRID(ST_MakePoint(0, 0), 25832));
SELECT pg_temp.error_of($$SELECT * FROM typify_dissolve_table('"Parts"', 0, 'Id', 'Geom')$$);
DROP SCHEMA "Typify test" CASCADE;
