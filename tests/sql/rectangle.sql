-- rectangle.sql: a rectangle has the area, ratio and direction asked for, and the bytes that PostGIS would write
SELECT degrees, ST_AsText(typify_rectangle('SRID=2056;POINT(100 200)', 200, 0.5, degrees), 6)
FROM unnest(ARRAY[0, 30, 45, 90, 135, 180, -90, 720]) WITH ORDINALITY AS d (degrees, number) ORDER BY number;
SELECT ST_AsText(typify_rectangle('POINT Z (100 200 7)', 4, 1, 0)) AS flat, ST_SRID(typify_rectangle('SRID=3857;POINT(0 0)', 1, 1, 0)) AS srid;

CREATE TEMP TABLE rectangle AS
SELECT i, area, ratio, degrees, typify_rectangle(ST_SetSRID(ST_MakePoint(x, y), srid), area, ratio, degrees) AS geom
FROM (SELECT i, (ARRAY[0, 2056, 3857, 999999])[i % 4 + 1] AS srid, (i * 7919 % 10007 - 5000) * (10 ^ (i % 7 - 1)) AS x, (i * 104729 % 10009 - 5000) * (10 ^ (i % 5 - 1)) AS y,
			 (1 + i % 97) * 3.7 AS area, (1 + i % 50) / 50.0 AS ratio, i * 1.37 AS degrees FROM generate_series(1, 2000) AS i) AS r;
SELECT count(*), bool_and(ST_IsValid(geom)) AS valid, bool_and(ST_IsPolygonCCW(geom)) AS counter_clockwise, bool_and(ST_NPoints(geom) = 5 AND ST_NumInteriorRings(geom) = 0) AS five_points,
	   bool_and(ST_StartPoint(ST_ExteriorRing(geom)) = ST_EndPoint(ST_ExteriorRing(geom))) AS closed,
	   max(abs(ST_Area(geom) / area - 1)) < 1e-3 AS area FROM rectangle;

-- the stored value, with its box, equals what PostGIS makes of the same geometry; comparing the composites compares the bytes
CREATE TYPE pg_temp.boxed AS (geom geometry);
CREATE FUNCTION pg_temp.same_bytes(a geometry, b geometry) RETURNS boolean LANGUAGE sql AS $$ SELECT ROW(a)::pg_temp.boxed *= ROW(b)::pg_temp.boxed $$;
SELECT count(*) AS rectangles, count(*) FILTER (WHERE pg_temp.same_bytes(geom, ST_GeomFromEWKB(ST_AsEWKB(geom)))) AS same_bytes,
	   count(*) FILTER (WHERE ST_Equals(geom, ST_GeomFromEWKB(ST_AsEWKB(geom)))) AS equal FROM rectangle;
SELECT srid, scale, count(*) AS results, count(*) FILTER (WHERE pg_temp.same_bytes(t, ST_GeomFromEWKB(ST_AsEWKB(t)))) AS same_bytes,
	   bool_and(ST_SRID(t) = srid) AS srid_kept, sum(ST_NumGeometries(t)) AS placeholders, bool_and((SELECT bool_and(ST_IsValid(d.geom) AND ST_SRID(d.geom) = srid) FROM ST_Dump(t) AS d)) AS valid_parts
FROM (SELECT srid, scale, i % 5, typify(ST_SetSRID(ST_MakeEnvelope(i * 31 % 97 * 20.1, i * 17 % 89 * 20.3, i * 31 % 97 * 20.1 + 9.7, i * 17 % 89 * 20.3 + 8.1), srid), scale) AS t
	  FROM generate_series(1, 60) AS i, unnest(ARRAY[0, 2056]) AS srid, unnest(ARRAY[25000, 200000, 2000000]) AS scale GROUP BY 1, 2, 3) AS q
GROUP BY srid, scale ORDER BY srid, scale;
SET client_min_messages = error;
SELECT pg_temp.same_bytes(typify('SRID=2056;POINT(0 0)'::geometry, 25000), 'SRID=2056;GEOMETRYCOLLECTION EMPTY') AS empty_with_srid, pg_temp.same_bytes(typify('POINT(0 0)'::geometry, 25000), 'GEOMETRYCOLLECTION EMPTY') AS empty;
RESET client_min_messages;

-- and so do geometries inside of rows
SELECT count(*) AS rows, count(*) FILTER (WHERE pg_temp.same_bytes(p.geom, ST_GeomFromEWKB(ST_AsEWKB(p.geom)))) AS same_bytes
FROM unnest((SELECT typify_placeholders(ST_SetSRID(ST_MakeEnvelope(i * 31 % 97 * 20.1, i, i * 31 % 97 * 20.1 + 9.7, i + 3), 2056), i, 75000) FROM generate_series(1, 60) AS i)) AS p;
