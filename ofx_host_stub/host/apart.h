/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_HOST_APART_H
#define WO_HOST_APART_H

#include "catalogue.h"

/* Plugins described in processes of their own, so that what they do there stays there.

   Describers are started by the host's command line, followed by

       BUNDLE BINARY FIRST PARENT

   FIRST is the number of the first plugin to describe, PARENT the process that waits. Each is the
   leader of a process group, reads nothing, and has the descriptors 1 and 2, of which the last line
   is kept, and WO_APART_RESULTS, to which it writes lines as they become known:

       count N            the binary is loaded and has so many plugins
       begin I [NAME]     plugin I is being fetched; with its name: is describing itself
       plugin | note | fail ...    as in a catalogue
       end                all is said; what follows is Unload

   One that says nothing for config.describe_seconds, or goes on for ten times as long, is killed
   with its group; so is one that writes nonsense. After a crash or a kill in plugin I another one
   goes on with I + 1. A describer dies with its parent (on Linux). */

#define WO_APART_RESULTS 3

/* Fills the catalogues of binaries, which are empty before, several at once. A fault of a plugin is
   a line among the failures of its binary and no failure of this function, which knows only want of
   memory and WO_ABORTED (config.aborted); then nothing that was begun is left running. No thread is
   made; signals are left alone. */
WO_NODISCARD wo_status wo_apart_describe(wo_host *host, wo_binary *const *binaries, size_t count,
                                         wo_error *error);

#endif
