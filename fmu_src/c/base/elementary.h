/* <math.h> with elementary functions that give the same bits on every platform, for .c files only: its macros would
 * reach whoever includes a header. */
#pragma once

#include <math.h>

#include "elementary_functions.h"

#define sin(x) elementary_sin(x)
#define cos(x) elementary_cos(x)
#define asin(x) elementary_asin(x)
#define acos(x) elementary_acos(x)
#define atan2(a, b) elementary_atan2(a, b)
#define hypot(a, b) elementary_hypot(a, b)
#define exp(x) elementary_exp(x)
#define expm1(x) elementary_expm1(x)
#define log(x) elementary_log(x)
