-- groups.sql: each group is its own mesh, few or many, hashed, sorted or spilled to disk
CREATE TABLE typify_test_building AS
SELECT i AS id, i % 3000 AS block, ST_MakeEnvelope(x, y, x + 6 + i % 11, y + 7 + i % 7) AS geom
FROM (SELECT i, i::bigint * 7919 % 10007 AS x, i::bigint * 104729 % 10009 AS y FROM generate_series(1, 30000) AS i) AS b;
ANALYZE typify_test_building;

CREATE FUNCTION pg_temp.story() RETURNS text LANGUAGE sql AS
$$
	SELECT count(*) || ' groups, ' || sum(ST_NumGeometries(t)) || ' placeholders, ' || md5(string_agg(md5(t::bytea), '' ORDER BY block))
	FROM (SELECT block, typify(geom, 75000, 0.5) AS t FROM typify_test_building GROUP BY block) AS q
$$;
CREATE FUNCTION pg_temp.node_of(query text) RETURNS text LANGUAGE plpgsql AS
$$
DECLARE
	line text;
BEGIN
	FOR line IN EXECUTE 'EXPLAIN (COSTS OFF) ' || query LOOP
		IF line ~ 'Aggregate' THEN RETURN trim(line, ' ->'); END IF;
	END LOOP;
END
$$;
SET max_parallel_workers_per_gather = 0;
CREATE TEMP TABLE story (how text, story text);
SET enable_sort = off;
SELECT pg_temp.node_of('SELECT typify(geom, 75000, 0.5) FROM typify_test_building GROUP BY block');
INSERT INTO story SELECT 'hashed', pg_temp.story();
SET work_mem = '64kB';
SET hash_mem_multiplier = 1;
INSERT INTO story SELECT 'hashed, spilled', pg_temp.story();
RESET work_mem;
RESET hash_mem_multiplier;
RESET enable_sort;
SET enable_hashagg = off;
SELECT pg_temp.node_of('SELECT typify(geom, 75000, 0.5) FROM typify_test_building GROUP BY block');
INSERT INTO story SELECT 'sorted', pg_temp.story();
RESET enable_hashagg;
SELECT count(DISTINCT story) AS stories, min(substring(story from '^.*placeholders')) FROM story;

-- a group gives the same alone
SELECT count(*) AS groups, count(*) FILTER (WHERE t::bytea = alone::bytea) AS same
FROM (SELECT block, typify(geom, 75000, 0.5) AS t FROM typify_test_building WHERE block < 20 GROUP BY block) AS g,
	 LATERAL (SELECT typify(geom, 75000, 0.5) AS alone FROM typify_test_building AS b WHERE b.block = g.block) AS a;
-- grouping sets, filters, several calls at once
SELECT block IS NULL AS whole, count(*) AS groups, sum(ST_NumGeometries(t)) AS placeholders
FROM (SELECT block, typify(geom, 200000) AS t FROM typify_test_building WHERE block < 50 GROUP BY ROLLUP (block)) AS q GROUP BY 1 ORDER BY 1;
SELECT ST_NumGeometries(typify(geom, 25000) FILTER (WHERE id <= 10)) AS ten, typify(geom, 25000) FILTER (WHERE id < 0) IS NULL AS none, ST_NumGeometries(typify(DISTINCT geom, 25000)) AS distinct_ones,
	   ST_NumGeometries(typify(geom, 50000)) AS at_50, ST_NumGeometries(typify(geom, 100000, 1)) AS at_100, cardinality(typify_placeholders(geom, id, 50000)) AS rows
FROM typify_test_building WHERE block < 10;
DROP TABLE typify_test_building;
