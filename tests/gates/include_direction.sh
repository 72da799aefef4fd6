#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Copyright the WideOpen authors
#
# Does every #include point in the allowed direction, and do core and plugins keep off printing,
# exit, threads and memory that is not the context's? The rules stand in include_direction.awk.
#
# usage: include_direction.sh ROOT
# Exit 0: yes. 1: no (each fault is printed). 2: wrong use.

set -u
LC_ALL=C
export LC_ALL

if [ $# -ne 1 ] || [ ! -d "$1" ]; then
    echo "usage: include_direction.sh ROOT" >&2
    exit 2
fi
gates=$(cd "$(dirname "$0")" && pwd)
# shellcheck source=sources.sh
. "$gates/sources.sh"
work=$(mktemp -d) || exit 2
trap 'rm -rf "$work"' EXIT

source_files "$1" >"$work/all" || exit 2
cd "$1" || exit 2
grep -E '\.([chCH]|cc|hh|cpp|cxx|hpp|hxx)(\.in)?$' "$work/all" >"$work/sources"
if [ ! -s "$work/sources" ]; then
    echo "include_direction.sh: no source files below $1" >&2
    exit 2
fi
xargs awk -v want=code -f "$gates/blank.awk" <"$work/sources" >"$work/code" || exit 2
awk -f "$gates/include_direction.awk" "$work/all" "$work/code"
