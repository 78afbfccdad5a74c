-- outlines.sql: shape => footprint draws the representative's own outline, scaled to the area and in its place
\i tests/data/error_of.sql

CREATE TEMP TABLE building (id int, name text, geom geometry);
INSERT INTO building VALUES
	(1, 'L', 'POLYGON((0 0, 20 0, 20 8, 8 8, 8 20, 0 20, 0 0))'),
	(2, 'court', 'POLYGON((100 0, 130 0, 130 30, 100 30, 100 0), (110 10, 110 20, 120 20, 120 10, 110 10))'),
	(3, 'parts', 'MULTIPOLYGON(((200 0, 205 0, 205 5, 200 5, 200 0)), ((210 0, 230 0, 230 10, 210 10, 210 0)))'),
	(4, 'bow-tie', 'POLYGON((300 0, 330 20, 330 0, 300 10, 300 0))'),
	(5, 'triangle with Z', 'POLYGON Z((400 0 1, 420 0 2, 410 20 3, 400 0 1))'),
	(6, 'well', 'POINT(500 0)');

-- at the source scale every outline is what it was; of several parts the largest, by the area of all
SELECT b.name, ST_AsText(ST_SnapToGrid(p.geom, 0.001), 3) AS drawn, round(p.area::numeric, 3) AS area,
	round(ST_Area(p.geom)::numeric, 3) AS area_drawn, round(width::numeric, 3) AS width, round(length::numeric, 3) AS length
FROM building AS b, unnest((SELECT typify_placeholders(geom, id, 25000, 0, typify_options(shape => 'footprint')) FROM building)) AS p
WHERE b.id = p.id ORDER BY b.id;
-- enlarged: the centroid and the shape stay, the area is A_n
SELECT b.name, round(ST_Distance(ST_Centroid(p.geom), ST_SetSRID(ST_Centroid(b.geom), 2056))::numeric, 6) AS moved,
	round((ST_Area(p.geom) / ST_Area(b.geom))::numeric, 6) AS factor, round(typify_area_factor(100000)::numeric, 6) AS asked,
	round((ST_Perimeter(p.geom) / ST_Perimeter(b.geom))::numeric, 6) AS lengths, ST_NumInteriorRings(p.geom) AS holes, ST_SRID(p.geom) AS srid
FROM building AS b, unnest((SELECT typify_placeholders(geom, id, 100000, 0, typify_options(shape => 'footprint', exponent => 0))
	FROM (SELECT id, ST_SetSRID(geom, 2056) AS geom FROM building) AS b)) AS p
WHERE b.id = p.id AND b.id IN (1, 2, 5) ORDER BY b.id;
-- of two, the larger one's outline at the middle of both, with the mean of their areas
SELECT p.id, p.member_count, ST_AsText(ST_Centroid(p.geom), 2) AS centre, round(ST_Area(p.geom)::numeric, 3) AS area, ST_NPoints(p.geom) AS points
FROM unnest((SELECT typify_placeholders(geom, id, 25000, 0, typify_options(shape => 'footprint', count => 1)) FROM building WHERE id IN (1, 5))) AS p;
-- min_side is the short side of the rectangle around it, max_area its own area
SELECT b.name, round(width::numeric, 2) AS width, round(area::numeric, 2) AS area, round((area / ST_Area(p.geom))::numeric, 6) AS told
FROM building AS b, unnest((SELECT typify_placeholders(geom, id, 100000, 0, typify_options(shape => 'footprint', exponent => 0, min_side => 0.5, max_area => 0.1))
	FROM building WHERE id < 6)) AS p
WHERE b.id = p.id ORDER BY b.id;

-- auto: kept buildings have their own outline without small detours, in place and with their own area; others a rectangle
CREATE TEMP TABLE town AS SELECT * FROM building WHERE id IN (1, 2, 3) UNION ALL VALUES
	(7, 'hall with a niche', 'POLYGON((0 100, 40 100, 40 110, 39.5 110, 39.5 112, 40 112, 40 140, 20 140, 20 120, 0 120, 0 100))'::geometry),
	(8, 'bow-tie', 'POLYGON((100 100, 150 140, 150 100, 100 140, 100 100))');
SELECT b.name, ST_AsText(ST_SnapToGrid(p.geom, 0.01)) AS drawn, round((ST_Area(p.geom) / ST_Area(b.geom))::numeric, 3) AS factor, p.member_count
FROM town AS b, unnest((SELECT typify_placeholders(geom, id, 50000, 0, typify_options(shape => 'auto', exponent => 0, keep_area => 0.2)) FROM town)) AS p
WHERE b.id = p.id ORDER BY b.id;
-- at a scale where all of it is a detour it is still there; which corners remain, GEOS 3.13 answers otherwise than before
SELECT b.name, round(ST_Distance(ST_Centroid(p.geom), ST_Centroid(b.geom))::numeric) AS moved, ST_NumInteriorRings(p.geom) AS holes, round(p.area::numeric, 3) AS area, p.members
FROM town AS b, unnest((SELECT typify_placeholders(geom, id, 1000000, 0, typify_options(shape => 'auto', keep_area => 100), CASE id WHEN 2 THEN float8 'Infinity' END) FROM town)) AS p
WHERE b.id = p.id ORDER BY b.id;

-- the aggregate of geometries draws the same; a cast to text and back, that PostGIS writes it the same; any order of rows
CREATE TEMP TABLE many AS SELECT i AS id, i % 3 AS block, ST_SetSRID(CASE WHEN i % 3 = 0 THEN ST_Translate(l.geom, x, y) WHEN i % 3 = 1 THEN ST_MakeEnvelope(x, y, x + 9, y + 12)
	ELSE ST_Multi(ST_Translate(t.geom, x - 400, y)) END, 2056) AS geom
FROM (SELECT i, i * 7919 % 1009 * 4 AS x, i * 104729 % 1013 * 4 AS y FROM generate_series(1, 1200) AS i) AS place, building AS l, building AS t WHERE l.id = 1 AND t.id = 5;
SELECT ST_AsEWKB(ST_Collect(p.geom ORDER BY n)) = ST_AsEWKB(ST_CollectionExtract(t, 3)) AS same, count(*), t::bytea = t::text::geometry::bytea AS as_postgis_writes,
	bool_and(ST_IsValid(p.geom)) AS valid
FROM (SELECT typify(geom, 75000, 0.5, typify_options(shape => 'footprint')) AS t, typify_placeholders(geom, id, 75000, 0.5, typify_options(shape => 'footprint')) AS list FROM many) AS b,
	unnest(list) WITH ORDINALITY AS p (id, geom, member_count, members, area, width, length, orientation, n) GROUP BY t;
SELECT count(DISTINCT md5(t::bytea)) AS answers FROM (
	SELECT typify(geom, 75000, 0.5, typify_options(shape => 'footprint') ORDER BY md5((id * seed)::text)) AS t FROM many, generate_series(1, 20) AS seed GROUP BY seed) AS t;
-- and the same members as with rectangles
SELECT count(*) AS different FROM unnest((SELECT typify_placeholders(geom, id, 75000, 0.5) FROM many)) AS r
FULL JOIN unnest((SELECT typify_placeholders(geom, id, 75000, 0.5, typify_options(shape => 'footprint')) FROM many)) AS f USING (id, members) WHERE r.geom IS NULL OR f.geom IS NULL;

-- workers carry outlines
CREATE TABLE typify_test_outlines AS SELECT * FROM many, generate_series(1, 5) AS copy;
ANALYZE typify_test_outlines;
SET parallel_setup_cost = 0;
SET parallel_tuple_cost = 0;
SET min_parallel_table_scan_size = 0;
SET max_parallel_workers_per_gather = 2;
SELECT md5(string_agg(md5(t::bytea), '' ORDER BY block)) AS parallel FROM (SELECT block, typify(ST_Translate(geom, 5000 * copy, 0), 75000, 0.5, typify_options(shape => 'footprint')) AS t FROM typify_test_outlines GROUP BY block) AS q \gset
SET max_parallel_workers_per_gather = 0;
SELECT md5(string_agg(md5(t::bytea), '' ORDER BY block)) = :'parallel' AS same_as_serial FROM (SELECT block, typify(ST_Translate(geom, 5000 * copy, 0), 75000, 0.5, typify_options(shape => 'footprint')) AS t FROM typify_test_outlines GROUP BY block) AS q;
DROP TABLE typify_test_outlines;
