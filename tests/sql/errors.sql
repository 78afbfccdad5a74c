-- errors.sql: every wrong parameter is an error that names it, its value and what is allowed
\pset null '(null)'
\i tests/data/error_of.sql

CREATE TEMP TABLE building AS
SELECT i AS id, ST_MakeEnvelope(i * 20, 0, i * 20 + 10, 8) AS geom FROM generate_series(1, 6) AS i;

-- scale and s_u, in each form
CREATE FUNCTION pg_temp.each_form(arguments text) RETURNS TABLE (form text, error text) LANGUAGE sql AS
$$
	SELECT form, pg_temp.error_of(format(query, arguments))
	FROM (VALUES
		(1, 'typify', 'SELECT typify(geom, %s) FROM building'),
		(2, 'typify_placeholders', 'SELECT typify_placeholders(geom, id, %s) FROM building'),
		(3, 'typify_cluster', 'SELECT typify_cluster(geom, %s) OVER () FROM building')
	) AS forms (number, form, query) ORDER BY number
$$;

SELECT a AS arguments, f.* FROM unnest(ARRAY['24999', '-1', '0', '''NaN''', '''Infinity''', '''-Infinity''', 'NULL',
	'50000, -0.1', '50000, 1.000001', '50000, ''NaN''', '50000, ''Infinity''', '50000, NULL']) WITH ORDINALITY AS a (a, number),
	pg_temp.each_form(a) AS f ORDER BY number, form;
SELECT a AS arguments, f.* FROM unnest(ARRAY['25000', '50000, 0', '50000, 1', '50000, 0.5, NULL', '1e9']) WITH ORDINALITY AS a (a, number),
	pg_temp.each_form(a) AS f ORDER BY number, form;

-- numbers so large that placeholders do not fit double precision
SELECT pg_temp.error_of('SELECT typify(geom, 1e200) FROM building');
SELECT pg_temp.error_of('SELECT typify(ST_MakeEnvelope(0, 0, 9e153, 9e153), 50000)');
SELECT pg_temp.error_of('SELECT typify_placeholders(ST_MakeEnvelope(0, 0, 9e153, 9e153), 1, 50000)');
SELECT pg_temp.error_of('SELECT typify(ST_MakeEnvelope(0, 0, 1e155, 1e155), 25000)');
SELECT pg_temp.error_of('SELECT typify(''POLYGON((0 0,1e200 2e200,3e200 1e200,0 0))'', 25000)');
SELECT pg_temp.error_of('SELECT typify_area_factor(1e300)');

-- parameters that vary inside a group, but not between groups
SELECT f.* FROM pg_temp.each_form('20000 + 10000 * id') AS f;
SELECT f.* FROM pg_temp.each_form('50000, id / 10.0') AS f;
SELECT f.* FROM pg_temp.each_form('50000, 0, typify_options(psi => id / 10.0)') AS f;
SELECT f.* FROM pg_temp.each_form('50000, 0, CASE WHEN id > 3 THEN typify_options(psi => 0) END') AS f;
SELECT f.* FROM pg_temp.each_form('50000 + 0 * id, 0 * id, CASE WHEN id > 0 THEN typify_options(psi => 0) END') AS f;
SELECT count(*) FROM (SELECT typify(geom, 20000 + 10000 * id, id / 10.0, typify_options(psi => id / 20.0)) FROM building GROUP BY id) AS g;
SELECT id, typify_cluster(geom, 20000 + 10000 * id, id / 10.0, typify_options(psi => id / 20.0)) OVER (PARTITION BY id) FROM building ORDER BY id;
-- NULL options and options that set nothing mean the same
SELECT f.* FROM pg_temp.each_form('50000, 0, CASE WHEN id > 3 THEN typify_options() END') AS f;
-- as a window aggregate, too
SELECT pg_temp.error_of('SELECT typify(geom, 20000 + 10000 * id) OVER () FROM building');

-- importance
SELECT i AS importance, pg_temp.error_of(format('SELECT typify_placeholders(geom, id, 50000, 0, NULL, %s) FROM building', i))
FROM unnest(ARRAY['NULL', '1', '1 + 0 * id', '0.9', '-1', '''NaN''', '2', '''Infinity''']) WITH ORDINALITY AS i (i, number) ORDER BY number;

-- formulas
SELECT q, pg_temp.error_of('SELECT ' || q)
FROM unnest(ARRAY[
	'typify_count(-1, 50000)', 'typify_count(1, 24999)', 'typify_count(1, ''NaN'')', 'typify_count(1, ''Infinity'')',
	'typify_count(1, 50000, typify_options(min_distance => 10))', 'typify_count(1, 50000, typify_options(min_gap => -1))',
	'typify_area_factor(24999)', 'typify_area_factor(50000, typify_options(shape => ''footprint''))',
	'typify_psi(0, 1)', 'typify_psi(-1, 1)', 'typify_psi(1, -1)', 'typify_psi(''NaN'', 1)', 'typify_psi(1, ''Infinity'')',
	'typify_psi(1, 1, 0, 1)', 'typify_psi(1, 1, 25000, 25000)', 'typify_psi(1, 1, 25000, ''Infinity'')',
	'typify_rectangle(''POINT(0 0)'', 0, 1, 0)', 'typify_rectangle(''POINT(0 0)'', ''Infinity'', 1, 0)',
	'typify_rectangle(''POINT(0 0)'', 1, 0, 0)', 'typify_rectangle(''POINT(0 0)'', 1, 1.1, 0)',
	'typify_rectangle(''POINT(0 0)'', 1, ''NaN'', 0)', 'typify_rectangle(''POINT(0 0)'', 1, 1, ''Infinity'')',
	'typify_rectangle(''LINESTRING(0 0,1 1)'', 1, 1, 0)', 'typify_rectangle(ST_MakePoint(0, ''Infinity''), 1, 1, 0)',
	'typify_rectangle(''MULTIPOINT((0 0))'', 1, 1, 0)', 'typify_rectangle(''POINT(1e308 0)'', 1e308, 1e-308, 0)',
	'typify_rectangle(''POINT(0 0)'', 1, 1e-320, 0)'
]) WITH ORDINALITY AS q (q, number) ORDER BY number;
SELECT typify_count(NULL, 50000) AS count_null, typify_count(1, NULL) AS scale_null, typify_area_factor(NULL) AS factor_null,
	   typify_psi(NULL, 1) AS psi_null, typify_rectangle(NULL, 1, 1, 0) AS center_null, typify_rectangle('POINT EMPTY', 1, 1, 0) AS center_empty;

-- support functions are for aggregates alone
SELECT pg_temp.error_of('SELECT typify_deserialize(''\x00'', NULL)') <> 'no error' AS deserialize_refused,
	   pg_temp.error_of('SELECT typify_final(NULL)') <> 'no error' AS final_refused;

-- a superuser changed the extension's types; what was added and dropped again does no harm
BEGIN;
ALTER TYPE typify_options ADD ATTRIBUTE extra integer;
ALTER TYPE typify_placeholder ADD ATTRIBUTE extra integer;
SELECT pg_temp.error_of('SELECT typify_options()');
SELECT pg_temp.error_of('SELECT typify_placeholders(geom, id, 50000) FROM building');
ALTER TYPE typify_options DROP ATTRIBUTE extra;
ALTER TYPE typify_placeholder DROP ATTRIBUTE extra;
SELECT (typify_options(psi => 0.5)).psi, cardinality(typify_placeholders(geom, id, 50000, 0, typify_options(count => 2))) AS placeholders FROM building;
SELECT id, member_count, members FROM unnest((SELECT typify_placeholders(geom, id, 50000, 0, typify_options(count => 2)) FROM building));
ROLLBACK;
