/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */

/* Ends with 0 when standard input is one well-formed JSON value in UTF-8 (RFC 8259), else with 1
   and the byte where it goes wrong. Shares no code with the program it checks. */

#include <ctype.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

static int here = ' ';
static long position = -1;

static void next(void)
{
    here = getchar();
    position++;
}

static void blanks(void)
{
    while (here == ' ' || here == '\t' || here == '\n' || here == '\r')
        next();
}

static bool word(const char *letters)
{
    for (; *letters; letters++, next())
        if (here != *letters)
            return false;
    return true;
}

static bool digits(void)
{
    if (!isdigit(here))
        return false;
    while (isdigit(here))
        next();
    return true;
}

static bool number(void)
{
    if (here == '-')
        next();
    if (here == '0')
        next();
    else if (!digits())
        return false;
    if (here == '.') {
        next();
        if (!digits())
            return false;
    }
    if (here == 'e' || here == 'E') {
        next();
        if (here == '+' || here == '-')
            next();
        return digits();
    }
    return true;
}

static bool escape(void)
{
    next();
    if (here == 'u') {
        for (int i = 0; i < 4; i++) {
            next();
            if (!isxdigit(here))
                return false;
        }
    } else if (here == EOF || !strchr("\"\\/bfnrt", here)) {
        return false;
    }
    next();
    return true;
}

/* One code point of more than a byte, its first byte in here. */
static bool multibyte(void)
{
    const int lead = here;
    const int more = lead >= 0xF0 ? 3 : lead >= 0xE0 ? 2 : 1;
    if (lead < 0xC2 || lead > 0xF4)
        return false;
    unsigned long code = (unsigned long)lead & (0x3FUL >> more);
    for (int i = 0; i < more; i++) {
        next();
        if (here < 0x80 || here > 0xBF)
            return false;
        code = code << 6 | ((unsigned long)here & 0x3FUL);
    }
    next();
    const unsigned long least[] = {0x80, 0x800, 0x10000};
    return code >= least[more - 1] && code <= 0x10FFFF && (code < 0xD800 || code > 0xDFFF);
}

static bool string(void)
{
    if (here != '"')
        return false;
    next();
    while (here != '"') {
        if (here == EOF || here < 0x20)
            return false;
        if (here == '\\') {
            if (!escape())
                return false;
        } else if (here >= 0x80) {
            if (!multibyte())
                return false;
        } else {
            next();
        }
    }
    next();
    return true;
}

static bool value(int depth);

static bool container(int closing, int depth)
{
    next();
    blanks();
    if (here == closing) {
        next();
        return true;
    }
    for (;;) {
        if (closing == '}') {
            if (!string())
                return false;
            blanks();
            if (here != ':')
                return false;
            next();
        }
        if (!value(depth + 1))
            return false;
        if (here == closing) {
            next();
            return true;
        }
        if (here != ',')
            return false;
        next();
        blanks();
    }
}

static bool value(int depth)
{
    blanks();
    bool good;
    if (depth > 256)
        return false;
    if (here == '{' || here == '[')
        good = container(here == '{' ? '}' : ']', depth);
    else if (here == '"')
        good = string();
    else if (here == 't')
        good = word("true");
    else if (here == 'f')
        good = word("false");
    else if (here == 'n')
        good = word("null");
    else
        good = number();
    blanks();
    return good;
}

int main(void)
{
    next();
    if (value(0) && here == EOF && !ferror(stdin))
        return 0;
    fprintf(stderr, "not JSON at byte %ld\n", position);
    return 1;
}
