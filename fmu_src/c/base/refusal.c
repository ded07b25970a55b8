#include "refusal.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Exponents from MIN_PLAIN_EXPONENT to MAX_PLAIN_EXPONENT are written without "e", as repr does. */
enum { MAX_DIGITS = 17, MIN_PLAIN_EXPONENT = -4, MAX_PLAIN_EXPONENT = 15 };

bool refuse(Refusal *refusal, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(refusal->text, sizeof refusal->text, format, arguments);
    va_end(arguments);
    return false;
}

/* Write the fewest digits that read back as `value` > 0, without a point; return the exponent of the first one. */
static int shortest_digits(double value, char digits[MAX_DIGITS + 1]) {
    char scientific[NUMBER_SIZE];
    for (int count = 1; count <= MAX_DIGITS; count++) {
        snprintf(scientific, sizeof scientific, "%.*e", count - 1, value);
        if (strtod(scientific, NULL) == value) {
            break;
        }
    }
    const char *read = scientific;
    int count = 0;
    for (; *read != 'e'; read++) {
        if ('0' <= *read && *read <= '9') { /* skips the decimal point of any locale */
            digits[count++] = *read;
        }
    }
    digits[count] = '\0';
    return (int)strtol(read + 1, NULL, 10);
}

const char *number_text(double value, char text[NUMBER_SIZE]) {
    if (isnan(value)) {
        return strcpy(text, "nan");
    }
    const char *sign = signbit(value) ? "-" : "";
    if (isinf(value) || value == 0.0) {
        snprintf(text, NUMBER_SIZE, "%s%s", sign, value == 0.0 ? "0.0" : "inf");
        return text;
    }
    char digits[MAX_DIGITS + 1];
    int exponent = shortest_digits(fabs(value), digits);
    int count = (int)strlen(digits);
    if (exponent < MIN_PLAIN_EXPONENT || exponent > MAX_PLAIN_EXPONENT) {
        snprintf(text, NUMBER_SIZE, "%s%c%s%se%c%02d", sign, digits[0], count > 1 ? "." : "", digits + 1,
                 exponent < 0 ? '-' : '+', abs(exponent));
    } else if (exponent < 0) {
        snprintf(text, NUMBER_SIZE, "%s0.%.*s%s", sign, -1 - exponent, "000", digits);
    } else if (count <= exponent + 1) {
        snprintf(text, NUMBER_SIZE, "%s%s%.*s.0", sign, digits, exponent + 1 - count, "000000000000000");
    } else {
        snprintf(text, NUMBER_SIZE, "%s%.*s.%s", sign, exponent + 1, digits, digits + exponent + 1);
    }
    return text;
}
