/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WIDEOPEN_GLASS_H
#define WIDEOPEN_GLASS_H

#include "wideopen/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Refractive indices, relative to air at 20 to 25 degrees Celsius, as catalogues give them. */

#define WO_NM_F 486.1327
#define WO_NM_D 587.5618
#define WO_NM_C 656.2725

typedef enum wo_dispersion {
    WO_DISPERSION_NONE,      /* n = nd for every wavelength */
    WO_DISPERSION_ABBE,      /* n = nd + b (1/l^2 - 1/ld^2), b such that (nd - 1)/(nF - nC) = Vd:
                                Cauchy's formula with two terms */
    WO_DISPERSION_SELLMEIER, /* n^2 = 1 + sum B_i l^2 / (l^2 - C_i), a = B1 B2 B3 C1 C2 C3, C in
                                um^2 (Marsicano 3.13, Jeong 4.4) */
    WO_DISPERSION_SCHOTT     /* n^2 = a0 + a1 l^2 + a2 l^-2 + a3 l^-4 + a4 l^-6 + a5 l^-8, l in um
                                (Marsicano 3.12) */
} wo_dispersion;

typedef struct wo_glass {
    char name[32];
    wo_dispersion kind;
    double nd, vd; /* vd 0 = not known */
    double a[6];
    double low_nm, high_nm; /* where the formula holds */
} wo_glass;

/* The catalogue, in the order of its names; beyond the last NULL. Any thread. */
const wo_glass *wo_glass_at(size_t index);
/* By name; case does not matter. NULL when there is none. Any thread. */
const wo_glass *wo_glass_find(const char *name);

/* n = 1. */
wo_glass wo_glass_air(void);

/* A glass of nd 1..4 and Abbe number vd 5..200, named after them; vd 0 = no dispersion; nd 1 with
   vd 0 is air. */
WO_NODISCARD wo_status wo_glass_abbe(double nd, double vd, wo_glass *glass, wo_error *error);

/* A glass of a formula of its own. Refused when its index is not finite and in 1..4 everywhere in
   low_nm..high_nm (a pole of the formula inside, for example). nd and vd are computed. */
WO_NODISCARD wo_status wo_glass_formula(const char *name, wo_dispersion kind, const double a[6],
                                        double low_nm, double high_nm, wo_glass *glass,
                                        wo_error *error);

/* Index at a wavelength. Outside of the formula's range the nearest wavelength inside is taken and
   *clamped (may be NULL) becomes true; it is never set to false. nm that is no number counts as the
   d line. Always finite, 1..4. Any thread. */
double wo_glass_index(const wo_glass *glass, double nm, bool *clamped);

#ifdef __cplusplus
}
#endif
#endif
