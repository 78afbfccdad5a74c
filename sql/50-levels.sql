-- 50-levels.sql: the two stored levels of detail, checked and as sources of buildings and objects with their groups

CREATE FUNCTION typify_centre(geom geometry)
RETURNS point
AS 'MODULE_PATHNAME'
LANGUAGE C IMMUTABLE STRICT PARALLEL SAFE COST 10;
COMMENT ON FUNCTION typify_centre(geometry) IS
'The point that stands for a building in typify: its centroid, or the centre of its box where an invalid outline (a bow-tie) has its centroid outside. In units of the SRID; NULL for EMPTY. Errors: 22023 for a geographic or geocentric SRID and coordinates that are not finite; 0A000 for curves, TINs, polyhedral surfaces and collections.';

CREATE FUNCTION typify_nearest(a point[], b point[])
RETURNS integer[]
AS 'MODULE_PATHNAME'
LANGUAGE C IMMUTABLE STRICT PARALLEL SAFE COST 10000;
COMMENT ON FUNCTION typify_nearest(point[], point[]) IS
'For each point of a the place of the nearest point of b, counted from 1, the first of equals; NULLs where b is empty. Needs no index. Errors: 22004 for an array that contains NULLs; 22023 for a coordinate that is not finite.';

CREATE FUNCTION typify_lod25_source(lod25 regclass, id_column name, geom_column name, group_by name, links regclass,
	groups text[] DEFAULT NULL, importance_column name DEFAULT NULL)
RETURNS text
LANGUAGE plpgsql STABLE PARALLEL SAFE
SET search_path FROM CURRENT
AS $$
DECLARE
	grp text := 'NULL';
	link text := '';
	condition text := 'true';
BEGIN
	IF links IS NOT NULL THEN
		IF group_by IS NOT NULL THEN
			RAISE EXCEPTION 'links and group_by are both given, but links are groups already'
				USING ERRCODE = '22023', HINT = 'Leave one of them out.';
		END IF;
		grp := 'l.' || typify_column_name(links, 'lod200_id', 'integer', 'links');
		link := format(' LEFT JOIN %s AS l ON l.%s = b.%I', typify_table_name(links, 'links'),
			typify_column_name(links, 'lod25_id', 'integer', 'links'), id_column);
		condition := typify_group_condition(links, 'lod200_id', 'l', groups);
	ELSIF group_by IS NOT NULL THEN
		PERFORM typify_table_name(lod25, 'lod25');
		grp := 'b.' || typify_column_name(lod25, group_by, 'any', 'group_by');
		condition := typify_group_condition(lod25, group_by, 'b', groups);
	END IF;
	RETURN typify_source(lod25, 'lod25', '', id_column, geom_column, true, grp, link, condition, importance_column);
END $$;
COMMENT ON FUNCTION typify_lod25_source(regclass, name, name, name, regclass, text[], name) IS
'The source (see typify_source) of the buildings of a table. grp is the column group_by as text, or lod200_id of links (a table or view with lod25_id and lod200_id), or NULL. groups: at least these groups; NULL for all. Errors: as of typify_source; 22023 for links together with group_by.';

-- A building is where its centre is, and so is an object of LOD200: one that covers buildings of several groups belongs
-- to the group that its middle is nearest to.
CREATE FUNCTION typify_nearest_groups(lod25_source text, lod200_source text)
RETURNS TABLE (id bigint, geom geometry, grp text)
LANGUAGE plpgsql STABLE PARALLEL RESTRICTED
SET search_path FROM CURRENT
-- of arrays the planner expects few rows
SET enable_nestloop = off
SET jit = off
AS $$
BEGIN
	RETURN QUERY EXECUTE format($query$
WITH building AS MATERIALIZED (
	SELECT row_number() OVER (ORDER BY id) AS building, grp, typify_centre(geom) AS centre FROM %s AS b
), object AS MATERIALIZED (
	SELECT row_number() OVER () AS object, id, geom, typify_centre(geom) AS centre FROM %s AS c
), nearest AS (
	SELECT * FROM unnest(typify_nearest((SELECT array_agg(centre ORDER BY object) FROM object),
		(SELECT array_agg(centre ORDER BY building) FROM building))) WITH ORDINALITY AS pair (building, object)
)
SELECT id, geom, grp FROM object LEFT JOIN nearest USING (object) LEFT JOIN building USING (building)$query$,
		lod25_source, lod200_source);
END $$;
COMMENT ON FUNCTION typify_nearest_groups(text, text) IS
'The objects of the second source, each with the group of the building of the first whose centre is nearest to the object''s centre, of equally near ones that with the smallest id. grp NULL: that of the building, or there is no building. Needs no index. Errors: as of typify_centre.';

CREATE FUNCTION typify_levels(lod25 regclass, lod200 regclass, id_column name, geom_column name,
	lod200_id_column name, lod200_geom_column name, group_by name, lod200_group_by name, links regclass, keyed boolean,
	importance_column name DEFAULT NULL,
	OUT lod25_source text, OUT lod200_source text, OUT srid integer)
LANGUAGE plpgsql STABLE PARALLEL RESTRICTED
SET search_path FROM CURRENT
AS $$
DECLARE
	grp text := 'NULL';
	objects text;
	lod200_srid integer;
BEGIN
	lod25_source := typify_lod25_source(lod25, id_column, geom_column, group_by, links, NULL, importance_column);
	IF lod200 IS NOT NULL THEN
		PERFORM typify_table_name(lod200, 'lod200');
		IF lod200_group_by IS NULL AND EXISTS (
			SELECT FROM pg_attribute WHERE attrelid = lod200 AND attname = group_by AND attnum > 0 AND NOT attisdropped)
		THEN
			lod200_group_by := group_by;
		END IF;
		IF links IS NOT NULL THEN
			keyed := true;
			grp := 'b.' || typify_column_name(lod200, lod200_id_column, 'integer', 'lod200_id_column');
		ELSIF lod200_group_by IS NOT NULL THEN
			grp := 'b.' || typify_column_name(lod200, lod200_group_by, 'any', 'lod200_group_by');
		END IF;
		IF lod200_group_by IS NOT NULL AND group_by IS NULL THEN
			RAISE EXCEPTION 'lod200_group_by is given without group_by'
				USING ERRCODE = '22023', HINT = CASE WHEN links IS NULL
					THEN 'Name the column of lod25 with group_by => ''...''.'
					ELSE 'Leave it out: with links, the groups are lod200_id_column.' END;
		END IF;
		objects := typify_source(lod200, 'lod200', 'lod200_', lod200_id_column, lod200_geom_column, keyed, grp);
		lod200_source := CASE WHEN group_by IS NULL OR lod200_group_by IS NOT NULL THEN objects
			ELSE format('typify_nearest_groups(%L, %L)', lod25_source, objects) END;
	END IF;
	srid := typify_source_srid(lod25_source, lod25, geom_column, 'lod25');
	PERFORM typify_check_ids(lod25_source, lod25, id_column, 'id_column', links);
	IF lod200 IS NOT NULL THEN
		lod200_srid := typify_source_srid(objects, lod200, lod200_geom_column, 'lod200');
		PERFORM typify_check_same_srid('lod25', srid, 'lod200', lod200_srid);
		srid := coalesce(srid, lod200_srid);
		IF keyed THEN
			PERFORM typify_check_ids(objects, lod200, lod200_id_column, 'lod200_id_column');
		END IF;
	END IF;
END $$;
COMMENT ON FUNCTION typify_levels(regclass, regclass, name, name, name, name, name, name, regclass, boolean, name) IS
'Checks two levels of detail and returns their sources (see typify_source) and SRID. The group of an object of LOD200 is, with links, its id; else its column lod200_group_by, or the column that group_by names if LOD200 has it; else that of the building nearest to it (typify_nearest_groups); without group_by it is NULL. keyed: whether ids of LOD200 are needed, as with links they always are. lod200 may be NULL. Errors: as of typify_source; 22023 for lod200_group_by without group_by, SRIDs that are two or not projected, and ids that occur twice; 22004 for ids that are NULL.';
