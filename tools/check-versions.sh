#!/bin/bash
# check-versions.sh - typify.control and META.json (its own version and that of the extension) name one version
cd "$(dirname "$0")/.."
version=$(sed -n "s/^default_version *= *'\(.*\)'.*/\1/p" typify.control)
echo "typify.control has ${version:-no version}, META.json:"
grep '"version"' META.json
[ -n "$version" ] && [ "$(grep -cF "\"version\": \"$version\"" META.json)" = 2 ]
