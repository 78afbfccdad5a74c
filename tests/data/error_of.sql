-- error_of.sql - for tests: what a statement fails with, as SQLSTATE: message / hint
\set ECHO none
CREATE FUNCTION pg_temp.error_of(query text) RETURNS text LANGUAGE plpgsql SET search_path FROM CURRENT AS
$$
DECLARE
	code text;
	message text;
	hint text;
BEGIN
	EXECUTE query;
	RETURN 'no error';
EXCEPTION WHEN OTHERS THEN
	GET STACKED DIAGNOSTICS code = RETURNED_SQLSTATE, message = MESSAGE_TEXT, hint = PG_EXCEPTION_HINT;
	RETURN code || ': ' || message || CASE hint WHEN '' THEN '' ELSE ' / ' || hint END;
END
$$;
\set ECHO all
