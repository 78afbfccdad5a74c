#!/bin/bash
# three_schemas.sh - the fear: names resolve only where everything is in public. typify, PostGIS and the tables live in
# three schemas, none is on the search_path, names need quoting, and the role owns its tables and nothing else. Uses
# the server of the PG* variables.
. "$(dirname "$0")/common.sh"

role=typify_three_schemas_owner
own_role $role
own_database typify_three_schemas
export PGDATABASE=typify_three_schemas
sql -v role=$role <<'SQL'
REVOKE CREATE ON SCHEMA public FROM PUBLIC;
CREATE SCHEMA gis;
CREATE SCHEMA "Typify ""here""";
CREATE SCHEMA "Land's";
GRANT USAGE ON SCHEMA gis, "Typify ""here""" TO :role;
CREATE EXTENSION postgis SCHEMA gis;
CREATE EXTENSION typify SCHEMA "Typify ""here""";
ALTER SCHEMA "Land's" OWNER TO :role;
SET ROLE :role;
SET search_path = "Land's", gis;
CREATE TABLE "LOD 25" ("the Id" integer PRIMARY KEY, "Block ""b""" text, "Shape%s" geometry(Polygon, 25832), "x.y" integer);
INSERT INTO "LOD 25" SELECT i, 'block ' || i % 4, ST_MakeEnvelope(i % 4 * 900 + i * 71 % 300, i * 97 % 307,
	i % 4 * 900 + i * 71 % 300 + 8 + i % 5, i * 97 % 307 + 9, 25832), i % 4 FROM generate_series(1, 200) AS i;
CREATE INDEX ON "LOD 25" USING gist ("Shape%s");
CREATE TABLE "LOD.200" ("the Id" integer PRIMARY KEY, "x.y" integer, "Ge'om" geometry(Polygon, 25832));
INSERT INTO "LOD.200" SELECT i, i % 4, ST_MakeEnvelope(i % 4 * 900 + i * 31 % 300, i * 53 % 307,
	i % 4 * 900 + i * 31 % 300 + 40, i * 53 % 307 + 45, 25832) FROM generate_series(1, 24) AS i;
CREATE VIEW "my links" AS SELECT "the Id" AS lod25_id, 1 + ("the Id" % 4)::bigint AS lod200_id FROM "LOD 25";
SQL

# answers WHAT QUERY ANSWER, as the role, with nothing on the search_path; TYPIFY. and COLUMNS stand for what is long
answers() {
	local found query=${2//TYPIFY./\"Typify \"\"here\"\"\".}
	query=${query//COLUMNS/id_column => \'the Id\', geom_column => \'Shape%s\'}
	query=${query//LOD25/\'\"Land\'\'s\".\"LOD 25\"\'}
	query=${query//LOD200/\'\"Land\'\'s\".\"LOD.200\"\', lod200_geom_column => \'Ge\'\'om\'}
	found=$(sql -At -v VERBOSITY=terse -c "SET ROLE $role" -c "SET search_path = ''" -c "$query" 2>&1) || true
	check "$1" "$found" "$3"
}

answers "the whole" "SELECT count(*), sum(member_count) FROM TYPIFY.typify_derive(lod25 => LOD25, lod200 => NULL,
	scale => 50000, COLUMNS)" "100|200"
answers "calibrated" "SELECT count(*), sum(member_count) FROM TYPIFY.typify_derive(lod25 => LOD25, lod200 => LOD200,
	scale => 200000, s_u => 0.5, COLUMNS)" "24|200"
answers "grouped by a column of both" "SELECT count(*), count(DISTINCT grp) FROM TYPIFY.typify_derive(lod25 => LOD25,
	lod200 => LOD200, scale => 200000, group_by => 'x.y', COLUMNS)" "24|4"
answers "grouped by the nearest building" "SELECT count(*), count(DISTINCT grp) FROM TYPIFY.typify_derive(lod25 => LOD25,
	lod200 => LOD200, scale => 200000, group_by => 'Block \"b\"', allocation => 'total', COLUMNS)" "24|4"
answers "one group of a box" "SELECT min(grp), max(grp), sum(member_count) FROM TYPIFY.typify_derive(lod25 => LOD25,
	lod200 => LOD200, scale => 100000, group_by => 'Block \"b\"',
	box => gis.ST_MakeEnvelope(900, 0, 1200, 300, 25832), COLUMNS)" "block 1|block 1|50"
answers "grouped by links" "SELECT count(*), count(DISTINCT grp) FROM TYPIFY.typify_derive(lod25 => LOD25,
	lod200 => LOD200, scale => 200000, links => '\"Land''s\".\"my links\"', lod200_id_column => 'the Id', COLUMNS)" "4|4"
answers "calibration" "SELECT count(*), bool_and(calibrated), sum(n200) FILTER (WHERE overall)
	FROM TYPIFY.typify_calibrate(lod25 => LOD25, lod200 => LOD200, group_by => 'x.y', COLUMNS)" "5|t|24"
answers "a missing column is named as it is written" "SELECT TYPIFY.typify_derive(LOD25, NULL, 75000)" \
	"ERROR:  \"Land's\".\"LOD 25\" has no column id"
exit $FAILED
