-- maps.sql: what the web map shows, in a database of its own that has tables buildings (id, geom) and roads (class, geom):
-- a hierarchy for each density control, their tile functions, and what the server asks besides.
--
-- On a screen nothing is smaller than 3 pixels, far more than paper needs. Exponent 4 keeps the share of ink where sizes are
-- fixed on the map, so that towns do not turn black. And all buildings are one group, since every group keeps at least
-- one placeholder, at 1:1 000 000 still.
SET client_min_messages = warning;
CREATE SCHEMA maps;

CALL typify_build_hierarchy('maps.hierarchy_0', 'buildings', 0, options => typify_options(exponent => 4));
CALL typify_build_hierarchy('maps.hierarchy_25', 'buildings', 0.25, options => typify_options(exponent => 4));
CALL typify_build_hierarchy('maps.hierarchy_50', 'buildings', 0.5, options => typify_options(exponent => 4));
CALL typify_build_hierarchy('maps.hierarchy_75', 'buildings', 0.75, options => typify_options(exponent => 4));
CALL typify_build_hierarchy('maps.hierarchy_100', 'buildings', 1, options => typify_options(exponent => 4));

CREATE TABLE web_maps AS
SELECT s_u, typify_create_tile_function('maps', 'tiles_' || 100 * s_u, ('maps.hierarchy_' || 100 * s_u)::regclass,
	layer => 'buildings')::regproc::text AS tiles, 'maps.hierarchy_' || 100 * s_u AS hierarchy, 'buildings' AS buildings
FROM unnest(ARRAY[0, 0.25, 0.5, 0.75, 1]::float8[]) AS s_u;

-- outlines: the first zoom whose scale is above that of the buildings everywhere
CREATE FUNCTION web_about() RETURNS json LANGUAGE sql STABLE AS $$
	SELECT json_build_object('layer', 'buildings', 's_u', (SELECT json_agg(s_u ORDER BY s_u) FROM web_maps),
		'outlines', (SELECT min(zoom) FROM generate_series(0, 24) AS zoom
			WHERE typify_zoom_scale(zoom, (SELECT min(abs(latitude)) FROM maps.hierarchy_50_groups)) < 25000),
		'bounds', json_build_array(ST_XMin(e), ST_YMin(e), ST_XMax(e), ST_YMax(e)))
	FROM (SELECT ST_Transform(ST_SetSRID(ST_Extent(geom)::geometry, max(ST_SRID(geom))), 4326) AS e FROM buildings) AS extent
$$;

CREATE FUNCTION web_collection(features json) RETURNS json LANGUAGE sql IMMUTABLE AS $$
	SELECT json_build_object('type', 'FeatureCollection', 'features', coalesce(features, '[]'))
$$;

CREATE FUNCTION web_feature(geom geometry, properties json) RETURNS json LANGUAGE sql STABLE AS $$
	SELECT json_build_object('type', 'Feature', 'properties', properties,
		'geometry', ST_AsGeoJSON(ST_Transform(geom, 4326), 7)::json)
$$;

CREATE FUNCTION web_roads() RETURNS json LANGUAGE sql STABLE AS $$
	SELECT web_collection(json_agg(web_feature(geom, json_build_object('class', class)))) FROM roads
$$;

-- the placeholder that this building represents at a zoom, and whose tile shows it at this place
CREATE FUNCTION web_members(hierarchy regclass, buildings regclass, id bigint, zoom float8, lng float8, lat float8)
RETURNS json LANGUAGE plpgsql STABLE AS $$
DECLARE
	srid integer := (SELECT ST_SRID(geom) FROM buildings LIMIT 1);
	place geometry := ST_Expand(ST_Transform(ST_SetSRID(ST_MakePoint(lng, lat), 4326), srid), 1);
	scales float8[];
	features json;
BEGIN
	EXECUTE format('SELECT array_agg(DISTINCT typify_zoom_scale($1, latitude)) FROM %s_groups WHERE extent && ST_Expand($2, 5000)',
		hierarchy) INTO scales USING zoom, place;
	EXECUTE format('SELECT json_agg(web_feature(b.geom, ''{}'')) FROM %s AS b WHERE b.id = ANY ((
		SELECT p.members FROM unnest($1) AS scale, typify_at($2, greatest(25000, scale), ST_Expand($3, 0.003 * scale)) AS p
		WHERE p.id = $4 ORDER BY p.member_count DESC LIMIT 1)::bigint[])', buildings)
	INTO features USING scales, hierarchy, place, id;
	RETURN web_collection(features);
END $$;
