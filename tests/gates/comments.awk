# SPDX-License-Identifier: BSD-3-Clause
# Copyright the WideOpen authors
#
# Reads what blank.awk makes of C sources with want=comments; prints the comments that look like
# code which somebody left behind.

BEGIN { FS = "\t" }

{
    text = substr($0, length($1) + length($2) + 3)
    # An example in a header stands indented below the text.
    if ($1 ~ /\.(h|hh)$/ && text ~ /^       /)
        next
    gsub(/^[ \t*]+|[ \t*]+$/, "", text)
    type = "^(const|static|extern|inline|struct|enum|union|unsigned|int|char|float|double|void" \
           "|bool|size_t|ptrdiff_t|u?int[0-9]+_t|wo_[a-z_]+|Ofx[A-Za-z]+) [^.]*"
    if (text ~ /^[A-Za-z_][A-Za-z0-9_>.-]* ?\(.*\);$/ ||
        text ~ /^\*?[A-Za-z_][][A-Za-z0-9_>.-]* *([-+*\/|&^%]|<<|>>)?= [^;]*;$/ ||
        text ~ /^return( [^;]*)?;$/ || text ~ /^(break|continue);$/ || text ~ /^goto [a-z_]+;$/ ||
        text ~ /^(\} *)?(else +)?(if|for|while|switch) ?\(.*\) *(\{|.*;)?$/ ||
        text ~ /^\} *(else *\{?)?$/ || text ~ /\) *\{$/ ||
        text ~ /^# *(include *[<"]|define [A-Za-z_]|if(n?def)? [A-Za-z_!(0-9]|endif|pragma )/ ||
        text ~ (type ";$")) {
        printf "%s:%d: code in a comment: %s\n", $1, $2, text
        faults++
    }
}

END { exit faults > 0 }
