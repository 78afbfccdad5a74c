#!/bin/bash
# test.sh - every test with all its set-up. Goes on after a failure; the last line counts. QGIS=1 installs QGIS as
# well (600 MB), so that layers are opened in it; where it is installed they are anyway.
. "$(dirname "$0")/common.sh"
. "$(dirname "$0")/tally.sh"

choose_version
make_workspace
need_packages $SERVER_PACKAGES $PICTURE_PACKAGES $TEST_PACKAGES $(node_packages) $(browser_packages) ${QGIS:+$QGIS_PACKAGES}
export TYPIFY_DATA=$(realpath -m "${TYPIFY_DATA:-$ROOT/../shared/data}")
export WORKSPACE TALLY=$WORKSPACE/tally
: >"$TALLY"
copy_tree

single "core knows no PostgreSQL" tools/check-core.sh
single "versions agree" tools/check-versions.sh
single "gcc has no warning" tools/check-warnings.sh gcc
single "clang has no warning" tools/check-warnings.sh clang
suite "core" make -s -C tests/unit check
suite "core under sanitizers" make -s -C tests/unit asan
single "same answer from every compiler and optimization" tests/determinism.sh
single "centroid linkage equals SciPy's" tests/scipy.sh
single "fuzz targets build and run" make -C tests/fuzz check

if build_and_stage; then
	with_server 3600 tools/test-in-server.sh || report failed "throw-away server" "exit status $?"
	if [ -s regression.diffs ]; then cp -r regression.diffs results "$ROOT/"; fi
else
	report failed "build for PostgreSQL $VERSION"
fi
close_tally
