#!/bin/bash
# barriers.sh - the fear: on real roads a member is carried across, or barriers cost too much. Liechtenstein and Leipzig
# with their main roads, and with all their roads; the server of the PG* variables and the data in TYPIFY_DATA, by
# default ../shared/data beside the project. Times are printed, not judged. Exit status 77: skipped.
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"
data=${TYPIFY_DATA:-../shared/data}
for set in liechtenstein_2024 leipzig_2017; do
	for layer in buildings roads; do
		[ -r "$data/$set/$layer.csv.gz" ] || { echo "skipped: no $data/$set/$layer.csv.gz (TYPIFY_DATA)"; exit 77; }
	done
done
fresh_database typify_barriers

load() { # load SET: tables buildings, roads and cells, the faces between its main roads within a frame
	local layer
	sql -c 'DROP TABLE IF EXISTS buildings, roads, main_roads, cells'
	for layer in buildings roads; do
		sql -c "CREATE TABLE $layer (id bigint PRIMARY KEY, class text, geom geometry NOT NULL)"
		gzip -dc "$data/$1/$layer.csv.gz" | sql -c "COPY $layer FROM STDIN WITH (FORMAT csv, HEADER true)"
	done
	sql -c "CREATE TABLE main_roads AS SELECT geom FROM roads WHERE class ~ '^(motorway|trunk|primary|secondary|tertiary)(_link)?\$'" \
		-c "CREATE TABLE cells AS SELECT row_number() OVER () AS cell, (d).geom FROM (SELECT ST_Dump(ST_Polygonize(geom)) AS d
			FROM (SELECT ST_Node(ST_Collect(geom)) AS geom FROM (SELECT ST_SetSRID(geom, 0) AS geom FROM main_roads
				UNION ALL SELECT ST_SetSRID(ST_Boundary(ST_Expand(ST_Extent(geom)::geometry, 20000)), 0) FROM main_roads) AS r)
				AS noded) AS faces" \
		-c 'CREATE INDEX ON cells USING gist (geom)' -c 'ANALYZE'
}

seconds() { # seconds STATEMENT: how long it takes
	local start=$EPOCHREALTIME
	sql -o /dev/null -c "$1"
	awk -v from="$start" -v to="$EPOCHREALTIME" 'BEGIN { printf "%.2f", to - from }'
}

for set in liechtenstein_2024 leipzig_2017; do
	load $set
	for scale in 50000 100000; do
		plain=$(seconds "SELECT typify(geom, $scale, 0.5) FROM buildings")
		main=$(seconds "SELECT typify(geom, $scale, 0.5, (SELECT typify_options(barriers => ST_Collect(geom)) FROM main_roads)) FROM buildings")
		all=$(seconds "SELECT typify(geom, $scale, 0.5, (SELECT typify_options(barriers => ST_Collect(geom)) FROM roads)) FROM buildings")
		sql -c 'DROP TABLE IF EXISTS placeholders' -c "CREATE TABLE placeholders AS
			SELECT p.* FROM (SELECT typify_placeholders(geom, id, $scale, 0.5, (SELECT typify_options(barriers => ST_Collect(geom)) FROM main_roads)) AS list
				FROM buildings) AS t, unnest(list) AS p"
		echo "$set 1:$scale: plain $plain s, main roads $main s, all roads $all s;" \
			"$(answer "SELECT format('%s placeholders of %s asked for', count(*), typify_count(sum(member_count)::bigint, $scale)) FROM placeholders")"
		check "$set 1:$scale: buildings that are members" "$(answer 'SELECT sum(member_count) FROM placeholders')" \
			"$(answer 'SELECT count(*) FROM buildings')"
		check "$set 1:$scale: members in another cell than their placeholder" "$(answer "
			WITH placed AS (SELECT members, ST_SetSRID(ST_Centroid(geom), 0) AS centre FROM placeholders),
			member AS (SELECT unnest(members) AS id, centre FROM placed)
			SELECT count(*) FROM member JOIN buildings AS b USING (id)
			JOIN cells ON ST_Intersects(cells.geom, ST_SetSRID(typify_centre(b.geom)::geometry, 0))
			WHERE NOT ST_Intersects(cells.geom, centre)")" 0
	done
done
exit $FAILED
