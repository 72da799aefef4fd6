/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_BRIDGE_OPENCV_PRIVATE_HH
#define WO_BRIDGE_OPENCV_PRIVATE_HH

#include "picture_private.h"

#include <opencv2/core.hpp>

#include <string>

/* What the *_opencv.cc files share. Matrices are top row first. */

/* A copy as floats, with the components it has. */
cv::Mat wo_mat_of(const wo_image *image);

/* A malloc-ed copy of a float or 8-bit matrix (0..255 becomes 0..1). */
WO_NODISCARD wo_status wo_image_of(const cv::Mat &mat, wo_image *result, wo_error *error);

/* Changes the size; smaller by area average, larger by linear interpolation. */
cv::Mat wo_resized(const cv::Mat &mat, int width, int height);

/* One line of smooth text, its left end at x and the middle of its capitals at y, cut short with
   dots where it is wider than most pixels. size is the height of capitals. Returns its width. */
int wo_draw_text(cv::Mat &canvas, const std::string &text, int x, int y, int size, int most,
                 const cv::Scalar &colour);

#endif
