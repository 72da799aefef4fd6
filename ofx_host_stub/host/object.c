/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "internal.h"

#include <stdlib.h>
#include <string.h>

bool wo_object_init(wo_object *object, wo_host *host, wo_entry *entry, const char *context,
                    bool instance)
{
    const wo_props_when when = instance ? WO_PROPS_INSTANCE : WO_PROPS_DESCRIBE;
    *object = (wo_object){.host = host, .entry = entry, .instance = instance};
    object->handle = wo_handle_add(WO_HANDLE_EFFECT, object);
    object->param_set = wo_handle_add(WO_HANDLE_PARAM_SET, object);
    if (context)
        object->context = wo_text_copy(context);
    wo_props_init(&object->props, host, when, "the %s of %.60s",
                  instance ? "instance" : "descriptor", entry->info.identifier);
    wo_props_init(&object->param_set_props, host, when, "the parameter set of %.60s",
                  entry->info.identifier);
    wo_schema_param_set(&object->param_set_props);
    if (instance)
        wo_schema_instance(&object->props);
    else
        wo_schema_descriptor(&object->props);
    if (context)
        wo_props_set_text(&object->props, kOfxImageEffectPropContext, 0, context);
    return object->handle && object->param_set && (!context || object->context) &&
           !object->props.failed && !object->param_set_props.failed;
}

static void handle_off(void **handle)
{
    wo_process_lock();
    wo_handle_remove(*handle);
    wo_process_unlock();
    *handle = NULL;
}

static void par_destroy(wo_par *par)
{
    handle_off(&par->handle);
    wo_props_clear(&par->props);
    wo_par_free_values(par);
    free(par->name);
    free(par);
}

static void port_destroy(wo_port *port)
{
    handle_off(&port->handle);
    wo_props_clear(&port->props);
    wo_texts_clear(&port->wishes);
    free(port->colourspace);
    free(port->identity);
    free(port->carries);
    free(port->name);
    free(port);
}

void wo_object_clear(wo_object *object)
{
    for (size_t i = 0; i < object->param_count; i++)
        par_destroy(object->params[i]);
    for (size_t i = 0; i < object->port_count; i++)
        port_destroy(object->ports[i]);
    free(object->params);
    free(object->ports);
    handle_off(&object->handle);
    handle_off(&object->param_set);
    wo_props_clear(&object->props);
    wo_props_clear(&object->param_set_props);
    free(object->context);
    *object = (wo_object){0};
}

wo_par *wo_object_param(const wo_object *object, const char *name)
{
    for (size_t i = 0; i < object->param_count; i++)
        if (strcmp(object->params[i]->name, name) == 0)
            return object->params[i];
    return NULL;
}

wo_port *wo_object_port(const wo_object *object, const char *name)
{
    for (size_t i = 0; i < object->port_count; i++)
        if (strcmp(object->ports[i]->name, name) == 0)
            return object->ports[i];
    return NULL;
}

static wo_par *par_new(wo_object *object, const char *type, const char *name)
{
    wo_par *par = calloc(1, sizeof *par);
    if (!par)
        return NULL;
    par->owner = object;
    par->name = wo_text_copy(name);
    par->text = wo_text_copy("");
    par->handle = wo_handle_add(WO_HANDLE_PARAM, par);
    wo_props_init(&par->props, object->host,
                  object->instance ? WO_PROPS_INSTANCE : WO_PROPS_DESCRIBE, "parameter \"%.80s\"",
                  name);
    wo_par **params = wo_grow(object->params, object->param_count, &object->param_capacity,
                              sizeof *object->params);
    if (params)
        object->params = params;
    if (!params || !par->name || !par->text || !par->handle || par->props.failed ||
        !wo_param_type_of(type, &par->kind, &par->dimension, &par->is_text)) {
        par_destroy(par);
        return NULL;
    }
    object->params[object->param_count++] = par;
    return par;
}

static wo_port *port_new(wo_object *object, const char *name)
{
    wo_port *port = calloc(1, sizeof *port);
    if (!port)
        return NULL;
    port->owner = object;
    port->name = wo_text_copy(name);
    port->carries = wo_text_copy("");
    port->handle = wo_handle_add(WO_HANDLE_CLIP, port);
    wo_props_init(&port->props, object->host, object->instance ? WO_PROPS_NEVER : WO_PROPS_DESCRIBE,
                  "clip \"%.80s\"", name);
    wo_port **ports =
        wo_grow(object->ports, object->port_count, &object->port_capacity, sizeof *object->ports);
    if (ports)
        object->ports = ports;
    if (!ports || !port->name || !port->carries || !port->handle || port->props.failed) {
        port_destroy(port);
        return NULL;
    }
    port->output = strcmp(name, kOfxImageEffectOutputClipName) == 0;
    object->ports[object->port_count++] = port;
    return port;
}

wo_par *wo_object_add_param(wo_object *object, const char *type, const char *name)
{
    wo_par *par = par_new(object, type, name);
    if (!par)
        return NULL;
    if (!wo_schema_param(&par->props, type, name) || par->props.failed) {
        object->param_count--;
        par_destroy(par);
        return NULL;
    }
    return par;
}

wo_port *wo_object_add_port(wo_object *object, const char *name)
{
    wo_port *port = port_new(object, name);
    if (!port)
        return NULL;
    wo_schema_clip(&port->props, name);
    if (port->props.failed) {
        object->port_count--;
        port_destroy(port);
        return NULL;
    }
    return port;
}

/* What a plugin may change on a parameter of an instance. */
static const char *const instance_writes[] = {
    kOfxParamPropEnabled,      kOfxParamPropSecret,     kOfxPropLabel,
    kOfxPropShortLabel,        kOfxPropLongLabel,       kOfxParamPropHint,
    kOfxParamPropMin,          kOfxParamPropMax,        kOfxParamPropDisplayMin,
    kOfxParamPropDisplayMax,   kOfxParamPropDataPtr,    kOfxParamPropEvaluateOnChange,
    kOfxParamPropChoiceOption, kOfxParamPropChoiceEnum, kOfxParamPropChoiceOrder,
    kOfxParamPropGroupOpen,    kOfxParamPropDefault,    kOfxParamPropShowTimeMarker,
    kOfxParamPropIncrement,    kOfxParamPropDigits,
};

/* Defaults of positions and sizes may be given as fractions of the project. */
static void denormalise(wo_par *par, const wo_host_project *project)
{
    const char *type = wo_props_text(&par->props, kOfxParamPropDoubleType, 0, "");
    const char *system = wo_props_text(&par->props, kOfxParamPropDefaultCoordinateSystem, 0, "");
    if (strcmp(system, kOfxParamCoordinatesNormalised) != 0)
        return;
    const bool absolute = strstr(type, "Absolute") != NULL;
    int axis = -1; /* of value 0 */
    if (strncmp(type, kOfxParamDoubleTypeX, strlen(kOfxParamDoubleTypeX)) == 0)
        axis = 0;
    else if (strncmp(type, kOfxParamDoubleTypeY, strlen(kOfxParamDoubleTypeY)) == 0)
        axis = 1;
    for (int i = 0; axis >= 0 && i < par->dimension && axis + i < 2; i++) {
        par->value[i] *= project->size[axis + i];
        if (absolute)
            par->value[i] += project->offset[axis + i];
    }
}

static bool copy_param(wo_object *to, const wo_par *from, const wo_host_project *project)
{
    wo_par *par = par_new(to, wo_props_text(&from->props, kOfxParamPropType, 0, ""), from->name);
    if (!par)
        return false;
    wo_props_copy(&par->props, &from->props);
    wo_props_set_text(&par->props, kOfxPropType, 0, kOfxTypeParameterInstance);
    for (size_t i = 0; i < WO_COUNT(instance_writes); i++)
        wo_props_allow(&par->props, instance_writes[i]);
    for (int i = 0; i < par->dimension; i++)
        par->value[i] = wo_par_is_integer(par)
                            ? wo_props_int(&par->props, kOfxParamPropDefault, i, 0)
                            : wo_props_double(&par->props, kOfxParamPropDefault, i, 0);
    denormalise(par, project);
    if (par->is_text &&
        !wo_text_set(&par->text, wo_props_text(&par->props, kOfxParamPropDefault, 0, "")))
        return false;
    return !par->props.failed;
}

static bool copy_port(wo_object *to, const wo_port *from)
{
    wo_port *port = port_new(to, from->name);
    if (!port)
        return false;
    wo_props_copy(&port->props, &from->props);
    wo_schema_clip_instance(&port->props);
    return !port->props.failed;
}

bool wo_object_copy(wo_object *to, const wo_object *from, const wo_host_project *project)
{
    for (size_t i = 0; i < from->param_count; i++)
        if (!copy_param(to, from->params[i], project))
            return false;
    for (size_t i = 0; i < from->port_count; i++)
        if (!copy_port(to, from->ports[i]))
            return false;
    wo_props_copy(&to->param_set_props, &from->param_set_props);
    wo_props_allow(&to->param_set_props, kOfxPropParamSetNeedsSyncing);
    return !to->param_set_props.failed;
}
