-- importance_tables.sql: importance and sheds of whole tables and stored layers
SET client_min_messages = warning;
\i tests/data/error_of.sql
\i tests/data/two_levels.sql
CREATE TABLE typify_test_lod25 (id integer PRIMARY KEY, block text, geom geometry(Polygon, 25832), worth real, words text);
INSERT INTO typify_test_lod25 SELECT *, CASE WHEN id % 7 = 0 THEN 'Infinity'::real WHEN id % 5 = 0 THEN 2 END, 'two' FROM lod25;
CREATE TABLE typify_test_lod200 AS SELECT * FROM lod200;

-- the same as the aggregate with the group's options
SELECT count(*) AS rows, count(*) FILTER (WHERE d.geom = p.geom AND d.members = p.members AND d.area = p.area) AS same
FROM typify_derive('typify_test_lod25', 'typify_test_lod200', 75000, 0.5, 'block', importance_column => 'worth') AS d
FULL JOIN (
	SELECT (unnest(list)).* FROM (
		SELECT typify_placeholders(b.geom, b.id, 75000, 0.5, c.options, b.worth) AS list FROM typify_test_lod25 AS b
		JOIN typify_calibrate('typify_test_lod25', 'typify_test_lod200', 0.5, 'block', importance_column => 'worth') AS c
			ON c.grp IS NOT DISTINCT FROM b.block AND NOT c.overall GROUP BY c.grp) AS g) AS p USING (id);
SELECT count(*) AS rows, count(*) FILTER (WHERE d.geom = p.geom AND d.members = p.members AND d.area = p.area) AS same
FROM typify_derive('typify_test_lod25', NULL, 75000, importance_column => 'worth') AS d
FULL JOIN unnest((SELECT typify_placeholders(geom, id, 75000, 0, NULL, worth) FROM typify_test_lod25)) AS p USING (id);
-- kept buildings are there, whatever the count of the group
SELECT scale, count(*) AS rows, sum(d.member_count) AS members, count(*) FILTER (WHERE b.worth = 'Infinity') AS kept,
	count(*) FILTER (WHERE b.worth = 'Infinity' AND abs(d.area / ST_Area(b.geom) - 1) < 1e-9) AS in_size
FROM unnest(ARRAY[50000, 200000, 1000000]) AS scale, LATERAL typify_derive('typify_test_lod25', 'typify_test_lod200', scale, 0, 'block', importance_column => 'worth') AS d
	JOIN typify_test_lod25 AS b USING (id) GROUP BY scale ORDER BY scale;
-- psi is found for what is scaled and what is kept together: the areas of both as they are
SELECT c.grp, round(c.mean_placeholder_area::numeric, 6) = round((SELECT avg(p.area) FROM unnest((
	SELECT typify_placeholders(geom, id, 200000, 0, typify_options(exponent => c.exponent, psi => 63 / 64.0), worth) FROM typify_test_lod25 AS b WHERE b.block = c.grp)) AS p)::numeric, 6) AS same
FROM typify_calibrate('typify_test_lod25', 'typify_test_lod200', 0, 'block', importance_column => 'worth') AS c WHERE grp IN ('3', '7') ORDER BY grp;
-- keep_area is no part of it
SELECT count(*) AS groups, count(*) FILTER (WHERE a.psi = b.psi AND a.exponent = b.exponent) AS same
FROM typify_calibrate('typify_test_lod25', 'typify_test_lod200', 0, 'block') AS a
JOIN typify_calibrate('typify_test_lod25', 'typify_test_lod200', 0, 'block', typify_options(keep_area => 0.001)) AS b
	ON a.grp IS NOT DISTINCT FROM b.grp AND a.overall = b.overall;

-- sheds: the counts are those of the houses, and nobody is lost; block bare has nothing else
UPDATE typify_test_lod25 SET geom = ST_SetSRID(ST_MakeEnvelope(ST_XMin(geom), ST_YMin(geom), ST_XMin(geom) + 3, ST_YMin(geom) + 3), 25832) WHERE block = 'bare';
SELECT coalesce(grp, 'none') AS grp, n25, n200, round(mean_area25::numeric, 2) AS mean_area25, calibrated
FROM typify_calibrate('typify_test_lod25', 'typify_test_lod200', 0, 'block', typify_options(min_area => 100)) WHERE NOT overall ORDER BY 1;
SELECT scale, count(*) AS rows, sum(member_count) AS members, count(*) FILTER (WHERE geom IS NULL) AS undrawn,
	count(*) FILTER (WHERE c.calibrated) AS of_calibrated, sum(DISTINCT c.n200) FILTER (WHERE c.calibrated AND c.grp ~ '[1-9]') AS n200_of_nine,
	count(*) FILTER (WHERE c.grp ~ '[1-9]') AS of_nine, round((avg(area) FILTER (WHERE c.grp = '9'))::numeric, 3) = round(max(mean_area200) FILTER (WHERE c.grp = '9')::numeric, 3) AS mean_area_of_9
FROM unnest(ARRAY[25000, 200000]) AS scale, LATERAL typify_derive('typify_test_lod25', 'typify_test_lod200', scale, 0, 'block', options => typify_options(min_area => 100)) AS d
	JOIN typify_calibrate('typify_test_lod25', 'typify_test_lod200', 0, 'block', typify_options(min_area => 100)) AS c
	ON c.grp IS NOT DISTINCT FROM d.grp AND NOT c.overall GROUP BY scale ORDER BY scale;
SELECT count(*) AS rows, sum(member_count) AS members, count(*) FILTER (WHERE geom IS NULL) AS undrawn
FROM typify_derive('typify_test_lod25', NULL, 100000, 0, 'block', options => typify_options(min_area => 100), allocation => 'total');

-- layers know the column
CREATE TEMP TABLE expected AS SELECT * FROM typify_derive('typify_test_lod25', 'typify_test_lod200', 100000, 0, 'block', importance_column => 'worth');
SELECT typify_create_scale('typify_test_view', 'typify_test_lod25', 'typify_test_lod200', 100000, 0, 'block', options => typify_options(min_side => 0, min_gap => 0), importance_column => 'worth') AS layer;
SELECT typify_create_scale('typify_test_table', 'typify_test_lod25', 'typify_test_lod200', 100000, 0, 'block', 'table', options => typify_options(min_side => 0, min_gap => 0), importance_column => 'worth') AS layer;
CALL typify_build_scale('typify_test_built', 'typify_test_lod25', 'typify_test_lod200', 100000, 0, 'block', options => typify_options(min_side => 0, min_gap => 0), importance_column => 'worth', batch => 4);
SELECT obj_description('typify_test_built'::regclass)::json->>'importance_column' AS column;
CREATE FUNCTION pg_temp.differ(layer regclass) RETURNS bigint LANGUAGE plpgsql AS
$$
DECLARE
	n bigint;
BEGIN
	EXECUTE format('SELECT count(*) FROM %s AS l FULL JOIN expected AS e USING (id) WHERE (l.geom = e.geom AND l.area = e.area AND l.members = e.members) IS NOT TRUE', layer) INTO n;
	RETURN n;
END
$$;
SELECT l AS layer, pg_temp.differ(l) AS differ FROM unnest(ARRAY['typify_test_view', 'typify_test_table', 'typify_test_built']::regclass[]) AS l;
-- a building that is kept from now on
UPDATE typify_test_lod25 SET worth = 'Infinity' WHERE block = '8' AND id % 5 = 0;
TRUNCATE expected;
INSERT INTO expected SELECT * FROM typify_derive('typify_test_lod25', 'typify_test_lod200', 100000, 0, 'block', importance_column => 'worth');
SELECT pg_temp.differ('typify_test_table') > 0 AS stale, typify_refresh_groups('typify_test_table', ARRAY['8']) > 0 AS refreshed, typify_refresh_scale('typify_test_view') IS NOT NULL AS view;
SELECT l AS layer, pg_temp.differ(l) AS differ FROM unnest(ARRAY['typify_test_view', 'typify_test_table']::regclass[]) AS l;

SELECT c AS column, pg_temp.error_of(format('SELECT count(*) FROM typify_derive(''typify_test_lod25'', NULL, 75000, importance_column => %L)', c)) FROM unnest(ARRAY['words', 'gone', 'geom']) AS c;
UPDATE typify_test_lod25 SET worth = 0.5 WHERE id = 30;
SELECT pg_temp.error_of('SELECT count(*) FROM typify_derive(''typify_test_lod25'', NULL, 75000, importance_column => ''worth'')');
DROP MATERIALIZED VIEW typify_test_view;
DROP TABLE typify_test_table, typify_test_built, typify_test_lod25, typify_test_lod200;
