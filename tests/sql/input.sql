-- input.sql: what a building may be, and what is done with everything else
\pset null '(null)'

-- one building at the source scale is drawn with its own measures
CREATE FUNCTION pg_temp.measured(geom geometry) RETURNS text LANGUAGE sql AS
$$
	SELECT format('area %s at %s, %s x %s, %s degrees', round(p.area::numeric, 3), ST_AsText(ST_Centroid(p.geom), 3),
				  round(p.width::numeric, 3), round(p.length::numeric, 3), round(p.orientation::numeric, 3))
	FROM unnest((SELECT typify_placeholders(geom, 1, 25000))) AS p
$$;

\i tests/data/error_of.sql

-- polygons: holes are subtracted, parts added, Z and M ignored
SELECT what, pg_temp.measured(geom::geometry)
FROM (VALUES
	(1, 'square', 'POLYGON((0 0,10 0,10 10,0 10,0 0))'),
	(2, 'oblong', 'POLYGON((0 0,20 0,20 10,0 10,0 0))'),
	(3, 'upright', 'POLYGON((0 0,10 0,10 20,0 20,0 0))'),
	(4, 'turned by 30 degrees', ST_Rotate('POLYGON((0 0,20 0,20 10,0 10,0 0))', radians(30))::text),
	(5, 'turned by 150 degrees', ST_Rotate('POLYGON((0 0,20 0,20 10,0 10,0 0))', radians(150))::text),
	(6, 'hole', 'POLYGON((0 0,10 0,10 10,0 10,0 0),(1 1,4 1,4 4,1 4,1 1))'),
	(7, 'two holes', 'POLYGON((0 0,9 0,9 9,0 9,0 0),(1 1,2 1,2 2,1 2,1 1),(7 7,8 7,8 8,7 8,7 7))'),
	(8, 'two parts', 'MULTIPOLYGON(((0 0,10 0,10 10,0 10,0 0)),((20 0,30 0,30 10,20 10,20 0)))'),
	(9, 'two parts, one hole', 'MULTIPOLYGON(((0 0,9 0,9 9,0 9,0 0),(1 1,4 1,4 4,1 4,1 1)),((20 0,29 0,29 9,20 9,20 0)))'),
	(10, 'Z', 'POLYGON Z((0 0 7,20 0 8,20 10 9,0 10 8,0 0 7))'),
	(11, 'M', 'POLYGON M((0 0 7,20 0 8,20 10 9,0 10 8,0 0 7))'),
	(12, 'ZM', 'MULTIPOLYGON ZM(((0 0 7 1,20 0 8 1,20 10 9 1,0 10 8 1,0 0 7 1)))'),
	(13, 'empty part', 'MULTIPOLYGON(EMPTY,((0 0,20 0,20 10,0 10,0 0)))'),
	(14, 'L', 'POLYGON((0 0,20 0,20 5,5 5,5 20,0 20,0 0))')
) AS input (number, what, geom) ORDER BY number;

-- centroids and areas are those of PostGIS
CREATE FUNCTION pg_temp.alone(geom geometry) RETURNS typify_placeholder LANGUAGE sql AS
$$
	SELECT (typify_placeholders(g, 1, 25000))[1] FROM (VALUES (geom)) AS b (g)
$$;
SELECT count(*), max(abs((p).area - ST_Area(geom))) < 1e-9 AS same_area,
	   max(ST_Distance(ST_Centroid((p).geom), ST_Centroid(geom))) < 1e-9 AS same_centroid
FROM (SELECT geom, pg_temp.alone(geom) AS p
	  FROM (SELECT ST_Buffer(ST_MakePoint(i, i * i % 17), 1 + i % 5, i % 4 + 1) AS geom FROM generate_series(1, 50) AS i) AS b) AS q;

-- what has no area has no size, but a place: joined with a square it moves the placeholder
SELECT what, p.member_count, ST_AsText(ST_Centroid(p.geom), 3) AS centre
FROM (VALUES
	(1, 'point', 'POINT(100 0)'),
	(2, 'points', 'MULTIPOINT((90 0),(110 0),(100 30))'),
	(3, 'line', 'LINESTRING(90 0,110 0,110 20)'),
	(4, 'lines', 'MULTILINESTRING((90 0,110 0),(0 100,0 140))'),
	(5, 'flat polygon', 'POLYGON((90 0,110 0,90 0,90 0))'),
	(6, 'polygon of one point', 'POLYGON((100 0,100 0,100 0,100 0))'),
	(7, 'line of one point', 'LINESTRING(100 0,100 0)')
) AS input (number, what, geom),
LATERAL (SELECT typify_placeholders(g, i, 25000, 0, typify_options(count => 1)) AS list
		 FROM (VALUES (1, geom::geometry), (2, 'POLYGON((-1 -1,1 -1,1 1,-1 1,-1 -1))')) AS b (i, g)) AS l,
unnest(l.list) AS p ORDER BY number;

-- alone they are a row without geom, and nothing in the collection
SELECT id, geom, member_count, members, area, width, length
FROM unnest((SELECT typify_placeholders(geom, id, 25000) FROM (VALUES (1, 'POINT(0 0)'::geometry), (2, 'LINESTRING(5 5,6 6)')) AS b (id, geom)));
SELECT ST_AsText(typify(geom, 25000)) FROM (VALUES ('POINT(0 0)'::geometry), ('LINESTRING(5 5,6 6)')) AS b (geom);
SELECT ST_AsText(typify('SRID=2056;POINT(0 0)'::geometry, 25000)), ST_SRID(typify('SRID=2056;POINT(0 0)'::geometry, 25000));
SELECT ST_AsText(typify(geom, 25000)) FROM (VALUES ('POINT(0 0)'::geometry), ('POLYGON((5 5,6 5,6 6,5 6,5 5))')) AS b (geom);

-- invalid polygons work; a centroid outside of the box is replaced by the box's centre
SELECT what, pg_temp.measured(geom::geometry)
FROM (VALUES
	(1, 'clockwise', 'POLYGON((0 0,0 10,20 10,20 0,0 0))'),
	(2, 'repeated points', 'POLYGON((0 0,0 0,20 0,20 0,20 10,0 10,0 10,0 0))'),
	(3, 'hole wound like the shell', 'POLYGON((0 0,10 0,10 10,0 10,0 0),(1 1,1 4,4 4,4 1,1 1))'),
	(4, 'bow-tie of unequal wings', 'POLYGON((0 0,10 10,10 0,0 4,0 0))'),
	(5, 'bow-tie with a far centroid', 'POLYGON((0 0,10 10,10 0,0 10.1,0 0))'),
	(6, 'spike', 'POLYGON((0 0,10 0,10 10,5 10,5 30,5 10,0 10,0 0))')
) AS input (number, what, geom) ORDER BY number;

-- NULL and EMPTY are passed over; a group of nothing else is NULL
SELECT ST_AsText(typify(geom, 25000)) FROM (VALUES (NULL::geometry), ('POLYGON EMPTY'), ('POLYGON((0 0,2 0,2 2,0 2,0 0))'),
	('MULTIPOLYGON EMPTY'), ('GEOMETRYCOLLECTION EMPTY'), ('POINT EMPTY'), ('CURVEPOLYGON EMPTY'), ('TIN EMPTY'),
	('GEOMETRYCOLLECTION(POINT EMPTY,GEOMETRYCOLLECTION(LINESTRING EMPTY))')) AS b (geom);
SELECT typify(geom, 25000), typify_placeholders(geom, 1, 25000) FROM (VALUES (NULL::geometry), ('POLYGON EMPTY')) AS b (geom);
SELECT typify(geom, 25000), typify_placeholders(geom, 1, 25000) FROM (SELECT NULL::geometry AS geom LIMIT 0) AS b;
SELECT what, typify_cluster(geom, 25000) OVER () FROM (VALUES ('null', NULL::geometry), ('empty', 'POLYGON EMPTY'),
	('square', 'POLYGON((0 0,2 0,2 2,0 2,0 0))')) AS b (what, geom) ORDER BY what;

-- other types, numbers that are none
SELECT geom, pg_temp.error_of(format('SELECT typify(%L::geometry, 25000)', geom))
FROM (VALUES
	(1, 'CURVEPOLYGON(CIRCULARSTRING(0 0,4 0,4 4,0 4,0 0))'),
	(2, 'CIRCULARSTRING(0 0,1 1,2 0)'),
	(3, 'COMPOUNDCURVE(CIRCULARSTRING(0 0,1 1,2 0),(2 0,3 0))'),
	(4, 'MULTICURVE((0 0,5 5),CIRCULARSTRING(4 0,4 4,8 4))'),
	(5, 'MULTISURFACE(((0 0,1 0,1 1,0 0)))'),
	(6, 'POLYHEDRALSURFACE(((0 0 0,0 0 1,0 1 1,0 1 0,0 0 0)))'),
	(7, 'TIN(((0 0 0,0 0 1,0 1 0,0 0 0)))'),
	(8, 'TRIANGLE((0 0,0 9,9 0,0 0))'),
	(9, 'GEOMETRYCOLLECTION(POLYGON((0 0,1 0,1 1,0 0)))'),
	(10, 'POINT(NaN 0)'),
	(11, 'POLYGON((0 0,1e200 0,1e200 1e200,0 1e200,0 0))')
) AS input (number, geom) ORDER BY number;
SELECT pg_temp.error_of('SELECT typify(ST_MakeLine(ST_MakePoint(0, 0), ST_MakePoint(1, ''-Infinity'')), 25000)');
SELECT pg_temp.error_of('SELECT typify(ST_MakePolygon(ST_MakeLine(ARRAY[ST_MakePoint(0, 0), ST_MakePoint(9, 0), ST_MakePoint(''Infinity'', 9), ST_MakePoint(0, 0)])), 25000)');
SELECT pg_temp.error_of('SELECT typify_placeholders(ST_MakePoint(1, ''NaN''), 1, 25000)');
SELECT pg_temp.error_of('SELECT typify_cluster(ST_MakePoint(''Infinity'', 1), 25000) OVER ()');
-- NaN in Z or M does not matter
SELECT pg_temp.measured(ST_Force3D('POLYGON((0 0,2 0,2 2,0 2,0 0))', 'NaN'));

-- ids
SELECT pg_temp.error_of($$SELECT typify_placeholders('POINT(0 0)'::geometry, NULL, 25000)$$);
SELECT pg_temp.error_of($$SELECT typify_placeholders(ST_MakePoint(i, 0), i / 2, 25000) FROM generate_series(-3, 3) AS i$$);
SELECT p.id, p.members FROM unnest((SELECT typify_placeholders(ST_Expand(ST_MakePoint(0, 0), id % 3 + 2), id, 25000, 0, typify_options(count => 1))
	FROM (VALUES (9223372036854775807), (-9223372036854775808), (0), (-1)) AS b (id))) AS p;
-- a row without geometry needs no id
SELECT typify_placeholders(NULL::geometry, NULL, 25000);
