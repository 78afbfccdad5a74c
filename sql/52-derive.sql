-- 52-derive.sql: placeholders of a whole table at any scale

-- A group never gets more than it has: those that would are full, and the others divide what is left. Sorted by the
-- level that fills them, the full groups come first; the level of the first that is not full is that of all the rest.
-- Nine decimals: far above what rounding does to a quota, so that ties are ties.
CREATE FUNCTION typify_allocate(total bigint, sizes bigint[], shares double precision[]) RETURNS bigint[]
LANGUAGE sql IMMUTABLE STRICT PARALLEL SAFE
BEGIN ATOMIC
	WITH given AS (
		SELECT place, size, share, size / nullif(share, 0) AS full_at
		FROM ROWS FROM (unnest(sizes), unnest(shares)) WITH ORDINALITY AS given(size, share, place)
	), divided AS (
		SELECT place, size, share, full_at, (total - sum(size) OVER up + size)::float8 / sum(share) OVER down AS level
		FROM given WHERE share > 0
		WINDOW up AS (ORDER BY full_at, place ROWS UNBOUNDED PRECEDING),
			down AS (ORDER BY full_at DESC, place DESC ROWS UNBOUNDED PRECEDING)
	), rest AS (
		SELECT coalesce((SELECT level FROM divided WHERE level <= full_at ORDER BY full_at, place LIMIT 1),
			'Infinity'::float8) AS level
	), quota AS (
		SELECT place, size, round(CASE WHEN share > 0 THEN least(size, share * rest.level) ELSE 0 END::numeric, 9)
			AS quota
		FROM given, rest
	), ranked AS (
		SELECT place, floor(quota) AS whole, total - sum(floor(quota)) OVER () AS missing,
			row_number() OVER (ORDER BY floor(quota) < size DESC, quota - floor(quota) DESC, place) AS rank
		FROM quota
	)
	SELECT array_agg((whole + CASE WHEN rank <= missing THEN 1 ELSE 0 END)::bigint ORDER BY place) FROM ranked;
END;
COMMENT ON FUNCTION typify_allocate(bigint, bigint[], double precision[]) IS
'Divides a total over groups in proportion to their shares by largest remainders (Hamilton), equal remainders by their order; no group gets more than its size. total: at most the sum of sizes. NULL for a NULL or empty argument.';

-- What the law leaves of 2^52 buildings is its share, as precise as a double.
CREATE FUNCTION typify_allot(levels typify_calibration[], scale double precision) RETURNS bigint[]
LANGUAGE plpgsql IMMUTABLE PARALLEL SAFE
SET search_path FROM CURRENT
AS $$
DECLARE
	whole CONSTANT bigint := 4503599627370496;
	options typify_options := levels[1].options;
BEGIN
	IF options.min_distance > 0 AND options.count IS NULL AND options.count_rule IS NULL AND options.exponent IS NULL THEN
		RAISE EXCEPTION 'min_distance alone says when to stop, so there is no total to distribute'
			USING ERRCODE = '22023',
				HINT = 'Set count, count_rule or exponent as well, or use allocation => ''each_group''.';
	END IF;
	RETURN typify_allocate(typify_count(levels[1].n25, scale, options),
		(SELECT array_agg(l.n25 ORDER BY ordinality) FROM unnest(levels) WITH ORDINALITY AS l WHERE NOT l.overall),
		(SELECT array_agg(l.n25 * typify_count(whole, scale, typify_options_with(l.options,
				CASE WHEN (l.options).count IS NULL THEN (l.options).exponent ELSE 2 END, (l.options).psi, NULL))::float8
			/ whole ORDER BY ordinality)
		 FROM unnest(levels) WITH ORDINALITY AS l WHERE NOT l.overall));
END $$;
COMMENT ON FUNCTION typify_allot(typify_calibration[], double precision) IS
'The count of the whole table at a scale, by the first element''s options, divided over the groups (the other elements) by typify_allocate: in proportion to what the law leaves of each in real numbers, or, with options.count, to their buildings. Error 22023 when min_distance alone says when to stop.';

CREATE FUNCTION typify_census(source text, options typify_options) RETURNS typify_calibration[]
LANGUAGE plpgsql STABLE PARALLEL RESTRICTED
SET search_path FROM CURRENT
AS $$
DECLARE
	levels typify_calibration[];
BEGIN
	EXECUTE format(
		'WITH census AS MATERIALIZED (SELECT grp, greatest(count(*) FILTER (WHERE %s), 1) AS n FROM %s AS b GROUP BY grp)
		SELECT array_agg(ROW(grp, n, 0, NULL, NULL, NULL, NULL, NULL, $1, false, overall)::typify_calibration
			ORDER BY overall DESC, grp COLLATE "C" NULLS LAST)
		FROM (SELECT grp, n, false AS overall FROM census
			UNION ALL SELECT NULL, sum(n)::bigint, true FROM census) AS each', typify_houses(options), source)
	INTO levels USING options;
	RETURN levels;
END $$;
COMMENT ON FUNCTION typify_census(text, typify_options) IS
'As typify_calibrate_levels where nothing is calibrated: the counts of a sub-select and of its groups, with the options as they are.';

CREATE FUNCTION typify_wanted(source text, groups text[], box geometry) RETURNS text[]
LANGUAGE plpgsql STABLE PARALLEL RESTRICTED
SET search_path FROM CURRENT
AS $$
BEGIN
	IF box IS NOT NULL THEN
		EXECUTE format(
			'SELECT coalesce(array_agg(DISTINCT grp), ''{}'') FROM %s AS b
			WHERE geom && $1 AND ($2 IS NULL OR typify_group_key(grp) = ANY ($2))', source)
		INTO groups USING box, typify_group_keys(groups);
	END IF;
	RETURN groups;
END $$;
COMMENT ON FUNCTION typify_wanted(text, text[], geometry) IS
'The groups among the given ones that have a building whose bounding box meets that of box; NULL for all groups, when neither is given.';

CREATE FUNCTION typify_surroundings(source text, groups text[], scale double precision) RETURNS geometry
LANGUAGE plpgsql STABLE PARALLEL RESTRICTED
SET search_path FROM CURRENT
AS $$
DECLARE
	extent geometry;
BEGIN
	IF groups IS NOT NULL THEN
		EXECUTE format('SELECT ST_SetSRID(ST_Extent(geom)::geometry, min(ST_SRID(geom))) FROM %s AS b
			WHERE typify_group_key(grp) = ANY ($1)', source) INTO extent USING typify_group_keys(groups);
	END IF;
	RETURN ST_Expand(extent, 0.02 * scale / typify_metres_per_unit(nullif(ST_SRID(extent), 0)));
END $$;
COMMENT ON FUNCTION typify_surroundings(text, text[], double precision) IS
'A box around the buildings of these groups that reaches 20 mm on the map farther, beyond all that a barrier may touch; NULL for all groups and where the groups have no building.';

CREATE FUNCTION typify_plan(lod25 regclass, lod200 regclass, scale double precision, s_u double precision,
	group_by name, box geometry, options typify_options, allocation text, id_column name, geom_column name,
	lod200_id_column name, lod200_geom_column name, lod200_group_by name, links regclass, groups text[],
	barriers_table regclass, barriers_geom_column name, importance_column name,
	OUT source text, OUT levels typify_calibration[], OUT hidden text[], OUT barriers geometry)
LANGUAGE plpgsql STABLE PARALLEL RESTRICTED
SET search_path FROM CURRENT
SET jit = off
SET datestyle = ISO
SET intervalstyle = postgres
SET timezone = 'UTC'
SET bytea_output = hex
SET extra_float_digits = 1
AS $$
DECLARE
	grouped boolean := group_by IS NOT NULL OR links IS NOT NULL;
	whole record;
	wanted text[];
	keys text[];
	allotted bigint[];
BEGIN
	IF allocation IS NULL THEN
		PERFORM typify_refuse_null('allocation');
	ELSIF allocation NOT IN ('each_group', 'total') THEN
		RAISE EXCEPTION 'allocation is "%", it must be each_group or total', allocation
			USING ERRCODE = '22023', HINT = 'each_group gives every group its own count, total divides that of all.';
	END IF;
	PERFORM typify_check_parameters(scale, s_u, options);
	whole := typify_levels(lod25, lod200, id_column, geom_column, lod200_id_column, lod200_geom_column, group_by,
		lod200_group_by, links, false, importance_column);
	PERFORM typify_check_same_srid('lod25', whole.srid, 'box', ST_SRID(box));

	wanted := typify_wanted(whole.lod25_source, groups, box);
	keys := typify_group_keys(wanted);
	source := typify_lod25_source(lod25, id_column, geom_column, group_by, links, wanted, importance_column);
	barriers := typify_barrier_lines(barriers_table, barriers_geom_column, options, whole.srid,
		CASE WHEN lod200 IS NULL THEN typify_surroundings(source, wanted, scale) END);
	options := typify_options_without_barriers(options);
	IF lod200 IS NOT NULL THEN
		levels := typify_calibrate_levels(whole.lod25_source, whole.lod200_source, s_u, options, grouped, wanted, false,
			barriers);
	ELSE
		levels := typify_census(CASE allocation WHEN 'total' THEN whole.lod25_source ELSE source END, options);
	END IF;
	IF NOT grouped THEN
		levels := levels[1:1];
		levels[1].overall := false;
	ELSIF allocation = 'total' THEN
		allotted := 0 || typify_allot(levels, scale);
	END IF;
	SELECT array_agg(ROW(l.grp, l.n25, l.n200, l.mean_area25, l.mean_placeholder_area, l.mean_area200, l.exponent,
			l.psi, typify_options_with(l.options, (l.options).exponent, (l.options).psi,
				CASE WHEN allotted IS NULL THEN (l.options).count ELSE greatest(allotted[ordinality], 1) END),
			l.calibrated, l.overall)::typify_calibration ORDER BY ordinality),
		array_agg(typify_group_key(l.grp)) FILTER (WHERE allotted[ordinality] = 0)
	INTO levels, hidden
	FROM unnest(levels) WITH ORDINALITY AS l
	WHERE NOT l.overall AND l.n25 > 0 AND (wanted IS NULL OR typify_group_key(l.grp) = ANY (keys));
END $$;
COMMENT ON FUNCTION typify_plan(regclass, regclass, double precision, double precision, name, geometry, typify_options,
	text, name, name, name, name, name, regclass, text[], regclass, name, name) IS
'What typify_derive, whose arguments these are, does before it draws. source: of the buildings, at least those of the groups asked for; barriers: all that these groups may touch; levels: these groups, by the bytes of their names, the NULL group last, each with its options, NULL when there is none; hidden: the keys (typify_group_key) of those that get no placeholder, and are one row that is not drawn.';

CREATE FUNCTION typify_draw_sites(source text, scale double precision, s_u double precision,
	levels typify_calibration[], hidden text[], barriers geometry)
RETURNS TABLE (
	id bigint,
	geom geometry,
	member_count integer,
	members bigint[],
	area double precision,
	width double precision,
	length double precision,
	orientation double precision,
	grp text,
	site double precision[])
LANGUAGE plpgsql STABLE PARALLEL RESTRICTED
SET search_path FROM CURRENT
SET jit = off
SET datestyle = ISO
SET intervalstyle = postgres
SET timezone = 'UTC'
SET bytea_output = hex
SET extra_float_digits = 1
AS $$
BEGIN
	RETURN QUERY EXECUTE format(
		'SELECT p.id, CASE WHEN shown THEN p.geom END, p.member_count, p.members, CASE WHEN shown THEN p.area ELSE 0 END,
			CASE WHEN shown THEN p.width ELSE 0 END, CASE WHEN shown THEN p.length ELSE 0 END, p.orientation, g.grp,
			CASE WHEN shown AND p.geom IS NOT NULL THEN p.site END
		FROM (SELECT l.grp, typify_sites(b.geom, b.id, $1, $2, l.options, (SELECT $5), b.importance) AS list
			FROM %s AS b JOIN unnest($3) AS l ON typify_group_key(l.grp) = typify_group_key(b.grp)
			GROUP BY l.grp) AS g
		CROSS JOIN LATERAL unnest(g.list) AS p
		CROSS JOIN LATERAL (SELECT (typify_group_key(g.grp) = ANY ($4)) IS NOT TRUE AS shown) AS either', source)
		USING scale, s_u, levels, hidden, barriers;
END $$;
COMMENT ON FUNCTION typify_draw_sites(text, double precision, double precision, typify_calibration[], text[], geometry) IS
'The rows of typify_derive, as typify_plan says, with each group legible by itself, and the field site of typify_site where a row is drawn.';

CREATE FUNCTION typify_settled_geometry(geom geometry, settled typify_settled) RETURNS geometry
LANGUAGE sql IMMUTABLE PARALLEL SAFE
BEGIN ATOMIC
	SELECT CASE WHEN (settled).id IS NULL THEN geom WHEN NOT (settled).drawn THEN NULL
		WHEN (settled).geom IS NOT NULL THEN (settled).geom
		ELSE ST_Affine(geom, (settled).factor, 0, 0, (settled).factor, (settled).x, (settled).y) END;
END;
COMMENT ON FUNCTION typify_settled_geometry(geometry, typify_settled) IS
'The polygon of a placeholder after typify_settle; the one before where nothing was done to it.';

CREATE FUNCTION typify_settled_area(area double precision, settled typify_settled) RETURNS double precision
LANGUAGE sql IMMUTABLE PARALLEL SAFE
BEGIN ATOMIC
	SELECT CASE WHEN (settled).id IS NULL THEN area WHEN NOT (settled).drawn THEN 0
		WHEN (settled).geom IS NOT NULL THEN (settled).width * (settled).length
		ELSE area * (settled).factor * (settled).factor END;
END;
COMMENT ON FUNCTION typify_settled_area(double precision, typify_settled) IS
'The area of a placeholder after typify_settle; the one before where nothing was done to it.';

CREATE FUNCTION typify_draw_layer(source text, scale double precision, s_u double precision,
	levels typify_calibration[], hidden text[], barriers geometry)
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
LANGUAGE plpgsql STABLE PARALLEL RESTRICTED
SET search_path FROM CURRENT
SET jit = off
AS $$
BEGIN
	RETURN QUERY
		WITH drawn AS MATERIALIZED (
			SELECT * FROM typify_draw_sites(source, scale, s_u, levels, hidden, barriers)
		), settled AS MATERIALIZED (
			SELECT s FROM unnest((
				SELECT typify_settle(n.id, n.number::integer, n.member_count, ST_SRID(n.geom), n.site, (SELECT typify_draw_layer.barriers))
				FROM (SELECT *, dense_rank() OVER (ORDER BY typify_group_key(d.grp)) AS number FROM drawn AS d
					WHERE d.site IS NOT NULL) AS n)) AS s
		)
		SELECT d.id, typify_settled_geometry(d.geom, s), d.member_count + coalesce(cardinality(i.members), 0),
			d.members || i.members, typify_settled_area(d.area, s), coalesce((s).width, d.width),
			coalesce((s).length, d.length), d.orientation, d.grp
		FROM drawn AS d LEFT JOIN settled ON (s).id = d.id
		LEFT JOIN (
			SELECT (gone.s).heir AS id, array_agg(m ORDER BY g.id, place) AS members
			FROM settled AS gone JOIN drawn AS g ON g.id = (gone.s).id
			CROSS JOIN LATERAL unnest(g.members) WITH ORDINALITY AS m (m, place)
			WHERE (gone.s).heir IS NOT NULL GROUP BY (gone.s).heir) AS i ON i.id = d.id
		WHERE (s).heir IS NULL;
END $$;
COMMENT ON FUNCTION typify_draw_layer(text, double precision, double precision, typify_calibration[], text[], geometry) IS
'The rows of typify_derive, as typify_plan says, with the placeholders of all groups legible together.';

CREATE FUNCTION typify_draw(source text, scale double precision, s_u double precision, levels typify_calibration[],
	hidden text[], grouped boolean, barriers geometry, whole boolean)
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
LANGUAGE plpgsql STABLE PARALLEL RESTRICTED
SET search_path FROM CURRENT
SET jit = off
SET datestyle = ISO
SET intervalstyle = postgres
SET timezone = 'UTC'
SET bytea_output = hex
SET extra_float_digits = 1
AS $$
BEGIN
	IF levels IS NULL THEN
		RETURN;
	ELSIF whole AND grouped AND (levels[1].options).min_gap > 0 THEN
		RETURN QUERY SELECT * FROM typify_draw_layer(source, scale, s_u, levels, hidden, barriers);
		RETURN;
	END IF;
	RETURN QUERY
		SELECT p.id, CASE WHEN shown THEN p.geom END, p.member_count, p.members, CASE WHEN shown THEN p.area ELSE 0 END,
			CASE WHEN shown THEN p.width ELSE 0 END, CASE WHEN shown THEN p.length ELSE 0 END, p.orientation, g.grp
		FROM typify_each_group(source, scale, s_u, levels, grouped, barriers) AS g
		CROSS JOIN LATERAL unnest(g.list) AS p
		CROSS JOIN LATERAL (SELECT (typify_group_key(g.grp) = ANY (hidden)) IS NOT TRUE AS shown) AS either;
END $$;
COMMENT ON FUNCTION typify_draw(text, double precision, double precision, typify_calibration[], text[], boolean, geometry,
	boolean) IS
'The rows of typify_derive, as typify_plan says. grouped: false takes everything as one group. whole: these are all groups, whose placeholders options.min_gap keeps apart across groups too.';

CREATE FUNCTION typify_derive(
	lod25 regclass,
	lod200 regclass,
	scale double precision,
	s_u double precision DEFAULT 0,
	group_by name DEFAULT NULL,
	box geometry DEFAULT NULL,
	options typify_options DEFAULT NULL,
	allocation text DEFAULT 'each_group',
	id_column name DEFAULT 'id',
	geom_column name DEFAULT 'geom',
	lod200_id_column name DEFAULT 'id',
	lod200_geom_column name DEFAULT 'geom',
	lod200_group_by name DEFAULT NULL,
	links regclass DEFAULT NULL,
	groups text[] DEFAULT NULL,
	barriers regclass DEFAULT NULL,
	barriers_geom_column name DEFAULT 'geom',
	importance_column name DEFAULT NULL)
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
LANGUAGE plpgsql STABLE PARALLEL RESTRICTED
SET search_path FROM CURRENT
AS $$
DECLARE
	plan record;
BEGIN
	plan := typify_plan(lod25, lod200, scale, s_u, group_by, box, options, allocation, id_column, geom_column,
		lod200_id_column, lod200_geom_column, lod200_group_by, links, groups, barriers, barriers_geom_column,
		importance_column);
	RETURN QUERY SELECT * FROM typify_draw(plan.source, scale, s_u, plan.levels, plan.hidden,
		group_by IS NOT NULL OR links IS NOT NULL, plan.barriers, box IS NULL AND groups IS NULL);
END $$;
COMMENT ON FUNCTION typify_derive(regclass, regclass, double precision, double precision, name, geometry,
	typify_options, text, name, name, name, name, name, regclass, text[], regclass, name, name) IS
'The placeholders of a table of buildings at any scale (its denominator, at least source_scale), calibrated as typify_calibrate does with lod200, the stored coarse level, or, where lod200 is NULL, with options as they are. Rows in no particular order: the fields of typify_placeholder (id: of the representative, and so a key of the layer), and grp, the group as text.
group_by: a column of lod25, of any type; each of its values is typified by itself, NULL too. links: a table or view with lod25_id and lod200_id, as typify_match returns, instead: lod200_id is the group, and buildings without a link are the NULL group; at m200 each group with an object of lod200 is one placeholder of its area.
allocation: each_group gives every group its own count, as the aggregate does. total divides the count of the whole table at the scale by largest remainders, in proportion to what the law leaves of each group in real numbers, equal remainders by the bytes of the group''s name. A group may get none: it is one row with geom NULL, area, width and length 0, all its buildings as members.
box: only groups that have a building whose bounding box meets that of box, each whole. groups: only these groups (an element NULL is the NULL group). The rows are the same as without either, unless options.min_gap is set.
options.min_gap: with neither box nor groups placeholders are kept apart over the whole table. Those of different groups are not merged but shrunk, moved or, last, not drawn: then their members go to the nearest placeholder of their group, and where none of a group fits it is a row that is not drawn (geom NULL, with a WARNING). With box or groups each group is legible by itself.
barriers: a table or view of roads, rivers, railways (its column barriers_geom_column, lines or polygons) that nothing is merged across: those that are drawn at the scale. The same as the option barriers, which goes without a table; calibration heeds them too.
importance_column: a column of lod25 with numbers, the importance of each building as typify_placeholders takes it: ''Infinity'' keeps it in place and in size.
Columns, groups of lod200 and what options keep: see typify_calibrate. lod25 and lod200 may be tables, views, materialized, partitioned or foreign tables; NULL and EMPTY geometries do not count. No row when lod25 has no building.
Errors: as of typify_calibrate and typify_placeholders; 22023 for an allocation or a scale that is not allowed, a box of another SRID, and total with min_distance alone.';
