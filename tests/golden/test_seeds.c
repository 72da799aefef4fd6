/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "blur_footage.h"
#include "defocus/renderer.h"
#include "tests/property/cases.h"
#include "tests/property/near.h"

#include <stdlib.h>

/* Another seed at a target error of one step of 8 bits: nothing that anybody sees. The difference
   of two pictures holds the errors of both. */

static wo_image render(const wo_footage *set, int method, int seed)
{
    const wo_context context = WO_CONTEXT_INIT;
    wo_lens_blur_params params;
    wo_image inputs[WO_LENS_BLUR_CLIPS];
    wo_plan_args args;
    wo_error error = {WO_OK, ""};
    blur_footage_setup(set, 4, 64, &params, inputs, &args);
    params.method = method;
    params.sampling = WO_SAMPLING_ADAPTIVE;
    params.target_error = 1.0 / 255;
    params.seed = seed;
    const wo_rect r = args.window;
    const size_t w = (size_t)wo_rect_width(r);
    wo_image out = {calloc(w * (size_t)wo_rect_height(r), 4 * sizeof(float)), r,
                    (ptrdiff_t)(w * 4 * sizeof(float)), 4};
    assert_non_null(out.data);
    if (wo_effect_run(&wo_lens_blur, &context, &params, &args, &out, NULL, &error) != WO_OK)
        fail_msg("%s", error.text);
    return out;
}

/* rms: of the difference, in steps of 8 bits; within: part of the pixels that differ by less than
   two of them in any colour. */
static void check(const wo_footage *set, int method, double rms, double within)
{
    wo_image a = render(set, method, 0);
    wo_image b = render(set, method, 1);
    double sum = 0;
    int64_t near[2] = {0};
    const int64_t pixels = (int64_t)wo_rect_width(a.bounds) * wo_rect_height(a.bounds);
    for (int64_t i = 0; i < pixels; i++) {
        double most = 0;
        for (int k = 0; k < 3; k++) {
            const double d =
                255 * (double)(wo_display(a.data[4 * i + k]) - wo_display(b.data[4 * i + k]));
            sum += d * d;
            most = fmax(most, fabs(d));
        }
        near[0] += most < 1;
        near[1] += most < 2;
    }
    const double measured = sqrt(sum / (3.0 * (double)pixels));
    const double one = (double)near[0] / (double)pixels;
    const double two = (double)near[1] / (double)pixels;
    print_message("%s, %s: RMS %.3f of 255, %.2f %% within 1, %.2f %% within 2\n",
                  set->options.scene, wo_renderer_of((wo_method)method)->key, measured, 100 * one,
                  100 * two);
    assert_true(measured > 0);
    assert_at_most(measured, rms);
    assert_true(two >= within);
    free(a.data);
    free(b.data);
}

static void scenes(void **state)
{
    (void)state;
    static const struct {
        const char *scene;
        double rms, within;
    } bars[] = {{"night-lights", 0.75, 0.97}, {"still-life", 0.5, 0.98}};
    const wo_context context = WO_CONTEXT_INIT;
    for (size_t i = 0; i < (size_t)cases_of(WO_COUNT(bars), 1); i++) {
        const wo_footage_options options = {
            .scene = bars[i].scene, .width = 240, .height = 135, .samples = 16, .layers = 4};
        wo_footage *set = NULL;
        wo_error error = {WO_OK, ""};
        if (wo_footage_make(&context, &options, &set, &error) != WO_OK)
            fail_msg("%s", error.text);
        check(set, WO_METHOD_RAYS, bars[i].rms, bars[i].within);
        check(set, WO_METHOD_HYBRID, bars[i].rms, bars[i].within);
        wo_footage_destroy(&context, &set);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(scenes)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
