-- cancel.sql: a cancelled statement stops at once and leaves the connection usable
CREATE TABLE typify_test_building AS
SELECT i AS id, ST_MakeEnvelope(x, y, x + 5, y + 5) AS geom FROM (SELECT i, i::bigint * 7919 % 100003 AS x, i::bigint * 104729 % 100019 AS y FROM generate_series(1, 200000) AS i) AS b;
SET max_parallel_workers_per_gather = 0;
SET statement_timeout = '20ms';
SELECT ST_NumGeometries(typify(geom, 75000, 0.5)) FROM typify_test_building;
SELECT cardinality(typify_placeholders(geom, id, 75000, 0.5)) FROM typify_test_building;
SELECT max(k) FROM (SELECT typify_cluster(geom, 75000, 0.5) OVER () AS k FROM typify_test_building) AS q;
RESET statement_timeout;
SELECT ST_NumGeometries(typify(geom, 75000, 0.5)) FROM typify_test_building;
SELECT ST_NumGeometries(typify(geom, 75000, 0.5)) FROM typify_test_building WHERE id <= 30;
DROP TABLE typify_test_building;
