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
   a function of the zone and of the wavelength. Read in dioptres in front of the lens, vf(rho, l) =
   vf + wo_diagram_at(rho, l), so a positive value focuses nearer than the lens is set to. The
   pencil of an axial point is p(v) = x + K u (v - vf - diagram(|u|, l)). */

#define WO_DIAGRAM_ZONES 33
#define WO_DIAGRAM_LINES 16

typedef struct wo_diagram {
    int zones; /* 2..33, at rho = i / (zones - 1) */
    int lines; /* 1..16, nm rising */
    double nm[WO_DIAGRAM_LINES];
    double shift[WO_DIAGRAM_LINES][WO_DIAGRAM_ZONES]; /* dioptres */
} wo_diagram;

#define WO_DIAGRAM_PRESET_LIST(X)                                                                  \
    X(PERFECT, "perfect", "Perfect")                                                               \
    X(SPHERICAL, "spherical", "Spherical singlet")                                                 \
    X(ASPHERICAL, "aspherical", "Aspherical singlet")                                              \
    X(ACHROMAT_A, "achromatA", "Achromat, soft front")                                             \
    X(ACHROMAT_B, "achromatB", "Achromat, corrected zone")                                         \
    X(APOCHROMAT, "apochromat", "Apochromat")

typedef enum wo_diagram_preset {
#define WO_DIAGRAM_ENUM(name, key, label) WO_DIAGRAM_##name,
    WO_DIAGRAM_PRESET_LIST(WO_DIAGRAM_ENUM)
#undef WO_DIAGRAM_ENUM
        WO_DIAGRAM_PRESET_COUNT
} wo_diagram_preset;

/* A preset for a lens of this focal length and f-number. residual scales what aberration is left: 1
   as the type has it, 0 none, up to 10. */
WO_NODISCARD wo_status wo_diagram_make(wo_diagram_preset preset, double focal_mm, double f_number,
                                       double residual, wo_diagram *diagram, wo_error *error);

/* The diagram of a prescription, traced exactly on the axis for the wavelengths nm[lines], with the
   iris open to f_number (0: fully), focused at vf dioptres from the entrance pupil with the d
   line's paraxial rays. */
WO_NODISCARD wo_status wo_diagram_of_lens(const wo_prescription *lens, double f_number, double vf,
                                          const double *nm, int lines, wo_diagram *diagram,
                                          wo_error *error);

/* Shift in dioptres at zone rho 0..1 (clamped) and wavelength nm (clamped to the lines): monotone
   cubic in rho and linear in nm. Finite always. Any thread. */
double wo_diagram_at(const wo_diagram *diagram, double rho, double nm);

/* Ranges, finite numbers, rising lines. */
WO_NODISCARD wo_status wo_diagram_validate(const wo_diagram *diagram, wo_error *error);

/* Pencil map (Kawase 2015; Jeong 5.2.2): density of the axial bundle over distance from the focus
   and radius, normalised by the bundle's height at that distance, one row of `radii` for each
   distance and one plane for each wavelength. */
typedef struct wo_pencil_map {
    int distances, radii, lines;
    double v_low, v_high; /* dioptres from the focus: first and last row */
    double k;             /* px of radius per dioptre that heights are given in */
    double *nm;           /* [lines] */
    double *height;       /* [lines][distances]: outer radius of the bundle, px */
    float *density; /* [lines][distances][radii]: energy per area over that of a uniform disc of
                       the same height, 0..; integrates to 1 over the disc */
} wo_pencil_map;

WO_NODISCARD wo_status wo_pencil_map_create(const wo_context *context, const wo_diagram *diagram,
                                            double k, double v_low, double v_high, int distances,
                                            int radii, const double *nm, int lines,
                                            wo_pencil_map **map, wo_error *error);
void wo_pencil_map_destroy(const wo_context *context, wo_pencil_map **map);

/* Density at radius r px, vergence distance v from the focus, wavelength nm: linear between
 * entries. */
double wo_pencil_map_at(const wo_pencil_map *map, double v, double r, double nm);

#ifdef __cplusplus
}
#endif
#endif
