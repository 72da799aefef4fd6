/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#define _POSIX_C_SOURCE 200809L
#include "colour_standard.h"

#include <math.h>
#include <string.h>
#include <strings.h>

/* D65 and the white of ACES, in CIE xy */
#define D65  0.3127f, 0.3290f
#define ACES 0.32168f, 0.33767f
#define REC709                                                                                     \
    {                                                                                              \
        0.640f, 0.330f, 0.300f, 0.600f, 0.150f, 0.060f, D65                                        \
    }
#define P3_D65                                                                                     \
    {                                                                                              \
        0.680f, 0.320f, 0.265f, 0.690f, 0.150f, 0.060f, D65                                        \
    }
#define REC2020                                                                                    \
    {                                                                                              \
        0.708f, 0.292f, 0.170f, 0.797f, 0.131f, 0.046f, D65                                        \
    }
#define ADOBE_RGB                                                                                  \
    {                                                                                              \
        0.640f, 0.330f, 0.210f, 0.710f, 0.150f, 0.060f, D65                                        \
    }
#define AP0                                                                                        \
    {                                                                                              \
        0.7347f, 0.2653f, 0.0f, 1.0f, 0.0001f, -0.0770f, ACES                                      \
    }
#define AP1                                                                                        \
    {                                                                                              \
        0.713f, 0.293f, 0.165f, 0.830f, 0.128f, 0.044f, ACES                                       \
    }
#define CIE_XYZ                                                                                    \
    {                                                                                              \
        1, 0, 0, 1, 0, 0, D65                                                                      \
    }
#define NO_PRIMARY                                                                                 \
    {                                                                                              \
        0                                                                                          \
    }

static const wo_colour_standard standards[] = {
    {"lin_rec709_scene",
     "",
     REC709,
     true,
     {"lin_rec709", "lin_srgb", "Linear Rec.709 (sRGB)", "Linear Rec.709", "Linear sRGB",
      "Utility - Linear - Rec.709", "Utility - Linear - sRGB", "scene-linear Rec.709-sRGB"}},
    {"lin_ap1_scene",
     "",
     AP1,
     true,
     {"ACEScg", "lin_ap1", "ACES - ACEScg", "aces_cg", "scene-linear ACEScg"}},
    {"lin_ap0_scene",
     "",
     AP0,
     true,
     {"ACES2065-1", "lin_ap0", "ACES - ACES2065-1", "aces2065_1", "aces"}},
    {"lin_p3d65_scene",
     "",
     P3_D65,
     true,
     {"lin_p3d65", "Linear P3-D65", "Utility - Linear - P3-D65", "lin_displayp3"}},
    {"lin_rec2020_scene",
     "",
     REC2020,
     true,
     {"lin_rec2020", "Linear Rec.2020", "Utility - Linear - Rec.2020"}},
    {"lin_adobergb_scene",
     "",
     ADOBE_RGB,
     true,
     {"lin_adobergb", "Linear AdobeRGB", "Utility - Linear - Adobe RGB"}},
    {"lin_ciexyzd65_scene", "", CIE_XYZ, true, {"lin_ciexyzd65", "CIE XYZ-D65 - Scene-referred"}},
    {"srgb_rec709_scene",
     "sRGB",
     REC709,
     false,
     {"sRGB", "sRGB - Texture", "srgb_texture", "srgb_tx", "srgb_rec709",
      "Utility - sRGB - Texture", "sRGB Encoded Rec.709 (sRGB)", "Input - Generic - sRGB - Texture",
      "sRGB texture"}},
    {"g22_rec709_scene",
     "Gamma2.2",
     REC709,
     false,
     {"g22_rec709", "Gamma 2.2 Rec.709 - Texture", "Gamma 2.2 Encoded Rec.709", "g22_rec709_tx",
      "Utility - Gamma 2.2 - Rec.709 - Texture"}},
    {"g18_rec709_scene",
     "Gamma1.8",
     REC709,
     false,
     {"g18_rec709", "Gamma 1.8 Rec.709 - Texture", "Gamma 1.8 Encoded Rec.709", "g18_rec709_tx",
      "Utility - Gamma 1.8 - Rec.709 - Texture"}},
    {"srgb_ap1_scene", "", AP1, false, {"srgb_ap1", "sRGB Encoded AP1", "srgb_encoded_ap1_tx"}},
    {"g22_ap1_scene",
     "",
     AP1,
     false,
     {"g22_ap1", "Gamma 2.2 AP1 - Texture", "Gamma 2.2 Encoded AP1", "g22_ap1_tx"}},
    {"srgb_p3d65_scene",
     "",
     P3_D65,
     false,
     {"srgb_displayp3", "srgb_p3d65", "sRGB Encoded P3-D65", "srgb_encoded_p3d65_tx"}},
    {"g22_adobergb_scene",
     "",
     ADOBE_RGB,
     false,
     {"g22_adobergb", "Gamma 2.2 Encoded AdobeRGB", "adobergb"}},
    {"data", "", NO_PRIMARY, false, {"raw", "data", "Utility - Raw", "non-colour"}},
    {"", "Gamma2.4", REC709, false, {"g24_rec709_scene", "g24_rec709", "Rec.709 BT.1886"}},
    {"",
     "Rec709",
     REC709,
     false,
     {"camera_rec709", "rec709", "Rec.709 camera", "Camera Rec.709", "Utility - Rec.709 - Camera"}},
    {"", "KodakLog", NO_PRIMARY, false, {"Cineon", "lg10", "Cineon log film scan"}},
};

const wo_colour_standard *wo_colour_standard_named(const char *word)
{
    for (size_t i = 0; *word && i < WO_COUNT(standards); i++) {
        const wo_colour_standard *const s = &standards[i];
        if (!strcasecmp(word, s->id) || !strcasecmp(word, s->library))
            return s;
        for (size_t n = 0; n < WO_COUNT(s->names) && s->names[n]; n++)
            if (!strcasecmp(word, s->names[n]))
                return s;
    }
    return NULL;
}

bool wo_colour_same_primaries(const float a[8], const float b[8])
{
    for (int i = 0; i < 8; i++)
        if (!(fabsf(a[i] - b[i]) <= 1.5e-3f))
            return false;
    return true;
}

const wo_colour_standard *wo_colour_standard_by_primaries(const float primaries[8])
{
    for (size_t i = 0; i < WO_COUNT(standards); i++)
        if (standards[i].linear && wo_colour_same_primaries(standards[i].primaries, primaries))
            return &standards[i];
    return NULL;
}
