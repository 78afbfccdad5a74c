#!/bin/bash
# geopackage.sh - the fear: what leaves the database as a GeoPackage is not the layer any more. Exports a layer with
# ogr2ogr, reads it back and compares row by row. Uses the server of the PG* variables.
. "$(dirname "$0")/common.sh"

command -v ogr2ogr >/dev/null || { echo "skipped: no ogr2ogr; the Debian package is gdal-bin"; exit 77; }
fresh_database typify_geopackage tests/data/settlement.sql tests/data/settlement_lod200.sql
sql -o /dev/null -c "SELECT typify_create_scale('layer75', 'settlement_buildings', 'settlement_lod200', 75000, 0.5,
	group_by => 'block')"
# GeoPackage knows no arrays; and what comes from a query has no type unless it is named
ogr2ogr -f GPKG "$OWN_FOLDER/layer.gpkg" "PG:dbname=$PGDATABASE" -nln layer75 -nlt POLYGON -sql \
	"SELECT id, member_count, array_to_string(members, ' ') AS members, area, geom FROM layer75"
ogrinfo -so -ro "$OWN_FOLDER/layer.gpkg" layer75 >"$OWN_FOLDER/info"
check "features in the file" "$(sed -n 's/^Feature Count: //p' "$OWN_FOLDER/info")" \
	"$(answer 'SELECT count(*) FROM layer75')"
check "geometry type" "$(sed -n 's/^Geometry: //p' "$OWN_FOLDER/info")" Polygon
check "reference system" "$(grep -c '^ *ID\["EPSG",25832\]\]$' "$OWN_FOLDER/info")" 1
ogr2ogr -f PostgreSQL "PG:dbname=$PGDATABASE" "$OWN_FOLDER/layer.gpkg" layer75 -nln back -lco GEOMETRY_NAME=geom \
	-lco FID=fid
check "rows that came back" "$(answer 'SELECT count(*) FROM back')" "$(answer 'SELECT count(*) FROM layer75')"
check "rows that came back as they were" "$(answer "SELECT count(*) FROM layer75 AS a JOIN back AS b USING (id)
	WHERE ST_AsEWKB(a.geom) IS NOT DISTINCT FROM ST_AsEWKB(b.geom) AND a.member_count = b.member_count
		AND array_to_string(a.members, ' ') = b.members AND abs(a.area - b.area) <= 1e-12 * a.area")" \
	"$(answer 'SELECT count(*) FROM layer75')"
check "type of the geometry that came back" "$(answer "SELECT type || ' ' || srid FROM geometry_columns
	WHERE f_table_name = 'back'")" "POLYGON 25832"
exit $FAILED
