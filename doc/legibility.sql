-- legibility.sql: the pictures and figures of doc/legibility.md, of one place.
--
-- Needs buildings(id, class, geom), roads(class, geom) and scene(name, scale, magnify, frame), tables or views, and the
-- setting legibility.attribution. The views main_roads and important say what the map shows as wide lines, and which
-- buildings have to stay.

CREATE VIEW main_roads AS SELECT geom FROM roads WHERE class ~ '^(main|motorway|trunk|primary|secondary)';
CREATE VIEW small_roads AS SELECT geom FROM roads WHERE class ~ '^(residential|unclassified|tertiary|minor)';
CREATE VIEW important AS SELECT id, geom FROM buildings WHERE class IN ('church', 'cathedral', 'castle', 'school', 'town hall');
CREATE VIEW source AS
SELECT b.id, b.geom, CASE WHEN i.id IS NULL THEN 1 ELSE 'Infinity'::float8 END AS worth
FROM buildings AS b LEFT JOIN important AS i USING (id);
CREATE VIEW axes AS
SELECT (r).number, ST_MakeLine(ST_Centroid(geom) ORDER BY (r).place) AS geom
FROM (SELECT geom, typify_rows(geom) OVER () AS r FROM buildings) AS b WHERE (r).place IS NOT NULL GROUP BY 1;

-- the layers: how each limitation looks, and what is done about it
CREATE TABLE layers (picture text, remedy boolean, title text, scale float8, id bigint, geom geometry, members bigint[], area float8, width float8);
CREATE FUNCTION derive(picture text, remedy boolean, words text, options typify_options DEFAULT NULL, weighted boolean DEFAULT false)
RETURNS void LANGUAGE sql AS
$$
	INSERT INTO layers
	SELECT name, remedy, words, scale, p.id, p.geom, p.members, p.area, p.width
	FROM scene, LATERAL (
		SELECT typify_placeholders(geom, id, scale, 0.5, options, CASE WHEN weighted THEN worth ELSE 1 END) AS list FROM source) AS t, unnest(list) AS p
	WHERE name = picture
$$;
CREATE VIEW all_main_roads AS SELECT ST_Collect(geom) AS geom FROM main_roads;
SELECT count(derive(name, false, 'Without')) AS without FROM scene;
SELECT derive('rows', true, 'With alignment', typify_options(alignment => 5)) AS rows;
SELECT derive('important', true, 'With importance, keep_area', typify_options(keep_area => 0.5), true) AS important;
SELECT derive('sizes', true, 'With min_side, keep_area', typify_options(min_side => 0.35, keep_area => 0.5)) AS sizes;
SELECT derive('gaps', true, 'With min_gap, barriers',
	typify_options(min_side => 0.35, min_gap => 0.2, barriers => geom, barrier_width => 0.5)) AS gaps FROM all_main_roads;
SELECT derive('all', true, 'With all of it', typify_options(alignment => 5, keep_area => 0.5, min_side => 0.35, min_gap => 0.2,
	barriers => geom, barrier_width => 0.5), true) AS all_of_it FROM all_main_roads;

-- ---- the figures, over all of the place ----

CREATE FUNCTION figures(wanted text, wanted_remedy boolean) RETURNS text LANGUAGE plpgsql AS
$$
DECLARE
	q record;
	words text[];
BEGIN
	CREATE TEMP TABLE judged ON COMMIT DROP AS SELECT * FROM layers WHERE picture = wanted AND remedy = wanted_remedy;
	SELECT typify_quality.* INTO q
	FROM scene, typify_quality('source', 'judged', scale, barriers => 'main_roads', barrier_width => 0.5) WHERE name = wanted;
	words := ARRAY[format('%s of %s placeholders', q.reached, q.asked)];
	IF wanted IN ('rows', 'all') THEN
		words := words || format('%s %% of the rows kept', round(100 * q.rows_kept));
	END IF;
	IF wanted IN ('important', 'all') THEN
		words := words || (SELECT format('%s of %s important buildings in place and in size', count(j.id), count(*))
			FROM important AS i LEFT JOIN judged AS j ON j.id = i.id AND ST_Distance(ST_Centroid(j.geom), ST_Centroid(i.geom)) < 0.01
				-- as large as it is or, where it is narrower than what can be seen, as wide as that
				AND (abs(ST_Area(j.geom) / ST_Area(i.geom) - 1) < 0.001
					OR wanted = 'all' AND ST_Area(j.geom) > ST_Area(i.geom) AND abs(j.width / (0.35 * j.scale / 1000) - 1) < 1e-6));
	END IF;
	IF wanted IN ('sizes', 'all') THEN
		words := words || format('%s narrower than 0.35 mm', q.short_sides) || (
			SELECT format('the largest twentieth is %s %% of the ink', round(100 * sum(area) FILTER (WHERE place <= number / 20.0) / sum(area)))
			FROM (SELECT area, row_number() OVER (ORDER BY area DESC) AS place, count(*) OVER () AS number
				FROM judged WHERE geom IS NOT NULL) AS ranked);
	END IF;
	IF wanted IN ('gaps', 'all') THEN
		words := words || format('%s overlaps', q.overlapping) || format('%s gaps below 0.2 mm', q.narrow_gaps)
			|| format('%s on a main road or too near', q.barrier_crossings + q.barrier_gaps);
	END IF;
	DROP TABLE judged;
	RETURN array_to_string(words, ', ');
END
$$;

-- ---- the pictures ----

CREATE FUNCTION inside(frame geometry, query text) RETURNS geometry LANGUAGE plpgsql AS
$$
DECLARE
	found geometry;
BEGIN
	EXECUTE format('SELECT ST_Collect(geom) FROM (%s) AS t WHERE geom && $1', query) INTO found USING frame;
	RETURN found;
END
$$;

-- buildings, the layer without and the layer with the remedy; blue: what is to be kept, rows or outlines
CREATE FUNCTION panel(wanted text, title text, query text, is_result boolean) RETURNS text LANGUAGE sql AS
$$
	SELECT typify_svg(CASE WHEN NOT is_result THEN geom END, CASE WHEN is_result THEN geom END, scale, inside(frame, 'SELECT geom FROM small_roads'), title, magnify, frame,
		barriers => inside(frame, 'SELECT geom FROM main_roads'), barrier_width => 0.5,
		rows => CASE WHEN wanted = 'rows' THEN inside(frame, 'SELECT geom FROM axes') WHEN wanted IN ('important', 'all') THEN inside(frame, 'SELECT ST_Boundary(geom) AS geom FROM important') END,
		min_gap => CASE WHEN wanted IN ('gaps', 'all') AND is_result THEN 0.2 END)
	FROM scene, inside(frame, query) AS geom WHERE name = wanted
$$;
CREATE FUNCTION picture(wanted text) RETURNS text LANGUAGE sql AS
$$
	SELECT typify_svg_sheet(ARRAY[panel(wanted, 'Buildings', 'SELECT geom FROM buildings', false)]
		|| array_agg(panel(wanted, title, format('SELECT geom FROM layers WHERE picture = %L AND remedy = %L', wanted, remedy), true) ORDER BY remedy),
		3, attribution => nullif(current_setting('legibility.attribution'), ''))
	FROM (SELECT DISTINCT title, remedy FROM layers WHERE picture = wanted) AS both_layers
$$;
