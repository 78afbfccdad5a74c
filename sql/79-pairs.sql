-- 79-pairs.sql: which polygons of a layer overlap, and which are too close

CREATE FUNCTION typify_box_pairs(a box[], b box[])
RETURNS TABLE (a_place integer, b_place integer)
AS 'MODULE_PATHNAME'
LANGUAGE C IMMUTABLE STRICT PARALLEL SAFE COST 10000 ROWS 100000;
COMMENT ON FUNCTION typify_box_pairs(box[], box[]) IS
'Which boxes of a meet which of b, borders included: their places, counted from 1. Needs no index. In the order of a. Errors: 22004 for an array that contains NULLs; 22023 for a coordinate that is not finite.';

CREATE FUNCTION typify_valid(geom geometry) RETURNS geometry
LANGUAGE sql IMMUTABLE STRICT PARALLEL SAFE
RETURN CASE WHEN ST_IsValid(geom) THEN geom ELSE ST_CollectionExtract(ST_MakeValid(geom), 3) END;
COMMENT ON FUNCTION typify_valid(geometry) IS 'The polygon itself where it is valid, else what ST_MakeValid makes of it';

-- Polygons that share no more than a border have a common area of rounding errors.
CREATE FUNCTION typify_close_pairs(geoms geometry[], min_gap double precision)
RETURNS TABLE (a_place bigint, b_place bigint, a geometry, b geometry, overlap boolean)
LANGUAGE plpgsql IMMUTABLE PARALLEL SAFE COST 100000 ROWS 1000
SET search_path FROM CURRENT
SET enable_nestloop = off
SET jit = off
AS $$
BEGIN
	RETURN QUERY
	WITH shape AS MATERIALIZED (
		SELECT geom, place, ST_Area(geom) AS area, box(geom) AS box, box(ST_Expand(geom, min_gap)) AS wide_box
		FROM unnest(geoms) WITH ORDINALITY AS s (geom, place)
	), near AS MATERIALIZED (
		SELECT one.place AS one, other.place AS other, one.geom, other.geom AS other_geom,
			least(one.area, other.area) AS area, ST_Distance(one.geom, other.geom) AS distance
		FROM typify_box_pairs((SELECT coalesce(array_agg(box ORDER BY place), '{}') FROM shape),
			(SELECT coalesce(array_agg(wide_box ORDER BY place), '{}') FROM shape)) AS near (one_place, other_place)
		JOIN shape AS one ON one.place = one_place JOIN shape AS other ON other.place = other_place
		WHERE one_place < other_place
	), judged AS MATERIALIZED (
		SELECT near.*, CASE WHEN distance = 0
			THEN ST_Area(ST_Intersection(typify_valid(geom), typify_valid(other_geom))) > 1e-6 * area
			ELSE false END AS overlaps_other
		FROM near WHERE distance = 0 OR distance < min_gap * (1 - 1e-6)
	)
	SELECT one, other, geom, other_geom, overlaps_other FROM judged WHERE overlaps_other OR min_gap > 0;
END $$;
COMMENT ON FUNCTION typify_close_pairs(geometry[], double precision) IS
'The pairs of polygons that overlap, or lie nearer to each other than min_gap (units of the SRID, up to 1e-6 relative): their places, counted from 1, a_place the smaller one, the polygons, and overlap: whether they have a common area, of more than 1e-6 of the smaller one. In no particular order; needs no index.';

CREATE FUNCTION typify_polygons(geom geometry) RETURNS geometry[]
LANGUAGE sql IMMUTABLE STRICT PARALLEL SAFE
BEGIN ATOMIC
	SELECT coalesce(array_agg(member ORDER BY place), '{}')
	FROM (SELECT coalesce(path[1], 1) AS place,
			CASE WHEN count(*) = 1 THEN (array_agg(part.geom))[1] ELSE ST_Collect(part.geom ORDER BY path) END AS member
		  FROM ST_Dump(typify_polygons.geom) AS part
		  WHERE ST_Dimension(part.geom) = 2 AND NOT ST_IsEmpty(part.geom) GROUP BY 1) AS members;
END;
COMMENT ON FUNCTION typify_polygons(geometry) IS
'The members of a collection that are areas, in its order; a multipolygon in a collection is one member';

CREATE FUNCTION typify_violations(geom geometry, min_gap double precision)
RETURNS TABLE (kind text, mark geometry)
LANGUAGE plpgsql IMMUTABLE STRICT PARALLEL SAFE COST 100000 ROWS 1000
SET search_path FROM CURRENT
AS $$
BEGIN
	PERFORM typify_check_length(min_gap, 'min_gap', 'Give a length in units of the SRID; 0 finds overlaps alone.');
	RETURN QUERY
	SELECT CASE WHEN overlap THEN 'overlap' ELSE 'gap' END,
		CASE WHEN overlap THEN ST_Normalize(ST_CollectionExtract(ST_Intersection(typify_valid(a), typify_valid(b)), 3))
			ELSE ST_ShortestLine(a, b) END
	FROM typify_close_pairs(typify_polygons(typify_violations.geom), min_gap)
	ORDER BY a_place, b_place;
END $$;
COMMENT ON FUNCTION typify_violations(geometry, double precision) IS
'Where the polygons of a collection are not legible, ready to be drawn. kind: overlap, with mark the area that two of them share; gap, with mark the shortest line between two that lie nearer to each other than min_gap (units of the SRID). Limits as of typify_quality. Points and lines are passed over. Ordered by the places of the polygons. NULL for NULLs. Errors: 22023 for a min_gap below 0 or not finite.';
