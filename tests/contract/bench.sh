#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Copyright the WideOpen authors
#
# `wideopen bench` from outside: files, tables, JSON, methods that fail, mistakes. TRICKS is a folder
# with a plugin that only pretends to be LensBlur, with noise of a known size.
#
# usage: bench.sh WIDEOPEN JSON_CHECK WORK_DIR TRICKS
# Exit 0: everything as promised. 1: something is not (each is printed). 2: wrong use.

set -u

if [ $# -ne 4 ]; then
    echo "usage: bench.sh WIDEOPEN JSON_CHECK WORK_DIR TRICKS" >&2
    exit 2
fi
wideopen=$1 json_check=$2 work=$3 tricks=$4
tools=$(cd "$(dirname "$0")" && pwd)/cli_tools.sh
rm -rf "$work"
mkdir -p "$work" && cd "$work" || exit 2
unset OCIO OFX_PLUGIN_PATH

. "$tools"

# table FILE PROGRAM: awk over the rows of a CSV file with the fields in f[1..n], head line first.
table() {
    checks=$((checks + 1))
    awk '
        function fields(line, count, field, c, i, quoted) {
            count = 1; field = ""; quoted = 0
            for (i = 1; i <= length(line); i++) {
                c = substr(line, i, 1)
                if (c == "\"" && quoted && substr(line, i + 1, 1) == "\"") { field = field c; i++ }
                else if (c == "\"") quoted = !quoted
                else if (c == "," && !quoted) { f[count++] = field; field = "" }
                else field = field c
            }
            f[count] = field
            return quoted ? -1 : count
        }
        { n = fields($0) }
        '"$2" "$1" >table_faults || fail "$1: $(head -3 table_faults)"
}

# ---------------------------------------------------------------------------------------- mistakes

expect 0 bench --help
shows 'wideopen bench'
mistake() {
    expect 2 bench -o none "$@"
    silent
    absent none
}
expect 2 bench
says '-o DIR'
mistake --scenes no-such-scene
says still-life
mistake --scenes fence,fence
says fence
mistake --scenes fence,,hair
mistake --methods nonsense
says rays
mistake --methods rays,rays
mistake --methods rays --judge reference
says reference
mistake --samples 16,many
says many
mistake --samples 16,16
mistake --samples 0
mistake --samples 1.5
mistake --targets 2
mistake --samples none --targets none
mistake --given all
mistake --repeats 0
mistake --repeats 17
mistake --size 64
mistake --tolerance 2
mistake --clock sun
mistake --set fStop
mistake --set fStop=-1
mistake --set samples=4
says 'sets it itself'
mistake --set nonsense=1
mistake surplus
echo file >plain
expect 1 bench -o plain --quick
says plain

# --------------------------------------------------------------- noise of a known size, and failures

scenes=two-planes,slanted-plane
bench() {
    expect "$@" --size 64x36 --reference 16 --no-progress
}
bench 1 bench -o out --scenes $scenes --plugin-path "$tricks" \
    --methods rays,hybrid,liar,broken,holes --samples 4,16 --targets 0.02,0.01 --repeats 2 \
    --converged 16384 --json
says bench.html
says failed
is_json stdout
cp stdout out.json
for file in bench.csv bench.html two-planes-layers.svg two-planes-sd.svg slanted-plane-layers.svg \
    slanted-plane-sd.svg; do
    present out/$file
done
for drawing in out/*.svg out/bench.html; do
    checks=$((checks + 1))
    ! grep -q -i -e ' d="[^"]*[ni]n' "$drawing" || fail "$drawing: points without numbers"
done
for drawing in out/*.svg; do
    well_formed "$drawing"
done
checks=$((checks + 1))
[ "$(grep -c '<svg' out/bench.html)" -eq 4 ] || fail "bench.html does not show 4 plots"
checks=$((checks + 1))
! grep -q -e 'src=' -e '<link' -e '<script' out/bench.html || fail "bench.html needs other files"

# 2 scenes, as given twice, 5 methods, 4 settings.
table out/bench.csv 'n != 21 { print "fields: " n " in " $0; bad = 1 }
    END { if (NR != 81) { print NR " lines"; bad = 1 } exit bad }'
table out/bench.csv 'NR > 1 {
    wanted = f[3] == "broken" || f[3] == "holes" && f[4] == "samples" ? "failed" : "done"
    if (f[4] == "target" && f[3] != "hybrid" && f[3] != "liar") wanted = f[3] == "broken" ? "failed" : f[6]
    if (f[3] == "rays" && f[4] == "target") wanted = "left out"
    if (f[6] != wanted) { print f[6] " instead of " wanted ": " $0; bad = 1 }
    if (f[6] == "done" && (f[7] != 2 || !(f[8] > 0) || !(f[9] > 0) || !(f[12] > 0) || !(f[15] > 0))) {
        print "numbers: " $0; bad = 1
    }
    if (f[6] == "failed" && f[21] == "") { print "no reason: " $0; bad = 1 }
    } END { exit bad }'
table out/bench.csv 'function near(a, b) { return a > 0.93 * b && a < 1.07 * b }
    f[6] == "done" {
        noise = f[4] == "target" ? 0.9 * f[5] : (f[3] == "rays" ? 0.2 : 0.1) / sqrt(f[5])
        if (!near(f[17], noise)) { print "sampling error: " $0; bad = 1 }
        if (f[3] == "hybrid" && !near(f[18], 1)) { print "calibration: " $0; bad = 1 }
        if (f[3] == "liar" && !near(f[18], 3)) { print "calibration: " $0; bad = 1 }
        if (f[3] == "rays" && f[16] != "") { print "estimate: " $0; bad = 1 }
        seen++
    } END { if (seen != 40) { print seen " are done"; bad = 1 } exit bad }'
checks=$((checks + 1))
grep -q 'this method, ""broken"", never works"' out/bench.csv || fail "a reason is not quoted"
value out.json judged hybrid
value out.json scenes.0.scene two-planes
value out.json scenes.0.given layers
value out.json scenes.0.layers 2
value out.json scenes.1.given sd
value out.json scenes.0.points.4.method hybrid
value out.json scenes.0.points.4.state done
value out.json scenes.0.points.4.runs 2
value out.json scenes.0.points.12.state failed
value out.json summary.layers.scenes 2
value out.json summary.calibration.renders 64
value out.json summary.calibration.within 32

# Footage is made once.
checks=$((checks + 1))
touch marker
bench 0 bench -o out --scenes $scenes --plugin-path "$tricks" --methods rays,hybrid --samples 4 \
    --targets none --repeats 1 --converged 0 --given sd --clock cpu
newer=$(find out/footage -type f -newer marker)
[ -z "$newer" ] || fail "made again: $newer"
shows 'two-planes, sd: 64x36'
shows 'On the front'
shows 'hybrid'
table out/bench.csv 'n != 21 || f[17] != "" && NR > 1 { print; bad = 1 }
    END { if (NR != 5) { print NR " lines"; bad = 1 } exit bad }'

# Folders as scenes; one that holds nothing does not stop the others.
mkdir empty
footage=$(ls -d out/footage/two-planes-*)
bench 1 bench -o folders --scene-dir empty --scene-dir "$footage/" --plugin-path "$tricks" \
    --methods rays --samples 4 --targets none --repeats 1 --converged 0 --crop 2 --json
is_json stdout
cp stdout folders.json
value folders.json scenes.0.state 'left out'
value folders.json scenes.1.state failed
value folders.json scenes.2.state done
table folders/bench.csv 'n != 21 { print; bad = 1 } f[1] == "empty" { states = states f[6] ";" }
    END { if (NR != 5 || states != "left out;failed;") { print NR ", " states; bad = 1 } exit bad }'
present folders/"$(basename "$footage")"-layers.svg
absent folders/empty-sd.svg
absent folders/footage

# A render that does not end, by its limit and by an interrupt.
bench 1 bench -o out --scenes two-planes --plugin-path "$tricks" --methods sleepy --given sd \
    --samples 4 --targets none --converged 0 --limit 0.2 --json
cp stdout sleepy.json
value sleepy.json scenes.0.points.0.state failed
value sleepy.json scenes.0.points.0.why 'stopped after 0.2 s, see --limit'
checks=$((checks + 1))
timeout --preserve-status -s INT 2 "$wideopen" bench -o out --scenes two-planes --size 64x36 \
    --reference 16 --plugin-path "$tricks" --methods sleepy --converged 0 --no-progress \
    >stdout 2>stderr
code=$?
[ "$code" -eq 130 ] || fail "interrupted: exit code $code instead of 130"

# --------------------------------------------------------------------------- the plugin as it is

bench 0 bench -o real --scenes two-planes --samples 4 --targets 0.05 --repeats 1 --converged 16
table real/bench.csv 'n != 21 || f[6] == "failed" { print; bad = 1 } END { exit bad }'
table real/bench.csv 'f[3] == "rays" && f[4] == "samples" && f[6] == "done" { seen++ }
    END { if (seen != 2) print seen " rows of rays"; exit seen != 2 }'
well_formed real/two-planes-layers.svg

finish
