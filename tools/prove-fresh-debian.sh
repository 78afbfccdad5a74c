#!/bin/bash
# prove-fresh-debian.sh [SUITE] - makes fresh minimal Debian systems to which only git and make (and, for a user,
# sudo) are added, and runs make demo, make test and plain PGXS there, as root and as a user. Then looks for what was
# left behind. Runs as root, needs debootstrap and the network; removes everything it made.
# TYPIFY_DATA: a folder of real data that the tests may read there. USERS: "root maria", or one of them. QGIS=1: with
# the tests that open layers in QGIS. STEPS: "demo test plain", or some of them.
. "$(dirname "$0")/chroot.sh"
SUITE=${1:-bookworm}

prepare_user() { # SYSTEM USER
	in_system "$1" apt-get -q update >/dev/null
	if [ "$2" = root ]; then
		# as in a container, where packages may not start their services; the user's system lets them
		printf '#!/bin/sh\nexit 101\n' >"$1/usr/sbin/policy-rc.d"
		chmod 755 "$1/usr/sbin/policy-rc.d"
		in_system "$1" apt-get -q -y install --no-install-recommends git make >/dev/null
	else
		in_system "$1" apt-get -q -y install --no-install-recommends git make sudo >/dev/null
		in_system "$1" useradd --create-home --shell /bin/bash "$2"
		echo "$2 ALL=(ALL) NOPASSWD: ALL" >"$1/etc/sudoers.d/$2"
	fi
}

# What a newcomer types; runs inside the system as the user.
cat >"$PLACE/newcomer.sh" <<'NEWCOMER'
cd ~/typify
step() { echo "--- $(id -un): $*"; }
as_root() { if [ "$(id -u)" = 0 ]; then "$@"; else sudo "$@"; fi; }
as_postgres() { as_root su postgres -s /bin/sh -c "cd /; $1"; }
installed() {
	dpkg-query -W -f '${db:Status-Status} ${Package} ${Installed-Size}\n' "$@" 2>/dev/null | grep ^installed
}
wanted() { [[ " $STEPS " == *" $1 "* ]]; }
say_size() { installed | awk '{ size += $3 } END { printf "installed: %d packages, %d MB\n", NR, size / 1024 }'; }
if [ -d /srv/data ]; then export TYPIFY_DATA=/srv/data; fi
status=0
git init -q . && git add -A && git -c user.name=x -c user.email=x@example.org commit -qm x

say_size
if wanted demo; then
	step make demo; time make demo || status=1
	ls -l demo-output || status=1
	say_size
	if installed nodejs npm chromium gdal-bin libgmp-dev python3-scipy python3-qgis; then
		echo "the demo does not need these"
		status=1
	fi
fi
if wanted test; then
	step make test; time make test || status=1
	say_size
fi

step nothing is left behind
rm -rf demo-output
left=$(
	git status --porcelain --ignored
	find /tmp /var/tmp -mindepth 1 -maxdepth 1 \( -name 'typify*' -o -name 'pg_virt*' -o -name 'tmp.*' \)
	ls -d /etc/postgresql/*/regress /var/lib/postgresql/*/regress 2>/dev/null
	grep -alE 'regress|osm2pgsql' /proc/[0-9]*/cmdline 2>/dev/null
)
if [ -n "$left" ]; then echo "left: $left"; status=1; fi

wanted plain || exit $status
step "make && make install && make installcheck"
# what Debian made when it installed the server; its port may be another's by now, outside of this system
version=$(ls /etc/postgresql | tail -n 1)
as_root pg_ctlcluster "$version" main stop 2>/dev/null || true
for try in 1 2 3; do
	export PGPORT=$((54000 + RANDOM % 1000))
	as_root pg_conftool "$version" main set port $PGPORT
	as_root pg_ctlcluster "$version" main start && break
done
as_postgres "createuser -p $PGPORT -s $(id -un)"
plain() { make && as_root make install && make installcheck && make clean; }
plain >/tmp/plain.log 2>&1 || { tail -n 30 /tmp/plain.log; status=1; }
grep -E '^(test|ok|not ok) |^# All|tests passed' /tmp/plain.log
exit $status
NEWCOMER

status=0
make_system "$SUITE" "$PLACE/base"
for user in ${USERS:-root maria}; do
	system=$PLACE/$user
	cp -a "$PLACE/base" "$system"
	prepare_user "$system" "$user"
	home=$(awk -F: -v user="$user" '$1 == user {print $6}' "$system/etc/passwd")
	chmod 0700 "$system$home"
	copy_checkout "$system$home/typify"
	cp "$PLACE/newcomer.sh" "$system/newcomer.sh"
	in_system "$system" chown -R "$user:" "$home"
	if in_system "$system" su - "$user" -c "QGIS='${QGIS:-}' STEPS='${STEPS:-demo test plain}' bash /newcomer.sh"; then
		echo "=== $SUITE as $user: proven"
	else
		echo "=== $SUITE as $user: FAILED"
		status=1
	fi
	rm -rf --one-file-system "$system"
done
exit $status
