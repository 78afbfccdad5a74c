# statements.sh - what is timed in the server; to be sourced. NAME=query, where @ stands for the table; the settings
# of a statement, where it needs any, are in SETTINGS. Each returns one small row, so that nothing but the work counts.

ROUND=(count scan measure envelopes delaunay typify unmerged to_one placeholders cluster blocks districts)
OPTIONS=(typify s_u_0 s_u_1 counted to_one min_distance black_white median sum square footprint min_area keep_area
	placeholders importance alignment legible)
BARRIERS=(typify barriers barrier_gaps) # where there are roads
HIERARCHY=(typify hierarchy build_hierarchy write_hierarchy lookups)
WORKERS=(serial workers typify typify_workers)

declare -A STATEMENT=(
	[count]='SELECT count(*) FROM @'
	[scan]='SELECT sum(ST_MemSize(geom)) FROM @'
	[measure]='SELECT length(bench_measure(geom, 75000, 0.5)) FROM @'
	[envelopes]='SELECT count(ST_OrientedEnvelope(geom)) FROM @'
	[delaunay]='SELECT pg_column_size(ST_DelaunayTriangles(ST_Collect(ST_Centroid(geom)))) FROM @'
	[typify]='SELECT pg_column_size(typify(geom, 75000, 0.5)) FROM @'
	[unmerged]='SELECT pg_column_size(typify(geom, 25000, 0.5)) FROM @'
	[to_one]='SELECT pg_column_size(typify(geom, 75000, 0.5, typify_options(count => 1))) FROM @'
	[placeholders]='SELECT cardinality(typify_placeholders(geom, id, 75000, 0.5)) FROM @'
	[cluster]='SELECT max(number) FROM (SELECT typify_cluster(geom, 75000, 0.5) OVER () AS number FROM @) t'
	[blocks]='SELECT sum(pg_column_size(p)) FROM (SELECT typify(geom, 75000, 0.5) AS p FROM @ GROUP BY block) t'
	[districts]='SELECT sum(pg_column_size(p)) FROM (SELECT typify(geom, 75000, 0.5) AS p FROM @ GROUP BY district) t'
	[s_u_0]='SELECT pg_column_size(typify(geom, 75000, 0)) FROM @'
	[s_u_1]='SELECT pg_column_size(typify(geom, 75000, 1)) FROM @'
	[counted]='SELECT pg_column_size(typify(geom, 75000, 0.5, (SELECT typify_options(count => count(*) / 3) FROM @))) FROM @'
	[min_distance]='SELECT pg_column_size(typify(geom, 75000, 0.5, typify_options(min_distance => 20))) FROM @'
	[black_white]="SELECT pg_column_size(typify(geom, 75000, 0.5, typify_options(count_rule => 'black_white'))) FROM @"
	[median]="SELECT pg_column_size(typify(geom, 75000, 0.5, typify_options(area_statistic => 'median'))) FROM @"
	[sum]="SELECT pg_column_size(typify(geom, 75000, 0.5, typify_options(area_statistic => 'sum'))) FROM @"
	[hierarchy]='SELECT cardinality(typify_hierarchy(geom, id, 0.5)) FROM @'
	[build_hierarchy]="CALL typify_build_hierarchy('bench_tree', '@', 0.5)"
	[write_hierarchy]="SELECT bench_write_hierarchy('bench_tree')"
	[lookups]="SELECT bench_lookups('bench_tree', '@')"
	[legible]="SELECT pg_column_size(typify(geom, 75000, 0.5, typify_options(min_side => 0.35, min_gap => 0.2))) FROM @"
	[alignment]="SELECT pg_column_size(typify(geom, 75000, 0.5, typify_options(alignment => 4))) FROM @"
	[importance]='SELECT cardinality(typify_placeholders(geom, id, 75000, 0.5, NULL, 1.0 + id % 3)) FROM @'
	[keep_area]="SELECT pg_column_size(typify(geom, 75000, 0.5, typify_options(keep_area => 0.5))) FROM @"
	[min_area]="SELECT pg_column_size(typify(geom, 75000, 0.5, typify_options(min_area => 50))) FROM @"
	[footprint]="SELECT pg_column_size(typify(geom, 75000, 0.5, typify_options(shape => 'footprint'))) FROM @"
	[barriers]="SELECT pg_column_size(typify(geom, 75000, 0.5, (SELECT typify_options(barriers => ST_Collect(geom)) FROM @_roads))) FROM @"
	[barrier_gaps]="SELECT pg_column_size(typify(geom, 75000, 0.5, (SELECT typify_options(min_side => 0.35, min_gap => 0.2, barrier_width => 0.5, barriers => \
ST_Collect(geom)) FROM @_roads))) FROM @"
	[square]="SELECT pg_column_size(typify(geom, 75000, 0.5, typify_options(shape => 'square'))) FROM @"
)
STATEMENT[serial]=${STATEMENT[districts]/@/@_parts}
STATEMENT[workers]=${STATEMENT[serial]}
STATEMENT[typify_workers]=${STATEMENT[typify]}

# Partitions by group and as many workers as cores: the aggregate's last step runs in the workers. With the leader
# taking part there would be three processes for two cores.
TWO_WORKERS='SET max_parallel_workers_per_gather = 2; SET enable_partitionwise_aggregate = on;
	SET parallel_leader_participation = off;'
declare -A SETTINGS=(
	[blocks]="SET work_mem = '512MB';"
	[districts]="SET work_mem = '512MB';"
	[serial]="SET work_mem = '512MB';"
	[workers]="SET work_mem = '512MB'; $TWO_WORKERS"
	[typify_workers]='SET max_parallel_workers_per_gather = 2;'
	[build_hierarchy]='DROP TABLE IF EXISTS bench_tree, bench_tree_groups;'
)
declare -A WORDS=(
	[serial]='one process'
	[workers]='two workers'
	[typify_workers]='two workers'
	[write_hierarchy]='the rows of that table once more into another, with its indexes'
	[lookups]='200 boxes, 0.3 m wide on the map, at scales from 1:25 000 to 1:1 600 000'
)
