/* Why a call is refused: a text that names the thing, its value and what it must be. */
#pragma once

#include <stdbool.h>

enum { REFUSAL_SIZE = 512, NUMBER_SIZE = 40 };

typedef struct {
    char text[REFUSAL_SIZE];
} Refusal;

/* Write the text as snprintf does; return false, so that a function can `return refuse(...)`. */
bool refuse(Refusal *refusal, const char *format, ...);

/* A short text that reads back as `value`, with a decimal point in every locale, as Python's repr does below 1e15:
 * "0.1", "1e-05", "3500.0", "nan", "inf". Returns `text`. */
const char *number_text(double value, char text[NUMBER_SIZE]);
