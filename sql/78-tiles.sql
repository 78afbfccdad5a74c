-- 78-tiles.sql: a function that makes vector tiles, written into the user's schema
--
-- pg_tileserv and Martin publish every function that takes (z, x, y integer [, json]) and returns bytea. So none of
-- typify's own may look like that: the tile function is written for a hierarchy by typify_create_tile_function, belongs
-- to who calls it and not to the extension, and names everything that it reads by schema.
--
-- What a tile shows is found in three steps: the tile's box, brought back into the coordinate system of the hierarchy;
-- the nodes alive in that box, each group at its own scale; and their polygons in units of the tile, by a lattice of
-- control points (src/core/tile.h). The text of a function is put together by the functions below from these parts.

CREATE FUNCTION typify_tile_area(z integer, x integer, y integer, low_x double precision, low_y double precision,
	high_x double precision, high_y double precision)
RETURNS geometry
AS 'MODULE_PATHNAME'
LANGUAGE C IMMUTABLE STRICT PARALLEL SAFE;
COMMENT ON FUNCTION typify_tile_area(integer, integer, integer, double precision, double precision, double precision,
	double precision) IS
'The tile with a buffer of 64 / 4096 of its side, cut to a box, as a POLYGON in Web Mercator (3857) with 8 points a side, so that ST_Transform bends them; NULL where the two do not meet. Error 22023 for a tile that does not exist (z is 0 to 30).';

CREATE FUNCTION typify_tile_lattice(low_x double precision, low_y double precision, high_x double precision,
	high_y double precision, srid integer, zoom integer, metres_per_unit double precision)
RETURNS geometry
AS 'MODULE_PATHNAME'
LANGUAGE C IMMUTABLE STRICT PARALLEL SAFE;
COMMENT ON FUNCTION typify_tile_lattice(double precision, double precision, double precision, double precision, integer,
	integer, double precision) IS
'Control points by which polygons in a box (units of the SRID) are brought into tiles of a zoom: the corners of square cells that cover the box, row by row, as a LINESTRING. A cell is about a sixteenth of a tile of that zoom (from zoom 6 on) and stands at multiples of its side, wherever the box is. Error 22023 for a box that takes more than a million corners.';

CREATE FUNCTION typify_tile_frame(lattice geometry, projected geometry, z integer, x integer, y integer)
RETURNS bytea
AS 'MODULE_PATHNAME'
LANGUAGE C IMMUTABLE STRICT PARALLEL SAFE;
COMMENT ON FUNCTION typify_tile_frame(geometry, geometry, integer, integer, integer) IS
'What typify_tile_node needs of a tile. lattice: as of typify_tile_lattice; projected: its ST_Transform to 3857. The bytes are those of this machine and not for keeping. Error 22023 where the two do not belong together, for a point that is not finite and for a tile that does not exist.';

CREATE FUNCTION typify_tile_node(representative bigint, x double precision, y double precision,
	area double precision, ratio double precision, ux double precision, uy double precision, member_count integer,
	kept boolean, scale double precision, options typify_options, psi double precision, srid integer,
	metres_per_unit double precision, frame bytea)
RETURNS geometry
AS 'MODULE_PATHNAME'
LANGUAGE C IMMUTABLE PARALLEL SAFE COST 10;
COMMENT ON FUNCTION typify_tile_node(bigint, double precision, double precision, double precision, double precision,
	double precision, double precision, integer, boolean, double precision, typify_options, double precision, integer,
	double precision, bytea) IS
'The polygon of typify_node_placeholder in units of a tile, for ST_AsMVT: whole numbers, 4096 to the side, y downwards, not clipped, so that every tile that it reaches into has the same polygon. Differs from ST_AsMVTGeom(ST_Transform(polygon, 3857), ...) by one unit at most up to 65 degrees of latitude. NULL when it does not reach into the tile with its buffer, has no size, or no area in whole units, and when anything else but options and psi is NULL. frame: as of typify_tile_frame. Errors: as of typify_node_placeholder; 22023 for what is no frame.';

CREATE FUNCTION typify_tile_project(geom geometry, frame bytea) RETURNS geometry
AS 'MODULE_PATHNAME'
LANGUAGE C IMMUTABLE STRICT PARALLEL SAFE COST 10;
COMMENT ON FUNCTION typify_tile_project(geometry, bytea) IS
'ST_Transform(geom, 3857) for geometries of any type that lie in the lattice of a frame (typify_tile_frame), to a quarter of a unit of its tile and in a fraction of the time. Outside of the lattice its nearest cell goes on. Errors: 22023 for what is no frame; XX001 for corrupt bytes.';

CREATE FUNCTION typify_tile_attributes(source regclass, attributes name[]) RETURNS text[]
LANGUAGE plpgsql STABLE PARALLEL SAFE
SET search_path FROM CURRENT
AS $$
DECLARE
	attribute name;
	names text[] := '{}';
BEGIN
	IF attributes IS NULL OR array_position(attributes, NULL) IS NOT NULL THEN
		PERFORM typify_refuse_null('attributes', 'Name columns of the buildings, or leave the argument out for none.');
	END IF;
	FOREACH attribute IN ARRAY attributes LOOP
		names := names || typify_column_name(source, attribute, 'any', 'attributes');
		IF attribute IN ('representative', 'member_count', 'geom') THEN
			RAISE EXCEPTION 'attribute % has a name that tiles have already', quote_ident(attribute)
				USING ERRCODE = '42701', HINT = 'Pass a view of the buildings in which the column has another name.';
		ELSIF (SELECT count(*) FROM unnest(attributes) AS other WHERE other = attribute) > 1 THEN
			RAISE EXCEPTION 'attribute % is named twice', quote_ident(attribute)
				USING ERRCODE = '42701', HINT = 'Name each column once.';
		ELSIF (SELECT atttypid FROM pg_attribute WHERE attrelid = source AND attname = attribute) = 'geometry'::regtype THEN
			RAISE EXCEPTION 'attribute % is a geometry', quote_ident(attribute)
				USING ERRCODE = '42804', HINT = 'A feature of a tile has one geometry: name other columns.';
		END IF;
	END LOOP;
	RETURN names;
END $$;
COMMENT ON FUNCTION typify_tile_attributes(regclass, name[]) IS
'The columns that tiles carry over from the buildings, quoted for SQL. Errors: 22004 for NULL; 42703 for a column that is not there; 42701 for one that is named twice or as one of the tiles'' own (representative, member_count, geom); 42804 for a geometry.';

CREATE FUNCTION typify_tile_source(definition jsonb) RETURNS jsonb
LANGUAGE plpgsql STABLE PARALLEL RESTRICTED
SET search_path FROM CURRENT
AS $$
DECLARE
	name text := coalesce(definition->>'source', definition->>'lod25');
	source regclass := to_regclass(name);
	id text;
	geom text;
	srid integer;
	extent geometry;
BEGIN
	IF source IS NULL THEN
		RAISE EXCEPTION '%, from which the placeholders come, does not exist', name
			USING ERRCODE = '42P01', HINT = 'Rename the table of the buildings back.';
	END IF;
	id := typify_column_name(source, (definition->>'id_column')::name, 'integer', 'id_column');
	geom := typify_column_name(source, (definition->>'geom_column')::name, 'geometry', 'geom_column');
	EXECUTE format('SELECT ST_SetSRID(ST_Extent(%1$s)::geometry, max(ST_SRID(%1$s))) FROM %2$s', geom, name) INTO extent;
	srid := coalesce(ST_SRID(extent), 0);
	IF extent IS NULL THEN
		RAISE EXCEPTION '% has no building', name
			USING ERRCODE = '55000', HINT = 'Fill it and build the hierarchy or the layers first.';
	ELSIF srid = 0 THEN
		RAISE EXCEPTION 'the coordinate system of % is unknown, so it has no place on a web map', name
			USING ERRCODE = '22023', HINT = 'Use UpdateGeometrySRID to say which it is, and build anew.';
	END IF;
	RETURN jsonb_build_object('table', name, 'id', id, 'geom', geom, 'srid', srid, 'extent', extent::text);
END $$;
COMMENT ON FUNCTION typify_tile_source(jsonb) IS
'The buildings from which a hierarchy or a layer comes, by its definition: a JSON object of their table, id and geom (names quoted for SQL), srid, and extent as hexadecimal EWKB. Errors: 42P01 when the table is not there; 55000 when it has no building; 22023 for an unknown SRID; those of typify_column_name.';

CREATE FUNCTION typify_tile_outlines(source jsonb, attributes text[], layer text) RETURNS text
LANGUAGE sql STABLE PARALLEL SAFE
BEGIN ATOMIC
	SELECT format('lattice := typify_tile_lattice(ST_XMin(box), ST_YMin(box), ST_XMax(box), ST_YMax(box), %6$s, z, %7$s);
		frame := typify_tile_frame(lattice, ST_Transform(lattice, 3857), z, x, y);
		RETURN (
		SELECT ST_AsMVT(feature, %1$L, 4096, ''geom'', ''representative'')
		FROM (
			SELECT b.%2$s::bigint AS representative, 1 AS member_count%3$s,
				ST_AsMVTGeom(typify_tile_project(b.%4$s, frame), tile, 4096, 64, true) AS geom
			FROM %5$s AS b
			WHERE b.%4$s && box
		) AS feature);',
		layer, source->>'id', (SELECT string_agg(', b.' || name, '' ORDER BY place)
			FROM unnest(attributes) WITH ORDINALITY AS a (name, place)), source->>'geom', source->>'table', source->>'srid',
		typify_metres_per_unit((source->>'srid')::integer));
END;
COMMENT ON FUNCTION typify_tile_outlines(jsonb, text[], text) IS
'Statements that return a tile of the buildings themselves. source: as of typify_tile_source; attributes: as of typify_tile_attributes; layer: the name of the tile''s layer. They use the variables of typify_tile_body.';

-- Far from the buildings a projection need not be defined; half of this box more than they have on each side is not far.
CREATE FUNCTION typify_tile_domain(source jsonb) RETURNS geometry
LANGUAGE sql STABLE PARALLEL SAFE
BEGIN ATOMIC
	SELECT ST_Envelope(ST_Expand(extent, ST_MaxDistance(extent, extent) / 2
		+ 100000 / typify_metres_per_unit((source->>'srid')::integer)))
	FROM (SELECT (source->>'extent')::geometry AS extent) AS e;
END;
COMMENT ON FUNCTION typify_tile_domain(jsonb) IS
'The box within which tiles of these buildings may show something: their own with half its diagonal and 100 km around it.';

CREATE FUNCTION typify_tile_joined(source jsonb, attributes text[], OUT names text, OUT source_join text)
LANGUAGE sql IMMUTABLE PARALLEL SAFE
BEGIN ATOMIC
	SELECT coalesce(string_agg(', b.' || name, '' ORDER BY place), ''),
		CASE WHEN count(name) > 0 THEN format(' LEFT JOIN %s AS b ON b.%s = p.id', source->>'table', source->>'id')
			ELSE '' END
	FROM unnest(attributes) WITH ORDINALITY AS a (name, place);
END;
COMMENT ON FUNCTION typify_tile_joined(jsonb, text[]) IS
'SQL for the attributes that placeholders p take over from the buildings b that represent them: what is selected, and the join.';

CREATE FUNCTION typify_tile_stored(zooms integer[], layers regclass[], source jsonb, attributes text[], layer text)
RETURNS text
LANGUAGE sql STABLE PARALLEL SAFE
BEGIN ATOMIC
	SELECT format('(
		SELECT ST_AsMVT(feature, %1$L, 4096, ''geom'', ''representative'')
		FROM (
			SELECT p.id AS representative, p.member_count%2$s,
				ST_AsMVTGeom(ST_Transform(p.geom, 3857), tile, 4096, 64, false) AS geom
			FROM (%3$s
			) AS p%4$s
		) AS feature)', layer, joined.names, string_agg(format('
				SELECT l.id, l.member_count, l.geom FROM %s AS l WHERE z = %s AND l.geom && box',
			typify_table_name(stored, 'layers'), zoom), '
				UNION ALL' ORDER BY zoom), joined.source_join)
	FROM ROWS FROM (unnest(zooms), unnest(layers)) AS given (zoom, stored), typify_tile_joined(source, attributes) AS joined
	GROUP BY joined.names, joined.source_join;
END;
COMMENT ON FUNCTION typify_tile_stored(integer[], regclass[], jsonb, text[], text) IS
'SQL of a tile of stored layers, each at its zoom. A placeholder is not clipped: then all tiles show the same. source, attributes, layer: as of typify_tile_outlines. It uses the variables z, tile and box.';

CREATE FUNCTION typify_tile_options(definition jsonb, min_side double precision, max_area double precision) RETURNS text
LANGUAGE sql IMMUTABLE PARALLEL SAFE
BEGIN ATOMIC
	SELECT format('typify_options(%s)', string_agg(format('%I => %L', key, value), ', ' ORDER BY key))
	FROM jsonb_each_text(jsonb_strip_nulls(coalesce(nullif(definition->'options', 'null'), '{}') - 'barriers'
		|| jsonb_build_object('min_side', min_side, 'max_area', max_area)));
END;
COMMENT ON FUNCTION typify_tile_options(jsonb, double precision, double precision) IS
'The options of a hierarchy with min_side and max_area of tiles instead of its own, as SQL.';

-- Groups have a scale each, so the index is asked for the range of those that may be near. A polygon reaches no further
-- than the largest of all when it is enlarged without psi. As arrays the groups are hashed, however few are expected.
CREATE FUNCTION typify_tile_nodes(nodes text, groups text, definition jsonb, source jsonb, attributes text[],
	min_side double precision, max_area double precision, tile_size integer, layer text)
RETURNS text
LANGUAGE sql STABLE PARALLEL SAFE
BEGIN ATOMIC
	SELECT format('
	known := obj_description(%1$L::regclass, ''pg_class'');
	reach := (known ->> ''reach'')::float8 / %3$s + %5$s / 1000 / %6$s;
	SELECT array_agg(g.group_id) AS ids, array_agg(g.psi) AS psis, array_agg(g.scale) AS scales, min(g.scale) AS low,
		max(g.scale) AS high
	INTO near
	FROM (SELECT c.group_id, c.psi, greatest(%3$s, typify_zoom_scale(zoom, c.latitude, %4$s)) AS scale FROM %2$s AS c
		WHERE c.extent && ST_Expand(box, reach * typify_zoom_scale(zoom, 0, %4$s))) AS g;
	IF near.ids IS NULL THEN
		RETURN '''';
	END IF;
	lattice := typify_tile_lattice(greatest(ST_XMin(box) - 2 * reach * near.high, %13$s),
		greatest(ST_YMin(box) - 2 * reach * near.high, %14$s), least(ST_XMax(box) + 2 * reach * near.high, %15$s),
		least(ST_YMax(box) + 2 * reach * near.high, %16$s), %8$s, z, %6$s);
	frame := typify_tile_frame(lattice, ST_Transform(lattice, 3857), z, x, y);
	RETURN (
		SELECT ST_AsMVT(feature, %10$L, 4096, ''geom'', ''representative'')
		FROM (
			SELECT p.representative, p.member_count%11$s, p.geom
			FROM (
				SELECT n.representative, n.member_count, typify_tile_node(n.representative, n.x, n.y, n.area, n.ratio,
					n.ux, n.uy, n.member_count, n.kept, g.scale, %7$s, g.psi, %8$s, %6$s, frame) AS geom
				FROM %1$s AS n JOIN unnest(near.ids, near.psis, near.scales) AS g (group_id, psi, scale) USING (group_id)
				WHERE n.place <@ ANY (typify_search(box(point(ST_XMin(box), ST_YMin(box)), point(ST_XMax(box), ST_YMax(box))),
						near.low, near.high, (known ->> ''reach'')::float8, (known ->> ''top'')::float8, %3$s, %9$s,
						%5$s / 1000 / %6$s * near.high))
					AND n.scale_from <= near.high AND n.scale_to > near.low
					AND n.scale_from <= g.scale AND n.scale_to > g.scale
				OFFSET 0
			) AS p%12$s
			WHERE p.geom IS NOT NULL
		) AS feature);',
		nodes, groups, coalesce(definition->'options'->>'source_scale', '25000'), tile_size, min_side,
		typify_metres_per_unit((source->>'srid')::integer), typify_tile_options(definition, min_side, max_area),
		source->>'srid', coalesce(definition->'options'->>'lod200_scale', '200000'), layer, names,
		replace(source_join, 'p.id', 'p.representative'), floor(ST_XMin(bounds)), floor(ST_YMin(bounds)),
		ceil(ST_XMax(bounds)), ceil(ST_YMax(bounds)))
	FROM typify_tile_joined(source, attributes), typify_tile_domain(source) AS bounds;
END;
COMMENT ON FUNCTION typify_tile_nodes(text, text, jsonb, jsonb, text[], double precision, double precision, integer,
	text) IS
'Statements that return a tile of a hierarchy. nodes, groups, definition: as of typify_hierarchy_parts; source, attributes, layer: as of typify_tile_outlines. They use the variables of typify_tile_body.';

CREATE FUNCTION typify_tile_layers(layers regclass[], latitude double precision, tile_size integer,
	OUT zooms integer[], OUT sorted regclass[])
LANGUAGE plpgsql STABLE PARALLEL SAFE
SET search_path FROM CURRENT
AS $$
DECLARE
	layer regclass;
BEGIN
	FOREACH layer IN ARRAY layers LOOP
		IF typify_layer(layer)->'finished' = 'false' THEN
			RAISE EXCEPTION '% is not finished', layer
				USING ERRCODE = '55000', HINT = 'Call typify_build_scale as before to go on with it.';
		END IF;
	END LOOP;
	SELECT array_agg(zoom ORDER BY zoom, scale), array_agg(given.layer ORDER BY zoom, scale) INTO zooms, sorted
	FROM unnest(layers) AS given (layer), LATERAL (
		SELECT scale, greatest(0, round(log(2, (typify_zoom_scale(0, latitude, tile_size) / scale)::numeric)))::integer AS zoom
		FROM (SELECT (typify_layer(given.layer)->>'scale')::float8 AS scale) AS s) AS z;
	FOR place IN 2..cardinality(zooms) LOOP
		IF zooms[place] = zooms[place - 1] THEN
			RAISE EXCEPTION '% and % are both for zoom %', sorted[place - 1], sorted[place], zooms[place]
				USING ERRCODE = '22023', HINT = format('Give one layer per zoom: at zoom %s the scale is 1:%s there.', zooms[place],
					round(typify_zoom_scale(zooms[place], latitude, tile_size)));
		END IF;
	END LOOP;
END $$;
COMMENT ON FUNCTION typify_tile_layers(regclass[], double precision, integer) IS
'Which zoom each stored layer is for: the one whose scale at that latitude is nearest to its own; both arrays by zoom. Errors: 42809 for what is no layer; 55000 for one that is not finished; 22023 for two layers at one zoom.';

CREATE FUNCTION typify_tile_comment(description text, layer text, source jsonb, attributes name[], min_zoom integer,
	max_zoom integer, made jsonb)
RETURNS text
LANGUAGE plpgsql STABLE PARALLEL SAFE
SET search_path FROM CURRENT
AS $$
DECLARE
	bounds geometry := ST_Transform(ST_Segmentize((source->>'extent')::geometry,
		greatest(1, ST_MaxDistance((source->>'extent')::geometry, (source->>'extent')::geometry) / 16)), 4326);
	fields json;
BEGIN
	SELECT json_object_agg(name, type ORDER BY place) INTO fields
	FROM (SELECT * FROM (VALUES ('member_count', 'Number', 1)) AS own (name, type, place)
		UNION ALL
		SELECT attribute, CASE WHEN typcategory = 'N' AND typname <> 'numeric' THEN 'Number' WHEN typcategory = 'B' THEN 'Boolean'
			ELSE 'String' END, 2 + place
		FROM unnest(attributes) WITH ORDINALITY AS a (attribute, place)
		JOIN pg_attribute ON attrelid = (source->>'table')::regclass AND attname = attribute
		JOIN pg_type ON pg_type.oid = atttypid) AS field;
	RETURN json_build_object('description', description, 'minzoom', min_zoom, 'maxzoom', max_zoom,
		'bounds', json_build_array(floor(ST_XMin(bounds) * 1e5) / 1e5, floor(ST_YMin(bounds) * 1e5) / 1e5,
			ceil(ST_XMax(bounds) * 1e5) / 1e5, ceil(ST_YMax(bounds) * 1e5) / 1e5),
		'vector_layers', json_build_array(json_build_object('id', layer, 'fields', fields)),
		'typify', made);
END $$;
COMMENT ON FUNCTION typify_tile_comment(text, text, jsonb, name[], integer, integer, jsonb) IS
'The comment of a tile function: TileJSON, which Martin takes over, and under "typify" how the function was made. source: as of typify_tile_source.';

CREATE FUNCTION typify_tile_body(shown text, source jsonb, min_zoom integer, max_zoom integer, branches text)
RETURNS text
LANGUAGE sql STABLE PARALLEL SAFE
BEGIN ATOMIC
	SELECT format('
#variable_conflict use_variable
-- Vector tiles of %1$s, written by typify_create_tile_function of typify %2$s.
DECLARE
	finer CONSTANT float8 := coalesce((query ->> ''finer'')::float8, 0);
	zoom CONSTANT float8 := z + finer;
	-- what of the tile is near buildings; the same in their coordinate system; its square
	area CONSTANT geometry := typify_tile_area(z, x, y, %3$s);
	box CONSTANT geometry := ST_Transform(area, %4$s);
	tile CONSTANT geometry := ST_TileEnvelope(z, x, y);
	known jsonb;
	reach float8;
	near record;
	lattice geometry;
	frame bytea;
BEGIN
	IF NOT (finer >= 0 AND finer <= 1) THEN
		RAISE EXCEPTION ''finer is %%, it must be from 0 to 1'', finer
			USING ERRCODE = ''22023'', HINT = ''The tile is drawn as of zoom z + finer.'';
	ELSIF area IS NULL OR z < %5$s OR z > %6$s THEN
		RETURN '''';
	END IF;%7$s
END
', shown, (SELECT extversion FROM pg_extension WHERE extname = 'typify'), (
			SELECT format('%s, %s, %s, %s', floor(ST_XMin(world)), floor(ST_YMin(world)), ceil(ST_XMax(world)),
				ceil(ST_YMax(world)))
			FROM ST_Transform(typify_tile_domain(source), 3857) AS world),
		source->>'srid', min_zoom, max_zoom, branches);
END;
COMMENT ON FUNCTION typify_tile_body(text, jsonb, integer, integer, text) IS
'The body of a tile function in PL/pgSQL. shown: what of; branches: statements that return a tile, with the variables that it declares.';

CREATE FUNCTION typify_tile_check_arguments(schema name, name name, min_side double precision,
	max_area double precision, min_zoom integer, max_zoom integer, tile_size integer)
RETURNS void
LANGUAGE plpgsql STABLE PARALLEL SAFE
SET search_path FROM CURRENT
AS $$
DECLARE
	argument text := CASE WHEN typify_tile_check_arguments.schema IS NULL THEN 'schema' WHEN name IS NULL THEN 'name'
		WHEN min_side IS NULL THEN 'min_side' WHEN min_zoom IS NULL THEN 'min_zoom' WHEN max_zoom IS NULL THEN 'max_zoom'
		WHEN tile_size IS NULL THEN 'tile_size' END;
BEGIN
	IF argument IS NOT NULL THEN
		PERFORM typify_refuse_null(argument);
	ELSIF to_regnamespace(quote_ident(typify_tile_check_arguments.schema)) IS NULL THEN
		RAISE EXCEPTION 'schema % does not exist', quote_ident(typify_tile_check_arguments.schema) USING ERRCODE = '3F000',
			HINT = format('CREATE SCHEMA %I, or choose one that is there.', typify_tile_check_arguments.schema);
	ELSIF to_regprocedure(format('%I.%I(integer, integer, integer, json)', typify_tile_check_arguments.schema, name))
			IS NOT NULL THEN
		RAISE EXCEPTION 'function %.%(integer, integer, integer, json) exists already',
				quote_ident(typify_tile_check_arguments.schema), quote_ident(name)
			USING ERRCODE = '42723', HINT = 'Drop it first or choose another name.';
	ELSIF min_zoom < 0 OR max_zoom < min_zoom OR max_zoom > 24 THEN
		RAISE EXCEPTION 'zooms are % to %, they must be from 0 to 24, the smaller first', min_zoom, max_zoom
			USING ERRCODE = '22023', HINT = 'Leave min_zoom and max_zoom out for 0 to 18.';
	ELSIF tile_size NOT BETWEEN 64 AND 4096 THEN
		RAISE EXCEPTION 'tile_size is %, it must be from 64 to 4096', tile_size
			USING ERRCODE = '22023', HINT = 'Map clients draw vector tiles at 512 pixels, the default, or at 256.';
	END IF;
	-- as the options that they are
	PERFORM typify_area_factor(25000, typify_options(min_side => min_side, max_area => max_area));
END $$;
COMMENT ON FUNCTION typify_tile_check_arguments(name, name, double precision, double precision, integer, integer, integer) IS
'Refuses arguments of typify_create_tile_function: 22004 for NULL, 3F000 for a schema that is missing, 42723 when the name is taken, 22023 for a value that is not allowed.';

CREATE FUNCTION typify_tile_hierarchy(hierarchy regclass) RETURNS jsonb
LANGUAGE plpgsql STABLE PARALLEL SAFE
SET search_path FROM CURRENT
AS $$
DECLARE
	part record := typify_hierarchy_parts(hierarchy);
BEGIN
	IF part.definition->'finished' = 'false' THEN
		RAISE EXCEPTION '% is not finished', part.nodes USING ERRCODE = '55000',
			HINT = 'Call typify_build_hierarchy with the same arguments to go on with it.';
	END IF;
	RETURN part.definition;
END $$;
COMMENT ON FUNCTION typify_tile_hierarchy(regclass) IS
'How a hierarchy is made, as its comment says. Errors: as of typify_hierarchy_parts; 55000 for one that is not finished.';

CREATE FUNCTION typify_tile_latitude(hierarchy regclass, source jsonb) RETURNS double precision
LANGUAGE plpgsql STABLE PARALLEL SAFE
SET search_path FROM CURRENT
AS $$
DECLARE
	latitude double precision := abs(typify_latitude((source->>'extent')::geometry));
BEGIN
	IF hierarchy IS NOT NULL THEN
		EXECUTE format('SELECT min(abs(latitude)) FROM %s', (typify_hierarchy_parts(hierarchy)).groups) INTO latitude;
	END IF;
	IF latitude IS NULL THEN
		RAISE EXCEPTION 'SRID % has no place on a web map', source->>'srid' USING ERRCODE = '22023',
			HINT = 'Use UpdateGeometrySRID to say which coordinate system it is, and build anew.';
	END IF;
	RETURN latitude;
END $$;
COMMENT ON FUNCTION typify_tile_latitude(regclass, jsonb) IS
'Degrees from the equator of the group of a hierarchy that is nearest to it, or of stored layers of their buildings. Error 22023 where the SRID is not known.';

CREATE FUNCTION typify_tile_branches(hierarchy regclass, layers regclass[], source jsonb, attributes text[],
	latitude double precision, min_side double precision, max_area double precision, tile_size integer, layer text)
RETURNS text
LANGUAGE plpgsql STABLE PARALLEL SAFE
SET search_path FROM CURRENT
AS $$
DECLARE
	part record;
	zooms integer[];
	sorted regclass[];
	outlined text;
	stored text := '';
	nodes text := '
	RETURN '''';';
BEGIN
	IF cardinality(layers) > 0 THEN
		SELECT * INTO zooms, sorted FROM typify_tile_layers(layers, latitude, tile_size);
		stored := format('
	IF z = ANY (%L) THEN
		RETURN %s;
	END IF;', zooms, typify_tile_stored(zooms, sorted, source, attributes, layer));
		outlined := format('z > %s', zooms[cardinality(zooms)]);
	END IF;
	IF hierarchy IS NOT NULL THEN
		SELECT * INTO part FROM typify_hierarchy_parts(hierarchy);
		nodes := typify_tile_nodes(part.nodes, part.groups, part.definition, source, attributes, min_side, max_area,
			tile_size, layer);
		outlined := format('typify_zoom_scale(zoom, %s, %s) < %s', latitude, tile_size,
			coalesce(part.definition->'options'->>'source_scale', '25000'));
	END IF;
	RETURN format('%s
	IF %s THEN
		%s
	END IF;%s', stored, outlined, typify_tile_outlines(source, attributes, layer), nodes);
END $$;
COMMENT ON FUNCTION typify_tile_branches(regclass, regclass[], jsonb, text[], double precision, double precision,
	double precision, integer, text) IS
'The statements of a tile function that make tiles: of a stored layer at its zoom, of the buildings where the scale is above that of their source, else of the hierarchy. latitude: the one nearest to the equator.';

CREATE FUNCTION typify_create_tile_function(
	schema name,
	name name,
	hierarchy regclass,
	attributes name[] DEFAULT '{}',
	min_side double precision DEFAULT 0.85,
	max_area double precision DEFAULT NULL,
	layers regclass[] DEFAULT NULL,
	min_zoom integer DEFAULT 0,
	max_zoom integer DEFAULT 18,
	tile_size integer DEFAULT 512,
	layer text DEFAULT NULL)
RETURNS regprocedure
LANGUAGE plpgsql
SET search_path FROM CURRENT
SET extra_float_digits = 1
AS $$
DECLARE
	signature text;
	shown text := 'stored layers';
	layer_name text := coalesce(layer, schema || '.' || name);
	source jsonb;
	latitude double precision;
	branches text;
BEGIN
	PERFORM typify_tile_check_arguments(schema, name, min_side, max_area, min_zoom, max_zoom, tile_size);
	IF hierarchy IS NULL AND coalesce(cardinality(layers), 0) = 0 THEN
		PERFORM typify_refuse_null('hierarchy', 'Give the name of a hierarchy, or stored layers as layers => ''{...}''.');
	END IF;
	signature := format('%I.%I(integer, integer, integer, json)', schema, name);
	IF hierarchy IS NOT NULL THEN
		shown := typify_table_name(hierarchy, 'hierarchy');
	END IF;
	source := typify_tile_source(CASE WHEN hierarchy IS NULL THEN typify_layer(layers[1])
		ELSE typify_tile_hierarchy(hierarchy) END);
	latitude := typify_tile_latitude(hierarchy, source);
	branches := typify_tile_branches(hierarchy, layers, source,
		typify_tile_attributes((source->>'table')::regclass, attributes), latitude, min_side, max_area, tile_size,
		layer_name);
	EXECUTE format('CREATE FUNCTION %I.%I(z integer, x integer, y integer, query json DEFAULT ''{}'') RETURNS bytea '
		'LANGUAGE plpgsql STABLE STRICT PARALLEL SAFE SET search_path FROM CURRENT SET jit = off '
		'SET enable_seqscan = off SET max_parallel_workers_per_gather = 0 AS %L', schema, name,
		typify_tile_body(shown, source, min_zoom, max_zoom, branches));
	EXECUTE format('COMMENT ON FUNCTION %s IS %L', signature, typify_tile_comment(
		format('Buildings of %s, typified', source->>'table'), layer_name, source, attributes, min_zoom, max_zoom,
		jsonb_build_object('version', (SELECT extversion FROM pg_extension WHERE extname = 'typify'),
			'shown', shown, 'layers', layers::text[], 'min_side', min_side, 'max_area', max_area,
			'tile_size', tile_size)));
	RETURN signature::regprocedure;
END $$;
COMMENT ON FUNCTION typify_create_tile_function(name, name, regclass, name[], double precision, double precision,
	regclass[], integer, integer, integer, text) IS
'Writes a function schema.name(z integer, x integer, y integer, query json DEFAULT ''{}'') that returns a vector tile (bytea, by ST_AsMVT) of a hierarchy, and returns it. pg_tileserv and Martin find it and publish it. It belongs to who calls this and not to the extension, runs with the rights of who calls it (grant SELECT on the hierarchy, its _groups and the buildings), depends on no search_path, and goes on after typify_refresh_hierarchy.
A tile shows the placeholders alive at the scale of its zoom, in each group that of the latitude of the group''s middle (typify_zoom_scale), and the buildings themselves at zooms where the scale is above source_scale everywhere. Each feature has as id that of the representative (negative ones are left out by ST_AsMVT), member_count, and the attributes. Placeholders are not clipped: two tiles that show the same one have the same polygon.
schema, name: as they are, without quotes. attributes: columns of the buildings, joined by the id of the representative; none by default. min_side, max_area: in mm and mm2 on the map instead of those of the hierarchy; 0.85 mm are 3 pixels, max_area is by default 2 * min_side^2. layers: stored layers to be shown instead, each at the zoom whose scale is nearest to its own; hierarchy may then be NULL: tiles at other zooms are empty, and show buildings above the last. min_zoom, max_zoom: tiles of other zooms are empty. tile_size: pixels that the side of a tile takes on the screen (512 in MapLibre, Mapbox GL and OpenLayers). layer: name of the tile''s layer, by default schema.name, as pg_tileserv expects. query: "finer", 0 to 1, draws the tile as of zoom z + finer; anything else in it is ignored.
The function returns NULL for a NULL argument and fails (22023) for a tile that does not exist. Its comment is TileJSON.
Errors: 22004 for NULL where a value is needed; 3F000 for a schema that is missing; 42723 when the name is taken; 42809 for what is no hierarchy or layer; 55000 for one that is not finished or has no building; 42703, 42701, 42804 for attributes (typify_tile_attributes); 22023 for an unknown SRID, two layers at one zoom and other values that are not allowed; 42P01 when the buildings are there no more.';
