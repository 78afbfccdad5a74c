-- 60-layers.sql: one stored layer per scale, as a materialized view or a table
--
-- A layer knows how it was derived from its comment, a JSON text; there is no other record of it, so dropping it is
-- a plain DROP and a dump takes everything along. A calibrated table layer also remembers which share of LOD200
-- each group had, as the comment of its index on grp: by that typify_refresh_groups finds the groups whose
-- calibration moved although none of their own buildings changed.
--
-- Names are resolved where the caller's search_path is still in force: relations arrive as regclass, and the thin
-- outer functions, which set no search_path, hand on current_schema(). Everything within says schema and name.

CREATE FUNCTION typify_layer_name(caller_schema name, name text) RETURNS text
LANGUAGE plpgsql STABLE PARALLEL SAFE
SET search_path FROM CURRENT AS
$$
DECLARE
	parts text[];
	schema text;
	layer text;
BEGIN
	IF name IS NULL THEN
		PERFORM typify_refuse_null('name');
	END IF;
	BEGIN
		parts := parse_ident(name);
	EXCEPTION WHEN invalid_parameter_value THEN
		RAISE EXCEPTION '"%" is not a name', name USING ERRCODE = 'invalid_name',
			HINT = 'Write name or schema.name, parts with spaces or signs in double quotes: "My Schema"."Layer 75".';
	END;
	IF cardinality(parts) > 2 THEN
		RAISE EXCEPTION '"%" has too many parts for a name', name USING ERRCODE = 'invalid_name',
			HINT = 'Write name or schema.name; a name that contains a dot goes in double quotes.';
	END IF;
	layer := parts[cardinality(parts)];
	schema := CASE WHEN cardinality(parts) = 2 THEN parts[1] ELSE caller_schema::text END;
	IF octet_length(layer) > 63 THEN
		RAISE EXCEPTION 'the name "%" is too long', layer USING ERRCODE = 'name_too_long',
			HINT = 'A name has at most 63 bytes.';
	END IF;
	IF schema IS NULL THEN
		RAISE EXCEPTION 'no schema has been selected to create the layer "%" in', layer
			USING ERRCODE = 'invalid_schema_name', HINT = 'Write schema.name, or set the search_path.';
	END IF;
	IF to_regnamespace(quote_ident(schema)) IS NULL THEN
		RAISE EXCEPTION 'schema "%" does not exist', schema USING ERRCODE = 'invalid_schema_name',
			HINT = format('CREATE SCHEMA %I, or choose one that is there.', schema);
	END IF;
	RETURN format('%I.%I', schema, layer);
END
$$;

COMMENT ON FUNCTION typify_layer_name(name, text) IS
'Schema and name, quoted where needed, of a layer to be: name is written as in SQL, its schema may be left out and is then caller_schema. Errors: 22004 for a NULL name; 42602 for a text that is no name or has more than two parts; 42622 above 63 bytes; 3F000 for a schema that is missing.';

CREATE FUNCTION typify_legible_options(options typify_options) RETURNS typify_options
LANGUAGE sql IMMUTABLE PARALLEL SAFE
BEGIN ATOMIC
	SELECT typify_options((options).source_scale, (options).lod200_scale, (options).exponent, (options).psi,
		(options).count, (options).min_distance, (options).count_rule, (options).area_statistic, (options).shape,
		(options).min_area, coalesce((options).min_side, 0.35), (options).max_area, (options).keep_area,
		coalesce((options).min_gap, 0.2), (options).alignment, (options).barriers, (options).barrier_width);
END;

COMMENT ON FUNCTION typify_legible_options(typify_options) IS
'Options with a min_side of 0.35 mm and a min_gap of 0.2 mm where they set none. Errors: as of typify_options.';

CREATE FUNCTION typify_layer_definition(lod25 regclass, lod200 regclass, scale double precision, s_u double precision,
	group_by name, options typify_options, allocation text, id_column name, geom_column name,
	lod200_id_column name, lod200_geom_column name, lod200_group_by name, links regclass, barriers regclass,
	barriers_geom_column name, importance_column name)
RETURNS json
LANGUAGE plpgsql STABLE PARALLEL SAFE
SET search_path FROM CURRENT
SET extra_float_digits = 1 AS
$$
DECLARE
	argument text;
BEGIN
	argument := CASE WHEN scale IS NULL THEN 'scale' WHEN s_u IS NULL THEN 's_u'
		WHEN allocation IS NULL THEN 'allocation' WHEN id_column IS NULL THEN 'id_column'
		WHEN geom_column IS NULL THEN 'geom_column' WHEN lod200_id_column IS NULL THEN 'lod200_id_column'
		WHEN lod200_geom_column IS NULL THEN 'lod200_geom_column'
		WHEN barriers_geom_column IS NULL THEN 'barriers_geom_column' END;
	IF argument IS NOT NULL THEN
		PERFORM typify_refuse_null(argument);
	ELSIF ST_MemSize(options.barriers) > 100000 THEN
		RAISE EXCEPTION 'barriers of % bytes are too large for the comment of a layer', ST_MemSize(options.barriers)
			USING ERRCODE = '54000', HINT = 'Keep them in a table, and pass that: barriers => ''main_roads''.';
	END IF;
	RETURN json_build_object(
		'typify', (SELECT extversion FROM pg_extension WHERE extname = 'typify'),
		'lod25', typify_table_name(lod25, 'lod25'),
		'lod200', CASE WHEN lod200 IS NOT NULL THEN typify_table_name(lod200, 'lod200') END,
		'scale', scale, 's_u', s_u, 'group_by', group_by, 'allocation', allocation,
		'options', jsonb_strip_nulls(to_jsonb(options) || jsonb_build_object('barriers', (options).barriers::text)),
		'id_column', id_column, 'geom_column', geom_column, 'lod200_id_column', lod200_id_column,
		'lod200_geom_column', lod200_geom_column, 'lod200_group_by', lod200_group_by,
		'links', CASE WHEN links IS NOT NULL THEN typify_table_name(links, 'links') END,
		'barriers', CASE WHEN barriers IS NOT NULL THEN typify_table_name(barriers, 'barriers') END,
		'barriers_geom_column', barriers_geom_column,
		'importance_column', importance_column);
END
$$;

COMMENT ON FUNCTION typify_layer_definition(regclass, regclass, double precision, double precision, name,
	typify_options, text, name, name, name, name, name, regclass, regclass, name, name) IS
'How a layer is derived, as its comment says it: a JSON object of the version of typify, the arguments of typify_derive by their names (relations with schema) and, among options, those that are set. Errors: 22004 for a NULL where a value is needed; 54000 for the option barriers above 100 kB; those of typify_table_name.';

CREATE FUNCTION typify_layer_comment(relation oid) RETURNS jsonb
LANGUAGE plpgsql STABLE PARALLEL SAFE
SET search_path FROM CURRENT AS
$$
DECLARE
	comment jsonb;
BEGIN
	comment := obj_description(relation, 'pg_class');
	RETURN CASE jsonb_typeof(comment) WHEN 'object' THEN comment END;
EXCEPTION WHEN invalid_text_representation THEN
	RETURN NULL;
END
$$;

COMMENT ON FUNCTION typify_layer_comment(oid) IS
'The comment of a relation where it is a JSON object; NULL otherwise.';

CREATE FUNCTION typify_layer(layer regclass) RETURNS jsonb
LANGUAGE plpgsql STABLE PARALLEL SAFE
SET search_path FROM CURRENT AS
$$
DECLARE
	name text := typify_table_name(layer, 'name');
	definition jsonb := typify_layer_comment(layer);
BEGIN
	IF definition ?& ARRAY['typify', 'lod25', 'scale', 's_u', 'options'] THEN
		RETURN definition;
	END IF;
	RAISE EXCEPTION '% is not a layer of typify', name USING ERRCODE = 'wrong_object_type',
		HINT = 'Layers are made by typify_create_scale or typify_build_scale; the JSON in their comment '
			'says how they are derived and must stay.';
END
$$;

COMMENT ON FUNCTION typify_layer(regclass) IS
'How a layer is derived, as its comment says (see typify_layer_definition); "finished": false marks a table that typify_build_scale has not completed. Errors: 22004 for NULL; 42809 for what is no layer.';

CREATE FUNCTION typify_layer_call(definition jsonb, function text, groups text DEFAULT 'NULL') RETURNS text
LANGUAGE plpgsql STABLE PARALLEL SAFE
SET search_path FROM CURRENT AS
$$
DECLARE
	source text;
	options text := 'NULL';
BEGIN
	FOREACH source IN ARRAY ARRAY[definition->>'lod25', definition->>'lod200', definition->>'links',
			definition->>'barriers'] LOOP
		IF source IS NOT NULL AND to_regclass(source) IS NULL THEN
			RAISE EXCEPTION '%, from which the layer is derived, does not exist', source
				USING ERRCODE = 'undefined_table',
				HINT = 'Rename the table back, or drop the layer and create it from what is there now.';
		END IF;
	END LOOP;
	IF definition->'options' <> 'null' THEN
		SELECT format('typify_options(%s)', string_agg(format('%I => %L', key, value), ', ' ORDER BY key))
		INTO options FROM jsonb_each_text(definition->'options');
	END IF;
	RETURN format('%s(lod25 => %L::regclass, lod200 => %L::regclass, scale => %L, s_u => %L, group_by => %L, box => NULL, '
		'options => %s, allocation => %L, id_column => %L, geom_column => %L, lod200_id_column => %L, '
		'lod200_geom_column => %L, lod200_group_by => %L, links => %L::regclass, groups => %s%s, '
		'importance_column => %L)',
		function, definition->>'lod25', definition->>'lod200', definition->>'scale', definition->>'s_u',
		definition->>'group_by', options, definition->>'allocation', definition->>'id_column',
		definition->>'geom_column', definition->>'lod200_id_column', definition->>'lod200_geom_column',
		definition->>'lod200_group_by', definition->>'links', groups,
		CASE WHEN function = 'typify_plan' OR definition->>'barriers' IS NOT NULL THEN format(
			', %s => %L::regclass, barriers_geom_column => %L',
			CASE function WHEN 'typify_plan' THEN 'barriers_table' ELSE 'barriers' END,
			definition->>'barriers', definition->>'barriers_geom_column') ELSE '' END,
		definition->>'importance_column');
END
$$;

COMMENT ON FUNCTION typify_layer_call(jsonb, text, text) IS
'SQL that calls typify_derive, or typify_plan, which has the same arguments, as the definition of a layer says; groups: SQL for the argument of that name. Options are written as a call of typify_options with those that are set, so that the definition of a materialized view outlives new options. Error 42P01 when a table from which the layer is derived is there no more.';

CREATE FUNCTION typify_layer_create_table(layer text, definition json, geom_type text) RETURNS regclass
LANGUAGE plpgsql
SET search_path FROM CURRENT AS
$$
BEGIN
	EXECUTE format('CREATE TABLE %s (id bigint PRIMARY KEY, geom %s, member_count integer NOT NULL, '
		'members bigint[] NOT NULL, area float8, width float8, length float8, orientation float8, grp text)',
		layer, geom_type);
	EXECUTE format('CREATE INDEX ON %s (grp)', layer);
	EXECUTE format('COMMENT ON TABLE %s IS %L', layer, definition);
	RETURN layer::regclass;
END
$$;

COMMENT ON FUNCTION typify_layer_create_table(text, json, text) IS
'An empty table for a layer, with its comment, its key and the index on grp.';

CREATE FUNCTION typify_layer_is_settled(definition jsonb) RETURNS boolean
LANGUAGE sql IMMUTABLE PARALLEL SAFE
BEGIN ATOMIC
	SELECT coalesce((definition->'options'->>'min_gap')::double precision > 0, false)
		AND (definition->>'group_by' IS NOT NULL OR definition->>'links' IS NOT NULL);
END;

COMMENT ON FUNCTION typify_layer_is_settled(jsonb) IS
'Whether the placeholders of different groups of a layer are kept apart: options.min_gap is set, and there are groups.';

CREATE FUNCTION typify_layer_has_sites(layer regclass) RETURNS boolean
LANGUAGE sql STABLE PARALLEL SAFE
BEGIN ATOMIC
	SELECT EXISTS (SELECT FROM pg_attribute WHERE attrelid = layer AND attname = 'site' AND NOT attisdropped);
END;

COMMENT ON FUNCTION typify_layer_has_sites(regclass) IS
'Whether a table layer is being built whose groups are still to be kept apart: until then it has a column site, as of typify_site.';

CREATE FUNCTION typify_layer_replace(layer regclass, groups text[], derived text) RETURNS bigint
LANGUAGE plpgsql
SET search_path FROM CURRENT AS
$$
DECLARE
	rows bigint;
	columns text := 'id, geom, member_count, members, area, width, length, orientation, grp'
		|| CASE WHEN derived LIKE 'typify_draw_sites(%' THEN ', site' ELSE '' END;
BEGIN
	EXECUTE format('DELETE FROM %s WHERE $1 IS NULL OR grp = ANY ($1) OR grp IS NULL AND array_position($1, NULL) > 0',
		typify_table_name(layer, 'name')) USING groups;
	EXECUTE format('INSERT INTO %s (%s) SELECT %2$s FROM %s', typify_table_name(layer, 'name'), columns, derived)
		USING groups;
	GET DIAGNOSTICS rows = ROW_COUNT;
	RETURN rows;
EXCEPTION WHEN unique_violation THEN
	IF groups IS NULL THEN
		RAISE;
	END IF;
	RAISE EXCEPTION 'a building of these groups represents a placeholder of another group in %', layer
		USING ERRCODE = 'unique_violation',
		HINT = 'Where buildings moved from one group to another, refresh both; or use typify_refresh_scale.';
END
$$;

COMMENT ON FUNCTION typify_layer_replace(regclass, text[], text) IS
'Replaces the rows of these groups of a table layer (NULL: all) by others, and returns their number. derived: SQL that gives them and takes the groups as $1. Error 23505 when the id of a new row stands in a group that is not among them.';

CREATE FUNCTION typify_layer_update(layer regclass, derived text) RETURNS bigint
LANGUAGE plpgsql
SET search_path FROM CURRENT AS
$$
DECLARE
	rows bigint;
BEGIN
	EXECUTE format('WITH new AS MATERIALIZED (SELECT * FROM %2$s AS derived), '
		'gone AS (DELETE FROM %1$s AS old WHERE NOT EXISTS (SELECT FROM new WHERE new.id = old.id)) '
		'INSERT INTO %1$s AS old (id, geom, member_count, members, area, width, length, orientation, grp) '
		'SELECT id, geom, member_count, members, area, width, length, orientation, grp FROM new '
		'ON CONFLICT (id) DO UPDATE SET (geom, member_count, members, area, width, length, orientation, grp) = '
		'ROW(excluded.geom, excluded.member_count, excluded.members, excluded.area, excluded.width, excluded.length, '
			'excluded.orientation, excluded.grp) '
		'WHERE (old.geom::bytea, old.member_count, old.members, old.area, old.width, old.length, old.orientation, old.grp) '
			'IS DISTINCT FROM (excluded.geom::bytea, excluded.member_count, excluded.members, excluded.area, '
			'excluded.width, excluded.length, excluded.orientation, excluded.grp)',
		typify_table_name(layer, 'name'), derived);
	GET DIAGNOSTICS rows = ROW_COUNT;
	RETURN rows;
END
$$;

COMMENT ON FUNCTION typify_layer_update(regclass, text) IS
'Makes the rows of a table layer those that SQL derives, and returns how many it wrote: only rows that differ are touched.';

CREATE FUNCTION typify_layer_is_calibrated(definition jsonb) RETURNS boolean
LANGUAGE sql IMMUTABLE PARALLEL SAFE
BEGIN ATOMIC
	SELECT definition->>'lod200' IS NOT NULL AND NOT coalesce(definition->'options' ?& ARRAY['exponent', 'psi'], false);
END;

COMMENT ON FUNCTION typify_layer_is_calibrated(jsonb) IS
'Whether a layer takes exponent or psi from LOD200: there is one, and options do not give both.';

CREATE FUNCTION typify_layer_source(definition jsonb, groups text[] DEFAULT NULL) RETURNS text
LANGUAGE sql STABLE PARALLEL SAFE
BEGIN ATOMIC
	SELECT typify_lod25_source((definition->>'lod25')::regclass, (definition->>'id_column')::name,
		(definition->>'geom_column')::name, (definition->>'group_by')::name, (definition->>'links')::regclass, groups,
		(definition->>'importance_column')::name);
END;

COMMENT ON FUNCTION typify_layer_source(jsonb, text[]) IS
'The sub-select of the buildings from which a layer is derived, at least of these groups (see typify_lod25_source).';

CREATE FUNCTION typify_layer_geometry(definition jsonb) RETURNS text
LANGUAGE sql STABLE PARALLEL RESTRICTED
BEGIN ATOMIC
	SELECT format('geometry(Polygon, %s)', coalesce(typify_source_srid(typify_layer_source(definition),
		(definition->>'lod25')::regclass, (definition->>'geom_column')::name, 'lod25'), 0));
END;

COMMENT ON FUNCTION typify_layer_geometry(jsonb) IS
'The type of the geometry column of a layer: polygons with the SRID of the buildings it is derived from. Errors: as of typify_source_srid and typify_lod25_source.';

CREATE FUNCTION typify_layer_shares(definition jsonb) RETURNS jsonb
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
	shares jsonb;
	levels record;
BEGIN
	levels := typify_levels((definition->>'lod25')::regclass, (definition->>'lod200')::regclass,
		(definition->>'id_column')::name, (definition->>'geom_column')::name, (definition->>'lod200_id_column')::name,
		(definition->>'lod200_geom_column')::name, (definition->>'group_by')::name,
		(definition->>'lod200_group_by')::name, (definition->>'links')::regclass, false);
	EXECUTE format('SELECT jsonb_agg(jsonb_build_array(grp, number, area) ORDER BY grp COLLATE "C") FROM ('
		'SELECT grp, count(*) AS number, sum(ST_Area(geom)::numeric) AS area FROM %s AS lod200 GROUP BY grp) AS share',
		levels.lod200_source) INTO shares;
	RETURN coalesce(shares, '[]');
END
$$;

COMMENT ON FUNCTION typify_layer_shares(jsonb) IS
'Which share of LOD200 each group of a layer has now: a JSON array of [grp, number of objects, sum of their areas]. By that and by its own buildings a group is calibrated.';

CREATE FUNCTION typify_layer_share_rows(shares jsonb) RETURNS TABLE (key text, number bigint, area numeric)
LANGUAGE sql IMMUTABLE PARALLEL SAFE
BEGIN ATOMIC
	SELECT typify_group_key(share->>0), (share->>1)::bigint, (share->>2)::numeric
	FROM jsonb_array_elements(shares) AS share;
END;

COMMENT ON FUNCTION typify_layer_share_rows(jsonb) IS
'What typify_layer_shares found, as rows; key: as of typify_group_key.';

CREATE FUNCTION typify_layer_index(layer regclass, column_name name) RETURNS regclass
LANGUAGE sql STABLE PARALLEL SAFE
BEGIN ATOMIC
	SELECT min(indexrelid)::regclass FROM pg_index JOIN pg_attribute ON attrelid = indrelid AND attnum = indkey[0]
	WHERE indrelid = layer AND indnatts = 1 AND attname = column_name;
END;

COMMENT ON FUNCTION typify_layer_index(regclass, name) IS
'The index of a layer on this column alone; NULL when there is none. The comment of the one on grp keeps the shares of LOD200.';

CREATE FUNCTION typify_layer_keep_shares(layer regclass, kept jsonb) RETURNS void
LANGUAGE plpgsql
SET search_path FROM CURRENT AS
$$
DECLARE
	index regclass := typify_layer_index(layer, 'grp');
BEGIN
	IF index IS NOT NULL AND kept IS DISTINCT FROM typify_layer_comment(index) THEN
		EXECUTE format('COMMENT ON INDEX %s IS %L', index, kept);
	END IF;
END
$$;

COMMENT ON FUNCTION typify_layer_keep_shares(regclass, jsonb) IS
'Writes down the shares of LOD200 with which the groups of a table layer were derived, as {"lod200": shares}, and while it is being built its plan (see typify_layer_begin). NULL: nothing is kept.';

CREATE FUNCTION typify_layer_derive_all(layer regclass, definition jsonb) RETURNS void
LANGUAGE plpgsql
SET search_path FROM CURRENT AS
$$
BEGIN
	PERFORM typify_layer_replace(layer, NULL, typify_layer_call(definition, 'typify_derive', '$1'));
	PERFORM typify_layer_keep_shares(layer, CASE WHEN typify_layer_is_calibrated(definition)
		THEN jsonb_build_object('lod200', typify_layer_shares(definition)) END);
	PERFORM typify_layer_finish(layer);
END
$$;

COMMENT ON FUNCTION typify_layer_derive_all(regclass, jsonb) IS
'Fills a table layer, in place of what is in it.';

CREATE FUNCTION typify_layer_finish(layer regclass) RETURNS void
LANGUAGE plpgsql
SET search_path FROM CURRENT AS
$$
DECLARE
	name text := typify_table_name(layer, 'name');
	kind text := CASE relkind WHEN 'm' THEN 'MATERIALIZED VIEW' ELSE 'TABLE' END FROM pg_class WHERE oid = layer;
	definition json;
BEGIN
	SELECT json_object_agg(key, value) INTO definition
	FROM json_each(obj_description(layer, 'pg_class')::json) WHERE key <> 'finished';
	EXECUTE format('COMMENT ON %s %s IS %L', kind, name, definition);
	IF typify_layer_has_sites(layer) THEN
		EXECUTE format('ALTER TABLE %s DROP COLUMN site', name);
	END IF;
	IF typify_layer_index(layer, 'geom') IS NULL THEN
		EXECUTE format('CREATE INDEX ON %s USING gist (geom)', name);
	END IF;
	EXECUTE format('ANALYZE %s', name);
END
$$;

COMMENT ON FUNCTION typify_layer_finish(regclass) IS
'What a layer gets when its rows are there: the spatial index, statistics, a comment without "finished", no column that only its building needed.';

CREATE FUNCTION typify_layer_create(caller_schema name, name text, kind text, definition json) RETURNS regclass
LANGUAGE plpgsql
SET search_path FROM CURRENT AS
$$
DECLARE
	layer_name text := typify_layer_name(caller_schema, name);
	layer regclass := to_regclass(layer_name);
	geom_type text := typify_layer_geometry(definition::jsonb);
	source text;
BEGIN
	IF kind IS NULL THEN
		PERFORM typify_refuse_null('kind');
	ELSIF kind NOT IN ('materialized view', 'table') THEN
		RAISE EXCEPTION 'kind is "%", it must be materialized view or table', kind
			USING ERRCODE = 'invalid_parameter_value',
			HINT = 'A materialized view can be refreshed while it is read, a table also group by group.';
	ELSIF layer IS NOT NULL THEN
		RAISE EXCEPTION '% exists already', layer_name USING ERRCODE = 'duplicate_table',
			HINT = 'Drop it first or choose another name; typify_refresh_scale derives a layer anew.';
	END IF;
	IF kind = 'materialized view' THEN
		FOREACH source IN ARRAY ARRAY[definition->>'lod25', definition->>'lod200', definition->>'links',
				definition->>'barriers'] LOOP
			IF (SELECT relpersistence = 't' FROM pg_class WHERE oid = source::regclass) THEN
				RAISE EXCEPTION 'a materialized view cannot be derived from the temporary table %', source
					USING ERRCODE = 'feature_not_supported',
					HINT = 'Use a permanent table, or create the layer with kind => ''table''.';
			END IF;
		END LOOP;
		EXECUTE format('CREATE MATERIALIZED VIEW %s AS '
			'SELECT id, geom::%s AS geom, member_count, members, area, width, length, orientation, grp FROM %s',
			layer_name, geom_type, typify_layer_call(definition::jsonb, 'typify_derive'));
		layer := layer_name::regclass;
		EXECUTE format('CREATE UNIQUE INDEX ON %s (id)', layer_name);
		EXECUTE format('COMMENT ON MATERIALIZED VIEW %s IS %L', layer_name, definition);
		PERFORM typify_layer_finish(layer);
	ELSE
		layer := typify_layer_create_table(layer_name, definition, geom_type);
		PERFORM typify_layer_derive_all(layer, definition::jsonb);
	END IF;
	RETURN layer;
END
$$;

COMMENT ON FUNCTION typify_layer_create(name, text, text, json) IS
'The work of typify_create_scale; caller_schema: where a name without a schema goes.';

CREATE FUNCTION typify_create_scale(
	name text,
	lod25 regclass,
	lod200 regclass,
	scale double precision,
	s_u double precision DEFAULT 0,
	group_by name DEFAULT NULL,
	kind text DEFAULT 'materialized view',
	options typify_options DEFAULT NULL,
	allocation text DEFAULT 'each_group',
	id_column name DEFAULT 'id',
	geom_column name DEFAULT 'geom',
	lod200_id_column name DEFAULT 'id',
	lod200_geom_column name DEFAULT 'geom',
	lod200_group_by name DEFAULT NULL,
	links regclass DEFAULT NULL,
	barriers regclass DEFAULT NULL,
	barriers_geom_column name DEFAULT 'geom',
	importance_column name DEFAULT NULL)
RETURNS regclass
LANGUAGE sql
BEGIN ATOMIC
	SELECT typify_layer_create(current_schema(), name, kind, typify_layer_definition(lod25, lod200, scale, s_u,
		group_by, typify_legible_options(options), allocation, id_column, geom_column, lod200_id_column,
		lod200_geom_column, lod200_group_by, links, barriers, barriers_geom_column, importance_column));
END;

COMMENT ON FUNCTION typify_create_scale(text, regclass, regclass, double precision, double precision, name, text,
	typify_options, text, name, name, name, name, name, regclass, regclass, name, name) IS
'Creates a layer: the placeholders of typify_derive at one scale, stored, and returns it. name is written as in SQL, with or without a schema; kind is ''materialized view'' or ''table''; all other arguments are those of typify_derive. Options leave it legible: min_side is 0.35 and min_gap 0.2 mm on the map unless they say otherwise, 0 turns either off. The layer has its columns, a unique index on id (the id of the representative, which does not change when buildings elsewhere do), geom of type geometry(Polygon, SRID) with a spatial index, for tables an index on grp, and a JSON comment that says how it was derived. It is dropped by DROP. Errors: 42P07 when the name is taken; 42602, 42622, 3F000 for a name that is none, is too long or has a schema that is missing; 22023 for another kind; 22004 for a NULL where a value is needed; 0A000 for a materialized view of a temporary table; those of typify_derive.';

CREATE FUNCTION typify_refresh_scale(name regclass, concurrently boolean DEFAULT false) RETURNS void
LANGUAGE plpgsql
SET search_path FROM CURRENT AS
$$
DECLARE
	definition jsonb := typify_layer(name);
	layer text := typify_table_name(name, 'name');
BEGIN
	IF typify_refresh_scale.concurrently IS NULL THEN
		PERFORM typify_refuse_null('concurrently');
	END IF;
	IF (SELECT relkind = 'm' FROM pg_class WHERE oid = name) THEN
		EXECUTE format('REFRESH MATERIALIZED VIEW %s %s',
			CASE WHEN typify_refresh_scale.concurrently THEN 'CONCURRENTLY' ELSE '' END, layer);
	ELSIF typify_refresh_scale.concurrently THEN
		RAISE EXCEPTION '% is a table, which is not refreshed concurrently', layer
			USING ERRCODE = 'wrong_object_type',
			HINT = 'Leave concurrently out: whoever reads a table sees the old rows until the transaction commits.';
	ELSE
		EXECUTE format('LOCK TABLE %s IN SHARE ROW EXCLUSIVE MODE', layer);
		PERFORM typify_layer_derive_all(name, definition);
	END IF;
END
$$;

COMMENT ON FUNCTION typify_refresh_scale(regclass, boolean) IS
'Derives a layer anew from its tables as they are now, calibration included. concurrently: a materialized view stays readable meanwhile (REFRESH MATERIALIZED VIEW CONCURRENTLY); a table always does. Finishes a table that typify_build_scale began. Errors: 42809 for what is no layer, and for concurrently with a table; 42P01 when a table from which it is derived is there no more; 22004 for NULL; those of typify_derive.';

CREATE FUNCTION typify_refresh_groups(name regclass, groups text[]) RETURNS bigint
LANGUAGE plpgsql
SET search_path FROM CURRENT AS
$$
DECLARE
	definition jsonb := typify_layer(name);
	layer text := typify_table_name(name, 'name');
	before jsonb := typify_layer_comment(typify_layer_index(name, 'grp'))->'lod200';
	now jsonb;
	moved text[];
BEGIN
	IF groups IS NULL THEN
		PERFORM typify_refuse_null('groups');
	ELSIF (SELECT relkind <> 'r' FROM pg_class WHERE oid = name) THEN
		RAISE EXCEPTION '% is a materialized view, whose groups are not refreshed one by one', layer
			USING ERRCODE = 'wrong_object_type',
			HINT = 'Use typify_refresh_scale, or create the layer with kind => ''table''.';
	ELSIF definition->>'allocation' = 'total' THEN
		RAISE EXCEPTION 'the allocation of % is total, so that its groups depend on each other', layer
			USING ERRCODE = 'feature_not_supported', HINT = 'Use typify_refresh_scale.';
	ELSIF definition->'finished' = 'false' THEN
		RAISE EXCEPTION '% is not finished', layer USING ERRCODE = 'object_not_in_prerequisite_state',
			HINT = 'Call typify_build_scale as before to go on with it, or typify_refresh_scale.';
	END IF;
	EXECUTE format('LOCK TABLE %s IN SHARE ROW EXCLUSIVE MODE', layer);
	IF typify_layer_is_calibrated(definition) THEN
		now := typify_layer_shares(definition);
		EXECUTE format('SELECT array_agg(grp)
			FROM (SELECT grp, typify_group_key(grp) AS key, sum(member_count) AS n25 FROM %s GROUP BY grp) AS g
			LEFT JOIN typify_layer_share_rows($1) AS old USING (key) LEFT JOIN typify_layer_share_rows($2) AS new USING (key)
			WHERE (old.number, old.area) IS DISTINCT FROM (new.number, new.area)
				OR coalesce(new.number, 0) NOT BETWEEN 1 AND n25 OR new.area = 0', layer) INTO moved USING before, now;
		groups := CASE WHEN before IS NOT NULL THEN groups || moved END;
		PERFORM typify_layer_keep_shares(name, jsonb_build_object('lod200', now));
	ELSE
		-- nothing is taken from LOD200, so it need not be read
		definition := definition || '{"lod200": null, "lod200_group_by": null}';
	END IF;
	IF typify_layer_is_settled(definition) THEN
		RETURN typify_layer_update(name, typify_layer_call(definition, 'typify_derive'));
	END IF;
	RETURN typify_layer_replace(name, groups, typify_layer_call(definition, 'typify_derive', '$1'));
END
$$;

COMMENT ON FUNCTION typify_refresh_groups(regclass, text[]) IS
'Derives groups of a table layer anew and returns the number of rows written. groups: those in which buildings were added, changed, moved or removed, as text (a NULL element is the NULL group); a group that is no longer there loses its rows. Afterwards the layer has the rows that deriving it anew would give: groups whose calibration moved with the change are refreshed as well, that is, all that use the overall values, and those whose LOD200 objects changed. Where options give both exponent and psi, or without LOD200, nothing is calibrated and only the groups named are touched. With min_gap, which layers have unless it was turned off, and groups a change moves neighbours in others: then everything is derived, and the rows that differ are written. Errors: 42809 for what is no layer or is a materialized view; 0A000 for a layer whose allocation is total; 55000 for one that typify_build_scale has not finished; 23505 when a building that came from a group that is not named represents a placeholder there; 42P01 when a table from which it is derived is there no more; 22004 for NULL.';

CREATE FUNCTION typify_layer_state(definition jsonb) RETURNS bigint
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
	state bigint;
BEGIN
	EXECUTE format('SELECT sum(hash_record(b)) FROM %s AS b', typify_layer_source(definition)) INTO state;
	IF definition->>'barriers' IS NOT NULL THEN
		EXECUTE format('SELECT $1 + coalesce(sum(hash_record(b)), 0) FROM %s AS b', typify_barrier_source(
			(definition->>'barriers')::regclass, (definition->>'barriers_geom_column')::name)) INTO state USING state;
	END IF;
	RETURN coalesce(state, 0);
END
$$;

COMMENT ON FUNCTION typify_layer_state(jsonb) IS
'A number that tells whether the buildings from which a layer is derived, and its barriers, are the same as before: the sum of the hashes of their ids, geometries and groups.';

CREATE FUNCTION typify_layer_plan(definition jsonb) RETURNS jsonb
LANGUAGE plpgsql STABLE PARALLEL RESTRICTED
SET search_path FROM CURRENT
SET extra_float_digits = 1 AS
$$
DECLARE
	plan jsonb;
BEGIN
	EXECUTE format('SELECT coalesce(jsonb_agg(jsonb_build_array(l.grp, (l.options).exponent, (l.options).psi, '
			'(l.options).count, typify_group_key(l.grp) = ANY (hidden)) ORDER BY place), ''[]'') '
		'FROM %s AS plan, unnest(levels) WITH ORDINALITY AS l (grp, n25, n200, mean_area25, mean_placeholder_area, '
			'mean_area200, exponent, psi, options, calibrated, overall, place)',
		typify_layer_call(definition, 'typify_plan')) INTO plan;
	RETURN plan;
END
$$;

COMMENT ON FUNCTION typify_layer_plan(jsonb) IS
'What typify_plan says of the groups of a layer: a JSON array of [grp, exponent, psi, count, hidden], in its order, hidden being true or null.';

CREATE FUNCTION typify_layer_begin(caller_schema name, name text, definition json, batch integer,
	OUT layer regclass, OUT groups integer)
LANGUAGE plpgsql
SET search_path FROM CURRENT AS
$$
DECLARE
	layer_name text := typify_layer_name(caller_schema, name);
	unfinished json;
	there jsonb;
	kept jsonb;
	current jsonb;
BEGIN
	SELECT * INTO layer, there, unfinished
	FROM typify_layer_unfinished(layer_name, definition, batch, 'typify_refresh_scale derives a layer anew');
	kept := typify_layer_comment(typify_layer_index(layer, 'grp'));
	IF layer IS NULL THEN
		layer := typify_layer_create_table(layer_name, unfinished, typify_layer_geometry(definition::jsonb));
		IF typify_layer_is_settled(definition::jsonb) THEN
			EXECUTE format('ALTER TABLE %s ADD COLUMN site float8[]', layer);
		END IF;
	END IF;
	current := jsonb_build_object('state', typify_layer_state(definition::jsonb))
		|| CASE WHEN typify_layer_is_calibrated(definition::jsonb)
			THEN jsonb_build_object('lod200', typify_layer_shares(definition::jsonb)) ELSE '{}' END;
	IF kept IS NULL OR kept - 'plan' <> current THEN
		IF there IS NOT NULL THEN
			RAISE NOTICE 'the tables are not what they were when % was begun: it is begun anew', layer_name;
			EXECUTE format('DELETE FROM %s', layer);
		END IF;
		kept := current || jsonb_build_object('plan', typify_layer_plan(definition::jsonb));
		PERFORM typify_layer_keep_shares(layer, kept);
	END IF;
	groups := jsonb_array_length(kept->'plan');
END
$$;

COMMENT ON FUNCTION typify_layer_begin(name, text, json, integer) IS
'The table that typify_build_scale fills, and how many groups it will have. It is made now, with "finished": false in its comment, or is the one that an earlier call with the same arguments left unfinished. What all batches go by is kept in the comment of its index on grp: "plan" (see typify_layer_plan), and from what that was made, "state" (typify_layer_state) and "lod200" (typify_layer_shares). Where these are no longer the same, the table is emptied and planned anew. Error 42P07 for any other relation of that name.';

CREATE FUNCTION typify_layer_build(layer regclass, first integer, last integer) RETURNS void
LANGUAGE plpgsql
SET search_path FROM CURRENT
SET extra_float_digits = 1 AS
$$
DECLARE
	definition jsonb;
	plan jsonb;
	base typify_options;
	todo text[];
	keys text[];
	levels typify_calibration[];
	hidden text[];
BEGIN
	-- two calls that build the same layer at the same time take turns, and neither repeats what the other did
	EXECUTE format('LOCK TABLE %s IN SHARE ROW EXCLUSIVE MODE', layer);
	definition := typify_layer(layer);
	plan := typify_layer_comment(typify_layer_index(layer, 'grp'))->'plan';
	base := jsonb_populate_record(base, nullif(definition->'options', 'null'));
	EXECUTE format('SELECT array_agg(grp) FROM (SELECT one->>0 AS grp '
			'FROM jsonb_array_elements($1) WITH ORDINALITY AS one (one, place) WHERE place BETWEEN $2 AND $3) AS todo '
		'WHERE CASE WHEN grp IS NULL THEN NOT EXISTS (SELECT FROM %1$s AS done WHERE done.grp IS NULL) '
		'ELSE NOT EXISTS (SELECT FROM %1$s AS done WHERE done.grp = todo.grp) END', layer)
	INTO todo USING plan, first, last;
	keys := typify_group_keys(todo);
	SELECT array_agg(ROW(one->>0, NULL, NULL, NULL, NULL, NULL, NULL, NULL, typify_options_with(typify_options_without_barriers(base),
			(one->>1)::float8, (one->>2)::float8, (one->>3)::bigint), NULL, NULL)::typify_calibration),
		array_agg(typify_group_key(one->>0)) FILTER (WHERE (one->>4)::boolean)
	INTO levels, hidden
	FROM jsonb_array_elements(plan) AS one WHERE typify_group_key(one->>0) = ANY (keys);
	IF levels IS NOT NULL THEN
		PERFORM typify_layer_replace(layer, todo, format(
			CASE WHEN typify_layer_has_sites(layer)
				THEN 'typify_draw_sites(%1$L, %2$L::float8, %3$L::float8, %4$L::typify_calibration[], %5$L::text[], '
				ELSE 'typify_draw(%1$L, %2$L::float8, %3$L::float8, %4$L::typify_calibration[], %5$L::text[], %6$L::boolean, ' END
			|| 'typify_barrier_lines(%7$L::regclass, %8$L, %9$L::typify_options, NULL, typify_surroundings(%1$L, $1, %2$L))'
			|| CASE WHEN typify_layer_has_sites(layer) THEN ')' ELSE ', false)' END,
			typify_layer_source(definition, todo), definition->>'scale', definition->>'s_u', levels, hidden,
			definition->>'group_by' IS NOT NULL OR definition->>'links' IS NOT NULL, definition->>'barriers',
			definition->>'barriers_geom_column', base));
	END IF;
END
$$;

COMMENT ON FUNCTION typify_layer_build(regclass, integer, integer) IS
'One batch of typify_build_scale: derives those of the groups first to last of the plan that have no rows yet.';

CREATE FUNCTION typify_layer_complete(layer regclass) RETURNS void
LANGUAGE plpgsql
SET search_path FROM CURRENT AS
$$
DECLARE
	definition jsonb := typify_layer(layer);
	base typify_options;
	settled typify_settled[];
BEGIN
	EXECUTE format('LOCK TABLE %s IN SHARE ROW EXCLUSIVE MODE', layer);
	IF typify_layer_has_sites(layer) THEN
		EXECUTE format('SELECT typify_settle(id, number::integer, member_count, ST_SRID(geom), site, (SELECT $1)) '
			'FROM (SELECT *, dense_rank() OVER (ORDER BY typify_group_key(grp)) AS number FROM %s WHERE site IS NOT NULL) AS n', layer)
		INTO settled
		USING typify_barrier_lines((definition->>'barriers')::regclass, (definition->>'barriers_geom_column')::name,
			jsonb_populate_record(base, nullif(definition->'options', 'null')), NULL);
		EXECUTE format('UPDATE %1$s AS d SET member_count = member_count + cardinality(i.members), members = d.members || i.members '
			'FROM (SELECT (s).heir AS id, array_agg(m ORDER BY g.id, place) AS members FROM unnest($1) AS s '
				'JOIN %1$s AS g ON g.id = (s).id CROSS JOIN LATERAL unnest(g.members) WITH ORDINALITY AS m (m, place) '
				'WHERE (s).heir IS NOT NULL GROUP BY (s).heir) AS i WHERE i.id = d.id', layer) USING settled;
		EXECUTE format('DELETE FROM %s AS d USING unnest($1) AS s WHERE (s).id = d.id AND (s).heir IS NOT NULL', layer) USING settled;
		EXECUTE format('UPDATE %s AS d SET geom = typify_settled_geometry(d.geom, s), area = typify_settled_area(d.area, s), '
			'width = (s).width, length = (s).length FROM unnest($1) AS s WHERE (s).id = d.id', layer) USING settled;
	END IF;
	PERFORM typify_layer_keep_shares(layer,
		nullif(typify_layer_comment(typify_layer_index(layer, 'grp')) - 'plan' - 'state', '{}'));
	PERFORM typify_layer_finish(layer);
END
$$;

COMMENT ON FUNCTION typify_layer_complete(regclass) IS 'The end of typify_build_scale: the placeholders of all groups are kept apart, and the layer is one like any other.';

-- A procedure that commits cannot set a search_path, so it asks where typify is. What comes before the first COMMIT
-- leaves nothing behind when it fails.
CREATE PROCEDURE typify_build_scale(
	name text,
	lod25 regclass,
	lod200 regclass,
	scale double precision,
	s_u double precision DEFAULT 0,
	group_by name DEFAULT NULL,
	options typify_options DEFAULT NULL,
	allocation text DEFAULT 'each_group',
	id_column name DEFAULT 'id',
	geom_column name DEFAULT 'geom',
	lod200_id_column name DEFAULT 'id',
	lod200_geom_column name DEFAULT 'geom',
	lod200_group_by name DEFAULT NULL,
	links regclass DEFAULT NULL,
	batch integer DEFAULT 1000,
	barriers regclass DEFAULT NULL,
	barriers_geom_column name DEFAULT 'geom',
	importance_column name DEFAULT NULL)
LANGUAGE plpgsql AS
$$
DECLARE
	typify text := extnamespace::regnamespace FROM pg_catalog.pg_extension WHERE extname = 'typify';
	layer regclass;
	number integer;
	done integer := 0;
BEGIN
	EXECUTE format('SELECT * FROM %1$s.typify_layer_begin(current_schema(), $1, %1$s.typify_layer_definition($2, $3, $4, '
		'$5, $6, %1$s.typify_legible_options($7), $8, $9, $10, $11, $12, $13, $14, $16, $17, $18), $15)', typify)
	INTO layer, number USING name, lod25, lod200, scale, s_u, group_by, options, allocation, id_column, geom_column,
		lod200_id_column, lod200_geom_column, lod200_group_by, links, batch, barriers, barriers_geom_column,
		importance_column;
	WHILE done < number LOOP
		EXECUTE format('SELECT %s.typify_layer_build($1, $2, $3)', typify)
			USING layer, done + 1, least(done + batch::bigint, number)::integer;
		COMMIT;
		done := least(done + batch::bigint, number);
		RAISE NOTICE '% of % groups (% %%)', done, number, 100::bigint * done / number;
	END LOOP;
	EXECUTE format('SELECT %s.typify_layer_complete($1)', typify) USING layer;
	COMMIT;
END
$$;

COMMENT ON PROCEDURE typify_build_scale(text, regclass, regclass, double precision, double precision, name,
	typify_options, text, name, name, name, name, name, regclass, integer, regclass, name, name) IS
'Creates the layer that typify_create_scale creates with kind => ''table'', group by group: batch groups at a time, a COMMIT after each, and a NOTICE that says how many are done. After a stop (cancelled, failed, connection lost) the table stays with what is done and "finished": false in its comment; calling with the same arguments goes on with the groups that have no rows yet. Groups, counts and calibration are found once, at the beginning, so that it takes little longer than typify_create_scale. A call that goes on keeps to them, unless a building, its group, or what LOD200 has of a group is another than then: that is said (NOTICE), and the table is begun anew. Edits while a call runs are edits like any later: name their groups to typify_refresh_groups when it is finished. CALL it outside a transaction block (2D000 inside). Other errors: as of typify_create_scale; 22023 for a batch below 1.';
