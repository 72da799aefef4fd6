/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */

/* Lists of choices for the rows of focus_params.inc.h. */
#define FOCUS_KEY(name, key, label)   key,
#define FOCUS_LABEL(name, key, label) label,
static const char *const focus_by[] = {WO_FOCUS_BY_LIST(FOCUS_KEY) NULL};
static const char *const focus_by_labels[] = {WO_FOCUS_BY_LIST(FOCUS_LABEL) NULL};
static const char *const focus_maps[] = {WO_FOCUS_MAP_LIST(FOCUS_KEY) NULL};
static const char *const focus_map_labels[] = {WO_FOCUS_MAP_LIST(FOCUS_LABEL) NULL};
