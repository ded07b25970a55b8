#include "refusal.h"

#include <float.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Every number has a text of at most MOST digits that reads back as it; most have one of FEWEST. */
enum { FEWEST = 15, MOST = 17 };

bool refuse(Refusal *refusal, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(refusal->text, sizeof refusal->text, format, arguments);
    va_end(arguments);
    return false;
}

const char *number_text(double value, char text[NUMBER_SIZE]) {
    if (!isfinite(value)) {
        return strcpy(text, isnan(value) ? "nan" : value > 0.0 ? "inf" : "-inf");
    }
    for (int digits = fabs(value) < DBL_MIN ? 1 : FEWEST; digits <= MOST; digits++) {
        snprintf(text, NUMBER_SIZE, "%.*g", digits, value);
        if (strtod(text, NULL) == value) {
            break;
        }
    }
    char *point = text + strspn(text, "-0123456789");
    char *decimals = point + strcspn(point, "0123456789e"); /* behind the decimal point of any locale */
    if (*point == '\0') {
        return strcat(text, ".0");
    }
    if (decimals > point) {
        *point = '.';
        memmove(point + 1, decimals, strlen(decimals) + 1);
    }
    return text;
}
