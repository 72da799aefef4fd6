/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "command.h"

#include <signal.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

static void print_message(const char *format, va_list list)
{
    char text[2048];
    vsnprintf(text, sizeof text, format, list);
    fprintf(stderr, "wideopen: %s\n", text);
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

static void on_interrupt(int number)
{
    const long long first = atomic_load(&interrupted_at), now = now_ms();
    if (first == 0)
        atomic_store(&interrupted_at, now);
    else if (now - first > 300) /* one interrupt may arrive twice: to us and to our group */
        _exit(128 + number);
}

void wo_interrupt_catch(void)
{
    struct sigaction action;
    memset(&action, 0, sizeof action);
    action.sa_handler = on_interrupt;
    sigemptyset(&action.sa_mask);
    action.sa_flags = SA_RESTART;
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
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
    snprintf(bar->label, sizeof bar->label, "%s", label);
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
