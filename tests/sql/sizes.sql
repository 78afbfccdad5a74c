-- sizes.sql: sides and areas are those that min_side and max_area say, in every unit
\i tests/data/error_of.sql

-- at 1:100 000 the area factor is 64/7: a house of 10 by 10 comes to 30 by 30 m, a shed of 4 by 2 to 12 by 6
CREATE TEMP TABLE building (id int, name text, geom geometry);
INSERT INTO building VALUES (1, 'house', ST_MakeEnvelope(0, 0, 10, 10)), (2, 'shed', ST_MakeEnvelope(100, 0, 104, 2)),
	(3, 'barn', ST_MakeEnvelope(200, 0, 220, 10)), (4, 'hall', ST_MakeEnvelope(300, 0, 400, 60)),
	(5, 'fence', ST_MakeEnvelope(500, 0, 600, 0.5)), (6, 'well', 'POINT(700 0)');
SELECT name, round(width::numeric, 2) AS width, round(length::numeric, 2) AS length, round(area::numeric, 2) AS area,
	round(ST_Area(p.geom)::numeric, 2) AS drawn
FROM building AS b, unnest((SELECT typify_placeholders(geom, id, 100000, 0, typify_options(exponent => 0)) FROM building WHERE id < 6)) AS p
WHERE b.id = p.id ORDER BY b.id;
SELECT name, round(width::numeric, 2) AS width, round(length::numeric, 2) AS length, round(area::numeric, 2) AS area,
	round(ST_Area(p.geom)::numeric, 2) AS drawn
FROM building AS b, unnest((SELECT typify_placeholders(geom, id, 100000, 0, typify_options(exponent => 0, min_side => 0.35)) FROM building)) AS p
WHERE b.id = p.id ORDER BY b.id;
-- min_side without a limit, and a limit without min_side
SELECT name, round(width::numeric, 2) AS width, round(length::numeric, 2) AS length
FROM building AS b, unnest((SELECT typify_placeholders(geom, id, 100000, 0, typify_options(exponent => 0, min_side => 0.35, max_area => 0)) FROM building)) AS p
WHERE b.id = p.id ORDER BY b.id;
SELECT name, round(width::numeric, 2) AS width, round(length::numeric, 2) AS length
FROM building AS b, unnest((SELECT typify_placeholders(geom, id, 100000, 0, typify_options(exponent => 0, max_area => 0.05)) FROM building WHERE id < 6)) AS p
WHERE b.id = p.id ORDER BY b.id;
-- several members are no stripe: the fence stands for two
SELECT name, member_count, round(width::numeric, 2) AS width, round(length::numeric, 2) AS length
FROM building AS b, unnest((SELECT typify_placeholders(geom, id, 100000, 0, typify_options(count => 1, min_side => 0.35)) FROM building WHERE id > 4)) AS p
WHERE b.id = p.id;

-- the aggregate of geometries draws the same
SELECT ST_AsEWKB(ST_Collect(p.geom ORDER BY n)) = ST_AsEWKB(ST_CollectionExtract(t, 3)) AS same
FROM (SELECT typify(geom, 100000, 0.5, typify_options(min_side => 0.35)) AS t, typify_placeholders(geom, id, 100000, 0.5, typify_options(min_side => 0.35)) AS list FROM building) AS b,
	unnest(list) WITH ORDINALITY AS p (id, geom, member_count, members, area, width, length, orientation, n) GROUP BY t;

-- millimetres on the map in feet, US feet, kilometres, metres, and in a unit that +to_meter tells; unknown: metres
BEGIN;
INSERT INTO spatial_ref_sys (srid, srtext, proj4text) VALUES (990101, NULL, '+proj=tmerc +units=km'), (990102, NULL, '+proj=tmerc +to_meter=0.201168'),
	(990103, NULL, '+proj=tmerc +units=ft'), (990104, 'PROJCS["mine"]', '+proj=tmerc +units=us-ft +no_defs');
SELECT srid, round(((typify_placeholders(ST_SetSRID(ST_MakePoint(1, 1), srid), 1, 100000, 0, typify_options(min_side => 0.35)))[1].width
	* typify_metres_per_unit(srid))::numeric, 6) AS width_in_metres
FROM unnest(ARRAY[0, 2056, 2272, 990101, 990102, 990103, 990104, 999001]) AS srid GROUP BY srid ORDER BY srid;
SELECT count(*) > 4000 AS all_projected, count(*) FILTER (WHERE abs(width * typify_metres_per_unit(srid) / 35 - 1) > 1e-12) AS other_units
FROM (SELECT srid, (typify_placeholders(ST_SetSRID(ST_MakePoint(1, 1), srid), 1, 100000, 0, typify_options(min_side => 0.35)))[1].width
	FROM spatial_ref_sys WHERE typify_metres_per_unit(srid) <> 'NaN' AND srtext LIKE 'PROJCS%' GROUP BY srid) AS p;
ROLLBACK;

-- sizes are calibrated without them
SELECT a.psi = b.psi AS same_psi FROM typify_calibrate('pg_temp.building', 'pg_temp.building') AS a,
	typify_calibrate('pg_temp.building', 'pg_temp.building', options => typify_options(min_side => 0.35, max_area => 1)) AS b;

-- both vary the parameters of a group
SELECT pg_temp.error_of(format('SELECT typify(geom, 100000, 0, typify_options(%s => id)) FROM pg_temp.building', o)) FROM unnest(ARRAY['min_side', 'max_area']) AS o;
