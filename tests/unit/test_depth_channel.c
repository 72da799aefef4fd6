/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "cli/depth_channel.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { PARTS = 3, CHANNELS = 16 };

/* "name: R G B Z; other: Z" */
static wo_io_file *file_of(const char *text)
{
    wo_io_file *file = NULL;
    char names[PARTS][256] = {"", "", ""};
    size_t count = 0;
    char *copy = strdup(text), *parts = copy, *part;
    while ((part = strsep(&parts, ";")))
        snprintf(names[count++], sizeof names[0], "%s", part);
    free(copy);
    assert_int_equal(wo_io_file_create(count, &file, NULL), WO_OK);
    for (size_t p = 0; p < count; p++) {
        const char *channels[CHANNELS];
        int used = 0;
        char *words = names[p], *word, *name = strchr(words, ':') ? strsep(&words, ":") : NULL;
        while (name && *name == ' ')
            name++;
        while ((word = strsep(&words, " ")))
            if (*word)
                channels[used++] = word;
        const wo_rect one = {0, 0, 1, 1};
        assert_int_equal(wo_io_part_init(&file->parts[p], name, one, one, channels, used, NULL),
                         WO_OK);
        for (int i = 0; i < used; i++)
            file->parts[p].pixels[i] = (float)(100 * p) + (float)i;
    }
    return file;
}

static const struct {
    const char *file, *words, *channel; /* NULL: the words are good, or there is nothing better */
} cases[] = {
    {"R G B A Z", "", "Z"},
    {"R G B A z", "", "z"},
    {"R G B A depth", "", "depth"},
    {"R G B A depth.Z N.X N.Y N.Z", "", "depth.Z"},
    {"R G B A N.X N.Y N.Z", "", NULL},
    {"R G B A P.X P.Y P.Z ZDepth", "", "ZDepth"},
    {"Combined.R Combined.G Combined.B Mist.Z Depth.Z", "", "Depth.Z"},
    {"V.Combined.R V.Combined.G V.Combined.B V.Depth.V", "", "V.Depth.V"},
    {"R G B A depth.R", "", "depth.R"},
    {"R G B A depth.R depth.G depth.B", "", "depth.R"},
    {"R G B A", "", NULL},
    {"Z", "", NULL},
    {"depth.Z", "", NULL},
    {"beauty: R G B A; depth: Z", "", "Z"},
    {"beauty: R G B A; other: R G B Z; more: Z", "more", NULL},
    {"beauty: R G B A; other: R G B Z", "other", "Z"},
    {"beauty: R G B A Z; other: R G B Z", "other", "other:Z"},
    {"R G B Z; R G B Z", "", "Z"},
    {"layer1.R layer1.G layer1.B layer1.Z layer2.R layer2.G layer2.B layer2.Z", "layer2",
     "layer2.Z"},
    {"layer1.R layer1.G layer1.B layer1_depth.Z", "layer1_depth", NULL},
    {"layer1.R layer1.G layer1.B layer1_depth.Z", "layer1", "layer1_depth.Z"},
    {"a.R a.G a.B a.Z b.R b.G b.B b.Z", "b", "b.Z"},
    {"b.R b.G b.B a.Z", "b", NULL}, /* whose depth it is */
    {"b.R b.G b.B b.depth.V a.depth.V", "b", "b.depth.V"},
    {"layer1.R layer1.G layer1.B layer10.Z", "layer1", NULL},
    {"layer1: R G B A; layer1_depth: Z; layer2: R G B A", "layer1", "Z"},
    {"layer1: R G B A; layer2_depth: Z; layer2: R G B A", "layer2", "Z"},
    {"layer1_depth: Z; layer2: R G B A; layer2_depth: Z", "layer2", "layer2_depth:Z"},
    {"R G B Z", "R", NULL},
    {"R G B Z", "R,G,B", NULL},
    {"R G B Z P.X P.Y P.Z", "P", NULL},
};

static void the_depth_of_a_file_is_found(void **state)
{
    (void)state;
    for (size_t i = 0; i < WO_COUNT(cases); i++) {
        wo_io_file *file = file_of(cases[i].file);
        char channel[64] = "";
        const bool found = wo_depth_channel(file, cases[i].words, channel, sizeof channel);
        if (found != (cases[i].channel != NULL) ||
            (found && strcmp(channel, cases[i].channel) != 0))
            fail_msg("%s of %s is \"%s\"", cases[i].words, cases[i].file, channel);
        wo_image image = {0};
        if (found) { /* and these are words for it */
            assert_int_equal(wo_io_select(file, channel, &image, NULL, NULL), WO_OK);
            assert_int_equal(image.components, 1);
        }
        free(image.data);
        wo_io_file_destroy(&file);
    }
}

static void the_right_part_is_named(void **state)
{
    (void)state;
    wo_io_file *file = file_of("beauty: R G B A Z; other: R G B Z");
    char channel[64] = "";
    wo_image image = {0};
    assert_true(wo_depth_channel(file, "other", channel, sizeof channel));
    assert_int_equal(wo_io_select(file, channel, &image, NULL, NULL), WO_OK);
    assert_true(image.data[0] == 103);
    free(image.data);
    wo_io_file_destroy(&file);
}

static void clips_of_depth_are_known_by_name(void **state)
{
    (void)state;
    assert_true(wo_is_depth_clip("Depth"));
    assert_true(wo_is_depth_clip("Depth4"));
    assert_true(wo_is_depth_clip("BackgroundDepth"));
    assert_false(wo_is_depth_clip("Source"));
    assert_false(wo_is_depth_clip("Mask"));
    assert_false(wo_is_depth_clip("Deep"));
    char name[16];
    assert_true(wo_colour_of_depth("Depth", name, sizeof name));
    assert_string_equal(name, "Source");
    assert_true(wo_colour_of_depth("Depth3", name, sizeof name));
    assert_string_equal(name, "Layer3");
    assert_true(wo_colour_of_depth("BackgroundDepth", name, sizeof name));
    assert_string_equal(name, "Background");
    assert_false(wo_colour_of_depth("Mask", name, sizeof name));
}

static void grey_is_no_colour(void **state)
{
    (void)state;
    float pixels[8] = {1, 1, 1, 0.5f, 2, 2, 2, 1};
    wo_image image = {pixels, {0, 0, 2, 1}, sizeof pixels, 4};
    assert_false(wo_is_coloured(&image));
    pixels[6] = 3;
    assert_true(wo_is_coloured(&image));
    image.components = 1;
    assert_false(wo_is_coloured(&image));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_depth_of_a_file_is_found),
        cmocka_unit_test(the_right_part_is_named),
        cmocka_unit_test(clips_of_depth_are_known_by_name),
        cmocka_unit_test(grey_is_no_colour),
    };
    return cmocka_run_group_tests_name("depth_channel", tests, NULL, NULL);
}
