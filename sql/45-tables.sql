-- 45-tables.sql: the user's tables, as SQL that reads them, and what is asked of them before they are read
--
-- Names are resolved to catalog entries once and written out with their schema, so that no search_path matters.
-- What a source function returns is the text of a sub-select (id bigint, geom geometry, grp text, importance
-- double precision); only typify_calibrate, typify_derive and their like put it into a query, which runs with the
-- rights of the caller.

CREATE FUNCTION typify_refuse_null(argument text,
	hint text DEFAULT 'Give a value, or leave the argument out to take its default.')
RETURNS void
LANGUAGE plpgsql IMMUTABLE STRICT PARALLEL SAFE
SET search_path FROM CURRENT
AS $$
BEGIN
	RAISE EXCEPTION '% must not be null', argument
		USING ERRCODE = '22004', HINT = hint;
END $$;
COMMENT ON FUNCTION typify_refuse_null(text, text) IS 'Raises the error 22004 for an argument that must not be NULL';

CREATE FUNCTION typify_table_name(relation regclass, argument text) RETURNS text
LANGUAGE plpgsql STABLE PARALLEL SAFE
SET search_path FROM CURRENT
AS $$
DECLARE
	entry record;
BEGIN
	IF relation IS NULL THEN
		PERFORM typify_refuse_null(argument, 'Give the name of a table or view.');
	END IF;
	SELECT format('%I.%I', nspname, relname) AS name, relkind INTO entry
	FROM pg_class JOIN pg_namespace ON pg_namespace.oid = relnamespace WHERE pg_class.oid = relation;
	IF NOT FOUND THEN
		RAISE EXCEPTION '% is %, which is no relation', argument, relation
			USING ERRCODE = '42P01', HINT = 'Give the name of a table or view.';
	ELSIF entry.relkind NOT IN ('r', 'p', 'v', 'm', 'f') THEN
		RAISE EXCEPTION '% is %, which is no table or view', argument, entry.name
			USING ERRCODE = '42809', HINT = 'Give the name of a table, view, materialized view or foreign table.';
	END IF;
	RETURN entry.name;
END $$;
COMMENT ON FUNCTION typify_table_name(regclass, text) IS
'The name of a table, view, materialized, partitioned or foreign table with its schema, quoted for SQL. argument: what the error calls it. Errors: 22004 for NULL, 42P01 for an OID that is no relation, 42809 for an index, sequence and the like.';

CREATE FUNCTION typify_column_name(relation regclass, column_name name, kind text, argument text) RETURNS text
LANGUAGE plpgsql STABLE PARALLEL SAFE
SET search_path FROM CURRENT
AS $$
DECLARE
	table_name text := typify_table_name(relation, 'table');
	link_hint text := CASE argument WHEN 'links' THEN
		'A table of links has lod25_id and lod200_id of an integer type.' END;
	type oid;
BEGIN
	IF column_name IS NULL THEN
		PERFORM typify_refuse_null(argument);
	END IF;
	-- a domain counts as what it is made of at last
	WITH RECURSIVE base AS (
		SELECT pg_type.oid, typbasetype FROM pg_attribute JOIN pg_type ON pg_type.oid = atttypid
		WHERE attrelid = relation AND attname = column_name AND attnum > 0 AND NOT attisdropped
		UNION ALL SELECT pg_type.oid, pg_type.typbasetype FROM base JOIN pg_type ON pg_type.oid = base.typbasetype
	)
	SELECT oid INTO type FROM base WHERE typbasetype = 0;
	IF NOT FOUND THEN
		RAISE EXCEPTION '% has no column %', table_name, quote_ident(column_name)
			USING ERRCODE = '42703', HINT = coalesce(link_hint,
				format('Name one of its columns with %s => ''...''.', argument));
	ELSIF kind = 'integer' AND type NOT IN ('int2'::regtype, 'int4'::regtype, 'int8'::regtype) THEN
		RAISE EXCEPTION 'column % of % is of type %, it must be smallint, integer or bigint', quote_ident(column_name),
				table_name, format_type(type, NULL)
			USING ERRCODE = '42804', HINT = coalesce(link_hint, format(
				'Name a key of integers with %s => ''...'', or pass a view that numbers the rows.', argument));
	ELSIF kind = 'integers' AND type NOT IN ('int2[]'::regtype, 'int4[]'::regtype, 'int8[]'::regtype) THEN
		RAISE EXCEPTION 'column % of % is of type %, it must be an array of smallint, integer or bigint',
				quote_ident(column_name), table_name, format_type(type, NULL)
			USING ERRCODE = '42804', HINT = format(
				'Name an array of ids with %s => ''...'', or pass a view that casts to bigint[].', argument);
	ELSIF kind = 'geometry' AND type <> 'geometry'::regtype THEN
		RAISE EXCEPTION 'column % of % is of type %, it must be geometry', quote_ident(column_name), table_name,
				format_type(type, NULL)
			USING ERRCODE = '42804', HINT = format(
				'Name the geometry column with %s => ''...'', or pass a view that casts to geometry.', argument);
	ELSIF kind = 'number' AND type NOT IN ('int2'::regtype, 'int4'::regtype, 'int8'::regtype, 'float4'::regtype,
			'float8'::regtype, 'numeric'::regtype) THEN
		RAISE EXCEPTION 'column % of % is of type %, it must be a number', quote_ident(column_name), table_name,
				format_type(type, NULL)
			USING ERRCODE = '42804', HINT = format(
				'Name a column of numbers with %s => ''...'', or pass a view that makes numbers of it.', argument);
	END IF;
	RETURN quote_ident(column_name);
END $$;
COMMENT ON FUNCTION typify_column_name(regclass, name, text, text) IS
'The name of a column, quoted for SQL, after a look at its type. kind: integer (smallint, integer, bigint), integers (an array of them), geometry, number (integers, real, double precision, numeric) or any; domains over them count. argument: the argument that the hint tells to set. Errors: 22004 for NULL, 42703 for a column that is not there, 42804 for one of another type.';

-- The text of a number or a word is the same where they are equal, so that an index on the column finds the groups; of
-- other types that is not certain.
CREATE FUNCTION typify_group_condition(relation regclass, column_name name, alias text, groups text[]) RETURNS text
LANGUAGE plpgsql STABLE PARALLEL SAFE
SET search_path FROM CURRENT
AS $$
DECLARE
	type oid := (SELECT atttypid FROM pg_attribute WHERE attrelid = relation AND attname = column_name);
	beyond numeric := CASE type WHEN 'int2'::regtype THEN 32768 WHEN 'int4'::regtype THEN 2147483648
		ELSE 9223372036854775808 END;
	condition text := format('%s.%I = ANY (%%L::%%s)', alias, column_name);
BEGIN
	IF groups IS NULL OR array_position(groups, NULL) IS NOT NULL THEN
		RETURN 'true';
	ELSIF type IN ('int2'::regtype, 'int4'::regtype, 'int8'::regtype) THEN
		-- of the column's very type: then the server hashes them, instead of comparing each row with each
		RETURN format(condition, ARRAY(SELECT grp FROM unnest(groups) AS grp WHERE CASE WHEN grp ~ '^(0|-?[1-9][0-9]{0,18})$'
				THEN grp::numeric >= - beyond AND grp::numeric < beyond END), type::regtype || '[]');
	ELSIF type IN ('text'::regtype, 'varchar'::regtype) THEN
		RETURN format(condition, groups, 'text[]');
	END IF;
	RETURN 'true';
END $$;
COMMENT ON FUNCTION typify_group_condition(regclass, name, text, text[]) IS
'A condition on a column that holds at least for the rows of the groups, and that an index on it may serve; true where there is none, and for groups NULL, which means all. alias: of the table.';

CREATE FUNCTION typify_source(relation regclass, argument text, prefix text, id_column name, geom_column name,
	keyed boolean, grp text DEFAULT 'NULL', link text DEFAULT '', condition text DEFAULT 'true',
	importance_column name DEFAULT NULL)
RETURNS text
LANGUAGE plpgsql STABLE PARALLEL SAFE
SET search_path FROM CURRENT
AS $$
DECLARE
	table_name text := typify_table_name(relation, argument);
	id text := 'NULL';
	importance text := 'NULL';
	geom text;
BEGIN
	IF keyed THEN
		id := 'b.' || typify_column_name(relation, id_column, 'integer', prefix || 'id_column');
	END IF;
	geom := 'b.' || typify_column_name(relation, geom_column, 'geometry', prefix || 'geom_column');
	IF importance_column IS NOT NULL THEN
		importance := 'b.' || typify_column_name(relation, importance_column, 'number', 'importance_column');
	END IF;
	RETURN format('(SELECT %1$s::bigint AS id, %2$s::%3$s AS geom, %4$s::text COLLATE "C" AS grp, '
		'%5$s::double precision AS importance FROM %6$s AS b%7$s '
		'WHERE %2$s IS NOT NULL AND NOT ST_IsEmpty(%2$s) AND %8$s)', id, geom, 'geometry'::regtype, grp, importance,
		table_name, link, condition);
END $$;
COMMENT ON FUNCTION typify_source(regclass, text, text, name, name, boolean, text, text, text, name) IS
'The sub-select of the rows of a table that have a geometry which is neither NULL nor EMPTY: id (NULL unless keyed), geom, grp, by SQL of the columns of the table, b, and of what link joins to it, and importance (NULL unless importance_column names a column of numbers). argument: what errors call the table; prefix: of the arguments that name its columns, as in lod200_id_column. Errors: as of typify_table_name and typify_column_name.';

CREATE FUNCTION typify_source_srid(source text, relation regclass, geom_column name, argument text) RETURNS integer
LANGUAGE plpgsql STABLE PARALLEL RESTRICTED
SET search_path FROM CURRENT
AS $$
DECLARE
	low integer := (SELECT nullif(postgis_typmod_srid(atttypmod), 0) FROM pg_attribute
		WHERE attrelid = relation AND attname = geom_column AND atttypid = 'geometry'::regtype AND atttypmod >= 0);
	high integer := low;
BEGIN
	IF low IS NULL THEN
		EXECUTE format('SELECT min(ST_SRID(geom)), max(ST_SRID(geom)) FROM %s AS b', source) INTO low, high;
	END IF;
	IF low <> high THEN
		RAISE EXCEPTION 'the geometries of % have two SRIDs, % and %', argument, low, high
			USING ERRCODE = '22023', HINT = 'Use ST_Transform to bring them into one coordinate system.';
	END IF;
	-- refuses degrees
	PERFORM typify_centre(ST_SetSRID(ST_MakePoint(0, 0), low));
	RETURN low;
END $$;
COMMENT ON FUNCTION typify_source_srid(text, regclass, name, text) IS
'The SRID of a geometry column: the one in its type, else that of the geometries of the sub-select (as typify_source makes it), NULL when it has no row. argument: what the error calls the table. Errors: 22023 for two of them and for one that is geographic or geocentric.';

CREATE FUNCTION typify_check_same_srid(argument text, srid integer, other_argument text, other_srid integer)
RETURNS void
LANGUAGE plpgsql IMMUTABLE PARALLEL SAFE
SET search_path FROM CURRENT
AS $$
BEGIN
	IF srid <> other_srid THEN
		RAISE EXCEPTION '% has SRID %, but % has SRID %', argument, srid, other_argument, other_srid
			USING ERRCODE = '22023', HINT = 'Use ST_Transform, for a table in a view, to bring them into one coordinate system.';
	END IF;
END $$;
COMMENT ON FUNCTION typify_check_same_srid(text, integer, text, integer) IS
'Refuses (22023) two arguments with geometries of different SRIDs. A NULL SRID is that of a table without any geometry, and passes.';

CREATE FUNCTION typify_check_ids(source text, relation regclass, id_column name, argument text,
	links regclass DEFAULT NULL)
RETURNS void
LANGUAGE plpgsql STABLE PARALLEL RESTRICTED
SET search_path FROM CURRENT
AS $$
DECLARE
	is_key boolean := EXISTS (
		SELECT FROM pg_index JOIN pg_attribute ON attrelid = indrelid AND attnum = indkey[0]
		WHERE indrelid = relation AND attname = id_column AND attnotnull AND indisunique AND indimmediate
			AND indisvalid AND indnkeyatts = 1 AND indpred IS NULL);
	unique_ids boolean := is_key AND links IS NULL;
	no_id boolean;
	twice bigint;
BEGIN
	IF NOT unique_ids THEN
		-- by sorting; to group by id would take three times as long
		EXECUTE format('SELECT count(DISTINCT id) = count(*) FROM %s AS b', source) INTO unique_ids;
	END IF;
	IF unique_ids THEN
		RETURN;
	END IF;
	-- not the first by LIMIT, for which the planner would join links one by one
	EXECUTE format('SELECT bool_or(id IS NULL), min(id) FROM (SELECT id FROM %s AS b '
		'GROUP BY id HAVING count(*) > 1 OR id IS NULL) AS wrong', source) INTO no_id, twice;
	IF no_id THEN
		RAISE EXCEPTION 'an id in % is null', typify_table_name(relation, 'table')
			USING ERRCODE = '22004', HINT = format(
				'Fill column %I, name another one with %s => ''...'', or pass a view without such rows.', id_column, argument);
	ELSIF twice IS NOT NULL AND is_key THEN
		RAISE EXCEPTION 'lod25_id % occurs more than once in links %', twice, typify_table_name(links, 'links')
			USING ERRCODE = '22023', HINT = 'A building belongs to one object of LOD200: keep one row of it.';
	ELSIF twice IS NOT NULL THEN
		RAISE EXCEPTION 'id % occurs more than once in %', twice, typify_table_name(relation, 'table')
			USING ERRCODE = '22023', HINT = CASE WHEN links IS NULL THEN format(
				'Name a column with different numbers with %s => ''...'', or pass a view that numbers the rows.', argument)
				ELSE 'Ids of the buildings, and lod25_id of links, must each occur once.' END;
	END IF;
END $$;
COMMENT ON FUNCTION typify_check_ids(text, regclass, name, text, regclass) IS
'Refuses rows of a source without an id (22004), two with the same one, and links that name one building twice (22023). argument: the one that names the column. Where the table''s key says so already, nothing is read.';

CREATE FUNCTION typify_barrier_source(barriers regclass, geom_column name) RETURNS text
LANGUAGE plpgsql STABLE PARALLEL SAFE
SET search_path FROM CURRENT
AS $$
DECLARE
	table_name text := typify_table_name(barriers, 'barriers');
	geom text := typify_column_name(barriers, geom_column, 'geometry', 'barriers_geom_column');
BEGIN
	RETURN format('(SELECT %1$s::%2$s AS geom FROM %3$s AS b WHERE %1$s IS NOT NULL AND NOT ST_IsEmpty(%1$s))', geom,
		'geometry'::regtype, table_name);
END $$;
COMMENT ON FUNCTION typify_barrier_source(regclass, name) IS
'The sub-select of the geometries of a table of barriers that are neither NULL nor EMPTY. Errors: as of typify_table_name and typify_column_name.';

CREATE FUNCTION typify_barrier_lines(barriers regclass, geom_column name, options typify_options, srid integer,
	around geometry DEFAULT NULL)
RETURNS geometry
LANGUAGE plpgsql STABLE PARALLEL RESTRICTED
SET search_path FROM CURRENT
AS $$
DECLARE
	source text;
	lines geometry := options.barriers;
BEGIN
	IF barriers IS NOT NULL AND NOT ST_IsEmpty(lines) THEN
		RAISE EXCEPTION 'barriers are given as a table and among options'
			USING ERRCODE = '22023', HINT = 'Leave one of them out.';
	ELSIF barriers IS NOT NULL THEN
		source := typify_barrier_source(barriers, geom_column);
		PERFORM typify_check_same_srid('lod25', srid, 'barriers', typify_source_srid(source, barriers, geom_column, 'barriers'));
		EXECUTE format('SELECT ST_Collect(geom) FROM %s AS b WHERE $1 IS NULL OR geom && $1', source) INTO lines USING around;
	END IF;
	PERFORM typify_check_same_srid('lod25', srid, 'barriers', CASE WHEN NOT ST_IsEmpty(lines) THEN ST_SRID(lines) END);
	RETURN lines;
END $$;
COMMENT ON FUNCTION typify_barrier_lines(regclass, name, typify_options, integer, geometry) IS
'The barriers of a table, collected, or those among options; NULL when there are none. srid: of the buildings. around: only rows of the table whose boxes meet it. Errors: 22023 for both, for two SRIDs and for another one than that of the buildings; others as of typify_barrier_source.';
