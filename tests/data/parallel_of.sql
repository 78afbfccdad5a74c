-- parallel_of.sql - for tests: what a query answers, and whether its plan aggregates in parallel workers
\set ECHO none
CREATE FUNCTION pg_temp.answer(query text) RETURNS text LANGUAGE plpgsql AS
$$
DECLARE
	answer text;
BEGIN
	EXECUTE query INTO answer;
	RETURN answer;
END
$$;
CREATE FUNCTION pg_temp.is_parallel(query text) RETURNS boolean LANGUAGE plpgsql AS
$$
DECLARE
	line text;
BEGIN
	FOR line IN EXECUTE 'EXPLAIN (COSTS OFF) ' || query LOOP
		IF line ~ 'Partial .*Aggregate' THEN RETURN true; END IF;
	END LOOP;
	RETURN false;
END
$$;
\set ECHO all
