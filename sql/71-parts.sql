-- 71-parts.sql: touching parts joined to buildings, so that parts do not count as houses

-- Closing: out by half the tolerance and in again fills gaps, notches and holes up to it; mitres keep corners sharp.
CREATE FUNCTION typify_join_parts(parts geometry[], tolerance double precision) RETURNS geometry
LANGUAGE sql IMMUTABLE STRICT PARALLEL SAFE COST 1000
BEGIN ATOMIC
	SELECT CASE
		WHEN cardinality(parts) = 1 THEN parts[1]
		WHEN ST_IsEmpty(joined) THEN (
			SELECT ST_Multi(ST_Collect(piece.geom ORDER BY n, piece.path))
			FROM unnest(parts) WITH ORDINALITY AS part(geom, n), ST_Dump(part.geom) AS piece)
		WHEN tolerance = 0 THEN joined
		ELSE ST_CollectionExtract(ST_MakeValid(
			ST_Buffer(ST_Buffer(joined, tolerance / 2, 'join=mitre'), -tolerance / 2, 'join=mitre')), 3) END
	FROM (SELECT ST_UnaryUnion(ST_Collect(
			ST_CollectionExtract(ST_MakeValid(ST_Force2D(part.geom)), 3) ORDER BY n)) AS joined
		  FROM unnest(parts) WITH ORDINALITY AS part(geom, n)) AS united;
END;
COMMENT ON FUNCTION typify_join_parts(geometry[], double precision) IS
'Support of typify_dissolve: polygons joined to one POLYGON or MULTIPOLYGON, gaps up to the tolerance filled; one alone stays as it is';

CREATE FUNCTION typify_dissolve(geom geometry, tolerance double precision)
RETURNS TABLE (building geometry, parts integer[])
LANGUAGE plpgsql IMMUTABLE PARALLEL SAFE COST 100000 ROWS 1000
SET search_path FROM CURRENT
AS $$
BEGIN
	PERFORM typify_check_length(tolerance, 'tolerance', 'Give a length in units of the SRID; 0 joins what touches.');
	RETURN QUERY
	WITH part AS (
		SELECT n, CASE WHEN count(*) = 1 THEN (array_agg(piece.geom))[1] ELSE ST_Collect(piece.geom ORDER BY path) END AS geom
		FROM (SELECT coalesce(dumped.path[1], 1) AS n, dumped.path, dumped.geom
			  FROM ST_Dump(typify_dissolve.geom) AS dumped) AS piece
		GROUP BY n
	), grouped AS (
		SELECT n, part.geom, CASE WHEN ST_Dimension(part.geom) = 2
			THEN ST_ClusterDBSCAN(part.geom, tolerance, 1) OVER (PARTITION BY ST_Dimension(part.geom)) END AS house
		FROM part WHERE typify_centre(part.geom) IS NOT NULL
	)
	SELECT typify_join_parts(array_agg(grouped.geom ORDER BY n), tolerance), array_agg(n ORDER BY n)
	FROM grouped GROUP BY house, CASE WHEN house IS NULL THEN n END
	ORDER BY min(n);
END $$;
COMMENT ON FUNCTION typify_dissolve(geometry, double precision) IS
'Joins building parts that touch, overlap or lie at most tolerance apart (units of the SRID), also over third ones. geom: a collection of buildings, as ST_Collect makes it. One row per joined building: building, a POLYGON (a MULTIPOLYGON where parts meet in a corner or could not become one), and parts, the places in the collection of what it is made of, ascending, counted as ST_GeometryN does: the id map. Gaps, notches and holes up to the tolerance in width are filled; with 0 nothing is. Invalid outlines are repaired (ST_MakeValid) before they are joined. A building without neighbours stays as it is, and so do points and lines. EMPTY members are passed over. Rows are ordered by their first part; NULL or EMPTY gives none. typify_dissolve_table does it for a table. Errors: 22004 for a NULL tolerance; 22023 for one below 0 or not finite, for a geographic SRID and coordinates that are not finite; 0A000 for curves, TINs and polyhedral surfaces.';

CREATE FUNCTION typify_dissolve_table(
	buildings regclass,
	tolerance double precision DEFAULT 0,
	id_column name DEFAULT 'id',
	geom_column name DEFAULT 'geom')
RETURNS TABLE (id bigint, geom geometry, parts bigint[])
LANGUAGE plpgsql STABLE PARALLEL RESTRICTED COST 1000000 ROWS 10000
SET search_path FROM CURRENT
SET jit = off
AS $$
DECLARE
	source text := typify_source(buildings, 'buildings', '', id_column, geom_column, true);
BEGIN
	PERFORM typify_check_length(tolerance, 'tolerance', 'Give a length in units of the SRID; 0 joins what touches.');
	PERFORM typify_source_srid(source, buildings, geom_column, 'buildings'),
		typify_check_ids(source, buildings, id_column, 'id_column');
	RETURN QUERY EXECUTE format($query$
WITH grouped AS (
	SELECT id, geom, CASE WHEN dimension = 2
		THEN ST_ClusterDBSCAN(geom, $1, 1) OVER (PARTITION BY dimension) END AS house
	FROM (SELECT id, geom, ST_Dimension(geom) AS dimension FROM %s AS b WHERE typify_centre(geom) IS NOT NULL) AS part
)
SELECT (array_agg(id ORDER BY CASE ST_Dimension(geom) WHEN 2 THEN ST_Area(geom) END DESC, id))[1],
	typify_join_parts(array_agg(geom ORDER BY id), $1), array_agg(id ORDER BY id)
FROM grouped GROUP BY house, CASE WHEN house IS NULL THEN id END
ORDER BY 1$query$, source) USING tolerance;
END $$;
COMMENT ON FUNCTION typify_dissolve_table(regclass, double precision, name, name) IS
'typify_dissolve for a table or view of buildings: one row per joined building. id: of its largest part (of equals the smallest id), so that attributes can be joined on. geom: see typify_dissolve. parts: the ids of all its parts, ascending; over all rows each usable row of the table occurs exactly once, so that unnest(parts) is the map from part to building. Ordered by id. tolerance: in units of the SRID; 0 joins what touches. Errors as of typify_dissolve, and 42703, 42804, 42809 for columns and tables, 22004 for an id that is NULL, 22023 for ids that occur twice and for two SRIDs.';
