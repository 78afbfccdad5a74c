#!/bin/bash
# readme.sh - the fear: a newcomer copies a query from the README and it fails. Runs them all on the sample. Uses the
# server of the PG* variables.
. "$(dirname "$0")/common.sh"

split_page README.md "$OWN_FOLDER"
cat "$OWN_FOLDER"/*.sql | grep -v 'CREATE EXTENSION' >"$OWN_FOLDER/queries"
fresh_database typify_readme tests/data/settlement.sql tests/data/settlement_lod200.sql
sql -c 'CREATE TABLE buildings AS SELECT * FROM settlement_buildings' -c 'CREATE TABLE lod25 AS TABLE buildings' \
	-c 'CREATE TABLE lod200 AS TABLE settlement_lod200' -c 'CREATE TABLE roads AS TABLE settlement_roads' \
	-c 'CREATE VIEW main_roads AS SELECT * FROM settlement_roads'
sql -o /dev/null -f "$OWN_FOLDER/queries"
echo "$(grep -c ';' "$OWN_FOLDER/queries") statements ran"
check "valid placeholders at 75 000, each with its id" \
	"$(answer 'SELECT count(DISTINCT id) FROM buildings75 WHERE ST_IsValid(geom)')" \
	"$(answer 'SELECT sum(n) FROM (SELECT typify_count(count(*), 75000) n FROM buildings GROUP BY block) t')"
exit $FAILED
