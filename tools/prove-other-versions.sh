#!/bin/bash
# prove-other-versions.sh [SUITE...] - builds and runs the tests that need a server in fresh systems that come with
# other versions of PostgreSQL: Debian trixie 17 and sid 18, Ubuntu jammy 14 and noble 16 (these when UBUNTU_KEYRING
# names the keyring of the package ubuntu-keyring and UBUNTU_MIRROR where to get them). Runs as root, needs debootstrap
# and the network; removes everything it made. TYPIFY_DATA: a folder of real data that the tests may read there.
. "$(dirname "$0")/chroot.sh"
UBUNTU_KEYRING=${UBUNTU_KEYRING:-/usr/share/keyrings/ubuntu-archive-keyring.gpg}
UBUNTU_MIRROR=${UBUNTU_MIRROR:-}

prove_suite() {
	local system=$PLACE/$1
	case $1 in
		jammy | noble)
			MIRROR=$UBUNTU_MIRROR SCRIPT=/usr/share/debootstrap/scripts/gutsy make_system "$1" "$system" make \
				--keyring="$UBUNTU_KEYRING" --components=main,universe
			;;
		*) make_system "$1" "$system" make ;;
	esac
	copy_checkout "$system/srv/typify"
	in_system "$system" env ${TYPIFY_DATA:+TYPIFY_DATA=/srv/data} /srv/typify/tools/test-version.sh
}

status=0
if [ $# = 0 ]; then
	set -- trixie sid
	if [ -f "$UBUNTU_KEYRING" ] && [ -n "$UBUNTU_MIRROR" ]; then
		set -- jammy noble "$@"
	else
		echo "=== jammy, noble: skipped without UBUNTU_KEYRING and UBUNTU_MIRROR"
	fi
fi
for suite in "$@"; do
	if (trap - EXIT; prove_suite "$suite"); then
		echo "=== $suite: proven"
	else
		echo "=== $suite: FAILED"
		status=1
	fi
	rm -rf --one-file-system "${PLACE:?}/$suite"
done
exit $status
