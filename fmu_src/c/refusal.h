/* Why a call is refused: a text that names the thing, its value and what is allowed. */
#ifndef SLIDER_REFUSAL_H
#define SLIDER_REFUSAL_H

#include <stdbool.h>

enum { REFUSAL_SIZE = 512, NUMBER_SIZE = 40 };

typedef struct {
    char text[REFUSAL_SIZE];
} Refusal;

/* Writes the text as snprintf does; returns false, so that a function can `return refuse(...)`. */
bool refuse(Refusal *refusal, const char *format, ...);

/* Refuses a step of `step_size` [s] that takes more than `most` of `what`: a step up to `reached` [s],
 * named as a power of ten, takes less. Returns false. */
bool refuse_work(Refusal *refusal, double step_size, double reached, int most, const char *what);

/* The shortest text that reads back as `value`, with a decimal point in every locale; as Python's
 * repr: "0.1", "1e-05", "3500.0", "nan", "inf". Returns `text`. */
const char *number_text(double value, char text[NUMBER_SIZE]);

#endif
