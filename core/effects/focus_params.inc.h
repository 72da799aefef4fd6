/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */

/* Rows of a parameter table for what is in focus. The file that includes them in its table defines
   FIELD(name) and includes focus/focus.h; the lists of choices are focus_choices.inc.h. */

#define FOCUS_NUMBER(row_key, row_label, row_unit, field, start, low, high, ui_low, ui_high, ...)  \
    {                                                                                              \
        .key = row_key, .label = row_label, .unit = row_unit, .group = "focusControl",             \
        .help = __VA_ARGS__, .type = WO_PARAM_DOUBLE, .offset = FIELD(field), .initial = {start},  \
        .min = low, .max = high, .ui_min = ui_low, .ui_max = ui_high, .animates = true             \
    }

/* The four rows of point n, first at (x, y). */
#define FOCUS_POINT(n, x, y)                                                                       \
    {.key = "focusPoint" #n,                                                                       \
     .label = "Point " #n,                                                                         \
     .unit = "px",                                                                                 \
     .group = "focusControl",                                                                      \
     .help = "Place of the point in pixels of the full resolution, from the lower left corner of " \
             "the picture (canonical coordinates). Outside the frame it reads the depth at the "   \
             "border and fades out.",                                                              \
     .type = WO_PARAM_POINT,                                                                       \
     .offset = FIELD(focus_point[(n)-1]),                                                          \
     .initial = {x, y},                                                                            \
     .min = -1e6,                                                                                  \
     .max = 1e6,                                                                                   \
     .ui_min = 0,                                                                                  \
     .ui_max = 4096,                                                                               \
     .overlay = true,                                                                              \
     .animates = true},                                                                            \
        FOCUS_NUMBER("focusOffset" #n, "Offset " #n, "1/m", focus_offset[(n)-1], 0, -1e6, 1e6, -2, \
                     2,                                                                            \
                     "Dioptres away from what lies at the point: the focus is so much nearer, or " \
                     "farther if negative, and the point out of focus. 0 has it in focus."),       \
        FOCUS_NUMBER("focusWeight" #n, "Weight " #n, "", focus_weight[(n)-1], 1, 0, 1e6, 0, 10,    \
                     "Strength of the point against the others. 0 takes it away; large values "    \
                     "make its surroundings follow it."),                                          \
        FOCUS_NUMBER("focusDof" #n, "Amount " #n, "", focus_dof[(n)-1], 1, 0, 100, 0, 4,           \
                     "Amount of blur around the point: 0 keeps everything sharp there, 1 is what " \
                     "the lens does, 2 is twice the radius. Between points it changes smoothly.")

{.key = "focusBy",
 .label = "Focus by",
 .unit = "",
 .group = "focusControl",
 .help =
     "What says where the focus is: the focus distance, the depth under point 1, a tilted plane "
     "through what lies at the points (least squares, as a tilt lens does it), or a surface "
     "that is bent through all of them (moving least squares).",
 .type = WO_PARAM_CHOICE,
 .offset = FIELD(focus_by),
 .initial = {WO_FOCUS_BY_DISTANCE},
 .min = 0,
 .max = WO_FOCUS_BY_COUNT - 1,
 .ui_min = 0,
 .ui_max = WO_FOCUS_BY_COUNT - 1,
 .choices = focus_by,
 .choice_labels = focus_by_labels,
 .overlay = true,
 .animates = true},
    {.key = "focusClip",
     .label = "Focus clip is",
     .unit = "",
     .group = "focusControl",
     .help = "What the numbers of the Focus clip are, which takes the place of the points: the "
             "distance in focus in m, its vergence in 1/m, or the radius of blur in px of the full "
             "resolution, positive in front of the focus. Where they are not finite, and distances "
             "not above 0, the focus distance holds; such a radius is 0.",
     .type = WO_PARAM_CHOICE,
     .offset = FIELD(focus_clip),
     .initial = {WO_FOCUS_MAP_DISTANCE},
     .min = 0,
     .max = WO_FOCUS_MAP_COUNT - 1,
     .ui_min = 0,
     .ui_max = WO_FOCUS_MAP_COUNT - 1,
     .choices = focus_maps,
     .choice_labels = focus_map_labels,
     .animates = true},
    FOCUS_NUMBER("fieldCurvature", "Field curvature", "1/m", field_curvature, 0, -1e3, 1e3, -1, 1,
                 "Offset of the focus in the corners of the frame, growing with the square of the "
                 "distance from the centre: positive bends the surface of focus towards the "
                 "camera, negative away from it."),
    FOCUS_NUMBER("protectNear", "Protect in front", "m", protect_near, 0, 0, 1e9, 0, 10,
                 "So much in front of the focus stays sharp; blur counts from there on. 0 is what "
                 "the lens does."),
    FOCUS_NUMBER("protectFar", "Protect behind", "m", protect_far, 0, 0, 1e9, 0, 10,
                 "So much behind the focus stays sharp; blur counts from there on. 0 is what the "
                 "lens does."),
    FOCUS_NUMBER("nearGain", "Blur in front", "", near_gain, 1, 0, 10, 0, 2,
                 "Factor on the radius of blur in front of the focus: 0 is sharp, 1 what the lens "
                 "does."),
    FOCUS_NUMBER("farGain", "Blur behind", "", far_gain, 1, 0, 10, 0, 2,
                 "Factor on the radius of blur behind the focus: 0 is sharp, 1 what the lens "
                 "does."),
    {.key = "focusPoints",
     .label = "Points",
     .unit = "",
     .group = "focusControl",
     .help = "How many of the points count for a plane or a surface. A plane wants three that are "
             "not in a line; two tilt it along their line only, one not at all.",
     .type = WO_PARAM_INT,
     .offset = FIELD(focus_points),
     .initial = {3},
     .min = 1,
     .max = WO_FOCUS_POINTS,
     .ui_min = 1,
     .ui_max = WO_FOCUS_POINTS,
     .overlay = true,
     .animates = true},
    FOCUS_NUMBER("focusFalloff", "Fall-off", "", focus_falloff, 3, 1, 8, 1, 8,
                 "How fast the influence of a point on the surface falls with distance: 2 to 4 is "
                 "smooth, 8 gives each point a flat realm of its own with short ways between "
                 "them, 1 a peak at each point."),
    FOCUS_NUMBER("focusFade", "Fade outside", "", focus_fade, 0.2, 0, 1e3, 0, 2,
                 "How far outside the frame a point still has a say, in halves of the frame's "
                 "diagonal; it fades out on the way, to the focus distance when no other is left. "
                 "0 drops it at the border."),
    FOCUS_POINT(1, 960, 540), FOCUS_POINT(2, 480, 270), FOCUS_POINT(3, 1440, 270),
    FOCUS_POINT(4, 1440, 810), FOCUS_POINT(5, 480, 810), FOCUS_POINT(6, 960, 270),
    FOCUS_POINT(7, 960, 810), FOCUS_POINT(8, 480, 540), FOCUS_POINT(9, 1440, 540),
    FOCUS_POINT(10, 240, 135), FOCUS_POINT(11, 1680, 135), FOCUS_POINT(12, 1680, 945),
    FOCUS_POINT(13, 240, 945), FOCUS_POINT(14, 240, 540), FOCUS_POINT(15, 1680, 540),
    FOCUS_POINT(16, 960, 945),
