-- area.sql: the identities of the size law, and the statistics and shapes
SELECT typify_area_factor(25000) AS at_source, typify_area_factor(200000) AS at_coarse, typify_area_factor(400000) AS beyond,
	   typify_area_factor(200000, typify_options(psi => 0)) AS psi_0, typify_area_factor(200000, typify_options(psi => 1)) AS psi_1,
	   typify_area_factor(25000, typify_options(psi => -3)) AS psi_negative_at_source;
SELECT count(*) AS differ FROM generate_series(1, 20) AS k WHERE typify_area_factor(1000 * k, typify_options(source_scale => 1000 * k, psi => k / 20.0)) <> 1;
SELECT typify_psi(300, 4900) AS smallest_legible_square, typify_psi(100, 6400) AS as_the_mean, typify_psi(100, 0) AS nothing, typify_psi(10, 50, 10000, 50000) AS other_levels;

CREATE TEMP TABLE building AS
SELECT i AS id, ST_Rotate(ST_MakeEnvelope(x, y, x + 6 + i % 11, y + 7 + i % 7), i / 5.0, ST_MakePoint(x, y)) AS geom
FROM (SELECT i, i * 37 % 101 * 23 AS x, i * 53 % 97 * 31 AS y FROM generate_series(1, 200) AS i) AS b;

-- with the calibrated psi the mean placeholder at the coarse scale is as large as the mean coarse object
WITH unscaled AS (
	SELECT avg(p.area / typify_area_factor(200000)) AS mean FROM unnest((SELECT typify_placeholders(geom, id, 200000, 0.5) FROM building)) AS p
), calibrated AS (
	SELECT lod200, typify_options(psi => typify_psi(mean, lod200)) AS options FROM unscaled, unnest(ARRAY[100, 1234.5, 4900, 20000]) AS lod200
)
SELECT lod200, abs(avg(p.area) / lod200 - 1) < 1e-12 AS reached
FROM calibrated, LATERAL unnest((SELECT typify_placeholders(geom, id, 200000, 0.5, options) FROM building)) AS p GROUP BY lod200 ORDER BY lod200;

-- at the source scale with nothing merged every building keeps its area and the bounding rectangle's shape
SELECT count(*) AS buildings, count(*) FILTER (WHERE abs(p.area - ST_Area(b.geom)) < 1e-9 AND ST_Distance(ST_Centroid(p.geom), ST_Centroid(b.geom)) < 1e-4 AND ST_HausdorffDistance(p.geom, b.geom) < 1e-4) AS same
FROM unnest((SELECT typify_placeholders(geom, id, 25000) FROM building)) AS p JOIN building AS b USING (id);

-- the fields agree with the drawn rectangle
SELECT scale, count(*) AS placeholders, max(abs(ST_Area(geom) / area - 1)) < 1e-6 AS area, max(abs(width * length / area - 1)) < 1e-12 AS sides,
	   bool_and(width <= length) AS width_is_shorter, bool_and(orientation >= 0 AND orientation < 180) AS half_turn,
	   max(abs(ST_Perimeter(geom) / (2 * (width + length)) - 1)) < 1e-6 AS perimeter, bool_and(ST_IsValid(geom) AND NOT ST_IsPolygonCW(geom)) AS valid
FROM unnest(ARRAY[25000, 75000, 200000]) AS scale, LATERAL unnest((SELECT typify_placeholders(geom, id, scale, 0.5) FROM building)) AS p GROUP BY scale ORDER BY scale;

-- statistics of the members' areas, recomputed from the members
SELECT statistic, count(*) AS placeholders, max(abs(p.area / expected - 1)) < 1e-12 AS as_expected
FROM unnest(ARRAY['mean', 'median', 'sum']) AS statistic,
	 LATERAL unnest((SELECT typify_placeholders(geom, id, 100000, 0.5, typify_options(area_statistic => statistic)) FROM building)) AS p,
	 LATERAL (SELECT CASE statistic WHEN 'mean' THEN avg(ST_Area(geom)) * typify_area_factor(100000)
									WHEN 'median' THEN percentile_cont(0.5) WITHIN GROUP (ORDER BY ST_Area(geom)) * typify_area_factor(100000)
									ELSE sum(ST_Area(geom)) END AS expected FROM building WHERE id = ANY (p.members)) AS e
GROUP BY statistic ORDER BY statistic;
-- sum keeps the ink
SELECT abs(ST_Area(typify(geom, 100000, 0, typify_options(area_statistic => 'sum'))) / sum(ST_Area(geom)) - 1) < 1e-9 AS same_ink FROM building;
-- the representative is the largest member, and lends ratio and direction
SELECT count(*) AS placeholders, count(*) FILTER (WHERE ST_Area(b.geom) >= largest - 1e-9) AS largest_is_representative,
	   count(*) FILTER (WHERE abs(p.width / p.length - least(w, l) / greatest(w, l)) < 1e-6) AS its_ratio
FROM unnest((SELECT typify_placeholders(geom, id, 100000, 0.5) FROM building)) AS p JOIN building AS b USING (id),
	 LATERAL (SELECT max(ST_Area(geom)) AS largest FROM building WHERE id = ANY (p.members)) AS m,
	 LATERAL (SELECT ST_Distance(ST_PointN(ST_ExteriorRing(b.geom), 1), ST_PointN(ST_ExteriorRing(b.geom), 2)) AS w,
					 ST_Distance(ST_PointN(ST_ExteriorRing(b.geom), 2), ST_PointN(ST_ExteriorRing(b.geom), 3)) AS l) AS s;
-- squares: equal sides, the same area, the representative's direction
SELECT count(*) AS placeholders, count(*) FILTER (WHERE s.width = s.length) AS equal_sides, count(*) FILTER (WHERE s.area = r.area) AS same_area, count(*) FILTER (WHERE s.orientation = r.orientation) AS same_direction
FROM unnest((SELECT typify_placeholders(geom, id, 100000, 0.5, typify_options(shape => 'square')) FROM building)) AS s
JOIN unnest((SELECT typify_placeholders(geom, id, 100000, 0.5) FROM building)) AS r USING (id);
