-- rows of buildings: which are found, and how they are kept
\i tests/data/error_of.sql
\set ECHO none
\i tests/data/settlement.sql
SET extra_float_digits = 0;
\set ECHO all

-- the rows that are found in the settlement, whose generator knows its own
CREATE TEMP TABLE house AS
SELECT id, class, row_id, geom, (r).number, (r).place
FROM (SELECT *, typify_rows(geom) OVER () AS r FROM settlement_buildings) AS b;
SELECT count(*) AS buildings, count(number) AS in_rows, count(DISTINCT number) AS rows FROM house;
SELECT min(n) AS shortest, max(n) AS longest, bool_and(last = n - 1 AND first = 0 AND places = n) AS places_count_on
FROM (SELECT count(*) AS n, min(place) AS first, max(place) AS last, count(DISTINCT place) AS places
	FROM house WHERE number IS NOT NULL GROUP BY number) AS row;
SELECT class, count(*), count(number) AS in_rows FROM house GROUP BY class ORDER BY count(*) DESC, class;

-- recall: members of the generator's rows of three and more, and neighbours in them that are in one row
CREATE TEMP TABLE laid AS
SELECT row_id, number, place, lead(number) OVER along AS next_number, lead(place) OVER along AS next_place,
	count(*) OVER (PARTITION BY row_id) AS n
FROM house WHERE row_id IS NOT NULL WINDOW along AS (PARTITION BY row_id ORDER BY id);
SELECT count(*) AS laid_out, count(number) AS found, round(count(number)::numeric / count(*), 3) AS recall,
	round(avg((number = next_number AND abs(place - next_place) = 1)::integer) FILTER (WHERE next_number IS NOT NULL), 3)
		AS neighbours_next_to_each_other
FROM laid WHERE n >= 3;

-- precision: neighbours in a row that is found are neighbours in one of the generator's, or stand on the same side of
-- the same road, where its plots are laid out in rows as well
CREATE TEMP TABLE side AS
SELECT h.id, r.id AS road,
	sign((ST_X(b) - ST_X(a)) * (ST_Y(c) - ST_Y(a)) - (ST_Y(b) - ST_Y(a)) * (ST_X(c) - ST_X(a))) AS side
FROM house AS h
CROSS JOIN LATERAL (SELECT ST_Centroid(h.geom) AS c) AS centre
LEFT JOIN LATERAL (SELECT id, geom FROM settlement_roads
	WHERE ST_DWithin(geom, c, 120) ORDER BY ST_Distance(geom, c), id LIMIT 1) AS r ON true
CROSS JOIN LATERAL (SELECT ST_LineLocatePoint(r.geom, c) AS share) AS located
CROSS JOIN LATERAL (SELECT ST_LineInterpolatePoint(r.geom, greatest(share - 0.01, 0)) AS a,
	ST_LineInterpolatePoint(r.geom, least(share + 0.01, 1)) AS b) AS ends;
WITH link AS (
	SELECT row_id, id, lead(row_id) OVER along AS next_row_id, lead(id) OVER along AS next_id
	FROM house WHERE number IS NOT NULL WINDOW along AS (PARTITION BY number ORDER BY place)
)
SELECT count(*) AS links, count(*) FILTER (WHERE row_id = next_row_id) AS of_the_generator,
	round(avg((coalesce(row_id = next_row_id, false) OR coalesce((a.road, a.side) = (b.road, b.side), false))::integer), 3) AS precision
FROM link JOIN side AS a USING (id) JOIN side AS b ON b.id = next_id;

-- a row of k equal houses stays on its line and evenly spaced, whatever is left of it, down to 2
CREATE FUNCTION pg_temp.row_of(k integer, ux float8, uy float8) RETURNS TABLE (id bigint, geom geometry) LANGUAGE sql AS
$$
	SELECT i, typify_rectangle(ST_SetSRID(ST_MakePoint(600000 + 20 * i * ux, 5200000 + 20 * i * uy), 25832), 90, 0.8, 30)
	FROM generate_series(0, k - 1) AS i
$$;
WITH left_over AS (
	SELECT k, n, row_number() OVER (PARTITION BY ux, k, n ORDER BY (p).members[1]) AS place, ux, uy,
		ST_Centroid((p).geom) AS c
	FROM (VALUES (1.0::float8, 0.0::float8), (0.6, 0.8), (-0.8, 0.6), (0.28, -0.96)) AS direction(ux, uy),
		unnest(ARRAY[3, 4, 5, 7, 8, 13, 19, 30]) AS k, generate_series(2, k) AS n,
		LATERAL (SELECT unnest(typify_placeholders(r.geom, r.id, 50000, 0, typify_options(count => n, alignment => 1))) AS p
			FROM pg_temp.row_of(k, ux, uy) AS r) AS each
), gap AS (
	SELECT *, ST_Distance(c, lead(c) OVER (PARTITION BY ux, k, n ORDER BY place)) AS gap,
		abs((ST_X(c) - 600000) * uy - (ST_Y(c) - 5200000) * ux) AS off_line
	FROM left_over
), row AS (
	SELECT k, n, count(*) AS placeholders, max(off_line) AS off_line,
		coalesce(stddev_pop(gap) / nullif(avg(gap), 0), 0) AS variation
	FROM gap GROUP BY ux, k, n
)
SELECT count(*) AS rows, bool_and(placeholders = n) AS as_many_as_asked, max(off_line) < 0.001 AS on_the_line,
	max(variation) < 0.001 AS evenly_spaced
FROM row;

-- kept apart by a gap, a row too dense for it gives up places: what is left stays on its line, evenly, from end to end
WITH left_over AS (
	SELECT k, ux, uy, scale, row_number() OVER (PARTITION BY ux, k, scale ORDER BY (p).members[1]) AS place,
		count(*) OVER (PARTITION BY ux, k, scale) AS n, ST_Centroid((p).geom) AS c, (p).member_count, (p).geom
	FROM (VALUES (1.0::float8, 0.0::float8), (0.6, 0.8), (-0.8, 0.6), (0.28, -0.96)) AS direction(ux, uy),
		unnest(ARRAY[6, 7, 13, 30]) AS k, unnest(ARRAY[50000, 75000, 100000]) AS scale,
		LATERAL (SELECT unnest(typify_placeholders(r.geom, r.id, scale, 0, typify_options(exponent => 0, alignment => 5, min_side => 0.35, min_gap => 0.2))) AS p
			FROM pg_temp.row_of(k, ux, uy) AS r) AS each
), gap AS (
	SELECT *, ST_Distance(c, lead(c) OVER along) AS pitch, ST_Distance(geom, lead(geom) OVER along) AS gap,
		abs((ST_X(c) - 600000) * uy - (ST_Y(c) - 5200000) * ux) AS off_line
	FROM left_over WINDOW along AS (PARTITION BY ux, k, scale ORDER BY place)
), row AS (
	SELECT k, scale, n, max(off_line) / scale * 1000 AS off_line, min(gap) / scale * 1000 AS gap, sum(pitch) / (20 * (k - 1)) AS stretch,
		coalesce(stddev_pop(pitch) / nullif(avg(pitch), 0), 0) AS variation, sum(member_count) = k AS all_members, max(member_count) - min(member_count) AS uneven
	FROM gap GROUP BY ux, k, scale, n
)
SELECT scale, k, min(n) AS fewest, max(n) AS most, max(off_line) < 0.05 AS on_the_line, max(variation) < 0.02 AS evenly_spaced, min(gap) > 0.2 * (1 - 1e-6) AS apart,
	bool_and(stretch BETWEEN 0.98 AND 1.2) AS from_end_to_end, bool_and(all_members) AS all_members, max(uneven) AS uneven
FROM row GROUP BY scale, k ORDER BY scale, k;
CREATE TABLE pg_temp.kept_50000 AS SELECT p.* FROM unnest((SELECT typify_placeholders(geom, id, 50000, 0.5, typify_options(alignment => 5, min_side => 0.35, min_gap => 0.2)) FROM settlement_buildings)) AS p;
CREATE TABLE pg_temp.kept_75000 AS SELECT p.* FROM unnest((SELECT typify_placeholders(geom, id, 75000, 0.5, typify_options(alignment => 5, min_side => 0.35, min_gap => 0.2)) FROM settlement_buildings)) AS p;
CREATE TABLE pg_temp.kept_100000 AS SELECT p.* FROM unnest((SELECT typify_placeholders(geom, id, 100000, 0.5, typify_options(alignment => 5, min_side => 0.35, min_gap => 0.2)) FROM settlement_buildings)) AS p;
-- and in the settlement most rows stay rows
SELECT scale, q.overlapping, q.narrow_gaps, q.rows_kept >= least_kept AS rows_kept
FROM (VALUES (50000, 0.85), (75000, 0.7), (100000, 0.75)) AS aim (scale, least_kept),
	LATERAL typify_quality('settlement_buildings', ('pg_temp.kept_' || scale)::regclass, scale) AS q ORDER BY scale;

-- the settlement as one group: placeholders of rows, and those that mix several rows
SELECT scale, alignment, count(*) FILTER (WHERE rows > 0) AS of_rows, count(*) FILTER (WHERE rows > 1) AS of_several
FROM unnest(ARRAY[50000, 75000, 100000]) AS scale, unnest(ARRAY[0, 1, 4, 20]) AS alignment,
	LATERAL (SELECT count(DISTINCT house.number) AS rows
		FROM (SELECT unnest(typify_placeholders(geom, id, scale, 0, typify_options(alignment => alignment))) AS p
			FROM settlement_buildings) AS each
		CROSS JOIN unnest((p).members) AS member JOIN house ON house.id = member
		GROUP BY (p).id) AS placeholder
GROUP BY scale, alignment ORDER BY scale, alignment;

-- 0 changes nothing; every form gives the same; nor does the order of rows matter
SELECT (SELECT typify(geom, 75000, 0.5) FROM settlement_buildings)::text =
	(SELECT typify(geom, 75000, 0.5, typify_options(alignment => 0)) FROM settlement_buildings)::text AS off,
	(SELECT typify(geom, 75000, 0.5, typify_options(alignment => 2) ORDER BY id) FROM settlement_buildings)::text =
	(SELECT typify(geom, 75000, 0.5, typify_options(alignment => 2) ORDER BY id * 7919 % 1601, id)
	 FROM settlement_buildings)::text AS any_order;
SELECT count(*) AS in_the_placeholder_of_their_cluster
FROM (SELECT id, typify_cluster(geom, 75000, 0.5, typify_options(alignment => 2)) OVER () AS k
	FROM settlement_buildings) AS clustered
JOIN (SELECT unnest((p).members) AS id, place - 1 AS k
	FROM (SELECT typify_placeholders(geom, id, 75000, 0.5, typify_options(alignment => 2)) AS list
		FROM settlement_buildings) AS typified, unnest(list) WITH ORDINALITY AS p(id, geom, member_count, members, area,
		width, length, orientation, place)) AS listed USING (id, k);
SELECT count(*) AS derived, sum(member_count) AS members
FROM typify_derive('settlement_buildings', NULL, 75000, group_by => 'block', options => typify_options(alignment => 2));

-- no row leads across a barrier
SELECT array_agg(member_count ORDER BY id) AS without_barrier
FROM (SELECT unnest(typify_placeholders(geom, id, 50000, 0, typify_options(count => 4, alignment => 1))) AS p
	FROM pg_temp.row_of(10, 0.6, 0.8)) AS typified, LATERAL (SELECT (p).*) AS each;
SELECT string_agg(members::text, ' ' ORDER BY id) AS with_barrier
FROM (SELECT ST_GeomFromText('LINESTRING(600830 5199440,599230 5200640)', 25832) AS barrier) AS line,
	LATERAL (SELECT unnest(typify_placeholders(geom, id, 50000, 0,
		typify_options(count => 4, alignment => 1, barriers => barrier))) AS p FROM pg_temp.row_of(10, 0.6, 0.8)) AS typified,
	LATERAL (SELECT (p).*) AS each;

-- typify_rows: order, partitions, rows without a geometry, copies
SELECT array_agg(DISTINCT (r).number) AS numbers, count(r) AS in_rows, count(*) AS rows
FROM (SELECT typify_rows(geom) OVER (ORDER BY id DESC ROWS 1 PRECEDING) AS r
	FROM (SELECT * FROM pg_temp.row_of(5, 0.6, 0.8) UNION ALL VALUES (90, NULL::geometry), (91, 'POINT EMPTY')) AS b) AS found;
SELECT part, array_agg((r).place ORDER BY id) AS places
FROM (SELECT id, id / 4 AS part, typify_rows(geom) OVER (PARTITION BY id / 4) AS r FROM pg_temp.row_of(11, 0.6, 0.8)) AS f
GROUP BY part ORDER BY part;
SELECT count(r) AS in_rows FROM (
	SELECT typify_rows(geom) OVER () AS r
	FROM (SELECT * FROM pg_temp.row_of(6, 1, 0) UNION ALL SELECT * FROM pg_temp.row_of(6, 1, 0)) AS twice) AS found;
SELECT count(r) AS points_in_rows
FROM (SELECT typify_rows(ST_Centroid(geom)) OVER () AS r FROM pg_temp.row_of(6, 1, 0)) AS found;

-- axes for a picture
SELECT (SELECT count(*) FROM regexp_matches(svg, '<path d="M', 'g')) AS paths
FROM (SELECT typify_svg(ST_Collect(geom), NULL, 5000, rows => (
	SELECT ST_Collect(axis) FROM (
		SELECT ST_MakeLine(ST_Centroid(geom) ORDER BY (r).place) AS axis
		FROM (SELECT geom, typify_rows(geom) OVER () AS r FROM pg_temp.row_of(6, 1, 0)) AS found
		WHERE r IS NOT NULL GROUP BY (r).number) AS axes)) AS svg
	FROM pg_temp.row_of(6, 1, 0)) AS picture;

SELECT pg_temp.error_of(query) FROM (VALUES
	(1, 'SELECT typify_options(alignment => -1)'),
	(2, 'SELECT typify_options(alignment => ''Infinity'')'),
	(3, 'SELECT typify_options(alignment => ''NaN'')'),
	(4, 'SELECT typify_rows(''POINT(1 1)'')'),
	(5, 'SELECT typify_rows(geom) OVER () FROM (VALUES (''SRID=4326;POINT(1 1)''::geometry)) AS b(geom)'),
	(6, 'SELECT typify_rows(geom) OVER ()
		FROM (VALUES (''SRID=25832;POINT(1 1)''::geometry), (''SRID=25833;POINT(1 2)'')) AS b(geom)'),
	(7, 'SELECT typify_rows(geom) OVER () FROM (VALUES (''CIRCULARSTRING(0 0,1 1,2 0)''::geometry)) AS b(geom)')
) AS wrong(number, query) ORDER BY number;

DROP VIEW hamlet;
DROP TABLE settlement_buildings, settlement_roads, settlement_blocks;
