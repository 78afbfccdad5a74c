#!/bin/bash
# hierarchy_page.sh - the fear: who follows doc/hierarchy.md meets a command that fails, or other numbers than the page
# prints. Runs its blocks in order and compares. Uses the server of the PG* variables; UPDATE: 1 writes what the commands
# print into the page.
. "$(dirname "$0")/common.sh"
. tests/server/page.sh

run_page doc/hierarchy.md any_scale
exit $FAILED
