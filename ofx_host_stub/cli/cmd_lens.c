/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "args.h"
#include "command.h"
#include "json.h"
#include "lens_data.h"
#include "lens_panels.h"
#include "text_file.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { FILE_LIMIT = 1 << 20, NAMES_MAX = 256 };

static const wo_option options[] = {
    {"--json", NULL, NULL,
     "Print all that the page shows as JSON; what is infinite or does not exist becomes null.",
     false},
    {"--wavelength", NULL, "NM", "Of the first-order data and the focus, 300..2500; 587.56.",
     false},
    {"--meridian", NULL, "x|y",
     "Which section's first-order data; they differ for anamorphic lenses. x.", false},
    {"--fnumber", NULL, "N", "Stop the iris down; as open as it gets.", false},
    {"--focus", NULL, "M",
     "Distance of the object from the entrance pupil in metres; infinity. The sensor stands in the "
     "paraxial focus.",
     false},
    {"--field", NULL, "DEG",
     "Half field, 0.1..150; what the prescription says, else where a third of the light is left, "
     "at most 45. From 89 on the object must be at infinity.",
     false},
    {"--page", NULL, "FILE", "All drawings on one page, as SVG.", false},
    {"--section", NULL, "FILE",
     "The lens with rays of three fields, as SVG. Rays that are stopped are grey and end there.",
     false},
    {"--aberration", NULL, "FILE",
     "Longitudinal aberration at F, d and C, as SVG. Pupil height is where a ray crosses the plane "
     "of the entrance pupil (ep_z); 1 is the last ray that gets through, in mm beside it.",
     false},
    {"--spots", NULL, "FILE", "Spot diagrams at 0, 0.7 and 1 of the field, as SVG.", false},
    {"--vignetting", NULL, "FILE",
     "The part of the iris that passes light, the light on the sensor and distortion over the "
     "field, as SVG.",
     false},
    {"--bokeh", NULL, "FILE", "Density of rays through focus over the field: png, tif ...", false},
    {"--pencil-map", NULL, "FILE",
     "Density of the axial bundle over distance from the focus and radius at F, d and C, as EXR; "
     "heights in micrometres on the sensor for an object at infinity. It ends with the last ray "
     "that gets through, as the aberration does.",
     false},
};

static const wo_usage usage = {
    .command = "lens",
    .synopsis = "list | NAME | FILE [options]",
    .about = "Says what a lens is and draws it: one that comes with the program, or a prescription "
             "in a .lens or .dat file. Lengths are in mm.\n"
             "efl: focal length. bfd: last vertex to the rear focus. ffd: first vertex to the "
             "front focus. H1, H2: principal planes from the first and from the last vertex. ep_z, "
             "ep_d: entrance pupil from the first vertex and its diameter; xp_z, xp_d: exit pupil "
             "from the last vertex. fno: f-number.",
    .positionals = "NAME",
    .positionals_min = 1,
    .positionals_max = 1,
    .options = options,
    .option_count = WO_COUNT(options),
    .after = "Examples:\n  wideopen lens list\n"
             "  wideopen lens mine.lens --fnumber 2.8 --page mine.svg --bokeh mine.png\n",
};

/* ------------------------------------------------------------------------------- list */

static void list_json(void)
{
    wo_prescription lens;
    wo_json json;
    wo_json_begin(&json, stdout);
    wo_json_array(&json, NULL);
    for (size_t i = 0; wo_lens_name_at(i); i++) {
        if (wo_lens_find(wo_lens_name_at(i), &lens, NULL) != WO_OK)
            continue;
        wo_json_object(&json, NULL);
        wo_json_text(&json, "name", lens.name);
        wo_json_text(&json, "title", lens.title);
        wo_json_text(&json, "source", lens.source);
        wo_json_number(&json, "focal", lens.focal_mm > 0 ? lens.focal_mm : NAN);
        wo_json_number(&json, "f_number", lens.f_number > 0 ? lens.f_number : NAN);
        wo_json_number(&json, "half_field", lens.half_field > 0 ? lens.half_field : NAN);
        wo_json_close(&json);
    }
    wo_json_close(&json);
}

static int list(const wo_args *args)
{
    if (wo_args_count(args, "--json")) {
        list_json();
        return WO_EXIT_OK;
    }
    wo_prescription lens;
    for (size_t i = 0; wo_lens_name_at(i); i++) {
        wo_error error = {0};
        if (wo_lens_find(wo_lens_name_at(i), &lens, &error) != WO_OK)
            return wo_failure(&error);
        printf("%-30s %s\n", lens.name, lens.title);
    }
    return WO_EXIT_OK;
}

/* ---------------------------------------------------------------------------- finding */

static bool ends_with(const char *text, const char *end)
{
    const size_t length = strlen(text), tail = strlen(end);
    return length > tail && strcmp(text + length - tail, end) == 0;
}

static bool looks_like_file(const char *word)
{
    return strchr(word, '/') || ends_with(word, ".lens") || ends_with(word, ".dat") ||
           access(word, F_OK) == 0;
}

static int unknown_lens(const char *word)
{
    const char *names[NAMES_MAX];
    size_t count = 0;
    char near[256];
    while (count < NAMES_MAX && wo_lens_name_at(count)) {
        names[count] = wo_lens_name_at(count);
        count++;
    }
    const int hits = wo_near_words(word, names, count, near, sizeof near);
    if (hits)
        return wo_usage_fault("lens", "unknown lens \"%s\"; did you mean %s", word, near);
    return wo_usage_fault("lens", "unknown lens \"%s\"; wideopen lens list shows what there is",
                          word);
}

static int find(const char *word, wo_prescription *lens)
{
    wo_error error = {0};
    if (wo_lens_find(word, lens, NULL) == WO_OK)
        return WO_EXIT_OK;
    if (!looks_like_file(word))
        return unknown_lens(word);
    char *text;
    size_t length;
    if (wo_text_read(word, FILE_LIMIT, &text, &length, &error) != WO_OK)
        return wo_failure(&error);
    const wo_status status = wo_prescription_parse(text, length, word, lens, &error);
    free(text);
    return status == WO_OK ? WO_EXIT_OK : wo_failure(&error);
}

/* --------------------------------------------------------------------------- printing */

const wo_lens_row_name wo_lens_rows[WO_LENS_ROWS] = {
    {"efl", "focal length", offsetof(wo_first_order, efl)},
    {"bfd", "rear focus from the last vertex", offsetof(wo_first_order, bfd)},
    {"ffd", "front focus from the first vertex", offsetof(wo_first_order, ffd)},
    {"H1", "principal plane from the first vertex", offsetof(wo_first_order, H1)},
    {"H2", "principal plane from the last vertex", offsetof(wo_first_order, H2)},
    {"ep_z", "entrance pupil from the first vertex", offsetof(wo_first_order, ep_z)},
    {"ep_d", "entrance pupil, diameter", offsetof(wo_first_order, ep_d)},
    {"xp_z", "exit pupil from the last vertex", offsetof(wo_first_order, xp_z)},
    {"xp_d", "exit pupil, diameter", offsetof(wo_first_order, xp_d)},
    {"fno", "f-number", offsetof(wo_first_order, fno)},
};

const char wo_lens_clamped_note[] =
    "a glass has no data for this wavelength; the nearest that it has was taken";

double wo_lens_row(const wo_first_order *first, size_t row)
{
    return *(const double *)((const char *)first + wo_lens_rows[row].offset);
}

static void print_text(const wo_lens_view *view, const wo_first_order *first)
{
    wo_put_clean(view->lens.name, stdout);
    fputs("  ", stdout);
    wo_put_clean(view->lens.title, stdout);
    if (view->lens.source[0]) {
        fputs("\nsource: ", stdout);
        wo_put_clean(view->lens.source, stdout);
    }
    printf("\nat %.4f nm, lengths in mm\n\n", view->nm);
    for (size_t i = 0; i < WO_LENS_ROWS; i++) {
        char number[32];
        wo_plot_number(number, sizeof number, wo_lens_row(first, i), 4);
        printf("  %-5s %14s  %s\n", wo_lens_rows[i].key, number, wo_lens_rows[i].text);
    }
    if (view->system.clamped)
        printf("\nnote: %s\n", wo_lens_clamped_note);
}

/* ------------------------------------------------------------------------------- work */

static bool read_setup(const wo_args *args, wo_lens_setup *setup)
{
    return wo_args_double(args, "--wavelength", 300, 2500, &setup->nm) &&
           wo_args_double(args, "--fnumber", 0.4, 1000, &setup->f_number) &&
           wo_args_double(args, "--focus", 0.001, 1e6, &setup->focus_m) &&
           wo_args_double(args, "--field", 0.1, 150, &setup->half_field);
}

static wo_status draw(const wo_args *args, const wo_lens_view *view, int *drawn, wo_error *error)
{
    static const struct {
        const char *option;
        wo_lens_page page;
    } pages[] = {
        {"--section", WO_PAGE_SECTION}, {"--aberration", WO_PAGE_ABERRATION},
        {"--spots", WO_PAGE_SPOTS},     {"--vignetting", WO_PAGE_VIGNETTING},
        {"--page", WO_PAGE_ALL},
    };
    for (size_t i = 0; i < WO_COUNT(pages); i++) {
        const char *const path = wo_args_value(args, pages[i].option, 0);
        if (!path)
            continue;
        WO_TRY(wo_lens_page_save(view, pages[i].page, path, error));
        *drawn += 1;
    }
    static const struct {
        const char *option;
        wo_status (*save)(const wo_lens_view *view, const char *path, wo_error *error);
    } pictures[] = {{"--bokeh", wo_lens_strip_save}, {"--pencil-map", wo_lens_pencil_map_save}};
    for (size_t i = 0; i < WO_COUNT(pictures); i++) {
        const char *const path = wo_args_value(args, pictures[i].option, 0);
        if (!path)
            continue;
        WO_TRY(pictures[i].save(view, path, error));
        *drawn += 1;
    }
    return WO_OK;
}

static int show(const wo_args *args)
{
    wo_prescription lens;
    wo_lens_view view;
    wo_lens_setup setup = {.nm = WO_NM_D};
    wo_error error = {0};
    int drawn = 0;
    const char *const meridian = wo_args_value(args, "--meridian", 0);
    if (!read_setup(args, &setup))
        return WO_EXIT_USAGE;
    if (meridian && strcmp(meridian, "x") != 0 && strcmp(meridian, "y") != 0)
        return wo_usage_fault("lens", "--meridian is x or y, not \"%s\"", meridian);
    const int code = find(args->positionals[0], &lens);
    if (code != WO_EXIT_OK)
        return code;
    if (wo_lens_view_make(&lens, &setup, &view, &error) != WO_OK ||
        draw(args, &view, &drawn, &error) != WO_OK)
        return wo_failure(&error);
    const wo_first_order *const first = &view.first[meridian && *meridian == 'y' ? 1 : 0];
    if (wo_args_count(args, "--json"))
        wo_lens_print_json(&view, first, stdout);
    else if (drawn == 0)
        print_text(&view, first);
    return WO_EXIT_OK;
}

int wo_cmd_lens(int argc, char **argv)
{
    wo_args args;
    int code = wo_args_read(&args, &usage, argc, argv);
    if (code == WO_EXIT_OK && args.help)
        wo_args_help(&usage, stdout);
    else if (code == WO_EXIT_OK)
        code = strcmp(args.positionals[0], "list") == 0 ? list(&args) : show(&args);
    wo_args_free(&args);
    return code;
}
