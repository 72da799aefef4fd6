/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_BRIDGE_GUARD_HH
#define WO_BRIDGE_GUARD_HH

#include "wideopen/status.h"

#include <exception>
#include <new>

/* Runs the body of an extern "C" function; whatever a foreign library throws becomes a status, and
   its words go into *error. The only place where exceptions are caught. */
template <typename Body>
wo_status wo_guard(wo_error *error, const char *where, Body body) noexcept
{
    try {
        return body();
    } catch (const std::bad_alloc &) {
        return wo_fail(error, WO_ERR_NOMEM, "%s: out of memory", where);
    } catch (const std::exception &problem) {
        return wo_fail(error, WO_ERR_LIBRARY, "%s: %s", where, problem.what());
    } catch (...) {
        return wo_fail(error, WO_ERR_LIBRARY, "%s: a library threw something unknown", where);
    }
}

#endif
