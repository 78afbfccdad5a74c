-- data.sql - generated data for the benchmark, the same on every machine: tables with columns id, geom, block (about 10
-- neighbours) and district (about 1000). A building stands for every 1600 square metres, whatever n.

-- number i of the stream, in [0, 1)
CREATE FUNCTION bench_unit(i bigint, stream bigint) RETURNS double precision
LANGUAGE sql IMMUTABLE PARALLEL SAFE
RETURN (hashint8extended(i, stream) & 1099511627775)::double precision / 1099511627776;

-- rectangle of 40 to 400 square metres
CREATE FUNCTION bench_building(i bigint, x double precision, y double precision) RETURNS geometry
LANGUAGE sql IMMUTABLE PARALLEL SAFE
RETURN typify_rectangle(ST_Point(x, y), 40 + 360 * bench_unit(i, 1), 0.4 + 0.6 * bench_unit(i, 2),
	180 * bench_unit(i, 3));

CREATE FUNCTION bench_uniform(n bigint) RETURNS TABLE (id bigint, geom geometry)
LANGUAGE sql STABLE
BEGIN ATOMIC
	SELECT i, bench_building(i, 40 * sqrt(n) * bench_unit(i, 4), 40 * sqrt(n) * bench_unit(i, 5))
	FROM generate_series(1, n) AS i;
END;

-- a square in each cell of a grid, up to half a cell off its corner, row by row
CREATE FUNCTION bench_jittered_grid(n bigint) RETURNS TABLE (id bigint, geom geometry)
LANGUAGE sql STABLE
BEGIN ATOMIC
	SELECT i, typify_rectangle(
		ST_Point(40 * (i % side + 0.5 * bench_unit(i, 4)), 40 * (i / side + 0.5 * bench_unit(i, 5))), 144, 1, 0)
	FROM (SELECT ceil(sqrt(n))::bigint AS side) AS s, generate_series(1, n) AS i;
END;

-- Towns of 2000 buildings on average, dense in the middle; few are large: the share of the k-th falls with the root of k.
CREATE FUNCTION bench_towns(n bigint) RETURNS TABLE (id bigint, geom geometry)
LANGUAGE sql STABLE
BEGIN ATOMIC
	SELECT i, bench_building(i,
		40 * sqrt(n) * bench_unit(town, 6) + distance * cos(angle),
		40 * sqrt(n) * bench_unit(town, 7) + distance * sin(angle))
	FROM (
		SELECT i, town, 2 * pi() * bench_unit(i, 4) AS angle,
			40 * sqrt(2000) * (0.2 + bench_unit(town, 8)) * bench_unit(i, 5) AS distance
		FROM (
			SELECT i, floor(power(bench_unit(i, 9), 2) * (n / 2000 + 1))::bigint AS town
			FROM generate_series(1, n) AS i) AS t) AS p;
END;

-- What the aggregate does before its last step: rows read and measured. The bytes are those of the state.
CREATE AGGREGATE bench_measure(geometry, double precision, double precision) (
	SFUNC = typify_transition,
	STYPE = internal,
	FINALFUNC = typify_serialize
);

-- Writes the nodes of a hierarchy once more, with all indexes: what building one takes besides finding them.
CREATE FUNCTION bench_write_hierarchy(hierarchy regclass) RETURNS void
LANGUAGE plpgsql AS
$$
BEGIN
	EXECUTE format('CREATE TABLE bench_copy (LIKE %s)', hierarchy);
	EXECUTE format('INSERT INTO bench_copy TABLE %s', hierarchy);
	ALTER TABLE bench_copy ADD PRIMARY KEY (group_id, node);
	CREATE INDEX ON bench_copy USING gist (place);
	ANALYZE bench_copy;
	DROP TABLE bench_copy;
END
$$;

-- How many placeholders 200 look-ups find.
CREATE FUNCTION bench_lookups(hierarchy regclass, buildings regclass) RETURNS bigint
LANGUAGE plpgsql AS
$$
DECLARE
	found bigint;
BEGIN
	EXECUTE format('SELECT sum((SELECT count(*) FROM typify_at(%L, scale, ST_Expand(ST_Centroid(geom), 0.15 * scale), false)))
		FROM (SELECT geom, 25000 * power(2::float8, i %% 7) AS scale FROM (SELECT geom, row_number() OVER (ORDER BY
			hashint8extended(id, 1)) AS i FROM %s) AS mixed WHERE i <= 200) AS box', hierarchy, buildings) INTO found;
	RETURN found;
END
$$;
