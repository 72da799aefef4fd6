/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "apart.h"

#include <errno.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif

/* The other side of apart.c: what a describer does. Each line is written when it is known, so that
   nothing is lost when a plugin ends the process. */

static void say(const char *format, ...) WO_PRINTF(1, 2);
static void say(const char *format, ...)
{
    char line[WO_LINE_MAX];
    va_list args;
    va_start(args, format);
    vsnprintf(line, sizeof line, format, args);
    va_end(args);
    size_t length = strlen(line);
    for (const char *from = line; length > 0;) {
        const ssize_t done = write(WO_APART_RESULTS, from, length);
        if (done < 0 && errno == EINTR)
            continue;
        if (done <= 0)
            _exit(1); /* nobody listens any more */
        from += done;
        length -= (size_t)done;
    }
}

/* Dies with the parent, writes no image of its memory. */
static void be_mortal(long parent)
{
    const struct rlimit nothing = {0, 0};
    (void)setrlimit(RLIMIT_CORE, &nothing);
#ifdef __linux__
    (void)prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
    if ((long)getppid() != parent)
        _exit(1);
}

static bool is_failure(const wo_host *host, const char *note)
{
    for (size_t i = 0; i < host->failures.count; i++)
        if (strcmp(host->failures.items[i], note) == 0)
            return true;
    return false;
}

/* Says what is new since the last call. */
static void say_news(const wo_host *host, wo_binary *binary)
{
    wo_catalogue *catalogue = &binary->catalogue;
    char line[WO_LINE_MAX];
    for (size_t i = 0; i < host->notes.count; i++) {
        const char *note = host->notes.items[i];
        (void)wo_texts_add(is_failure(host, note) ? &catalogue->failures : &catalogue->notes, note);
    }
    for (size_t i = 0; wo_catalogue_line(catalogue, i, line); i++)
        say("%s", line);
    wo_catalogue_clear(catalogue);
}

static void forget_news(wo_host *host)
{
    wo_texts_clear(&host->notes);
    wo_texts_clear(&host->failures);
    wo_host_violations_clear(host);
}

static void describe_all(wo_host *host, wo_binary *binary, int first)
{
    const char *why = "";
    wo_module *module = wo_module_open(binary, &why);
    if (!module) {
        wo_note_failure(host, "%s: %s", binary->bundle, why);
        say_news(host, binary);
        return;
    }
    say("count\t%d\n", wo_module_count(module));
    for (int i = first; i < wo_module_count(module); i++) {
        char name[256];
        say("begin\t%d\n", i);
        const char *identifier = wo_module_identifier(module, i);
        wo_line_clean(name, sizeof name, identifier ? identifier : "");
        if (identifier)
            say("begin\t%d\t%s\n", i, name);
        (void)wo_module_describe(host, binary, module, i);
        say_news(host, binary);
        forget_news(host);
    }
}

int wo_host_describer(int argc, char **argv)
{
    enum { BUNDLE, BINARY, FIRST, PARENT, COUNT };
    wo_host *host = NULL;
    wo_error error = {0};
    if (argc != COUNT)
        return 2;
    be_mortal(strtol(argv[PARENT], NULL, 10));
    const wo_host_config config = {.threads = 1, .background = true};
    if (wo_host_create(&config, &host, &error) != WO_OK) {
        fprintf(stderr, "%s\n", error.text);
        return 1;
    }
    wo_binary binary = {.bundle = argv[BUNDLE], .path = argv[BINARY]};
    describe_all(host, &binary, (int)strtol(argv[FIRST], NULL, 10));
    say("end\n");
    wo_host_unload(host);
    _exit(0); /* before threads and destructors that plugins have left can do harm */
}
