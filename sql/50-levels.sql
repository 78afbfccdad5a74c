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
	link_hint text := CASE argument WHEN 'links' THEN
		'A table of links has lod25_id and lod200_id of an integer type.' END;
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
			USING ERRCODE = '42703', HINT = coalesce(link_hint,
				format('Name one of its columns with %s => ''...''.', argument));
	ELSIF kind = 'integer' AND type NOT IN ('int2'::regtype, 'int4'::regtype, 'int8'::regtype) THEN
		RAISE EXCEPTION 'column % of % is of type %, it must be smallint, integer or bigint', quote_ident(column_name),
				table_name, format_type(type, NULL)
			USING ERRCODE = '42804', HINT = coalesce(link_hint, format(
				'Name a key of integers with %s => ''...'', or pass a view that numbers the rows.', argument));
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

-- The text of a number or a word is the same where they are equal, so that an index on the column finds the groups; of
-- other types that is not certain.
CREATE FUNCTION typify_group_condition(relation regclass, column_name name, alias text, groups text[]) RETURNS text
LANGUAGE plpgsql STABLE PARALLEL SAFE
SET search_path FROM CURRENT
AS $$
DECLARE
	type oid := (SELECT atttypid FROM pg_attribute WHERE attrelid = relation AND attname = column_name);
	condition text := format('%s.%I = ANY (%%L::%%s)', alias, column_name);
BEGIN
	IF groups IS NULL OR array_position(groups, NULL) IS NOT NULL THEN
		RETURN 'true';
	ELSIF type IN ('int2'::regtype, 'int4'::regtype, 'int8'::regtype) THEN
		RETURN format(condition, ARRAY(SELECT grp FROM unnest(groups) AS grp WHERE grp ~ '^(0|-?[1-9][0-9]{0,17})$'),
			'bigint[]');
	ELSIF type IN ('text'::regtype, 'varchar'::regtype) THEN
		RETURN format(condition, groups, 'text[]');
	END IF;
	RETURN 'true';
END $$;
COMMENT ON FUNCTION typify_group_condition(regclass, name, text, text[]) IS
'A condition on a column that holds at least for the rows of the groups, and that an index on it may serve; true where there is none, and for groups NULL, which means all. alias: of the table.';

CREATE FUNCTION typify_lod25_source(lod25 regclass, id_column name, geom_column name, group_by name, links regclass,
	groups text[] DEFAULT NULL)
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
	condition text := 'true';
BEGIN
	IF links IS NOT NULL THEN
		IF group_by IS NOT NULL THEN
			RAISE EXCEPTION 'links and group_by are both given, but links are groups already'
				USING ERRCODE = '22023', HINT = 'Leave one of them out.';
		END IF;
		grp := 'l.' || typify_column_name(links, 'lod200_id', 'integer', 'links');
		link := format(' LEFT JOIN %s AS l ON l.%s = b.%s', typify_table_name(links, 'links'),
			typify_column_name(links, 'lod25_id', 'integer', 'links'), id);
		condition := typify_group_condition(links, 'lod200_id', 'l', groups);
	ELSIF group_by IS NOT NULL THEN
		grp := 'b.' || typify_column_name(lod25, group_by, 'any', 'group_by');
		condition := typify_group_condition(lod25, group_by, 'b', groups);
	END IF;
	RETURN format('(SELECT b.%1$s::bigint AS id, b.%2$s::%6$s AS geom, %3$s::text COLLATE "C" AS grp FROM %4$s AS b%5$s '
		'WHERE b.%2$s IS NOT NULL AND NOT ST_IsEmpty(b.%2$s) AND %7$s)', id, geom, grp, table_name, link,
		'geometry'::regtype, condition);
END $$;
COMMENT ON FUNCTION typify_lod25_source(regclass, name, name, name, regclass, text[]) IS
'The sub-select of the buildings of a table as typify_derive takes them: id bigint, geom, grp text, without those whose geometry is NULL or EMPTY. grp is the column group_by as text, or lod200_id of links (a table or view with lod25_id and lod200_id), or NULL. groups: at least these groups; NULL for all. Errors: as of typify_table_name and typify_column_name; 22023 for links together with group_by.';

CREATE FUNCTION typify_has_column(relation regclass, column_name name) RETURNS boolean
LANGUAGE sql STABLE PARALLEL SAFE
BEGIN ATOMIC
	SELECT EXISTS (SELECT FROM pg_attribute
		WHERE attrelid = relation AND attname = column_name AND attnum > 0 AND NOT attisdropped);
END;
COMMENT ON FUNCTION typify_has_column(regclass, name) IS 'Whether a table or view has a column of this name';

CREATE FUNCTION typify_lod200_source(lod200 regclass, geom_column name, group_column name) RETURNS text
LANGUAGE plpgsql STABLE PARALLEL SAFE
SET search_path FROM CURRENT
AS $$
DECLARE
	geom text := typify_column_name(lod200, geom_column, 'geometry', 'lod200_geom_column');
BEGIN
	RETURN format('(SELECT c.%1$s::%4$s AS geom, %2$s::text COLLATE "C" AS grp FROM %3$s AS c '
		'WHERE c.%1$s IS NOT NULL AND NOT ST_IsEmpty(c.%1$s))', geom,
		coalesce('c.' || quote_ident(group_column), 'NULL'), typify_table_name(lod200, 'lod200'),
		'geometry'::regtype);
END $$;
COMMENT ON FUNCTION typify_lod200_source(regclass, name, name) IS
'The sub-select of the objects of LOD200, without those whose geometry is NULL or EMPTY: geom, and grp text, which is the column group_column, or NULL without one. Errors: as of typify_table_name and typify_column_name.';

-- A building is where its centroid is, and so is an object of LOD200: one that covers buildings of several groups
-- belongs to the group that its middle is nearest to. Equally near is what differs by rounding only, 1e-12.

-- With an index: a query for the least distance and one for the ties, since PostgreSQL 15 does not find neighbours by
-- index where they are sorted by a second column.
CREATE FUNCTION typify_nearest_by_index(lod25_source text, lod200_source text) RETURNS text
LANGUAGE sql IMMUTABLE STRICT PARALLEL SAFE
RETURN format('(SELECT c.geom, n.grp FROM (SELECT geom, ST_Centroid(geom) AS centre FROM %1$s AS c OFFSET 0) AS c
	CROSS JOIN LATERAL (SELECT b.geom <-> c.centre AS distance FROM %2$s AS b ORDER BY 1 LIMIT 1) AS d
	CROSS JOIN LATERAL (SELECT b.grp FROM %2$s AS b
		WHERE ST_DWithin(b.geom, c.centre, d.distance * (1 + 1e-12)) ORDER BY b.id LIMIT 1) AS n)',
	lod200_source, lod25_source);
COMMENT ON FUNCTION typify_nearest_by_index(text, text) IS
'The sub-select of typify_nearest_groups as nearest-neighbour queries, for buildings with a GiST index.';

-- Without: buildings lie in the cells of a grid that their boxes meet. What is found in the nine cells around an object
-- is the nearest if it is no farther than a cell's side; the others look again in cells four times as wide.
CREATE FUNCTION typify_nearest_groups(lod25_source text, lod200_source text)
RETURNS TABLE (geom geometry, grp text)
LANGUAGE plpgsql STABLE PARALLEL RESTRICTED
SET search_path FROM CURRENT
SET jit = off
-- of arrays and series the planner expects few rows
SET enable_nestloop = off
AS $$
#variable_conflict use_column
DECLARE
	objects geometry[];
	centres geometry[];
	places bigint[];
	groups text[];
	found_places bigint[] := '{}';
	found_groups text[] := '{}';
	finite bigint;
	side double precision;
	x double precision;
	y double precision;
BEGIN
	EXECUTE format('SELECT array_agg(geom), array_agg(ST_Centroid(geom)) FROM %s AS c', lod200_source)
	INTO objects, centres;
	EXECUTE format(
		'SELECT greatest(sqrt(width * height / n), width / 1e4, height / 1e4, 1e-6), x, y
		FROM (SELECT count(*) AS n, min(ST_XMin(geom)) AS x, min(ST_YMin(geom)) AS y,
				max(ST_XMax(geom)) - min(ST_XMin(geom)) AS width, max(ST_YMax(geom)) - min(ST_YMin(geom)) AS height
			  FROM %s AS b) AS extent', lod25_source)
	INTO side, x, y;
	-- where a coordinate is no finite number, typify_placeholders says so later
	finite := (SELECT count(*) FROM unnest(centres) AS c WHERE abs(ST_X(c)) + abs(ST_Y(c)) < 'Infinity');
	WHILE side < 'Infinity' AND cardinality(found_places) < finite LOOP
		EXECUTE format(
			'WITH spot AS MATERIALIZED (
				SELECT place, centre, floor((ST_X(centre) - $3) / $5) + di AS i,
					floor((ST_Y(centre) - $4) / $5) + dj AS j
				FROM unnest($1) WITH ORDINALITY AS c(centre, place), generate_series(-1, 1) AS di,
					generate_series(-1, 1) AS dj
				WHERE place <> ALL ($2)
			), cell AS MATERIALIZED (
				SELECT id, grp, geom, i::float8, j::float8 FROM %s AS b,
					generate_series(floor((ST_XMin(geom) - $3) / $5)::integer, floor((ST_XMax(geom) - $3) / $5)::integer)
						AS i,
					generate_series(floor((ST_YMin(geom) - $4) / $5)::integer, floor((ST_YMax(geom) - $4) / $5)::integer)
						AS j
			), near AS (
				SELECT place, id, grp, distance, min(distance) OVER (PARTITION BY place) AS least
				FROM (SELECT place, id, grp, geom <-> centre AS distance FROM spot JOIN cell USING (i, j)) AS pair
			), nearest AS (
				SELECT DISTINCT ON (place) place, grp FROM near
				WHERE distance <= least * (1 + 1e-12) AND least <= $5 ORDER BY place, id
			)
			SELECT array_agg(place), array_agg(grp) FROM nearest', lod25_source)
		INTO places, groups USING centres, found_places, x, y, side;
		found_places := found_places || places;
		found_groups := found_groups || groups;
		side := side * 4;
	END LOOP;
	RETURN QUERY
		SELECT o.geom, f.grp FROM unnest(objects) WITH ORDINALITY AS o(geom, place)
		LEFT JOIN unnest(found_places, found_groups) AS f(place, grp) USING (place);
END $$;
COMMENT ON FUNCTION typify_nearest_groups(text, text) IS
'The objects of the second sub-select with the group of the building of the first that is nearest to their centroid, of equally near ones that with the smallest id; needs no index. grp NULL: that of the building, or there is no building.';

CREATE FUNCTION typify_lod200_groups(lod25_source text, lod25 regclass, lod200 regclass, id_column name,
	geom_column name, lod200_geom_column name, group_by name, lod200_group_by name, links regclass) RETURNS text
LANGUAGE plpgsql STABLE PARALLEL SAFE
SET search_path FROM CURRENT
AS $$
DECLARE
	lod200_source text;
BEGIN
	PERFORM typify_table_name(lod200, 'lod200');
	IF lod200_group_by IS NOT NULL AND group_by IS NULL AND links IS NULL THEN
		RAISE EXCEPTION 'lod200_group_by is given without group_by'
			USING ERRCODE = '22023', HINT = 'Name the column of lod25 with group_by => ''...''.';
	ELSIF links IS NOT NULL THEN
		lod200_group_by := coalesce(lod200_group_by, id_column);
		PERFORM typify_column_name(lod200, lod200_group_by, 'integer', 'lod200_group_by');
	ELSIF lod200_group_by IS NOT NULL THEN
		PERFORM typify_column_name(lod200, lod200_group_by, 'any', 'lod200_group_by');
	ELSIF typify_has_column(lod200, group_by) THEN
		lod200_group_by := group_by;
	ELSIF group_by IS NOT NULL THEN
		lod200_source := typify_lod200_source(lod200, lod200_geom_column, NULL);
		IF EXISTS (
			SELECT FROM pg_index JOIN pg_class ON pg_class.oid = indexrelid JOIN pg_am ON pg_am.oid = relam
			JOIN pg_attribute ON attrelid = indrelid AND attnum = indkey[0]
			WHERE indrelid = lod25 AND attname = geom_column AND amname = 'gist' AND indisvalid AND indpred IS NULL)
		THEN
			RETURN typify_nearest_by_index(lod25_source, lod200_source);
		END IF;
		RETURN format('typify_nearest_groups(%L, %L)', lod25_source, lod200_source);
	END IF;
	RETURN typify_lod200_source(lod200, lod200_geom_column, lod200_group_by);
END $$;
COMMENT ON FUNCTION typify_lod200_groups(text, regclass, regclass, name, name, name, name, name, regclass) IS
'The sub-select of the objects of LOD200 with their groups: geom, grp text. With links, the group of an object is its key, the column lod200_group_by or else id_column. Else it is the column lod200_group_by, or the column that group_by names if LOD200 has it, or the group of the building nearest to the object''s centroid, of equally near ones the one with the smallest id. Without group_by it is NULL. Errors: as of typify_table_name and typify_column_name; 22023 for lod200_group_by without group_by.';

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
	PERFORM typify_rectangle(ST_SetSRID(ST_MakePoint(0, 0), low), 1, 1, 0);
	RETURN low;
END $$;
COMMENT ON FUNCTION typify_source_srid(text, regclass, name, text) IS
'The SRID of a geometry column: the one in its type, else that of the geometries of the sub-select (as typify_lod25_source makes it), NULL when it has no row. argument: what the error calls the table. Errors: 22023 for two of them and for one that is geographic or geocentric.';

CREATE FUNCTION typify_check_ids(source text, lod25 regclass, id_column name, links regclass) RETURNS void
LANGUAGE plpgsql STABLE PARALLEL RESTRICTED
SET search_path FROM CURRENT
AS $$
DECLARE
	is_key boolean := EXISTS (
		SELECT FROM pg_index JOIN pg_attribute ON attrelid = indrelid AND attnum = indkey[0]
		WHERE indrelid = lod25 AND attname = id_column AND indisunique AND indimmediate AND indisvalid
			AND indnkeyatts = 1 AND indpred IS NULL);
	twice bigint;
BEGIN
	IF is_key AND links IS NULL THEN
		RETURN;
	END IF;
	EXECUTE format('SELECT id FROM %s AS b WHERE id IS NOT NULL GROUP BY id HAVING count(*) > 1 ORDER BY id LIMIT 1',
		source) INTO twice;
	IF twice IS NULL THEN
		RETURN;
	ELSIF is_key THEN
		RAISE EXCEPTION 'lod25_id % occurs more than once in links %', twice, typify_table_name(links, 'links')
			USING ERRCODE = '22023', HINT = 'A building belongs to one object of LOD200: keep one row of it.';
	END IF;
	RAISE EXCEPTION 'id % occurs more than once in %', twice, typify_table_name(lod25, 'lod25')
		USING ERRCODE = '22023', HINT = CASE WHEN links IS NULL THEN
			'Name a column with different numbers with id_column => ''...'', or pass a view that numbers the rows.'
			ELSE 'Ids of the buildings, and lod25_id of links, must each occur once.' END;
END $$;
COMMENT ON FUNCTION typify_check_ids(text, regclass, name, regclass) IS
'Refuses (22023) buildings of which two have one id, and links that name one building twice. Where a unique index says so already, nothing is read.';

CREATE FUNCTION typify_check_srids(lod25_source text, lod25 regclass, geom_column name, lod200 regclass,
	lod200_geom_column name, box geometry) RETURNS void
LANGUAGE plpgsql STABLE PARALLEL RESTRICTED
SET search_path FROM CURRENT
AS $$
DECLARE
	srid integer := typify_source_srid(lod25_source, lod25, geom_column, 'lod25');
	lod200_srid integer;
BEGIN
	IF lod200 IS NOT NULL THEN
		lod200_srid := typify_source_srid(typify_lod200_source(lod200, lod200_geom_column, NULL), lod200,
			lod200_geom_column, 'lod200');
	END IF;
	IF srid <> lod200_srid THEN
		RAISE EXCEPTION 'the geometries of lod25 have SRID %, those of lod200 SRID %', srid, lod200_srid
			USING ERRCODE = '22023', HINT = 'Use ST_Transform to bring them into one coordinate system.';
	ELSIF srid <> ST_SRID(box) THEN
		RAISE EXCEPTION 'the geometries of lod25 have SRID %, box has SRID %', srid, ST_SRID(box)
			USING ERRCODE = '22023', HINT = 'Use ST_Transform on box, or ST_MakeEnvelope with the SRID.';
	END IF;
END $$;
COMMENT ON FUNCTION typify_check_srids(text, regclass, name, regclass, name, geometry) IS
'Refuses (22023) two levels of detail, and a box, that are not in one projected coordinate system. lod200 and box may be NULL.';
