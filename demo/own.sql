-- own.sql: the user's buildings (raw_buildings, raw_roads) under the names that the demo uses, in metres

SELECT NOT EXISTS (SELECT FROM pg_class WHERE oid = to_regclass('raw_roads')) AS without_roads \gset
\if :without_roads
	CREATE TABLE raw_roads (class text, geom geometry);
\endif

DO $$
DECLARE
	srids text := (SELECT string_agg(DISTINCT ST_SRID(geom)::text, ', ') FROM raw_buildings);
	polygons bigint := (SELECT count(*) FROM raw_buildings WHERE ST_Dimension(geom) = 2 AND NOT ST_IsEmpty(geom));
BEGIN
	IF polygons = 0 THEN
		RAISE EXCEPTION 'there is no building polygon in this file';
	ELSIF srids LIKE '%,%' THEN
		RAISE EXCEPTION 'the buildings have several SRIDs: %', srids
			USING HINT = 'Bring them to one with ST_Transform.';
	END IF;
END $$;

CREATE SCHEMA demo;
CREATE TABLE demo.subject AS SELECT 'your buildings'::text AS name, nullif(:'attribution', '') AS attribution;

-- The UTM zone of the middle for degrees; anything else stays as it is
CREATE TABLE demo.reference AS
SELECT srid, degrees, CASE
	WHEN degrees THEN CASE WHEN y < 0 THEN 32700 ELSE 32600 END + 1 + floor((x + 180) / 6)::integer % 60
	ELSE srid END AS target
FROM (SELECT ST_SRID(box) AS srid, ST_X(ST_Centroid(box)) AS x, ST_Y(ST_Centroid(box)) AS y,
		typify_metres_per_unit(ST_SRID(box)) = 'NaN' AS degrees
	  FROM (SELECT ST_SetSRID(ST_Extent(geom)::geometry, min(ST_SRID(geom))) AS box
			FROM raw_buildings) AS extent) AS middle;

\pset tuples_only on
\pset format unaligned
SELECT CASE WHEN degrees THEN format('Longitude and latitude (SRID %s) projected to UTM: SRID %s', srid, target)
	WHEN srid = 0 THEN 'No SRID given: coordinates are taken as metres' END AS message
FROM demo.reference WHERE degrees OR srid = 0;
\pset tuples_only off

CREATE TABLE buildings AS
SELECT row_number() OVER () AS id, class, NULL::bigint AS block,
	CASE WHEN degrees THEN ST_Transform(geom, target) ELSE geom END AS geom
FROM raw_buildings, demo.reference
WHERE ST_Dimension(geom) = 2 AND NOT ST_IsEmpty(geom);

CREATE TABLE demo.road AS
SELECT CASE
		WHEN class ~ '^(motorway|trunk|primary|secondary|tertiary|main)' THEN 'main'
		WHEN class IN ('residential', 'unclassified', 'living_street', 'pedestrian', 'minor') THEN 'residential'
		ELSE 'track' END AS class,
	CASE WHEN degrees THEN ST_Transform(geom, target) ELSE geom END AS geom
FROM raw_roads, demo.reference
WHERE class !~ '^(footway|path|steps|cycleway|rail|transit|proposed|construction)';

DROP TABLE raw_buildings, raw_roads;
