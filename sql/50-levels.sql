-- 50-levels.sql: the user's tables of the two stored levels of detail, as SQL that reads them
--
-- Names are resolved to catalog entries once and written out with their schema, so that no search_path matters.
-- What the functions below return is the text of a sub-select; only typify_calibrate, typify_derive and their
-- like put it into a query, which then runs with the rights of the caller.

CREATE FUNCTION typify_refuse_null(argument text) RETURNS void
LANGUAGE plpgsql IMMUTABLE STRICT PARALLEL SAFE
SET search_path FROM CURRENT
AS $$
BEGIN
	RAISE EXCEPTION '% must not be null', argument
		USING ERRCODE = '22004', HINT = 'Give a value, or leave the argument out to take its default.';
END $$;
COMMENT ON FUNCTION typify_refuse_null(text) IS 'Raises the error 22004 for an argument that must not be NULL';

CREATE FUNCTION typify_table_name(relation regclass, argument text) RETURNS text
LANGUAGE plpgsql STABLE PARALLEL SAFE
SET search_path FROM CURRENT
AS $$
DECLARE
	entry record;
BEGIN
	IF relation IS NULL THEN
		PERFORM typify_refuse_null(argument);
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
	type oid;
BEGIN
	IF column_name IS NULL THEN
		PERFORM typify_refuse_null(argument);
	END IF;
	SELECT coalesce(nullif(typbasetype, 0), pg_type.oid) INTO type
	FROM pg_attribute JOIN pg_type ON pg_type.oid = atttypid
	WHERE attrelid = relation AND attname = column_name AND attnum > 0 AND NOT attisdropped;
	IF NOT FOUND THEN
		RAISE EXCEPTION '% has no column %', table_name, quote_ident(column_name)
			USING ERRCODE = '42703', HINT = format('Name one of its columns with %s => ''...''.', argument);
	ELSIF kind = 'integer' AND type NOT IN ('int2'::regtype, 'int4'::regtype, 'int8'::regtype) THEN
		RAISE EXCEPTION 'column % of % is of type %, it must be smallint, integer or bigint', quote_ident(column_name),
				table_name, format_type(type, NULL)
			USING ERRCODE = '42804', HINT = format(
				'Name a key of integers with %s => ''...'', or pass a view that numbers the rows.', argument);
	ELSIF kind = 'geometry' AND type <> 'geometry'::regtype THEN
		RAISE EXCEPTION 'column % of % is of type %, it must be geometry', quote_ident(column_name), table_name,
				format_type(type, NULL)
			USING ERRCODE = '42804', HINT = format(
				'Name the geometry column with %s => ''...'', or pass a view that casts to geometry.', argument);
	END IF;
	RETURN quote_ident(column_name);
END $$;
COMMENT ON FUNCTION typify_column_name(regclass, name, text, text) IS
'The name of a column, quoted for SQL, after a look at its type. kind: integer (smallint, integer, bigint), geometry or any; domains over them count. argument: the argument that the hint tells to set. Errors: 22004 for NULL, 42703 for a column that is not there, 42804 for one of another type.';

CREATE FUNCTION typify_lod25_source(lod25 regclass, id_column name, geom_column name, group_by name, links regclass)
RETURNS text
LANGUAGE plpgsql STABLE PARALLEL SAFE
SET search_path FROM CURRENT
AS $$
DECLARE
	table_name text := typify_table_name(lod25, 'lod25');
	id text := typify_column_name(lod25, id_column, 'integer', 'id_column');
	geom text := typify_column_name(lod25, geom_column, 'geometry', 'geom_column');
	grp text := 'NULL';
	link text := '';
BEGIN
	IF links IS NOT NULL THEN
		IF group_by IS NOT NULL THEN
			RAISE EXCEPTION 'links and group_by are given, but links are groups already'
				USING ERRCODE = '22023', HINT = 'Leave one of them out.';
		END IF;
		grp := 'l.' || typify_column_name(links, 'lod200_id', 'integer', 'links');
		link := format(' LEFT JOIN %s AS l ON l.%s = b.%s', typify_table_name(links, 'links'),
			typify_column_name(links, 'lod25_id', 'integer', 'links'), id);
	ELSIF group_by IS NOT NULL THEN
		grp := 'b.' || typify_column_name(lod25, group_by, 'any', 'group_by');
	END IF;
	RETURN format('(SELECT b.%1$s::bigint AS id, b.%2$s::%6$s AS geom, %3$s::text AS grp FROM %4$s AS b%5$s '
		'WHERE b.%2$s IS NOT NULL AND NOT ST_IsEmpty(b.%2$s))', id, geom, grp, table_name, link,
		'geometry'::regtype);
END $$;
COMMENT ON FUNCTION typify_lod25_source(regclass, name, name, name, regclass) IS
'The sub-select of the buildings of a table as typify_derive takes them: id bigint, geom, grp text, without those whose geometry is NULL or EMPTY. grp is the column group_by as text, or lod200_id of links (a table or view with lod25_id and lod200_id), or NULL. Errors: as of typify_table_name and typify_column_name; 22023 for links together with group_by.';
