#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Copyright the WideOpen authors
#
# Colour spaces from file to file: a render that changes nothing changes no code, and other programs
# find the labels of what is there.
#
# usage: colour.sh WIDEOPEN WORK_DIR
# Exit 0: everything as promised. 1: something is not (each is printed). 2: wrong use.

set -u

if [ $# -ne 2 ]; then
    echo "usage: colour.sh WIDEOPEN WORK_DIR" >&2
    exit 2
fi
wideopen=$1 work=$2
tools=$(cd "$(dirname "$0")" && pwd)/cli_tools.sh
rm -rf "$work"
mkdir -p "$work" && cd "$work" || exit 2
unset OCIO OFX_PLUGIN_PATH
json_check=:

. "$tools"

# copy CODE WORDS...: a render without depth, which copies Source.
copy() {
    wanted=$1
    shift
    expect "$wanted" render LensBlur --no-progress "$@"
}

# red FILE EXPECTED: the mean of the first channel, to four digits.
red() {
    checks=$((checks + 1))
    found=$(oiiotool "$1" --printstats | sed -n 's/.*Avg: *\([0-9.]*\).*(float).*/\1/p; s/.*Avg: *\([0-9.]*\) .*/\1/p' | head -n 1)
    awk "BEGIN { exit !($found - $2 < $3 && $2 - $found < $3) }" || fail "$1: $found, not $2"
}

# labelled FILE PATTERN, unlabelled FILE PATTERN: what iinfo says of it.
labelled() {
    checks=$((checks + 1))
    iinfo -v "$1" >info 2>&1
    grep -q -e "$2" info || fail "$1 does not say $2"
}

unlabelled() {
    checks=$((checks + 1))
    iinfo -v "$1" >info 2>&1
    ! grep -q -e "$2" info || fail "$1 says $2"
}

oiiotool --pattern constant:color=0.18,0.02,0.02 16x8 3 -d float \
    --attrib colorInteropID lin_ap1_scene -o ap1.exr || exit 2

# An id goes on from file to file with its pixels.
copy 0 --clip Source=ap1.exr -o one.exr --bits float --report report.json
red one.exr 0.18 0.00001
labelled one.exr 'colorInteropID: "lin_ap1_scene"'
labelled one.exr 'chromaticities: 0.713'
value report.json frames.0.space ACEScg
value report.json clips.Source.space ACEScg
copy 0 --clip Source=one.exr -o two.exr --bits float
red two.exr 0.18 0.00001
copy 0 --clip Source=two.exr -o rec709.exr --bits float --out-space lin_rec709
red rec709.exr 0.2928 0.0001
labelled rec709.exr 'colorInteropID: "lin_rec709_scene"'
labelled rec709.exr 'chromaticities: 0.64'
unlabelled rec709.exr 'colorInteropID: "lin_ap1'
copy 0 --clip Source=rec709.exr -o again.exr --bits float
red again.exr 0.2928 0.0001
copy 0 --clip Source=ap1.exr -o screen.png --bits 16
red screen.png 37840 60
unlabelled screen.png 'colorInteropID: "lin_ap1'
labelled screen.png 'oiio:ColorSpace: "sRGB"'

# Each frame says for itself; where a farm cuts the sequence changes nothing.
cp ap1.exr in.0001.exr
oiiotool ap1.exr --attrib colorInteropID lin_rec709_scene -o in.0002.exr
oiiotool ap1.exr --resize 24x12 --ch R,G,B,A=0.5 --attrib colorInteropID lin_ap1_scene \
    -o in.0003.exr
copy 0 --clip 'Source=in.####.exr' --frames 1-3 -o 'all.####.exr' --out-space lin_rec709
for frame in 1 2 3; do
    copy 0 --clip 'Source=in.####.exr' --frames $frame -o 'cut.####.exr' --out-space lin_rec709
    same all.000$frame.exr cut.000$frame.exr
done
red all.0001.exr 0.2928 0.001
red all.0002.exr 0.18 0.001
red all.0003.exr 0.2928 0.001

# What cannot be said, and what is not understood.
copy 0 --clip Source=ap1.exr -o unsaid.tif --out-space ACEScg
says 'warning: unsaid.tif is in the colour space ACEScg, but its format cannot say so'
oiiotool ap1.exr --eraseattrib colorInteropID --attrib colorSpace 'House v2' -o house.exr
copy 0 --clip Source=house.exr -o house2.exr
says 'House v2, which the colour configuration does not know'
labelled house2.exr 'colorSpace: "House v2"'
unlabelled house2.exr colorInteropID:
oiiotool --pattern constant:color=1e6,1,1 16x8 3 -d float -o bright.exr
copy 0 --clip Source=bright.exr -o cut.exr
says 'beyond 65504'
oiiotool --pattern constant:color=1e36,1,1 16x8 3 -d float -o absurd.exr
oiiotool --pattern constant:color=2,2,2 16x8 1 --chnames Z -d float -o depth.exr
copy 0 --clip Source=absurd.exr --clip Depth=depth.exr:Z -o cut.exr --bits float --set samples=1
says 'beyond 1e30'

# A configuration of the first version, where what nobody knows is raw.
cat >config.ocio <<'END'
ocio_profile_version: 1
roles: {default: raw, scene_linear: lnf}
displays: {d: [!<View> {name: v, colorspace: sRGB}]}
colorspaces:
  - !<ColorSpace> {name: lnf}
  - !<ColorSpace> {name: sRGB, to_reference: !<ExponentTransform> {value: [2.2, 2.2, 2.2, 1]}}
  - !<ColorSpace> {name: raw, isdata: true}
END
oiiotool --pattern constant:color=0.5,0.5,0.5 16x8 3 -d uint16 -o grey.png
for suffix in png tif jpg; do
    copy 0 --clip Source=grey.png -o grey2.$suffix --ocio config.ocio
done
red grey2.png 127.5 0.6
red grey2.tif 32768 40
red grey2.jpg 127.5 0.6
copy 0 --clip Source=grey.png -o grey2.exr --ocio config.ocio
red grey2.exr 0.2176 0.0002

# Log with alpha beside it.
for alpha in 0.51 0.25 0.03; do
    oiiotool --pattern constant:color=0.5,0.5,0.5,$alpha 18x8 4 -d uint10 \
        --attrib oiio:ColorSpace KodakLog -o film.dpx
    copy 0 --clip Source=film.dpx -o film.exr
    red film.exr 0.2570 0.001
    copy 0 --clip Source=film.dpx -o film2.dpx
    oiiotool film.dpx film2.dpx --absdiff -o difference.exr
    red difference.exr 0 0.0001
done

finish
