/* The elementary functions by their number. */
#include "base/elementary_functions.h"

static double sine(double x) { return elementary_sine_cosine(x).sine; }
static double cosine(double x) { return elementary_sine_cosine(x).cosine; }

typedef double (*Function)(double);

static const Function FUNCTIONS[] = {
    elementary_sin, elementary_cos,   elementary_asin, elementary_acos,  elementary_exp,
    elementary_expm1, elementary_log, sine, cosine,
};

double probe_elementary(int function, double x) {
    return FUNCTIONS[function](x);
}
