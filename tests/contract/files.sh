#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Copyright the WideOpen authors
#
# Files as they come: damaged ones, sequences whose frames differ in their channels, names with a
# percent sign.
#
# usage: files.sh WIDEOPEN JSON_CHECK WORK_DIR
# Exit 0: everything as promised. 1: something is not (each is printed). 2: wrong use.

set -u

if [ $# -ne 3 ]; then
    echo "usage: files.sh WIDEOPEN JSON_CHECK WORK_DIR" >&2
    exit 2
fi
wideopen=$1 json_check=$2 work=$3
tools=$(cd "$(dirname "$0")" && pwd)/cli_tools.sh
rm -rf "$work"
mkdir -p "$work" && cd "$work" || exit 2
unset OCIO OFX_PLUGIN_PATH

. "$tools"

# tga FILE TYPE BITS PIXEL: 4 x 4 of one pixel; numbers are octal.
tga() {
    # shellcheck disable=SC2059 # the words are formats
    {
        printf "\\0\\0\\$2\\0\\0\\0\\0\\0\\0\\0\\0\\0\\4\\0\\4\\0\\$3\\0"
        for _ in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16; do printf "$4"; done
    } >"$1"
}

# blur CODE SOURCE OUTPUT WORDS...
blur() {
    wanted=$1 source=$2 output=$3
    shift 3
    expect "$wanted" render LensBlur --clip "Source=$source" --clip Depth=depth.pgm -o "$output" \
        --set method=rays --set samples=4 --no-progress "$@"
}

# alike FILE FILE
alike() {
    expect 0 compare "$1" "$2" --json
    cp stdout alike.json
    value alike.json max_error 0
}

{
    printf 'P5 4 4 255\n'
    printf 'dddddddddddddddd'
} >depth.pgm

# A damaged file is one line and exit 1.
head -c 791 /dev/zero >zeros
{
    printf '\0\1\11\0\0\0\0\30\0\0\0\0\20\0\0\56\40\0'
    head -c 769 zeros
    printf '\10\0\0\0'
} >bad.tga
blur 1 bad.tga none.png
says '^wideopen: .*bad.tga: '
checks=$((checks + 1))
[ "$(wc -l <stderr)" -eq 1 ] || fail "more than one line for a damaged file"
absent none.png

# RGB, RGBA, grey, RGB: every frame is rendered as if it were alone.
tga shot.0001.tga 2 30 '\62\144\310'
tga shot.0002.tga 2 40 '\62\144\310\377'
tga shot.0003.tga 3 10 '\144'
tga shot.0004.tga 2 30 '\62\144\310'
blur 0 shot.####.tga out.####.png --frames 1-4 --report report.json
value report.json warnings '[]'
alike out.0001.png out.0002.png
blur 0 shot.0002.tga alpha.png
alike out.0002.png alpha.png
alike out.0001.png out.0004.png
blur 0 shot.0003.tga grey.png
alike out.0003.png grey.png

# RGBA first: the others have an alpha of 1.
cp shot.0002.tga back.0001.tga
cp shot.0001.tga back.0002.tga
cp shot.0003.tga back.0003.tga
blur 0 back.####.tga with.####.png --frames 1-3
alike with.0001.png with.0002.png
alike with.0003.png grey.png

# A percent sign in the name of a folder or a file that is there.
mkdir '50%done'
cp shot.0001.tga '50%done/a.tga'
cp shot.0001.tga '100%done.tga'
blur 0 '50%done/a.tga' one.png
alike one.png out.0001.png
blur 0 '100%done.tga' two.png
alike two.png out.0001.png
cp shot.0001.tga '50%done/a.7.tga'
blur 0 '50%done/a.%d.tga' 'b.%02d.png' --frames 7
alike b.07.png out.0001.png

finish
