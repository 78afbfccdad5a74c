-- layers.sql: one stored layer per scale - created, refreshed as a whole and by groups, built in batches
\pset null '(null)'
\set SHOW_CONTEXT never
CREATE SCHEMA typify_layers;
SET search_path = typify_layers, public;
\i tests/data/error_of.sql
\i tests/data/edits.sql

-- 300 buildings in 11 blocks and the NULL block; LOD200 has nothing in block 4 and nothing in the NULL block
CREATE TABLE lod25 (id bigint PRIMARY KEY, block integer, geom geometry(Polygon, 25832));
INSERT INTO lod25
SELECT i, nullif(i % 12, 0), ST_MakeEnvelope(x, y, x + 6 + i % 11, y + 7 + i % 7, 25832)
FROM generate_series(1, 300) AS i, LATERAL (SELECT (i % 12) % 4 * 1000 + i * 7919 % 307 AS x, (i % 12) / 4 * 1000 + i * 104729 % 311 AS y) AS xy;
CREATE INDEX ON lod25 USING gist (geom);
CREATE TABLE lod200 (id bigint PRIMARY KEY, block integer, geom geometry(Polygon, 25832));
INSERT INTO lod200
SELECT b * 10 + k, b, ST_MakeEnvelope(x, y, x + 60 + b, y + 50 + k, 25832)
FROM generate_series(1, 11) AS b, generate_series(1, 2 + b % 3) AS k, LATERAL (SELECT b % 4 * 1000 + k * 70 AS x, b / 4 * 1000 + k * 60 AS y) AS xy
WHERE b <> 4;
CREATE VIEW lod200_without_block AS SELECT id, geom FROM lod200;

-- both kinds
SELECT typify_create_scale('layer75', 'lod25', 'lod200', 75000, 0.5, 'block') AS layer;
SELECT typify_create_scale('layer75_table', 'lod25', 'lod200', 75000, 0.5, group_by => 'block', kind => 'table') AS layer;
SELECT layer, count(*) AS placeholders, sum(member_count) AS members, count(DISTINCT id) = count(*) AS unique_ids, count(DISTINCT grp) AS groups,
	pg_temp.differing(layer::regclass, 'SELECT * FROM typify_derive(''lod25'', ''lod200'', 75000, 0.5, ''block'', options => typify_legible_options(NULL))') AS differing
FROM (SELECT 'layer75' AS layer, l.* FROM layer75 AS l UNION ALL SELECT 'layer75_table', l.* FROM layer75_table AS l) AS either GROUP BY layer ORDER BY layer;
SELECT relname, relkind, a.attname, format_type(a.atttypid, a.atttypmod)
FROM pg_class JOIN pg_attribute AS a ON attrelid = pg_class.oid WHERE relname ~ '^layer75' AND relkind IN ('r', 'm') AND attnum > 0 ORDER BY relname, attnum;
SELECT tablename, regexp_replace(indexdef, '^.* ON ', '') AS index, indexdef ~ 'UNIQUE' AS is_unique FROM pg_indexes WHERE tablename ~ '^layer75' ORDER BY 1, 2;
-- how it was derived, for reading and for machines
SELECT regexp_replace(obj_description('layer75'::regclass), '"typify" : "[0-9.]+"', '"typify" : "..."') AS comment;
SELECT obj_description('layer75'::regclass) = obj_description('layer75_table'::regclass) AS both_kinds_alike, (obj_description('layer75'::regclass)::jsonb->>'typify') = extversion AS version
FROM pg_extension WHERE extname = 'typify';

-- every argument passes through
CREATE TABLE links AS SELECT id AS lod25_id, CASE WHEN block <> 4 THEN block * 10 + 1 + id % 2 END AS lod200_id FROM lod25;
CREATE TABLE named AS SELECT id AS gid, geom AS outline, block AS "Block" FROM lod25;
CREATE TABLE named200 AS SELECT geom AS shape, block AS "Quarter" FROM lod200;
SELECT typify_create_scale('with_links', 'lod25', 'lod200', 200000, links => 'links') AS layer, typify_create_scale('with_links_table', 'lod25', 'lod200', 200000, links => 'links', kind => 'table') AS layer;
SELECT typify_create_scale('plain', 'lod25', NULL, 50000) AS layer, typify_create_scale('plain_table', 'lod25', NULL, 50000, kind => 'table') AS layer;
SELECT typify_create_scale('total', 'lod25', NULL, 200000, 1, 'block', allocation => 'total', options => typify_options(exponent => 3, psi => 0.123456789012345678, shape => 'square', count_rule => 'radical', lod200_scale => 150000)) AS layer;
SELECT typify_create_scale('named75', 'named', 'named200', 75000, 0.25, 'Block', id_column => 'gid', geom_column => 'outline', lod200_geom_column => 'shape', lod200_group_by => 'Quarter') AS layer;
SELECT pg_temp.differing('with_links', 'SELECT * FROM typify_derive(''lod25'', ''lod200'', 200000, links => ''links'', options => typify_legible_options(NULL))') AS with_links,
	pg_temp.differing('with_links_table', 'SELECT * FROM typify_derive(''lod25'', ''lod200'', 200000, links => ''links'', options => typify_legible_options(NULL))') AS with_links_table,
	pg_temp.differing('plain', 'SELECT * FROM typify_derive(''lod25'', NULL, 50000, options => typify_legible_options(NULL))') AS plain,
	pg_temp.differing('plain_table', 'SELECT * FROM typify_derive(''lod25'', NULL, 50000, options => typify_legible_options(NULL))') AS plain_table,
	pg_temp.differing('total', 'SELECT * FROM typify_derive(''lod25'', NULL, 200000, 1, ''block'', allocation => ''total'', options => typify_legible_options(typify_options(exponent => 3, psi => 0.123456789012345678, shape => ''square'', count_rule => ''radical'', lod200_scale => 150000)))') AS total,
	pg_temp.differing('named75', 'SELECT * FROM typify_derive(''named'', ''named200'', 75000, 0.25, ''Block'', id_column => ''gid'', geom_column => ''outline'', lod200_geom_column => ''shape'', lod200_group_by => ''Quarter'', options => typify_legible_options(NULL))') AS named75;
SELECT obj_description('total'::regclass)::jsonb->'options' AS options;
-- a placeholder without size stays as a row, and so does the SRID of a column that says none
CREATE TABLE untyped (id integer, geom geometry);
SELECT typify_create_scale('of_nothing', 'untyped', NULL, 50000) AS layer;
INSERT INTO untyped VALUES (1, NULL), (2, 'SRID=25832;POINT(0 0)'), (3, 'SRID=25832;POLYGON((100 0,110 0,110 10,100 10,100 0))');
SELECT typify_refresh_scale('of_nothing');
SELECT typify_create_scale('untyped25', 'untyped', NULL, 25000, kind => 'table', options => typify_options(min_side => 0, min_gap => 0)) AS layer;
SELECT id, geom IS NULL AS not_drawn, ST_SRID(geom) AS srid, members FROM untyped25 ORDER BY id;
SELECT format_type(atttypid, atttypmod) FROM pg_attribute WHERE attrelid = 'untyped25'::regclass AND attname = 'geom';
SELECT count(*) FROM of_nothing;

-- refreshed as a whole; readers of a table see old rows until the end, so nothing is concurrent about it
SELECT count(pg_temp.edit('lod25', n)) AS edits FROM generate_series(1, 20) AS n;
SELECT pg_temp.differing('layer75', 'SELECT * FROM typify_derive(''lod25'', ''lod200'', 75000, 0.5, ''block'', options => typify_legible_options(NULL))') > 0 AS stale;
SELECT typify_refresh_scale('layer75');
SELECT pg_temp.differing('layer75', 'SELECT * FROM typify_derive(''lod25'', ''lod200'', 75000, 0.5, ''block'', options => typify_legible_options(NULL))') AS differing;
SELECT count(pg_temp.edit('lod25', n)) AS edits FROM generate_series(21, 40) AS n;
SELECT typify_refresh_scale('layer75', concurrently => true);
SELECT typify_refresh_scale('layer75_table');
SELECT pg_temp.differing('layer75', 'SELECT * FROM typify_derive(''lod25'', ''lod200'', 75000, 0.5, ''block'', options => typify_legible_options(NULL))') AS differing, pg_temp.differing('layer75_table', 'TABLE layer75') AS table_differing;

-- 400 edits, the groups that changed refreshed after every 5: the same rows as deriving anew, whether objects of
-- LOD200 know their block or go to the nearest building, and where nothing is calibrated
CREATE FUNCTION pg_temp.rounds(layer regclass, query text, first integer, rounds integer, OUT edits integer, OUT stale integer, OUT differing bigint) LANGUAGE plpgsql
SET client_min_messages = error AS
$$
DECLARE
	touched text[];
	number integer := first;
BEGIN
	edits := 0;
	stale := 0;
	differing := 0;
	FOR i IN 1 .. rounds LOOP
		touched := '{}';
		FOR j IN 1 .. 5 LOOP
			touched := touched || pg_temp.edit('lod25', number);
			number := number + 1;
			edits := edits + 1;
		END LOOP;
		stale := stale + (pg_temp.differing(layer, query) > 0)::integer;
		PERFORM typify_refresh_groups(layer, touched);
		differing := differing + pg_temp.differing(layer, query);
	END LOOP;
END
$$;
SELECT typify_create_scale('nearest', 'lod25', 'lod200_without_block', 100000, 0, 'block', 'table') AS layer;
SELECT typify_create_scale('fixed', 'lod25', NULL, 75000, 1, 'block', 'table', typify_options(min_gap => 0)) AS layer;
SELECT * FROM pg_temp.rounds('layer75_table', 'SELECT * FROM typify_derive(''lod25'', ''lod200'', 75000, 0.5, ''block'', options => typify_legible_options(NULL))', 41, 30);
SELECT typify_refresh_scale('nearest'), typify_refresh_scale('fixed');
SELECT * FROM pg_temp.rounds('nearest', 'SELECT * FROM typify_derive(''lod25'', ''lod200_without_block'', 100000, 0, ''block'', options => typify_legible_options(NULL))', 191, 30);
SELECT typify_refresh_scale('fixed');
SELECT * FROM pg_temp.rounds('fixed', 'SELECT * FROM typify_derive(''lod25'', NULL, 75000, 1, ''block'', options => typify_options(min_side => 0.35))', 341, 20);
SELECT typify_refresh_scale('nearest');
-- an edit of LOD200 is noticed by itself
UPDATE lod200 SET geom = ST_Expand(geom, 10) WHERE id = 71;
SELECT pg_temp.differing('nearest', 'SELECT * FROM typify_derive(''lod25'', ''lod200_without_block'', 100000, 0, ''block'', options => typify_legible_options(NULL))') > 0 AS stale;
SELECT typify_refresh_groups('nearest', '{}') > 0 AS rows;
SELECT pg_temp.differing('nearest', 'SELECT * FROM typify_derive(''lod25'', ''lod200_without_block'', 100000, 0, ''block'', options => typify_legible_options(NULL))') AS differing;
-- only what is named, and what depends on it, is written: here just one group, then none
SELECT count(*) AS rows_before FROM fixed WHERE grp = '7';
SELECT typify_refresh_groups('fixed', '{7}') = count(*) AS as_many FROM fixed WHERE grp = '7';
SELECT typify_refresh_groups('fixed', '{no such group}') AS rows, typify_refresh_groups('fixed', '{}') AS none;
-- a group that is gone loses its rows; the NULL group
DELETE FROM lod25 WHERE block = 7;
SELECT typify_refresh_groups('fixed', '{7}') AS rows;
SELECT count(*) AS left_over FROM fixed WHERE grp = '7';
UPDATE lod25 SET block = NULL WHERE block = 8;
SELECT typify_refresh_groups('fixed', ARRAY['8', NULL]) > 0 AS rows;
SELECT pg_temp.differing('fixed', 'SELECT * FROM typify_derive(''lod25'', NULL, 75000, 1, ''block'', options => typify_options(min_side => 0.35))') AS differing;
-- a table whose index on grp, with what it remembers, is gone is refreshed as a whole
DROP INDEX nearest_grp_idx;
SELECT typify_refresh_groups('nearest', '{1}') IS NOT NULL AS refreshed;
SELECT pg_temp.differing('nearest', 'SELECT * FROM typify_derive(''lod25'', ''lod200_without_block'', 100000, 0, ''block'', options => typify_legible_options(NULL))') AS differing;

-- built in batches: the same table, the same comment
CALL typify_build_scale('built', 'lod25', 'lod200', 75000, 0.5, 'block', batch => 4);
CALL typify_build_scale('built_nearest', 'lod25', 'lod200_without_block', 100000, 0, 'block', batch => 5);
CALL typify_build_scale('built_total', 'lod25', NULL, 200000, 1, 'block', allocation => 'total', batch => 5, options => typify_options(exponent => 3, psi => 0.123456789012345678, shape => 'square', count_rule => 'radical', lod200_scale => 150000));
CALL typify_build_scale('built_links', 'lod25', 'lod200', 200000, links => 'links');
CALL typify_build_scale('built_plain', 'lod25', NULL, 50000);
CALL typify_build_scale('built_empty', 'untyped', NULL, 50000, id_column => 'id');
SELECT typify_refresh_scale('layer75'), typify_refresh_scale('total'), typify_refresh_scale('with_links'), typify_refresh_scale('plain');
SELECT pg_temp.differing('built', 'TABLE layer75') AS built, pg_temp.differing('built_nearest', 'TABLE nearest') AS nearest, pg_temp.differing('built_total', 'TABLE total') AS total, pg_temp.differing('built_links', 'TABLE with_links') AS links, pg_temp.differing('built_plain', 'TABLE plain') AS plain;
SELECT obj_description('built'::regclass) = obj_description('layer75'::regclass) AS same_comment,
	(SELECT array_agg(regexp_replace(indexdef, '^.* ON [^ ]+', '') ORDER BY 1) FROM pg_indexes WHERE tablename = 'built') = (SELECT array_agg(regexp_replace(indexdef, '^.* ON [^ ]+', '') ORDER BY 1) FROM pg_indexes WHERE tablename = 'layer75_table') AS same_indexes;
-- groups are named alike whatever the session's settings say about dates and numbers
CREATE TABLE dated AS SELECT id, DATE '2024-01-31' + block * 30 AS day, block / 7.0::float8 AS share, geom FROM lod25;
SET datestyle = 'German, DMY';
SET extra_float_digits = -5;
CALL typify_build_scale('built_by_day', 'dated', 'lod200_without_block', 75000, 0, 'day');
CALL typify_build_scale('built_by_share', 'dated', 'lod200_without_block', 75000, 0, 'share');
SELECT typify_create_scale('by_day', 'dated', 'lod200_without_block', 75000, 0, 'day', 'table') AS layer;
RESET datestyle;
RESET extra_float_digits;
SELECT typify_create_scale('by_share', 'dated', 'lod200_without_block', 75000, 0, 'share', 'table') AS layer;
SELECT pg_temp.differing('built_by_day', 'TABLE by_day') AS by_day, pg_temp.differing('built_by_share', 'TABLE by_share') AS by_share, min(grp) AS first_day FROM by_day;
SELECT obj_description('built_by_day_grp_idx'::regclass) = obj_description('by_day_grp_idx'::regclass) AS same_by_day, obj_description('built_by_share_grp_idx'::regclass) = obj_description('by_share_grp_idx'::regclass) AS same_by_share;
DELETE FROM dated WHERE day = '2024-03-01';
SELECT typify_refresh_groups('by_day', '{2024-03-01}') > 0 AS rows;
SELECT pg_temp.differing('by_day', 'SELECT * FROM typify_derive(''dated'', ''lod200_without_block'', 75000, 0, ''day'', options => typify_legible_options(NULL))') AS by_day;
-- what is built is refreshed by groups like any other
SELECT typify_refresh_groups('built', '{1}') AS differing_rows;
SELECT pg_temp.differing('built', 'TABLE layer75') AS differing;
-- stopped after two batches: what is done stays, and says that it is not all. Other arguments do not go on with it,
-- the same ones do
CREATE FUNCTION go_on() RETURNS boolean LANGUAGE plpgsql AS
$$
BEGIN
	IF to_regclass('typify_layers.stopped') IS NOT NULL AND current_setting('typify_test.stop') = 'on' THEN
		IF (SELECT count(DISTINCT grp) FROM typify_layers.stopped) >= 6 THEN
			RAISE EXCEPTION 'stopped by the test';
		END IF;
	END IF;
	RETURN true;
END
$$;
CREATE VIEW stopping AS SELECT id, block, geom FROM lod25 WHERE go_on();
SET typify_test.stop = on;
CALL typify_build_scale('stopped', 'stopping', 'lod200', 75000, 0.5, 'block', batch => 3);
SELECT count(DISTINCT grp) AS groups, obj_description('stopped'::regclass)::jsonb->'finished' AS finished FROM stopped;
SET typify_test.stop = off;
SELECT pg_temp.error_of('SELECT typify_refresh_groups(''stopped'', ''{1}'')');
SELECT pg_temp.error_of('CALL typify_build_scale(''stopped'', ''stopping'', ''lod200'', 75000, 0.6, ''block'')');
SELECT pg_temp.error_of('SELECT typify_create_scale(''stopped'', ''stopping'', ''lod200'', 75000, 0.5, ''block'')');
CALL typify_build_scale('stopped', 'stopping', 'lod200', 75000, 0.5, 'block', batch => 5);
SELECT pg_temp.differing('stopped', 'TABLE layer75') AS differing, obj_description('stopped'::regclass)::jsonb ? 'finished' AS unfinished;
SELECT pg_temp.error_of('CALL typify_build_scale(''stopped'', ''stopping'', ''lod200'', 75000, 0.5, ''block'')');
-- stopped, and the tables change before it goes on: it begins anew, whatever changed
DROP TABLE stopped;
SET typify_test.stop = on;
CALL typify_build_scale('stopped', 'stopping', 'lod200_without_block', 75000, 0.5, 'block', batch => 3);
SET typify_test.stop = off;
UPDATE lod25 SET geom = ST_Translate(geom, 1, 0) WHERE id = (SELECT min(id) FROM lod25);
CALL typify_build_scale('stopped', 'stopping', 'lod200_without_block', 75000, 0.5, 'block');
SELECT pg_temp.differing('stopped', 'SELECT * FROM typify_derive(''lod25'', ''lod200_without_block'', 75000, 0.5, ''block'', options => typify_legible_options(NULL))') AS differing;
DROP TABLE stopped;
SET typify_test.stop = on;
CALL typify_build_scale('stopped', 'stopping', 'lod200', 700000, 0.5, 'block', allocation => 'total', batch => 3);
SET typify_test.stop = off;
UPDATE lod200 SET geom = ST_Expand(geom, 2) WHERE id = (SELECT max(id) FROM lod200);
CALL typify_build_scale('stopped', 'stopping', 'lod200', 700000, 0.5, 'block', allocation => 'total', batch => 3);
SELECT pg_temp.differing('stopped', 'SELECT * FROM typify_derive(''lod25'', ''lod200'', 700000, 0.5, ''block'', allocation => ''total'', options => typify_legible_options(NULL))') AS differing, count(*) FILTER (WHERE geom IS NULL) AS hidden FROM stopped;
-- ... and goes on where the groups are the same, whatever the session's settings say of their names
DROP TABLE stopped;
CREATE VIEW stopping_by_day AS SELECT id, DATE '2024-01-31' + block * 30 AS day, geom FROM stopping;
SET typify_test.stop = on;
CALL typify_build_scale('stopped', 'stopping_by_day', NULL, 75000, 0.5, 'day', batch => 3);
SET typify_test.stop = off;
SET datestyle = 'German, DMY';
CALL typify_build_scale('stopped', 'stopping_by_day', NULL, 75000, 0.5, 'day');
RESET datestyle;
-- a failure in the first batch leaves nothing; nor does a call inside a transaction block
DROP TABLE stopped;
CALL typify_build_scale('never', 'lod25', NULL, 20000, 0.5, 'block');
SELECT pg_temp.error_of('CALL typify_build_scale(''never'', ''lod25'', NULL, 75000, 0.5, ''block'')');
SELECT to_regclass('never') AS never;

-- dropped by DROP, which takes the comment along; what a materialized view is derived from cannot be dropped under it
DROP TABLE built_plain;
SELECT pg_temp.error_of('DROP TABLE lod200');

-- a name is written as in SQL
CREATE SCHEMA "typify Layers";
SELECT typify_create_scale('"typify Layers"."Layer 75.5 ""x"""', 'lod25', NULL, 75500, kind => 'table') AS layer;
SELECT typify_refresh_scale('"typify Layers"."Layer 75.5 ""x"""');
CALL typify_build_scale('"typify Layers"."Built 75.5"', 'lod25', NULL, 75500);
SELECT typify_create_scale('MixedCase', 'lod25', NULL, 75500) AS folded;
SELECT pg_temp.differing('"typify Layers"."Built 75.5"', 'TABLE "typify Layers"."Layer 75.5 ""x"""') AS differing;

-- what is wrong says so
SELECT n AS name, pg_temp.error_of(format('SELECT typify_create_scale(%L, ''lod25'', NULL, 75000)', n)) AS error
FROM unnest(ARRAY[NULL, '', 'a.b.c', 'two words', '1st', 'a.', '"open', 'no_such_schema.a', 'layer75', 'lod25', 'links', repeat('x', 64)]) WITH ORDINALITY AS n (n, number) ORDER BY number;
SELECT a AS arguments, pg_temp.error_of(format('SELECT typify_create_scale(''wrong'', %s)', a)) AS error
FROM unnest(ARRAY['NULL, NULL, 75000', '''lod25'', NULL, NULL', '''lod25'', NULL, 75000, NULL', '''lod25'', NULL, 75000, kind => NULL',
	'''lod25'', NULL, 75000, kind => ''view''', '''lod25'', NULL, 75000, kind => ''TABLE''', '''lod25'', NULL, 75000, allocation => NULL',
	'''lod25'', NULL, 75000, allocation => ''fair''', '''lod25'', NULL, 75000, id_column => NULL', '''lod25'', NULL, 75000, geom_column => NULL',
	'''lod25'', NULL, 75000, lod200_geom_column => NULL', '''lod25'', NULL, 75000, id_column => ''no''', '''lod25'', NULL, 75000, geom_column => ''id''',
	'''lod25'', NULL, 75000, group_by => ''no''', '''no_such_table'', NULL, 75000', '''lod25_pkey'', NULL, 75000', '1, NULL, 75000', '''lod25'', ''lod200_pkey'', 75000',
	'''lod25'', NULL, 24999', '''lod25'', NULL, 75000, 2', '''lod25'', NULL, 75000, options => jsonb_populate_record(NULL::typify_options, ''{"shape": "round"}'')']) WITH ORDINALITY AS a (a, number)
ORDER BY number;
SELECT pg_temp.error_of('CALL typify_build_scale(''wrong'', ''lod25'', NULL, 75000, batch => 0)'), pg_temp.error_of('CALL typify_build_scale(''wrong'', ''lod25'', NULL, 75000, batch => NULL)');
SELECT pg_temp.error_of('CALL typify_build_scale(''layer75'', ''lod25'', NULL, 75000)'), pg_temp.error_of('CALL typify_build_scale(''lod25'', ''lod25'', NULL, 75000)');
SELECT to_regclass('wrong') AS wrong;
CREATE TEMP TABLE passing AS TABLE lod25;
SELECT regexp_replace(pg_temp.error_of('SELECT typify_create_scale(''wrong'', ''passing'', NULL, 75000)'), 'pg_temp_[0-9]+', 'pg_temp_...');
BEGIN;
SELECT typify_create_scale('of_passing', 'passing', NULL, 75000, kind => 'table') AS layer;
ROLLBACK;
SET search_path = no_such_schema;
SELECT public.typify_create_scale('wrong', 'typify_layers.lod25', NULL, 75000);
SET search_path = typify_layers, public;

-- refreshing what is no layer, or not in that way
COMMENT ON TABLE links IS 'Which building goes with which object';
COMMENT ON TABLE lod200 IS '{"a": 1}';
SELECT n AS name, pg_temp.error_of(format('SELECT typify_refresh_scale(%L)', n)) AS scale, pg_temp.error_of(format('SELECT typify_refresh_groups(%L, ''{1}'')', n)) AS groups
FROM unnest(ARRAY[NULL, 'lod25', 'links', 'lod200', 'lod25_pkey', 'no_such_layer', '1']) WITH ORDINALITY AS n (n, number) ORDER BY number;
SELECT pg_temp.error_of('SELECT typify_refresh_scale(''built'', NULL)');
SELECT pg_temp.error_of('SELECT typify_refresh_scale(''built'', true)');
SELECT pg_temp.error_of('SELECT typify_refresh_groups(''built'', NULL)');
SELECT pg_temp.error_of('SELECT typify_refresh_groups(''layer75'', ''{1}'')');
SELECT pg_temp.error_of('SELECT typify_refresh_groups(''built_total'', ''{1}'')');
-- a building that came from a group that is not named
CREATE TABLE pair AS SELECT i AS id, i AS block, ST_MakeEnvelope(i * 20, 0, i * 20 + 10, 10) AS geom FROM generate_series(1, 2) AS i;
SELECT typify_create_scale('pair75', 'pair', NULL, 75000, 0, 'block', 'table', typify_options(min_gap => 0)) AS layer;
UPDATE pair SET block = 2;
SELECT pg_temp.error_of('SELECT typify_refresh_groups(''pair75'', ''{2}'')');
SELECT typify_refresh_groups('pair75', '{1, 2}') AS both;
SELECT id, members, grp FROM pair75;
-- the source is gone, or its column
ALTER TABLE pair RENAME TO pair_elsewhere;
SELECT pg_temp.error_of('SELECT typify_refresh_scale(''pair75'')') AS scale, pg_temp.error_of('SELECT typify_refresh_groups(''pair75'', ''{1}'')') AS groups;
ALTER TABLE pair_elsewhere RENAME TO pair;
ALTER TABLE pair DROP COLUMN block;
SELECT pg_temp.error_of('SELECT typify_refresh_scale(''pair75'')') AS scale;
-- a materialized view follows its table by itself
ALTER TABLE lod25 RENAME TO detailed;
SELECT typify_refresh_scale('layer75');

SET client_min_messages = warning;
DROP SCHEMA typify_layers, "typify Layers" CASCADE;
