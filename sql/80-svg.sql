-- Pictures: buildings before and after at true map size, as SVG.
--
-- Lengths inside a picture are millimetres on paper. Panels and pictures on a sheet are nested <svg>
-- elements: each clips to its own box and needs no ids. Text is ASCII but for what the caller hands in.

CREATE FUNCTION typify_svg_number(number double precision) RETURNS text
LANGUAGE sql IMMUTABLE STRICT PARALLEL SAFE
RETURN replace(to_char(number, 'FM999,999,999,999'), ',', ' ');
COMMENT ON FUNCTION typify_svg_number(double precision) IS 'A whole number as maps print it: 75 000';

CREATE FUNCTION typify_svg_escape(words text) RETURNS text
LANGUAGE sql IMMUTABLE STRICT PARALLEL SAFE
RETURN regexp_replace(
	replace(replace(replace(replace(words, '&', '&amp;'), '<', '&lt;'), '>', '&gt;'), '"', '&quot;'),
	'[\x01-\x08\x0b\x0c\x0e-\x1f]', ' ', 'g');
COMMENT ON FUNCTION typify_svg_escape(text) IS
'Text made safe for XML; control characters, which XML has no place for, become spaces';

CREATE FUNCTION typify_svg_text(x double precision, y double precision, size double precision, words text,
	style text DEFAULT '') RETURNS text
LANGUAGE sql IMMUTABLE STRICT PARALLEL SAFE
RETURN format('<text x="%s" y="%s" font-size="%s"%s>%s</text>' || E'\n',
	round(x::numeric, 2), round(y::numeric, 2), size, style, typify_svg_escape(words));
COMMENT ON FUNCTION typify_svg_text(double precision, double precision, double precision, text, text) IS
'A line of text for typify_svg; style is further SVG attributes';

CREATE FUNCTION typify_svg_paths(geom geometry, frame box2d, mm_per_unit double precision, line_style text DEFAULT '')
RETURNS text
LANGUAGE sql IMMUTABLE STRICT PARALLEL SAFE
BEGIN ATOMIC
	SELECT string_agg(CASE ST_Dimension(paper)
			WHEN 0 THEN format('<path d="M %s %s h 0" stroke="#1a1a1a" stroke-width="0.3"/>',
				round(ST_X(paper)::numeric, 3), round(-ST_Y(paper)::numeric, 3))
			WHEN 1 THEN format('<path d="%s"%s/>', ST_AsSVG(paper, 0, 3), line_style)
			ELSE format('<path d="%s"/>', ST_AsSVG(paper, 0, 3)) END, E'\n' ORDER BY path)
	FROM (SELECT part.path,
			ST_TransScale(ST_Force2D(part.geom), -ST_XMin(frame), -ST_YMax(frame), mm_per_unit, mm_per_unit) AS paper
		  FROM ST_Dump(geom) AS part
		  WHERE part.geom && frame::geometry AND NOT ST_IsEmpty(part.geom)) AS drawn;
END;
COMMENT ON FUNCTION typify_svg_paths(geometry, box2d, double precision, text) IS
'The parts of a geometry that meet the frame as SVG paths, in millimetres from its upper left corner;
line_style is further SVG attributes of lines';

CREATE FUNCTION typify_svg_scale_bar(x double precision, y double precision, room double precision,
	mm_per_metre double precision) RETURNS text
LANGUAGE sql IMMUTABLE STRICT PARALLEL SAFE
BEGIN ATOMIC
	SELECT format('<path d="M %s %s v 1.2 h %s v -1.2" fill="none" stroke="#333" stroke-width="0.2"/>' || E'\n',
			round(x::numeric, 2), round((y - 1.2)::numeric, 2), round((metres * mm_per_metre)::numeric, 3))
		|| typify_svg_text(x + metres * mm_per_metre + 1, y, 2.2, CASE
			WHEN metres >= 1000 THEN typify_svg_number(metres / 1000) || ' km'
			ELSE trim_scale(metres::numeric) || ' m' END)
	FROM (SELECT digit * power(10::numeric, exponent) AS metres
		  FROM generate_series(-3, 7) AS exponent, unnest(ARRAY[1, 2, 5]) AS digit) AS nice
	WHERE metres * mm_per_metre <= room
	ORDER BY metres DESC LIMIT 1;
END;
COMMENT ON FUNCTION typify_svg_scale_bar(double precision, double precision, double precision, double precision) IS
'A scale bar for typify_svg: the longest of 1, 2, 5, 10, ... metres that fits into the room';

CREATE FUNCTION typify_svg_count(geom geometry, frame box2d, word text) RETURNS text
LANGUAGE sql IMMUTABLE STRICT PARALLEL SAFE
BEGIN ATOMIC
	SELECT typify_svg_number(count(DISTINCT coalesce(path[1], 1))) || ' ' || word
		|| CASE WHEN count(DISTINCT coalesce(path[1], 1)) = 1 THEN '' ELSE 's' END
	FROM ST_Dump(geom) AS part
	WHERE part.geom && frame::geometry;
END;
COMMENT ON FUNCTION typify_svg_count(geometry, box2d, text) IS
'How many members of a collection meet the frame: 41 buildings';

CREATE FUNCTION typify_svg_layer(geom geometry, frame box2d, mm_per_unit double precision, colour text,
	width double precision, more text DEFAULT '') RETURNS text
LANGUAGE sql IMMUTABLE STRICT PARALLEL SAFE
RETURN format('<g fill="none" stroke="%s" stroke-width="%s" stroke-linecap="round" stroke-linejoin="round"%s>
%s
</g>
', colour, round(width::numeric, 3)::double precision, more, typify_svg_paths(geom, frame, mm_per_unit));
COMMENT ON FUNCTION typify_svg_layer(geometry, box2d, double precision, text, double precision, text) IS
'Lines for typify_svg; width in millimetres, more is further SVG attributes';

CREATE FUNCTION typify_svg_panel(x double precision, y double precision, frame box2d, mm_per_unit double precision,
	geom geometry, word text, style text, below text, above text) RETURNS text
LANGUAGE sql IMMUTABLE PARALLEL SAFE
BEGIN ATOMIC
	SELECT coalesce(typify_svg_text(x, y - 1.1, 2.3, typify_svg_count(geom, frame, word), ' fill="#555"'), '')
		|| format($svg$<svg x="%s" y="%s" width="%3$s" height="%4$s" viewBox="0 0 %3$s %4$s">
%5$s<g fill-rule="evenodd" stroke-linecap="round" %6$s>
%7$s
</g>
%8$s<rect width="%3$s" height="%4$s" fill="none" stroke="#888" stroke-width="0.3"/>
</svg>
$svg$, round(x::numeric, 2), round(y::numeric, 2), round((mm_per_unit * (ST_XMax(frame) - ST_XMin(frame)))::numeric, 2),
		round((mm_per_unit * (ST_YMax(frame) - ST_YMin(frame)))::numeric, 2), below, style,
		typify_svg_paths(geom, frame, mm_per_unit, ' fill="none" stroke="#1a1a1a" stroke-width="0.1"'), above);
END;
COMMENT ON FUNCTION typify_svg_panel(double precision, double precision, box2d, double precision, geometry, text, text,
	text, text) IS
'One framed map for typify_svg, its count above it; below and above: SVG of what lies under and over the buildings';

-- Marks are drawn wide enough to be seen: what violates a limit is smaller than the limit.
CREATE FUNCTION typify_svg_marks(after geometry, frame box2d, mm_per_unit double precision, min_gap double precision,
	OUT marks text, OUT words text)
LANGUAGE plpgsql IMMUTABLE STRICT PARALLEL SAFE
SET search_path FROM CURRENT
AS $$
DECLARE
	found record;
BEGIN
	SELECT ST_Collect(mark ORDER BY place) FILTER (WHERE kind = 'overlap') AS overlaps,
		ST_Collect(mark ORDER BY place) FILTER (WHERE kind = 'gap') AS gaps,
		count(*) FILTER (WHERE kind = 'overlap' AND mark && frame::geometry) AS overlap_count,
		count(*) FILTER (WHERE kind = 'gap' AND mark && frame::geometry) AS gap_count
	INTO found
	FROM typify_violations(after, min_gap) WITH ORDINALITY AS violation (kind, mark, place);
	marks := coalesce(typify_svg_layer(found.overlaps, frame, mm_per_unit, '#d62728', 0.2, ' style="fill:#d62728"'), '')
		|| coalesce(typify_svg_layer(found.gaps, frame, mm_per_unit, '#ff9f1c', 0.5), '');
	words := format('%s %s, %s %s too narrow', typify_svg_number(found.overlap_count),
		CASE found.overlap_count WHEN 1 THEN 'overlap' ELSE 'overlaps' END, typify_svg_number(found.gap_count),
		CASE found.gap_count WHEN 1 THEN 'gap' ELSE 'gaps' END);
END $$;
COMMENT ON FUNCTION typify_svg_marks(geometry, box2d, double precision, double precision) IS
'Marks for typify_svg over placeholders that overlap (red) or lie nearer to each other than min_gap, units of the SRID (orange), and how many of them the frame shows, in words';

CREATE FUNCTION typify_svg_document(width double precision, height double precision, content text) RETURNS text
LANGUAGE sql IMMUTABLE STRICT PARALLEL SAFE
RETURN format($svg$<svg xmlns="http://www.w3.org/2000/svg" width="%1$smm" height="%2$smm" viewBox="0 0 %1$s %2$s"
font-family="Helvetica, Arial, 'DejaVu Sans', sans-serif" fill="#222">
<rect width="%1$s" height="%2$s" fill="#fff"/>
%3$s</svg>
$svg$, round(width::numeric, 2), round(height::numeric, 2), content);
COMMENT ON FUNCTION typify_svg_document(double precision, double precision, text) IS
'A whole SVG picture on white paper from its content; sides in millimetres';

-- The box to show: what is asked for, else the content with a margin of 1.5 mm; never smaller than the least panel.
CREATE FUNCTION typify_svg_frame(wanted geometry, content geometry, mm_per_unit double precision) RETURNS box2d
LANGUAGE sql IMMUTABLE PARALLEL SAFE
BEGIN ATOMIC
	SELECT ST_Expand(box, greatest(margin, (34 / mm_per_unit - ST_XMax(box) + ST_XMin(box)) / 2),
		greatest(margin, (20 / mm_per_unit - ST_YMax(box) + ST_YMin(box)) / 2))
	FROM (SELECT Box2D(coalesce(wanted, content)) AS box,
			CASE WHEN wanted IS NULL THEN 1.5 / mm_per_unit ELSE 0 END AS margin) AS given;
END;
COMMENT ON FUNCTION typify_svg_frame(geometry, geometry, double precision) IS
'The box that typify_svg shows, at least 34 x 20 mm on paper';

CREATE FUNCTION typify_svg_check_geometry(geom geometry) RETURNS void
LANGUAGE plpgsql IMMUTABLE STRICT PARALLEL SAFE
SET search_path FROM CURRENT
AS $$
DECLARE
	-- what ST_AsSVG cannot write
	undrawn text := (
		SELECT max(CASE ST_GeometryType(part.geom) WHEN 'ST_Triangle' THEN 'triangles' ELSE 'curves' END)
		FROM ST_Dump(geom) AS part
		WHERE ST_GeometryType(part.geom) NOT IN ('ST_Point', 'ST_LineString', 'ST_Polygon'));
	-- their spelling is that of the C library
	wrong text := lower(substring(ST_AsText(ST_Force2D(geom), 0) FROM '(?i)-?nan|-?inf'));
BEGIN
	IF undrawn IS NOT NULL THEN
		RAISE EXCEPTION 'a % cannot be drawn: it has %', substr(ST_GeometryType(geom), 4), undrawn
			USING ERRCODE = '0A000', HINT = CASE undrawn
				WHEN 'triangles' THEN 'Use ST_MakePolygon(ST_ExteriorRing(geom)) on the triangles of ST_Dump.'
				ELSE 'Use ST_CurveToLine to turn curves into polygons and lines.' END;
	END IF;
	IF wrong IS NOT NULL THEN
		RAISE EXCEPTION 'a coordinate of the geometry is %, it must be a finite number',
			CASE WHEN wrong LIKE '%nan' THEN 'NaN' WHEN wrong LIKE '-%' THEN '-Infinity' ELSE 'Infinity' END
			USING ERRCODE = '22023', HINT = 'Leave such geometries out, or repair them.';
	END IF;
END $$;
COMMENT ON FUNCTION typify_svg_check_geometry(geometry) IS
'Refuses what typify_svg cannot draw: curves, triangles, coordinates that are no finite numbers';

CREATE FUNCTION typify_svg_check(scale double precision, magnify double precision, barrier_width double precision,
	min_gap double precision, geometries geometry[]) RETURNS integer
LANGUAGE plpgsql STABLE PARALLEL SAFE
SET search_path FROM CURRENT
AS $$
DECLARE
	srids integer[] := ARRAY(
		SELECT DISTINCT ST_SRID(given) FROM unnest(geometries) AS given
		WHERE given IS NOT NULL ORDER BY 1);
BEGIN
	IF scale IS NULL OR NOT (scale > 0 AND scale < 'Infinity') THEN
		RAISE EXCEPTION 'scale must be a positive number, not %', coalesce(scale::text, 'NULL')
			USING ERRCODE = '22023', HINT = 'Give the denominator: 75000 for a map at 1:75 000.';
	END IF;
	IF magnify IS NULL OR NOT (magnify > 0 AND magnify < 'Infinity') THEN
		RAISE EXCEPTION 'magnify must be a positive number, not %', coalesce(magnify::text, 'NULL')
			USING ERRCODE = '22023', HINT = '1 draws at true map size, 4 four times as large.';
	END IF;
	IF cardinality(srids) > 1 THEN
		RAISE EXCEPTION 'geometries have different SRIDs: % and %', srids[1], srids[2]
			USING ERRCODE = '22023', HINT = 'Bring them to one reference system with ST_Transform.';
	END IF;
	IF typify_metres_per_unit(srids[1]) = 'NaN' THEN
		RAISE EXCEPTION 'cannot draw geographic coordinates (SRID %) at map scale', srids[1]
			USING ERRCODE = '22023', HINT = 'Project them first with ST_Transform.';
	END IF;
	PERFORM typify_check_length(barrier_width, 'barrier_width', 'Give millimetres on the map; 0 is a thin line.'),
		typify_check_length(coalesce(min_gap, 0), 'min_gap', 'Give millimetres on the map; 0 marks overlaps alone.'),
		typify_svg_check_geometry(given) FROM unnest(geometries) AS given;
	RETURN srids[1];
END $$;
COMMENT ON FUNCTION typify_svg_check(double precision, double precision, double precision, double precision,
	geometry[]) IS
'Refuses arguments that typify_svg cannot draw; returns their SRID';

-- Counts stand above the panels, scale and scale bar below the first, violations below the placeholders; a lone panel is
-- drawn in black.
CREATE FUNCTION typify_svg(before geometry, after geometry, scale double precision, roads geometry DEFAULT NULL,
	title text DEFAULT NULL, magnify double precision DEFAULT 1, frame geometry DEFAULT NULL,
	attribution text DEFAULT NULL, barriers geometry DEFAULT NULL, barrier_width double precision DEFAULT 0,
	rows geometry DEFAULT NULL, min_gap double precision DEFAULT NULL) RETURNS text
LANGUAGE plpgsql STABLE PARALLEL SAFE
SET search_path FROM CURRENT
AS $$
DECLARE
	margin CONSTANT double precision := 4;
	black CONSTANT text := 'fill="#1a1a1a" fill-opacity="0.88"';
	grey CONSTANT text := 'fill="#9c9c9c" stroke="#5c5c5c" stroke-width="0.06"';
	srid integer := typify_svg_check(scale, magnify, barrier_width, min_gap,
		ARRAY[before, after, roads, frame, barriers, rows]);
	mm_per_metre double precision := 1000 / scale * magnify;
	mm_per_unit double precision := mm_per_metre * coalesce(typify_metres_per_unit(srid), 1);
	road_width double precision := greatest(0.15, least(0.35, round((0.2 * magnify)::numeric, 2)));
	shown box2d := typify_svg_frame(frame, coalesce(
		ST_Expand(Box2D(ST_Collect(ST_Envelope(before), ST_Envelope(after))), 0)::geometry, roads, barriers), mm_per_unit);
	panel_width double precision := mm_per_unit * (ST_XMax(shown) - ST_XMin(shown));
	y double precision := margin + CASE WHEN title IS NULL THEN 3 ELSE 8 END;
	bottom double precision := y + mm_per_unit * (ST_YMax(shown) - ST_YMin(shown));
	x double precision := margin;
	picture text := coalesce(typify_svg_text(margin, margin + 3, 3.4, title, ' font-weight="bold"'), '');
	below text;
	axes text;
	marks text;
	words text;
	words_x double precision;
BEGIN
	IF shown IS NULL THEN
		RETURN NULL;
	END IF;
	below := coalesce(typify_svg_layer(roads, shown, mm_per_unit, '#d9cfbd', road_width), '')
		|| coalesce(typify_svg_layer(barriers, shown, mm_per_unit, '#e08e79', greatest(barrier_width, 0.1) * magnify), '');
	axes := coalesce(typify_svg_layer(rows, shown, mm_per_unit, '#1f77b4', greatest(0.15, 0.05 * magnify)), '');
	IF before IS NOT NULL OR after IS NULL THEN
		picture := picture || typify_svg_panel(x, y, shown, mm_per_unit, before, 'building',
			CASE WHEN after IS NULL THEN black ELSE grey END, below, axes);
		x := x + panel_width + margin;
	END IF;
	IF after IS NOT NULL THEN
		words_x := CASE WHEN before IS NULL THEN x + 26 ELSE x END;
		SELECT found.marks, found.words INTO marks, words
		FROM typify_svg_marks(after, shown, mm_per_unit, min_gap * magnify / mm_per_unit) AS found;
		picture := picture || typify_svg_panel(x, y, shown, mm_per_unit, after, 'placeholder', black, below,
				coalesce(marks, '') || axes)
			|| coalesce(typify_svg_text(words_x, bottom + 3.6, 2.3, words, ' fill="#d62728"'), '');
		x := x + panel_width + margin;
	END IF;
	picture := picture || typify_svg_text(margin, bottom + 3.6, 2.3, '1:' || typify_svg_number(scale) || CASE
			WHEN magnify <> 1 THEN ', drawn ' || trim_scale(round(magnify::numeric, 2)) || 'x' ELSE '' END)
		|| typify_svg_scale_bar(margin, bottom + 7.2, least(30, panel_width / 2), mm_per_metre)
		|| coalesce(typify_svg_text(margin, bottom + 10.4, 1.8, attribution, ' fill="#777"'), '');
	-- words are as wide as they are long times their size times 0.6, at most
	RETURN typify_svg_document(
		greatest(x, words_x + 1.4 * length(words), 2 * margin + 2.1 * length(coalesce(title, '')),
			2 * margin + 1.1 * length(coalesce(attribution, ''))),
		bottom + CASE WHEN attribution IS NULL THEN 9.5 ELSE 12.5 END, picture);
END $$;
COMMENT ON FUNCTION typify_svg(geometry, geometry, double precision, geometry, text, double precision, geometry, text,
	geometry, double precision, geometry, double precision) IS
'An SVG picture of buildings before and after at true map size: millimetres as on a map at 1:scale, times magnify. roads: thin lines under both; barriers: lines as wide as barrier_width (mm on the map) under both; rows: lines over both, such as the axes of rows of buildings. frame: only what lies in its box. min_gap (mm on the map): placeholders that overlap are marked in red and those nearer to each other than that in orange, and both are counted; 0 marks overlaps alone, NULL nothing. Geometries are collections, as ST_Collect makes them; NULL for none. Errors: 22023 for scale, magnify and lengths that are not allowed, two SRIDs, a geographic one and coordinates that are not finite; 22004 for a NULL barrier_width; 0A000 for curves and triangles.';

-- A picture of ours says its size in its first tag; on a sheet it is a nested <svg>, whose lengths have no unit.
CREATE FUNCTION typify_svg_sheet(svgs text[], columns integer DEFAULT 2, title text DEFAULT NULL,
	attribution text DEFAULT NULL) RETURNS text
LANGUAGE plpgsql IMMUTABLE PARALLEL SAFE
SET search_path FROM CURRENT
AS $$
DECLARE
	head CONSTANT text := '^<svg ([^>]*)width="([0-9.]+)mm" height="([0-9.]+)mm"';
	top double precision := CASE WHEN title IS NULL THEN 0 ELSE 11 END;
	content text;
	width double precision;
	height double precision;
BEGIN
	IF columns IS NULL OR columns < 1 THEN
		RAISE EXCEPTION 'columns must be at least 1, not %', coalesce(columns::text, 'NULL')
			USING ERRCODE = '22023', HINT = 'Give how many pictures stand side by side.';
	END IF;
	IF EXISTS (SELECT FROM unnest(svgs) AS svg WHERE svg !~ head) THEN
		RAISE EXCEPTION 'a sheet takes pictures of typify_svg or typify_svg_sheet only'
			USING ERRCODE = '22023', HINT = 'Give an array such as ARRAY[typify_svg(...), typify_svg(...)].';
	END IF;
	WITH picture AS (
		SELECT svg, (n - 1) % columns AS i, (n - 1) / columns AS j,
			size[2]::double precision AS w, size[3]::double precision AS h
		FROM (SELECT svg, row_number() OVER (ORDER BY place) AS n, regexp_match(svg, head) AS size
			  FROM unnest(svgs) WITH ORDINALITY AS given(svg, place) WHERE svg IS NOT NULL) AS numbered
	), across AS (
		SELECT i, sum(max(w)) OVER (ORDER BY i) AS right_, max(w) AS w FROM picture GROUP BY i
	), down AS (
		SELECT j, top + sum(max(h)) OVER (ORDER BY j) AS bottom, max(h) AS h FROM picture GROUP BY j
	)
	SELECT string_agg(regexp_replace(svg, head, format('<svg x="%s" y="%s" \1width="\2" height="\3"',
			round((right_ - across.w)::numeric, 2), round((bottom - down.h)::numeric, 2))), '' ORDER BY j, i),
		max(right_), max(bottom)
	INTO content, width, height
	FROM picture JOIN across USING (i) JOIN down USING (j);
	RETURN typify_svg_document(
		greatest(width, 8 + 2.6 * length(coalesce(title, '')), 8 + 1.1 * length(coalesce(attribution, ''))),
		height + CASE WHEN attribution IS NULL THEN 0 ELSE 4 END,
		coalesce(typify_svg_text(4, 8.5, 4.2, title, ' font-weight="bold"'), '') || content
		|| coalesce(typify_svg_text(4, height + 1, 1.8, attribution, ' fill="#777"'), ''));
END $$;
COMMENT ON FUNCTION typify_svg_sheet(text[], integer, text, text) IS
'Several pictures of typify_svg on one sheet, row by row, at their own sizes; NULLs are passed over';
