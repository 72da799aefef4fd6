#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Copyright the WideOpen authors
#
# Breaches of the rules that the host writes down are printed, whenever they happen.
#
# usage: strict.sh WIDEOPEN JSON_CHECK WORK_DIR PLUGINS
# Exit 0: everything as promised. 1: something is not (each is printed). 2: wrong use.

set -u

if [ $# -ne 4 ]; then
    echo "usage: strict.sh WIDEOPEN JSON_CHECK WORK_DIR PLUGINS" >&2
    exit 2
fi
wideopen=$1 json_check=$2 work=$3 plugins=$4
tools=$(cd "$(dirname "$0")" && pwd)/cli_tools.sh
rm -rf "$work"
mkdir -p "$work" && cd "$work" || exit 2
unset OCIO OFX_PLUGIN_PATH
export WIDEOPEN_PLUGIN_CACHE=off WO_TEST_MISDEED

. "$tools"

expect 0 footage still-life -o scene --size 32x18 --layers 1

# bad CODE MISDEED WORDS...
bad() {
    wanted=$1 WO_TEST_MISDEED=$2
    shift 2
    expect "$wanted" render Bad --plugin-path "$plugins/bad" --clip Source=scene/pinhole.exr \
        -o out.exr "$@"
}

# While a render runs, when the instance goes, when the plugin goes.
for misdeed in 'set param in render' 'leak memory' 'leak mutex'; do
    bad 0 "$misdeed" --report report.json
    says 'violation: org.wideopen.test.Bad: '
    is_json report.json
    checks=$((checks + 1))
    grep -q '"org.wideopen.test.Bad: ' report.json || fail "$misdeed: not in the report"
    bad 1 "$misdeed" --strict
    says 'broke the rules of OpenFX'
done
says 'OfxActionUnload: a mutex was not destroyed'

# Before there is a render, and when there is none to be.
bad 1 'illegal create status'
says 'OfxActionCreateInstance: it answers kOfxStatReplyYes'
bad 2 'no label' --set nothing=1
says 'OfxActionDescribe: it has no label'
expect 0 describe Bad --plugin-path "$plugins/bad"
says 'OfxActionDescribe: it has no label'

# What is right is not complained of; what others do is not judged.
bad 0 none --strict
checks=$((checks + 1))
grep -q violation stderr && fail 'a violation of nothing'
WO_TEST_MISDEED='no label'
expect 0 render Legal --plugin-path "$plugins/legal" --plugin-path "$plugins/bad" \
    --clip Source=scene/pinhole.exr -o out.exr --strict
checks=$((checks + 1))
grep -q violation stderr && fail 'a violation of another plugin'

finish
