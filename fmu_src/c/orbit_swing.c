#include "orbit_swing.h"

#include "contact.h"

Response swing_after(const Law *law, const Response *swing, double t) {
    const Oscillator *slip = &law->resolved->held.plant.slip;
    Response free = free_response(slip, t);
    double y = swing->displacement, u = swing->rate;
    return (Response){y * (free.displacement + slip->decay * free.rate) + u * free.rate,
                      u * (free.displacement - slip->decay * free.rate) -
                          slip->stiffness * y * free.rate};
}

void add_swing(Moment *moment, const Response *swing, double share) {
    moment->state.displacement += swing->displacement;
    moment->state.rate += swing->rate;
    moment->position -= share * swing->displacement;
    if (moment->mode != STICK) {
        moment->state.velocity -= share * swing->rate;
    }
}
