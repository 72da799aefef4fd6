/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_CORE_OPTICS_LENS_CHOICE_H
#define WO_CORE_OPTICS_LENS_CHOICE_H

#include "optics/lens_model.h"

/* The lenses to choose from, one list for all effects: key, label. A new one is a row here and a
   case in wo_lens_choose. */
#define WO_LENS_KIND_LIST(X)                                                                       \
    X(THIN, "thin", "Thin")                                                                        \
    X(THICK, "thick", "Thick")                                                                     \
    X(SINGLET, "singlet", "Singlet")                                                               \
    X(PRESCRIPTION, "prescription", "Prescription")                                                \
    X(SEIDEL, "seidel", "Seidel")                                                                  \
    X(DIAGRAM, "diagram", "Diagram")

typedef enum wo_lens_kind {
#define WO_LENS_KIND_ENUM(name, key, label) WO_LENS_##name,
    WO_LENS_KIND_LIST(WO_LENS_KIND_ENUM)
#undef WO_LENS_KIND_ENUM
        WO_LENS_KIND_COUNT
} wo_lens_kind;

/* Glasses of the thick lens and the singlet: key, label, name in the catalogue. */
#define WO_LENS_GLASS_LIST(X)                                                                      \
    X("crown", "Crown", "N-BK7")                                                                   \
    X("flint", "Flint", "N-SF6")                                                                   \
    X("fluorite", "Fluorite", "CAF2")                                                              \
    X("lanthanum", "Lanthanum", "N-LAK9")

/* The designs that effects offer: those of the library that can be put behind a picture. Projects
   hold a design by its key or by its place in this list, whichever the host keeps, so both mean the
   same for ever: a new design goes to the end, wherever its name sorts, and a row whose design
   cannot be offered is given to one that can. (Row 0 was one with cylinders, always refused.)
   Key; name for wo_lens_find. */
#define WO_LENS_DESIGN_LIST(X)                                                                     \
    X("standard", "dgauss_codev_100_f2")                                                           \
    X("asphere_edmund_54", "asphere_edmund_54")                                                    \
    X("biotar_zeiss_100_f14", "biotar_zeiss_100_f14")                                              \
    X("cooke_triplet_50_f5", "cooke_triplet_50_f5")                                                \
    X("dgauss_angenieux_100_f11", "dgauss_angenieux_100_f11")                                      \
    X("dgauss_codev_100_f2", "dgauss_codev_100_f2")                                                \
    X("dgauss_tronnier_100_f2", "dgauss_tronnier_100_f2")                                          \
    X("dgauss_werfel_100_f125", "dgauss_werfel_100_f125")                                          \
    X("doublet_edmund_49291", "doublet_edmund_49291")                                              \
    X("doublet_laikin_20in", "doublet_laikin_20in")                                                \
    X("doublet_thorlabs_ac508_250a", "doublet_thorlabs_ac508_250a")                                \
    X("fisheye_laikin_170", "fisheye_laikin_170")                                                  \
    X("masterprime_zeiss_asph", "masterprime_zeiss_asph")                                          \
    X("petzval_kodak_100", "petzval_kodak_100")                                                    \
    X("petzval_laikin_f14", "petzval_laikin_f14")                                                  \
    X("planar_rudolph_583336", "planar_rudolph_583336")                                            \
    X("prime_us8427765_asph", "prime_us8427765_asph")                                              \
    X("retrofocus_nikon_100_f28", "retrofocus_nikon_100_f28")                                      \
    X("singlet_biconvex_thorlabs_50", "singlet_biconvex_thorlabs_50")                              \
    X("singlet_pcx_edmund_49847", "singlet_pcx_edmund_49847")                                      \
    X("telephoto_laikin_f56", "telephoto_laikin_f56")                                              \
    X("telephoto_sigler_250", "telephoto_sigler_250")                                              \
    X("tessar_brendel_100_f28", "tessar_brendel_100_f28")                                          \
    X("tessar_laikin_f45", "tessar_laikin_f45")                                                    \
    X("triplet_sasian_50_f4", "triplet_sasian_50_f4")                                              \
    X("wide_laikin_100", "wide_laikin_100")                                                        \
    X("wide_nakamura_100", "wide_nakamura_100")                                                    \
    X("zoom_canon_70_200_at_194", "zoom_canon_70_200_at_194")                                      \
    X("zoom_canon_70_200_at_72", "zoom_canon_70_200_at_72")                                        \
    X("zoom_itoh_100_145_at_100", "zoom_itoh_100_145_at_100")

enum { WO_LENS_DESIGNS = 30, WO_LENS_DESIGN_DEFAULT = 5 };
extern const char *const wo_lens_names[]; /* keys; ends with NULL */
/* Name for wo_lens_find of the design in this place; NULL: there is none. */
const char *wo_lens_design(int place);

typedef struct wo_lens_choice {
    wo_lens_kind kind;
    const char *design; /* of prescription and seidel: a name for wo_lens_find */
    wo_diagram_preset diagram;
    double residual; /* of the diagram */
    int glass;       /* row of WO_LENS_GLASS_LIST */
    double bending;  /* shape factor (r2 + r1) / (r2 - r1): 0 equiconvex, 1 flat behind */
    double thickness_mm;
    double focal_mm;   /* every lens is scaled to this focal length */
    double f_number;   /* the design's own when that is slower */
    double cats_eye;   /* of the thin and thick lens and the diagram; at half_field */
    bool best_focus;   /* focus with the smallest spot on the axis, not with paraxial rays */
    double vf;         /* dioptres from the entrance pupil */
    double half_field; /* tangent */
    const double *nm;  /* wavelengths that will be asked for */
    int lines;
} wo_lens_choice;

/* A lens that focuses every zone and wavelength at its own place, and cuts the pupil of field
   points by a second disc (wo_aperture_cats_eye). */
typedef struct wo_zonal_lens {
    double radius; /* m, of the entrance pupil */
    double half_field;
    double cats_eye; /* amount for a field of tangent 1; 0 = none */
    wo_diagram diagram;
} wo_zonal_lens;
wo_lens_model wo_zonal_lens_model(const wo_zonal_lens *lens);

/* Third-order aberrations of a prescription, as transverse aberrations at the image. */
typedef struct wo_seidel_lens {
    double radius; /* m */
    double half_field;
    double scale; /* 1 / (2 n' u') */
    wo_seidel sums;
    double tangent; /* that the sums belong to */
    int lines;
    double nm[WO_LINES_MAX], shift[WO_LINES_MAX]; /* axial colour, dioptres */
} wo_seidel_lens;
/* Needs a valid prescription of revolution. */
WO_NODISCARD wo_status wo_seidel_lens_make(const wo_prescription *lens, double f_number,
                                           double half_field, const double *nm, int lines,
                                           wo_seidel_lens *out, wo_error *error);
wo_lens_model wo_seidel_lens_model(const wo_seidel_lens *lens);

/* Two spheres of one glass with this focal length, iris in front. */
WO_NODISCARD wo_status wo_singlet(const wo_glass *glass, double focal_mm, double f_number,
                                  double bending, double thickness_mm, wo_prescription *lens,
                                  wo_error *error);

/* Memory of whatever was chosen; const after it is made. */
typedef struct wo_chosen_lens {
    union {
        wo_zonal_lens zonal;
        wo_seidel_lens seidel;
        wo_exact_lens exact;
    } as;
    wo_lens_model model;
    double f_number; /* reached */
} wo_chosen_lens;

/* WO_LENS_THIN has faster pencils of its own; as a model it is the perfect diagram. *out points
   into itself: do not copy it. */
WO_NODISCARD wo_status wo_lens_choose(const wo_lens_choice *choice, wo_chosen_lens *out,
                                      wo_error *error);

#endif
