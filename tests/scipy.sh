#!/bin/sh
# scipy.sh - the fear: with s_u = 0 the core is not what it should be then, centroid-linkage clustering. Compares
# with SciPy on real buildings (TYPIFY_DATA, by default ../shared/data beside the project). Exit status 77: skipped.
set -eu

here=$(cd "$(dirname "$0")" && pwd)
core=$here/../src/core
data=${TYPIFY_DATA:-$here/../../shared/data}
python=/usr/bin/python3

if ! "$python" -c 'import scipy.cluster.hierarchy' 2>/dev/null; then
	echo "skipped: python3-scipy is not installed"
	exit 77
fi
[ -d "$data" ] || { echo "skipped: no data in $data (TYPIFY_DATA)"; exit 77; }

build=$(mktemp -d)
trap 'rm -rf "$build"' EXIT
${CC:-gcc} -std=gnu11 -O2 -ffp-contract=off -I"$core" -o "$build/merges" "$here/unit/merges.c" "$core"/*.c -lm
"$python" "$here/scipy_compare.py" "$build/merges" "$data"
