#!/bin/bash
# run.sh - the benchmark inside a server that may be thrown away (PG* variables; typify is installed there).
#
# N            buildings of a data set        RUNS   runs of everything; they take turns
# LARGE        not empty: 10 and 30 million buildings too
# SETS         which data sets: of real towns uniform jittered_grid
# TYPIFY_DATA  folder with leipzig_2017; where it is missing the real data set is left out
# RESULTS      file for "set <tab> figure <tab> value", a line a run: seconds that passed, "... cpu" on the processor, or
#              "... kB" at the peak
# TILES        how many tiles of a hierarchy (1000)
# CORE         the core's benchmark (tests/bench/build/core)
# PLAN         file for the plan of the two workers

set -euo pipefail
cd "$(dirname "$0")"
. ./statements.sh
. ./large.sh
. ./tiles.sh
DATABASE=typify_bench
SPARE=$(mktemp -d)
trap 'rm -rf "$SPARE"' EXIT

say() { printf '%s\n' "$*" >&2; }
sql() { psql -qXAt -v ON_ERROR_STOP=1 "$@"; }
note() { printf '%s\t%s\t%s\n' "$@" >>"$RESULTS"; } # note SET FIGURE VALUE

# --- data ---

# finish_table TABLE: blocks and districts by place, the rows in the order that they had
finish_table() {
	sql <<-SQL
		CREATE TABLE $1 AS
		SELECT id, geom, (place - 1) / 10 AS block, (place - 1) / 1000 AS district
		FROM (SELECT id, geom, row_number() OVER (ORDER BY geom, id) AS place FROM $1_raw) t ORDER BY id;
		DROP TABLE $1_raw;
		VACUUM (ANALYZE) $1;
	SQL
}

# make_data SET N: table bench_SET
make_data() {
	sql -c "CREATE TABLE bench_$1_raw AS SELECT * FROM bench_$1($2)"
	finish_table "bench_$1"
}

# Leipzig as it is, or laid out 3 x 3 where that is too few; of it the N buildings nearest to the middle, and all roads.
make_real() { # make_real BUILDINGS ROADS
	local columns='id bigint, class text, geom geometry' copies=2
	if [ "$N" -le 122526 ]; then copies=0; fi
	sql -c "CREATE TABLE leipzig ($columns)" \
		-c '\copy leipzig FROM PSTDIN WITH (FORMAT csv, HEADER true)' < <(gzip -dc "$1")
	sql -c "CREATE TABLE leipzig_roads ($columns)" \
		-c '\copy leipzig_roads FROM PSTDIN WITH (FORMAT csv, HEADER true)' < <(gzip -dc "$2")
	sql <<-SQL
		CREATE TABLE bench_real_roads AS
		SELECT ST_Translate(geom, i * 34000, j * 31000) AS geom
		FROM leipzig_roads, generate_series(0, $copies) AS i, generate_series(0, $copies) AS j;
		CREATE TABLE copies AS
		SELECT row_number() OVER () AS id, ST_Translate(geom, i * 34000, j * 31000) AS geom
		FROM leipzig, generate_series(0, $copies) AS i, generate_series(0, $copies) AS j;
		CREATE TABLE bench_real_raw AS
		SELECT id, geom FROM copies
		ORDER BY geom <-> (SELECT ST_SetSRID(ST_Centroid(ST_Extent(geom)::geometry), 25833) FROM copies), id LIMIT $N;
		DROP TABLE copies, leipzig, leipzig_roads;
	SQL
	finish_table bench_real
}

make_parts() { # make_parts SET
	sql <<-SQL
		CREATE TABLE bench_$1_parts (LIKE bench_$1) PARTITION BY HASH (district);
		SELECT format('CREATE TABLE bench_$1_part%s PARTITION OF bench_$1_parts
			FOR VALUES WITH (MODULUS 8, REMAINDER %s)', k, k) FROM generate_series(0, 7) AS k \gexec
		INSERT INTO bench_$1_parts SELECT * FROM bench_$1;
		VACUUM (ANALYZE) bench_$1_parts;
	SQL
}

# --- measuring ---

query_of() { echo "${STATEMENT[$2]//@/bench_$1}"; } # query_of SET STATEMENT

# nanoseconds that this process has been on a processor
CPU="SELECT 'cpu ' || split_part(pg_read_file('/proc/self/schedstat'), ' ', 1);"

# one_run SET STATEMENT: in a backend of its own, whose libraries are loaded by then
one_run() {
	local answer
	answer=$(sql <<-SQL
		SET jit = off; SET max_parallel_workers_per_gather = 0; ${SETTINGS[$2]:-}
		SELECT typify(geom, 75000), typify_placeholders(geom, 1, 75000), ST_OrientedEnvelope(geom),
			ST_DelaunayTriangles(geom) FROM (SELECT ST_MakeEnvelope(0, 0, 1, 1) AS geom) t GROUP BY geom \g /dev/null
		$CPU
		\timing on
		$(query_of "$1" "$2") \g /dev/null
		\timing off
		$CPU
		SELECT 'peak ' || substring(pg_read_file('/proc/self/status') FROM 'VmHWM:\s+(\d+) kB');
	SQL
	)
	awk -v set="$1" -v figure="$2" -v OFS='\t' '
		$1 == "cpu" && before != "" { print set, figure " cpu", ($2 - before) / 1e9 }
		$1 == "cpu" { before = $2 }
		$1 == "Time:" { print set, figure, $2 / 1000 }
		$1 == "peak" { print set, figure " kB", $2 }' <<<"$answer" >>"$RESULTS"
}

# all_runs SET STATEMENT...: the statements take turns
all_runs() {
	local set=$1 run statement
	shift
	for ((run = 1; run <= RUNS; run++)); do
		say "$set: run $run of $RUNS, $# statements"
		for statement in "$@"; do one_run "$set" "$statement"; done
	done
}

# the core on the very centroids
core_runs() {
	local file=$SPARE/$1.points
	sql -c "\\copy (SELECT ST_X(c), ST_Y(c), ST_Area(geom) FROM (SELECT geom, ST_Centroid(geom) AS c FROM bench_$1) t)
		TO '$file'"
	say "$1: core, $RUNS runs"
	"$CORE" phases 0 "$RUNS" all "$1=$file" >>"$RESULTS"
	rm "$file"
}

show_plan() { # show_plan SET STATEMENT
	sql -c "SET jit = off; SET max_parallel_workers_per_gather = 0; ${SETTINGS[$2]}" \
		-c "EXPLAIN (COSTS off) $(query_of "$1" "$2")" >"$PLAN"
}

# measure SET: everything that every data set is measured by
measure() {
	note "$1" buildings "$(sql -c "SELECT count(*) FROM bench_$1")"
	all_runs "$1" "${ROUND[@]}"
	core_runs "$1"
}

# --- the whole ---

createdb $DATABASE
export PGDATABASE=$DATABASE PGOPTIONS='-c client_min_messages=warning'
sql -c 'CREATE EXTENSION typify CASCADE' -f data.sql
say "PostGIS $(sql -c 'SELECT postgis_lib_version()'), $N buildings, $RUNS runs"
note server PostgreSQL "$(sql -c 'SHOW server_version')"
note server PostGIS "$(sql -c 'SELECT postgis_lib_version()')"
note server GEOS "$(sql -c 'SELECT postgis_geos_version()')"

for set in $SETS; do
	case $set in
		uniform | jittered_grid | towns) make_data $set "$N" ;;
		real)
			real=$TYPIFY_DATA/leipzig_2017
			if [ ! -r "$real/buildings.csv.gz" ] || [ ! -r "$real/roads.csv.gz" ]; then
				say "skipped: no $real (TYPIFY_DATA), so nothing is measured on real buildings"
				continue
			fi
			make_real "$real/buildings.csv.gz" "$real/roads.csv.gz"
			;;
	esac
	measure $set
	# by group, and with options: only on those that are like towns
	case $set in
		towns | real)
			make_parts $set
			all_runs $set "${WORKERS[@]}"
			show_plan $set workers
			all_runs $set "${OPTIONS[@]}"
			if [ $set = real ]; then all_runs real "${BARRIERS[@]}"; fi
			all_runs $set "${HIERARCHY[@]}"
			tile_runs $set
			;;
	esac
	sql -c "DROP TABLE IF EXISTS bench_$set, bench_${set}_parts, bench_tree, bench_tree_groups, bench_${set}_roads"
done
for statement in "${!STATEMENT[@]}"; do
	note query "$statement" "\`${STATEMENT[$statement]//@/b}\`${WORDS[$statement]:+, ${WORDS[$statement]}}"
done
if [ -n "$LARGE" ]; then large_runs; fi
