#!/bin/bash
# build_scale.sh - the fear: typify_build_scale is stopped half-way, cancelled, timed out or cut off, and what it goes
# on to build later is not what typify_create_scale makes. Uses the server of the PG* variables.
set -euo pipefail
cd "$(dirname "$0")/../.."
database=typify_build_scale
scratch=$(mktemp -d)
finish() {
	rm -rf "$scratch"
	dropdb --if-exists -f $database
}
trap finish EXIT
createdb $database
export PGDATABASE=$database
arguments="'slow', 'coarse', 75000, 0.5, 'block'"
query() { PGOPTIONS='-c client_min_messages=warning' psql -qXAt -v ON_ERROR_STOP=1 "$@"; }
query -o /dev/null -c 'CREATE EXTENSION typify CASCADE' -f tests/data/settlement.sql -f - <<'SQL'
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
query -o /dev/null -c "SELECT typify_create_scale('whole', $arguments, 'table')"
groups=$(query -c 'SELECT count(DISTINCT block) FROM settlement_buildings')
failed=0
# check WHAT VALUE: the value must be t
check() {
	if [ "$2" = t ]; then echo "ok: $1"; else echo "failed: $1: $2"; failed=1; fi
}
done_groups() { query -c 'SELECT count(DISTINCT grp) FROM layer'; }
# build BATCH GROUPS SECONDS [OPTIONS]: in the background; its words go to $scratch/words
build() {
	PGAPPNAME=build PGOPTIONS="-c typify_test.groups=$2 -c typify_test.seconds=$3 ${4-}" psql -qX -v ON_ERROR_STOP=1 \
		-v VERBOSITY=verbose -c "CALL typify_build_scale('layer', $arguments, batch => $1)" \
		>"$scratch/words" 2>&1 </dev/null &
}
# stop FUNCTION: calls it on the backend that builds as soon as that sleeps
stop() {
	local stopped
	for ((i = 0; i < 300; i++)); do
		stopped=$(query -c "SELECT $1(pid) FROM pg_stat_activity
			WHERE application_name = 'build' AND wait_event = 'PgSleep'")
		if [ "$stopped" ]; then break; fi
		sleep 0.1
	done
	wait || true
}
unfinished() { query -c "SELECT obj_description('layer'::regclass)::jsonb->'finished' = 'false'
	AND (SELECT count(DISTINCT grp) = $1 FROM layer)"; }

build 1 5 60
stop pg_cancel_backend
check "cancelled: $(grep -o 'ERROR:  57014' "$scratch/words"), $(done_groups) of $groups groups are there" \
	"$(unfinished 5)"
build 5 20 60 '-c statement_timeout=5s'
wait || true
check "timed out: $(grep -o 'ERROR:  57014' "$scratch/words"), $(done_groups) are there" "$(unfinished 20)"
build 3 30 60
stop pg_terminate_backend
check "cut off: $(done_groups) are there" "$(unfinished 30)"
# two at a time do not get into each other's way
build 2 1 0.01
for ((i = 0; i < 100; i++)); do
	if [ "$(done_groups)" -gt 30 ]; then break; fi
	sleep 0.1
done
query -c "CALL typify_build_scale('layer', $arguments, batch => 3)"
wait || true
check "gone on with, by two at the same time, the other at last $(
	grep -o '[0-9]* of [0-9]* groups' "$scratch/words" | tail -1)" "$(query -c "SELECT $(done_groups) = $groups")"
check "finished" "$(query -c "SELECT NOT obj_description('layer'::regclass)::jsonb ? 'finished'")"
check "row for row what typify_create_scale makes" "$(query -c "SELECT count(*) = 0 FROM
	((TABLE layer EXCEPT ALL TABLE whole) UNION ALL (TABLE whole EXCEPT ALL TABLE layer)) AS d")"
check "the same comment and what it remembers" "$(query -c "SELECT
	obj_description('layer'::regclass) = obj_description('whole'::regclass)
	AND obj_description('layer_grp_idx'::regclass) = obj_description('whole_grp_idx'::regclass)")"
exit $failed
