/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */

/* Damaged texts: whatever they are, reading them ends well, stays within them, and what is accepted
   is a prescription that can be written and read again. */
#include "prescription_test.h"

#include "scenes.h"

#include <stdlib.h>

enum { CASES = 20000, TEXT_MAX = 8192 };

/* The texts of all designs, and a file of pbrt. */
enum { SEEDS = 31 };
static char seeds[SEEDS][TEXT_MAX];

static int make_seeds(void **state)
{
    (void)state;
    strcpy(seeds[0], "# radius sep n aperture\n29.475 3.76 1.67 25.2\n84.83 0.12 1 25.2\n"
                     "0 4.2 0 17\n-40 6.44 1.699 16\n100 2 1 16\n");
    for (size_t i = 1; i < SEEDS; i++) {
        wo_prescription lens;
        const char *const name = wo_lens_name_at(i - 1);
        if (!name || wo_lens_find(name, &lens, NULL) != WO_OK ||
            wo_prescription_print(&lens, seeds[i], TEXT_MAX) >= TEXT_MAX)
            return -1;
    }
    return 0;
}

static char random_byte(rng *r)
{
    static const char likely[] = "0123456789.-+eE#/= \t\n\r\0kAxystopcinf\xc3\xa9";
    return rng_int(r, 0, 3) ? likely[rng_int(r, 0, (int32_t)sizeof likely - 2)]
                            : (char)(rng_int(r, 0, 255) - 128);
}

/* One small damage; returns the new length. */
static size_t damage(rng *r, char *text, size_t bytes)
{
    static const char *const pieces[] = {"surface 0 1 air 5 stop\n",
                                         "surface c=0.01 -3 N-BK7 0 A16=0\n",
                                         "1e308",
                                         "-1e-308",
                                         "title \xf0\x9f\x98\x80\n",
                                         "glass Q schott 2.3 0 0 0 0 0 400 700\n",
                                         "N-SF6",
                                         " 1.5/60 ",
                                         " A2=-1e-3 ",
                                         " k=-0 ",
                                         "inf",
                                         "0.0000000000000000000001"};
    if (bytes == 0)
        return 0;
    const size_t at = (size_t)(rng_unit(r) * (double)bytes);
    const char *piece;
    size_t length, most;
    switch (rng_int(r, 0, 4)) {
    case 0:
        text[at] = random_byte(r);
        return bytes;
    case 1:
        memmove(text + at, text + at + 1, bytes - at - 1);
        return bytes - 1;
    case 2: /* a piece of its own elsewhere */
        most = bytes - at < 40 ? bytes - at : 40;
        memmove(text + (size_t)(rng_unit(r) * (double)(bytes - most)), text + at, most);
        return bytes;
    case 3:
        piece = pieces[rng_int(r, 0, (int32_t)WO_COUNT(pieces) - 1)];
        length = strlen(piece);
        if (bytes + length > TEXT_MAX)
            return bytes;
        memmove(text + at + length, text + at, bytes - at);
        memcpy(text + at, piece, length);
        return bytes + length;
    default:
        return rng_int(r, 0, 19) == 0 ? at : bytes;
    }
}

/* In memory of exactly this size: an address checker sees a step beyond. True when accepted. */
static bool try_text(const char *text, size_t bytes)
{
    wo_error error = {WO_OK, ""};
    wo_prescription lens;
    char *const exact = malloc(bytes ? bytes : 1);
    assert_non_null(exact);
    memcpy(exact, text, bytes);
    const wo_status status = wo_prescription_parse(exact, bytes, "fuzz.lens", &lens, &error);
    free(exact);
    if (status != WO_OK) {
        assert_int_equal(error.status, status);
        assert_true(strncmp(error.text, "fuzz.lens:", 10) == 0);
        for (const char *at = error.text; *at; at++)
            assert_true(*at >= ' ' && *at <= '~');
        assert_int_equal(lens.count, 0);
        return false;
    }
    if (wo_prescription_validate(&lens, &error) != WO_OK)
        fail_msg("accepted, but: %s", error.text);
    const char *const wrong = round_trip(&lens, &error);
    if (wrong)
        fail_msg("does not round-trip: %s", wrong);
    return true;
}

static void damaged_designs(void **state)
{
    (void)state;
    static char text[TEXT_MAX];
    rng r = {20240917};
    int accepted = 0;
    for (int i = 0; i < CASES; i++) {
        const char *const seed = seeds[rng_int(&r, 0, SEEDS - 1)];
        size_t bytes = strlen(seed);
        memcpy(text, seed, bytes);
        for (int32_t count = rng_int(&r, 0, 5); count > 0; count--)
            bytes = damage(&r, text, bytes);
        accepted += try_text(text, bytes);
    }
    /* Both ways are well travelled. */
    assert_in_range(accepted, CASES / 10, CASES * 9 / 10);
}

static void every_truncation(void **state)
{
    (void)state;
    static char text[TEXT_MAX];
    wo_error error = {WO_OK, ""};
    wo_prescription lens;
    if (wo_lens_find("masterprime_zeiss_asph", &lens, &error) != WO_OK)
        fail_msg("%s", error.text);
    const size_t bytes = wo_prescription_print(&lens, text, sizeof text);
    assert_true(bytes < sizeof text);
    for (size_t length = 0; length < bytes; length++)
        try_text(text, length);
    assert_true(try_text(text, bytes));
}

static void random_bytes(void **state)
{
    (void)state;
    static char text[TEXT_MAX];
    rng r = {7};
    for (int i = 0; i < CASES / 4; i++) {
        const size_t bytes = (size_t)rng_int(&r, 0, 400);
        const size_t head = rng_int(&r, 0, 1) ? 7 : 0;
        for (size_t k = 0; k < bytes; k++)
            text[k] = random_byte(&r);
        if (bytes >= head)
            memcpy(text, "lens 1\n", head);
        try_text(text, bytes);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(damaged_designs),
        cmocka_unit_test(every_truncation),
        cmocka_unit_test(random_bytes),
    };
    return cmocka_run_group_tests_name("prescription_fuzz", tests, make_seeds, NULL);
}
