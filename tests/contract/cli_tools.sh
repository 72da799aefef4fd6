# SPDX-License-Identifier: BSD-3-Clause
# Copyright the WideOpen authors
#
# What the tests of the command line share. To be sourced in an empty folder, with $wideopen and
# $json_check set; ends by: finish.

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

# well_formed FILE: every element is closed by its own name, in order; no attribute is open.
well_formed() {
    checks=$((checks + 1))
    tr -d '\n' <"$1" | sed 's/</\n</g' | awk '
        NR == 1 { if ($0 != "") bad = "text before the first element"; next }
        {
            if (!match($0, />/)) { bad = "no end: " $0; exit }
            tag = substr($0, 1, RSTART)
            quotes = gsub(/"/, "\"", tag)
            if (quotes % 2) bad = "quotes: " tag
            if (tag ~ /^<\?/) next
            name = tag
            gsub(/^<\/?|[ \/>].*$/, "", name)
            if (tag ~ /^<\//) {
                if (open[depth--] != name) bad = "closes another: " tag
            } else if (tag !~ /\/>$/) {
                open[++depth] = name
            }
            if (bad) exit
        }
        END {
            if (!bad && (depth || NR < 3)) bad = "something stays open"
            if (bad) { print bad; exit 1 }
        }' >xml_error || fail "$1: $(cat xml_error)"
}

silent_error() {
    checks=$((checks + 1))
    [ ! -s stderr ] || fail "something on stderr"
}

finish() {
    no_leftovers
    echo "$checks checks, $failures failed"
    [ "$failures" -eq 0 ]
}
