/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "render_report.h"

#include "text_file.h"

#include <stdlib.h>
#include <string.h>

bool wo_record_begin(wo_record *record, wo_host_instance *instance, double time)
{
    record->plugin = wo_host_instance_plugin(instance);
    record->context = wo_host_instance_context(instance);
    record->params = calloc(record->context->param_count + 1, sizeof *record->params);
    if (!record->params)
        return false;
    for (size_t i = 0; i < record->context->param_count; i++) {
        const wo_host_param_info *const info = &record->context->params[i];
        char value[4096];
        if (wo_host_param_get_text(instance, info->name, time, value, sizeof value) < 0)
            continue;
        wo_param_record *const param = &record->params[record->param_count];
        param->name = info->script_name;
        param->keys = wo_host_param_key_count(instance, info->name);
        param->value = strdup(value);
        if (!param->value)
            return false;
        record->param_count++;
    }
    return true;
}

wo_frame_record *wo_record_next(wo_record *record, int frame)
{
    wo_frame_record *const frames =
        realloc(record->frames, (record->frame_count + 1) * sizeof *frames);
    if (!frames)
        return NULL;
    record->frames = frames;
    wo_frame_record *const next = &frames[record->frame_count++];
    *next = (wo_frame_record){.frame = frame};
    return next;
}

bool wo_record_add_warning(wo_record *record, const char *key, const char *text)
{
    wo_warning_record *const warnings =
        realloc(record->warnings, (record->warning_count + 1) * sizeof *warnings);
    if (!warnings)
        return false;
    record->warnings = warnings;
    wo_warning_record *const next = &warnings[record->warning_count];
    *next = (wo_warning_record){
        .frame = record->frame_count ? record->frames[record->frame_count - 1].frame : 0,
        .key = strdup(key),
        .text = strdup(text)};
    if (!next->key || !next->text) {
        free(next->key);
        free(next->text);
        return false;
    }
    record->warning_count++;
    return true;
}

bool wo_record_warn(wo_record *record, const char *key, const char *text)
{
    for (size_t i = 0; i < record->warning_count; i++)
        if (strcmp(record->warnings[i].key, key) == 0)
            return true;
    return wo_record_add_warning(record, key, text);
}

/* "KEY: TEXT" */
static bool keep_warning(wo_record *record, const char *said)
{
    char key[64];
    const char *const colon = strstr(said, ": ");
    if (!colon || (size_t)(colon - said) >= sizeof key)
        return wo_record_warn(record, said, said);
    snprintf(key, sizeof key, "%.*s", (int)(colon - said), said);
    return wo_record_warn(record, key, colon + 2);
}

bool wo_record_publish(wo_record *record, const char *kind, const char *text)
{
    if (strcmp(kind, "warning") == 0)
        return keep_warning(record, text);
    wo_frame_record *const frame = &record->frames[record->frame_count - 1];
    const bool report = strcmp(kind, "report") == 0;
    if (!report && strcmp(kind, "plan") != 0)
        return true;
    char *const copy = strdup(text);
    if (!copy)
        return false;
    if (!report) {
        free(frame->plan);
        frame->plan = copy;
        return true;
    }
    char **const reports =
        realloc(frame->reports, (frame->report_count + 1) * sizeof *frame->reports);
    if (!reports) {
        free(copy);
        return false;
    }
    frame->reports = reports;
    reports[frame->report_count++] = copy;
    return true;
}

void wo_record_free(wo_record *record)
{
    for (size_t i = 0; i < record->frame_count; i++) {
        wo_frame_record *const frame = &record->frames[i];
        for (size_t k = 0; k < frame->report_count; k++)
            free(frame->reports[k]);
        free(frame->reports);
        free(frame->plan);
        free(frame->output);
        free(frame->space);
    }
    for (size_t i = 0; i < record->param_count; i++)
        free(record->params[i].value);
    for (size_t i = 0; i < record->warning_count; i++) {
        free(record->warnings[i].key);
        free(record->warnings[i].text);
    }
    free(record->warnings);
    free(record->params);
    free(record->frames);
    *record = (wo_record){0};
}

/* Sum of "rays" over the reports; false when there is none. A copy of a clip takes no rays. */
static bool frame_rays(const wo_frame_record *frame, double *rays)
{
    bool known = frame->identity;
    *rays = 0;
    for (size_t i = 0; i < frame->report_count; i++) {
        const char *begin;
        size_t length;
        if (wo_json_valid(frame->reports[i]) &&
            wo_json_find(frame->reports[i], "rays", &begin, &length)) {
            *rays += strtod(begin, NULL);
            known = true;
        }
    }
    return known;
}

static void write_frame(wo_json *json, const wo_frame_record *frame)
{
    double rays;
    wo_json_object(json, NULL);
    wo_json_integer(json, "frame", frame->frame);
    wo_json_text(json, "output", frame->output);
    wo_json_bool(json, "skipped", frame->skipped);
    wo_json_text(json, "space", frame->space);
    const wo_rect w = frame->window;
    wo_json_numbers(json, "window", (const double[]){w.x1, w.y1, w.x2, w.y2}, 4);
    wo_json_text(json, "identity", frame->identity ? frame->identity_clip : NULL);
    wo_json_integer(json, "actions", frame->actions);
    wo_json_object(json, "seconds");
    wo_json_number(json, "read", frame->read_seconds);
    wo_json_number(json, "render", frame->render_seconds);
    wo_json_number(json, "write", frame->write_seconds);
    wo_json_close(json);
    if (frame_rays(frame, &rays))
        wo_json_number(json, "rays", rays);
    else
        wo_json_text(json, "rays", NULL);
    wo_json_array(json, "reports");
    for (size_t i = 0; i < frame->report_count; i++)
        wo_json_raw(json, NULL, frame->reports[i]);
    wo_json_close(json);
    wo_json_text(json, "plan", frame->plan);
    wo_json_close(json);
}

static void write_clips(wo_json *json, const wo_inputs *inputs)
{
    wo_json_object(json, "clips");
    for (size_t i = 0; wo_inputs_at(inputs, i); i++) {
        const wo_input *const input = wo_inputs_at(inputs, i);
        wo_json_object(json, wo_input_clip(input));
        wo_json_text(json, "file", wo_input_file(input));
        wo_json_text(json, "space", wo_input_space(input));
        wo_json_close(json);
    }
    wo_json_close(json);
}

static void write_params(wo_json *json, const wo_record *record)
{
    wo_json_object(json, "params");
    for (size_t i = 0; i < record->param_count; i++)
        wo_json_text(json, record->params[i].name, record->params[i].value);
    wo_json_close(json);
    wo_json_object(json, "keys");
    for (size_t i = 0; i < record->param_count; i++)
        if (record->params[i].keys > 0)
            wo_json_integer(json, record->params[i].name, record->params[i].keys);
    wo_json_close(json);
}

static void write_warnings(wo_json *json, const wo_record *record)
{
    wo_json_array(json, "warnings");
    for (size_t i = 0; i < record->warning_count; i++) {
        wo_json_object(json, NULL);
        wo_json_integer(json, "frame", record->warnings[i].frame);
        wo_json_text(json, "key", record->warnings[i].key);
        wo_json_text(json, "text", record->warnings[i].text);
        wo_json_close(json);
    }
    wo_json_close(json);
}

static void write_sums(wo_json *json, const wo_record *record)
{
    double total = 0;
    bool known = record->frame_count > 0;
    for (size_t i = 0; i < record->frame_count; i++) {
        double rays;
        known = frame_rays(&record->frames[i], &rays) && known;
        total += rays;
    }
    if (known)
        wo_json_number(json, "rays", total);
    else
        wo_json_text(json, "rays", NULL);
    wo_json_number(json, "seconds", record->seconds);
}

void wo_record_write(const wo_record *record, wo_host *host, const wo_inputs *inputs,
                     const wo_error *failed, FILE *out)
{
    const wo_host_plugin *const plugin = record->plugin;
    char version[32];
    snprintf(version, sizeof version, "%u.%u", plugin->version_major, plugin->version_minor);
    wo_json json;
    wo_json_begin(&json, out);
    wo_json_object(&json, NULL);
    wo_json_text(&json, "wideopen", WO_VERSION_TEXT);
    wo_json_text(&json, "plugin", plugin->identifier);
    wo_json_text(&json, "version", version);
    wo_json_text(&json, "context", record->context->short_name);
    wo_json_integer(&json, "threads", wo_host_threads(host));
    write_clips(&json, inputs);
    write_params(&json, record);
    wo_json_array(&json, "frames");
    for (size_t i = 0; i < record->frame_count; i++)
        write_frame(&json, &record->frames[i]);
    wo_json_close(&json);
    write_sums(&json, record);
    write_warnings(&json, record);
    wo_json_array(&json, "violations");
    for (size_t i = 0; i < wo_host_violation_count(host); i++)
        wo_json_text(&json, NULL, wo_host_violation(host, i));
    wo_json_close(&json);
    wo_json_bool(&json, "ok", !failed);
    wo_json_text(&json, "error", failed ? failed->text : NULL);
    wo_json_close(&json);
}

wo_status wo_record_save(const wo_record *record, wo_host *host, const wo_inputs *inputs,
                         const wo_error *failed, const char *path, wo_error *error)
{
    wo_text_out out;
    WO_TRY(wo_text_begin(&out, path, error));
    wo_record_write(record, host, inputs, failed, out.file);
    return wo_text_end(&out, error);
}
