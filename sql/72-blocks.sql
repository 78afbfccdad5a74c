-- 72-blocks.sql: the blocks between road lines, and the block of each building

CREATE FUNCTION typify_check_lines(lines geometry) RETURNS void
LANGUAGE plpgsql IMMUTABLE STRICT PARALLEL SAFE
SET search_path FROM CURRENT
AS $$
DECLARE
	wrong text := (
		SELECT min(ST_GeometryType(part.geom)) FROM ST_Dump(lines) AS part
		WHERE ST_GeometryType(part.geom) <> 'ST_LineString');
BEGIN
	IF wrong IS NOT NULL THEN
		RAISE EXCEPTION 'blocks lie between lines, and the geometry has a %', substr(wrong, 4)
			USING ERRCODE = '0A000', HINT = CASE
				WHEN wrong ~ 'Curve|Circular' THEN 'Use ST_CurveToLine to turn curves into lines.'
				WHEN wrong ~ 'Point' THEN 'Use ST_CollectionExtract(geom, 2) to keep the lines alone.'
				ELSE 'Use ST_Boundary to get the outline of areas.' END;
	END IF;
	-- the C room knows which reference systems are not planar and which coordinates are not finite
	PERFORM typify_centre(ST_SetSRID(ST_MakePoint(0, 0), ST_SRID(lines))), typify_centre(part.geom)
	FROM ST_Dump(lines) AS part;
END $$;
COMMENT ON FUNCTION typify_check_lines(geometry) IS
'Refuses what typify_blocks cannot take: 0A000 for anything but lines; 22023 for a geographic SRID and coordinates that are not finite';

-- A frame far outside becomes the shell of the unbounded face, whose holes come with it. Lines go in and faces come
-- out in an order of their own, so that neither the order of the lines nor that of the polygonizer matters.
CREATE FUNCTION typify_blocks(lines geometry) RETURNS SETOF geometry
LANGUAGE plpgsql IMMUTABLE STRICT PARALLEL SAFE COST 100000 ROWS 1000
SET search_path FROM CURRENT
AS $$
DECLARE
	far_away CONSTANT double precision := 1e8;
	middle geometry := CASE WHEN ST_IsEmpty(lines) THEN ST_SetSRID(ST_MakePoint(0, 0), ST_SRID(lines))
		ELSE ST_Envelope(lines) END;
	frame geometry := ST_Expand(ST_Force2D(middle), far_away);
BEGIN
	PERFORM typify_check_lines(lines);
	RETURN QUERY
	WITH noded AS (
		SELECT ST_UnaryUnion(ST_Collect(part.geom ORDER BY part.geom)) AS geom
		FROM (SELECT ST_Force2D(dumped.geom) AS geom FROM ST_Dump(lines) AS dumped) AS part
	), face AS (
		SELECT ST_Normalize(dumped.geom) AS geom
		FROM noded, ST_Dump(ST_Polygonize(ARRAY[noded.geom, ST_ExteriorRing(frame)])) AS dumped
	)
	SELECT geom FROM face
	ORDER BY ST_XMin(geom) = ST_XMin(frame) DESC, ST_YMin(geom), ST_XMin(geom), ST_YMax(geom), ST_XMax(geom),
		ST_AsBinary(geom);
END $$;
COMMENT ON FUNCTION typify_blocks(geometry) IS
'The blocks between road lines: one POLYGON for each face of their arrangement. The first row is the outside, what no lines enclose: it reaches 100 million units beyond the lines on each side, farther than any place on Earth in metres or feet. The others follow from south to north, then west to east, by the lower left corners of their boxes. So WITH ORDINALITY gives numbers, the same for the same lines in any order; they are those of typify_assign_blocks. Lines need no common points where they cross; what encloses nothing (dead ends) divides nothing; blocks inside a block are holes of it. Blocks cover everything, and share no more than their borders; none has area zero. lines: LINESTRINGs, MULTILINESTRINGs, collections of them, as ST_Collect makes them; Z and M are ignored. EMPTY lines give the outside alone, NULL no row. Errors: 0A000 for areas, points and curves; 22023 for a geographic SRID and coordinates that are not finite.';

CREATE FUNCTION typify_cell_size(side double precision, whole double precision) RETURNS double precision
LANGUAGE sql IMMUTABLE STRICT PARALLEL SAFE
RETURN whole / power(2::double precision, least(12, floor(ln(whole / side) / ln(2::double precision))));
COMMENT ON FUNCTION typify_cell_size(double precision, double precision) IS
'Support of typify_assign_blocks: the side of the whole, halved as long as it stays longer than a side, at most 12 times';

-- Needs no index, so that views will do: each block stands in the cells that its box meets of a grid about as wide as
-- the box, which are few, and each building looks into one cell of every grid. Block by block, since PostGIS keeps the
-- index of a polygon's edges from one call to the next with the same polygon.
CREATE FUNCTION typify_assign_blocks(
	buildings regclass,
	lines regclass,
	id_column name DEFAULT 'id',
	geom_column name DEFAULT 'geom',
	lines_geom_column name DEFAULT 'geom')
RETURNS TABLE (id bigint, block bigint)
LANGUAGE plpgsql STABLE PARALLEL RESTRICTED COST 1000000 ROWS 100000
SET search_path FROM CURRENT
SET enable_nestloop = off
SET jit = off
AS $$
DECLARE
	source text := typify_source(buildings, 'buildings', '', id_column, geom_column, true);
	lines_source text := typify_source(lines, 'lines', 'lines_', NULL, lines_geom_column, false);
	srid integer := typify_source_srid(source, buildings, geom_column, 'buildings');
	srid_of_lines integer := typify_source_srid(lines_source, lines, lines_geom_column, 'lines');
	all_lines geometry;
BEGIN
	PERFORM typify_check_same_srid('buildings', srid, 'lines', srid_of_lines),
		typify_check_ids(source, buildings, id_column, 'id_column');
	EXECUTE format('SELECT ST_Collect(ST_Force2D(geom)) FROM %s AS l', lines_source) INTO all_lines;
	RETURN QUERY EXECUTE format($query$
WITH building AS MATERIALIZED (
	SELECT id, centre[0] AS x, centre[1] AS y FROM (SELECT id, typify_centre(geom) AS centre FROM %s AS b) AS placed
), face AS (
	SELECT number, geom, ST_XMin(geom) AS x0, ST_YMin(geom) AS y0, ST_XMax(geom) AS x1, ST_YMax(geom) AS y1
	FROM typify_blocks($1) WITH ORDINALITY AS block (geom, number)
	WHERE number > 1
), sized AS MATERIALIZED (
	SELECT face.*, typify_cell_size(greatest(x1 - x0, y1 - y0), max(greatest(x1 - x0, y1 - y0)) OVER ()) AS size
	FROM face
), cell AS MATERIALIZED (
	SELECT number, size, i, j, x0, y0, x1, y1
	FROM sized, generate_series(floor(x0 / size)::bigint, floor(x1 / size)::bigint) AS i,
		generate_series(floor(y0 / size)::bigint, floor(y1 / size)::bigint) AS j
), look AS MATERIALIZED (
	SELECT building.*, size, floor(x / size)::bigint AS i, floor(y / size)::bigint AS j
	FROM building, (SELECT DISTINCT size FROM sized) AS sizes
), near AS MATERIALIZED (
	SELECT number, array_agg(look.id) AS ids, array_agg(x) AS xs, array_agg(y) AS ys
	FROM look JOIN cell USING (size, i, j)
	WHERE x BETWEEN x0 AND x1 AND y BETWEEN y0 AND y1
	GROUP BY number
), inside AS (
	SELECT one.id, min(number) AS number
	FROM near JOIN sized USING (number), unnest(ids, xs, ys) AS one (id, x, y)
	WHERE ST_Intersects(sized.geom, ST_SetSRID(ST_MakePoint(one.x, one.y), $2))
	GROUP BY one.id
)
SELECT id, coalesce(number, 1) FROM building LEFT JOIN inside USING (id) ORDER BY id$query$, source)
		USING all_lines, coalesce(srid, 0);
END $$;
COMMENT ON FUNCTION typify_assign_blocks(regclass, regclass, name, name, name) IS
'The block of each building, ready to group by: rows id, block, ascending by id, one for each building with a usable geometry. buildings: a table or view with ids (id_column) and geometries (geom_column). lines: a table or view of road lines. The centroid decides (see typify_centre); on a border the smaller number, and any before the outside. Numbers are those of typify_blocks WITH ORDINALITY; 1 is the outside, where all that lies in no other block belongs, also when there is no line. UPDATE buildings SET block = a.block FROM typify_assign_blocks(''buildings'', ''roads'') AS a WHERE a.id = buildings.id writes them. Other lines may give all blocks other numbers. Errors: 42703, 42804, 42809 for columns and tables; 22004 for NULLs; 22023 for ids that occur twice, SRIDs that are two or geographic, and coordinates that are not finite; 0A000 for lines that are none.';
