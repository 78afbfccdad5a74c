-- 30-aggregates.sql: typify and typify_placeholders, with their support functions

CREATE FUNCTION typify_combine(internal, internal)
RETURNS internal
AS 'MODULE_PATHNAME'
LANGUAGE C IMMUTABLE PARALLEL SAFE COST 10;

COMMENT ON FUNCTION typify_combine(internal, internal) IS
'Support of typify and typify_placeholders: joins the buildings of two partial groups. Errors as of typify for groups of two SRIDs or of varying parameters.';

CREATE FUNCTION typify_serialize(internal)
RETURNS bytea
AS 'MODULE_PATHNAME'
LANGUAGE C IMMUTABLE STRICT PARALLEL SAFE COST 10;

COMMENT ON FUNCTION typify_serialize(internal) IS
'Support of typify and typify_placeholders: a partial group on its way to another process, 56 bytes a building. Error 54000 above 1 GB: SET max_parallel_workers_per_gather = 0.';

CREATE FUNCTION typify_deserialize(bytea, internal)
RETURNS internal
AS 'MODULE_PATHNAME'
LANGUAGE C IMMUTABLE STRICT PARALLEL SAFE COST 10;

COMMENT ON FUNCTION typify_deserialize(bytea, internal) IS
'Support of typify and typify_placeholders: takes in what typify_serialize wrote.';

CREATE FUNCTION typify_final(internal)
RETURNS geometry
AS 'MODULE_PATHNAME'
LANGUAGE C IMMUTABLE PARALLEL SAFE COST 10000;

COMMENT ON FUNCTION typify_final(internal) IS
'Support of typify: typifies the buildings of a group.';

CREATE FUNCTION typify_placeholders_final(internal)
RETURNS typify_placeholder[]
AS 'MODULE_PATHNAME'
LANGUAGE C IMMUTABLE PARALLEL SAFE COST 10000;

COMMENT ON FUNCTION typify_placeholders_final(internal) IS
'Support of typify_placeholders: typifies the buildings of a group.';

CREATE FUNCTION typify_transition(internal, geometry, double precision)
RETURNS internal
AS 'MODULE_PATHNAME'
LANGUAGE C IMMUTABLE PARALLEL SAFE COST 10;

COMMENT ON FUNCTION typify_transition(internal, geometry, double precision) IS
'Support of typify: measures a building and adds it to its group.';

CREATE AGGREGATE typify(
	geom geometry,
	scale double precision)
(
	SFUNC = typify_transition,
	STYPE = internal,
	SSPACE = 1024,
	FINALFUNC = typify_final,
	COMBINEFUNC = typify_combine,
	SERIALFUNC = typify_serialize,
	DESERIALFUNC = typify_deserialize,
	PARALLEL = SAFE
);

COMMENT ON AGGREGATE typify(geometry, double precision) IS
'Typifies the buildings of a group by mesh simplification (Burghardt and Cecconi 2003, 2007): a GEOMETRYCOLLECTION of one rectangle per drawn placeholder, in canonical order, with the SRID of the input; ST_Dump gives rows. Any order of rows, serial or parallel, gives the same bytes. NULL for a group without a usable row. Placeholders without size (of points, lines) are left out with a WARNING. geom: polygons, lines or points in a projected coordinate system. scale: the denominator, at least source_scale (25000 unless set). A row whose geometry is NULL or EMPTY is passed over. Errors: 22023 for a geographic, a geocentric or a second SRID, a coordinate or parameter that is not finite or out of range, and parameters that vary inside a group; 22004 for a NULL scale or s_u; 0A000 for curves, TINs, polyhedral surfaces and collections; 54000 for a result above 1 GB.';

CREATE FUNCTION typify_transition(internal, geometry, double precision, double precision)
RETURNS internal
AS 'MODULE_PATHNAME'
LANGUAGE C IMMUTABLE PARALLEL SAFE COST 10;

COMMENT ON FUNCTION typify_transition(internal, geometry, double precision, double precision) IS
'Support of typify: measures a building and adds it to its group.';

CREATE AGGREGATE typify(
	geom geometry,
	scale double precision,
	s_u double precision)
(
	SFUNC = typify_transition,
	STYPE = internal,
	SSPACE = 1024,
	FINALFUNC = typify_final,
	COMBINEFUNC = typify_combine,
	SERIALFUNC = typify_serialize,
	DESERIALFUNC = typify_deserialize,
	PARALLEL = SAFE
);

COMMENT ON AGGREGATE typify(geometry, double precision, double precision) IS
'Typifies the buildings of a group by mesh simplification (Burghardt and Cecconi 2003, 2007): a GEOMETRYCOLLECTION of one rectangle per drawn placeholder, in canonical order, with the SRID of the input; ST_Dump gives rows. Any order of rows, serial or parallel, gives the same bytes. NULL for a group without a usable row. Placeholders without size (of points, lines) are left out with a WARNING. geom: polygons, lines or points in a projected coordinate system. scale: the denominator, at least source_scale (25000 unless set). s_u: density control in 0 .. 1; 0, the default, always merges the closest two. A row whose geometry is NULL or EMPTY is passed over. Errors: 22023 for a geographic, a geocentric or a second SRID, a coordinate or parameter that is not finite or out of range, and parameters that vary inside a group; 22004 for a NULL scale or s_u; 0A000 for curves, TINs, polyhedral surfaces and collections; 54000 for a result above 1 GB.';

CREATE FUNCTION typify_transition(internal, geometry, double precision, double precision, typify_options)
RETURNS internal
AS 'MODULE_PATHNAME'
LANGUAGE C IMMUTABLE PARALLEL SAFE COST 10;

COMMENT ON FUNCTION typify_transition(internal, geometry, double precision, double precision, typify_options) IS
'Support of typify: measures a building and adds it to its group.';

CREATE AGGREGATE typify(
	geom geometry,
	scale double precision,
	s_u double precision,
	options typify_options)
(
	SFUNC = typify_transition,
	STYPE = internal,
	SSPACE = 1024,
	FINALFUNC = typify_final,
	COMBINEFUNC = typify_combine,
	SERIALFUNC = typify_serialize,
	DESERIALFUNC = typify_deserialize,
	PARALLEL = SAFE
);

COMMENT ON AGGREGATE typify(geometry, double precision, double precision, typify_options) IS
'Typifies the buildings of a group by mesh simplification (Burghardt and Cecconi 2003, 2007): a GEOMETRYCOLLECTION of one rectangle per drawn placeholder, in canonical order, with the SRID of the input; ST_Dump gives rows. Any order of rows, serial or parallel, gives the same bytes. NULL for a group without a usable row. Placeholders without size (of points, lines) are left out with a WARNING. geom: polygons, lines or points in a projected coordinate system. scale: the denominator, at least source_scale (25000 unless set). s_u: density control in 0 .. 1; 0, the default, always merges the closest two. options: see typify_options; NULL sets none. A row whose geometry is NULL or EMPTY is passed over. Errors: 22023 for a geographic, a geocentric or a second SRID, a coordinate or parameter that is not finite or out of range, and parameters that vary inside a group; 22004 for a NULL scale or s_u; 0A000 for curves, TINs, polyhedral surfaces and collections; 54000 for a result above 1 GB.';

CREATE FUNCTION typify_placeholders_transition(internal, geometry, bigint, double precision)
RETURNS internal
AS 'MODULE_PATHNAME'
LANGUAGE C IMMUTABLE PARALLEL SAFE COST 10;

COMMENT ON FUNCTION typify_placeholders_transition(internal, geometry, bigint, double precision) IS
'Support of typify_placeholders: measures a building and adds it to its group.';

CREATE AGGREGATE typify_placeholders(
	geom geometry,
	id bigint,
	scale double precision)
(
	SFUNC = typify_placeholders_transition,
	STYPE = internal,
	SSPACE = 1024,
	FINALFUNC = typify_placeholders_final,
	COMBINEFUNC = typify_combine,
	SERIALFUNC = typify_serialize,
	DESERIALFUNC = typify_deserialize,
	PARALLEL = SAFE
);

COMMENT ON AGGREGATE typify_placeholders(geometry, bigint, double precision) IS
'Typifies the buildings of a group as typify does and says who became what: an array of typify_placeholder in canonical order (element k + 1 is number k of typify_cluster, identical copies of a geometry aside: ids tell them apart here); unnest gives rows. Every building is a member of exactly one placeholder; one without size has geom NULL and raises a WARNING. NULL for a group without a usable row. id: a key of the building inside its group. scale: the denominator, at least source_scale (25000 unless set). A row whose geometry is NULL or EMPTY is passed over. Errors: 22023 for a geographic, a geocentric or a second SRID, a coordinate or parameter that is not finite or out of range, and parameters that vary inside a group; 22004 for a NULL scale or s_u; 0A000 for curves, TINs, polyhedral surfaces and collections; 54000 for a result above 1 GB. Also 22004 for a NULL id and 22023 for an id that occurs twice in a group.';

CREATE FUNCTION typify_placeholders_transition(internal, geometry, bigint, double precision, double precision)
RETURNS internal
AS 'MODULE_PATHNAME'
LANGUAGE C IMMUTABLE PARALLEL SAFE COST 10;

COMMENT ON FUNCTION typify_placeholders_transition(internal, geometry, bigint, double precision, double precision) IS
'Support of typify_placeholders: measures a building and adds it to its group.';

CREATE AGGREGATE typify_placeholders(
	geom geometry,
	id bigint,
	scale double precision,
	s_u double precision)
(
	SFUNC = typify_placeholders_transition,
	STYPE = internal,
	SSPACE = 1024,
	FINALFUNC = typify_placeholders_final,
	COMBINEFUNC = typify_combine,
	SERIALFUNC = typify_serialize,
	DESERIALFUNC = typify_deserialize,
	PARALLEL = SAFE
);

COMMENT ON AGGREGATE typify_placeholders(geometry, bigint, double precision, double precision) IS
'Typifies the buildings of a group as typify does and says who became what: an array of typify_placeholder in canonical order (element k + 1 is number k of typify_cluster, identical copies of a geometry aside: ids tell them apart here); unnest gives rows. Every building is a member of exactly one placeholder; one without size has geom NULL and raises a WARNING. NULL for a group without a usable row. id: a key of the building inside its group. scale: the denominator, at least source_scale (25000 unless set). s_u: density control in 0 .. 1; 0, the default, always merges the closest two. A row whose geometry is NULL or EMPTY is passed over. Errors: 22023 for a geographic, a geocentric or a second SRID, a coordinate or parameter that is not finite or out of range, and parameters that vary inside a group; 22004 for a NULL scale or s_u; 0A000 for curves, TINs, polyhedral surfaces and collections; 54000 for a result above 1 GB. Also 22004 for a NULL id and 22023 for an id that occurs twice in a group.';

CREATE FUNCTION typify_placeholders_transition(internal, geometry, bigint, double precision, double precision, typify_options)
RETURNS internal
AS 'MODULE_PATHNAME'
LANGUAGE C IMMUTABLE PARALLEL SAFE COST 10;

COMMENT ON FUNCTION typify_placeholders_transition(internal, geometry, bigint, double precision, double precision, typify_options) IS
'Support of typify_placeholders: measures a building and adds it to its group.';

CREATE AGGREGATE typify_placeholders(
	geom geometry,
	id bigint,
	scale double precision,
	s_u double precision,
	options typify_options)
(
	SFUNC = typify_placeholders_transition,
	STYPE = internal,
	SSPACE = 1024,
	FINALFUNC = typify_placeholders_final,
	COMBINEFUNC = typify_combine,
	SERIALFUNC = typify_serialize,
	DESERIALFUNC = typify_deserialize,
	PARALLEL = SAFE
);

COMMENT ON AGGREGATE typify_placeholders(geometry, bigint, double precision, double precision, typify_options) IS
'Typifies the buildings of a group as typify does and says who became what: an array of typify_placeholder in canonical order (element k + 1 is number k of typify_cluster, identical copies of a geometry aside: ids tell them apart here); unnest gives rows. Every building is a member of exactly one placeholder; one without size has geom NULL and raises a WARNING. NULL for a group without a usable row. id: a key of the building inside its group. scale: the denominator, at least source_scale (25000 unless set). s_u: density control in 0 .. 1; 0, the default, always merges the closest two. options: see typify_options; NULL sets none. A row whose geometry is NULL or EMPTY is passed over. Errors: 22023 for a geographic, a geocentric or a second SRID, a coordinate or parameter that is not finite or out of range, and parameters that vary inside a group; 22004 for a NULL scale or s_u; 0A000 for curves, TINs, polyhedral surfaces and collections; 54000 for a result above 1 GB. Also 22004 for a NULL id and 22023 for an id that occurs twice in a group.';

CREATE FUNCTION typify_placeholders_transition(internal, geometry, bigint, double precision, double precision, typify_options, double precision)
RETURNS internal
AS 'MODULE_PATHNAME'
LANGUAGE C IMMUTABLE PARALLEL SAFE COST 10;

COMMENT ON FUNCTION typify_placeholders_transition(internal, geometry, bigint, double precision, double precision, typify_options, double precision) IS
'Support of typify_placeholders: measures a building and adds it to its group.';

CREATE AGGREGATE typify_placeholders(
	geom geometry,
	id bigint,
	scale double precision,
	s_u double precision,
	options typify_options,
	importance double precision)
(
	SFUNC = typify_placeholders_transition,
	STYPE = internal,
	SSPACE = 1024,
	FINALFUNC = typify_placeholders_final,
	COMBINEFUNC = typify_combine,
	SERIALFUNC = typify_serialize,
	DESERIALFUNC = typify_deserialize,
	PARALLEL = SAFE
);

COMMENT ON AGGREGATE typify_placeholders(geometry, bigint, double precision, double precision, typify_options, double precision) IS
'Typifies the buildings of a group as typify does and says who became what: an array of typify_placeholder in canonical order (element k + 1 is number k of typify_cluster, identical copies of a geometry aside: ids tell them apart here); unnest gives rows. Every building is a member of exactly one placeholder; one without size has geom NULL and raises a WARNING. NULL for a group without a usable row. id: a key of the building inside its group. scale: the denominator, at least source_scale (25000 unless set). s_u: density control in 0 .. 1; 0, the default, always merges the closest two. options: see typify_options; NULL sets none. importance: at least 1, NULL counts as 1. Edges of a placeholder count as many times longer as its highest importance says, position and mean area are weighted by importance, and the representative is the member of the highest one, then the largest. ''Infinity'' keeps a building: it stays where it is, with its own area, takes in others without moving, and is merged with no other kept one, so that the count may not be reached. A row whose geometry is NULL or EMPTY is passed over. Errors: 22023 for a geographic, a geocentric or a second SRID, a coordinate or parameter that is not finite or out of range, and parameters that vary inside a group; 22004 for a NULL scale or s_u; 0A000 for curves, TINs, polyhedral surfaces and collections; 54000 for a result above 1 GB. Also 22004 for a NULL id and 22023 for an id that occurs twice in a group.';

-- For wrappers, whose options differ from group to group while the barriers are the same for all: as an option they
-- would be copied for every group.
CREATE FUNCTION typify_barred_transition(internal, geometry, bigint, double precision, double precision, typify_options, geometry, double precision)
RETURNS internal
AS 'MODULE_PATHNAME'
LANGUAGE C IMMUTABLE PARALLEL SAFE COST 10;

COMMENT ON FUNCTION typify_barred_transition(internal, geometry, bigint, double precision, double precision, typify_options, geometry, double precision) IS
'Support of typify_barred: measures a building and adds it to its group.';

CREATE AGGREGATE typify_barred(
	geom geometry,
	id bigint,
	scale double precision,
	s_u double precision,
	options typify_options,
	barriers geometry,
	importance double precision)
(
	SFUNC = typify_barred_transition,
	STYPE = internal,
	SSPACE = 1024,
	FINALFUNC = typify_placeholders_final,
	COMBINEFUNC = typify_combine,
	SERIALFUNC = typify_serialize,
	DESERIALFUNC = typify_deserialize,
	PARALLEL = SAFE
);

COMMENT ON AGGREGATE typify_barred(geometry, bigint, double precision, double precision, typify_options, geometry, double precision) IS
'As typify_placeholders, with barriers beside the options instead of among them, so that options can differ from group to group without a copy of the barriers in each. Pass them as a scalar sub-select. Errors: as of typify_placeholders; 22023 for barriers in both places.';

CREATE FUNCTION typify_sites_final(internal)
RETURNS typify_site[]
AS 'MODULE_PATHNAME'
LANGUAGE C IMMUTABLE PARALLEL SAFE COST 10000;

COMMENT ON FUNCTION typify_sites_final(internal) IS
'Support of typify_sites: typifies the buildings of a group.';

CREATE AGGREGATE typify_sites(
	geom geometry,
	id bigint,
	scale double precision,
	s_u double precision,
	options typify_options,
	barriers geometry,
	importance double precision)
(
	SFUNC = typify_barred_transition,
	STYPE = internal,
	SSPACE = 1024,
	FINALFUNC = typify_sites_final,
	COMBINEFUNC = typify_combine,
	SERIALFUNC = typify_serialize,
	DESERIALFUNC = typify_deserialize,
	PARALLEL = SAFE
);

COMMENT ON AGGREGATE typify_sites(geometry, bigint, double precision, double precision, typify_options, geometry, double precision) IS
'As typify_barred, with what typify_settle needs to make the placeholders of several groups legible together; kept buildings in each other''s way are left for that one to tell of.';

CREATE FUNCTION typify_settle_transition(internal, bigint, integer, integer, integer, double precision[], geometry)
RETURNS internal
AS 'MODULE_PATHNAME'
LANGUAGE C IMMUTABLE PARALLEL SAFE COST 10;

COMMENT ON FUNCTION typify_settle_transition(internal, bigint, integer, integer, integer, double precision[], geometry) IS
'Support of typify_settle: takes in a placeholder.';

CREATE FUNCTION typify_settle_final(internal)
RETURNS typify_settled[]
AS 'MODULE_PATHNAME'
LANGUAGE C IMMUTABLE PARALLEL SAFE COST 100000;

COMMENT ON FUNCTION typify_settle_final(internal) IS
'Support of typify_settle: makes the placeholders legible.';

CREATE AGGREGATE typify_settle(
	id bigint,
	grp integer,
	member_count integer,
	srid integer,
	site double precision[],
	barriers geometry)
(
	SFUNC = typify_settle_transition,
	STYPE = internal,
	SSPACE = 16384,
	FINALFUNC = typify_settle_final,
	PARALLEL = SAFE
);

COMMENT ON AGGREGATE typify_settle(bigint, integer, integer, integer, double precision[], geometry) IS
'Makes the drawn placeholders of all groups of a layer legible together (options.min_gap), where each group is so by itself: id, which differs from row to row, a number of the group, member_count, the SRID, the field site of typify_site, and barriers, the same for all rows or NULL. Placeholders of different groups are not merged: they are shrunk, moved or, last, one of two is not drawn, that with more conflicts, then with fewer members: its members go to the nearest of its group (heir) or, where none of that is drawn, nowhere, which is said in a WARNING. Kept ones stay: how many are too near to each other or to a barrier is said in a WARNING, too. Returns those that something was done to; NULL without min_gap or a row. The same set of rows gives the same answer. Rows with a NULL are passed over. Errors: 22023 for a site that is none; 22003 for coordinates that are too large.';

