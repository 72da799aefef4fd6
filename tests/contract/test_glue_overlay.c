/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "glue_fixture.h"
#include "mock_overlay.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>
#include <dlfcn.h>

#include "plugins/fake_gl.h"

/* Handles over a viewer: where they are offered, what is drawn, what the pen does to them. Point 1
   is at 10,20 and point 2 at 30,30 at first; point 3, at 50,20, is not used. */

static OfxPlugin *pointing;
static OfxImageEffectHandle effect;
static OfxInteractHandle interact;
static OfxPluginEntryPoint *entry; /* of the draw suite */

static const double first[2] = {10, 20};

static OfxPluginEntryPoint *entry_of(OfxImageEffectHandle e, const char *property)
{
    void *const address = mock_effect_pointer(e, property);
    OfxPluginEntryPoint *function = NULL;
    memcpy(&function, &address, sizeof function);
    return function;
}

static OfxPluginEntryPoint *entry_gl(void)
{
    return entry_of(effect, kOfxImageEffectPluginPropOverlayInteractV1);
}

static void load(OfxPlugin *plugin, unsigned flags)
{
    mock.flags = flags;
    plugin->setHost(mock_host());
    assert_int_equal(plugin->mainEntry(kOfxActionLoad, NULL, NULL, NULL), kOfxStatOK);
}

static void open_interact(OfxPluginEntryPoint *opened)
{
    OfxStatus status = kOfxStatFailed;
    assert_non_null(opened);
    interact = mock_interact_create(opened, effect, &status);
    assert_int_equal(status, kOfxStatOK);
}

static OfxStatus draw(void)
{
    return mock_interact(entry, interact, kOfxInteractActionDraw, NULL);
}

static void open_flags(unsigned flags)
{
    OfxStatus status = kOfxStatFailed;
    load(pointing, flags);
    effect = mock_create(pointing, kOfxImageEffectContextFilter, &status);
    assert_non_null(effect);
    entry = entry_of(effect, kOfxImageEffectPluginPropOverlayInteractV2);
    if (!entry)
        entry = entry_gl();
    open_interact(entry);
    draw(); /* a handle must have been seen to be taken */
}

static void close_all(void)
{
    mock_interact_destroy(entry, interact);
    mock_destroy(pointing, effect);
    assert_int_equal(pointing->mainEntry(kOfxActionUnload, NULL, NULL, NULL), kOfxStatOK);
    assert_int_equal(mock.live_blocks, 0);
    assert_int_equal(mock.live_sets, 0);
    assert_int_equal(mock.edits_begun, mock.edits_ended);
}

static int set_up(void **state)
{
    (void)state;
    mock_reset();
    mock_viewer_reset();
    pointing = probe_get(2);
    open_flags(MOCK_OVERLAYS);
    return 0;
}

static int tear_down(void **state)
{
    (void)state;
    close_all();
    return 0;
}

static OfxStatus act(const char *action, double x, double y)
{
    return mock_interact(entry, interact, action, (double[2]){x, y});
}

static bool same_colour(OfxRGBAColourF a, OfxRGBAColourF b)
{
    return memcmp(&a, &b, sizeof a) == 0;
}

/* The nth drawing of a kind in a colour of the host, or NULL. */
static const mock_drawing *drawn(int kind, OfxStandardColour colour, int nth)
{
    for (int i = 0; i < mock_viewer.count; i++)
        if (mock_viewer.drawings[i].kind == kind &&
            same_colour(mock_viewer.drawings[i].colour, mock_colour(colour)) && nth-- == 0)
            return &mock_viewer.drawings[i];
    return NULL;
}

static void assert_point(const char *name, double x, double y)
{
    double at[3];
    assert_true(mock_get_number(effect, name, at));
    if (fabs(at[0] - x) > 1e-12 || fabs(at[1] - y) > 1e-12)
        fail_msg("%s is at %g,%g, not at %g,%g", name, at[0], at[1], x, y);
}

static void it_is_offered_where_the_host_can(void **state)
{
    static const struct {
        unsigned flags;
        bool gl, draw;
    } rows[] = {{0, false, false},
                {MOCK_OVERLAYS, true, true},
                {MOCK_OVERLAYS | MOCK_NO_DRAW, true, false},
                {MOCK_OVERLAYS | MOCK_HOLLOW_DRAW, true, false},
                {MOCK_OVERLAYS | MOCK_NO_INTERACT, false, false}};
    (void)state;
    for (size_t i = 0; i < WO_COUNT(rows) * 2; i++) {
        OfxStatus status = kOfxStatFailed;
        const bool handles = i < WO_COUNT(rows);
        OfxPlugin *const plugin = handles ? pointing : probe;
        load(plugin, rows[i % WO_COUNT(rows)].flags);
        const OfxImageEffectHandle e = mock_create(plugin, kOfxImageEffectContextFilter, &status);
        assert_non_null(e);
        assert_int_equal(entry_of(e, kOfxImageEffectPluginPropOverlayInteractV1) != NULL,
                         handles && rows[i % WO_COUNT(rows)].gl);
        assert_int_equal(entry_of(e, kOfxImageEffectPluginPropOverlayInteractV2) != NULL,
                         handles && rows[i % WO_COUNT(rows)].draw);
        mock_destroy(plugin, e);
    }
    assert_int_equal(probe->mainEntry(kOfxActionUnload, NULL, NULL, NULL), kOfxStatOK);
    load(pointing, MOCK_OVERLAYS); /* for tear_down */
}

static void handles_are_where_the_points_are(void **state)
{
    static const double places[2][2] = {{10, 20}, {30, 30}};
    (void)state;
    mock_viewer.pixel[0] = 2;
    mock_viewer.pixel[1] = 0.5;
    assert_int_equal(draw(), kOfxStatOK);
    for (int i = 0; i < 2; i++) {
        const mock_drawing *const cross =
            drawn(kOfxDrawPrimitiveLines, kOfxStandardColourOverlayDeselected, i);
        const mock_drawing *const circle =
            drawn(kOfxDrawPrimitiveLineLoop, kOfxStandardColourOverlayDeselected, i);
        const mock_drawing *const text = drawn(MOCK_TEXT, kOfxStandardColourOverlayText, i);
        assert_non_null(cross);
        assert_non_null(circle);
        assert_non_null(text);
        assert_int_equal(cross->count, 4);
        for (int j = 0; j < 4; j += 2) {
            const double x = (cross->points[j].x + cross->points[j + 1].x) / 2;
            const double y = (cross->points[j].y + cross->points[j + 1].y) / 2;
            assert_true(fabs(x - places[i][0]) < 1e-12 && fabs(y - places[i][1]) < 1e-12);
        }
        for (int j = 0; j < circle->count; j++) { /* round on the screen: 8 pixels */
            const double x = (circle->points[j].x - places[i][0]) / 2;
            const double y = (circle->points[j].y - places[i][1]) / 0.5;
            assert_true(fabs(hypot(x, y) - 8) < 1e-9);
        }
        assert_string_equal(text->text, i == 0 ? "Point 1" : "Point 2");
        assert_true(text->points[0].x > places[i][0] + 16);
    }
    assert_null(drawn(kOfxDrawPrimitiveLines, kOfxStandardColourOverlayDeselected, 2));
    assert_null(drawn(kOfxDrawPrimitiveLineLoop, kOfxStandardColourOverlayMarqueeFG, 0));
    assert_null(drawn(kOfxDrawPrimitiveLines, kOfxStandardColourOverlayActive, 0));
    /* Each line and text lies on a dark one. */
    assert_int_equal(mock_viewer.count, 2 * 2 * 3);
}

static void points_of_a_plane_are_joined(void **state)
{
    (void)state;
    mock_set_number(effect, "mode", 2, 0, 0);
    assert_int_equal(draw(), kOfxStatOK);
    const mock_drawing *join =
        drawn(kOfxDrawPrimitiveLineStrip, kOfxStandardColourOverlayMarqueeFG, 0);
    assert_non_null(join);
    assert_int_equal(join->count, 2);
    mock_set_number(effect, "uses", 3, 0, 0);
    assert_int_equal(draw(), kOfxStatOK);
    join = drawn(kOfxDrawPrimitiveLineLoop, kOfxStandardColourOverlayMarqueeFG, 0);
    assert_non_null(join);
    assert_int_equal(join->count, 3);
    assert_int_equal(join->stipple, kOfxDrawLineStipplePatternDash);
    assert_true(join->points[2].x == 50 && join->points[2].y == 20);
    mock_set_number(effect, "uses", 1, 0, 0);
    assert_int_equal(draw(), kOfxStatOK);
    assert_null(drawn(kOfxDrawPrimitiveLineStrip, kOfxStandardColourOverlayMarqueeFG, 0));
    assert_int_equal(mock_viewer.count, 2 * 3);
    mock_set_number(effect, "mode", 0, 0, 0);
    assert_int_equal(draw(), kOfxStatReplyDefault);
    assert_int_equal(mock_viewer.count, 0);
    assert_int_equal(act(kOfxInteractActionPenDown, first[0], first[1]), kOfxStatReplyDefault);
}

static void the_handle_under_the_pen_lights_up(void **state)
{
    (void)state;
    assert_int_equal(act(kOfxInteractActionPenMotion, 32, 31), kOfxStatReplyDefault);
    assert_int_equal(mock_viewer.redraws, 1);
    draw();
    const mock_drawing *const cross =
        drawn(kOfxDrawPrimitiveLines, kOfxStandardColourOverlayActive, 0);
    assert_non_null(cross);
    assert_true((cross->points[0].x + cross->points[1].x) / 2 == 30);
    assert_non_null(drawn(kOfxDrawPrimitiveLines, kOfxStandardColourOverlayDeselected, 0));
    act(kOfxInteractActionPenMotion, 33, 31);
    assert_int_equal(mock_viewer.redraws, 1);
    act(kOfxInteractActionPenMotion, 90, 90);
    assert_int_equal(mock_viewer.redraws, 2);
    draw();
    assert_null(drawn(kOfxDrawPrimitiveLines, kOfxStandardColourOverlayActive, 0));
}

static void a_drag_is_one_edit(void **state)
{
    (void)state;
    assert_int_equal(act(kOfxInteractActionPenDown, 12, 17), kOfxStatOK);
    assert_int_equal(mock.edits_begun, 1);
    assert_string_equal(mock.edit, "Point 1");
    assert_point("first", 10, 20);
    for (int i = 1; i <= 5; i++) {
        assert_int_equal(act(kOfxInteractActionPenMotion, 12 + 3 * i, 17 + i), kOfxStatOK);
        assert_point("first", 10 + 3 * i, 20 + i); /* it is held where it was taken */
        assert_int_equal(mock.values_set, i);
    }
    assert_int_equal(mock.edits_ended, 0);
    assert_int_equal(act(kOfxInteractActionPenUp, 28, 23), kOfxStatOK);
    assert_point("first", 26, 26);
    assert_int_equal(mock.edits_begun, 1);
    assert_int_equal(mock.edits_ended, 1);
    assert_int_equal(act(kOfxInteractActionPenMotion, 80, 80), kOfxStatReplyDefault);
    assert_int_equal(act(kOfxInteractActionPenUp, 80, 80), kOfxStatReplyDefault);
    assert_point("first", 26, 26);
    assert_point("second", 30, 30);
    assert_true(mock_viewer.redraws >= 6);

    /* A click changes nothing, a pen beside the handles is not taken. */
    mock.values_set = 0;
    assert_int_equal(act(kOfxInteractActionPenDown, 30, 31), kOfxStatOK);
    assert_int_equal(act(kOfxInteractActionPenUp, 30, 31), kOfxStatOK);
    assert_int_equal(mock.values_set, 0);
    assert_int_equal(act(kOfxInteractActionPenDown, 50, 20), kOfxStatReplyDefault);
    assert_int_equal(mock.edits_begun, 2);
    assert_int_equal(mock.edits_ended, 2);
}

static void values_stay_in_their_range(void **state)
{
    (void)state;
    act(kOfxInteractActionPenDown, first[0], first[1]);
    act(kOfxInteractActionPenMotion, 1e300, -1e300);
    assert_point("first", 500, -500);
    act(kOfxInteractActionPenMotion, (double)NAN, 0);
    act(kOfxInteractActionPenMotion, 0, (double)INFINITY);
    assert_int_equal(act(kOfxInteractActionPenUp, (double)NAN, (double)NAN), kOfxStatOK);
    assert_point("first", 500, -500);
}

static void reach_is_a_distance_on_the_screen(void **state)
{
    static const struct {
        double scale, away;
        bool taken;
    } rows[] = {{1, 7, true}, {1, 9, false}, {10, 70, true}, {0.1, 7, false}, {0.1, 0.7, true}};
    (void)state;
    mock_set_number(effect, "uses", 1, 0, 0);
    for (size_t i = 0; i < WO_COUNT(rows); i++) {
        mock_viewer.pixel[0] = mock_viewer.pixel[1] = rows[i].scale;
        assert_int_equal(act(kOfxInteractActionPenDown, first[0] + rows[i].away, first[1]),
                         rows[i].taken ? kOfxStatOK : kOfxStatReplyDefault);
        act(kOfxInteractActionPenUp, first[0] + rows[i].away, first[1]);
    }
    /* The nearest one is taken. */
    mock_viewer.pixel[0] = mock_viewer.pixel[1] = 10;
    mock_set_number(effect, "uses", 3, 0, 0);
    assert_int_equal(act(kOfxInteractActionPenDown, 31, 29), kOfxStatOK);
    assert_string_equal(mock.edit, "Point 2");
    act(kOfxInteractActionPenUp, 31, 29);
}

static void edits_are_ended_whatever_happens(void **state)
{
    (void)state;
    act(kOfxInteractActionPenDown, first[0], first[1]);
    act(kOfxInteractActionPenDown, first[0], first[1]); /* the pen was never lifted */
    assert_int_equal(mock.edits_begun, 2);
    assert_int_equal(mock.edits_ended, 1);
    act(kOfxInteractActionLoseFocus, 0, 0);
    assert_int_equal(mock.edits_ended, 2);
    draw();
    assert_null(drawn(kOfxDrawPrimitiveLines, kOfxStandardColourOverlayActive, 0));
    act(kOfxInteractActionPenDown, first[0], first[1]);
    assert_int_equal(mock.edits_ended, 2);
    mock_interact_destroy(entry, interact);
    assert_int_equal(mock.edits_ended, 3);
    open_interact(entry);
}

static void assert_finite_drawings(void)
{
    for (int i = 0; i < mock_viewer.count; i++)
        for (int j = 0; j < mock_viewer.drawings[i].count; j++)
            assert_true(isfinite(mock_viewer.drawings[i].points[j].x) &&
                        isfinite(mock_viewer.drawings[i].points[j].y));
}

static void senseless_arguments_do_no_harm(void **state)
{
    const double numbers[] = {0,      -1,   (double)NAN, (double)INFINITY, -(double)INFINITY,
                              1e-320, 1e308};
    static const char *const actions[] = {
        kOfxInteractActionDraw,          kOfxInteractActionPenMotion, kOfxInteractActionPenDown,
        kOfxInteractActionPenUp,         kOfxInteractActionKeyDown,   kOfxInteractActionKeyUp,
        kOfxInteractActionKeyRepeat,     kOfxInteractActionGainFocus, kOfxInteractActionLoseFocus,
        "OfxInteractActionFromTheFuture"};
    (void)state;
    for (size_t i = 0; i < WO_COUNT(actions); i++) {
        for (size_t j = 0; j < WO_COUNT(numbers); j++)
            for (size_t k = 0; k < WO_COUNT(numbers); k++) {
                mock_viewer.pixel[0] = numbers[j];
                mock_viewer.pixel[1] = numbers[k];
                act(actions[i], numbers[k], numbers[j]);
                assert_finite_drawings();
                mock_interact(entry, interact, actions[i], NULL);
                assert_finite_drawings();
            }
        mock_viewer_reset();
        mock_viewer.no_pixel = true;
        act(actions[i], first[0], first[1]);
        mock_viewer.no_effect = true; /* the interact knows it, too */
        act(actions[i], first[0], first[1]);
        mock_viewer.no_context = true;
        act(actions[i], first[0], first[1]);
        mock_viewer.no_properties = true;
        assert_int_equal(act(actions[i], first[0], first[1]), kOfxStatReplyDefault);
        mock_viewer_reset();
        entry(actions[i], interact, NULL, NULL);
        assert_int_equal(entry(actions[i], NULL, NULL, NULL), kOfxStatErrBadHandle);
    }
    assert_int_equal(entry(NULL, interact, NULL, NULL), kOfxStatErrValue);
    assert_int_equal(act(kOfxInteractActionGainFocus, 0, 0), kOfxStatReplyDefault);
    act(kOfxInteractActionLoseFocus, 0, 0);

    mock_set_number(effect, "first", (double)NAN, 1, 0);
    assert_int_equal(draw(), kOfxStatReplyDefault);
    mock_set_number(effect, "first", (double)INFINITY, 1, 0);
    assert_int_equal(draw(), kOfxStatOK); /* at the end of the range */
    assert_finite_drawings();
}

static void poor_hosts_get_what_they_can_show(void **state)
{
    static const struct {
        unsigned flags;
        OfxStatus drawing, pen;
    } rows[] = {{MOCK_NO_INSTANCE_DATA, kOfxStatOK, kOfxStatReplyDefault},
                {MOCK_READ_ONLY, kOfxStatOK, kOfxStatReplyDefault},
                {MOCK_NO_MEMORY, kOfxStatOK, kOfxStatOK},
                {MOCK_NO_MEMORY | MOCK_HOLLOW_EFFECT, kOfxStatOK, kOfxStatOK},
                {MOCK_NO_DRAW, kOfxStatReplyDefault, kOfxStatReplyDefault},
                {MOCK_HOLLOW_DRAW, kOfxStatReplyDefault, kOfxStatReplyDefault}};
    (void)state;
    for (size_t i = 0; i < WO_COUNT(rows); i++) {
        close_all();
        open_flags(MOCK_OVERLAYS | rows[i].flags);
        assert_int_equal(draw(), rows[i].drawing);
        mock_viewer.redraws = 0;
        act(kOfxInteractActionPenMotion, first[0], first[1]);
        assert_int_equal(mock_viewer.redraws,
                         rows[i].drawing == kOfxStatOK && rows[i].flags != MOCK_NO_INSTANCE_DATA);
        assert_int_equal(act(kOfxInteractActionPenDown, first[0], first[1]), rows[i].pen);
        act(kOfxInteractActionPenMotion, 15, 25);
        act(kOfxInteractActionPenUp, 15, 25);
        if (rows[i].pen == kOfxStatOK)
            assert_point("first", 15, 25);
        else
            assert_point("first", 10, 20);
    }
    close_all();
    mock.refuse = kOfxParamTypeDouble2D;
    open_flags(MOCK_OVERLAYS);
    assert_int_equal(draw(), kOfxStatReplyDefault);
    mock.refuse = NULL;
    mock_viewer.colourless = true;
    close_all();
    open_flags(MOCK_OVERLAYS);
    assert_int_equal(draw(), kOfxStatOK);
    for (int i = 0; i < mock_viewer.count; i++)
        assert_true(mock_viewer.drawings[i].colour.a > 0);
}

static void memory_may_run_out(void **state)
{
    OfxStatus status = kOfxStatOK;
    (void)state;
    mock.fail_after = 0;
    assert_int_equal(act(kOfxInteractActionPenDown, first[0], first[1]), kOfxStatReplyDefault);
    assert_int_equal(draw(), kOfxStatReplyDefault);
    assert_null(mock_interact_create(entry, effect, &status));
    assert_int_equal(status, kOfxStatErrMemory);
    mock.fail_after = -1;
    assert_int_equal(draw(), kOfxStatOK);
}

static void the_host_is_told_when_to_redraw(void **state)
{
    static const char *const names[] = {"mode", "uses", "first", "second", "third"};
    (void)state;
    for (int i = 0; i < (int)WO_COUNT(names); i++) {
        const char *const name = mock_interact_slave(interact, i);
        assert_non_null(name);
        assert_string_equal(name, names[i]);
    }
    assert_null(mock_interact_slave(interact, (int)WO_COUNT(names)));
}

static void it_comes_and_goes_again_and_again(void **state)
{
    (void)state;
    for (int i = 0; i < 4; i++) {
        assert_int_equal(draw(), kOfxStatOK);
        act(kOfxInteractActionPenDown, first[0], first[1]);
        OfxPluginEntryPoint *const before = entry;
        close_all();
        assert_int_equal(before(kOfxActionDescribe, &mock, NULL, NULL),
                         kOfxStatErrMissingHostFeature);
        open_flags(MOCK_OVERLAYS);
    }
}

/* ---- OpenGL ---- */

static fake_gl *record;

static void *open_gl(int flags)
{
    void *const library = dlopen(FAKE_GL, RTLD_NOW | flags);
    if (!library)
        print_error("%s\n", dlerror());
    assert_non_null(library);
    record = dlsym(library, "fake_gl_record");
    assert_non_null(record);
    memset(record, 0, sizeof *record);
    return library;
}

static void without_opengl_nothing_is_drawn(void **state)
{
    (void)state;
    mock_viewer.no_context = true;
    assert_int_equal(mock_interact(entry_gl(), interact, kOfxInteractActionDraw, NULL),
                     kOfxStatReplyDefault);
}

static void assert_gl_drawing(void)
{
    double box[4] = {1e9, 1e9, -1e9, -1e9};
    int on_circle = 0, dashed = 0;

    memset(record, 0, sizeof *record);
    assert_int_equal(mock_interact(entry_gl(), interact, kOfxInteractActionDraw, NULL), kOfxStatOK);
    assert_int_equal(mock_viewer.count, 0);
    assert_int_equal(record->stray, 0);
    assert_int_equal(record->pushed, 1);
    assert_int_equal(record->popped, 1);
    assert_int_equal(record->begun, record->ended);
    assert_int_equal(record->blended, 1);
    for (int i = 0; i < record->vertex_count; i++) {
        const double x = record->vertices[i].x, y = record->vertices[i].y;
        if (record->vertices[i].mode == 2 && fabs(hypot(x - 10, y - 20) - 8) < 1e-9)
            on_circle++;
        dashed += record->vertices[i].dashed;
        box[0] = fmin(box[0], x);
        box[1] = fmin(box[1], y);
        box[2] = fmax(box[2], x);
        box[3] = fmax(box[3], y);
    }
    assert_int_equal(on_circle, 2 * 24); /* a dark one and a light one */
    assert_int_equal(dashed, 2 * 3);
    assert_true(box[0] == 2 && box[1] == 12); /* from the left of point 1 and 3 */
    assert_true(box[2] > 58 && box[2] < 80 && box[3] > 38 && box[3] < 60); /* numbers above */
}

static void opengl_is_found_in_the_process(void **state)
{
    static const int ways[] = {RTLD_LOCAL, RTLD_GLOBAL};
    (void)state;
    mock_set_number(effect, "mode", 2, 0, 0);
    mock_set_number(effect, "uses", 3, 0, 0);
    for (size_t i = 0; i < WO_COUNT(ways); i++) {
        void *const library = open_gl(ways[i]);
        mock_viewer.no_context = true;
        assert_gl_drawing();

        /* An overlay of the draw suite has no context of OpenGL, whatever else is missing. */
        record->calls = 0;
        assert_int_equal(draw(), kOfxStatReplyDefault);
        mock_viewer.no_context = false;
        assert_int_equal(draw(), kOfxStatOK);
        assert_int_equal(mock_interact(entry_gl(), interact, kOfxInteractActionDraw, NULL),
                         kOfxStatOK);
        assert_int_equal(record->calls, 0);
        assert_int_equal(dlclose(library), 0);
    }
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(it_is_offered_where_the_host_can),
        TEST(handles_are_where_the_points_are),
        TEST(points_of_a_plane_are_joined),
        TEST(the_handle_under_the_pen_lights_up),
        TEST(a_drag_is_one_edit),
        TEST(values_stay_in_their_range),
        TEST(reach_is_a_distance_on_the_screen),
        TEST(edits_are_ended_whatever_happens),
        TEST(senseless_arguments_do_no_harm),
        TEST(poor_hosts_get_what_they_can_show),
        TEST(memory_may_run_out),
        TEST(the_host_is_told_when_to_redraw),
        TEST(it_comes_and_goes_again_and_again),
        TEST(without_opengl_nothing_is_drawn),
        TEST(opengl_is_found_in_the_process),
    };
    return cmocka_run_group_tests_name("overlays", tests, fixture_open, fixture_close);
}
