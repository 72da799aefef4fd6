#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright the WideOpen authors
#
# Other free tools beside LensBlur: error over the time of the whole process. See peers.md.
#
# usage: peers.sh [--cores N] [--repeats N] [--clock cpu|wall] [--only A,B] -o FOLDER
#                 WIDEOPEN SCENE_FOLDER ...
#        peers.sh --discs -o FOLDER WIDEOPEN     what each makes of a bright point
#        peers.sh --missing                      which tools are not installed
# Exit 0: done. 1: a render failed, or with --missing a tool is. 2: wrong use, or something that
# must be there is not.
set -euo pipefail
LC_ALL=C
export LC_ALL
unset OCIO OFX_PLUGIN_PATH
here=$(cd "$(dirname "$0")" && pwd)

peers="gegl-lens-blur gegl-variable-blur gegl-variable-blur-hq gmic-16 gmic-64 magick magick-hdri
    blender blender-preview"
# METHOD-SAMPLES of LensBlur.
ours="filter-4 filter-8 filter-16 filter-32 filter-64 spread-16 spread-64 accumulate-16
    hybrid-4 hybrid-8 hybrid-16 hybrid-64 rays-8 rays-16 rays-64"

fault() {
    echo "peers.sh: $*" >&2
    exit 2
}

usage() {
    sed -n '/^# usage/,/^# Exit/s/^# \(.*\)$/\1/p' "$0" | sed '$d' >&2
    exit 2
}

# compute EXPRESSION: a number.
compute() {
    awk "BEGIN { printf \"%.9g\", ($1) }"
}

# ------------------------------------------------------------------------------- what is installed

# Sets program and package (of Debian) of a tool.
program_of() {
    case $1 in
    gegl-*) program=gegl package=gegl ;;
    gmic-*) program=gmic package=gmic ;;
    magick) program=convert-im6.q16 package=imagemagick-6.q16 ;;
    magick-hdri) program=convert-im6.q16hdri package=imagemagick-6.q16hdri ;;
    blender*) program=blender package=blender ;;
    *) program=$wideopen package= ;;
    esac
}

# Sets found to the tools that are there and lacking to the packages of the others, which it names.
find_peers() {
    local name
    found='' lacking=''
    for name in $peers; do
        program_of "$name"
        if command -v "$program" > /dev/null; then
            found="$found $name"
        else
            echo "peers.sh: $name is left out: there is no $program" >&2
            [[ " $lacking " == *" $package "* ]] || lacking="$lacking $package"
        fi
    done
    [ -z "$lacking" ] ||
        echo "peers.sh: to have them: apt-get install --no-install-recommends$lacking" >&2
}

version_of() {
    program_of "$1"
    if [ -z "$package" ]; then
        "$wideopen" --version | sed 's/.* //'
    else
        dpkg-query -W -f '${Version}' "$package" 2> /dev/null || echo unknown
    fi
}

# ------------------------------------------------------------------------------ what they are given

# prepare PICTURE RADIUS: what the tools read, made in $work, in nobody's time. RADIUS holds the
# radius of the circle of confusion in px.
prepare() {
    local facts
    facts=$(oiiotool "$2" --ch 0,0,0 --chnames R,G,B --abs -d float -o "$work/radius.exr" \
        --printstats "$1" --ch R,G,B,A --compression zip -o "$work/picture.exr" \
        --ch R,G,B --compression none -d float -o "$work/picture.tif" \
        --echo 'Size {TOP.width} {TOP.height}')
    largest=$(sed -n 's/.*Stats Max: \([^ ]*\) .*/\1/p' <<< "$facts")
    longer=$(awk '/^Size/ { print ($2 > $3 ? $2 : $3) }' <<< "$facts")
    [ "$(compute "$largest > 0.6")" = 1 ] || fault "$1: nothing is out of focus"
    # GEGL's lens-blur reaches half a pixel beyond its radius.
    disc=$(compute "$largest - 0.5")
    # A Gaussian of half a disc's radius has its second moment and its sum of squares.
    sigma=$(compute "$largest / 2")
    oiiotool "$work/radius.exr" --dup --subc 0.5 --clamp:min=0 --divc "$disc" \
        -o "$work/disc.exr" --pop --divc "$largest" -o "$work/unit.exr" \
        --compression none -o "$work/unit.tif" --ch R -o "$work/unit1.exr"
}

# command_of NAME OUTPUT: sets command, which makes the picture $made; finish_picture makes OUTPUT
# of that.
command_of() {
    local picture=$work/picture.exr preview=0
    made=$2
    case $1 in
    gegl-lens-blur)
        command=(gegl "$picture" -o "$made" -- gegl:lens-blur radius="$disc" linear-mask=true
            'aux=[' gegl:load path="$work/disc.exr" ']') ;;
    gegl-variable-blur*)
        command=(gegl "$picture" -o "$made" -- gegl:variable-blur radius="$sigma" linear-mask=true)
        [ "$1" = gegl-variable-blur ] || command+=(high-quality=true)
        command+=('aux=[' gegl:load path="$work/unit.exr" ']') ;;
    gmic-*) # its amplitude is a standard deviation in hundredths of the longer side
        command=(gmic -v - "$picture" "$work/unit1.exr" fx_blur_dof
            "$(compute "100 * $sigma / $longer"),${1#*-},1,0,50,50,30,30,0,1,0,0" -o. "$made") ;;
    magick*) # Debian's knows no EXR; compose:args is a standard deviation
        made=${2%.exr}.tif
        program_of "$1"
        command=("$program" "$work/picture.tif" "$work/unit.tif" -define compose:args="$sigma"
            -compose blur -composite -define quantum:format=floating-point -depth 32
            -compress none "$made") ;;
    blender*)
        [ "$1" = blender ] || preview=1
        command=(blender --background --factory-startup -noaudio --threads "$cores"
            --python-exit-code 1 --python "$here/peers_blender.py" --
            "$picture" "$work/radius.exr" "$largest" "$preview" "$made") ;;
    *)
        command=("$wideopen" render LensBlur --clip Source="$source" --clip Depth="$depth"
            "${camera[@]}" --set method="${1%-*}" --set samples="${1#*-}" --threads "$cores"
            --no-progress --report "${2%.exr}.json" -o "$made") ;;
    esac
}

# run NAME OUTPUT: sets wall and cpu, the seconds of the whole process; fails when there is no
# picture.
run() {
    local log=${2%.exr}.log user system
    command_of "$1" "$2"
    rm -f "$made" "$2"
    local TIMEFORMAT='%R %U %S'
    { time taskset -c "$processors" "${command[@]}" > "$log" 2>&1 < /dev/null; } \
        2> "$work/time" || true
    read -r wall user system < "$work/time"
    cpu=$(compute "$user + $system")
    [ "$made" = "$2" ] || oiiotool "$made" -d float -o "$2" > /dev/null 2>&1 || true
    [ -s "$2" ] || { echo "peers.sh: $1 failed; it said:" >&2 && cat "$log" >&2 && return 1; }
}

# ------------------------------------------------------------------------------------------ results

# The table of one scene and who is beaten by whom: of $1, the csv. A tool is beaten by a setting of
# ours that is nearer to the truth in PSNR and in SSIM and takes less time.
print_scene() {
    awk -F , -v scene="$scene" -v clock="$clock" '
        NR == 1 || $1 != scene { next }
        {
            n++
            name[n] = $2; mine[n] = $3 == "ours"; psnr[n] = $9; ssim[n] = $10; relmse[n] = $11
            wall[n] = $7; cpu[n] = $8; time[n] = clock == "cpu" ? $8 : $7
        }
        END {
            printf "\n%-24s %8s %7s %9s %8s %8s\n", scene, "PSNR dB", "SSIM", "relMSE", "cpu s",
                "wall s"
            for (i = 1; i <= n; i++)
                printf "  %-22s %8.2f %7.3f %9.4g %8.2f %8.2f\n", name[i], psnr[i], ssim[i],
                    relmse[i], cpu[i], wall[i]
            for (i = 1; i <= n; i++) {
                if (mine[i])
                    continue
                best = next_one = 0
                for (j = 1; j <= n; j++) {
                    if (!mine[j] || psnr[j] <= psnr[i] || ssim[j] <= ssim[i])
                        continue
                    if (time[j] < time[i] && (!best || psnr[j] > psnr[best]))
                        best = j
                    if (!next_one || time[j] < time[next_one])
                        next_one = j
                }
                if (best)
                    printf "  %s is beaten by %s: %+.1f dB in %.2f of the time\n", name[i],
                        name[best], psnr[best] - psnr[i], time[best] / time[i]
                else if (next_one)
                    printf "  %s is NOT beaten: %s, %+.1f dB, takes %.2f of its time\n", name[i],
                        name[next_one], psnr[next_one] - psnr[i], time[next_one] / time[i]
                else
                    printf "  %s is NOT beaten: none of ours is nearer to the truth\n", name[i]
            }
        }' "$1"
}

# measure SCENE_FOLDER: adds rows to the csv.
measure() {
    local folder=$1 truth name round score psnr ssim relmse
    scene=$(basename "$folder")
    truth=$folder/truth.exr
    [ -e "$truth" ] || truth=$folder/reference.exr
    source=$folder/pinhole.exr depth=$folder/depth.exr camera=()
    for name in "$source" "$truth"; do
        [ -e "$name" ] || fault "there is no $name"
    done
    [ -e "$depth" ] || depth=$source:depth
    work=$out/$scene
    mkdir -p "$work"
    "$wideopen" render LensBlur --clip Source="$source" --clip Depth="$depth" --set output=coc \
        --bits float --no-progress -o "$work/coc.exr" > /dev/null 2>&1 || fault "$folder: no camera?"
    prepare "$source" "$work/coc.exr"
    local -A best_wall=() best_cpu=()
    for ((round = 0; round < repeats; round++)); do
        for name in $wanted; do
            [ "${best_wall[$name]-}" != failed ] || continue
            echo "$scene, run $((round + 1)) of $repeats: $name" >&2
            if ! run "$name" "$work/$name.exr"; then
                best_wall[$name]=failed status=1
                continue
            fi
            [ $round -gt 0 ] || best_wall[$name]=$wall best_cpu[$name]=$cpu
            [ "$(compute "$wall < ${best_wall[$name]}")" = 0 ] || best_wall[$name]=$wall
            [ "$(compute "$cpu < ${best_cpu[$name]}")" = 0 ] || best_cpu[$name]=$cpu
        done
    done
    for name in $wanted; do
        [ "${best_wall[$name]}" != failed ] || continue
        score=$work/$name.score.json
        "$wideopen" compare --json --crop "$crop" "$truth" "$work/$name.exr" > "$score" ||
            { echo "peers.sh: $scene: $name is no picture" >&2 && status=1 && continue; }
        IFS=$'\t' read -r psnr ssim relmse <<< "$("$wideopen" json "$score" psnr ssim relmse)"
        program_of "$name"
        {
            printf '%s,' "$scene" "$name" "${package:-ours}" "$(version_of "$name")" "$cores" \
                "$repeats" "${best_wall[$name]}" "${best_cpu[$name]}" "$psnr" "$ssim" "$relmse"
            compute "10 ^ (-$psnr / 20)"
            echo
        } >> "$csv"
    done
    print_scene "$csv"
    awk -F , -v scene="$scene" -v OFS='\t' -v clock="$clock" '
        NR == 1 || $1 != scene { next }
        $3 != "ours" { print ".other tools", $2, $(clock == "cpu" ? 8 : 7), $12 }
        $3 == "ours" {
            split($2, part, "-")
            print part[1], part[2], $(clock == "cpu" ? 8 : 7), $12
        }' "$csv" > "$work/points"
    "$plotter" "$scene, whole process, cores: $cores" "$(
        [ "$clock" = cpu ] && echo "user and system time, s" || echo "time, s")" \
        "error: RMSE of the displayed value" "$out/$scene.svg" < "$work/points"
    local cells=("truth=$truth" "pinhole=$source")
    for name in $wanted; do
        [ "${best_wall[$name]}" = failed ] || cells+=("$name=$work/$name.exr")
    done
    "$wideopen" sheet "${cells[@]}" --columns 4 --width 320 -o "$out/$scene.png" > /dev/null
}

# discs: every tool on one bright point that is out of focus by 2 to 32 px. A disc of equal values
# has the radius sqrt(area / pi), a Gaussian twice its standard deviation.
measure_discs() {
    local radius name average deviation side=161
    work=$out/discs
    mkdir -p "$work"
    source=$work/point.exr depth=$work/depth.exr
    oiiotool --create ${side}x$side 4 --fill:color=0,0,0,1 ${side}x$side \
        --fill:color=1,1,1,1 1x1+$((side / 2))+$((side / 2)) -d float -o "$source"
    oiiotool --create ${side}x$side 1 --fill:color=1 ${side}x$side -d float -o "$depth"
    printf '%-24s %8s %10s %8s\n' tool "radius" measured light
    for name in $wanted; do
        for radius in 2 4 8 16 32; do
            # One pixel is sharp: some tools stretch their map to 0..1.
            oiiotool --create ${side}x$side 1 --fill:color=$radius ${side}x$side \
                --fill:color=0 1x1+0+0 -d float -o "$work/constant.exr"
            prepare "$source" "$work/constant.exr"
            camera=(--set focalLength=50 --set sensorWidth=36 --set focusDistance=2
                --set fStop="$(compute "0.5 * 2500e-3 * 0.5 / 36 * $side / $radius")")
            run "$name" "$work/$name-$radius.exr" || { status=1 && continue; }
            read -r average deviation <<< "$(oiiotool "$work/$name-$radius.exr" --ch 0 \
                --mulc 10000 --printstats | awk '/Avg/ { a = $3 } /StdDev/ { s = $3 } END { print a, s }')"
            awk -v n="$name" -v r=$radius -v s=$side -v a="$average" -v d="$deviation" 'BEGIN {
                printf "%-24s %8g %10.2f %8.3f\n", n, r,
                    sqrt(s * s * a * a / (a * a + d * d) / 3.14159265), a * s * s / 10000 }'
        done
    done
}

# --------------------------------------------------------------------------------------------- main

# A function: the shell has read all of it before anything runs.
main() {
    cores=1 repeats=3 clock=cpu only='' out='' crop=0 task=measure wideopen=''
    while [ $# -gt 0 ]; do
        case $1 in
        --discs) task=discs ;;
        --missing) task=missing ;;
        --cores | --repeats | --clock | --only | --crop | -o)
            [ $# -ge 2 ] || usage
            case $1 in
            --cores) cores=$2 ;;
            --repeats) repeats=$2 ;;
            --clock) clock=$2 ;;
            --only) only=${2//,/ } ;;
            --crop) crop=$2 ;;
            -o) out=$2 ;;
            esac
            shift ;;
        -*) usage ;;
        *) break ;;
        esac
        shift
    done
    status=0
    if [ $task = missing ]; then
        find_peers
        [ -z "$lacking" ] || status=1
        exit $status
    fi
    case $clock in cpu | wall) ;; *) usage ;; esac
    [[ $cores =~ ^[1-9][0-9]*$ && $repeats =~ ^[1-9][0-9]*$ && $crop =~ ^[0-9]+$ ]] || usage
    [[ -n $out && $# -ge 1 ]] || usage
    wideopen=$1
    shift
    [ -x "$wideopen" ] || fault "no program $wideopen"
    for name in oiiotool taskset awk; do
        command -v $name > /dev/null || fault "there is no $name (openimageio-tools, util-linux, mawk)"
    done
    plotter=$(dirname "$wideopen")/plot_points
    [ -x "$plotter" ] || fault "no program $plotter: it is built with wideopen"
    # The first cores that this process may use.
    processors=$(taskset -cp $$ | sed 's/.*: //' | tr ',' '\n' |
        awk -F - -v n="$cores" '{ for (i = $1; i <= ($2 == "" ? $1 : $2); i++) if (k < n) {
            printf "%s%d", k ? "," : "", i; k++ } } END { exit k < n }') ||
        fault "there are fewer than $cores cores"
    export GEGL_THREADS=$cores OMP_NUM_THREADS=$cores MAGICK_THREAD_LIMIT=$cores
    mkdir -p "$out"
    out=$(cd "$out" && pwd)
    find_peers
    wanted=${only:-$found $ours}
    for name in $wanted; do
        [[ " $found " == *" $name "* ]] || {
            [[ $name =~ ^[a-z]+-[1-9][0-9]*$ && ! $peers =~ (^|[[:space:]])$name([[:space:]]|$) ]] ||
                fault "there is no $name"
        }
    done
    if [ $task = discs ]; then
        wanted=${only:-$found spread-64}
        measure_discs
        exit $status
    fi
    [ $# -ge 1 ] || usage
    csv=$out/peers.csv
    echo "scene,name,package,version,cores,runs,wall,cpu,psnr,ssim,relmse,rmse" > "$csv"
    for folder in "$@"; do
        measure "$folder"
    done
    exit $status
}

main "$@"
