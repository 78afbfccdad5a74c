-- quality.sql: what typify_quality says of layers whose figures are known by hand. At 1:50 000 a millimetre is 50 m.
\pset null '(null)'
\set SHOW_CONTEXT never
SET client_min_messages = warning;
CREATE SCHEMA typify_quality_test;
SET search_path = typify_quality_test, public;
\i tests/data/error_of.sql
CREATE FUNCTION box_at(x float8, y float8, width float8, height float8 DEFAULT NULL) RETURNS geometry LANGUAGE sql IMMUTABLE AS
$$ SELECT ST_MakeEnvelope(x, y, x + width, y + coalesce(height, width), 25832) $$;

-- eight buildings of 10 m; two are a member of each placeholder, but number 8, which is lost
CREATE TABLE source (id integer PRIMARY KEY, block text, geom geometry);
INSERT INTO source SELECT i, 'AB'::char(2), box_at(100 * i, 0, 10) FROM generate_series(1, 8) AS i;
INSERT INTO source VALUES (9, 'A', NULL), (10, 'A', 'SRID=25832;POLYGON EMPTY');
CREATE TABLE good (id integer, geom geometry, members integer[]);
INSERT INTO good VALUES (1, box_at(145, -5, 20), '{1, 2}'), (3, box_at(345, -5, 20), '{3, 4}'), (5, box_at(545, -5, 20), '{5, 6}'),
	(7, NULL, '{7}'), (8, 'SRID=25832;POLYGON EMPTY', '{1}');
SELECT buildings, asked, reached, not_drawn, members_not_drawn, lost, repeated FROM typify_quality('source', 'good', 50000);
SELECT overlapping, narrow_gaps, short_sides, barrier_crossings, barrier_gaps, members_across, rows_kept, dense_groups FROM typify_quality('source', 'good', 50000);
-- 50 m are a millimetre; 800 m2 and 1 200 m2 on the two cells of 500 m that have buildings
SELECT round(displacement_median::numeric, 6) AS median, round(displacement_p99::numeric, 6) AS p99, round(ink_before::numeric, 6) AS before, round(ink_after::numeric, 6) AS after,
	density_cell AS cell, density_correlation AS correlation, density_slope AS slope, road_angle_before, road_angle FROM typify_quality('source', 'good', 50000);
-- the law: groups each by itself, another exponent, a count, none
UPDATE source SET block = CASE WHEN id < 4 THEN 'A' WHEN id < 8 THEN 'B' END;
SELECT name, asked FROM (VALUES ('groups of 3, 4 and 1', 'block', NULL), ('exponent', NULL, typify_options(exponent => 1)), ('count', NULL, typify_options(count => 7)),
	('min_distance', NULL, typify_options(min_distance => 9)), ('min_distance and exponent', NULL, typify_options(min_distance => 9, exponent => 4))) AS v (name, grp, options),
	typify_quality('source', 'good', 50000, grp, options) ORDER BY name;

-- gaps and sides: which layer has what
CREATE TABLE cases (name text, geom geometry);
INSERT INTO cases VALUES
	('01 overlapping', box_at(0, 0, 20)), ('01 overlapping', box_at(15, 0, 20)),
	('02 one in the other', box_at(0, 0, 60)), ('02 one in the other', box_at(20, 20, 20)),
	('03 the same twice', box_at(0, 0, 20)), ('03 the same twice', box_at(0, 0, 20)),
	('04 three in one place', box_at(0, 0, 20)), ('04 three in one place', box_at(10, 0, 20)), ('04 three in one place', box_at(5, 10, 20)),
	('05 a common border', box_at(0, 0, 20)), ('05 a common border', box_at(20, 0, 20)),
	('06 a common corner', box_at(0, 0, 20)), ('06 a common corner', box_at(20, 20, 20)),
	('07 gap 0.19 mm', box_at(0, 0, 20)), ('07 gap 0.19 mm', box_at(29.5, 0, 20)),
	('08 gap 0.2 mm', box_at(0, 0, 20)), ('08 gap 0.2 mm', box_at(30, 0, 20)),
	('09 gap a millionth less', box_at(0, 0, 20)), ('09 gap a millionth less', box_at(29.999995, 0, 20)),
	('10 gap two hundred thousandths less', box_at(0, 0, 20)), ('10 gap two hundred thousandths less', box_at(29.9998, 0, 20)),
	('11 gap across corners', box_at(0, 0, 20)), ('11 gap across corners', box_at(27.2, 27.2, 20)),
	('12 gap 0.19 mm, far from the origin', box_at(5e6, 6e6, 20)), ('12 gap 0.19 mm, far from the origin', box_at(5e6 + 29.5, 6e6, 20)),
	('13 side 0.34 mm', box_at(0, 0, 17, 90)), ('14 side 0.35 mm', box_at(0, 0, 17.5, 90)), ('15 side 0.35 mm, turned', ST_Rotate(box_at(0, 0, 17.5, 90), 0.7)),
	('16 side 0.34 mm, turned', ST_Rotate(box_at(0, 0, 17, 90), 0.7)), ('17 L of sides 0.2 mm', ST_Difference(box_at(0, 0, 30), box_at(10, 10, 20))),
	('18 bow-ties that overlap', 'SRID=25832;POLYGON((0 0, 40 40, 40 0, 0 40, 0 0))'), ('18 bow-ties that overlap', 'SRID=25832;POLYGON((10 0, 50 40, 50 0, 10 40, 10 0))'),
	('19 multipolygon in a hole', 'SRID=25832;POLYGON((0 0, 90 0, 90 90, 0 90, 0 0), (10 10, 10 80, 80 80, 80 10, 10 10))'),
	('19 multipolygon in a hole', 'SRID=25832;MULTIPOLYGON(((30 30, 50 30, 50 50, 30 50, 30 30)), ((52 30, 60 30, 60 50, 52 50, 52 30)))');
CREATE FUNCTION gaps(wanted text, min_side float8 DEFAULT 17.5, min_gap float8 DEFAULT 10) RETURNS TABLE (overlapping bigint, narrow_gaps bigint, short_sides bigint, inked numeric) LANGUAGE sql AS
$$ SELECT overlapping, narrow_gaps, short_sides, round(inked::numeric, 2) FROM typify_quality_gaps(ARRAY(SELECT geom FROM cases WHERE name = wanted), ARRAY(SELECT point(ux, uy) FROM cases, typify_measures(geom) WHERE name = wanted), min_side, min_gap) $$;
SELECT name, g.* FROM (SELECT DISTINCT name FROM cases) AS c, gaps(name) AS g ORDER BY name;
SELECT g.* FROM gaps('05 a common border', 0, 0) AS g;
-- as one layer: cases apart from each other, no members, no ids
CREATE VIEW all_cases AS SELECT ST_Translate(geom, 500 * dense_rank() OVER (ORDER BY name), 0) AS shape FROM cases WHERE name !~ 'far';
CREATE VIEW no_ids AS SELECT geom FROM source;
SELECT reached, not_drawn, members_not_drawn, lost, repeated, overlapping, narrow_gaps, short_sides FROM typify_quality('no_ids', 'all_cases', 50000, result_geom_column => 'shape');
-- half the limits, and in feet
SELECT overlapping, narrow_gaps, short_sides FROM typify_quality('no_ids', 'all_cases', 25000, result_geom_column => 'shape');
SELECT overlapping, narrow_gaps, short_sides FROM typify_quality('no_ids', 'all_cases', 50000, result_geom_column => 'shape', min_side => 0.2, min_gap => 0.19);
CREATE VIEW feet_source AS SELECT id, ST_SetSRID(ST_Scale(geom, 1 / 0.3048, 1 / 0.3048), 2263) AS geom FROM source;
CREATE VIEW feet_layer AS SELECT ST_SetSRID(ST_Scale(shape, 1 / 0.30480060960121922, 1 / 0.30480060960121922), 2263) AS geom FROM all_cases;
SELECT overlapping, narrow_gaps, short_sides, round(density_cell::numeric, 3) AS cell FROM typify_quality('feet_source', 'feet_layer', 50000);

-- sides and measures of the exact rectangle; of an L the longer arm leads
SELECT round(width::numeric, 6) AS width, round(length::numeric, 6) AS length, round(ratio::numeric, 6) AS ratio, round(area::numeric, 3) AS area, round(x::numeric, 3) AS x, round(y::numeric, 3) AS y, round(ux::numeric, 6) AS ux, round(uy::numeric, 6) AS uy
FROM (VALUES (1, box_at(0, 0, 4, 2)), (2, ST_Rotate(box_at(0, 0, 4, 2), radians(30))), (3, 'POLYGON((0 0, 9 0, 9 3, 3 3, 3 6, 0 6, 0 0))'::geometry), (4, 'POINT(1 2)'), (5, 'LINESTRING(0 0, 3 4)'), (6, 'POLYGON EMPTY')) AS v (n, geom)
LEFT JOIN LATERAL typify_measures(geom) ON true LEFT JOIN LATERAL typify_sides(geom) ON true ORDER BY n;

-- barriers: one crosses the first placeholder, one is 20 m from the second, one is exactly as far from the third as it must be; each parts a building from its placeholder
CREATE TABLE lines (geom geometry);
INSERT INTO lines VALUES ('SRID=25832;LINESTRING(150 -100, 150 100)'), ('SRID=25832;MULTILINESTRING Z((385 -100 1, 385 0 1, 385 100 1), (0 900 1, 1 900 1))'), ('SRID=25832;LINESTRING(587.5 -100, 587.5 100)'),
	(NULL), ('SRID=25832;LINESTRING EMPTY');
SELECT barrier_crossings, barrier_gaps, members_across FROM typify_quality('source', 'good', 50000, barriers => 'lines', barrier_width => 0.5);
SELECT barrier_crossings, barrier_gaps, members_across FROM typify_quality('source', 'good', 50000, barriers => 'lines');
SELECT barrier_crossings, barrier_gaps, members_across FROM typify_quality('source', 'good', 50000, barriers => 'lines', barrier_width => 1);
-- angles: the nearest road has 30 degrees; off it by 0, 3, 3, 10 and 40
CREATE TABLE road AS SELECT 'SRID=25832;LINESTRING(0 -20, 86.60254037844386 30, 400 -60)'::geometry AS geom;
CREATE TABLE turned AS SELECT ST_Rotate(box_at(10 + x, -5, 20, 10), radians(turn), ST_SetSRID(ST_MakePoint(20 + x, 0), 25832)) AS geom FROM (VALUES (0, 30), (5, 123), (10, 33), (15, -50), (20, 80)) AS v (x, turn);
SELECT round(road_angle::numeric, 6) AS road_angle, round(road_angle_before::numeric, 3) AS before FROM typify_quality('source', 'turned', 50000, roads => 'road');
SELECT round(road_angle::numeric, 6) AS by_barriers FROM typify_quality('source', 'turned', 50000, barriers => 'road');
SELECT barrier_crossings, road_angle FROM typify_quality('source', 'turned', 50000, barriers => 'road', roads => 'lines');

-- displacement: by members 60, 40 and 10 m, by the nearest 40, 0 and 10
CREATE TABLE three (id bigint, geom geometry);
INSERT INTO three VALUES (1, box_at(0, 0, 10)), (2, box_at(100, 0, 10)), (3, box_at(200, 0, 10));
CREATE TABLE moved (geom geometry, "The members" bigint[]);
INSERT INTO moved VALUES (box_at(60, 0, 10), '{1, 2}'), (box_at(210, 0, 10), '{3}');
SELECT members_column, round((displacement_median * 50)::numeric, 6) AS median, round((displacement_p99 * 50)::numeric, 6) AS p99, lost
FROM (VALUES ('The members'), (NULL)) AS v (members_column), LATERAL typify_quality('three', 'moved', 50000, members_column => members_column) AS q ORDER BY 1;

-- density in cells of 500 m: 40, 20 and 0 buildings; halved, levelled, the wrong way round, in the wrong place
CREATE TABLE town AS SELECT i AS id, box_at(CASE WHEN i < 40 THEN 10 + i ELSE 610 + i END, 10, 1) AS geom FROM generate_series(0, 59) AS i;
CREATE FUNCTION placed(a integer, b integer, c integer) RETURNS TABLE (correlation numeric, slope numeric, settled bigint) LANGUAGE sql AS
$$ SELECT round(correlation::numeric, 4), round(slope::numeric, 4), settled FROM typify_quality_density(ARRAY(SELECT point(ST_X(ST_Centroid(geom)), 10) FROM town),
	ARRAY(SELECT point(100, 1) FROM generate_series(1, a)) || ARRAY(SELECT point(700, 1) FROM generate_series(1, b)) || ARRAY(SELECT point(-1, 1) FROM generate_series(1, c)), 500) $$;
SELECT a, b, c, p.* FROM (VALUES (20, 10, 0), (15, 15, 0), (10, 20, 0), (20, 0, 10), (40, 20, 0), (0, 0, 0)) AS v (a, b, c), placed(a, b, c) AS p ORDER BY 1, 2;

-- rows: two of 12 houses in straight lines, and scattered sheds; four placeholders on each line, one off the line by 4 m (kept) and 6 m (not), a row left with one, and a row of which a third is not drawn
CREATE TABLE street AS SELECT row_number() OVER () AS id, geom FROM (SELECT box_at(30 * i, 300 * j, 10) AS geom FROM generate_series(1, 12) AS i, generate_series(0, 1) AS j UNION ALL SELECT box_at(i * 7919 % 2003, 700 + i * 104729 % 1009, 3 + i % 5, 6) FROM generate_series(1, 12) AS i) AS h;
SELECT count(DISTINCT (r).number) AS rows, count(*) AS members FROM (SELECT typify_rows(geom) OVER () AS r FROM street) AS f WHERE (r).place IS NOT NULL;
CREATE FUNCTION on_street(off float8, thin integer, hidden integer) RETURNS TABLE (geom geometry, members bigint[]) LANGUAGE sql AS
$$
	SELECT CASE WHEN n > hidden THEN ST_Translate(ST_Envelope(ST_Collect(geom ORDER BY id)), 0, CASE WHEN n = 1 AND y = 0 THEN off ELSE 0 END) END, array_agg(id)
	FROM (SELECT id, geom, round(ST_YMin(geom)) AS y, (row_number() OVER (PARTITION BY ST_YMin(geom) ORDER BY ST_XMin(geom)) - 1) / thin + 1 AS n FROM street WHERE ST_YMin(geom) < 600) AS h GROUP BY y, n
$$;
CREATE TABLE drawn (geom geometry, members bigint[]);
CREATE FUNCTION rows_kept(off float8, thin integer, hidden integer) RETURNS float8 LANGUAGE plpgsql AS
$$ BEGIN
	TRUNCATE drawn;
	INSERT INTO drawn SELECT * FROM on_street(off, thin, hidden);
	RETURN (SELECT q.rows_kept FROM typify_quality('street', 'drawn', 50000) AS q);
END $$;
SELECT off, thin, hidden, rows_kept(off, thin, hidden) FROM (VALUES (0, 3, 0), (4, 3, 0), (6, 3, 0), (0, 6, 0), (0, 12, 0), (0, 6, 1), (0, 4, 1)) AS v (off, thin, hidden);
SELECT q.rows_kept AS too_small_a_scale FROM typify_quality('street', 'drawn', 5000000) AS q;

-- too dense: 400 houses of 100 m2 wall to wall want 200 placeholders of 250 m2 at least at 1:50 000; 20 m apart they have room, and one alone always
CREATE TABLE blocks AS SELECT row_number() OVER () AS id, grp, geom FROM (
	SELECT 'dense' AS grp, box_at(10 * i, 10 * j, 10) AS geom FROM generate_series(1, 20) AS i, generate_series(1, 20) AS j
	UNION ALL SELECT 'loose', box_at(2000 + 35 * i, 35 * j, 10) FROM generate_series(1, 20) AS i, generate_series(1, 20) AS j
	UNION ALL SELECT NULL, box_at(-500, 0, 10) UNION ALL SELECT 'row', box_at(-2000 + 12 * i, 0, 10) FROM generate_series(1, 12) AS i) AS b;
SELECT grp, buildings, asked, round(coverage::numeric, 2) AS coverage FROM typify_dense_groups('blocks', 50000, 'grp');
SELECT dense_groups FROM typify_quality('blocks', 'good', 50000, 'grp', members_column => 'members');
SELECT count(*) AS with_exponent_4 FROM typify_dense_groups('blocks', 50000, 'grp', typify_options(exponent => 4));
SELECT count(*) AS at_its_own_scale FROM typify_dense_groups('blocks', 25000, 'grp', min_side => 0, min_gap => 0);

-- nothing: a source, a layer, both, all rows not drawn
CREATE TABLE nothing (id bigint, geom geometry(Polygon, 25832), members bigint[]);
CREATE VIEW hidden AS SELECT NULL::geometry AS geom, '{1, 2}'::bigint[] AS members;
SELECT s, l, q.buildings, asked, reached, not_drawn, lost, overlapping, displacement_median AS displacement, ink_before IS NULL AS no_ink, density_correlation AS density, barrier_crossings, round(road_angle::numeric, 3) AS road_angle
FROM (VALUES ('source', 'nothing'), ('nothing', 'good'), ('nothing', 'nothing'), ('three', 'hidden')) AS v (s, l), LATERAL typify_quality(s::regclass, l::regclass, 50000, barriers => 'road') AS q ORDER BY 1, 2;
CREATE VIEW no_lines AS SELECT geom FROM lines WHERE false;
SELECT barrier_crossings, barrier_gaps, members_across, road_angle FROM typify_quality('source', 'good', 50000, barriers => 'no_lines');

-- typify's own: nobody is lost, and the counts are the law's
CREATE VIEW own AS SELECT * FROM typify_derive('blocks', NULL, 50000, 0.5, 'grp');
SELECT buildings, asked, reached, not_drawn, lost, repeated FROM typify_quality('blocks', 'own', 50000, 'grp');

-- the pairs against all pairs
CREATE TABLE many AS SELECT i, ST_Rotate(box_at(i * 7919 % 1009, i * 104729 % 1013, 10 + i % 40, 5 + i % 23), i) AS geom FROM generate_series(1, 300) AS i;
SELECT g.overlapping, g.narrow_gaps, g.overlapping = s.overlapping AND g.narrow_gaps = s.narrow_gaps AS as_slowly, abs(inked - ST_Area(ST_UnaryUnion((SELECT ST_Collect(geom) FROM many)))) < 1e-6 AS union
FROM typify_quality_gaps(ARRAY(SELECT geom FROM many), '{}', 5, 10) AS g,
	(SELECT count(*) FILTER (WHERE ST_Overlaps(a.geom, b.geom) OR ST_Contains(a.geom, b.geom) OR ST_Contains(b.geom, a.geom)) AS overlapping, count(*) FILTER (WHERE ST_Disjoint(a.geom, b.geom) AND ST_DWithin(a.geom, b.geom, 10)) AS narrow_gaps
	 FROM many AS a JOIN many AS b ON a.i < b.i) AS s;

-- errors
CREATE TABLE degrees AS SELECT 1 AS id, ST_SetSRID(box_at(7, 50, 1), 4326) AS geom;
CREATE TABLE other_srid AS SELECT 1 AS id, ST_SetSRID(box_at(7, 50, 1), 25833) AS geom;
CREATE TABLE points AS SELECT 1 AS id, 'SRID=25832;POINT(1 1)'::geometry AS geom;
CREATE TABLE curves AS SELECT 1 AS id, 'SRID=25832;CURVEPOLYGON(CIRCULARSTRING(0 0, 4 0, 4 4, 0 4, 0 0))'::geometry AS geom;
CREATE TABLE twice AS SELECT 1 AS id, geom FROM source;
CREATE TABLE texts AS SELECT 'a'::text AS id, geom, 'x'::text AS members FROM source;
SELECT pg_temp.error_of('SELECT typify_quality(' || arguments || ')') FROM (VALUES
	(1, 'NULL, ''good'', 50000'), (2, '''source'', NULL, 50000'), (3, '''source'', ''good'', NULL'), (4, '''source'', ''good'', 20000'), (5, '''source'', ''good'', ''NaN'''),
	(6, '''source'', ''good'', 50000, min_gap => NULL'), (7, '''source'', ''good'', 50000, min_side => -1'), (8, '''source'', ''good'', 50000, barrier_width => ''Infinity'''), (9, '''source'', ''good'', 50000, cell => 0'), (10, '''source'', ''good'', 50000, cell => NULL'),
	(11, '''source'', ''other_srid'', 50000'), (12, '''degrees'', ''degrees'', 50000'), (13, '''source'', ''good'', 50000, barriers => ''other_srid'''), (14, '''source'', ''points'', 50000'), (15, '''source'', ''curves'', 50000'),
	(16, '''source'', ''good'', 50000, barriers => ''good'''), (17, '''source'', ''good'', 50000, roads => ''points'''), (18, '''twice'', ''good'', 50000'), (19, '''texts'', ''good'', 50000'), (20, '''source'', ''good'', 50000, members_column => ''who'''),
	(21, '''source'', ''good'', 50000, result_geom_column => ''shape'''), (22, '''source'', ''good'', 50000, ''where'''), (23, '''source'', ''good'', 50000, roads => ''lines'', roads_geom_column => ''line'''), (24, '''source'', ''texts'', 50000'), (25, '''source'', ''good'', 50000, options => typify_options(count => 0)')) AS v (n, arguments) ORDER BY n;
SELECT pg_temp.error_of('SELECT * FROM typify_dense_groups(' || arguments || ')') FROM (VALUES (1, 'NULL, 50000'), (2, '''source'', NULL'), (3, '''source'', 50000, min_gap => NULL'), (4, '''source'', 50000, ''where''')) AS v (n, arguments) ORDER BY n;
SELECT pg_temp.error_of(query) FROM (VALUES (1, 'SELECT * FROM typify_box_pairs(ARRAY[NULL::box], ''{}'')'), (2, 'SELECT * FROM typify_box_pairs(ARRAY[box(point(0, 0), point(1, ''NaN''))], ''{}'')'), (3, 'SELECT typify_nearest_segments(ARRAY[point(0, 0)], ARRAY[lseg(point(0, 0), point(''Infinity'', 0))])'),
	(4, 'SELECT typify_measures(''SRID=4326;POINT(1 1)'')'), (5, 'SELECT typify_sides(''POINT(NaN 1)'')')) AS v (n, query) ORDER BY n;
SELECT count(*) AS pairs FROM typify_box_pairs('{}', '{}');
SELECT a_place, b_place FROM typify_box_pairs('{(1,1),(0,0);(9,9),(8,8)}', '{(3,3),(1,1);(8,9),(7,7);(99,99),(-99,-99)}') ORDER BY 1, 2;
SELECT typify_nearest_segments('{"(0,0)","(9,9)"}', '{}') AS none, typify_nearest_segments('{}', '{}') AS no_points, typify_nearest_segments('{"(0,0)","(9,9)"}', '{"[(8,0),(9,1)]","[(-1,-1),(-1,9)]"}') AS nearest;
DROP SCHEMA typify_quality_test CASCADE;
