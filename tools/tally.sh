# tally.sh - how tests are run, named and counted; to be sourced. TALLY names the file that counts them:
# one word a test, so that scripts on both sides of a server count together.

report() { # report ok|failed|skipped NAME [WORD]
	echo "$1" >>"$TALLY"
	printf '%-8s%s\n' "$1" "$2${3:+ ($3)}"
}

# single NAME COMMAND...: one test; exit status 77 skips it, the last line saying why; a failure shows its output
single() {
	local name=$1 log=$WORKSPACE/single.log status=0
	shift
	bounded 600 "$@" >"$log" 2>&1 </dev/null || status=$?
	case $status in
		0) report ok "$name" ;;
		77) report skipped "$name" "$(tail -n 1 "$log" | sed 's/^skipped:* *//')" ;;
		124 | 137) show "$log"; report failed "$name" "stopped after 600 s" ;;
		*) show "$log"; report failed "$name" ;;
	esac
}

show() { tail -n 200 "$1" | sed 's/^/    /'; }

# suite NAME COMMAND...: prints a line a test and closes with "N passed, N failed[, N skipped]", which is added up
suite() {
	local name=$1 log=$WORKSPACE/suite.log status=0 summary
	shift
	echo "$name:"
	bounded 600 "$@" >"$log" 2>&1 </dev/null || status=$?
	summary=$(grep -E "$SUMMARY" "$log" | tail -n 1) || true
	grep -vE "$SUMMARY" "$log" | sed 's/^/  /' || true
	add "$(word_count passed "$summary")" ok
	add "$(word_count failed "$summary")" failed
	add "$(word_count skipped "$summary")" skipped
	if [ -z "$summary" ]; then
		report failed "$name" "came to no end, exit status $status"
	elif [ $status != 0 ] && [ "$(word_count failed "$summary")" = 0 ]; then
		report failed "$name" "exit status $status"
	fi
}

SUMMARY='^[0-9]+ passed, [0-9]+ failed(, [0-9]+ skipped)?$'
word_count() { sed -n "s/.*\b\([0-9]\+\) $1.*/\1/p" <<<"$2" | grep . || echo 0; }
add() { for ((i = 0; i < $1; i++)); do echo "$2"; done >>"$TALLY"; }
counted() { grep -c "^$1\$" "$TALLY" || true; }

# Prints how many were skipped and, alone on the last line, the count; fails when a test did or when there was none.
close_tally() {
	local passed failed skipped
	passed=$(counted ok) failed=$(counted failed) skipped=$(counted skipped)
	if [ "$skipped" != 0 ]; then echo "$skipped skipped, each for the reason above"; fi
	echo "$passed passed, $failed failed"
	[ "$failed" = 0 ] && [ "$passed" != 0 ]
}
