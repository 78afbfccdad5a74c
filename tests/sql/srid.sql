-- srid.sql: results carry the SRID of the input; degrees are refused, whoever asks and wherever PostGIS is
\i tests/data/error_of.sql

SELECT srid, ST_SRID(typify(geom, 25000)) AS typified, ST_SRID((typify_placeholders(geom, 1, 25000))[1].geom) AS in_rows,
	   ST_SRID(typify_rectangle(ST_Centroid(geom), 4, 1, 0)) AS rectangle
FROM unnest(ARRAY[0, 2056, 3857, 999001]) AS srid, LATERAL (SELECT ST_MakeEnvelope(0, 0, 2, 2, srid) AS geom) AS b
GROUP BY srid, geom ORDER BY srid;

-- geographic systems, two- and three-dimensional, and a geocentric one
SELECT srid, pg_temp.error_of(format('SELECT typify(ST_SetSRID(ST_MakePoint(0, 0), %s), 25000)', srid))
FROM unnest(ARRAY[4326, 4258, 4979, 4150, 4978]) AS srid ORDER BY srid;
SELECT pg_temp.error_of('SELECT typify_placeholders(ST_SetSRID(ST_MakePoint(0, 0), 4326), 1, 25000)');
SELECT pg_temp.error_of('SELECT typify_cluster(ST_SetSRID(ST_MakePoint(0, 0), 4326), 25000) OVER ()');
SELECT pg_temp.error_of('SELECT typify_rectangle(ST_SetSRID(ST_MakePoint(0, 0), 4326), 1, 1, 0)');

-- systems that users add
BEGIN;
INSERT INTO spatial_ref_sys (srid, srtext, proj4text) VALUES
	(990001, 'GEOGCRS["mine",DATUM["d",ELLIPSOID["e",6378137,298.25]],CS[ellipsoidal,2]]', ''),
	(990002, 'PROJCRS["mine",BASEGEOGCRS["base",DATUM["d",ELLIPSOID["e",6378137,298.25]]]]', '+proj=tmerc'),
	(990003, NULL, '+proj=longlat +datum=WGS84'),
	(990004, NULL, NULL),
	(990005, NULL, '+proj=ob_tran +o_proj=longlat +o_lat_p=39 +to_meter=0.0174532925199433'),
	(990006, 'COMPD_CS["both",GEOGCS["WGS 84"],VERT_CS["height"]]', NULL),
	(990007, 'GEODCRS["mine",DATUM["d",ELLIPSOID["e",6378137,298.25]],CS[ellipsoidal,2]]', ''),
	(990008, 'GeodeticCRS ( "Cartesian?", DATUM["d"], CS[ellipsoidal,3] )', ''),
	(990009, 'GEODCRS["mine",DATUM["d",ELLIPSOID["e",6378137,298.25]],CS[Cartesian,3],AXIS["(X)",geocentricX]]', ''),
	(990010, 'GEOCCS["mine",DATUM["d"],PRIMEM["Greenwich",0]]', NULL),
	(990011, NULL, '+proj=geocent +datum=WGS84'),
	(990012, '', '+init=epsg:4326'),
	(990013, '', '+init=EPSG:2056'),
	(990014, '', '+init=epsg:990014'),
	(990015, 'LOCAL_CS["a ""GEOGCS"" of our own"]', NULL),
	(990016, 'COMPOUNDCRS["both",PROJCRS["plan",BASEGEOGCRS["base"],CS[Cartesian,2]],VERTCRS["height"]]', NULL);
SELECT srid, pg_temp.error_of(format('SELECT typify(ST_MakeEnvelope(0, 0, 2, 2, %s), 25000)', srid))
FROM generate_series(990001, 990016) AS srid ORDER BY srid;
-- with another primary key, and with none
ALTER TABLE spatial_ref_sys DROP CONSTRAINT spatial_ref_sys_pkey, ADD COLUMN number serial PRIMARY KEY;
SELECT pg_temp.error_of('SELECT typify(ST_MakeEnvelope(0, 0, 2, 2, 4326), 25000)');
ALTER TABLE spatial_ref_sys DROP CONSTRAINT spatial_ref_sys_pkey;
SELECT pg_temp.error_of('SELECT typify(ST_MakeEnvelope(0, 0, 2, 2, 4326), 25000)');
SELECT pg_temp.error_of('SELECT typify(ST_MakeEnvelope(0, 0, 2, 2, 2056), 25000)');
ROLLBACK;

-- two in a group: an error; in two groups: fine
SELECT pg_temp.error_of('SELECT typify(ST_SetSRID(ST_MakePoint(i, 0), srid), 25000) FROM (VALUES (1, 2056), (2, 21781)) AS b (i, srid)');
SELECT pg_temp.error_of('SELECT typify(ST_SetSRID(ST_MakePoint(i, 0), srid), 25000) FROM (VALUES (1, 0), (2, 21781)) AS b (i, srid)');
SELECT pg_temp.error_of('SELECT typify_cluster(ST_SetSRID(ST_MakePoint(i, 0), srid), 25000) OVER () FROM (VALUES (1, 2056), (2, 21781)) AS b (i, srid)');
SELECT srid, ST_SRID(typify(ST_MakeEnvelope(i, 0, i + 1, 1, srid), 25000)) FROM (VALUES (1, 2056), (2, 21781), (5, 2056), (6, 0)) AS b (i, srid)
GROUP BY srid ORDER BY srid;

-- nobody needs the right to read spatial_ref_sys, nor a search_path
BEGIN;
CREATE ROLE regress_typify_reader;
CREATE SCHEMA regress_typify_empty;
GRANT USAGE ON SCHEMA regress_typify_empty TO regress_typify_reader;
REVOKE ALL ON spatial_ref_sys FROM PUBLIC;
SELECT nspname AS postgis FROM pg_type JOIN pg_namespace ON pg_namespace.oid = typnamespace WHERE typname = 'geometry' \gset
SELECT nspname AS typify FROM pg_type JOIN pg_namespace ON pg_namespace.oid = typnamespace WHERE typname = 'typify_options' \gset
SET LOCAL ROLE regress_typify_reader;
SET LOCAL search_path = regress_typify_empty;
SELECT :postgis.ST_SRID(:typify.typify(:postgis.ST_SetSRID(:postgis.ST_MakeEnvelope(0, 0, 2, 2), 2056), 25000));
SAVEPOINT before_error;
SELECT :typify.typify(:postgis.ST_SetSRID(:postgis.ST_MakePoint(0, 0), 4326), 25000);
ROLLBACK;
