#!/bin/bash
# dump.sh - the fear: a dump with layers, or with indexes on typify's functions, does not restore, or restores other
# rows. typify, PostGIS and the tables are in three schemas. Uses the server of the PG* variables.
. "$(dirname "$0")/common.sh"

# the search_path is what the README's users have: everything on it while they work, nothing while it is restored
path="SET search_path = maps, typify, gis"
export database=typify_dump scratch=$OWN_FOLDER
own_database $database
OWN_DATABASES+=(${database}_copy)
sql -d $database -o /dev/null <<SQL
CREATE SCHEMA gis;
CREATE SCHEMA typify;
CREATE SCHEMA maps;
CREATE EXTENSION postgis SCHEMA gis;
CREATE EXTENSION typify SCHEMA typify;
$path;
\i tests/data/settlement.sql
-- coarse objects, in another order than the alphabet: a dump that sorts by name alone would restore too early
CREATE TABLE zz_coarse AS
SELECT row_number() OVER () AS id, ST_Envelope(ST_Collect(geom))::geometry(Polygon, 25832) AS geom
FROM (SELECT block, geom, ST_ClusterDBSCAN(geom, 40, 3) OVER () AS cluster FROM settlement_buildings) AS b
WHERE cluster IS NOT NULL AND ST_GeometryType(geom) = 'ST_Polygon' GROUP BY cluster;
CREATE TABLE links AS
SELECT b.id AS lod25_id, (SELECT c.id FROM zz_coarse AS c ORDER BY c.geom <-> b.geom, c.id LIMIT 1) AS lod200_id
FROM settlement_buildings AS b;
CREATE MATERIALIZED VIEW zz_filtered AS SELECT * FROM settlement_buildings WHERE ST_Area(geom) > 30;
CREATE VIEW zz_seen AS SELECT * FROM zz_filtered;

SELECT typify_create_scale('"A layer"', 'settlement_buildings', 'zz_coarse', 75000, 0.5, 'block',
	options => typify_options(shape => 'square', psi => 0.1 + 0.2));
SELECT typify_create_scale('a_of_links', 'settlement_buildings', 'zz_coarse', 200000, links => 'links');
SELECT typify_create_scale('a_of_a_view', 'zz_seen', NULL, 100000);
SELECT typify_create_scale('a_table', 'settlement_buildings', 'zz_coarse', 50000, 0.25, 'block', 'table');
CALL typify_build_hierarchy('a_hierarchy', 'settlement_buildings', 0.5);
SELECT typify_create_tile_function('maps', 'tiles', 'a_hierarchy', attributes => '{class}');
-- indexes on expressions, and a constraint
CREATE TABLE spots (id bigint PRIMARY KEY, number bigint, geom geometry(Point, 25832));
INSERT INTO spots SELECT id, id * 10, ST_Centroid(geom) FROM settlement_buildings;
CREATE INDEX spots_rectangle ON spots USING gist (typify_rectangle(geom, 100, 0.5, 30));
CREATE INDEX spots_count ON spots (typify_count(number, 75000, typify_options(exponent => 1)));
ALTER TABLE spots ADD CHECK (typify_area_factor(25000 + number) >= 1);
SQL

# story DATABASE: everything that must be the same on the other side
story() {
	PGOPTIONS="$PGOPTIONS -c extra_float_digits=3" sql -At -d "$1" <<SQL
$path;
SELECT format('%s %s rows %s', relation, count(*), md5(string_agg(line, ';' ORDER BY line)))
FROM (
	SELECT 'A layer' AS relation, l::text AS line FROM "A layer" AS l
	UNION ALL SELECT 'a_of_links', l::text FROM a_of_links AS l
	UNION ALL SELECT 'a_of_a_view', l::text FROM a_of_a_view AS l UNION ALL SELECT 'a_table', l::text FROM a_table AS l
	UNION ALL SELECT 'spots', l::text FROM spots AS l
) AS lines GROUP BY relation ORDER BY relation;
SELECT format('tile of zoom %s: %s bytes', z, length(tiles(z, x, y)))
FROM (VALUES (11, 1084, 698), (14, 8673, 5589)) AS tile (z, x, y);
SELECT obj_description('tiles'::regproc, 'pg_proc');
SELECT format('%s populated %s', matviewname, ispopulated) FROM pg_matviews WHERE schemaname = 'maps' ORDER BY 1;
SELECT format('%s: %s', relname, obj_description(oid, 'pg_class')) FROM pg_class
WHERE obj_description(oid, 'pg_class') IS NOT NULL AND relnamespace = 'maps'::regnamespace ORDER BY 1;
SELECT indexdef FROM pg_indexes WHERE schemaname = 'maps' ORDER BY 1;
SET enable_seqscan = off;
SELECT 'found by index', count(*) FROM spots
WHERE typify_rectangle(geom, 100, 0.5, 30) && ST_MakeEnvelope(613000, 5487000, 614000, 5488000, 25832);
SELECT 'found by index', count(*) FROM spots
WHERE typify_count(number, 75000, typify_options(exponent => 1)) = 577;
SQL
}
story $database >"$scratch/before"
grep -E 'rows|found' "$scratch/before"
# restored HOW COMMAND...: the command restores into the empty copy; no word of an error, the same story, and layers
# that can be refreshed
restored() {
	local how=$1
	shift
	dropdb --if-exists ${database}_copy
	createdb -T template0 ${database}_copy
	if ! "$@" >"$scratch/words" 2>&1 </dev/null || [ -s "$scratch/words" ]; then
		echo "failed: $how"
		cat "$scratch/words"
		FAILED=1
		return
	fi
	story ${database}_copy >"$scratch/after"
	if ! diff "$scratch/before" "$scratch/after"; then echo "failed: $how: other rows"; FAILED=1; return; fi
	sql -d ${database}_copy -o /dev/null -c "$path" \
		-c "SELECT typify_refresh_scale('\"A layer\"', true), typify_refresh_scale('a_of_links')" \
		-c "SELECT typify_refresh_groups('a_table', '{1}')"
	story ${database}_copy >"$scratch/after"
	if ! diff "$scratch/before" "$scratch/after"; then echo "failed: $how, refreshed: other rows"; FAILED=1; return; fi
	echo "ok: $how, and refreshed there"
}
restored "plain dump" bash -c 'set -o pipefail
	pg_dump $database | psql -qX -v ON_ERROR_STOP=1 -o /dev/null -d ${database}_copy'
pg_dump -Fc -f "$scratch/dump" $database
restored "custom format" pg_restore --exit-on-error -d ${database}_copy "$scratch/dump"
restored "custom format, two jobs" pg_restore --exit-on-error -j 2 -d ${database}_copy "$scratch/dump"
restored "section by section" bash -c 'for section in pre-data data post-data; do
	pg_restore --exit-on-error --section=$section -d ${database}_copy "$scratch/dump" || exit 1; done'
exit $FAILED
