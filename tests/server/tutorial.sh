#!/bin/bash
# tutorial.sh - the fear: who follows doc/two-levels.md meets a command that fails, or other numbers than the page
# prints. Runs its blocks in order and compares. Uses the server of the PG* variables.
# PICTURES: a folder that gets the page's picture. UPDATE: 1 writes what the commands print into the page.
. "$(dirname "$0")/common.sh"
page=doc/two-levels.md

for program in ogr2ogr rsvg-convert; do
	command -v $program >/dev/null ||
		{ echo "skipped: no $program; Debian has it in gdal-bin or librsvg2-bin"; exit 77; }
done
psql -qXAt -c "SELECT datname FROM pg_database WHERE datname = 'two_levels'" postgres | grep . &&
	{ echo "failed: there is a database two_levels already"; exit 1; }
OWN_DATABASES+=(two_levels)

# the page is read at the top of the sources, and leaves files there: this is their stand-in
mkdir "$OWN_FOLDER/blocks" "$OWN_FOLDER/top"
split_page $page "$OWN_FOLDER/blocks"
cp -r tests "$OWN_FOLDER/top/"
blocks=0 compared=0 line=
finished() { # a block that fails ends the test, one of sh while its output goes to a file
	local status=$?
	clean_up
	[ $status = 0 ] || [ -z "$line" ] || echo "failed: $page, block of line $line" >&2
}
trap finished EXIT
for block in "$OWN_FOLDER"/blocks/*.s[qh]*; do
	case $block in *.text) continue ;; esac
	line=$(basename "${block%.*}")
	cd "$OWN_FOLDER/top"
	case $block in
		*.sql) sql -f "$block" >"$OWN_FOLDER/printed" ;;
		*.sh) . "$block" >"$OWN_FOLDER/printed" ;;
	esac
	cd - >/dev/null
	blocks=$((blocks + 1))
	[ -f "$block.text" ] || continue
	# psql pads columns, and ends with an empty line
	sed -i -e 's/ *$//' -e '${/^$/d}' "$OWN_FOLDER/printed"
	mv "$OWN_FOLDER/printed" "$block.printed"
	compared=$((compared + 1))
	[ "${UPDATE:-}" != 1 ] || continue
	if ! diff -u --label "$page" --label printed "$block.text" "$block.printed"; then
		echo "failed: $page prints something else under the block of line $line"
		FAILED=1
	fi
done
line=
echo "$blocks blocks ran, $compared compared with what the page prints"
check "panels of the picture" "$(grep -c '<rect .*fill="none" stroke="#888"' "$OWN_FOLDER/top/two-levels.svg")" 4
[ -z "${PICTURES:-}" ] || cp "$OWN_FOLDER/top/two-levels.png" "$PICTURES/"
if [ "${UPDATE:-}" = 1 ]; then
	awk -v folder="$OWN_FOLDER/blocks" '
		/^```[a-z]+$/ {
			language = substr($0, 4)
			if (language != "text") last = sprintf("%s/%04d.%s", folder, NR, language)
			print
			if (language == "text") {
				while ((getline line <(last ".printed")) > 0) print line
				skipping = 1
			}
			next
		}
		/^```$/ { skipping = 0 }
		!skipping' $page >"$OWN_FOLDER/page"
	cp "$OWN_FOLDER/page" $page
fi
exit $FAILED
