#!/bin/bash
# demo.sh - the demo with all its set-up. DATA, ROADS, OSM: the user's own buildings and lines, OUT: folder for the
# pictures; more in demo/run.sh.
. "$(dirname "$0")/common.sh"

cd "$ROOT"
DATA=${DATA:-} ROADS=${ROADS:-} OSM=${OSM:-} OUT=$(realpath -m "${OUT:-demo-output}")
if [ -n "${DATA}" ] && [ -n "${OSM}" ]; then fail "give DATA or OSM, not both"; fi
for file in "${DATA}" "${ROADS}" "${OSM}"; do
	if [ -n "$file" ] && [ ! -f "$file" ]; then fail "there is no file $file"; fi
done
choose_version
make_workspace
need_packages $SERVER_PACKAGES $PICTURE_PACKAGES ${OSM:+osm2pgsql}
if [ -n "${DATA}" ]; then DATA=$(readable_copy "$DATA"); fi
if [ -n "${ROADS}" ]; then ROADS=$(readable_copy "$ROADS"); fi
if [ -n "${OSM}" ]; then OSM=$(readable_copy "$OSM"); fi
mkdir -p "$OUT"
export DATA ROADS OSM OUT
copy_tree
build_and_stage || fail "the build failed"
with_server 86400 demo/run.sh
