#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Copyright the WideOpen authors
#
# What signals leave behind while a large picture is written: the exit code, no half file.
#
# usage: signals.sh WIDEOPEN WORK_DIR
# Exit 0: everything as promised. 1: something is not (each is printed). 2: wrong use.

set -u

if [ $# -ne 2 ]; then
    echo "usage: signals.sh WIDEOPEN WORK_DIR" >&2
    exit 2
fi
wideopen=$1 work=$2
tools=$(cd "$(dirname "$0")" && pwd)/cli_tools.sh
rm -rf "$work"
mkdir -p "$work" && cd "$work" || exit 2
unset OCIO OFX_PLUGIN_PATH
json_check=:

. "$tools"

# Noise takes its time to compress.
oiiotool --pattern noise:type=uniform 800x600 3 -d half --compression none -o in.exr || exit 2

temporary() {
    find . -name '.wideopen-*.tmp' | grep -c .
}

# interrupt SIGNAL CODE WORDS...: wideopen with the words gets the signal when it writes; where that
# takes no time it is none of this test's.
interrupt() {
    name=$1 wanted=$2
    shift 2
    checks=$((checks + 1))
    rm -f out.png stderr
    "$wideopen" "$@" >stdout 2>stderr </dev/null &
    process=$!
    while kill -0 $process 2>/dev/null && [ "$(temporary)" -eq 0 ]; do
        sleep 0.02
    done
    kill -s "$name" $process 2>/dev/null
    wait $process
    code=$?
    [ "$code" -eq "$wanted" ] || fail "$name, $1: exit code $code instead of $wanted"
    [ "$(temporary)" -eq 0 ] || fail "$name, $1: half a file is left"
    rm -f .wideopen-*.tmp
}

for signal in INT TERM HUP; do
    interrupt $signal 130 render LensBlur --clip Source=in.exr -o out.png --bits 16 --no-progress
    says 'interrupted'
done
interrupt TERM 143 sheet a=in.exr -o out.png
interrupt HUP 129 sheet a=in.exr -o out.png

# nohup: whoever ignores a signal goes on.
checks=$((checks + 1))
(
    trap '' HUP
    exec "$wideopen" render LensBlur --clip Source=in.exr -o out.png --no-progress
) >stdout 2>stderr </dev/null &
process=$!
while kill -0 $process 2>/dev/null && [ "$(temporary)" -eq 0 ]; do
    sleep 0.02
done
kill -s HUP $process 2>/dev/null
wait $process
code=$?
[ "$code" -eq 0 ] || fail "ignored HUP: exit code $code instead of 0"
present out.png

# A file that may not grow is an error, not the end.
checks=$((checks + 1))
(
    ulimit -f 64
    exec "$wideopen" render LensBlur --clip Source=in.exr -o small.exr --no-progress
) >stdout 2>stderr </dev/null
code=$?
[ "$code" -eq 1 ] || fail "ulimit -f: exit code $code instead of 1"
says 'File too large'
absent small.exr

finish
