-- window.sql: typify_cluster by partition, whatever the order and frame; typify as a window aggregate
CREATE TEMP TABLE building AS
SELECT i AS id, i % 3 AS block, ST_MakeEnvelope(x, y, x + 6 + i % 11, y + 7 + i % 7) AS geom
FROM (SELECT i, i * 37 % 101 * 13 AS x, i * 53 % 97 * 11 AS y FROM generate_series(1, 150) AS i) AS b;
INSERT INTO building VALUES (1000, 1, NULL), (1001, 2, 'POLYGON EMPTY'), (1002, 7, NULL);

SELECT block, count(*) AS rows, count(k) AS numbered, min(k), max(k), count(DISTINCT k) AS clusters
FROM (SELECT block, typify_cluster(geom, 75000, 0.5) OVER (PARTITION BY block) AS k FROM building) AS q GROUP BY block ORDER BY block;

-- order, frame and arrival of rows do not matter
SELECT count(*) AS rows, count(*) FILTER (WHERE a IS DISTINCT FROM b OR a IS DISTINCT FROM c OR a IS DISTINCT FROM d) AS differ FROM (
	SELECT typify_cluster(geom, 75000) OVER (PARTITION BY block) AS a, typify_cluster(geom, 75000) OVER (PARTITION BY block ORDER BY id DESC) AS b,
		   typify_cluster(geom, 75000) OVER (PARTITION BY block ORDER BY md5(id::text) ROWS BETWEEN 1 PRECEDING AND CURRENT ROW) AS c,
		   typify_cluster(geom, 75000) OVER (PARTITION BY block ORDER BY id RANGE BETWEEN CURRENT ROW AND 5 FOLLOWING EXCLUDE CURRENT ROW) AS d
	FROM (SELECT * FROM building ORDER BY md5(id::text || 'x')) AS shuffled) AS q;

-- buildings whose measures are equal but whose bytes differ are told apart: always the same numbers
CREATE TEMP TABLE twin AS SELECT i AS id, CASE i % 3 WHEN 0 THEN 'POLYGON((0 0,2 0,2 2,0 2,0 0))' WHEN 1 THEN 'POLYGON((2 0,2 2,0 2,0 0,2 0))' ELSE 'POLYGON Z((0 0 1,2 0 1,2 2 1,0 2 1,0 0 1))' END::geometry AS geom FROM generate_series(1, 9) AS i;
SELECT count(DISTINCT story) AS stories FROM (
	SELECT seed, string_agg(kind || ':' || k, ',' ORDER BY kind, k) AS story FROM (
		SELECT seed, id % 3 AS kind, typify_cluster(geom, 50000) OVER (PARTITION BY seed ORDER BY md5(seed || '.' || id)) AS k FROM twin, generate_series(1, 20) AS seed) AS q GROUP BY seed) AS q;

-- defaults and all four arguments
SELECT count(*) FILTER (WHERE a <> b OR a <> c) AS differ, max(d) + 1 AS counted FROM (
	SELECT typify_cluster(geom, 75000) OVER w AS a, typify_cluster(geom, 75000, 0) OVER w AS b, typify_cluster(geom, 75000, 0, NULL) OVER w AS c,
		   typify_cluster(geom, 75000, options => typify_options(count => 4)) OVER w AS d FROM building WINDOW w AS ()) AS q;

-- the aggregate as a window aggregate: whole partition, and a growing frame
SELECT count(DISTINCT t::bytea) AS results, bool_and(t::bytea = alone::bytea) AS same_as_aggregate
FROM (SELECT typify(geom, 75000, 0.5) OVER () AS t FROM building) AS w, (SELECT typify(geom, 75000, 0.5) AS alone FROM building) AS a;
SELECT id, ST_NumGeometries(typify(geom, 50000) OVER (ORDER BY id)) AS growing, ST_NumGeometries(typify(geom, 50000) OVER (ORDER BY id ROWS BETWEEN 3 PRECEDING AND CURRENT ROW)) AS moving,
	   cardinality(typify_placeholders(geom, id, 50000) OVER (ORDER BY id)) AS rows
FROM building WHERE id <= 8 ORDER BY id;
