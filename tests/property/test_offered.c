/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "near.h"
#include "optics/lens_choice.h"
#include "scenes.h"

#include <stdio.h>
#include <string.h>

/* What a choice offers can be had, and is what it was: hosts keep choices in projects by place or
   by key. */

/* Every choice of LensBlur, one after the other, beside defaults. */
static void every_choice_renders(void **state)
{
    (void)state;
    int count = 0;
    for (size_t i = 0; i < WO_LENS_BLUR_PARAMS; i++) {
        const wo_param *const row = &wo_lens_blur_table[i];
        if (strcmp(row->key, "lensDesign") == 0)
            continue; /* below */
        for (int k = 0; k < wo_param_choice_count(row); k++, count++) {
            scene s;
            scene_init(&s, (wo_rect){0, 0, 48, 27});
            scene_fill_layers(&s, 3);
            picture_fill(scene_clip(&s, WO_CLIP_FOCUS, 1), (const float[1]){2});
            s.params.samples = 4;
            s.params.wavelengths = 2;
            wo_error error = {WO_OK, ""};
            const wo_context context = WO_CONTEXT_INIT;
            if (wo_param_parse(row, row->choices[k], &s.params, &error) != WO_OK)
                fail_msg("%s", error.text);
            wo_image out = picture_make(s.geometry.extent, 4);
            if (scene_run(&s, &context, s.geometry.extent, &out, NULL, &error) != WO_OK)
                fail_msg("%s=%s: %s", row->key, row->choices[k], error.text);
            picture_free(&out);
            scene_free(&s);
        }
    }
    assert_true(count > 40);
}

/* Every design in every lens that takes one, near and far, for short and long focal lengths. */
static void every_design_is_a_lens(void **state)
{
    (void)state;
    static const wo_lens_kind kinds[] = {WO_LENS_PRESCRIPTION, WO_LENS_SEIDEL};
    static const double focal[] = {20, 50, 200}, vf[] = {0, 0.4};
    static const double nm[] = {450, 550, 650};
    static wo_chosen_lens chosen;
    for (int i = 0; i < WO_LENS_DESIGNS; i++)
        for (size_t k = 0; k < WO_COUNT(kinds) * WO_COUNT(focal) * WO_COUNT(vf); k++) {
            const wo_lens_choice choice = {.kind = kinds[k % 2],
                                           .design = wo_lens_design(i),
                                           .focal_mm = focal[k / 2 % 3],
                                           .f_number = 2.8,
                                           .vf = vf[k / 6],
                                           .half_field = 0.4,
                                           .nm = nm,
                                           .lines = 3};
            wo_error error = {WO_OK, ""};
            if (wo_lens_choose(&choice, &chosen, &error) != WO_OK)
                fail_msg("%s: %s", wo_lens_names[i], error.text);
        }
    assert_null(wo_lens_design(-1));
    assert_null(wo_lens_design(WO_LENS_DESIGNS));
}

/* Every design of the library that can be rendered is offered, but once. */
static void every_lens_of_revolution_is_offered(void **state)
{
    (void)state;
    for (size_t n = 0; wo_lens_name_at(n); n++) {
        wo_prescription lens;
        int offered = 0;
        assert_int_equal(wo_lens_find(wo_lens_name_at(n), &lens, NULL), WO_OK);
        for (int i = 0; wo_lens_names[i]; i++)
            offered += strcmp(wo_lens_names[i], lens.name) == 0;
        if (offered != (wo_lens_model_check(&lens, NULL) == WO_OK))
            fail_msg("%s is offered %d times", lens.name, offered);
    }
}

/* Place and key of every choice of every effect, as the file has them. New ones come at the end and
   are written down there. */
static void places_and_keys_stay(void **state)
{
    (void)state;
    FILE *const file = fopen(WO_CHOICES, "r");
    assert_non_null(file);
    char line[256], want[256];
    for (size_t e = 0; wo_effects[e]; e++)
        for (size_t i = 0; i < wo_effects[e]->param_count; i++) {
            const wo_param *const row = &wo_effects[e]->params[i];
            for (int k = 0; k < wo_param_choice_count(row); k++) {
                snprintf(want, sizeof want, "%s %s %d %s\n", wo_effects[e]->name, row->key, k,
                         row->choices[k]);
                do {
                    if (!fgets(line, sizeof line, file))
                        fail_msg("not in the list of choices, or moved: %s", want);
                } while (line[0] == '#');
                if (strcmp(line, want) != 0)
                    fail_msg("a choice was %sand is now %s", line, want);
            }
        }
    assert_null(fgets(line, sizeof line, file)); /* else one was taken out */
    fclose(file);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_choice_renders),
        cmocka_unit_test(every_design_is_a_lens),
        cmocka_unit_test(every_lens_of_revolution_is_offered),
        cmocka_unit_test(places_and_keys_stay),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
