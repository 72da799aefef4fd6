#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Copyright the WideOpen authors
#
# Are all sources as clang-format (version 14, see .clang-format) would write them?
#
# usage: format.sh CLANG_FORMAT ROOT
# Exit 0: yes. 1: no (the files that differ are printed). 2: wrong use.

set -u
LC_ALL=C
export LC_ALL

if [ $# -ne 2 ] || [ ! -f "$2/.clang-format" ]; then
    echo "usage: format.sh CLANG_FORMAT ROOT" >&2
    exit 2
fi
format=$1
gates=$(cd "$(dirname "$0")" && pwd)
# shellcheck source=sources.sh
. "$gates/sources.sh"
work=$(mktemp -d) || exit 2
trap 'rm -rf "$work"' EXIT

source_files "$2" >"$work/all" || exit 2
cd "$2" || exit 2
# Left out: what a program wrote.
grep -E '\.(c|h|cc|hh)$' "$work/all" | grep -v -x -F 'tests/contract/ofx_abi_dump.c' \
    >"$work/sources"
if [ ! -s "$work/sources" ]; then
    echo "format.sh: no source files below $2" >&2
    exit 2
fi
# One line for each place; the lines of the source follow, which are not wanted.
xargs "$format" --style=file --dry-run <"$work/sources" >"$work/said" 2>&1
code=$?
sed -n "s/^\(.*\):[0-9]*:[0-9]*: warning: code should be clang-formatted.*/\1/p" "$work/said" |
    sort | uniq -c | awk '{ print $2 ": " $1 " places differ" }' >"$work/faults"
cat "$work/faults"
if [ "$code" -ne 0 ]; then
    cat "$work/said"
    echo "format.sh: $format failed"
    exit 1
fi
failures=$(wc -l <"$work/faults")
echo "$(wc -l <"$work/sources") files, $failures not formatted"
[ "$failures" -eq 0 ]
