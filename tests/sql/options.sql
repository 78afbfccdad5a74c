-- options.sql: no value slips in unchecked, and no option that is set is ignored
\pset null '(null)'
\i tests/data/error_of.sql

CREATE TABLE typify_test_building AS
SELECT i AS id, ST_MakeEnvelope(i * 20 + i % 3, i * i % 31, i * 20 + 10, i * i % 31 + 7 + i % 4) AS geom FROM generate_series(1, 40) AS i;

-- nothing set: all fields NULL
SELECT typify_options();
SELECT typify_options(count => 7, shape => 'square');
SELECT attname, format_type(atttypid, atttypmod) FROM pg_attribute WHERE attrelid = 'typify_options'::regclass ORDER BY attnum;

-- wrong values, from the function and from a row
CREATE TEMP TABLE wrong (number serial, field text, value text);
INSERT INTO wrong (field, value) VALUES
	('source_scale', '0'), ('source_scale', '-5'), ('source_scale', '''NaN'''), ('source_scale', '''Infinity'''),
	('source_scale', '200000'), ('lod200_scale', '25000'), ('lod200_scale', '''Infinity'''), ('lod200_scale', '-1'),
	('exponent', '-0.1'), ('exponent', '''NaN'''), ('psi', '1.01'), ('psi', '''NaN'''), ('psi', '''-Infinity'''),
	('count', '0'), ('count', '-1'), ('min_distance', '-1'), ('min_distance', '''Infinity'''),
	('count_rule', '''''' ), ('count_rule', '''Radical'''), ('area_statistic', '''mode'''), ('shape', '''circle'''),
	('min_area', '-1'), ('min_side', '''NaN'''), ('max_area', '-1'), ('keep_area', '''Infinity'''), ('min_gap', '-0.2'),
	('alignment', '-1'), ('barrier_width', '''NaN''');
SELECT number, field, value, pg_temp.error_of(format('SELECT typify_options(%I => %s)', field, value)) AS from_function FROM wrong ORDER BY number;

-- a composite of any other making is checked when it is used, with the same words
CREATE FUNCTION pg_temp.row_with(field text, value text) RETURNS text LANGUAGE sql AS
$$
	SELECT 'ROW(' || string_agg(CASE attname WHEN field THEN value ELSE 'NULL' END, ', ' ORDER BY attnum) || ')::typify_options'
	FROM pg_attribute WHERE attrelid = 'typify_options'::regclass
$$;
SELECT count(*) AS wrong_values, count(*) FILTER (WHERE from_row = from_function) AS same_words, count(*) FILTER (WHERE from_count = from_function) AS same_in_count
FROM (SELECT pg_temp.error_of(format('SELECT typify_options(%I => %s)', field, value)) AS from_function,
			 pg_temp.error_of(format('SELECT typify(geom, 250000, 0, %s) FROM typify_test_building', pg_temp.row_with(field, value))) AS from_row,
			 pg_temp.error_of(format('SELECT typify_count(10, 250000, %s)', pg_temp.row_with(field, value))) AS from_count
	  FROM wrong) AS w;

-- values that mean off are today's behaviour
SELECT o AS option, typify(geom, 50000, 0, o)::bytea = typify(geom, 50000)::bytea AS same
FROM typify_test_building, (VALUES (1, typify_options()), (2, typify_options(min_area => 0, keep_area => 0)), (3, typify_options(alignment => 0)),
	(4, typify_options(barrier_width => 0)), (5, typify_options(barriers => 'LINESTRING EMPTY')),
	(6, typify_options(min_distance => 0)), (8, typify_options(min_side => 0, max_area => 0, min_gap => 0)), (7, typify_options(25000, 200000, 2, 0.75, NULL, NULL, 'radical', 'mean', 'rectangle'))) AS v (number, o)
GROUP BY number, o ORDER BY number;

-- every way a composite can come: literal, function, row, domain, table, sub-select, prepared parameter, variable
CREATE DOMAIN typify_test_options AS typify_options CHECK ((VALUE).count > 1);
CREATE TABLE typify_test_settings (name text, o typify_options, d typify_test_options);
INSERT INTO typify_test_settings VALUES ('seven', typify_options(count => 7), typify_options(count => 7));
PREPARE typify_test_prepared (typify_options) AS SELECT ST_NumGeometries(typify(geom, 50000, 0, $1)) AS prepared FROM typify_test_building;
SET plan_cache_mode = force_generic_plan;
EXECUTE typify_test_prepared (typify_options(count => 7));
EXECUTE typify_test_prepared (typify_options(count => 8));
EXECUTE typify_test_prepared (NULL);
RESET plan_cache_mode;
SELECT ST_NumGeometries(typify(geom, 50000, 0, '(,,,,7,,,,,,,,,,,,)')) AS literal,
	   ST_NumGeometries(typify(geom, 50000, 0, ROW(NULL, NULL, NULL, NULL, 7, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL)::typify_options)) AS "row",
	   ST_NumGeometries(typify(geom, 50000, 0, (SELECT o FROM typify_test_settings))) AS sub_select,
	   ST_NumGeometries(typify(geom, 50000, 0, (SELECT d FROM typify_test_settings))) AS domain_sub_select
FROM typify_test_building;
SELECT ST_NumGeometries(typify(geom, 50000, 0, o)) AS from_table, ST_NumGeometries(typify(geom, 50000, 0, d)) AS from_domain
FROM typify_test_building, typify_test_settings;
DO $$
DECLARE
	o typify_options := typify_options(count => 7);
BEGIN
	o.count := 6;
	RAISE NOTICE 'variable: %', (SELECT ST_NumGeometries(typify(geom, 50000, 0, o)) FROM typify_test_building);
END
$$;

-- parameters may change from one scan to the next, never from one row to the next
SELECT s AS scale, ST_NumGeometries((SELECT typify(geom, s) FROM typify_test_building)) AS correlated, n AS lateral, c AS clusters
FROM unnest(ARRAY[25000, 50000, 100000, 50000, 200000]) WITH ORDINALITY AS s (s, number),
	 LATERAL (SELECT ST_NumGeometries(typify(geom, s)) AS n FROM typify_test_building) AS l,
	 LATERAL (SELECT max(k) + 1 AS c FROM (SELECT typify_cluster(geom, s) OVER () AS k FROM typify_test_building) AS w) AS w
ORDER BY number;
SELECT c AS count, ST_NumGeometries((SELECT typify(geom, 50000, 0, typify_options(count => c)) FROM typify_test_building)) AS correlated, n AS lateral, m AS sub_select
FROM unnest(ARRAY[3, 9, 3, 12]) WITH ORDINALITY AS c (c, number),
	 LATERAL (SELECT typify_options(count => c) AS o OFFSET 0) AS o,
	 LATERAL (SELECT ST_NumGeometries(typify(geom, 50000, 0, o)) AS n FROM typify_test_building) AS l,
	 LATERAL (SELECT ST_NumGeometries(typify(geom, 50000, 0, (SELECT typify_options(count => c)))) AS m FROM typify_test_building) AS k
ORDER BY number;
SELECT g, ST_NumGeometries(typify(geom, 50000, 0, (SELECT typify_options(count => 2 + g) OFFSET 0))) AS correlated_with_group
FROM (SELECT id % 3 AS g, geom FROM typify_test_building) AS b GROUP BY g ORDER BY g;

-- 11 MB of options as a scalar sub-select cost nothing per row or group: were they copied or compared for each of
-- 20 000 rows, this would take minutes
CREATE TABLE typify_test_large AS
SELECT typify_options(count => 2, barriers => ST_Collect(array_agg('LINESTRING EMPTY'::geometry))) AS o FROM generate_series(1, 1400000);
CREATE TABLE typify_test_many AS
SELECT i AS id, i % 2000 AS g, ST_MakeEnvelope(i % 141 * 20, i / 141 * 20, i % 141 * 20 + 10, i / 141 * 20 + 8) AS geom FROM generate_series(1, 20000) AS i;
SELECT pg_column_size(typify_options((o).source_scale, barriers => (o).barriers)) AS bytes FROM typify_test_large;
SET statement_timeout = '30s';
SELECT sum(ST_NumGeometries(t)) FROM (SELECT typify(geom, 50000, 0.5, (SELECT o FROM typify_test_large)) AS t FROM typify_test_many GROUP BY g) AS q;
SELECT sum(ST_NumGeometries(t)) FROM (SELECT typify(geom, 50000, 0.5, (SELECT typify_options(count => 2, barriers => (o).barriers) FROM typify_test_large)) AS t FROM typify_test_many GROUP BY g) AS q;
SET enable_hashagg = off;
SELECT sum(ST_NumGeometries(t)) FROM (SELECT typify(geom, 50000, 0.5, (SELECT typify_options(count => 2, barriers => (o).barriers) FROM typify_test_large)) AS t FROM typify_test_many GROUP BY g) AS q;
RESET enable_hashagg;
SELECT max(k) FROM (SELECT typify_cluster(geom, 50000, 0.5, (SELECT o FROM typify_test_large)) OVER (PARTITION BY g % 2) AS k FROM typify_test_many) AS q;
SET parallel_setup_cost = 0;
SET parallel_tuple_cost = 0;
SET min_parallel_table_scan_size = 0;
SELECT sum(ST_NumGeometries(t)) FROM (SELECT typify(geom, 50000, 0.5, (SELECT typify_options(count => 2, barriers => (o).barriers) FROM typify_test_large)) AS t FROM typify_test_many GROUP BY g) AS q;
RESET statement_timeout;

DROP TABLE typify_test_building, typify_test_settings, typify_test_large, typify_test_many;
DROP DOMAIN typify_test_options;
