/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "ofx_host_stub/cli/bench.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { RAYS, HYBRID, OTHER, METHODS, SETTINGS = 3 };

typedef struct fixture {
    wo_bench bench;
    wo_bench_shot shots[2];
    wo_bench_point points[2][METHODS * SETTINGS];
} fixture;

/* Two shots of three methods with three settings, of which nothing is done. */
static void begin(fixture *f)
{
    static const char *const names[METHODS] = {"rays", "hybrid", "other"};
    static const double values[SETTINGS] = {16, 64, 256};
    *f = (fixture){.bench = {.plugin = "test",
                             .runs = 1,
                             .time_tolerance = 0.1,
                             .method_count = METHODS,
                             .setting_count = SETTINGS,
                             .judged = HYBRID,
                             .base = RAYS,
                             .base_setting = 2,
                             .shot_count = 2}};
    f->bench.shots = f->shots;
    for (int m = 0; m < METHODS; m++)
        snprintf(f->bench.method[m], sizeof f->bench.method[m], "%s", names[m]);
    for (int s = 0; s < SETTINGS; s++) {
        f->bench.setting[s].value = values[s];
        snprintf(f->bench.setting[s].text, sizeof f->bench.setting[s].text, "%g", values[s]);
    }
    for (int i = 0; i < 2; i++) {
        f->shots[i] = (wo_bench_shot){.layers = i == 0,
                                      .state = WO_BENCH_DONE,
                                      .noise = NAN,
                                      .width = 4,
                                      .height = 3,
                                      .points = f->points[i]};
        snprintf(f->shots[i].scene, sizeof f->shots[i].scene, "odd<%d>&", i);
    }
}

static void done(fixture *f, int shot, int method, int setting, double seconds, double rmse)
{
    f->points[shot][method * SETTINGS + setting] = (wo_bench_point){
        .state = WO_BENCH_DONE,
        .runs = 1,
        .seconds = seconds,
        .own_seconds = NAN,
        .rays = NAN,
        .rmse = rmse,
        .ssim = 1,
        .estimate = NAN,
        .sampling = NAN,
        .ratio = {NAN},
    };
}

/* Rays: four times the time halve the error. */
static void fill_rays(fixture *f, int shot)
{
    done(f, shot, RAYS, 0, 1, 0.04);
    done(f, shot, RAYS, 1, 4, 0.02);
    done(f, shot, RAYS, 2, 16, 0.01);
}

static void test_front(void **state)
{
    (void)state;
    fixture f;
    begin(&f);
    fill_rays(&f, 0);
    done(&f, 0, HYBRID, 0, 1.05, 0.05); /* within the tolerance of time */
    done(&f, 0, HYBRID, 1, 5, 0.02);    /* as good, but later */
    done(&f, 0, HYBRID, 2, 5, 0.0199);  /* better than what is faster */
    const wo_bench_shot *const shot = &f.shots[0];
    assert_int_equal(wo_bench_beaten(&f.bench, shot, HYBRID * SETTINGS + 0), -1);
    assert_int_equal(wo_bench_beaten(&f.bench, shot, HYBRID * SETTINGS + 1), RAYS * SETTINGS + 1);
    assert_int_equal(wo_bench_beaten(&f.bench, shot, HYBRID * SETTINGS + 2), -1);
    assert_false(wo_bench_on_front(&f.bench, shot, HYBRID * SETTINGS + 0));
    assert_false(wo_bench_on_front(&f.bench, shot, HYBRID * SETTINGS + 1));
    assert_true(wo_bench_on_front(&f.bench, shot, HYBRID * SETTINGS + 2));
    for (int s = 0; s < SETTINGS; s++)
        assert_true(wo_bench_on_front(&f.bench, shot, RAYS * SETTINGS + s));
    /* Points that are not done are on no front and beat nobody. */
    assert_false(wo_bench_on_front(&f.bench, shot, OTHER * SETTINGS));
    f.points[0][RAYS * SETTINGS + 1].state = WO_BENCH_FAILED;
    assert_int_equal(wo_bench_beaten(&f.bench, shot, HYBRID * SETTINGS + 1), -1);
    /* Nobody is beaten by settings of his own. */
    done(&f, 0, HYBRID, 0, 100, 1);
    f.points[0][RAYS * SETTINGS].state = WO_BENCH_FAILED;
    f.points[0][RAYS * SETTINGS + 2].state = WO_BENCH_FAILED;
    assert_int_equal(wo_bench_beaten(&f.bench, shot, HYBRID * SETTINGS + 0), -1);
}

static void check_near(double value, double expected)
{
    if (!(fabs(value - expected) <= 1e-9 * fabs(expected)))
        fail_msg("%.12g instead of %.12g", value, expected);
}

static void test_time_at(void **state)
{
    (void)state;
    fixture f;
    begin(&f);
    const wo_bench_shot *const shot = &f.shots[0];
    assert_true(isnan(wo_bench_time_at(&f.bench, shot, RAYS, 0.1)));
    fill_rays(&f, 0);
    const double slack = 1 + WO_BENCH_REACHED;
    check_near(wo_bench_time_at(&f.bench, shot, RAYS, 0.5), 1);
    check_near(wo_bench_time_at(&f.bench, shot, RAYS, 0.02 / slack), 4);
    check_near(wo_bench_time_at(&f.bench, shot, RAYS, 0.01 * sqrt(2) / slack), 8);
    assert_true(wo_bench_time_at(&f.bench, shot, RAYS, 0.0101 / slack) < 16);
    assert_true(isinf(wo_bench_time_at(&f.bench, shot, RAYS, 0.0099 / slack)));
    /* Slower and worse points of its own do not bend the curve. */
    done(&f, 0, OTHER, 0, 1, 0.04);
    done(&f, 0, OTHER, 1, 3, 0.9);
    done(&f, 0, OTHER, 2, 4, 0.02);
    check_near(wo_bench_time_at(&f.bench, shot, OTHER, 0.02 * sqrt(2) / slack), 2);
    /* No error at all. */
    done(&f, 0, OTHER, 2, 4, 0);
    check_near(wo_bench_time_at(&f.bench, shot, OTHER, 0.02), 4);
}

static void test_verdict(void **state)
{
    (void)state;
    fixture f;
    begin(&f);
    done(&f, 0, HYBRID, 0, 2, 0.02);
    assert_int_equal(wo_bench_judge(&f.bench, &f.shots[0]).points, 0); /* against nobody */
    fill_rays(&f, 0);
    done(&f, 0, HYBRID, 1, 8, 0.01 * (1 + WO_BENCH_REACHED));
    wo_bench_verdict verdict = wo_bench_judge(&f.bench, &f.shots[0]);
    assert_int_equal(verdict.points, 2);
    assert_int_equal(verdict.unbeaten, 2);
    check_near(verdict.share, 0.5);
    done(&f, 0, HYBRID, 2, 30, 0.03);
    verdict = wo_bench_judge(&f.bench, &f.shots[0]);
    assert_int_equal(verdict.points, 3);
    assert_int_equal(verdict.unbeaten, 2);

    fill_rays(&f, 1);
    done(&f, 1, HYBRID, 0, 2, 0.02); /* never comes to 0.01 */
    assert_true(isinf(wo_bench_judge(&f.bench, &f.shots[1]).share));
    const wo_bench_summary layers = wo_bench_sum(&f.bench, true);
    assert_int_equal(layers.shots, 1);
    assert_int_equal(layers.on_front, 0);
    assert_int_equal(layers.compared, 1);
    assert_int_equal(layers.halved, 1);
    const wo_bench_summary sd = wo_bench_sum(&f.bench, false);
    assert_int_equal(sd.shots, 1);
    assert_int_equal(sd.on_front, 1);
    assert_int_equal(sd.compared, 1);
    assert_int_equal(sd.halved, 0);

    f.bench.judged = RAYS; /* the one that is compared with: no share */
    assert_true(isnan(wo_bench_judge(&f.bench, &f.shots[0]).share));
    f.bench.judged = -1;
    assert_int_equal(wo_bench_sum(&f.bench, true).shots, 0);
}

static void test_calibration(void **state)
{
    (void)state;
    static const double ratios[] = {1, 1.24, 1.26, 0.81, 0.79, NAN, INFINITY};
    fixture f;
    begin(&f);
    assert_int_equal(wo_bench_calibrate(&f.bench, -1).renders, 0);
    assert_true(isnan(wo_bench_calibrate(&f.bench, -1).median));
    done(&f, 0, HYBRID, 0, 1, 1);
    wo_bench_point *const p = &f.points[0][HYBRID * SETTINGS];
    p->runs = WO_COUNT(ratios);
    memcpy(p->ratio, ratios, sizeof ratios);
    done(&f, 1, RAYS, 0, 1, 1);
    f.points[1][0].ratio[0] = 1;
    wo_bench_calibration c = wo_bench_calibrate(&f.bench, HYBRID);
    assert_int_equal(c.renders, 6);
    assert_int_equal(c.within, 3);
    assert_true(c.low == 0.79 && isinf(c.high));
    check_near(c.median, 1.12);
    c = wo_bench_calibrate(&f.bench, -1);
    assert_int_equal(c.renders, 7);
    assert_int_equal(c.within, 4);
    assert_true(c.median == 1);
}

static char *written(void (*write)(const wo_bench *, FILE *), const wo_bench *bench)
{
    char *text = NULL;
    size_t length = 0;
    FILE *const out = open_memstream(&text, &length);
    assert_non_null(out);
    write(bench, out);
    assert_int_equal(fclose(out), 0);
    return text;
}

static void page(const wo_bench *bench, FILE *out)
{
    assert_int_equal(wo_bench_page(bench, out, NULL), WO_OK);
}

/* Whatever is there, NaN and infinity among it, all of it can be written. */
static void test_written(void **state)
{
    (void)state;
    fixture f;
    begin(&f);
    for (int i = 0; i < 4; i++) {
        if (i == 1)
            fill_rays(&f, 0);
        if (i == 2) {
            done(&f, 0, HYBRID, 0, 0, 0);
            done(&f, 0, HYBRID, 1, 1e-12, 1e12);
            f.points[0][OTHER * SETTINGS].state = WO_BENCH_FAILED;
            snprintf(f.points[0][OTHER * SETTINGS].why, 256, "a <b> & \"c\", d");
        }
        if (i == 3) {
            f.shots[1].state = WO_BENCH_FAILED;
            snprintf(f.shots[1].why, 256, "no <such> file");
        }
        char *json = written(wo_bench_json, &f.bench);
        assert_true(wo_json_valid(json));
        char *html = written(page, &f.bench);
        assert_null(strstr(html, "<b>"));
        assert_null(strstr(html, "odd<"));
        assert_null(strstr(html, "<such>"));
        assert_null(strstr(html, "nan"));
        char *csv = written(wo_bench_csv, &f.bench);
        assert_null(strstr(csv, "nan"));
        assert_null(strstr(csv, "inf"));
        char *table = written(wo_bench_table, &f.bench);
        assert_null(strstr(table, "nan"));
        free(json);
        free(html);
        free(csv);
        free(table);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_front),   cmocka_unit_test(test_time_at),
        cmocka_unit_test(test_verdict), cmocka_unit_test(test_calibration),
        cmocka_unit_test(test_written),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
