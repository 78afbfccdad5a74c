#!/bin/bash
# run.sh - makes the maps in the server of the PG* variables, which may be thrown away, and serves them until interrupted.
# DATA, ROADS: as in tools/web.sh; without DATA the landscape of the sample. PORT: where it answers.
set -euo pipefail
cd "$(dirname "$0")"
export PGDATABASE=typify_web PGOPTIONS='-c client_min_messages=warning'
sql() { psql -qX -v ON_ERROR_STOP=1 -o /dev/null "$@"; }
copy() { # copy FILE TABLE
	local reader=cat
	case $1 in *.gz) reader='gzip -dc' ;; esac
	$reader "$1" | sql -c "\\copy $2 FROM PSTDIN WITH (FORMAT csv, HEADER true)"
}

createdb $PGDATABASE
sql -c 'CREATE EXTENSION typify CASCADE'
if [ -n "${DATA:-}" ]; then
	sql -c 'CREATE TABLE buildings (id bigint PRIMARY KEY, class text, geom geometry)' \
		-c 'CREATE TABLE roads (id bigint, class text, geom geometry)'
	copy "$DATA" buildings
	if [ -n "${ROADS:-}" ]; then copy "$ROADS" roads; fi
	sql -c 'CREATE INDEX ON buildings USING gist (geom)' -c 'ANALYZE buildings'
else
	sql -f ../data/settlement.sql -f landscape.sql
fi
echo "building five hierarchies of $(psql -qXAt -c 'SELECT count(*) FROM buildings') buildings" >&2
sql -f maps.sql
echo 'the map is here, until you press Ctrl-C:' >&2
exec node server.mjs
