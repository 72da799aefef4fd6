/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "args.h"

#include "command.h"

#include <ctype.h>
#include <errno.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LINE_WIDTH = 100, HELP_COLUMN = 30, NEAR_MAX = 64 };

static const wo_option help_option = {"--help", "-h", NULL, "Print this text and end.", true};

static const wo_option *find_option(const wo_usage *usage, const char *name, size_t length)
{
    for (size_t i = 0; i <= usage->option_count; i++) {
        const wo_option *const option = i < usage->option_count ? &usage->options[i] : &help_option;
        if (strlen(option->name) == length && memcmp(option->name, name, length) == 0)
            return option;
        if (option->shorter && strlen(option->shorter) == length &&
            memcmp(option->shorter, name, length) == 0)
            return option;
    }
    return NULL;
}

static int unknown_option(const wo_usage *usage, const char *name, size_t length)
{
    const char *words[NEAR_MAX];
    size_t count = 0;
    for (size_t i = 0; i < usage->option_count && count < NEAR_MAX - 1; i++)
        words[count++] = usage->options[i].name;
    words[count++] = help_option.name;
    char given[128], near[1024];
    snprintf(given, sizeof given, "%.*s", (int)(length < 100 ? length : 100), name);
    const int hits = wo_near_words(given, words, count, near, sizeof near);
    return wo_usage_fault(usage->command, "unknown option %s; %s %s", given,
                          hits ? "did you mean" : "there are", near);
}

static int add(wo_args *args, const wo_option *option, const char *value)
{
    if (option == &help_option) {
        args->help = true;
        return WO_EXIT_OK;
    }
    for (int i = 0; !option->repeats && i < args->given_count; i++)
        if (args->given[i].option == option)
            return wo_usage_fault(args->usage->command, "%s is given twice", option->name);
    args->given[args->given_count].option = option;
    args->given[args->given_count].value = value;
    args->given_count++;
    return WO_EXIT_OK;
}

/* One word that starts with a dash; *next is the following word or NULL, *used says if it was
   eaten. */
static int read_option(wo_args *args, const char *word, const char *next, bool *used)
{
    const wo_usage *const usage = args->usage;
    const char *value = NULL;
    size_t length = strlen(word);
    if (word[1] == '-') {
        const char *const equals = strchr(word, '=');
        if (equals) {
            length = (size_t)(equals - word);
            value = equals + 1;
        }
    } else if (length > 2) {
        length = 2;
        value = word + 2;
    }
    const wo_option *const option = find_option(usage, word, length);
    if (!option)
        return unknown_option(usage, word, length);
    if (!option->argument) {
        if (value)
            return wo_usage_fault(usage->command, "%s takes no value, but got \"%s\"", option->name,
                                  value);
        return add(args, option, NULL);
    }
    if (!value && next && strncmp(next, "--", 2) != 0) {
        value = next;
        *used = true;
    }
    if (!value)
        return wo_usage_fault(usage->command, "%s needs a value: %s %s", option->name, option->name,
                              option->argument);
    return add(args, option, value);
}

static int check_positionals(const wo_args *args)
{
    const wo_usage *const usage = args->usage;
    if (args->positional_count < usage->positionals_min)
        return wo_usage_fault(usage->command, "something is missing: wideopen %s %s needs %s",
                              usage->command, usage->synopsis, usage->positionals);
    if (args->positional_count > usage->positionals_max)
        return wo_usage_fault(usage->command, "\"%s\" is one word too many; expected %s",
                              args->positionals[usage->positionals_max],
                              usage->positionals_max ? usage->positionals : "options only");
    return WO_EXIT_OK;
}

int wo_args_read(wo_args *args, const wo_usage *usage, int argc, char **argv)
{
    *args = (wo_args){.usage = usage};
    const size_t room = argc > 0 ? (size_t)argc : 1;
    args->positionals = calloc(room, sizeof *args->positionals);
    args->given = calloc(room, sizeof *args->given);
    if (!args->positionals || !args->given) {
        wo_message("out of memory while reading the command line");
        return WO_EXIT_FAILURE;
    }
    bool plain_only = false;
    for (int i = 1; i < argc; i++) {
        if (plain_only || argv[i][0] != '-' || argv[i][1] == '\0') {
            args->positionals[args->positional_count++] = argv[i];
        } else if (strcmp(argv[i], "--") == 0) {
            plain_only = true;
        } else {
            bool used = false;
            const int code = read_option(args, argv[i], i + 1 < argc ? argv[i + 1] : NULL, &used);
            if (code != WO_EXIT_OK)
                return code;
            i += used;
        }
    }
    return args->help ? WO_EXIT_OK : check_positionals(args);
}

void wo_args_free(wo_args *args)
{
    free(args->positionals);
    free(args->given);
    *args = (wo_args){0};
}

void wo_print_wrapped(FILE *out, const char *text, int at, int indent)
{
    int column = at;
    bool line_start = true;
    while (*text) {
        if (*text == '\n') {
            fputc('\n', out);
            column = 0;
            line_start = true;
            text++;
            continue;
        }
        if (*text == ' ') {
            text++;
            continue;
        }
        const int length = (int)strcspn(text, " \n");
        if (!line_start && column + 1 + length > LINE_WIDTH) {
            fputc('\n', out);
            column = 0;
            line_start = true;
        }
        if (line_start) {
            fprintf(out, "%*s", column < indent ? indent - column : 0, "");
            column = column < indent ? indent : column;
            line_start = false;
        } else {
            fputc(' ', out);
            column++;
        }
        fprintf(out, "%.*s", length, text);
        column += length;
        text += length;
    }
    fputc('\n', out);
}

static void print_option(FILE *out, const wo_option *option)
{
    char left[128];
    const int length =
        snprintf(left, sizeof left, "  %s%s%s%s%s", option->shorter ? option->shorter : "",
                 option->shorter ? ", " : "", option->name, option->argument ? " " : "",
                 option->argument ? option->argument : "");
    fputs(left, out);
    const bool fits = length < HELP_COLUMN - 1;
    if (!fits)
        fputc('\n', out);
    wo_print_wrapped(out, option->help, fits ? length : 0, HELP_COLUMN);
}

void wo_args_help(const wo_usage *usage, FILE *out)
{
    fprintf(out, "wideopen %s %s\n\n", usage->command, usage->synopsis);
    wo_print_wrapped(out, usage->about, 0, 0);
    fputs("\nOptions:\n", out);
    for (size_t i = 0; i < usage->option_count; i++)
        print_option(out, &usage->options[i]);
    print_option(out, &help_option);
    if (usage->after)
        fprintf(out, "\n%s", usage->after);
}

int wo_args_count(const wo_args *args, const char *name)
{
    int count = 0;
    for (int i = 0; i < args->given_count; i++)
        count += strcmp(args->given[i].option->name, name) == 0;
    return count;
}

const char *wo_args_value(const wo_args *args, const char *name, int i)
{
    for (int k = 0; k < args->given_count; k++)
        if (strcmp(args->given[k].option->name, name) == 0 && i-- == 0)
            return args->given[k].value;
    return NULL;
}

bool wo_args_int(const wo_args *args, const char *name, int min, int max, int *value)
{
    const char *const text = wo_args_value(args, name, 0);
    if (!text)
        return true;
    char *end;
    errno = 0;
    const long number = strtol(text, &end, 10);
    if (end == text || *end || errno || number < min || number > max) {
        wo_usage_fault(args->usage->command, "%s is \"%s\", but must be a whole number %d..%d",
                       name, text, min, max);
        return false;
    }
    *value = (int)number;
    return true;
}

bool wo_args_double(const wo_args *args, const char *name, double min, double max, double *value)
{
    const char *const text = wo_args_value(args, name, 0);
    if (!text)
        return true;
    double number;
    if (!wo_read_numbers(text, &number, 1) || !(number >= min && number <= max)) {
        wo_usage_fault(args->usage->command, "%s is \"%s\", but must be a number %g..%g", name,
                       text, min, max);
        return false;
    }
    *value = number;
    return true;
}

bool wo_read_numbers(const char *text, double *values, int count)
{
    for (int i = 0; i < count; i++) {
        char *end;
        if (isspace((unsigned char)*text))
            return false;
        values[i] = strtod(text, &end);
        if (end == text || !isfinite(values[i]) || *end != (i + 1 < count ? ',' : '\0'))
            return false;
        text = end + 1;
    }
    return true;
}

bool wo_read_size(const char *text, int *width, int *height)
{
    int *const sides[2] = {width, height};
    for (int i = 0; i < 2; i++) {
        if (!isdigit((unsigned char)*text))
            return false;
        char *end;
        errno = 0;
        const long side = strtol(text, &end, 10);
        if (errno || side < 1 || side > 65536 || (i == 0 ? *end != 'x' : *end != '\0'))
            return false;
        *sides[i] = (int)side;
        text = end + 1;
    }
    return true;
}

/* Number of single-letter edits between two words, letter case ignored; long words are cut. */
static int edit_distance(const char *a, const char *b)
{
    enum { LENGTH = 48 };
    int row[LENGTH + 1];
    const int n = (int)strnlen(a, LENGTH), m = (int)strnlen(b, LENGTH);
    for (int j = 0; j <= m; j++)
        row[j] = j;
    for (int i = 1; i <= n; i++) {
        int diagonal = row[0];
        row[0] = i;
        for (int j = 1; j <= m; j++) {
            const bool same = tolower((unsigned char)a[i - 1]) == tolower((unsigned char)b[j - 1]);
            int best = diagonal + !same;
            diagonal = row[j];
            best = row[j] + 1 < best ? row[j] + 1 : best;
            best = row[j - 1] + 1 < best ? row[j - 1] + 1 : best;
            row[j] = best;
        }
    }
    return row[m];
}

static bool is_near(const char *word, const char *candidate)
{
    const size_t bare = strspn(word, "-");
    const char *const w = word + bare, *const c = candidate + strspn(candidate, "-");
    const size_t length = strlen(w);
    return edit_distance(w, c) <= 1 + (int)length / 4 ||
           (length >= 3 && (strstr(c, w) || strstr(w, c)));
}

int wo_near_words(const char *word, const char *const *words, size_t count, char *buffer,
                  size_t size)
{
    int hits = 0;
    for (size_t i = 0; i < count; i++)
        hits += is_near(word, words[i]);
    size_t used = 0;
    buffer[0] = '\0';
    for (size_t i = 0; i < count && used < size; i++)
        if (!hits || is_near(word, words[i])) {
            const int length =
                snprintf(buffer + used, size - used, "%s%s", used ? ", " : "", words[i]);
            used += length > 0 ? (size_t)length : 0;
        }
    return hits;
}
