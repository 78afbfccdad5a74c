-- min_area.sql: sheds add nothing to count, position or mean, and nobody is lost
SET client_min_messages = warning;
\i tests/data/two_levels.sql

CREATE TEMP TABLE building (id int, geom geometry);
INSERT INTO building SELECT i, ST_MakeEnvelope(i * 30, 0, i * 30 + 10, 10) FROM generate_series(1, 8) AS i;
INSERT INTO building SELECT 100 + i, ST_MakeEnvelope(i * 30 + 12, 0, i * 30 + 14, 2) FROM generate_series(1, 8) AS i;
-- eight houses give four at 1:50 000, with sheds or without
SELECT p.id, members, round(ST_X(ST_Centroid(geom))::numeric, 3) AS x, round(area::numeric, 3) AS area
FROM unnest((SELECT typify_placeholders(geom, id, 50000, 0, typify_options(min_area => 5)) FROM building)) AS p ORDER BY x;
SELECT typify(geom, 50000, 0, typify_options(min_area => 5))::bytea = (typify(geom, 50000) FILTER (WHERE id < 100))::bytea AS same FROM building;
SELECT id, typify_cluster(geom, 50000, 0, typify_options(min_area => 5)) OVER () AS cluster FROM building ORDER BY id % 100, id;
-- sheds alone: one row that is not drawn, and an empty collection
SELECT p.id, p.geom IS NULL AS hidden, member_count, members, area, width, length
FROM unnest((SELECT typify_placeholders(geom, id, 50000, 0, typify_options(min_area => 5)) FROM building WHERE id > 100)) AS p;
SELECT ST_AsText(typify(geom, 50000, 0, typify_options(min_area => 5))) FROM building WHERE id > 100;
SELECT DISTINCT typify_cluster(geom, 50000, 0, typify_options(min_area => 5)) OVER () AS cluster FROM building WHERE id > 100;
-- a kept shed is drawn
SELECT p.id, member_count, round(area::numeric, 3) AS area
FROM unnest((SELECT typify_placeholders(geom, id, 50000, 0, typify_options(min_area => 5), CASE WHEN id = 104 THEN 'Infinity'::float8 END) FROM building WHERE id > 100)) AS p;
-- points are sheds as well
SELECT p.id, members FROM unnest((SELECT typify_placeholders(g, id, 50000, 0, typify_options(min_area => 5))
	FROM (VALUES (1, 'POLYGON((0 0,10 0,10 10,0 10,0 0))'::geometry), (2, 'POINT(900 0)'), (3, 'LINESTRING(4 4,5 5)')) AS v (id, g))) AS p;

-- the blocks, at every scale: as many, of the same houses; each shed with the nearest
SELECT scale, count(*) AS placeholders, sum(w.member_count) AS members, sum(o.member_count) AS houses,
	count(*) FILTER (WHERE o.geom = w.geom AND o.area = w.area AND w.members @> o.members) AS same
FROM unnest(ARRAY[25000, 50000, 75000, 100000, 200000, 500000, 1000000]) AS scale, LATERAL (
	SELECT block, typify_placeholders(geom, id, scale, 0.5, typify_options(min_area => 100)) AS with_sheds,
		typify_placeholders(geom, id, scale, 0.5) FILTER (WHERE ST_Area(geom) >= 100) AS without
	FROM lod25 GROUP BY block) AS g, LATERAL unnest(with_sheds) WITH ORDINALITY AS w (id, geom, member_count, members, area, width, length, orientation, n),
	LATERAL unnest(without) WITH ORDINALITY AS o (id, geom, member_count, members, area, width, length, orientation, n)
WHERE w.n = o.n GROUP BY scale ORDER BY scale;
SELECT count(*) AS sheds, count(*) FILTER (WHERE ST_Distance(ST_Centroid(b.geom), ST_Centroid(p.geom)) > nearest + 1e-6) AS not_to_the_nearest
FROM (SELECT typify_placeholders(geom, id, 75000, 0.5, typify_options(min_area => 100)) AS list FROM lod25) AS t, unnest(list) AS p,
	unnest(p.members) AS m JOIN lod25 AS b ON b.id = m, LATERAL (
		SELECT min(ST_Distance(ST_Centroid(b.geom), ST_Centroid(q.geom))) AS nearest FROM unnest(list) AS q) AS d
WHERE ST_Area(b.geom) < 100;

-- with one on its side of a barrier, if there is one
CREATE TEMP TABLE yard AS SELECT * FROM (VALUES (1, ST_MakeEnvelope(0, 0, 20, 20)), (2, ST_MakeEnvelope(60, 0, 80, 20)), (3, ST_MakeEnvelope(82, 8, 84, 10)),
	(4, ST_MakeEnvelope(24, 8, 26, 10)), (5, ST_MakeEnvelope(45, 8, 47, 10))) AS v (id, geom);
SELECT way, p.id, members
FROM (VALUES ('no barrier', NULL), ('beside a house', 'LINESTRING(22 -50,22 50)'), ('around a shed', 'LINESTRING(44 -50,44 50,48 50,48 -50,44 -50)')) AS v (way, line), LATERAL (
	SELECT typify_placeholders(geom, id, 50000, 0, typify_options(exponent => 0, min_area => 5, barriers => line::geometry)) AS list FROM yard) AS t, unnest(list) AS p
ORDER BY way COLLATE "C", id;
