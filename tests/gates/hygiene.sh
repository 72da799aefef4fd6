#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Copyright the WideOpen authors
#
# Form of the files: names, blanks, lengths, licence lines, leftovers. What is looked for stands in
# hygiene.awk and comments.awk, what may lie in the top folder below.
#
# usage: hygiene.sh ROOT
# Exit 0: all is well. 1: it is not (each fault is printed). 2: wrong use.

set -u
LC_ALL=C
export LC_ALL

if [ $# -ne 1 ] || [ ! -d "$1" ]; then
    echo "usage: hygiene.sh ROOT" >&2
    exit 2
fi
gates=$(cd "$(dirname "$0")" && pwd)
# shellcheck source=sources.sh
. "$gates/sources.sh"
work=$(mktemp -d) || exit 2
trap 'rm -rf "$work"' EXIT

source_files "$1" >"$work/all" || exit 2
cd "$1" || exit 2
if [ ! -s "$work/all" ]; then
    echo "hygiene.sh: no files below $1" >&2
    exit 2
fi

# The only entries of the top folder.
sed 's|/.*||' "$work/all" | sort -u | while IFS= read -r entry; do
    case $entry in
    include | core | plugins | ofx_host_stub | tests | footage) ;;
    CMakeLists.txt | CMakePresets.json | README.md | CHANGELOG.md | LICENSE*) ;;
    demo | check | .*) ;;
    *) echo "$entry: does not belong into the top folder" ;;
    esac
done >"$work/faults"

# Letters, digits, and no blanks: names that every tool takes.
grep -v -E '^[A-Za-z0-9._/-]+$' "$work/all" |
    sed 's/$/: a name of other characters than A-Za-z0-9._-/' \
    >>"$work/faults"
grep -E '^[A-Za-z0-9._/-]+$' "$work/all" |
    grep -v -i -E '\.(png|jpe?g|exr|tiff?|dpx|hdr|pfm|gif|webp)$' >"$work/texts"
grep -E '\.(c|h|cc|hh)(\.in)?$' "$work/texts" >"$work/sources"

while IFS= read -r file; do
    if [ -s "$file" ] && [ -n "$(tail -c 1 "$file")" ]; then
        echo "$file: no newline at the end"
    fi
done <"$work/texts" >>"$work/faults"
xargs awk -f "$gates/hygiene.awk" <"$work/texts" >>"$work/faults"
xargs awk -v want=comments -f "$gates/blank.awk" <"$work/sources" >"$work/comments"
awk -f "$gates/comments.awk" "$work/comments" >>"$work/faults"

sort "$work/faults"
count=$(wc -l <"$work/faults")
echo "$(wc -l <"$work/all") files, $count faults"
[ "$count" -eq 0 ]
