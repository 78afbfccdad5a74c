#!/bin/bash
# legible_layers.sh - the fear: on real buildings in groups two placeholders of a layer overlap or come nearer than the
# gap, somebody is lost, or a kept building is moved, shrunk or gone. Groups are blocks between main roads. An
# independent check by PostGIS. The server of the PG* variables and the data in TYPIFY_DATA, by default ../shared/data
# beside the project; what is missing there is skipped, all of it: exit status 77.
. "$(dirname "$0")/common.sh"
data=${TYPIFY_DATA:-../shared/data}
sets=
for set in liechtenstein_2024 leipzig_2017; do
	if [ -r "$data/$set/buildings.csv.gz" ] && [ -r "$data/$set/roads.csv.gz" ]; then
		sets="$sets $set"
	else
		echo "left out: no $data/$set (TYPIFY_DATA)"
	fi
done
[ -n "$sets" ] || { echo "skipped: no real data (TYPIFY_DATA)"; exit 77; }
fresh_database typify_legible_layers
sql -c "CREATE FUNCTION too_near(geoms geometry[], gap float8) RETURNS bigint LANGUAGE plpgsql AS \$\$
	BEGIN
		CREATE TEMP TABLE g ON COMMIT DROP AS SELECT n, geom FROM unnest(geoms) WITH ORDINALITY AS g (geom, n) WHERE geom IS NOT NULL;
		CREATE INDEX ON g USING gist (geom);
		ANALYZE g;
		RETURN (SELECT count(*) FROM g AS a JOIN g AS b ON a.n < b.n AND a.geom && ST_Expand(b.geom, gap) AND ST_DWithin(a.geom, b.geom, gap * (1 - 1e-6)));
	END \$\$"

load() { # load SET: buildings, with those that are kept, and its main roads
	REAL_DATA=$data/$1
	sql -c 'DROP TABLE IF EXISTS buildings, roads, main_roads, blocks'
	load_real buildings roads
	sql -c "CREATE TABLE main_roads AS SELECT geom FROM roads WHERE class ~ '^(motorway|trunk|primary|secondary|tertiary)(_link)?\$'" \
		-c 'ALTER TABLE buildings ADD COLUMN block bigint, ADD COLUMN worth float8 DEFAULT 1' \
		-c "UPDATE buildings SET worth = 'Infinity' WHERE class IN ('church', 'cathedral', 'castle', 'school', 'town hall')"
}

# set_blocks LINES: the block between the lines of a query, and a frame, that the centre of each building is in
set_blocks() {
	sql -c 'DROP TABLE IF EXISTS blocks' \
		-c "CREATE TABLE blocks AS SELECT row_number() OVER (ORDER BY (d).path) AS block, (d).geom
			FROM (SELECT ST_Dump(ST_Polygonize(geom)) AS d FROM (SELECT ST_Node(ST_Collect(geom)) AS geom FROM (
				$1 UNION ALL SELECT ST_Boundary(ST_Expand(ST_SetSRID(ST_Extent(geom)::geometry, min(ST_SRID(geom))), 100)) FROM buildings) AS lines) AS noded) AS faces" \
		-c 'CREATE INDEX ON blocks USING gist (geom)' \
		-c 'UPDATE buildings AS b SET block = k.block FROM blocks AS k WHERE ST_Intersects(k.geom, ST_SetSRID(typify_centre(b.geom)::geometry, ST_SRID(b.geom)))' -c 'ANALYZE'
}

# derive SCALE OPTIONS [ARGUMENT]: the layer; what it warns of is left in the file warnings
derive() {
	sql -c 'DROP TABLE IF EXISTS layer'
	PGOPTIONS='-c client_min_messages=warning' sql -c "CREATE TABLE layer AS SELECT * FROM typify_derive('buildings', NULL, $1, 0.5, 'block', options => typify_options($2)${3:-})" 2>"$OWN_FOLDER/warnings"
}

# warned PATTERN: the number in the only warning of that kind; 0: there is none
warned() {
	sed -n "s/^WARNING:  \([0-9]*\) $1.*/\1/p" "$OWN_FOLDER/warnings" | awk '{ n += $1; k++ } END { print (k > 1 ? k " warnings" : n + 0) }'
}

# the placeholders that did not fit in their group, or between those of others
undrawn() {
	sed -n -e 's/^WARNING:  \([0-9]*\) placeholders\{0,1\} do.*/\1/p' -e 's/^WARNING:  there is no room for \([0-9]*\) .*/\1/p' "$OWN_FOLDER/warnings" |
		awk '{ n += $1 } END { print n + 0 }'
}

everybody() { # everybody WHAT: each building is in one placeholder, and what is not drawn is told of
	check "$1: buildings that are members" "$(answer 'SELECT count(DISTINCT m) FROM layer, unnest(members) AS m')" "$(answer 'SELECT count(*) FROM buildings')"
	check "$1: members" "$(answer 'SELECT sum(member_count) FROM layer')" "$(answer 'SELECT count(*) FROM buildings')"
	check "$1: not drawn, as told" "$(answer 'SELECT count(*) - count(geom) FROM layer')" "$(undrawn)"
}

legible_in_blocks() { # legible_in_blocks WHAT SCALE
	local what="$1 1:$2"
	derive "$2" 'min_side => 0.35, min_gap => 0.2'
	echo "$what: $(answer "SELECT format('%s drawn, %s not, in %s groups; the law says %s', count(geom), count(*) - count(geom), count(DISTINCT grp),
		(SELECT sum(typify_count(n, $2)) FROM (SELECT count(*) AS n FROM buildings GROUP BY block) AS b)) FROM layer")"
	check "$what: overlaps and gaps" "$(answer "SELECT too_near(array_agg(geom), 0.2 * $2 / 1000) FROM layer")" 0
	check "$what: short sides" "$(answer "SELECT count(*) FROM layer WHERE geom IS NOT NULL AND width < 0.35 * $2 / 1000 * (1 - 1e-6)")" 0
	everybody "$what"
}

for set in $sets; do
	load "$set"
	set_blocks 'SELECT geom FROM main_roads'
	for scale in 50000 100000; do legible_in_blocks "$set, blocks between main roads" $scale; done
	[ "$set" = liechtenstein_2024 ] || continue
	set_blocks 'SELECT geom FROM roads'
	for scale in 50000 100000; do legible_in_blocks "$set, blocks between all roads" $scale; done
done

# kept buildings and everything else together
load "$(awk '{ print $1 }' <<<"$sets")"
set_blocks 'SELECT geom FROM main_roads'
for scale in 50000 75000 100000 200000; do
	what="kept buildings, rows and main roads 1:$scale"
	derive $scale "alignment => 5, keep_area => 0.5, min_side => 0.35, min_gap => 0.2, barrier_width => 0.5" ", importance_column => 'worth', barriers => 'main_roads'"
	sql -c 'DROP TABLE IF EXISTS kept' -c "CREATE TABLE kept AS SELECT id, geom FROM buildings WHERE worth > 1 OR ST_Area(geom) >= 0.5 * ($scale / 1000.0) ^ 2"
	check "$what: in place and in size" "$(answer "SELECT count(*) FROM kept JOIN layer AS j USING (id)
		WHERE ST_Distance(typify_centre(kept.geom)::geometry, ST_SetSRID(ST_Centroid(j.geom), 0)) < 0.001
			AND j.area >= ST_Area(kept.geom) * (1 - 1e-9) AND (j.area <= ST_Area(kept.geom) * (1 + 1e-9) OR j.width <= 0.35 * $scale / 1000 * (1 + 1e-6))")" \
		"$(answer 'SELECT count(*) FROM kept')"
	check "$what: pairs of kept ones that are too near, as told" "$(answer "SELECT too_near(array_agg(geom), 0.2 * $scale / 1000) FROM layer JOIN (SELECT id FROM kept) AS k USING (id)")" \
		"$(warned 'pairs\{0,1\} of kept')"
	check "$what: all that are too near" "$(answer "SELECT too_near(array_agg(geom), 0.2 * $scale / 1000) FROM layer")" "$(warned 'pairs\{0,1\} of kept')"
	check "$what: too near to a main road, as told" "$(answer "SELECT count(DISTINCT id) FROM layer JOIN main_roads AS r ON ST_DWithin(layer.geom, r.geom, 0.45 * $scale / 1000 * (1 - 1e-6))")" \
		"$(warned 'kept buildings\{0,1\} ')"
	everybody "$what"
	echo "$what: $(answer "SELECT format('%s placeholders drawn, %s kept', (SELECT count(geom) FROM layer), (SELECT count(*) FROM kept))")"
done
exit $FAILED
