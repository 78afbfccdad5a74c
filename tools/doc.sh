#!/bin/bash
# doc.sh - redraws the pictures of README and doc/, and writes anew what the commands of its tutorials print and the
# figures of doc/legibility.md. To be read before it is committed: the tests hold the pages against what is printed, not
# against what is right. Pictures of real data stay as they are where TYPIFY_DATA has none.
. "$(dirname "$0")/common.sh"

choose_version
make_workspace
need_packages $SERVER_PACKAGES $PICTURE_PACKAGES gdal-bin $(node_packages) $(browser_packages)
export TYPIFY_DATA=$(realpath -m "${TYPIFY_DATA:-$ROOT/../shared/data}")
copy_tree
build_and_stage || fail "the build failed"
draw() {
	OUT=$WORKSPACE/demo-output demo/run.sh >/dev/null
	UPDATE=1 PICTURES=$WORKSPACE tests/server/tutorial.sh
	UPDATE=1 tests/server/hierarchy_page.sh
	SCREENSHOTS=$WORKSPACE tests/server/web.sh
	UPDATE=1 PICTURES=$WORKSPACE tests/server/legibility.sh
}
export -f draw
export WORKSPACE DATA= OSM=
with_server 1200 bash -ec draw
cp doc/two-levels.md doc/legibility.md doc/hierarchy.md "$ROOT/doc/"
cp "$WORKSPACE/members.png" "$ROOT/doc/pictures/web-map.png"
cp "$WORKSPACE/two-levels.png" "$WORKSPACE"/legibility-*.png "$WORKSPACE/demo-output/settlement.png" "$ROOT/doc/pictures/"
