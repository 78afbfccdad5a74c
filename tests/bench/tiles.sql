-- tiles.sql - times vector tiles of a hierarchy and of its buildings: table bench_tiled (id, geom in a projected system),
-- tile function public.bench_tiles. Zooms 8 to 16; tiles that hold a building, a building standing for its place.

-- The plain tile, as the documentation of PostGIS and of tile servers has it.
CREATE FUNCTION bench_plain_tile(z integer, x integer, y integer) RETURNS bytea
LANGUAGE plpgsql STABLE STRICT PARALLEL SAFE SET jit = off AS $$
DECLARE
	tile CONSTANT geometry := ST_TileEnvelope(z, x, y);
	box CONSTANT geometry := ST_Transform(ST_Segmentize(ST_TileEnvelope(z, x, y, margin => 64 / 4096.0), ST_Perimeter(tile) / 32),
		(SELECT ST_SRID(geom) FROM bench_tiled LIMIT 1));
BEGIN
	RETURN (SELECT ST_AsMVT(feature, 'buildings', 4096, 'geom', 'id') FROM (
		SELECT b.id, ST_AsMVTGeom(ST_Transform(b.geom, 3857), tile, 4096, 64, true) AS geom
		FROM bench_tiled AS b WHERE b.geom && box) AS feature);
END $$;

CREATE TABLE bench_times (z integer, x integer, y integer, buildings bigint, plain double precision, ours double precision,
	plain_bytes integer, our_bytes integer);

CREATE FUNCTION bench_asked(n integer) RETURNS TABLE (z integer, x integer, y integer) LANGUAGE sql AS $$
	SELECT z, x, y FROM (
		SELECT DISTINCT ON (z, x, y) z, x, y, chance FROM (
			SELECT z, floor((ST_X(p) + 20037508.342789244) / 40075016.685578488 * 2 ^ z)::integer AS x,
				floor((20037508.342789244 - ST_Y(p)) / 40075016.685578488 * 2 ^ z)::integer AS y,
				hashint8extended(id, z) AS chance
			FROM (SELECT id, ST_Transform(ST_Centroid(geom), 3857) AS p FROM bench_tiled
				ORDER BY hashint8extended(id, 1) LIMIT 20 * n) AS b, generate_series(8, 16) AS z
		) AS every ORDER BY z, x, y, chance
	) AS once ORDER BY row_number() OVER (PARTITION BY z ORDER BY chance), z LIMIT n
$$;

CREATE FUNCTION bench_milliseconds(function text, z integer, x integer, y integer, OUT milliseconds double precision,
	OUT bytes integer)
LANGUAGE plpgsql AS $$
DECLARE
	start timestamptz := clock_timestamp();
BEGIN
	EXECUTE format('SELECT length(%s($1, $2, $3))', function) INTO bytes USING z, x, y;
	milliseconds := 1000 * extract(epoch FROM clock_timestamp() - start);
END $$;

-- Each tile twice of each kind, taking turns; the second counts.
CREATE PROCEDURE bench_time_tiles(n integer) LANGUAGE plpgsql AS $$
DECLARE
	srid CONSTANT integer := (SELECT ST_SRID(geom) FROM bench_tiled LIMIT 1);
	box geometry;
	tile record;
	plain record;
	ours record;
BEGIN
	FOR tile IN SELECT * FROM bench_asked(n) LOOP
		FOR run IN 1..2 LOOP
			plain := bench_milliseconds('bench_plain_tile', tile.z, tile.x, tile.y);
			ours := bench_milliseconds('bench_tiles', tile.z, tile.x, tile.y);
		END LOOP;
		box := ST_Transform(ST_TileEnvelope(tile.z, tile.x, tile.y), srid);
		INSERT INTO bench_times VALUES (tile.z, tile.x, tile.y, (SELECT count(*) FROM bench_tiled AS b WHERE b.geom && box),
			plain.milliseconds, ours.milliseconds, plain.bytes, ours.bytes);
		COMMIT;
	END LOOP;
END $$;
