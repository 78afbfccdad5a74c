#!/bin/bash
# tiles.sh - the fear: at the border of two tiles a building jumps, is cut off or is missing. Decodes all tiles of the
# sample from zoom 15 to 19, where a source scale of 1:250 has them made of a hierarchy. Uses the server of the PG*
# variables.
. "$(dirname "$0")/common.sh"

fresh_database typify_tiles tests/data/settlement.sql
sql -o /dev/null -c "CALL typify_build_hierarchy('any_scale', 'settlement_buildings', 0.5, 'block',
	typify_options(source_scale => 250, exponent => 0.5))" \
	-c "SELECT typify_create_tile_function('public', 'tiles', 'any_scale', max_zoom => 19)"
sql -At -F ' ' -c "
	SELECT z, x, y, encode(tile, 'hex')
	FROM generate_series(15, 19) AS z,
		(SELECT ST_Transform(ST_SetSRID(ST_Expand(ST_Extent(geom)::geometry, 100), 25832), 3857) AS e
			FROM settlement_buildings) AS extent,
		LATERAL (SELECT 40075016.685578488 / 2 ^ z AS side) AS size,
		generate_series(floor((ST_XMin(e) + 20037508.342789244) / side)::integer,
			floor((ST_XMax(e) + 20037508.342789244) / side)::integer) AS x,
		generate_series(floor((20037508.342789244 - ST_YMax(e)) / side)::integer,
			floor((20037508.342789244 - ST_YMin(e)) / side)::integer) AS y,
		LATERAL (SELECT tiles(z, x, y) AS tile OFFSET 0) AS t
	WHERE tile <> ''" >"$OWN_FOLDER/tiles"
read -r _ tiles _ borders _ shared _ other _ features < <(python3 tests/server/tile_borders.py <"$OWN_FOLDER/tiles")
echo "$tiles tiles, $borders borders with $shared placeholders on both sides, $features placeholders"
check "borders that are looked at, 1000 or more" "$((borders >= 1000))" 1
check "placeholders that are another polygon in the next tile" "$other" 0
check "placeholders of all zooms, each in a tile" "$features" "$(answer "
	SELECT count(*) FROM generate_series(15, 19) AS z, any_scale AS n JOIN any_scale_groups AS g USING (group_id)
	WHERE n.scale_from <= typify_zoom_scale(z, g.latitude) AND n.scale_to > typify_zoom_scale(z, g.latitude)")"
exit $FAILED
