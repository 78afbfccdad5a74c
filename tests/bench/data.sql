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
