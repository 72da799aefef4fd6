/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WIDEOPEN_PARAM_H
#define WIDEOPEN_PARAM_H

#include "wideopen/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Parameters of an effect: one table of rows per effect; OFX describe, command line flags, --help,
   documentation and tests are loops over it. Values live in a plain struct without pointers. */

/*             type               C type of the field            values */
typedef enum wo_param_type {
    WO_PARAM_DOUBLE, /*           double                         1 */
    WO_PARAM_INT,    /*              int32_t                        1 */
    WO_PARAM_BOOL,   /*             int32_t, 0 or 1                1 */
    WO_PARAM_CHOICE, /*           int32_t, index into choices    1 */
    WO_PARAM_POINT,  /*            double[2]                      2 */
    WO_PARAM_COLOUR, /*           double[3], scene-linear RGB    3 */
    WO_PARAM_STRING  /*            char[WO_PARAM_STRING_SIZE]     text */
} wo_param_type;

#define WO_PARAM_STRING_SIZE 1024

typedef struct wo_param {
    const char *key;   /* script name, camelCase, unique, never changes */
    const char *label; /* for people */
    const char *help;  /* one or two sentences: what it does, what the ends of the range mean */
    const char *unit;  /* "mm", "m", "px", "deg", "" ... */
    const char *group; /* key of the row's group in wo_effect.groups */
    wo_param_type type;
    size_t offset;                    /* of the field in the params struct */
    double initial[3];                /* default value(s); a string's default is initial_text */
    double min, max;                  /* hard range, applied to each value */
    double ui_min, ui_max;            /* range of a slider */
    const char *const *choices;       /* WO_PARAM_CHOICE: keys, ends with NULL */
    const char *const *choice_labels; /* labels of the choices, same order; NULL = the keys */
    const char *initial_text;         /* WO_PARAM_STRING */
    bool animates;                    /* may change over time */
    bool overlay; /* a host that draws over its viewer shows it: a WO_PARAM_POINT as a handle, in
                     canonical coordinates; other types decide what is shown (wo_effect.handles) */
} wo_param;

/* Number of numeric values of a row: 1, 2 or 3; 0 for a string. */
int wo_param_values(const wo_param *param);

/* Number of choices of a WO_PARAM_CHOICE row, else 0. */
int wo_param_choice_count(const wo_param *param);

/* Row with this key, or NULL. */
const wo_param *wo_param_find(const wo_param *table, size_t count, const char *key);

/* Fills the struct with the defaults. Does not fail. */
void wo_params_default(const wo_param *table, size_t count, void *params);

/* Reads the numeric values of one row out of, or into, the struct. set checks the hard range (NaN
   fails); integers, booleans and choices must be whole. */
void wo_param_get(const wo_param *param, const void *params, double values[3]);
WO_NODISCARD wo_status wo_param_set(const wo_param *param, void *params, const double values[3],
                                    wo_error *error);
const char *wo_param_get_text(const wo_param *param, const void *params);
WO_NODISCARD wo_status wo_param_set_text(const wo_param *param, void *params, const char *text,
                                         wo_error *error);

/* Parses a value as the command line writes it ("2.8", "true", "hexagon" or its index, "x,y",
   "r,g,b", text) and sets it. */
WO_NODISCARD wo_status wo_param_parse(const wo_param *param, const char *text, void *params,
                                      wo_error *error);

/* Prints the value so that wo_param_parse reads it back; returns the length as snprintf does. */
int wo_param_print(const wo_param *param, const void *params, char *buffer, size_t size);

/* Checks every row's value against its hard range. */
WO_NODISCARD wo_status wo_params_validate(const wo_param *table, size_t count, const void *params,
                                          wo_error *error);

#ifdef __cplusplus
}
#endif
#endif
