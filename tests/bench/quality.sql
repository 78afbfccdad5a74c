-- quality.sql: the layers that tests/bench/quality.sh compares, and the table of their figures

CREATE TABLE methods (method text PRIMARY KEY, place integer);
INSERT INTO methods VALUES ('plain', 1), ('legible', 2), ('legible, barriers', 3), ('k-means', 4);

-- What one does with PostGIS alone: in squares of 3 km, for ST_ClusterKMeans of a city takes hours, as many clusters
-- as the law leaves of all, shared out by largest remainders; for each the oriented envelope of its buildings, scaled to
-- the area that a placeholder of typify has for the same members.
CREATE FUNCTION kmeans_layer(buildings regclass, scale float8) RETURNS TABLE (geom geometry, members bigint[])
LANGUAGE plpgsql SET max_parallel_workers_per_gather = 0 AS
$$
BEGIN
	RETURN QUERY EXECUTE format($query$
WITH building AS MATERIALIZED (
	SELECT id, geom, floor((ST_X(ST_Centroid(geom)) - 700) / 3000) AS i, floor((ST_Y(ST_Centroid(geom)) - 700) / 3000) AS j FROM %s
), census AS (
	SELECT array_agg(i ORDER BY i, j) AS xs, array_agg(j ORDER BY i, j) AS ys, array_agg(n ORDER BY i, j) AS ns, sum(n)::bigint AS n
	FROM (SELECT i, j, count(*) AS n FROM building GROUP BY i, j) AS square
), square AS MATERIALIZED (
	SELECT s.* FROM census, ROWS FROM (unnest(xs), unnest(ys), unnest(typify_allocate(typify_count(n, $1), ns, ns::float8[]))) AS s (i, j, k)
), clustered AS MATERIALIZED (
	SELECT i, j, id, geom, CASE WHEN k > 0 THEN ST_ClusterKMeans(geom, greatest(k, 1)::integer) OVER (PARTITION BY i, j) END AS cluster
	FROM building JOIN square USING (i, j)
), drawn AS (
	SELECT ST_OrientedEnvelope(ST_Collect(geom)) AS geom, avg(ST_Area(geom)) * typify_area_factor($1) AS area, array_agg(id) AS members
	FROM clustered WHERE cluster IS NOT NULL GROUP BY i, j, cluster
)
SELECT CASE WHEN ST_Area(geom) > 0 THEN ST_Translate(ST_Scale(ST_Translate(geom, -x, -y), by, by), x, y) END, members
FROM drawn, LATERAL (SELECT ST_X(ST_Centroid(geom)) AS x, ST_Y(ST_Centroid(geom)) AS y, sqrt(area / nullif(ST_Area(geom), 0)) AS by) AS at
$query$, buildings) USING scale;
END
$$;

CREATE FUNCTION layer_query(data text, method text, scale float8) RETURNS text LANGUAGE sql AS
$$
	SELECT CASE method
		WHEN 'plain' THEN format('SELECT geom, members FROM typify_derive(%L, NULL, %s, 0.5)', data, scale)
		WHEN 'legible' THEN format('SELECT geom, members FROM typify_derive(%L, NULL, %s, 0.5, '
			'options => typify_options(min_side => 0.35, min_gap => 0.2))', data, scale)
		WHEN 'legible, barriers' THEN format('SELECT geom, members FROM typify_derive(%L, NULL, %s, 0.5, barriers => %L, '
			'options => typify_options(min_side => 0.35, min_gap => 0.2, barrier_width => 0.5))', data, scale, data || '_main')
		ELSE format('SELECT * FROM kmeans_layer(%L, %s)', data, scale) END
$$;

CREATE TABLE figures AS
SELECT ''::text AS data, ''::text AS method, 0::float8 AS scale, 0::float8 AS made_in, 0::float8 AS judged_in, q.*
FROM typify_quality('methods', 'methods', 50000) AS q LIMIT 0;

-- One layer and its figures, with the seconds that both took; none where the extension cannot make it.
CREATE FUNCTION compare(data text, method text, scale float8) RETURNS void LANGUAGE plpgsql AS
$$
DECLARE
	start timestamptz := clock_timestamp();
	made timestamptz;
BEGIN
	DROP TABLE IF EXISTS layer;
	EXECUTE 'CREATE TABLE layer AS ' || layer_query(data, method, scale);
	made := clock_timestamp();
	INSERT INTO figures
	SELECT data, method, scale, extract(epoch FROM made - start), extract(epoch FROM clock_timestamp() - made), q.*
	FROM typify_quality(data::regclass, 'layer', scale, barriers => (data || '_main')::regclass, barrier_width => 0.5,
		roads => (data || '_roads')::regclass) AS q;
EXCEPTION WHEN feature_not_supported OR undefined_function THEN
	RAISE WARNING 'no layer %: %', method, SQLERRM;
END
$$;

-- ---- the report ----

CREATE FUNCTION cells(VARIADIC cells text[]) RETURNS text LANGUAGE sql AS
$$ SELECT '| ' || array_to_string(cells, ' | ', '-') || ' |' $$;

CREATE FUNCTION number(n anyelement, digits integer DEFAULT 0) RETURNS text LANGUAGE sql AS
$$ SELECT replace(to_char(round(n::numeric, digits), 'FM999,999,999,990' || CASE WHEN digits > 0 THEN '.' || repeat('0', digits) ELSE '' END), ',', ' ') $$;

CREATE FUNCTION introduction(wanted text) RETURNS text LANGUAGE sql AS
$$
	SELECT format('%s buildings. At 1:%s they ink %s %% of the settled ground; their longer sides are %s degrees off the nearest road in the median.',
		number(buildings), number(scale), number(100 * ink_before, 1), number(road_angle_before, 1))
	FROM figures WHERE data = wanted ORDER BY scale LIMIT 1
$$;

CREATE FUNCTION report(wanted text) RETURNS SETOF text LANGUAGE sql AS
$$
	SELECT cells('1:', 'layer', 'drawn', 'of asked', 'overlaps', 'gaps', 'sides', 'on lines', 'near lines', 'across', 'moved', '99 %', 'ink', 'r', 'slope', 'rows', 'angle', 's')
	UNION ALL SELECT '|--:|---|' || repeat('--:|', 16)
	UNION ALL (
		SELECT cells(number(scale), method, number(reached), number(100.0 * reached / asked) || ' %', number(overlapping), number(narrow_gaps),
			number(short_sides), number(barrier_crossings), number(barrier_gaps), number(members_across),
			number(displacement_median, 2), number(displacement_p99, 2), number(ink_after / ink_before, 2),
			number(density_correlation, 3), number(density_slope, 2), number(rows_kept, 2), number(road_angle, 1), number(made_in, 1))
		FROM figures JOIN methods USING (method) WHERE data = wanted ORDER BY scale, place)
$$;
