-- 10-types.sql: the options and the placeholder rows

CREATE TYPE typify_options AS (
	source_scale double precision,
	lod200_scale double precision,
	exponent double precision,
	psi double precision,
	count bigint,
	min_distance double precision,
	count_rule text,
	area_statistic text,
	shape text,
	min_area double precision,
	min_side double precision,
	max_area double precision,
	keep_area double precision,
	min_gap double precision,
	alignment double precision,
	barriers geometry,
	barrier_width double precision
);

COMMENT ON TYPE typify_options IS
'Options of typification, made by typify_options(). A field that is NULL is unset; defaults are applied at use. Values are checked at every use, however the composite was made. Scales are denominators. Areas and distances of ground are in units of the SRID; min_side, min_gap and barrier_width are millimetres, max_area and keep_area square millimetres on the map.';

COMMENT ON COLUMN typify_options.source_scale IS
'm25: denominator of the detailed level of detail. Above 0; default 25000.';
COMMENT ON COLUMN typify_options.lod200_scale IS
'm200: denominator of the coarse level of detail. Larger than source_scale; default 200000.';
COMMENT ON COLUMN typify_options.exponent IS
'x of the radical law n * (m25 / m_r)^(x/2). At least 0; default 2, which repeats the figures of the paper (1 is the law as it is printed there). Beyond lod200_scale the further reduction takes at least 4.';
COMMENT ON COLUMN typify_options.psi IS
'How far the sizes of the coarse level pull the sizes of placeholders (paper, section on size). At most 1; default 0.75. See typify_psi.';
COMMENT ON COLUMN typify_options.count IS
'How many placeholders, instead of the law. At least 1.';
COMMENT ON COLUMN typify_options.min_distance IS
'Go on until the shortest edge between placeholders is at least this long, in units of the SRID. Alone it decides; with count, count_rule or exponent set, both conditions must hold. 0 is no condition.';
COMMENT ON COLUMN typify_options.count_rule IS
'radical (default; Toepfer and Pillewizer 1966) or black_white (paper: keeps the share of ink, n / greatest area factor up to the scale; all n where areas are 0).';
COMMENT ON COLUMN typify_options.area_statistic IS
'What a placeholder takes from the areas of its members: mean (default, paper), median, or sum: their plain sum without the area factor.';
COMMENT ON COLUMN typify_options.shape IS
'rectangle (default, paper: ratio and direction of the representative), square (of equal area), footprint (the representative''s own outline, of several parts the largest, scaled to the area about its centroid; width and length are those of its minimum-area rectangle, which is drawn where the outline is no valid polygon) or auto (kept buildings, see keep_area and importance, with their own outline, simplified by ST_SimplifyPreserveTopology where detours are shorter than 0.1 mm on the map (which corners remain may depend on the version of GEOS), and their own area; all others as rectangles).';
COMMENT ON COLUMN typify_options.min_area IS
'A building smaller than this (a shed) adds nothing to count, position or mean; it is a member of the placeholder whose centre is nearest to its centroid, of equally near ones the first. A group of such buildings alone is one row with geom NULL. A kept building is no shed. Square units of the SRID; 0, the default, is off.';
COMMENT ON COLUMN typify_options.min_side IS 
'Shortest side of a placeholder, mm on the map (usual: 0.35); 0 is none. A shorter side is enlarged to it; the long side is then at least min(1 / ratio, 1.5) times as long, and of a placeholder of several members the ratio is at least 1/3. Points and lines get this size too.';
COMMENT ON COLUMN typify_options.max_area IS 
'Largest area that a placeholder is enlarged to, mm2 on the map; one that is larger by the unscaled statistic of its members'' areas keeps that. Default 2 * min_side^2 where min_side is set; 0 is no limit.';
COMMENT ON COLUMN typify_options.keep_area IS 
'Buildings whose true area on the map is at least this are kept, as those of importance ''Infinity'' are: each in its place, with its own area, whatever it has absorbed; two of them are not merged. mm2 (usual: 0.5); 0, the default, is off. Their number depends on the scale, so the count may not be reached. psi is calibrated without it.';
COMMENT ON COLUMN typify_options.min_gap IS 
'Smallest gap between placeholders, mm on the map (usual: 0.2); 0 is none, and then they may overlap. Those that are nearer are shrunk to their true size, moved by at most the gap or half their longer side, shrunk to min_side (without min_side no further), and at last merged, so that there may be fewer than the count.';
COMMENT ON COLUMN typify_options.alignment IS
'Keeps rows of buildings (see typify_rows): an edge that leaves a row counts 1 + alignment times as long as one inside it, merges go evenly along a row, and what is left of it is laid out evenly on its line. At least 0; default 0, which is off; 4 keeps both sides of a street apart up to a fourth of the buildings. Rows are found among the buildings of a group.';
COMMENT ON COLUMN typify_options.barriers IS
'Lines that nothing is merged across, even where the count cannot be reached then: the roads, rivers, railways that are drawn at the target scale. Lines and polygons (whose rings count), multi and collections of them (points in a collection are passed over), with the SRID of the buildings; EMPTY is none. What lies exactly on a line belongs to its right side, of a horizontal one to the upper side. Pass large ones as a scalar sub-select: they are then read, kept and indexed once for all groups.';
COMMENT ON COLUMN typify_options.barrier_width IS
'Width of the line symbol of barriers, mm on the map; default 0. It counts where min_gap does.';

CREATE TYPE typify_placeholder AS (
	id bigint,
	geom geometry,
	member_count integer,
	members bigint[],
	area double precision,
	width double precision,
	length double precision,
	orientation double precision
);

COMMENT ON TYPE typify_placeholder IS
'A placeholder building. id: of its representative, the member with the largest area. geom: its rectangle, NULL when it has no size and is not drawn. member_count, members: how many and which buildings it represents, ids ascending. area, width, length: square units and units of the SRID. orientation: of the longer side, degrees in [0, 180) counter-clockwise from the x axis.';

CREATE TYPE typify_site AS (
	id bigint,
	geom geometry,
	member_count integer,
	members bigint[],
	area double precision,
	width double precision,
	length double precision,
	orientation double precision,
	site double precision[]
);

COMMENT ON TYPE typify_site IS
'A typify_placeholder on its way to where all groups of a layer are made legible. site: numbers that typify_settle understands: where it belongs, how it may be moved and shrunk, and how far it was.';

CREATE TYPE typify_settled AS (
	id bigint,
	drawn boolean,
	geom geometry,
	width double precision,
	length double precision,
	factor double precision,
	x double precision,
	y double precision,
	heir bigint
);

COMMENT ON TYPE typify_settled IS
'What typify_settle did to a placeholder. drawn: false where there was no room. geom: its rectangle; NULL for one that is drawn as an outline: that is scaled by factor about the origin and then shifted by x and y. width, length: as they are now. heir: the id of the placeholder that takes over the members of one that is not drawn; NULL where all of its group are not.';

CREATE FUNCTION typify_options(
	source_scale double precision DEFAULT NULL,
	lod200_scale double precision DEFAULT NULL,
	exponent double precision DEFAULT NULL,
	psi double precision DEFAULT NULL,
	count bigint DEFAULT NULL,
	min_distance double precision DEFAULT NULL,
	count_rule text DEFAULT NULL,
	area_statistic text DEFAULT NULL,
	shape text DEFAULT NULL,
	min_area double precision DEFAULT NULL,
	min_side double precision DEFAULT NULL,
	max_area double precision DEFAULT NULL,
	keep_area double precision DEFAULT NULL,
	min_gap double precision DEFAULT NULL,
	alignment double precision DEFAULT NULL,
	barriers geometry DEFAULT NULL,
	barrier_width double precision DEFAULT NULL)
RETURNS typify_options
AS 'MODULE_PATHNAME'
LANGUAGE C IMMUTABLE PARALLEL SAFE;

COMMENT ON FUNCTION typify_options IS
'Makes options, by name: typify_options(exponent => 1, shape => ''square''). Arguments that are left out stay NULL, which means unset. Fields and units: see the type of the same name. Errors: 22023 for a value that is not allowed, naming the argument, the value and what is allowed.';
