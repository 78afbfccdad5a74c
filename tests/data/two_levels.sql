-- two_levels.sql - for tests: buildings in blocks and a coarse layer of them, made by arithmetic.
-- Creates lod25(id, block, geom) and lod200(id, block, geom) as temporary tables.
--   blocks 1 .. 9: 10 * block buildings and block objects    few: 2 buildings, 3 objects
--   NULL: 12 buildings, 2 objects                            bare: 7 buildings, no object
--   lost: no building, 1 object
\set ECHO none
CREATE TEMP TABLE lod25 (id integer PRIMARY KEY, block text, geom geometry(Polygon, 25832));
CREATE TEMP TABLE lod200 (id integer PRIMARY KEY, block text, geom geometry(Polygon, 25832));
CREATE TEMP VIEW block AS
SELECT block, n25, n200, 1000 * (place % 4) AS x, 1000 * (place / 4) AS y
FROM (SELECT k::text, 10 * k, k, k FROM generate_series(1, 9) AS k
	  UNION ALL VALUES (NULL, 12, 2, 10), ('few', 2, 3, 11), ('bare', 7, 0, 12), ('lost', 0, 1, 13)
) AS b (block, n25, n200, place);
INSERT INTO lod25
SELECT row_number() OVER (ORDER BY b.x + 4 * b.y, i), block, ST_SetSRID(ST_MakeEnvelope(
	b.x + i * 7919 % 307, b.y + i * 104729 % 311, b.x + i * 7919 % 307 + 6 + i % 11, b.y + i * 104729 % 311 + 7 + i % 7), 25832)
FROM block AS b, generate_series(1, n25) AS i;
INSERT INTO lod200
SELECT row_number() OVER (ORDER BY b.x + 4 * b.y, i), block, ST_SetSRID(ST_MakeEnvelope(
	b.x + i * 6007 % 307, b.y + i * 4001 % 311, b.x + i * 6007 % 307 + 31 + i % 13, b.y + i * 4001 % 311 + 27 + i % 17), 25832)
FROM block AS b, generate_series(1, n200) AS i;
CREATE INDEX ON lod25 USING gist (geom);
ANALYZE lod25;
ANALYZE lod200;
\set ECHO all
