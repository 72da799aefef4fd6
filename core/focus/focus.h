/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CORE_FOCUS_FOCUS_H
#define WO_CORE_FOCUS_FOCUS_H

#include "focus/focus_surface.h"
#include "wideopen/image.h"

/* What is in focus, pixel by pixel. The renderer counts vergence from the focus, so a focal surface
   vf(p) and all that is asked for beside it is a change of numbers when a layer is loaded: pixel p
   of a surface at vergence v holds
       w(p) = amount (gain (zone (v - vf(p))))     [dioptres]
   and its circle of confusion has the radius K |w(p)|. No renderer knows of it. */

#define WO_FOCUS_BY_LIST(X)                                                                        \
    X(WO_FOCUS_BY_DISTANCE, "distance", "Distance")                                                \
    X(WO_FOCUS_BY_POINT, "point", "Point")                                                         \
    X(WO_FOCUS_BY_PLANE, "plane", "Plane")                                                         \
    X(WO_FOCUS_BY_SURFACE, "surface", "Surface")

typedef enum wo_focus_by {
#define WO_FOCUS_BY_ENUM(name, key, label) name,
    WO_FOCUS_BY_LIST(WO_FOCUS_BY_ENUM)
#undef WO_FOCUS_BY_ENUM
        WO_FOCUS_BY_COUNT
} wo_focus_by;

/* What the numbers of a map of the focus are; it takes the place of the surface where they are
   valid. */
#define WO_FOCUS_MAP_LIST(X)                                                                       \
    X(WO_FOCUS_MAP_OFF, "off", "Off")                                                              \
    X(WO_FOCUS_MAP_DISTANCE, "distance", "Distance")                                               \
    X(WO_FOCUS_MAP_VERGENCE, "vergence", "Vergence")                                               \
    X(WO_FOCUS_MAP_RADIUS, "radius", "Radius")

typedef enum wo_focus_map {
#define WO_FOCUS_MAP_ENUM(name, key, label) name,
    WO_FOCUS_MAP_LIST(WO_FOCUS_MAP_ENUM)
#undef WO_FOCUS_MAP_ENUM
        WO_FOCUS_MAP_COUNT
} wo_focus_map;

typedef struct wo_focus_options {
    wo_focus_by by;
    double vf; /* 1/m: by distance, and where points have no say */
    wo_focus_point points[WO_FOCUS_POINTS];
    double presence[WO_FOCUS_POINTS]; /* 0..1: of each point; the weights hold it already */
    int count;
    double falloff;   /* >= 1 */
    double curvature; /* 1/m in the corner of the frame, with the square from the axis */
    double protect_near, protect_far; /* m before and behind the surface that stay sharp; >= 0 */
    double near_gain, far_gain;       /* >= 0 */
    wo_focus_map map_is;
    wo_image map;     /* borrowed; its last valid pixel goes on beyond its bounds */
    double map_scale; /* px of the picture for a px of the map's radius */
    wo_rect format;
    double stretch; /* vertical px per horizontal px */
} wo_focus_options;

/* Const after it is made and fitted; shared by all threads. */
typedef struct wo_focus {
    wo_focus_options options;
    double centre_x, centre_y, half_diagonal; /* px */
    double v_axis;                            /* 1/m in focus on the axis: where the lens focuses */
    wo_focus_plane plane;
    double tilt[2];    /* dioptres per px, of the plane */
    double tilt_slope; /* px of blur radius per px across the plane, <= WO_FOCUS_TILT_MAX */
    double tilt_asked; /* the same before the limit */
    double presence;   /* 0..1: of the points */
    bool flat;         /* one distance and nothing else: w = v - v_axis */
    double k;          /* px per dioptre */
    bool amounts;      /* some point changes the amount of blur */
    bool ordered;      /* w alone would lose the order of surfaces */
} wo_focus;

/* The plane of focus crosses the plane of the lens at 1 / (tilt focal_px) m from its centre; there
   the rays of the lens lie in it, and none is in focus. The limit keeps it one diameter of the
   entrance pupil away. (Lee et al. 2010, section 5.1, limit the normal of the plane for this
   reason.) A steeper plane is turned about its middle of the picture. */
#define WO_FOCUS_TILT_MAX 0.5

/* The surface. Does not fail: what is not finite in the points must have been refused before. */
void wo_focus_make(const wo_focus_options *options, wo_focus *focus);

/* Then, with the lens that focuses at v_axis: k > 0 px of blur radius per dioptre, and what no ray
   exceeds, slope >= k. */
void wo_focus_fit_lens(wo_focus *focus, double k, double slope);

/* Vergence in focus at pixel (x, y), and amount of blur there; without the map. Any thread. */
double wo_focus_at(const wo_focus *focus, int32_t x, int32_t y, double *amount);

/* w of a surface at vergence v in pixel (x, y). Finite; grows strictly with v unless a map gives
   the radius. Samples of the map that are not finite, and distances that are not above 0, leave
   the focus at options.vf; such a radius is 0. Any thread. */
double wo_focus_from(const wo_focus *focus, int32_t x, int32_t y, double v);

/* Where a place in units of a point's x and y lies: what fits wo_focus_point. px of the picture. */
void wo_focus_place(const wo_focus_options *options, double px, double py, wo_focus_point *point);

/* 1 inside the format, falling smoothly to 0 at fade times half the diagonal beyond it. */
double wo_focus_presence(const wo_focus_options *options, double px, double py, double fade);

#endif
