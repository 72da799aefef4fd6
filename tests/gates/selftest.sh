#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Copyright the WideOpen authors
#
# Can the gates fail? Each is run on a small project without faults, which it must pass, and on
# copies with one fault each, which it must find.
#
# shellcheck disable=SC2317 # functions are called by name
#
# usage: selftest.sh include_direction | hygiene | headers CC CXX | format CLANG_FORMAT |
#                    bundles CC | state CC | abi CC ROOT
# Exit 0: yes. 1: no (what was not found is printed). 2: wrong use.

set -u
LC_ALL=C
export LC_ALL

gates=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d) || exit 2
trap 'rm -rf "$work"' EXIT
sound=$work/sound
tree=$work/tree
failures=0
checks=0

usage() {
    sed -n 's/^# \(usage: .*\|  *bundles .*\)$/\1/p' "$0" >&2
    exit 2
}

fail() {
    echo "FAILED: $*"
    sed 's/^/    /' "$work/said"
    failures=$((failures + 1))
}

# must CODE WORDS COMMAND...: the command must end with this code and say these words.
must() {
    code=$1 words=$2
    shift 2
    checks=$((checks + 1))
    "$@" >"$work/said" 2>&1
    found=$?
    [ "$found" -eq "$code" ] || fail "code $found instead of $code: $*"
    [ -z "$words" ] || grep -q -F -e "$words" "$work/said" ||
        fail "does not say \"$words\": $*"
}

# ---------------------------------------------------------------------------------- a small project

# edit EXPRESSION FILE
edit() {
    sed "$1" "$2" >"$work/edited" && cat "$work/edited" >"$2"
}

# put FILE LINE...: a file with the lines of the licence and these.
put() {
    mkdir -p "$(dirname "$1")"
    written=$1
    shift
    {
        echo "/* SPDX-License-Identifier: BSD-3-Clause */"
        echo "/* Copyright the WideOpen authors */"
        [ $# -eq 0 ] || printf '%s\n' "$@"
    } >"$written"
}

# header FILE NAME LINE...
header() {
    guarded=$1 guard=$2
    shift 2
    put "$guarded" "#ifndef $guard" "#define $guard" "$@" "#endif"
}

make_project() {
    mkdir -p "$sound"
    (
        cd "$sound" || exit 2
        header include/wideopen/base.h WO_BASE_H '#include <stddef.h>' 'size_t wo_count(void);'
        header include/wideopen/effect.h WO_EFFECT_H '#include "wideopen/base.h"'
        header include/ofx/ofxCore.h OFX_CORE_H 'typedef int OfxStatus;'
        put core/base/context.c '#include "wideopen/base.h"' '#include <stdlib.h>' \
            'void *wo_take(size_t n)' '{' '    return malloc(n);' '}'
        header core/base/number.h WO_NUMBER_H '#include "wideopen/base.h"'
        put core/base/number.c '#include "number.h"' '#include <math.h>' '#include <stdio.h>' \
            '/* Never calls printf("%g"), exit or malloc. */' \
            'static const char text[] = "printf(free)";' "static const char mark = '\"';" \
            'int wo_number_print(char *b, size_t n, const struct x *c)' '{' \
            '    return c->abort(c) || b[0] == mark ? 0 : snprintf(b, n, "%s", text);' '}'
        put core/defocus/march_avx2.c '#include "base/number.h"' '#include <immintrin.h>'
        put plugins/plugin.c '#include "ofx/ofxCore.h"' '#include "wideopen/effect.h"'
        put plugins/ofx_draw_gl.c '#include <dlfcn.h>'
        header ofx_host_stub/host/host.h WO_HOST_H '#include "wideopen/base.h"'
        header ofx_host_stub/host/internal.h WO_INTERNAL_H '#include "host.h"' \
            '#include "ofxCore.h"'
        put ofx_host_stub/host/host.c '#include "internal.h"' '#include <dlfcn.h>'
        header ofx_host_stub/bridge/io.h WO_IO_H '#include "wideopen/base.h"'
        header ofx_host_stub/bridge/io_exr_private.h WO_IO_EXR_H '#include <openexr.h>'
        put ofx_host_stub/bridge/io_exr.c '#include "io.h"' '#include "io_exr_private.h"'
        put ofx_host_stub/bridge/io_oiio.cc '#include "io.h"' '#include <OpenImageIO/imageio.h>' \
            '#include <vector>'
        put ofx_host_stub/cli/main.c '#include "bridge/io.h"' '#include "host/host.h"' \
            '#include "footage.h"' '#include <stdio.h>' '#include <unistd.h>'
        header footage/footage.h WO_FOOTAGE_H '#include "wideopen/base.h"'
        put footage/scene.c '#include "bridge/io.h"' '#include "footage.h"'
        header tests/property/scenes.h WO_SCENES_H '#include <stddef.h>'
        put tests/unit/test_number.c '#include "scenes.h"' '#include "core/base/number.h"' \
            '#include <cmocka.h>'
        printf '# Builds it.\nproject(small)\n' >CMakeLists.txt
        printf '# Small\n' >README.md
        printf '#!/bin/sh\n# SPDX-License-Identifier: BSD-3-Clause\n' >check
    ) || exit 2
}

fresh() {
    rm -rf "$tree"
    cp -R "$sound" "$tree"
}

# broken WORDS FILE LINE...: the gate in $gate must find the fault that these lines make at the end
# of the file.
broken() {
    words=$1 file=$2
    shift 2
    fresh
    [ -e "$tree/$file" ] || put "$tree/$file"
    printf '%s\n' "$@" >>"$tree/$file"
    must 1 "$words" "$gates/$gate.sh" "$tree"
    grep -q -F "$file" "$work/said" || fail "does not name $file"
}

# ------------------------------------------------------------------------------------- the gates

test_include_direction() {
    gate=include_direction
    fresh
    must 0 "0 faults" "$gates/$gate.sh" "$tree"
    must 2 usage "$gates/$gate.sh" "$work/nowhere"

    broken "api must not include core" include/wideopen/base.h '#include "base/number.h"'
    broken "api must not include ofx" include/wideopen/base.h '#include "ofx/ofxCore.h"'
    broken "api must not include <unistd.h>" include/wideopen/base.h '#include <unistd.h>'
    broken "ofx must not include api" include/ofx/ofxCore.h '#include "wideopen/base.h"'
    broken "core must not include ofx" core/base/number.c '#include "ofx/ofxCore.h"'
    broken "core must not include ofx" core/base/number.c '#include <ofx/ofxCore.h>'
    broken "core must not include plugins" core/base/number.c '#include "../../plugins/plugin.c"'
    broken "core must not include <pthread.h>" core/base/number.c '#include <pthread.h>'
    broken "core must not include <threads.h>" core/base/number.c '  #  include <threads.h>'
    broken "OpenEXR belong into bridge" core/base/number.c '#include <openexr.h>'
    broken "simd files" core/base/number.c '#include <immintrin.h>'
    broken "neither in the project" core/base/number.c '#include "missing.h"'
    broken "neither in the project" core/base/number.c '#include <unknown/thing.h>'
    broken "names no file" core/base/number.c '#include NUMBER_H'
    broken "C++ header in a C file" core/base/number.c '#include <vector>'
    broken "must not print: printf" core/base/number.c 'int f(void) { return printf("x"); }'
    broken "must not print: stderr" core/base/number.c 'void *f(void) { return stderr; }'
    broken "must not print: puts" core/base/number.c '/* say */ int x = puts("/*");'
    broken "must not leave the program: exit" core/base/number.c 'void f(void) { exit(1); }'
    broken "must not leave the program: abort" core/base/number.c 'void (*f)(void) = abort;'
    broken "through the context: malloc" core/base/number.c 'void *p = malloc(1);'
    broken "through the context: free" core/base/number.c 'void f(void *p) { free(p); }'
    broken "must not make threads: pthread_create" core/base/context.c 'void *p = pthread_create;'
    broken "must not make threads: _Thread_local" core/base/number.c '_Thread_local int n;'
    broken "must not know OpenFX: OfxStatus" core/base/number.c 'OfxStatus status;'
    broken "plugins must not include core" plugins/plugin.c '#include "base/number.h"'
    broken "plugins must not include bridge" plugins/plugin.c '#include "bridge/io.h"'
    broken "plugins must not include <dlfcn.h>" plugins/plugin.c '#include <dlfcn.h>'
    broken "must not print: fprintf" plugins/plugin.c 'int f(void) { return fprintf(0, ""); }'
    broken "host must not include core" ofx_host_stub/host/host.c '#include "base/number.h"'
    broken "host must not include bridge" ofx_host_stub/host/host.c '#include "../bridge/io.h"'
    broken "host knows no effects" ofx_host_stub/host/host.c '#include "wideopen/effect.h"'
    broken "bridge must not include ofx" ofx_host_stub/bridge/io_exr.c '#include "ofxCore.h"'
    broken "bridge must not include host" ofx_host_stub/bridge/io_exr.c '#include "host/host.h"'
    broken "one foreign library per file" ofx_host_stub/bridge/io_oiio.cc \
        '#include <OpenColorIO/OpenColorIO.h>'
    broken "one foreign library per file" ofx_host_stub/bridge/io_oiio.cc \
        '#include "io_exr_private.h"'
    broken "one foreign library per file" ofx_host_stub/bridge/io_exr.c \
        '#include <embree3/rtcore.h>'
    broken "shows OpenCV" ofx_host_stub/bridge/io.h '#include <opencv2/core.hpp>'
    broken "OpenImageIO belong into bridge" ofx_host_stub/cli/main.c \
        '#include <OpenImageIO/imageio.h>'
    broken "only the C headers of bridge" ofx_host_stub/cli/main.c \
        '#include "bridge/io_exr_private.h"'
    broken "only host/host.h" ofx_host_stub/cli/main.c '#include "host/internal.h"'
    broken "cli must not include core" ofx_host_stub/cli/main.c '#include "base/number.h"'
    broken "cli must not include plugins" ofx_host_stub/cli/main.c \
        '#include "../../plugins/plugin.c"'
    broken "footage must not include host" footage/scene.c '#include "host/host.h"'
    broken "footage must not include core" footage/scene.c '#include "base/number.h"'
    broken "Embree belong into bridge" footage/scene.c '#include <embree4/rtcore.h>'
    broken "OpenCV belong into bridge" tests/unit/test_number.c '#include <opencv2/core.hpp>'
    broken "footage must not include tests" footage/scene.c '#include "../tests/unit/test_number.c"'
    broken "neither in the project" footage/scene.c '#include "scenes.h"'
    broken "neither in the project" tests/unit/test_number.c '#include "missing.h"'
    broken "C++ belongs into bridge only" core/base/fast.cc 'int f;'
    broken "C++ belongs into bridge only" ofx_host_stub/cli/fast.hpp 'int f;'
    broken "outside of the folders" tools/tool.c 'int f;'
}

test_hygiene() {
    gate=hygiene
    fresh
    must 0 "0 faults" "$gates/$gate.sh" "$tree"
    must 2 usage "$gates/$gate.sh" "$work/nowhere"
    c=core/base/number.c

    broken "tab" $c "$(printf '\tint f;')"
    broken "tab" CMakeLists.txt "$(printf 'if(A)\n\tset(B)\nendif()')"
    broken "blank at the end" $c 'int f; '
    broken "blank at the end" README.md 'Words. '
    broken "blank at the end" $c "$(printf 'int f;\r')"
    broken "not ASCII" $c "$(printf '/* \303\274 */')"
    broken "not ASCII" CMakeLists.txt "$(printf '# \303\274')"
    broken "longer than 100" $c "/* $(printf '%096d' 0) */"
    broken "longer than 100" include/wideopen/base.h "/* $(printf '%096d' 0) */"
    broken "finish something" $c "/* TO""DO: more */"
    broken "finish something" README.md "FIX""ME"
    broken "finish something" check "# XX""X"
    broken "switched off" $c '#if 0' '#endif'
    broken "switched off" include/wideopen/base.h '  #  if 0' '#endif'
    broken "code in a comment" $c '/* f(x); */'
    broken "code in a comment" $c '// x = 3;'
    broken "code in a comment" $c '/* const int x = f(3);' ' * and more */'
    broken "code in a comment" $c '/*' 'if (x) {' '*/'
    broken "code in a comment" $c '/* #include <math.h> */'
    broken "code in a comment" include/wideopen/base.h '/* return x; */'
    broken "code in a comment" CMakeLists.txt '# set(A 1)'
    broken "somebody's machine" $c '/* see /home''/me/notes */'
    broken "somebody's machine" README.md 'In /wo''rk/here.'
    broken "more than 650 lines" $c \
        "$(awk 'BEGIN { while (i++ < 660) print "int f" i ";" }')"

    fresh
    edit 1d "$tree/$c"
    must 1 "$c:1: the first line is not" "$gates/$gate.sh" "$tree"
    fresh
    edit 2d "$tree/check"
    echo : >>"$tree/check"
    must 1 "check:2: the second line is not" "$gates/$gate.sh" "$tree"
    fresh
    printf 'int last;' >>"$tree/$c"
    must 1 "$c: no newline at the end" "$gates/$gate.sh" "$tree"
    fresh
    mkdir "$tree/scripts"
    echo : >"$tree/scripts/run"
    must 1 "scripts: does not belong" "$gates/$gate.sh" "$tree"
    fresh
    echo : >"$tree/tests/a name"
    must 1 "tests/a name: a name of other characters" "$gates/$gate.sh" "$tree"
    # Good prose is no code.
    fresh
    printf '/* Reads f(x) twice; the second\n   time; from g (or h);\n   x = 3 then. */\n' \
        >>"$tree/$c"
    must 0 "0 faults" "$gates/$gate.sh" "$tree"
}

test_headers() {
    [ $# -eq 2 ] || usage
    run_headers() { "$gates/headers.sh" "$cc" "$cxx" "$tree"; }
    cc=$1 cxx=$2
    fresh
    must 0 " 0 failed" run_headers
    for file in include/wideopen/base.h include/ofx/ofxCore.h ofx_host_stub/host/host.h \
            ofx_host_stub/bridge/io.h footage/footage.h; do
        fresh
        header "$tree/$file" WO_H 'uint32_t wo_value(void);'
        must 1 "$file does not compile alone" run_headers
    done
    fresh
    header "$tree/include/wideopen/base.h" WO_H 'int wo_f(int template);'
    must 1 "std=c++17" run_headers
    fresh
    header "$tree/include/wideopen/base.h" WO_H 'static_assert(true);'
    must 1 "std=c11" run_headers
    fresh
    put "$tree/include/wideopen/base.h" 'struct wo_twice { int a; };'
    must 1 "base.h does not compile alone" run_headers
    fresh
    header "$tree/include/wideopen/base.h" WO_H \
        'static inline int wo_f(int unused)' '{' '    return 0;' '}'
    must 1 "base.h does not compile alone" run_headers
}

test_format() {
    [ $# -eq 1 ] || usage
    run_format() { "$gates/format.sh" "$clang_format" "$tree"; }
    clang_format=$1
    printf 'BasedOnStyle: LLVM\nIndentWidth: 4\nSortIncludes: Never\n' >"$sound/.clang-format"
    find "$sound" \( -name '*.c' -o -name '*.h' -o -name '*.cc' \) -exec "$clang_format" -i {} +
    fresh
    must 0 " 0 not formatted" run_format
    echo 'int  f ;' >>"$tree/core/base/number.c"
    must 1 "core/base/number.c: " run_format
}

test_bundles() {
    [ $# -eq 1 ] || usage
    cc=$1
    folder=$work/plugins
    binary=$folder/A.ofx.bundle/Contents/Linux-x86-64/A.ofx
    mkdir -p "$(dirname "$binary")"
    cat >"$work/plugin.c" <<'END'
#include <stdlib.h>
int OfxGetNumberOfPlugins(void);
void *OfxGetPlugin(int n);
int OfxSetHost(const void *host);
int OfxGetNumberOfPlugins(void) { return abs(-1); }
void *OfxGetPlugin(int n) { return n ? 0 : calloc(1, 1); }
int OfxSetHost(const void *host) { return host != 0; }
END
    # build OPTION...
    build() {
        # shellcheck disable=SC2086 # a compiler may be a command with arguments
        $cc -shared -fPIC -o "$binary" "$@" 2>"$work/log" || fail "$(cat "$work/log")"
    }
    must 2 "no plugin" "$gates/bundles.sh" exports "$folder"
    must 2 usage "$gates/bundles.sh" other "$folder"
    build "$work/plugin.c"
    must 0 " 0 faults" "$gates/bundles.sh" exports "$folder"
    must 0 " 0 faults" "$gates/bundles.sh" needed "$folder"

    build -DOfxSetHost=ofx_set_host "$work/plugin.c"
    must 1 "missing: OfxSetHost" "$gates/bundles.sh" exports "$folder"
    must 1 "one too many: ofx_set_host" "$gates/bundles.sh" exports "$folder"
    echo 'int wo_state = 3;' >"$work/more.c"
    build "$work/plugin.c" "$work/more.c"
    must 1 "one too many: wo_state" "$gates/bundles.sh" exports "$folder"
    build "$work/plugin.c" -Wl,-z,execstack
    must 1 "executable stack" "$gates/bundles.sh" exports "$folder"
    printf '%s\n' '__asm__(".pushsection .text; .quad OfxSetHost; .popsection");' >"$work/more.c"
    build "$work/plugin.c" "$work/more.c" -Wl,-z,notext
    must 1 "relocations in code" "$gates/bundles.sh" exports "$folder"
    build "$work/plugin.c" -Wl,-rpath,/somewhere
    must 1 "search path: /somewhere" "$gates/bundles.sh" needed "$folder"
    echo 'int wo_other(void); int wo_other(void) { return 1; }' >"$work/other.c"
    # shellcheck disable=SC2086
    $cc -shared -fPIC -o "$work/libother.so" "$work/other.c"
    build "$work/plugin.c" -Wl,--no-as-needed -L"$work" -lother
    must 1 "needs libother.so" "$gates/bundles.sh" needed "$folder"
    build "$work/plugin.c" -nostdlib
    must 1 "not even the C library" "$gates/bundles.sh" needed "$folder"
    echo 'no binary' >"$binary"
    must 1 "cannot read it" "$gates/bundles.sh" exports "$folder"
}

test_state() {
    [ $# -eq 1 ] || usage
    cc=$1
    # archive LINE...
    archive() {
        printf '%s\n' "$@" >"$work/part.c"
        rm -f "$work/libpart.a"
        # shellcheck disable=SC2086
        $cc -O2 -fPIC -fdata-sections -c -o "$work/part.o" "$work/part.c" &&
            ar rcs "$work/libpart.a" "$work/part.o"
    }
    archive 'static const char *const names[] = {"a", "b"};' 'const int wo_table[] = {1, 2};' \
        'const char *wo_name(int i) { return names[i]; }'
    must 0 " 0 with variables" "$gates/state.sh" "$work/libpart.a"
    must 2 "cannot read" "$gates/state.sh" "$work/plugin.c"
    archive 'int wo_counter;'
    must 1 "variable wo_counter" "$gates/state.sh" "$work/libpart.a"
    archive 'int wo_counter = 3;'
    must 1 "variable wo_counter" "$gates/state.sh" "$work/libpart.a"
    archive 'int wo_next(void) { static int last; return ++last; }'
    must 1 "variable last" "$gates/state.sh" "$work/libpart.a"
    archive 'const char *wo_names[] = {"a"};'
    must 1 "variable wo_names" "$gates/state.sh" "$work/libpart.a"
    archive '_Thread_local int wo_mine;'
    must 1 "variable wo_mine" "$gates/state.sh" "$work/libpart.a"
}

test_abi() {
    [ $# -eq 2 ] || usage
    cc=$1 root=$2
    run_dump() {
        "$root/tests/contract/ofx_abi.sh" "$cc" "$work/ofx" "$root/tests/contract/ofx_abi_dump.c" \
            "$root/tests/contract/ofx_abi_expect.txt" "$work/dump"
    }
    # shellcheck disable=SC2086
    run_signatures() {
        $cc -std=c11 -fsyntax-only -I "$work/ofx" "$root/tests/contract/ofx_signatures.c"
    }
    # spoilt FILE EXPRESSION: our headers with one change, which must be one.
    spoilt() {
        rm -rf "$work/ofx"
        cp -R "$root/include/ofx" "$work/ofx"
        : >"$work/said"
        edit "$2" "$work/ofx/$1"
        ! cmp -s "$root/include/ofx/$1" "$work/ofx/$1" || fail "no change in $1: $2"
    }
    rm -rf "$work/ofx"
    cp -R "$root/include/ofx" "$work/ofx"
    must 0 "" run_dump
    must 0 "" run_signatures
    spoilt ofxCore.h 's/"OfxActionDescribe"/"OfxActionDescribes"/'
    must 1 "differ" run_dump
    spoilt ofxCore.h 's/^#define kOfxStatErrMemory .*/#define kOfxStatErrMemory 9/'
    must 1 "differ" run_dump
    spoilt ofxCore.h '/^    const char \*pluginIdentifier;/d'
    must 1 "" run_dump
    spoilt ofxImageEffect.h 's/const OfxRectD \*region/OfxRectD *region/'
    must 1 "clipGetImage" run_signatures
    spoilt ofxCore.h 's/typedef double OfxTime/typedef float OfxTime/'
    must 1 "OfxTime" run_signatures
}

[ $# -ge 1 ] || usage
name=$1
shift
case $name in
include_direction | hygiene | headers | format | bundles | state | abi) ;;
*) usage ;;
esac
make_project
"test_$name" "$@"
echo "$checks checks, $failures failures"
[ "$failures" -eq 0 ]
