# page.sh - runs the commands of a tutorial; to be sourced after common.sh

# run_page PAGE DATABASE PROGRAM...: runs the blocks of a page in order, in a copy of what they need in $OWN_FOLDER/top, and
# compares what they print; DATABASE is what the page creates, PROGRAMs what it calls. UPDATE: 1 writes what the commands
# print into the page. A block that fails ends the test.
run_page() {
	local page=$1 database=$2 program block blocks=0 compared=0
	for program in "${@:3}"; do
		command -v "$program" >/dev/null ||
			{ echo "skipped: no $program; Debian has it in gdal-bin or librsvg2-bin"; exit 77; }
	done
	psql -qXAt -c "SELECT datname FROM pg_database WHERE datname = '$database'" postgres | grep . &&
		{ echo "failed: there is a database $database already"; exit 1; }
	OWN_DATABASES+=("$database")
	# the page is read at the top of the sources, and leaves files there: this is their stand-in
	mkdir "$OWN_FOLDER/blocks" "$OWN_FOLDER/top"
	split_page "$page" "$OWN_FOLDER/blocks"
	cp -r tests "$OWN_FOLDER/top/"
	PAGE=$page LINE=
	trap page_ended EXIT
	for block in "$OWN_FOLDER"/blocks/*.s[qh]*; do
		case $block in *.text) continue ;; esac
		LINE=$(basename "${block%.*}")
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
			echo "failed: $page prints something else under the block of line $LINE"
			FAILED=1
		fi
	done
	LINE=
	echo "$blocks blocks ran, $compared compared with what the page prints"
	[ "${UPDATE:-}" != 1 ] || update_page
}

page_ended() { # a block that fails ends the test, one of sh while its output goes to a file
	local status=$?
	clean_up
	[ $status = 0 ] || [ -z "$LINE" ] || echo "failed: $PAGE, block of line $LINE" >&2
}

update_page() {
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
		!skipping' "$PAGE" >"$OWN_FOLDER/page"
	cp "$OWN_FOLDER/page" "$PAGE"
}
