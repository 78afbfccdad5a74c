-- 70-links.sql: which LOD25 buildings stand behind which LOD200 object, and what links, parts and blocks share

CREATE FUNCTION typify_centre(geom geometry)
RETURNS point
AS 'MODULE_PATHNAME'
LANGUAGE C IMMUTABLE STRICT PARALLEL SAFE COST 10;

COMMENT ON FUNCTION typify_centre(geometry) IS
'The point that stands for a building in typify: its centroid, or the centre of its box where an invalid outline (a bow-tie) has its centroid outside. In units of the SRID; NULL for EMPTY. Errors: 22023 for a geographic or geocentric SRID and coordinates that are not finite; 0A000 for curves, TINs, polyhedral surfaces and collections.';

CREATE FUNCTION typify_pairs(a point[], b point[], max_distance double precision)
RETURNS integer[]
AS 'MODULE_PATHNAME'
LANGUAGE C IMMUTABLE STRICT PARALLEL SAFE COST 10000;

COMMENT ON FUNCTION typify_pairs(point[], point[], double precision) IS
'Pairs two sets of points one to one, greedily by (distance, place in a, place in b), none farther apart than max_distance: for each point of a the place of its partner in b, counted from 1, or NULL. Takes about n log n for any sets. Errors: 22004 for an array that contains NULLs; 22023 for a coordinate that is not finite, and a max_distance that is not finite or below 0.';

CREATE FUNCTION typify_nearest(a point[], b point[])
RETURNS integer[]
AS 'MODULE_PATHNAME'
LANGUAGE C IMMUTABLE STRICT PARALLEL SAFE COST 10000;

COMMENT ON FUNCTION typify_nearest(point[], point[]) IS
'For each point of a the place of the nearest point of b, counted from 1, the first of equals; NULLs where b is empty. Needs no index. Errors: 22004 for an array that contains NULLs; 22023 for a coordinate that is not finite.';

CREATE FUNCTION typify_check_column(relation regclass, role text, column_name name, kind text)
RETURNS void
LANGUAGE plpgsql STABLE PARALLEL SAFE
SET search_path FROM CURRENT
AS $$
DECLARE
	type regtype;
	allowed regtype[] := CASE kind
		WHEN 'geometry' THEN ARRAY['geometry'::regtype]
		WHEN 'integer' THEN ARRAY['smallint'::regtype, 'integer'::regtype, 'bigint'::regtype] END;
BEGIN
	IF column_name IS NULL THEN
		RAISE EXCEPTION 'the name of a column of % must not be null', role
			USING ERRCODE = '22004', HINT = 'Leave the argument out to take its default.';
	END IF;
	SELECT CASE t.typtype WHEN 'd' THEN typify_base_type(t.oid) ELSE t.oid END INTO type
	FROM pg_catalog.pg_attribute AS a JOIN pg_catalog.pg_type AS t ON t.oid = a.atttypid
	WHERE a.attrelid = relation AND a.attname = column_name AND a.attnum > 0 AND NOT a.attisdropped;
	IF type IS NULL THEN
		RAISE EXCEPTION 'column % of % (%) does not exist', quote_ident(column_name), role, relation
			USING ERRCODE = '42703', HINT = 'Its columns are ' || coalesce((
				SELECT string_agg(quote_ident(attname), ', ' ORDER BY attnum) FROM pg_catalog.pg_attribute
				WHERE attrelid = relation AND attnum > 0 AND NOT attisdropped), 'none') || '.';
	END IF;
	IF type <> ALL (allowed) THEN
		RAISE EXCEPTION 'column % of % (%) has the type %', quote_ident(column_name), role, relation, type
			USING ERRCODE = '42804', HINT = CASE kind
				WHEN 'geometry' THEN 'Name a column of type geometry, or cast it in a view.'
				ELSE 'Name a column of whole numbers (bigint), or number the rows in a view.' END;
	END IF;
END $$;
COMMENT ON FUNCTION typify_check_column(regclass, text, name, text) IS
'Refuses a column that does not exist (42703), that has another type than geometry or, for kind integer, whole numbers (42804; kind NULL allows any), and a NULL name (22004). role: how messages call the table.';

CREATE FUNCTION typify_base_type(type oid) RETURNS regtype
LANGUAGE sql STABLE STRICT PARALLEL SAFE
BEGIN ATOMIC
	WITH RECURSIVE base(type) AS (
		SELECT typify_base_type.type
		UNION ALL
		SELECT t.typbasetype FROM base JOIN pg_type AS t ON t.oid = base.type WHERE t.typtype = 'd'
	)
	SELECT base.type::regtype FROM base JOIN pg_type AS t ON t.oid = base.type WHERE t.typtype <> 'd';
END;
COMMENT ON FUNCTION typify_base_type(oid) IS 'The type that a domain is made of; any other type itself';

CREATE FUNCTION typify_check_layer(relation regclass, role text, id_column name, geom_column name)
RETURNS integer
LANGUAGE plpgsql STABLE PARALLEL RESTRICTED
SET search_path FROM CURRENT
AS $$
DECLARE
	srids integer[];
	without_id boolean;
	twice bigint;
BEGIN
	IF relation IS NULL THEN
		RAISE EXCEPTION '% must not be null', role
			USING ERRCODE = '22004', HINT = 'Give the name of a table or view.';
	END IF;
	IF (SELECT relkind FROM pg_catalog.pg_class WHERE oid = relation) NOT IN ('r', 'p', 'v', 'm', 'f') THEN
		RAISE EXCEPTION '% (%) has no rows of buildings', role, relation
			USING ERRCODE = '42809', HINT = 'Give a table or view, a materialized view, or a foreign table.';
	END IF;
	PERFORM typify_check_column(relation, role, geom_column, 'geometry');
	EXECUTE format('SELECT array_agg(DISTINCT ST_SRID(%1$I) ORDER BY ST_SRID(%1$I)) FROM %2$s WHERE NOT ST_IsEmpty(%1$I)',
		geom_column, relation) INTO srids;
	IF cardinality(srids) > 1 THEN
		RAISE EXCEPTION 'the geometries of % (%) have two SRIDs, % and %', role, relation, srids[1], srids[2]
			USING ERRCODE = '22023', HINT = 'Use ST_Transform to bring them into one coordinate system.';
	END IF;
	-- the C room knows which systems are not planar
	PERFORM typify_centre(ST_SetSRID(ST_MakePoint(0, 0), srids[1]));
	IF id_column IS NOT NULL THEN
		PERFORM typify_check_column(relation, role, id_column, 'integer');
		EXECUTE format('SELECT bool_or(%1$I IS NULL) FROM %2$s WHERE NOT ST_IsEmpty(%3$I)', id_column, relation,
			geom_column) INTO without_id;
		IF without_id THEN
			RAISE EXCEPTION 'an id of % (%) is null', role, relation
				USING ERRCODE = '22004', HINT = format('Fill the column %I, or leave such rows out.', id_column);
		END IF;
		EXECUTE format('SELECT min(id) FROM (SELECT %1$I AS id FROM %2$s WHERE NOT ST_IsEmpty(%3$I)
			GROUP BY 1 HAVING count(*) > 1) AS several', id_column, relation, geom_column) INTO twice;
		IF twice IS NOT NULL THEN
			RAISE EXCEPTION 'the id % occurs twice in % (%)', twice, role, relation
				USING ERRCODE = '22023', HINT = 'Give each row an id of its own.';
		END IF;
	END IF;
	RETURN srids[1];
END $$;
COMMENT ON FUNCTION typify_check_layer(regclass, text, name, name) IS
'Refuses a table that cannot be read as a layer, and returns its SRID (NULL without any geometry). role: how messages call it. id_column NULL: ids are not asked for. Errors: 42703 and 42804 for columns, 42809 for what is no table, 22004 for NULLs, 22023 for ids that occur twice, two SRIDs and a geographic SRID.';

CREATE FUNCTION typify_check_same_srid(role_a text, srid_a integer, role_b text, srid_b integer)
RETURNS void
LANGUAGE plpgsql IMMUTABLE PARALLEL SAFE
SET search_path FROM CURRENT
AS $$
BEGIN
	IF srid_a <> srid_b THEN
		RAISE EXCEPTION '% and % have two SRIDs, % and %', role_a, role_b, srid_a, srid_b
			USING ERRCODE = '22023', HINT = 'Use ST_Transform, in a view, to bring them into one coordinate system.';
	END IF;
END $$;
COMMENT ON FUNCTION typify_check_same_srid(text, integer, text, integer) IS
'Refuses two layers of different SRIDs (22023); a NULL SRID stands for an empty layer and passes';

CREATE FUNCTION typify_match_options(options typify_options, n bigint) RETURNS typify_options
LANGUAGE plpgsql IMMUTABLE PARALLEL SAFE
SET search_path FROM CURRENT
AS $$
BEGIN
	options.count := n;
	options.exponent := NULL;
	options.count_rule := NULL;
	options.psi := NULL;
	options.area_statistic := NULL;
	options.shape := NULL;
	options.min_side := NULL;
	options.max_area := NULL;
	options.keep_area := NULL;
	options.min_gap := NULL;
	RETURN options;
END $$;
COMMENT ON FUNCTION typify_match_options(typify_options, bigint) IS
'Support of typify_match: the options with a count, without what only says how placeholders are drawn.';

-- Groups are joined by two columns, since NULL is a group too and only equality can be hashed. Placeholders without
-- size serve as well as others here, so their warning is not passed on. Planning without nested loops: what is joined
-- has no statistics, and a wrong guess would be quadratic.
CREATE FUNCTION typify_match(
	lod25 regclass,
	lod200 regclass,
	s_u double precision DEFAULT 0,
	group_by name DEFAULT NULL,
	max_distance double precision DEFAULT 2.5,
	options typify_options DEFAULT NULL,
	id_column name DEFAULT 'id',
	geom_column name DEFAULT 'geom',
	lod200_id_column name DEFAULT 'id',
	lod200_geom_column name DEFAULT 'geom',
	lod200_group_by name DEFAULT NULL)
RETURNS TABLE (lod25_id bigint, lod200_id bigint, distance double precision)
LANGUAGE plpgsql STABLE PARALLEL RESTRICTED COST 1000000 ROWS 10000
SET search_path FROM CURRENT
SET enable_nestloop = off
SET jit = off
SET client_min_messages = error
AS $$
DECLARE
	m200 double precision := coalesce(options.lod200_scale, 200000);
	srid integer := typify_check_layer(lod25, 'lod25', id_column, geom_column);
	srid200 integer := typify_check_layer(lod200, 'lod200', lod200_id_column, lod200_geom_column);
	max_length double precision := max_distance / 1000 * m200
		/ coalesce(typify_metres_per_unit(coalesce(srid, srid200)), 1);
BEGIN
	PERFORM typify_check_same_srid('lod25', srid, 'lod200', srid200);
	IF lod200_group_by IS NULL AND EXISTS (
		SELECT FROM pg_catalog.pg_attribute WHERE attrelid = lod200 AND attname = group_by AND NOT attisdropped
	) THEN
		lod200_group_by := group_by;
	END IF;
	IF group_by IS NOT NULL THEN
		PERFORM typify_check_column(lod25, 'lod25', group_by, NULL);
	ELSIF lod200_group_by IS NOT NULL THEN
		RAISE EXCEPTION 'lod200_group_by is given without group_by'
			USING ERRCODE = '22023', HINT = 'Give the column of lod25 that holds the same groups as group_by.';
	END IF;
	IF lod200_group_by IS NOT NULL THEN
		PERFORM typify_check_column(lod200, 'lod200', lod200_group_by, NULL);
	END IF;
	IF max_distance IS NULL OR NOT (max_distance >= 0 AND max_distance < 'Infinity') THEN
		RAISE EXCEPTION 'max_distance is %, it must be a finite number of at least 0', coalesce(max_distance::text, 'NULL')
			USING ERRCODE = CASE WHEN max_distance IS NULL THEN '22004' ELSE '22023' END,
				HINT = 'Give millimetres on the map at lod200_scale; 2.5 is usual.';
	END IF;
	IF options.count IS NOT NULL OR options.min_distance IS NOT NULL THEN
		RAISE EXCEPTION 'option % does not go with typify_match, which makes as many placeholders as lod200 has objects',
			CASE WHEN options.count IS NULL THEN 'min_distance' ELSE 'count' END
			USING ERRCODE = '22023', HINT = 'Leave the option out.';
	END IF;
	-- what is not asked for below is checked all the same
	PERFORM typify(ST_MakeEnvelope(0, 0, 1, 1), m200, s_u, options);
	RETURN QUERY EXECUTE format($query$
WITH detailed AS MATERIALIZED (
	SELECT id, geom, grp IS NULL AS no_grp, coalesce(grp, '') AS grp, centre
	FROM (SELECT %2$I::bigint AS id, %3$I AS geom, %4$s AS grp, typify_centre(%3$I) AS centre FROM %1$s) AS b
	WHERE centre IS NOT NULL
), objects AS MATERIALIZED (
	SELECT id, grp IS NULL AS no_grp, coalesce(grp, '') AS grp, centre
	FROM (SELECT %6$I::bigint AS id, %8$s AS grp, typify_centre(%7$I) AS centre FROM %5$s) AS b
	WHERE centre IS NOT NULL
), coarse AS MATERIALIZED (%9$s
), wanted AS MATERIALIZED (
	SELECT no_grp, grp, array_agg(id ORDER BY id) AS ids, array_agg(centre ORDER BY id) AS centres,
		typify_match_options($3, count(*)) AS options
	FROM coarse GROUP BY no_grp, grp
), placeholders AS MATERIALIZED (
	SELECT no_grp, grp, (p).id, (p).geom, (p).members
	FROM (SELECT no_grp, grp, unnest(typify_placeholders(d.geom, d.id, $1, $2, w.options)) AS p
		  FROM detailed AS d JOIN wanted AS w USING (no_grp, grp) GROUP BY no_grp, grp) AS made
), sizeless AS (
	SELECT p.id, point(avg(d.centre[0] ORDER BY d.id), avg(d.centre[1] ORDER BY d.id)) AS centre
	FROM (SELECT id, unnest(members) AS member FROM placeholders WHERE geom IS NULL) AS p
	JOIN detailed AS d ON d.id = p.member GROUP BY p.id
), offered AS (
	SELECT no_grp, grp, array_agg(id ORDER BY id) AS ids, array_agg(centre ORDER BY id) AS centres
	FROM (SELECT p.no_grp, p.grp, id, coalesce(typify_centre(p.geom), s.centre) AS centre
		  FROM placeholders AS p LEFT JOIN sizeless AS s USING (id)) AS placed
	GROUP BY no_grp, grp
), pairs AS MATERIALIZED (
	SELECT pair.id, ids200[pair.place] AS id200, pair.centre <-> centres200[pair.place] AS distance
	FROM (SELECT o.ids, o.centres, w.ids AS ids200, w.centres AS centres200
		  FROM offered AS o JOIN wanted AS w USING (no_grp, grp)) AS sets,
		unnest(ids, centres, typify_pairs(centres, centres200, $4)) AS pair (id, centre, place)
	WHERE pair.place IS NOT NULL
)
SELECT d.id, linked.id200, linked.distance
FROM detailed AS d LEFT JOIN (
	SELECT unnest(p.members) AS member, pairs.id200, pairs.distance FROM placeholders AS p JOIN pairs USING (id)
) AS linked ON linked.member = d.id
UNION ALL
SELECT NULL, o.id, NULL FROM objects AS o WHERE NOT EXISTS (SELECT FROM pairs WHERE pairs.id200 = o.id)
ORDER BY 1 NULLS LAST, 2$query$,
		lod25, id_column, geom_column, coalesce(quote_ident(group_by) || '::text', 'NULL::text'),
		lod200, lod200_id_column, lod200_geom_column, coalesce(quote_ident(lod200_group_by) || '::text', 'NULL::text'),
		CASE WHEN group_by IS NULL OR lod200_group_by IS NOT NULL THEN $coarse$
	SELECT id, no_grp, grp, centre FROM objects$coarse$ ELSE $coarse$
	SELECT o.id, coalesce(d.no_grp, true) AS no_grp, coalesce(d.grp, '') AS grp, o.centre
	FROM unnest((SELECT array_agg(id ORDER BY id) FROM objects), (SELECT array_agg(centre ORDER BY id) FROM objects),
		typify_nearest((SELECT array_agg(centre ORDER BY id) FROM objects),
			(SELECT array_agg(centre ORDER BY id) FROM detailed))) AS o (id, centre, place)
	LEFT JOIN (SELECT no_grp, grp, row_number() OVER (ORDER BY id) AS place FROM detailed) AS d USING (place)$coarse$ END)
	USING m200, s_u, options, max_length;
END $$;
COMMENT ON FUNCTION typify_match(regclass, regclass, double precision, name, double precision, typify_options, name,
	name, name, name, name) IS
'Links LOD25 buildings to LOD200 objects. Each group of LOD25 is typified to as many placeholders as it has LOD200 objects; placeholders and objects of the group are paired one to one, greedily by (distance, id of the placeholder, id of the object), at most max_distance apart (mm on the map at lod200_scale; the linear unit of the SRID is heeded). Distance: from the centre of the placeholder, the mean of its members'' centroids, to the centroid of the object, in units of the SRID. Rows, in this order: one per LOD25 building (lod200_id and distance NULL where its placeholder has no partner, or its group no LOD200 object), then one per LOD200 object without partner (lod25_id NULL). A group with more objects than buildings leaves the rest without partner. Rows without a usable geometry are passed over. group_by: a column of lod25, NULL being one group; objects take the group in their column lod200_group_by (default: the column that group_by names, if LOD200 has it), without one that of the LOD25 building whose centroid is nearest to theirs (of the smallest id among equally near ones). The same set of rows gives the same links. As a view or table it serves typify_derive as links. Errors: 42703, 42804, 42809 for columns and tables; 22004 for NULLs; 22023 for ids that occur twice, SRIDs that are two or geographic, numbers out of range, and the options count and min_distance; 0A000 for geometries and options that are not supported.';
