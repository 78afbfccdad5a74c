-- hierarchies.sql: the fear: what a hierarchy shows at a scale is not what the aggregate gives there
\set ECHO none
\i tests/data/settlement.sql
\set ECHO all
\i tests/data/error_of.sql
SET client_min_messages = warning;

-- life spans end at the very number at which the count falls
CREATE FUNCTION pg_temp.just_before(float8) RETURNS float8 LANGUAGE sql AS 'SELECT $1 * 0.99999999999999988898';
CREATE TEMP TABLE law AS
SELECT name, typify_options(exponent => exponent, source_scale => m25, lod200_scale => m200) AS options
FROM (VALUES ('default', NULL::float8, NULL::float8, NULL::float8), ('as printed', 1, NULL, NULL), ('none', 0, NULL, NULL),
	('calibrated', 1.3183, NULL, NULL), ('steep', 7.25, 10000, 123456.789)) AS v (name, exponent, m25, m200);
SELECT name, n, count(*) FILTER (WHERE typify_count(n, scale, options) >= c) AS not_below_at, count(*) FILTER (WHERE
	scale > coalesce((options).source_scale, 25000) AND typify_count(n, pg_temp.just_before(scale), options) < c) AS below_before
FROM law, unnest(ARRAY[2, 7, 40, 1677]) AS n, generate_series(2, n) AS c,
	LATERAL (SELECT typify_scale_below(n, c, options) AS scale OFFSET 0) AS s GROUP BY name, n ORDER BY name, n;
SELECT typify_count(40, 50000) AS forty_at_50000, typify_scale_below(40, 21) <= 50000 AS fewer_than_21_by_then,
	typify_scale_below(40, 20) > 50000 AS fewer_than_20_only_later, typify_scale_below(40, 41) AS fewer_than_41,
	typify_scale_below(40, 1) AS fewer_than_1, typify_scale_below(0, 1) AS of_none;
SELECT pg_temp.error_of(call) FROM unnest(ARRAY['SELECT typify_scale_below(-1, 1)', 'SELECT typify_scale_below(1, -1)',
	'SELECT typify_scale_below(9, 3, typify_options(count => 3))', 'SELECT typify_scale_below(9, 3, typify_options(exponent => ''NaN''))']) AS call;

-- three houses: the nearer two are merged first
SELECT node, parent, kept, representative AS rep, member_count AS n, first_leaf AS first, x, y, area, ratio, ux, uy, cost,
	round(scale_from::numeric, 3) AS scale_from, round(scale_to::numeric, 3) AS scale_to
FROM unnest((SELECT typify_hierarchy(ST_MakeEnvelope(x, 0, x + 8, h), id, 0) FROM (VALUES (1, 0, 4), (2, 10, 2), (3, 30, 1)) AS b (id, x, h))) ORDER BY node;

-- at every scale what typify_placeholders gives, bit for bit
CREATE FUNCTION pg_temp.unlike(s_u float8, options typify_options, kept bigint, OUT scales bigint, OUT other_count bigint, OUT unlike bigint)
LANGUAGE plpgsql AS $$
BEGIN
	CREATE TEMP TABLE node AS SELECT n.* FROM (SELECT unnest(typify_hierarchy(geom, id, s_u, options, CASE id WHEN kept THEN 'Infinity'::float8 END)) AS m FROM hamlet) AS h
		CROSS JOIN LATERAL (SELECT (m).*) AS n;
	WITH drawn AS MATERIALIZED (
		SELECT scale, (p).id, (p).geom::text, (p).member_count, (SELECT array_agg(l.representative ORDER BY l.representative) FROM node AS l
			WHERE l.node BETWEEN d.first_leaf AND d.first_leaf + d.member_count - 1) AS members, (p).area, (p).width, (p).length, (p).orientation
		FROM (SELECT scale, n.*, typify_node_placeholder(n.representative, n.x, n.y, n.area, n.ratio, n.ux, n.uy, n.member_count, n.kept, scale, options, NULL, 25832, 1) AS p
			FROM (SELECT DISTINCT scale_from AS scale FROM node) AS s JOIN node AS n ON n.scale_from <= scale AND n.scale_to > scale OFFSET 0) AS d
	), wanted AS MATERIALIZED (
		SELECT scale, p.id, p.geom::text, p.member_count, p.members, p.area, p.width, p.length, p.orientation
		FROM (SELECT scale, typify_placeholders(geom, id, scale, s_u, options, CASE id WHEN kept THEN 'Infinity'::float8 END) AS list
			FROM hamlet, (SELECT DISTINCT scale_from AS scale FROM node) AS s GROUP BY scale) AS t, unnest(list) AS p
	)
	SELECT count(*), count(*) FILTER (WHERE rows <> typify_count(41, scale, options)), (SELECT count(*) FROM ((TABLE drawn EXCEPT ALL TABLE wanted) UNION ALL (TABLE wanted EXCEPT ALL TABLE drawn)) AS d)
	INTO scales, other_count, unlike FROM (SELECT scale, count(*) AS rows FROM drawn GROUP BY scale) AS s;
	DROP TABLE node;
END $$;
SELECT name, s_u, u.* FROM (VALUES ('plain', NULL, NULL), ('median', typify_options(area_statistic => 'median'), NULL), ('sum', typify_options(area_statistic => 'sum'), NULL),
	('square', typify_options(shape => 'square', exponent => 1), NULL), ('legible', typify_options(min_side => 0.35, psi => 1), NULL),
	('one is kept', typify_options(exponent => 3), (SELECT min(id) + 7 FROM hamlet)),
	('barriers', (SELECT typify_options(barriers => ST_SetSRID(ST_MakeLine(ST_MakePoint(ST_XMin(e), ST_YMin(e)), ST_MakePoint(ST_XMax(e), ST_YMax(e))), 25832)) FROM (SELECT ST_Extent(geom) AS e FROM hamlet) AS x), NULL)) AS o (name, options, kept),
	unnest(ARRAY[0, 0.5, 1]::float8[]) AS s_u, LATERAL pg_temp.unlike(s_u, options, kept) AS u ORDER BY name, s_u;

-- the same bytes from parallel workers and in any order of rows
CREATE TEMP TABLE serial AS SELECT md5(typify_hierarchy(geom, id, 0.5)::text) AS h, md5(typify_hierarchy(geom, id, 0.5 ORDER BY id * 7919 % 1677)::text) AS shuffled FROM settlement_buildings;
SET parallel_setup_cost = 0;
SET parallel_tuple_cost = 0;
SET min_parallel_table_scan_size = 0;
SET max_parallel_workers_per_gather = 2;
ALTER TABLE settlement_buildings SET (parallel_workers = 2);
SELECT h = shuffled AS same_in_any_order, h = (SELECT md5(typify_hierarchy(geom, id, 0.5)::text) FROM settlement_buildings) AS same_in_parallel FROM serial;
RESET parallel_setup_cost;
RESET parallel_tuple_cost;
RESET min_parallel_table_scan_size;
RESET max_parallel_workers_per_gather;

-- a table of nodes; its look-ups are what typify_derive gives
CALL typify_build_hierarchy('town', 'settlement_buildings', 0.5, 'block', batch => 20);
SELECT obj_description('town'::regclass)::jsonb - ARRAY['typify', 'source', 'reach', 'top'] AS comment;
SELECT count(*) AS groups, sum(count) AS buildings, count(*) FILTER (WHERE built) AS built, (SELECT count(*) FROM town) AS nodes FROM town_groups;
CREATE FUNCTION pg_temp.differing(a text, b text) RETURNS bigint LANGUAGE plpgsql AS $$
DECLARE
	rows bigint;
BEGIN
	EXECUTE format('WITH a AS MATERIALIZED (%s), b AS MATERIALIZED (%s) SELECT count(*) FROM ((TABLE a EXCEPT ALL TABLE b) UNION ALL (TABLE b EXCEPT ALL TABLE a)) AS d', a, b) INTO rows;
	RETURN rows;
END $$;
SELECT scale, pg_temp.differing(format('SELECT * FROM typify_at(''town'', %s)', scale), format('SELECT * FROM typify_derive(''settlement_buildings'', NULL, %s, 0.5, ''block'')', scale)) AS unlike
FROM unnest(ARRAY[25000, 33333, 75000, 200000, 777777, 1e9]) AS scale;
-- in a box: every placeholder whose polygon meets it, also from without, and nothing else
CREATE TEMP TABLE box AS SELECT scale, ST_MakeEnvelope(x, y, x + scale / 500, y + scale / 700, 25832) AS box
FROM (SELECT ST_XMin(geom) AS x, ST_YMin(geom) AS y FROM settlement_buildings WHERE id % 100 = 0) AS b, unnest(ARRAY[25000, 60000, 300000]) AS scale;
CREATE TEMP TABLE shown AS SELECT scale, a.* FROM unnest(ARRAY[25000, 60000, 300000]) AS scale, typify_at('town', scale, with_members => false) AS a;
SELECT scale, count(*) AS boxes, sum(found) > 40 AS many, sum(wrong) AS wrong, sum(from_without) > 0 AS some_from_without
FROM (SELECT scale, (SELECT count(*) FROM typify_at('town', scale, box, false)) AS found,
	pg_temp.differing(format('SELECT id, geom FROM typify_at(''town'', %s, %L, false)', scale, box), format('SELECT id, geom FROM shown WHERE scale = %s AND ST_Intersects(geom, %L)', scale, box)) AS wrong,
	(SELECT count(*) FROM shown WHERE shown.scale = box.scale AND ST_Intersects(geom, box) AND NOT ST_Intersects(ST_Centroid(geom), box)) AS from_without FROM box) AS b GROUP BY scale ORDER BY scale;
SELECT pg_temp.differing('SELECT * FROM typify_at(''town'', 75000, ST_MakeEnvelope(-1e12, -1e12, 1e12, 1e12, 25832))', 'SELECT * FROM typify_at(''town'', 75000)') AS unlike_in_a_box_of_everything;
-- by the index, whatever the planner thinks of so small a table
SET enable_seqscan = off;
CREATE FUNCTION pg_temp.plan() RETURNS SETOF text LANGUAGE plpgsql AS $$
DECLARE
	look record := typify_hierarchy_lookup('town', 75000, (SELECT box FROM box LIMIT 1));
BEGIN
	RETURN QUERY EXECUTE 'EXPLAIN ' || typify_lookup_query(look.nodes, look.groups, true, true)
		USING 75000::float8, look.options, look.srid, look.metres_per_unit, look.areas, (SELECT box FROM box LIMIT 1);
END $$;
SELECT count(*) FILTER (WHERE line ~ 'town_place_idx') > 0 AS by_place, count(*) FILTER (WHERE line ~ 'town_pkey') > 0 AS members_by_key,
	count(*) FILTER (WHERE line ~ 'Seq Scan on town ') AS scans FROM pg_temp.plan() AS line;
RESET enable_seqscan;

-- ranked over all groups: as many as the law leaves of all, but one in each group; the order of merges is that of costs
CALL typify_build_hierarchy('ranked', 'settlement_buildings', 0.5, 'block', life_spans => 'ranked');
SELECT scale, (SELECT count(*) FROM typify_at('ranked', scale, with_members => false)) - greatest(typify_count(1677, scale), 71) AS too_many
FROM unnest(ARRAY[25000, 40000, 75000, 200000, 300000, 1e7]) AS scale;
SELECT count(*) AS out_of_order FROM (SELECT scale_from, lag(scale_from) OVER (ORDER BY cost, grp COLLATE "C", node) AS before FROM ranked JOIN ranked_groups AS g USING (group_id) WHERE node >= g.count) AS n WHERE scale_from < before;

-- with points and one house: what has no size is a row without geometry, found by its place
CREATE TABLE sparse AS SELECT i AS id, ST_SetSRID(CASE WHEN i < 4 THEN ST_MakePoint(100 * i, 0) ELSE ST_MakeEnvelope(1000, 0, 1010, 10) END, 25832) AS geom FROM generate_series(1, 4) AS i;
CALL typify_build_hierarchy('few', 'sparse');
SELECT id, ST_AsText(geom) AS geom, member_count, members, area FROM typify_at('few', 25000, ST_MakeEnvelope(50, -10, 250, 10, 25832)) ORDER BY id;
CREATE TABLE nobody (id bigint, geom geometry(Point, 25832));
CALL typify_build_hierarchy('none', 'nobody');
SELECT count(*) AS of_nobody FROM typify_at('none', 50000);

-- names in quotes, in a schema that is on no search_path
CREATE SCHEMA "My Maps";
CREATE VIEW "My Maps"."Houses and %" AS SELECT id AS "Id", geom AS "Shape", block AS "In" FROM settlement_buildings WHERE block < 5;
CALL typify_build_hierarchy('"My Maps"."Tree 1"', '"My Maps"."Houses and %"', 1, 'In', life_spans => 'ranked', id_column => 'Id', geom_column => 'Shape');
SELECT count(*) - typify_count((SELECT count(*) FROM "My Maps"."Houses and %"), 60000) AS too_many, min(cardinality(members)) AS least FROM typify_at('"My Maps"."Tree 1"', 60000);
CREATE OR REPLACE VIEW "My Maps"."Houses and %" AS SELECT id AS "Id", geom AS "Shape", block AS "In" FROM settlement_buildings WHERE block < 4 AND id % 9 > 0;
SELECT count(*) > 0 AS stale FROM typify_refresh_hierarchy('"My Maps"."Tree 1"');
SELECT count(*) - typify_count((SELECT count(*) FROM "My Maps"."Houses and %"), 60000) AS too_many FROM typify_at('"My Maps"."Tree 1"', 60000);
DROP SCHEMA "My Maps" CASCADE;

-- bad input
SELECT pg_temp.error_of(call) FROM unnest(ARRAY[
	$$SELECT * FROM typify_at(NULL, 50000)$$, $$SELECT * FROM typify_at('settlement_buildings', 50000)$$, $$SELECT * FROM typify_at('town_groups', 50000)$$,
	$$SELECT * FROM typify_at('town', NULL)$$, $$SELECT * FROM typify_at('town', 24999)$$, $$SELECT * FROM typify_at('town', 'Infinity')$$,
	$$SELECT * FROM typify_at('town', 50000, ST_SetSRID('POLYGON EMPTY'::geometry, 25832))$$, $$SELECT * FROM typify_at('town', 50000, ST_MakeEnvelope(0, 0, 1, 1, 4326))$$,
	$$SELECT * FROM typify_at('town', 50000, ST_SetSRID(ST_MakePoint('NaN', 0), 25832))$$, $$SELECT * FROM typify_at('town', 50000, with_members => NULL)$$,
	$$SELECT * FROM typify_refresh_hierarchy('sparse')$$, $$SELECT * FROM typify_refresh_hierarchy('town', min_zoom => 9, max_zoom => 8)$$,
	$$SELECT * FROM typify_refresh_hierarchy('town', min_side => -1)$$, $$CALL typify_build_hierarchy('h', 'sparse', batch => 0)$$, $$CALL typify_build_hierarchy('town', 'sparse')$$,
	$$CALL typify_build_hierarchy('sparse', 'sparse')$$, $$CALL typify_build_hierarchy('a b', 'sparse')$$, $$CALL typify_build_hierarchy('h', 'sparse', 2)$$,
	$$CALL typify_build_hierarchy('h', 'sparse', 0, 'nix')$$, $$CALL typify_build_hierarchy('h', NULL)$$, $$CALL typify_build_hierarchy('h', 'sparse', life_spans => 'total')$$,
	$$CALL typify_build_hierarchy('h', 'sparse', life_spans => NULL)$$, $$CALL typify_build_hierarchy('h', 'sparse', options => typify_options(min_gap => 0.2))$$,
	$$CALL typify_build_hierarchy('h', 'sparse', options => typify_options(count => 3))$$, $$SELECT typify_hierarchy(geom, id, NULL) FROM sparse$$,
	$$SELECT typify_hierarchy(geom, 1, 0) FROM sparse$$, $$SELECT typify_hierarchy(geom, id, 0, typify_options(min_distance => 3)) FROM sparse$$,
	$$SELECT typify_hierarchy(geom, id, 0, typify_options(count_rule => 'black_white')) FROM sparse$$, $$SELECT typify_hierarchy(geom, id, 0, typify_options(keep_area => 1)) FROM sparse$$,
	$$SELECT typify_hierarchy(geom, id, 0, typify_options(min_area => 1)) FROM sparse$$, $$SELECT typify_hierarchy(geom, id, 0, typify_options(alignment => 1)) FROM sparse$$,
	$$SELECT typify_hierarchy(geom, id, 0, typify_options(shape => 'footprint')) FROM sparse$$, $$SELECT typify_hierarchy(geom, id, id) FROM sparse$$]) AS call;
COMMENT ON TABLE town IS '{"typify": "0.1.0", "source": "x", "s_u": 0, "options": null, "life_spans": "each_group", "finished": false}';
SELECT pg_temp.error_of('SELECT * FROM typify_at(''town'', 50000)'), pg_temp.error_of('SELECT * FROM typify_refresh_hierarchy(''town'')');
ALTER TABLE few_groups RENAME TO lost;
SELECT pg_temp.error_of('SELECT * FROM typify_at(''few'', 50000)');
DROP TABLE town, town_groups, ranked, ranked_groups, few, lost, none, none_groups, sparse, nobody;
DROP VIEW hamlet;
DROP TABLE settlement_buildings, settlement_roads, settlement_blocks;
