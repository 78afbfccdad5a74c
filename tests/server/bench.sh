#!/bin/bash
# bench.sh - the fear: the benchmark rots between two times that somebody runs it. A tiny run of it; no time counts.
# Uses the server of the PG* variables.
. "$(dirname "$0")/common.sh"

cd tests/bench
folder=$OWN_FOLDER
OWN_DATABASES+=(typify_bench)

make -s
export N=1000 RUNS=2 TILES=20 SETS=towns LARGE= TYPIFY_DATA=none RESULTS=$folder/results PLAN=$folder/plan CORE=$PWD/build/core
: >"$RESULTS"
./run.sh
"$CORE" shapes 1000 1 >>"$RESULTS"
awk -f report.awk -v plan="$PLAN" "$RESULTS" | tee "$folder/report"

. ./statements.sh
for statement in "${!STATEMENT[@]}"; do
	for figure in "$statement" "$statement kB"; do
		values=$(awk -F '\t' -v figure="$figure" '$1 == "towns" && $2 == figure && $3 > 0' "$RESULTS" | wc -l)
		if [ "$values" -lt 2 ]; then echo "failed: $figure was measured $values times"; FAILED=1; fi
	done
done
# a cell without a number is one whose figure nobody wrote
grep -nE '\| *(nan|-nan|inf|0 ns) |^\|  \|' "$folder/report" && FAILED=1
[ "$(grep -c '^## ' "$folder/report")" = 9 ] || { echo "failed: sections are missing"; FAILED=1; }
exit $FAILED
