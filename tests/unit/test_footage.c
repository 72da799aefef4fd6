/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "footage_test.h"

#include "bridge_test.h"
#include "scenes.h"

static void scenes_are_listed(void **state)
{
    (void)state;
    static const char *const wanted[] = {"still-life", "night-lights", "fence", "slanted-plane",
                                         "hair",       "two-planes",   "lamp"};
    for (size_t i = 0; i < WO_COUNT(wanted); i++)
        assert_non_null(wo_footage_scene_find(wanted[i]));
    assert_null(wo_footage_scene_find("still"));
    assert_null(wo_footage_scene_find(NULL));
    size_t count = 0;
    for (const wo_footage_scene *s; (s = wo_footage_scene_at(count)); count++) {
        assert_ptr_equal(wo_footage_scene_find(s->name), s);
        assert_true(strlen(s->help) > 10);
        assert_true(s->width > 0 && s->height > 0 && s->focal_mm > 0 && s->f_stop > 0);
    }
    assert_true(count >= WO_COUNT(wanted));
}

static void bad_options_are_refused(void **state)
{
    (void)state;
    const wo_footage_options good = {.scene = "lamp", .width = 8, .height = 8};
    const struct {
        wo_status status;
        const char *text;
        wo_footage_options options;
    } cases[] = {
        {WO_ERR_NOT_FOUND, "still-life", {.scene = "nowhere"}},
        {WO_ERR_NOT_FOUND, "night-lights", {.scene = NULL}},
        {WO_ERR_RANGE, "width", {.scene = "lamp", .width = -1, .height = 8}},
        {WO_ERR_RANGE, "height", {.scene = "lamp", .width = 8, .height = 70000}},
        {WO_ERR_RANGE, "samples", {.scene = "lamp", .samples = 257}},
        {WO_ERR_RANGE, "layers", {.scene = "lamp", .layers = 9}},
        {WO_ERR_RANGE, "overscan", {.scene = "lamp", .width = 40, .height = 30, .overscan = 4}},
        {WO_ERR_RANGE, "overscan", {.scene = "lamp", .overscan = -1}},
        {WO_ERR_RANGE, "layers", {.scene = "lamp", .layers = -1}},
        {WO_ERR_RANGE, "reference", {.scene = "lamp", .reference_spp = 15}},
        {WO_ERR_RANGE, "f-number", {.scene = "lamp", .f_stop = (double)NAN}},
        {WO_ERR_RANGE, "f-number", {.scene = "lamp", .f_stop = -2}},
        {WO_ERR_RANGE, "focus", {.scene = "lamp", .focus_m = (double)NAN}},
        {WO_ERR_RANGE, "focus", {.scene = "lamp", .focus_m = 0.001}},
        {WO_ERR_RANGE, "focal", {.scene = "lamp", .focal_mm = (double)INFINITY}},
        {WO_ERR_RANGE, "blades", {.scene = "lamp", .blades = 2}},
        {WO_ERR_RANGE, "rotation", {.scene = "lamp", .rotation = (double)NAN}},
    };
    for (size_t i = 0; i < WO_COUNT(cases); i++) {
        wo_error error = {0};
        wo_footage *set = (wo_footage *)&error;
        const wo_status status = wo_footage_make(NULL, &cases[i].options, &set, &error);
        assert_int_equal(status, cases[i].status);
        assert_null(set);
        if (!strstr(error.text, cases[i].text))
            fail_msg("\"%s\" does not say \"%s\"", error.text, cases[i].text);
    }
    wo_footage *set = make_set(&good, 1);
    assert_int_equal(set->options.samples, 32);
    assert_null(set->reference.data);
    assert_int_equal(set->layer_count, 0);
    free_set(&set);
    assert_null(set);
    free_set(&set);
}

static void sizes_follow_the_scene(void **state)
{
    (void)state;
    const wo_footage_scene *const scene = wo_footage_scene_find("lamp");
    wo_footage *set = make_set(&(wo_footage_options){.scene = "lamp", .samples = 1}, 1);
    assert_int_equal(set->options.width, scene->width);
    assert_int_equal(set->options.height, scene->height);
    free_set(&set);
    set = make_set(&(wo_footage_options){.scene = "lamp", .samples = 1, .width = 32}, 1);
    assert_int_equal(set->options.height, 18);
    free_set(&set);
    set = make_set(&(wo_footage_options){.scene = "lamp", .samples = 1, .height = 9}, 1);
    assert_int_equal(set->options.width, 16);
    free_set(&set);
}

static bool same_set(const wo_footage *a, const wo_footage *b)
{
    bool same = same_bytes(&a->colour, &b->colour) && same_bytes(&a->depth, &b->depth) &&
                same_bytes(&a->normal, &b->normal) && same_bytes(&a->reference, &b->reference) &&
                same_bytes(&a->reference_error, &b->reference_error) &&
                a->noise_psnr == b->noise_psnr && a->layer_count == b->layer_count &&
                a->umbra_dropped == b->umbra_dropped && a->deeper_dropped == b->deeper_dropped;
    for (int k = 0; k < a->layer_count && same; k++)
        same = same_bytes(&a->layer[k], &b->layer[k]) &&
               same_bytes(&a->layer_depth[k], &b->layer_depth[k]) &&
               a->layer_pixels[k] == b->layer_pixels[k];
    return same;
}

/* The same bytes whatever the threads; another seed gives other bytes. */
static void threads_do_not_matter_seeds_do(void **state)
{
    (void)state;
    static const char *const names[] = {"fence", "night-lights"};
    for (size_t i = 0; i < WO_COUNT(names); i++) {
        wo_footage_options o = {.scene = names[i],
                                .width = 61,
                                .height = 33,
                                .samples = 7,
                                .layers = 3,
                                .reference_spp = 24,
                                .umbra = i == 1,
                                .seed = 5};
        wo_footage *one = make_set(&o, 1), *some = make_set(&o, i ? 3 : 4);
        assert_true(same_set(one, some));
        o.seed = 6;
        wo_footage *other = make_set(&o, 4);
        assert_false(same_bytes(&one->colour, &other->colour));
        assert_false(same_bytes(&one->reference, &other->reference));
        free_set(&one);
        free_set(&some);
        free_set(&other);
    }
}

/* Inside the frame the overscan changes nothing; beyond it there is more of the scene. */
static void overscan_goes_on(void **state)
{
    (void)state;
    wo_footage_options o = {.scene = "slanted-plane",
                            .width = 64,
                            .height = 36,
                            .samples = 5,
                            .layers = 2,
                            .umbra = true,
                            .reference_spp = 16};
    wo_footage *tight = make_set(&o, 2);
    o.overscan = 3;
    wo_footage *wide = make_set(&o, 2);
    assert_true(wo_rect_equal(wide->frame, tight->colour.bounds));
    assert_true(wo_rect_equal(wide->colour.bounds, wo_rect_grow(wide->frame, 3, 3)));
    assert_true(wo_rect_equal(wide->layer[1].bounds, wide->colour.bounds));
    assert_true(same_bytes(&wide->reference, &tight->reference));
    const size_t row = 4 * sizeof(float) * (size_t)o.width;
    for (int32_t y = 0; y < o.height; y++) {
        assert_memory_equal(wo_image_at(&wide->colour, 0, y), wo_image_at(&tight->colour, 0, y),
                            row);
        assert_memory_equal(wo_image_at(&wide->layer_depth[0], 0, y),
                            wo_image_at(&tight->layer_depth[0], 0, y), row / 4);
    }
    for (int32_t y = -3; y < 0; y++)
        assert_true(*wo_image_at(&wide->depth, -3, y) > 0);
    free_set(&tight);
    free_set(&wide);
}

/* Noise of what the seed leaves alone changes, the picture does not. */
static void seeds_move_samples_too(void **state)
{
    (void)state;
    wo_footage_options o = {.scene = "two-planes", .width = 48, .height = 27, .samples = 4};
    wo_footage *a = make_set(&o, 1);
    o.seed = 1;
    wo_footage *b = make_set(&o, 1);
    assert_false(same_bytes(&a->colour, &b->colour));
    assert_true(same_bytes(&a->depth, &b->depth));
    free_set(&a);
    free_set(&b);
}

typedef struct watch {
    double last;
    int calls;
    int stop_after; /* 0: never */
    bool rising;
} watch;

static void note_progress(void *user, double fraction)
{
    watch *const w = user;
    w->rising = w->rising && fraction > w->last && fraction <= 1;
    w->last = fraction;
    w->calls++;
}

static bool want_stop(void *user)
{
    const watch *const w = user;
    return w->stop_after > 0 && w->calls >= w->stop_after;
}

static void progress_rises_and_aborts(void **state)
{
    (void)state;
    unsigned threads = 4;
    wo_error error = {0};
    wo_footage *set = NULL;
    const wo_footage_options o = {.scene = "fence",
                                  .width = 48,
                                  .height = 27,
                                  .samples = 2,
                                  .layers = 2,
                                  .reference_spp = 16};
    for (int stop_after = 0; stop_after < 400; stop_after = stop_after ? stop_after * 7 : 1) {
        watch w = {.rising = true, .stop_after = stop_after};
        wo_context context = {.runner = wo_threads_runner(&threads),
                              .progress = note_progress,
                              .progress_user = &w,
                              .aborted = want_stop,
                              .abort_user = &w};
        const wo_status status = wo_footage_make(&context, &o, &set, &error);
        assert_true(w.rising);
        if (stop_after == 0) {
            assert_int_equal(status, WO_OK);
            assert_true(w.calls > 10 && w.last > 0.9);
            wo_footage_destroy(&context, &set);
        } else {
            assert_int_equal(status, WO_ABORTED);
            assert_null(set);
        }
    }
}

typedef struct heap {
    int left; /* allocations before one fails */
    int live;
} heap;

static void *heap_get(void *user, size_t bytes)
{
    heap *const h = user;
    if (h->left-- == 0)
        return NULL;
    h->live++;
    return aligned_alloc(WO_ALIGNMENT, (bytes + WO_ALIGNMENT - 1) / WO_ALIGNMENT * WO_ALIGNMENT);
}

static void heap_put(void *user, void *memory)
{
    ((heap *)user)->live -= memory != NULL;
    free(memory);
}

/* Every allocation fails once: no crash, no leak, the right status. */
static void failing_memory_is_survived(void **state)
{
    (void)state;
    const wo_footage_options all[] = {
        {.scene = "lamp", .width = 5, .height = 4, .samples = 1, .layers = 2, .reference_spp = 16},
        {.scene = "two-planes", .width = 3, .height = 2, .samples = 1, .layers = 1, .umbra = true}};
    for (size_t i = 0; i < WO_COUNT(all); i++) {
        wo_status status = WO_ERR_NOMEM;
        int n = 0;
        for (; status != WO_OK && n < 1000; n++) {
            heap h = {.left = n};
            const wo_context context = {.allocator = {&h, heap_get, heap_put}};
            wo_error error = {0};
            wo_footage *set = NULL;
            status = wo_footage_make(&context, &all[i], &set, &error);
            if (status != WO_OK) {
                assert_int_equal(status, WO_ERR_NOMEM);
                assert_null(set);
                assert_int_equal(error.status, WO_ERR_NOMEM);
            }
            wo_footage_destroy(&context, &set);
            assert_int_equal(h.live, 0);
        }
        assert_int_equal(status, WO_OK);
        assert_true(n > 10);
    }
}

/* The same for the descriptions, which know no failures of their own. */
static void descriptions_survive_failing_memory(void **state)
{
    (void)state;
    for (size_t i = 0; i < wo_scene_entry_count; i++) {
        wo_status status = WO_ERR_NOMEM;
        for (int n = 0; status != WO_OK && n < 1000; n++) {
            heap h = {.left = n};
            const wo_context context = {.allocator = {&h, heap_get, heap_put}};
            wo_error error = {0};
            wo_scene *scene = NULL;
            status = wo_scene_create(&context, &wo_scene_entries[i], 4, 0.36, 0.2, &scene, &error);
            assert_true(status == WO_OK || (status == WO_ERR_NOMEM && !scene));
            assert_int_equal(error.status, status);
            wo_scene_destroy(&context, &scene);
            assert_int_equal(h.live, 0);
        }
        assert_int_equal(status, WO_OK);
    }
}

static double number(const wo_io_part *part, const char *name)
{
    const wo_io_attribute *const found = wo_io_part_find(part, name);
    assert_non_null(found);
    return found->number;
}

static void check_part(const wo_io_file *file, size_t index, const char *name, const char *channel,
                       const wo_image *image, bool half)
{
    const wo_io_part *const part = &file->parts[index];
    assert_string_equal(part->name, name);
    assert_string_equal(part->channel_names[0], channel);
    assert_int_equal(part->channels, image->components);
    assert_true(wo_rect_equal(part->data_window, image->bounds));
    assert_true(number(part, "wideopen:focalLength") == 50);
    assert_true(fabs(number(part, "wideopen:fStop") - 2.5) < 1e-6);
    assert_true(fabs(number(part, "wideopen:focusDistance") - 3) < 1e-6);
    assert_true(number(part, "wideopen:sensorWidth") == 36);
    assert_true(number(part, "wideopen:blades") == 6);
    assert_true(fabs(number(part, "wideopen:rotation") - 12) < 1e-5);
    assert_string_equal(wo_io_part_find(part, "wideopen:scene")->text, "two-planes");
    assert_string_equal(wo_io_part_find(part, "wideopen:seed")->text, "18446744073709551615");
    const size_t count = image_bytes(image) / sizeof(float);
    for (size_t i = 0; i < count; i++) {
        const double a = part->pixels[i], b = image->data[i];
        assert_true(half ? fabs(a - b) <= 1e-3 * fabs(b) + 1e-6 : a == b);
    }
}

static void files_hold_what_was_made(void **state)
{
    (void)state;
    wo_context context = WO_CONTEXT_INIT;
    wo_footage *set = NULL;
    const wo_footage_options o = {.scene = "two-planes",
                                  .width = 40,
                                  .height = 21,
                                  .layers = 2,
                                  .samples = 8,
                                  .reference_spp = 16,
                                  .seed = UINT64_MAX,
                                  .f_stop = 2.5,
                                  .focus_m = 3,
                                  .blades = 6,
                                  .rotation = 12};
    assert_int_equal(wo_footage_render(&context, &o, test_folder, &set, &fault), WO_OK);
    wo_io_file *file = NULL;
    assert_int_equal(wo_io_read(in_folder(WO_FOOTAGE_PINHOLE), false, &file, &fault), WO_OK);
    assert_int_equal(file->part_count, 3);
    check_part(file, 0, "rgba", "R", &set->colour, true);
    check_part(file, 1, "depth", "Z", &set->depth, false);
    check_part(file, 2, "normal", "N.X", &set->normal, true);
    wo_io_file_destroy(&file);
    assert_int_equal(wo_io_read(in_folder(WO_FOOTAGE_LAYERS), false, &file, &fault), WO_OK);
    assert_int_equal(file->part_count, 4);
    check_part(file, 0, "layer1", "R", &set->layer[0], true);
    check_part(file, 1, "layer1_depth", "Z", &set->layer_depth[0], false);
    check_part(file, 2, "layer2", "R", &set->layer[1], true);
    check_part(file, 3, "layer2_depth", "Z", &set->layer_depth[1], false);
    wo_image view = {0};
    const wo_io_part *part = NULL;
    assert_int_equal(wo_io_select(file, "layer2_depth", &view, &part, &fault), WO_OK);
    assert_ptr_equal(part, &file->parts[3]);
    assert_int_equal(view.components, 1);
    free(view.data);
    assert_int_equal(wo_io_select(file, "layer2", &view, &part, &fault), WO_OK);
    assert_int_equal(view.components, 4);
    free(view.data);
    wo_io_file_destroy(&file);
    assert_int_equal(wo_io_read(in_folder(WO_FOOTAGE_REFERENCE), false, &file, &fault), WO_OK);
    check_part(file, 0, "", "R", &set->reference, false);
    assert_true(number(&file->parts[0], "wideopen:samples") == set->options.reference_spp);
    assert_true(fabs(number(&file->parts[0], "wideopen:noisePSNR") - set->noise_psnr) < 1e-4);
    wo_io_file_destroy(&file);
    assert_int_equal(wo_io_read(in_folder(WO_FOOTAGE_REFERENCE_ERROR), false, &file, &fault),
                     WO_OK);
    check_part(file, 0, "", "R", &set->reference_error, false);
    wo_io_file_destroy(&file);
    assert_int_equal(count_files(true), 4);
    wo_footage_destroy(&context, &set);
    assert_int_equal(wo_footage_render(&context, &o, "/nowhere/at/all", &set, &fault), WO_ERR_IO);
    assert_null(set);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(scenes_are_listed),
        cmocka_unit_test(bad_options_are_refused),
        cmocka_unit_test(sizes_follow_the_scene),
        cmocka_unit_test(threads_do_not_matter_seeds_do),
        cmocka_unit_test(overscan_goes_on),
        cmocka_unit_test(seeds_move_samples_too),
        cmocka_unit_test(progress_rises_and_aborts),
        cmocka_unit_test(failing_memory_is_survived),
        cmocka_unit_test(descriptions_survive_failing_memory),
        cmocka_unit_test_setup_teardown(files_hold_what_was_made, make_folder, remove_folder),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
