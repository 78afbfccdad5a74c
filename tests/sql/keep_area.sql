-- keep_area.sql: what is large on the map is there, in place and in size, at every scale
SET client_min_messages = warning;
\i tests/data/error_of.sql
\i tests/data/two_levels.sql
SET search_path = pg_temp, public;
\set ECHO none
\i tests/data/settlement.sql
\set ECHO all
RESET search_path;

-- a hall among houses: 100 by 60 m is 0.6 mm2 at 1:100 000
CREATE TEMP TABLE building (id int, geom geometry);
INSERT INTO building SELECT i, ST_MakeEnvelope(i * 30, 0, i * 30 + 10, 10) FROM generate_series(1, 8) AS i;
INSERT INTO building VALUES (9, ST_MakeEnvelope(70, 20, 170, 80));
SELECT scale, keep, p.id, member_count, ST_AsText(ST_Centroid(p.geom), 3) AS place, round(area::numeric, 3) AS area, round(width::numeric, 3) AS width
FROM (VALUES (100000, 0), (100000, 0.6), (100000, 0.6001), (150000, 0.2), (150000, 0.6)) AS v (scale, keep),
	LATERAL unnest((SELECT typify_placeholders(geom, id, scale, 0, typify_options(count => 1, keep_area => keep)) FROM building)) AS p
ORDER BY scale, keep, p.id;
-- in feet a square millimetre is as large
SELECT p.id, member_count FROM unnest((SELECT typify_placeholders(ST_SetSRID(ST_Scale(geom, 1 / 0.3048006096, 1 / 0.3048006096), 2272), id, 100000, 0,
	typify_options(count => 1, keep_area => 0.59999)) FROM building)) AS p;
-- a size that min_side asks for is had all the same, but no other ratio
SELECT p.id, round(width::numeric, 3) AS width, round(length::numeric, 3) AS length
FROM unnest((SELECT typify_placeholders(geom, id, 100000, 0, typify_options(count => 1, keep_area => 0.05, min_side => 0.35)) FROM
	(VALUES (1, ST_MakeEnvelope(0, 0, 300, 40)), (2, ST_MakeEnvelope(0, 50, 10, 60)), (3, ST_MakeEnvelope(400, 50, 425, 650))) AS v (id, geom))) AS p ORDER BY p.id;
SELECT ST_AsEWKB(ST_GeometryN(typify(geom, 100000, 0, typify_options(count => 1, keep_area => 0.6)), 1))
	= ST_AsEWKB((typify_placeholders(geom, id, 100000, 0, typify_options(count => 1, keep_area => 0.6)))[1].geom) AS same FROM building;
SELECT id, typify_cluster(geom, 100000, 0, typify_options(count => 2, keep_area => 0.6)) OVER () AS cluster FROM building ORDER BY id;

-- the sample and the blocks at every scale
SELECT scale, sum(member_count) AS members, count(*) FILTER (WHERE large) AS large, count(*) FILTER (WHERE large AND p.id = b.id) AS there,
	count(*) FILTER (WHERE large AND p.id = b.id AND abs(p.area / ST_Area(b.geom) - 1) < 1e-9) AS in_size,
	count(*) FILTER (WHERE large AND p.id = b.id AND ST_Distance(ST_Centroid(p.geom), ST_Centroid(b.geom)) < 1e-6) AS in_place
FROM unnest(ARRAY[25000, 50000, 75000, 100000, 200000, 500000, 1000000]) AS scale, LATERAL (
	SELECT typify_placeholders(geom, id, scale, 0.5, typify_options(keep_area => 700 * (1000 / scale::float8) ^ 2)) AS list FROM settlement_buildings
	UNION ALL SELECT typify_placeholders(geom, 1000000 + id, scale, 0, typify_options(keep_area => 170 * (1000 / scale::float8) ^ 2)) FROM lod25 GROUP BY block) AS g,
	LATERAL (SELECT m, CASE WHEN m = p.members[1] THEN p.member_count END AS member_count, p.id, p.geom, p.area FROM unnest(list) AS p, unnest(p.members) AS m) AS p
	JOIN (SELECT id::bigint, geom, ST_Area(geom) >= 700 AS large FROM settlement_buildings
		UNION ALL SELECT 1000000 + id, geom, ST_Area(geom) >= 170 FROM lod25) AS b ON b.id = m
GROUP BY scale ORDER BY scale;

SELECT pg_temp.error_of(format('SELECT typify(geom, 50000, 0, typify_options(keep_area => %s)) FROM pg_temp.building', v))
FROM unnest(ARRAY['-1', '''NaN''', 'id']) AS v;
