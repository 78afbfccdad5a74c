-- parallel.sql: parallel plans happen and give the same bytes
CREATE TABLE typify_test_building AS
SELECT i AS id, i % 7 AS block, ST_MakeEnvelope(x, y, x + 6 + i % 11, y + 7 + i % 7, 2056) AS geom
FROM (SELECT i, i::bigint * 7919 % 10007 * 3 AS x, i::bigint * 104729 % 10009 * 3 AS y FROM generate_series(1, 20000) AS i) AS b;
ANALYZE typify_test_building;
\i tests/data/parallel_of.sql
CREATE TABLE typify_test_query AS
SELECT * FROM (VALUES
	(1, 'typify', 'SELECT md5(typify(geom, 75000, 0.5)::bytea) FROM typify_test_building'),
	(2, 'typify, options', 'SELECT md5(typify(geom, 75000, 0.5, typify_options(shape => ''square'', exponent => 1))::bytea) FROM typify_test_building'),
	(3, 'typify, sub-select', 'SELECT md5(typify(geom, 75000, 0.5, (SELECT typify_options(count => 1 + count(*)) FROM typify_test_building))::bytea) FROM typify_test_building'),
	(4, 'typify_placeholders', 'SELECT md5(typify_placeholders(geom, id, 75000, 0.5)::text) FROM typify_test_building'),
	(5, 'groups', 'SELECT md5(string_agg(md5(t::bytea), '''' ORDER BY block)) FROM (SELECT block, typify(geom, 75000) AS t FROM typify_test_building GROUP BY block) AS q'),
	(6, 'groups with rows', 'SELECT md5(string_agg(md5(t::text), '''' ORDER BY block)) FROM (SELECT block, typify_placeholders(geom, id, 75000, 1) AS t FROM typify_test_building GROUP BY block) AS q'),
	(7, 'some without rows', 'SELECT md5(typify(geom, 75000)::bytea) FROM typify_test_building WHERE id < 100'),
	(8, 'nothing', 'SELECT coalesce(md5(typify(geom, 75000)::bytea), ''null'') FROM typify_test_building WHERE id % 2 = 2')
) AS q (number, what, query);

SET max_parallel_workers_per_gather = 0;
CREATE TEMP TABLE serial AS SELECT number, pg_temp.answer(query) AS answer FROM typify_test_query;
SET max_parallel_workers_per_gather = 3;
SET parallel_setup_cost = 0;
SET parallel_tuple_cost = 0;
SET min_parallel_table_scan_size = 0;
CREATE TEMP TABLE parallel AS SELECT number, pg_temp.is_parallel(query) AS is_parallel, pg_temp.answer(query) AS answer FROM typify_test_query;
SET parallel_leader_participation = off;
CREATE TEMP TABLE workers AS SELECT number, pg_temp.answer(query) AS answer FROM typify_test_query;
SELECT what, is_parallel, s.answer = p.answer AS same, s.answer = w.answer AS same_from_workers_alone
FROM typify_test_query JOIN serial AS s USING (number) JOIN parallel AS p USING (number) JOIN workers AS w USING (number) ORDER BY number;

-- partitions by group: whole groups in the workers
CREATE TABLE typify_test_partitioned (id integer, block integer, geom geometry) PARTITION BY HASH (block);
CREATE TABLE typify_test_partition_0 PARTITION OF typify_test_partitioned FOR VALUES WITH (MODULUS 2, REMAINDER 0);
CREATE TABLE typify_test_partition_1 PARTITION OF typify_test_partitioned FOR VALUES WITH (MODULUS 2, REMAINDER 1);
INSERT INTO typify_test_partitioned SELECT id, block, geom FROM typify_test_building;
ANALYZE typify_test_partitioned;
SET enable_partitionwise_aggregate = on;
SELECT pg_temp.answer(replace(query, 'typify_test_building', 'typify_test_partitioned')) = answer AS same FROM typify_test_query JOIN serial USING (number) WHERE number IN (5, 6) ORDER BY number;
RESET enable_partitionwise_aggregate;

-- errors come through, whichever process finds them
\set VERBOSITY terse
SELECT typify(ST_SetSRID(geom, 4326), 75000) FROM typify_test_building;
SELECT typify(CASE WHEN id = 19999 THEN ST_SetSRID(geom, 21781) ELSE geom END, 75000) FROM typify_test_building;
SELECT typify(geom, CASE WHEN id > 10000 THEN 75000 ELSE 50000 END) FROM typify_test_building;
SELECT typify_placeholders(geom, id / 20000, 75000) FROM typify_test_building WHERE id < 3;
SELECT typify(geom, 75000, 2) FROM typify_test_building;
\set VERBOSITY default
DROP TABLE typify_test_building, typify_test_partitioned, typify_test_query;
