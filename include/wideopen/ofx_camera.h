/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WIDEOPEN_OFX_CAMERA_H
#define WIDEOPEN_OFX_CAMERA_H

/* Metadata of a clip's picture, which OpenFX has no properties for. A host may set these two, C
   string X N with the same N, on the property set of a clip's instance: names of attributes, as
   the file spells them (or with a prefix as "exr/"), and their values. Values are texts: numbers in
   the C locale, those of a vector or a box separated by blanks. They are those of the time of the
   action that runs, as seen by GetRegionOfDefinition, GetRegionsOfInterest, IsIdentity and Render,
   and do not change while one runs. Our plugins read the camera of Source and of their depth clips
   from them (wideopen/camera.h); without these properties they do with their parameters. A host
   that knows which parameters its user has set by hand may add the attribute "wideopen:own", whose
   value lists their names separated by blanks: they win over the metadata. */
#define kWideOpenClipPropMetadataNames  "org.wideopen.ClipProp.MetadataNames"
#define kWideOpenClipPropMetadataValues "org.wideopen.ClipProp.MetadataValues"

#endif
