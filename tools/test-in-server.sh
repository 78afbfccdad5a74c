#!/bin/bash
# test-in-server.sh - the tests that need a server; test.sh runs it inside the throw-away one
. "$(dirname "$0")/common.sh"
. "$(dirname "$0")/tally.sh"

# pg_regress writes "test NAME ... ok" before PostgreSQL 16, then "ok 1 - NAME"
regress_results() {
	sed -nE -e 's/^test +([^ ]+) +\.\.\. ok.*/ok \1/p' -e 's/^test +([^ ]+) +\.\.\. FAILED.*/failed \1/p' \
		-e 's/^ok [0-9]+ +[-+] ([^ ]+) .*/ok \1/p' -e 's/^not ok [0-9]+ +[-+] ([^ ]+) .*/failed \1/p' "$1"
}

regress() {
	local log=$WORKSPACE/regress.log status=0 verdict name file expected=()
	for file in tests/sql/*.sql; do
		name=$(basename "$file" .sql)
		# pg_regress itself would end there, without the tests that follow
		if [ -f "expected/$name.out" ]; then
			expected+=("$name")
		else
			report failed "regress: $name" "there is no expected/$name.out"
		fi
	done
	if [ ${#expected[@]} = 0 ]; then return; fi
	bounded 900 make installcheck REGRESS="${expected[*]}" >"$log" 2>&1 </dev/null || status=$?
	regress_results "$log" >"$WORKSPACE/regress.results"
	while read -r verdict name; do report "$verdict" "regress: $name"; done <"$WORKSPACE/regress.results"
	if [ -s regression.diffs ]; then cat regression.diffs; fi
	if [ $status != 0 ] && ! grep -q ^failed "$WORKSPACE/regress.results"; then
		show "$log"
		report failed "regress" "exit status $status"
	fi
}

sample_demo() {
	DATA= OSM= OUT=$WORKSPACE/demo-output demo/run.sh
}

no_crash() {
	local log
	log=$(pg_lsclusters -h | awk -v port="$PGPORT" '$3 == port {print $NF}')
	! grep -E -B 5 'terminated by signal|PANIC:|TRAP:' "$log"
}

export -f sample_demo no_crash
regress
for script in tests/server/*.sh; do
	if [ -x "$script" ]; then single "server: $(basename "$script" .sh)" "$script"; fi
done
single "demo" bash -ec sample_demo
single "the server never crashed" bash -ec no_crash
