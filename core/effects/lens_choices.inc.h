/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */

/* Lists of choices for the rows of lens_params.inc.h. */
#define ROW_KEY(name, key, label)     key,
#define ROW_LABEL(name, key, label)   label,
#define GLASS_KEY(key, label, name)   key,
#define GLASS_LABEL(key, label, name) label,
static const char *const lens_kinds[] = {WO_LENS_KIND_LIST(ROW_KEY) NULL};
const char *const wo_lens_blur_lens_labels[] = {WO_LENS_KIND_LIST(ROW_LABEL) NULL};
static const char *const diagrams[] = {WO_DIAGRAM_PRESET_LIST(ROW_KEY) NULL};
static const char *const diagram_labels[] = {WO_DIAGRAM_PRESET_LIST(ROW_LABEL) NULL};
static const char *const glasses[] = {WO_LENS_GLASS_LIST(GLASS_KEY) NULL};
static const char *const glass_labels[] = {WO_LENS_GLASS_LIST(GLASS_LABEL) NULL};
