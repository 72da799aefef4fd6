/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#define _POSIX_C_SOURCE 200809L
#include "image_io_private.h"

#include <dlfcn.h>
#include <pthread.h>
#include <stdio.h>
#include <string.h>

/* Loads io_oiio.cc with all that it needs, once, and passes calls on to it. It stays loaded: its
   libraries keep threads and caches. */

static struct {
    pthread_once_t once;
    char why[256]; /* it could not be loaded */
    wo_status (*read)(const char *, const wo_io_format *, bool, wo_io_file **, wo_error *);
    wo_status (*write)(const char *, int, const wo_io_format *, const wo_io_part *, wo_io_depth,
                       wo_error *);
    wo_status (*exr_pixels)(const char *, int, wo_io_part *, wo_error *);
} module = {.once = PTHREAD_ONCE_INIT};

/* A pointer to a function out of a pointer to an object: POSIX promises that it fits. */
static bool find(void *library, const char *name, void *function, size_t bytes)
{
    void *const address = dlsym(library, name);
    memcpy(function, &address, bytes);
    return address != NULL;
}

static void load(void)
{
    void *const library = dlopen("wo_oiio.so", RTLD_LAZY | RTLD_LOCAL);
    if (library && find(library, "wo_io_oiio_read", &module.read, sizeof module.read) &&
        find(library, "wo_io_oiio_write", &module.write, sizeof module.write) &&
        find(library, "wo_io_oiio_exr_pixels", &module.exr_pixels, sizeof module.exr_pixels))
        return;
    const char *const words = dlerror();
    snprintf(module.why, sizeof module.why, "%s", words ? words : "no reason is given");
}

static wo_status ready(wo_error *error)
{
    (void)pthread_once(&module.once, load);
    return module.why[0] ? wo_fail(error, WO_ERR_LIBRARY, "OpenImageIO: %s", module.why) : WO_OK;
}

wo_status wo_io_oiio_read(const char *path, const wo_io_format *format, bool headers_only,
                          wo_io_file **file, wo_error *error)
{
    WO_TRY(ready(error));
    return module.read(path, format, headers_only, file, error);
}

wo_status wo_io_oiio_write(const char *path, int fd, const wo_io_format *format,
                           const wo_io_part *part, wo_io_depth depth, wo_error *error)
{
    WO_TRY(ready(error));
    return module.write(path, fd, format, part, depth, error);
}

wo_status wo_io_oiio_exr_pixels(const char *path, int part_index, wo_io_part *part, wo_error *error)
{
    WO_TRY(ready(error));
    return module.exr_pixels(path, part_index, part, error);
}
