#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright the WideOpen authors
#
# The pictures of core/effects/lens_blur.md: what every parameter does, one sheet for each group.
# Which, is in parameter_pictures.txt.
#
# usage: parameter_pictures.sh WIDEOPEN WORK_FOLDER PICTURES_FOLDER [GROUP ...]
set -euo pipefail

[ $# -ge 3 ] || { sed -n '8p' "$0" >&2; exit 2; }
wideopen=$1 work=$2 pictures=$3
shift 3
list=$(dirname "$0")/parameter_pictures.txt
columns=6
mkdir -p "$work" "$pictures"

# Footage: made once. $1 scene, $2 size.
footage() {
    local folder=$work/$1-$2
    [ -e "$folder/scene.json" ] ||
        "$wideopen" footage "$1" -o "$folder" --size "$2" --layers 4 \
            --overscan $((${2#*x} / 11)) --no-progress > /dev/null 2>&1
    echo "$folder"
}

layers_of() {
    local k
    clips=(--clip "Source=$1/layers.exr:layer1" --clip "Depth=$1/layers.exr:layer1_depth")
    for k in 2 3 4; do
        clips+=(--clip "Layer$k=$1/layers.exr:layer$k" --clip "Depth$k=$1/layers.exr:layer${k}_depth")
    done
}

pinhole_of() {
    clips=(--clip "Source=$1/pinhole.exr" --clip "Depth=$1/pinhole.exr:depth")
}

# A shot: clips, window (y up) and settings to start from.
shot() {
    local folder mask unit soft
    camera=(--no-metadata)
    window=0,0,320,180
    settings=(fStop=0.7 focusDistance=3.3 samples=256)
    case $1 in
    table | near)
        layers_of "$(footage still-life 320x180)"
        window=90,30,218,102
        [ "$1" = table ] || settings+=(focusDistance=0.25 fStop=8) ;;
    wide)
        layers_of "$(footage still-life 320x180)"
        settings+=(focalLength=20 fStop=0.1) ;;
    unit) # depth is 0..1 for 0..10 m
        folder=$(footage still-life 320x180)
        pinhole_of "$folder"
        unit=$work/unit.exr
        [ -e "$unit" ] || "$wideopen" render LensBlur "${clips[@]}" --no-metadata --no-progress \
            --bits float --set depthScale=10 --set output=depth -o "$unit" 2> /dev/null
        clips=(--clip "Source=$folder/pinhole.exr" --clip "Depth=$unit:R")
        settings+=(depthMode=normalised near=1e-6 far=10)
        window=90,30,218,102 ;;
    metadata)
        pinhole_of "$(footage still-life 320x180)"
        camera=() settings=(samples=256) ;;
    floor | points | clip)
        folder=$(footage slanted-plane 320x180)
        pinhole_of "$folder"
        settings=(fStop=0.35 focusDistance=1.3 samples=256)
        settings+=("focusPoint1=160,30" "focusPoint2=40,60" "focusPoint3=280,60")
        settings+=("focusPoint4=160,150")
        [ "$1" != points ] || settings+=(focusBy=surface focusPoints=4 focusOffset1=1)
        [ "$1" != clip ] ||
            clips+=(--clip "Focus=$(footage still-life 320x180)/pinhole.exr:depth") ;;
    channels)
        folder=$(footage still-life 320x180)
        clips=(--clip "Source=$folder/pinhole.exr" --clip "Depth=$folder/pinhole.exr:R,G,B,A")
        settings+=(depthMode=normalised near=1 far=5) ;;
    mask)
        folder=$(footage still-life 320x180)
        layers_of "$folder"
        mask=$work/mask.exr
        # 1 in front of the focus, 0 behind it.
        [ -e "$mask" ] || "$wideopen" render LensBlur "${clips[@]}" --no-metadata --no-progress \
            --set focusDistance=4 --set fStop=0.1 --set output=coc --set maxRadius=1 \
            -o "$mask" 2> /dev/null
        clips+=(--clip "Mask=$mask:R")
        settings+=(fStop=0.4 focusDistance=20) ;;
    edges)
        layers_of "$(footage still-life 320x180)"
        window=192,26,320,98
        settings+=(focusDistance=6) ;;
    soft) # depth that was antialiased: its own picture, a little out of focus
        folder=$(footage still-life 320x180)
        soft=$work/soft.exr
        [ -e "$soft" ] || "$wideopen" render LensBlur --clip "Source=$folder/pinhole.exr:depth" \
            --raw Source --no-metadata --no-progress --bits float \
            --set fStop=0.1 --set maxRadius=0.8 --set samples=256 -o "$soft" 2> /dev/null
        clips=(--clip "Source=$folder/pinhole.exr" --clip "Depth=$soft:R")
        window=110,60,174,96
        settings=(fStop=0.5 focusDistance=3.3 samples=256) ;;
    noise)
        layers_of "$(footage still-life 320x180)"
        window=230,20,310,65
        settings+=(focusDistance=8 samples=64 method=rays) ;;
    views)
        layers_of "$(footage still-life 320x180)"
        settings+=(sampling=adaptive blades=5) ;;
    lights)
        layers_of "$(footage night-lights 640x360)"
        window=425,160,553,232
        settings=(fStop=0.7 focusDistance=2 samples=512) ;;
    left | right | bottom | top | corner)
        layers_of "$(footage night-lights 320x180)"
        case $1 in
        left) window=0,54,128,126 ;;
        right) window=192,54,320,126 ;;
        bottom) window=32,0,160,72 ;;
        top) window=192,108,320,180 ;;
        corner) window=0,72,128,144 ;;
        esac
        settings=(fStop=0.35 focusDistance=2 samples=512) ;;
    glass | sharp)
        layers_of "$(footage night-lights 640x360)"
        window=425,160,553,232
        settings=(fStop=2 focusDistance=1 samples=2048 method=rays)
        [ "$1" != sharp ] || settings+=(focusDistance=8) ;;
    *)
        echo "no shot is called $1" >&2
        exit 1 ;;
    esac
}

# Puts the pictures of one parameter into cells.
add_parameter() {
    local key=${1//\#/1} values=$2 with=$4 value shown setting out sets
    local -a list_of
    read -ra list_of <<< "$values"
    # The pictures of a parameter stand in one row, if they fit there.
    if [ $((${#cells[@]} % columns + ${#list_of[@]})) -gt $columns ]; then
        while [ $((${#cells[@]} % columns)) -ne 0 ]; do cells+=("="); done
    fi
    shot "$3"
    for value in "${list_of[@]}"; do
        shown=${value%%\**}
        out=$work/$key-${#cells[@]}.exr
        sets=()
        # shellcheck disable=SC2086 # settings are words
        for setting in "${settings[@]}" ${with//\#/1} "$key=$shown"; do sets+=(--set "$setting"); done
        "$wideopen" render LensBlur "${clips[@]}" "${camera[@]}" "${sets[@]}" --window "$window" \
            --bits float --no-progress -o "$out" 2> "$work/said" || { cat "$work/said" >&2; exit 1; }
        cells+=("$key|$shown=$out${value#"$shown"}")
    done
}

make_sheet() {
    [ ${#cells[@]} -eq 0 ] ||
        "$wideopen" sheet "${cells[@]}" --columns $columns --width 128 \
            -o "$pictures/parameters-$group.png"
    cells=()
}

cells=()
group=
wanted=" $* "
while IFS='|' read -r key values name with; do
    read -r key <<< "$key"
    case $key in
    '' | '#'*) ;;
    '['*)
        make_sheet
        group=${key//[\[\]]/} ;;
    *)
        if [ "$wanted" = "  " ] || [[ $wanted == *" $group "* ]]; then
            read -r name <<< "$name"
            add_parameter "$key" "$values" "$name" "$with"
        fi ;;
    esac
done < "$list"
make_sheet
