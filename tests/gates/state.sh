#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Copyright the WideOpen authors
#
# Is the core free of state? No object of the archives may hold variables: tables that are const are
# all right, with pointers in them, too. For builds without sanitizers: these add variables of their
# own.
#
# usage: state.sh ARCHIVE...
# Exit 0: yes. 1: no (each variable is printed). 2: wrong use.

set -u
LC_ALL=C
export LC_ALL

if [ $# -eq 0 ]; then
    echo "usage: state.sh ARCHIVE..." >&2
    exit 2
fi
work=$(mktemp -d) || exit 2
trap 'rm -rf "$work"' EXIT

failures=0
for archive in "$@"; do
    if ! objdump -t "$archive" >"$work/symbols" 2>"$work/log" || ! grep -q . "$work/symbols"; then
        cat "$work/log" >&2
        echo "state.sh: objdump cannot read $archive" >&2
        exit 2
    fi
    # ADDRESS FLAGS SECTION SIZE NAME; the flags may hold blanks, and O marks a variable.
    awk -v archive="$archive" '
        /file format/ { member = $1; sub(/:$/, "", member) }
        / d / { next }
        (/ O / || / \.t(bss|data)/) &&
            / (\.data|\.bss|\.tdata|\.tbss|\*COM\*)(\.[^\t ]*)?\t/ && !/ \.data\.rel\.ro/ {
            printf "%s: %s: variable %s\n", archive, member, $NF
            found = 1
        }
        END { exit found }' "$work/symbols" || failures=$((failures + 1))
done
echo "$# archives, $failures with variables"
[ "$failures" -eq 0 ]
