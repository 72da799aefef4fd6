/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CLI_DEPTH_CHANNEL_H
#define WO_CLI_DEPTH_CHANNEL_H

#include "bridge/image_io.h"

/* Where a file keeps its depth, when it is given for a clip of depth with words that show a colour:
   "" of a file with R, G, B, A and Z, or "layer2" with layer2.Z or layer2_depth.Z beside its
   colour; not the depth of another layer. Writes the words that name the channel (for wo_io_select)
   and is true; false: the words are good as they are, or there is no such channel. Channels are
   known by their names alone: Z, depth, zdepth, or whatever is in a layer called so; not Z beside X
   and Y, which is part of a vector. */
bool wo_depth_channel(const wo_io_file *file, const char *words, char *channel, size_t size);

/* Is it a clip of depth, by its name: "Depth", "Depth2", "BackgroundDepth"? */
bool wo_is_depth_clip(const char *clip);

/* Name of the clip whose depth this is: "Source" of "Depth", "Layer2" of "Depth2", "Background" of
   "BackgroundDepth"; false: it is no clip of depth. */
bool wo_colour_of_depth(const char *clip, char *colour, size_t size);

/* Do the three first channels of a picture differ, so that it is no grey one? */
bool wo_is_coloured(const wo_image *image);

#endif
