-- match.sql: LOD25 buildings and LOD200 objects are linked greedily, one to one, within the limit, in any order of rows
SET client_min_messages = warning;
CREATE SCHEMA "Typify test";
SET search_path = "Typify test", public;
\i tests/data/error_of.sql

-- the pairs alone: the closest first, ties by place, none beyond the limit
SELECT typify_pairs(ARRAY[point(0, 0), point(4, 0)], ARRAY[point(3, 0), point(10, 0)], 100) AS the_closest_first,
	   typify_pairs(ARRAY[point(0, 0), point(2, 0)], ARRAY[point(1, 0), point(1, 0)], 100) AS ties_by_place,
	   typify_pairs(ARRAY[point(0, 0), point(2, 0)], ARRAY[point(1, 0)], 100) AS one_to_one,
	   typify_pairs(ARRAY[point(0, 0), point(0, 9)], ARRAY[point(3, 4), point(3, 14)], 5) AS at_the_limit,
	   typify_pairs(ARRAY[point(0, 0)], ARRAY[point(3, 4)], 4.999) AS beyond,
	   typify_pairs('{}', ARRAY[point(0, 0)], 1) AS nobody, typify_pairs(ARRAY[point(0, 0)], '{}', 1) AS for_nobody;
SELECT typify_nearest(ARRAY[point(0, 0), point(9, 9), point(5, 5)], ARRAY[point(8, 8), point(2, 2), point(2, 2)]) AS nearest,
	   typify_nearest(ARRAY[point(0, 0)], '{}') AS of_none;
SELECT pg_temp.error_of(format('SELECT typify_pairs(%s)', arguments)) FROM unnest(ARRAY[
	'ARRAY[point(0, 0), NULL], ''{}'', 1', '''{}'', ARRAY[point(0, ''NaN'')], 1', '''{}'', ''{}'', -1', '''{}'', ''{}'', ''Infinity''']) AS arguments;

-- twelve pairs of houses along a road, six objects near the middles of the pairs, one of them too far away
CREATE TABLE "LOD 25" ("Id" integer, "Block" text, "Geom" geometry);
INSERT INTO "LOD 25" SELECT i, CASE WHEN i <= 8 THEN 'west' WHEN i <= 16 THEN NULL ELSE 'east' END,
	ST_MakeEnvelope(x, 0, x + 10, 8, 25832) FROM (SELECT i, (i + 1) / 2 * 300 + (i % 2) * 20 AS x FROM generate_series(1, 24) AS i) AS b;
INSERT INTO "LOD 25" VALUES (100, 'west', NULL), (101, 'west', ST_GeomFromText('POLYGON EMPTY', 25832));
CREATE TABLE "LOD 200" (fid bigint, part text, shape geometry(Geometry, 25832));
INSERT INTO "LOD 200" SELECT k, CASE WHEN k <= 4 THEN 'west' WHEN k = 12 THEN 'east' END,
	ST_MakeEnvelope(k * 300 - 20, k, k * 300 + 50, k + 70, 25832) FROM unnest(ARRAY[1, 2, 3, 4, 5, 6, 7, 12]) AS k;
UPDATE "LOD 200" SET shape = ST_Translate(shape, 0, 900) WHERE fid = 3;
INSERT INTO "LOD 200" VALUES (50, NULL, NULL), (51, 'west', ST_GeomFromText('POLYGON EMPTY', 25832));
CREATE FUNCTION pg_temp.links(arguments text) RETURNS TABLE (lod200_id bigint, lod25_ids bigint[], distance numeric) LANGUAGE plpgsql AS
$$
BEGIN
	RETURN QUERY EXECUTE format('SELECT lod200_id, array_agg(lod25_id ORDER BY lod25_id), max(round(distance::numeric, 3))
		FROM typify_match(%s) GROUP BY lod200_id ORDER BY lod200_id NULLS FIRST', arguments);
END
$$;
SELECT set_config('typify_test.names', $$id_column => 'Id', geom_column => 'Geom', lod200_id_column => 'fid', lod200_geom_column => 'shape'$$, false) AS names;
-- one group: eight placeholders for eight objects; no groups in the middle and east without objects
SELECT * FROM pg_temp.links($$'"LOD 25"', '"LOD 200"', $$ || current_setting('typify_test.names'));
SELECT * FROM pg_temp.links($$'"LOD 25"', '"LOD 200"', 0, 'Block', lod200_group_by => 'part', $$ || current_setting('typify_test.names'));
-- without a column of theirs, objects take the group of the nearest building: the same here
SELECT count(*) AS differ FROM (
	(SELECT * FROM pg_temp.links($$'"LOD 25"', '"LOD 200"', 0, 'Block', lod200_group_by => 'part', $$ || current_setting('typify_test.names'))
	 EXCEPT SELECT * FROM pg_temp.links($$'"LOD 25"', '"LOD 200"', 0, 'Block', $$ || current_setting('typify_test.names')))) AS d;
-- a narrower limit: 0.2 mm at 1:200 000 are 40 m
SELECT * FROM pg_temp.links($$'"LOD 25"', '"LOD 200"', 0, 'Block', 0.2, $$ || current_setting('typify_test.names'));
SELECT * FROM pg_temp.links($$'"LOD 25"', '"LOD 200"', 0, 'Block', 0.4, typify_options(lod200_scale => 100000), $$ || current_setting('typify_test.names')) WHERE lod200_id < 3;

-- any order of rows, any plan
CREATE TABLE expected AS SELECT * FROM typify_match('"LOD 25"', '"LOD 200"', 0.5, 'Block', id_column => 'Id', geom_column => 'Geom',
	lod200_id_column => 'fid', lod200_geom_column => 'shape');
CREATE VIEW turned25 AS SELECT * FROM "LOD 25" ORDER BY "Id" * 7919 % 101;
CREATE VIEW turned200 AS SELECT * FROM "LOD 200" ORDER BY fid * 7919 % 11;
SELECT count(*) AS rows, count(lod25_id) AS buildings, count(DISTINCT lod25_id) AS different FROM expected;
SELECT count(*) AS differ FROM (TABLE expected EXCEPT SELECT * FROM typify_match('turned25', 'turned200', 0.5, 'Block', id_column => 'Id',
	geom_column => 'Geom', lod200_id_column => 'fid', lod200_geom_column => 'shape')) AS d;

-- groups with more objects than buildings, with none; layers without rows; points, which have no size
CREATE TABLE few (id bigint, geom geometry, grp integer);
CREATE TABLE many (id bigint, geom geometry, grp integer);
SELECT count(*) AS both_empty FROM typify_match('few', 'many');
INSERT INTO many SELECT i, ST_MakeEnvelope(i * 100, 0, i * 100 + 60, 60, 2056), 1 FROM generate_series(1, 4) AS i;
SELECT * FROM typify_match('few', 'many');
INSERT INTO few VALUES (1, ST_SetSRID(ST_MakePoint(320, 30), 2056), 1), (2, ST_SetSRID(ST_MakePoint(140, 30), 2056), 1), (3, ST_SetSRID(ST_MakePoint(140, 30), 2056), 2);
SELECT * FROM typify_match('few', 'many', group_by => 'grp', lod200_group_by => 'grp');
-- the column of the same name serves by itself
SELECT count(*) AS differ FROM (SELECT * FROM typify_match('few', 'many', group_by => 'grp', lod200_group_by => 'grp') EXCEPT SELECT * FROM typify_match('few', 'many', 0, 'grp')) AS d;
TRUNCATE many;
SELECT * FROM typify_match('few', 'many', group_by => 'grp');
-- feet: 500 m are 1640.4 of them
DELETE FROM few WHERE id > 1;
UPDATE few SET geom = ST_MakeEnvelope(0, 0, 30, 30, 2263);
INSERT INTO many VALUES (1, ST_MakeEnvelope(1640, 0, 1670, 30, 2263), 1);
SELECT * FROM typify_match('few', 'many');
UPDATE many SET geom = ST_MakeEnvelope(1641, 0, 1671, 30, 2263);
SELECT * FROM typify_match('few', 'many');

-- errors
CREATE TABLE wrong (id text, geom text, lonlat geometry, twice bigint, nobody bigint, two geometry, curve geometry, number bigint);
INSERT INTO wrong VALUES ('a', '', 'SRID=4326;POINT(0 0)', 5, NULL, 'SRID=2056;POINT(0 0)', 'SRID=2263;CURVEPOLYGON(CIRCULARSTRING(0 0, 4 0, 4 4, 0 4, 0 0))', 1),
	('b', '', 'SRID=4326;POINT(1 0)', 5, 7, 'SRID=21781;POINT(0 0)', 'SRID=2263;POINT(0 0)', 2);
CREATE INDEX an_index ON few (id);
SELECT arguments, pg_temp.error_of(format('SELECT * FROM typify_match(%s)', arguments)) FROM unnest(ARRAY[
	$$'no_such_table', 'many'$$, $$NULL, 'many'$$, $$'few', NULL$$, $$'an_index', 'many'$$,
	$$'few', 'many', id_column => 'Id'$$, $$'few', 'many', lod200_geom_column => 'the_geom'$$, $$'few', 'many', geom_column => NULL$$,
	$$'few', 'many', 0, 'block'$$, $$'few', 'many', 0, 'grp', lod200_group_by => 'block'$$, $$'few', 'many', lod200_group_by => 'grp'$$,
	$$'wrong', 'many', geom_column => 'lonlat'$$, $$'wrong', 'many', id_column => 'number'$$,
	$$'wrong', 'many', id_column => 'number', geom_column => 'lonlat'$$, $$'wrong', 'many', id_column => 'number', geom_column => 'two'$$,
	$$'wrong', 'many', id_column => 'twice', geom_column => 'curve'$$, $$'wrong', 'many', id_column => 'nobody', geom_column => 'curve'$$,
	$$'wrong', 'many', id_column => 'number', geom_column => 'curve'$$, $$'few', '"LOD 200"', lod200_id_column => 'fid', lod200_geom_column => 'shape'$$,
	$$'few', 'many', 1.5$$, $$'few', 'many', NULL$$, $$'few', 'many', max_distance => -1$$, $$'few', 'many', max_distance => 'NaN'$$, $$'few', 'many', max_distance => NULL$$,
	$$'few', 'many', options => typify_options(count => 5)$$, $$'few', 'many', options => typify_options(min_distance => 5)$$,
	$$'few', 'many', options => typify_options(lod200_scale => 20000)$$, $$'few', 'many', options => jsonb_populate_record(NULL::typify_options, '{"shape": "round"}')$$]) WITH ORDINALITY AS a (arguments, n) ORDER BY n;

-- three schemas, none on the search_path, for a role that owns only its tables; also as a materialized view
CREATE ROLE regress_typify_owner;
CREATE SCHEMA regress_typify_own AUTHORIZATION regress_typify_owner;
CREATE SCHEMA regress_typify_nothing;
GRANT USAGE ON SCHEMA regress_typify_nothing TO regress_typify_owner;
SELECT nspname AS typify FROM pg_type JOIN pg_namespace ON pg_namespace.oid = typnamespace WHERE typname = 'typify_options' \gset
ALTER TABLE few SET SCHEMA regress_typify_own;
ALTER TABLE many SET SCHEMA regress_typify_own;
ALTER TABLE regress_typify_own.few OWNER TO regress_typify_owner;
ALTER TABLE regress_typify_own.many OWNER TO regress_typify_owner;
SET ROLE regress_typify_owner;
SET search_path = regress_typify_nothing;
CREATE MATERIALIZED VIEW regress_typify_own.links AS SELECT * FROM :typify.typify_match('regress_typify_own.few', 'regress_typify_own.many');
REFRESH MATERIALIZED VIEW regress_typify_own.links;
SELECT * FROM regress_typify_own.links;
RESET ROLE;
RESET search_path;
DROP SCHEMA "Typify test", regress_typify_own, regress_typify_nothing CASCADE;
DROP ROLE regress_typify_owner;
