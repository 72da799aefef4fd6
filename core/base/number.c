/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "number.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* More digits than these cannot change which double is meant, short of an adversary. */
enum { DIGITS_MAX = 800, EXPONENT_MAX = 100000 };

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

/* strtod and printf put the locale's decimal point only where there is one to put; digits with an
   exponent and no point read the same everywhere. */
bool wo_number_read(const char *text, const char **end, double *value)
{
    char digits[DIGITS_MAX + 16];
    size_t length = 0;
    long exponent = 0;
    bool any = false, point = false;
    const char *at = text;

    if (*at == '+' || *at == '-') {
        if (*at == '-')
            digits[length++] = '-';
        at++;
    }
    const size_t first = length;
    for (;; at++) {
        if (*at == '.' && !point) {
            point = true;
            continue;
        }
        if (!is_digit(*at))
            break;
        any = true;
        if (length == first && *at == '0') {
            exponent -= point;
        } else if (length - first < DIGITS_MAX) {
            digits[length++] = *at;
            exponent -= point;
        } else {
            exponent += !point;
        }
        if (exponent > EXPONENT_MAX || exponent < -EXPONENT_MAX)
            return false;
    }
    if (!any)
        return false;
    if (length == first)
        digits[length++] = '0';

    if (*at == 'e' || *at == 'E') {
        const char *mark = at + 1;
        const bool negative = *mark == '-';
        if (*mark == '+' || *mark == '-')
            mark++;
        if (is_digit(*mark)) {
            long power = 0;
            for (; is_digit(*mark); mark++)
                power = power < EXPONENT_MAX ? power * 10 + (*mark - '0') : power;
            exponent += negative ? -power : power;
            at = mark;
        }
    }
    snprintf(digits + length, sizeof digits - length, "e%ld", exponent);
    const double number = strtod(digits, NULL);
    if (!isfinite(number))
        return false;
    *value = number;
    if (end)
        *end = at;
    return true;
}

/* Digits of value, d.ddd x 10^exponent, without point; returns how many. */
static int shortest_digits(double value, char digits[24], int *exponent)
{
    for (int precision = 0; precision <= 16; precision++) {
        char text[48];
        int count = 0;
        snprintf(text, sizeof text, "%.*e", precision, value);
        const char *mark = text;
        for (; *mark != 'e'; mark++)
            if (is_digit(*mark))
                digits[count++] = *mark;
        digits[count] = '\0';
        *exponent = atoi(mark + 1);

        char again[48];
        snprintf(again, sizeof again, "%se%d", digits, *exponent - precision);
        if (strtod(again, NULL) == value || precision == 16) {
            while (count > 1 && digits[count - 1] == '0')
                digits[--count] = '\0';
            return count;
        }
    }
    return 0;
}

int wo_number_print(double value, char text[WO_NUMBER_SIZE])
{
    if (isnan(value))
        return snprintf(text, WO_NUMBER_SIZE, "nan");
    if (isinf(value))
        return snprintf(text, WO_NUMBER_SIZE, value < 0 ? "-inf" : "inf");
    if (value == 0)
        return snprintf(text, WO_NUMBER_SIZE, signbit(value) ? "-0" : "0");

    char digits[24];
    int exponent = 0;
    const int count = shortest_digits(fabs(value), digits, &exponent);
    const char *const sign = value < 0 ? "-" : "";

    if (exponent < -5 || exponent > 15)
        return snprintf(text, WO_NUMBER_SIZE, "%s%.1s%s%se%d", sign, digits, count > 1 ? "." : "",
                        digits + 1, exponent);
    if (exponent < 0)
        return snprintf(text, WO_NUMBER_SIZE, "%s0.%.*s%s", sign, -exponent - 1, "00000", digits);
    if (count <= exponent + 1)
        return snprintf(text, WO_NUMBER_SIZE, "%s%s%.*s", sign, digits, exponent + 1 - count,
                        "0000000000000000");
    return snprintf(text, WO_NUMBER_SIZE, "%s%.*s.%s", sign, exponent + 1, digits,
                    digits + exponent + 1);
}
