# large.sh - what takes long and much memory: 10 and 30 million buildings in one group; to be sourced by run.sh

# A group of 30 million in the memory of one backend, of buildings made on the way.
thirty_million() {
	sql <<-SQL
		SET jit = off; SET max_parallel_workers_per_gather = 0;
		\timing on
		SELECT 'placeholders ' || pg_column_size(typify(bench_building(i, 219089 * bench_unit(i, 4),
			219089 * bench_unit(i, 5)), 100000, 0.5)) / 96 FROM (SELECT generate_series(1, 30000000) AS i) t;
		\timing off
		SELECT 'peak ' || substring(pg_read_file('/proc/self/status') FROM 'VmHWM:\s+(\d+) kB');
	SQL
}

# A table of one page is one worker's, however many there are: that one gathers 20 million points of a group and has
# to hand them on, more than a value can hold.
refused() {
	sql 2>&1 <<-SQL || true
		CREATE TABLE bench_seed WITH (parallel_workers = 2) AS SELECT generate_series(1, 20) AS k;
		ANALYZE bench_seed;
		SET jit = off; SET parallel_setup_cost = 0; SET parallel_tuple_cost = 0; SET min_parallel_table_scan_size = 0;
		SET max_parallel_workers_per_gather = 2; SET parallel_leader_participation = off;
		SELECT pg_column_size(typify(ST_Point(k, i), 75000))
		FROM bench_seed, generate_series(1, 1000000) AS i;
	SQL
}

large_runs() {
	local n set answer runs=3
	for n in 100000 10000000; do
		say "core: $n points"
		"$CORE" phases $n $runs brief uniform towns | sed "s/^\(uniform\|towns\)\t/\1 of $n\t/" >>"$RESULTS"
		for set in uniform towns; do
			sql -c "CREATE TABLE bench_${set}_of_$n AS SELECT * FROM bench_$set($n)" \
				-c "VACUUM (ANALYZE) bench_${set}_of_$n"
			RUNS=$runs all_runs ${set}_of_$n count typify
			sql -c "DROP TABLE bench_${set}_of_$n"
		done
		runs=1
	done
	say "30 million buildings in one group"
	answer=$(thirty_million)
	note large "30 million seconds" "$(awk '$1 == "Time:" { print $2 / 1000 }' <<<"$answer")"
	note large "30 million kB" "$(awk '$1 == "peak" { print $2 }' <<<"$answer")"
	note large "30 million placeholders" "$(awk '$1 == "placeholders" { print $2 }' <<<"$answer")"
	say "20 million buildings in one group of a parallel plan"
	refused | sed -n 's/^\(ERROR\|HINT\|psql.*ERROR\): */\1: /p' | while read -r line; do note large refused "$line"; done
}
