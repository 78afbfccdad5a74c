#!/bin/bash
# check-core.sh - the core knows neither headers nor calls of PostgreSQL; prints where it does
cd "$(dirname "$0")/.."
! grep -nE 'postgres\.h|fmgr\.h|#include *"\.\./|palloc|\bereport\b|\belog *\(' src/core/*.[ch]
