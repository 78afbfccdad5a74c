-- 41-rows.sql: which buildings stand in rows

CREATE TYPE typify_row_place AS (
	number integer,
	place integer
);
COMMENT ON TYPE typify_row_place IS
'Where a building stands: number of its row in the partition, and its place along the row, both from 0.';

CREATE FUNCTION typify_rows(geom geometry)
RETURNS typify_row_place
AS 'MODULE_PATHNAME'
LANGUAGE C IMMUTABLE PARALLEL SAFE WINDOW COST 10000;

COMMENT ON FUNCTION typify_rows(geometry) IS
'Window function: the row of buildings that the building stands in, as option alignment finds them, and its place along it; NULL for a building in no row, and where the geometry is NULL or EMPTY. A row is a chain of at least three neighbours of similar size and orientation, at regular spacing on a straight or gently curved line; each building is in at most one. Frame and ORDER BY of the window do not matter. A line along each row: SELECT (r).number, ST_MakeLine(ST_Centroid(geom) ORDER BY (r).place) FROM (SELECT geom, typify_rows(geom) OVER () AS r FROM buildings) AS b WHERE r IS NOT NULL GROUP BY 1. Errors as of typify.';
