/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "bench.h"

#include <math.h>
#include <stdlib.h>

const wo_bench_point *wo_bench_at(const wo_bench *bench, const wo_bench_shot *shot, int method,
                                  int setting)
{
    return &shot->points[method * bench->setting_count + setting];
}

const char *wo_bench_given(const wo_bench_shot *shot)
{
    return shot->layers ? "layers" : "sd";
}

const char *wo_bench_state_text(wo_bench_state state)
{
    static const char *const texts[] = {"waiting", "done", "failed", "left out"};
    return texts[state];
}

double wo_bench_psnr(double rmse)
{
    return -20 * log10(rmse);
}

static int point_count(const wo_bench *bench)
{
    return bench->method_count * bench->setting_count;
}

static bool is_done(const wo_bench_shot *shot, int point)
{
    return shot->points[point].state == WO_BENCH_DONE;
}

int wo_bench_beaten(const wo_bench *bench, const wo_bench_shot *shot, int point)
{
    const wo_bench_point *const p = &shot->points[point];
    for (int i = 0; i < point_count(bench); i++) {
        const wo_bench_point *const q = &shot->points[i];
        if (is_done(shot, i) && i / bench->setting_count != point / bench->setting_count &&
            q->seconds * (1 + bench->time_tolerance) < p->seconds && q->rmse <= p->rmse)
            return i;
    }
    return -1;
}

bool wo_bench_on_front(const wo_bench *bench, const wo_bench_shot *shot, int point)
{
    const wo_bench_point *const p = &shot->points[point];
    for (int i = 0; i < point_count(bench); i++) {
        const wo_bench_point *const q = &shot->points[i];
        if (is_done(shot, i) && q->seconds <= p->seconds && q->rmse <= p->rmse &&
            (q->seconds < p->seconds || q->rmse < p->rmse))
            return false;
    }
    return is_done(shot, point);
}

static int by_time(const void *a, const void *b)
{
    const wo_bench_point *const p = *(const wo_bench_point *const *)a;
    const wo_bench_point *const q = *(const wo_bench_point *const *)b;
    if (p->seconds != q->seconds)
        return p->seconds < q->seconds ? -1 : 1;
    return (p->rmse > q->rmse) - (p->rmse < q->rmse);
}

double wo_bench_time_at(const wo_bench *bench, const wo_bench_shot *shot, int method, double error)
{
    const wo_bench_point *points[WO_BENCH_SETTINGS];
    size_t count = 0;
    for (int i = 0; i < bench->setting_count; i++) {
        const wo_bench_point *const p = wo_bench_at(bench, shot, method, i);
        if (p->state == WO_BENCH_DONE)
            points[count++] = p;
    }
    if (count == 0)
        return NAN;
    qsort(points, count, sizeof points[0], by_time);
    const double enough = error * (1 + WO_BENCH_REACHED);
    const wo_bench_point *best = NULL; /* so far */
    for (size_t i = 0; i < count; i++) {
        const wo_bench_point *const p = points[i];
        if (p->rmse <= enough) {
            if (!best || !(p->rmse > 0))
                return p->seconds;
            const double part = log(best->rmse / enough) / log(best->rmse / p->rmse);
            return best->seconds * pow(p->seconds / best->seconds, part);
        }
        if (!best || p->rmse < best->rmse)
            best = p;
    }
    return INFINITY;
}

/* Is there anything to be held against? */
static bool has_rivals(const wo_bench *bench, const wo_bench_shot *shot)
{
    for (int i = 0; i < point_count(bench); i++)
        if (is_done(shot, i) && i / bench->setting_count != bench->judged)
            return true;
    return false;
}

wo_bench_verdict wo_bench_judge(const wo_bench *bench, const wo_bench_shot *shot)
{
    wo_bench_verdict verdict = {.share = NAN};
    if (bench->judged < 0 || shot->state != WO_BENCH_DONE || !has_rivals(bench, shot))
        return verdict;
    for (int i = 0; i < bench->setting_count; i++) {
        const int point = bench->judged * bench->setting_count + i;
        verdict.points += is_done(shot, point);
        verdict.unbeaten += is_done(shot, point) && wo_bench_beaten(bench, shot, point) < 0;
    }
    if (bench->base < 0 || bench->base == bench->judged)
        return verdict;
    const wo_bench_point *const base = wo_bench_at(bench, shot, bench->base, bench->base_setting);
    if (base->state == WO_BENCH_DONE && verdict.points > 0)
        verdict.share = wo_bench_time_at(bench, shot, bench->judged, base->rmse) / base->seconds;
    return verdict;
}

wo_bench_summary wo_bench_sum(const wo_bench *bench, bool layers)
{
    wo_bench_summary sum = {0};
    for (int i = 0; i < bench->shot_count; i++) {
        const wo_bench_shot *const shot = &bench->shots[i];
        if (shot->layers != layers || shot->state != WO_BENCH_DONE)
            continue;
        const wo_bench_verdict verdict = wo_bench_judge(bench, shot);
        if (verdict.points == 0)
            continue;
        sum.shots++;
        sum.on_front += verdict.unbeaten == verdict.points;
        sum.compared += !isnan(verdict.share);
        sum.halved += verdict.share <= 0.5;
    }
    return sum;
}

static int by_value(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

wo_bench_calibration wo_bench_calibrate(const wo_bench *bench, int method)
{
    wo_bench_calibration result = {.low = NAN, .median = NAN, .high = NAN};
    const size_t most = (size_t)bench->shot_count * (size_t)point_count(bench) * WO_BENCH_RUNS;
    double *const ratios = malloc((most + 1) * sizeof *ratios);
    if (!ratios)
        return result;
    int count = 0;
    for (int s = 0; s < bench->shot_count; s++) {
        const wo_bench_shot *const shot = &bench->shots[s];
        for (int i = 0; shot->points && i < point_count(bench); i++) {
            if (!is_done(shot, i) || (method >= 0 && i / bench->setting_count != method))
                continue;
            for (int run = 0; run < shot->points[i].runs; run++)
                if (!isnan(shot->points[i].ratio[run]))
                    ratios[count++] = shot->points[i].ratio[run];
        }
    }
    qsort(ratios, (size_t)count, sizeof *ratios, by_value);
    result.renders = count;
    for (int i = 0; i < count; i++)
        result.within += ratios[i] <= WO_BENCH_CALIBRATED && ratios[i] >= 1 / WO_BENCH_CALIBRATED;
    if (count > 0) {
        result.low = ratios[0];
        result.high = ratios[count - 1];
        result.median = 0.5 * (ratios[(count - 1) / 2] + ratios[count / 2]);
    }
    free(ratios);
    return result;
}

int wo_bench_failures(const wo_bench *bench)
{
    int count = 0;
    for (int s = 0; s < bench->shot_count; s++) {
        const wo_bench_shot *const shot = &bench->shots[s];
        count += shot->state == WO_BENCH_FAILED;
        for (int i = 0; shot->points && i < point_count(bench); i++)
            count += shot->points[i].state == WO_BENCH_FAILED;
    }
    return count;
}
