#!/bin/bash
# edits.sh - the fear: after edits, refreshing the groups that changed leaves a layer that is not what deriving anew
# gives: rows too many, too few, stale, or calibrated to what was. 1 000 random edits of the settlement, ten at a time,
# with LOD200 by nearest building and groups kept apart, and with fixed options and no gap. Uses the server of the PG* variables.
. "$(dirname "$0")/common.sh"

fresh_database typify_edits tests/data/settlement.sql
sql -o /dev/null \
	-c 'CREATE TABLE lod25 AS SELECT id, block, geom FROM settlement_buildings' \
	-c 'CREATE TABLE coarse AS SELECT ST_Expand(ST_Centroid(geom), 30) AS geom FROM lod25 WHERE id % 11 = 0' \
	-c 'ALTER TABLE lod25 ADD PRIMARY KEY (id)' \
	-c 'CREATE INDEX ON lod25 USING gist (geom)' -c 'CREATE INDEX ON lod25 (block)' -c 'ANALYZE'
summary=$(sql -At -f tests/data/edits.sql -f - <<'SQL' | tail -1
CREATE FUNCTION pg_temp.edits(OUT edits integer, OUT stale integer, OUT differing bigint, OUT fixed_differing bigint,
	OUT refreshed bigint, OUT rows bigint, OUT seconds_groups numeric, OUT seconds_anew numeric) LANGUAGE plpgsql
SET client_min_messages = error AS
$$
DECLARE
	anew CONSTANT text := 'SELECT * FROM typify_derive(''lod25'', ''coarse'', 75000, 0.5, ''block'', '
		'options => typify_options(min_side => 0.35, min_gap => 0.2))';
	options CONSTANT typify_options := jsonb_populate_record((c).options, '{"min_side": 0, "min_gap": 0}')
		FROM typify_calibrate('lod25', 'coarse', 0.5) AS c;
	fixed CONSTANT text := format(
		'SELECT * FROM typify_derive(''lod25'', ''coarse'', 100000, 0.5, ''block'', options => %L)', options);
	touched text[];
	started timestamptz;
BEGIN
	edits := 0;
	stale := 0;
	differing := 0;
	fixed_differing := 0;
	refreshed := 0;
	rows := 0;
	seconds_groups := 0;
	seconds_anew := 0;
	PERFORM typify_create_scale('layer', 'lod25', 'coarse', 75000, 0.5, 'block', 'table');
	PERFORM typify_create_scale('fixed', 'lod25', 'coarse', 100000, 0.5, 'block', 'table', options);
	FOR round IN 1 .. 100 LOOP
		touched := '{}';
		FOR i IN 1 .. 10 LOOP
			edits := edits + 1;
			touched := touched || pg_temp.edit('lod25', edits);
		END LOOP;
		IF round % 10 = 0 THEN
			stale := stale + (pg_temp.differing('layer', anew) > 0)::integer;
		END IF;
		PERFORM typify_refresh_groups('layer', touched);
		started := clock_timestamp();
		refreshed := refreshed + typify_refresh_groups('fixed', touched);
		seconds_groups := seconds_groups + extract(epoch FROM clock_timestamp() - started)::numeric;
		rows := rows + (SELECT count(*) FROM fixed);
		differing := differing + pg_temp.differing('layer', anew);
		fixed_differing := fixed_differing + pg_temp.differing('fixed', fixed);
		started := clock_timestamp();
		EXECUTE 'SELECT count(*) FROM (' || fixed || ') AS f';
		seconds_anew := seconds_anew + extract(epoch FROM clock_timestamp() - started)::numeric;
	END LOOP;
END
$$;
SELECT format('%s edits, %s of 10 times stale before; rows that differ afterwards: %s calibrated, %s with fixed '
	'options; with those, %s of %s rows written in %s s, anew it takes %s s', edits, stale, differing, fixed_differing,
	refreshed, rows, round(seconds_groups, 1), round(seconds_anew, 1)) FROM pg_temp.edits();
SQL
)
echo "$summary"
[[ $summary == "1000 edits, 10 of 10 times stale before; rows that differ afterwards: 0 calibrated, 0 with fixed "* ]]
