#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Copyright the WideOpen authors
#
# The command line on several threads: footage, every method in tiles on all of them, and a stop.
# Small, for ThreadSanitizer.
#
# usage: threads.sh WIDEOPEN JSON_CHECK WORK_DIR
# Exit 0: everything as promised. 1: something is not (each is printed). 2: wrong use.

set -u

if [ $# -ne 3 ]; then
    echo "usage: threads.sh WIDEOPEN JSON_CHECK WORK_DIR" >&2
    exit 2
fi
# shellcheck disable=SC2034 # json_check is read by the tools
wideopen=$1 json_check=$2 work=$3
tools=$(cd "$(dirname "$0")" && pwd)/cli_tools.sh
rm -rf "$work"
mkdir -p "$work" && cd "$work" || exit 2
unset OCIO OFX_PLUGIN_PATH

. "$tools"

expect 0 footage two-planes -o scene --size 64x40 --layers 2 --reference 16 --threads 4 --no-progress
blur() {
    wanted=$1
    shift
    expect "$wanted" render LensBlur --clip Source=scene/layers.exr:layer1 --no-progress \
        --clip Depth=scene/layers.exr:layer1_depth --clip Layer2=scene/layers.exr:layer2 \
        --clip Depth2=scene/layers.exr:layer2_depth --set samples=8 "$@"
}
for method in hybrid rays filter spread accumulate; do
    blur 0 -o one.exr --set method=$method --threads 1
    blur 0 -o four.exr --set method=$method --threads 4 --tile 16
    same one.exr four.exr
done
blur 0 -o seen.png --threads 4

expect 0 footage two-planes -o large --size 320x200 --samples 1 --layers 0 --no-progress
checks=$((checks + 1))
timeout --preserve-status -s INT 2 "$wideopen" render LensBlur --clip Source=large/pinhole.exr \
    --clip Depth=large/pinhole.exr:depth --set samples=16384 --set method=rays --set fStop=0.7 \
    --threads 4 -o stopped.exr --no-progress >stdout 2>stderr
code=$?
[ "$code" -eq 130 ] || fail "interrupted: exit code $code instead of 130"
absent stopped.exr

finish
