/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "effects/lens_blur_views.h"

#include <math.h>
#include <string.h>

static void show(double value, float out[4])
{
    out[0] = out[1] = out[2] = (float)value;
    out[3] = 1;
}

/* Vergence from the focus of the nearest surface that was given, or NaN. */
static float nearest_surface(const wo_stack *stack, int32_t x, int32_t y)
{
    const ptrdiff_t at = wo_stack_at(stack, x, y);
    float v = NAN;
    for (int s = 0; s < stack->sheets; s++)
        if (!stack->guessed[s] && stack->v[s][at] == stack->v[s][at] && !(stack->v[s][at] <= v))
            v = stack->v[s][at];
    return v;
}

static void image(const wo_plan *plan, const wo_frame *frame, int32_t x, int32_t y, float out[4])
{
    (void)plan;
    memcpy(out, frame->c[wo_frame_at(frame, x, y)], 4 * sizeof *out);
}

static void circle_of_confusion(const wo_plan *plan, const wo_frame *frame, int32_t x, int32_t y,
                                float out[4])
{
    (void)frame;
    const float v = nearest_surface(&plan->stack, x, y);
    show(isnan(v) ? 0 : plan->setup.lens.k * (double)v, out);
}

static void depth(const wo_plan *plan, const wo_frame *frame, int32_t x, int32_t y, float out[4])
{
    (void)frame;
    const double v = (double)nearest_surface(&plan->stack, x, y) + plan->focus.v_axis;
    show(v > 1e-9 ? 1 / v : 0, out);
}

static void rays(const wo_plan *plan, const wo_frame *frame, int32_t x, int32_t y, float out[4])
{
    (void)plan;
    show((double)frame->rays[wo_frame_at(frame, x, y)], out);
}

static void error(const wo_plan *plan, const wo_frame *frame, int32_t x, int32_t y, float out[4])
{
    (void)plan;
    const float e = frame->error[wo_frame_at(frame, x, y)];
    show(isnan(e) ? 0 : (double)e, out);
}

static void guessed(const wo_plan *plan, const wo_frame *frame, int32_t x, int32_t y, float out[4])
{
    (void)plan;
    show((double)frame->guessed[wo_frame_at(frame, x, y)], out);
    out[3] = out[0];
}

static void split(const wo_plan *plan, const wo_frame *frame, int32_t x, int32_t y, float out[4])
{
    (void)frame;
    const wo_rect w = plan->window;
    const size_t at = (size_t)(y - w.y1) * (size_t)wo_rect_width(w) + (size_t)(x - w.x1);
    show(plan->split ? 0.5 * plan->split[at] : 0, out);
    out[3] = out[0];
}

/* Up to this radius of blur a surface counts as in focus, px. */
#define IN_FOCUS_PX 0.5

/* Blue in front of the focus, green in it, red behind, over the picture's luminance. */
static void focus_plane(const wo_plan *plan, const wo_frame *frame, int32_t x, int32_t y,
                        float out[4])
{
    (void)frame;
    float c[4];
    const double px = plan->setup.lens.k * (double)nearest_surface(&plan->stack, x, y);
    (void)wo_read_colour(&plan->source, plan->source_alpha, x, y, c);
    const float grey = fminf(fmaxf(0.2126f * c[0] + 0.7152f * c[1] + 0.0722f * c[2], 0), 1);
    show(0.5 * (double)grey, out);
    if (!isnan(px))
        out[px > IN_FOCUS_PX ? 2 : px < -IN_FOCUS_PX ? 0 : 1] += 0.1f + 0.4f * grey;
}

static void mask(const wo_plan *plan, const wo_frame *frame, int32_t x, int32_t y, float out[4])
{
    (void)plan;
    show((double)frame->mask[wo_frame_at(frame, x, y)], out);
}

/* Of half the format's height: the radius that the aperture is shown with. */
#define APERTURE_SHOWN 0.9

/* The aperture as the photographer sees it, brightest where most light comes through. */
static void aperture(const wo_plan *plan, const wo_frame *frame, int32_t x, int32_t y, float out[4])
{
    (void)frame;
    enum { FINE = 4 }; /* points a pixel, each way */
    const wo_rect f = plan->geometry.format;
    const double stretch = plan->geometry.pixel_stretch;
    const double radius =
        0.5 * APERTURE_SHOWN * fmin(wo_rect_height(f) / stretch, wo_rect_width(f));
    double sum = 0;
    for (int i = 0; i < FINE * FINE; i++) {
        const double px = x + (i % FINE + 0.5) / FINE - 0.5 * (f.x1 + f.x2);
        const double py = y + (i / FINE + 0.5) / FINE - 0.5 * (f.y1 + f.y2);
        sum += wo_aperture_density(&plan->aperture, px / radius, py / (radius * stretch));
    }
    show(sum / (FINE * FINE) * plan->aperture_scale, out);
}

const wo_view wo_views[WO_OUTPUT_COUNT] = {
    [WO_OUTPUT_IMAGE] = {true, image},        [WO_OUTPUT_COC] = {false, circle_of_confusion},
    [WO_OUTPUT_DEPTH] = {false, depth},       [WO_OUTPUT_RAYS] = {true, rays},
    [WO_OUTPUT_ERROR] = {true, error},        [WO_OUTPUT_GUESSED] = {true, guessed},
    [WO_OUTPUT_FOCUS] = {false, focus_plane}, [WO_OUTPUT_SPLIT] = {false, split},
    [WO_OUTPUT_MASK] = {true, mask},          [WO_OUTPUT_APERTURE] = {false, aperture},
};
