-- 77-refresh.sql: a hierarchy brought up to date, and which map tiles are stale by that

CREATE TYPE typify_drawn AS (
	zoom integer,
	state bigint,
	west integer,
	north integer,
	east integer,
	south integer
);
COMMENT ON TYPE typify_drawn IS
'What a hierarchy shows at a zoom of a web map: state, a hash of what is drawn, and the tiles where it is seen, columns west to east, rows north to south.';

CREATE FUNCTION typify_tiles_of_box(box geometry, zoom integer, OUT west integer, OUT north integer, OUT east integer,
	OUT south integer)
LANGUAGE sql IMMUTABLE PARALLEL SAFE
BEGIN ATOMIC
	-- in sides of a tile from the north-western corner of the world; a tile shows a sixty-fourth around it
	SELECT floor(greatest(least(ST_XMin(m) / side + n / 2 - 1.0 / 64, n - 1), 0))::integer,
		floor(greatest(least(n / 2 - ST_YMax(m) / side - 1.0 / 64, n - 1), 0))::integer,
		floor(greatest(least(ST_XMax(m) / side + n / 2 + 1.0 / 64, n - 1), 0))::integer,
		floor(greatest(least(n / 2 - ST_YMin(m) / side + 1.0 / 64, n - 1), 0))::integer
	FROM ST_Transform(box, 3857) AS m, LATERAL (SELECT power(2::float8, zoom) AS n) AS tiles,
		LATERAL (SELECT 2 * pi() * 6378137 / n AS side) AS mercator;
END;
COMMENT ON FUNCTION typify_tiles_of_box(geometry, integer) IS
'The tiles of a web map (Web Mercator) at a zoom on which a box is seen, in their square or in the 64th of it that they show around it: columns and rows, the first in the north-west. NULL for a NULL box.';

CREATE FUNCTION typify_hierarchy_drawn(hierarchy regclass, ids integer[], min_zoom integer, max_zoom integer,
	min_side double precision)
RETURNS typify_drawn[]
LANGUAGE plpgsql STABLE PARALLEL SAFE
SET search_path FROM CURRENT
SET jit = off AS
$$
DECLARE
	part record := typify_hierarchy_parts(hierarchy);
	options typify_options := typify_options_without_barriers(typify_hierarchy_options(part.definition));
	srid integer := typify_hierarchy_srid(part.groups::regclass);
	nodes typify_drawn[];
	outlines typify_drawn[];
	equator double precision;
BEGIN
	EXECUTE format('SELECT min(abs(latitude)) FROM %s', part.groups) INTO equator;
	EXECUTE format(
		'WITH shown AS (
			SELECT group_id, psi, zoom, scale, sqrt(greatest(typify_area_factor(scale, typify_options_with($1, exponent,
				coalesce(psi, ($1).psi), NULL)), 1)) AS enlargement
			FROM %2$s, generate_series($2, $3) AS zoom,
				LATERAL (SELECT greatest(typify_zoom_scale(zoom, latitude), $4) AS scale) AS own
			WHERE group_id = ANY ($5) AND typify_zoom_scale(zoom, $6) >= $4 AND latitude IS NOT NULL
		)
		SELECT array_agg(ROW(zoom, typify_leaf_hash(representative, x, y, area, ratio, ux, uy)
			# hashint8extended(member_count, kept::integer) # hashfloat8extended(coalesce(psi, 0), 0),
			(tiles).west, (tiles).north, (tiles).east, (tiles).south)::typify_drawn)
		FROM (
			SELECT n.*, shown.psi, zoom, typify_tiles_of_box(ST_Expand(ST_SetSRID(ST_MakePoint(x, y), $7),
				typify_reach(area, ratio, 0.75) * enlargement + 0.92 * $8 * scale), zoom) AS tiles
			FROM shown JOIN %1$s AS n USING (group_id)
			WHERE n.scale_from <= scale AND n.scale_to > scale OFFSET 0
		) AS alive', part.nodes, part.groups)
	INTO nodes USING options, min_zoom, max_zoom, coalesce(options.source_scale, 25000), ids, equator, srid,
		greatest(min_side, options.min_side) / 1000 / typify_metres_per_unit(srid);
	EXECUTE format(
		'SELECT array_agg(ROW(zoom, state, (tiles).west, (tiles).north, (tiles).east, (tiles).south)::typify_drawn)
		FROM (SELECT zoom, state, typify_tiles_of_box(ST_Expand(extent, 4 * reach), zoom) AS tiles
			FROM %s, generate_series($1, $2) AS zoom
			WHERE group_id = ANY ($3) AND typify_zoom_scale(zoom, $4) < $5 AND latitude IS NOT NULL OFFSET 0) AS outline',
		part.groups)
	INTO outlines USING min_zoom, max_zoom, ids, equator, coalesce(options.source_scale, 25000);
	RETURN nodes || outlines;
END
$$;
COMMENT ON FUNCTION typify_hierarchy_drawn(regclass, integer[], integer, integer, double precision) IS
'What is seen of these groups of a hierarchy at the zooms of a web map: an element for every placeholder at each zoom that shows placeholders, and for each group where outlines are shown instead. min_side: of the tiles, mm. NULL where the SRID is not known.';

CREATE FUNCTION typify_refresh_hierarchy(
	hierarchy regclass,
	groups text[] DEFAULT NULL,
	min_zoom integer DEFAULT 0,
	max_zoom integer DEFAULT 14,
	min_side double precision DEFAULT 0.85)
RETURNS TABLE (z integer, x integer, y integer)
LANGUAGE plpgsql
SET search_path FROM CURRENT
SET jit = off AS
$$
DECLARE
	part record;
	changes typify_hierarchy_change[];
	ids integer[];
	before typify_drawn[];
	after typify_drawn[];
BEGIN
	EXECUTE format('LOCK TABLE %s IN SHARE ROW EXCLUSIVE MODE', typify_table_name(hierarchy, 'hierarchy'));
	part := typify_hierarchy_parts(hierarchy);
	IF part.definition->'finished' = 'false' THEN
		RAISE EXCEPTION '% is not finished', part.nodes USING ERRCODE = 'object_not_in_prerequisite_state',
			HINT = 'Call typify_build_hierarchy with the same arguments to go on with it.';
	ELSIF NOT (min_zoom BETWEEN 0 AND 24 AND max_zoom BETWEEN min_zoom AND 24) THEN
		RAISE EXCEPTION 'zooms are % to %, they must be from 0 to 24, the smaller first', min_zoom, max_zoom
			USING ERRCODE = 'invalid_parameter_value', HINT = 'Leave them out for 0 to 14, or set max_zoom to NULL for none.';
	ELSIF NOT (min_side >= 0 AND min_side < 'Infinity') THEN
		RAISE EXCEPTION 'min_side is %, it must be a finite number of at least 0', min_side
			USING ERRCODE = 'invalid_parameter_value', HINT = 'Leave it out for that of tiles, 0.85 mm.';
	END IF;
	changes := typify_hierarchy_changes(hierarchy, groups);
	IF changes IS NULL THEN
		RETURN;
	END IF;
	-- of a ranked hierarchy all life spans move
	EXECUTE format('SELECT array_agg(group_id) FROM %s WHERE $1 OR group_id IN (SELECT group_id FROM unnest($2))',
		part.groups) INTO ids USING part.definition->>'life_spans' = 'ranked', changes;
	before := typify_hierarchy_drawn(hierarchy, ids, min_zoom, max_zoom, min_side);
	PERFORM typify_hierarchy_mark(hierarchy, changes);
	WHILE typify_hierarchy_build(hierarchy, 1000) IS NOT NULL LOOP
	END LOOP;
	PERFORM typify_hierarchy_complete(hierarchy);
	EXECUTE format('SELECT array_agg(group_id) FROM %s WHERE group_id = ANY ($1) OR typify_group_key(grp) IN '
		'(SELECT typify_group_key(grp) FROM unnest($2))', part.groups) INTO ids USING ids, changes;
	after := typify_hierarchy_drawn(hierarchy, ids, min_zoom, max_zoom, min_side);
	RETURN QUERY
		WITH old AS MATERIALIZED (SELECT * FROM unnest(before)), new AS MATERIALIZED (SELECT * FROM unnest(after)),
		differing AS ((TABLE old EXCEPT ALL TABLE new) UNION ALL (TABLE new EXCEPT ALL TABLE old))
		SELECT DISTINCT d.zoom, tile_x, tile_y FROM differing AS d, generate_series(d.west, d.east) AS tile_x,
			generate_series(d.north, d.south) AS tile_y;
END
$$;
COMMENT ON FUNCTION typify_refresh_hierarchy(regclass, text[], integer, integer, double precision) IS
'Brings a hierarchy up to date with its tables: makes the nodes of groups anew whose buildings changed, and of a calibrated hierarchy those whose calibration moved. Afterwards it holds what building it anew would, but for the numbers of groups; of a ranked one the life spans of all groups are set anew. Returns the map tiles that are stale by that, as z, x, y of Web Mercator (XYZ, rows from the north): those that show a placeholder which was there before or is there now, and not both; at zooms that show outlines of buildings those that meet a group which changed.
groups: those that changed, as text (a NULL element is the NULL group); without them every group is compared, by a hash of its buildings. min_zoom, max_zoom: which zooms are looked at; NULL for none, which is faster. min_side: that of the tiles, mm on the map. Where the SRID is not known there are no tiles.
Errors: 42809 for a table that is no hierarchy; 55000 for one that is not finished; 22023 for zooms and min_side; 42P01 when a table from which it is made is there no more; those of typify_build_hierarchy.';
