-- derive.sql: placeholders of whole tables at any scale, whatever the tables are
\pset null '(null)'
\i tests/data/error_of.sql
\i tests/data/two_levels.sql

-- without calibration: what the aggregate gives, group by group
SELECT how, scale, count(*) AS placeholders, sum(member_count) AS members, count(DISTINCT id) AS ids,
	md5(string_agg(concat_ws(' ', grp, id, geom::bytea, members, area, width, length, orientation), ',' ORDER BY id)) =
		min(CASE how WHEN 'whole' THEN whole ELSE grouped END) AS as_the_aggregate
FROM unnest(ARRAY[25000, 60000, 200000, 1e6]::float8[]) AS scale CROSS JOIN LATERAL (
	SELECT 'block' AS how, * FROM typify_derive('lod25', NULL, scale, 0.5, 'block')
	UNION ALL SELECT 'whole', * FROM typify_derive('lod25', NULL, scale, 0.5)) AS d
CROSS JOIN LATERAL (
	SELECT md5(string_agg(concat_ws(' ', id, geom::bytea, members, area, width, length, orientation), ',' ORDER BY id)) AS whole
	FROM unnest((SELECT typify_placeholders(geom, id, scale, 0.5) FROM lod25))) AS a
CROSS JOIN LATERAL (
	SELECT md5(string_agg(concat_ws(' ', block, id, p.geom::bytea, members, area, width, length, orientation), ',' ORDER BY id)) AS grouped
	FROM (SELECT block, typify_placeholders(geom, id, scale, 0.5) AS list FROM lod25 GROUP BY block) AS g, unnest(list) AS p) AS b
GROUP BY how, scale ORDER BY how, scale;
-- nobody is lost, whatever is asked
SELECT scale, count(*) AS ways, bool_and(members = 471 AND different = 471 AND counted = 471) AS everybody_once
FROM unnest(ARRAY[25000, 50000, 75000, 150000, 200000, 700000]::float8[]) AS scale, unnest(ARRAY[0, 0.5, 1]::float8[]) AS s_u,
	unnest(ARRAY['each_group', 'total']) AS allocation, unnest(ARRAY['block', NULL]) AS group_by, unnest(ARRAY['lod200'::regclass, NULL]) AS lod200
CROSS JOIN LATERAL (
	SELECT count(m) AS members, count(DISTINCT m) AS different, sum(CASE WHEN place = 1 THEN member_count END) AS counted
	FROM typify_derive('lod25', lod200, scale, s_u, group_by, allocation => allocation) AS d, unnest(d.members) WITH ORDINALITY AS u(m, place)) AS a
GROUP BY scale ORDER BY scale;

-- total: the count of the whole table, by largest remainders
SELECT total, sizes, shares, typify_allocate(total, sizes, shares) FROM (VALUES
	(10, '{100,100,100}'::bigint[], '{1,1,1}'::float8[]), (10, '{100,100,100}', '{5.3,2.4,2.3}'), (7, '{3,3,3}', '{1,1,1}'), (9, '{3,3,3}', '{2.9,0.1,1}'),
	(9, '{1,3,100}', '{5,5,5}'), (3, '{1,1,1,1,1}', '{0.5,0.5,0.5,0.5,0.5}'), (1, '{4,9}', '{0.1,0.3}'), (5, '{0,5}', '{0,5}'), (100, '{30,60,30}', '{30,30,1}'), (4, '{2,2}', '{0.3,0.1}')) AS v (total, sizes, shares);
SELECT count(*) AS tables, count(*) FILTER (WHERE allotted_sum <> total) AS wrong_sum, count(*) FILTER (WHERE NOT fits) AS too_many, count(*) FILTER (WHERE far) AS off_quota
FROM (
	SELECT t, total, sum(a) AS allotted_sum, bool_and(a BETWEEN 0 AND size) AS fits,
		-- Hamilton keeps to the quota: no group is off by one or more, unless it is full
		bool_or(a < size AND (a < floor(total * share / shares - 1e-6)) OR bool_full IS NOT TRUE AND a > ceil(total * share / shares + 1e-6)) AS far
	FROM (SELECT t, floor(sum(size) OVER (PARTITION BY t) * (1 + t % 10) / 10) AS total, size, share, sum(share) OVER (PARTITION BY t) AS shares, a,
			bool_or(a = size) OVER (PARTITION BY t) AS bool_full
		  FROM generate_series(1, 300) AS t
		  CROSS JOIN LATERAL (SELECT array_agg((1 + i * 7919 * t % 41)::bigint ORDER BY i) AS sizes, array_agg((1 + i * 7919 * t % 41) * (1 + i * t % 7) / 10.0::float8 ORDER BY i) AS shares
							  FROM generate_series(1, 2 + t % 30) AS i) AS s
		  CROSS JOIN LATERAL (SELECT sum(n) AS n FROM unnest(sizes) AS n) AS n
		  CROSS JOIN LATERAL unnest(sizes, shares, typify_allocate(floor(n.n * (1 + t % 10) / 10)::bigint, sizes, shares)) AS u(size, share, a)) AS g
	GROUP BY t, total) AS each;
SELECT scale, count(*) AS rows, count(geom) AS drawn, n.whole, sum(member_count) AS members, count(*) FILTER (WHERE geom IS NULL AND (area, width, length) = (0, 0, 0)) AS none,
	string_agg(grp, ' ' ORDER BY grp COLLATE "C") FILTER (WHERE geom IS NULL) AS groups_with_none
FROM unnest(ARRAY[25000, 40000, 75000, 120000, 200000, 400000, 800000]::float8[]) AS scale
CROSS JOIN LATERAL typify_derive('lod25', NULL, scale, 0.5, 'block', allocation => 'total') AS d
CROSS JOIN LATERAL (SELECT typify_count(471, scale) AS whole) AS n
GROUP BY scale, whole ORDER BY scale;
SELECT scale, count(geom) AS drawn, n.whole FROM unnest(ARRAY[25000, 40000, 75000, 120000, 200000, 400000]::float8[]) AS scale
CROSS JOIN LATERAL typify_derive('lod25', 'lod200', scale, 0.5, 'block', allocation => 'total') AS d
CROSS JOIN LATERAL (SELECT typify_count(471, scale, c.options) AS whole FROM typify_calibrate('lod25', 'lod200', 0.5, 'block') AS c WHERE overall) AS n
GROUP BY scale, whole ORDER BY scale;
SELECT name, sum(n) AS drawn, string_agg(n::text, ' ' ORDER BY grp COLLATE "C") AS by_group FROM (
	SELECT name, grp, count(geom) AS n FROM (VALUES
		('count', typify_options(count => 30)), ('count, 30 m', typify_options(count => 30, min_distance => 60)), ('black-white', typify_options(count_rule => 'black_white', psi => 0.9)),
		('exponent 0', typify_options(exponent => 0))) AS v (name, o)
	CROSS JOIN LATERAL typify_derive('lod25', NULL, 200000, 0, 'block', options => o, allocation => 'total') GROUP BY name, grp) AS g
GROUP BY name ORDER BY name;

-- box and groups: whole groups, with the same rows
CREATE TEMP VIEW way AS SELECT * FROM unnest(ARRAY['lod200'::regclass, NULL]) AS lod200, unnest(ARRAY['each_group', 'total']) AS allocation;
SELECT lod200, allocation, what, count(b.id) AS rows, string_agg(DISTINCT CASE WHEN b.id IS NOT NULL THEN coalesce(b.grp, '(null)') END, ' ') AS groups, count(b.id) FILTER (WHERE b IS NOT DISTINCT FROM a) AS same
FROM way CROSS JOIN (VALUES
	('box over 1 and 2', ST_MakeEnvelope(300, 0, 2100, 100, 25832), NULL::text[]), ('box in a gap', ST_MakeEnvelope(500, 500, 600, 600, 25832), NULL),
	('empty box', 'SRID=25832;POLYGON EMPTY', NULL), ('groups', NULL, '{3,NULL,few,absent,3}'), ('no group', NULL, '{}'), ('box and groups', ST_MakeEnvelope(-10, -10, 1400, 3400, 25832), '{1,bare,NULL}')) AS v (what, box, groups)
LEFT JOIN LATERAL typify_derive('lod25', lod200, 75000, 0.5, 'block', box, allocation => allocation, groups => v.groups) AS b ON true
LEFT JOIN LATERAL (SELECT * FROM typify_derive('lod25', lod200, 75000, 0.5, 'block', allocation => allocation)) AS a ON a.id = b.id
GROUP BY lod200, allocation, what ORDER BY lod200, allocation, what;
SELECT count(*) AS whole, (SELECT count(*) FROM typify_derive('lod25', 'lod200', 75000, box => ST_MakeEnvelope(0, 0, 1500, 100, 25832))) AS met,
	(SELECT count(*) FROM typify_derive('lod25', 'lod200', 75000, box => ST_MakeEnvelope(500, 500, 600, 600, 25832))) AS not_met,
	(SELECT count(*) FROM typify_derive('lod25', 'lod200', 75000, groups => '{NULL}')) AS null_group, (SELECT count(*) FROM typify_derive('lod25', 'lod200', 75000, groups => '{1}')) AS no_such_group
FROM typify_derive('lod25', 'lod200', 75000);

-- group columns of any type, named the same in every session, ids of every integer type
CREATE DOMAIN pg_temp.key AS smallint;
CREATE TYPE pg_temp.kind AS ENUM ('a', 'b');
CREATE TEMP TABLE typed AS SELECT id, id::smallint AS small, id::bigint AS big, id::smallint::pg_temp.key AS keyed, geom, id % 3 AS number, id % 2 = 0 AS yes, date '2025-01-01' + id % 3 AS day, (id % 3) / 2.0 AS fraction, id % 2 / 3.0::float8 AS third, CASE id % 3 WHEN 2 THEN 'it''s "2"' ELSE 'w' || id % 3 END AS word,
	chr(97 + id % 3)::char(4) AS letter, ARRAY[id % 2, NULL] AS list, CASE id % 2 WHEN 0 THEN 'a' ELSE 'b' END::pg_temp.kind AS kind, ROW(id % 2, 'x')::record IS NULL AS never, jsonb_build_object('k', id % 2) AS json FROM lod25;
SELECT c AS by, count(DISTINCT grp) AS groups, count(*) AS placeholders, string_agg(DISTINCT grp, ' ') AS names
FROM unnest(ARRAY['number', 'yes', 'day', 'fraction', 'letter', 'list', 'kind', 'never', 'json']) AS c, typify_derive('typed', NULL, 75000, 0, c) GROUP BY c ORDER BY c;
SELECT c AS by, g AS groups, count(*) AS placeholders, string_agg(DISTINCT grp, ' ') AS names
FROM (VALUES ('number', '{2,absent,1.5,99999999999999999999,-1}'), ('number', '{0,NULL}'), ('day', '{2025-01-02,tomorrow}'), ('letter', '{a,"b   "}'), ('yes', '{true}'), ('word', '{w1,"it''s \"2\""}')) AS v (c, g),
	typify_derive('typed', NULL, 75000, 0, c, groups => g::text[]) GROUP BY c, g ORDER BY c, g;
SET datestyle = 'German';
SET extra_float_digits = -10;
SELECT c AS by, count(DISTINCT grp) AS groups, string_agg(DISTINCT grp, ' ') AS names FROM unnest(ARRAY['day', 'third']) AS c, typify_derive('typed', NULL, 75000, 0, c) GROUP BY c ORDER BY c;
RESET datestyle;
RESET extra_float_digits;
SELECT c AS key, count(*) AS placeholders, sum(id) AS ids FROM unnest(ARRAY['id', 'small', 'big', 'keyed']) AS c, typify_derive('typed', NULL, 75000, 0, id_column => c) GROUP BY c ORDER BY c;

-- views, materialized views, partitioned and foreign tables
CREATE VIEW typify_test_view AS SELECT id, block, ST_Translate(geom, 0, 0) AS geom FROM lod25;
CREATE TABLE typify_test_parted (id integer, block text, geom geometry) PARTITION BY LIST (block);
CREATE TABLE typify_test_part PARTITION OF typify_test_parted FOR VALUES IN ('1', '2', '3', NULL);
CREATE TABLE typify_test_rest PARTITION OF typify_test_parted DEFAULT;
INSERT INTO typify_test_parted SELECT * FROM lod25;
CREATE MATERIALIZED VIEW typify_test_stored AS SELECT * FROM typify_test_parted;
CREATE EXTENSION file_fdw;
CREATE SERVER typify_test_files FOREIGN DATA WRAPPER file_fdw;
\set ECHO none
SELECT format('CREATE FOREIGN TABLE typify_test_foreign (id integer, block text, geom geometry) SERVER typify_test_files OPTIONS (program %L, delimiter ''|'')',
	'printf ''' || string_agg(id || '|' || coalesce(block, '\\N') || '|' || geom::text || '\n', '' ORDER BY id) || '''') FROM lod25 \gexec
\set ECHO all
SELECT t AS relation, count(*) AS placeholders, count(*) FILTER (WHERE (a.geom::bytea, a.members, a.area, a.grp) IS NOT DISTINCT FROM (d.geom::bytea, d.members, d.area, d.grp)) AS same
FROM unnest(ARRAY['typify_test_view', 'typify_test_parted', 'typify_test_stored', 'typify_test_foreign']) AS t
CROSS JOIN LATERAL typify_derive(t::regclass, 'lod200', 75000, 0.5, 'block') AS d
LEFT JOIN LATERAL (SELECT * FROM typify_derive('lod25', 'lod200', 75000, 0.5, 'block')) AS a USING (id)
GROUP BY t ORDER BY t;
-- the nearest building's group, without an index too
ALTER TABLE lod200 RENAME block TO quarter;
SELECT t AS relation, count(*) AS groups, sum(n200 * ascii(grp)) AS objects FROM unnest(ARRAY['lod25', 'typify_test_parted', 'typify_test_foreign']) AS t, typify_calibrate(t::regclass, 'lod200', 0, 'block') GROUP BY t ORDER BY t;
ALTER TABLE lod200 RENAME quarter TO block;
DROP EXTENSION file_fdw CASCADE;
DROP MATERIALIZED VIEW typify_test_stored;
DROP TABLE typify_test_parted;
DROP VIEW typify_test_view;

-- in a read-only transaction, and as a table's source
BEGIN READ ONLY;
SELECT count(*) FROM typify_derive('lod25', 'lod200', 75000, 0.5, 'block', allocation => 'total');
COMMIT;
CREATE TEMP TABLE derived AS SELECT * FROM typify_derive('lod25', 'lod200', 75000, 0.5, 'block');
SELECT attname, atttypid::regtype FROM pg_attribute WHERE attrelid = 'derived'::regclass AND attnum > 0 ORDER BY attnum;
-- points have no size: said once, by what would draw them
CREATE TEMP TABLE point AS SELECT id, block, ST_Centroid(geom) AS geom FROM lod25;
SELECT count(*) AS rows, count(geom) AS drawn FROM typify_derive('point', 'lod200', 200000, 0.5);
-- NULL and EMPTY are passed over; no building, no row
CREATE TEMP TABLE holes AS SELECT id, block, geom::geometry FROM lod25 UNION ALL VALUES (1, '1', NULL::geometry), (9002, 'none', 'SRID=25832;POLYGON EMPTY');
SELECT count(*) AS rows, count(*) FILTER (WHERE grp = 'none') AS none FROM typify_derive('holes', 'lod200', 75000, 0.5, 'block');
CREATE TEMP TABLE nobody (id integer, block text, geom geometry);
SELECT count(*) AS rows FROM unnest(ARRAY['lod200'::regclass, 'nobody', NULL]) AS l, unnest(ARRAY['each_group', 'total']) AS a, unnest(ARRAY['block', NULL]) AS g, typify_derive('nobody', l, 75000, 0.5, g, allocation => a);

-- errors of its own, besides those of typify_calibrate
CREATE TEMP TABLE wrong AS SELECT id / 2 AS twice, id::text AS word, ST_SetSRID(geom, 4326) AS degrees, * FROM lod25;
CREATE TEMP TABLE link AS SELECT id AS lod25_id, 1 AS lod200_id FROM lod25;
CREATE TEMP TABLE word_link AS SELECT id::text AS lod25_id, 1 AS lod200_id FROM lod25;
SELECT a AS arguments, regexp_replace(pg_temp.error_of(format('SELECT * FROM typify_derive(%s)', a)), 'pg_temp_\d+', 'pg_temp', 'g') AS error FROM unnest(ARRAY[
	'''absent'', NULL, 75000', 'NULL, NULL, 75000', '0, NULL, 75000', '''lod25'', NULL, NULL', '''lod25'', NULL, 24999', '''lod25'', NULL, ''NaN''', '''lod25'', NULL, 75000, NULL', '''lod25'', NULL, 75000, -1',
	'''lod25'', NULL, 75000, allocation => NULL', '''lod25'', NULL, 75000, allocation => ''each''', '''lod25'', NULL, 75000, id_column => NULL', '''lod25'', NULL, 75000, geom_column => NULL', '''lod25'', ''lod200'', 75000, lod200_geom_column => NULL',
	'''lod25'', NULL, 75000, box => ST_MakeEnvelope(0, 0, 1, 1)', '''lod25'', NULL, 75000, box => ST_MakeEnvelope(0, 0, 1, 1, 25833)',
	'''wrong'', NULL, 75000, id_column => ''word''', '''wrong'', NULL, 75000, id_column => ''twice''', '''wrong'', NULL, 75000, 0, ''block'', id_column => ''twice''', '''wrong'', NULL, 75000, geom_column => ''degrees''',
	'''lod25'', NULL, 75000, 0, ''block'', links => ''link''', '''lod25'', NULL, 75000, links => ''word_link''', '''lod25'', NULL, 75000, links => ''absent''',
	'''lod25'', ''lod200'', 75000, 0, ''block'', allocation => ''total'', options => typify_options(min_distance => 10)', '''lod25'', NULL, 75000, options => typify_options(min_gap => -1)',
	'''lod200'', ''lod25'', 75000', '''lod25'', ''nobody'', 75000', '''nobody'', NULL, 20000', '''nobody'', NULL, 75000, 2'
]) WITH ORDINALITY AS a (a, number) ORDER BY number;
