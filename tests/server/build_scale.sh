#!/bin/bash
# build_scale.sh - the fear: typify_build_scale is stopped half-way, cancelled, timed out or cut off, and what it goes
# on to build later is not what typify_create_scale makes. Uses the server of the PG* variables.
. "$(dirname "$0")/common.sh"

fresh_database typify_build_scale tests/data/settlement.sql
scratch=$OWN_FOLDER
arguments="'slow', 'coarse', 75000, 0.5, 'block'"
sql -o /dev/null <<'SQL'
CREATE TABLE coarse AS SELECT ST_Expand(ST_Centroid(geom), 30) AS geom FROM settlement_buildings WHERE id % 11 = 0;
-- from so many groups in the layer on, reading the buildings takes so many seconds longer
CREATE FUNCTION nap() RETURNS boolean LANGUAGE plpgsql AS
$$
BEGIN
	IF current_setting('typify_test.groups', true) <> '' AND to_regclass('layer') IS NOT NULL THEN
		IF (SELECT count(DISTINCT grp) FROM layer) >= current_setting('typify_test.groups')::bigint THEN
			PERFORM pg_sleep(current_setting('typify_test.seconds')::float8);
		END IF;
	END IF;
	RETURN true;
END
$$;
CREATE VIEW slow AS SELECT b.* FROM settlement_buildings AS b, (SELECT nap() OFFSET 0) AS n;
SQL
sql -o /dev/null -c "SELECT typify_create_scale('whole', $arguments, 'table')"
groups=$(answer 'SELECT count(DISTINCT block) FROM settlement_buildings')
done_groups() { answer 'SELECT count(DISTINCT grp) FROM layer'; }
# build BATCH GROUPS SECONDS [OPTIONS]: in the background; its words go to $scratch/words
build() {
	PGAPPNAME=build PGOPTIONS="-c typify_test.groups=$2 -c typify_test.seconds=$3 ${4-}" sql \
		-v VERBOSITY=verbose -c "CALL typify_build_scale('layer', $arguments, batch => $1)" \
		>"$scratch/words" 2>&1 </dev/null &
}
# stop FUNCTION: calls it on the backend that builds as soon as that sleeps
stop() {
	local stopped
	for ((i = 0; i < 300; i++)); do
		stopped=$(answer "SELECT $1(pid) FROM pg_stat_activity
			WHERE application_name = 'build' AND wait_event = 'PgSleep'")
		if [ "$stopped" ]; then break; fi
		sleep 0.1
	done
	wait || true
}
unfinished() { answer "SELECT obj_description('layer'::regclass)::jsonb->'finished' = 'false'
	AND (SELECT count(DISTINCT grp) = $1 FROM layer)"; }

build 1 5 60
stop pg_cancel_backend
check "cancelled: $(grep -o 'ERROR:  57014' "$scratch/words"), $(done_groups) of $groups groups are there" \
	"$(unfinished 5)" t
build 5 20 60 '-c statement_timeout=5s'
wait || true
check "timed out: $(grep -o 'ERROR:  57014' "$scratch/words"), $(done_groups) are there" "$(unfinished 20)" t
build 3 30 60
stop pg_terminate_backend
check "cut off: $(done_groups) are there" "$(unfinished 30)" t
# two at a time do not get into each other's way
build 2 1 0.01
for ((i = 0; i < 100; i++)); do
	if [ "$(done_groups)" -gt 30 ]; then break; fi
	sleep 0.1
done
answer "CALL typify_build_scale('layer', $arguments, batch => 3)"
wait || true
check "gone on with, by two at the same time, the other at last $(
	grep -o '[0-9]* of [0-9]* groups' "$scratch/words" | tail -1)" "$(answer "SELECT $(done_groups) = $groups")" t
check "finished" "$(answer "SELECT NOT obj_description('layer'::regclass)::jsonb ? 'finished'")" t
check "row for row what typify_create_scale makes" "$(answer "SELECT count(*) = 0 FROM
	((TABLE layer EXCEPT ALL TABLE whole) UNION ALL (TABLE whole EXCEPT ALL TABLE layer)) AS d")" t
check "the same comment and what it remembers" "$(answer "SELECT
	obj_description('layer'::regclass) = obj_description('whole'::regclass)
	AND obj_description('layer_grp_idx'::regclass) = obj_description('whole_grp_idx'::regclass)")" t
exit $FAILED
