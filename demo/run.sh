#!/bin/bash
# run.sh - typify's demo inside a server that may be thrown away (PG* variables; the extension is installed there).
# OUT          folder for the pictures
# DATA         a user's own buildings: .csv.gz with columns id, class, geom (hex WKB with SRID)
# ROADS        lines to draw under them, same columns
# OSM          an OpenStreetMap extract: .osm.pbf
# ATTRIBUTION  what to write under the pictures of DATA
# Without DATA and OSM the shipped settlement is shown.

set -euo pipefail
cd "$(dirname "$0")/.."
OUT=${OUT:-demo-output}
DATA=${DATA:-} ROADS=${ROADS:-} OSM=${OSM:-} ATTRIBUTION=${ATTRIBUTION:-}
DATABASE=typify_demo

say() { printf '%s\n' "$@"; }
fail() { printf 'demo: %s\n' "$*" >&2; exit 1; }
sql() { psql -qX -v ON_ERROR_STOP=1 -v out="$OUT" -v attribution="$ATTRIBUTION" "$@"; }

# check_csv FILE: says in words what is wrong with it, prints its columns when nothing is
check_csv() {
	local header column
	[ -r "$1" ] || fail "cannot read $1"
	gzip -t "$1" 2>/dev/null || fail "$1 is not a gzip file; 'gzip buildings.csv' makes one"
	header=$(gzip -dc "$1" 2>/dev/null | head -n 1 | tr -d '\r"' || true)
	for column in id class geom; do
		case ",$header," in
			*,$column,*) ;;
			*) fail "$1 has no column $column: the first line must name id, class and geom, but is '${header:0:80}'" ;;
		esac
	done
	say "$header"
}

# load_csv FILE TABLE: into TABLE(id text, class text, geom geometry)
load_csv() {
	local columns
	columns=$(check_csv "$1") || exit 1
	sql -c "CREATE TABLE raw (\"${columns//,/\" text, \"}\" text)" \
		-c "\\copy raw FROM PROGRAM 'gzip -dc \"$1\"' WITH (FORMAT csv, HEADER true)" \
		-c "CREATE TABLE $2 AS SELECT id, class, geom::geometry FROM raw WHERE geom IS NOT NULL" -c "DROP TABLE raw" ||
		fail "$1 could not be read; geom must be hex WKB with SRID, as SELECT geom or ST_AsHEXEWKB(geom) writes it"
}

load() {
	if [ -n "$DATA" ]; then
		say "Loading $DATA ..."
		load_csv "$DATA" raw_buildings
		if [ -n "$ROADS" ]; then load_csv "$ROADS" raw_roads; fi
		sql -f demo/own.sql
	elif [ -n "$OSM" ]; then
		[ -r "$OSM" ] || fail "cannot read $OSM"
		command -v osm2pgsql >/dev/null || fail "osm2pgsql is missing: apt-get install osm2pgsql"
		say "Importing $OSM with osm2pgsql ..."
		osm2pgsql -d "$DATABASE" -O flex -S demo/osm.lua "$OSM" >"$OUT/osm2pgsql.log" 2>&1 ||
			fail "osm2pgsql failed, see $OUT/osm2pgsql.log: $(tail -n 1 "$OUT/osm2pgsql.log")"
		rm -f "$OUT/osm2pgsql.log"
		ATTRIBUTION=${ATTRIBUTION:-(c) OpenStreetMap contributors, ODbL}
		sql -f demo/own.sql
	else
		say "Making the sample settlement (tests/data/settlement.sql) ..."
		sql -f tests/data/settlement.sql -f demo/sample.sql
	fi
}

# list_pictures: makes the PNG of every picture and prints its path with what it shows
list_pictures() {
	local name caption kinds=svg
	if command -v rsvg-convert >/dev/null; then kinds='{svg,png}'
	else say "No PNG, since rsvg-convert is missing: apt-get install librsvg2-bin"; fi
	sql -At -F '|' -c "SELECT name, caption FROM demo.picture ORDER BY number" | while IFS='|' read -r name caption; do
		if [ "$kinds" != svg ]; then rsvg-convert --unlimited -d 200 -p 200 "$OUT/$name.svg" -o "$OUT/$name.png"; fi
		printf '  %-*s %s\n' $((${#OUT} + 38)) "$OUT/$name.$kinds" "$caption"
	done
}

mkdir -p "$OUT"
OUT=$(cd "$OUT" && pwd)
psql -qX -d "${PGDATABASE:-postgres}" -c "DROP DATABASE IF EXISTS $DATABASE" -c "CREATE DATABASE $DATABASE" 2>&1 |
	grep -v NOTICE || true
export PGDATABASE=$DATABASE PGOPTIONS="${PGOPTIONS:-} -c client_min_messages=warning"
sql -c "CREATE EXTENSION postgis" -c "CREATE EXTENSION typify"
load
sql -f demo/prepare.sql
say ""
sql -f demo/scales.sql
sql -f demo/pictures.sql
if [ -z "$DATA$OSM" ]; then sql -f demo/figures.sql; fi
say "" "Pictures, as SVG in true size and as PNG:"
list_pictures
say "" "The line that made them, in any database with your buildings:" \
	"  SELECT typify_svg(ST_Collect(geom), typify(geom, 75000, 0.5), 75000) FROM buildings;" \
	"One row for each placeholder, with the ids of its buildings:" \
	"  SELECT (unnest(typify_placeholders(geom, id, 75000, 0.5))).* FROM buildings;"
