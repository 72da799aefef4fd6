/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "internal.h"

#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#ifdef __linux__
#include <elf.h>

/* The loader maps what the headers promise without looking at the length of the file; a truncated
   one then ends the process with SIGBUS. So look first. */

static const char *segment_fault(int file, off_t size, const Elf64_Ehdr *header)
{
    for (unsigned i = 0; i < header->e_phnum; i++) {
        Elf64_Phdr segment;
        const Elf64_Off at = header->e_phoff + (Elf64_Off)i * sizeof segment;
        if (at > (Elf64_Off)size || (Elf64_Off)size - at < sizeof segment ||
            pread(file, &segment, sizeof segment, (off_t)at) != (ssize_t)sizeof segment)
            return "it is cut off";
        if (segment.p_type != PT_LOAD && segment.p_type != PT_DYNAMIC)
            continue;
        if (segment.p_offset > (Elf64_Off)size ||
            segment.p_filesz > (Elf64_Off)size - segment.p_offset)
            return "it is cut off";
    }
    return NULL;
}

static const char *fault(int file)
{
    struct stat status;
    Elf64_Ehdr header;
    if (fstat(file, &status) != 0 || !S_ISREG(status.st_mode))
        return "it is no file";
    if (status.st_size == 0)
        return "it is empty";
    if (pread(file, &header, sizeof header, 0) != (ssize_t)sizeof header ||
        memcmp(header.e_ident, ELFMAG, SELFMAG) != 0)
        return "it is no shared library";
    if (header.e_ident[EI_CLASS] != ELFCLASS64 || header.e_type != ET_DYN ||
        header.e_phentsize != sizeof(Elf64_Phdr))
        return "it is no shared library of this kind of machine";
    return segment_fault(file, status.st_size, &header);
}

const char *wo_binary_fault(const char *path)
{
    const int file = open(path, O_RDONLY | O_CLOEXEC);
    if (file < 0)
        return "it cannot be read";
    const char *why = fault(file);
    close(file);
    return why;
}

#else

const char *wo_binary_fault(const char *path)
{
    (void)path; /* other loaders check for themselves */
    return NULL;
}

#endif
