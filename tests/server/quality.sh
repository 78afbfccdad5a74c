#!/bin/bash
# quality.sh - the fear: the figures of typify_quality are wrong where layers are large, or take minutes. Counted anew by
# other means (spatial indexes, GEOS) on real data. Uses the server of the PG* variables. Times are printed, not judged.
. "$(dirname "$0")/common.sh"

need_real leipzig_2017 buildings roads
fresh_database typify_quality_leipzig
load_real buildings roads
sql <<-'SQL'
	CREATE VIEW main_roads AS SELECT geom FROM roads WHERE class IN ('motorway', 'trunk', 'primary', 'secondary');
	CREATE TABLE city (scale float8, geom geometry, members bigint[]);
	INSERT INTO city SELECT scale, geom, members FROM unnest(ARRAY[28000, 75000]) AS scale, typify_derive('buildings', NULL, scale, 0.5);
	CREATE VIEW city28 AS SELECT * FROM city WHERE scale = 28000;
	CREATE VIEW city75 AS SELECT * FROM city WHERE scale = 75000;
	CREATE TABLE figures AS SELECT 0::float8 AS scale, * FROM typify_quality('buildings', 'city75', 75000) LIMIT 0;
SQL

judge() { # judge SCALE
	local start=$EPOCHREALTIME
	sql -c "INSERT INTO figures SELECT $1000, * FROM typify_quality('buildings', 'city$1', $1000,
		barriers => 'main_roads', barrier_width => 0.5, roads => 'roads')"
	awk -v scale="$1" -v n="$(answer "SELECT reached FROM figures WHERE scale = $1000")" -v from="$start" \
		-v to="$EPOCHREALTIME" 'BEGIN { printf "%s placeholders at 1:%s 000 judged: %.1f s\n", n, scale, to - from }'
}
judge 28
judge 75
holds "100 000 placeholders" "SELECT reached > 100000 AND reached = asked AND lost = 0 AND repeated = 0 FROM figures WHERE scale = 28000"

# 1:75 000: 0.2 mm are 15 m, 0.35 mm 26.25 m, 0.45 mm 33.75 m
sql <<-'SQL'
	CREATE TABLE drawn AS SELECT row_number() OVER () AS n, geom, members FROM city75;
	CREATE INDEX ON drawn USING gist (geom);
	CREATE TABLE pairs AS
	SELECT ST_Area(ST_Intersection(a.geom, b.geom)) > 1e-6 * least(ST_Area(a.geom), ST_Area(b.geom)) AS overlap
	FROM drawn AS a JOIN drawn AS b ON a.n < b.n AND ST_DWithin(a.geom, b.geom, 15 * (1 - 1e-6));
	CREATE TABLE lines AS SELECT geom FROM main_roads;
	CREATE INDEX ON lines USING gist (geom);
	CREATE TABLE links AS
	SELECT ST_MakeLine(ST_Centroid(b.geom), ST_Centroid(d.geom)) AS geom
	FROM drawn AS d, unnest(members) AS id JOIN buildings AS b USING (id);
	ANALYZE;
SQL
same() { # same FIGURE QUERY: up to a millionth
	holds "$1, found otherwise: $(answer "SELECT $1 FROM figures WHERE scale = 75000")" \
		"SELECT abs($1 - found) <= 1e-6 * abs(found) FROM figures, ($2) AS other (found) WHERE scale = 75000"
}
same overlapping "SELECT count(*) FROM pairs WHERE overlap"
same narrow_gaps "SELECT count(*) FROM pairs WHERE NOT overlap"
# placeholders are rectangles
same short_sides "SELECT count(*) FROM drawn WHERE least(ST_Distance(ST_PointN(ST_ExteriorRing(geom), 1),
	ST_PointN(ST_ExteriorRing(geom), 2)), ST_Distance(ST_PointN(ST_ExteriorRing(geom), 2),
	ST_PointN(ST_ExteriorRing(geom), 3))) < 26.25 * (1 - 1e-6)"
same barrier_crossings "SELECT count(*) FROM drawn WHERE EXISTS (SELECT FROM lines WHERE ST_Intersects(lines.geom, drawn.geom))"
same barrier_gaps "SELECT count(*) FROM drawn WHERE EXISTS (SELECT FROM lines WHERE ST_DWithin(lines.geom, drawn.geom,
	33.75 * (1 - 1e-6))) AND NOT EXISTS (SELECT FROM lines WHERE ST_Intersects(lines.geom, drawn.geom))"
same members_across "SELECT count(*) FROM links WHERE EXISTS (SELECT FROM lines WHERE ST_Intersects(lines.geom, links.geom))"
same displacement_median "SELECT percentile_cont(0.5) WITHIN GROUP (ORDER BY ST_Length(geom)) / 75 FROM links"
same displacement_p99 "SELECT percentile_cont(0.99) WITHIN GROUP (ORDER BY ST_Length(geom)) / 75 FROM links"
same "ink_after / ink_before" "SELECT ST_Area(ST_UnaryUnion((SELECT ST_Collect(geom) FROM drawn)))
	/ (SELECT sum((m).area) FROM (SELECT typify_measures(geom) AS m FROM buildings) AS t)"
exit $FAILED
