/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WIDEOPEN_BASE_H
#define WIDEOPEN_BASE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Version of the library; the plugins report the same one. */
#define WO_VERSION_MAJOR 0
#define WO_VERSION_MINOR 1
#define WO_VERSION_PATCH 0
#define WO_VERSION_TEXT  "0.1.0"

#if defined(__GNUC__)
#define WO_NODISCARD          __attribute__((warn_unused_result))
#define WO_PRINTF(text, args) __attribute__((format(printf, text, args)))
#else
#define WO_NODISCARD
#define WO_PRINTF(text, args)
#endif

/* Number of elements of a true array. */
#define WO_COUNT(array) (sizeof(array) / sizeof((array)[0]))

#endif
