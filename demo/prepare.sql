-- prepare.sql: what the demo's tables and pictures share

CREATE INDEX ON buildings USING gist (geom);
CREATE INDEX ON demo.road USING gist (geom);
ANALYZE buildings;
ANALYZE demo.road;

CREATE TABLE demo.scale (scale double precision PRIMARY KEY);
INSERT INTO demo.scale VALUES (50000), (75000), (100000), (200000);

CREATE TABLE demo.result (scale double precision, grouped_by text, placeholders bigint, milliseconds double precision,
	area double precision, geom geometry);

CREATE TABLE demo.picture (number serial, name text, caption text);

-- Which roads a map of this scale has room for
CREATE FUNCTION demo.roads(at_scale double precision, frame geometry) RETURNS geometry LANGUAGE sql STABLE
BEGIN ATOMIC
	SELECT ST_Collect(geom) FROM demo.road
	WHERE geom && frame
		AND (class = 'main' OR class = 'residential' AND at_scale <= 100000 OR class = 'track' AND at_scale <= 75000);
END;

CREATE FUNCTION demo.buildings(frame geometry) RETURNS geometry LANGUAGE sql STABLE
BEGIN ATOMIC
	SELECT ST_Collect(geom ORDER BY id) FROM public.buildings WHERE geom && frame;
END;

-- The whole when its map at this scale fits into width x height millimetres and has not too many buildings for
-- a picture; else the window with the most buildings, among the whole, half and quarter of that size.
CREATE FUNCTION demo.densest(at_scale double precision, width double precision, height double precision)
RETURNS geometry LANGUAGE sql STABLE
BEGIN ATOMIC
	WITH extent AS (
		SELECT ST_Extent(geom) AS box, min(ST_SRID(geom)) AS srid FROM public.buildings
	), metre AS MATERIALIZED (
		SELECT box, srid, at_scale / 1000 / typify_metres_per_unit(srid) AS unit FROM extent
	), size AS MATERIALIZED (
		SELECT srid, share, ST_XMin(box) - 1.5 * unit AS x0, ST_YMin(box) - 1.5 * unit AS y0,
			least(width * unit * share, ST_XMax(box) - ST_XMin(box) + 3 * unit) AS w,
			least(height * unit * share, ST_YMax(box) - ST_YMin(box) + 3 * unit) AS h
		FROM metre, unnest(ARRAY[1, 0.5, 0.25, 0.125]) AS share
	), cell AS (
		SELECT share, srid, w, h, x0, y0,
			floor((ST_XMin(geom) - x0) / w * 3) AS i, floor((ST_YMin(geom) - y0) / h * 3) AS j, count(*) AS n
		FROM size, public.buildings
		GROUP BY share, srid, w, h, x0, y0, i, j
	), best AS (
		SELECT share, srid, w, h, x0 + (i - di) * w / 3 AS x, y0 + (j - dj) * h / 3 AS y, sum(n) AS total
		FROM cell, generate_series(0, 2) AS di, generate_series(0, 2) AS dj
		GROUP BY share, srid, w, h, x0, y0, i - di, j - dj
	), dense AS (
		SELECT DISTINCT ON (share) share, srid, x, y, w, h, total FROM best ORDER BY share, total DESC, x DESC, y DESC
	)
	SELECT ST_MakeEnvelope(x, y, x + w, y + h, srid) FROM dense
	WHERE total <= 25000 OR share = 0.125
	ORDER BY share DESC LIMIT 1;
END;

-- What the pictures show: before and after at each scale, and (scale 0) the sheets
CREATE TABLE demo.frame AS
SELECT scale, demo.densest(scale, 110, 90) AS frame FROM demo.scale
UNION ALL
SELECT 0, demo.densest(50000, 84, 64);

-- One panel at its place on a sheet: buildings alone for the source scale, else placeholders
CREATE FUNCTION demo.panel(buildings geometry, placeholders geometry, at_scale double precision, frame geometry,
	title text, drawn_at double precision DEFAULT NULL) RETURNS text LANGUAGE sql STABLE
BEGIN ATOMIC
	SELECT typify_svg(buildings, placeholders, at_scale,
		demo.roads(least(at_scale, coalesce(drawn_at, at_scale)), frame), title,
		coalesce(at_scale / drawn_at, 1), frame);
END;

-- The five panels of a sheet, 1:25 000 to the smallest scale, of all buildings or of those in one block
CREATE FUNCTION demo.five(frame geometry, drawn_at double precision DEFAULT NULL) RETURNS text[] LANGUAGE sql STABLE
BEGIN ATOMIC
	SELECT demo.panel(demo.buildings(frame), NULL, 25000, frame, NULL, drawn_at)
		|| array_agg(demo.panel(NULL, geom, scale, frame, NULL, drawn_at) ORDER BY scale)
	FROM demo.result WHERE grouped_by = '';
END;
