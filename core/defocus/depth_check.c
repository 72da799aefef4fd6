/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "defocus/depth_check.h"

#include <math.h>

/* Renderers write 1e10, 1e30 or infinity where a ray leaves the scene. */
#define HUGE_DEPTH 1e9f
/* m: no scene lies beyond. */
#define NEAREST  1e-3
#define FARTHEST 1e5
/* Part of the samples that says what kind they are: a filter rings, but never in so many pixels. */
#define MANY 0.2
/* All but the noise. */
#define ALL 0.999
/* Part of the pixels with something in them that depth at least covers. */
#define COVERED 0.75
/* Whole numbers below this are kept by floats of 16 bits, too, which above it know no others. */
#define WHOLE_BELOW 1024
/* Different values that a picture of few flat things does not have. */
enum { LEVELS = 32 };
/* Steps of files of 16 bits and of 8. */
#define STEPS 65535.0
/* px */
enum { PIXELS_LEAST = 1024 };

/* Samples by what they can be, with the sign that the reading expects. */
typedef struct facts {
    int64_t pixels;
    int64_t huge; /* HUGE_DEPTH or more */
    int64_t zero, negative, positive;
    int64_t near, far;  /* of the positive: below nearest, beyond farthest of the job */
    int64_t above_one;  /* of the positive */
    int64_t small;      /* of the positive: below WHOLE_BELOW, */
    int64_t fractional; /* and of these no whole number, */
    int64_t between;    /* no multiple of 1/STEPS */
    double low, high;   /* of negative and positive */
} facts;

typedef struct check_job {
    const wo_sheet_source *source;
    wo_rect window; /* has depth */
    bool may_be_sky, part;
    bool shown;              /* only pixels that show something */
    float nearest, farthest; /* samples read as NEAREST and FARTHEST, or the other way round */
    facts *workers;
} check_job;

static const facts nothing = {.low = HUGE_VAL, .high = -HUGE_VAL};

static bool shows(const wo_sheet_source *source, int32_t x, int32_t y)
{
    float c[4];
    (void)wo_read_colour(source->colour, source->alpha, x, y, c);
    return c[3] != 0 || c[0] != 0 || c[1] != 0 || c[2] != 0;
}

static float sign_of(const wo_sheet_source *source)
{
    return source->reading.mode == WO_DEPTH_NEGATIVE ? -1 : 1;
}

static const float *samples_at(const wo_sheet_source *source, int32_t x, int32_t y)
{
    const int last = source->depth->components - 1;
    return wo_image_at(source->depth, x, y) +
           (source->depth_channel < last ? source->depth_channel : last);
}

/* Loops over so many floats side by side, without branches, become vectors. */
enum { LANES = 16, CHUNK = 32 * LANES };

static bool is_known(float s)
{
    return (s != 0) & (fabsf(s) < HUGE_DEPTH);
}

static void add_range(const float samples[CHUNK], facts *to)
{
    float low[LANES], high[LANES];
    for (int k = 0; k < LANES; k++) {
        low[k] = (float)to->low;
        high[k] = (float)to->high;
    }
    for (int i = 0; i < CHUNK; i += LANES)
        for (int k = 0; k < LANES; k++) {
            const float s = is_known(samples[i + k]) ? samples[i + k] : NAN;
            low[k] = s < low[k] ? s : low[k];
            high[k] = s > high[k] ? s : high[k];
        }
    for (int k = 0; k < LANES; k++) {
        to->low = fmin(to->low, (double)low[k]);
        to->high = fmax(to->high, (double)high[k]);
    }
}

/* n samples, with the sign that the reading expects; those behind them become NaN. */
static void add_samples(const check_job *job, float samples[CHUNK], int n, facts *to)
{
    const float nearest = job->nearest, farthest = job->farthest, steps = (float)STEPS;
    int zero = 0, huge = 0, negative = 0, positive = 0, near = 0, far = 0, above_one = 0;
    int small = 0, fractional = 0, between = 0;
    for (int i = n; i < CHUNK; i++)
        samples[i] = NAN;
    add_range(samples, to);
    for (int i = 0; i < CHUNK; i++) {
        const float s = samples[i];
        const int known = is_known(s), above = known & (s > 0);
        const float whole = above & (s < WHOLE_BELOW) ? s : 0;
        const float step = (above & (s <= 1) ? s : 0) * steps;
        zero += s == 0;
        huge += s >= HUGE_DEPTH;
        negative += known & (s < 0);
        positive += above;
        near += above & (s < nearest);
        far += above & (s > farthest);
        above_one += above & (s > 1);
        small += whole > 0;
        fractional += whole != (float)(int)whole;
        between += fabsf(step - (float)(int)(step + 0.5f)) > 0.02f;
    }
    to->pixels += n;
    to->zero += zero;
    to->huge += huge;
    to->negative += negative;
    to->positive += positive;
    to->near += near;
    to->far += far;
    to->above_one += above_one;
    to->small += small;
    to->fractional += fractional;
    to->between += between;
}

static void count_row(void *user, size_t index, unsigned worker)
{
    check_job *job = user;
    const int32_t y = job->window.y1 + (int32_t)index;
    const int32_t stride = job->source->depth->components;
    const float *at = samples_at(job->source, job->window.x1, y);
    const float sign = sign_of(job->source);
    float samples[CHUNK];
    int n = 0;
    for (int32_t x = job->window.x1; x < job->window.x2; x++, at += stride) {
        if (job->shown && !shows(job->source, x, y))
            continue;
        samples[n++] = sign * *at;
        if (n < CHUNK)
            continue;
        add_samples(job, samples, n, &job->workers[worker]);
        n = 0;
    }
    add_samples(job, samples, n, &job->workers[worker]);
}

/* Bounds of what is read as neither too near nor too far, in samples. */
static void set_bounds(check_job *job)
{
    const wo_depth_reading *reading = &job->source->reading;
    const bool inverse = reading->mode == WO_DEPTH_INVERSE;
    job->nearest = (float)(inverse ? 1 / (FARTHEST * reading->scale) : NEAREST * reading->scale);
    job->farthest = (float)(inverse ? 1 / (NEAREST * reading->scale) : FARTHEST * reading->scale);
}

static facts count(const wo_context *context, check_job *job)
{
    const unsigned workers = wo_workers(context);
    facts sum = nothing;
    for (unsigned i = 0; i < workers; i++)
        job->workers[i] = nothing;
    wo_run(context, count_row, job, (size_t)wo_rect_height(job->window));
    for (unsigned i = 0; i < workers; i++) {
        const facts *f = &job->workers[i];
        sum.pixels += f->pixels;
        sum.huge += f->huge;
        sum.zero += f->zero;
        sum.negative += f->negative;
        sum.positive += f->positive;
        sum.near += f->near;
        sum.far += f->far;
        sum.above_one += f->above_one;
        sum.small += f->small;
        sum.fractional += f->fractional;
        sum.between += f->between;
        sum.low = fmin(sum.low, f->low);
        sum.high = fmax(sum.high, f->high);
    }
    return sum;
}

/* Are there many values among the samples between 0 and limit? */
static bool has_levels(const check_job *job, double limit)
{
    float seen[LEVELS];
    int count = 0;
    for (int32_t y = job->window.y1; y < job->window.y2; y++)
        for (int32_t x = job->window.x1; x < job->window.x2; x++) {
            const float s = sign_of(job->source) * *samples_at(job->source, x, y);
            int i = 0;
            if (!(s > 0 && (double)s <= limit))
                continue;
            while (i < count && seen[i] != s)
                i++;
            if (i < count)
                continue;
            seen[count++] = s;
            if (count == LEVELS)
                return true;
        }
    return false;
}

/* What a warning says, in the order in which kinds are looked for. */
typedef enum kind {
    SANE,
    NEGATIVE,
    BOTH_SIGNS,
    ZERO,
    STEPPED,
    UNIT_RANGE,
    WHOLE,
    TOO_FAR,
    TOO_NEAR,
    SKY_IN_INVERSE,
    NOT_NORMALISED
} kind;

static kind kind_of_normalised(const facts *f)
{
    const double known = (double)(f->zero + f->negative + f->positive);
    return (double)(f->negative + f->above_one) > MANY * known ? NOT_NORMALISED : SANE;
}

static kind kind_of(const check_job *job, const facts *f)
{
    const wo_depth_reading *reading = &job->source->reading;
    const double known = (double)(f->negative + f->positive), positive = (double)f->positive;
    if (f->pixels < PIXELS_LEAST)
        return SANE;
    if (reading->mode == WO_DEPTH_NORMALISED)
        return job->part ? SANE : kind_of_normalised(f);
    /* Round what is seen against the sky a filter may leave more noise than that. */
    if (job->part ? (double)f->negative > ALL * known && known > 0.5 * (double)f->pixels
                  : (double)f->negative > MANY * known)
        return (double)f->negative > (1 - MANY) * known ? NEGATIVE : BOTH_SIGNS;
    const bool may_be_sky = job->may_be_sky || job->part;
    if (f->zero == f->pixels && !may_be_sky)
        return ZERO;
    if (reading->mode == WO_DEPTH_INVERSE) {
        if ((double)f->huge > (1 - ALL) * (double)f->pixels)
            return SKY_IN_INVERSE;
    } else if (f->positive > 0 && f->above_one == 0 && reading->scale >= 1) {
        if (f->between == 0 && has_levels(job, 1))
            return STEPPED;
        if (f->high > 0.995 && f->low > 0 && f->low < 0.02)
            return UNIT_RANGE;
    }
    if (f->small >= PIXELS_LEAST && f->fractional == 0 && has_levels(job, WHOLE_BELOW))
        return WHOLE;
    const bool inverse = reading->mode == WO_DEPTH_INVERSE;
    const double far = (double)(inverse ? f->near : f->far);
    const double near = (double)(inverse ? f->far : f->near);
    if (positive > 0 && far >= ALL * positive && !may_be_sky)
        return TOO_FAR;
    if (positive > 0 && near >= ALL * positive && !job->part)
        return TOO_NEAR;
    return SANE;
}

static void warn(const check_job *job, const facts *f, const char *name, wo_report *report)
{
    const wo_depth_reading *reading = &job->source->reading;
    const bool flipped = reading->mode == WO_DEPTH_NEGATIVE;
    const double low = flipped ? -f->high : f->low, high = flipped ? -f->low : f->high;
    const double known = (double)(f->negative + f->positive);
    const double negative = 100 * (double)f->negative / known;
    switch (kind_of(job, f)) {
    case SANE:
        break;
    case NEGATIVE:
        wo_report_warn(report, "depth-negative",
                       "%s: %.0f %% of the depth is %s (%.4g .. %.4g), which is read as infinitely "
                       "far; %s",
                       name, negative, flipped ? "positive" : "negative", low, high,
                       flipped ? "--set depthMode=distance"
                               : "--set depthMode=negative for z in camera space");
        break;
    case BOTH_SIGNS:
        wo_report_warn(report, "depth-negative",
                       "%s: %.0f %% of the depth is %s (%.4g .. %.4g), which is read as infinitely "
                       "far; is it the channel that holds the depth?",
                       name, negative, flipped ? "positive" : "negative", low, high);
        break;
    case ZERO:
        wo_report_warn(report, "depth-zero",
                       "%s: the depth is 0 everywhere, which is read as infinitely far; is it the "
                       "channel that holds the depth? --set useDepth=false where there is none",
                       name);
        break;
    case STEPPED:
    case UNIT_RANGE:
        wo_report_warn(
            report, "depth-normalised",
            "%s: the depth goes from %.4g to %.4g %s, and is read as a distance; --set "
            "depthMode=normalised with near and far in metres (far is where it is 1), or "
            "depthMode=inverse with depthScale where white is near",
            name, low, high,
            kind_of(job, f) == STEPPED ? "in steps of a file of whole numbers"
                                       : "as normalised or estimated depth does");
        break;
    case WHOLE:
        wo_report_warn(
            report, "depth-whole",
            "%s: all depth is whole numbers (%.4g .. %.4g), as sensors and files of whole "
            "numbers give, at %g to the metre; --set depthScale=1000 for millimetres, 100 "
            "for centimetres",
            name, low, high, reading->scale);
        break;
    case TOO_FAR:
        wo_report_warn(
            report, "depth-far",
            "%s: all depth (%.4g .. %.4g) is read as farther than %g km; --set depthScale "
            "says how many units make a metre: 1000 for millimetres, 100 for centimetres",
            name, low, high, FARTHEST / 1000);
        break;
    case TOO_NEAR:
        wo_report_warn(
            report, "depth-near",
            "%s: all depth (%.4g .. %.4g) is read as nearer than %g mm; --set depthScale "
            "says how many units make a metre: 1 for metres, 0.001 for kilometres",
            name, low, high, NEAREST * 1000);
        break;
    case SKY_IN_INVERSE:
        wo_report_warn(
            report, "depth-inverse",
            "%s: %.2g %% of it is %g or more, as the sky is where depth is distance, and "
            "is read as touching the lens; --set depthMode=distance",
            name, 100 * (double)f->huge / (double)f->pixels, (double)HUGE_DEPTH);
        break;
    case NOT_NORMALISED:
        wo_report_warn(report, "depth-not-normalised",
                       "%s: much of the depth (%.4g .. %.4g) is outside 0 .. 1 and cut to near or "
                       "far; --set depthMode=distance",
                       name, low, high);
        break;
    }
}

/* Where a layer shows nothing no depth is missing: data windows of layers are often cut. */
static bool is_covered(const wo_sheet_source *source, wo_rect window, wo_rect inside)
{
    int64_t shown = 0, covered = 0;
    if (wo_rect_contains(inside, window))
        return true;
    for (int32_t y = window.y1; y < window.y2; y++)
        for (int32_t x = window.x1; x < window.x2; x++) {
            const bool here = shows(source, x, y);
            shown += here;
            covered += here && x >= inside.x1 && x < inside.x2 && y >= inside.y1 && y < inside.y2;
        }
    return (double)covered >= COVERED * (double)shown;
}

static void check_size(const wo_sheet_source *source, wo_rect window, wo_rect inside,
                       const char *name, wo_report *report)
{
    const wo_rect b = source->depth->bounds;
    if (!is_covered(source, window, inside))
        wo_report_warn(report, "depth-size",
                       "%s: the depth covers %d,%d .. %d,%d of %d,%d .. %d,%d px; beyond, its edge "
                       "is repeated",
                       name, b.x1, b.y1, b.x2, b.y2, window.x1, window.y1, window.x2, window.y2);
}

wo_status wo_depth_check(const wo_context *context, const wo_sheet_source *source, wo_rect window,
                         const wo_depth_clip *clip, wo_report *report, wo_error *error)
{
    if (!source->depth || !source->depth->data)
        return WO_OK;
    check_job job = {.source = source,
                     .may_be_sky = clip->may_be_sky,
                     .part = clip->part,
                     .window = wo_rect_intersect(window, source->depth->bounds)};
    if (!clip->part)
        check_size(source, window, job.window, clip->name, report);
    if (wo_rect_empty(job.window))
        return WO_OK;
    if (!(job.workers = wo_new(context, error, wo_workers(context), sizeof *job.workers)))
        return WO_ERR_NOMEM;
    set_bounds(&job);
    facts f = count(context, &job);
    if (kind_of(&job, &f) != SANE) {
        job.shown = true;
        f = count(context, &job);
        warn(&job, &f, clip->name, report);
    }
    wo_delete(context, job.workers);
    return WO_OK;
}
