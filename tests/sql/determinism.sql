-- determinism.sql: the same bytes from any order of rows
CREATE TEMP TABLE building AS
SELECT i AS id, ST_MakeEnvelope(x, y, x + 6 + i % 11, y + 7 + i % 7) AS geom
FROM (SELECT i, i * 37 % 101 * 13 AS x, i * 53 % 97 * 11 AS y FROM generate_series(1, 300) AS i) AS b;
-- ties of every kind: a regular grid, equal houses, houses on one another
INSERT INTO building SELECT 1000 + i, ST_MakeEnvelope(i % 10 * 20, i / 10 * 20 - 3000, i % 10 * 20 + 10, i / 10 * 20 - 2990) FROM generate_series(0, 99) AS i;
INSERT INTO building SELECT 2000 + i, ST_MakeEnvelope(5000, i / 4 * 10, 5005, i / 4 * 10 + 5) FROM generate_series(0, 39) AS i;

CREATE TEMP TABLE answer AS
SELECT s_u, scale, seed, md5(typify(geom, scale, s_u ORDER BY md5(seed || '.' || id))::bytea) AS picture, md5(typify_placeholders(geom, id, scale, s_u ORDER BY md5(seed || '.' || id))::text) AS rows
FROM building, generate_series(1, 50) AS seed, (VALUES (75000, 0.5), (200000, 0)) AS p (scale, s_u) GROUP BY s_u, scale, seed;
SELECT scale, s_u, count(*) AS orders, count(DISTINCT picture) AS pictures, count(DISTINCT rows) AS rows FROM answer GROUP BY scale, s_u ORDER BY scale;
-- nor do Z, M and the wrapping as a multi geometry
SELECT count(DISTINCT picture) AS pictures FROM (SELECT form, md5(typify(g, 75000, 0.5)::bytea) AS picture
	FROM building, LATERAL (VALUES (1, geom), (2, ST_Force4D(geom)), (3, ST_Multi(geom))) AS v (form, g) GROUP BY form) AS q;
