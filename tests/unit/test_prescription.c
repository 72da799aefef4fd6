/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "prescription_test.h"

#include "scenes.h"

#include <stdio.h>

static const char complete[] =
    "\xef\xbb\xbf# a comment\r\n"
    "lens 1 # the format\r\n"
    "name my_lens-2\n"
    "\ttitle  Doublet #3, \xc3\xa9t\xc3\xa9 \t\r\n"
    "source a book\n"
    "note one\n"
    "note two\n"
    "focal 50\r\n"
    "fnumber 2.8\n"
    "field 20.5\n"
    "glass Mine sellmeier 1.03961212 0.231792344 1.01046945 0.00600069867 0.0200179144 "
    "103.560653 300 2500\n"
    "glass Old schott 2.2718929 -1.0108077e-2 1.0592509e-2 2.0816965e-4 -7.6472538e-6 "
    "4.9240991e-7 365 1014\n"
    "\n"
    "surface 40 5 mine 12 k=-1.5 A2=1e-9 A8=2e-12 A16=0 cylinder=y\n"
    "surface -60 1.5e0 n-SF6 12#comment\n"
    "surface inf -0.5 Air 0\n"
    "surface 0 2 old 5 stop\n"
    "surface c=0.01 +2 1.5 5 cylinder=x\n"
    "surface -1e9 2 1.5168/64.17 5\n"
    "surface 100 40.25 air 10";

static void every_word_of_the_format(void **state)
{
    (void)state;
    const wo_prescription lens = parse_as(complete, "file.lens");
    assert_string_equal(lens.name, "my_lens-2");
    assert_string_equal(lens.title, "Doublet #3, \xc3\xa9t\xc3\xa9");
    assert_string_equal(lens.source, "a book");
    assert_true(lens.focal_mm == 50 && lens.f_number == 2.8 && lens.half_field == 20.5);
    assert_int_equal(lens.count, 7);
    assert_int_equal(lens.stop, 3);
    const wo_surface *const s = lens.surface;
    assert_true(s[0].curvature == 1.0 / 40 && s[0].thickness == 5 && s[0].semi_aperture == 12);
    assert_true(s[0].conic == -1.5 && s[0].asphere[0] == 1e-9 && s[0].asphere[3] == 2e-12);
    assert_int_equal(s[0].asphere_terms, 8);
    assert_int_equal(s[0].meridian, WO_MERIDIAN_Y);
    assert_string_equal(s[0].glass.name, "Mine");
    assert_near(s[0].glass.nd, 1.5168, 1e-6);
    assert_string_equal(s[1].glass.name, "N-SF6");
    assert_true(s[1].thickness == 1.5 && s[1].asphere_terms == 0);
    assert_true(s[2].curvature == 0 && s[2].thickness == -0.5 && s[2].semi_aperture == 0);
    assert_string_equal(s[2].glass.name, "air");
    assert_true(s[3].stop && !s[2].stop);
    assert_int_equal(s[3].glass.kind, WO_DISPERSION_SCHOTT);
    assert_true(s[4].curvature == 0.01);
    assert_int_equal(s[4].glass.kind, WO_DISPERSION_NONE);
    assert_int_equal(s[4].meridian, WO_MERIDIAN_X);
    assert_true(s[5].curvature == 1 / -1e9);
    assert_true(s[5].glass.kind == WO_DISPERSION_ABBE && s[5].glass.vd == 64.17);
    assert_true(s[6].thickness == 40.25);
    wo_error error = {WO_OK, ""};
    assert_null(round_trip(&lens, &error));
}

/* The example of the page is one of the designs. */
static void example_of_the_page(void **state)
{
    (void)state;
    static char page[LENS_TEXT_SIZE];
    FILE *const file = fopen(WO_LENS_PAGE, "rb");
    assert_non_null(file);
    page[fread(page, 1, sizeof page - 1, file)] = '\0';
    fclose(file);
    char *const from = strstr(page, "```\n");
    assert_non_null(from);
    char *const to = strstr(from + 4, "```");
    assert_non_null(to);
    *to = '\0';
    const wo_prescription lens = parse_as(from + 4, "page");
    const wo_prescription design = builtin(lens.name);
    const char *const wrong = difference(&lens, &design);
    if (wrong)
        fail_msg("%s differs", wrong);
}

static void names_from_files(void **state)
{
    (void)state;
    const char *const text = "lens 1\nsurface 50 5 1.5 10 stop\n";
    assert_string_equal(parse_as(text, "/a/b.c/My lens.v2.lens").name, "My_lens_v2");
    assert_string_equal(parse_as(text, "plain").name, "plain");
    assert_string_equal(parse_as(text, ".lens").name, "_lens");
    assert_string_equal(parse_as(text, "").name, "lens");
    assert_string_equal(parse_as(text, NULL).name, "lens");
    char path[300];
    memset(path, 'x', sizeof path);
    path[299] = '\0';
    assert_int_equal(strlen(parse_as(text, path).name), 63);
}

static void pbrt_files(void **state)
{
    (void)state;
    const char *const text = "# D-GAUSS F/2 22deg HFOV\n# radius sep n aperture\n"
                             "29.475\t3.76\t1.67\t25.2\n84.83 0.12 1 25.2\n\n0 4.2 0 17.0 # iris\n"
                             " -40 6.44 1.699 16\n0 3 1 16\n100 2 0 16\n";
    const wo_prescription lens = parse_as(text, "dgauss.50mm.dat");
    assert_string_equal(lens.name, "dgauss_50mm");
    assert_int_equal(lens.count, 6);
    assert_int_equal(lens.stop, 2);
    assert_true(lens.surface[2].stop && lens.surface[2].semi_aperture == 8.5);
    assert_string_equal(lens.surface[2].glass.name, "air");
    assert_true(lens.surface[0].glass.nd == 1.67 && lens.surface[0].semi_aperture == 12.6);
    assert_true(lens.surface[0].curvature == 1 / 29.475);
    /* A plane back of a glass is no iris, and an index of 0 is air. */
    assert_true(!lens.surface[4].stop && lens.surface[4].glass.nd == 1);
    assert_true(lens.surface[5].glass.nd == 1);
    wo_error error = {WO_OK, ""};
    assert_null(round_trip(&lens, &error));
    /* The iris within a glass leaves the glass. */
    const wo_prescription inside = parse_as("10 1 1.5 5\n0 1 0 4\n-10 9 1 5\n", "x.dat");
    assert_true(inside.surface[1].stop && inside.surface[1].glass.nd == 1.5);
}

#define HEAD "lens 1\n"
#define GOOD "surface 50 5 1.5 10 stop\n"

static void errors_name_the_line(void **state)
{
    (void)state;
    static const struct {
        const char *text, *line, *part;
    } rows[] = {
        {"", "f:1: ", "lens 1"},
        {"\n# only this\n", "f:2: ", "lens 1"},
        {"name x\n", "f:1: ", "\"name\""},
        {"lens 2\n", "f:1: ", "version 2"},
        {"lens\n", "f:1: ", "missing"},
        {"lens 1 1\n", "f:1: ", "nothing more"},
        {HEAD HEAD GOOD, "f:2: ", "twice"},
        {HEAD "focal 50\n" GOOD "focal 50\n", "f:4: ", "twice"},
        {HEAD "name a\nname a\n" GOOD, "f:3: ", "twice"},
        {HEAD "colour red\n" GOOD, "f:2: ", "\"colour\""},
        {HEAD "Name x\n" GOOD, "f:2: ", "\"Name\""},
        {HEAD "name a/b\n" GOOD, "f:2: ", "a/b"},
        {HEAD "name\n" GOOD, "f:2: ", "missing"},
        {HEAD "title \t \n" GOOD, "f:2: ", "missing"},
        {HEAD "title a\tb\n" GOOD, "f:2: ", "0x09"},
        {HEAD "title \xff\n" GOOD, "f:2: ", "0xff"},
        {HEAD "title \xc3\n" GOOD, "f:2: ", "0xc3"},
        {HEAD "note \xed\xa0\x80\n" GOOD, "f:2: ", "UTF-8"},
        {HEAD "note \xc0\x80\n" GOOD, "f:2: ", "UTF-8"},
        {HEAD "focal fifty\n" GOOD, "f:2: ", "\"fifty\""},
        {HEAD "focal 50mm\n" GOOD, "f:2: ", "\"50mm\""},
        {HEAD "focal 5,5\n" GOOD, "f:2: ", "\"5,5\""},
        {HEAD "focal 0x10\n" GOOD, "f:2: ", "0x10"},
        {HEAD "focal nan\n" GOOD, "f:2: ", "nan"},
        {HEAD "focal inf\n" GOOD, "f:2: ", "inf"},
        {HEAD "focal 1e999\n" GOOD, "f:2: ", "1e999"},
        {HEAD "focal -1\n" GOOD, "f:2: ", "focal length -1 mm"},
        {HEAD "fnumber 0.01\n" GOOD, "f:2: ", "0.1..1000"},
        {HEAD "field 151\n" GOOD, "f:2: ", "half field 151"},
        {HEAD "\nsurface\n", "f:3: ", "radius is missing"},
        {HEAD "surface 50\n", "f:2: ", "thickness is missing"},
        {HEAD "surface 50 5\n", "f:2: ", "medium is missing"},
        {HEAD "surface 50 5 1.5 # 10\n", "f:2: ", "semi-aperture is missing"},
        {HEAD "surface nan 5 1.5 10 stop\n", "f:2: ", "\"nan\""},
        {HEAD "surface 1e-400 5 1.5 10 stop\n", "f:2: ", "too close to 0"},
        {HEAD "surface 0.09 5 1.5 10 stop\n", "f:2: ", "radius 0.09"},
        {HEAD "surface 2e9 5 1.5 10 stop\n", "f:2: ", "radius 2e+09"},
        {HEAD "surface c=10.1 5 1.5 10 stop\n", "f:2: ", "curvature 10.1"},
        {HEAD "surface 50 -10001 1.5 10 stop\n", "f:2: ", "thickness -10001"},
        {HEAD "surface 50 100001 1.5 10 stop\n", "f:2: ", "thickness 100001"},
        {HEAD "surface 50 5 N-BK8 10 stop\n", "f:2: ", "\"N-BK8\""},
        {HEAD "surface 50 5 0.9 10 stop\n", "f:2: ", "index 0.9"},
        {HEAD "surface 50 5 1.5/ 10 stop\n", "f:2: ", "Abbe number"},
        {HEAD "surface 50 5 1.5/3 10 stop\n", "f:2: ", "Abbe number 3"},
        {HEAD "surface 50 5 1.5/60/2 10 stop\n", "f:2: ", "60/2"},
        {HEAD "surface 50 5 1.5 -1 stop\n", "f:2: ", "semi-aperture -1"},
        {HEAD "surface 50 5 1.5 0 stop\n", "f:2: ", "iris"},
        {HEAD "surface 50 5 1.5 10 stop stop\n", "f:2: ", "twice"},
        {HEAD "surface 50 5 1.5 10 stop k=1 k=1\n", "f:2: ", "twice"},
        {HEAD "surface 50 5 1.5 10 A4=1 A4=1\n", "f:2: ", "twice"},
        {HEAD "surface 50 5 1.5 10 cylinder=x cylinder=y\n", "f:2: ", "twice"},
        {HEAD "surface 50 5 1.5 10 cylinder=z\n", "f:2: ", "cylinder=z"},
        {HEAD "surface 50 5 1.5 10 A3=1\n", "f:2: ", "A3=1"},
        {HEAD "surface 50 5 1.5 10 A18=1\n", "f:2: ", "A18=1"},
        {HEAD "surface 50 5 1.5 10 A4=\n", "f:2: ", "aspheric term"},
        {HEAD "surface 50 5 1.5 10 A4=2e6\n", "f:2: ", "A4 = 2e+06"},
        {HEAD "surface 50 5 1.5 10 k=-1e7\n", "f:2: ", "conic constant -1e+07"},
        {HEAD "surface 50 5 1.5 10 Stop\n", "f:2: ", "\"Stop\""},
        {HEAD "surface 50 5 1.5 10\n", "f:2: ", "0 surfaces are the stop"},
        {HEAD GOOD GOOD, "f:3: ", "surface 1 is the stop"},
        {HEAD "surface 50 5 1.5 9\n" GOOD GOOD, "f:4: ", "surface 2 is the stop"},
        {HEAD "surface 0 5 1.5 10 stop\n", "f:2: ", "power"},
        {HEAD "surface 50 5 air 10 stop\n", "f:2: ", "power"},
        {HEAD "focal 50\n", "f:2: ", "0 surfaces"},
        {HEAD "glass N-BK7 schott 2.25 0 0 0 0 0 400 700\n", "f:2: ", "already"},
        {HEAD "glass A schott 2 0 0 0 0 0 400 700\nglass a schott 2 0 0 0 0 0 400 700\n",
         "f:3: ", "already"},
        {HEAD "glass A cauchy 2 0 0 0 0 0 400 700\n", "f:2: ", "\"cauchy\""},
        {HEAD "glass A schott 2 0 0 0 0 0 400\n", "f:2: ", "highest wavelength is missing"},
        {HEAD "glass A schott 2 0 0 0 0 0 400 700 x\n", "f:2: ", "nothing more"},
        {HEAD "glass A sellmeier 1 0 0 0.25 0 0 400 700\n", "f:2: ", "pole"},
        {HEAD "glass 1A schott 2 0 0 0 0 0 400 700\n", "f:2: ", "name of a glass"},
        {HEAD "surface 50 5 B 10 stop\nglass B schott 2 0 0 0 0 0 400 700\n", "f:2: ", "\"B\""},
        {"lens 1\x01\n", "f:1: ", "0x01"},
        {"l\xc3\xa9ns 1\n", "f:1: ", "0xc3"},
        {"10 5 1.5 8\n0 5 1\n", "f:2: ", "diameter is missing"},
        {"10 5 1.5 8 9\n", "f:1: ", "\"9\""},
        {"10 5 1.5 8\n\nlens 1\n", "f:3: ", "\"lens\""},
        {"10 5 1.5 8\n-10 5 1 8\n0 1 0 4\n0 1 1 4\n", "f:4: ", "surface 3"},
        {"10 5 1.5 8\n-10 5 1 8\n", "f:2: ", "stop"},
        {"10 5 5 8\n", "f:1: ", "index 5"},
        {"10 5 1.5 -8\n", "f:1: ", "semi-aperture -4"},
        {"0.01 5 1.5 8\n", "f:1: ", "radius 0.01"},
    };
    for (size_t i = 0; i < WO_COUNT(rows); i++) {
        wo_error error = {WO_OK, ""};
        wo_prescription lens;
        const wo_status status =
            wo_prescription_parse(rows[i].text, strlen(rows[i].text), "f", &lens, &error);
        if (status == WO_OK || error.status != status)
            fail_msg("accepted: %s", rows[i].text);
        if (strncmp(error.text, rows[i].line, strlen(rows[i].line)) != 0 ||
            !strstr(error.text, rows[i].part))
            fail_msg("\"%s\" has neither \"%s\" nor \"%s\"", error.text, rows[i].line,
                     rows[i].part);
        assert_int_equal(lens.count, 0);
    }
}

static void bytes_that_are_no_text(void **state)
{
    (void)state;
    static const char zero[] = "lens 1\nsurface 50 5 1.5 10 stop\0 k=1\n";
    static const char title[] = "lens 1\ntitle a\0b\n";
    wo_error error = {WO_OK, ""};
    wo_prescription lens;
    assert_int_equal(wo_prescription_parse(zero, sizeof zero - 1, "f", &lens, &error),
                     WO_ERR_FORMAT);
    assert_non_null(strstr(error.text, "f:2: byte 0x00"));
    assert_int_equal(wo_prescription_parse(title, sizeof title - 1, "f", &lens, &error),
                     WO_ERR_FORMAT);
    assert_non_null(strstr(error.text, "f:2: title, byte 2 is 0x00"));
    /* The other half of the last character lies behind the end. */
    static const char half[] = "lens 1\nnote \xc3\xa9";
    assert_int_equal(wo_prescription_parse(half, sizeof half - 2, "f", &lens, &error),
                     WO_ERR_FORMAT);
    assert_non_null(strstr(error.text, "f:2: note, byte 1 is 0xc3"));
    assert_int_equal(wo_prescription_parse(NULL, 0, "f", &lens, NULL), WO_ERR_FORMAT);
    assert_int_equal(wo_prescription_parse(zero, 2 << 20, "f", &lens, &error), WO_ERR_RANGE);
}

static void limits(void **state)
{
    (void)state;
    char text[LENS_TEXT_SIZE];
    wo_error error = {WO_OK, ""};
    wo_prescription lens;
    for (int count = 64; count <= 65; count++) {
        strcpy(text, HEAD GOOD);
        for (int i = 1; i < count; i++)
            strcat(text, "surface 50 5 1.5 10\n");
        const wo_status status = wo_prescription_parse(text, strlen(text), "f", &lens, &error);
        assert_int_equal(status, count == 64 ? WO_OK : WO_ERR_RANGE);
    }
    assert_non_null(strstr(error.text, "f:66: more than 64"));
    for (int length = 127; length <= 128; length++) {
        snprintf(text, sizeof text, HEAD "title %0*d\n" GOOD, length, 7);
        const wo_status status = wo_prescription_parse(text, strlen(text), "f", &lens, &error);
        assert_int_equal(status, length == 127 ? WO_OK : WO_ERR_RANGE);
    }
    assert_non_null(strstr(error.text, "f:2: title of 128 bytes"));
    for (int length = 63; length <= 64; length++) {
        snprintf(text, sizeof text, HEAD "focal %0*d\n" GOOD, length, 7);
        const wo_status status = wo_prescription_parse(text, strlen(text), "f", &lens, &error);
        assert_int_equal(status, length == 63 ? WO_OK : WO_ERR_FORMAT);
    }
    assert_non_null(strstr(error.text, "63 characters"));
}

static void refused(wo_prescription lens, const char *part)
{
    wo_error error = {WO_OK, ""};
    assert_int_not_equal(wo_prescription_validate(&lens, &error), WO_OK);
    if (!strstr(error.text, part))
        fail_msg("\"%s\" has no \"%s\"", error.text, part);
}

/* Each change makes a legal prescription illegal. */
static void validation(void **state)
{
    (void)state;
    wo_error error = {WO_OK, ""};
    const wo_prescription good = parse_as(complete, "f");
    assert_int_equal(wo_prescription_validate(&good, &error), WO_OK);
    wo_prescription lens;
#define REFUSED(change, part)                                                                      \
    lens = good;                                                                                   \
    change;                                                                                        \
    refused(lens, part)
    REFUSED(lens.count = 0, "0 surfaces");
    REFUSED(lens.count = 65, "65 surfaces");
    REFUSED(lens.count = -1, "-1 surfaces");
    REFUSED(lens.stop = 2, "stop 2");
    REFUSED(lens.stop = -1, "stop -1");
    REFUSED(lens.surface[3].stop = false, "0 surfaces are the stop");
    REFUSED(lens.surface[4].stop = true, "2 surfaces are the stop");
    REFUSED(lens.surface[1].curvature = NAN, "surface 2: curvature");
    REFUSED(lens.surface[1].curvature = -11, "surface 2: curvature -11");
    REFUSED(lens.surface[1].thickness = INFINITY, "surface 2: thickness");
    REFUSED(lens.surface[1].semi_aperture = NAN, "surface 2: semi-aperture");
    REFUSED(lens.surface[1].conic = NAN, "surface 2: conic");
    REFUSED(lens.surface[0].asphere[7] = NAN, "surface 1: A16");
    REFUSED(lens.surface[1].asphere_terms = 9, "surface 2: 9 aspheric");
    REFUSED(lens.surface[1].asphere[0] = 1e-3, "surface 2: A2");
    REFUSED(lens.surface[1].meridian = (wo_meridian)7, "surface 2: meridian 7");
    REFUSED(lens.surface[1].glass.nd = 1.6, "surface 2: glass \"N-SF6\"");
    REFUSED(lens.surface[0].glass.a[3] = 0.25, "surface 1: glass Mine");
    REFUSED(lens.surface[5].glass.nd = 0.5, "surface 6: refractive index 0.5");
    REFUSED(memset(lens.surface[1].glass.name, 'x', 32), "surface 2: the name");
    REFUSED(lens.surface[1].glass.kind = (wo_dispersion)9, "surface 2: glass");
    REFUSED(strcpy(lens.surface[3].glass.name, "MINE"), "surfaces 1 and 4");
    REFUSED(lens.name[0] = '\0', "no name");
    REFUSED(lens.name[0] = ' ', "name");
    REFUSED(memset(lens.name, 'x', sizeof lens.name), "name");
    REFUSED(memset(lens.title, 'x', sizeof lens.title), "title");
    REFUSED(strcpy(lens.source, "two\nlines"), "source");
    REFUSED(strcpy(lens.source, "blank "), "source");
    REFUSED(lens.focal_mm = NAN, "focal");
    REFUSED(lens.f_number = -1, "f-number");
    REFUSED(lens.half_field = 200, "half field");
#undef REFUSED
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_word_of_the_format),
        cmocka_unit_test(example_of_the_page),
        cmocka_unit_test(names_from_files),
        cmocka_unit_test(pbrt_files),
        cmocka_unit_test(errors_name_the_line),
        cmocka_unit_test(bytes_that_are_no_text),
        cmocka_unit_test(limits),
        cmocka_unit_test(validation),
    };
    return cmocka_run_group_tests_name("prescription", tests, NULL, NULL);
}
