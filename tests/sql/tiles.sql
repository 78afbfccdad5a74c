-- tiles.sql: functions that make vector tiles of a hierarchy or of stored layers
\pset null '(null)'
\set SHOW_CONTEXT never
CREATE SCHEMA typify_tiles;
SET search_path = typify_tiles, public;
\i tests/data/error_of.sql

-- 400 buildings in 12 blocks and the NULL block, near 49 degrees north
CREATE TABLE buildings (id bigint PRIMARY KEY, block integer, class text, floors integer, "Tile" numeric,
	geom geometry(Polygon, 25832));
INSERT INTO buildings
SELECT i, nullif(i % 13, 0), 'class ' || i % 3, i % 7, i / 2.0, ST_MakeEnvelope(x, y, x + 6 + i % 11, y + 7 + i % 7, 25832)
FROM generate_series(1, 400) AS i, LATERAL (SELECT 500000 + (i % 13) % 4 * 1000 + i * 7919 % 907 AS x,
	5430000 + (i % 13) / 4 * 1000 + i * 104729 % 911 AS y) AS xy;
CREATE INDEX ON buildings USING gist (geom);
CALL typify_build_hierarchy('any_scale', 'buildings', 0.5, 'block');

-- the tile that holds the middle of the buildings
CREATE FUNCTION pg_temp.tile(z integer, OUT x integer, OUT y integer) LANGUAGE sql AS $$
	SELECT floor((public.ST_X(p) + 20037508.342789244) / 40075016.685578488 * 2 ^ z),
		floor((20037508.342789244 - public.ST_Y(p)) / 40075016.685578488 * 2 ^ z)
	FROM public.ST_Transform((SELECT public.ST_Centroid(public.ST_Collect(geom)) FROM typify_tiles.buildings), 3857) AS p $$;

-- the scale of a zoom
SELECT zoom, latitude, round(typify_zoom_scale(zoom, latitude)::numeric, 3) AS scale,
	round(typify_zoom_scale(zoom, latitude, 256)::numeric, 3) AS of_raster_tiles
FROM (VALUES (0, 0), (11, 49.5), (11.5, 49.5), (12, -60)) AS v (zoom, latitude);

SELECT typify_create_tile_function('typify_tiles', 'tiles', 'any_scale');
SELECT typify_create_tile_function('typify_tiles', 'tiles_with', 'any_scale', attributes => '{class,floors,"Tile"}',
	min_side => 0.5, max_zoom => 15, layer => 'houses');

-- what pg_tileserv and Martin look for: the types and names of the arguments, and the type that is returned
CREATE FUNCTION pg_temp.published() RETURNS SETOF regprocedure LANGUAGE sql AS $$
	SELECT oid::regprocedure FROM pg_proc
	WHERE prorettype = 'bytea'::regtype AND pronargs BETWEEN 3 AND 4 AND proargtypes[0] = 'integer'::regtype
		AND proargtypes[1] = 'integer'::regtype AND proargtypes[2] = 'integer'::regtype
		AND lower(proargnames[1]) IN ('z', 'zoom') AND lower(proargnames[2]) = 'x' AND lower(proargnames[3]) = 'y'
		AND (pronargs = 3 OR proargtypes[3] IN ('json'::regtype, 'jsonb'::regtype)) $$;
SELECT count(*) FILTER (WHERE proname ~ '^(st_|_|typify_)' ) AS of_extensions, array_agg(proname ORDER BY proname) AS published
FROM pg_proc WHERE oid IN (SELECT pg_temp.published());
SELECT proname, provolatile, proparallel, proisstrict, prosecdef, pronargdefaults, pg_get_function_arguments(oid),
	EXISTS (SELECT FROM pg_depend WHERE classid = 'pg_proc'::regclass AND objid = pg_proc.oid AND deptype = 'e') AS of_an_extension
FROM pg_proc WHERE oid IN (SELECT pg_temp.published()) ORDER BY proname;
SELECT jsonb_pretty(obj_description('tiles_with'::regproc, 'pg_proc')::jsonb #- '{typify,version}') AS comment;

-- any search_path, and a session that has seen nothing of typify
SET search_path = pg_catalog;
SELECT length(typify_tiles.tiles(12, x, y)) > 1000 AS found FROM pg_temp.tile(12);
SET search_path = typify_tiles, public;

-- the features, as they lie in the protocol's bytes: one for each node alive at its group's scale
CREATE FUNCTION pg_temp.features(tile bytea, layer text) RETURNS bigint LANGUAGE sql AS $$
	-- a feature begins with the tag 0x12; its polygon type is the two bytes 0x1803
	SELECT count(*) FROM regexp_matches(encode(tile, 'hex'), '1803', 'g') $$;
SELECT z, (SELECT count(*) FROM any_scale AS n JOIN any_scale_groups AS g USING (group_id)
	WHERE n.scale_from <= greatest(25000, typify_zoom_scale(z, latitude))
		AND n.scale_to > greatest(25000, typify_zoom_scale(z, latitude))) AS alive,
	sum(pg_temp.features(tiles(z, a, b), 'tiles')) >= (SELECT count(*) FROM any_scale AS n JOIN any_scale_groups AS g USING (group_id)
	WHERE n.scale_from <= greatest(25000, typify_zoom_scale(z, latitude))
		AND n.scale_to > greatest(25000, typify_zoom_scale(z, latitude))) AS all_there
FROM generate_series(8, 12, 2) AS z, pg_temp.tile(z) AS t, generate_series(t.x - 1, t.x + 1) AS a,
	generate_series(t.y - 1, t.y + 1) AS b
GROUP BY z ORDER BY z;

-- half a zoom further in, and what finer may be
SELECT finer, (pg_temp.features(tiles(11, x, y, json_build_object('finer', finer)), 'tiles')
	= pg_temp.features(tiles(11, x, y, json_build_object('finer', finer::text)), 'tiles')) AS number_or_text,
	pg_temp.features(tiles(11, x, y, json_build_object('finer', finer)), 'tiles')
	> pg_temp.features(tiles(11, x, y), 'tiles') AS more
FROM (VALUES (0), (0.5), (1)) AS v (finer), pg_temp.tile(11);
SELECT pg_temp.error_of(format('SELECT tiles(11, 1000, 700, %L)', query)) AS error
FROM unnest(ARRAY['{"finer": 2}', '{"finer": -0.5}', '{"finer": "NaN"}', '{"finer": "much"}']) AS query;
SELECT length(tiles(11, x, y, '{"other": 7}')) = length(tiles(11, x, y)) AS others_count_not,
	length(tiles(11, x, y, '[]')) = length(tiles(11, x, y)) AS nor_does_a_list FROM pg_temp.tile(11);

-- attributes, and the name of the layer
SELECT z, position('\x636c6173732031'::bytea IN tiles_with(z, x, y)) > 0 AS class_1, position('houses'::bytea IN tiles_with(z, x, y)) > 0 AS layer,
	position('floors'::bytea IN tiles_with(z, x, y)) > 0 AS floors, position('member_count'::bytea IN tiles_with(z, x, y)) > 0 AS member_count,
	position('class'::bytea IN tiles(z, x, y)) > 0 AS without
FROM unnest(ARRAY[9, 12, 14]) AS z, pg_temp.tile(z);

-- no buildings, no zoom, no tile
SELECT z, x, y, length(tiles(z, x, y)) AS bytes
FROM (VALUES (0, 0, 0), (5, 0, 0), (12, 4000, 4000), (19, 270000, 180000), (14, 8700, 16383)) AS v (z, x, y) ORDER BY z;
SELECT length(tiles_with(16, x, y)) AS above_max_zoom FROM pg_temp.tile(16);
SELECT tiles(NULL, 1, 1) AS z, tiles(1, NULL, 1) AS x, tiles(1, 1, NULL) AS y, tiles(1, 1, 1, NULL) AS query;
SELECT pg_temp.error_of(format('SELECT tiles(%s)', tile)) AS error
FROM unnest(ARRAY['3, 8, 0', '3, 0, -1', '-1, 0, 0', '31, 0, 0']) AS tile;

-- a polygon is that of the projection, rounded; and the same from two tiles that lie side by side
CREATE FUNCTION pg_temp.polygons(z integer, x integer, y integer) RETURNS TABLE (id bigint, polygon geometry, slow geometry)
LANGUAGE sql AS $$
	WITH placeholder AS (
		SELECT n.*, psi, scale, (typify_node_placeholder(representative, n.x, n.y, area, ratio, ux, uy, member_count, kept, scale,
			typify_options(min_side => 0.85), psi, 25832, 1)).geom
		FROM any_scale AS n JOIN any_scale_groups AS g USING (group_id),
			LATERAL (SELECT greatest(25000, typify_zoom_scale(polygons.z, latitude)) AS scale) AS s
		WHERE scale_from <= scale AND scale_to > scale
	), lattice AS MATERIALIZED (
		SELECT typify_tile_lattice(ST_XMin(e) - polygons.x % 7 * 1000, ST_YMin(e), ST_XMax(e), ST_YMax(e) + polygons.y % 7 * 1000, 25832,
			polygons.z, 1) AS lattice
		FROM (SELECT ST_Extent(geom) AS e FROM placeholder) AS e
	), frame AS MATERIALIZED (
		SELECT typify_tile_frame(lattice, ST_Transform(lattice, 3857), polygons.z, polygons.x, polygons.y) AS frame FROM lattice
	)
	SELECT representative, typify_tile_node(representative, p.x, p.y, area, ratio, ux, uy, member_count, kept, scale,
			typify_options(min_side => 0.85), psi, 25832, 1, frame),
		ST_AsMVTGeom(ST_Transform(geom, 3857), ST_TileEnvelope(polygons.z, polygons.x, polygons.y), 4096, 64, false)
	FROM placeholder AS p, frame $$;
SELECT z, count(*) > 20 AS many, max(greatest(abs(ST_XMin(polygon) - ST_XMin(slow)), abs(ST_XMax(polygon) - ST_XMax(slow)),
		abs(ST_YMin(polygon) - ST_YMin(slow)), abs(ST_YMax(polygon) - ST_YMax(slow)))) <= 1 AS within_a_unit,
	bool_and(ST_IsValid(polygon) AND ST_NPoints(polygon) = 5 AND ST_SRID(polygon) = 0) AS sound
FROM generate_series(7, 12) AS z, pg_temp.tile(z), LATERAL pg_temp.polygons(z, x, y) WHERE polygon IS NOT NULL GROUP BY z ORDER BY z;
CREATE TEMP TABLE seen AS
SELECT z, u, v, id, polygon FROM generate_series(12, 14) AS z, pg_temp.tile(z), generate_series(x - 1, x + 1) AS u,
	generate_series(y - 1, y + 1) AS v, LATERAL pg_temp.polygons(z, u, v) WHERE polygon IS NOT NULL;
SELECT count(*) >= 20 AS across_borders, bool_and(ST_AsText(a.polygon) = ST_AsText(ST_Translate(b.polygon, 4096 * (b.u - a.u), 4096 * (b.v - a.v)))) AS same
FROM seen AS a JOIN seen AS b USING (z, id) WHERE (a.u, a.v) < (b.u, b.v);

-- other coordinate systems: in feet, in Web Mercator itself, and one whose grid is turned
CREATE TABLE others (name text, srid integer);
INSERT INTO spatial_ref_sys (srid, proj4text) VALUES (990101, '+proj=tmerc +lat_0=48 +lon_0=9 +ellps=GRS80 +units=ft +no_defs');
INSERT INTO others VALUES ('in_feet', 990101), ('in_web_mercator', 3857), ('turned', 31467), ('in_laea', 3035);
SELECT format('CREATE TABLE %I AS SELECT id, block, ST_Transform(geom, %s) AS geom FROM buildings', name, srid) FROM others \gexec
SELECT format('CALL typify_build_hierarchy(%L, %L, 0.5, ''block'')', name || '_h', name) FROM others \gexec
SELECT count(typify_create_tile_function('typify_tiles', name || '_tiles', (name || '_h')::regclass)) AS created FROM others;
SELECT z, pg_temp.features(in_feet_tiles(z, x, y), '') = pg_temp.features(tiles(z, x, y), '') AS in_feet,
	pg_temp.features(turned_tiles(z, x, y), '') = pg_temp.features(tiles(z, x, y), '') AS turned,
	pg_temp.features(in_web_mercator_tiles(z, x, y), '') > 0 AS in_web_mercator,
	pg_temp.features(in_laea_tiles(z, x, y), '') > 0 AS in_laea
FROM unnest(ARRAY[6, 9, 10]) AS z, pg_temp.tile(z);

-- stored layers, alone and before a hierarchy
SELECT typify_create_scale('layer12', 'buildings', NULL, typify_zoom_scale(12, 49), 0.5, 'block') AS layer,
	typify_create_scale('layer11', 'buildings', NULL, 90000, 0.5, 'block') AS layer;
SELECT typify_create_tile_function('typify_tiles', 'of_layers', NULL, '{class}', layers => '{layer12,layer11}', layer => 'l');
SELECT typify_create_tile_function('typify_tiles', 'of_both', 'any_scale', layers => '{layer11}', layer => 'l');
SELECT z, pg_temp.features(of_layers(z, x, y), 'l') > 0 AS of_layers, pg_temp.features(of_both(z, x, y), 'l') > 0 AS of_both
FROM generate_series(10, 13) AS z, pg_temp.tile(z) ORDER BY z;

-- after a change of the buildings the function goes on with what the hierarchy has
UPDATE buildings SET class = 'new' WHERE class = 'class 1';
SELECT position('new'::bytea IN tiles_with(12, x, y)) > 0 AS joined_anew FROM pg_temp.tile(12);

-- bad input
CREATE TABLE no_hierarchy (id bigint, geom geometry);
CREATE TABLE srid_0 AS SELECT id, ST_SetSRID(geom, 0) AS geom FROM buildings;
CALL typify_build_hierarchy('of_srid_0', 'srid_0');
CREATE TABLE gone AS SELECT * FROM buildings;
CALL typify_build_hierarchy('of_gone', 'gone');
DROP TABLE gone;
SELECT pg_temp.error_of('SELECT typify_create_tile_function(' || arguments || ')') AS error
FROM unnest(ARRAY[
	$$'typify_tiles', 'tiles', 'any_scale'$$,
	$$'nowhere', 't', 'any_scale'$$,
	$$NULL, 't', 'any_scale'$$,
	$$'typify_tiles', NULL, 'any_scale'$$,
	$$'typify_tiles', 't', NULL$$,
	$$'typify_tiles', 't', 'no_hierarchy'$$,
	$$'typify_tiles', 't', 'of_srid_0'$$,
	$$'typify_tiles', 't', 'of_gone'$$,
	$$'typify_tiles', 't', 'any_scale', NULL$$,
	$$'typify_tiles', 't', 'any_scale', '{nothing}'$$,
	$$'typify_tiles', 't', 'any_scale', '{class,class}'$$,
	$$'typify_tiles', 't', 'any_scale', '{geom}'$$,
	$$'typify_tiles', 't', 'any_scale', min_side => -1$$,
	$$'typify_tiles', 't', 'any_scale', min_side => NULL$$,
	$$'typify_tiles', 't', 'any_scale', max_area => 'Infinity'$$,
	$$'typify_tiles', 't', 'any_scale', min_zoom => 9, max_zoom => 8$$,
	$$'typify_tiles', 't', 'any_scale', max_zoom => 31$$,
	$$'typify_tiles', 't', 'any_scale', tile_size => 0$$,
	$$'typify_tiles', 't', NULL, layers => '{}'$$,
	$$'typify_tiles', 't', NULL, layers => '{any_scale}'$$,
	$$'typify_tiles', 't', NULL, layers => '{layer11,layer11}'$$
]) AS arguments;
SELECT pg_temp.error_of(call) AS error
FROM unnest(ARRAY[
	$$SELECT typify_tile_lattice(0, 0, 1e9, 1e9, 25832, 12, 1)$$,
	$$SELECT typify_tile_lattice(0, 0, 'NaN', 1, 25832, 12, 1)$$,
	$$SELECT typify_tile_lattice(0, 0, 1, 1, 25832, 40, 1)$$,
	$$SELECT typify_tile_lattice(0, 0, 1, 1, 25832, 12, 0)$$,
	$$SELECT typify_tile_frame('LINESTRING(0 0, 1 1)', 'LINESTRING(0 0, 1 1)', 0, 0, 0)$$,
	$$SELECT typify_tile_frame('POINT(0 0)', 'LINESTRING(0 0, 1 1)', 0, 0, 0)$$,
	$$SELECT typify_tile_frame('LINESTRING EMPTY', 'LINESTRING EMPTY', 0, 0, 0)$$,
	$$SELECT typify_tile_node(1, 0, 0, 1, 1, 1, 0, 1, false, 25000, NULL, NULL, 25832, 1, '\x00')$$
]) AS call;

SET client_min_messages = warning;
DELETE FROM spatial_ref_sys WHERE srid = 990101;
DROP SCHEMA typify_tiles CASCADE;
