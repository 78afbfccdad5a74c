-- landscape.sql: tables buildings and roads of 25 towns, so that small scales have something to show: the sample
-- settlement, its touching parts joined, and around it copies that are turned or mirrored, most without some of their blocks.
CREATE TABLE buildings (id bigint PRIMARY KEY, class text, geom geometry(MultiPolygon, 25832));
CREATE TABLE roads (class text, geom geometry(LineString, 25832));

CREATE TEMP TABLE towns AS
SELECT number, column_, row_, CASE number WHEN 0 THEN 0 ELSE number * 7 % 4 END AS quarter_turns,
	CASE WHEN number % 3 = 1 THEN -1 ELSE 1 END AS mirror,
	4800 * column_ + CASE number WHEN 0 THEN 0 ELSE number * 211 % 700 END AS x,
	4500 * row_ + CASE number WHEN 0 THEN 0 ELSE number * 379 % 500 END AS y
FROM generate_series(-2, 2) AS column_, generate_series(-2, 2) AS row_,
	LATERAL (SELECT ((column_ + 5) % 5) * 5 + (row_ + 5) % 5 AS number) AS n;

CREATE FUNCTION pg_temp.moved(geom geometry, town towns) RETURNS geometry LANGUAGE sql AS $$
	SELECT ST_Translate(ST_Affine(geom, town.mirror * c, -s, town.mirror * s, c,
			centre_x - town.mirror * c * centre_x + s * centre_y, centre_y - town.mirror * s * centre_x - c * centre_y),
		town.x, town.y)
	FROM (SELECT round(cos(town.quarter_turns * pi() / 2)) AS c, round(sin(town.quarter_turns * pi() / 2)) AS s,
		614000::float8 AS centre_x, 5487500::float8 AS centre_y) AS turn
$$;

CREATE TEMP TABLE joined AS
SELECT d.id, b.class, b.block, d.geom FROM typify_dissolve_table('settlement_buildings', 0.5) AS d
JOIN settlement_buildings AS b USING (id);
INSERT INTO buildings
SELECT t.number * 10000 + b.id, b.class, ST_Multi(pg_temp.moved(b.geom, t))
FROM towns AS t, joined AS b
WHERE t.number = 0 OR (t.number * 31 + b.block * 17) % 5 > 0 AND (t.number % 4 <> 3 OR b.block % 3 > 0);
INSERT INTO roads SELECT r.class, pg_temp.moved(r.geom, t) FROM towns AS t, settlement_roads AS r;
CREATE INDEX ON buildings USING gist (geom);
ANALYZE buildings;
