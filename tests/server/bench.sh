#!/bin/bash
# bench.sh - the fear: the benchmark rots between two times that somebody runs it. A tiny run of it; no time counts.
# Uses the server of the PG* variables.
. "$(dirname "$0")/common.sh"

# the sample in the place of the real buildings and roads
folder=$OWN_FOLDER
fresh_database typify_bench_sample tests/data/settlement.sql
mkdir "$folder/leipzig_2017"
for layer in buildings roads; do
	sql -c "\copy (SELECT id, class, ST_SetSRID(geom, 25833) AS geom FROM settlement_$layer) TO PSTDOUT (FORMAT csv, HEADER)" |
		gzip >"$folder/leipzig_2017/$layer.csv.gz"
done

cd tests/bench
OWN_DATABASES+=(typify_bench)

make -s
export N=1000 RUNS=2 TILES=20 SETS="towns real" LARGE= TYPIFY_DATA=$folder RESULTS=$folder/results PLAN=$folder/plan CORE=$PWD/build/core
: >"$RESULTS"
./run.sh
"$CORE" shapes 1000 1 >>"$RESULTS"
awk -f report.awk -v plan="$PLAN" "$RESULTS" | tee "$folder/report"

. ./statements.sh
for statement in "${!STATEMENT[@]}"; do
	for figure in "$statement" "$statement kB"; do
		values=$(awk -F '\t' -v figure="$figure" '$1 == "real" && $2 == figure && $3 > 0' "$RESULTS" | wc -l)
		if [ "$values" -lt 2 ]; then echo "failed: $figure was measured $values times"; FAILED=1; fi
	done
done
# a cell without a number is one whose figure nobody wrote
grep -nE '\| *(nan|-nan|inf|0 ns) |^\|  \|' "$folder/report" && FAILED=1
[ "$(grep -c '^## ' "$folder/report")" = 9 ] || { echo "failed: sections are missing"; FAILED=1; }
exit $FAILED
