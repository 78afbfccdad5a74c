-- 76-lookup.sql: placeholders at any scale from a hierarchy, and bringing it up to date

CREATE FUNCTION typify_check_box(box geometry, srid integer) RETURNS void
LANGUAGE plpgsql IMMUTABLE PARALLEL SAFE
SET search_path FROM CURRENT AS
$$
BEGIN
	PERFORM typify_check_same_srid('hierarchy', srid, 'box', ST_SRID(box));
	IF ST_IsEmpty(box) THEN
		RAISE EXCEPTION 'box is empty' USING ERRCODE = 'invalid_parameter_value',
			HINT = 'Leave it out to get everything.';
	ELSIF NOT (abs(ST_XMin(box)) < 'Infinity' AND abs(ST_XMax(box)) < 'Infinity'
			AND abs(ST_YMin(box)) < 'Infinity' AND abs(ST_YMax(box)) < 'Infinity') THEN
		RAISE EXCEPTION 'a coordinate of box is not finite' USING ERRCODE = 'invalid_parameter_value',
			HINT = 'Leave the box out to get everything.';
	END IF;
END
$$;
COMMENT ON FUNCTION typify_check_box(geometry, integer) IS
'Refuses (22023) a box in which to look that is of another SRID, empty or not finite; NULL passes.';

CREATE FUNCTION typify_hierarchy_lookup(hierarchy regclass, scale double precision, box geometry,
	OUT nodes text, OUT groups text, OUT options typify_options, OUT srid integer, OUT metres_per_unit double precision,
	OUT areas box[])
LANGUAGE plpgsql STABLE PARALLEL SAFE
SET search_path FROM CURRENT AS
$$
DECLARE
	definition jsonb;
BEGIN
	SELECT part.nodes, part.groups, part.definition INTO nodes, groups, definition
	FROM typify_hierarchy_parts(hierarchy) AS part;
	IF definition->'finished' = 'false' THEN
		RAISE EXCEPTION '% is not finished', nodes USING ERRCODE = 'object_not_in_prerequisite_state',
			HINT = 'Call typify_build_hierarchy with the same arguments to go on with it.';
	ELSIF scale IS NULL THEN
		PERFORM typify_refuse_null('scale');
	END IF;
	options := typify_hierarchy_options(definition);
	-- refuses a scale that is not allowed
	PERFORM typify_area_factor(scale, options);
	srid := typify_hierarchy_srid(groups::regclass);
	metres_per_unit := typify_metres_per_unit(srid);
	PERFORM typify_check_box(box, srid);
	areas := typify_search(box(point(ST_XMin(box), ST_YMin(box)), point(ST_XMax(box), ST_YMax(box))), scale, scale,
		(definition->>'reach')::float8, (definition->>'top')::float8, coalesce(options.source_scale, 25000),
		coalesce(options.lod200_scale, 200000), coalesce(options.min_side, 0) * scale / 1000 / metres_per_unit);
END
$$;
COMMENT ON FUNCTION typify_hierarchy_lookup(regclass, double precision, geometry) IS
'What a look-up needs to know of a hierarchy: its tables, options and SRID, metres in a unit of that, and where in its index to look (typify_search; NULL without a box). Errors: as of typify_at.';

CREATE FUNCTION typify_lookup_query(nodes text, groups text, boxed boolean, with_members boolean) RETURNS text
LANGUAGE sql IMMUTABLE PARALLEL SAFE
BEGIN ATOMIC
	SELECT format('SELECT (p).id, (p).geom, (p).member_count, %3$s, (p).area, (p).width, (p).length, (p).orientation, grp '
		'FROM (SELECT n.group_id, n.first_leaf, n.x, n.y, g.grp, typify_node_placeholder(n.representative, '
			'n.x, n.y, n.area, n.ratio, n.ux, n.uy, n.member_count, n.kept, $1, $2, g.psi, $3, $4) AS p '
		'FROM %4$s JOIN %2$s AS g USING (group_id) '
		'WHERE n.scale_from <= $1 AND n.scale_to > $1 OFFSET 0) AS alive WHERE %5$s',
		nodes, groups,
		CASE WHEN with_members THEN format('CASE WHEN (p).member_count = 1 THEN ARRAY[(p).id] ELSE ARRAY('
			'SELECT leaf.representative FROM %s AS leaf WHERE leaf.group_id = alive.group_id AND leaf.node BETWEEN '
			'alive.first_leaf AND alive.first_leaf + (p).member_count - 1 ORDER BY 1) END', nodes) ELSE 'NULL::bigint[]' END,
		CASE WHEN boxed THEN format('unnest($5) AS found (area) JOIN %s AS n ON n.place <@ found.area', nodes)
			ELSE nodes || ' AS n' END,
		CASE WHEN boxed THEN 'ST_Intersects(coalesce((p).geom, ST_SetSRID(ST_MakePoint(x, y), $3)), $6)' ELSE 'true' END);
END;
COMMENT ON FUNCTION typify_lookup_query(text, text, boolean, boolean) IS
'SQL that gives the rows of typify_at. $1: scale, $2: options, $3: SRID, $4: metres in its unit, and where it is boxed $5: areas of the index, $6: box.';

CREATE FUNCTION typify_at(
	hierarchy regclass,
	scale double precision,
	box geometry DEFAULT NULL,
	with_members boolean DEFAULT true)
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
LANGUAGE plpgsql STABLE PARALLEL SAFE
SET search_path FROM CURRENT
SET jit = off
-- of <@ the planner knows nothing, and takes a thousandth of the table for each area
SET enable_seqscan = off AS
$$
DECLARE
	look record := typify_hierarchy_lookup(hierarchy, scale, box);
BEGIN
	IF with_members IS NULL THEN
		PERFORM typify_refuse_null('with_members');
	END IF;
	RETURN QUERY EXECUTE typify_lookup_query(look.nodes, look.groups, box IS NOT NULL, with_members)
		USING scale, look.options, look.srid, look.metres_per_unit, look.areas, box;
END
$$;
COMMENT ON FUNCTION typify_at(regclass, double precision, geometry, boolean) IS
'The placeholders at any scale from a hierarchy that typify_build_hierarchy made. Rows in no particular order: the fields of typify_placeholder, and grp, the group as text. With life_spans => ''each_group'' they are those that typify_placeholders gives for each group at that scale, exactly; at any scale, and in milliseconds.
scale: the denominator, at least source_scale. box: only placeholders whose polygon meets it, also where its centre lies outside, found by an index; one that has no size, by its place. The polygons are the same with any box. with_members: false leaves members NULL, which is faster.
Errors: 42809 for a table that is no hierarchy; 42P01 when its table of groups is missing; 55000 for one that is not finished; 22023 for a scale that is not allowed, and a box that is empty, of another SRID or not finite; 22004 for NULL, but for box.';
