#!/bin/bash
# bench.sh [core] - the benchmark with all its set-up: of the extension in a throw-away server and of the core, or of the
# core alone. N: buildings a data set (default 1 000 000), RUNS: how often (default 5), SETS: which data sets in the
# server (default all), LARGE=1: 10 and 30 million too, OUT: where the report goes besides the screen (by default
# doc/benchmarks.md for all data sets of a million), RESULTS_OUT: where the plain values go.
. "$(dirname "$0")/common.sh"

what=${1:-all}
export N=${N:-1000000} RUNS=${RUNS:-5} LARGE=${LARGE:-}
all_sets="real towns uniform jittered_grid"
export SETS=${SETS:-$all_sets}
for set in $SETS; do [[ " $all_sets " == *" $set "* ]] || fail "there is no data set $set; there are $all_sets"; done
[[ $N =~ ^[1-9][0-9]{2,}$ && $RUNS =~ ^[1-9][0-9]*$ ]] || fail "N must be a number from 100 up, and RUNS from 1 up"
if [ "$what$SETS" = "all$all_sets" ] && [ -z "${OUT:-}" ] && [ "$N" = 1000000 ]; then OUT=$ROOT/doc/benchmarks.md; fi
if [ -n "${OUT:-}" ]; then OUT=$(realpath -m "$OUT"); fi
if [ -n "${RESULTS_OUT:-}" ]; then RESULTS_OUT=$(realpath -m "$RESULTS_OUT"); fi
repeat="make bench"
if [ "$what" = core ]; then repeat="make bench-core"; fi
if [ "$N" != 1000000 ]; then repeat+=" N=$N"; fi
if [ "$RUNS" != 5 ]; then repeat+=" RUNS=$RUNS"; fi
if [ "$SETS" != "$all_sets" ]; then repeat+=" SETS='$SETS'"; fi
if [ -n "$LARGE" ]; then repeat+=" LARGE=$LARGE"; fi

if [ "$what" = all ]; then choose_version; else SERVER_PACKAGES="gcc libc6-dev"; fi
make_workspace
need_packages $SERVER_PACKAGES $BENCH_PACKAGES
export TYPIFY_DATA=$(realpath -m "${TYPIFY_DATA:-$ROOT/../shared/data}")
export WORKSPACE RESULTS=$WORKSPACE/results PLAN=$WORKSPACE/plan CORE=$WORKSPACE/tree/tests/bench/build/core
: >"$RESULTS"
: >"$PLAN"
load=$(cut -d' ' -f1-3 /proc/loadavg)
version="$(sed -n "s/^default_version *= *'\(.*\)'.*/\1/p" "$ROOT/typify.control")"
if commit=$(git -C "$ROOT" describe --always --dirty 2>/dev/null); then version+=", commit $commit"; fi
copy_tree
make -s -C tests/bench

grouped() { sed -E ':again; s/([0-9])([0-9]{3})( |$)/\1 \2\3/; t again' <<<"$1"; }
result() { awk -F '\t' -v set="$1" -v figure="$2" '$1 == set && $2 == figure { print $3; exit }' "$RESULTS"; }
machine() {
	local model memory
	model=$(sed -n 's/^model name[^:]*: *//p' /proc/cpuinfo | head -n 1)
	memory=$(awk '/^MemTotal/ { printf "%.0f GB", $2 / 1048576 }' /proc/meminfo)
	echo "${model:-$(uname -m)}, $(nproc) cores, $memory"
}
head_of_report() {
	cat <<-END
		# Benchmarks

		Made by \`$repeat\`. Medians of $RUNS runs; what is compared takes turns, so that a busy minute hits all of it.

		| | |
		|---|---|
		| date | $(date -u +%Y-%m-%d) |
		| machine | $(machine) |
		| load before and after | $load; $(cut -d' ' -f1-3 /proc/loadavg) |
		| typify | $version |
		| compiler | $(gcc --version | head -n 1) |
	END
	if [ "$what" = all ]; then
		echo "| server | PostgreSQL $(result server PostgreSQL), PostGIS $(result server PostGIS), GEOS $(result server GEOS) |"
	else
		echo "| GEOS | $(result '*' 'GEOS version') |"
	fi
	if [ "$what" = core ]; then return; fi
	cat <<-END

		Data sets of $(grouped "$N") buildings: **uniform**; **jittered grid**, a square in every cell; **towns**, of 2 000 buildings
		on average, few large and many small, dense in the middle; all made by tests/bench/data.sql. **Real** is Leipzig
		from OpenStreetMap as of 2017 (ODbL 1.0, (c) OpenStreetMap contributors), laid out 3 x 3 where that is too few:
		the $(grouped "$N") buildings nearest to the middle. Every statement runs in a backend of its own with its libraries loaded,
		\`jit = off\` and, where nothing else is said, \`max_parallel_workers_per_gather = 0\`; all other settings are the
		server's defaults.
	END
}

if [ "$what" = all ]; then
	build_and_stage || fail "the build failed"
	with_server 86400 tests/bench/run.sh
else
	echo "core: $N points, $RUNS runs" >&2
	"$CORE" phases "$N" "$RUNS" all uniform towns "jittered grid" >>"$RESULTS"
fi
echo "core: shapes that are known to hurt" >&2
"$CORE" shapes 100000 "$RUNS" >>"$RESULTS"
echo "core: instructions" >&2
tests/bench/instructions.sh "$CORE" 100000 uniform towns "jittered grid" >>"$RESULTS"

if [ -n "${RESULTS_OUT:-}" ]; then cp "$RESULTS" "$RESULTS_OUT"; fi
{ head_of_report && awk -f tests/bench/report.awk -v plan="$PLAN" -v large="$LARGE" "$RESULTS"; } >"$WORKSPACE/report.md"
cat "$WORKSPACE/report.md"
if [ -n "${OUT:-}" ]; then cp "$WORKSPACE/report.md" "$OUT"; fi
