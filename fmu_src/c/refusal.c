#include "refusal.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_DIGITS = 17, LEAST_PLAIN_EXPONENT = -4, LEAST_LARGE_EXPONENT = 16 };

bool refuse(Refusal *refusal, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(refusal->text, sizeof refusal->text, format, arguments);
    va_end(arguments);
    return false;
}

bool refuse_work(Refusal *refusal, double step_size, double reached, int most, const char *what) {
    char size[NUMBER_SIZE], allowed[NUMBER_SIZE] = "one under other forces";
    if (reached > 0.0) {
        snprintf(allowed, sizeof allowed, "one of at most 1e%d s", (int)floor(log10(reached)));
    }
    return refuse(refusal,
                  "doStep: communicationStepSize = %s refused: it takes more than %d %s; allowed is "
                  "%s", number_text(step_size, size), most, what, allowed);
}

/* Writes the fewest digits that read back as `value` > 0, without a point; returns the exponent of
 * the first one. */
static int shortest_digits(double value, char digits[MOST_DIGITS + 1]) {
    char scientific[NUMBER_SIZE];
    for (int count = 1; count <= MOST_DIGITS; count++) {
        snprintf(scientific, sizeof scientific, "%.*e", count - 1, value);
        if (strtod(scientific, NULL) == value) {
            break;
        }
    }
    const char *read = scientific;
    int count = 0;
    for (; *read != 'e'; read++) {
        if ('0' <= *read && *read <= '9') { /* whatever the locale has for a point is left out */
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
    char digits[MOST_DIGITS + 1];
    int exponent = shortest_digits(fabs(value), digits);
    int count = (int)strlen(digits);
    if (exponent < LEAST_PLAIN_EXPONENT || exponent >= LEAST_LARGE_EXPONENT) {
        snprintf(text, NUMBER_SIZE, "%s%c%s%se%c%02d", sign, digits[0], count > 1 ? "." : "",
                 digits + 1, exponent < 0 ? '-' : '+', abs(exponent));
    } else if (exponent < 0) {
        snprintf(text, NUMBER_SIZE, "%s0.%.*s%s", sign, -1 - exponent, "000", digits);
    } else if (count <= exponent + 1) {
        snprintf(text, NUMBER_SIZE, "%s%s%.*s.0", sign, digits, exponent + 1 - count,
                 "000000000000000");
    } else {
        snprintf(text, NUMBER_SIZE, "%s%.*s.%s", sign, exponent + 1, digits, digits + exponent + 1);
    }
    return text;
}
