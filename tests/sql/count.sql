-- count.sql: as many placeholders as the law says, at least one, never more than there are buildings

-- the paper's figures, and the law as the paper prints it
SELECT scale, typify_count(41, scale) AS figures, typify_count(41, scale, typify_options(exponent => 1)) AS printed_law
FROM unnest(ARRAY[25000, 50000, 75000, 100000, 200000]) AS scale ORDER BY scale;
-- whole counts survive rounding
SELECT count(*) AS differ FROM generate_series(1, 1000) AS k WHERE typify_count(4 * k, 50000) <> 2 * k OR typify_count(3 * k, 75000) <> k OR typify_count(8 * k, 200000) <> k;
SELECT typify_count(0, 50000) AS none, typify_count(1, 200000) AS one, typify_count(2, 1e12) AS at_least_one, typify_count(17717, 75000) AS liechtenstein,
	   typify_count(1000000000000, 50000) AS many;
-- exponent 0 keeps all up to the coarse level; beyond it the exponent is at least 4
SELECT scale, typify_count(1000, scale, typify_options(exponent => 0)) AS exponent_0, typify_count(1000, scale, typify_options(exponent => 1)) AS exponent_1,
	   typify_count(1000, scale) AS exponent_2, typify_count(1000, scale, typify_options(exponent => 5)) AS exponent_5
FROM unnest(ARRAY[100000, 200000, 400000, 800000]) AS scale ORDER BY scale;
-- other levels of detail
SELECT typify_count(100, 10000, typify_options(source_scale => 5000, lod200_scale => 50000)) AS half, typify_count(100, 100000, typify_options(source_scale => 5000, lod200_scale => 50000)) AS beyond;
-- black-white: n over the greatest area factor so far
SELECT scale, typify_count(1000, scale, typify_options(count_rule => 'black_white')) AS black_white, round(typify_area_factor(scale)::numeric, 6) AS area_factor
FROM unnest(ARRAY[25000, 50000, 75000, 100000, 150000, 200000, 400000]) AS scale ORDER BY scale;
SELECT count(*) AS grows FROM (SELECT n, lag(n) OVER (ORDER BY scale) AS before FROM (SELECT scale, typify_count(1000, scale, typify_options(count_rule => 'black_white', psi => 0.95)) AS n
	FROM generate_series(25000, 400000, 1000) AS scale) AS c) AS d WHERE n > before;
-- an explicit count
SELECT typify_count(41, 75000, typify_options(count => 7)) AS seven, typify_count(5, 75000, typify_options(count => 7)) AS no_more_than_there_are;

-- the aggregates do as the formula says
CREATE TEMP TABLE building AS
SELECT i AS id, ST_MakeEnvelope(x, y, x + 8 + i % 5, y + 9 + i % 3) AS geom
FROM (SELECT i, i * 37 % 41 * 23 AS x, i * 53 % 29 * 31 AS y FROM generate_series(1, 41) AS i) AS b;
SELECT scale, ST_NumGeometries(typify(geom, scale)) AS default_law, ST_NumGeometries(typify(geom, scale, 0.5, typify_options(exponent => 1))) AS printed_law,
	   ST_NumGeometries(typify(geom, scale, 0, typify_options(count_rule => 'black_white'))) AS black_white,
	   ST_NumGeometries(typify(geom, scale, 1, typify_options(count => 7))) AS seven
FROM building, unnest(ARRAY[25000, 50000, 75000, 100000, 200000, 400000]) AS scale GROUP BY scale ORDER BY scale;
-- without areas the black-white rule keeps all
SELECT cardinality(typify_placeholders(ST_Centroid(geom), id, 100000, 0, typify_options(count_rule => 'black_white'))) FROM building;

-- minimum distance: alone it decides; with a count or law both must hold
CREATE FUNCTION pg_temp.distances(options typify_options) RETURNS TABLE (placeholders bigint, far_enough boolean) LANGUAGE sql AS
$$
	WITH p AS (SELECT p.* FROM unnest((SELECT typify_placeholders(geom, id, 50000, 0, options) FROM building)) AS p)
	SELECT count(*), coalesce((SELECT min(ST_Distance(ST_Centroid(a.geom), ST_Centroid(b.geom))) FROM p AS a JOIN p AS b ON a.id < b.id) >= (options).min_distance - 1e-3, true) FROM p
$$;
SELECT d AS min_distance, alone.*, law.*, counted.*
FROM unnest(ARRAY[1, 50, 100, 200, 10000]) AS d, pg_temp.distances(typify_options(min_distance => d)) AS alone (alone, alone_far_enough),
	 pg_temp.distances(typify_options(min_distance => d, exponent => 2)) AS law (with_law, law_far_enough),
	 pg_temp.distances(typify_options(min_distance => d, count => 10)) AS counted (with_count, count_far_enough) ORDER BY d;
