/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_BRIDGE_IO_CHILD_PRIVATE_H
#define WO_BRIDGE_IO_CHILD_PRIVATE_H

#include "image_io_private.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What passes between a program that reads a file (io_child.c) and wideopen-read (read_main.c),
   which decodes it. The program starts one wideopen-read and keeps it. That one loads the image
   library, forks a process for the next file, waits for its end and tells of it: whatever a damaged
   file does to the library's memory ends with that process.

   A request goes through a socket that keeps messages apart, with two descriptors: the file, and
   the writing end of a pipe. Through the pipe come records until the process ends, and then one
   reply through the socket. */

#define WO_CHILD_PROGRAM "wideopen-read"
#define WO_CHILD_MARK    0x776f3031u

enum { WO_CHILD_SOCKET = 3 }; /* where wideopen-read finds its end */

typedef struct wo_child_request {
    uint32_t mark;
    int32_t part;          /* of an EXR; -1 = every part */
    uint32_t headers_only; /* 0 or 1 */
    uint32_t files;        /* that one process reads before it ends */
    uint32_t go_on;        /* behind a file that is refused, 0 or 1 */
    uint64_t promised;     /* bytes of pixels as floats by the file's own head, 0 = not known */
    char library[16];      /* the format, as OpenImageIO calls it */
    char extension[8];     /* and people do */
    char shown[104];       /* the file's name for texts */
} wo_child_request;

typedef struct wo_child_reply {
    uint32_t mark;
    int32_t ended; /* 0 = the process reads on, 1 = state is that of waitpid */
    int32_t state;
} wo_child_reply;

typedef enum wo_child_kind {
    WO_CHILD_HEAD,   /* a file without pixels, wo_wire_put_file */
    WO_CHILD_PIXELS, /* floats of part index */
    WO_CHILD_FAULT,  /* text: why part index has no pixels */
    WO_CHILD_END     /* index is a wo_status, then the error's text */
} wo_child_kind;

typedef struct wo_child_record {
    uint32_t kind;
    uint32_t index;
    uint64_t bytes; /* that follow */
} wo_child_record;

/* Most bytes of a HEAD, and of a text. */
#define WO_CHILD_MAX_HEAD ((uint64_t)256 << 20)
#define WO_CHILD_MAX_TEXT 255

/* Limits of one process: what a picture of so many bytes may take. Memory in bytes on top of what
   the empty process has, time in seconds. */
uint64_t wo_child_memory(uint64_t picture, uint64_t file);
unsigned wo_child_seconds(uint64_t picture);      /* of the processor */
unsigned wo_child_wall_seconds(uint64_t picture); /* by the clock, without progress */

/* Bytes to be sent, or being taken apart. */
typedef struct wo_wire {
    unsigned char *bytes; /* malloc-ed by wo_wire_put_file */
    size_t size, used;
} wo_wire;

/* A file without its pixels, to bytes and back. Reading checks every size and count. */
WO_NODISCARD wo_status wo_wire_put_file(const wo_io_file *file, wo_wire *wire, wo_error *error);
WO_NODISCARD wo_status wo_wire_get_file(const char *path, wo_wire *wire, wo_io_file **file,
                                        wo_error *error);

/* Reads a file in a process of its own; fd is the open file, path for texts, promised as in the
   request. */
WO_NODISCARD wo_status wo_io_read_apart(const char *path, int fd, const wo_io_format *format,
                                        bool headers_only, uint64_t promised, wo_io_file **file,
                                        wo_error *error);

/* Fills the pixels of part_index of an EXR whose header is read; for B44 and DWA. */
WO_NODISCARD wo_status wo_io_exr_pixels_apart(const char *path, int fd, int part_index,
                                              wo_io_part *part, wo_error *error);

/* io_oiio_read.cc: what comes of a file goes to a sink. head is called once, then pixels or fault
   for each part, or nothing more when only headers are wanted. */
typedef struct wo_child_sink {
    wo_status (*head)(void *to, const wo_io_file *file, wo_error *error);
    wo_status (*pixels)(void *to, size_t index, const wo_io_part *part, wo_error *error);
    wo_status (*fault)(void *to, size_t index, const char *text, wo_error *error);
    void *to;
} wo_child_sink;

/* path is what to open, of file_bytes bytes. */
WO_NODISCARD wo_status wo_io_oiio_read(const wo_child_request *request, const char *path,
                                       uint64_t file_bytes, const wo_child_sink *sink,
                                       wo_error *error);

#ifdef __cplusplus
}
#endif
#endif
