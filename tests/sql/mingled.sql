-- mingled.sql: the rows of many groups come in any order and are kept together; no group takes another's rows, importances,
-- outlines, parameters or SRID
CREATE TABLE typify_test_building AS
SELECT i AS id, block, block % 7 AS district, CASE WHEN block % 5 = 0 THEN CASE WHEN i % 4 = 0 THEN 2.5 WHEN i % 11 = 0 THEN 'Infinity' END END AS importance,
	   50000 + block % 7 * 10000 + (block % 2) * block AS scale, (ARRAY['rectangle', 'footprint', 'auto', 'square'])[1 + block % 4] AS shape,
	   ST_SetSRID(ST_MakePolygon(ST_MakeLine(ARRAY[ST_MakePoint(x, y), ST_MakePoint(x + 9 + i % 5, y), ST_MakePoint(x + 9, y + 8 + i % 3), ST_MakePoint(x, y + 7), ST_MakePoint(x, y)])), (ARRAY[2056, 25832, 21781])[1 + block % 3]) AS geom
FROM (SELECT i, i::bigint * 7919 % 10007 % 331 AS block, i::bigint * 7919 % 10007 AS x, i::bigint * 104729 % 10009 AS y FROM generate_series(1, 4000) AS i) AS b;
ALTER TABLE typify_test_building SET (parallel_workers = 2);
ANALYZE typify_test_building;
CREATE FUNCTION pg_temp.node_of(query text, pattern text DEFAULT 'Aggregate', how text DEFAULT '') RETURNS text LANGUAGE plpgsql AS
$$
DECLARE
	line text;
BEGIN
	FOR line IN EXECUTE 'EXPLAIN (' || how || 'COSTS OFF) ' || query LOOP
		IF line ~ pattern THEN RETURN trim(line, ' ->'); END IF;
	END LOOP;
END
$$;
SET max_parallel_workers_per_gather = 0;

-- what each group gives by itself
CREATE TABLE typify_test_alone AS
SELECT g.block, a.* FROM (SELECT DISTINCT block FROM typify_test_building) AS g, LATERAL (
	SELECT md5(typify(geom, scale, 0.5, typify_options(shape => shape))::bytea) AS drawn,
		   md5(typify_placeholders(geom, id, scale, 0.5, typify_options(shape => shape, keep_area => 130), importance)::text) AS placeholders,
		   md5(typify_hierarchy(geom, id, 0.5, NULL::typify_options, importance)::text) AS nodes
	FROM typify_test_building AS b WHERE b.block = g.block) AS a;
SELECT count(*) AS groups, count(DISTINCT drawn) AS drawn, count(DISTINCT placeholders) AS placeholders, count(DISTINCT nodes) AS nodes FROM typify_test_alone;

-- the same together: three calls in one query; hashed, in batches, sorted, and from workers that each have a part of every group
CREATE VIEW typify_test_together AS
SELECT block, md5(typify(geom, scale, 0.5, typify_options(shape => shape))::bytea) AS drawn,
	   md5(typify_placeholders(geom, id, scale, 0.5, typify_options(shape => shape, keep_area => 130), importance)::text) AS placeholders,
	   md5(typify_hierarchy(geom, id, 0.5, NULL::typify_options, importance)::text) AS nodes
FROM typify_test_building GROUP BY block;
CREATE FUNCTION pg_temp.differing() RETURNS text LANGUAGE plpgsql AS
$$
DECLARE
	answer text;
BEGIN
	SELECT count(*) || ' groups, differing: ' || count(*) FILTER (WHERE a.drawn <> t.drawn) || ' drawn, ' || count(*) FILTER (WHERE a.placeholders <> t.placeholders) || ' placeholders, '
		|| count(*) FILTER (WHERE a.nodes <> t.nodes) || ' nodes' INTO answer FROM typify_test_alone AS a JOIN typify_test_together AS t USING (block);
	RETURN answer;
END
$$;
SET enable_sort = off;
SELECT pg_temp.node_of('SELECT * FROM typify_test_together') AS node, pg_temp.differing();
SET work_mem = '64kB';
SET hash_mem_multiplier = 1;
SELECT pg_temp.node_of('SELECT * FROM typify_test_together') AS node, pg_temp.node_of('SELECT * FROM typify_test_together', 'Batches: [2-9]', 'ANALYZE, ') IS NOT NULL AS in_batches, pg_temp.differing();
RESET work_mem;
RESET hash_mem_multiplier;
RESET enable_sort;
SET enable_hashagg = off;
SELECT pg_temp.node_of('SELECT * FROM typify_test_together') AS node, pg_temp.differing();
RESET enable_hashagg;
SET max_parallel_workers_per_gather = 2;
SET parallel_setup_cost = 0;
SET parallel_tuple_cost = 0;
SET min_parallel_table_scan_size = 0;
SET enable_sort = off;
SELECT pg_temp.node_of('SELECT * FROM typify_test_together', 'Partial') AS node, pg_temp.differing();
RESET enable_sort;
SET enable_hashagg = off;
SELECT pg_temp.node_of('SELECT * FROM typify_test_together', 'Partial') AS node, pg_temp.differing();
RESET enable_hashagg;
SET max_parallel_workers_per_gather = 0;

-- sets of groups of different lives: hashed and sorted in one pass; a group's rows are in several of them
CREATE TEMP VIEW mixed AS
SELECT district, block, GROUPING(district, block) AS which, count(*) AS houses, md5(typify_placeholders(ST_SetSRID(geom, 2056), id, 75000, 0.5, typify_options(shape => 'auto', keep_area => 130), importance)::text) AS answer
FROM typify_test_building GROUP BY GROUPING SETS ((district), (block), (district, block), ());
PREPARE differing_sets AS
SELECT count(*) AS groups, sum(m.houses) AS houses, count(*) FILTER (WHERE m.answer <> a.answer) AS differing
FROM mixed AS m, LATERAL (SELECT md5(typify_placeholders(ST_SetSRID(geom, 2056), id, 75000, 0.5, typify_options(shape => 'auto', keep_area => 130), importance)::text) AS answer
	FROM typify_test_building AS b WHERE (m.district IS NULL OR b.district = m.district) AND (m.block IS NULL OR b.block = m.block)) AS a;
SET plan_cache_mode = force_generic_plan;
SELECT pg_temp.node_of('EXECUTE differing_sets', 'MixedAggregate') AS node;
EXECUTE differing_sets;
-- the same plan, in batches
SET work_mem = '64kB';
SELECT pg_temp.node_of('EXECUTE differing_sets', 'MixedAggregate') AS node;
EXECUTE differing_sets;
RESET work_mem;
DEALLOCATE differing_sets;

-- frames: a result between one row and the next, and groups that begin anew with every row
SELECT count(*) AS rows, count(*) FILTER (WHERE md5(w.growing::text) <> md5(a.growing::text)) AS growing, count(*) FILTER (WHERE md5(w.moving::text) <> md5(a.moving::text)) AS moving,
	   count(*) FILTER (WHERE w.drawn::bytea <> a.drawn::bytea) AS drawn
FROM (SELECT id, block, typify_placeholders(geom, id, scale, 0.5, typify_options(shape => shape), importance) OVER (PARTITION BY block ORDER BY id) AS growing,
			 typify_placeholders(geom, id, scale, 0.5, typify_options(shape => shape), importance) OVER (PARTITION BY block ORDER BY id ROWS 3 PRECEDING) AS moving,
			 typify(geom, 75000) OVER (PARTITION BY block ORDER BY id) AS drawn, row_number() OVER (PARTITION BY block ORDER BY id) AS n
	  FROM typify_test_building WHERE block < 30) AS w,
	 LATERAL (SELECT typify_placeholders(geom, id, scale, 0.5, typify_options(shape => shape), importance) AS growing,
			 typify_placeholders(geom, id, scale, 0.5, typify_options(shape => shape), importance) FILTER (WHERE n > w.n - 4) AS moving, typify(geom, 75000) AS drawn
		FROM (SELECT *, row_number() OVER (ORDER BY id) AS n FROM typify_test_building AS b WHERE b.block = w.block) AS b WHERE n <= w.n) AS a;

-- filters, an order, distinct rows; groups whose first rows have no geometry, and some without any
CREATE FUNCTION pg_temp.mix(blocks integer[]) RETURNS TABLE (block bigint, answer text) LANGUAGE sql AS
$$
	SELECT block, concat_ws(' ', typify_placeholders(geom, id, scale, 0.5, typify_options(shape => shape), importance) FILTER (WHERE id % 3 = 0)::text,
		typify(DISTINCT geom, 75000 ORDER BY geom, 75000)::text, typify(CASE WHEN id > 2000 + 10 * block THEN geom END, 75000)::text)
	FROM typify_test_building AS b WHERE b.block = ANY (blocks) GROUP BY block
$$;
SELECT count(*) AS groups, count(*) FILTER (WHERE t.answer = a.answer) AS same
FROM pg_temp.mix((SELECT array_agg(DISTINCT block)::integer[] FROM typify_test_building)) AS t, LATERAL pg_temp.mix(ARRAY[t.block]::integer[]) AS a;

-- the same plan again and again, with a parameter that changes: hashed groups in a correlated sub-select
SELECT count(*) AS rescans, count(*) FILTER (WHERE again = once) AS same
FROM generate_series(50000, 74000, 3000) AS m,
	 LATERAL (SELECT md5(string_agg(md5(t::bytea), '' ORDER BY block)) AS again FROM (SELECT block, typify(geom, m, 0.5) AS t FROM typify_test_building WHERE id % 9000 < m GROUP BY block) AS g) AS a,
	 LATERAL (SELECT md5(string_agg(md5(t::bytea), '' ORDER BY block)) AS once FROM (SELECT DISTINCT block FROM typify_test_building) AS g,
		LATERAL (SELECT typify(geom, m) AS t0, typify(geom, m, 0.5) AS t FROM typify_test_building AS b WHERE b.block = g.block) AS t) AS o;

-- one row of one group among all: the errors are those of a group by itself
SET enable_sort = off;
\i tests/data/error_of.sql
SELECT pg_temp.error_of('SELECT typify(geom, CASE id WHEN 3977 THEN 90000 ELSE scale END) FROM typify_test_building GROUP BY block');
SELECT pg_temp.error_of('SELECT typify(CASE id WHEN 3977 THEN ST_SetSRID(geom, 3035) ELSE geom END, 75000) FROM typify_test_building GROUP BY block');
SELECT pg_temp.error_of('SELECT typify_placeholders(geom, CASE block WHEN 17 THEN 17 ELSE id END, 75000) FROM typify_test_building GROUP BY block');
SELECT pg_temp.differing();
RESET enable_sort;
DROP VIEW typify_test_together, mixed;
DROP TABLE typify_test_building, typify_test_alone;
