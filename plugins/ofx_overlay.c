/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "ofx_overlay.h"

#include "ofx_draw.h"
#include "ofx_memory.h"
#include "ofx_params.h"

#include <math.h>
#include <string.h>

enum { HANDLES_MAX = 32, ROUND = 24 };

static const double radius = 8; /* of a handle, and how near the pen must come; screen pixels */
static const int nothing = -1;

/* All that lives between two actions of one interact. */
typedef struct overlay {
    int picked;     /* row of the handle under the pen, or nothing */
    bool seen;      /* handles were drawn the last time; others are not taken */
    bool dragging;  /* the picked one; an edit is open */
    OfxPointD pen;  /* where it was last while dragging */
    OfxPointD grip; /* from the pen to the handle */
} overlay;

/* One action; lives on its stack. */
typedef struct overlay_action {
    const wo_ofx_suites *suites;
    const wo_effect *effect;
    OfxInteractHandle interact;
    OfxPropertySetHandle properties; /* of the interact, or NULL */
    OfxPropertySetHandle in;
    OfxImageEffectHandle handle; /* NULL where the host does not say */
    overlay *state;              /* NULL where the host keeps none: nothing can be dragged */
    double pixel[2];             /* size of a screen pixel, canonical */
} overlay_action;

/* Handles in use, in the order of the table. */
typedef struct handles {
    int count;
    bool joined;
    struct {
        int row;
        int number; /* 1 for the first point of the table */
        OfxPointD at;
    } items[HANDLES_MAX];
} handles;

static bool is_handle(const wo_param *param)
{
    return param->overlay && param->type == WO_PARAM_POINT;
}

void wo_ofx_overlay_describe(const wo_ofx_plugin *plugin, OfxPropertySetHandle effect)
{
    const wo_ofx_suites *const s = &plugin->suites;
    const wo_effect *const e = plugin->effect();
    const struct {
        const char *name;
        OfxPluginEntryPoint *entry;
    } rows[] = {{kOfxImageEffectPluginPropOverlayInteractV1, plugin->overlay_gl},
                {kOfxImageEffectPluginPropOverlayInteractV2,
                 wo_ofx_can_draw(s) ? plugin->overlay_draw : NULL}};
    bool any = false;

    for (size_t i = 0; i < e->param_count; i++)
        any = any || is_handle(&e->params[i]);
    if (!any || !s->interact || !s->interact->interactGetPropertySet ||
        !wo_ofx_get_int(s, s->host, kOfxImageEffectPropSupportsOverlays, 0))
        return;
    for (size_t i = 0; i < WO_COUNT(rows); i++) {
        void *address = NULL;
        memcpy(&address, &rows[i].entry, sizeof address);
        if (address)
            s->property->propSetPointer(effect, rows[i].name, 0, address);
    }
}

/* ---- the action ---- */

/* Finite and larger than nothing, or the next best: what a host says of its zoom is needed for
   divisions. */
static void read_pixel(overlay_action *a)
{
    const OfxPropertySetHandle sets[] = {a->in, a->properties};
    a->pixel[0] = a->pixel[1] = 1;
    for (size_t i = 0; i < WO_COUNT(sets); i++) {
        double pixel[2];
        if (wo_ofx_read_doubles(a->suites, sets[i], kOfxInteractPropPixelScale, 2, pixel) &&
            pixel[0] >= 1e-6 && pixel[1] >= 1e-6 && pixel[0] <= 1e6 && pixel[1] <= 1e6) {
            memcpy(a->pixel, pixel, sizeof pixel);
            return;
        }
    }
}

static void begin(overlay_action *a, const wo_ofx_plugin *plugin, OfxInteractHandle interact,
                  OfxPropertySetHandle in)
{
    const wo_ofx_suites *const suites = &plugin->suites;
    *a = (overlay_action){
        .suites = suites, .effect = plugin->effect(), .interact = interact, .in = in};
    if (suites->interact->interactGetPropertySet(interact, &a->properties) != kOfxStatOK)
        a->properties = NULL;
    a->handle = wo_ofx_get_pointer(suites, in, kOfxPropEffectInstance);
    if (!a->handle)
        a->handle = wo_ofx_get_pointer(suites, a->properties, kOfxPropEffectInstance);
    a->state = wo_ofx_get_pointer(suites, a->properties, kOfxPropInstanceData);
    read_pixel(a);
}

static void redraw(const overlay_action *a)
{
    if (a->suites->interact->interactRedraw)
        a->suites->interact->interactRedraw(a->interact);
}

static OfxParamSetHandle params_of(const overlay_action *a)
{
    OfxParamSetHandle set = NULL;
    if (!a->handle || a->suites->effect->getParamSet(a->handle, &set) != kOfxStatOK)
        return NULL;
    return set;
}

/* The host's parameter of a row, or NULL. */
static OfxParamHandle param_of(const overlay_action *a, int row)
{
    OfxParamHandle param = NULL;
    const OfxParamSetHandle set = params_of(a);
    if (!set || a->suites->param->paramGetHandle(set, a->effect->params[row].key, &param, NULL) !=
                    kOfxStatOK)
        return NULL;
    return param;
}

static void collect(const overlay_action *a, const void *params, handles *list)
{
    const wo_effect *const effect = a->effect;
    const int used = effect->handles ? effect->handles(params, &list->joined) : HANDLES_MAX;
    int number = 0;
    for (size_t i = 0; i < effect->param_count && number < used; i++) {
        double values[3];
        if (!is_handle(&effect->params[i]))
            continue;
        number++;
        if (list->count == HANDLES_MAX || !param_of(a, (int)i))
            continue;
        wo_param_get(&effect->params[i], params, values);
        list->items[list->count].row = (int)i;
        list->items[list->count].number = number;
        list->items[list->count++].at = (OfxPointD){values[0], values[1]};
    }
}

/* None where the parameters cannot be read: the render complains about that. */
static void read_handles(const overlay_action *a, handles *list)
{
    wo_ofx_memory memory = {a->suites, a->handle};
    const wo_context context = {.allocator = wo_ofx_allocator(&memory)};
    const double time = wo_ofx_get_double(a->suites, a->in, kOfxPropTime, 0);

    *list = (handles){.count = 0};
    if (!params_of(a))
        return;
    void *const params = wo_new(&context, NULL, 1, a->effect->params_size);
    if (params &&
        wo_ofx_read_params(a->suites, a->effect, a->handle, time, params, NULL, NULL) == WO_OK)
        collect(a, params, list);
    wo_delete(&context, params);
}

/* ---- drawing ---- */

static void draw_handle(const wo_ofx_canvas *canvas, OfxPointD at, bool picked, const char *label,
                        int number)
{
    const wo_ofx_ink ink = picked ? WO_OFX_INK_PICKED : WO_OFX_INK_IDLE;
    const float width = picked ? 2 : 1.5f;
    const double x = radius * canvas->pixel[0], y = radius * canvas->pixel[1];
    const OfxPointD cross[4] = {
        {at.x - x / 2, at.y}, {at.x + x / 2, at.y}, {at.x, at.y - y / 2}, {at.x, at.y + y / 2}};
    const OfxPointD beside = {at.x + 1.5 * x, at.y + y};
    OfxPointD circle[ROUND];

    for (int i = 0; i < ROUND; i++) {
        const double turn = 2 * 3.14159265358979323846 * i / ROUND;
        circle[i] = (OfxPointD){at.x + x * cos(turn), at.y + y * sin(turn)};
    }
    wo_ofx_canvas_lines(canvas, ink, false, width, kOfxDrawPrimitiveLines, cross, 4);
    wo_ofx_canvas_lines(canvas, ink, false, width, kOfxDrawPrimitiveLineLoop, circle, ROUND);
    wo_ofx_canvas_label(canvas, picked ? WO_OFX_INK_PICKED : WO_OFX_INK_TEXT, beside, label,
                        number);
}

static OfxStatus draw(const overlay_action *a, bool may_gl)
{
    const int picked = a->state ? a->state->picked : nothing;
    OfxPointD corners[HANDLES_MAX];
    wo_ofx_canvas canvas;
    handles list;

    read_handles(a, &list);
    const bool seen = list.count > 0 && wo_ofx_canvas_begin(&canvas, a->suites, a->in,
                                                            a->properties, a->pixel, may_gl);
    if (a->state)
        a->state->seen = seen;
    if (!seen)
        return kOfxStatReplyDefault;
    for (int i = 0; i < list.count; i++)
        corners[i] = list.items[i].at;
    if (list.joined && list.count > 1)
        wo_ofx_canvas_lines(&canvas, WO_OFX_INK_JOIN, true, 1,
                            list.count > 2 ? kOfxDrawPrimitiveLineLoop : kOfxDrawPrimitiveLineStrip,
                            corners, list.count);
    for (int i = 0; i < list.count; i++)
        draw_handle(&canvas, list.items[i].at, list.items[i].row == picked,
                    a->effect->params[list.items[i].row].label, list.items[i].number);
    wo_ofx_canvas_end(&canvas);
    return kOfxStatOK;
}

/* ---- the pen ---- */

static bool read_pen(const overlay_action *a, OfxPointD *pen)
{
    double at[2];
    if (!wo_ofx_read_doubles(a->suites, a->in, kOfxInteractPropPenPosition, 2, at) ||
        !isfinite(at[0]) || !isfinite(at[1]))
        return false;
    *pen = (OfxPointD){at[0], at[1]};
    return true;
}

/* Index of the nearest handle within reach of the pen, or nothing. */
static int find(const overlay_action *a, const handles *list, OfxPointD pen)
{
    double best = radius * radius;
    int found = nothing;
    for (int i = 0; i < list->count; i++) {
        const double x = (list->items[i].at.x - pen.x) / a->pixel[0];
        const double y = (list->items[i].at.y - pen.y) / a->pixel[1];
        if (x * x + y * y <= best) {
            best = x * x + y * y;
            found = i;
        }
    }
    return found;
}

static void end_drag(const overlay_action *a)
{
    const OfxParamSetHandle set = params_of(a);
    if (!a->state->dragging)
        return;
    a->state->dragging = false;
    if (set && a->suites->param->paramEditEnd)
        a->suites->param->paramEditEnd(set);
}

static void pick(const overlay_action *a, int row)
{
    if (a->state->picked == row)
        return;
    a->state->picked = row;
    redraw(a);
}

static OfxStatus pen_down(const overlay_action *a)
{
    const OfxParameterSuiteV1 *const suite = a->suites->param;
    const OfxParamSetHandle set = params_of(a);
    OfxPointD pen;
    handles list;

    end_drag(a); /* of a host that forgot to say so */
    if (!a->state->seen || !set || !suite->paramSetValue || !read_pen(a, &pen))
        return kOfxStatReplyDefault;
    read_handles(a, &list);
    const int i = find(a, &list, pen);
    if (i == nothing)
        return kOfxStatReplyDefault;
    const OfxPointD at = list.items[i].at;
    a->state->pen = pen;
    a->state->grip = (OfxPointD){at.x - pen.x, at.y - pen.y};
    a->state->dragging = true;
    if (suite->paramEditBegin)
        suite->paramEditBegin(set, a->effect->params[list.items[i].row].label);
    pick(a, list.items[i].row);
    return kOfxStatOK;
}

static void drag(const overlay_action *a, OfxPointD pen)
{
    const wo_param *const row = &a->effect->params[a->state->picked];
    const OfxParamHandle param = param_of(a, a->state->picked);
    if (!param || (pen.x == a->state->pen.x && pen.y == a->state->pen.y))
        return; /* a mere click makes no key */
    a->state->pen = pen;
    a->suites->param->paramSetValue(param, fmin(fmax(pen.x + a->state->grip.x, row->min), row->max),
                                    fmin(fmax(pen.y + a->state->grip.y, row->min), row->max));
    redraw(a);
}

static OfxStatus pen_motion(const overlay_action *a)
{
    OfxPointD pen;
    handles list;
    const bool known = read_pen(a, &pen);

    if (a->state->dragging) {
        if (known)
            drag(a, pen);
        return kOfxStatOK;
    }
    if (!a->state->seen || !known)
        return kOfxStatReplyDefault;
    read_handles(a, &list);
    const int i = find(a, &list, pen);
    pick(a, i == nothing ? nothing : list.items[i].row);
    return kOfxStatReplyDefault;
}

static OfxStatus pen_up(const overlay_action *a)
{
    const bool dragging = a->state->dragging;
    OfxPointD pen;
    if (dragging && read_pen(a, &pen))
        drag(a, pen);
    end_drag(a);
    return dragging ? kOfxStatOK : kOfxStatReplyDefault;
}

static OfxStatus lose_focus(const overlay_action *a)
{
    end_drag(a);
    pick(a, nothing);
    return kOfxStatReplyDefault;
}

/* ---- life ---- */

static OfxStatus create(const overlay_action *a)
{
    const wo_ofx_suites *const s = a->suites;
    wo_ofx_memory memory = {s, a->handle};
    const wo_context context = {.allocator = wo_ofx_allocator(&memory)};
    int slaves = 0;

    if (!a->properties)
        return kOfxStatOK;
    for (size_t i = 0; i < a->effect->param_count; i++)
        if (a->effect->params[i].overlay &&
            wo_ofx_set_string(s, a->properties, kOfxInteractPropSlaveToParam, slaves,
                              a->effect->params[i].key) == kOfxStatOK)
            slaves++;
    overlay *const state = wo_new(&context, NULL, 1, sizeof *state);
    if (!state)
        return kOfxStatErrMemory;
    state->picked = nothing;
    if (s->property->propSetPointer(a->properties, kOfxPropInstanceData, 0, state) != kOfxStatOK)
        wo_delete(&context, state);
    return kOfxStatOK;
}

static OfxStatus destroy(const overlay_action *a)
{
    wo_ofx_memory memory = {a->suites, a->handle};
    const wo_context context = {.allocator = wo_ofx_allocator(&memory)};

    if (!a->state)
        return kOfxStatOK;
    end_drag(a);
    wo_delete(&context, a->state);
    a->suites->property->propSetPointer(a->properties, kOfxPropInstanceData, 0, NULL);
    return kOfxStatOK;
}

OfxStatus wo_ofx_overlay(const wo_ofx_plugin *plugin, const char *action, const void *handle,
                         OfxPropertySetHandle in, bool may_gl)
{
    static const struct {
        const char *name;
        OfxStatus (*act)(const overlay_action *a);
    } rows[] = {
        {kOfxInteractActionPenMotion, pen_motion},
        {kOfxInteractActionPenDown, pen_down},
        {kOfxInteractActionPenUp, pen_up},
        {kOfxInteractActionLoseFocus, lose_focus},
    };
    const wo_ofx_suites *const s = &plugin->suites;
    overlay_action a;

    if (!action)
        return kOfxStatErrValue;
    if (!s->property || !s->interact || !s->interact->interactGetPropertySet)
        return kOfxStatErrMissingHostFeature;
    if (!handle)
        return kOfxStatErrBadHandle;
    if (strcmp(action, kOfxActionDescribe) == 0)
        return kOfxStatOK;
    begin(&a, plugin, (OfxInteractHandle)handle, in);
    if (strcmp(action, kOfxActionCreateInstance) == 0)
        return create(&a);
    if (strcmp(action, kOfxActionDestroyInstance) == 0)
        return destroy(&a);
    if (strcmp(action, kOfxInteractActionDraw) == 0)
        return draw(&a, may_gl);
    for (size_t i = 0; i < WO_COUNT(rows) && a.state; i++)
        if (strcmp(action, rows[i].name) == 0)
            return rows[i].act(&a);
    return kOfxStatReplyDefault;
}
