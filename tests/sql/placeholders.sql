-- placeholders.sql: nobody is lost, and all forms tell the same story
CREATE TEMP TABLE building AS
SELECT i * 3 - 700 AS id, i % 4 AS block, CASE WHEN i % 10 = 0 THEN ST_MakePoint(x, y) ELSE ST_MakeEnvelope(x, y, x + 6 + i % 11, y + 7 + i % 7) END AS geom
FROM (SELECT i, i * 37 % 101 * 13 AS x, i * 53 % 97 * 11 AS y FROM generate_series(1, 500) AS i) AS b;
-- a row of equal houses, and houses on one another
INSERT INTO building SELECT 10000 + i, 5, ST_MakeEnvelope(i / 2 * 20, 0, i / 2 * 20 + 10, 8) FROM generate_series(1, 60) AS i;

SET client_min_messages = error;
CREATE TEMP TABLE placeholder AS
SELECT block, scale, s_u, p.* FROM (
	SELECT block, scale, s_u, typify_placeholders(geom, id, scale, s_u) AS list
	FROM building, unnest(ARRAY[25000, 50000, 75000, 200000, 1000000]) AS scale, unnest(ARRAY[0, 0.5, 1]) AS s_u GROUP BY block, scale, s_u
) AS g, unnest(list) WITH ORDINALITY AS p (id, geom, member_count, members, area, width, length, orientation, number);

-- every building is a member exactly once; counts add up; the representative is a member; members ascend
SELECT scale, s_u, sum(member_count) AS members, (SELECT count(*) FROM building) AS buildings,
	   bool_and(member_count = cardinality(members)) AS counted, bool_and(id = ANY (members)) AS representative_is_member,
	   bool_and(members = (SELECT array_agg(m ORDER BY m) FROM unnest(members) AS m)) AS ascending, bool_and(array_lower(members, 1) = 1) AS from_1,
	   count(*) FILTER (WHERE (geom IS NULL) <> (area = 0)) AS drawn_but_without_size
FROM placeholder GROUP BY scale, s_u ORDER BY scale, s_u;
SELECT count(*) AS not_exactly_once FROM (SELECT b.id, scale, s_u FROM placeholder AS p, unnest(members) AS m JOIN building AS b ON b.id = m WHERE b.block = p.block
	GROUP BY b.id, scale, s_u HAVING count(*) <> 1) AS q;
SELECT count(*) AS lost FROM building, unnest(ARRAY[25000, 75000]) AS scale WHERE NOT EXISTS (SELECT FROM placeholder AS p WHERE p.block = building.block AND p.scale = scale AND building.id = ANY (members));
-- as many as the law says
SELECT count(*) AS other_count FROM (SELECT block, scale, count(*) AS n, sum(member_count) AS buildings FROM placeholder GROUP BY block, scale, s_u) AS q WHERE n <> typify_count(buildings::bigint, scale);

-- the collection holds the drawn placeholders in the same order, with the same bytes
SELECT count(*) AS groups, bool_and(t::bytea = ST_Collect(geoms)::bytea OR ST_AsEWKB(t) = ST_AsEWKB(ST_ForceCollection(ST_Collect(geoms)))) AS same_pictures, bool_and(ST_NumGeometries(t) = cardinality(geoms)) AS same_number
FROM (SELECT block, scale, s_u, typify(geom, scale, s_u) AS t FROM building, unnest(ARRAY[25000, 50000, 75000, 200000, 1000000]) AS scale, unnest(ARRAY[0, 0.5, 1]) AS s_u GROUP BY block, scale, s_u) AS c
JOIN (SELECT block, scale, s_u, array_agg(geom ORDER BY number) FILTER (WHERE geom IS NOT NULL) AS geoms FROM placeholder GROUP BY block, scale, s_u) AS p USING (block, scale, s_u)
WHERE geoms IS NOT NULL;

-- number k of typify_cluster is element k + 1; where equal houses lie on one another any of them may be meant
SELECT count(*) AS rows, count(*) FILTER (WHERE b.id = ANY (p.members) OR EXISTS (SELECT FROM building AS twin WHERE twin.block = b.block AND twin.geom = b.geom AND twin.id = ANY (p.members))) AS same
FROM (SELECT id, geom, block, scale, s_u, typify_cluster(geom, scale, s_u) OVER (PARTITION BY block, scale, s_u) AS k FROM building, unnest(ARRAY[25000, 50000, 75000, 200000]) AS scale, unnest(ARRAY[0, 0.5]) AS s_u) AS b
JOIN placeholder AS p ON p.block = b.block AND p.scale = b.scale AND p.s_u = b.s_u AND p.number = k + 1;
SELECT count(*) AS other_sizes FROM (SELECT block, scale, k, count(*) AS n FROM (SELECT block, scale, typify_cluster(geom, scale) OVER (PARTITION BY block, scale) AS k FROM building, unnest(ARRAY[50000, 200000]) AS scale) AS c GROUP BY block, scale, k) AS c
JOIN placeholder AS p ON p.block = c.block AND p.scale = c.scale AND p.s_u = 0 AND p.number = k + 1 WHERE n <> member_count;

-- the centre is the mean of all members' centroids (up to the grid)
SELECT max(ST_Distance(ST_Centroid(p.geom), ST_MakePoint(x, y))) < 1e-4 AS at_the_mean
FROM placeholder AS p, LATERAL (SELECT avg(ST_X(ST_Centroid(geom))) AS x, avg(ST_Y(ST_Centroid(geom))) AS y FROM building WHERE id = ANY (p.members)) AS m WHERE p.geom IS NOT NULL;
RESET client_min_messages;

-- the row type, field by field
SELECT attname, format_type(atttypid, atttypmod) FROM pg_attribute WHERE attrelid = 'typify_placeholder'::regclass ORDER BY attnum;
-- one building, one placeholder, members in order
SELECT p.id, ST_AsText(p.geom, 6) AS geom, p.member_count, p.members, round(p.area::numeric, 6) AS area, round(p.width::numeric, 6) AS width, round(p.length::numeric, 6) AS length, p.orientation
FROM unnest((SELECT typify_placeholders(ST_MakeEnvelope(i, 0, i + 4, 2 + i % 2 * 2), 10 - i, 200000, 0, typify_options(psi => 1 - 1 / 64.0)) FROM generate_series(1, 3) AS i)) AS p;
