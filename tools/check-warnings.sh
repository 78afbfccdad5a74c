#!/bin/bash
# check-warnings.sh COMPILER - every C file of the extension compiles without a warning
cd "$(dirname "$0")/.."
compiler=$1
flags="-std=gnu11 -O2 -Wall -Wextra -Werror -Wmissing-prototypes -Wpointer-arith -Wvla -ffp-contract=off -fPIC"
headers=$("${PG_CONFIG:-pg_config}" --includedir-server) || exit 1
status=0
for file in src/core/*.c src/*.c; do
	"$compiler" $flags -isystem "$headers" -c -o /dev/null "$file" || status=1
done
exit $status
