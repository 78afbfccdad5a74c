-- figures.sql: the paper's Figures 8, 9 and 11 from the shipped settlement, the picture of the README, and rows

\pset format unaligned
\pset tuples_only on

-- Figures 8 and 9: a hamlet of 41 buildings
CREATE TABLE demo.hamlet AS
SELECT 25000::double precision AS scale, ST_Collect(geom ORDER BY id) AS geom FROM hamlet
UNION ALL
SELECT scale, typify(geom, scale, 0.5) FROM hamlet, demo.scale GROUP BY scale;

CREATE FUNCTION demo.hamlet_sheet(title text, drawn_at double precision DEFAULT NULL) RETURNS text LANGUAGE sql STABLE
BEGIN ATOMIC
	SELECT typify_svg_sheet(array_agg(demo.panel(
		CASE scale WHEN 25000 THEN geom END, CASE scale WHEN 25000 THEN NULL ELSE geom END, scale, frame, NULL,
		drawn_at) ORDER BY scale), 5, title)
	FROM demo.hamlet, (SELECT ST_Expand(ST_Envelope(ST_Collect(geom)), 40) AS frame FROM hamlet) AS around;
END;

\set file :out '/figure-8-hamlet.svg'
SELECT demo.hamlet_sheet('A hamlet, the same ground at every scale', 10000) \g :file
\set file :out '/figure-9-hamlet-true-size.svg'
SELECT demo.hamlet_sheet('The hamlet at true map size') \g :file

\pset format aligned
\pset tuples_only off
\pset title 'The hamlet (paper, Figure 8: 20, 13, 10 and 5 of 41)'
SELECT '1:' || typify_svg_number(scale) AS scale, ST_NumGeometries(geom) AS drawn
FROM demo.hamlet ORDER BY hamlet.scale;
\pset title
\pset format unaligned
\pset tuples_only on

-- Figure 11: a quarter of houses in which every 29th was replaced by a market hall and its neighbours made room.
-- The mean blows a house up when a hall is among those it stands for; the median follows the many, the sum the ink.
CREATE TABLE demo.mixed AS
WITH quarter AS (
	SELECT id, geom FROM buildings
	WHERE class = 'house' AND geom && ST_MakeEnvelope(614220, 5487830, 614720, 5488290, 25832)
), hall AS (
	SELECT id, ST_Buffer(geom, 10, 'join=mitre mitre_limit=2') AS geom FROM quarter WHERE id % 29 = 0
)
SELECT id, geom FROM hall
UNION ALL
SELECT id, geom FROM quarter WHERE NOT EXISTS (SELECT FROM hall WHERE ST_DWithin(hall.geom, quarter.geom, 4));

CREATE TABLE demo.statistic AS
SELECT place, statistic, typify(geom, 100000, 0, typify_options(area_statistic => statistic)) AS geom
FROM demo.mixed, unnest(ARRAY['mean', 'median', 'sum']) WITH ORDINALITY AS given(statistic, place)
GROUP BY place, statistic;

\set file :out '/figure-11-statistics.svg'
SELECT typify_svg_sheet(demo.panel(mixed.buildings, NULL, 100000, frame, 'buildings', 12500)
		|| ARRAY(SELECT demo.panel(NULL, geom, 100000, frame, statistic, 12500) FROM demo.statistic ORDER BY place),
	4, 'Halls among houses: the statistic of the areas')
FROM (SELECT ST_Collect(geom ORDER BY id) AS buildings, ST_Expand(ST_Envelope(ST_Collect(geom)), 60) AS frame
	  FROM demo.mixed) AS mixed \g :file

\pset format aligned
\pset tuples_only off
\pset title 'Halls among houses at 1:100 000 (paper, Figure 11): areas in square metres'
SELECT statistic, count(*) AS placeholders, round(sum(ST_Area(part.geom))) AS total,
	round(max(ST_Area(part.geom))) AS largest
FROM demo.statistic, ST_Dump(statistic.geom) AS part GROUP BY place, statistic ORDER BY place;
\pset title
\pset format unaligned
\pset tuples_only on

INSERT INTO demo.picture (name, caption) VALUES
	('figure-8-hamlet', '41 buildings become 20, 13, 10 and 5 (paper, Figure 8)'),
	('figure-9-hamlet-true-size', 'the same at true map size (paper, Figure 9)'),
	('figure-11-statistics', 'large buildings among small ones: mean, median, sum (paper, Figure 11)'),
	('settlement', 'the picture of the README'),
	('rows', 'rows of houses: what is found, and 1:75 000 without and with alignment => 4');

\set file :out '/settlement.svg'
SELECT typify_svg(demo.buildings(frame), (SELECT typify(geom, 75000, 0.5) FROM buildings), 75000,
	demo.roads(75000, frame), magnify => 4, frame => frame)
FROM (SELECT ST_MakeEnvelope(613240, 5487020, 614340, 5488270, 25832) AS frame) AS window_ \g :file

\set file :out '/rows.svg'
SELECT typify_svg_sheet(ARRAY[
		typify_svg(demo.buildings(frame), NULL, 75000, rows => (
				SELECT ST_Collect(axis) FROM (
					SELECT ST_MakeLine(ST_Centroid(geom) ORDER BY (r).place) AS axis
					FROM (SELECT geom, typify_rows(geom) OVER () AS r FROM buildings) AS found
					WHERE r IS NOT NULL GROUP BY (r).number) AS axes),
			title => 'rows', magnify => 5, frame => frame),
		typify_svg(NULL, (SELECT typify(geom, 75000, 0) FROM buildings), 75000,
			demo.roads(75000, frame), title => 'plain', magnify => 5, frame => frame),
		typify_svg(NULL, (SELECT typify(geom, 75000, 0, typify_options(alignment => 4)) FROM buildings), 75000,
			demo.roads(75000, frame), title => 'alignment => 4', magnify => 5, frame => frame)], 3)
FROM (SELECT ST_MakeEnvelope(613240, 5487620, 613840, 5488270, 25832) AS frame) AS window_ \g :file
