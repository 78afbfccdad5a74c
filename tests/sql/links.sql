-- links.sql: from typify_match to typify_derive - with links as groups, each linked object of LOD200 is one placeholder
-- at lod200_scale, as large as it is and standing for its buildings
\pset null '(null)'
CREATE SCHEMA typify_links;
SET search_path = typify_links, public;
\i tests/data/two_levels.sql
\i tests/data/error_of.sql

-- made by arithmetic; with ids and geometries of other names
CREATE TABLE made AS SELECT id AS nr, block, geom AS outline FROM lod25;
CREATE TABLE made200 AS SELECT 1000 + id AS fid, block AS quarter, geom AS shape FROM lod200;
DROP TABLE lod25, lod200 CASCADE;
CREATE TABLE made_links AS SELECT * FROM typify_match('made', 'made200', 0.5, 'block', id_column => 'nr', geom_column => 'outline',
	lod200_id_column => 'fid', lod200_geom_column => 'shape', lod200_group_by => 'quarter');
CREATE MATERIALIZED VIEW made_links_stored AS SELECT * FROM typify_match('made', 'made200', 0.5, 'block', id_column => 'nr', geom_column => 'outline',
	lod200_id_column => 'fid', lod200_geom_column => 'shape', lod200_group_by => 'quarter');

-- the shipped settlement, and the boxes around its clusters
\set ECHO none
\i tests/data/settlement.sql
\set ECHO all
SET search_path = typify_links, public;
CREATE VIEW town AS SELECT id AS nr, block, geom AS outline FROM settlement_buildings;
CREATE TABLE town200 AS
SELECT min(id) AS fid, ST_Envelope(ST_Collect(geom)) AS shape
FROM (SELECT id, geom, ST_ClusterDBSCAN(geom, 25, 2) OVER () AS cluster FROM settlement_buildings) AS b WHERE cluster IS NOT NULL GROUP BY cluster;
CREATE TABLE town_links AS SELECT * FROM typify_match('town', 'town200', 0.5, 'block', 1, id_column => 'nr', geom_column => 'outline',
	lod200_id_column => 'fid', lod200_geom_column => 'shape');
CREATE MATERIALIZED VIEW town_links_stored AS SELECT * FROM typify_match('town', 'town200', 0.5, 'block', 1, id_column => 'nr', geom_column => 'outline',
	lod200_id_column => 'fid', lod200_geom_column => 'shape');

CREATE FUNCTION pg_temp.story(data text, stored text, scale float8, s_u float8, options typify_options, OUT linked boolean, OUT one_each boolean,
	OUT of_its_area boolean, OUT of_its_buildings boolean, OUT others boolean, OUT everybody boolean, OUT both_sides_unmatched boolean) LANGUAGE plpgsql AS
$$
BEGIN
	EXECUTE format('WITH link AS MATERIALIZED (
		SELECT lod200_id::text AS grp, array_agg(lod25_id ORDER BY lod25_id) AS ids FROM %1$s WHERE lod25_id IS NOT NULL GROUP BY lod200_id
	), drawn AS MATERIALIZED (
		SELECT * FROM typify_derive(%2$L, %3$L, $1, $2, options => $3, id_column => ''nr'', geom_column => ''outline'',
			lod200_id_column => ''fid'', lod200_geom_column => ''shape'', links => %1$L)
	)
	SELECT count(l.grp) > 20, count(d.id) FILTER (WHERE d.grp IS NOT NULL) = (SELECT count(*) FROM link WHERE grp IS NOT NULL) AND count(DISTINCT d.grp) = count(d.grp),
		bool_and(abs(d.area / ST_Area(o.shape) - 1) < 1e-9) FILTER (WHERE d.grp IS NOT NULL), bool_and(d.members = l.ids) FILTER (WHERE d.grp IS NOT NULL),
		(SELECT array_agg(m ORDER BY m) FROM drawn, unnest(members) AS m WHERE grp IS NULL) IS NOT DISTINCT FROM (SELECT ids FROM link WHERE grp IS NULL),
		sum(d.member_count) = (SELECT count(*) FROM %2$s), (SELECT count(*) > 0 FROM link WHERE grp IS NULL) AND (SELECT count(*) > 0 FROM %1$s WHERE lod25_id IS NULL)
	FROM drawn AS d LEFT JOIN link AS l USING (grp) LEFT JOIN %3$s AS o ON o.fid::text = d.grp', stored, data, data || '200')
	INTO linked, one_each, of_its_area, of_its_buildings, others, everybody, both_sides_unmatched USING scale, s_u, options;
END
$$;
SELECT stored, s_u, name, (pg_temp.story(data, stored, scale, s_u, o)).*
FROM (VALUES ('made', 'made_links'), ('made', 'made_links_stored'), ('town', 'town_links'), ('town', 'town_links_stored')) AS d (data, stored),
	(VALUES (0, 200000, 'nothing', NULL::typify_options), (0.5, 200000, 'nothing', NULL), (1, 200000, 'median', typify_options(area_statistic => 'median')),
		(0.5, 100000, 'other scales', typify_options(source_scale => 10000, lod200_scale => 100000))) AS v (s_u, scale, name, o)
ORDER BY stored, s_u, name;
-- in between, at least one for each object and never fewer at a larger scale; at m25 every building
SELECT stored, bool_and(n >= objects) AS all_objects, bool_and(n <= before) AS ever_fewer, max(n) = max(members) AS at_m25_all
FROM (SELECT stored, scale, n, members, objects, lag(n) OVER (PARTITION BY stored ORDER BY scale) AS before FROM (
	SELECT stored, scale, count(*) AS n, sum(member_count) AS members, count(DISTINCT grp) AS objects
	FROM (VALUES ('made', 'made_links'), ('town', 'town_links')) AS d (data, stored), unnest(ARRAY[25000, 40000, 75000, 120000, 200000]::float8[]) AS scale,
		typify_derive(data::regclass, (data || '200')::regclass, scale, 0.5, id_column => 'nr', geom_column => 'outline', lod200_id_column => 'fid', lod200_geom_column => 'shape', links => stored::regclass)
	GROUP BY stored, scale) AS each) AS t GROUP BY stored ORDER BY stored;

-- layers of links: a materialized view of a materialized view, a table, one built in batches
SELECT typify_create_scale('town75', 'town', 'town200', 75000, 0.5, id_column => 'nr', geom_column => 'outline', lod200_id_column => 'fid', lod200_geom_column => 'shape', links => 'town_links_stored') AS layer;
SELECT typify_create_scale('town75_table', 'town', 'town200', 75000, 0.5, kind => 'table', id_column => 'nr', geom_column => 'outline', lod200_id_column => 'fid', lod200_geom_column => 'shape', links => 'town_links') AS layer;
SET client_min_messages = warning;
CALL typify_build_scale('town75_built', 'town', 'town200', 75000, 0.5, id_column => 'nr', geom_column => 'outline', lod200_id_column => 'fid', lod200_geom_column => 'shape', links => 'town_links', batch => 20);
RESET client_min_messages;
SELECT count(*) > 100 AS placeholders, (SELECT count(*) FROM (TABLE town75 EXCEPT ALL TABLE town75_table) AS d) AS table_differs, (SELECT count(*) FROM (TABLE town75 EXCEPT ALL TABLE town75_built) AS d) AS built_differs FROM town75;
-- a link corrected by hand: both groups refreshed
CREATE TEMP TABLE choice AS SELECT min(lod200_id) AS old, max(lod200_id) AS new, min(lod25_id) FILTER (WHERE lod200_id IS NOT NULL) AS nr FROM town_links;
UPDATE choice SET old = (SELECT lod200_id FROM town_links WHERE lod25_id = nr);
UPDATE town_links SET lod200_id = new FROM choice WHERE lod25_id = nr;
SELECT typify_refresh_groups('town75_table', ARRAY[old::text, new::text]) > 0 AS rows FROM choice;
SELECT typify_refresh_scale('town75_built');
SELECT (SELECT count(*) FROM (TABLE town75_table EXCEPT ALL TABLE town75_built) AS d) AS differ, grp = new::text AS moved FROM town75_table, choice WHERE nr = ANY (members);

-- what links and ids may be
CREATE TABLE twice AS SELECT lod25_id, lod200_id FROM town_links UNION ALL SELECT nr, old FROM choice;
CREATE TABLE town_without_fid AS SELECT shape FROM town200;
CREATE TABLE town_twice AS TABLE town200 UNION ALL (SELECT * FROM town200 ORDER BY fid LIMIT 1);
SELECT l AS lod200, k AS links, e AS more, pg_temp.error_of(format('SELECT * FROM typify_derive(''town'', %L, 75000, id_column => ''nr'', geom_column => ''outline'', lod200_geom_column => ''shape'', links => %L%s)', l, k, e)) AS error
FROM (VALUES ('town200', 'town_links', ''), ('town200', 'twice', ', lod200_id_column => ''fid'''), ('town_twice', 'town_links', ', lod200_id_column => ''fid'''), ('town_without_fid', 'town_links', ', lod200_id_column => ''fid'''),
	('town200', 'town_links', ', lod200_id_column => ''shape'''), ('town200', 'town_links', ', lod200_id_column => NULL'), ('town200', 'town_links', ', group_by => ''block'''), ('town200', 'town200', ', lod200_id_column => ''fid''')) AS v (l, k, e);
SET client_min_messages = warning;
DROP SCHEMA typify_links CASCADE;
