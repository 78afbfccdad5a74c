#!/bin/bash
# web.sh - the web map with all its set-up, until interrupted: a throw-away server with a landscape of towns, a hierarchy of
# it for each density control, and a small web server. PORT: where it answers (default: any free port). DATA, ROADS: the
# user's own buildings (columns id, class, geom as hex WKB with SRID, as for make demo) and lines.
. "$(dirname "$0")/common.sh"

cd "$ROOT"
DATA=${DATA:-} ROADS=${ROADS:-}
for file in "$DATA" "$ROADS"; do
	if [ -n "$file" ] && [ ! -f "$file" ]; then fail "there is no file $file"; fi
done
choose_version
make_workspace
need_packages $SERVER_PACKAGES $(node_packages)
if [ -n "$DATA" ]; then DATA=$(readable_copy "$DATA"); fi
if [ -n "$ROADS" ]; then ROADS=$(readable_copy "$ROADS"); fi
export DATA ROADS PORT=${PORT:-0}
copy_tree
export npm_config_cache=$WORKSPACE/npm
(cd tests/web && bounded 600 npm ci --omit=dev >"$WORKSPACE/npm.log" 2>&1) || {
	tail -n 5 "$WORKSPACE/npm.log" >&2
	fail "npm could not fetch the packages of tests/web"
}
build_and_stage || fail "the build failed"
with_server 864000 tests/web/run.sh
