#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Copyright the WideOpen authors
#
# The command line with plugins on the path that crash, hang, shout and free what they gave: list,
# describe and render work, and only the plugin that runs is judged.
#
# usage: faulty_plugins.sh WIDEOPEN JSON_CHECK WORK_DIR PLUGINS
# Exit 0: everything as promised. 1: something is not (each is printed). 2: wrong use.

set -u

if [ $# -ne 4 ]; then
    echo "usage: faulty_plugins.sh WIDEOPEN JSON_CHECK WORK_DIR PLUGINS" >&2
    exit 2
fi
wideopen=$1 json_check=$2 work=$3 plugins=$4
tools=$(cd "$(dirname "$0")" && pwd)/cli_tools.sh
rm -rf "$work"
mkdir -p "$work" && cd "$work" || exit 2
unset OCIO WIDEOPEN_PLUGIN_CACHE
XDG_CACHE_HOME=$work/cache
OFX_PLUGIN_PATH=$plugins/faulty:$plugins/hanging:$plugins/fresh:$plugins/good
export XDG_CACHE_HOME OFX_PLUGIN_PATH

. "$tools"

says_not() {
    checks=$((checks + 1))
    grep -q -e "$1" stderr && fail "stderr says: $1"
}

# Nothing is known yet. The plugin beside the program is nearer than those on the path: nobody else
# is asked, judged or mentioned.
expect 0 footage two-planes -o scene --size 64x48 --no-progress
scene=scene/pinhole.exr
expect 0 render LensBlur --clip Source=$scene --clip Depth=$scene:Z --strict -o strict.exr
says '^wideopen: strict.exr: 64x48'
says_not violation
says_not faulty
says_not hanging
expect 0 describe LensBlur --notes
says_not faulty
checks=$((checks + 1))
[ "$(find cache -name '*.txt' | wc -l)" -eq 1 ] || fail "more than LensBlur was looked at"

# Those on the path first: in their folders, too, the bundle of the name is asked alone.
mkdir near
for bundle in "$plugins"/faulty/* "$plugins"/hanging/* "$plugins"/good/*; do
    ln -s "$bundle" near/
done
expect 0 describe Good --plugin-path near
says_not failed
expect 0 render Fresh --size 8x8 --strict -o fresh.exr --plugin-path "$plugins/fresh"
present fresh.exr

# What a plugin says when it fails is not cut.
WO_TEST_REFUSES=$(printf '%03000d' 7)
export WO_TEST_REFUSES
expect 1 render Fresh --size 8x8 -o refused.exr --plugin-path "$plugins/fresh"
says "plugin.*$WO_TEST_REFUSES\$"
absent refused.exr
unset WO_TEST_REFUSES

# Where a plugin goes, and what it does to the mask of new files, is its own affair.
WO_TEST_STRAYS=1
export WO_TEST_STRAYS
expect 0 render Fresh --size 8x8 -o strays.exr --report strays.json --plugin-path "$plugins/fresh"
present strays.exr
present strays.json
checks=$((checks + 1))
[ "$(find strays.exr strays.json -perm -200 | wc -l)" -eq 2 ] || fail "files nobody may write"
unset WO_TEST_STRAYS

# Everything: the list is made, and says who fails and why.
expect 0 list --plugin-wait 2
shows '^org.wideopen.LensBlur '
shows '^org.wideopen.test.Good '
shows '^org.wideopen.test.Fresh '
shows '^org.wideopen.test.DescribeCrash.Last '
says 'failed: .*/LoadCrash.ofx.bundle: crashed (signal 6, .*it said: missing'
says 'failed: .*/LoadHang.ofx.bundle: was killed .* while it was loaded'
says 'failed: .*/DescribeHang.ofx.bundle: was killed .*DescribeHang.Middle described itself'
says 'failed: .*/CountMany.ofx.bundle: '
says 'failed: .*/GetNull.ofx.bundle: plugin 1 is NULL'
says '^wideopen: org.wideopen.test.DescribeWrong.Middle breaks the rules of OpenFX 2 times: OfxActionDescribe: '
checks=$((checks + 1))
[ "$(grep -c DescribeWrong stderr)" -eq 1 ] || fail "more than a line for a plugin"
# No cell reaches into the next.
checks=$((checks + 1))
at=$(awk '/Generator$/ { print match($0, /(Filter, General, )?Generator$/) }' stdout | sort -u | wc -l)
[ "$at" -eq 1 ] || fail "the last column begins at $at places: $(cat stdout)"
OFX_PLUGIN_PATH=$plugins/faulty
expect 0 list --json
is_json stdout
grep -q '"failures": \[' stdout || fail "list --json tells no failures"

# A plugin that is asked for and fails is named; the path to it is not what kills the program.
expect 2 describe org.wideopen.test.DescribeCrash.Middle
says 'no plugin "org.wideopen.test.DescribeCrash.Middle"'
says 'failed: .*DescribeCrash.Middle described itself'
says 'other plugins or binaries failed; wideopen list names them'
checks=$((checks + 1))
[ "$(grep -c failed: stderr)" -eq 1 ] || fail "failures that nobody asked for: $(cat stderr)"
expect 0 describe org.wideopen.test.DescribeCrash.Last
OFX_PLUGIN_PATH=$plugins/hanging
expect 2 render LoadHang --size 8x8 -o nothing.exr --plugin-wait 1
says 'failed: .*/LoadHang.ofx.bundle: was killed'
absent nothing.exr

# The cache can be put elsewhere, or off.
expect 0 describe LensBlur --plugin-cache elsewhere
present elsewhere
rm -rf cache
expect 0 describe LensBlur --plugin-cache off
WIDEOPEN_PLUGIN_CACHE=off
export WIDEOPEN_PLUGIN_CACHE
expect 0 describe LensBlur
absent cache
expect 2 list --plugin-wait 0
says plugin-wait
expect 0 list --help
shows WIDEOPEN_PLUGIN_CACHE

finish
