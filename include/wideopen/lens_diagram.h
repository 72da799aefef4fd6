/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WIDEOPEN_LENS_DIAGRAM_H
#define WIDEOPEN_LENS_DIAGRAM_H

#include "wideopen/context.h"
#include "wideopen/prescription.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Longitudinal aberration diagrams (Kawase 2015): where rays through a zone of the pupil focus, as
   a function of the zone and of the wavelength. Read in dioptres in front of the lens: with the
   sensor left where it is, zone rho focuses on the vergence

       vf(rho, l) = vf + wo_diagram_at(rho, l)

   so a positive shift focuses nearer than the lens is set to. That is a zone of more power, whose
   rays from an object in focus cross the axis SHORT of the sensor: undercorrected spherical
   aberration and, in a lens without colour correction, blue light. A longitudinal aberration dz
   behind a lens of focal length f is a shift of -dz / (f (f + dz)). The pencil of an axial point is

       p(v) = x + K u (v - vf - shift(|u|, l))

   so of the objects in front of the focus (v > vf) those colours and zones make the smaller blur,
   and of those behind it the larger one. */

#define WO_DIAGRAM_ZONES     33
#define WO_DIAGRAM_LINES     16
#define WO_DIAGRAM_NM_MIN    100.0
#define WO_DIAGRAM_NM_MAX    10000.0
#define WO_DIAGRAM_SHIFT_MAX 1e6 /* dioptres */

typedef struct wo_diagram {
    int zones;     /* 2..33, at rho = i / (zones - 1) */
    int lines;     /* 1..16, nm rising */
    double radius; /* mm: height in the plane of the entrance pupil that rho = 1 stands for; 0: not
                      said */
    double nm[WO_DIAGRAM_LINES];
    double shift[WO_DIAGRAM_LINES][WO_DIAGRAM_ZONES]; /* dioptres */
} wo_diagram;

#define WO_DIAGRAM_PRESET_LIST(X)                                                                  \
    X(PERFECT, "perfect", "Perfect")                                                               \
    X(SPHERICAL, "spherical", "Spherical")                                                         \
    X(ASPHERICAL, "aspherical", "Aspherical")                                                      \
    X(ACHROMAT_A, "achromatA", "Achromat A")                                                       \
    X(ACHROMAT_B, "achromatB", "Achromat B")                                                       \
    X(APOCHROMAT, "apochromat", "Apochromat")

typedef enum wo_diagram_preset {
#define WO_DIAGRAM_ENUM(name, key, label) WO_DIAGRAM_##name,
    WO_DIAGRAM_PRESET_LIST(WO_DIAGRAM_ENUM)
#undef WO_DIAGRAM_ENUM
        WO_DIAGRAM_PRESET_COUNT
} wo_diagram_preset;

/* A preset for a lens of this focal length (1..1e6 mm) and f-number (0.5..1000), focused with the
   paraxial rays of the d line. Its 33 zones and 16 lines (400..700 nm) come from exact traces of
   real lenses of the type: f * shift of spherical aberration grows with the square of the aperture,
   that of colour does not depend on it. The balance of zones, and of spherochromatism with axial
   colour in the corrected types, is that of the type at every f-number, as of lenses designed for
   it: stopping one lens down is another matter. residual scales all of it: 1 as the type has it, 0
   none, up to 10. */
WO_NODISCARD wo_status wo_diagram_make(wo_diagram_preset preset, double focal_mm, double f_number,
                                       double residual, wo_diagram *diagram, wo_error *error);

/* The diagram of a prescription, traced exactly from the point of the sensor on the axis out
   through the lens, in the meridian of y, for the wavelengths nm[lines] (rising, 1..16), with the
   iris open to f_number (0: fully), focused at vf dioptres from the entrance pupil with the d
   line's paraxial rays. The pupil coordinate rho is the height at which a ray crosses the plane of
   the paraxial entrance pupil, in parts of that of the last ray of the d line that gets through the
   iris and all clear radii (diagram->radius; it differs from the paraxial radius by some per cent),
   or of a lower one where a line's rays end before. WO_ERR_UNSUPPORTED for a lens without a focal
   length, entrance pupil or image at finite places, or without light along its axis; WO_ERR_RANGE
   for an iris without limit. */
WO_NODISCARD wo_status wo_diagram_of_lens(const wo_prescription *lens, double f_number, double vf,
                                          const double *nm, int lines, wo_diagram *diagram,
                                          wo_error *error);

/* Shift in dioptres at zone rho 0..1 (clamped) and wavelength nm (clamped to the lines): monotone
   cubic in rho and linear in nm. Finite always. Any thread. */
double wo_diagram_at(const wo_diagram *diagram, double rho, double nm);

/* Ranges, finite numbers, rising lines. */
WO_NODISCARD wo_status wo_diagram_validate(const wo_diagram *diagram, wo_error *error);

/* Pencil map (Kawase 2015; Jeong 5.2.1): density of the axial bundle over distance from the focus
   and radius, normalised by the bundle's height at that distance, one row of `radii` for each
   distance and one plane for each wavelength. */
#define WO_PENCIL_DISTANCES_MAX 8192
#define WO_PENCIL_RADII_MAX     8192
#define WO_PENCIL_LINES_MAX     256

typedef struct wo_pencil_map {
    int distances, radii, lines;
    double v_low, v_high; /* dioptres from the focus: first and last row */
    double k;             /* px of radius per dioptre that heights are given in */
    double *nm;           /* [lines], rising */
    double *height;       /* [lines][distances]: outer radius of the bundle, px */
    float *density; /* [lines][distances][radii]: energy per area over that of a uniform disc of
                       the same height, 0..; integrates to 1 over the disc. Entry j is the mean of
                       the ring j / radii .. (j + 1) / radii of the height. 1 where height is 0. */
} wo_pencil_map;

/* k > 0; v_low < v_high, within WO_DIAGRAM_SHIFT_MAX; 2..WO_PENCIL_DISTANCES_MAX distances, 2..
   WO_PENCIL_RADII_MAX radii, 1..WO_PENCIL_LINES_MAX rising wavelengths. The energy of every ring of
   the pupil, d(rho^2), lands whole in the rings |r| = k rho |v - shift| that it covers, so caustics
   stay finite and each row integrates to 1. WO_ABORTED when the context says so. */
WO_NODISCARD wo_status wo_pencil_map_create(const wo_context *context, const wo_diagram *diagram,
                                            double k, double v_low, double v_high, int distances,
                                            int radii, const double *nm, int lines,
                                            wo_pencil_map **map, wo_error *error);
/* A map of this size, all zeros: to be filled by a reader. */
WO_NODISCARD wo_status wo_pencil_map_new(const wo_context *context, int distances, int radii,
                                         int lines, wo_pencil_map **map, wo_error *error);
/* Ranges, finite numbers, rising lines, and the energy of every row 1 to 1e-3. */
WO_NODISCARD wo_status wo_pencil_map_validate(const wo_pencil_map *map, wo_error *error);
/* NULL and a pointer to NULL are legal. */
void wo_pencil_map_destroy(const wo_context *context, wo_pencil_map **map);

/* Outer radius in px of the bundle at vergence distance v from the focus and wavelength nm: linear
   between entries, those at the ends beyond them. */
double wo_pencil_map_height(const wo_pencil_map *map, double v, double nm);

/* Density at radius |r| px, vergence distance v from the focus, wavelength nm, over that of a
   uniform disc as high as wo_pencil_map_height: linear between entries, those at the ends beyond
   them, 0 outside the disc and for a radius that is NaN. */
double wo_pencil_map_at(const wo_pencil_map *map, double v, double r, double nm);

/* Jeong's dissertation, section 5.2: one profile of one object and one wavelength serves all
   objects, focus distances and wavelengths, by asking where the sensor would stand to see the same
   circle of confusion. Written in vergence and with what his equations need to hold:

     (5.5)  u = 1 / (1/F - vf)                  sensor distance of a lens focused at vf
     (5.7)  c = -E u (v - vf)                   signed circle of confusion, negative in front
     (5.8)  c = E (u (1/F(l) - v) - 1)          with u of (5.5) at the wavelength focused with: the
                                                sensor is common to all wavelengths, so his d_f has
                                                to be the one of the wavelength. F(l) is absolute:
                                                F (n - 1) / (n(l) - 1)
     (5.9)  u'' = u (1/F(l) - v) / (1/F - v_r)  sensor distance at which the profile, taken of an
                                                object at v_r, has that circle: his coordinate

   The pencil map needs no such object: c = -E u (v - vf - (1/F(l) - 1/F)), so the row is the
   distance in parentheses and nothing is singular. */
typedef struct wo_profile {
    double focal_m;  /* F at the wavelength that the profile was taken and the lens focused with */
    double vergence; /* v_r, 1/m, < 1/F */
} wo_profile;

/* F(l) from the indices at that wavelength and at the one of focal. */
double wo_profile_focal(double focal_m, double index, double index_at);
/* u'' for an object at v with the lens at vf < 1/F and F(l) = focal_at_m; INFINITY for other vf. */
double wo_profile_image(const wo_profile *profile, double v, double vf, double focal_at_m);
/* The row of a pencil map of one wavelength that has the same circle. */
double wo_profile_distance(const wo_profile *profile, double v, double vf, double focal_at_m);

#ifdef __cplusplus
}
#endif
#endif
