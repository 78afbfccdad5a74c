-- 40-window.sql: the window form

CREATE FUNCTION typify_cluster(
	geom geometry,
	scale double precision,
	s_u double precision DEFAULT 0,
	options typify_options DEFAULT NULL)
RETURNS integer
AS 'MODULE_PATHNAME'
LANGUAGE C IMMUTABLE PARALLEL SAFE WINDOW COST 10000;

COMMENT ON FUNCTION typify_cluster(geometry, double precision, double precision, typify_options) IS
'Window function: the number, from 0, of the placeholder that represents the row in its partition, in the canonical order of typify and typify_placeholders. The frame and the ORDER BY of the window do not matter, but for identical copies of a geometry that are not merged into one placeholder: which copy gets which of their numbers depends on the order of rows; typify_placeholders tells copies apart by id. NULL for a row whose geometry is NULL or EMPTY. scale: the denominator, at least source_scale (25000 unless set). s_u: density control in 0 .. 1; 0, the default, always merges the closest two. options: see typify_options; NULL sets none. Errors as of typify.';
