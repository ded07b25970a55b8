/* The work of one communication step: all its parts draw from one budget. */
#pragma once

#include <math.h>

#include "../base/refusal_texts.h"

/* The step has `step_size` [s], of which `passed` [s] were over when its present part began. `spent` is the share of
 * the budget that is spent. */
typedef struct {
    double step_size, passed, spent;
} Budget;

static inline Budget budget_of(double step_size) {
    return (Budget){.step_size = step_size};
}

/* How much is left of a kind of work of which a whole budget buys `max_count`. */
static inline int budget_left(const Budget *budget, int max_count) {
    return budget->spent < 1.0 ? (int)((1.0 - budget->spent) * max_count) : 0;
}

static inline void budget_spend(Budget *budget, int count, int max_count) {
    budget->spent += (double)count / max_count;
}

/* Refuse work of which a whole budget buys `max_count` of `what`. A step up to `reached` [s] after the present part
 * began takes less: the text names the power of ten below it. Return false. */
static inline bool budget_refuse(const Budget *budget, double reached, int max_count, const char *what,
                                 Refusal *refusal) {
    double end = budget->passed + reached;
    if (end > 0.0) {
        long long exponent = (long long)floor(log10(end));
        return refuse_too_much_work(refusal, budget->step_size, max_count, what, exponent);
    }
    return refuse_too_much_work_at_once(refusal, budget->step_size, max_count, what);
}
