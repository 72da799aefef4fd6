/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CLI_RENDER_INPUT_H
#define WO_CLI_RENDER_INPUT_H

#include "bridge/colour.h"
#include "bridge/image_io.h"
#include "host/host.h"
#include "picture_fit.h"
#include "render_output.h"

/* The clips of a render: files, or sequences of them, as sources of a host. A clip holds the
   picture of the frame that is rendered; a clip that looks at other frames holds a few more. */

#define WO_INPUTS_MAX 32 /* clips of one render */

/* What becomes of a frame that is not on the disk. */
typedef enum wo_missing_frames {
    WO_MISSING_ERROR,
    WO_MISSING_SKIP, /* the caller leaves it out */
    WO_MISSING_HOLD  /* the last one before it stands in its place, before the first the first */
} wo_missing_frames;

/* OpenFX names of what plugins are given. */
#define WO_OFX_SPACE_WORKING "ofx_scene_linear"
#define WO_OFX_SPACE_RAW     "ofx_raw"

typedef struct wo_inputs wo_inputs;
typedef struct wo_input wo_input; /* one clip */

/* colour is borrowed until wo_inputs_destroy, which takes NULL and sets *inputs to NULL. in_space
   is the space of all colour files, or NULL: each by the rules of the colour configuration. */
WO_NODISCARD wo_status wo_inputs_create(wo_colour *colour, const char *in_space, wo_inputs **inputs,
                                        wo_error *error);
void wo_inputs_destroy(wo_inputs **inputs);

/* Before clips are added; WO_MISSING_ERROR otherwise. */
void wo_inputs_set_missing(wo_inputs *inputs, wo_missing_frames missing);

/* From now on all clips but main come on these pixels; otherwise each on its own. Before
   wo_inputs_prepare. */
void wo_inputs_fit(wo_inputs *inputs, const wo_input *main, const wo_project_pixels *pixels);

/* Adds a clip from "FILE[:CHANNELS]" and reads it at frame. clip is borrowed as long as inputs
   live. */
WO_NODISCARD wo_status wo_inputs_add(wo_inputs *inputs, const wo_host_clip_info *clip,
                                     const char *spec, int frame, wo_error *error);

/* Clip by name, or NULL; by number 0.. in the order they were added, or NULL. */
wo_input *wo_inputs_find(const wo_inputs *inputs, const char *clip);
wo_input *wo_inputs_at(const wo_inputs *inputs, size_t index);

/* Makes the pictures of one frame ready, drops what no clip needs any more. Fails when a file of
   this frame is missing or damaged; a clip that looks at other frames need not have this one. */
WO_NODISCARD wo_status wo_inputs_prepare(wo_inputs *inputs, int frame, wo_error *error);

/* The first clip that a frame is missing of, and that does not look at others; or NULL. */
const wo_input *wo_inputs_missing(const wo_inputs *inputs, int frame);

/* Is the present picture that of another frame, which is held? */
bool wo_input_is_held(const wo_input *input, int frame, int *held);

/* The channel that was found for a clip of depth whose words show a colour; NULL: the words are
   taken as given. */
const char *wo_input_found(const wo_input *input);

/* Does the present picture of a clip of depth show colours, of which one at most is depth? */
bool wo_input_is_coloured_depth(const wo_input *input);

/* What a clip is. */
const char *wo_input_clip(const wo_input *input);
const char *wo_input_file(const wo_input *input);  /* as given, without channels */
const char *wo_input_space(const wo_input *input); /* "raw" for numbers */

/* Whether the clip holds numbers that no colour conversion may touch. Guessed at first: mattes,
   channels that are no colours, and single channels of any clip but Source. */
bool wo_input_is_raw(const wo_input *input);
void wo_input_set_raw(wo_input *input, bool raw); /* before wo_inputs_prepare */

/* The present picture's file without its pixels: windows, pixel aspect, attributes. Borrowed until
   the next wo_inputs_prepare. */
const wo_io_part *wo_input_header(const wo_input *input);

/* Where the present picture comes from; borrowed as the header. */
wo_origin wo_input_origin(const wo_input *input);

/* Lets plugins see the attributes of the files, and "wideopen:own" = own (borrowed until
   wo_inputs_destroy); NULL, as at first: they see nothing. */
void wo_inputs_pass_metadata(wo_inputs *inputs, const char *own);

/* The attributes that plugins see of the present picture, one after the other. */
void wo_input_metadata(const wo_input *input, wo_host_add_metadata *add, void *to);

/* First and last frame of a sequence; false: it is a still, which is there at all times. */
bool wo_input_frames(const wo_input *input, int *first, int *last);

/* Frames per second as the present picture's file says. */
double wo_input_rate(const wo_input *input, double otherwise);

/* After a render of frame: fails when a clip does not have it and gave no other one in its place,
   so that nothing was rendered from it. */
WO_NODISCARD wo_status wo_inputs_check_given(const wo_inputs *inputs, int frame, wo_error *error);

/* The clip as a source; valid as long as inputs live. A still lasts as long as the project. */
wo_host_source wo_input_source(wo_input *input, const wo_host_project *project);

#endif
