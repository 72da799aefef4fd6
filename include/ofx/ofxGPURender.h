/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */

/*
 * Rendering on the GPU: OpenGL textures, and CUDA, Metal and OpenCL memory.
 *
 * Host and effect descriptor say what they can do: "false", "true" or, for a plugin that has no
 * other way, "needed". The Enabled property in the arguments of a render says what this render
 * uses. Rows of GPU images never run backwards. Where the host gives a stream or a queue the plugin
 * must not wait for the end of its work; where it gives none the plugin must.
 */

#ifndef WO_OFX_GPU_RENDER_H
#define WO_OFX_GPU_RENDER_H

#include "ofxCore.h"
#include "ofxImageEffect.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Out of GPU memory: the host may free some and try again. */
#define kOfxStatGPUOutOfMemory 1001
#define kOfxStatGLOutOfMemory  1001

/* The GPU render failed: the host should try again on the CPU. */
#define kOfxStatGPURenderFailed 1002
#define kOfxStatGLRenderFailed  1002

/* string "true" or "false": renders on the CPU too. Since 1.5.1. */
#define kOfxImageEffectPropCPURenderSupported "OfxImageEffectPropCPURenderSupported"

/* ---- OpenGL ---------------------------------------------------------------------------------- */

/* string: false, true or needed. */
#define kOfxImageEffectPropOpenGLRenderSupported "OfxImageEffectPropOpenGLRenderSupported"

/* int 0/1: this render uses OpenGL. */
#define kOfxImageEffectPropOpenGLEnabled "OfxImageEffectPropOpenGLEnabled"

/* string xN on the effect descriptor: bit depths wanted for textures. */
#define kOfxOpenGLPropPixelDepth "OfxOpenGLPropPixelDepth"

/* int: GLuint name of the texture. */
#define kOfxImageEffectPropOpenGLTextureIndex "OfxImageEffectPropOpenGLTextureIndex"

/* int: GLenum target of the texture. */
#define kOfxImageEffectPropOpenGLTextureTarget "OfxImageEffectPropOpenGLTextureTarget"

/* Actions on an instance, with a context current. The second string begins with a k. */
#define kOfxActionOpenGLContextAttached "OfxActionOpenGLContextAttached"
#define kOfxActionOpenGLContextDetached "kOfxActionOpenGLContextDetached"

/* The string differs from the name. */
#define kOfxOpenGLRenderSuite "OfxImageEffectOpenGLRenderSuite"

/* Version 1. A texture handle is an image without kOfxImagePropData but with the two texture
 * properties. */
typedef struct OfxImageEffectOpenGLRenderSuiteV1 {
    /* `format` is a bit depth, or NULL to let the host choose. `region` as in clipGetImage. */
    OfxStatus (*clipLoadTexture)(OfxImageClipHandle clip, OfxTime time, const char *format,
                                 const OfxRectD *region, OfxPropertySetHandle *textureHandle);
    OfxStatus (*clipFreeTexture)(OfxPropertySetHandle textureHandle);
    OfxStatus (*flushResources)(void);
} OfxImageEffectOpenGLRenderSuiteV1;

/* ---- CUDA, since 1.5 ------------------------------------------------------------------------- */

/* string: false, true or needed. */
#define kOfxImageEffectPropCudaRenderSupported "OfxImageEffectPropCudaRenderSupported"

/* int 0/1: kOfxImagePropData is a CUDA device pointer. */
#define kOfxImageEffectPropCudaEnabled "OfxImageEffectPropCudaEnabled"

/* string: false, true or needed. */
#define kOfxImageEffectPropCudaStreamSupported "OfxImageEffectPropCudaStreamSupported"

/* pointer: cudaStream_t. */
#define kOfxImageEffectPropCudaStream "OfxImageEffectPropCudaStream"

/* ---- Metal, since 1.5 ------------------------------------------------------------------------ */

/* string: false, true or needed. */
#define kOfxImageEffectPropMetalRenderSupported "OfxImageEffectPropMetalRenderSupported"

/* int 0/1: kOfxImagePropData is an id<MTLBuffer>. */
#define kOfxImageEffectPropMetalEnabled "OfxImageEffectPropMetalEnabled"

/* pointer: id<MTLCommandQueue>. */
#define kOfxImageEffectPropMetalCommandQueue "OfxImageEffectPropMetalCommandQueue"

/* ---- OpenCL, since 1.5 ----------------------------------------------------------------------- */

/* string: OpenCL buffers: false, true or needed. */
#define kOfxImageEffectPropOpenCLRenderSupported "OfxImageEffectPropOpenCLRenderSupported"

/* string: OpenCL images: false or true. */
#define kOfxImageEffectPropOpenCLSupported "OfxImageEffectPropOpenCLSupported"

/* int 0/1: this render uses OpenCL. */
#define kOfxImageEffectPropOpenCLEnabled "OfxImageEffectPropOpenCLEnabled"

/* pointer: cl_command_queue. */
#define kOfxImageEffectPropOpenCLCommandQueue "OfxImageEffectPropOpenCLCommandQueue"

/* pointer: cl_mem image; if NULL, kOfxImagePropData is a cl_mem buffer. */
#define kOfxImageEffectPropOpenCLImage "OfxImageEffectPropOpenCLImage"

#define kOfxOpenCLProgramSuite "OfxOpenCLProgramSuite"

/* Version 1. pResult is a cl_program *. */
typedef struct OfxOpenCLProgramSuiteV1 {
    OfxStatus (*compileProgram)(const char *pszProgramSource, int fOptional, void *pResult);
} OfxOpenCLProgramSuiteV1;

#ifdef __cplusplus
}
#endif

#endif
