-- 70-links.sql: which LOD25 buildings stand behind which LOD200 object

CREATE FUNCTION typify_pairs(a point[], b point[], max_distance double precision)
RETURNS integer[]
AS 'MODULE_PATHNAME'
LANGUAGE C IMMUTABLE STRICT PARALLEL SAFE COST 10000;

COMMENT ON FUNCTION typify_pairs(point[], point[], double precision) IS
'Pairs two sets of points one to one, greedily by (distance, place in a, place in b), none farther apart than max_distance: for each point of a the place of its partner in b, counted from 1, or NULL. Takes about n log n for any sets. Errors: 22004 for an array that contains NULLs; 22023 for a coordinate that is not finite, and a max_distance that is not finite or below 0.';

CREATE FUNCTION typify_check_length(length double precision, argument text, hint text) RETURNS void
LANGUAGE plpgsql IMMUTABLE PARALLEL SAFE
SET search_path FROM CURRENT
AS $$
BEGIN
	IF length IS NULL THEN
		PERFORM typify_refuse_null(argument, hint);
	ELSIF NOT (length >= 0 AND length < 'Infinity') THEN
		RAISE EXCEPTION '% is %, it must be a finite number of at least 0', argument, length
			USING ERRCODE = '22023', HINT = hint;
	END IF;
END $$;
COMMENT ON FUNCTION typify_check_length(double precision, text, text) IS
'Refuses a length that is NULL (22004), below 0 or not finite (22023)';

-- Placeholders without size serve as well as others here, so their warning is not passed on, and of the options only
-- those count that say where placeholders are. Planning without nested loops: what is joined has no statistics, and a
-- wrong guess would be quadratic.
CREATE FUNCTION typify_match(
	lod25 regclass,
	lod200 regclass,
	s_u double precision DEFAULT 0,
	group_by name DEFAULT NULL,
	max_distance double precision DEFAULT 2.5,
	options typify_options DEFAULT NULL,
	id_column name DEFAULT 'id',
	geom_column name DEFAULT 'geom',
	lod200_id_column name DEFAULT 'id',
	lod200_geom_column name DEFAULT 'geom',
	lod200_group_by name DEFAULT NULL)
RETURNS TABLE (lod25_id bigint, lod200_id bigint, distance double precision)
LANGUAGE plpgsql STABLE PARALLEL RESTRICTED COST 1000000 ROWS 10000
SET search_path FROM CURRENT
SET enable_nestloop = off
SET jit = off
SET client_min_messages = error
AS $$
DECLARE
	m200 double precision := coalesce(options.lod200_scale, 200000);
	levels record;
	max_length double precision;
BEGIN
	PERFORM typify_table_name(lod200, 'lod200');
	PERFORM typify_check_length(max_distance, 'max_distance',
		'Give millimetres on the map at lod200_scale; 2.5 is usual.');
	IF options.count IS NOT NULL OR options.min_distance IS NOT NULL THEN
		RAISE EXCEPTION 'option % does not go with typify_match, which makes as many placeholders as lod200 has objects',
			CASE WHEN options.count IS NULL THEN 'min_distance' ELSE 'count' END
			USING ERRCODE = '22023', HINT = 'Leave the option out.';
	END IF;
	PERFORM typify_check_parameters(m200, s_u, options);
	levels := typify_levels(lod25, lod200, id_column, geom_column, lod200_id_column, lod200_geom_column, group_by,
		lod200_group_by, NULL, true);
	max_length := max_distance / 1000 * m200 / coalesce(typify_metres_per_unit(levels.srid), 1);
	RETURN QUERY EXECUTE format($query$
WITH detailed AS MATERIALIZED (
	SELECT id, geom, typify_group_key(grp) AS key, typify_centre(geom) AS centre FROM %s AS b
), coarse AS MATERIALIZED (
	SELECT id, typify_group_key(grp) AS key, typify_centre(geom) AS centre FROM %s AS c
), wanted AS MATERIALIZED (
	SELECT key, array_agg(id ORDER BY id) AS ids, array_agg(centre ORDER BY id) AS centres,
		typify_options(source_scale => ($3).source_scale, lod200_scale => ($3).lod200_scale, count => count(*),
			min_area => ($3).min_area, alignment => ($3).alignment) AS options
	FROM coarse GROUP BY key
), placeholders AS MATERIALIZED (
	SELECT key, (p).id, (p).geom, (p).members
	FROM (SELECT key, unnest(typify_barred(d.geom, d.id, $1, $2, w.options, (SELECT ($3).barriers), NULL)) AS p
		  FROM detailed AS d JOIN wanted AS w USING (key) GROUP BY key) AS made
), sizeless AS (
	SELECT p.id, point(avg(d.centre[0] ORDER BY d.id), avg(d.centre[1] ORDER BY d.id)) AS centre
	FROM (SELECT id, unnest(members) AS member FROM placeholders WHERE geom IS NULL) AS p
	JOIN detailed AS d ON d.id = p.member GROUP BY p.id
), offered AS (
	SELECT key, array_agg(id ORDER BY id) AS ids, array_agg(centre ORDER BY id) AS centres
	FROM (SELECT p.key, id, coalesce(typify_centre(p.geom), s.centre) AS centre
		  FROM placeholders AS p LEFT JOIN sizeless AS s USING (id)) AS placed
	GROUP BY key
), pairs AS MATERIALIZED (
	SELECT pair.id, ids200[pair.place] AS id200, pair.centre <-> centres200[pair.place] AS distance
	FROM (SELECT o.ids, o.centres, w.ids AS ids200, w.centres AS centres200
		  FROM offered AS o JOIN wanted AS w USING (key)) AS sets,
		unnest(ids, centres, typify_pairs(centres, centres200, $4)) AS pair (id, centre, place)
	WHERE pair.place IS NOT NULL
)
SELECT d.id, linked.id200, linked.distance
FROM detailed AS d LEFT JOIN (
	SELECT unnest(p.members) AS member, pairs.id200, pairs.distance FROM placeholders AS p JOIN pairs USING (id)
) AS linked ON linked.member = d.id
UNION ALL
SELECT NULL, c.id, NULL FROM coarse AS c WHERE NOT EXISTS (SELECT FROM pairs WHERE pairs.id200 = c.id)
ORDER BY 1 NULLS LAST, 2$query$, levels.lod25_source, levels.lod200_source)
	USING m200, s_u, options, max_length;
END $$;
COMMENT ON FUNCTION typify_match(regclass, regclass, double precision, name, double precision, typify_options, name,
	name, name, name, name) IS
'Links LOD25 buildings to LOD200 objects. Each group of LOD25 is typified to as many placeholders as it has LOD200 objects; placeholders and objects of the group are paired one to one, greedily by (distance, id of the placeholder, id of the object), at most max_distance apart (mm on the map at lod200_scale; the linear unit of the SRID is heeded). Distance: from the centre of the placeholder, the mean of its members'' centroids, to the centroid of the object, in units of the SRID. Rows, in this order: one per LOD25 building (lod200_id and distance NULL where its placeholder has no partner, or its group no LOD200 object), then one per LOD200 object without partner (lod25_id NULL). A group with more objects than buildings leaves the rest without partner. Rows without a usable geometry are passed over. group_by: a column of lod25, NULL being one group; objects take the group in their column lod200_group_by (default: the column that group_by names, if LOD200 has it), without one that of the LOD25 building whose centre is nearest to theirs (see typify_centre; of equally near ones that with the smallest id). The same set of rows gives the same links. As a view or table it serves typify_derive as links. Errors: 42703, 42804, 42809 for columns and tables; 22004 for NULLs; 22023 for ids that occur twice, SRIDs that are two or geographic, numbers out of range, and the options count and min_distance; 0A000 for geometries and options that are not supported.';
