#!/bin/bash
# web.sh - the fear: the web map of README and doc/hierarchy.md does not come up, is black, or asks other hosts. Serves
# the sample and looks at it in a headless Chromium. Uses the server of the PG* variables; SCREENSHOTS: a folder that
# gets the pictures. Skipped where node, npm or Chromium are missing, or npm's packages are not to be had.
. "$(dirname "$0")/common.sh"

for program in node npm chromium; do
	command -v $program >/dev/null || { echo "skipped: no $program; Debian has it"; exit 77; }
done
cp -r tests/web "$OWN_FOLDER/web"
# Without a way to the packages there is no test; packages that do not fit together, or not this node, are a failure.
web_packages() (
	cd "$OWN_FOLDER/web"
	npm_config_cache=$OWN_FOLDER/npm npm_config_engine_strict=true timeout 240 npm ci >"$OWN_FOLDER/npm.log" 2>&1
)
no_way='ENOTFOUND|EAI_AGAIN|ECONN[A-Z]+|ETIMEDOUT|ENETUNREACH|EHOSTUNREACH|E40[0-9]|E5[0-9][0-9]|CERT|ENOTCACHED'
web_packages || {
	status=$?
	tail -n 5 "$OWN_FOLDER/npm.log"
	code=$(sed -nE 's/^npm (ERR!|error) code //p' "$OWN_FOLDER/npm.log")
	[ $status = 124 ] || [[ $code =~ $no_way ]] || exit 1
	echo "skipped: npm has no way to the packages of tests/web${code:+: $code}"
	exit 77
}
fresh_database typify_web tests/data/settlement.sql
sql -o /dev/null -c 'CREATE TABLE buildings AS SELECT d.id, class, d.geom
		FROM typify_dissolve_table($$settlement_buildings$$, 0.5) AS d JOIN settlement_buildings USING (id)' \
	-c 'ALTER TABLE buildings ADD PRIMARY KEY (id)' -c 'CREATE INDEX ON buildings USING gist (geom)' \
	-c 'CREATE TABLE roads AS TABLE settlement_roads' -f tests/web/maps.sql

export HOME=$OWN_FOLDER TMPDIR=$OWN_FOLDER
node "$OWN_FOLDER/web/server.mjs" >"$OWN_FOLDER/address" &
server=$!
trap 'kill $server 2>/dev/null && wait $server; clean_up' EXIT
for ((i = 0; i < 100; i++)); do [ -s "$OWN_FOLDER/address" ] && break; sleep 0.1; done
mkdir "$OWN_FOLDER/screenshots"
node "$OWN_FOLDER/web/test.mjs" "$(cat "$OWN_FOLDER/address")" "$OWN_FOLDER/screenshots" || FAILED=1
check "screenshots" "$(find "$OWN_FOLDER/screenshots" -name '*.png' -size +5k | wc -l)" 9
[ -z "${SCREENSHOTS:-}" ] || cp "$OWN_FOLDER"/screenshots/*.png "$SCREENSHOTS/"
exit $FAILED
