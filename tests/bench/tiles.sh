# tiles.sh - vector tiles of a hierarchy beside those of the buildings themselves; to be sourced by run.sh. TILES: how
# many. Of a set without a coordinate system the buildings are taken to stand in UTM zone 33.

TILES=${TILES:-1000}

# tile_figures SET CONDITION WORD: what a line of the table is made of
tile_figures() {
	sql -F $'\t' -c "
		SELECT '$1', 'tiles $3 ' || figure, value FROM (
			SELECT count(*) AS n, percentile_disc(0.5) WITHIN GROUP (ORDER BY buildings) AS buildings,
				percentile_disc(ARRAY[0.5, 0.99]) WITHIN GROUP (ORDER BY plain) AS plain,
				percentile_disc(ARRAY[0.5, 0.99]) WITHIN GROUP (ORDER BY ours) AS ours,
				percentile_disc(0.5) WITHIN GROUP (ORDER BY plain / ours) AS faster,
				sum(plain_bytes) / sum(our_bytes)::float8 AS smaller
			FROM bench_times WHERE $2
		) AS t, LATERAL (VALUES ('n', n), ('buildings', buildings), ('plain 50', plain[1]), ('plain 99', plain[2]),
			('ours 50', ours[1]), ('ours 99', ours[2]), ('faster', faster), ('smaller', smaller)) AS f (figure, value)
		WHERE n > 0" >>"$RESULTS"
}

tile_runs() { # tile_runs SET
	local zoom
	sql -c "CREATE TABLE bench_tiled AS SELECT id, CASE ST_SRID(geom) WHEN 0
			THEN ST_SetSRID(ST_Translate(geom, 400000, 5600000), 32633) ELSE geom END AS geom FROM bench_$1" \
		-c 'ALTER TABLE bench_tiled ADD PRIMARY KEY (id)' -c 'CREATE INDEX ON bench_tiled USING gist (geom)' \
		-c 'VACUUM ANALYZE bench_tiled'
	say "$1: hierarchy"
	sql -c "\\timing on" -c "CALL typify_build_hierarchy('bench_hierarchy', 'bench_tiled', 0.5)" |
		awk -v set="$1" -v OFS='\t' '/^Time:/ { print set, "tiles built", $2 / 1000 }' >>"$RESULTS"
	sql -f tiles.sql -o /dev/null -c "SELECT typify_create_tile_function('public', 'bench_tiles', 'bench_hierarchy')"
	say "$1: $TILES tiles"
	sql -c "CALL bench_time_tiles($TILES)"
	for zoom in 8 9 10 11 12 13 14 15 16; do tile_figures "$1" "z = $zoom" $zoom; done
	tile_figures "$1" true all
	sql -c 'DROP TABLE bench_hierarchy, bench_hierarchy_groups, bench_tiled, bench_times' \
		-c 'DROP FUNCTION bench_tiles, bench_plain_tile, bench_asked, bench_milliseconds' -c 'DROP PROCEDURE bench_time_tiles'
}
