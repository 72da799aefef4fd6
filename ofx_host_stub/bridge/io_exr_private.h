/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_BRIDGE_IO_EXR_PRIVATE_H
#define WO_BRIDGE_IO_EXR_PRIVATE_H

#include "image_io_private.h"

#include <openexr.h>

/* What the io_exr_*.c files share. The library reads and writes through this stream, so that its
   words and the system's errors end here and not on stderr. */
typedef struct wo_exr_stream {
    const char *path;
    int fd;
    int64_t size;     /* of a file being read */
    int system_error; /* errno of the first failed call, 0 = none */
    bool no_memory;   /* the library asked for some and got none */
    char words[128];  /* first complaint of the library */
} wo_exr_stream;

/* From begin to end the library's complaints in this thread go to the stream. */
void wo_exr_begin(wo_exr_stream *stream);
void wo_exr_end(void);

/* Settings of a context that uses the stream. */
exr_context_initializer_t wo_exr_settings(wo_exr_stream *stream);

/* Status and text for a failed call of the library. */
wo_status wo_exr_failure(const wo_exr_stream *stream, exr_result_t result, wo_error *error);

#define WO_EXR_TRY(stream, call)                                                                   \
    do {                                                                                           \
        const exr_result_t wo_exr_result = (call);                                                 \
        if (wo_exr_result != EXR_ERR_SUCCESS)                                                      \
            return wo_exr_failure((stream), wo_exr_result, error);                                 \
    } while (0)

/* Zeroed memory for the library's buffers, so that short data never shows old memory. */
void *wo_exr_get(size_t bytes);
void *wo_exr_get_buffer(exr_transcoding_pipeline_buffer_id_t which, size_t bytes);
void wo_exr_put_buffer(exr_transcoding_pipeline_buffer_id_t which, void *memory);

/* Attributes, both directions. */
WO_NODISCARD wo_status wo_exr_read_attributes(const wo_exr_stream *stream, exr_const_context_t exr,
                                              int index, wo_io_part *part, wo_error *error);
WO_NODISCARD wo_status wo_exr_write_attributes(const wo_exr_stream *stream, exr_context_t exr,
                                               int index, const wo_io_part *part, wo_error *error);

/* One channel as it lies in a chunk. */
typedef struct wo_exr_channel {
    int target; /* index in wo_io_part, -1 = not wanted */
    exr_pixel_type_t type;
    uint8_t bytes;                  /* of a sample */
    bool chroma;                    /* RY of a layer of luminance and chroma */
    int32_t x_sampling, y_sampling; /* every how many pixels there is a sample */
} wo_exr_channel;

/* A part being read. */
typedef struct wo_exr_source {
    wo_exr_stream *stream;
    exr_const_context_t exr;
    int index;
    wo_io_part *part;
    const wo_exr_channel *channels; /* in file order */
    size_t channel_count;
    size_t pixel_bytes; /* of one sample of every channel */
    exr_storage_t storage;
    exr_compression_t compression;
    int32_t tile_width, tile_height; /* 0 = scanlines */
    int32_t left, top;               /* of the data window, as the file counts */
    int32_t x, y;                    /* of the chunk being unpacked: left, top, y down, from 0 */
    wo_status status;                /* why unpacking failed */
    wo_error *error;
    void *scratch; /* of the deep reader */
    size_t scratch_size;
} wo_exr_source;

/* Sample i of a channel's row as a float. */
float wo_exr_sample(const uint8_t *row, exr_pixel_type_t type, size_t i);

/* Gives a part that has a head its pixels; count channels in file order (io_exr_read.c). */
WO_NODISCARD wo_status wo_exr_read_pixels(wo_exr_stream *stream, exr_const_context_t exr, int index,
                                          wo_io_part *part, const wo_exr_channel *channels,
                                          size_t count, wo_error *error);

/* io_exr_chroma.c. */

/* Does the channel belong to a layer of Y, RY and BY without other colours? Then such a layer is
   shown as R, G, B: RY in the place of R, Y of G, BY of B. */
bool wo_exr_is_chroma(const exr_attr_chlist_t *list, const char *name);
/* Fills the pixels between the samples of a channel. left and top are those of the data window in
   the file; both samplings divide them and the part's size. */
void wo_exr_interpolate(wo_io_part *part, const wo_exr_channel *channel);
/* Y, RY, BY in the places red, red + 1, red + 2 to R, G, B. */
void wo_exr_chroma_to_rgb(wo_io_part *part, int red, const exr_attr_chromaticities_t *primaries);

/* Flattens one deep chunk into the part (io_exr_deep.c). */
WO_NODISCARD wo_status wo_exr_flatten(wo_exr_source *source, const exr_decode_pipeline_t *decode);

#endif
