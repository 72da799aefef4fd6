#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Copyright the WideOpen authors
#
# The camera of a file's metadata: the same bytes as the same camera by --set, from the file to the
# plugin; what is set by hand wins, what cannot be is said and left alone.
#
# usage: camera.sh WIDEOPEN EXR_TAG WORK_DIR
# Exit 0: everything as promised. 1: something is not (each is printed). 2: wrong use.

set -u

if [ $# -ne 3 ]; then
    echo "usage: camera.sh WIDEOPEN EXR_TAG WORK_DIR" >&2
    exit 2
fi
wideopen=$1 exr_tag=$2 work=$3
rm -rf "$work"
mkdir -p "$work" && cd "$work" || exit 2
unset OCIO OFX_PLUGIN_PATH

failures=0
checks=0

fail() {
    failures=$((failures + 1))
    echo "FAILED: $*"
    sed 's/^/    stderr: /' stderr
}

# blur SCENE OUT WORDS...: the scene through LensBlur; messages in stderr, the report in report.json.
blur() {
    scene=$1 out=$2
    shift 2
    checks=$((checks + 1))
    "$wideopen" render LensBlur --clip "Source=$scene" --clip "Depth=$scene:depth" --strict \
        --set samples=8 --no-progress --report report.json -o "$out" "$@" 2>stderr ||
        fail "render of $scene with $*"
}

same() {
    checks=$((checks + 1))
    cmp -s "$1" "$2" && return
    "$wideopen" compare "$1" "$2" --json >compared 2>stderr
    [ "$("$wideopen" json compared max_error)" = 0 ] || fail "$1 and $2 differ: $(cat compared)"
}

differ() {
    checks=$((checks + 1))
    "$wideopen" compare "$1" "$2" --json >compared 2>stderr || fail "compare $1 $2"
    [ "$("$wideopen" json compared max_error)" != 0 ] || fail "$1 and $2 do not differ"
}

says() {
    checks=$((checks + 1))
    grep -q -e "$1" stderr || fail "stderr does not say: $1"
}

# told N FIELD VALUE: entry N of the camera in the plugin's report.
told() {
    checks=$((checks + 1))
    found=$("$wideopen" json report.json "frames.0.reports.0.camera.$1.$2" 2>/dev/null)
    [ "$found" = "$3" ] || fail "camera.$1.$2 is \"$found\" instead of \"$3\""
}

"$wideopen" footage two-planes -o scene --size 96x64 --layers 0 --no-progress 2>stderr ||
    fail footage
tag() {
    checks=$((checks + 1))
    "$exr_tag" scene/pinhole.exr "$@" 2>stderr || fail "exr_tag $*"
}

# Our own names, and nothing: the defaults.
tag bare.exr
tag own.exr wideopen:focalLength=35 wideopen:sensorWidth=24 wideopen:fStop=1.4 \
    wideopen:focusDistance=1.8
blur bare.exr plain.exr
[ "$("$wideopen" json report.json frames.0.reports.0.camera)" = '[]' ] || fail "a camera of nothing"
blur bare.exr wanted.exr --set focalLength=35 --set sensorWidth=24 --set fStop=1.4 \
    --set focusDistance=1.8
blur own.exr got.exr
says 'camera of own.exr: focalLength 35, sensorWidth 24, fStop 1.4, focusDistance 1.8'
same wanted.exr got.exr
differ plain.exr got.exr
told 2 name wideopen:fStop
told 2 value 1.4
told 2 used true
blur own.exr got.exr --tile 16 --threads 2
same wanted.exr got.exr
blur own.exr got.exr --no-metadata
same plain.exr got.exr
blur own.exr got.exr --set cameraFrom=parameters
same plain.exr got.exr
told 2 used false
"$wideopen" render LensBlur --clip Source=own.exr --set fStop=4 --explain >explained 2>stderr
grep -q 'camera *focalLength 35 mm from wideopen:focalLength$' explained || fail "no origin told"
grep -q 'fStop 1.4 from wideopen:fStop: not used, the parameter is set by hand' explained ||
    fail "no parameter set by hand"

# What is set by hand wins, each alone, and what is called own.
blur bare.exr wanted.exr --set focalLength=35 --set sensorWidth=24 --set fStop=4 \
    --set focusDistance=1.8
blur own.exr got.exr --set fStop=4
same wanted.exr got.exr
blur own.exr got.exr --set fStop=@1:4,@2:8 --frames 1
same wanted.exr got.exr
blur bare.exr wanted.exr --set focalLength=35 --set sensorWidth=24 --set fStop=1.4
blur own.exr got.exr --set cameraFrom=metadataOwnFocus
same wanted.exr got.exr
blur bare.exr wanted.exr --set focalLength=35 --set sensorWidth=24 --set focusDistance=1.8
blur own.exr got.exr --set cameraFrom=metadataOwnFNumber
same wanted.exr got.exr
blur bare.exr wanted.exr --set focalLength=35 --set sensorWidth=24
blur own.exr got.exr --set cameraFrom=metadataOwnFocusAndFNumber
same wanted.exr got.exr

# V-Ray: the angle of view makes the sensor.
tag vray.exr cameraFocalLength=35 cameraAperture=36 cameraFov=37.8493 cameraFNumber=2 \
    cameraNearClip=0 cameraFarClip=1e30 cameraTargetDistance=2
blur vray.exr got.exr
says 'cameraTargetDistance of vray.exr is not used'
says 'cameraFarClip of vray.exr is not used'
told 1 name cameraFov
width=$("$wideopen" json report.json frames.0.reports.0.camera.1.value)
blur bare.exr wanted.exr --set focalLength=35 --set "sensorWidth=$width" --set fStop=2
same wanted.exr got.exr

# Unreal: texts, centimetres, of distances and of the depth.
pass=unreal/camera/FinalImage
tag unreal.exr $pass/focalLength::text=35.0 $pass/sensorWidth::text=23.76 $pass/fstop::text=2.8 \
    $pass/focalDistance::text=2.25 $pass/minFStop::text=1.2
blur unreal.exr got.exr
blur bare.exr wanted.exr --set focalLength=35 --set sensorWidth=23.76 --set fStop=2.8 \
    --set focusDistance=0.0225 --set depthScale=100
same wanted.exr got.exr

# OpenEXR's own names, with a sensor of photosites; near and far of normalised depth.
tag standard.exr pinholeFocalLength=40 aperture=2 focus=3 tStop=2.2 sensorPhotositePitch=8.25 \
    'sensorAcquisitionRectangle::box2i=272 0 3151 1619' wideopen:near=0.5 wideopen:far=20
blur standard.exr got.exr --set depthMode=3
says 'tStop of standard.exr is not used'
blur bare.exr wanted.exr --set focalLength=40 --set sensorWidth=23.76 --set fStop=2 \
    --set focusDistance=3 --set near=0.5 --set far=20 --set depthMode=3
same wanted.exr got.exr

# RenderMan: units of the scene, which the parameter gives.
tag prman.exr focal=50 haperture=36 fstop=2 focaldistance=300
blur prman.exr got.exr --set depthScale=100
blur bare.exr wanted.exr --set focalLength=50 --set sensorWidth=36 --set fStop=2 \
    --set focusDistance=3 --set depthScale=100
same wanted.exr got.exr

# What cannot be.
tag bad.exr wideopen:fStop=nan wideopen:focalLength=-50 wideopen:sensorWidth=inf \
    wideopen:focusDistance::text=near wideopen:near=0 aperture=1e-30
blur bad.exr got.exr
says 'wideopen:fStop of bad.exr is not used'
says 'wideopen:sensorWidth of bad.exr is not used'
same plain.exr got.exr

# Every frame has a camera of its own.
tag in.0001.exr focus=1
tag in.0002.exr focus=5
blur 'in.####.exr' 'moved.####.exr' --frames 1-2
blur bare.exr wanted.exr --set focusDistance=5
same wanted.exr moved.0002.exr
blur bare.exr wanted.exr --set focusDistance=1
same wanted.exr moved.0001.exr

echo "$checks checks, $failures failed"
[ "$failures" -eq 0 ]
