#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Copyright the WideOpen authors
#
# Times: what a sequence covers does not depend on which of its frames are rendered.
#
# usage: frames.sh WIDEOPEN JSON_CHECK WORK_DIR PLUGINS EXR_TAG
# Exit 0: everything as promised. 1: something is not (each is printed). 2: wrong use.

set -u

if [ $# -ne 5 ]; then
    echo "usage: frames.sh WIDEOPEN JSON_CHECK WORK_DIR PLUGINS EXR_TAG" >&2
    exit 2
fi
wideopen=$1 json_check=$2 work=$3 plugins=$4 exr_tag=$5
tools=$(cd "$(dirname "$0")" && pwd)/cli_tools.sh
rm -rf "$work"
mkdir -p "$work" && cd "$work" || exit 2
unset OCIO OFX_PLUGIN_PATH

. "$tools"

# picture FILE GREY: 4 x 2 pixels of a grey of 0..255
picture() {
    pixel=$(printf '\\%03o\\%03o\\%03o' "$2" "$2" "$2")
    # shellcheck disable=SC2059
    { printf 'P6\n4 2\n255\n' && printf "$pixel$pixel$pixel$pixel$pixel$pixel$pixel$pixel"; } >"$1"
}

# frames CODE LIST OUTPUT WORDS...
frames() {
    wanted=$1 list=$2 output=$3
    shift 3
    expect "$wanted" render Frames --plugin-path "$plugins/frames" --frames "$list" -o "$output" \
        --strict "$@"
}

# Five frames; what is made of those that are odd counts them.
for n in 1 3 5 7 9; do
    picture p.000$n.ppm $((n * 20))
done
frames 0 1-5 in.####.exr --clip Source=p.####.ppm
for n in 1 2 3 4 5; do
    present in.000$n.exr
done

# One frame of five is the same whether it is rendered alone or with others.
frames 0 3 alone.####.exr --clip Source=in.####.exr
same alone.0003.exr in.0005.exr
frames 0 1-3 all.####.exr --clip Source=in.%04d.exr
same all.0001.exr in.0001.exr
same all.0002.exr in.0003.exr
same all.0003.exr in.0005.exr

# What plugins are told.
frames 0 3 told.####.exr --clip Source=in.####.exr --set tell=on
says 'source 1-5 output 1-5 line 1-5 duration 5 rate 24 now 3-3'
frames 0 2-4 told.####.exr --clip Source=in.####.exr --set tell=on --range 1-20
says 'source 1-5 output 1-5 line 1-20 duration 20 rate 24 now 4-4'
frames 0 3 told.####.exr --clip Source=in.0002.exr --set tell=on
says 'source 3-3 output 3-3 line 3-3 duration 1 rate 24 now 3-3'
frames 0 3 told.####.exr --clip Source=in.0002.exr --set tell=on --range 1-20
says 'source 1-20 output 1-20 line 1-20 duration 20 rate 24 now 3-3'
expect 2 render Frames --plugin-path "$plugins/frames" --clip Source=in.0002.exr -o told.exr \
    --range twenty
says 'range: "twenty" is no list of frames'

# Frames beyond the ends: the plugin knows them and takes one that is there.
frames 0 8 beyond.####.exr --clip Source=in.####.exr
same beyond.0008.exr in.0005.exr
frames 1 8 nothing.####.exr --clip Source=in.####.exr --set beyond=on
says 'no frame 8, its frames are 1 to 5'
absent nothing.0008.exr

# A gap: a failure only where the missing frame is wanted.
rm in.0003.exr
frames 1 2 gap.####.exr --clip Source=in.####.exr
says 'no frame 3; its frames are 1 to 5'
frames 0 3 gap.####.exr --clip Source=in.####.exr
same gap.0003.exr in.0005.exr

# Numbers of all kinds, and in folders.
mkdir -p take.0007 take.0009 take.0011
cp in.0001.exr take.0007/a.7.exr
cp in.0002.exr take.0011/a.11.exr
cp in.0001.exr take.0007/a.8.exr
cp in.0001.exr take.0007/a.x.exr
frames 0 7 folder.####.exr --clip 'Source=take.%04d/a.%d.exr' --set tell=on
says 'source 7-11'
for n in -002 0001 10000 00003 3 -5; do
    cp in.0001.exr wide.$n.exr
done
frames 0 10000 wide.out.%d.exr --clip 'Source=wide.%04d.exr' --set tell=on
says 'source -2-10000 '

# Frames per second of the file.
"$exr_tag" in.0001.exr tagged.exr '''framesPerSecond::rational=25 1''' || fail "exr_tag"
frames 0 1 told.exr --clip Source=tagged.exr --set tell=on
says 'rate 25 '

finish
