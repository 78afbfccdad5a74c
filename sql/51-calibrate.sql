-- 51-calibrate.sql: psi and exponent from the two stored levels of detail

CREATE TYPE typify_calibration AS (
	grp text,
	n25 bigint,
	n200 bigint,
	mean_area25 double precision,
	mean_placeholder_area double precision,
	mean_area200 double precision,
	exponent double precision,
	psi double precision,
	options typify_options,
	calibrated boolean,
	overall boolean
);
COMMENT ON TYPE typify_calibration IS
'What typify_calibrate finds for a group or, where overall is true, for all together. grp: the group as text, NULL for the NULL group and for all. n25, n200: usable buildings of LOD25 and objects of LOD200 (a geometry that is NULL or EMPTY does not count). mean_area25, mean_area200: their mean areas. mean_placeholder_area: mean over the placeholders at m200 of the unscaled mean (median, sum) of their members'' areas. Areas in square units of the SRID, NULL where there is nothing to take the mean of. exponent, psi: those of options; NULL where the options have no use for it. options: ready to pass on. calibrated: false for a group with no object of LOD200, or with more of them than buildings, which has the values of all.';

CREATE FUNCTION typify_exponent(
	n25 bigint,
	n200 bigint,
	m25 double precision DEFAULT 25000,
	m200 double precision DEFAULT 200000)
RETURNS double precision
LANGUAGE sql IMMUTABLE STRICT PARALLEL SAFE
BEGIN ATOMIC
	-- ln(m25 / m200): of the very quotient that the law raises to a power, so that nothing is lost where it is near 1
	SELECT CASE WHEN n25 <= n200 THEN 0 WHEN n200 > 0 THEN -2 * ln(n25::float8 / n200) / ln(m25 / m200) END;
END;
COMMENT ON FUNCTION typify_exponent(bigint, bigint, double precision, double precision) IS
'The exponent at which the radical law leaves n200 of n25 buildings at m200: 2 ln(n25 / n200) / ln(m200 / m25), and 0 where n200 is not less than n25; NULL for n200 of 0 or less. typify_count(n25, m200, options with this exponent) is n200 exactly: the law counts with a tolerance of 1e-12, and what rounding does to exponent and power is below 1e-13. m25 and m200: denominators, m25 the smaller.';

CREATE FUNCTION typify_options_with(
	options typify_options,
	exponent double precision,
	psi double precision,
	count bigint)
RETURNS typify_options
LANGUAGE sql IMMUTABLE PARALLEL SAFE
BEGIN ATOMIC
	SELECT typify_options((options).source_scale, (options).lod200_scale, exponent, psi, count, (options).min_distance,
		(options).count_rule, (options).area_statistic, (options).shape, (options).min_area, (options).min_side,
		(options).max_area, (options).keep_area, (options).min_gap, (options).alignment, (options).barriers,
		(options).barrier_width);
END;
COMMENT ON FUNCTION typify_options_with(typify_options, double precision, double precision, bigint) IS
'Options with another exponent, psi and count; NULL unsets one. Errors: as of typify_options.';

CREATE FUNCTION typify_options_without_sizes(options typify_options)
RETURNS typify_options
LANGUAGE sql IMMUTABLE PARALLEL SAFE
BEGIN ATOMIC
	SELECT typify_options((options).source_scale, (options).lod200_scale, (options).exponent, (options).psi,
		(options).count, (options).min_distance, (options).count_rule, (options).area_statistic, (options).shape,
		(options).min_area, alignment => (options).alignment, barriers => (options).barriers);
END;
COMMENT ON FUNCTION typify_options_without_sizes(typify_options) IS
'Options without those that make a map legible (min_side, max_area, keep_area, min_gap, barrier_width): sizes are calibrated as the area factor alone makes them. Errors: as of typify_options.';

CREATE FUNCTION typify_options_without_barriers(options typify_options)
RETURNS typify_options
LANGUAGE plpgsql IMMUTABLE PARALLEL SAFE
SET search_path FROM CURRENT
AS $$
BEGIN
	IF options.barriers IS NOT NULL THEN
		options.barriers := NULL;
	END IF;
	RETURN options;
END $$;
COMMENT ON FUNCTION typify_options_without_barriers(typify_options) IS
'Options without barriers: what is passed on for every group.';

CREATE FUNCTION typify_check_parameters(scale double precision, s_u double precision, options typify_options)
RETURNS void
LANGUAGE sql IMMUTABLE PARALLEL SAFE
BEGIN ATOMIC
	SELECT typify_cluster(ST_SetSRID('POINT(0 0)'::geometry, coalesce(ST_SRID((options).barriers), 0)), scale, s_u,
		options) OVER ();
END;
COMMENT ON FUNCTION typify_check_parameters(double precision, double precision, typify_options) IS
'Refuses scale, s_u and options as typify does, before any building is read.';

-- A group key as text that is never NULL, so that groups can be joined by hashing.
CREATE FUNCTION typify_group_key(grp text) RETURNS text
LANGUAGE sql IMMUTABLE PARALLEL SAFE
RETURN coalesce('=' || grp, '');
COMMENT ON FUNCTION typify_group_key(text) IS
'Text that is never NULL and differs where groups differ: = and the group, or nothing for NULL';

CREATE FUNCTION typify_group_keys(groups text[]) RETURNS text[]
LANGUAGE sql IMMUTABLE STRICT PARALLEL SAFE
BEGIN ATOMIC
	SELECT coalesce(array_agg(DISTINCT typify_group_key(grp)), '{}') FROM unnest(groups) AS grp;
END;
COMMENT ON FUNCTION typify_group_keys(text[]) IS
'The different keys (typify_group_key) of groups; NULL for NULL, which means all';

CREATE FUNCTION typify_each_group(source text, scale double precision, s_u double precision,
	groups typify_calibration[], grouped boolean, barriers geometry)
RETURNS TABLE (grp text, list typify_placeholder[])
LANGUAGE plpgsql STABLE PARALLEL RESTRICTED
SET search_path FROM CURRENT
SET jit = off
AS $$
BEGIN
	IF grouped AND barriers IS NULL THEN
		RETURN QUERY EXECUTE format(
			'SELECT l.grp, typify_placeholders(b.geom, b.id, $1, $2, l.options, b.importance)
			FROM %s AS b JOIN unnest($3) AS l ON typify_group_key(l.grp) = typify_group_key(b.grp)
			GROUP BY l.grp', source)
			USING scale, s_u, groups;
	ELSIF grouped THEN
		RETURN QUERY EXECUTE format(
			'SELECT l.grp, typify_barred(b.geom, b.id, $1, $2, l.options, (SELECT $4), b.importance)
			FROM %s AS b JOIN unnest($3) AS l ON typify_group_key(l.grp) = typify_group_key(b.grp)
			GROUP BY l.grp', source)
			USING scale, s_u, groups, barriers;
	ELSE
		RETURN QUERY EXECUTE format(
			'SELECT NULL::text, typify_barred(b.geom, b.id, $1, $2, $3, (SELECT $4), b.importance) FROM %s AS b', source)
			USING scale, s_u, groups[1].options, barriers;
	END IF;
END $$;
COMMENT ON FUNCTION typify_each_group(text, double precision, double precision, typify_calibration[], boolean, geometry) IS
'The placeholders of the groups of a sub-select (id, geom, grp, importance) that are named in groups, each with its options there, in one reading. grouped: false takes everything as one group, with the options of the first element. barriers: of all groups; NULL for none. Errors: as of typify_placeholders.';

CREATE FUNCTION typify_houses(options typify_options) RETURNS text
LANGUAGE sql STABLE PARALLEL SAFE
BEGIN ATOMIC
	SELECT CASE WHEN (options).min_area > 0
		THEN format('(ST_Area(geom) >= %L::double precision OR importance = ''Infinity'') IS TRUE', (options).min_area)
		ELSE 'true' END;
END;
COMMENT ON FUNCTION typify_houses(typify_options) IS
'A condition on the rows of a source of buildings (geom, importance) that holds for those that count, which is all but those below min_area.';

-- Means by exact sums, so that they do not depend on the order of rows.
CREATE FUNCTION typify_survey(lod25_source text, lod200_source text, houses text) RETURNS typify_calibration[]
LANGUAGE plpgsql STABLE PARALLEL RESTRICTED
SET search_path FROM CURRENT
AS $$
DECLARE
	levels typify_calibration[];
BEGIN
	EXECUTE format(
		'WITH lod25 AS (
			SELECT grp, greatest(count(*) FILTER (WHERE house), 1) AS n,
				sum(ST_Area(geom)::numeric) FILTER (WHERE house) AS area
			FROM (SELECT grp, geom, %s AS house FROM %s AS b) AS b GROUP BY grp
		), lod200 AS (
			SELECT grp, count(*) AS n, sum(ST_Area(geom)::numeric) AS area FROM %s AS c GROUP BY grp
		), a AS (
			SELECT false AS overall, grp, typify_group_key(grp) AS key, n, area FROM lod25
			UNION ALL SELECT true, NULL, '''', sum(n)::bigint, sum(area) FROM lod25
		), b AS (
			SELECT false AS overall, grp, typify_group_key(grp) AS key, n, area FROM lod200
			UNION ALL SELECT true, NULL, '''', sum(n)::bigint, sum(area) FROM lod200
		)
		SELECT array_agg(ROW(coalesce(a.grp, b.grp), coalesce(a.n, 0), coalesce(b.n, 0), a.area / a.n, NULL,
			b.area / b.n, NULL, NULL, NULL, NULL, overall)::typify_calibration
			ORDER BY overall DESC, coalesce(a.grp, b.grp) COLLATE "C" NULLS LAST)
		FROM a FULL JOIN b USING (overall, key)', houses, lod25_source, lod200_source) INTO levels;
	RETURN levels;
END $$;
COMMENT ON FUNCTION typify_survey(text, text, text) IS
'Counts and mean areas of two sub-selects (geom, grp, the first importance too), of the first of those that houses (see typify_houses) holds for, a group without any counting as one: the first element for all together, then one for each group of either, by the bytes of grp (C collation), the NULL group last. The other fields are NULL.';

-- psi: such that the area factor is 1 at m200, since what is kept has its own area whatever the factor; 0 where that
-- would be lost to rounding. With min_area nothing but sheds alone is without size: they count for nothing. Messages
-- about placeholders without size belong to what is drawn; here nothing is.
CREATE FUNCTION typify_measure(source text, levels typify_calibration[], s_u double precision, counts bigint[],
	measured boolean[], barriers geometry)
RETURNS typify_calibration[]
LANGUAGE plpgsql STABLE PARALLEL RESTRICTED
SET search_path FROM CURRENT
SET client_min_messages = error
AS $$
DECLARE
	lod200_scale double precision := coalesce((levels[1].options).lod200_scale, 200000);
	reduction double precision := coalesce((levels[1].options).source_scale, 25000) / lod200_scale;
	probe_psi double precision := CASE WHEN reduction > 1e-4 THEN 1 - reduction * reduction ELSE 0 END;
	factor double precision := CASE WHEN (levels[1].options).area_statistic = 'sum' THEN 1
		ELSE typify_area_factor(lod200_scale, typify_options_with(levels[1].options, NULL, probe_psi, NULL)) END;
	sized_only boolean := coalesce((levels[1].options).min_area, 0) > 0;
	probes typify_calibration[];
BEGIN
	SELECT array_agg(ROW(l.grp, l.n25, l.n200, l.mean_area25, NULL, l.mean_area200, l.exponent, probe_psi,
		typify_options_with(typify_options_without_sizes(l.options), l.exponent, probe_psi,
			coalesce(counts[ordinality], (l.options).count)), l.calibrated, l.overall)::typify_calibration)
	INTO probes
	FROM unnest(levels) WITH ORDINALITY AS l
	WHERE measured IS NULL OR measured[ordinality];
	RETURN (
		WITH size AS MATERIALIZED (
			SELECT grp, n, area / factor AS area
			FROM typify_each_group(source, lod200_scale, s_u, probes, measured IS NOT NULL, barriers), LATERAL (
				SELECT count(*) FILTER (WHERE p.geom IS NOT NULL OR NOT sized_only) AS n, sum(p.area) AS area
				FROM unnest(list) AS p) AS sizes
		), mean AS (
			SELECT typify_group_key(grp) AS key, false AS overall, area / nullif(n, 0) AS area FROM size
			UNION ALL SELECT '', true, sum(area ORDER BY grp COLLATE "C" NULLS LAST) / nullif(sum(n), 0) FROM size
		)
		SELECT array_agg(ROW(l.grp, l.n25, l.n200, l.mean_area25, mean.area, l.mean_area200, l.exponent, l.psi,
			l.options, l.calibrated, l.overall)::typify_calibration ORDER BY ordinality)
		FROM unnest(levels) WITH ORDINALITY AS l
		LEFT JOIN mean ON key = typify_group_key(l.grp) AND mean.overall = l.overall);
END $$;
COMMENT ON FUNCTION typify_measure(text, typify_calibration[], double precision, bigint[], boolean[], geometry) IS
'Calibrations with mean_placeholder_area filled in: the groups for which measured is true are typified at m200 with their exponent, element i to counts[i] where that is not NULL, and the first element takes the mean over all their placeholders. measured NULL: everything is one group.';

CREATE FUNCTION typify_own_psi(calibration typify_calibration) RETURNS double precision
LANGUAGE sql IMMUTABLE PARALLEL SAFE
BEGIN ATOMIC
	SELECT CASE WHEN (calibration).calibrated AND (calibration).mean_placeholder_area > 0
		AND (calibration).mean_area200 > 0
		THEN typify_psi((calibration).mean_placeholder_area, (calibration).mean_area200,
			coalesce(((calibration).options).source_scale, 25000),
			coalesce(((calibration).options).lod200_scale, 200000)) END;
END;
COMMENT ON FUNCTION typify_own_psi(typify_calibration) IS
'psi from the mean areas of a calibration; NULL when it is not calibrated and where one of the two has no area (points, lines).';

CREATE FUNCTION typify_with_psi(levels typify_calibration[]) RETURNS typify_calibration[]
LANGUAGE sql IMMUTABLE PARALLEL SAFE
BEGIN ATOMIC
	SELECT array_agg(ROW(l.grp, l.n25, l.n200, l.mean_area25, l.mean_placeholder_area, l.mean_area200, l.exponent,
		psi.psi, typify_options_with(l.options, (l.options).exponent, psi.psi, (l.options).count), l.calibrated,
		l.overall)::typify_calibration ORDER BY ordinality)
	FROM (SELECT typify_own_psi(levels[1]) AS psi) AS whole, unnest(levels) WITH ORDINALITY AS l
	CROSS JOIN LATERAL (SELECT coalesce(typify_own_psi(ROW(l.grp, l.n25, l.n200, l.mean_area25, l.mean_placeholder_area,
		l.mean_area200, l.exponent, l.psi, l.options, l.calibrated, l.overall)::typify_calibration), whole.psi) AS psi)
		AS psi;
END;
COMMENT ON FUNCTION typify_with_psi(typify_calibration[]) IS
'Calibrations with psi, in options too: each its own from its mean areas, else that of the first element, which is the whole.';

-- The count of the black-white rule follows from psi, and psi from the sizes of that many placeholders: repeated
-- until the counts stay. They mostly do after two or three rounds; where they alternate, the last is as good.
CREATE FUNCTION typify_calibrate_levels(lod25_source text, lod200_source text, s_u double precision,
	given typify_options, grouped boolean, wanted text[], report boolean, barriers geometry)
RETURNS typify_calibration[]
LANGUAGE plpgsql STABLE PARALLEL RESTRICTED
SET search_path FROM CURRENT
AS $$
DECLARE
	m25 double precision := coalesce(given.source_scale, 25000);
	m200 double precision := coalesce(given.lod200_scale, 200000);
	rule text := coalesce(given.count_rule, CASE WHEN given.min_distance > 0 THEN 'none' ELSE 'radical' END);
	lawful boolean := given.exponent IS NULL AND given.count IS NULL AND rule = 'radical';
	by_ink boolean := given.count IS NULL AND rule = 'black_white';
	sized boolean := given.psi IS NULL AND given.area_statistic IS DISTINCT FROM 'sum';
	levels typify_calibration[] := typify_survey(lod25_source, lod200_source, typify_houses(given));
	whole typify_calibration := levels[1];
	keys text[] := typify_group_keys(wanted);
	measured boolean[];
	counts bigint[];
	last_counts bigint[];
BEGIN
	IF whole.n25 = 0 THEN
		RETURN NULL;
	ELSIF whole.n200 = 0 THEN
		RAISE EXCEPTION 'lod200 has no object with a geometry'
			USING ERRCODE = '22023', HINT = 'Fill it, or pass NULL for lod200 to derive without calibration.';
	ELSIF whole.n200 > whole.n25 THEN
		RAISE EXCEPTION 'lod200 has more objects (%) than lod25 has buildings (%)', whole.n200, whole.n25
			USING ERRCODE = '22023', HINT = 'Pass the detailed table first and the coarse one second.';
	END IF;
	IF NOT grouped THEN
		levels := levels[1:1];
	END IF;
	levels := ARRAY(
		SELECT ROW(l.grp, l.n25, l.n200, l.mean_area25, NULL, l.mean_area200, x.exponent, given.psi,
			typify_options_with(given, x.exponent, given.psi, given.count), x.calibrated,
			l.overall)::typify_calibration
		FROM unnest(levels) WITH ORDINALITY AS l
		CROSS JOIN LATERAL (SELECT l.n200 BETWEEN 1 AND l.n25 AS calibrated) AS fit
		CROSS JOIN LATERAL (SELECT fit.calibrated, CASE
			WHEN NOT lawful THEN given.exponent
			WHEN fit.calibrated THEN typify_exponent(l.n25, l.n200, m25, m200)
			ELSE typify_exponent(whole.n25, whole.n200, m25, m200) END AS exponent) AS x
		ORDER BY ordinality);
	IF NOT (sized OR report) THEN
		RETURN levels;
	END IF;
	IF grouped THEN
		-- the values of all are only needed where a group has none of its own
		measured := ARRAY(
			SELECT NOT l.overall AND l.n25 > 0 AND (all_of_them OR typify_group_key(l.grp) = ANY (keys))
			FROM unnest(levels) WITH ORDINALITY AS l, (
				SELECT wanted IS NULL OR bool_or(NOT o.calibrated OR o.mean_area200 = 0)
					FILTER (WHERE typify_group_key(o.grp) = ANY (keys) AND NOT o.overall AND o.n25 > 0) AS all_of_them
				FROM unnest(levels) AS o) AS need
			ORDER BY ordinality);
	END IF;
	IF by_ink THEN
		counts := ARRAY(
			SELECT greatest(1, CASE
				WHEN NOT sized THEN typify_count(l.n25, m200, given)
				WHEN l.calibrated THEN l.n200
				ELSE l.n25 * whole.n200 / whole.n25 END)
			FROM unnest(levels) WITH ORDINALITY AS l ORDER BY ordinality);
	END IF;
	FOR round IN 1 .. 8 LOOP
		levels := typify_measure(lod25_source, levels, s_u, counts, measured, barriers);
		EXIT WHEN NOT sized;
		levels := typify_with_psi(levels);
		EXIT WHEN NOT by_ink;
		last_counts := counts;
		counts := ARRAY(
			SELECT greatest(1, typify_count(l.n25, m200, l.options))
			FROM unnest(levels) WITH ORDINALITY AS l ORDER BY ordinality);
		EXIT WHEN counts = last_counts;
	END LOOP;
	RETURN levels;
END $$;
COMMENT ON FUNCTION typify_calibrate_levels(text, text, double precision, typify_options, boolean, text[], boolean,
	geometry) IS
'The calibrations of two sub-selects, the whole first; NULL when there is no building. given: without barriers, which come by themselves. grouped: false for the whole alone. wanted: only these groups need psi; NULL for all. report: also find mean_placeholder_area where psi has no use for it. Errors: 22023 for a LOD200 without objects or with more of them than buildings; others as of typify_placeholders.';

CREATE FUNCTION typify_calibrate(
	lod25 regclass,
	lod200 regclass,
	s_u double precision DEFAULT 0,
	group_by name DEFAULT NULL,
	options typify_options DEFAULT NULL,
	id_column name DEFAULT 'id',
	geom_column name DEFAULT 'geom',
	lod200_id_column name DEFAULT 'id',
	lod200_geom_column name DEFAULT 'geom',
	lod200_group_by name DEFAULT NULL,
	links regclass DEFAULT NULL,
	importance_column name DEFAULT NULL)
RETURNS SETOF typify_calibration
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
	source record;
	levels typify_calibration[];
BEGIN
	PERFORM typify_table_name(lod200, 'lod200');
	PERFORM typify_check_parameters(coalesce(options.lod200_scale, 200000), s_u, options);
	source := typify_levels(lod25, lod200, id_column, geom_column, lod200_id_column, lod200_geom_column, group_by,
		lod200_group_by, links, false, importance_column);
	PERFORM typify_check_same_srid('lod25', source.srid, 'barriers', ST_SRID(options.barriers));
	levels := typify_calibrate_levels(source.lod25_source, source.lod200_source, s_u,
		typify_options_without_barriers(options), group_by IS NOT NULL OR links IS NOT NULL, NULL, true, options.barriers);
	IF levels IS NOT NULL AND options.barriers IS NOT NULL THEN
		levels[1].options.barriers := options.barriers;
	END IF;
	RETURN QUERY SELECT * FROM unnest(levels);
END $$;
COMMENT ON FUNCTION typify_calibrate(regclass, regclass, double precision, name, typify_options, name, name, name, name,
	name, regclass, name) IS
'Takes psi and exponent from two stored levels of detail, for the clusters that s_u and options really make (psi: paper, section on size; exponent: 2 ln(n25 / n200) / ln(m200 / m25), not below 0): rows of typify_calibration, whose options are ready to pass on. Derived with them, a layer has at m200 exactly the count and, to rounding, the mean area of LOD200, and at m25 the count of LOD25. Without groups one row. With group_by (a column of lod25, of any type) or links (a table or view with lod25_id and lod200_id, as typify_match returns; lod200_id is the group) a first row, overall, for all groups together, then one for each group by the bytes of its name, the NULL group last; calibrated is false where a group has no object of LOD200 or more of them than buildings: it takes the exponent and psi of all. The mean_placeholder_area of all is that of the placeholders of all groups.
Objects of LOD200 belong to the group in their column lod200_group_by (default: the column that group_by names, if LOD200 has it), without one to that of the building whose centre is nearest to theirs (see typify_centre; of equally near ones that with the smallest id); with links, to the group of their lod200_id_column.
What options set is kept: exponent, psi, count; with count, count_rule => ''black_white'' or min_distance alone no exponent is calibrated, since these say how many. With black_white the counts follow from the psi that is calibrated. With area_statistic => ''sum'' no psi is calibrated, since it has no effect. No psi is calibrated from a LOD200 without areas (points, lines). Barriers stay with the first row''s options alone: a copy for every group may be more than a server holds.
The tables are read, never written; id_column and, asked for with links only, lod200_id_column (smallint, integer, bigint; different for each row) and the two geometry columns may be named otherwise. NULL and EMPTY geometries do not count, nor do buildings below min_area, a group of such alone being counted as one building. importance_column: a column of lod25 with the importance of each building (see typify_placeholders). No row when lod25 has no building.
Errors: 42P01, 42809, 42703, 42804 for a table or column that is not there or of another kind; 22004 for arguments and ids that are NULL; 22023 for two SRIDs, a geographic one, ids that occur twice, a lod200 without objects or with more of them than lod25, links together with group_by, lod200_group_by without group_by; others as of typify_placeholders.';
