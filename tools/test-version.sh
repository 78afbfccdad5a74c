#!/bin/bash
# test-version.sh - what can differ from one PostgreSQL (PGVERSION) to the next, with its set-up: builds without a
# warning, and runs the tests that need a server in a throw-away one. The core, the compilers and the browser are
# make test's. The last line counts.
. "$(dirname "$0")/common.sh"
. "$(dirname "$0")/tally.sh"

choose_version
make_workspace
need_packages $SERVER_PACKAGES $PICTURE_PACKAGES gdal-bin
export TYPIFY_DATA=$(realpath -m "${TYPIFY_DATA:-$ROOT/../shared/data}")
export WORKSPACE TALLY=$WORKSPACE/tally
: >"$TALLY"
copy_tree

"$PG_CONFIG" --version
gcc --version | head -n 1
single "gcc has no warning" tools/check-warnings.sh gcc
if build_and_stage; then
	with_server 3600 tools/test-in-server.sh || report failed "throw-away server" "exit status $?"
else
	report failed "build for PostgreSQL $VERSION"
fi
close_tally
