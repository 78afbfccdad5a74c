-- 20-formulas.sql: the formulas of the method alone, for use and for teaching

CREATE FUNCTION typify_count(n bigint, scale double precision, options typify_options DEFAULT NULL)
RETURNS bigint
AS 'MODULE_PATHNAME'
LANGUAGE C IMMUTABLE PARALLEL SAFE;

COMMENT ON FUNCTION typify_count(bigint, double precision, typify_options) IS
'How many of n buildings remain at a scale (its denominator): floor(n * (m25 / m_r)^(x/2)), at least 1 and at most n, by the radical law (Toepfer and Pillewizer 1966; paper, section on positioning), by the black-white rule (buildings are taken to have an area) or as options.count says. NULL for a NULL n or scale. Errors: 22023 for n below 0, a scale below source_scale, or when min_distance alone says when to stop.';

CREATE FUNCTION typify_scale_below(
	n bigint,
	count bigint,
	options typify_options DEFAULT NULL)
RETURNS double precision
AS 'MODULE_PATHNAME'
LANGUAGE C IMMUTABLE PARALLEL SAFE;

COMMENT ON FUNCTION typify_scale_below(bigint, bigint, typify_options) IS
'The scale from which on fewer than count of n buildings remain: the smallest number at which typify_count is below count, exactly; at the one just before it is not. At least source_scale; Infinity where count is 1 or less. NULL for a NULL n or count. Errors: 22023 for a negative n or count, and for options that make the count depend on more than the scale: count, min_distance, the black-white rule.';

CREATE FUNCTION typify_area_factor(scale double precision, options typify_options DEFAULT NULL)
RETURNS double precision
AS 'MODULE_PATHNAME'
LANGUAGE C IMMUTABLE PARALLEL SAFE;

COMMENT ON FUNCTION typify_area_factor(double precision, typify_options) IS
'f_area (paper, section on size): by how much the area of a placeholder on the ground exceeds the mean area of its members at a scale, (m_r^2 / m25^2) * (1 - psi * (m_r - m25) / (m200 - m25)); the fraction is held at 1 beyond m200. 1 at m_r = m25. NULL for a NULL scale. Errors: 22023 for a scale below source_scale; 22003 on overflow.';

CREATE FUNCTION typify_psi(
	mean_placeholder_area double precision,
	mean_area_lod200 double precision,
	m25 double precision DEFAULT 25000,
	m200 double precision DEFAULT 200000)
RETURNS double precision
AS 'MODULE_PATHNAME'
LANGUAGE C IMMUTABLE STRICT PARALLEL SAFE;

COMMENT ON FUNCTION typify_psi(double precision, double precision, double precision, double precision) IS
'psi = 1 - (m25^2 / m200^2) * mean_area_lod200 / mean_placeholder_area (paper, section on size), so that the mean placeholder at m200 is as large as the mean object of the coarse level of detail. mean_placeholder_area: mean, over the placeholders at m200, of the unscaled mean of their members; area_statistic => ''mean'' divided by typify_area_factor(m200) gives it. Areas in square ground units, both above 0 (the second may be 0). Errors: 22023.';

CREATE FUNCTION typify_rectangle(
	center geometry,
	area double precision,
	ratio double precision,
	orientation double precision)
RETURNS geometry
AS 'MODULE_PATHNAME'
LANGUAGE C IMMUTABLE STRICT PARALLEL SAFE;

COMMENT ON FUNCTION typify_rectangle(geometry, double precision, double precision, double precision) IS
'A rectangle as typify draws it: POLYGON around center (a POINT, whose SRID it takes; NULL when it is EMPTY), of this area (square units of the SRID, above 0), ratio of the shorter to the longer side (above 0, at most 1) and orientation of the longer side (degrees counter-clockwise from the x axis). Errors: 22023 for other values, for a center that is no point, and for a geographic SRID.';

CREATE FUNCTION typify_metres_per_unit(srid integer) RETURNS double precision
LANGUAGE sql STABLE STRICT PARALLEL SAFE
BEGIN ATOMIC
	SELECT coalesce((
		SELECT CASE
			WHEN proj4text ~ '\+proj=(longlat|latlong)' THEN 'NaN'::double precision
			WHEN proj4text ~ '\+to_meter=[0-9.]+'
				THEN substring(proj4text FROM '\+to_meter=([0-9.]+)')::double precision
			WHEN proj4text ~ '\+units=us-ft' THEN 1200 / 3937.0
			WHEN proj4text ~ '\+units=ft' THEN 0.3048
			WHEN proj4text ~ '\+units=km' THEN 1000
			ELSE 1 END
		FROM spatial_ref_sys AS ref WHERE ref.srid = typify_metres_per_unit.srid), 1);
END;
COMMENT ON FUNCTION typify_metres_per_unit(integer) IS
'Metres in a unit of a reference system: 0.3048 for feet, 1 where it is not known, NaN for degrees';

CREATE FUNCTION typify_zoom_scale(zoom double precision, latitude double precision, tile_size integer DEFAULT 512)
RETURNS double precision
LANGUAGE sql IMMUTABLE STRICT PARALLEL SAFE
BEGIN ATOMIC
	SELECT 2 * pi() * 6378137 / tile_size / 0.00028 * cos(radians(latitude)) / power(2::double precision, zoom);
END;
COMMENT ON FUNCTION typify_zoom_scale(double precision, double precision, integer) IS
'The denominator of the scale at which a web map (Web Mercator) shows a latitude (degrees) at a zoom, on a screen of 0.28 mm a pixel as OGC takes it. tile_size: pixels that a side of a tile takes on the screen: 512 in MapLibre, Mapbox GL and OpenLayers, 256 for raster tiles. typify_zoom_scale(11, 49.5) is 88 646.';
