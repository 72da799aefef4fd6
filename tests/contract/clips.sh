#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Copyright the WideOpen authors
#
# Clips that do not go together, and depth that is none: told, refused or mended.
#
# usage: clips.sh WIDEOPEN JSON_CHECK WORK_DIR EXR_CHANGE
# Exit 0: everything as promised. 1: something is not (each is printed). 2: wrong use.

set -u

if [ $# -ne 4 ]; then
    echo "usage: clips.sh WIDEOPEN JSON_CHECK WORK_DIR EXR_CHANGE" >&2
    exit 2
fi
wideopen=$1 json_check=$2 work=$3 exr_change=$4
tools=$(cd "$(dirname "$0")" && pwd)/cli_tools.sh
rm -rf "$work"
mkdir -p "$work" && cd "$work" || exit 2
unset OCIO OFX_PLUGIN_PATH

. "$tools"

# blur CODE SOURCE DEPTH OUTPUT WORDS...
blur() {
    wanted=$1 source=$2 depth=$3 output=$4
    shift 4
    expect "$wanted" render LensBlur --clip "Source=$source" --clip "Depth=$depth" -o "$output" \
        --set method=rays --set samples=4 --no-progress --bits float "$@"
}

# quiet: the last command warned of nothing.
quiet() {
    checks=$((checks + 1))
    ! grep -q 'warning' stderr || fail "a warning without cause"
}

# change IN OUT WORDS...
change() {
    checks=$((checks + 1))
    "$exr_change" "$@" 2>stderr || fail "exr_change $*"
}

expect 0 footage still-life -o scene --size 96x64 --layers 1 --no-progress
scene=scene/pinhole.exr
blur 0 $scene $scene:depth out.exr --report report.json
quiet
value report.json warnings '[]'

# ------------------------------------------------------------------------------- whose depth it is

# A file of colour and depth is depth where depth is wanted.
blur 0 $scene $scene found.exr
says 'clip Depth: channel Z of'
quiet
same out.exr found.exr
blur 0 $scene $scene:R red.exr
quiet
blur 0 $scene $scene:rgba colour.exr --report report.json
says 'warning: clip Depth: .* shows colours'
value report.json warnings.0.key depth-colour
blur 0 $scene $scene:rgba green.exr --set depthChannel=green
quiet

# Of several layers the one that is seen, in whatever order the clips come.
expect 0 footage still-life -o layered --size 96x64 --layers 3 --no-progress
layers=layered/layers.exr
for k in 1 2; do
    blur 0 $layers:layer$k $layers:layer${k}_depth named.exr
    expect 0 render LensBlur --clip Depth=$layers --clip Source=$layers:layer$k -o found.exr \
        --set method=rays --set samples=4 --no-progress --bits float
    says 'clip Depth: channel .*Z of'
    same named.exr found.exr
done

# -------------------------------------------------------------------------- depth that cannot be it

change $scene negative.exr times=-1
blur 0 $scene negative.exr:depth far.exr --report report.json
says 'warning: Depth: 100 % of the depth is negative'
says 'depthMode=negative'
is_json report.json
value report.json warnings.0.key depth-negative
value report.json warnings.0.frame 1
value report.json frames.0.reports.0.warnings.0.key depth-negative
blur 0 $scene negative.exr:depth again.exr --set depthMode=negative
quiet
same out.exr again.exr
blur 0 $scene negative.exr:depth none.exr --explain
says 'warning: Depth: 100 % of the depth is negative'
shows 'warning     Depth: 100 % of the depth is negative'
absent none.exr
blur 0 $scene negative.exr:depth tiles.exr --tile 48
says 'warning: Depth: .* of the depth is negative'
change $scene millions.exr times=1e6
blur 0 $scene millions.exr:depth far.exr
says 'warning: Depth: all depth .* farther than 100 km'

# An estimate of 0..1 in a file of 8 bits, grey in three channels.
{
    printf 'P6\n96 64\n255\n'
    LC_ALL=C awk 'BEGIN { for (i = 0; i < 96 * 64; i++) { v = 1 + int(i / 50); printf "%c%c%c", v, v, v } }'
} >estimate.ppm
blur 0 $scene estimate.ppm far.exr
says 'warning: Depth: .* in steps of a file of whole numbers'
says 'depthMode=normalised'
blur 0 $scene estimate.ppm far.exr --set depthMode=inverse
quiet

# Each kind is told once, however many frames.
cp $scene in.0001.exr
cp $scene in.0002.exr
blur 0 in.####.exr negative.exr:depth far.####.exr --frames 1-2 --report report.json
checks=$((checks + 1))
[ "$(grep -c warning stderr)" = 1 ] || fail "a warning for each frame"
says 'warning: frame 1: Depth'
value report.json frames.1.reports.0.warnings.0.key depth-negative

# ------------------------------------------------------------------------------------ size, aspect

change $scene small.exr columns=2 rows=2
blur 1 $scene small.exr:depth no.exr
says 'clip Depth: small.exr: 48 x 32 px'
says '96 x 64'
says 'clip-size scale'
absent no.exr
blur 2 $scene small.exr:depth no.exr --clip-size stretch
says 'error, scale or keep'
blur 0 $scene small.exr:depth scaled.exr --clip-size scale
quiet
checks=$((checks + 1))
psnr=$("$wideopen" compare out.exr scaled.exr --json | "$wideopen" json - psnr)
awk "BEGIN { exit !($psnr > 30) }" || fail "depth of half the size is $psnr dB off"
blur 0 $scene small.exr:depth kept.exr --clip-size keep
says 'warning: Depth: the depth covers 0,0 .. 48,32 of 0,0 .. 96,64 px'
for clip in Mask Focus Layer2 Background; do
    blur 1 $scene $scene:depth no.exr --clip $clip=small.exr
    says "clip $clip: small.exr"
done

# Pixels twice as wide: depth in square pixels, and as many of them as there are of Source.
change $scene wide.exr columns=2 aspect=2
blur 0 wide.exr wide.exr:depth wide_out.exr
blur 0 wide.exr $scene:depth from_square.exr
quiet
same wide_out.exr from_square.exr
change $scene narrow.exr columns=2
blur 1 wide.exr narrow.exr:depth no.exr
says '48 x 64 px of aspect 1, but Source has 48 x 64 of aspect 2'
blur 0 wide.exr narrow.exr:depth from_untold.exr --clip-size scale
same wide_out.exr from_untold.exr

# ---------------------------------------------------------------------------------- missing frames

for n in 2 3 5; do
    change $scene depth.000$n.exr times=$n
done
for n in 1 2 3 4 5 6; do
    cp $scene in.000$n.exr
done
# shot CODE FRAMES OUTPUT WORDS...
shot() {
    wanted=$1 list=$2 output=$3
    shift 3
    blur "$wanted" in.####.exr depth.####.exr:depth "$output" --frames "$list" "$@"
}
shot 1 2-6 stop.####.exr
says 'there is no depth.0004.exr (frames 2 to 5); --missing-frames skip'
present stop.0003.exr
absent stop.0004.exr
shot 2 2-6 stop.####.exr --missing-frames black
says 'error, skip or hold'
shot 0 1-6 skip.####.exr --missing-frames skip --report report.json
says 'warning: frame 1: clip Depth: depth.####.exr has no frame 1, which is left out'
says 'warning: frame 4: clip Depth: depth.####.exr has no frame 4, which is left out'
for n in 1 4 6; do
    absent skip.000$n.exr
done
for n in 2 3 5; do
    present skip.000$n.exr
done
is_json report.json
value report.json ok true
value report.json frames.0.skipped true
value report.json frames.1.skipped false
value report.json warnings.1.key missing-frame
value report.json warnings.1.frame 4
shot 0 1-6 hold.####.exr --missing-frames hold
says 'warning: frame 1: clip Depth: depth.####.exr has no frame 1, frame 2 stands in its place'
says 'warning: frame 4: clip Depth: depth.####.exr has no frame 4, frame 3 stands in its place'
same hold.0001.exr skip.0002.exr
same hold.0004.exr skip.0003.exr
same hold.0005.exr skip.0005.exr
same hold.0006.exr skip.0005.exr
# A farm that renders one frame gets the same.
blur 1 none.####.exr depth.####.exr:depth stop.####.exr --frames 2-6
says 'there is no none.0002.exr, nor any other frame of none.####.exr$'
shot 0 4 alone.####.exr --missing-frames hold
same alone.0004.exr hold.0004.exr
shot 1 4 none.####.exr --missing-frames skip
says 'no frame was rendered'

finish
