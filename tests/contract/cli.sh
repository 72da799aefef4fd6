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

# expect CODE WORDS...: runs wideopen with the words; stdout and stderr go to files of these names.
expect() {
    wanted=$1
    shift
    checks=$((checks + 1))
    "$wideopen" "$@" >stdout 2>stderr </dev/null
    code=$?
    [ "$code" -eq "$wanted" ] || fail "wideopen $*: exit code $code instead of $wanted"
}

# says PATTERN, shows PATTERN: the last stderr, the last stdout.
says() {
    checks=$((checks + 1))
    grep -q -e "$1" stderr || fail "stderr does not say: $1"
}

shows() {
    checks=$((checks + 1))
    grep -q -e "$1" stdout || fail "stdout does not show: $1"
}

silent() {
    checks=$((checks + 1))
    [ ! -s stdout ] || fail "something on stdout: $(head -c 200 stdout)"
}

is_json() {
    checks=$((checks + 1))
    "$json_check" <"$1" 2>json_error || fail "$1: $(cat json_error)"
}

# value FILE PATH EXPECTED
value() {
    checks=$((checks + 1))
    found=$("$wideopen" json "$1" "$2" 2>stderr)
    [ "$found" = "$3" ] || fail "$1: $2 is \"$found\" instead of \"$3\""
}

absent() {
    checks=$((checks + 1))
    [ ! -e "$1" ] || fail "$1 exists"
}

present() {
    checks=$((checks + 1))
    [ -s "$1" ] || fail "$1 is missing or empty"
}

# No temporary file is left behind anywhere.
no_leftovers() {
    checks=$((checks + 1))
    left=$(find . -name '*.tmp' -o -name '.wideopen-*')
    [ -z "$left" ] || fail "left behind: $left"
}

same() {
    checks=$((checks + 1))
    "$wideopen" compare "$1" "$2" --json >compared 2>stderr || fail "compare $1 $2"
    [ "$("$wideopen" json compared max_error)" = 0 ] || fail "$1 and $2 differ: $(cat compared)"
}

# ------------------------------------------------------------------------------- help and mistakes

for command in list describe render footage compare sheet json; do
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
expect 0 render LensBlur --help
shows fStop
shows 'default'
expect 0 describe LensBlur --plugin-path .

# ---------------------------------------------------------------------------------------- footage

expect 0 footage two-planes -o scene --size 96x64 --layers 2 --reference 16 --no-progress
silent
present "$SCENE"
present "$REFERENCE"
expect 2 footage no-such-scene -o scene2
says still-life
expect 2 footage two-planes -o scene2 --size 96
absent scene2

# ----------------------------------------------------------------------------------------- compare

expect 0 compare "$REFERENCE" "$REFERENCE" --json
is_json stdout
cp stdout equal.json
value equal.json psnr null
value equal.json max_error 0
value equal.json nonfinite 0
expect 0 compare "$REFERENCE" "$SCENE" --json --crop 4 --diff diff.png
is_json stdout
present diff.png
expect 1 compare "$REFERENCE" missing.exr
says missing.exr
silent
expect 1 compare "$REFERENCE" "$REFERENCE" --crop 40
expect 2 compare "$REFERENCE" "$REFERENCE" --crop -1
expect 2 compare "$REFERENCE" "$REFERENCE" --in-space NoSuchSpace
says NoSuchSpace
