-- the coarse layer of the shipped settlement: the same bytes everywhere, sound as data, and plausibly coarser
\set ECHO none
\i tests/data/settlement.sql
\i tests/data/settlement_lod200.sql
\set ECHO all

-- the same on every machine
SELECT count(*) AS objects,
	md5(string_agg(concat_ws(' ', id, class, encode(ST_AsEWKB(geom, 'NDR'), 'hex')), ',' ORDER BY id))
FROM settlement_lod200;

-- what is drawn: fewer and larger than on the detailed map
SELECT class, count(*), round(min(ST_Area(geom))) AS smallest, round(avg(ST_Area(geom))) AS mean,
	round(max(ST_Area(geom))) AS largest
FROM settlement_lod200 GROUP BY class ORDER BY count(*) DESC, class;
SELECT count(*) AS lod25, (SELECT count(*) FROM settlement_lod200) AS lod200,
	round(avg(ST_Area(geom))) AS mean_area25, (SELECT round(avg(ST_Area(geom))) FROM settlement_lod200) AS mean_area200
FROM settlement_buildings;

-- what would spoil it: nothing of this is there
SELECT count(*) AS invalid FROM settlement_lod200 WHERE NOT ST_IsValid(geom);
SELECT count(*) AS too_near
FROM settlement_lod200 AS a JOIN settlement_lod200 AS b ON a.id < b.id AND ST_DWithin(a.geom, b.geom, 10);
SELECT count(*) AS far_from_every_building FROM settlement_lod200 AS coarse
WHERE NOT EXISTS (SELECT FROM settlement_buildings AS fine WHERE ST_DWithin(coarse.geom, fine.geom, 20));

-- blocks as groups: none has more coarse objects than buildings; some have none
WITH placed AS (
	SELECT block, count(*) AS n200
	FROM settlement_lod200 AS coarse, LATERAL (
		SELECT block FROM settlement_buildings AS fine ORDER BY fine.geom <-> coarse.geom, fine.id LIMIT 1) AS nearest
	GROUP BY block
)
SELECT count(*) AS blocks, count(*) FILTER (WHERE n200 IS NULL) AS without,
	count(*) FILTER (WHERE n200 > n25) AS with_more
FROM (SELECT block, count(*) AS n25 FROM settlement_buildings GROUP BY block) AS fine LEFT JOIN placed USING (block);

DROP VIEW hamlet;
DROP TABLE settlement_buildings, settlement_roads, settlement_blocks, settlement_lod200;
