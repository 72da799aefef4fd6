#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Copyright the WideOpen authors
#
# Are our OFX headers binary compatible with the standard? Compiles the dump program against them
# and compares every string, number, size and offset it prints with the expected list (64 bit).
#
# usage: ofx_abi.sh CC INCLUDE_DIR DUMP_C EXPECT_TXT WORK_DIR
# Exit 0: identical. 1: different (the diff is printed) or not compilable. 2: wrong use.

set -u

if [ $# -ne 5 ]; then
    echo "usage: ofx_abi.sh CC INCLUDE_DIR DUMP_C EXPECT_TXT WORK_DIR" >&2
    exit 2
fi
cc=$1 include=$2 dump=$3 expect=$4 work=$5

for file in "$include/ofxCore.h" "$dump" "$expect"; do
    if [ ! -s "$file" ]; then
        echo "ofx_abi.sh: $file is missing or empty" >&2
        exit 2
    fi
done
mkdir -p "$work" || exit 2

# $cc is not quoted: it may be a command with arguments, such as "ccache gcc".
rm -f "$work/ofx_abi_dump" "$work/ofx_abi.txt"
if ! $cc -std=c11 -I "$include" -DOFX_NO_DEFAULT_COLORSPACE_HEADER \
        -o "$work/ofx_abi_dump" "$dump"; then
    echo "ofx_abi.sh: the dump program does not compile" >&2
    exit 1
fi
if ! "$work/ofx_abi_dump" > "$work/ofx_abi.txt"; then
    echo "ofx_abi.sh: the dump program failed" >&2
    exit 1
fi
if ! diff -u "$expect" "$work/ofx_abi.txt"; then
    echo "ofx_abi.sh: the headers in $include differ from $expect" >&2
    exit 1
fi
