#include "budget.h"

#include <math.h>

#include "../base/refusal_texts.h"

bool budget_refuse(const Budget *budget, double reached, int max_count, const char *what,
                   Refusal *refusal) {
    double end = budget->passed + reached;
    if (end > 0.0) {
        long long exponent = (long long)floor(log10(end));
        return refuse_too_much_work(refusal, budget->step_size, max_count, what, exponent);
    }
    return refuse_too_much_work_at_once(refusal, budget->step_size, max_count, what);
}
