-- edits.sql - for tests: pg_temp.edit(buildings, number) does the edit of that number to a table of buildings (id,
-- block, geom) and returns the blocks it touched, as text. The same number does the same on every machine.
\set ECHO none
CREATE FUNCTION pg_temp.chance(number bigint, salt integer) RETURNS float8 LANGUAGE plpgsql IMMUTABLE AS
$$
DECLARE
	x bigint := (number * 7477 + salt * 104729 + 17) & 4294967295;
BEGIN
	x := (((x >> 16) # x) * 73244475) & 4294967295;
	x := (((x >> 16) # x) * 73244475) & 4294967295;
	RETURN ((x >> 16) # x) / 4294967296.0::float8;
END
$$;
CREATE FUNCTION pg_temp.edit(buildings regclass, number bigint) RETURNS text[] LANGUAGE plpgsql AS
$$
DECLARE
	what integer := floor(5 * pg_temp.chance(number, 1));
	dx float8 := round((200 * pg_temp.chance(number, 2) - 100)::numeric, 2);
	dy float8 := round((200 * pg_temp.chance(number, 3) - 100)::numeric, 2);
	one record;
	other record;
BEGIN
	EXECUTE format('SELECT * FROM %s ORDER BY id OFFSET floor($1 * (SELECT count(*) FROM %1$s)) LIMIT 1', buildings)
		INTO one USING pg_temp.chance(number, 4);
	EXECUTE format('SELECT * FROM %s ORDER BY id OFFSET floor($1 * (SELECT count(*) FROM %1$s)) LIMIT 1', buildings)
		INTO other USING pg_temp.chance(number, 5);
	IF what = 0 THEN
		EXECUTE format('INSERT INTO %s (id, block, geom) VALUES ($1, $2, ST_Translate($3, $4, $5))', buildings)
			USING 1000000 + number, one.block, one.geom, dx, dy;
	ELSIF what = 1 THEN
		EXECUTE format('DELETE FROM %s WHERE id = $1', buildings) USING one.id;
	ELSIF what = 2 THEN
		EXECUTE format('UPDATE %s SET geom = ST_Translate(geom, $2, $3) WHERE id = $1', buildings) USING one.id, dx, dy;
	ELSIF what = 3 THEN
		EXECUTE format('UPDATE %s SET geom = ST_Envelope(geom) WHERE id = $1', buildings) USING one.id;
	ELSE
		EXECUTE format('UPDATE %s SET block = $2 WHERE id = $1', buildings)
			USING one.id, CASE WHEN dx < 80 THEN other.block END;
		RETURN ARRAY[one.block::text, CASE WHEN dx < 80 THEN other.block::text END];
	END IF;
	RETURN ARRAY[one.block::text];
END
$$;
-- rows that only one of a layer and a query has
CREATE FUNCTION pg_temp.differing(layer regclass, query text) RETURNS bigint LANGUAGE plpgsql AS
$$
DECLARE
	number bigint;
BEGIN
	EXECUTE format('WITH query AS MATERIALIZED (%2$s) SELECT count(*) '
		'FROM ((TABLE %1$s EXCEPT ALL TABLE query) UNION ALL (TABLE query EXCEPT ALL TABLE %1$s)) AS d', layer, query)
	INTO number;
	RETURN number;
END
$$;
\set ECHO all
