/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "effects/lens_blur.h"

#include <string.h>

const wo_effect *const wo_effects[] = {&wo_lens_blur, NULL};

const wo_effect *wo_effect_find(const char *name)
{
    for (size_t i = 0; wo_effects[i]; i++)
        if (strcmp(wo_effects[i]->name, name) == 0)
            return wo_effects[i];
    return NULL;
}

wo_status wo_effect_run(const wo_effect *effect, const wo_context *context, const void *params,
                        const wo_plan_args *args, const wo_image *output, wo_report *report,
                        wo_error *error)
{
    wo_plan *plan = NULL;
    WO_TRY(effect->plan_create(context, params, args, &plan, error));
    const wo_status status = effect->render(plan, args->window, output, report, error);
    effect->plan_destroy(&plan);
    return status;
}
