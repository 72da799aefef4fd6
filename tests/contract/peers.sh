#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Copyright the WideOpen authors
#
# footage/peers.sh without the tools that it compares with: a small scene, one setting of ours, and a
# program in gegl's place that hands the picture on.
#
# usage: peers.sh PEERS WIDEOPEN WORK_DIR
# Exit 0: everything as promised. 1: something is not (each is printed). 2: wrong use. 77: what
# peers.sh needs is not installed.

set -u

if [ $# -ne 3 ]; then
    echo "usage: peers.sh PEERS WIDEOPEN WORK_DIR" >&2
    exit 2
fi
peers=$1 wideopen=$2 work=$3
for program in bash oiiotool taskset; do
    command -v $program >/dev/null || exit 77
done
rm -rf "$work"
mkdir -p "$work/tools" && cd "$work" || exit 2
failures=0

# must CODE WORDS COMMAND...: the command must end with this code and say these words.
must() {
    code=$1 words=$2
    shift 2
    "$@" >said 2>&1 </dev/null
    found=$?
    if [ "$found" -ne "$code" ] || ! grep -q -e "$words" said; then
        echo "FAILED: code $found instead of $code, or it does not say \"$words\": $*"
        sed 's/^/    /' said
        failures=$((failures + 1))
    fi
}

# Only what the script itself needs can be found, and our own gegl.
for program in bash chmod env ln sh awk basename cat dirname grep mkdir oiiotool rm sed taskset tr; do
    ln -s "$(command -v $program)" "tools/$program"
done
# shellcheck disable=SC2123 # it is the search path that is meant
PATH=$work/tools
export PATH

must 2 usage "$peers"
must 2 usage "$peers" --clock sun -o out "$wideopen" scene
must 2 usage "$peers" --cores 0 -o out "$wideopen" scene
must 2 'fewer than 9999' "$peers" --cores 9999 -o out "$wideopen" scene
must 1 'apt-get install.* gegl gmic .*imagemagick.* blender$' "$peers" --missing
must 2 'no gegl-lens-blur' "$peers" --only gegl-lens-blur -o out "$wideopen" scene
must 2 'no scene/pinhole.exr' "$peers" --only filter-4 -o out "$wideopen" scene

# shellcheck disable=SC2016 # for the program to expand
printf '#!/bin/sh\ncat "$1" >"$3"\n' >tools/gegl
chmod +x tools/gegl
must 0 '' "$wideopen" footage still-life -o scene --size 96x54 --reference 16 --no-progress
must 0 'gegl-lens-blur is beaten by filter-16\|NOT beaten: filter-16' \
    "$peers" --only gegl-lens-blur,filter-16 --repeats 2 -o out "$wideopen" scene
must 0 'all there' sh -c 'grep -q "</svg>" out/scene.svg && grep -q gegl-lens-blur out/scene.svg &&
    [ -s out/scene/filter-16.exr ] && echo all there'
# shellcheck disable=SC2016 # for awk to expand
# A row each: as many fields as the head, times and errors above zero.
must 0 '2 rows' awk -F , 'NR > 1 && NF == 12 && $6 == 2 && $7 > 0 && $8 > 0 && $9 > 10 && $12 > 0 {
    n++ } END { print n, "rows" }' out/peers.csv

plot=$(dirname "$wideopen")/plot_points
must 2 usage "$plot" only three words
must 1 'no lines of' sh -c "echo no points | $plot title x y plot.svg"
must 0 '2 dots' sh -c "printf 'a\tfirst\t0.5\t0.01\na\tnext\t1\t0.001\n.b\tnone\t0\t-1\n' |
    $plot title x y plot.svg && echo \$(grep -c -e '>first<' -e '>next<' -e '>none<' plot.svg) dots"

printf '#!/bin/sh\necho no memory\nexit 1\n' >tools/gegl
must 1 'gegl-lens-blur failed' \
    "$peers" --only gegl-lens-blur --repeats 1 -o out "$wideopen" scene

[ $failures -eq 0 ]
