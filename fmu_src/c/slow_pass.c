#include "slow_pass.h"

#include <math.h>

#include "settling.h"

/* Step tried first, as a share of the time in which friction changes the fast velocity. */
#define FIRST_STEP 0.1

/* What must be left, in first steps, for the motion to settle. */
#define SETTLING 100.0

/* Part of a beat that a step may have: its stages then see all phases of the normal load. */
#define BEAT_SHARE 0.125

/* Part of a beat up to which a kink ahead counts as the one just passed. */
#define MIN_SHARE 1e-9

/* Steps before each of which it may turn out that the motion has settled. */
enum { BLOCK = 16 };

double slow_pass_step(double fast, double mass, double strongest, double duration) {
    return strongest > 0.0 ? FIRST_STEP * fast * mass / strongest : duration;
}

bool slow_pass(const SlowPass *pass, double end, Reached *now, Refusal *refusal) {
    for (int count = 0; now->t < end && isfinite(now->velocity); count += BLOCK) {
        if (count >= pass->most) {
            return refuse_work(refusal, pass->duration, now->t, pass->most,
                               "steps of averaged motion");
        }
        bool may_settle = pass->may_settle && end - now->t > SETTLING * pass->step;
        if (may_settle && settle(pass->acceleration, pass->motion, pass->fast, end, now)) {
            break;
        }
        double kink = fmax(pass->to_kink(pass->motion, now->t), MIN_SHARE * pass->beat);
        *now = integrate(pass->acceleration, pass->motion, *now, fmin(end, now->t + kink),
                         pass->tolerance, BEAT_SHARE * pass->beat, BLOCK);
    }
    return true;
}
