-- barriers.sql: nothing is merged across a barrier, whatever form the call and the barrier have
\pset null '(null)'
\i tests/data/error_of.sql

-- two rows of five houses, 12 apart, on both sides of y = 9; id = 10 * row + place
CREATE TABLE typify_test_house AS
SELECT r * 10 + i AS id, ST_SetSRID(ST_MakeEnvelope(i * 10, r * 12, i * 10 + 6, r * 12 + 6), 2056) AS geom
FROM generate_series(0, 4) AS i, generate_series(0, 1) AS r;
CREATE FUNCTION pg_temp.members(barriers text, scale float8 DEFAULT 100000, s_u float8 DEFAULT 0, among text DEFAULT 'true') RETURNS text
LANGUAGE plpgsql AS $$
DECLARE
	answer text;
BEGIN
	EXECUTE format('SELECT string_agg((p).members::text, '' '' ORDER BY (p).members)
		FROM (SELECT unnest(typify_placeholders(geom, id, $1, $2, typify_options(barriers => ST_GeomFromText($3, 2056)))) AS p FROM typify_test_house WHERE %s) AS q', among)
	INTO answer USING scale, s_u, barriers;
	RETURN answer;
END $$;

-- a river between the rows; away from them; with a gap; none
SELECT what, pg_temp.members(lines) AS members FROM (VALUES
	(1, 'none', NULL),
	(2, 'empty', 'LINESTRING EMPTY'),
	(3, 'far away', 'LINESTRING(-1000 500,1000 500)'),
	(4, 'between the rows', 'LINESTRING(-10 9,60 9)'),
	(5, 'between the columns', 'MULTILINESTRING((28 -10,28 30),(-10 1000,60 1000))'),
	(6, 'with a gap', 'MULTILINESTRING((-10 9,18 9),(28 9,60 9))'),
	(7, 'an island', 'POLYGON((9 -1,17 -1,17 7,9 7,9 -1))'),
	(8, 'in a collection', 'GEOMETRYCOLLECTION(POINT(3 3),GEOMETRYCOLLECTION(LINESTRING(-10 9,60 9)),POLYGON EMPTY)'),
	(9, 'with Z', 'LINESTRING Z (-10 9 1,60 9 2)'),
	(10, 'cell by cell', 'MULTILINESTRING((-10 9,60 9),(8 -10,8 30),(18 -10,18 30),(28 -10,28 30),(38 -10,38 30))')
) AS v (number, what, lines) ORDER BY number;

-- through a gap in it, once the two that see each other through it are the closest
SELECT pg_temp.members('MULTILINESTRING((-10 9,18 9),(28 9,60 9))', 200000) AS with_a_gap, pg_temp.members('LINESTRING(-10 9,60 9)', 200000) AS without;

-- the count is not reached then
SELECT s AS scale, typify_count(10, s) AS count, ST_NumGeometries(typify(geom, s, 0, typify_options(barriers => 'SRID=2056;LINESTRING(-10 9,60 9)'))) AS placeholders
FROM typify_test_house, unnest(ARRAY[50000, 100000, 200000, 1000000]) AS s GROUP BY s ORDER BY s;

-- on a line, along it, through its joint: the right side of it, the upper one of a horizontal line
SELECT what, pg_temp.members(lines, 200000) AS members FROM (VALUES
	(1, 'along the lower row', 'LINESTRING(-10 3,60 3)'),
	(2, 'along the upper row', 'LINESTRING(-10 15,60 15)'),
	(3, 'joints on the centres', 'LINESTRING(-10 3,3 3,13 3,23 3,33 3,43 3,60 3)'),
	(4, 'up the third column', 'LINESTRING(23 -10,23 30)'),
	(5, 'ends on a centre', 'LINESTRING(23 -10,23 3)'),
	(6, 'through a joint', 'LINESTRING(-10 9,23 9,60 9)')
) AS v (number, what, lines) ORDER BY number;

-- a minimum distance is kept inside of a cell alone
SELECT pg_temp.members(NULL, 100000, 0, 'id < 5') AS law, (SELECT string_agg((p).members::text, ' ' ORDER BY (p).members) FROM (
	SELECT unnest(typify_placeholders(geom, id, 100000, 0, typify_options(min_distance => 13, barriers => 'SRID=2056;LINESTRING(28 -10,28 30)'))) AS p
	FROM typify_test_house WHERE id < 5) AS q) AS thirteen_apart;

-- every form: aggregates, window, beside the options; any order of rows
CREATE TABLE typify_test_lines AS SELECT 'SRID=2056;MULTILINESTRING((-10 9,60 9),(28 -10,28 30))'::geometry AS geom;
SELECT ST_AsText(typify(geom, 200000, 0, (SELECT typify_options(barriers => geom) FROM typify_test_lines)), 1) AS collection FROM typify_test_house;
SELECT (p).members, round((p).area::numeric, 3) AS area, ST_AsText(ST_Centroid((p).geom), 1) AS centre
FROM (SELECT unnest(typify_placeholders(geom, id, 200000, 0, (SELECT typify_options(barriers => geom) FROM typify_test_lines))) AS p FROM typify_test_house) AS q ORDER BY 1;
SELECT array_agg(id ORDER BY id) AS members
FROM (SELECT id, typify_cluster(geom, 200000, 0, (SELECT typify_options(barriers => geom) FROM typify_test_lines)) OVER () AS k FROM typify_test_house) AS q GROUP BY k ORDER BY k;
SELECT count(DISTINCT typify) AS answers FROM generate_series(1, 50) AS s,
	LATERAL (SELECT typify(geom, 100000, 0.5, (SELECT typify_options(barriers => geom) FROM typify_test_lines) ORDER BY md5(id::text || s)) FROM typify_test_house) AS t;
SELECT typify_barred(geom, id, 100000, 0.5, NULL, (SELECT geom FROM typify_test_lines), NULL)::text =
	typify_placeholders(geom, id, 100000, 0.5, (SELECT typify_options(barriers => geom) FROM typify_test_lines))::text AS beside_is_among FROM typify_test_house;

-- other barriers for other groups: from a table, joined row by row, correlated, in any plan, in grouping sets
CREATE TABLE typify_test_barrier AS SELECT k AS side, typify_options(barriers => ST_GeomFromText(format('LINESTRING(%s -10,%s 30)', 8 + 20 * k, 8 + 20 * k), 2056)) AS o FROM generate_series(0, 1) AS k;
SET enable_hashagg = off;
SELECT side, typify_placeholders(geom, id, 1000000, 0, o)::typify_placeholder[] IS NOT NULL AS there,
	(SELECT string_agg(p.members::text, ' ' ORDER BY p.members) FROM unnest(typify_placeholders(geom, id, 1000000, 0, o)) AS p) AS members
FROM typify_test_house JOIN typify_test_barrier ON id / 10 = side GROUP BY side ORDER BY side;
RESET enable_hashagg;
SET enable_sort = off;
SELECT side, (SELECT string_agg(p.members::text, ' ' ORDER BY p.members) FROM unnest(typify_placeholders(geom, id, 1000000, 0, o)) AS p) AS members
FROM typify_test_house JOIN typify_test_barrier ON id / 10 = side GROUP BY side ORDER BY side;
RESET enable_sort;
SELECT side, members FROM typify_test_barrier AS b, LATERAL (SELECT string_agg(p.members::text, ' ' ORDER BY p.members) AS members
	FROM unnest((SELECT typify_placeholders(geom, id, 1000000, 0, b.o) FROM typify_test_house WHERE id / 10 = side)) AS p) AS l ORDER BY side;
SELECT side, odd, ST_NumGeometries(typify(geom, 1000000, 0, o)) AS placeholders
FROM (SELECT h.geom, side, id % 2 AS odd, o FROM typify_test_house AS h JOIN typify_test_barrier ON id / 10 = side) AS q
GROUP BY GROUPING SETS ((side, odd), (side)) ORDER BY side, odd;
SELECT pg_temp.error_of('SELECT typify(h.geom, 1000000, 0, o) FROM typify_test_house AS h JOIN typify_test_barrier ON id / 10 = side');

-- parallel plans: the leader finds constant barriers in its own plan, others come with the states
CREATE TABLE typify_test_town AS
SELECT i AS id, i % 7 AS block, ST_SetSRID(ST_MakeEnvelope(x, y, x + 6 + i % 11, y + 7 + i % 7), 2056) AS geom
FROM (SELECT i, i::bigint * 7919 % 10007 * 3 AS x, i::bigint * 104729 % 10009 * 3 AS y FROM generate_series(1, 5000) AS i) AS b;
CREATE TABLE typify_test_net AS
SELECT k % 7 AS block, ST_SetSRID(ST_MakeLine(ST_MakePoint(k * 251, -10), ST_MakePoint(k * 113 % 30000, 31000)), 2056) AS geom FROM generate_series(1, 119) AS k;
CREATE TABLE typify_test_nets AS SELECT block, ST_Collect(geom ORDER BY geom) AS geom FROM typify_test_net GROUP BY block;
ANALYZE typify_test_town;
CREATE TABLE typify_test_query AS SELECT * FROM (VALUES
	(1, 'one group', 'SELECT md5(typify(geom, 75000, 0.5, (SELECT typify_options(barriers => ST_Collect(geom ORDER BY geom)) FROM typify_test_net))::bytea) FROM typify_test_town'),
	(2, 'a literal', 'SELECT md5(typify(geom, 75000, 0.5, typify_options(barriers => ''SRID=2056;LINESTRING(0 0,30000 30000)''))::bytea) FROM typify_test_town'),
	(3, 'rows', 'SELECT md5(typify_placeholders(geom, id, 75000, 0.5, (SELECT typify_options(barriers => ST_Collect(geom ORDER BY geom)) FROM typify_test_net))::text) FROM typify_test_town'),
	(4, 'beside the options', 'SELECT md5(typify_barred(geom, id, 75000, 0.5, NULL, (SELECT ST_Collect(geom ORDER BY geom) FROM typify_test_net), NULL)::text) FROM typify_test_town'),
	(5, 'groups', 'SELECT md5(string_agg(md5(t::bytea), '''' ORDER BY block)) FROM (SELECT block, typify(geom, 75000, 0, (SELECT typify_options(barriers => ST_Collect(geom ORDER BY geom)) FROM typify_test_net)) AS t FROM typify_test_town GROUP BY block) AS q'),
	(6, 'each group its own', 'SELECT md5(string_agg(md5(t::bytea), '''' ORDER BY block)) FROM (SELECT block, typify(t.geom, 75000, 0, typify_options(barriers => n.geom)) AS t FROM typify_test_town AS t JOIN typify_test_nets AS n USING (block) GROUP BY block) AS q'),
	(7, 'one scan after the other', 'SELECT md5(string_agg(md5(t::bytea), '''' ORDER BY block)) FROM typify_test_nets AS n, LATERAL (SELECT typify(geom, 75000, 0, typify_options(barriers => n.geom)) AS t FROM typify_test_town) AS l')
) AS q (number, what, query);
\i tests/data/parallel_of.sql
SET max_parallel_workers_per_gather = 0;
CREATE TEMP TABLE serial AS SELECT number, pg_temp.answer(query) AS answer FROM typify_test_query;
SET max_parallel_workers_per_gather = 3;
SET parallel_setup_cost = 0;
SET parallel_tuple_cost = 0;
SET min_parallel_table_scan_size = 0;
CREATE TEMP TABLE parallel AS SELECT number, pg_temp.is_parallel(query) AS is_parallel, pg_temp.answer(query) AS answer FROM typify_test_query;
SET parallel_leader_participation = off;
CREATE TEMP TABLE workers AS SELECT number, pg_temp.answer(query) AS answer FROM typify_test_query;
SET enable_hashagg = off;
CREATE TEMP TABLE sorted AS SELECT number, pg_temp.answer(query) AS answer FROM typify_test_query;
SELECT what, CASE WHEN number < 6 THEN is_parallel END AS is_parallel, s.answer = p.answer AS same, s.answer = w.answer AS same_from_workers_alone, s.answer = o.answer AS same_sorted
FROM typify_test_query JOIN serial AS s USING (number) JOIN parallel AS p USING (number) JOIN workers AS w USING (number) JOIN sorted AS o USING (number) ORDER BY number;
RESET ALL;

-- nobody is carried across: members and their placeholder lie in one cell of the net
CREATE TABLE typify_test_cell AS
SELECT row_number() OVER () AS cell, geom FROM (SELECT (ST_Dump(ST_Polygonize(geom))).geom FROM (SELECT ST_Node(ST_Collect(geom)) AS geom
	FROM (SELECT geom FROM typify_test_net WHERE block < 2 UNION ALL SELECT ST_SetSRID(ST_Boundary(ST_MakeEnvelope(-50, -50, 31000, 31000)), 2056)) AS n) AS m) AS d;
CREATE TABLE typify_test_result AS
SELECT p.* FROM (SELECT typify_placeholders(geom, id, 100000, 0.5, (SELECT typify_options(barriers => ST_Collect(geom)) FROM typify_test_net WHERE block < 2)) AS list FROM typify_test_town) AS t, unnest(list) AS p;
SELECT count(*) >= typify_count(5000, 100000) AS count_or_more, count(*) < 1500 AS not_many_more, sum(member_count) AS members FROM typify_test_result;
SELECT count(*) AS members, count(*) FILTER (WHERE NOT ST_Intersects(c.geom, ST_Centroid(r.geom))) AS across
FROM typify_test_result AS r, unnest(members) AS member JOIN typify_test_town AS t ON t.id = member JOIN typify_test_cell AS c ON ST_Intersects(c.geom, ST_Centroid(t.geom));

-- tables and layers: barriers are a table of their own
CREATE TABLE typify_test_road (name text, geom geometry(LineString, 2056));
INSERT INTO typify_test_road VALUES ('river', 'SRID=2056;LINESTRING(-10 9,60 9)'), ('empty', 'SRID=2056;LINESTRING EMPTY'), ('none', NULL);
SELECT members FROM typify_derive('typify_test_house', NULL, 200000, options => typify_options(min_side => 0, min_gap => 0), barriers => 'typify_test_road') ORDER BY members;
CREATE VIEW typify_test_grouped AS SELECT id, id % 10 / 3 AS part, geom FROM typify_test_house;
SELECT grp, members FROM typify_derive('typify_test_grouped', NULL, 200000, group_by => 'part', options => typify_options(min_side => 0, min_gap => 0), barriers => 'typify_test_road') ORDER BY grp, members;
SELECT grp, members FROM typify_derive('typify_test_grouped', NULL, 200000, group_by => 'part', options => typify_options(barriers => 'SRID=2056;LINESTRING(-10 9,60 9)')) ORDER BY grp, members;
SELECT grp, members FROM typify_derive('typify_test_grouped', NULL, 200000, group_by => 'part', groups => '{1}', barriers => 'typify_test_road') ORDER BY grp, members;
SELECT count(*) AS calibrated_rows, count((options).barriers) AS with_barriers FROM typify_calibrate('typify_test_grouped', 'typify_test_house', 0, 'part', typify_options(barriers => 'SRID=2056;LINESTRING(-10 9,60 9)'));
SELECT count(*) AS links FROM typify_match('typify_test_house', 'typify_test_house', options => typify_options(barriers => 'SRID=2056;LINESTRING(-10 9,60 9)'));
SELECT typify_create_scale('typify_test_layer', 'typify_test_house', NULL, 200000, kind => 'table', options => typify_options(min_side => 0, min_gap => 0), barriers => 'typify_test_road') AS layer;
SELECT members FROM typify_test_layer ORDER BY members;
UPDATE typify_test_road SET geom = 'SRID=2056;LINESTRING(28 -10,28 30)' WHERE name = 'river';
SELECT typify_refresh_scale('typify_test_layer');
SELECT members FROM typify_test_layer ORDER BY members;
SELECT typify_create_scale('typify_test_view', 'typify_test_house', NULL, 200000, options => typify_options(min_side => 0, min_gap => 0), barriers => 'typify_test_road') AS layer;
SELECT members FROM typify_test_view ORDER BY members;
SELECT pg_temp.error_of('DROP TABLE typify_test_road');
SET client_min_messages = warning;
CALL typify_build_scale('typify_test_built', 'typify_test_grouped', NULL, 200000, group_by => 'part', options => typify_options(min_side => 0, min_gap => 0), barriers => 'typify_test_road');
RESET client_min_messages;
SELECT grp, members FROM typify_test_built ORDER BY grp, members;
SELECT obj_description('typify_test_built'::regclass)::jsonb->>'barriers' AS kept;

-- what is refused
SELECT b AS barriers, pg_temp.error_of(format('SELECT typify_options(barriers => %L)', b)) AS error FROM unnest(ARRAY['POINT(1 1)', 'MULTIPOINT(1 1,2 2)', 'GEOMETRYCOLLECTION(POINT(1 1))',
	'CIRCULARSTRING(0 0,1 1,2 0)', 'TIN(((0 0 0,0 0 1,0 1 0,0 0 0)))', 'GEOMETRYCOLLECTION(LINESTRING(0 0,1 1),COMPOUNDCURVE((0 0,1 1)))', 'POINT EMPTY', 'CIRCULARSTRING EMPTY']) WITH ORDINALITY AS v (b, number) ORDER BY number;
SELECT pg_temp.error_of('SELECT typify_options(barriers => ST_MakeLine(ST_MakePoint(0, 0), ST_MakePoint(1, ''NaN'')))') AS not_a_number,
	pg_temp.error_of('SELECT typify_options(barriers => ST_MakeLine(ST_MakePoint(0, 0), ST_MakePoint(''-Infinity'', 0)))') AS infinite;
SELECT pg_temp.error_of('SELECT typify(geom, 50000, 0, typify_options(barriers => ''LINESTRING(0 0,1 1)'')) FROM typify_test_house') AS other_srid,
	pg_temp.error_of('SELECT typify_cluster(geom, 50000, 0, typify_options(barriers => ''SRID=25833;LINESTRING(0 0,1 1)'')) OVER () FROM typify_test_house') AS in_a_window;
SELECT pg_temp.error_of('SELECT typify_barred(geom, id, 50000, 0, typify_options(barriers => geom), geom, NULL) FROM typify_test_house') AS twice,
	pg_temp.error_of('SELECT typify_derive(''typify_test_house'', NULL, 50000, options => typify_options(barriers => ''SRID=2056;LINESTRING(0 0,1 1)''), barriers => ''typify_test_road'')') AS twice_in_a_table;
SELECT pg_temp.error_of('SELECT typify_derive(''typify_test_house'', NULL, 50000, options => typify_options(barriers => ''SRID=25833;LINESTRING(0 0,1 1)''))') AS derived,
	pg_temp.error_of('SELECT typify_derive(''typify_test_house'', NULL, 50000, barriers => ''typify_test_road'', barriers_geom_column => ''name'')') AS no_geometry,
	pg_temp.error_of('SELECT typify_create_scale(''x'', ''typify_test_house'', NULL, 50000, options => typify_options(barriers => (SELECT ST_SetSRID(ST_MakeLine(array_agg(ST_MakePoint(i, i % 3))), 2056) FROM generate_series(1, 10000) AS i)))') AS too_large_to_keep;

-- who has large barriers made anew for every building is told so, once a statement; who passes them as a sub-select is not
CREATE TABLE typify_test_street AS SELECT ST_SetSRID(ST_MakeLine(ST_MakePoint(i, -500), ST_MakePoint(i, -400)), 2056) AS geom FROM generate_series(1, 1000) AS i;
SELECT ST_NumGeometries(typify(geom, 50000, 0, typify_options(barriers => (SELECT ST_Collect(geom) FROM typify_test_street)))) AS slow,
	ST_NumGeometries(typify(geom, 100000, 0, typify_options(barriers => (SELECT ST_Collect(geom) FROM typify_test_street)))) AS slow_too FROM typify_test_house, generate_series(1, 3);
SELECT sum(ST_NumGeometries(t)) AS slow_groups FROM (SELECT typify(geom, 50000, 0, typify_options(barriers => (SELECT ST_Collect(geom) FROM typify_test_street))) AS t FROM typify_test_house, generate_series(1, 3) GROUP BY id) AS g;
SELECT max(number) AS slow_window FROM (SELECT typify_cluster(geom, 50000, 0, typify_options(barriers => (SELECT ST_Collect(geom) FROM typify_test_street))) OVER () AS number FROM typify_test_house, generate_series(1, 3)) AS w;
SELECT ST_NumGeometries(typify(geom, 50000, 0, (SELECT typify_options(barriers => ST_Collect(geom)) FROM typify_test_street))) AS fast FROM typify_test_house, generate_series(1, 3);
SELECT ST_NumGeometries(typify(geom, 50000, 0, typify_options(barriers => (SELECT ST_Collect(geom) FROM typify_test_street WHERE ST_X(ST_StartPoint(geom)) < 10)))) AS few_lines FROM typify_test_house, generate_series(1, 3);
SELECT ST_NumGeometries(typify(geom, 50000, 0, typify_options(barriers => (SELECT ST_Collect(geom) FROM typify_test_street)))) AS few_buildings FROM typify_test_house;
DROP TABLE typify_test_street;

-- large ones are not copied where they stay in memory; those of a call that sorts its rows do not
CREATE TABLE typify_test_street AS SELECT ST_MakeLine(ST_MakePoint(i % 20 * 20 + 14, i / 20 * 0.01), ST_MakePoint(i % 20 * 20 + 14.5, 500)) AS geom FROM generate_series(1, 20000) AS i;
CREATE TABLE typify_test_village AS SELECT i AS id, ST_MakeEnvelope(i % 20 * 20, i / 20 * 20, i % 20 * 20 + 8, i / 20 * 20 + 7) AS geom FROM generate_series(0, 39) AS i;
SELECT few, ST_NumGeometries(plain) AS plain, sorted::bytea = plain::bytea AS sorted_as_plain
FROM generate_series(5, 40, 5) AS few,
	LATERAL (SELECT typify(geom, 50000, 0.5, (SELECT typify_options(barriers => ST_Collect(geom)) FROM typify_test_street)) AS plain FROM typify_test_village WHERE id < few) AS p,
	LATERAL (SELECT typify(geom, 50000, 0.5, (SELECT typify_options(barriers => ST_Collect(geom)) FROM typify_test_street) ORDER BY id) AS sorted FROM typify_test_village WHERE id < few) AS s
ORDER BY few;
DROP TABLE typify_test_street, typify_test_village;

DROP MATERIALIZED VIEW typify_test_view;
DROP VIEW typify_test_grouped;
DROP TABLE typify_test_house, typify_test_lines, typify_test_barrier, typify_test_town, typify_test_net, typify_test_nets, typify_test_query, typify_test_cell, typify_test_result, typify_test_road, typify_test_layer, typify_test_built;
