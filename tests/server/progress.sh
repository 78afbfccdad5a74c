#!/bin/bash
# progress.sh - the fear: a statement runs for minutes and nobody knows how far it is. Enough buildings for a second and
# more are typified with typify.progress on and off. Uses the server of the PG* variables.
. "$(dirname "$0")/common.sh"

fresh_database typify_progress
notices=$OWN_FOLDER/notices

# typified N ON_OFF EXPRESSION: seconds that it took; the notices are in $notices
typified() {
	local begin
	begin=$(date +%s%N)
	psql -qXAt -v ON_ERROR_STOP=1 -o /dev/null -c "SET typify.progress = $2" -c 'SET client_min_messages = notice' \
		-c "SELECT $3 FROM (SELECT ST_MakeEnvelope(x, y, x + 8, y + 6, 2056) AS geom, i AS id FROM (
			SELECT i, i::bigint * 7919 % 100003 * 3 AS x, i::bigint * 104729 % 100019 * 3 AS y
			FROM generate_series(1, $1) AS i) AS place OFFSET 0) AS building" 2>"$notices"
	awk -v begin="$begin" -v end="$(date +%s%N)" 'BEGIN {printf "%.0f\n", (end - begin) / 1e9}'
}

# a machine may be fast: as many buildings as keep it busy
n=400000
while [ "$(typified $n on 'typify(geom, 75000, 0.5)')" -lt 4 ] && [ $n -lt 6400000 ]; do n=$((n * 2)); done
echo "with $n buildings:"
cat "$notices"
check "all notices are words of progress" "$(grep -vcE '^NOTICE:  typifying a group of '$n' buildings: (ordering|building the mesh|collapsing|drawing), [0-9]+ % done$' "$notices" || true)" 0
grep -oE '[0-9]+ %' "$notices" | grep -oE '[0-9]+' >"$OWN_FOLDER/shares"
check "shares ascend" "$(sort -nu "$OWN_FOLDER/shares" | cmp -s - "$OWN_FOLDER/shares" && echo yes)" yes
check "there is more than one" "$([ "$(wc -l <"$OWN_FOLDER/shares")" -gt 1 ] && echo yes)" yes
check "at most ten" "$([ "$(wc -l <"$OWN_FOLDER/shares")" -le 10 ] && echo yes)" yes
typified "$n" on 'typify_cluster(geom, 75000, 0.5) OVER ()' >/dev/null
check "the window form shows it too" "$(grep -qE 'collapsing, [0-9]+ % done' "$notices" && echo yes)" yes
typified "$n" off 'typify(geom, 75000, 0.5)' >/dev/null
check "off: nothing is said" "$(wc -l <"$notices")" 0
typified 1000 on 'typify(geom, 75000, 0.5)' >/dev/null
check "small groups: nothing is said" "$(wc -l <"$notices")" 0
exit $FAILED
