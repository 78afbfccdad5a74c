# common.sh - what the set-up scripts share; to be sourced. Gives ROOT (the checkout), after choose_version VERSION
# (of PostgreSQL), and after make_workspace WORKSPACE: a world-readable folder that is gone when the script ends,
# however it ends.

set -euo pipefail
ROOT=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

# A minimal system has no other locale; the caller's make must not speak to ours.
export LC_ALL=C.UTF-8 LANG=C.UTF-8
unset MAKEFLAGS MFLAGS MAKEOVERRIDES MAKELEVEL
export USER=$(id -un)
umask 022
# The server that root starts runs as postgres, who could not enter a private folder.
if [ "$(id -u)" = 0 ]; then export TMPDIR=/tmp; fi

fail() {
	echo "typify: $*" >&2
	exit 1
}

# --- ending well ---

CHILD=
OWN_WORKSPACE=
clean_up() {
	trap '' EXIT HUP INT TERM
	# a server drops its cluster when it is told to stop; the files it reads must be there until then
	if [ -n "$CHILD" ]; then kill -TERM "$CHILD" 2>/dev/null && wait "$CHILD" || true; fi
	cd /
	if [ -n "$OWN_WORKSPACE" ]; then rm -rf "$OWN_WORKSPACE"; fi
}
trap clean_up EXIT
trap 'clean_up; exit 129' HUP
trap 'clean_up; exit 130' INT
trap 'clean_up; exit 143' TERM

make_workspace() {
	WORKSPACE=$(mktemp -d "${TMPDIR:-/tmp}/typify.XXXXXX")
	OWN_WORKSPACE=$WORKSPACE
	chmod 0755 "$WORKSPACE"
	export TMPDIR=$WORKSPACE
}

# bounded SECONDS COMMAND...: nothing runs for ever, and a signal to this script ends the command at once
bounded() {
	local status=0
	timeout --kill-after=60 "$@" &
	CHILD=$!
	wait "$CHILD" || status=$?
	CHILD=
	return $status
}

# --- packages ---

# The version asked for, else the newest server here, else the one that this Debian comes with.
choose_version() {
	VERSION=${PGVERSION:-}
	if [ -z "$VERSION" ]; then VERSION=$(newest_version_here || true); fi
	if [ -z "$VERSION" ]; then VERSION=$(packaged_version || true); fi
	if [ -z "$VERSION" ] && may_install; then
		apt_get update >/dev/null 2>&1 && VERSION=$(packaged_version || true)
	fi
	VERSION=${VERSION:-15}
	case $VERSION in 14 | 15 | 16 | 17 | 18) ;; *) fail "PGVERSION is $VERSION, but must be one of 14 to 18" ;; esac
	export PG_CONFIG=/usr/lib/postgresql/$VERSION/bin/pg_config
	SERVER_PACKAGES="gcc libc6-dev postgresql-$VERSION postgresql-server-dev-$VERSION postgresql-$VERSION-postgis-3"
}
newest_version_here() { ls -d /usr/lib/postgresql/*/bin/postgres 2>/dev/null | cut -d/ -f5 | sort -n | tail -n 1; }
packaged_version() { apt-cache depends postgresql 2>/dev/null | sed -n 's/.*Depends: postgresql-\([0-9]*\)$/\1/p'; }

PICTURE_PACKAGES="librsvg2-bin fonts-dejavu-core"
FUZZ_PACKAGES="gcc libc6-dev clang libclang-rt-dev"
TEST_PACKAGES="$FUZZ_PACKAGES libgmp-dev python3-scipy gdal-bin"
QGIS_PACKAGES="python3-qgis"
BENCH_PACKAGES="libgeos-dev valgrind"

# node, npm and Chromium where they are missing, from wherever those that are there may come
node_packages() { command -v node >/dev/null && command -v npm >/dev/null || echo nodejs npm; }
browser_packages() { command -v chromium >/dev/null || echo chromium; }

missing_packages() {
	local package
	for package in "$@"; do
		[ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null)" = installed ] || echo "$package"
	done
}

# Installs those of the packages that are missing. The lists are only fetched when apt cannot do it without.
need_packages() {
	local missing log=$WORKSPACE/apt.log
	command -v apt-get >/dev/null || fail "only Debian is set up; elsewhere use make, make install, make installcheck"
	mapfile -t missing < <(missing_packages "$@")
	if [ ${#missing[@]} = 0 ]; then return; fi
	may_install || fail "these packages are missing, and there is no sudo to install them: ${missing[*]}"
	echo "typify: installing ${missing[*]}"
	if ! apt_get install --no-install-recommends "${missing[@]}" >"$log" 2>&1 &&
		! { apt_get update && apt_get install --no-install-recommends "${missing[@]}"; } >"$log" 2>&1; then
		tail -n 20 "$log" >&2
		fail "apt-get could not install ${missing[*]}"
	fi
}

# No question asked, unless sudo has to ask a person at a terminal for a password.
may_install() {
	AS_ROOT=
	if [ "$(id -u)" = 0 ]; then return 0; fi
	AS_ROOT=sudo
	command -v sudo >/dev/null && { sudo -n true 2>/dev/null || { [ -t 0 ] && sudo -v; }; }
}

apt_get() {
	$AS_ROOT env DEBIAN_FRONTEND=noninteractive APT_LISTCHANGES_FRONTEND=none NEEDRESTART_SUSPEND=1 LC_ALL=C.UTF-8 \
		apt-get -q -y -o DPkg::Lock::Timeout=300 -o Dpkg::Use-Pty=0 -o Dpkg::Options::=--force-confdef \
		-o Dpkg::Options::=--force-confold "$@" </dev/null
}

# --- build and throw-away server ---

# readable_copy FILE: its copy in the workspace, which the server's user may read
readable_copy() {
	local folder
	folder=$(mktemp -d "$WORKSPACE/input.XXXXXX")
	cp --reflink=auto -L "$1" "$folder/"
	chmod -R a+rX "$folder"
	echo "$folder/$(basename "$1")"
}

# The checkout may lie where the server's user cannot read it, and may hold objects for another server.
copy_tree() {
	mkdir "$WORKSPACE/tree"
	tar -C "$ROOT" --exclude=./.git --exclude=./demo-output --exclude='./tests/*/build*' --exclude=./tests/web/node_modules --exclude='*.o' --exclude='*.d' \
		--exclude='*.so' --exclude='*.bc' -cf - . | tar -C "$WORKSPACE/tree" --no-same-owner -xf -
	chmod -R a+rX "$WORKSPACE/tree"
	cd "$WORKSPACE/tree"
}

build_and_stage() {
	local log=$WORKSPACE/build.log
	STAGE=$WORKSPACE/stage
	mkdir "$STAGE"
	if ! bounded 600 make -j "$(nproc)" >"$log" 2>&1 || ! make install DESTDIR="$STAGE" >>"$log" 2>&1; then
		tail -n 40 "$log" >&2
		return 1
	fi
}

# Settings that make the server look into the stage: Debian's own, from PostgreSQL 18 on the server's.
stage_settings() {
	local share=/usr/share/postgresql/$VERSION
	if grep -q extension_destdir "$share/postgresql.conf.sample"; then
		echo "extension_destdir=$STAGE"
	else
		echo "extension_control_path=$STAGE$share:\$system"
	fi
	echo "dynamic_library_path=$STAGE/usr/lib/postgresql/$VERSION/lib:\$libdir"
}

# with_server SECONDS COMMAND...: runs it with PG* set for a server that knows the staged extension
with_server() {
	local seconds=$1 setting options=()
	shift
	while read -r setting; do options+=(-o "$setting"); done < <(stage_settings)
	bounded "$seconds" pg_virtualenv -t -v "$VERSION" -c --locale=C.UTF-8 "${options[@]}" "$@"
}
