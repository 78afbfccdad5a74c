#!/bin/bash
# tutorial.sh - the fear: who follows doc/two-levels.md meets a command that fails, or other numbers than the page
# prints. Runs its blocks in order and compares. Uses the server of the PG* variables.
# PICTURES: a folder that gets the page's picture. UPDATE: 1 writes what the commands print into the page.
. "$(dirname "$0")/common.sh"
. tests/server/page.sh

run_page doc/two-levels.md two_levels ogr2ogr rsvg-convert
check "panels of the picture" "$(grep -c '<rect .*fill="none" stroke="#888"' "$OWN_FOLDER/top/two-levels.svg")" 4
[ -z "${PICTURES:-}" ] || cp "$OWN_FOLDER/top/two-levels.png" "$PICTURES/"
exit $FAILED
