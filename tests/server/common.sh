# common.sh - what the tests that need a server share; to be sourced (it is not executable, so it is no test itself).
# Goes to the checkout's top; the server is that of the PG* variables.

set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
export PGOPTIONS='-c client_min_messages=warning'
OWN_FOLDER=$(mktemp -d)
OWN_DATABASE=
clean_up() {
	if [ -n "$OWN_DATABASE" ]; then dropdb --if-exists "$OWN_DATABASE"; fi
	rm -rf "$OWN_FOLDER"
}
trap clean_up EXIT

# fresh_database NAME [FILE...]: a database with the extension and what the SQL files make, gone when the test ends.
# A database of that name that is there already is not ours: that is an error.
fresh_database() {
	createdb "$1"
	OWN_DATABASE=$1
	export PGDATABASE=$1
	sql -o /dev/null -c 'CREATE EXTENSION typify CASCADE'
	local file
	for file in "${@:2}"; do sql -o /dev/null -f "$file"; done
}

sql() { psql -qX -v ON_ERROR_STOP=1 "$@"; }
answer() { sql -At -c "$1"; }

# check WHAT FOUND EXPECTED: prints both, remembers a difference in FAILED
FAILED=0
check() {
	if [ "$2" = "$3" ]; then
		echo "ok: $1: $2"
	else
		echo "failed: $1: $2, expected $3"
		FAILED=1
	fi
}

# split_page PAGE FOLDER: the fenced blocks of a page, each in a file named by its line and its language:
# 0012.sql, 0020.sh, and what a block prints, where a block of text follows it, as 0012.sql.text
split_page() {
	awk -v folder="$2" '
		/^```[a-z]+$/ {
			language = substr($0, 4)
			file = sprintf("%s/%04d.%s", folder, NR, language)
			if (language == "text") file = last == "" ? "/dev/null" : last ".text"
			printf "" >file
			inside = 1
			next
		}
		/^```$/ { close(file); inside = 0; last = language == "text" ? "" : file; next }
		inside { print >file }
		!inside && NF { last = "" }' "$1"
}
