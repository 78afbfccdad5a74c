#!/bin/bash
# leipzig.sh - the fear: blocks, parts and links of a whole city take minutes, or lose a building. Uses the server of
# the PG* variables and real data. Times are printed, not judged.
. "$(dirname "$0")/common.sh"

need_real leipzig_2017 buildings roads
fresh_database typify_leipzig
load_real buildings roads

timed() { # timed WHAT STATEMENT
	local start=$EPOCHREALTIME
	sql -c "$2"
	awk -v what="$1" -v from="$start" -v to="$EPOCHREALTIME" 'BEGIN { printf "%s: %.1f s\n", what, to - from }'
}

timed "block ids for all buildings" "ALTER TABLE buildings ADD COLUMN block bigint;
	UPDATE buildings SET block = a.block FROM typify_assign_blocks('buildings', 'roads') AS a WHERE a.id = buildings.id"
timed "the blocks themselves" "CREATE TABLE blocks AS SELECT number, b.geom
	FROM (SELECT ST_Collect(geom) AS lines FROM roads) r, typify_blocks(lines) WITH ORDINALITY AS b (geom, number);
	CREATE INDEX ON blocks USING gist (geom); ANALYZE blocks"
holds "every building has a block" "SELECT count(*) = 122526 AND count(block) = count(*) FROM buildings"
holds "blocks are valid and have an area" "SELECT count(*) > 20000 AND bool_and(ST_IsValid(geom) AND ST_Area(geom) > 0) FROM blocks"
holds "a building's centroid is in its block, and inside no other" \
	"SELECT count(*) = 122526 FROM buildings b, LATERAL (SELECT ST_SetSRID(typify_centre(b.geom)::geometry, 25833) p) c
	WHERE b.block = (SELECT coalesce(min(number), 1) FROM blocks WHERE number > 1 AND ST_Intersects(blocks.geom, p))"

timed "touching parts joined" "CREATE TABLE houses AS SELECT * FROM typify_dissolve_table('buildings')"
sql -c "CREATE INDEX ON houses USING gist (geom)" -c "ANALYZE houses"
timed "... within half a metre" "CREATE TABLE near_houses AS SELECT * FROM typify_dissolve_table('buildings', 0.5)"
for table in houses near_houses; do
	holds "$table: every building is part of exactly one" \
		"SELECT count(*) = 122526 AND count(DISTINCT part) = count(*) FROM $table, unnest(parts) AS part"
	holds "$table: all valid, but for what stood alone" \
		"SELECT bool_and(ST_IsValid(geom)) FROM $table WHERE cardinality(parts) > 1"
done
holds "houses do not touch each other" \
	"SELECT count(*) = 0 FROM houses a JOIN houses b ON ST_DWithin(a.geom, b.geom, 0) AND a.id < b.id"
holds "they cover what their parts covered" "SELECT abs((SELECT sum(ST_Area(geom)) FROM houses)
	/ (SELECT ST_Area(ST_UnaryUnion(ST_Collect(ST_MakeValid(geom)))) FROM buildings) - 1) < 1e-6"

sql -c "CREATE TABLE lod200 AS SELECT row_number() OVER (ORDER BY ST_Collect(geom)) AS id,
	ST_Buffer(ST_Centroid(ST_Collect(ST_Centroid(geom))), 35)::geometry AS geom
	FROM buildings GROUP BY ST_SnapToGrid(ST_Centroid(geom), 140)"
timed "links, one group" "CREATE TABLE links AS SELECT * FROM typify_match('buildings', 'lod200', 0.5)"
timed "derived in blocks, calibrated" "CREATE TABLE derived AS
	SELECT * FROM typify_derive('buildings', 'lod200', 75000, 0.5, 'block')"
holds "every building is in one placeholder" \
	"SELECT count(*) = 122526 AND count(DISTINCT member) = 122526 FROM derived, unnest(members) AS member"
timed "links, block by block" "CREATE TABLE block_links AS SELECT * FROM typify_match('buildings', 'lod200', 0.5, 'block')"
for table in links block_links; do
	holds "$table: every building once, every object" "SELECT count(lod25_id) = 122526 AND count(DISTINCT lod25_id) = 122526
		AND count(DISTINCT lod200_id) = (SELECT count(*) FROM lod200) FROM $table"
	holds "$table: none is longer than the limit" "SELECT max(distance) <= 500 AND count(distance) > 100000 FROM $table"
done
exit $FAILED
