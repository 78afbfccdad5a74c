# chroot.sh - fresh Debian systems to prove things in; to be sourced by a script that runs as root.
# MIRROR: where packages come from, by default where this machine gets its own. SCRIPT: debootstrap's, for suites that
# it does not know. APT_DIR: a folder that keeps downloaded packages between runs.

set -euo pipefail
ROOT=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
MIRROR=${MIRROR:-$(apt-get indextargets --format '$(REPO_URI)' | head -n 1)}
[ "$(id -u)" = 0 ] || { echo "must run as root" >&2; exit 1; }
command -v debootstrap >/dev/null || { echo "needs debootstrap" >&2; exit 1; }

PLACE=$(mktemp -d /var/tmp/typify-proof.XXXXXX)
chmod 0755 "$PLACE"
trap 'rm -rf --one-file-system "$PLACE"' EXIT
trap 'exit 130' HUP INT TERM
APT_DIR=${APT_DIR:-$PLACE/packages}
mkdir -p "$APT_DIR"

# outside SYSTEM: lets its apt and npm get through as ours do, also from behind a proxy with a certificate authority of
# its own. Certificates lie where the package ca-certificates takes them from when it is installed.
outside() {
	local system=$1 name registry
	apt-config dump | grep -E '^Acquire::(http|https|Check|Retries)' >"$system/etc/apt/apt.conf.d/00outside" || true
	cp -L /etc/resolv.conf "$system/etc/resolv.conf"
	echo "127.0.0.1 localhost $(uname -n)" >"$system/etc/hosts"
	if [ -d /usr/local/share/ca-certificates ]; then
		cp -RL /usr/local/share/ca-certificates "$system/usr/local/share/"
	fi
	# read at every login, by sudo too
	for name in http_proxy https_proxy no_proxy HTTP_PROXY HTTPS_PROXY NO_PROXY; do
		if [ -n "${!name:-}" ]; then echo "$name=${!name}"; fi
	done >>"$system/etc/environment"
	if registry=$(npm config get registry 2>/dev/null); then
		echo "npm_config_registry=$registry" >>"$system/etc/environment"
	fi
}

# make_system SUITE DIR [PACKAGES,WITH,COMMAS [OPTION...]]: a minimal system
make_system() {
	local suite=$1 system=$2 include=${3:-} log=$PLACE/debootstrap.log
	shift $(($# < 3 ? $# : 3))
	debootstrap --variant=minbase --cache-dir="$APT_DIR" ${include:+--include="$include"} "$@" "$suite" "$system" \
		"$MIRROR" ${SCRIPT:-} >"$log" 2>&1 || { tail -n 20 "$log" >&2; exit 1; }
	outside "$system"
}

# in_system DIR COMMAND...: runs it there; when it ends, so do its servers and mounts
in_system() {
	local system=$1
	shift
	unshare --mount --pid --fork --kill-child bash -euc '
		system=$1 packages=$2 data=$3
		shift 3
		mount --make-rprivate /
		mount -t proc proc "$system/proc"
		mkdir -p "$system/dev/pts" "$system/dev/shm"
		mount -t devpts devpts "$system/dev/pts"
		mount -t tmpfs -o mode=1777 tmpfs "$system/dev/shm"
		mount --bind "$packages" "$system/var/cache/apt/archives"
		if [ -n "$data" ]; then mkdir -p "$system/srv/data"; mount --bind -o ro "$data" "$system/srv/data"; fi
		env -i PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin TERM=dumb HOME=/ chroot "$system" "$@"
	' bash "$system" "$APT_DIR" "${TYPIFY_DATA:-}" "$@"
}

# copy_checkout DIR/IN/SYSTEM: what is in version control or would be, as a clone would have it
copy_checkout() {
	mkdir -p "$1"
	git -C "$ROOT" ls-files -z --cached --others --exclude-standard |
		(cd "$ROOT" && while IFS= read -r -d '' file; do if [ -e "$file" ]; then printf '%s\0' "$file"; fi; done) |
		tar -C "$ROOT" --null -T - -cf - | tar -C "$1" --no-same-owner -xf -
}
