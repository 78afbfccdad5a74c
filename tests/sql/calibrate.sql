-- calibrate.sql: psi and exponent from two levels of detail; derived with them, LOD200 comes back
\pset null '(null)'
\i tests/data/error_of.sql
\i tests/data/two_levels.sql

-- the exponent gives LOD200's count exactly, for all small counts, large ones, near ones, and other scales
SELECT count(*) AS pairs, count(*) FILTER (WHERE typify_count(n25, 200000, o) <> n200) AS wrong_at_m200,
	count(*) FILTER (WHERE typify_count(n25, 25000, o) <> n25) AS wrong_at_m25
FROM (SELECT n25, n200, typify_options(exponent => typify_exponent(n25, n200)) AS o
	  FROM generate_series(1, 300) AS n25, generate_series(1, n25) AS n200) AS pair;
SELECT m25, m200, count(*) AS pairs, count(*) FILTER (WHERE typify_count(n25, m200, o) <> n200) AS wrong_at_m200,
	count(*) FILTER (WHERE typify_count(n25, m25, o) <> n25) AS wrong_at_m25
FROM (SELECT m25, m200, n25, n200,
		typify_options(source_scale => m25, lod200_scale => m200, exponent => typify_exponent(n25, n200, m25, m200)) AS o
	  FROM (VALUES (25000, 200000), (10000, 50000), (1, 1e9), (25000, 25000.001), (7777.7, 33333.3)) AS s (m25, m200),
		generate_series(1, 3000) AS i,
		LATERAL (SELECT 1 + i::bigint * i * 7919 * 31 % 700000000 AS n25) AS a,
		LATERAL (SELECT CASE i % 3 WHEN 0 THEN greatest(1, n25 - i % 5) ELSE 1 + i::bigint * 104729 * 7907 % n25 END AS n200) AS b
	) AS pair GROUP BY m25, m200 ORDER BY m25, m200;
SELECT typify_exponent(40, 5) AS eighth, typify_exponent(41, 41) AS same, typify_exponent(3, 7) AS more, typify_exponent(3, 0) AS none,
	round(typify_exponent(41, 14)::numeric, 6) AS fourteen;

-- ungrouped: one row; with what it says, LOD200's count and mean area, and LOD25's count
SELECT grp, n25, n200, round(mean_area25::numeric, 6) AS mean_area25, round(mean_placeholder_area::numeric, 6) AS mean_placeholder_area,
	round(mean_area200::numeric, 6) AS mean_area200, round(exponent::numeric, 9) AS exponent, round(psi::numeric, 9) AS psi,
	(options).exponent = exponent AND (options).psi = psi AS in_options, calibrated, overall
FROM typify_calibrate('lod25', 'lod200', 0.5);
CREATE TEMP TABLE choice AS
SELECT row_number() OVER () AS number, o AS options, name FROM (VALUES
	('nothing', NULL::typify_options),
	('median', typify_options(area_statistic => 'median')),
	('square', typify_options(shape => 'square')),
	('exponent 1', typify_options(exponent => 1)),
	('psi 0.5', typify_options(psi => 0.5)),
	('10 000 and 50 000', typify_options(source_scale => 10000, lod200_scale => 50000)),
	('radical, 30 m', typify_options(count_rule => 'radical', min_distance => 30)),
	('sum', typify_options(area_statistic => 'sum')),
	('count 20', typify_options(count => 20)),
	('30 m', typify_options(min_distance => 30)),
	('black-white', typify_options(count_rule => 'black_white')),
	('black-white, psi 0.9', typify_options(count_rule => 'black_white', psi => 0.9))) AS v (name, o);
-- same: count and mean area at m200 are LOD200's; what options set stays
SELECT name, s_u, n200, at200.n AS at_m200, at25.n AS at_m25, round(exponent::numeric, 3) AS exponent, round(psi::numeric, 3) AS psi,
	abs(at200.area / mean_area200 - 1) < 1e-9 AS same_area,
	abs(at200.area / (mean_placeholder_area * f.factor) - 1) < 1e-9 AS area_as_said
FROM choice CROSS JOIN unnest(ARRAY[0, 0.3, 1]::float8[]) AS s_u
CROSS JOIN LATERAL typify_calibrate('lod25', 'lod200', s_u, options => choice.options) AS c
CROSS JOIN LATERAL (SELECT coalesce((c.options).source_scale, 25000) AS m25, coalesce((c.options).lod200_scale, 200000) AS m200) AS m
CROSS JOIN LATERAL (SELECT CASE WHEN name = 'sum' THEN 1 ELSE typify_area_factor(m200, c.options) END AS factor) AS f
CROSS JOIN LATERAL (SELECT count(*) AS n, avg(area) AS area FROM typify_derive('lod25', 'lod200', m200, s_u, options => choice.options)) AS at200
CROSS JOIN LATERAL (SELECT count(*) AS n FROM typify_derive('lod25', 'lod200', m25, s_u, options => choice.options)) AS at25
ORDER BY number, s_u;
-- the options as returned, given to the aggregate, give the same as typify_derive
SELECT s_u, count(*) AS placeholders, count(*) FILTER (WHERE (p.geom::bytea, p.members, p.area, p.width, p.length, p.orientation) = (d.geom::bytea, d.members, d.area, d.width, d.length, d.orientation)) AS same
FROM unnest(ARRAY[0, 0.5]::float8[]) AS s_u
CROSS JOIN LATERAL (SELECT options FROM typify_calibrate('lod25', 'lod200', s_u)) AS c
CROSS JOIN LATERAL unnest((SELECT typify_placeholders(geom, id, 75000, s_u, c.options) FROM lod25)) AS p
JOIN LATERAL (SELECT * FROM typify_derive('lod25', 'lod200', 75000, s_u)) AS d USING (id)
GROUP BY s_u ORDER BY s_u;

-- groups: first all, then each; bare, few and lost have not what it takes and are listed
SELECT grp, n25, n200, round(mean_area25::numeric, 3) AS mean_area25, round(mean_placeholder_area::numeric, 3) AS mean_placeholder_area,
	round(mean_area200::numeric, 3) AS mean_area200, round(exponent::numeric, 6) AS exponent, round(psi::numeric, 6) AS psi, calibrated, overall
FROM typify_calibrate('lod25', 'lod200', 0.5, 'block');
SELECT s_u, count(*) AS groups, count(*) FILTER (WHERE at200.n = n200) AS same_count,
	count(*) FILTER (WHERE abs(at200.area / mean_area200 - 1) < 1e-9) AS same_area, count(*) FILTER (WHERE at25.n = n25) AS same_count_at_m25
FROM unnest(ARRAY[0, 0.25, 0.5, 0.75, 1]::float8[]) AS s_u
CROSS JOIN LATERAL typify_calibrate('lod25', 'lod200', s_u, 'block') AS c
JOIN LATERAL (SELECT grp, count(*) AS n, avg(area) AS area FROM typify_derive('lod25', 'lod200', 200000, s_u, 'block') GROUP BY grp)
	AS at200 ON at200.grp IS NOT DISTINCT FROM c.grp
JOIN LATERAL (SELECT grp, count(*) AS n FROM typify_derive('lod25', 'lod200', 25000, s_u, 'block') GROUP BY grp)
	AS at25 ON at25.grp IS NOT DISTINCT FROM c.grp
WHERE calibrated AND NOT overall GROUP BY s_u ORDER BY s_u;
-- the mean over the placeholders of all groups, each derived with its own options
SELECT abs(c.mean_placeholder_area / p.area - 1) < 1e-9 AS overall_is_of_all_groups
FROM typify_calibrate('lod25', 'lod200', 0.5, 'block') AS c,
	(SELECT avg(area / typify_area_factor(200000, g.options)) AS area FROM typify_derive('lod25', 'lod200', 200000, 0.5, 'block') AS d
	 JOIN typify_calibrate('lod25', 'lod200', 0.5, 'block') AS g ON NOT overall AND g.grp IS NOT DISTINCT FROM d.grp) AS p
WHERE overall;

-- objects of LOD200 and their group: a column of another name, or that of the nearest building, ties by id
CREATE TEMP TABLE named AS SELECT id, block AS quarter, geom FROM lod200;
SELECT how, count(*) AS groups, sum(n200) AS objects, md5(string_agg(concat_ws(' ', grp, n25, n200, round(psi::numeric, 9)), ',' ORDER BY grp COLLATE "C"))
FROM (
	SELECT 'column' AS how, * FROM typify_calibrate('lod25', 'lod200', 0.5, 'block')
	UNION ALL SELECT 'column of another name', * FROM typify_calibrate('lod25', 'named', 0.5, 'block', lod200_group_by => 'quarter')
	UNION ALL SELECT 'nearest', * FROM typify_calibrate('lod25', 'named', 0.5, 'block')
) AS c WHERE NOT overall GROUP BY how ORDER BY how;
CREATE TEMP TABLE tie (id bigint, side text, geom geometry);
INSERT INTO tie VALUES (3, 'east', ST_MakeEnvelope(10, 0, 20, 10)), (2, 'west', ST_MakeEnvelope(-20, 0, -10, 10)), (5, 'north', ST_MakeEnvelope(-10, 40, 10, 60));
CREATE TEMP TABLE middle AS SELECT 1 AS id, ST_MakeEnvelope(-5, 0, 5, 10) AS geom;
SELECT grp, n25, n200 FROM typify_calibrate('tie', 'middle', 0, 'side') WHERE NOT overall;
UPDATE tie SET id = 10 - id;
SELECT grp, n25, n200 FROM typify_calibrate('tie', 'middle', 0, 'side') WHERE NOT overall;

-- nothing depends on the order of rows
CREATE TEMP TABLE shuffled AS SELECT * FROM lod25 ORDER BY id * 7919 % 501;
CREATE TEMP TABLE shuffled200 AS SELECT * FROM lod200 ORDER BY id * 7919 % 53;
SELECT count(*) AS rows, count(*) FILTER (WHERE a IS NOT DISTINCT FROM b) AS same_to_the_last_bit
FROM typify_calibrate('lod25', 'lod200', 0.5, 'block') WITH ORDINALITY AS a JOIN typify_calibrate('shuffled', 'shuffled200', 0.5, 'block') WITH ORDINALITY AS b USING (ordinality);

-- NULL and EMPTY do not count; points have no area to take psi from; no building, no row
CREATE TEMP TABLE holes AS SELECT id, block, geom::geometry FROM lod25 UNION ALL VALUES (9001, '1', NULL::geometry), (9002, '1', 'SRID=25832;POLYGON EMPTY');
CREATE TEMP TABLE holes200 AS SELECT id, block, geom::geometry FROM lod200 UNION ALL VALUES (9001, '1', NULL::geometry), (9002, '1', 'SRID=25832;POLYGON EMPTY');
SELECT h.n25, h.n200, h IS NOT DISTINCT FROM c AS same FROM typify_calibrate('holes', 'holes200', 0.5) AS h, typify_calibrate('lod25', 'lod200', 0.5) AS c;
CREATE TEMP TABLE point200 AS SELECT id, block, ST_Centroid(geom) AS geom FROM lod200;
SELECT n25, n200, mean_area200, psi, (options).psi AS psi_in_options, (SELECT count(*) FROM typify_derive('lod25', 'point200', 200000)) AS at_m200 FROM typify_calibrate('lod25', 'point200');
CREATE TEMP TABLE nobody (id integer, block text, geom geometry);
SELECT count(*) AS none FROM typify_calibrate('nobody', 'lod200');
SELECT count(*) AS none FROM typify_calibrate('nobody', 'nobody', 0, 'block');

-- links as groups: each linked object is one placeholder of its own area at m200
CREATE TEMP TABLE link AS
SELECT b.id AS lod25_id, o.id AS lod200_id FROM lod25 AS b CROSS JOIN LATERAL (
	SELECT id FROM lod200 AS o WHERE o.block = b.block ORDER BY o.geom <-> b.geom, id LIMIT 1) AS o
UNION ALL SELECT NULL, 999;
SELECT count(*) AS groups, count(*) FILTER (WHERE calibrated) AS calibrated, count(*) FILTER (WHERE n25 = 0) AS without_building,
	count(*) FILTER (WHERE n200 = 0) AS without_object, count(*) FILTER (WHERE grp IS NULL) AS not_linked
FROM typify_calibrate('lod25', 'lod200', 0.5, links => 'link') WHERE NOT overall;
SELECT count(*) AS placeholders, count(*) FILTER (WHERE abs(d.area / ST_Area(o.geom) - 1) < 1e-9) AS of_its_objects_area, count(o.id) AS objects, count(DISTINCT o.id) AS different
FROM typify_derive('lod25', 'lod200', 200000, 0.5, links => 'link') AS d LEFT JOIN lod200 AS o ON o.id::text = d.grp;

-- errors
CREATE TEMP TABLE wrong AS SELECT id::text AS word, id / 2 AS twice, geom::text AS text, ST_SetSRID(geom, 25833) AS elsewhere, ST_SetSRID(geom, 4326) AS degrees,
	CASE WHEN id > 5 THEN ST_SetSRID(geom, 25833) ELSE geom END AS both, * FROM lod25;
CREATE TEMP TABLE empty200 AS SELECT 1 AS id, 'POINT EMPTY'::geometry AS geom;
CREATE TEMP TABLE two_links AS SELECT * FROM link UNION ALL SELECT 1, 2;
CREATE TEMP TABLE twice200 AS SELECT 1 + id / 2 AS id, geom FROM lod200;
CREATE TEMP TABLE spoilt AS SELECT id, block, geom::geometry FROM lod25 UNION ALL SELECT 9001, '1', ST_MakeLine(ST_SetSRID(ST_MakePoint(0, 'NaN'), 25832), ST_SetSRID(ST_MakePoint(1, 1), 25832));
CREATE TEMP SEQUENCE number;
SELECT a AS arguments, regexp_replace(pg_temp.error_of(format('SELECT * FROM typify_calibrate(%s)', a)), 'pg_temp_\d+', 'pg_temp', 'g') AS error FROM unnest(ARRAY[
	'''absent'', ''lod200''', '''lod25'', ''absent''', 'NULL, ''lod200''', '''lod25'', NULL', '''number'', ''lod200''',
	'''lod25'', ''lod200'', NULL', '''lod25'', ''lod200'', 1.1', '''lod25'', ''lod200'', 0, ''absent''',
	'''lod25'', ''lod200'', id_column => ''nr''', '''lod25'', ''lod200'', id_column => NULL', '''lod25'', ''lod200'', geom_column => ''shape''', '''lod25'', ''lod200'', lod200_geom_column => ''shape''',
	'''lod25'', ''lod200'', 0, ''block'', lod200_group_by => ''absent''', '''lod25'', ''lod200'', lod200_group_by => ''block''',
	'''wrong'', ''lod200'', id_column => ''word''', '''wrong'', ''lod200'', geom_column => ''text''', '''lod25'', ''wrong'', lod200_geom_column => ''text''',
	'''wrong'', ''lod200'', id_column => ''twice''', '''wrong'', ''lod200'', 0, ''block'', id_column => ''twice''',
	'''wrong'', ''lod200'', geom_column => ''elsewhere''', '''wrong'', ''lod200'', geom_column => ''both''', '''lod25'', ''wrong'', lod200_geom_column => ''both''', '''wrong'', ''wrong'', geom_column => ''degrees'', lod200_geom_column => ''degrees''',
	'''lod25'', ''empty200''', '''lod200'', ''lod25''', '''lod25'', ''lod200'', 0, ''block'', links => ''link''', '''lod25'', ''lod200'', links => ''lod200''', '''lod25'', ''lod200'', links => ''two_links''', '''lod25'', ''twice200'', links => ''link''', '''lod25'', ''lod200'', links => ''link'', lod200_group_by => ''block''', '''spoilt'', ''named'', 0, ''block''',
	'''lod25'', ''lod200'', options => typify_options(lod200_scale => 20000)', '''lod25'', ''lod200'', options => typify_options(source_scale => 300000)', '''lod25'', ''lod200'', options => jsonb_populate_record(NULL::typify_options, ''{"shape": "round"}'')'
]) WITH ORDINALITY AS a (a, number) ORDER BY number;
