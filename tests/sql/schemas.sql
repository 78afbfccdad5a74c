-- schemas.sql: typify, PostGIS and the tables in three schemas, none of them on the search_path, names that need
-- quoting, and a role that owns its tables and nothing else
\set SHOW_CONTEXT never
SET client_min_messages = warning;
SELECT current_database() AS home \gset
DROP DATABASE IF EXISTS typify_schemas;
DROP ROLE IF EXISTS regress_typify_cartographer;
CREATE DATABASE typify_schemas TEMPLATE template0;
CREATE ROLE regress_typify_cartographer;
\c typify_schemas
SET client_min_messages = warning;
CREATE SCHEMA "Post GIS";
CREATE SCHEMA "Typify, 1";
CREATE SCHEMA "My Maps" AUTHORIZATION regress_typify_cartographer;
CREATE SCHEMA not_mine;
REVOKE ALL ON SCHEMA public FROM public;
CREATE EXTENSION postgis SCHEMA "Post GIS";
CREATE EXTENSION typify SCHEMA "Typify, 1";
GRANT USAGE ON SCHEMA "Post GIS", "Typify, 1", not_mine TO public;
SET SESSION AUTHORIZATION regress_typify_cartographer;
SET search_path = '';
RESET client_min_messages;

CREATE TABLE "My Maps"."Houses, 25" ("Id" integer PRIMARY KEY, "Block ""A""" text, "The Geom" "Post GIS".geometry(Polygon, 25832));
INSERT INTO "My Maps"."Houses, 25"
SELECT i, 'block ' || i % 7, "Post GIS".ST_MakeEnvelope(x, y, x + 6 + i % 11, y + 7 + i % 7, 25832)
FROM generate_series(1, 140) AS i, LATERAL (SELECT (i % 7) * 1000 + i * 7919 % 307 AS x, i * 104729 % 311 AS y) AS xy;
CREATE TABLE "My Maps"."Houses 'n' Blocks" (id bigint, geom "Post GIS".geometry);
INSERT INTO "My Maps"."Houses 'n' Blocks"
SELECT b * 10 + k, "Post GIS".ST_MakeEnvelope(b * 1000 + k * 80, 0, b * 1000 + k * 80 + 60 + b, 50 + k, 25832) FROM generate_series(1, 6) AS b, generate_series(1, 2 + b % 2) AS k;

-- every call says its schema
SELECT "Typify, 1".typify_create_scale('"My Maps"."Layer 75"', '"My Maps"."Houses, 25"', '"My Maps"."Houses ''n'' Blocks"', 75000, 0.5, 'Block "A"', id_column => 'Id', geom_column => 'The Geom') AS layer;
SELECT "Typify, 1".typify_create_scale('"My Maps"."Table 75"', '"My Maps"."Houses, 25"', '"My Maps"."Houses ''n'' Blocks"', 75000, 0.5, 'Block "A"', 'table', id_column => 'Id', geom_column => 'The Geom',
	options => "Typify, 1".typify_options(shape => 'square')) AS layer;
SELECT relname, relkind, pg_get_userbyid(relowner) AS owner FROM pg_class WHERE relname ~ '^(Layer|Table) 75$' ORDER BY 1;
SELECT count(*) AS rows, sum(member_count) AS members, count(DISTINCT grp) AS groups FROM "My Maps"."Layer 75";
SELECT obj_description('"My Maps"."Table 75"'::regclass)::jsonb - 'typify' AS comment;
DELETE FROM "My Maps"."Houses, 25" WHERE "Id" IN (1, 8, 15);
SELECT "Typify, 1".typify_refresh_scale('"My Maps"."Layer 75"', true);
SELECT "Typify, 1".typify_refresh_groups('"My Maps"."Table 75"', '{block 1}') > 0 AS rows;
CALL "Typify, 1".typify_build_scale('"My Maps"."Built 75"', '"My Maps"."Houses, 25"', '"My Maps"."Houses ''n'' Blocks"', 75000, 0.5, 'Block "A"', id_column => 'Id', geom_column => 'The Geom', batch => 4,
	options => "Typify, 1".typify_options(shape => 'square'));
CREATE VIEW "My Maps".derived AS SELECT * FROM "Typify, 1".typify_derive('"My Maps"."Houses, 25"', '"My Maps"."Houses ''n'' Blocks"', 75000, 0.5, 'Block "A"', id_column => 'Id', geom_column => 'The Geom',
	options => "Typify, 1".typify_legible_options(NULL));
CREATE VIEW "My Maps".squares AS SELECT * FROM "Typify, 1".typify_derive('"My Maps"."Houses, 25"', '"My Maps"."Houses ''n'' Blocks"', 75000, 0.5, 'Block "A"', id_column => 'Id', geom_column => 'The Geom',
	options => "Typify, 1".typify_legible_options("Typify, 1".typify_options(shape => 'square')));
CREATE FUNCTION "My Maps".differing(one text, other text) RETURNS bigint LANGUAGE plpgsql AS
$$
DECLARE
	number bigint;
BEGIN
	EXECUTE format('SELECT count(*) FROM (SELECT id, geom::text, members, area, grp FROM %1$s EXCEPT ALL SELECT id, geom::text, members, area, grp FROM %2$s) AS d', one, other) INTO number;
	RETURN number;
END
$$;
SELECT "My Maps".differing('"My Maps"."Layer 75"', '"My Maps".derived') AS layer, "My Maps".differing('"My Maps"."Table 75"', '"My Maps".squares') AS "table", "My Maps".differing('"My Maps"."Built 75"', '"My Maps".squares') AS built;

CREATE TABLE "My Maps"."The Roads" AS SELECT "Post GIS".ST_SetSRID("Post GIS".ST_MakeLine("Post GIS".ST_MakePoint(0, 900), "Post GIS".ST_MakePoint(9000, 900)), 25832) AS "The Line";
SELECT buildings, reached, lost, barrier_crossings, road_angle IS NOT NULL AS road_angle, dense_groups FROM "Typify, 1".typify_quality('"My Maps"."Houses, 25"', '"My Maps"."Layer 75"', 75000, 'Block "A"', barriers => '"My Maps"."The Roads"', id_column => 'Id', geom_column => 'The Geom', barriers_geom_column => 'The Line');

-- a name without a schema goes where the caller creates things, not where typify is
SELECT "Typify, 1".typify_create_scale('nowhere', '"My Maps"."Houses, 25"', NULL, 75000, id_column => 'Id', geom_column => 'The Geom');
SET search_path = "My Maps";
SELECT "Typify, 1".typify_create_scale('somewhere', '"Houses, 25"', NULL, 75000, id_column => 'Id', geom_column => 'The Geom') AS layer;
CALL "Typify, 1".typify_build_scale('somewhere_else', '"Houses, 25"', NULL, 75000, id_column => 'Id', geom_column => 'The Geom');
SET search_path = '';
SELECT schemaname, matviewname FROM pg_matviews WHERE matviewname ~ 'where' UNION ALL SELECT schemaname, tablename FROM pg_tables WHERE tablename ~ 'where' ORDER BY 2;

-- what the role may not do fails as usual, with 42501 (insufficient_privilege)
\set VERBOSITY sqlstate
SELECT "Typify, 1".typify_create_scale('not_mine.layer', '"My Maps"."Houses, 25"', NULL, 75000, id_column => 'Id', geom_column => 'The Geom');
CALL "Typify, 1".typify_build_scale('not_mine.layer', '"My Maps"."Houses, 25"', NULL, 75000, id_column => 'Id', geom_column => 'The Geom');
RESET SESSION AUTHORIZATION;
CREATE TABLE not_mine.houses (id bigint, geom "Post GIS".geometry);
SELECT "Typify, 1".typify_create_scale('not_mine.layer', 'not_mine.houses', NULL, 75000), "Typify, 1".typify_create_scale('not_mine.layer_table', 'not_mine.houses', NULL, 75000, kind => 'table');
SET SESSION AUTHORIZATION regress_typify_cartographer;
SELECT "Typify, 1".typify_create_scale('"My Maps".of_another', 'not_mine.houses', NULL, 75000);
SELECT "Typify, 1".typify_refresh_scale('not_mine.layer');
SELECT "Typify, 1".typify_refresh_scale('not_mine.layer_table');
SELECT "Typify, 1".typify_refresh_groups('not_mine.layer_table', '{NULL}');
\set VERBOSITY default

RESET SESSION AUTHORIZATION;
\c :home
SET client_min_messages = warning;
DROP DATABASE typify_schemas;
DROP ROLE regress_typify_cartographer;
