/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "ofx_host_stub/cli/args.h"
#include "ofx_host_stub/cli/command.h"
#include "ofx_host_stub/cli/frames.h"
#include "ofx_host_stub/cli/json.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* --------------------------------------------------------------------------------------- frames */

static void check_frames(const char *text, const int *expected, size_t count)
{
    wo_frames frames;
    assert_int_equal(wo_frames_read(text, &frames, NULL), WO_OK);
    assert_int_equal(frames.count, count);
    for (size_t i = 0; i < count; i++)
        assert_int_equal(frames.numbers[i], expected[i]);
    wo_frames_free(&frames);
    assert_null(frames.numbers);
}

static void test_frames(void **state)
{
    (void)state;
    check_frames("12", (const int[]){12}, 1);
    check_frames("1-4", (const int[]){1, 2, 3, 4}, 4);
    check_frames("1-10x4", (const int[]){1, 5, 9}, 3);
    check_frames("-2--1,7", (const int[]){-2, -1, 7}, 3);
    check_frames("5,1-2", (const int[]){5, 1, 2}, 3);
}

static void test_frames_summary(void **state)
{
    static const struct {
        const char *text;
        int first, last, step;
    } cases[] = {{"1-9x2", 1, 9, 2}, {"3", 3, 3, 1}, {"9,1", 1, 9, 1}, {"1,3,4", 1, 4, 1}};
    (void)state;
    for (size_t i = 0; i < WO_COUNT(cases); i++) {
        wo_frames frames;
        assert_int_equal(wo_frames_read(cases[i].text, &frames, NULL), WO_OK);
        assert_int_equal(frames.first, cases[i].first);
        assert_int_equal(frames.last, cases[i].last);
        assert_int_equal(frames.step, cases[i].step);
        wo_frames_free(&frames);
    }
}

static void test_frames_refused(void **state)
{
    static const char *const wrong[] = {"",
                                        "a",
                                        "1-",
                                        "4-1",
                                        "1-5x0",
                                        "1-5x-1",
                                        "1,",
                                        ",1",
                                        "1 -3",
                                        "1.5",
                                        "1x2",
                                        " 1",
                                        "1-2-3",
                                        "0x10",
                                        "--1",
                                        "1-5x",
                                        "1,,2",
                                        "1;2",
                                        "9999999999999999999",
                                        "0-1000000",
                                        "0-999999,5"};
    (void)state;
    for (size_t i = 0; i < WO_COUNT(wrong); i++) {
        wo_frames frames;
        wo_error error = {0};
        assert_int_not_equal(wo_frames_read(wrong[i], &frames, &error), WO_OK);
        assert_null(frames.numbers);
        assert_int_equal(frames.count, 0);
        assert_true(error.text[0] != '\0');
    }
}

/* ----------------------------------------------------------------------------------------- JSON */

/* What the writer makes of the calls in fill, as a malloc-ed string. */
static char *written(void (*fill)(wo_json *json))
{
    char *text = NULL;
    size_t size = 0;
    FILE *const out = open_memstream(&text, &size);
    assert_non_null(out);
    wo_json json;
    wo_json_begin(&json, out);
    fill(&json);
    fclose(out);
    return text;
}

static void fill_all(wo_json *json)
{
    wo_json_object(json, NULL);
    wo_json_text(json, "quotes", "a \"b\" \\ \n \t \x01 \xC3\xA4");
    wo_json_text(json, "broken", "\xFF\xC3(\xED\xA0\x80");
    wo_json_text(json, "none", NULL);
    wo_json_number(json, "tenth", 0.1);
    wo_json_number(json, "third", 1.0 / 3.0);
    wo_json_number(json, "nan", (double)NAN);
    wo_json_number(json, "infinite", -(double)INFINITY);
    wo_json_integer(json, "big", -9007199254740993LL);
    wo_json_bool(json, "yes", true);
    wo_json_array(json, "empty");
    wo_json_close(json);
    wo_json_array(json, "list");
    wo_json_number(json, NULL, 1e300);
    wo_json_raw(json, NULL, " {\"inner\": [1, 2]} \n");
    wo_json_raw(json, NULL, "{broken");
    wo_json_close(json);
    wo_json_close(json);
}

static void check_value(const char *text, const char *path, const char *expected)
{
    const char *begin = NULL;
    size_t length = 0;
    assert_true(wo_json_find(text, path, &begin, &length));
    assert_int_equal(length, strlen(expected));
    assert_memory_equal(begin, expected, length);
}

static void test_json_round_trip(void **state)
{
    (void)state;
    char *const text = written(fill_all);
    assert_true(wo_json_valid(text));
    check_value(text, "quotes", "\"a \\\"b\\\" \\\\ \\n \\u0009 \\u0001 \xC3\xA4\"");
    check_value(text, "broken", "\"\\ufffd\\ufffd(\\ufffd\\ufffd\\ufffd\"");
    check_value(text, "none", "null");
    check_value(text, "tenth", "0.1");
    check_value(text, "nan", "null");
    check_value(text, "infinite", "null");
    check_value(text, "big", "-9007199254740993");
    check_value(text, "yes", "true");
    check_value(text, "empty", "[]");
    check_value(text, "list.0", "1e+300");
    check_value(text, "list.1.inner.1", "2");
    check_value(text, "list.2", "\"{broken\"");
    const char *begin;
    size_t length;
    assert_true(wo_json_find(text, "third", &begin, &length));
    assert_true(strtod(begin, NULL) == 1.0 / 3.0);
    free(text);
}

static void test_json_paths(void **state)
{
    static const char text[] = "{\"a\": {\"b\": [10, {\"c\": \"x.y\"}]}, \"ab\": 1}";
    static const char *const missing[] = {"b",  "a.c", "a.b.2", "a.b.x", "a.b.-1",    "a.b.0.c",
                                          "a.", ".a",  "a..b",  "ab.0",  "a.b.1.c.d", "a.b.+1"};
    (void)state;
    check_value(text, "", text);
    check_value(text, "a.b.0", "10");
    check_value(text, "a.b.1.c", "\"x.y\"");
    check_value(text, "ab", "1");
    for (size_t i = 0; i < WO_COUNT(missing); i++) {
        const char *begin;
        size_t length;
        assert_false(wo_json_find(text, missing[i], &begin, &length));
    }
}

static void test_json_validity(void **state)
{
    static const char *const good[] = {"0",    "-0.5e+3", "\"\\u00e4\"", "[]",
                                       " {} ", "[[],{}]", "null",        "{\"a\":[true,false]}"};
    static const char *const bad[] = {
        "",        "01",          "1.",  ".5",    "+1",       "1e",    "nan",
        "tru",     "[1,]",        "{,}", "{a:1}", "{\"a\"}",  "[1 2]", "\"",
        "\"\\x\"", "\"\\u12g4\"", "[",   "{} {}", "\"a\nb\"", "]"};
    (void)state;
    for (size_t i = 0; i < WO_COUNT(good); i++)
        assert_true(wo_json_valid(good[i]));
    for (size_t i = 0; i < WO_COUNT(bad); i++)
        assert_false(wo_json_valid(bad[i]));
    char deep[4001];
    memset(deep, '[', 2000);
    memset(deep + 2000, ']', 2000);
    deep[4000] = '\0';
    assert_false(wo_json_valid(deep)); /* refused, not overflowed */
}

/* ------------------------------------------------------------------------------------ arguments */

static const wo_option test_options[] = {
    {"--output", "-o", "FILE", "Where to.", false},
    {"--set", NULL, "NAME=VALUE", "A value.", true},
    {"--count", NULL, "N", "How many.", false},
    {"--json", NULL, NULL, "Print JSON.", false},
};

static const wo_usage test_usage = {
    .command = "test",
    .synopsis = "WORD",
    .about = "A command.",
    .positionals = "WORD",
    .positionals_min = 1,
    .positionals_max = 2,
    .options = test_options,
    .option_count = WO_COUNT(test_options),
};

static int read_words(wo_args *args, const char *const *words)
{
    char *argv[16] = {NULL};
    int argc = 0;
    for (; words[argc]; argc++)
        argv[argc] = (char *)words[argc]; /* argv is not written to */
    return wo_args_read(args, &test_usage, argc, argv);
}

#define WORDS(...) ((const char *const[]){"test", __VA_ARGS__, NULL})

static void test_args(void **state)
{
    (void)state;
    wo_args args;
    int count = 7;
    assert_int_equal(read_words(&args, WORDS("a", "-oout", "--set", "x=-1", "--set=y=2", "--count",
                                             "-3", "--json", "--", "--b")),
                     WO_EXIT_OK);
    assert_int_equal(args.positional_count, 2);
    assert_string_equal(args.positionals[1], "--b");
    assert_string_equal(wo_args_value(&args, "--output", 0), "out");
    assert_int_equal(wo_args_count(&args, "--set"), 2);
    assert_string_equal(wo_args_value(&args, "--set", 0), "x=-1");
    assert_string_equal(wo_args_value(&args, "--set", 1), "y=2");
    assert_null(wo_args_value(&args, "--set", 2));
    assert_int_equal(wo_args_count(&args, "--json"), 1);
    assert_true(wo_args_int(&args, "--count", -5, 5, &count));
    assert_int_equal(count, -3);
    assert_false(wo_args_int(&args, "--count", 0, 5, &count));
    wo_args_free(&args);
}

static void test_args_refused(void **state)
{
    const char *const *const wrong[] = {WORDS("a", "--ouput", "x"),
                                        WORDS("a", "--output"),
                                        WORDS("a", "--output", "--json"),
                                        WORDS("a", "-o", "x", "-o", "y"),
                                        WORDS("a", "--json=1"),
                                        WORDS("a", "-x"),
                                        WORDS("--json"),
                                        WORDS("a", "b", "c")};
    (void)state;
    for (size_t i = 0; i < WO_COUNT(wrong); i++) {
        wo_args args;
        assert_int_equal(read_words(&args, wrong[i]), WO_EXIT_USAGE);
        wo_args_free(&args);
    }
    wo_args args;
    assert_int_equal(read_words(&args, WORDS("--help")), WO_EXIT_OK);
    assert_true(args.help);
    wo_args_free(&args);
}

static void test_numbers(void **state)
{
    (void)state;
    double v[4];
    int width = 0, height = 0;
    assert_true(wo_read_numbers("-1,2.5,1e3,0", v, 4));
    assert_true(v[0] == -1 && v[1] == 2.5 && v[2] == 1000 && v[3] == 0);
    assert_false(wo_read_numbers("1,2,3", v, 4));
    assert_false(wo_read_numbers("1,2,3,4,5", v, 4));
    assert_false(wo_read_numbers("1, 2", v, 2));
    assert_false(wo_read_numbers("nan", v, 1));
    assert_false(wo_read_numbers("inf", v, 1));
    assert_false(wo_read_numbers("", v, 1));
    assert_true(wo_read_size("640x360", &width, &height));
    assert_int_equal(width, 640);
    assert_int_equal(height, 360);
    assert_false(wo_read_size("0x3", &width, &height));
    assert_false(wo_read_size("3x", &width, &height));
    assert_false(wo_read_size("65537x1", &width, &height));
    assert_false(wo_read_size("3x3x", &width, &height));
    assert_false(wo_read_size("-3x3", &width, &height));
}

static void test_near_words(void **state)
{
    static const char *const words[] = {"focalLength", "fStop", "samples", "seed"};
    char near[128];
    (void)state;
    assert_int_equal(wo_near_words("fstop", words, WO_COUNT(words), near, sizeof near), 1);
    assert_string_equal(near, "fStop");
    assert_int_equal(wo_near_words("focalLenght", words, WO_COUNT(words), near, sizeof near), 1);
    assert_string_equal(near, "focalLength");
    assert_int_equal(wo_near_words("zzzzzz", words, WO_COUNT(words), near, sizeof near), 0);
    assert_string_equal(near, "focalLength, fStop, samples, seed");
    char small[8];
    wo_near_words("zzzzzz", words, WO_COUNT(words), small, sizeof small);
    assert_string_equal(small, "focalLe");
}

/* ------------------------------------------------------------------------------------- messages */

static void test_clean_text(void **state)
{
    static const struct {
        const char *given, *wanted;
    } cases[] = {
        {"plain \t text\n", "plain \t text\n"},
        {"\x1b[2J\x1b]0;title\x07", "\\x1b[2J\\x1b]0;title\\x07"},
        {"back\bspace\rreturn\x7f", "back\\x08space\\x0dreturn\\x7f"},
        {"gr\xc3\xbc\xc3\x9f"
         "e \xe2\x82\xac \xf0\x9f\x93\xb7",
         "gr\xc3\xbc\xc3\x9f"
         "e \xe2\x82\xac \xf0\x9f\x93\xb7"},
        {"\xc2\x9b"
         "31m",
         "\\xc2\\x9b31m"}, /* the one character that begins as ESC [ does */
        {"\x9b"
         "31m",
         "\\x9b31m"},
        {"cut \xe2\x82", "cut \\xe2\\x82"},
        {"\xc0\x9b\xe0\x80\x9b", "\\xc0\\x9b\\xe0\\x80\\x9b"}, /* written longer than needed */
        {"\xff\xf8", "\\xff\\xf8"},
    };
    (void)state;
    for (size_t i = 0; i < WO_COUNT(cases); i++) {
        char text[128] = "";
        FILE *const out = tmpfile();
        assert_non_null(out);
        wo_put_clean(cases[i].given, out);
        rewind(out);
        text[fread(text, 1, sizeof text - 1, out)] = '\0';
        fclose(out);
        assert_string_equal(text, cases[i].wanted);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_frames),         cmocka_unit_test(test_frames_summary),
        cmocka_unit_test(test_frames_refused), cmocka_unit_test(test_json_round_trip),
        cmocka_unit_test(test_json_paths),     cmocka_unit_test(test_json_validity),
        cmocka_unit_test(test_args),           cmocka_unit_test(test_args_refused),
        cmocka_unit_test(test_numbers),        cmocka_unit_test(test_near_words),
        cmocka_unit_test(test_clean_text),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
