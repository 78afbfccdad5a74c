# common.sh - what the tests that need a server share; to be sourced (it is not executable, so it is no test itself).
# Goes to the checkout's top; the server is that of the PG* variables.

set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
export PGOPTIONS='-c client_min_messages=warning'
OWN_FOLDER=$(mktemp -d)
OWN_DATABASES=()
OWN_ROLES=()
clean_up() {
	local name
	for name in ${OWN_DATABASES[@]+"${OWN_DATABASES[@]}"}; do dropdb --if-exists -f "$name"; done
	for name in ${OWN_ROLES[@]+"${OWN_ROLES[@]}"}; do dropuser --if-exists "$name"; done
	rm -rf "$OWN_FOLDER"
}
trap clean_up EXIT

# own_database NAME, own_role NAME: made now, gone when the test ends. Of that name there must be none yet: it would not
# be ours.
own_database() {
	createdb -T template0 "$1"
	OWN_DATABASES+=("$1")
}
own_role() {
	createuser "$1"
	OWN_ROLES+=("$1")
}

# fresh_database NAME [FILE...]: a database of its own, with the extension and what the SQL files make
fresh_database() {
	own_database "$1"
	export PGDATABASE=$1
	sql -o /dev/null -c 'CREATE EXTENSION typify CASCADE'
	local file
	for file in "${@:2}"; do sql -o /dev/null -f "$file"; done
}

# need_real FOLDER LAYER...: real data in TYPIFY_DATA, by default ../shared/data beside the project; skips the test
# (exit status 77) where a layer of it is missing
need_real() {
	REAL_DATA=${TYPIFY_DATA:-../shared/data}/$1
	local layer
	for layer in "${@:2}"; do
		[ -r "$REAL_DATA/$layer.csv.gz" ] || { echo "skipped: no $REAL_DATA/$layer.csv.gz (TYPIFY_DATA)"; exit 77; }
	done
}
# load_real LAYER...: tables of the folder that was needed last, (id, class, geom), with a spatial index
load_real() {
	local layer
	for layer in "$@"; do
		sql -c "CREATE TABLE $layer (id bigint PRIMARY KEY, class text, geom geometry NOT NULL)" \
			-c "\\copy $layer FROM PSTDIN WITH (FORMAT csv, HEADER true)" -c "CREATE INDEX ON $layer USING gist (geom)" \
			-c "ANALYZE $layer" < <(gzip -dc "$REAL_DATA/$layer.csv.gz")
	done
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

# holds WHAT QUERY: the query must answer t
holds() { check "$1" "$(answer "$2" 2>&1 || true)" t; }

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
