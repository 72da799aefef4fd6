# SPDX-License-Identifier: BSD-3-Clause
# Copyright the WideOpen authors
#
# Who includes whom. Reads the list of all files, then (as the second file) what blank.awk makes of
# the sources with want=code; prints one line for every forbidden edge or name.

function words(text, set,    list, count, i)
{
    count = split(text, list, " ")
    for (i = 1; i <= count; i++)
        set[list[i]] = 1
}

BEGIN {
    FS = "\t"
    words("assert complex ctype errno fenv float inttypes iso646 limits locale math setjmp " \
          "signal stdalign stdarg stdatomic stdbool stddef stdint stdio stdlib stdnoreturn " \
          "string tgmath time uchar wchar wctype", standard)
    words("dirent dlfcn elf fcntl fnmatch ftw glob langinfo libgen malloc poll pthread sched " \
          "semaphore spawn strings termios threads unistd", system_header)
    words("immintrin x86intrin cpuid arm_neon arm_sve", vector)
    words("printf vprintf fprintf vfprintf dprintf vdprintf puts fputs putc fputc putchar fwrite " \
          "perror fopen fdopen freopen fflush stdout stderr stdin", printing)
    words("exit _exit _Exit quick_exit abort atexit at_quick_exit raise setjmp longjmp", leaving)
    words("malloc calloc realloc reallocarray aligned_alloc free posix_memalign memalign valloc " \
          "strdup strndup alloca", memory)
    words("_Thread_local __thread thread_local call_once", threads)

    # What each folder may see: folders, and the kinds of system headers.
    allowed["api"] = "api standard"
    allowed["ofx"] = "ofx standard"
    allowed["core"] = "api core standard"
    allowed["plugins"] = "api ofx plugins standard"
    allowed["host"] = "api ofx host standard system"
    allowed["bridge"] = "api bridge standard system"
    allowed["cli"] = "api host bridge footage cli standard system"
    allowed["footage"] = "api bridge footage standard system"
    allowed["tests"] = "api ofx core plugins host bridge footage cli tests standard system test"
    root_count = split("include/ core/ ofx_host_stub/ include/ofx/ plugins/ ofx_host_stub/host/ " \
                       "ofx_host_stub/bridge/ ofx_host_stub/cli/ footage/",
                       roots, " ")
}

function fault(text)
{
    printf "%s:%d: %s\n", file, line, text
    faults++
}

function folder_of(path)
{
    if (path ~ /^include\/wideopen\//)
        return "api"
    if (path ~ /^include\/ofx\//)
        return "ofx"
    if (path ~ /^ofx_host_stub\/(host|bridge|cli)\//) {
        sub(/^ofx_host_stub\//, "", path)
        sub(/\/.*/, "", path)
        return path
    }
    if (path ~ /^(core|plugins|footage|tests)\//) {
        sub(/\/.*/, "", path)
        return path
    }
    return ""
}

# a/./b and a/x/../b become a/b.
function simple(path)
{
    while (sub(/(^|\/)\.\//, "/", path))
        ;
    while (sub(/[^\/]+\/\.\.\//, "", path))
        ;
    sub(/^\//, "", path)
    return path
}

function exists(path)
{
    return path in known || (path ".in") in known
}

# The file of the project that a name means, or "".
function resolve(name,    own, i)
{
    own = file
    sub(/[^\/]*$/, "", own)
    if (exists(simple(own name)))
        return simple(own name)
    for (i = 1; i <= root_count; i++)
        if (exists(simple(roots[i] name)))
            return simple(roots[i] name)
    if (exists(simple(name)))
        return simple(name)
    return from == "tests" && name in test_header ? test_header[name] : ""
}

function family(name)
{
    if (name ~ /^OpenImageIO\//)
        return "OpenImageIO"
    if (name ~ /^OpenColorIO\//)
        return "OpenColorIO"
    if (name ~ /^opencv2?\//)
        return "OpenCV"
    if (name ~ /^openexr[a-z_]*\.h$/ || name ~ /^(OpenEXR|Imath)\//)
        return "OpenEXR"
    if (name ~ /^embree[0-9]*\//)
        return "Embree"
    return ""
}

# Kind of a header that is not the project's.
function system_kind(name,    base)
{
    base = name
    if (sub(/\.h$/, "", base)) {
        if (base in standard)
            return "standard"
        if (base in system_header || base ~ /^sys\//)
            return "system"
        if (base in vector)
            return "vector"
        if (base == "cmocka")
            return "test"
    }
    if (family(name) != "")
        return "foreign"
    return name ~ /^[a-z_]+$/ ? "c++" : ""
}

function may(folder, what)
{
    return index(" " allowed[folder] " ", " " what " ") > 0
}

function check_own(name, target,    to)
{
    to = folder_of(target)
    if (to == "") {
        fault("\"" name "\" lies in no folder that may be included")
        return
    }
    if (!may(from, to)) {
        fault(from " must not include " to ": \"" name "\"")
        return
    }
    if (from == "bridge")
        inner[file] = inner[file] " " target
    if (from == to || from == "tests")
        return
    if (to == "bridge" && (target !~ /\.h$/ || target ~ /_private\.h$/))
        fault("only the C headers of bridge may be included: \"" name "\"")
    if (to == "host" && target !~ /^ofx_host_stub\/host\/(host|found)\.h$/)
        fault("only host/host.h and found.h of the host may be included: \"" name "\"")
    if (to == "footage" && target != "footage/footage.h")
        fault("only footage.h of the footage may be included: \"" name "\"")
    if (from == "host" && target == "include/wideopen/effect.h")
        fault("the host knows no effects: \"" name "\"")
}

function check_system(name,    kind)
{
    kind = system_kind(name)
    if (kind == "")
        fault("<" name "> is neither in the project nor a known system header")
    else if (kind == "foreign") {
        if (from != "bridge")
            fault("headers of " family(name) " belong into bridge: <" name ">")
        else {
            if (file ~ /\.h$/ && file !~ /_private\.h$/)
                fault("a public header of bridge shows " family(name) ": <" name ">")
            foreign[file] = foreign[file] " " family(name)
        }
    } else if (kind == "c++") {
        if (file !~ /\.(cc|hh)(\.in)?$/)
            fault("C++ header in a C file: <" name ">")
    } else if (kind == "vector") {
        if (from != "core" || file !~ /(simd|avx|neon)/)
            fault("vector instructions belong into core's simd files: <" name ">")
    } else if (!may(from, kind) && !(file == "plugins/ofx_draw_gl.c" && name == "dlfcn.h"))
        fault(from " must not include <" name ">")
}

function check_include(text,    name, target)
{
    sub(/^[ \t]*#[ \t]*include(_next)?[ \t]*/, "", text)
    if (text !~ /^("[^"]+"|<[^>]+>)/) {
        fault("an #include that names no file: " text)
        return
    }
    name = substr(text, 2)
    sub(/[">].*/, "", name)
    includes++
    if (text ~ /^</ && system_kind(name) != "") {
        check_system(name)
        return
    }
    target = resolve(name)
    if (target != "")
        check_own(name, target)
    else
        check_system(name)
}

# Names that core and plugins must not use. Members of structs may be called so.
function check_names(text,    name, before)
{
    while (match(text, /[A-Za-z_][A-Za-z0-9_]*/)) {
        name = substr(text, RSTART, RLENGTH)
        before = substr(text, 1, RSTART - 1)
        text = substr(text, RSTART + RLENGTH)
        if (before ~ /(\.|->)[ \t]*$/)
            continue
        if (name in printing)
            fault(from " must not print: " name)
        else if (name in leaving)
            fault(from " must not leave the program: " name)
        else if (name in memory && file != "core/base/context.c")
            fault(from " must allocate through the context: " name)
        else if (name in threads || name ~ /^(pthread|thrd|mtx|cnd|tss)_/)
            fault(from " must not make threads: " name)
        else if (from == "core" && name ~ /^k?Ofx[A-Z]/)
            fault("core must not know OpenFX: " name)
    }
}

# Foreign families that a file of bridge sees, own headers included.
function families_of(path, seen, found,    list, count, i)
{
    if (path in seen)
        return
    seen[path] = 1
    count = split(foreign[path], list, " ")
    for (i = 1; i <= count; i++)
        found[list[i]] = 1
    count = split(inner[path], list, " ")
    for (i = 1; i <= count; i++)
        families_of(list[i], seen, found)
}

NR == FNR {
    known[$1] = 1
    if ($1 ~ /^tests\/.*\.h$/) {
        name = $1
        sub(/.*\//, "", name)
        test_header[name] = $1
    }
    next
}

$1 != file {
    file = $1
    line = 1
    from = folder_of(file)
    files++
    if (from == "")
        fault("a source file outside of the folders of the project")
    if (file ~ /\.(cc|hh|cpp|cxx|hpp|hxx|C|H)(\.in)?$/ && from != "bridge")
        fault("C++ belongs into bridge only")
    if (from == "bridge")
        bridge[++bridge_count] = file
}

{
    line = $2
    text = substr($0, length($1) + length($2) + 3)
    if (text ~ /^[ \t]*#[ \t]*include/)
        check_include(text)
    else if (from == "core" || from == "plugins")
        check_names(text)
}

END {
    line = 1
    for (i = 1; i <= bridge_count; i++) {
        split("", seen)
        split("", found)
        file = bridge[i]
        families_of(file, seen, found)
        list = ""
        count = 0
        for (name in found) {
            list = list (count++ ? " and " : "") name
        }
        if (count > 1)
            fault("one foreign library per file, not " list)
    }
    if (!includes) {
        print "no #include was found at all"
        exit 1
    }
    printf "%d includes in %d files, %d faults\n", includes, files, faults
    exit faults > 0
}
