# SPDX-License-Identifier: BSD-3-Clause
# Copyright the WideOpen authors
#
# Reads text files and prints one line for every fault of form. To be run with LC_ALL=C: columns are
# bytes. The words looked for are written so that they do not find themselves here.

BEGIN {
    commands = "# *(set|unset|if|elseif|else|endif|foreach|endforeach|function|include|message" \
               "|option|(add|target|find|get|set|link)_[a-z_]+) *\\("
    # Longest file. Exceptions with their reasons:
    most_lines = 650
    longer["tests/contract/ofx_abi_dump.c"] = 1 # written by a program
    wider["tests/contract/ofx_abi_dump.c"] = 1
}

function fault(text)
{
    printf "%s:%d: %s\n", FILENAME, FNR, text
    faults++
}

function end_of_file()
{
    if (path != "" && lines > most_lines && !(path in longer)) {
        printf "%s:%d: more than %d lines\n", path, lines, most_lines
        faults++
    }
}

# Kind of a file by its name, and for files without an extension by its first line.
function kind_of(name, first)
{
    if (name ~ /\.(c|h|cc|hh)(\.in)?$/)
        return "c"
    if (name ~ /(^|\/)CMakeLists\.txt$/ || name ~ /\.cmake$/)
        return "cmake"
    if (name ~ /\.(sh|awk)$/)
        return "script"
    if (name ~ /\.md$/)
        return "page"
    if (name ~ /(^|\/)[^.\/]+$/ && first ~ /^#( SPDX|!)/)
        return "script"
    return "text"
}

FNR == 1 {
    end_of_file()
    path = FILENAME
    kind = kind_of(path, $0)
    shebang = $0 ~ /^#!/
    spdx = "SPDX-License-Identifier: BSD-3-Clause"
    owner = "Copyright the WideOpen authors"
    if (kind == "c" && $0 != "/* " spdx " */")
        fault("the first line is not /* " spdx " */")
    if (kind == "script" && !shebang && $0 != "# " spdx)
        fault("the first line is not # " spdx)
}

FNR == 2 {
    if (kind == "c" && $0 != "/* " owner " */")
        fault("the second line is not /* " owner " */")
    if (kind == "script" && shebang && $0 != "# " spdx)
        fault("the second line is not # " spdx)
}

{
    lines = FNR
    if (/[ \t\r]$/)
        fault("blank at the end of the line")
    if (kind != "page" && kind != "text" && /\t/)
        fault("tab")
    if (kind != "page" && /[^ -~\t\r]/)
        fault("not ASCII")
    if (kind == "c" && length($0) > 100 && !(FILENAME in wider))
        fault("longer than 100 columns: " length($0))
    if (/(^|[^A-Za-z0-9_])(TO[D]O|FIX[M]E|XX[X])([^A-Za-z0-9_]|$)/)
        fault("a note to finish something")
    if (/^[ \t]*#[ \t]*if[ \t]+0([^-A-Za-z0-9_.]|$)/)
        fault("code that is switched off")
    if (kind == "cmake" && /^[ \t]*#+[ \t]*[a-z_]+ ?\(.*\)[ \t]*$/ && $0 ~ commands)
        fault("code in a comment")
    if (/(^|[^-A-Za-z0-9_.})\/])\/(home|work|root|Users)\/[A-Za-z0-9_]/)
        fault("a path of somebody's machine")
}

END {
    end_of_file()
    exit faults > 0
}
