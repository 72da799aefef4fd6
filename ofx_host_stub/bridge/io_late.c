/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#define _POSIX_C_SOURCE 200809L
#include "image_io_private.h"

#include "beside.h"

#include <dlfcn.h>
#include <limits.h>

/* OpenImageIO needs some 250 libraries, which take longer to load than a small picture to render:
   io_oiio_write.cc is a library of its own beside the program, loaded when the first file that is
   not EXR is written. It stays loaded; opening it again only finds it. */
#define LIBRARY "wo_formats.so"

typedef union symbol {
    void *address;
    wo_status (*write)(const char *, int, const wo_io_format *, const wo_io_part *, wo_io_depth,
                       wo_error *);
} symbol;

static wo_status find(const char *name, symbol *found, wo_error *error)
{
    char path[PATH_MAX];
    *found = (symbol){NULL};
    if (!wo_beside_program(LIBRARY, path, sizeof path))
        return wo_fail(error, WO_ERR_LIBRARY, "the system does not tell where " LIBRARY " is");
    void *const library = dlopen(path, RTLD_LAZY | RTLD_LOCAL);
    if (library)
        found->address = dlsym(library, name);
    if (found->address)
        return WO_OK;
    const char *const why = dlerror();
    return wo_fail(error, WO_ERR_LIBRARY, "formats other than EXR: %s",
                   why ? why : LIBRARY " is of another version");
}

wo_status wo_io_oiio_write(const char *path, int fd, const wo_io_format *format,
                           const wo_io_part *part, wo_io_depth depth, wo_error *error)
{
    symbol found;
    WO_TRY(find(__func__, &found, error));
    return found.write(path, fd, format, part, depth, error);
}
