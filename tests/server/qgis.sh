#!/bin/bash
# qgis.sh - the fear: a layer that PostGIS finds in order does not open in QGIS, shows nothing, or shows something else.
# Opens layers in QGIS without a screen, as the browser would and with the key named, and holds what QGIS sees and
# draws against SQL. Uses the server of the PG* variables. Exit status 77: skipped, there is no QGIS.
. "$(dirname "$0")/common.sh"

# QGIS speaks the system's Python, and writes into a home
qgis_layer() { HOME=$OWN_FOLDER XDG_RUNTIME_DIR=$OWN_FOLDER /usr/bin/python3 tests/server/qgis_layer.py "$@"; }

/usr/bin/python3 -c 'import qgis.core' 2>/dev/null ||
	{ echo "skipped: no QGIS; make test QGIS=1 installs python3-qgis, 600 MB"; exit 77; }
fresh_database typify_qgis tests/data/settlement.sql tests/data/settlement_lod200.sql

# value NAME: what qgis_layer printed under that name
value() { sed -n "s/^$1 //p" "$OWN_FOLDER/seen"; }

# opens WHAT PROVIDER SOURCE RELATION KEY: the layer is the relation
opens() {
	echo "$1:"
	qgis_layer "$2" "$3" "$OWN_FOLDER/layer.png" >"$OWN_FOLDER/seen" || { echo "failed: $1"; FAILED=1; return; }
	check "  features" "$(value features)" "$(answer "SELECT count(*) FROM $4")"
	check "  features read" "$(value read)" "$(value features)"
	check "  geometry type" "$(value geometry)" \
		"$(answer "SELECT initcap(type) FROM geometry_columns WHERE f_table_name = '$4'")"
	check "  srid" "$(value srid)" "$(answer "SELECT srid FROM geometry_columns WHERE f_table_name = '$4'")"
	check "  key" "$(value key)" "$5"
	check "  distinct keys" "$(value 'distinct keys')" "$(value features)"
	check "  invalid" "$(value invalid)" 0
	[ "$4" = classed ] || check "  spatial index" "$(value 'spatial index')" yes
	echo "  dark on the picture: $(value dark) %, built on the ground: $(value built) %"
	check "  the picture shows it" \
		"$(answer "SELECT $(value dark) > 1 AND abs($(value dark) - $(value built)) < 0.1")" t
}

layers="'settlement_buildings', 'settlement_lod200'"
sql -o /dev/null -c "SELECT typify_create_scale('layer75', $layers, 75000, 0.5, 'block')" \
	-c "SELECT typify_create_scale('layer50', $layers, 50000, 0.5, 'block', 'table')" \
	-c "CREATE VIEW classed AS SELECT p.*, b.class FROM layer75 p JOIN settlement_buildings b USING (id)"
echo "QGIS $(/usr/bin/python3 -c 'from qgis.core import Qgis; print(Qgis.QGIS_VERSION.split("-")[0])' 2>/dev/null)"
opens "a materialized view, its key named" postgres \
	"dbname='$PGDATABASE' key='id' srid=25832 type=Polygon table=\"public\".\"layer75\" (geom)" layer75 id
opens "a materialized view, its key found" postgres \
	"dbname='$PGDATABASE' table=\"public\".\"layer75\" (geom)" layer75 id
opens "a table, its key found" postgres "dbname='$PGDATABASE' table=\"public\".\"layer50\" (geom)" layer50 id
opens "a view with attributes, its key named" postgres \
	"dbname='$PGDATABASE' key='id' table=\"public\".\"classed\" (geom)" classed id
ogr2ogr -f GPKG "$OWN_FOLDER/layer75.gpkg" "PG:dbname=$PGDATABASE" layer75 -select id,member_count,area,grp
opens "an export to GeoPackage" ogr "$OWN_FOLDER/layer75.gpkg|layername=layer75" layer75 fid
exit $FAILED
