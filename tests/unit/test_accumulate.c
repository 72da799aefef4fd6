/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "defocus/accumulate.h"

#include "near.h"
#include "scenes.h"

#include <string.h>

static const wo_context plain = WO_CONTEXT_INIT;

/* A stack of made-up sheets around a few tiles, and a thin lens of one pencil for all pixels. */
enum { REACH = 30 };
static const wo_rect area = {-128, -64, 192, 72};
static const wo_rect window = {0, 0, 64, 16};

typedef struct field {
    wo_sheet sheet[WO_SHEETS_MAX];
    int sheets;
    double k; /* px per dioptre */
    wo_stack stack;
    wo_thin_pencils *pencils;
    wo_lens lens;
    wo_lens_rays rays;
} field;

static void field_start(field *f, double k)
{
    *f = (field){.k = k};
}

static wo_sheet *field_sheet(field *f)
{
    wo_sheet *sheet = &f->sheet[f->sheets++];
    assert_int_equal(wo_sheet_create(&plain, area, sheet, NULL), WO_OK);
    sheet->any = true;
    return sheet;
}

static void field_finish(field *f, int samples)
{
    static uint8_t opaque[320 * 136];
    const wo_thin_lens lens = {f->k, 0, 1000};
    const wo_aperture aperture = {.aspect = 1};
    assert_int_equal(
        wo_thin_pencils_create(&plain, &lens, &aperture, 1, samples, 7, &f->pencils, NULL), WO_OK);
    f->lens = wo_thin_pencils_lens(f->pencils);
    f->lens.sets = 1;
    for (size_t i = 0; i < sizeof opaque; i++) {
        double left = 1;
        for (int s = 0; s < f->sheets; s++)
            left *= f->sheet[s].guessed ? 1 : 1 - (double)f->sheet[s].c[i][3];
        opaque[i] = left < 1e-3;
    }
    assert_int_equal(wo_stack_create(&plain, f->sheet, (size_t)f->sheets, opaque, area, area,
                                     &f->stack, NULL),
                     WO_OK);
    assert_int_equal(
        wo_lens_rays_create(&plain, &f->stack, &f->lens, window, REACH, &f->rays, NULL), WO_OK);
}

static void field_free(field *f)
{
    wo_lens_rays_destroy(&plain, &f->rays);
    wo_stack_destroy(&plain, &f->stack);
    wo_thin_pencils_destroy(&plain, &f->pencils);
    for (int s = 0; s < f->sheets; s++)
        wo_sheet_destroy(&plain, &f->sheet[s]);
}

/* One random sheet: a base, a slope, steps, gaps and coverage of some kind; vergences up to
   limit. */
static void random_sheet(wo_sheet *sheet, rng *r, double limit, bool opaque)
{
    const double base = rng_range(r, -limit, limit);
    const double slope_x = rng_unit(r) < 0.5 ? rng_range(r, -limit, limit) / 20 : 0;
    const double slope_y = rng_unit(r) < 0.5 ? rng_range(r, -limit, limit) / 20 : 0;
    const double step = rng_unit(r) < 0.4 ? rng_range(r, 0, limit) : 0;
    const double rough = rng_unit(r) < 0.3 ? rng_range(r, 0, limit) * 0.1 : 0;
    const double gaps = opaque || rng_unit(r) < 0.3 ? 0 : rng_range(r, 0, 0.9);
    const int32_t size = rng_int(r, 1, 9);
    const bool partial = !opaque && rng_unit(r) < 0.5;
    const uint64_t salt = rng_bits(r);
    const int32_t w = wo_rect_width(area);
    for (int32_t i = 0; i < w * wo_rect_height(area); i++) {
        rng patch = {salt + (uint64_t)(i / w / size) * 977 + (uint64_t)(i % w / size)};
        const double v = base + slope_x * (i % w - 128) + slope_y * ((double)(i / w) - 64) +
                         step * rng_range(&patch, -1, 1) + rough * rng_range(r, -1, 1);
        const bool gap = rng_unit(&patch) < gaps;
        sheet->v[i] = gap ? NAN : (float)fmin(fmax(v, -limit), limit);
        const float a = gap ? 0 : partial ? (float)rng_range(r, 0, 0.95) : 1;
        for (int k = 0; k < 3; k++)
            sheet->c[i][k] = a * (float)rng_unit(r);
        sheet->c[i][3] = a;
    }
}

/* All pixels of a window by one method. */
typedef struct result {
    float c[16 * 64][4];
    float guessed[16 * 64];
    float error[16 * 64];
    wo_report report;
} result;

static wo_status run_with(const field *f, const wo_renderer *method, const wo_context *context,
                          wo_quality quality, result *out)
{
    const wo_highlights none = {0};
    const wo_defocus job = {context, &f->stack, &f->lens, &none, &f->rays, quality};
    const wo_frame frame = {.window = window,
                            .tiles = wo_tiles_of(window),
                            .c = out->c,
                            .guessed = out->guessed,
                            .error = out->error};
    memset(out, 0, sizeof *out);
    return method->render(&job, &frame, &out->report, NULL);
}

static void run(const field *f, const wo_renderer *method, result *out)
{
    const wo_quality quality = {.samples = f->lens.count};
    assert_int_equal(run_with(f, method, &plain, quality, out), WO_OK);
}

/* Fraction of pixels that differ by more than limit in colour or coverage. */
static double different(const result *a, const result *b, double limit)
{
    int count = 0;
    for (int i = 0; i < 16 * 64; i++) {
        double most = 0;
        for (int k = 0; k < 4; k++)
            most = fmax(most, fabs((double)a->c[i][k] - (double)b->c[i][k]));
        count += !(most <= limit);
    }
    return count / (16.0 * 64);
}

static result got, want;

static void views_agree_with_brute_force(void **state)
{
    (void)state;
    rng r = {3};
    for (int try = 0; try < 40; try++) {
        field f;
        field_start(&f, pow(10, rng_range(&r, -1, 3)));
        const int sheets = 1 + try % 5;
        const double radius = (double[]){0.4, 2, 8, REACH}[try / 5 % 4];
        for (int s = 0; s < sheets; s++) {
            random_sheet(field_sheet(&f), &r, radius / f.k, s == sheets - 1);
            f.sheet[s].guessed = s > 0 && s % 3 == 0;
        }
        for (int samples = 1; samples < 8; samples += 6) {
            field_finish(&f, samples);
            run(&f, &wo_render_accumulate, &got);
            run(&f, &wo_render_reference, &want);
            if (different(&got,&want,1e-3) > .002 && sheets > 1) {
              for (unsigned m=1;m<(1u<<sheets);m++) { if (!(m>>(sheets-1)&1)) continue;
                field h; field_start(&h, f.k);
                for (int s=0;s<sheets;s++) if (m>>s&1) { h.sheet[h.sheets++]=f.sheet[s]; }
                field_finish(&h, samples); static result g2,w2;
                run(&h,&wo_render_accumulate,&g2); run(&h,&wo_render_reference,&w2);
                double dd=different(&g2,&w2,1e-3);
                if (dd>.001) { print_message("   mask %x: %g", m, dd);
                 for(int i=0;i<1024;i++){double d=0; for(int k=0;k<4;k++) d=fmax(d,fabs((double)(g2.c[i][k]-w2.c[i][k]))); if(d>1e-3){print_message(" px %d,%d got %g %g a %g want %g %g a %g\n",i%64,i/64,(double)g2.c[i][0],(double)g2.c[i][1],(double)g2.c[i][3],(double)w2.c[i][0],(double)w2.c[i][1],(double)w2.c[i][3]);
                for(int s=0;s<h.sheets;s++) { ptrdiff_t at=(ptrdiff_t)(i/64+64)*320+i%64+128; print_message("    s%d d %g c %g %g a %g |", s, f.k*(double)h.sheet[s].v[at], (double)h.sheet[s].c[at][0],(double)h.sheet[s].c[at][1],(double)h.sheet[s].c[at][3]); for(int e=-1;e<=1;e++) for(int q=-1;q<=1;q++) print_message(" %.2f/%.2g/%.2f", f.k*(double)h.sheet[s].v[at+e*320+q], (double)h.sheet[s].c[at+e*320+q][3],(double)h.sheet[s].c[at+e*320+q][0]); print_message("\n"); }
 { wo_pencil pc; wo_pencil_room room; f.lens.pencil(f.lens.self,32,4,0,0,&room,&pc); for(int q=0;q<samples;q++) print_message("   ray b/k %g %g\n",(double)pc.bx[q]/f.k,(double)pc.by[q]/f.k);}
break;}} m=1u<<sheets; }
                wo_lens_rays_destroy(&plain, &h.rays);
            wo_stack_destroy(&plain, &h.stack);
            wo_thin_pencils_destroy(&plain, &h.pencils);
              } }
            print_message("%d sheets radius %g n %d: %g\n", sheets, radius, samples, different(&got, &want, 1e-3));
            wo_lens_rays_destroy(&plain, &f.rays);
            wo_stack_destroy(&plain, &f.stack);
            wo_thin_pencils_destroy(&plain, &f.pencils);
        }
        field_free(&f);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(views_agree_with_brute_force),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
