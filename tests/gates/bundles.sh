#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Copyright the WideOpen authors
#
# What a plugin shows to the program that loads it, and what it wants from it.
#
# usage: bundles.sh exports|needed PLUGIN_DIR
#   exports  the dynamic symbols of every *.ofx are the three functions of OpenFX and no other; no
#            relocations in code, no executable stack
#   needed   it needs the C library, the mathematics library and the loader, nothing else, and has
#            no search path. For builds without sanitizers: these add a library of their own.
# Exit 0: yes. 1: no (each fault is printed). 2: wrong use, or there is no plugin.

set -u
LC_ALL=C
export LC_ALL

usage() {
    echo "usage: bundles.sh exports|needed PLUGIN_DIR" >&2
    exit 2
}

[ $# -eq 2 ] || usage
what=$1 folder=$2
case $what in
exports | needed) ;;
*) usage ;;
esac
for tool in nm readelf; do
    if ! command -v "$tool" >/dev/null; then
        echo "bundles.sh: there is no $tool (package binutils)" >&2
        exit 2
    fi
done
work=$(mktemp -d) || exit 2
trap 'rm -rf "$work"' EXIT

failures=0
fault() {
    echo "$*"
    failures=$((failures + 1))
}

check_exports() {
    printf '%s\n' OfxGetNumberOfPlugins OfxGetPlugin OfxSetHost >"$work/expected"
    nm -D --defined-only -P "$1" >"$work/nm" || fault "$1: nm cannot read it"
    sed 's/ .*//' "$work/nm" | sort >"$work/exports"
    if ! cmp -s "$work/expected" "$work/exports"; then
        fault "$1: exports are not OfxGetNumberOfPlugins, OfxGetPlugin and OfxSetHost:"
        diff "$work/expected" "$work/exports" |
            sed -n "s/^>/    one too many:/p; s/^</    missing:/p"
    fi
    if grep -q -E '\(TEXTREL\)|FLAGS.*TEXTREL' "$work/dynamic"; then
        fault "$1: relocations in code"
    fi
    stack=$(readelf -lW "$1" | awk '$1 == "GNU_STACK" { print $(NF - 1) }')
    case $stack in
    '') fault "$1: does not say whether its stack is executable" ;;
    *E*) fault "$1: executable stack" ;;
    esac
}

check_needed() {
    needed=$(sed -n 's/^.*(NEEDED).*\[\(.*\)\]$/\1/p' "$work/dynamic")
    [ -n "$needed" ] || fault "$1: needs no library at all, not even the C library"
    for library in $needed; do
        case $library in
        libc.so.6 | libm.so.6 | ld-linux*.so.*) ;;
        *) fault "$1: needs $library" ;;
        esac
    done
    if grep -q -E '\((RPATH|RUNPATH)\)' "$work/dynamic"; then
        fault "$1: has a search path: $(sed -n 's/^.*PATH).*\[\(.*\)\]$/\1/p' "$work/dynamic")"
    fi
}

find "$folder" -name '*.ofx' -type f >"$work/plugins" || exit 2
if [ ! -s "$work/plugins" ]; then
    echo "bundles.sh: no plugin in $folder" >&2
    exit 2
fi
while IFS= read -r plugin; do
    if ! readelf -dW "$plugin" >"$work/dynamic" 2>/dev/null || [ ! -s "$work/dynamic" ]; then
        fault "$plugin: readelf cannot read it"
        continue
    fi
    "check_$what" "$plugin"
done <"$work/plugins"
echo "$(wc -l <"$work/plugins") plugins, $failures faults"
[ "$failures" -eq 0 ]
