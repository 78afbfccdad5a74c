#!/bin/bash
# real_data.sh - the fear: what holds on made-up sets does not hold on real buildings. Uses the server of the PG*
# variables and real data.
. "$(dirname "$0")/common.sh"

need_real liechtenstein_2024 buildings
fresh_database typify_real_data
load_real buildings

sql <<'SQL'
CREATE TABLE placeholders AS
SELECT scale, s_u, ordinality - 1 AS number, p.*
FROM (
	SELECT scale, s_u, typify_placeholders(geom, id, scale, s_u) AS list
	FROM buildings, unnest(ARRAY[25000, 50000, 75000, 100000, 200000, 500000]::float8[]) AS scale,
		unnest(ARRAY[0, 0.5, 1]::float8[]) AS s_u
	GROUP BY scale, s_u
) t, unnest(list) WITH ORDINALITY AS p;
CREATE TABLE members AS
SELECT scale, s_u, number, unnest(members) AS id FROM placeholders;
SQL
holds "as many as the law says" \
	"SELECT bool_and(n = typify_count(17717, scale)) FROM
		(SELECT scale, s_u, count(*) n FROM placeholders GROUP BY scale, s_u) t"
holds "75 000 leaves a third" "SELECT count(*) = floor(17717 / 3.0) FROM placeholders WHERE scale = 75000 AND s_u = 0.5"
holds "every building is a member of exactly one placeholder" \
	"SELECT count(*) = 18 * 17717 AND count(DISTINCT (scale, s_u, id)) = count(*) FROM members"
holds "member counts add up" "SELECT sum(member_count) = 18 * 17717 AND
	bool_and(member_count = cardinality(members)) FROM placeholders"
holds "the representative is the largest member" \
	"SELECT bool_and(ST_Area(r.geom) >= largest * (1 - 1e-12)) FROM placeholders p JOIN buildings r USING (id) JOIN
		(SELECT scale, s_u, number, max(ST_Area(geom)) largest FROM members JOIN buildings USING (id)
		GROUP BY scale, s_u, number) m USING (scale, s_u, number)"
holds "areas are the mean of the members times the factor" \
	"SELECT bool_and(abs(p.area / (m.mean * typify_area_factor(scale)) - 1) < 1e-9) FROM placeholders p JOIN
		(SELECT scale, s_u, number, avg(ST_Area(geom)) mean FROM members JOIN buildings USING (id)
		GROUP BY scale, s_u, number) m USING (scale, s_u, number)"
holds "each is drawn at the mean of its members' centroids" \
	"SELECT bool_and(ST_Distance(ST_Centroid(p.geom), ST_MakePoint(x, y)) < 1e-3) FROM
		(SELECT scale, s_u, number, avg(ST_X(ST_Centroid(geom))) x, avg(ST_Y(ST_Centroid(geom))) y
		FROM members JOIN buildings USING (id) GROUP BY scale, s_u, number) m
		JOIN (SELECT scale, s_u, number, ST_SetSRID(geom, 0) geom FROM placeholders) p USING (scale, s_u, number)"
holds "typify draws what typify_placeholders lists" \
	"SELECT array_agg(ST_AsEWKB((d).geom) ORDER BY (d).path) =
		(SELECT array_agg(ST_AsEWKB(geom) ORDER BY number) FROM placeholders WHERE scale = 75000 AND s_u = 0.5)
	FROM (SELECT ST_Dump(typify(geom, 75000, 0.5)) AS d FROM buildings) t"
holds "typify_cluster numbers as typify_placeholders does" \
	"SELECT bool_and(c.number = m.number) FROM
		(SELECT id, typify_cluster(geom, 75000, 0.5) OVER () AS number FROM buildings) c
		JOIN members m ON m.id = c.id AND m.scale = 75000 AND m.s_u = 0.5"
serial=$(sql -At -c 'SET max_parallel_workers_per_gather = 0' \
	-c 'SELECT md5(ST_AsEWKB(typify(geom, 75000, 0.5))) FROM buildings')
holds "a parallel plan gives the same bytes" \
	"SET parallel_setup_cost = 0; SET parallel_tuple_cost = 0; SET min_parallel_table_scan_size = 0;
	SELECT md5(ST_AsEWKB(typify(geom, 75000, 0.5))) = '$serial' FROM buildings"
holds "another order of rows gives the same bytes" \
	"SELECT md5(ST_AsEWKB(typify(geom, 75000, 0.5 ORDER BY id * 7919 % 17717))) = '$serial' FROM buildings"

# a coarse layer that typify did not make: the hulls of dense cores, and what is large and stands alone
sql <<'SQL'
CREATE TABLE lod25 AS SELECT id, geom, ST_ClusterDBSCAN(geom, 50, 5) OVER () AS place FROM buildings;
CREATE TABLE lod200 AS
SELECT min(id) AS id, ST_ConvexHull(ST_Buffer(ST_Collect(geom), 4)) AS geom
FROM (SELECT id, geom, ST_ClusterDBSCAN(geom, 12, 3) OVER () AS core FROM buildings) b
GROUP BY coalesce(core, -id) HAVING count(*) >= 4 OR count(*) = 1 AND sum(ST_Area(geom)) > 500;
CREATE TABLE calibration AS SELECT * FROM typify_calibrate('lod25', 'lod200', 0.5, 'place');
SQL
sql -P pager=off <<'SQL'
SELECT scale, asked, count(*) AS got, round(avg(area)) AS mean_area, round(max(wanted)) AS mean_area_stored
FROM (SELECT c.*, scale, typify_count(n25, scale, options) AS asked,
		CASE scale WHEN 25000 THEN mean_area25 WHEN 200000 THEN mean_area200 END AS wanted
	  FROM typify_calibrate('lod25', 'lod200', 0.5) c, unnest(ARRAY[25e3, 50e3, 75e3, 100e3, 150e3, 200e3]) AS scale) c,
	typify_derive('lod25', 'lod200', scale, 0.5) GROUP BY scale, asked ORDER BY scale;
SQL
holds "derived from two levels: LOD200's count and mean area at 1:200 000" \
	"SELECT count(*) = (SELECT count(*) FROM lod200) AND abs(avg(area) / (SELECT avg(ST_Area(geom)) FROM lod200) - 1) < 1e-9
	FROM typify_derive('lod25', 'lod200', 200000, 0.5)"
holds "... and LOD25's count at 1:25 000" \
	"SELECT count(*) = 17717 FROM typify_derive('lod25', 'lod200', 25000, 0.5)"
holds "... in each place with objects of LOD200" \
	"SELECT count(*) > 50 AND bool_and(n = n200 AND abs(area / mean_area200 - 1) < 1e-9) FROM calibration c JOIN
		(SELECT grp, count(*) n, avg(area) area FROM typify_derive('lod25', 'lod200', 200000, 0.5, 'place') GROUP BY grp) d
		ON d.grp IS NOT DISTINCT FROM c.grp WHERE calibrated AND NOT overall"
holds "... in all places together, with a total to divide" \
	"SELECT bool_and(drawn = typify_count(n25, scale, options) AND members = 17717) FROM
		(SELECT scale, count(geom) drawn, sum(member_count) members FROM unnest(ARRAY[50000, 75000, 200000, 500000]) scale,
		typify_derive('lod25', 'lod200', scale, 0.5, 'place', allocation => 'total') GROUP BY scale) d, calibration
	WHERE overall"
sql -c 'CREATE TABLE centres AS SELECT place, typify_centre(geom) AS centre FROM lod25' \
	-c 'CREATE INDEX ON centres USING gist (centre)'
holds "objects of LOD200 belong to the place of the building with the nearest centre" \
	"SELECT count(*) > 50 AND bool_and(c.n200 = coalesce(n.n200, 0)) FROM calibration c LEFT JOIN
		(SELECT place, count(*) n200 FROM lod200, LATERAL (SELECT place FROM centres
			ORDER BY centre <-> typify_centre(lod200.geom) LIMIT 1) nearest GROUP BY place) n
		ON n.place::text IS NOT DISTINCT FROM c.grp WHERE NOT overall"
exit $FAILED
