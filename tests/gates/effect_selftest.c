/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "effect_table.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A small effect without faults, copied and spoilt in one place for each mistake. */

typedef struct values {
    double size;
    int32_t mode;
    int32_t count;
    double place[2];
    char text[WO_PARAM_STRING_SIZE];
} values;

static const char *const modes[] = {"plain", "fancy", NULL};
static const char *const mode_labels[] = {"Plain", "Fancy", NULL};
static const char *const few[] = {"plain", NULL};
static const char *const same[] = {"plain", "plain", NULL};
static const char *const odd[] = {"plain", "very fancy", NULL};
static const char *const other_labels[] = {"Plain", "With frills", NULL};
static const char *const more_labels[] = {"Plain", "Fancy", "Third", NULL};

enum { SIZE, MODE, COUNT, PLACE, TEXT, ROWS };

typedef struct sample {
    wo_param params[ROWS];
    wo_param_group groups[2];
    wo_clip clips[2];
    wo_effect effect;
} sample;

static wo_status region(const void *params, const wo_geometry *geometry, wo_rect window,
                        size_t clip, wo_rect *needed, wo_error *error)
{
    (void)params, (void)geometry, (void)clip, (void)error;
    *needed = window;
    return WO_OK;
}

static int identity(const void *params, const wo_geometry *geometry)
{
    (void)params, (void)geometry;
    return 0;
}

static wo_status plan_create(const wo_context *context, const void *params,
                             const wo_plan_args *args, wo_plan **plan, wo_error *error)
{
    (void)context, (void)params, (void)args;
    *plan = NULL;
    return wo_fail(error, WO_ERR_UNSUPPORTED, "this effect is only a table");
}

static int plan_print(const wo_plan *plan, char *buffer, size_t size)
{
    (void)plan;
    return snprintf(buffer, size, "nothing");
}

static wo_status render(const wo_plan *plan, wo_rect window, const wo_image *output,
                        wo_report *report, wo_error *error)
{
    (void)plan, (void)window, (void)output, (void)report;
    return wo_fail(error, WO_ERR_UNSUPPORTED, "this effect is only a table");
}

static void plan_destroy(wo_plan **plan)
{
    *plan = NULL;
}

static int two_handles(const void *params, bool *joined)
{
    (void)params;
    *joined = true;
    return 2;
}

static void make(sample *s)
{
    *s = (sample){.params = {{.key = "size",
                              .label = "Size",
                              .help = "How large it is.",
                              .unit = "px",
                              .group = "shape",
                              .type = WO_PARAM_DOUBLE,
                              .offset = offsetof(values, size),
                              .initial = {2},
                              .min = 0,
                              .max = 10,
                              .ui_min = 1,
                              .ui_max = 5,
                              .animates = true},
                             {.key = "mode",
                              .label = "Mode",
                              .help = "How it looks.",
                              .unit = "",
                              .group = "shape",
                              .type = WO_PARAM_CHOICE,
                              .offset = offsetof(values, mode),
                              .max = 1,
                              .ui_max = 1,
                              .choices = modes,
                              .choice_labels = mode_labels},
                             {.key = "count",
                              .label = "Count",
                              .help = "How many there are.",
                              .unit = "",
                              .group = "rest",
                              .type = WO_PARAM_INT,
                              .offset = offsetof(values, count),
                              .initial = {3},
                              .min = 1,
                              .max = 8,
                              .ui_min = 1,
                              .ui_max = 8},
                             {.key = "place",
                              .label = "Place",
                              .help = "Where it is.",
                              .unit = "px",
                              .group = "rest",
                              .type = WO_PARAM_POINT,
                              .offset = offsetof(values, place),
                              .initial = {1, -1},
                              .min = -9,
                              .max = 9,
                              .ui_min = -1,
                              .ui_max = 1,
                              .overlay = true},
                             {.key = "text",
                              .label = "Text",
                              .help = "What it says.",
                              .unit = "",
                              .group = "rest",
                              .type = WO_PARAM_STRING,
                              .offset = offsetof(values, text),
                              .initial_text = "hello"}},
                  .groups = {{"shape", "Shape", true}, {"rest", "The rest", false}},
                  .clips = {{.name = "Source",
                             .label = "Source",
                             .help = "The picture.",
                             .components = WO_COMPONENT_RGBA},
                            {.name = "Mask",
                             .label = "Mask",
                             .help = "Where it happens.",
                             .components = WO_COMPONENT_ALPHA,
                             .optional = true,
                             .mask = true}},
                  .effect = {.name = "SmallThing",
                             .label = "Small Thing",
                             .help = "Nothing at all.",
                             .params_size = sizeof(values),
                             .param_count = ROWS,
                             .group_count = 2,
                             .clip_count = 2,
                             .region = region,
                             .identity = identity,
                             .plan_create = plan_create,
                             .plan_print = plan_print,
                             .render = render,
                             .plan_destroy = plan_destroy}};
    s->effect.params = s->params;
    s->effect.groups = s->groups;
    s->effect.clips = s->clips;
}

/* The mistake has been made in s; it must be found, in words that hold these. */
static void expect(sample *s, const char *words, faults *f)
{
    faults found = {.wanted = words};
    check_effect(&s->effect, &found);
    if (found.count == 0)
        fault(f, "not found: %s", words);
    else if (!found.met)
        fault(f, "found, but not as: %s", words);
    make(s);
}

#define MISTAKE(change, words)                                                                     \
    do {                                                                                           \
        change;                                                                                    \
        expect(&s, words, f);                                                                      \
    } while (0)

static void check_table_mistakes(faults *f)
{
    sample s;
    make(&s);
    faults none = {.out = f->out};
    check_effect(&s.effect, &none);
    if (none.count)
        fault(f, "faults in an effect that has none");

    MISTAKE(s.params[SIZE].key = "Size", "not camelCase");
    MISTAKE(s.params[SIZE].key = "my_size", "not camelCase");
    MISTAKE(s.params[SIZE].key = NULL, "not camelCase");
    MISTAKE(s.params[COUNT].key = "size", "twice");
    MISTAKE(s.params[SIZE].label = "", "no label");
    MISTAKE(s.params[SIZE].label = "Size.", "no label");
    MISTAKE(s.params[SIZE].help = "", "full stop");
    MISTAKE(s.params[SIZE].help = "How large it is", "full stop");
    MISTAKE(s.params[SIZE].unit = NULL, "unit");
    MISTAKE(s.params[SIZE].group = "none", "does not exist");
    MISTAKE(s.params[SIZE].type = (wo_param_type)99, "unknown type");
    MISTAKE(s.params[SIZE].initial[0] = 11, "outside the hard range");
    MISTAKE(s.params[SIZE].initial[0] = NAN, "outside the hard range");
    MISTAKE(s.params[PLACE].initial[1] = 10, "outside the hard range");
    MISTAKE(s.params[SIZE].ui_max = 11, "UI range is not inside");
    MISTAKE(s.params[SIZE].ui_min = -1, "UI range is not inside");
    MISTAKE(s.params[SIZE].ui_min = 5, "no UI range");
    MISTAKE(s.params[PLACE].max = INFINITY, "no hard range");
    MISTAKE(s.params[COUNT].initial[0] = 1.5, "default is not a whole number");
    MISTAKE(s.params[COUNT].max = 8.5, "whole numbers");
    MISTAKE(s.params[SIZE].initial_text = "2", "default text for a number");
    MISTAKE(s.params[SIZE].choices = modes, "what is no choice");
    MISTAKE(s.params[MODE].choices = NULL, "without choices");
    MISTAKE(s.params[MODE].choices = few, "labels do not go");
    MISTAKE(s.params[MODE].choices = same, "twice");
    MISTAKE(s.params[MODE].choices = odd, "is no camelCase");
    MISTAKE(s.params[MODE].choice_labels = few, "labels do not go");
    MISTAKE(s.params[MODE].choice_labels = more_labels, "labels do not go");
    MISTAKE(s.params[MODE].choice_labels = other_labels, "is not the choice");
    MISTAKE(s.params[MODE].max = 2, "the choices");
    MISTAKE(s.params[COUNT].offset = s.params[MODE].offset, "overlaps");
    MISTAKE(s.params[COUNT].offset += 2, "overlaps");
    MISTAKE(s.params[MODE].offset = s.params[SIZE].offset + 4, "overlaps");
    MISTAKE(s.params[TEXT].offset += 8, "no row");
    MISTAKE(s.effect.params_size -= 8, "outside the struct");
    MISTAKE(s.effect.params_size += 8, "last fields");
    MISTAKE(s.params[COUNT] = s.params[TEXT], "twice");
    MISTAKE((s.params[PLACE] = s.params[TEXT], s.effect.param_count--), "no row");
    MISTAKE(s.groups[1].key = "shape", "twice");
    MISTAKE(s.groups[1].key = "size", "both a group and a parameter");
    MISTAKE(s.groups[1].label = NULL, "no label");
    MISTAKE(s.effect.param_count = 2, "is empty");
    MISTAKE(s.effect.clip_count = 0, "clips");
    MISTAKE(s.effect.clip_count = WO_CLIPS_MAX + 1, "clips");
    MISTAKE(s.clips[0].name = "Picture", "Source");
    MISTAKE(s.clips[0].optional = true, "Source");
    MISTAKE(s.clips[1].name = "Source", "twice");
    MISTAKE(s.clips[1].name = "Output", "taken");
    MISTAKE(s.clips[1].name = "the mask", "not CamelCase");
    MISTAKE(s.clips[1].label = "", "no label");
    MISTAKE(s.clips[1].help = "Where", "full stop");
    MISTAKE(s.clips[1].components = 0, "components");
    MISTAKE(s.clips[1].components = 8, "components");
    MISTAKE(s.clips[1].optional = false, "not optional");
    MISTAKE(s.effect.name = "smallThing", "not CamelCase");
    MISTAKE(s.effect.label = "", "no label");
    MISTAKE(s.effect.help = NULL, "full stop");
    MISTAKE(s.effect.render = NULL, "missing");
    MISTAKE((s.params[PLACE].overlay = false, s.params[COUNT].overlay = true), "without a point");
    MISTAKE((s.params[PLACE].overlay = false, s.effect.handles = two_handles), "without a point");
    MISTAKE(s.effect.handles = two_handles, "2 of 1 handles");
}

/* Replaces the first from in a page by to; the page must then be found wrong, or still right. */
static void try_page(const char *from, const char *to, bool wrong, faults *f)
{
    sample s;
    page written = {0}, changed = {0};
    faults found = {0};
    make(&s);
    page_write(&s.effect, &written);
    const char *const at = strstr(written.data, from);
    if (!at) {
        fault(f, "a page without: %s", from);
    } else {
        page_add(&changed, "%.*s%s%s", (int)(at - written.data), written.data, to,
                 at + strlen(from));
        page_check(&s.effect, changed.data, &found);
        if (wrong && found.count == 0)
            fault(f, "not found: \"%s\" instead of \"%s\"", to, from);
        if (!wrong && found.count > 0)
            fault(f, "found, but right: \"%s\" instead of \"%s\"", to, from);
    }
    page_free(&written);
    page_free(&changed);
}

/* The list of pictures of the sample with one part replaced; then it is wrong, or still right. */
static void try_list(const char *from, const char *to, bool wrong, faults *f)
{
    static const char *const good = "# Words.\n\n[shape]\nsize | 1 2*0.5 | shot | count=4\n"
                                    "mode | plain fancy | shot | place=1,1 size=3\n"
                                    "[rest]\ncount | 1 8 | shot |\n"
                                    "place | 0,0 1,1 | shot |\ntext | hello you | shot |\n";
    sample s;
    page changed = {0};
    faults found = {0};
    make(&s);
    const char *const at = strstr(good, from);
    if (!at) {
        fault(f, "a list without: %s", from);
        return;
    }
    page_add(&changed, "%.*s%s%s", (int)(at - good), good, to, at + strlen(from));
    pictures_check(&s.effect, changed.data, NULL, &found);
    if (wrong != (found.count > 0))
        fault(f, "list of pictures, %s: \"%s\" instead of \"%s\"",
              wrong ? "not found" : "found, but right", to, from);
    page_free(&changed);
}

static void check_list_mistakes(faults *f)
{
    try_list("# Words.", "# Other words.", false, f);
    try_list("[shape]", "[rest]", true, f);
    try_list("[shape]", "", true, f);
    try_list("size |", "sizes |", true, f);
    try_list("size | 1 2", "size | 1 11", true, f);
    try_list("1 2*0.5", "1", true, f);
    try_list("plain fancy", "plain fanciest", true, f);
    try_list("count | 1 8 | shot |\n", "", true, f);
    try_list("count | 1 8 | shot |\n", "count | 1 8 | shot |\ncount | 1 8 | shot |\n", true, f);
    try_list("count | 1 8 | shot |\n", "count | 1 8 | shot\n", true, f);
    try_list("count | 1 8 | shot |\n", "count# | 1 8 | shot |\n", true, f);
    try_list("count=4", "count=9", true, f);
    try_list("count=4", "counts=4", true, f);
}

void check_checks(faults *f)
{
    check_table_mistakes(f);
    check_list_mistakes(f);
    try_page("# Small", "# Large", true, f);
    try_page("Nothing at all.", "Everything.", true, f);
    try_page("* `size`: How large it is.", "* `size`: How large.", true, f);
    try_page("* `size`", "* `sizes`", true, f);
    try_page("default `2`", "default `3`", true, f);
    try_page("slider 1 to 5", "slider 1 to 6", true, f);
    try_page("* `text`: What it says.\n  - Text: text, default `hello`\n", "", true, f);
    try_page("## Parameters\n", "## Parameters\n\n* `more`: Another one.\n", true, f);
    try_page("parameters-rest.png", "parameters-all.png", true, f);
    try_page("* `Mask`", "* `Matte`", true, f);
    try_page("## Clips", "## Pictures", true, f);
    try_page("## Parameters", "## Clips", true, f);
    try_page("Nothing at all.", "Nothing at\nall.", false, f);
    try_page("\n## Clips", "\nMore about it.\n\n## Method\n\n* `word`: free.\n\n## Clips", false,
             f);
}
