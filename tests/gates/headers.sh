#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Copyright the WideOpen authors
#
# Does every public header compile alone, and twice over, as C11 and as C++17, without a warning?
#
# usage: headers.sh CC CXX ROOT
# Exit 0: yes. 1: no (each is named, the compiler's words follow). 2: wrong use.

set -u
LC_ALL=C
export LC_ALL

if [ $# -ne 3 ] || [ ! -d "$3" ]; then
    echo "usage: headers.sh CC CXX ROOT" >&2
    exit 2
fi
cc=$1 cxx=$2 root=$3
work=$(mktemp -d) || exit 2
trap 'rm -rf "$work"' EXIT
cd "$root" || exit 2

headers=
for header in include/wideopen/*.h include/ofx/*.h ofx_host_stub/host/host.h \
        ofx_host_stub/bridge/*.h footage/footage.h; do
    case $header in
    *_private.h | *'*'*) ;;
    *) [ ! -f "$header" ] || headers="$headers $header" ;;
    esac
done
if [ -z "$headers" ]; then
    echo "headers.sh: no public header below $root" >&2
    exit 2
fi

failures=0
checked=0

# try HEADER LANGUAGE COMPILER...: compiles the header alone.
try() {
    header=$1 language=$2
    shift 2
    checked=$((checked + 1))
    if ! "$@" -Wall -Wextra -Wpedantic -Werror -fsyntax-only -I include "$work/alone.$language" \
            >"$work/log" 2>&1; then
        echo "$header does not compile alone: $*"
        sed 's/^/    /' "$work/log"
        failures=$((failures + 1))
    fi
}

for header in $headers; do
    # The last line keeps a file from being empty, which C forbids.
    printf '#include "%s"\n#include "%s"\nextern int wo_alone;\n' "$PWD/$header" "$PWD/$header" \
        >"$work/alone.c"
    cp "$work/alone.c" "$work/alone.cc"
    # Not quoted: each compiler may be a command with arguments, such as "ccache gcc".
    # shellcheck disable=SC2086
    try "$header" c $cc -std=c11
    # shellcheck disable=SC2086
    try "$header" cc $cxx -std=c++17
done
echo "$checked compilations of public headers, $failures failed"
[ "$failures" -eq 0 ]
