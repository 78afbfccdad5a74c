#!/bin/sh
# run.sh DIRECTORY FILTER PROGRAM... - runs the test programs of a directory and counts what they say.
# A program that dies counts as one failed test.
directory=$1 filter=$2
shift 2
for program in "$@"; do
	echo "# $program"
	"$directory/$program" "$filter" 2>&1
	status=$?
	[ $status -eq 0 ] || [ $status -eq 10 ] || echo "failed $program: it died with exit status $status"
done | awk '
	{ print; fflush() }
	/^ok / { passed++ }
	/^failed / { failed++ }
	END { printf "%d passed, %d failed\n", passed, failed; exit failed > 0 || passed == 0 }'
