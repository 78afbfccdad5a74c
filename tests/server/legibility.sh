#!/bin/bash
# legibility.sh - the fear: doc/legibility.md shows what typify no longer does. Draws its pictures and compares its
# figures. Uses the server of the PG* variables, and for Liechtenstein the data in TYPIFY_DATA, by default ../shared/data
# beside the project; without them the sample alone is drawn.
# PICTURES: a folder that gets the pictures. UPDATE: 1 writes the figures into the page.
. "$(dirname "$0")/common.sh"
page=doc/legibility.md
pictures="rows important sizes gaps all"
REAL_DATA=${TYPIFY_DATA:-../shared/data}/liechtenstein_2024
scene='CREATE TABLE scene (name text, scale float8, magnify float8, frame geometry)'

make_sample() {
	fresh_database typify_legibility_sample tests/data/settlement.sql
	sql <<-SQL
		CREATE VIEW buildings AS SELECT id, class, geom FROM settlement_buildings;
		CREATE VIEW roads AS SELECT class, geom FROM settlement_roads;
		$scene;
		INSERT INTO scene SELECT name, scale, magnify, ST_MakeEnvelope(x0, y0, x1, y1, 25832) FROM (VALUES
			('rows', 50000, 6, 613250, 5487860, 613660, 5488300), ('important', 75000, 5, 614700, 5486380, 615500, 5486860),
			('sizes', 100000, 5, 614050, 5487100, 615300, 5487800), ('gaps', 50000, 4, 613500, 5487130, 614200, 5487700),
			('all', 50000, 4, 613500, 5487130, 614200, 5487700)) AS v (name, scale, magnify, x0, y0, x1, y1);
	SQL
}

make_liechtenstein() {
	fresh_database typify_legibility_liechtenstein
	load_real buildings roads
	sql <<-SQL
		$scene;
		INSERT INTO scene SELECT name, scale, magnify, ST_MakeEnvelope(x0, y0, x1, y1, 2056) FROM (VALUES
			('rows', 50000, 6, 2755800, 1214000, 2756250, 1214350), ('important', 75000, 5, 2757600, 1222400, 2758400, 1223000),
			('sizes', 100000, 5, 2757300, 1220700, 2758600, 1221500), ('gaps', 50000, 4, 2757600, 1222400, 2758300, 1223000),
			('all', 50000, 4, 2757600, 1222400, 2758300, 1223000)) AS v (name, scale, magnify, x0, y0, x1, y1);
	SQL
}

# note PLACE: the figures of every picture, each in a file of its own, line by line
note() {
	local picture
	for picture in $pictures; do
		{
			echo "$1 without: $(answer "SELECT figures('$picture', false)")"
			echo "$1 with:    $(answer "SELECT figures('$picture', true)")"
		} >>"$OWN_FOLDER/$picture.figures"
	done
}

# draw PLACE ATTRIBUTION
draw() {
	local picture place=${1,,} svg
	sql -o /dev/null -f doc/legibility.sql
	for picture in $pictures; do
		svg=$OWN_FOLDER/$place-$picture.svg
		PGOPTIONS="$PGOPTIONS -c legibility.attribution=$(sed 's/ /\\ /g' <<<"$2")" answer "SELECT picture('$picture')" >"$svg"
		check "panels of $place-$picture" "$(grep -c '<rect .*fill="none" stroke="#888"' "$svg")" 3
		[ -z "${PICTURES:-}" ] || rsvg-convert --unlimited -d 150 -p 150 "$svg" -o "$PICTURES/legibility-$place-$picture.png"
	done
	note "$1"
}

# what the page tells to type runs
run_page() {
	local block
	mkdir "$OWN_FOLDER/blocks"
	split_page $page "$OWN_FOLDER/blocks"
	for block in "$OWN_FOLDER"/blocks/*.sql; do
		sql -o /dev/null -f "$block" || { echo "failed: $page, block of line $(basename "${block%.*}")"; FAILED=1; }
	done
}

make_sample
run_page
draw Sample ''
if [ -r "$REAL_DATA/buildings.csv.gz" ]; then
	make_liechtenstein
	draw Liechtenstein '(c) OpenStreetMap contributors, ODbL'
else
	echo "left out: Liechtenstein, no $REAL_DATA (TYPIFY_DATA)"
fi

# with_figures: the page, with the figures that were found, and where a place was left out with those that were there
with_figures() {
	awk -v folder="$OWN_FOLDER" '
		/^<!-- figures/ { file = folder "/" $3 ".figures" }
		/^```text$/ { print; while ((getline line <file) > 0) { print line; split(line, word, " "); found[word[1]] = 1 } close(file); inside = 1; next }
		/^```$/ { inside = 0; delete found }
		inside { split($0, word, " "); if (word[1] in found) next }
		{ print }' $page
}
with_figures >"$OWN_FOLDER/page"
if [ "${UPDATE:-}" = 1 ]; then
	cp "$OWN_FOLDER/page" $page
elif diff -u --label "$page" --label found $page "$OWN_FOLDER/page"; then
	echo "ok: figures are those of the page"
else
	echo "failed: $page says other figures"
	FAILED=1
fi
exit $FAILED
