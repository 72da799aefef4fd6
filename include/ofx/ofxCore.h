/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */

/*
 * OFX core: status codes, basic geometry, the host and plugin structs, the actions and the
 * properties that every object shares.
 *
 * A host loads a plugin binary, looks up the exported functions declared below, gives each plugin
 * an OfxHost and then talks to it only through OfxPlugin.mainEntry. The plugin talks back only
 * through suites, tables of functions it gets from OfxHost.fetchSuite.
 */

#ifndef WO_OFX_CORE_H
#define WO_OFX_CORE_H

#include <limits.h>
#include <stddef.h>

#if defined(_WIN32)
#define OfxExport __declspec(dllexport)
#elif defined(__GNUC__)
#define OfxExport __attribute__((visibility("default")))
#else
#define OfxExport
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Status codes ---------------------------------------------------------------------------- */

/* Every action and almost every suite function returns one. Codes from 1000 up are in
 * ofxImageEffect.h and ofxGPURender.h. */
typedef int OfxStatus;

#define kOfxStatOK                    0
#define kOfxStatFailed                1 /* this call failed, the object lives on */
#define kOfxStatErrFatal              2 /* the object, or the plugin, is beyond use */
#define kOfxStatErrUnknown            3 /* no such property, parameter, clip */
#define kOfxStatErrMissingHostFeature 4 /* the plugin needs what this host lacks */
#define kOfxStatErrUnsupported        5
#define kOfxStatErrExists             6
#define kOfxStatErrFormat             7
#define kOfxStatErrMemory             8
#define kOfxStatErrBadHandle          9
#define kOfxStatErrBadIndex           10
#define kOfxStatErrValue              11
#define kOfxStatReplyYes              12
#define kOfxStatReplyNo               13
#define kOfxStatReplyDefault          14 /* the plugin did not handle this action */
#define kOfxStatUnlicensed            15 /* after 1.5 */

/* ---- Basic types ----------------------------------------------------------------------------- */

/* A set of named, typed, indexed values that belongs to the host. Read and written with
 * OfxPropertySuiteV1 only. */
typedef struct OfxPropertySetStruct *OfxPropertySetHandle;

/* Time in frames; fractions are legal. */
typedef double OfxTime;

typedef struct OfxRangeI {
    int min, max;
} OfxRangeI;

typedef struct OfxRangeD {
    double min, max;
} OfxRangeD;

typedef struct OfxPointI {
    int x, y;
} OfxPointI;

typedef struct OfxPointD {
    double x, y;
} OfxPointD;

/* Rectangles are half open, x1 <= x < x2 and y1 <= y < y2, with y up. */
typedef struct OfxRectI {
    int x1, y1, x2, y2;
} OfxRectI;

typedef struct OfxRectD {
    double x1, y1, x2, y2;
} OfxRectD;

/* A side without end; the same numbers serve int and double rectangles. */
#define kOfxFlagInfiniteMax INT_MAX
#define kOfxFlagInfiniteMin INT_MIN

/* ---- Host and plugin ------------------------------------------------------------------------- */

/* What the host hands to a plugin. It stays valid from setHost until the binary is unloaded. */
typedef struct OfxHost {
    /* Properties of the host, read-only for plugins. */
    OfxPropertySetHandle host;

    /* A table of functions, or NULL if the host lacks that suite in that version. The first
     * argument is the member above. The table belongs to the host. */
    const void *(*fetchSuite)(OfxPropertySetHandle host, const char *suiteName, int suiteVersion);
} OfxHost;

/* The one door into a plugin or an interact. `action` is one of the action strings; `handle` is
 * NULL, an effect, or an interact, as the action says; `inArgs` and `outArgs` may be NULL. */
typedef OfxStatus(OfxPluginEntryPoint)(const char *action, const void *handle,
                                       OfxPropertySetHandle inArgs, OfxPropertySetHandle outArgs);

/* One plugin of a binary. Static data of the plugin, only read by the host. */
typedef struct OfxPlugin {
    const char *pluginApi;        /* kOfxImageEffectPluginApi */
    int apiVersion;               /* kOfxImageEffectPluginApiVersion */
    const char *pluginIdentifier; /* reverse domain name, ASCII, no blanks */
    unsigned int pluginVersionMajor;
    unsigned int pluginVersionMinor;
    void (*setHost)(OfxHost *host); /* called before any action; only keeps the pointer */
    OfxPluginEntryPoint *mainEntry;
} OfxPlugin;

/* ---- Functions a plugin binary exports ------------------------------------------------------- */

/* Optional, since 1.5: called before the other two if the binary has it. kOfxStatFailed makes the
 * host skip the binary without a word. `host` is promised only until OfxGetPlugin is called. */
OfxExport OfxStatus OfxSetHost(const OfxHost *host);

OfxExport int OfxGetNumberOfPlugins(void);

/* `nth` counts from 0. The result stays valid until the binary is unloaded. */
OfxExport OfxPlugin *OfxGetPlugin(int nth);

/* ---- Actions --------------------------------------------------------------------------------- */

/* First and last action; the handle is NULL. */
#define kOfxActionLoad   "OfxActionLoad"
#define kOfxActionUnload "OfxActionUnload"

/* The plugin says what it is; the handle is a descriptor. */
#define kOfxActionDescribe "OfxActionDescribe"

/* Life of one instance, which is the handle of all the actions below. */
#define kOfxActionCreateInstance  "OfxActionCreateInstance"
#define kOfxActionDestroyInstance "OfxActionDestroyInstance"

/* A parameter or a clip changed. Begin and End bracket any number of changes. */
#define kOfxActionBeginInstanceChanged "OfxActionBeginInstanceChanged"
#define kOfxActionInstanceChanged      "OfxActionInstanceChanged"
#define kOfxActionEndInstanceChanged   "OfxActionEndInstanceChanged"

/* The user opened, closed the controls of the instance. */
#define kOfxActionBeginInstanceEdit "OfxActionBeginInstanceEdit"
#define kOfxActionEndInstanceEdit   "OfxActionEndInstanceEdit"

/* Give back memory that can be made again; write private state into parameters. */
#define kOfxActionPurgeCaches     "OfxActionPurgeCaches"
#define kOfxActionSyncPrivateData "OfxActionSyncPrivateData"

/* ---- Properties ------------------------------------------------------------------------------ */

/* int xN: API version of the host, major first. */
#define kOfxPropAPIVersion "OfxPropAPIVersion"

/* double: time of the action, in frames. */
#define kOfxPropTime "OfxPropTime"

/* int 0/1: a user sits in front of it. */
#define kOfxPropIsInteractive "OfxPropIsInteractive"

/* string: folder of the plugin bundle, set by the host on the effect descriptor. */
#define kOfxPluginPropFilePath "OfxPluginPropFilePath"

/* pointer: private to the plugin, kept by the host with the instance. */
#define kOfxPropInstanceData "OfxPropInstanceData"

/* string: what the object is, one of the kOfxType strings. */
#define kOfxPropType "OfxPropType"

/* string: unique name of the object among its kind; never changes. */
#define kOfxPropName "OfxPropName"

/* int xN: version of the host or the plugin, major first. */
#define kOfxPropVersion "OfxPropVersion"

/* string: the version as text for people. */
#define kOfxPropVersionLabel "OfxPropVersionLabel"

/* string: what the plugin does, for people. */
#define kOfxPropPluginDescription "OfxPropPluginDescription"

/* string: name shown to the user; the name if unset. */
#define kOfxPropLabel "OfxPropLabel"

/* string x2: file in Contents/Resources; index 0 is SVG, 1 is PNG. */
#define kOfxPropIcon "OfxPropIcon"

/* string: label for tight places. */
#define kOfxPropShortLabel "OfxPropShortLabel"

/* string: label for wide places. */
#define kOfxPropLongLabel "OfxPropLongLabel"

/* string: why something changed, one of the three below. */
#define kOfxPropChangeReason "OfxPropChangeReason"

#define kOfxChangeUserEdited   "OfxChangeUserEdited"
#define kOfxChangePluginEdited "OfxChangePluginEdited"
#define kOfxChangeTime         "OfxChangeTime"

/* pointer: the OfxImageEffectHandle that an interact belongs to. */
#define kOfxPropEffectInstance "OfxPropEffectInstance"

/* pointer: native window of the host application; may be NULL. */
#define kOfxPropHostOSHandle "OfxPropHostOSHandle"

/* ---- Bit depths ------------------------------------------------------------------------------ */

/* Of one component of a pixel: 8 and 16 bit are unsigned and full range, half is 16 bit float. */
#define kOfxBitDepthNone  "OfxBitDepthNone"
#define kOfxBitDepthByte  "OfxBitDepthByte"
#define kOfxBitDepthShort "OfxBitDepthShort"
#define kOfxBitDepthHalf  "OfxBitDepthHalf"
#define kOfxBitDepthFloat "OfxBitDepthFloat"

#ifdef __cplusplus
}
#endif

#endif
