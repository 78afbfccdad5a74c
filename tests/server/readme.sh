#!/bin/bash
# readme.sh - the fear: a newcomer copies a query from the README and it fails. Runs them all on the sample. Uses the
# server of the PG* variables.
set -euo pipefail
cd "$(dirname "$0")/../.."
database=typify_readme
queries=$(mktemp)
finish() {
	rm -f "$queries"
	dropdb --if-exists $database
}
trap finish EXIT

awk '/^```sql$/ { inside = 1; next } /^```$/ { inside = 0 } inside' README.md | grep -v 'CREATE EXTENSION' >"$queries"
createdb $database
export PGDATABASE=$database PGOPTIONS='-c client_min_messages=warning'
psql -qX -v ON_ERROR_STOP=1 -o /dev/null -c 'CREATE EXTENSION typify CASCADE' -f tests/data/settlement.sql \
	-c 'CREATE TABLE buildings AS SELECT * FROM settlement_buildings' -c 'CREATE TABLE lod25 AS TABLE buildings' \
	-c 'CREATE TABLE roads AS TABLE settlement_roads' \
	-c 'CREATE TABLE lod200 AS SELECT id, ST_Buffer(geom, 8) AS geom FROM buildings WHERE ST_Area(geom) > 250'
psql -qX -v ON_ERROR_STOP=1 -o /dev/null -f "$queries"
drawn=$(psql -qXAt -c 'SELECT count(*) FROM buildings75 WHERE ST_IsValid(geom)')
expected=$(psql -qXAt -c 'SELECT sum(n) FROM (SELECT typify_count(count(*), 75000) n FROM buildings GROUP BY block) t')
echo "$(grep -c ';' "$queries") statements ran; $drawn placeholders at 75 000, $expected expected"
[ "$drawn" = "$expected" ]
