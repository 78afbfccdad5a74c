#!/bin/bash
# fuzz.sh - both fuzz targets with all their set-up, SECONDS_EACH seconds each. Inputs that broke something are
# kept in tests/fuzz.
. "$(dirname "$0")/common.sh"

make_workspace
need_packages $FUZZ_PACKAGES
copy_tree
status=0
bounded 86400 make -C tests/fuzz fuzz "SECONDS=${SECONDS_EACH:-60}" || status=$?
find tests/fuzz \( -name 'crash-*' -o -name 'leak-*' -o -name 'timeout-*' -o -name 'oom-*' \) \
	-exec cp -v {} "$ROOT/tests/fuzz/" \;
exit $status
