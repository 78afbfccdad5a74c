-- legibility.sql: nothing overlaps or comes nearer than min_gap, inside a group and across groups, and nobody is lost
\i tests/data/error_of.sql
\set ECHO none
\i tests/data/settlement.sql
\set ECHO all
SET client_min_messages = error;
CREATE TEMP TABLE house AS SELECT id, block, geom::geometry AS geom FROM settlement_buildings;
-- houses on one another, a row of equal ones, points and lines
INSERT INTO house SELECT 100000 + i, 900, ST_Translate(ST_SetSRID(ST_MakeEnvelope(0, 0, 10, 8), 25832), x + i / 3 * 12, y)
FROM generate_series(1, 60) AS i, (SELECT ST_XMax(e) + 100 AS x, ST_YMax(e) AS y FROM (SELECT ST_Extent(geom) AS e FROM house) AS q) AS p;
INSERT INTO house SELECT 200000 + i, 901, ST_Translate(ST_SetSRID(CASE WHEN i % 2 = 0 THEN ST_MakePoint(0, 0) ELSE ST_MakeLine(ST_MakePoint(0, 0), ST_MakePoint(9, 9)) END, 25832), x + i * 7, y)
FROM generate_series(1, 30) AS i, (SELECT ST_XMax(e) + 100 AS x, ST_YMin(e) AS y FROM (SELECT ST_Extent(geom) AS e FROM house) AS q) AS p;

CREATE FUNCTION pg_temp.too_near(geoms geometry[], gap float8) RETURNS bigint LANGUAGE sql AS
$$
	WITH g AS MATERIALIZED (SELECT n, geom FROM unnest(geoms) WITH ORDINALITY AS g (geom, n) WHERE geom IS NOT NULL)
	SELECT count(*) FROM g AS a JOIN g AS b ON a.n < b.n AND a.geom && ST_Expand(b.geom, gap) AND ST_DWithin(a.geom, b.geom, gap * (1 - 1e-6))
$$;

-- one group: as many as the law says are asked for, violations of the plain result, and of the legible one
CREATE TEMP TABLE made AS
SELECT scale, s_u, shape, min_side, min_gap, min_gap * scale / 1000 AS gap, min_side * scale / 1000 AS side,
	typify_placeholders(geom, id, scale, s_u, o) AS list, typify(geom, scale, s_u, o) AS picture,
	typify_placeholders(geom, id, scale, s_u, typify_options(shape => shape, min_side => min_side)) AS plain
FROM house, unnest(ARRAY[75000, 100000, 500000]::float8[]) AS scale, unnest(ARRAY[0.5]::float8[]) AS s_u,
	(VALUES ('rectangle', 0.35, 0.2), ('square', 0.35, 0.1), ('rectangle', 0, 0.2), ('footprint', 0.35, 0.2)) AS v (shape, min_side, min_gap),
	LATERAL (SELECT typify_options(shape => shape, min_side => min_side, min_gap => min_gap) AS o) AS opt
GROUP BY scale, s_u, shape, min_side, min_gap, o;
SELECT scale, s_u, shape, min_side, cardinality(plain) AS asked, cardinality(list) BETWEEN 0.3 * cardinality(plain) AND cardinality(plain) AS enough_left,
	pg_temp.too_near((SELECT array_agg(geom) FROM unnest(plain)), gap) > 0 AS crowded_before, pg_temp.too_near((SELECT array_agg(geom) FROM unnest(list)), gap) AS too_near,
	(SELECT sum(member_count) FROM unnest(list)) AS members, (SELECT count(DISTINCT m) FROM unnest(list) AS p, unnest(p.members) AS m) AS different,
	(SELECT count(*) FROM unnest(list) WHERE geom IS NOT NULL AND width < side * (1 - 1e-6)) AS too_small
FROM made ORDER BY shape, min_side, s_u, scale;
-- the collection is the same picture
SELECT count(*) FILTER (WHERE ST_NumGeometries(picture) <> (SELECT count(geom) FROM unnest(list))) AS other_number,
	count(*) FILTER (WHERE (SELECT array_agg(ST_AsEWKB((d).geom) ORDER BY (d).path) FROM ST_Dump(picture) AS d)
		<> (SELECT array_agg(ST_AsEWKB(geom) ORDER BY n) FILTER (WHERE geom IS NOT NULL) FROM unnest(list) WITH ORDINALITY AS p (id, geom, c, m, a, w, l, o, n))) AS other_pictures FROM made;
-- number k of typify_cluster is element k + 1
SELECT count(*) AS other_members FROM (SELECT id, geom, typify_cluster(geom, 100000, 0.5, typify_options(min_side => 0.35, min_gap => 0.2)) OVER () AS k FROM house) AS c
WHERE NOT EXISTS (SELECT FROM made, unnest(list[k + 1].members) AS m, house AS twin WHERE twin.id = m AND (m = c.id OR twin.geom = c.geom) AND scale = 100000 AND s_u = 0.5 AND shape = 'rectangle' AND min_side > 0);
-- any order of rows, any plan
SELECT count(DISTINCT md5(ST_AsEWKB(t))) AS results FROM (
	SELECT typify(geom, 75000, 0.5, typify_options(min_side => 0.35, min_gap => 0.2) ORDER BY o) AS t
	FROM (SELECT geom, round, hashint8extended(id, round) AS o FROM house, generate_series(1, 8) AS round) AS h GROUP BY round) AS r;

-- the whole layer: across groups too; who does not fit is a row without geometry
CREATE TEMP TABLE layer AS
SELECT scale, d.* FROM unnest(ARRAY[50000, 100000]::float8[]) AS scale, LATERAL typify_derive('house', NULL, scale, 0.5, 'block', options => typify_options(min_side => 0.35, min_gap => 0.2)) AS d;
CREATE TEMP TABLE by_group AS
SELECT scale, d.* FROM unnest(ARRAY[50000, 100000]::float8[]) AS scale, LATERAL typify_derive('house', NULL, scale, 0.5, 'block', options => typify_options(min_side => 0.35, min_gap => 0.2),
	groups => (SELECT array_agg(DISTINCT block::text) FROM house)) AS d;
SELECT scale, count(*) AS rows, count(geom) > 0.6 * count(*) AS most_drawn, count(*) FILTER (WHERE (geom IS NULL) <> (area = 0 AND width = 0 AND length = 0)) AS half_drawn, sum(member_count) AS members,
	pg_temp.too_near(array_agg(geom), 0.2 * scale / 1000) AS too_near, count(*) FILTER (WHERE geom IS NOT NULL AND width < 0.35 * scale / 1000 * (1 - 1e-6)) AS too_small,
	count(*) FILTER (WHERE abs(ST_Area(geom) - area) > 1e-6 * area) AS other_area
FROM layer GROUP BY scale ORDER BY scale;
-- the members are those of each group by itself and of those of the group that did not fit; where there was room nothing changed
SELECT count(*) AS rows, count(*) FILTER (WHERE l.members[:cardinality(g.members)] <> g.members OR l.grp <> g.grp) AS other_members,
	count(*) FILTER (WHERE l.members <> g.members) > 0 AS some_took_over, count(*) FILTER (WHERE l.geom::bytea = g.geom::bytea) > 0.2 * count(*) AS many_the_same,
	pg_temp.too_near((SELECT array_agg(geom) FROM by_group WHERE scale = 100000), 20) > 0 AS groups_were_too_near
FROM layer AS l JOIN by_group AS g USING (scale, id);
-- bound to its vertex: nobody is farther from the mean of its members than the gap or half its length
SELECT count(*) AS too_far FROM (SELECT scale, p.id, p.geom, p.length, ST_SetSRID(ST_MakePoint(avg(ST_X(ST_Centroid(h.geom))), avg(ST_Y(ST_Centroid(h.geom)))), 25832) AS mean
	FROM layer AS p JOIN by_group AS g USING (scale, id, members), unnest(p.members) AS m JOIN house AS h ON h.id = m WHERE p.geom IS NOT NULL GROUP BY scale, p.id, p.geom, p.length) AS q
WHERE ST_Distance(ST_Centroid(geom), mean) > greatest(0.2 * scale / 1000, length / 2) * 1.000001;
-- footprints too, and in feet
SELECT pg_temp.too_near(array_agg(geom), 10) AS footprints_too_near, count(geom) > 100 AS drawn FROM typify_derive('house', NULL, 50000, 0.5, 'block', options => typify_options(min_side => 0.35, min_gap => 0.2, shape => 'footprint'));
SELECT pg_temp.too_near(array_agg(p.geom), 10 / 0.3048) AS too_near, count(*) AS left, min(width) >= 17.5 / 0.3048006096 * (1 - 1e-6) AS wide_enough
FROM unnest((SELECT typify_placeholders(ST_SetSRID(ST_MakePoint(i * 31, 0), 2272), i, 50000, 0, typify_options(exponent => 0, min_side => 0.35, min_gap => 0.2)) FROM generate_series(1, 20) AS i)) AS p;
RESET client_min_messages;
-- one group on another: half of it does not fit
CREATE TEMP TABLE twins AS SELECT i AS id, i % 2 AS block, ST_MakeEnvelope(i / 2 * 60, 0, i / 2 * 60 + 10, 10) AS geom FROM generate_series(0, 19) AS i;
SELECT count(*) AS rows, count(geom) AS drawn, sum(member_count) AS members FROM typify_derive('twins', NULL, 100000, group_by => 'block', options => typify_options(exponent => 0, min_side => 0.35, min_gap => 0.2));
SELECT pg_temp.error_of('SELECT typify_settle(1, 1, 1, 0, ARRAY[1.0], NULL)');
-- barriers: nothing comes nearer to a road of 0.5 mm than half of it and the gap, nor is on its other side; kept ones stay
SET client_min_messages = error;
CREATE TEMP TABLE road AS SELECT ST_Collect(geom) AS geom FROM settlement_roads WHERE class = 'main';
CREATE TEMP TABLE beside AS
SELECT scale, p.* FROM (SELECT 50000 AS scale, typify_placeholders(geom, id, 50000, 0.5, (SELECT typify_options(min_side => 0.35, min_gap => 0.2, barriers => geom, barrier_width => 0.5) FROM road)) AS list FROM house
	UNION ALL SELECT 100000, typify_placeholders(geom, id, 100000, 0.5, (SELECT typify_options(min_side => 0.35, min_gap => 0.2, barriers => geom, barrier_width => 0.5) FROM road)) FROM house) AS q, unnest(list) AS p;
SELECT scale, count(*) > 100 AS many, sum(member_count) AS members, pg_temp.too_near(array_agg(beside.geom), 0.2 * scale / 1000) AS too_near,
	count(*) FILTER (WHERE ST_Distance(beside.geom, road.geom) < 0.45 * scale / 1000 * (1 - 1e-6)) AS too_near_to_a_road
FROM beside, road GROUP BY scale ORDER BY scale;
SELECT pg_temp.too_near(array_agg(d.geom), 10) AS too_near, count(*) FILTER (WHERE ST_Distance(d.geom, road.geom) < 22.5 * (1 - 1e-6)) AS too_near_to_a_road, sum(member_count) AS members
FROM road, typify_derive('house', NULL, 50000, 0.5, 'block', options => (SELECT typify_options(min_side => 0.35, min_gap => 0.2, barriers => geom, barrier_width => 0.5) FROM road)) AS d;
RESET client_min_messages;
SELECT id, ST_AsText(ST_Centroid(geom), 3) AS at, round(width::numeric, 3) AS width, member_count FROM unnest((SELECT typify_placeholders(ST_MakeEnvelope(i * 30, 0, i * 30 + 40, 40), i, 50000, 0, typify_options(exponent => 0, min_side => 0.35, min_gap => 0.2),
	CASE WHEN i IN (3, 4) THEN 'Infinity'::float8 ELSE 1 END) FROM generate_series(1, 6) AS i)) AS p WHERE id IN (3, 4) ORDER BY id;
-- kept ones stay in place and in size, whatever is beside them; over a layer each kind of collision is told of once
CREATE TEMP TABLE hall AS
SELECT i AS id, i % 3 AS block, ST_MakeEnvelope(i * 30, 0, i * 30 + 40, 40) AS geom, CASE WHEN i % 5 IN (0, 1) THEN 'Infinity'::float8 ELSE 1 END AS worth FROM generate_series(1, 20) AS i;
SELECT d.id, d.geom IS NOT NULL AS drawn, ST_Distance(ST_Centroid(d.geom), ST_Centroid(h.geom)) < 1e-9 AS in_place, round(d.width::numeric, 3) AS width, round(d.length::numeric, 3) AS length
FROM typify_derive('hall', NULL, 100000, 0, 'block', importance_column => 'worth', options => typify_options(exponent => 0, min_side => 0.35, min_gap => 0.2,
	barriers => ST_GeomFromText('LINESTRING(165 -100, 165 100)'), barrier_width => 0.5)) AS d JOIN hall AS h USING (id) WHERE worth > 1 ORDER BY d.id;
DROP VIEW hamlet;
DROP TABLE settlement_buildings, settlement_roads, settlement_blocks;
