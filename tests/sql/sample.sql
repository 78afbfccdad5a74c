-- the shipped settlement: the same bytes everywhere, sound as data, and typified at four scales
\set ECHO none
\i tests/data/settlement.sql
\set ECHO all

-- the same on every machine
SELECT count(*) AS buildings,
	md5(string_agg(concat_ws(' ', id, class, block, row_id, encode(ST_AsEWKB(geom, 'NDR'), 'hex')), ',' ORDER BY id))
FROM settlement_buildings;
SELECT count(*) AS roads,
	md5(string_agg(concat_ws(' ', id, class, encode(ST_AsEWKB(geom, 'NDR'), 'hex')), ',' ORDER BY id))
FROM settlement_roads;
SELECT count(*) AS blocks, round(sum(ST_Area(geom))) AS area FROM settlement_blocks;

-- what stands there
SELECT class, count(*), round(min(ST_Area(geom))) AS smallest, round(max(ST_Area(geom))) AS largest
FROM settlement_buildings GROUP BY class ORDER BY count(*) DESC, class;
SELECT class, count(*), round(sum(ST_Length(geom))) AS metres FROM settlement_roads GROUP BY class ORDER BY class;
SELECT count(DISTINCT row_id) AS rows, count(row_id) AS houses_in_rows FROM settlement_buildings;
SELECT count(*) AS hamlet FROM hamlet;

-- what would spoil it: nothing of this is there
SELECT count(*) AS invalid FROM settlement_buildings WHERE NOT ST_IsValid(geom) OR ST_Area(geom) < 5;
SELECT count(*) AS overlapping
FROM settlement_buildings AS a JOIN settlement_buildings AS b ON a.id < b.id AND a.geom && b.geom
WHERE ST_Intersects(a.geom, b.geom) AND ST_Area(ST_Intersection(a.geom, b.geom)) > 0.05;
SELECT count(*) AS on_a_road
FROM settlement_buildings AS b JOIN settlement_roads AS r ON ST_DWithin(b.geom, r.geom, 3.4);
SELECT count(*) AS without_block FROM settlement_buildings AS b
WHERE NOT EXISTS (
	SELECT FROM settlement_blocks AS s WHERE s.id = b.block AND ST_Contains(s.geom, ST_PointOnSurface(b.geom)));

-- typified: the settlement as one group, block by block, and the hamlet (paper, Figure 8)
SELECT scale,
	(SELECT ST_NumGeometries(typify(geom, scale, 0.5)) FROM settlement_buildings) AS settlement,
	(SELECT sum(ST_NumGeometries(block))
	 FROM (SELECT typify(geom, scale, 0.5) AS block FROM settlement_buildings GROUP BY block) AS b) AS by_block,
	(SELECT ST_NumGeometries(typify(geom, scale)) FROM hamlet) AS hamlet,
	(SELECT ST_NumGeometries(typify(geom, scale, 0, typify_options(exponent => 1))) FROM hamlet) AS hamlet_exponent_1
FROM unnest(ARRAY[50000, 75000, 100000, 200000]) AS scale ORDER BY scale;

DROP VIEW hamlet;
DROP TABLE settlement_buildings, settlement_roads, settlement_blocks;
