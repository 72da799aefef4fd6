/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CLI_RENDER_INPUT_PRIVATE_H
#define WO_CLI_RENDER_INPUT_PRIVATE_H

#include "render_input.h"

#include <limits.h>
#include <pthread.h>

/* render_input.c reads the pictures, render_source.c gives them to the host. */

enum { WO_PICTURES_MAX = 8, WO_FILES_MAX = 4 };

/* One frame of one clip. */
typedef struct wo_input_picture {
    int frame;
    bool linear;      /* colour conversion is done, or not needed */
    int own;          /* components in the file */
    char *path;       /* of this file */
    char *space;      /* its colour space */
    wo_image image;   /* data is malloc-ed */
    wo_io_file *file; /* headers only */
    size_t part;      /* of the file */
    unsigned long used;
} wo_input_picture;

struct wo_input {
    wo_inputs *inputs;
    const wo_host_clip_info *clip;
    char *pattern;
    char *channels;
    bool found;      /* channels are what was found for depth, not what was given */
    char space[256]; /* of the present picture, or of the last there was */
    bool sequence;
    int first, last; /* frames of a sequence that are on the disk */
    int components;  /* what the host was told, 0 = nothing yet */
    bool raw;
    bool wished; /* raw was asked for, whatever the picture looks like */
    bool missed; /* the plugin wanted a frame beyond them ... */
    bool given;  /* ... and got another one */
    wo_input_picture pictures[WO_PICTURES_MAX];
    size_t picture_count;
    const wo_input_picture *present;
};

/* A file with its pixels, kept while the clips of one frame are read: several clips often lie in
   one multi-part file. */
typedef struct wo_open_file {
    char path[PATH_MAX];
    wo_io_file *file;
} wo_open_file;

struct wo_inputs {
    wo_colour *colour;
    const char *in_space;
    const char *own; /* parameters set by hand; NULL = no metadata is passed on */
    wo_missing_frames missing;
    const wo_input *main; /* the others come on its pixels; NULL = each on its own */
    wo_project_pixels pixels;
    pthread_mutex_t lock; /* guards all below once a render runs */
    wo_input *clips[WO_INPUTS_MAX];
    size_t count;
    wo_open_file files[WO_FILES_MAX];
    size_t file_count, file_next;
    unsigned long clock;
};

/* The picture of a frame, read now if it is not held; a still has one for all frames. The lock of
   the inputs is held, here and below. */
WO_NODISCARD wo_status wo_input_fetch(wo_input *input, int frame, wo_input_picture **found,
                                      wo_error *error);
WO_NODISCARD wo_status wo_input_make_linear(wo_input *input, wo_input_picture *p, wo_error *error);

/* Is there nothing to convert in a picture of the clip? */
bool wo_input_is_numbers(const wo_input *input, const wo_input_picture *p);

/* The frame whose picture is taken for this one. A clip that is looked at elsewhere, too, need not
   have the frame that is rendered: its nearest one then stands for what is the same in all. */
int wo_input_stand_in(const wo_input *input, int frame);

/* Pixel aspect of a picture that wo_input_make_linear made. */
double wo_input_aspect(const wo_input *input, const wo_input_picture *p);

#endif
