-- hierarchy_tables.sql: the fear: what is written to the table of a hierarchy is not what the aggregate says, or goes
-- where it should not
\set ECHO none
\i tests/data/settlement.sql
\set ECHO all
\i tests/data/error_of.sql
SET client_min_messages = warning;

-- the rows of the aggregate, with their places, and the sums over them
CREATE TABLE worth AS SELECT id, block, geom, CASE WHEN id % 97 = 0 THEN 'Infinity'::real WHEN id % 5 = 0 THEN 2 END AS importance FROM settlement_buildings;
CALL typify_build_hierarchy('plain', 'worth', 0.5, 'block', typify_options(psi => 0.5));
CALL typify_build_hierarchy('weighted', 'worth', 0.5, 'block', importance_column => 'importance', batch => 20);
CREATE FUNCTION pg_temp.unlike(hierarchy regclass, options typify_options, importance text) RETURNS TABLE (nodes bigint, unlike bigint, groups_unlike bigint) LANGUAGE plpgsql AS $$
BEGIN
	RETURN QUERY EXECUTE format('WITH expected AS (
			SELECT grp, (unnest(list)).* FROM (SELECT block::text AS grp, typify_hierarchy(geom, id, 0.5, $1, %2$s) AS list FROM worth GROUP BY block) AS b
		), placed AS (
			SELECT *, typify_reach(area, ratio, coalesce(($1).psi, 0.75)) AS reach FROM expected
		)
		SELECT count(*), count(*) FILTER (WHERE (n.parent, n.kept, n.representative, n.member_count, n.first_leaf, n.x, n.y, n.area, n.ratio, n.ux, n.uy, n.cost, n.scale_from, n.scale_to, n.place::text)
				IS DISTINCT FROM (e.parent, e.kept, e.representative, e.member_count, e.first_leaf, e.x, e.y, e.area, e.ratio, e.ux, e.uy, e.cost, e.scale_from, e.scale_to,
				typify_place(e.x, e.y, e.reach, e.scale_from, e.scale_to, 25000)::text)),
			(SELECT count(*) FROM %1$s_groups AS g FULL JOIN (
					SELECT grp, count(*) FILTER (WHERE member_count = 1) AS count, max(reach) AS reach, ST_MakeEnvelope(min(x), min(y), max(x), max(y), 25832) AS extent FROM placed GROUP BY grp) AS p USING (grp)
				FULL JOIN (SELECT block::text AS grp, bit_xor(typify_building_hash(geom, id, coalesce(%2$s, 1))) AS state FROM worth GROUP BY block) AS s USING (grp)
				WHERE (g.count, g.reach, g.extent::bytea, g.state) IS DISTINCT FROM (p.count, p.reach, p.extent::bytea, s.state))
		FROM (SELECT g.grp, h.* FROM %1$s AS h JOIN %1$s_groups AS g USING (group_id)) AS n FULL JOIN placed AS e USING (grp, node)', hierarchy, importance) USING options;
END $$;
SELECT * FROM pg_temp.unlike('plain', typify_options(psi => 0.5), 'NULL::real');
SELECT * FROM pg_temp.unlike('weighted', NULL, 'importance');

-- kept buildings are there at every scale, and look-ups show what the aggregate does
SELECT scale, count(*) FILTER (WHERE w.importance = 'Infinity') AS kept, count(*) FILTER (WHERE w.importance = 'Infinity' AND abs(a.area / ST_Area(w.geom) - 1) < 1e-9) AS in_size,
	count(*) FILTER (WHERE (a.geom::bytea, a.members, a.area) IS DISTINCT FROM (p.geom::bytea, p.members, p.area)) AS unlike
FROM unnest(ARRAY[25000, 61234, 1e6, 1e9]) AS scale, LATERAL (
	SELECT a.* FROM typify_at('weighted', scale) AS a) AS a FULL JOIN LATERAL (
	SELECT (unnest(typify_placeholders(geom, id, scale, 0.5, NULL, importance))).* FROM worth GROUP BY block) AS p USING (id) JOIN worth AS w USING (id) GROUP BY scale ORDER BY scale;

-- an importance is an edit like others, and found
UPDATE worth SET importance = 3 WHERE id = 10;
SELECT count(*) > 0 AS stale FROM typify_refresh_hierarchy('weighted');
UPDATE worth SET importance = 'Infinity' WHERE id = 11;
SELECT count(*) > 0 AS stale FROM typify_refresh_hierarchy('weighted');
SELECT * FROM pg_temp.unlike('weighted', NULL, 'importance');
SELECT count(*) AS stale FROM typify_refresh_hierarchy('weighted');

-- the user's own columns and indexes stay
ALTER TABLE weighted ADD COLUMN note text;
ALTER TABLE weighted ADD COLUMN remark text, DROP COLUMN note;
CREATE INDEX weighted_by_building ON weighted (representative);
UPDATE worth SET importance = 4 WHERE id = 12;
SELECT count(*) > 0 AS stale FROM typify_refresh_hierarchy('weighted');
SELECT * FROM pg_temp.unlike('weighted', NULL, 'importance');
SET enable_seqscan = off;
SELECT count(*) > 0 AS found_by_index FROM weighted WHERE representative = 12;
RESET enable_seqscan;

-- groups at the ends of their type are found by name, and what is no number of the type is none
CREATE TABLE ends AS SELECT id, geom, (ARRAY[-32768, 32767, 5]::smallint[])[1 + id % 3] AS small, (ARRAY[-2147483648, 2147483647, 5]::integer[])[1 + id % 3] AS whole,
	(ARRAY[-9223372036854775808, 9223372036854775807, 5]::bigint[])[1 + id % 3] AS big FROM settlement_buildings;
SELECT typed, (SELECT string_agg(DISTINCT grp COLLATE "C", ' ' ORDER BY grp COLLATE "C") FROM typify_derive('ends', NULL, 1000000, 0, typed::name, groups => '{-32768,-2147483648,-9223372036854775808,32767,2147483647,9223372036854775807,9223372036854775808,-0,05,five}')) AS found
FROM unnest(ARRAY['small', 'whole', 'big']) AS typed;
DROP TABLE ends;

-- what rows would be written past is refused
CREATE FUNCTION nothing() RETURNS trigger LANGUAGE plpgsql AS 'BEGIN RETURN NEW; END';
CREATE TABLE part AS SELECT * FROM worth LIMIT 40;
CREATE FUNCTION pg_temp.refused(change text) RETURNS text LANGUAGE plpgsql AS $$
DECLARE
	made text := 'no error';
BEGIN
	EXECUTE change;
	made := pg_temp.error_of('SELECT typify_write_hierarchy(geom, id, 0.5, NULL, NULL, NULL, ''plain'', 1000) FROM part');
	RAISE EXCEPTION USING ERRCODE = 'TY000', MESSAGE = made;
EXCEPTION WHEN SQLSTATE 'TY000' THEN
	RETURN SQLERRM;
END $$;
SELECT change, pg_temp.refused(change) FROM unnest(ARRAY[
	'CREATE TRIGGER t AFTER INSERT ON plain FOR EACH ROW EXECUTE FUNCTION nothing()', 'CREATE TRIGGER t AFTER INSERT ON plain FOR EACH STATEMENT EXECUTE FUNCTION nothing()',
	'CREATE TRIGGER t AFTER UPDATE ON plain FOR EACH ROW EXECUTE FUNCTION nothing()', 'ALTER TABLE plain ADD CHECK (node < 3) NOT VALID', 'ALTER TABLE plain ADD COLUMN c integer DEFAULT 3',
	'ALTER TABLE plain DROP COLUMN cost', 'DELETE FROM plain WHERE parent IS NULL; ALTER TABLE plain ALTER COLUMN parent SET NOT NULL', 'ALTER TABLE plain ALTER COLUMN x TYPE real', 'SELECT 1']) AS change;
SELECT pg_temp.error_of(call) FROM unnest(ARRAY[
	$$SELECT typify_write_hierarchy(geom, id, 0.5, NULL, NULL, NULL, 'worth', 1) FROM part$$, $$SELECT typify_write_hierarchy(geom, id, 0.5, NULL, NULL, NULL, NULL, 1) FROM part$$,
	$$SELECT typify_write_hierarchy(geom, id, 0.5, NULL, NULL, NULL, 'plain', NULL) FROM part$$, $$SELECT typify_write_hierarchy(geom, id, 0.5, NULL, NULL, NULL, 'pg_views', 1) FROM part$$,
	$$SELECT typify_write_hierarchy(geom, id, 0.5, NULL, NULL, NULL, 0, 1) FROM part$$,
	$$SELECT typify_write_hierarchy(geom, 1, 0.5, NULL, NULL, NULL, 'plain', 1000) FROM part$$, $$SELECT typify_write_hierarchy(geom, id, 0.5, NULL, NULL, NULL, 'plain', 1) FROM part$$,
	$$SELECT typify_write_hierarchy(geom, id, 0.5, NULL, NULL, NULL, 'plain', 1000) OVER () FROM part$$]) AS call;
SELECT pg_temp.error_of($$CALL typify_build_hierarchy('h', 'worth', importance_column => 'geom')$$), pg_temp.error_of($$CALL typify_build_hierarchy('h', 'worth', importance_column => 'nix')$$);
BEGIN READ ONLY;
SELECT pg_temp.error_of($$SELECT typify_write_hierarchy(geom, id, 0.5, NULL, NULL, NULL, 'plain', 1000) FROM part$$);
ROLLBACK;
CREATE ROLE typify_test_reader;
GRANT SELECT ON part, plain TO typify_test_reader;
SET ROLE typify_test_reader;
DO $$ BEGIN PERFORM typify_write_hierarchy(geom, id, 0.5, NULL, NULL, NULL, 'plain', 1000) FROM part; EXCEPTION WHEN insufficient_privilege THEN RAISE WARNING '%', SQLERRM; END $$;
RESET ROLE;
ALTER TABLE plain ENABLE ROW LEVEL SECURITY;
GRANT INSERT ON plain TO typify_test_reader;
SET ROLE typify_test_reader;
DO $$ BEGIN PERFORM typify_write_hierarchy(geom, id, 0.5, NULL, NULL, NULL, 'plain', 1000) FROM part; EXCEPTION WHEN feature_not_supported THEN RAISE WARNING '%', SQLERRM; END $$;
RESET ROLE;
SELECT count(*) FILTER (WHERE group_id = 1000) AS written FROM plain;
DROP TABLE plain, plain_groups, weighted, weighted_groups, worth, part;
DROP OWNED BY typify_test_reader;
DROP ROLE typify_test_reader;
DROP FUNCTION nothing;
DROP VIEW hamlet;
DROP TABLE settlement_buildings, settlement_roads, settlement_blocks;
