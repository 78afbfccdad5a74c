#!/bin/bash
# instructions.sh CORE N SET... - the core's instructions by step, counted by callgrind: prints "set <tab> instructions
# STEP <tab> count". Nothing where valgrind is missing.
set -euo pipefail
core=$1 n=$2
shift 2
command -v valgrind >/dev/null || exit 0
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

for set in "$@"; do
	valgrind -q --tool=callgrind --callgrind-out-file="$folder/out" "$core" instructions "$n" "$set" >/dev/null
	# a file a dump, each with the word that the program gave it; the last one is what comes after
	for dump in "$folder"/out.*; do
		awk -v set="$set" -v OFS='\t' '
			/^desc: Trigger: Client Request: / { step = $NF }
			/^totals: / && step != "" { print set, "instructions " step, $2 }' "$dump"
	done
	rm -f "$folder"/out*
done
printf 'instructions\tn\t%s\n' "$n"
