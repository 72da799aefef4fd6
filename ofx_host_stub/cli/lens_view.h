/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CLI_LENS_VIEW_H
#define WO_CLI_LENS_VIEW_H

#include "wideopen/lens_trace.h"

/* A lens as it is looked at: stopped down, focused, with bundles of rays through it. Lengths in mm,
   angles in degrees. */

enum { WO_LENS_LINES = 3, WO_LENS_FIELDS = 3 };

typedef struct wo_lens_view {
    wo_prescription lens;          /* the iris stopped down to f_number */
    wo_system line[WO_LENS_LINES]; /* F, d, C */
    wo_system system;              /* at nm */
    double nm;
    wo_first_order first[2]; /* at nm, in x and in y */
    double f_number; /* of the axial beam: first[1].fno, or where clear radii leave less than the
                        iris does (all of a pupil at infinity), what they leave */
    double vf;       /* dioptres from the entrance pupil to the object, 0 = infinity */
    double half_field;
    double image;       /* last vertex to the sensor: the paraxial focus at nm */
    double open_semi;   /* clear radius of the surface with the iris, as the prescription has it */
    wo_meridian across; /* where the field is measured: of anamorphic lenses, the wider side */
    bool anamorphic;    /* some surface is a cylinder */
} wo_lens_view;

/* Degrees: how far out a plane at a finite distance is looked at. */
#define WO_LENS_PLANE_FIELD 89.0

extern const double wo_lens_nm[WO_LENS_LINES];
extern const double wo_lens_fields[WO_LENS_FIELDS]; /* in parts of half_field */

typedef struct wo_lens_setup {
    double nm;
    double f_number;   /* 0: the iris as it is */
    double focus_m;    /* from the entrance pupil; 0: infinity */
    double half_field; /* 0: the prescription's own, else where a third of the light is left */
} wo_lens_setup;

/* WO_ERR_RANGE when the lens does not open so far, or the object is inside of it. */
WO_NODISCARD wo_status wo_lens_view_make(const wo_prescription *lens, const wo_lens_setup *setup,
                                         wo_lens_view *view, wo_error *error);

/* WO_ERR_UNSUPPORTED when there is no image to look at. */
WO_NODISCARD wo_status wo_lens_needs_image(const wo_lens_view *view, wo_error *error);

double wo_lens_sensor_z(const wo_lens_view *view);

/* Sag of a surface along its meridian r away from the axis; NAN beside the surface, 0 across a
   cylinder's. */
double wo_lens_sag(const wo_surface *surface, wo_meridian meridian, double r);

/* A bundle from one object point, field degrees off the axis towards meridian. Its coordinates
   are those of a plane in front of the lens: across the bundle through the first vertex, or the
   plane of the first vertex for an object that is not at infinity. */
typedef struct wo_bundle {
    wo_rays rays;            /* where they are now */
    double *px, *py;         /* their coordinates in that plane */
    double *stop_x, *stop_y; /* NAN: never got there */
    int count;
    double area;           /* mm^2 on that plane that each ray stands for */
    double x1, y1, x2, y2; /* what they fill there */
} wo_bundle;

/* Exactly count scattered rays that fill what passes through the lens, and a margin; not traced
   yet. Each has a twin on the other side of the meridian. False: out of memory, or nothing passes.
 */
bool wo_bundle_fill(const wo_lens_view *view, wo_meridian meridian, double field, int count,
                    wo_bundle *bundle) WO_NODISCARD;
/* The same rays again from the start, traced through system; with outcomes. */
void wo_bundle_trace(const wo_lens_view *view, const wo_system *system, wo_meridian meridian,
                     double field, unsigned flags, wo_bundle *bundle);
/* Other scattered rays; turn is any number. */
void wo_bundle_scatter(wo_bundle *bundle, wo_meridian meridian, int turn);
void wo_bundle_free(wo_bundle *bundle);

/* What a point of the sensor sees through the lens at nm, height mm from the axis in the meridian
   where the field is measured; integrated over the beam to about 1e-4. */
typedef struct wo_lens_beam {
    double light; /* solid angle weighted with the cosine: light on the sensor of an even bright
                     scene of radiance 1 */
    double iris;  /* mm^2 of the iris that it sees */
} wo_lens_beam;
/* False: nothing passes, or height is not finite. */
bool wo_lens_beam_make(const wo_lens_view *view, double height, wo_lens_beam *beam) WO_NODISCARD;

/* One ray in the plane of the meridian, at coordinate h of the bundle's plane. */
typedef struct wo_lens_ray {
    double p[3], d[3]; /* x y z */
    wo_outcome outcome;
    double stop; /* height at the iris; NAN: never got there */
} wo_lens_ray;
wo_lens_ray wo_lens_aim(const wo_lens_view *view, wo_meridian meridian, double field, double h);
void wo_lens_trace(const wo_system *system, int first, int last, unsigned flags,
                   wo_meridian meridian, wo_lens_ray *ray);

/* Heights between which rays of the meridian pass the iris (and, with WO_TRACE_CLIP, everything),
   and that of the one through its centre, whether or not that passes (NAN: none gets there). False:
   none pass. */
bool wo_lens_fan(const wo_lens_view *view, wo_meridian meridian, double field, unsigned flags,
                 double *low, double *high, double *chief) WO_NODISCARD;

/* Height on the sensor of the chief ray, through the middle of the iris, whether or not clear radii
   stop it; NAN when there is none. */
double wo_lens_chief_height(const wo_lens_view *view, const wo_system *system, wo_meridian meridian,
                            double field);

#endif
