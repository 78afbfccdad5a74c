-- storage.sql: however a geometry is stored, it is read alike
CREATE TABLE typify_test_storage (id integer, plain geometry, short geometry, main geometry, external geometry, extended geometry);
ALTER TABLE typify_test_storage ALTER plain SET STORAGE PLAIN, ALTER short SET STORAGE MAIN, ALTER main SET STORAGE MAIN, ALTER external SET STORAGE EXTERNAL, ALTER extended SET STORAGE EXTENDED;
-- few points, some, and so many that values are compressed or moved out of line
INSERT INTO typify_test_storage SELECT i, g, g, g, g, g FROM generate_series(1, 30) AS i,
	LATERAL (SELECT ST_SetSRID(ST_Buffer(ST_MakePoint(i * 31 % 97 * 20, i * 17 % 89 * 20), 4 + i % 3, CASE WHEN i % 3 = 0 THEN 1 WHEN i % 3 = 1 THEN 20 ELSE 30 END), 2056) AS g) AS b;
INSERT INTO typify_test_storage (id, external, extended) SELECT 100 + i, g, g FROM generate_series(1, 3) AS i, LATERAL (SELECT ST_SetSRID(ST_Buffer(ST_MakePoint(i * 100, 0), 40, 2000), 2056) AS g) AS b;
SELECT count(DISTINCT t) AS pictures FROM (SELECT unnest(ARRAY[typify(plain, 75000)::bytea, typify(short, 75000)::bytea, typify(main, 75000)::bytea, typify(external, 75000)::bytea, typify(extended, 75000)::bytea]) AS t FROM typify_test_storage WHERE id < 100) AS q;
SELECT typify(external, 75000)::bytea = typify(extended, 75000)::bytea AS same, ST_NumGeometries(typify(extended, 75000)) FROM typify_test_storage;
SELECT count(*) FILTER (WHERE a IS DISTINCT FROM b) AS differ FROM (SELECT typify_cluster(external, 75000) OVER () AS a, typify_cluster(extended, 75000) OVER () AS b FROM typify_test_storage) AS q;
-- short headers: points fit 126 bytes
CREATE TABLE typify_test_point (geom geometry);
ALTER TABLE typify_test_point ALTER geom SET STORAGE MAIN;
INSERT INTO typify_test_point SELECT ST_MakePoint(i, i * i % 7) FROM generate_series(1, 20) AS i;
SELECT max(k) + 1 AS clusters FROM (SELECT typify_cluster(geom, 50000) OVER () AS k FROM typify_test_point) AS q;
-- results can be stored and read again
CREATE TABLE typify_test_result AS SELECT typify(extended, 75000) AS picture, typify_placeholders(extended, id, 75000) AS rows FROM typify_test_storage;
SELECT ST_NumGeometries(picture), cardinality(rows), (SELECT sum(ST_Area(geom)) FROM unnest(rows)) - ST_Area(picture) < 1e-6 AS same FROM typify_test_result;
CREATE TABLE typify_test_row AS SELECT p.* FROM typify_test_result, unnest(rows) AS p;
CREATE INDEX ON typify_test_row USING gist (geom);
SELECT count(*), count(*) FILTER (WHERE ST_IsValid(geom)) AS valid FROM typify_test_row;
DROP TABLE typify_test_storage, typify_test_point, typify_test_result, typify_test_row;
