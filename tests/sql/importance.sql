-- importance.sql: kept buildings are there, in place and in size, at every scale; means are weighted
\i tests/data/error_of.sql
SET client_min_messages = warning;
\i tests/data/two_levels.sql
SET search_path = pg_temp, public;
\set ECHO none
\i tests/data/settlement.sql
\set ECHO all
RESET search_path;
SET client_min_messages = error; -- placeholders without size are another test's

-- every 37th building is kept, every fifth weighs three
CREATE TEMP TABLE town AS
SELECT id, block::text AS grp, geom, CASE WHEN id % 37 = 0 THEN 'Infinity' WHEN id % 5 = 0 THEN 3::float8 END AS importance
FROM settlement_buildings
UNION ALL SELECT 1000000 + id, 'level ' || block, geom, CASE WHEN id % 7 = 0 THEN 'Infinity' WHEN id % 5 = 0 THEN 1.7 ELSE 1::float8 END
FROM lod25;
CREATE TEMP VIEW kept AS SELECT * FROM town WHERE importance = 'Infinity';
SELECT count(*) AS kept FROM kept;

-- whole, and group by group
SELECT scale, way, sum(n) AS placeholders, sum(members) AS members, sum(there) AS there, sum(in_place) AS in_place, sum(in_size) AS in_size
FROM unnest(ARRAY[25000, 50000, 75000, 100000, 200000, 500000, 1000000]) AS scale,
	(VALUES ('whole', 0.5), ('groups', 0)) AS w (way, s_u), LATERAL (
		SELECT typify_placeholders(geom, id, scale, s_u, NULL, importance) AS list FROM town
		GROUP BY CASE way WHEN 'groups' THEN coalesce(grp, 'none') END) AS g, LATERAL (
		SELECT count(*) AS n, sum(p.member_count) AS members, count(k.id) AS there,
			count(*) FILTER (WHERE ST_Distance(ST_Centroid(k.geom), ST_Centroid(p.geom)) < 1e-6) AS in_place,
			count(*) FILTER (WHERE abs(p.area / ST_Area(k.geom) - 1) < 1e-9 AND abs(ST_Area(p.geom) / p.area - 1) < 1e-6) AS in_size
		FROM unnest(list) AS p LEFT JOIN kept AS k USING (id)) AS c
GROUP BY scale, way ORDER BY scale, way;

-- the weighted mean, and who stands for it
CREATE TEMP TABLE building (id int, x float8, size float8, importance float8);
INSERT INTO building VALUES (1, 0, 10, 3), (2, 100, 20, 1), (3, 1000, 10, 2.5), (4, 1100, 20, 'Infinity'), (5, 5000, 30, NULL), (6, 5100, 10, 1);
CREATE TEMP VIEW house AS SELECT id, ST_MakeEnvelope(x - size / 2, 0, x + size / 2, size) AS geom, importance FROM building;
SELECT p.id, members, round(ST_X(ST_Centroid(p.geom))::numeric, 4) AS x, round(ST_Y(ST_Centroid(p.geom))::numeric, 4) AS y, round(p.area::numeric, 4) AS area
FROM unnest((SELECT typify_placeholders(geom, id, 25000, 0, typify_options(count => 3), importance) FROM house)) AS p ORDER BY p.id;
SELECT p.id, members, round(p.area::numeric, 4) AS area
FROM unnest((SELECT typify_placeholders(geom, id, 50000, 0, typify_options(count => 3, area_statistic => 'sum'), importance) FROM house)) AS p ORDER BY p.id;
-- an edge is as long as its more important end says: 3 at 100 m of 1 is farther than 1 at 250 m of 1
SELECT p.id, members FROM unnest((SELECT typify_placeholders(ST_MakePoint(x, 0), id, 25000, 0, typify_options(count => 2), i)
	FROM (VALUES (1, 0, 3), (2, 100, 1), (3, 350, 1)) AS v (id, x, i))) AS p ORDER BY p.id;

-- NULL and 1 are the same, and change nothing
SELECT typify_placeholders(geom, id, 75000, 0.5)::text = typify_placeholders(geom, id, 75000, 0.5, NULL, NULL)::text AS same,
	typify_placeholders(geom, id, 75000, 0.5)::text = typify_placeholders(geom, id, 75000, 0.5, NULL, 1)::text AS same_of_1
FROM lod25;

-- kept twins at one place, all kept, and a count that cannot be reached
SELECT p.id, members, ST_AsText(ST_Centroid(p.geom), 6) AS place, round(p.area::numeric, 6) AS area
FROM unnest((SELECT typify_placeholders(ST_MakeEnvelope(0, 0, 10, 10), i, 1000000, 0, typify_options(count => 1), CASE WHEN i % 2 = 0 THEN 'Infinity'::float8 END)
	FROM generate_series(1, 7) AS i)) AS p ORDER BY p.id;
SELECT cardinality(typify_placeholders(geom, id, 1000000, 0, typify_options(count => 1, min_distance => 1e6), 'Infinity')) AS all_of_them, count(*) FROM lod25;
SELECT cardinality(typify_placeholders(geom, id, 1000000, 0, NULL, importance)) AS reached, count(*) FILTER (WHERE importance = 'Infinity') AS kept,
	typify_count(count(*), 1000000) AS asked
FROM town WHERE id >= 1000000;
-- min_distance looks past the pairs that stay
SELECT p.id, members FROM unnest((SELECT typify_placeholders(ST_MakePoint(x, 0), id, 25000, 0, typify_options(min_distance => 50), i::float8)
	FROM (VALUES (1, 0, 'Infinity'), (2, 10, 'Infinity'), (3, 100, '1'), (4, 140, '1'), (5, 300, '1')) AS v (id, x, i))) AS p ORDER BY p.id;

-- fifty orders of rows
SELECT count(*) AS orders, count(DISTINCT answer) AS answers FROM (
	SELECT seed, md5(typify_placeholders(geom, id, 100000, 0.5, typify_options(min_area => 80, keep_area => 0.02), importance ORDER BY md5(seed || '.' || id))::text) AS answer
	FROM town, generate_series(1, 50) AS seed WHERE id >= 1000000 GROUP BY seed) AS q;
-- parallel plans
CREATE TABLE typify_test_town AS SELECT * FROM town;
ANALYZE typify_test_town;
SET max_parallel_workers_per_gather = 0;
SELECT md5(typify_placeholders(geom, id, 75000, 0.5, NULL, importance)::text) AS serial FROM typify_test_town \gset
SET max_parallel_workers_per_gather = 3;
SET parallel_setup_cost = 0;
SET parallel_tuple_cost = 0;
SET min_parallel_table_scan_size = 0;
SELECT md5(typify_placeholders(geom, id, 75000, 0.5, NULL, importance)::text) = :'serial' AS same FROM typify_test_town;
-- some workers have importances, others none
SELECT md5(typify_placeholders(geom, id, 75000, 0.5, NULL, CASE WHEN id = 37 THEN 'Infinity'::float8 END)::text) AS few FROM typify_test_town \gset
SET parallel_leader_participation = off;
SELECT md5(typify_placeholders(geom, id, 75000, 0.5, NULL, CASE WHEN id = 37 THEN 'Infinity'::float8 END)::text) = :'few' AS same FROM typify_test_town;
SET max_parallel_workers_per_gather = 0;
SELECT md5(typify_placeholders(geom, id, 75000, 0.5, NULL, CASE WHEN id = 37 THEN 'Infinity'::float8 END)::text) = :'few' AS same FROM typify_test_town;
RESET parallel_leader_participation;
RESET max_parallel_workers_per_gather;
DROP TABLE typify_test_town;

SELECT i AS importance, pg_temp.error_of(format('SELECT typify_placeholders(geom, id, 50000, 0, NULL, %s) FROM pg_temp.lod25', i))
FROM unnest(ARRAY['0.999', '0', '''-Infinity''', '''NaN''', 'CASE WHEN id = 7 THEN 0.5 END']) AS i;
