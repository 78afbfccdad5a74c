-- comments.sql: every object says what it does, and its declaration what it costs
SELECT pg_describe_object(classid, objid, 0) AS without_comment FROM pg_depend
WHERE refclassid = 'pg_extension'::regclass AND refobjid = (SELECT oid FROM pg_extension WHERE extname = 'typify') AND deptype = 'e'
	AND NOT (classid = 'pg_type'::regclass AND EXISTS (SELECT FROM pg_type AS element WHERE element.typarray = objid)) -- members from 17 on
	AND obj_description(objid, classid::regclass::name) IS NULL ORDER BY 1;
SELECT attname AS field_without_comment FROM pg_attribute WHERE attrelid = 'typify_options'::regclass AND col_description(attrelid, attnum) IS NULL ORDER BY attnum;
-- what is immutable is parallel safe, what reads tables at least in the leader
SELECT p.oid::regprocedure AS not_parallel_safe FROM pg_proc AS p JOIN pg_depend AS d ON d.objid = p.oid AND d.classid = 'pg_proc'::regclass AND d.deptype = 'e'
	AND d.refobjid = (SELECT oid FROM pg_extension WHERE extname = 'typify') WHERE provolatile = 'i' AND proparallel <> 's'
	-- an aggregate is what its transition function is
	AND NOT EXISTS (SELECT FROM pg_aggregate JOIN pg_proc AS t ON t.oid = aggtransfn WHERE aggfnoid = p.oid AND t.provolatile = 'v') OR provolatile = 's' AND proparallel = 'u' ORDER BY 1;
SELECT proname, procost FROM pg_proc WHERE proname ~ '^typify.*_final$' ORDER BY 1;
