# SPDX-License-Identifier: BSD-3-Clause
# Copyright the WideOpen authors
#
# Takes C and C++ sources apart. Prints "FILE<tab>LINE<tab>TEXT" for every line: with -v want=code
# the code without comments and without the insides of strings and characters (an #include keeps its
# name), with -v want=comments the text of the comments alone.

function literal(quote,    part)
{
    # rest begins behind the opening quote.
    while (match(rest, quote == "'" ? "['\\\\]" : "[\"\\\\]")) {
        part = substr(rest, RSTART, 1)
        if (part == "\\") {
            if (verbatim)
                code = code substr(rest, 1, RSTART + 1)
            rest = substr(rest, RSTART + 2)
            if (rest == "") {
                state = quote
                return
            }
        } else {
            code = code (verbatim ? substr(rest, 1, RSTART) : quote)
            rest = substr(rest, RSTART + 1)
            state = "code"
            return
        }
    }
    if (verbatim)
        code = code rest
    rest = ""
    state = "code"
}

FNR == 1 { state = "code" }

{
    rest = $0
    code = note = ""
    verbatim = state == "code" && rest ~ /^[ \t]*#[ \t]*include/
    while (rest != "") {
        if (state == "block") {
            at = index(rest, "*/")
            note = note (at ? substr(rest, 1, at - 1) : rest)
            rest = at ? substr(rest, at + 2) : ""
            if (at)
                state = "code"
        } else if (state == "line") {
            note = note rest
            if (rest !~ /\\$/)
                state = "code"
            rest = ""
        } else if (state == "raw") {
            at = index(rest, closing)
            rest = at ? substr(rest, at + length(closing)) : ""
            if (at)
                state = "code"
        } else if (state != "code") {
            literal(state)
        } else if (!match(rest, /["'\/]/)) {
            code = code rest
            rest = ""
        } else {
            at = RSTART
            mark = substr(rest, at, 1)
            pair = substr(rest, at, 2)
            before = code substr(rest, 1, at - 1)
            rest = substr(rest, at + 1)
            code = before
            if (pair == "/*") {
                rest = substr(rest, 2)
                code = code " "
                state = "block"
            } else if (pair == "//") {
                rest = substr(rest, 2)
                state = "line"
                if (rest == "")
                    state = "code"
            } else if (mark == "/") {
                code = code mark
            } else if (mark == "\"" && before ~ /(^|[^A-Za-z0-9_])(u8|[uUL])?R$/) {
                at = index(rest, "(")
                closing = ")" substr(rest, 1, at - 1) "\""
                rest = substr(rest, at + 1)
                code = code "\"\""
                state = "raw"
            } else if (mark == "'" && before ~ /[0-9]$/) {
                code = code mark
            } else {
                code = code mark
                literal(mark)
            }
        }
    }
    printf "%s\t%d\t%s\n", FILENAME, FNR, want == "comments" ? note : code
}
