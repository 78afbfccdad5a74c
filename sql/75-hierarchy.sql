-- 75-hierarchy.sql: the whole merge sequence of a group as nodes, and the table of them that a procedure builds

CREATE TYPE typify_node AS (
	node integer,
	parent integer,
	kept boolean,
	representative bigint,
	member_count integer,
	first_leaf integer,
	x double precision,
	y double precision,
	area double precision,
	ratio double precision,
	ux double precision,
	uy double precision,
	cost double precision,
	scale_from double precision,
	scale_to double precision
);
COMMENT ON TYPE typify_node IS
'A node of a hierarchy: a vertex of the mesh for as long as it is there. node: its number; leaves, the buildings, are 0 to n - 1 in tree order, inner nodes follow in the order in which they appear. parent: the node it is merged into, NULL of a root. kept: its representative has importance Infinity, so that the node stands there and is drawn with its own area. representative: id of the building that stands for it, of a leaf its own. member_count, first_leaf: its members are the leaves first_leaf to first_leaf + member_count - 1. x, y: the vertex. area: statistic of the members'' areas (area_statistic), unscaled, or of a kept one its own. ratio, ux, uy: short by long side and direction of the longer side of the representative''s rectangle. cost: the greatest of a merge up to the one that made the node, 0 of leaves. scale_from, scale_to: it is there for scale_from <= scale < scale_to, leaves from source_scale on, roots to Infinity. Ground units throughout; scales are denominators.';

CREATE FUNCTION typify_hierarchy_final(internal)
RETURNS typify_node[]
AS 'MODULE_PATHNAME'
LANGUAGE C IMMUTABLE PARALLEL SAFE COST 10000;
COMMENT ON FUNCTION typify_hierarchy_final(internal) IS
'Support of typify_hierarchy: merges the buildings of a group down to one.';

CREATE FUNCTION typify_hierarchy_transition(internal, geometry, bigint, double precision)
RETURNS internal
AS 'MODULE_PATHNAME'
LANGUAGE C IMMUTABLE PARALLEL SAFE COST 10;
COMMENT ON FUNCTION typify_hierarchy_transition(internal, geometry, bigint, double precision) IS
'Support of typify_hierarchy: measures a building and adds it to its group.';

CREATE AGGREGATE typify_hierarchy(
	geom geometry,
	id bigint,
	s_u double precision)
(
	SFUNC = typify_hierarchy_transition,
	STYPE = internal,
	SSPACE = 1024,
	FINALFUNC = typify_hierarchy_final,
	COMBINEFUNC = typify_combine,
	SERIALFUNC = typify_serialize,
	DESERIALFUNC = typify_deserialize,
	PARALLEL = SAFE
);
COMMENT ON AGGREGATE typify_hierarchy(geometry, bigint, double precision) IS
'The hierarchy of the buildings of a group: every vertex that there is at any scale, with its life span, as an array of typify_node in the order of their numbers. Those alive at a scale are the placeholders that typify_placeholders gives at that scale, exactly; typify_at draws them from a table that typify_build_hierarchy makes. The same bytes for any order of rows, serial or parallel. NULL for a group without a usable row. id: a key of the building inside its group. s_u: density control in 0 .. 1. A row whose geometry is NULL or EMPTY is passed over. Errors: as of typify_placeholders; 22023 for options that make the result depend on one scale: count, min_distance, the black-white rule, min_area, keep_area; 0A000 for shapes with outlines; 54000 above 1 GB, four million buildings in a group.';

CREATE FUNCTION typify_hierarchy_transition(internal, geometry, bigint, double precision, typify_options)
RETURNS internal
AS 'MODULE_PATHNAME'
LANGUAGE C IMMUTABLE PARALLEL SAFE COST 10;
COMMENT ON FUNCTION typify_hierarchy_transition(internal, geometry, bigint, double precision, typify_options) IS
'Support of typify_hierarchy: measures a building and adds it to its group.';

CREATE AGGREGATE typify_hierarchy(
	geom geometry,
	id bigint,
	s_u double precision,
	options typify_options)
(
	SFUNC = typify_hierarchy_transition,
	STYPE = internal,
	SSPACE = 1024,
	FINALFUNC = typify_hierarchy_final,
	COMBINEFUNC = typify_combine,
	SERIALFUNC = typify_serialize,
	DESERIALFUNC = typify_deserialize,
	PARALLEL = SAFE
);
COMMENT ON AGGREGATE typify_hierarchy(geometry, bigint, double precision, typify_options) IS
'The hierarchy of the buildings of a group: every vertex that there is at any scale, with its life span, as an array of typify_node in the order of their numbers. Those alive at a scale are the placeholders that typify_placeholders gives at that scale, exactly; typify_at draws them from a table that typify_build_hierarchy makes. The same bytes for any order of rows, serial or parallel. NULL for a group without a usable row. id: a key of the building inside its group. s_u: density control in 0 .. 1. options: see typify_options; NULL sets none. A row whose geometry is NULL or EMPTY is passed over. Errors: as of typify_placeholders; 22023 for options that make the result depend on one scale: count, min_distance, the black-white rule, min_area, keep_area; 0A000 for shapes with outlines; 54000 above 1 GB, four million buildings in a group.';

CREATE FUNCTION typify_hierarchy_transition(internal, geometry, bigint, double precision, typify_options, double precision)
RETURNS internal
AS 'MODULE_PATHNAME'
LANGUAGE C IMMUTABLE PARALLEL SAFE COST 10;
COMMENT ON FUNCTION typify_hierarchy_transition(internal, geometry, bigint, double precision, typify_options, double precision) IS
'Support of typify_hierarchy: measures a building and adds it to its group.';

CREATE AGGREGATE typify_hierarchy(
	geom geometry,
	id bigint,
	s_u double precision,
	options typify_options,
	importance double precision)
(
	SFUNC = typify_hierarchy_transition,
	STYPE = internal,
	SSPACE = 1024,
	FINALFUNC = typify_hierarchy_final,
	COMBINEFUNC = typify_combine,
	SERIALFUNC = typify_serialize,
	DESERIALFUNC = typify_deserialize,
	PARALLEL = SAFE
);
COMMENT ON AGGREGATE typify_hierarchy(geometry, bigint, double precision, typify_options, double precision) IS
'The hierarchy of the buildings of a group: every vertex that there is at any scale, with its life span, as an array of typify_node in the order of their numbers. Those alive at a scale are the placeholders that typify_placeholders gives at that scale, exactly; typify_at draws them from a table that typify_build_hierarchy makes. The same bytes for any order of rows, serial or parallel. NULL for a group without a usable row. id: a key of the building inside its group. s_u: density control in 0 .. 1. options: see typify_options; NULL sets none. importance: of the building, as in typify_placeholders; Infinity keeps it. A row whose geometry is NULL or EMPTY is passed over. Errors: as of typify_placeholders; 22023 for options that make the result depend on one scale: count, min_distance, the black-white rule, min_area, keep_area; 0A000 for shapes with outlines; 54000 above 1 GB, four million buildings in a group.';

CREATE TYPE typify_hierarchy_made AS (
	count bigint,
	state bigint,
	reach double precision,
	west double precision,
	south double precision,
	east double precision,
	north double precision
);
COMMENT ON TYPE typify_hierarchy_made IS
'What typify_write_hierarchy wrote of a group. count: of its buildings; state: typify_building_hash of each, combined by bit_xor; reach: the greatest of its nodes (typify_reach); west to north: the box of its vertices.';

CREATE FUNCTION typify_write_hierarchy_transition(internal, geometry, bigint, double precision, typify_options, geometry,
	double precision, regclass, integer)
RETURNS internal
AS 'MODULE_PATHNAME'
LANGUAGE C;
COMMENT ON FUNCTION typify_write_hierarchy_transition(internal, geometry, bigint, double precision, typify_options,
	geometry, double precision, regclass, integer) IS
'Support of typify_write_hierarchy: measures a building and adds it to its group.';

CREATE FUNCTION typify_write_hierarchy_final(internal)
RETURNS typify_hierarchy_made
AS 'MODULE_PATHNAME'
LANGUAGE C COST 10000;
COMMENT ON FUNCTION typify_write_hierarchy_final(internal) IS
'Support of typify_write_hierarchy: merges the buildings of a group down to one and writes the nodes.';

CREATE AGGREGATE typify_write_hierarchy(
	geom geometry,
	id bigint,
	s_u double precision,
	options typify_options,
	barriers geometry,
	importance double precision,
	hierarchy regclass,
	group_id integer)
(
	SFUNC = typify_write_hierarchy_transition,
	STYPE = internal,
	SSPACE = 1024,
	FINALFUNC = typify_write_hierarchy_final,
	FINALFUNC_MODIFY = READ_WRITE
);
COMMENT ON AGGREGATE typify_write_hierarchy(geometry, bigint, double precision, typify_options, geometry, double precision,
	regclass, integer) IS
'Support of typify_build_hierarchy: typify_hierarchy with barriers as an argument of its own, which puts the nodes into the table of a hierarchy, as those of this group, instead of returning them. hierarchy, group_id: the same for all buildings of a group. Needs INSERT on the table. Errors: as of typify_hierarchy but for the size of the result; 22004 for NULL as hierarchy or group_id; 42809 for a table whose columns are not those of a hierarchy; 0A000 for one with triggers on INSERT, row-level security, CHECK constraints or further columns that do not take NULL, which rows are written past; 25006 in a transaction that only reads.';

CREATE FUNCTION typify_building_hash(geom geometry, id bigint, importance double precision)
RETURNS bigint
AS 'MODULE_PATHNAME'
LANGUAGE C IMMUTABLE STRICT PARALLEL SAFE COST 10;
COMMENT ON FUNCTION typify_building_hash(geometry, bigint, double precision) IS
'A hash of what a hierarchy takes from a building: its id, centroid, area and rectangle, and its importance. NULL for EMPTY. Errors: as of typify for geometries.';

CREATE FUNCTION typify_leaf_hash(representative bigint, x double precision, y double precision, area double precision,
	ratio double precision, ux double precision, uy double precision)
RETURNS bigint
AS 'MODULE_PATHNAME'
LANGUAGE C IMMUTABLE STRICT PARALLEL SAFE;
COMMENT ON FUNCTION typify_leaf_hash(bigint, double precision, double precision, double precision, double precision,
	double precision, double precision) IS
'What typify_building_hash says of a building of importance 1 of which this leaf was made.';

CREATE FUNCTION typify_reach(area double precision, ratio double precision, psi double precision)
RETURNS double precision
AS 'MODULE_PATHNAME'
LANGUAGE C IMMUTABLE STRICT PARALLEL SAFE;
COMMENT ON FUNCTION typify_reach(double precision, double precision, double precision) IS
'How far the rectangle of a node reaches from its vertex before it is enlarged, half its diagonal: what typify_place and typify_search sort by size. More for a psi below 0.75, which is enlarged more.';

CREATE FUNCTION typify_place(x double precision, y double precision, reach double precision,
	scale_from double precision, scale_to double precision, source_scale double precision)
RETURNS point
AS 'MODULE_PATHNAME'
LANGUAGE C IMMUTABLE STRICT PARALLEL SAFE;
COMMENT ON FUNCTION typify_place(double precision, double precision, double precision, double precision,
	double precision, double precision) IS
'Where a node stands in the index of a hierarchy: its vertex, moved by 2^28 units in x for each band of scale_to (two bands for a doubling of the scale, the last one for roots) and in y for each class of its reach and, within that, of how many bands its life span lasts.';

CREATE FUNCTION typify_search(box box, scale_from double precision, scale_to double precision, reach double precision,
	top double precision, source_scale double precision, lod200_scale double precision, min_side double precision)
RETURNS box[]
AS 'MODULE_PATHNAME'
LANGUAGE C IMMUTABLE STRICT PARALLEL SAFE;
COMMENT ON FUNCTION typify_search(box, double precision, double precision, double precision, double precision,
	double precision, double precision, double precision) IS
'Where to look in the index of a hierarchy (see typify_place): every node that is alive at a scale from scale_from to scale_to and whose polygon then meets box has its place in one of these. They hold others too. reach, top: the greatest reach and the greatest finite scale_to of the hierarchy. min_side: in ground units at scale_to.';

CREATE FUNCTION typify_node_placeholder(representative bigint, x double precision, y double precision,
	area double precision, ratio double precision, ux double precision, uy double precision, member_count integer,
	kept boolean, scale double precision, options typify_options, psi double precision, srid integer, metres_per_unit double precision)
RETURNS typify_placeholder
AS 'MODULE_PATHNAME'
LANGUAGE C IMMUTABLE PARALLEL SAFE COST 10;
COMMENT ON FUNCTION typify_node_placeholder(bigint, double precision, double precision, double precision,
	double precision, double precision, double precision, integer, boolean, double precision, typify_options,
	double precision, integer, double precision) IS
'A node of a hierarchy as it is drawn at a scale: the placeholder of typify_placeholders at that scale, but for members, which is NULL. psi: instead of that of options, unless it is NULL. metres_per_unit: of the SRID. NULL when anything else but options is. Errors: as of typify_placeholders for scale and options.';

-- The comment of a hierarchy is that of a table layer (60-layers.sql) with a source instead of lod25 and life_spans
-- instead of scale and allocation, so that what reads and calibrates the tables of a layer does so here.
CREATE FUNCTION typify_hierarchy_definition(source regclass, s_u double precision, group_by name,
	options typify_options, life_spans text, lod200 regclass, id_column name, geom_column name, lod200_id_column name,
	lod200_geom_column name, lod200_group_by name, links regclass, barriers regclass, barriers_geom_column name,
	importance_column name)
RETURNS json
LANGUAGE plpgsql STABLE PARALLEL SAFE
SET search_path FROM CURRENT
SET extra_float_digits = 1 AS
$$
DECLARE
	layer json;
BEGIN
	PERFORM typify_table_name(source, 'source');
	IF life_spans IS NULL THEN
		PERFORM typify_refuse_null('life_spans');
	ELSIF (options).min_gap > 0 THEN
		RAISE EXCEPTION 'a hierarchy keeps no min_gap, since what is shown of neighbouring boxes would disagree'
			USING ERRCODE = 'invalid_parameter_value',
			HINT = 'Leave it out, or store a legible layer for each scale with typify_create_scale.';
	ELSIF life_spans NOT IN ('each_group', 'ranked') THEN
		RAISE EXCEPTION 'life_spans is "%", it must be each_group or ranked', life_spans
			USING ERRCODE = 'invalid_parameter_value',
			HINT = 'each_group gives every group its own count at a scale, ranked merges what is closest in all groups first.';
	END IF;
	layer := typify_layer_definition(source, lod200, coalesce((options).source_scale, 25000), s_u, group_by, options,
		'each_group', id_column, geom_column, lod200_id_column, lod200_geom_column, lod200_group_by, links, barriers,
		barriers_geom_column, importance_column);
	PERFORM typify_hierarchy(ST_SetSRID('POINT(0 0)'::geometry, coalesce(ST_SRID((options).barriers), 0)), 0, s_u, options);
	RETURN (SELECT json_object_agg(CASE key WHEN 'lod25' THEN 'source' WHEN 'allocation' THEN 'life_spans' ELSE key END,
			CASE key WHEN 'allocation' THEN to_json(life_spans) ELSE value END)
		FROM json_each(layer) WHERE key <> 'scale');
END
$$;
COMMENT ON FUNCTION typify_hierarchy_definition(regclass, double precision, name, typify_options, text, regclass, name,
	name, name, name, name, regclass, regclass, name, name) IS
'How a hierarchy is made, as its comment says it: a JSON object of the version of typify and the arguments of typify_build_hierarchy by their names. Errors: as of typify_layer_definition and typify_hierarchy; 22023 for other life_spans.';

CREATE FUNCTION typify_hierarchy_layer(definition jsonb) RETURNS jsonb
LANGUAGE sql IMMUTABLE PARALLEL SAFE
BEGIN ATOMIC
	SELECT definition - ARRAY['source', 'life_spans', 'reach', 'top', 'barriers_state'] || jsonb_build_object(
		'lod25', definition->'source', 'scale', coalesce((definition->'options'->>'source_scale')::float8, 25000),
		'allocation', 'each_group');
END;
COMMENT ON FUNCTION typify_hierarchy_layer(jsonb) IS
'The definition of a hierarchy as that of a layer at source_scale, for the functions that read a layer''s tables.';

CREATE FUNCTION typify_hierarchy_options(definition jsonb) RETURNS typify_options
LANGUAGE sql STABLE PARALLEL SAFE
BEGIN ATOMIC
	SELECT jsonb_populate_record(NULL::typify_options, nullif(definition->'options', 'null'));
END;
COMMENT ON FUNCTION typify_hierarchy_options(jsonb) IS
'The options in the comment of a hierarchy.';

CREATE FUNCTION typify_hierarchy_parts(hierarchy regclass, OUT nodes text, OUT groups text, OUT definition jsonb)
LANGUAGE plpgsql STABLE PARALLEL SAFE
SET search_path FROM CURRENT AS
$$
BEGIN
	nodes := typify_table_name(hierarchy, 'hierarchy');
	definition := typify_layer_comment(hierarchy);
	IF NOT coalesce(definition ?& ARRAY['typify', 'source', 'life_spans', 's_u', 'options'], false) THEN
		RAISE EXCEPTION '% is not a hierarchy of typify', nodes USING ERRCODE = 'wrong_object_type',
			HINT = 'Hierarchies are made by typify_build_hierarchy; the JSON in their comment says how and must stay.';
	END IF;
	SELECT format('%I.%I', nspname, relname || '_groups') INTO groups
	FROM pg_class JOIN pg_namespace ON pg_namespace.oid = relnamespace WHERE pg_class.oid = hierarchy;
	IF to_regclass(groups) IS NULL THEN
		RAISE EXCEPTION 'the groups of %, %, are missing', nodes, groups USING ERRCODE = 'undefined_table',
			HINT = 'A hierarchy and its table of groups are renamed and moved together; without it, build anew.';
	END IF;
END
$$;
COMMENT ON FUNCTION typify_hierarchy_parts(regclass) IS
'The table of nodes and its companion of groups, named with schema, and the JSON of the comment. Errors: 22004 for NULL; 42809 for what is no hierarchy; 42P01 when the companion is missing.';

CREATE FUNCTION typify_hierarchy_srid(groups regclass) RETURNS integer
LANGUAGE sql STABLE PARALLEL SAFE
BEGIN ATOMIC
	SELECT postgis_typmod_srid(atttypmod) FROM pg_attribute
	WHERE attrelid = groups AND attname = 'extent' AND atttypmod >= 0;
END;
COMMENT ON FUNCTION typify_hierarchy_srid(regclass) IS
'The SRID of a hierarchy, from the type of the extent in its table of groups.';

CREATE FUNCTION typify_hierarchy_create(nodes text, groups text, definition json) RETURNS regclass
LANGUAGE plpgsql
SET search_path FROM CURRENT AS
$$
DECLARE
	layer jsonb := typify_hierarchy_layer(definition::jsonb);
	extent_type text;
BEGIN
	-- by any building: whether all have its SRID is looked at when they are read (typify_plan)
	EXECUTE format('SELECT format(''geometry(Polygon, %%s)'', ST_SRID(geom)) FROM %s AS b LIMIT 1', typify_layer_source(layer))
	INTO extent_type;
	EXECUTE format('CREATE TABLE %s (group_id integer NOT NULL, node integer NOT NULL, parent integer, '
		'kept boolean NOT NULL, representative bigint NOT NULL, member_count integer NOT NULL, first_leaf integer NOT NULL, '
		'x float8 NOT NULL, y float8 NOT NULL, area float8 NOT NULL, ratio float8 NOT NULL, ux float8 NOT NULL, '
		'uy float8 NOT NULL, cost float8 NOT NULL, scale_from float8 NOT NULL, scale_to float8 NOT NULL, '
		'place point NOT NULL)', nodes);
	EXECUTE format('CREATE TABLE %s (group_id integer PRIMARY KEY, grp text, count bigint NOT NULL, exponent float8, '
		'psi float8, built boolean NOT NULL DEFAULT false, state bigint, reach float8, extent %s, latitude float8)', groups,
		coalesce(extent_type, typify_layer_geometry(layer)));
	EXECUTE format('COMMENT ON TABLE %s IS %L', nodes, definition);
	EXECUTE format('COMMENT ON TABLE %s IS %L', groups, format('The groups of %s.', nodes));
	RETURN nodes::regclass;
END
$$;
COMMENT ON FUNCTION typify_hierarchy_create(text, text, json) IS
'The two empty tables of a hierarchy. Of nodes: group_id and the fields of typify_node, and place, by which they are found (typify_place). Of groups: grp, the group as text; count of its buildings; exponent and psi, where they are the group''s own; built, whether its nodes are there; state, a hash of its buildings (typify_building_hash of each, combined by bit_xor); reach, the greatest of its nodes (typify_reach); extent of its vertices; latitude of the middle of that, NULL where the SRID is not known. Both get their keys when they are filled.';

CREATE FUNCTION typify_hierarchy_barriers(definition jsonb) RETURNS bigint
LANGUAGE plpgsql STABLE PARALLEL RESTRICTED
SET search_path FROM CURRENT
SET jit = off AS
$$
DECLARE
	state bigint;
BEGIN
	IF to_regclass(definition->>'barriers') IS NOT NULL THEN
		EXECUTE format('SELECT coalesce(sum(hash_record(b)), 0) FROM %s AS b', typify_barrier_source(
			(definition->>'barriers')::regclass, (definition->>'barriers_geom_column')::name)) INTO state;
	END IF;
	RETURN state;
END
$$;
COMMENT ON FUNCTION typify_hierarchy_barriers(jsonb) IS
'A number that tells whether the table of barriers of a hierarchy is the same as before; NULL without one.';

CREATE TYPE typify_hierarchy_change AS (
	group_id integer,
	grp text,
	count bigint,
	exponent double precision,
	psi double precision
);
COMMENT ON TYPE typify_hierarchy_change IS
'A group of a hierarchy whose nodes are to be made, with what they are made of now. group_id: NULL for a new group. count: 0 for one that has no buildings any more. exponent, psi: where they are its own.';

-- A group counts as changed when its buildings, exponent or psi are not what its nodes were made of, and when it is
-- named; all count as changed when the table of barriers is another than before. Where nothing is calibrated, and groups
-- are named, nothing else is looked at.
CREATE FUNCTION typify_hierarchy_changes(hierarchy regclass, named text[]) RETURNS typify_hierarchy_change[]
LANGUAGE plpgsql STABLE PARALLEL RESTRICTED
SET search_path FROM CURRENT
SET jit = off
SET datestyle = ISO
SET intervalstyle = postgres
SET timezone = 'UTC'
SET bytea_output = hex
SET extra_float_digits = 1 AS
$$
DECLARE
	part record := typify_hierarchy_parts(hierarchy);
	layer jsonb := typify_hierarchy_layer(part.definition);
	calibrated boolean := typify_layer_is_calibrated(layer);
	wanted text[] := CASE WHEN NOT calibrated THEN named END;
	plan record;
	compared boolean;
	changes typify_hierarchy_change[];
	moved boolean := part.definition->>'barriers_state' IS DISTINCT FROM typify_hierarchy_barriers(part.definition)::text;
BEGIN
	IF NOT calibrated THEN
		layer := layer || '{"lod200": null, "lod200_group_by": null}';
	END IF;
	EXECUTE format('SELECT * FROM %s', typify_layer_call(layer, 'typify_plan', '$1')) INTO plan USING wanted;
	EXECUTE format('SELECT count(*) > 0 FROM %s WHERE built', part.groups) INTO compared;
	EXECUTE format(
		'WITH level AS (
			SELECT typify_group_key(grp) AS key, grp, n25 AS n, ordinality AS place, (options).exponent, (options).psi
			FROM unnest($1) WITH ORDINALITY
		), known AS (
			SELECT typify_group_key(grp) AS key, * FROM %s
			WHERE $2 IS NULL OR typify_group_key(grp) = ANY ($2)
		), now AS (
			SELECT typify_group_key(grp) AS key, bit_xor(typify_building_hash(geom, id, coalesce(importance, 1))) AS state
			FROM %s AS b WHERE $3 GROUP BY grp
		)
		SELECT array_agg(ROW(known.group_id, coalesce(known.grp, level.grp), coalesce(level.n, 0),
			CASE WHEN $4 THEN level.exponent END, CASE WHEN $4 THEN level.psi END)::typify_hierarchy_change
			ORDER BY known.group_id, level.place)
		FROM level FULL JOIN known USING (key) LEFT JOIN now USING (key)
		WHERE level.key IS NULL OR known.key IS NULL OR $4 AND (known.exponent, known.psi) IS DISTINCT FROM
			(level.exponent, level.psi) OR key = ANY ($5) OR NOT known.built OR $6 OR $3 AND known.state IS DISTINCT FROM now.state',
		part.groups, typify_layer_source(layer, wanted))
	INTO changes USING plan.levels, typify_group_keys(wanted), compared AND named IS NULL, calibrated, typify_group_keys(named),
		compared AND named IS NULL AND moved;
	RETURN changes;
END
$$;
COMMENT ON FUNCTION typify_hierarchy_changes(regclass, text[]) IS
'The groups of a hierarchy whose nodes are to be made: known ones that changed, by group_id, then new ones by the bytes of their names; NULL when there is none. named: these groups count as changed; NULL: every group is compared. Errors: as of typify_derive.';

CREATE FUNCTION typify_latitude(extent geometry) RETURNS double precision
LANGUAGE plpgsql STABLE STRICT PARALLEL SAFE
SET search_path FROM CURRENT AS
$$
DECLARE
	middle geometry := ST_SetSRID(ST_MakePoint((ST_XMin(extent) + ST_XMax(extent)) / 2,
		(ST_YMin(extent) + ST_YMax(extent)) / 2), ST_SRID(extent));
BEGIN
	IF EXISTS (SELECT FROM spatial_ref_sys WHERE srid = ST_SRID(extent)) THEN
		RETURN ST_Y(ST_Transform(middle, 4326));
	END IF;
	RETURN NULL;
EXCEPTION WHEN internal_error THEN
	-- so PostGIS calls a place that the projection does not know
	RETURN NULL;
END
$$;
COMMENT ON FUNCTION typify_latitude(geometry) IS
'The latitude in degrees of the middle of the box of a geometry; NULL where it has none, as with an unknown SRID.';

CREATE FUNCTION typify_hierarchy_mark(hierarchy regclass, changes typify_hierarchy_change[]) RETURNS void
LANGUAGE plpgsql
SET search_path FROM CURRENT AS
$$
DECLARE
	part record := typify_hierarchy_parts(hierarchy);
BEGIN
	EXECUTE format(
		'WITH change AS (SELECT * FROM unnest($1)),
		removed AS (DELETE FROM %1$s AS n WHERE n.group_id IN (SELECT group_id FROM change)),
		gone AS (DELETE FROM %2$s AS g WHERE g.group_id IN (SELECT group_id FROM change WHERE count = 0)),
		changed AS (
			UPDATE %2$s AS g SET count = change.count, exponent = change.exponent, psi = change.psi, built = false,
				state = NULL
			FROM change WHERE g.group_id = change.group_id AND change.count > 0)
		INSERT INTO %2$s (group_id, grp, count, exponent, psi)
		SELECT (SELECT coalesce(max(group_id), 0) FROM %2$s) + row_number() OVER (), grp, count, exponent, psi
		FROM change WHERE group_id IS NULL', part.nodes, part.groups) USING changes;
END
$$;
COMMENT ON FUNCTION typify_hierarchy_mark(regclass, typify_hierarchy_change[]) IS
'Removes the nodes of these groups and leaves the groups, those that are new and those without buildings included, as they are to be built: not built, or not there.';

CREATE FUNCTION typify_hierarchy_fill(hierarchy regclass, ids integer[]) RETURNS void
LANGUAGE plpgsql
SET search_path FROM CURRENT
SET jit = off
SET datestyle = ISO
SET intervalstyle = postgres
SET timezone = 'UTC'
SET bytea_output = hex
SET extra_float_digits = 1 AS
$$
DECLARE
	part record := typify_hierarchy_parts(hierarchy);
	layer jsonb := typify_hierarchy_layer(part.definition);
	given typify_options := typify_hierarchy_options(part.definition);
	todo text[];
	around geometry;
	barriers geometry;
BEGIN
	EXECUTE format('SELECT array_agg(grp) FROM %s WHERE group_id = ANY ($1)', part.groups) INTO todo USING ids;
	IF layer->>'barriers' IS NOT NULL THEN
		around := typify_surroundings(typify_layer_source(layer, todo), todo, (layer->>'scale')::float8);
	END IF;
	barriers := typify_barrier_lines((layer->>'barriers')::regclass, (layer->>'barriers_geom_column')::name, given, NULL,
		around);
	given := typify_options_without_barriers(given);
	EXECUTE format(
		'WITH todo AS (
			SELECT group_id, typify_group_key(grp) AS key, CASE WHEN exponent IS NULL AND psi IS NULL THEN $2
				ELSE typify_options_with($2, exponent, coalesce(psi, ($2).psi), NULL) END AS options
			FROM %1$s WHERE group_id = ANY ($1) OFFSET 0
		), made AS MATERIALIZED (
			SELECT todo.group_id,
				typify_write_hierarchy(b.geom, b.id, $3, todo.options, (SELECT $4), b.importance, $5, todo.group_id) AS made
			FROM %2$s AS b JOIN todo ON todo.key = typify_group_key(b.grp) GROUP BY todo.group_id
		)
		UPDATE %1$s AS g SET built = true, count = (made).count, state = (made).state, reach = (made).reach,
			extent = e.extent, latitude = typify_latitude(e.extent)
		FROM made, LATERAL (SELECT ST_MakeEnvelope((made).west, (made).south, (made).east, (made).north, $6) AS extent) AS e
		WHERE made.group_id = g.group_id', part.groups, typify_layer_source(layer, todo))
	USING ids, given, (part.definition->>'s_u')::float8, barriers, hierarchy, typify_hierarchy_srid(part.groups::regclass);
	-- what has lost its buildings since it was to be built
	EXECUTE format('DELETE FROM %s WHERE group_id = ANY ($1) AND NOT built', part.groups) USING ids;
END
$$;
COMMENT ON FUNCTION typify_hierarchy_fill(regclass, integer[]) IS
'Makes the nodes of these groups, which have none, and writes down of each what they were made of: count, state, reach, extent and latitude. A group without buildings is removed.';

-- One ranking over all groups: the next merge is that with the smallest running maximum of cost, of equal ones that in
-- the first group by the bytes of its name, the NULL group last. What they leave is what the law leaves of all.
CREATE FUNCTION typify_hierarchy_rank(hierarchy regclass) RETURNS void
LANGUAGE plpgsql
SET search_path FROM CURRENT
SET jit = off AS
$$
DECLARE
	part record := typify_hierarchy_parts(hierarchy);
	given typify_options := typify_hierarchy_options(part.definition);
	source_scale float8 := coalesce(given.source_scale, 25000);
BEGIN
	EXECUTE format(
		'WITH step AS MATERIALIZED (
			SELECT n.group_id, n.node, typify_scale_below((SELECT sum(count)::bigint FROM %2$s),
				(SELECT sum(count)::bigint FROM %2$s) + 1
					- row_number() OVER (ORDER BY n.cost, g.grp COLLATE "C" NULLS LAST, n.node), $1) AS scale
			FROM %1$s AS n JOIN %2$s AS g USING (group_id) WHERE n.node >= g.count
		), span AS (
			SELECT n.group_id, n.node, coalesce(born.scale, $2) AS scale_from, coalesce(dead.scale, ''Infinity'') AS scale_to,
				coalesce(g.psi, ($1).psi, 0.75) AS psi
			FROM %1$s AS n JOIN %2$s AS g USING (group_id)
			LEFT JOIN step AS born ON born.group_id = n.group_id AND born.node = n.node
			LEFT JOIN step AS dead ON dead.group_id = n.group_id AND dead.node = n.parent
		)
		UPDATE %1$s AS n SET scale_from = span.scale_from, scale_to = span.scale_to,
			place = typify_place(x, y, typify_reach(area, ratio, span.psi), span.scale_from, span.scale_to,
				$2)
		FROM span WHERE span.group_id = n.group_id AND span.node = n.node
			AND (n.scale_from, n.scale_to) IS DISTINCT FROM (span.scale_from, span.scale_to)',
		part.nodes, part.groups) USING given, source_scale;
END
$$;
COMMENT ON FUNCTION typify_hierarchy_rank(regclass) IS
'Sets the life spans of a hierarchy by one ranking over all groups: by running maximum of cost, group in C collation, step. So many nodes are alive at a scale as the law leaves of all buildings, but at least one in each group.';

CREATE FUNCTION typify_hierarchy_complete(hierarchy regclass) RETURNS void
LANGUAGE plpgsql
SET search_path FROM CURRENT
SET extra_float_digits = 1 AS
$$
DECLARE
	part record;
	ranked boolean;
	bounds record;
	definition json;
BEGIN
	EXECUTE format('LOCK TABLE %s IN SHARE ROW EXCLUSIVE MODE', typify_table_name(hierarchy, 'hierarchy'));
	part := typify_hierarchy_parts(hierarchy);
	ranked := part.definition->>'life_spans' = 'ranked';
	IF (SELECT bool_or(indisprimary) FROM pg_index WHERE indrelid = hierarchy) IS NOT TRUE THEN
		EXECUTE format('ALTER TABLE %s ADD PRIMARY KEY (group_id, node)', part.nodes);
	END IF;
	IF ranked THEN
		PERFORM typify_hierarchy_rank(hierarchy);
	END IF;
	EXECUTE format('SELECT coalesce(max(reach), 0) AS reach, coalesce(max(typify_scale_below(count, 2,
			typify_options_with($1, exponent, NULL, NULL))), $2) AS top
		FROM (SELECT %s AS exponent, %s AS count, max(reach) AS reach FROM %s GROUP BY 1) AS g',
		CASE WHEN ranked THEN '($1).exponent' ELSE 'coalesce(exponent, ($1).exponent)' END,
		CASE WHEN ranked THEN 'sum(count)::bigint' ELSE 'max(count)' END, part.groups)
	INTO bounds USING typify_hierarchy_options(part.definition), (typify_hierarchy_layer(part.definition)->>'scale')::float8;
	SELECT json_object_agg(key, value) INTO definition
	FROM (SELECT key, value FROM json_each(obj_description(hierarchy, 'pg_class')::json)
		WHERE key NOT IN ('finished', 'barriers_state', 'reach', 'top')
		UNION ALL VALUES ('barriers_state', to_json(typify_hierarchy_barriers(part.definition))),
			('reach', to_json(bounds.reach)), ('top', to_json(bounds.top))) AS pair;
	EXECUTE format('COMMENT ON TABLE %s IS %L', part.nodes, definition);
	IF typify_layer_index(hierarchy, 'place') IS NULL THEN
		EXECUTE format('CREATE INDEX ON %s USING gist (place)', part.nodes);
		EXECUTE format('CREATE INDEX ON %s USING gist (extent)', part.groups);
		IF ranked THEN
			-- ranking has written every row anew, in any order
			EXECUTE format('CLUSTER %s USING %I', part.nodes,
				(SELECT relname FROM pg_class WHERE oid = typify_layer_index(hierarchy, 'place')));
			EXECUTE format('ALTER TABLE %s SET WITHOUT CLUSTER', part.nodes);
		END IF;
		EXECUTE format('ANALYZE %s (group_id, node, scale_from, scale_to, place)', part.nodes);
		EXECUTE format('ANALYZE %s', part.groups);
	END IF;
END
$$;
COMMENT ON FUNCTION typify_hierarchy_complete(regclass) IS
'What a hierarchy gets when its nodes are there: its key, ranked life spans, the index by place, statistics, and a comment without "finished" that says what a look-up must know of all nodes: the greatest reach (typify_reach), and as top a scale that no scale_to but Infinity exceeds; and barriers_state (typify_hierarchy_barriers).';

CREATE FUNCTION typify_hierarchy_begin(caller_schema name, name text, definition json, batch integer,
	OUT hierarchy regclass, OUT groups integer, OUT done integer)
LANGUAGE plpgsql
SET search_path FROM CURRENT AS
$$
DECLARE
	nodes_name text := typify_layer_name(caller_schema, name);
	parts text[] := parse_ident(nodes_name);
	groups_name text := typify_layer_name(caller_schema, format('%I.%I', parts[1], parts[2] || '_groups'));
	unfinished json;
BEGIN
	SELECT relation, layer.unfinished INTO hierarchy, unfinished
	FROM typify_layer_unfinished(nodes_name, definition, batch, 'typify_refresh_hierarchy brings a hierarchy up to date') AS layer;
	IF hierarchy IS NULL AND to_regclass(groups_name) IS NOT NULL THEN
		RAISE EXCEPTION '% exists already', groups_name USING ERRCODE = 'duplicate_table',
			HINT = 'It would hold the groups: drop it first or choose another name for the hierarchy.';
	ELSIF hierarchy IS NULL THEN
		hierarchy := typify_hierarchy_create(nodes_name, groups_name, unfinished);
	END IF;
	PERFORM typify_hierarchy_mark(hierarchy, typify_hierarchy_changes(hierarchy, NULL));
	EXECUTE format('SELECT count(*), count(*) FILTER (WHERE built) FROM %s', groups_name) INTO groups, done;
END
$$;
COMMENT ON FUNCTION typify_hierarchy_begin(name, text, json, integer) IS
'The tables that typify_build_hierarchy fills, how many groups there are and how many are there already. They are made now, with "finished": false in the comment, or are those that an earlier call with the same arguments left; groups that changed since are begun anew. Error 42P07 for any other relation of these names.';

CREATE FUNCTION typify_hierarchy_build(hierarchy regclass, batch integer) RETURNS integer
LANGUAGE plpgsql
SET search_path FROM CURRENT AS
$$
DECLARE
	groups text;
	ids integer[];
	done integer;
BEGIN
	-- two calls that build the same hierarchy at the same time take turns, and neither repeats what the other did
	EXECUTE format('LOCK TABLE %s IN SHARE ROW EXCLUSIVE MODE', typify_table_name(hierarchy, 'hierarchy'));
	groups := (typify_hierarchy_parts(hierarchy)).groups;
	EXECUTE format('SELECT array_agg(group_id) FROM (SELECT group_id FROM %s WHERE NOT built '
		'ORDER BY group_id LIMIT $1) AS todo', groups) INTO ids USING batch;
	IF ids IS NULL THEN
		RETURN NULL;
	END IF;
	PERFORM typify_hierarchy_fill(hierarchy, ids);
	EXECUTE format('SELECT count(*) FILTER (WHERE built) FROM %s', groups) INTO done;
	RETURN done;
END
$$;
COMMENT ON FUNCTION typify_hierarchy_build(regclass, integer) IS
'One batch of typify_build_hierarchy: makes the nodes of the next groups, at most so many, and returns how many groups are there then; NULL when there was none left to do.';

-- A procedure that commits cannot set a search_path, so it asks where typify is. What comes before the first COMMIT
-- leaves nothing behind when it fails.
CREATE PROCEDURE typify_build_hierarchy(
	hierarchy text,
	source regclass,
	s_u double precision DEFAULT 0,
	group_by name DEFAULT NULL,
	options typify_options DEFAULT NULL,
	life_spans text DEFAULT 'each_group',
	lod200 regclass DEFAULT NULL,
	id_column name DEFAULT 'id',
	geom_column name DEFAULT 'geom',
	lod200_id_column name DEFAULT 'id',
	lod200_geom_column name DEFAULT 'geom',
	lod200_group_by name DEFAULT NULL,
	links regclass DEFAULT NULL,
	barriers regclass DEFAULT NULL,
	barriers_geom_column name DEFAULT 'geom',
	batch integer DEFAULT 1000,
	importance_column name DEFAULT NULL)
LANGUAGE plpgsql AS
$$
DECLARE
	typify text := extnamespace::regnamespace FROM pg_catalog.pg_extension WHERE extname = 'typify';
	built regclass;
	number integer;
	done integer;
BEGIN
	EXECUTE format('SELECT hierarchy, groups, done FROM %1$s.typify_hierarchy_begin(current_schema(), $1, '
		'%1$s.typify_hierarchy_definition($2, $3, $4, $5, $6, $7, $8, $9, $10, $11, $12, $13, $14, $15, $16), $17)', typify)
	INTO built, number, done USING hierarchy, source, s_u, group_by, options, life_spans, lod200, id_column, geom_column,
		lod200_id_column, lod200_geom_column, lod200_group_by, links, barriers, barriers_geom_column, importance_column,
		batch;
	COMMIT;
	LOOP
		EXECUTE format('SELECT %s.typify_hierarchy_build($1, $2)', typify) INTO done USING built, batch;
		EXIT WHEN done IS NULL;
		COMMIT;
		RAISE NOTICE '% of % groups (% %%)', done, number, 100::bigint * done / number;
	END LOOP;
	EXECUTE format('SELECT %s.typify_hierarchy_complete($1)', typify) USING built;
	COMMIT;
END
$$;
COMMENT ON PROCEDURE typify_build_hierarchy(text, regclass, double precision, name, typify_options, text, regclass, name,
	name, name, name, name, regclass, regclass, name, integer, name) IS
'Builds the hierarchy of a table of buildings, from which typify_at takes any scale: a table of that name with a row for every node of every group (group_id, the fields of typify_node, and place, by which they are found), and a companion, the name with _groups behind it, with a row for every group. Its comment says in JSON how it was made.
source: a table, view, materialized, partitioned or foreign table. group_by: a column of it, of any type; each of its values is a group, NULL too. s_u, options: as of typify_hierarchy.
life_spans: each_group gives every group its own count at a scale, as typify_placeholders does, exactly. ranked divides the count of the whole table: what is closest in all groups merges first, so that dense groups are thinned more; a group keeps at least one.
lod200: a coarse level, by which exponent and psi of each group are calibrated as typify_derive does; it and the arguments after it are those of typify_derive.
barriers: lines that nothing is merged across, as in typify_derive.
importance_column: a column of source with numbers, the importance of each building as typify_hierarchy takes it: ''Infinity'' keeps it in place and in size at every scale.
batch groups at a time are built, then a COMMIT and a NOTICE that says how many are done. After a stop (cancelled, failed, connection lost) the tables stay with what is done and "finished": false in the comment; calling with the same arguments goes on, with groups anew that changed meanwhile. Rows are written as COPY does, so the table may have further indexes, and columns that take NULL, but no triggers on INSERT, row-level security or CHECK constraints (0A000). CALL it outside a transaction block (2D000 inside).
Errors: as of typify_hierarchy, but for the size of its result, and typify_derive; 22023 for a batch below 1, other life_spans, and min_gap (use typify_create_scale); 42P07 for a name that exists; those of typify_create_scale for a name that cannot be.';
