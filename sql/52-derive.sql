-- 52-derive.sql: placeholders of a whole table at any scale

CREATE FUNCTION typify_derive(
	lod25 regclass,
	lod200 regclass,
	scale double precision,
	s_u double precision DEFAULT 0,
	group_by name DEFAULT NULL,
	box geometry DEFAULT NULL,
	options typify_options DEFAULT NULL,
	allocation text DEFAULT 'each_group',
	id_column name DEFAULT 'id',
	geom_column name DEFAULT 'geom',
	lod200_geom_column name DEFAULT 'geom',
	lod200_group_by name DEFAULT NULL,
	links regclass DEFAULT NULL,
	groups text[] DEFAULT NULL)
RETURNS TABLE (
	id bigint,
	geom geometry,
	member_count integer,
	members bigint[],
	area double precision,
	width double precision,
	length double precision,
	orientation double precision,
	grp text)
LANGUAGE plpgsql STABLE PARALLEL RESTRICTED
SET search_path FROM CURRENT
AS $$
DECLARE
	source text := typify_lod25_source(lod25, id_column, geom_column, group_by, links);
BEGIN
	RETURN QUERY EXECUTE format(
		'SELECT p.*, g.grp FROM (
			SELECT grp, typify_placeholders(geom, id, $1, $2, $3) AS list FROM %1$s AS b
			WHERE ($4 IS NULL OR coalesce(grp, '''') = ANY ($4) AND grp IS NOT NULL
				OR grp IS NULL AND array_position($4, NULL) IS NOT NULL)
				AND ($5 IS NULL OR coalesce(''='' || grp, '''') IN (
					SELECT coalesce(''='' || grp, '''') FROM %1$s AS m WHERE geom && $5))
			GROUP BY grp) AS g, unnest(g.list) AS p', source)
		USING scale, s_u, options, groups, box;
END $$;
COMMENT ON FUNCTION typify_derive(regclass, regclass, double precision, double precision, name, geometry,
	typify_options, text, name, name, name, name, regclass, text[]) IS
'Placeholders of the buildings of a table at a scale, group by group.';
