-- 61-batches.sql: what the procedures that build a layer or a hierarchy in batches have in common

CREATE FUNCTION typify_layer_unfinished(name text, definition json, batch integer, refresh text,
	OUT relation regclass, OUT comment jsonb, OUT unfinished json)
LANGUAGE plpgsql
SET search_path FROM CURRENT AS
$$
BEGIN
	relation := to_regclass(name);
	IF typify_layer_comment(relation)->'finished' = 'false' THEN
		-- two calls that build the same at the same time take turns
		EXECUTE format('LOCK TABLE %s IN SHARE ROW EXCLUSIVE MODE', relation);
		comment := typify_layer_comment(relation);
	END IF;
	IF batch IS NULL THEN
		PERFORM typify_refuse_null('batch');
	ELSIF batch < 1 THEN
		RAISE EXCEPTION 'batch is %, it must be at least 1', batch USING ERRCODE = 'invalid_parameter_value',
			HINT = 'So many groups are made between two commits: leave it out for 1000.';
	ELSIF relation IS NOT NULL AND (comment->'finished' = 'false'
			AND comment - 'finished' - 'typify' = definition::jsonb - 'typify') IS NOT TRUE THEN
		RAISE EXCEPTION '% exists already', name USING ERRCODE = 'duplicate_table',
			HINT = CASE WHEN comment->'finished' = 'false'
				THEN 'It was begun with other arguments: call with those to go on, or drop it.'
				ELSE format('Drop it first or choose another name; %s.', refresh) END;
	END IF;
	SELECT json_object_agg(key, value) INTO unfinished
	FROM (SELECT key, value FROM json_each(definition) UNION ALL SELECT 'finished', 'false') AS pair;
END
$$;
COMMENT ON FUNCTION typify_layer_unfinished(text, json, integer, text) IS
'What a procedure that builds in batches begins with. relation: the one of this name (schema and name, quoted), NULL when there is none; comment: its comment, when it was begun with the same definition and is not finished, and then it is locked; unfinished: the definition with "finished": false. refresh: what a hint says of bringing it up to date. Errors: 22004, 22023 for batch; 42P07 for a relation that is anything else.';
