#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Copyright the WideOpen authors
#
# The command line from outside: exit codes, what goes to stdout and what to stderr, JSON, files.
#
# usage: cli.sh WIDEOPEN JSON_CHECK WORK_DIR
# Exit 0: everything as promised. 1: something is not (each is printed). 2: wrong use.

set -u

if [ $# -ne 3 ]; then
    echo "usage: cli.sh WIDEOPEN JSON_CHECK WORK_DIR" >&2
    exit 2
fi
wideopen=$1 json_check=$2 work=$3
tools=$(cd "$(dirname "$0")" && pwd)/cli_tools.sh
rm -rf "$work"
mkdir -p "$work" && cd "$work" || exit 2
unset OCIO OFX_PLUGIN_PATH

. "$tools"

# ------------------------------------------------------------------------------- help and mistakes

for command in list describe render footage lens compare bench sheet json; do
    expect 0 "$command" --help
    shows "wideopen $command"
done
expect 0 --help
shows footage
expect 0 --version
shows '^wideopen [0-9]'
expect 2
expect 2 rendr
says 'did you mean render'
silent
expect 2 list --jsn
says 'did you mean --json'
expect 2 describe
says PLUGIN
expect 2 describe NoSuchPlugin
says NoSuchPlugin
says LensBlur
expect 2 render LensBlur --clip Source=a.exr
says 'give -o FILE'
expect 2 compare one
expect 2 json
expect 1 json missing.json
says missing.json
printf '{"a": [1, ' >broken.json
expect 1 json broken.json
expect 1 list --plugin-path missing-folder
says missing-folder

# ------------------------------------------------------------------------------- list and describe

expect 0 list
shows 'org.wideopen.LensBlur'
expect 0 list --json
is_json stdout
cp stdout list.json
checks=$((checks + 1))
grep -q '"identifier": "org.wideopen.LensBlur"' list.json || fail "list --json lacks LensBlur"
expect 0 describe LensBlur
shows focusDistance
shows Depth4
expect 0 describe org.wideopen.LensBlur --json
is_json stdout
cp stdout describe.json
value describe.json identifier org.wideopen.LensBlur
expect 2 describe LensBlur --context Paint
says Paint
expect 2 describe lensblur
says 'no plugin "lensblur"; did you mean org.wideopen.LensBlur$'
expect 2 describe 'Lens Blur'
says 'no plugin "Lens Blur"; did you mean org.wideopen.LensBlur$'
expect 0 render LensBlur --help
shows fStop
shows 'default'
expect 0 describe LensBlur --plugin-path .

# ---------------------------------------------------------------------------------------- footage

expect 0 footage two-planes -o scene --size 96x64 --layers 2 --reference 16 --no-progress
silent
scene=scene/pinhole.exr
reference=scene/reference.exr
present "$scene"
present "$reference"
present scene/layers.exr
expect 2 footage no-such-scene -o scene2
says still-life
expect 2 footage two-planes -o scene2 --size 96
absent scene2

# ------------------------------------------------------------------------------------------- lens

expect 0 lens list
shows '^biotar_zeiss_100_f14 '
expect 0 lens list --json
is_json stdout
cp stdout lenses.json
value lenses.json 0.name "$("$wideopen" lens list | sed -n '1s/ .*//p')"
"$wideopen" lens list | while read -r lens title; do
    "$wideopen" lens "$lens" --json >lens.json 2>stderr || echo "$lens $title"
    "$json_check" <lens.json 2>>stderr || echo "$lens $title"
done >broken_lenses
checks=$((checks + 1))
[ ! -s broken_lenses ] || fail "lenses without data: $(cat broken_lenses)"

expect 0 lens biotar_zeiss_100_f14
shows 'focal length'
silent_error
expect 0 lens biotar_zeiss_100_f14 --json
is_json stdout
cp stdout lens.json
for key in efl bfd ffd H1 H2 ep_z ep_d xp_z xp_d fno oal f_number half_field image petzval_radius \
    seidel.sums.4 seidel.chromatic_sums.1 seidel.born_wolf.4 aberration.0.pupil_radius \
    aberration.0.lines.2.focus_shift.32 aberration.0.lines.2.slope.32 pencils.pupil_radius \
    pencils.zones.32 pencils.lines.2.vergence_shift.32 field.lit_iris.24 field.illumination.24 \
    field.distortion.24 field.image_height.24 spots.2.rms; do
    checks=$((checks + 1))
    "$wideopen" json lens.json "$key" >key 2>stderr || fail "lens --json lacks $key"
done
value lens.json name biotar_zeiss_100_f14
expect 0 lens biotar_zeiss_100_f14 --json --wavelength 486.1327 --fnumber 4
value stdout wavelength 486.1327
value stdout fno 4
expect 2 lens biotar_zeis_100_f14
says 'did you mean biotar_zeiss_100_f14'
expect 2 lens nothing_of_the_kind_at_all
says 'wideopen lens list'
expect 1 lens missing.lens
says missing.lens
expect 1 lens biotar_zeiss_100_f14 --fnumber 0.5
says 'wider than'
expect 2 lens biotar_zeiss_100_f14 --wavelength 10
expect 2 lens biotar_zeiss_100_f14 --field 151
expect 1 lens biotar_zeiss_100_f14 --field 95 --focus 2
says '95 degrees.*2 m'
expect 2 lens biotar_zeiss_100_f14 --meridian z
expect 1 lens biotar_zeiss_100_f14 --focus 0.01
expect 2 lens

# A single lens by the columns of a pbrt file, and the same with a mistake in its fourth line.
cat >single.dat <<'END'
# radius thickness index diameter
50 6 1.5168 20
-50 2 1 20
0 40 1 16
END
expect 0 lens single.dat --json
is_json stdout
value stdout name single
sed '4s/40/fourty/' single.dat >wrong.dat
expect 1 lens wrong.dat
says 'wrong.dat.*4'
expect 1 lens wrong.dat --page wrong.svg
absent wrong.svg
head -c 1100000 /dev/zero >large.lens
expect 1 lens large.lens
says 'longer than'
: >empty.lens
expect 1 lens empty.lens

expect 0 lens single.dat --section section.svg --aberration aberration.svg --spots spots.svg \
    --vignetting vignetting.svg --page page.svg --bokeh strip.png --focus 2 --field 10
silent
silent_error
for drawing in section aberration spots vignetting page; do
    present $drawing.svg
    well_formed $drawing.svg
    checks=$((checks + 1))
    ! grep -q -i -e ' d="[^"]*[ni]n' $drawing.svg || fail "$drawing.svg: points without numbers"
done
present strip.png
expect 0 lens biotar_zeiss_100_f14 --pencil-map map.exr
present map.exr
expect 1 lens biotar_zeiss_100_f14 --pencil-map missing-folder/map.exr
expect 1 lens biotar_zeiss_100_f14 --bokeh missing-folder/strip.png
expect 0 lens single.dat --page again.svg --focus 2 --field 10 --json
is_json stdout
checks=$((checks + 1))
cmp -s page.svg again.svg || fail "two drawings of one lens differ"
expect 0 lens anamorphic_schneider_31 --page anamorphic.svg
well_formed anamorphic.svg

# An iris in the rear focus: telecentric in object space. Its f-number is what the clear radius leaves.
cat >telecentric.lens <<'END'
lens 1
name telecentric
surface 51.68 4 1.5168 10
surface -51.68 49.33190807055051 air 10
surface 0 30 air 5 stop
END
expect 0 lens telecentric.lens --json
is_json stdout
value stdout fno null
value stdout ep_d null
expect 0 lens telecentric.lens --page telecentric.svg --focus 0.2
checks=$((checks + 1))
grep -q 'f/2\.[45]' telecentric.svg && ! grep -q 'f/0\.00' telecentric.svg ||
    fail "the page of a telecentric lens has no f-number"

# The longest title stays on the page; a sensor far away is noted.
{
    echo 'lens 1'
    printf 'title '
    head -c 127 /dev/zero | tr '\0' 'W'
    printf '\nname long\nfield 3\nsurface 5000 4 1.5168 10 stop\nsurface 0 9000 air 10\n'
} >long.lens
expect 0 lens long.lens --page long.svg --section long-section.svg
checks=$((checks + 2))
# 1 em is as wide as any letter.
sed -n 's/.*font-size="\([0-9.]*\)"[^>]*>\(WW*\).*/\1 \2/p' long.svg |
    awk '{ if ($1 * length($2) > 1280 - 28) exit 1 }' || fail "a long title leaves the page"
grep -q 'the sensor is not drawn: z = 9[0-9]*\.[0-9] mm' long-section.svg ||
    fail "a sensor outside of the section is not noted"

echo old >kept.svg
expect 1 lens single.dat --page missing-folder/page.svg
says missing-folder
expect 1 lens single.dat --fnumber 0.5 --page kept.svg
checks=$((checks + 1))
[ "$(cat kept.svg)" = old ] || fail "a failed drawing touched kept.svg"
if [ -c /dev/full ]; then
    expect 1 lens single.dat --page /dev/full
    says /dev/full
fi

# ----------------------------------------------------------------------------------------- compare

expect 0 compare "$reference" "$reference" --json
is_json stdout
cp stdout equal.json
value equal.json psnr null
value equal.json max_error 0
value equal.json nonfinite 0
expect 0 compare "$reference" "$scene" --json --crop 4 --diff diff.png
is_json stdout
present diff.png
expect 1 compare "$reference" missing.exr
says missing.exr
silent
expect 1 compare "$reference" "$reference" --crop 40
expect 2 compare "$reference" "$reference" --crop -1
expect 2 compare "$reference" "$reference" --in-space NoSuchSpace
says NoSuchSpace

expect 0 footage two-planes -o wide --size 96x64 --layers 1 --overscan 6 --no-progress
expect 0 compare "$scene" wide/pinhole.exr --json
value stdout max_error 0
expect 1 compare wide/pinhole.exr "$scene"
says "sizes differ"
expect 1 footage two-planes -o wide --size 96x64 --overscan 7 --no-progress
says overscan

# ------------------------------------------------------------------------------------------ render

# blur WANTED_CODE WORDS...
blur() {
    wanted=$1
    shift
    expect "$wanted" render LensBlur --clip "Source=$scene" --clip "Depth=$scene:depth" \
        --set samples=8 --no-progress "$@"
}

# psnr REF OUT: as a number, for comparisons.
psnr() {
    "$wideopen" compare "$1" "$2" --json | "$wideopen" json - psnr
}

above() {
    checks=$((checks + 1))
    awk "BEGIN { exit !($1 > $2) }" || fail "$1 is not above $2: $3"
}

blur 0 -o out.exr --report report.json --strict
silent
says 'camera of'
is_json report.json
value report.json ok true
value report.json error null
value report.json frames.0.output out.exr
value report.json frames.0.window '[0, 0, 96, 64]'
value report.json params.samples 8
above "$("$wideopen" json report.json rays)" 0 "rays of the report"
expect 0 compare "$reference" out.exr
above "$(psnr "$reference" out.exr)" "$(psnr "$reference" "$scene")" "blurred against sharp"

expect 0 render LensBlur --clip Source=scene/layers.exr:layer1 --no-progress \
    --clip Depth=scene/layers.exr:layer1_depth --clip Layer2=scene/layers.exr:layer2 \
    --clip Depth2=scene/layers.exr:layer2_depth --set samples=64 -o layers.exr
above "$(psnr "$reference" layers.exr)" "$(psnr "$reference" out.exr)" "layers against one picture"

blur 0 -o again.exr --json --no-metadata
is_json stdout
checks=$((checks + 1))
! grep -q 'camera of' stderr || fail "--no-metadata still takes the camera"

blur 0 -o tiles.exr --tile 16
same out.exr tiles.exr
blur 0 -o one.exr --threads 1
same out.exr one.exr
blur 0 -o three.exr --threads 3 --context Filter
blur 0 -o set.exr --set fStop=2.8 --set focusDistance=3 --set seed=7
blur 0 -o window.exr --window 10,5,50,40 --report report.json
value report.json frames.0.window '[10, 5, 50, 40]'
expect 1 compare out.exr window.exr
says 'sizes differ'
blur 0 -o half.exr --scale 0.5
expect 1 compare out.exr half.exr
says 48x32
blur 0 -o seen.png
above "$(psnr out.exr seen.png)" 40 "PNG against EXR"
blur 0 -o float.exr --bits float --out-space ACEScg
blur 0 -o plain.exr --report /dev/stdout
is_json stdout

blur 0 --explain
shows samples
blur 0 --explain --json -o explained.exr
is_json stdout
absent explained.exr

# Sequences: one picture for each frame, animated parameters.
cp "$scene" in.0001.exr
cp "$scene" in.0002.exr
sequence() {
    wanted=$1
    shift
    expect "$wanted" render LensBlur --clip 'Source=in.####.exr' --clip 'Depth=in.%04d.exr:depth' \
        --set samples=4 --no-progress "$@"
}
sequence 0 --frames 1-2 -o 'moved.####.exr' --set focusDistance=@1:1,@2:50 --report report.json
present moved.0001.exr
present moved.0002.exr
value report.json frames.1.frame 2
value report.json keys.focusDistance 2
above 60 "$(psnr moved.0001.exr moved.0002.exr)" "frames of a focus pull"
sequence 0 --frames 2 -o still.exr --set 'focusDistance@1:1,focusDistance@2:50'
same still.exr moved.0002.exr
sequence 1 --frames 2-3 -o 'late.####.exr' --report report.json
says 0003
value report.json ok false
absent late.0003.exr
sequence 2 -o 'out.####.exr'
says 'as in --frames 1-2'
sequence 2 --frames 1-2 -o out.exr
says '####'
sequence 2 --frames 2-1 -o 'out.####.exr'

# What was given, what is allowed, what to do.
blur 2 -o x.exr --set fstop=2
says 'did you mean fStop'
blur 2 -o x.exr --set fStop=-1
says 'fStop'
blur 2 -o x.exr --set fStop=nan
blur 2 -o x.exr --set fStop
blur 2 -o x.exr --set output=nonsense
says 'Focus plane'
blur 0 -o keys.exr --set output=coc --set depthMode=distance --set depthChannel=red \
    --set edgeRepair=colour
blur 2 -o x.exr --clip Backdrop=a.exr
says Layer2
blur 2 -o x.exr --clip "Source=$scene"
says twice
blur 2 -o x.exr --scale 2
blur 2 -o x.exr --window 1,2,3
blur 2 -o x.exr --threads 0
blur 2 -o x.exr --bits 12
blur 2 -o x.exr --in-space Nowhere
says ACEScg
blur 2 -o x.exr --out-space Nowhere
blur 2 -o x.exr --context Paint
blur 2 -o x.exr --raw Mask
blur 2 -o x.exr surplus
expect 2 render LensBlur -o x.exr
says 'needs clip Source'
says 'wideopen render org.wideopen.LensBlur --help lists'
blur 1 -o x.exr --clip Mask=missing.exr
says missing.exr
blur 1 -o x.exr --clip "Mask=$scene:nonsense"
says nonsense
head -c 500 "$scene" >cut.exr
blur 1 -o x.exr --clip Mask=cut.exr
echo 'no picture' >text.exr
blur 1 -o x.exr --clip Mask=text.exr
blur 1 -o missing-folder/x.exr
says missing-folder
mkdir folder.exr
blur 1 -o folder.exr
says 'cannot write folder.exr: it exists and is no ordinary file'
blur 1 -o x.gif
says exr
blur 1 -o x.exr --bits 8
blur 1 -o x.hdr --bits half
says 'the samples of hdr are float only; see --bits'
blur 1 -o x.png --bits float
says 'the samples of png are 8 or 16 only'
blur 1 -o x.exr --ocio missing.ocio
says 'cannot read the OpenColorIO configuration missing.ocio: No such file'
blur 1 -o x.exr --report missing-folder/report.json
rm -f x.exr
blur 1 -o x.exr --window 1000,0,1010,10
absent x.exr

# A failing render leaves an older file alone; so does an interrupted one.
echo old >kept.exr
blur 1 -o kept.exr --window 1000,0,1010,10
rm -f report.json
expect 0 footage two-planes -o large --size 384x256 --layers 1 --no-progress
checks=$((checks + 1))
timeout --preserve-status -s INT 2 "$wideopen" render LensBlur --clip "Source=large/pinhole.exr" \
    --clip "Depth=large/pinhole.exr:depth" --set samples=16384 --set fStop=0.7 -o kept.exr \
    --report report.json --no-progress >stdout 2>stderr
code=$?
[ "$code" -eq 130 ] || fail "interrupted: exit code $code instead of 130"
says interrupted
value report.json ok false
checks=$((checks + 1))
[ "$(cat kept.exr)" = old ] || fail "a failed render touched kept.exr"

# ---------------------------------------------------------------------------------- sheet, the rest

expect 0 sheet "sharp=$scene" 'blurred|8 rays=out.exr' -o sheet.png --title 'Two planes' --columns 2
present sheet.png
expect 0 sheet "scaled=$scene*0.5" 'empty=' 'last=out.exr' -o scaled.png --columns 3
present scaled.png
expect 2 sheet out.exr -o x.png
expect 2 sheet a=out.exr
expect 1 sheet a=missing.exr -o x.png
absent x.png

if [ -c /dev/full ]; then
    checks=$((checks + 1))
    "$wideopen" describe LensBlur >/dev/full 2>stderr
    code=$?
    [ "$code" -eq 1 ] || fail "a full disk under stdout: exit code $code instead of 1"
fi

finish
