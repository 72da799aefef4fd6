/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "command.h"

#include <signal.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

/* Bytes of the character at text, 0 when it is none that may be shown. */
static int shown_bytes(const unsigned char *text)
{
    static const unsigned least[] = {0, 0, 0xa0, 0x800, 0x10000}; /* 0x80..0x9f steer, too */
    const unsigned char first = text[0];
    if (first < 0x80)
        return (first >= 0x20 && first != 0x7f) || first == '\n' || first == '\t';
    const int bytes = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
    unsigned code = first & (0xffu >> (bytes + 1));
    if (first < 0xc0 || first > 0xf7)
        return 0;
    for (int i = 1; i < bytes; i++) {
        if ((text[i] & 0xc0) != 0x80)
            return 0;
        code = code << 6 | (text[i] & 0x3fu);
    }
    return code >= least[bytes] && code <= 0x10ffff ? bytes : 0;
}

void wo_put_clean(const char *text, FILE *out)
{
    for (const unsigned char *at = (const unsigned char *)text; *at;) {
        const int bytes = shown_bytes(at);
        if (bytes)
            fwrite(at, 1, (size_t)bytes, out);
        else
            fprintf(out, "\\x%02x", *at);
        at += bytes ? bytes : 1;
    }
}

/* Lines of any length; those of several threads stay whole. */
static void print_message(const char *format, va_list list)
{
    char text[2048];
    va_list again;
    va_copy(again, list);
    const int length = vsnprintf(text, sizeof text, format, list);
    char *const longer = length >= (int)sizeof text ? malloc((size_t)length + 1) : NULL;
    if (longer)
        vsnprintf(longer, (size_t)length + 1, format, again);
    va_end(again);
    flockfile(stderr);
    fputs("wideopen: ", stderr);
    wo_put_clean(longer ? longer : text, stderr);
    fputc('\n', stderr);
    funlockfile(stderr);
    free(longer);
}

void wo_message(const char *format, ...)
{
    va_list list;
    va_start(list, format);
    print_message(format, list);
    va_end(list);
}

int wo_usage_fault(const char *command, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    print_message(format, list);
    va_end(list);
    wo_message("wideopen %s --help lists what is allowed", command);
    return WO_EXIT_USAGE;
}

int wo_failure(const wo_error *error)
{
    if (wo_interrupted(NULL)) {
        wo_message("interrupted; nothing half-written is left");
        return WO_EXIT_INTERRUPTED;
    }
    wo_message("%s", error->text[0] ? error->text : wo_status_text(error->status));
    return WO_EXIT_FAILURE;
}

/* When the first interrupt came, in milliseconds; 0 = there was none. Lock-free, so a signal
   handler may use it. */
static atomic_llong interrupted_at;

static long long now_ms(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (long long)now.tv_sec * 1000 + now.tv_nsec / 1000000 + 1;
}

/* Set before any handler is. */
static void (*last_act)(void);

/* The shell, or whoever started this, sees which signal it was. */
static void die(int number)
{
    if (last_act)
        last_act();
    signal(number, SIG_DFL);
    raise(number);
}

static void on_interrupt(int number)
{
    const long long first = atomic_load(&interrupted_at), now = now_ms();
    if (first == 0)
        atomic_store(&interrupted_at, now);
    else if (now - first > 300) /* one interrupt may arrive twice: to us and to our group */
        die(number);
}

static void handle(int number, void (*handler)(int), bool even_ignored)
{
    struct sigaction action, before;
    memset(&action, 0, sizeof action);
    action.sa_handler = handler;
    sigemptyset(&action.sa_mask);
    action.sa_flags = SA_RESTART;
    if (even_ignored || (sigaction(number, NULL, &before) == 0 && before.sa_handler != SIG_IGN))
        sigaction(number, &action, NULL);
}

void wo_interrupt_watch(void (*clean_up)(void))
{
    static const int ends[] = {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGXCPU};
    last_act = clean_up;
    for (size_t i = 0; i < WO_COUNT(ends); i++)
        handle(ends[i], die, false);
    handle(SIGXFSZ, SIG_IGN, true);
}

void wo_interrupt_catch(void)
{
    handle(SIGINT, on_interrupt, true);
    handle(SIGTERM, on_interrupt, true);
    handle(SIGHUP, on_interrupt, false);
}

bool wo_interrupted(void *user)
{
    (void)user;
    return atomic_load(&interrupted_at) != 0;
}

bool wo_bar_wanted(bool forced, bool forbidden)
{
    return forced || (!forbidden && isatty(STDERR_FILENO));
}

void wo_bar_begin(wo_bar *bar, bool shown, const char *label)
{
    *bar = (wo_bar){.shown = shown, .permille = -1};
    for (size_t i = 0; label[i] && i + 1 < sizeof bar->label; i++)
        bar->label[i] = (char)(label[i] > 0 && label[i] < ' ' ? ' ' : label[i]);
}

void wo_bar_move(wo_bar *bar, double fraction)
{
    enum { WIDTH = 40 };
    const double inside = fraction > 0 ? (fraction < 1 ? fraction : 1) : 0;
    const int permille = (int)(inside * 1000);
    if (!bar->shown || permille == bar->permille)
        return;
    bar->permille = permille;
    char cells[WIDTH + 1];
    for (int i = 0; i < WIDTH; i++)
        cells[i] = i < permille * WIDTH / 1000 ? '#' : '.';
    cells[WIDTH] = '\0';
    fprintf(stderr, "\r%s [%s] %3d %%", bar->label, cells, permille / 10);
    fflush(stderr);
}

void wo_bar_end(wo_bar *bar)
{
    if (bar->shown && bar->permille >= 0)
        fprintf(stderr, "\r%*s\r", (int)strlen(bar->label) + 56, "");
    bar->shown = false;
}
