#!/bin/bash
# installcheck.sh - builds for one PostgreSQL (PGVERSION) without a warning and runs the regression tests in a
# throw-away server, with all its set-up
. "$(dirname "$0")/common.sh"

choose_version
make_workspace
need_packages $SERVER_PACKAGES
copy_tree
tools/check-warnings.sh gcc
build_and_stage || fail "the build failed"
"$PG_CONFIG" --version
# were it the command that failed, pg_virtualenv would print the server's log, which is full of expected errors
with_server 1800 bash -c 'make installcheck && touch passed || true'
if [ -s regression.diffs ]; then cat regression.diffs; fi
[ -f passed ]
