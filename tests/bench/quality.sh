#!/bin/bash
# quality.sh - makes the layers that doc/quality.md compares and prints the page's tables, inside a server that may be
# thrown away (PG* variables; typify is installed there).
#
# TYPIFY_DATA  folder with north_bayreuth, liechtenstein_2024 and leipzig_2017; those that are missing are left out
# SETS         which data sets: of sample north_bayreuth liechtenstein leipzig
# SCALES       denominators
set -euo pipefail
cd "$(dirname "$0")/../.."
DATABASE=typify_quality_report

say() { printf '%s\n' "$*" >&2; }
sql() { psql -qXAt -v ON_ERROR_STOP=1 "$@"; }

# load_csv FILE TABLE
load_csv() {
	sql -c "CREATE TABLE $2 (id bigint PRIMARY KEY, class text, geom geometry NOT NULL)" \
		-c '\copy '"$2"' FROM PSTDIN WITH (FORMAT csv, HEADER true)' -c "ANALYZE $2" < <(gzip -dc "$1")
}

# load SET FOLDER: tables SET, SET_roads (what traffic uses) and SET_main (the roads that small scales show)
load() {
	load_csv "$TYPIFY_DATA/$2/buildings.csv.gz" "$1"
	load_csv "$TYPIFY_DATA/$2/roads.csv.gz" "$1_all"
	sql <<-SQL
		CREATE TABLE $1_roads AS SELECT * FROM $1_all
		WHERE class !~ 'path|way\$|track|steps|rail|transit|platform|construction|pedestrian' OR class = 'motorway';
		CREATE TABLE $1_main AS SELECT * FROM $1_all WHERE class ~ '^(motorway|trunk|primary|secondary)';
	SQL
}

make_sample() {
	sql -f tests/data/settlement.sql
	sql <<-SQL
		ALTER TABLE settlement_buildings RENAME TO sample;
		CREATE TABLE sample_roads AS SELECT * FROM settlement_roads WHERE class <> 'track';
		CREATE TABLE sample_main AS SELECT * FROM settlement_roads WHERE class = 'main';
	SQL
}

# make_data SET: false when its files are missing
make_data() {
	local folder=$1
	case $1 in
		sample) make_sample && return ;;
		liechtenstein) folder=liechtenstein_2024 ;;
		leipzig) folder=leipzig_2017 ;;
	esac
	if [ ! -r "$TYPIFY_DATA/$folder/roads.csv.gz" ]; then say "left out: $1, no $TYPIFY_DATA/$folder"; return 1; fi
	load "$1" "$folder"
}

compare_set() {
	local scale method
	for scale in $SCALES; do
		for method in plain legible 'legible, barriers' k-means; do
			say "$1 at 1:$scale, $method"
			sql -o /dev/null -c "SELECT compare('$1', '$method', $scale)"
		done
	done
}

title_of() {
	case $1 in
		sample) echo "The sample settlement" ;;
		north_bayreuth) echo "North of Bayreuth (c)" ;;
		liechtenstein) echo "Liechtenstein (c)" ;;
		leipzig) echo "Leipzig (c)" ;;
	esac
}

createdb "$DATABASE"
export PGDATABASE=$DATABASE PGOPTIONS='-c client_min_messages=error -c jit=off'
trap 'dropdb --if-exists "$DATABASE"' EXIT
sql -c 'CREATE EXTENSION typify CASCADE'
sql -f tests/bench/quality.sql
for set in $SETS; do
	if ! make_data "$set"; then continue; fi
	compare_set "$set"
	echo
	echo "## $(title_of "$set")"
	echo
	sql <<-SQL
		SELECT introduction('$set');
	SQL
	echo
	sql -c "SELECT report('$set')"
done
