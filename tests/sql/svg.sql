-- pictures: sizes in millimetres, words that XML would trip over, odd inputs, errors
CREATE FUNCTION pg_temp.size(svg text) RETURNS text LANGUAGE sql AS
$$ SELECT substring(svg FROM '^<svg [^>]*(width="[^"]*" height="[^"]*")') $$;
-- true as well where the server has no libxml to ask
CREATE FUNCTION pg_temp.well_formed(svg text) RETURNS boolean LANGUAGE plpgsql AS
$$ BEGIN
	RETURN xmlparse(document svg) IS NOT NULL;
EXCEPTION WHEN feature_not_supported THEN
	RETURN true;
END $$;
CREATE TEMP TABLE town AS
SELECT ST_GeomFromText('MULTIPOLYGON(((0 0,3000 0,3000 2000,0 2000,0 0)),
		((4000 2000,5000 2000,5000 3000,4000 3000,4000 2000)))', 25832) AS before,
	ST_GeomFromText('GEOMETRYCOLLECTION(POLYGON((0 0,2000 0,2000 2000,0 2000,0 0)))', 25832) AS after,
	ST_GeomFromText('LINESTRING(0 -500,6000 3500)', 25832) AS roads;

-- a picture in full: 5 000 m are 100 mm at 1:50 000, in a panel with 1.5 mm on either side
SELECT typify_svg(before, after, 50000, roads, 'Fish & <Chips> "here"', attribution => 'me & you') FROM town;

-- sizes: one panel and two, half the scale, twice as large, a frame asked for, a frame too small
SELECT name, pg_temp.size(svg) AS size, pg_temp.well_formed(svg)
FROM town, LATERAL (VALUES
	(1, 'two panels', typify_svg(before, after, 50000)),
	(2, 'before alone', typify_svg(before, NULL, 50000)),
	(3, 'after alone', typify_svg(NULL, after, 50000, roads)),
	(4, '1:100 000', typify_svg(before, after, 100000)),
	(5, '1:100 000, enlarged', typify_svg(before, after, 100000, magnify => 2)),
	(6, 'frame', typify_svg(before, after, 50000, frame => ST_MakeEnvelope(0, 0, 2500, 2000, 25832))),
	(7, 'least panel', typify_svg(before, after, 5000000)),
	(8, 'title wider than the map', typify_svg(before, NULL, 500000, title => repeat('wide ', 20)))
) AS picture(number, name, svg) ORDER BY number;

-- in feet: 1 000 ft are 304.8 m; without SRID coordinates are metres
SELECT ST_SRID(square) AS srid, pg_temp.size(typify_svg(square, NULL, 5000)) AS size
FROM (SELECT ST_SetSRID(ST_MakeEnvelope(0, 0, 1000, 1000), srid) AS square
	  FROM unnest(ARRAY[0, 2263, 25832]) AS srid) AS squares;

-- nothing to draw, and almost nothing
SELECT typify_svg(NULL, NULL, 50000) IS NULL AS no_geometry,
	typify_svg('POLYGON EMPTY', 'GEOMETRYCOLLECTION EMPTY', 50000) IS NULL AS empty_geometry,
	pg_temp.well_formed(typify_svg('POLYGON EMPTY', NULL, 50000,
		frame => ST_MakeEnvelope(0, 0, 1, 1))) AS empty_in_frame,
	pg_temp.well_formed(typify_svg('POINT(1 1)', 'LINESTRING Z (0 0 1,2 2 1)', 50000)) AS points_and_lines;
SELECT regexp_matches(typify_svg('MULTIPOINT(1 1,2 2)', 'GEOMETRYCOLLECTION EMPTY', 1000),
	'>([0-9]+ [a-z]+)<', 'g') AS counted;
SELECT typify_svg_number(0) AS zero, typify_svg_number(75000) AS thousands, typify_svg_number(1234567) AS millions;
SELECT typify_svg_escape(E'a<b>&"c"\x01\n') AS escaped;

-- a hole stays a hole
SELECT typify_svg('POLYGON((0 0,9 0,9 9,0 9,0 0),(3 3,3 6,6 6,6 3,3 3))', NULL, 1000)
	~ 'evenodd.*<path d="M [^"M]*Z M [^"M]*Z"/>' AS hole;
-- a line is drawn as a line, not filled; faces of a surface are polygons
SELECT regexp_matches(typify_svg('LINESTRING(0 0,2 2,4 0)', 'MULTISURFACE(((0 0,4 0,4 2,0 0)))', 1000),
	'<path d="M [^>]*L[^>]*>', 'g') AS drawn;
SELECT pg_temp.well_formed(typify_svg('POLYHEDRALSURFACE(((0 0 0,0 0 1,0 1 1,0 1 0,0 0 0)))', NULL, 1000)) AS surface;

-- sheets
SELECT name, pg_temp.size(svg) AS size, pg_temp.well_formed(svg),
	(SELECT count(*) FROM regexp_matches(svg, '<svg ', 'g')) AS svgs
FROM (SELECT typify_svg(before, NULL, 50000) AS a, typify_svg(NULL, after, 100000) AS b FROM town) AS pictures,
LATERAL (VALUES
	(1, 'two columns', typify_svg_sheet(ARRAY[a, b])),
	(2, 'one column', typify_svg_sheet(ARRAY[a, b], 1)),
	(3, 'NULL in between', typify_svg_sheet(ARRAY[a, NULL, b], 2, 'Title', 'by me')),
	(4, 'sheet of sheets', typify_svg_sheet(ARRAY[typify_svg_sheet(ARRAY[a, b]), b], 1)),
	(5, 'none', typify_svg_sheet(ARRAY[NULL, NULL]))
) AS sheet(number, name, svg) ORDER BY number;

-- barriers as wide as their symbol, rows over both panels, violations: an overlap of 1 mm2 and a gap of 0.1 mm
CREATE TEMP TABLE tight AS
SELECT ST_GeomFromText('GEOMETRYCOLLECTION(POLYGON((0 0,100 0,100 100,0 100,0 0)),POLYGON((50 50,150 50,150 150,50 150,50 50)),
	POLYGON((155 50,255 50,255 150,155 150,155 50)),MULTIPOLYGON(((300 0,400 0,400 50,300 50,300 0)),((300 52,400 52,400 100,300 100,300 52))),
	POINT(0 0),LINESTRING(0 0,50 50))', 25832) AS after,
	ST_GeomFromText('MULTILINESTRING((-50 -50,450 -50))', 25832) AS barriers, ST_GeomFromText('LINESTRING(0 50,400 50)', 25832) AS rows;
SELECT typify_svg(NULL, after, 50000, barriers => barriers, barrier_width => 0.5, rows => rows, min_gap => 0.2) FROM tight;
SELECT n, regexp_match(svg, '[0-9]+ overlaps?, [^<]*') AS words, pg_temp.size(svg) AS size, pg_temp.well_formed(svg),
	(SELECT count(*) FROM regexp_matches(svg, '#1f77b4" stroke-width="0.15"', 'g')) AS rows, svg ~ 'e08e79" stroke-width="1.5"' AS barriers
FROM tight, LATERAL (VALUES (1, typify_svg(after, after, 50000, magnify => 3, barriers => barriers, barrier_width => 0.5, rows => rows, min_gap => 0)),
	(2, typify_svg(NULL, after, 50000, min_gap => 0.1)), (3, typify_svg(NULL, after, 50000, min_gap => 0.100001)),
	(4, typify_svg(NULL, after, 50000, min_gap => 0.2, frame => ST_MakeEnvelope(2000, 0, 2100, 100, 25832)))) AS picture (n, svg) ORDER BY n;
SELECT kind, round(ST_Area(mark)) AS area, round(ST_Length(mark)) AS length FROM tight, typify_violations(after, 10) ORDER BY kind;
SELECT count(*) AS of_nothing FROM unnest(ARRAY['GEOMETRYCOLLECTION EMPTY', NULL]::geometry[]) AS geom, typify_violations(geom, 1);
SELECT count(*) AS polygons FROM tight, unnest(typify_polygons(after));

-- errors
CREATE FUNCTION pg_temp.fails(statement text) RETURNS text LANGUAGE plpgsql AS
$$ DECLARE
	said text; hint text;
BEGIN
	EXECUTE statement;
	RETURN 'no error';
EXCEPTION WHEN OTHERS THEN
	GET STACKED DIAGNOSTICS said = MESSAGE_TEXT, hint = PG_EXCEPTION_HINT;
	RETURN concat_ws(' | ', SQLSTATE, said, hint);
END $$;
SELECT pg_temp.fails('SELECT typify_svg(''POINT(1 1)'', NULL, ' || scale || ')')
FROM unnest(ARRAY['0', '-1', 'NULL', '''NaN''', '''Infinity''']) AS scale;
SELECT pg_temp.fails('SELECT typify_svg(''POINT(1 1)'', NULL, 50000, magnify => 0)');
SELECT pg_temp.fails('SELECT typify_svg(''SRID=25832;POINT(1 1)'', ''SRID=25833;POINT(1 1)'', 50000)');
SELECT pg_temp.fails('SELECT typify_svg(''SRID=4326;POINT(1 1)'', NULL, 50000)');
-- what cannot be drawn, wherever it stands
SELECT pg_temp.fails(format('SELECT typify_svg(%L, NULL, 50000)', shape)) AS before
FROM unnest(ARRAY['TIN(((0 0,1 0,1 1,0 0)))', 'TRIANGLE((0 0,1 0,1 1,0 0))', 'CIRCULARSTRING(0 0,1 1,2 0)',
	'GEOMETRYCOLLECTION(POINT(1 1),CURVEPOLYGON(CIRCULARSTRING(0 0,4 0,4 4,0 4,0 0)))',
	'COMPOUNDCURVE(CIRCULARSTRING(0 0,1 1,2 0),(2 0,3 0))']) AS shape;
SELECT pg_temp.fails('SELECT typify_svg(NULL, ''TRIANGLE((0 0,1 0,1 1,0 0))'', 50000)') AS after;
SELECT pg_temp.fails('SELECT typify_svg(''POINT(1 1)'', NULL, 50000, ''CIRCULARSTRING(0 0,1 1,2 0)'')') AS roads;
SELECT pg_temp.fails(format('SELECT typify_svg(ST_MakeLine(ST_MakePoint(0, 0), ST_MakePoint(%s)), NULL, 50000)', xy))
FROM unnest(ARRAY['''NaN'', 1', '1, ''Infinity''', '''-Infinity'', 1']) AS xy;
SELECT pg_temp.fails('SELECT typify_svg(''POINT(1 1)'', NULL, 50000, ST_MakePoint(''NaN'', 1))') AS roads;
SELECT pg_temp.fails('SELECT typify_svg(ST_MakePoint(1, 1, ''NaN''), NULL, 50000)') AS height;
SELECT ST_AsText(ST_MakePolygon(ST_ExteriorRing(geom))) AS as_the_hint_says FROM ST_Dump('TIN(((0 0,1 0,1 1,0 0)))');

SELECT pg_temp.fails('SELECT typify_svg(''POINT(1 1)'', NULL, 50000, ' || argument || ')') AS barriers_rows_gaps
FROM unnest(ARRAY['barriers => ''CIRCULARSTRING(0 0,1 1,2 0)''', 'rows => ''SRID=25833;LINESTRING(0 0,1 1)''', 'barrier_width => -1',
	'barrier_width => NULL', 'min_gap => ''NaN''']) AS argument;
SELECT pg_temp.fails('SELECT typify_violations(''POINT(1 1)'', -1)') AS violations;
SELECT pg_temp.fails('SELECT typify_svg_sheet(ARRAY[''<p/>''])');
SELECT pg_temp.fails('SELECT typify_svg_sheet(ARRAY[''<p/>''], 0)');
