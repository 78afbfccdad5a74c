-- 85-quality.sql: how good a layer is, ours or another program's, against the buildings that it was made of
--
-- The layer and its source are read once, into arrays: views over typify_derive are expensive to read twice, and no
-- index is needed. Lengths are millimetres on the map and become ground units at the beginning; limits hold up to 1e-6
-- relative. What is measured is measured by PostGIS; typify adds which pairs to look at.

CREATE FUNCTION typify_measures(geom geometry,
	OUT x double precision,
	OUT y double precision,
	OUT area double precision,
	OUT ratio double precision,
	OUT ux double precision,
	OUT uy double precision)
AS 'MODULE_PATHNAME'
LANGUAGE C IMMUTABLE STRICT PARALLEL SAFE COST 10;
COMMENT ON FUNCTION typify_measures(geometry) IS
'What typify keeps of a building. x, y: as of typify_centre. area: of the shells less that of the holes. ratio: of the shorter to the longer side of the minimum-area bounding rectangle, 1 where it has no area. ux, uy: unit vector along its longer side, uy at least 0. In units of the SRID; NULL for EMPTY. Errors: as of typify_centre.';

CREATE FUNCTION typify_nearest_segments(points point[], segments lseg[])
RETURNS integer[]
AS 'MODULE_PATHNAME'
LANGUAGE C IMMUTABLE STRICT PARALLEL SAFE COST 10000;
COMMENT ON FUNCTION typify_nearest_segments(point[], lseg[]) IS
'For each point the place of the nearest segment, counted from 1, the first of equals; NULLs where there is none. Needs no index. Errors: 22004 for an array that contains NULLs; 22023 for a coordinate that is not finite.';

CREATE FUNCTION typify_sides(geom geometry, OUT width double precision, OUT length double precision)
LANGUAGE sql IMMUTABLE STRICT PARALLEL SAFE
BEGIN ATOMIC
	SELECT ST_YMax(turned) - ST_YMin(turned), ST_XMax(turned) - ST_XMin(turned)
	FROM typify_measures(geom) AS m, ST_Affine(geom, m.ux, m.uy, -m.uy, m.ux, 0, 0) AS turned;
END;
COMMENT ON FUNCTION typify_sides(geometry) IS
'The shorter and the longer side of the minimum-area bounding rectangle of a building, in units of the SRID. It is the exact one, which ST_OrientedEnvelope is not with every GEOS. Errors: as of typify_centre.';

-- ---- reading ----

CREATE FUNCTION typify_quality_source(source text,
	OUT ids bigint[], OUT centres point[], OUT directions point[], OUT area double precision,
	OUT row_numbers bigint[], OUT row_places integer[])
LANGUAGE plpgsql STABLE PARALLEL RESTRICTED
SET search_path FROM CURRENT
SET jit = off
AS $$
BEGIN
	EXECUTE format($query$
WITH measured AS MATERIALIZED (
	SELECT id, typify_measures(geom) AS m, grp, typify_rows(geom) OVER (PARTITION BY grp) AS r FROM %s AS b
), numbered AS MATERIALIZED (
	SELECT measured.*, CASE WHEN (r).place IS NOT NULL THEN dense_rank() OVER (ORDER BY grp, (r).number) END AS number
	FROM measured
)
SELECT coalesce(array_agg(id), '{}'), coalesce(array_agg(point((m).x, (m).y)), '{}'),
	coalesce(array_agg(point((m).ux, (m).uy)), '{}'), coalesce(sum((m).area), 0), coalesce(array_agg(number), '{}'),
	coalesce(array_agg((r).place), '{}') FROM numbered$query$, source)
	INTO ids, centres, directions, area, row_numbers, row_places;
END $$;
COMMENT ON FUNCTION typify_quality_source(text) IS
'Support of typify_quality: the buildings of a sub-select (as typify_source makes it): ids, centres, unit vectors of their longer sides, the sum of their areas, the number of the row of buildings that each stands in, as typify_rows finds them in each group, and its place there, NULL for none';

CREATE FUNCTION typify_quality_result(relation regclass, geom_column name, members_column name,
	OUT geoms geometry[], OUT centres point[], OUT directions point[], OUT not_drawn bigint,
	OUT member_ids bigint[], OUT member_places bigint[])
LANGUAGE plpgsql STABLE PARALLEL RESTRICTED
SET search_path FROM CURRENT
SET jit = off
AS $$
DECLARE
	wrong text;
BEGIN
	EXECUTE format($query$
WITH row AS MATERIALIZED (
	SELECT ST_SetSRID(ST_Force2D(geom), 0) AS geom, members, drawn, typify_measures(geom) AS m,
		CASE WHEN drawn THEN count(*) FILTER (WHERE drawn) OVER (ROWS UNBOUNDED PRECEDING) END AS place
	FROM (SELECT %1$s AS geom, %2$s::bigint[] AS members, %1$s IS NOT NULL AND NOT ST_IsEmpty(%1$s) AS drawn FROM %3$s)
		AS b
)
SELECT (SELECT coalesce(array_agg(geom ORDER BY place) FILTER (WHERE drawn), '{}') FROM row),
	(SELECT coalesce(array_agg(point((m).x, (m).y) ORDER BY place) FILTER (WHERE drawn), '{}') FROM row),
	(SELECT coalesce(array_agg(point((m).ux, (m).uy) ORDER BY place) FILTER (WHERE drawn), '{}') FROM row),
	(SELECT count(*) FILTER (WHERE NOT drawn) FROM row),
	(SELECT coalesce(array_agg(member), '{}') FROM row, unnest(members) AS member),
	(SELECT coalesce(array_agg(place), '{}') FROM row, unnest(members) AS member),
	(SELECT min(ST_GeometryType(geom)) FROM row WHERE drawn AND ST_Dimension(geom) < 2)$query$,
		quote_ident(geom_column), coalesce(quote_ident(members_column), 'NULL'), typify_table_name(relation, 'result'))
	INTO geoms, centres, directions, not_drawn, member_ids, member_places, wrong;
	IF wrong IS NOT NULL THEN
		RAISE EXCEPTION 'result has a %, it must have polygons', substr(wrong, 4)
			USING ERRCODE = '0A000', HINT = 'Leave such rows out in a view, or turn them into areas with ST_Buffer.';
	END IF;
END $$;
COMMENT ON FUNCTION typify_quality_result(regclass, name, name) IS
'Support of typify_quality: the rows of a layer of polygons. geoms: those that are drawn, with SRID 0; centres, and directions, unit vectors of their longer sides; not_drawn: the number of the others; member_ids and, for each, member_places, the place of its row in geoms, NULL where that is not drawn. members_column: NULL for none. Errors: 0A000 for anything but areas; as of typify_centre.';

CREATE FUNCTION typify_quality_segments(relation regclass, argument text, geom_column name, srid integer) RETURNS lseg[]
LANGUAGE plpgsql STABLE PARALLEL RESTRICTED
SET search_path FROM CURRENT
SET jit = off
AS $$
DECLARE
	source text := typify_source(relation, argument, argument || '_', NULL, geom_column, false);
	segments lseg[];
	wrong text;
BEGIN
	PERFORM typify_check_same_srid('source', srid, argument,
		typify_source_srid(source, relation, geom_column, argument));
	EXECUTE format($query$
WITH line AS MATERIALIZED (
	SELECT ST_Force2D(part.geom) AS geom FROM %s AS b, ST_Dump(geom) AS part
)
SELECT min(ST_GeometryType(geom)) FILTER (WHERE ST_GeometryType(geom) <> 'ST_LineString'),
	(SELECT coalesce(array_agg(lseg(ST_PointN(geom, i)::point, ST_PointN(geom, i + 1)::point)), '{}')
	 FROM line, generate_series(1, ST_NPoints(geom) - 1) AS i WHERE ST_GeometryType(geom) = 'ST_LineString')
FROM line$query$, source) INTO wrong, segments;
	IF wrong IS NOT NULL THEN
		RAISE EXCEPTION '% has a %, it must have lines', argument, substr(wrong, 4)
			USING ERRCODE = '0A000', HINT = CASE
				WHEN wrong ~ 'Curve|Circular' THEN 'Use ST_CurveToLine to turn curves into lines.'
				WHEN wrong ~ 'Point' THEN 'Leave the points out, in a view.'
				ELSE 'Use ST_Boundary, in a view, to get the outline of areas.' END;
	END IF;
	RETURN segments;
END $$;
COMMENT ON FUNCTION typify_quality_segments(regclass, text, name, integer) IS
'Support of typify_quality: the segments of a table of lines. argument: what errors call it; srid: of the source. Errors: as of typify_source; 22023 for another SRID; 0A000 for anything but lines.';

-- ---- the figures ----

-- Where many overlap in one place, each place is inked once.
CREATE FUNCTION typify_quality_gaps(geoms geometry[], directions point[], min_side double precision,
	min_gap double precision,
	OUT overlapping bigint, OUT narrow_gaps bigint, OUT short_sides bigint, OUT inked double precision)
LANGUAGE plpgsql STABLE PARALLEL SAFE
SET search_path FROM CURRENT
SET enable_nestloop = off
SET jit = off
AS $$
BEGIN
	WITH shape AS MATERIALIZED (
		SELECT geom, place, ST_Area(geom) AS area FROM unnest(geoms) WITH ORDINALITY AS s (geom, place)
	), turned AS MATERIALIZED (
		SELECT ST_Affine(geom, u[0], u[1], -u[1], u[0], 0, 0) AS geom
		FROM ROWS FROM (unnest(geoms), unnest(directions)) AS t (geom, u)
	), pair AS MATERIALIZED (
		SELECT a_place, b_place, overlap FROM typify_close_pairs(geoms, min_gap)
	), crowd AS (
		SELECT place, geom, area, ST_ClusterDBSCAN(geom, 0, 1) OVER () AS crowd
		FROM shape WHERE place IN (SELECT unnest(ARRAY[a_place, b_place]) FROM pair WHERE overlap)
	), crowd_area AS (
		SELECT sum(area) - ST_Area(ST_UnaryUnion(ST_Collect(typify_valid(geom)))) AS twice FROM crowd GROUP BY crowd
	)
	SELECT (SELECT count(*) FROM pair WHERE overlap), (SELECT count(*) FROM pair WHERE NOT overlap),
		(SELECT count(*) FROM turned WHERE ST_YMax(geom) - ST_YMin(geom) < min_side * (1 - 1e-6)),
		(SELECT coalesce(sum(area), 0) FROM shape) - (SELECT coalesce(sum(twice), 0) FROM crowd_area)
	INTO overlapping, narrow_gaps, short_sides, inked;
END $$;
COMMENT ON FUNCTION typify_quality_gaps(geometry[], point[], double precision, double precision) IS
'Support of typify_quality: of polygons, with the unit vectors of their longer sides, pairs that overlap, pairs that do not and are nearer than min_gap, polygons narrower than min_side, and the area of their union; ground units';

CREATE FUNCTION typify_quality_links(ids bigint[], centres point[], member_ids bigint[], member_places bigint[],
	placeholders point[], by_members boolean,
	OUT places bigint[], OUT links lseg[], OUT members_not_drawn bigint, OUT lost bigint, OUT repeated bigint)
LANGUAGE plpgsql STABLE PARALLEL SAFE
SET search_path FROM CURRENT
SET enable_nestloop = off
SET jit = off
AS $$
BEGIN
	IF by_members THEN
		WITH member AS MATERIALIZED (
			SELECT id, min(place) AS place, count(*) AS times
			FROM ROWS FROM (unnest(member_ids), unnest(member_places)) AS m (id, place) GROUP BY id
		)
		SELECT array_agg(member.place ORDER BY b.number), count(*) FILTER (WHERE times IS NULL),
			count(*) FILTER (WHERE times > 1), (SELECT count(*) FROM unnest(member_places) AS place WHERE place IS NULL)
		INTO places, lost, repeated, members_not_drawn
		FROM unnest(ids) WITH ORDINALITY AS b (id, number) LEFT JOIN member USING (id);
	ELSE
		places := typify_nearest(centres, placeholders);
	END IF;
	places := coalesce(places, '{}');
	SELECT coalesce(array_agg(lseg(centre, placeholder)), '{}') INTO links
	FROM ROWS FROM (unnest(centres), unnest(places)) AS building (centre, place)
	JOIN unnest(placeholders) WITH ORDINALITY AS p (placeholder, place) USING (place);
END $$;
COMMENT ON FUNCTION typify_quality_links(bigint[], point[], bigint[], bigint[], point[], boolean) IS
'Support of typify_quality: places, for each building the place of its placeholder, or, unless by_members, of the nearest one, NULL for none; links, the segments from centre to centre; members of rows that are not drawn; buildings that are a member of no row, and of more than one; the last three NULL unless by_members';

-- What is off the line by more than a tenth of a millimetre is seen to be.
CREATE FUNCTION typify_quality_rows(centres point[], row_numbers bigint[], row_places integer[], places bigint[],
	placeholders point[], share double precision, tolerance double precision) RETURNS double precision
LANGUAGE plpgsql IMMUTABLE PARALLEL SAFE
SET search_path FROM CURRENT
SET enable_nestloop = off
SET jit = off
AS $$
DECLARE
	kept double precision;
BEGIN
	WITH member AS MATERIALIZED (
		SELECT number, row_place, centre, place
		FROM ROWS FROM (unnest(centres), unnest(row_numbers), unnest(row_places), unnest(places))
			AS m (centre, number, row_place, place)
		WHERE number IS NOT NULL
	), axis AS MATERIALIZED (
		SELECT number, ST_MakeLine(centre::geometry ORDER BY row_place) AS line, count(DISTINCT place) AS drawn
		FROM member GROUP BY number HAVING count(*) * share >= 2
	), off AS (
		SELECT number, max(ST_Distance(placeholder::geometry, line)) AS distance
		FROM axis JOIN member USING (number) JOIN unnest(placeholders) WITH ORDINALITY AS p (placeholder, place) USING (place)
		GROUP BY number
	)
	SELECT avg(CASE WHEN drawn >= 2 AND distance <= tolerance THEN 1 ELSE 0 END) INTO kept
	FROM axis LEFT JOIN off USING (number);
	RETURN kept;
END $$;
COMMENT ON FUNCTION typify_quality_rows(point[], bigint[], integer[], bigint[], point[], double precision,
	double precision) IS
'Support of typify_quality: the share of rows of buildings that are kept, of those of which a share of the buildings is two or more: at least two placeholders, and the centres of all within the tolerance of the line along the row''s buildings; NULL where there is no such row';

CREATE FUNCTION typify_quality_barriers(geoms geometry[], links lseg[], barriers lseg[], reach double precision,
	OUT crossings bigint, OUT gaps bigint, OUT members_across bigint)
LANGUAGE plpgsql STABLE PARALLEL SAFE
SET search_path FROM CURRENT
SET enable_nestloop = off
SET jit = off
AS $$
BEGIN
	WITH segment AS MATERIALIZED (
		SELECT place, ST_MakeLine((s[0])::geometry, (s[1])::geometry) AS line, box(s[0], s[1]) AS box
		FROM unnest(barriers) WITH ORDINALITY AS b (s, place)
	), shape AS MATERIALIZED (
		SELECT place, geom FROM unnest(geoms) WITH ORDINALITY AS s (geom, place)
	), nearest AS (
		SELECT a_place, min(ST_Distance(geom, line)) AS distance
		FROM typify_box_pairs((SELECT coalesce(array_agg(box(ST_Expand(geom, reach)) ORDER BY place), '{}') FROM shape),
			(SELECT coalesce(array_agg(box ORDER BY place), '{}') FROM segment)) AS near
		JOIN shape ON shape.place = a_place JOIN segment ON segment.place = b_place
		GROUP BY a_place
	)
	SELECT count(*) FILTER (WHERE distance = 0), count(*) FILTER (WHERE distance > 0 AND distance < reach * (1 - 1e-6))
	INTO crossings, gaps FROM nearest;

	WITH segment AS MATERIALIZED (
		SELECT place, ST_MakeLine((s[0])::geometry, (s[1])::geometry) AS line, box(s[0], s[1]) AS box
		FROM unnest(barriers) WITH ORDINALITY AS b (s, place)
	), link AS MATERIALIZED (
		SELECT place, ST_MakeLine((s[0])::geometry, (s[1])::geometry) AS line, box(s[0], s[1]) AS box
		FROM unnest(links) WITH ORDINALITY AS l (s, place)
	), pair AS MATERIALIZED (
		SELECT a_place, link.line AS a, segment.line AS b
		FROM typify_box_pairs((SELECT coalesce(array_agg(box ORDER BY place), '{}') FROM link),
			(SELECT coalesce(array_agg(box ORDER BY place), '{}') FROM segment)) AS near
		JOIN link ON link.place = a_place JOIN segment ON segment.place = b_place
	)
	SELECT count(DISTINCT a_place) INTO members_across FROM pair WHERE ST_Intersects(a, b);
END $$;
COMMENT ON FUNCTION typify_quality_barriers(geometry[], lseg[], lseg[], double precision) IS
'Support of typify_quality: polygons that meet a barrier; polygons that do not, but are nearer to one than reach; links (from building to placeholder) that meet one';

CREATE FUNCTION typify_quality_density(before point[], after point[], cell double precision,
	OUT correlation double precision, OUT slope double precision, OUT settled bigint)
LANGUAGE plpgsql IMMUTABLE PARALLEL SAFE
SET search_path FROM CURRENT
SET jit = off
AS $$
BEGIN
	WITH counted AS (
		SELECT floor(p[0] / cell) AS i, floor(p[1] / cell) AS j, sum(b)::float8 AS b, sum(a)::float8 AS a
		FROM (SELECT p, 1 AS b, 0 AS a FROM unnest(before) AS p UNION ALL SELECT p, 0, 1 FROM unnest(after) AS p) AS each
		GROUP BY 1, 2
	)
	SELECT corr(a, b), regr_slope(a, b) * cardinality(before) / nullif(cardinality(after), 0),
		count(*) FILTER (WHERE b > 0)
	INTO correlation, slope, settled FROM counted;
END $$;
COMMENT ON FUNCTION typify_quality_density(point[], point[], double precision) IS
'Support of typify_quality: points are counted in the square cells of a grid, where either set has one. correlation of the counts; slope of the regression of after on before, times the ratio of all before to all after, so that 1 keeps all differences; settled: cells with a point before. NULLs where all cells are alike.';

CREATE FUNCTION typify_quality_angle(centres point[], directions point[], lines lseg[]) RETURNS double precision
LANGUAGE plpgsql IMMUTABLE PARALLEL SAFE
SET search_path FROM CURRENT
SET enable_nestloop = off
SET jit = off
AS $$
DECLARE
	angle double precision;
BEGIN
	WITH line AS MATERIALIZED (
		SELECT place, degrees(atan2((s[1])[1] - (s[0])[1], (s[1])[0] - (s[0])[0])) AS degrees
		FROM unnest(lines) WITH ORDINALITY AS l (s, place)
	), turned AS (
		SELECT (degrees(atan2(direction[1], direction[0])) - degrees)::numeric % 90 AS turn
		FROM ROWS FROM (unnest(directions), unnest(typify_nearest_segments(centres, lines))) AS b (direction, place)
		JOIN line USING (place)
	)
	SELECT percentile_cont(0.5) WITHIN GROUP (ORDER BY least(abs(turn), 90 - abs(turn))::float8) INTO angle FROM turned;
	RETURN angle;
END $$;
COMMENT ON FUNCTION typify_quality_angle(point[], point[], lseg[]) IS
'Support of typify_quality: the median of the angles between directions and the nearest lines, modulo 90 degrees, so from 0 to 45; NULL where there are none';

-- ---- the groups that are too dense ----

CREATE FUNCTION typify_dense_groups(
	source regclass,
	scale double precision,
	group_by name DEFAULT NULL,
	options typify_options DEFAULT NULL,
	min_side double precision DEFAULT 0.35,
	min_gap double precision DEFAULT 0.2,
	geom_column name DEFAULT 'geom')
RETURNS TABLE (grp text, buildings bigint, asked bigint, coverage double precision)
LANGUAGE plpgsql STABLE PARALLEL RESTRICTED
SET search_path FROM CURRENT
SET jit = off
AS $$
DECLARE
	buildings_source text := typify_source(source, 'source', '', NULL, geom_column, false,
		CASE WHEN group_by IS NULL THEN 'NULL' ELSE 'b.' || typify_column_name(source, group_by, 'any', 'group_by') END);
	unit double precision := scale / 1000 / typify_metres_per_unit(
		coalesce(typify_source_srid(buildings_source, source, geom_column, 'source'), 0));
BEGIN
	PERFORM typify_check_parameters(scale, 0, options),
		typify_check_length(min_side, 'min_side', 'Give millimetres on the map.'),
		typify_check_length(min_gap, 'min_gap', 'Give millimetres on the map.');
	RETURN QUERY EXECUTE format($query$
WITH measured AS MATERIALIZED (
	SELECT grp, typify_measures(geom) AS m FROM %s AS b
), census AS (
	SELECT grp, count(*) AS n, typify_count(count(*), $1, $2) AS asked,
		greatest(avg((m).area) * typify_area_factor($1, $2), $3 ^ 2) AS area,
		ST_ConvexHull(ST_Collect(ST_MakePoint((m).x, (m).y))) AS hull
	FROM measured GROUP BY grp
), covered AS (
	SELECT grp, n, asked, asked * area / (ST_Area(hull) + side * CASE ST_Dimension(hull)
		WHEN 2 THEN ST_Perimeter(hull) ELSE 2 * ST_Length(hull) END / 2 + side ^ 2) AS coverage
	FROM census, LATERAL (SELECT sqrt(area) + $4 AS side) AS own
	WHERE asked > 1
)
SELECT grp, n, asked, coverage FROM covered WHERE coverage > 0.5 ORDER BY coverage DESC, grp$query$, buildings_source)
		USING scale, options, min_side * unit, min_gap * unit;
END $$;
COMMENT ON FUNCTION typify_dense_groups(regclass, double precision, name, typify_options, double precision,
	double precision, name) IS
'The groups of a table of buildings that are too dense to typify at a scale: those whose placeholders, as many and as large as the law wants them (at least squares of min_side), would cover more than half of the ground, the densest first. coverage: the share that they would cover. The ground of a group is the convex hull of its buildings'' centres, widened on all sides by half of a square placeholder and its gap. Where more than about half is covered, rectangles find no place any more: draw such groups as areas, or ask for fewer (exponent). Groups of which one placeholder is asked are never too dense. group_by: a column, NULL for all in one group; options: of the law; min_side, min_gap: mm on the map. Errors: as of typify_quality.';

-- ---- all together ----

CREATE FUNCTION typify_quality_asked(source text, scale double precision, options typify_options, OUT n bigint)
LANGUAGE plpgsql STABLE PARALLEL RESTRICTED
SET search_path FROM CURRENT
AS $$
BEGIN
	IF options.min_distance > 0 AND options.count IS NULL AND options.count_rule IS NULL AND options.exponent IS NULL THEN
		RETURN;
	END IF;
	EXECUTE format('SELECT coalesce(sum(typify_count(n, $1, $2)), 0)::bigint '
		'FROM (SELECT count(*) AS n FROM %s AS b GROUP BY grp) AS census', source) INTO n USING scale, options;
END $$;
COMMENT ON FUNCTION typify_quality_asked(text, double precision, typify_options) IS
'Support of typify_quality: how many placeholders the law wants of all groups of a sub-select; NULL where min_distance alone says when to stop';

CREATE FUNCTION typify_quality_check(scale double precision, options typify_options, lengths double precision[])
RETURNS void
LANGUAGE plpgsql STABLE PARALLEL SAFE
SET search_path FROM CURRENT
AS $$
BEGIN
	IF scale IS NULL THEN
		PERFORM typify_refuse_null('scale', 'Give the denominator: 75000 for a map at 1:75 000.');
	END IF;
	PERFORM typify_check_parameters(scale, 0, options),
		typify_check_length(length, argument, 'Give millimetres on the map.')
	FROM ROWS FROM (unnest(lengths), unnest(ARRAY['min_side', 'min_gap', 'barrier_width', 'cell']))
		AS l (length, argument);
	IF lengths[4] = 0 THEN
		RAISE EXCEPTION 'cell is 0, it must be above 0'
			USING ERRCODE = '22023', HINT = 'Give the side of the cells in which density is compared, mm on the map.';
	END IF;
END $$;
COMMENT ON FUNCTION typify_quality_check(double precision, typify_options, double precision[]) IS
'Refuses arguments of typify_quality that are NULL (22004) or not allowed (22023); lengths: min_side, min_gap, barrier_width, cell';

CREATE FUNCTION typify_quality(
	source regclass,
	result regclass,
	scale double precision,
	group_by name DEFAULT NULL,
	options typify_options DEFAULT NULL,
	barriers regclass DEFAULT NULL,
	barrier_width double precision DEFAULT 0,
	roads regclass DEFAULT NULL,
	min_side double precision DEFAULT 0.35,
	min_gap double precision DEFAULT 0.2,
	cell double precision DEFAULT 10,
	id_column name DEFAULT 'id',
	geom_column name DEFAULT 'geom',
	result_geom_column name DEFAULT 'geom',
	members_column name DEFAULT NULL,
	barriers_geom_column name DEFAULT 'geom',
	roads_geom_column name DEFAULT 'geom')
RETURNS TABLE (
	buildings bigint,
	asked bigint,
	reached bigint,
	not_drawn bigint,
	members_not_drawn bigint,
	lost bigint,
	repeated bigint,
	overlapping bigint,
	narrow_gaps bigint,
	short_sides bigint,
	barrier_crossings bigint,
	barrier_gaps bigint,
	members_across bigint,
	displacement_median double precision,
	displacement_p99 double precision,
	ink_before double precision,
	ink_after double precision,
	density_cell double precision,
	density_correlation double precision,
	density_slope double precision,
	rows_kept double precision,
	road_angle_before double precision,
	road_angle double precision,
	dense_groups bigint)
LANGUAGE plpgsql STABLE PARALLEL RESTRICTED ROWS 1
SET search_path FROM CURRENT
SET jit = off
AS $$
DECLARE
	by_members boolean := members_column IS NOT NULL OR EXISTS (
		SELECT FROM pg_attribute WHERE attrelid = result AND attname = 'members' AND attnum > 0 AND NOT attisdropped);
	grp text := 'NULL';
	census text;
	result_source text;
	srid integer;
	unit double precision;
	before record;
	after record;
	link record;
	density record;
	barrier_lines lseg[];
	road_lines lseg[];
BEGIN
	PERFORM typify_quality_check(scale, options, ARRAY[min_side, min_gap, barrier_width, cell]),
		typify_table_name(source, 'source'), typify_table_name(result, 'result');
	IF group_by IS NOT NULL THEN
		grp := 'b.' || typify_column_name(source, group_by, 'any', 'group_by');
	END IF;
	IF by_members THEN
		members_column := coalesce(members_column, 'members');
		PERFORM typify_column_name(result, members_column, 'integers', 'members_column');
	END IF;
	census := typify_source(source, 'source', '', id_column, geom_column, by_members, grp);
	result_source := typify_source(result, 'result', 'result_', NULL, result_geom_column, false);
	srid := typify_source_srid(census, source, geom_column, 'source');
	PERFORM typify_check_same_srid('source', srid, 'result',
		typify_source_srid(result_source, result, result_geom_column, 'result'));
	IF by_members THEN
		PERFORM typify_check_ids(census, source, id_column, 'id_column');
	END IF;
	unit := scale / 1000 / typify_metres_per_unit(coalesce(srid, 0));
	IF barriers IS NOT NULL THEN
		barrier_lines := typify_quality_segments(barriers, 'barriers', barriers_geom_column, srid);
	END IF;
	IF roads IS NOT NULL THEN
		road_lines := typify_quality_segments(roads, 'roads', roads_geom_column, srid);
	END IF;

	before := typify_quality_source(census);
	after := typify_quality_result(result, result_geom_column, members_column);
	link := typify_quality_links(before.ids, before.centres, after.member_ids, after.member_places, after.centres,
		by_members);
	density := typify_quality_density(before.centres, after.centres, cell * unit);

	buildings := cardinality(before.centres);
	asked := typify_quality_asked(census, scale, options);
	reached := cardinality(after.centres);
	not_drawn := after.not_drawn;
	members_not_drawn := link.members_not_drawn;
	lost := link.lost;
	repeated := link.repeated;
	SELECT g.overlapping, g.narrow_gaps, g.short_sides, g.inked / nullif(density.settled * (cell * unit) ^ 2, 0)
	INTO overlapping, narrow_gaps, short_sides, ink_after
	FROM typify_quality_gaps(after.geoms, after.directions, min_side * unit, min_gap * unit) AS g;
	ink_before := before.area / nullif(density.settled * (cell * unit) ^ 2, 0);
	IF barriers IS NOT NULL THEN
		SELECT b.crossings, b.gaps, b.members_across INTO barrier_crossings, barrier_gaps, members_across
		FROM typify_quality_barriers(after.geoms, link.links, barrier_lines, (barrier_width / 2 + min_gap) * unit) AS b;
	END IF;
	rows_kept := typify_quality_rows(before.centres, before.row_numbers, before.row_places, link.places, after.centres,
		coalesce(asked, reached)::float8 / nullif(buildings, 0), 0.1 * unit);
	SELECT d[1] / unit, d[2] / unit INTO displacement_median, displacement_p99
	FROM (SELECT percentile_cont(ARRAY[0.5, 0.99]) WITHIN GROUP (ORDER BY @-@ l) AS d FROM unnest(link.links) AS l) AS d;
	density_cell := cell * unit;
	density_correlation := density.correlation;
	density_slope := density.slope;
	IF coalesce(roads, barriers) IS NOT NULL THEN
		road_lines := coalesce(road_lines, barrier_lines);
		road_angle_before := typify_quality_angle(before.centres, before.directions, road_lines);
		road_angle := typify_quality_angle(after.centres, after.directions, road_lines);
	END IF;
	IF asked IS NOT NULL THEN
		SELECT count(*) INTO dense_groups
		FROM typify_dense_groups(source, scale, group_by, options, min_side, min_gap, geom_column);
	END IF;
	RETURN NEXT;
END $$;
COMMENT ON FUNCTION typify_quality(regclass, regclass, double precision, name, typify_options, regclass,
	double precision, regclass, double precision, double precision, double precision, name, name, name, name, name, name)
IS
'How good a layer of polygons is, ours or another program''s, at a scale (its denominator), against the table of buildings that it was made of: one row of figures. Any of the tables may be a view, a materialized, partitioned or foreign table; no index is needed. Rows of source and of lines whose geometry is NULL or EMPTY do not count. Lengths are millimetres on the map; limits hold up to 1e-6 relative, so that a gap of exactly the limit is none too narrow.
buildings: of source. asked: how many placeholders the law of options (source_scale, exponent, count_rule ...; those of a calibrated layer are in typify_calibrate) leaves of them, group by group of group_by (a column of source), or of all in one group; NULL where min_distance alone decides. reached: rows of result that are drawn. not_drawn: rows with geom NULL or EMPTY; members_not_drawn: their members. lost: buildings that no row has as a member; repeated: those that several have.
overlapping: pairs of drawn polygons with a common area, of more than 1e-6 of the smaller one. narrow_gaps: pairs without, nearer to each other than min_gap. short_sides: polygons whose minimum-area bounding rectangle is narrower than min_side.
barriers: a table of lines, NULL for none (the three figures are NULL then). barrier_crossings: polygons that meet a line. barrier_gaps: polygons that do not, but are nearer to one than half of barrier_width (of the line''s symbol) and min_gap. members_across: buildings that a line parts from their placeholder: it meets the straight line from centre to centre.
displacement_median, displacement_p99: how far the centres of buildings are from those of their placeholders, median and 99th percentile, mm on the map. With members_column (integer array of ids of source; by default members, where result has such a column), a building''s placeholder is the drawn row that has it as a member; without, it is the one whose centre is nearest, and members_not_drawn, lost and repeated are NULL.
ink_before, ink_after: the black-white ratio, the share of settled ground that is inked: the sum of the areas of all buildings, and the area of the union of all polygons drawn, each divided by the area of the cells that contain the centre of a building.
density_cell: the side of the cells in units of the SRID, of a square grid through its origin; given as cell, mm on the map. density_correlation: of the numbers of buildings and polygons (their centres) in the cells where there is one. density_slope: of the regression of the numbers of polygons on those of buildings, divided by the ratio of all polygons to all buildings: 1 where differences in density stay as they are, below 1 where they are levelled. Both are NULL where all cells are alike.
rows_kept: the share of rows of buildings that are still rows, of those in source (found in each group, as typify_rows does) of which the law leaves two placeholders or more: two placeholders of their buildings at least, and the centres of all within 0.1 mm of the line along the buildings. NULL where there is no such row.
roads: a table of lines; without one, those of barriers. road_angle_before, road_angle: the median angle between the longer side of a building or polygon and the line nearest to its centre, modulo 90 degrees: from 0 (parallel or at right angles) to 45; NULL without lines.
dense_groups: how many groups are too dense to typify, which typify_dense_groups names; NULL where asked is.
Errors: 22004 for a NULL argument that needs a value, and for an id that is NULL; 22023 for a scale or length that is not allowed, ids that occur twice, two SRIDs, a geographic one, and coordinates that are not finite; 0A000 for a result that has other things than polygons, or lines that are none; 42P01, 42703, 42804, 42809 for tables and columns.';
