#!/bin/bash
# quality.sh - doc/quality.md with all its set-up: layers of typify and of PostGIS alone, judged by typify_quality. SETS
# and SCALES: which (default all), OUT: where the page goes besides the screen (by default doc/quality.md for all).
. "$(dirname "$0")/common.sh"

all_sets="sample north_bayreuth liechtenstein leipzig" all_scales="50000 75000 100000 200000"
export SETS=${SETS:-$all_sets} SCALES=${SCALES:-$all_scales}
for set in $SETS; do [[ " $all_sets " == *" $set "* ]] || fail "there is no data set $set; there are $all_sets"; done
for scale in $SCALES; do [[ $scale =~ ^[1-9][0-9]{4,}$ ]] || fail "a scale is a denominator, 25000 or more: $scale"; done
if [ "$SETS/$SCALES" = "$all_sets/$all_scales" ]; then OUT=${OUT:-$ROOT/doc/quality.md}; fi
if [ -n "${OUT:-}" ]; then OUT=$(realpath -m "$OUT"); fi

choose_version
make_workspace
need_packages $SERVER_PACKAGES
export TYPIFY_DATA=$(realpath -m "${TYPIFY_DATA:-$ROOT/../shared/data}")
copy_tree
build_and_stage || fail "the build failed"
export TABLES=$WORKSPACE/tables.md
with_server 7200 bash -c 'tests/bench/quality.sh >"$TABLES"'
{ cat tests/bench/quality.md && cat "$TABLES"; } >"$WORKSPACE/quality.md"
cat "$WORKSPACE/quality.md"
if [ -n "${OUT:-}" ]; then cp "$WORKSPACE/quality.md" "$OUT"; fi
