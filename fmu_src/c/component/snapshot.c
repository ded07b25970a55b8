/* Layout: the header of state_bytes.h; as numbers the fields below in their order, then the values that can be set; the
 * checksum. */
#include "snapshot.h"

#include <string.h>

#include "state_bytes.h"
#include "values.h"

/* What a number must be: finite, finite or infinite, a phase within a turn, or an integer, by the type that keeps
 * it. */
typedef enum { FINITE, FINITE_OR_INFINITE, PHASE, INTEGER, FLAG, LIFECYCLE } Kind;

/* `minimum` and `maximum` bound integers. */
typedef struct {
    const char *name;
    size_t offset;
    Kind kind;
    int minimum, maximum;
} Field;

#define FIELD(name, kind, minimum, maximum) {#name, offsetof(Snapshot, name), kind, minimum, maximum}

static const Field FIELDS[] = {
    FIELD(lifecycle, LIFECYCLE, 0, 0), /* the version of FMI bounds it */
    FIELD(time, FINITE, 0, 0),
    FIELD(time_carry, FINITE, 0, 0),
    FIELD(stop_time, FINITE_OR_INFINITE, 0, 0),
    FIELD(last_event_time, FINITE, 0, 0),
    FIELD(derivatives[0].value, FINITE, 0, 0),
    FIELD(derivatives[0].is_new, FLAG, 0, 1),
    FIELD(derivatives[1].value, FINITE, 0, 0),
    FIELD(derivatives[1].is_new, FLAG, 0, 1),
    FIELD(derivatives[2].value, FINITE, 0, 0),
    FIELD(derivatives[2].is_new, FLAG, 0, 1),
    FIELD(moment.state.velocity, FINITE, 0, 0),
    FIELD(moment.state.displacement, FINITE, 0, 0),
    FIELD(moment.state.rate, FINITE, 0, 0),
    FIELD(moment.position, FINITE, 0, 0),
    FIELD(moment.theta, PHASE, 0, 0),
    FIELD(moment.psi, PHASE, 0, 0),
    FIELD(moment.mode, INTEGER, BACKWARD, LIFTED),
    FIELD(moment.counts.sliding, INTEGER, BACKWARD, FORWARD),
    FIELD(moment.counts.reversals, FINITE, 0, 0),
    FIELD(moment.counts.sticks, FINITE, 0, 0),
    FIELD(moment.event_age, FINITE_OR_INFINITE, 0, 0),
    FIELD(moment.means.travel, FINITE, 0, 0),
    FIELD(moment.means.work, FINITE, 0, 0),
    FIELD(moment.means.elapsed, FINITE, 0, 0),
    FIELD(moment.means.sticking, FINITE, 0, 0),
    FIELD(moment.means.complete, FLAG, 0, 1),
    FIELD(moment.means.mean_velocity, FINITE, 0, 0),
    FIELD(moment.means.friction_power, FINITE, 0, 0),
    FIELD(moment.means.stick_fraction, FINITE, 0, 0),
    FIELD(moment.bristle, FINITE, 0, 0),
    FIELD(moment.stops.backward.theta, FINITE, 0, 0),
    FIELD(moment.stops.backward.drift, FINITE, 0, 0),
    FIELD(moment.stops.backward.curvature, FINITE, 0, 0),
    FIELD(moment.stops.forward.theta, FINITE, 0, 0),
    FIELD(moment.stops.forward.drift, FINITE, 0, 0),
    FIELD(moment.stops.forward.curvature, FINITE, 0, 0),
    FIELD(moment.leap_error, FINITE, 0, 0),
};

enum { FIELD_COUNT = sizeof FIELDS / sizeof FIELDS[0] };

enum { SNAPSHOT_SIZE = STATE_HEADER_SIZE + (FIELD_COUNT + SETTABLE_COUNT) * STATE_NUMBER_SIZE + STATE_CHECKSUM_SIZE };

size_t snapshot_size(void) {
    return SNAPSHOT_SIZE;
}

static double field_number(const Snapshot *snapshot, const Field *field) {
    const char *place = (const char *)snapshot + field->offset;
    switch (field->kind) {
    case INTEGER:
        return *(const int *)place;
    case FLAG:
        return *(const bool *)place;
    case LIFECYCLE:
        return *(const Lifecycle *)place;
    default:
        return *(const double *)place;
    }
}

static void set_field(Snapshot *snapshot, const Field *field, double number) {
    char *place = (char *)snapshot + field->offset;
    switch (field->kind) {
    case INTEGER:
        *(int *)place = (int)number;
        break;
    case FLAG:
        *(bool *)place = number != 0.0;
        break;
    case LIFECYCLE:
        *(Lifecycle *)place = (Lifecycle)(int)number;
        break;
    default:
        *(double *)place = number;
    }
}

static bool field_check(const Field *field, double number, Refusal *refusal) {
    char text[NUMBER_SIZE];
    if (field->kind == FINITE || field->kind == FINITE_OR_INFINITE) {
        bool may_be_infinite = field->kind == FINITE_OR_INFINITE && number > 0.0;
        return isfinite(number) || (may_be_infinite && isinf(number)) ||
               refuse_infinite_in_state(refusal, field->name, number_text(number, text));
    }
    if (field->kind == PHASE) {
        /* A turn where rounding takes a phase below 0 up to it, and a period that counts as ended before its end. */
        return (number >= -PERIOD_END_TOLERANCE && number <= TAU) ||
               refuse_phase_in_state(refusal, field->name, number_text(number, text));
    }
    int maximum = field->kind == LIFECYCLE ? FMI.states - 1 : field->maximum;
    return (number >= field->minimum && number <= maximum && number == floor(number)) ||
           refuse_out_of_range_in_state(refusal, field->name, number_text(number, text), field->minimum, maximum);
}

void snapshot_write(const Snapshot *snapshot, unsigned char *bytes) {
    unsigned char *place = bytes + STATE_HEADER_SIZE;
    for (size_t i = 0; i < FIELD_COUNT; i++, place += STATE_NUMBER_SIZE) {
        state_number_put(place, field_number(snapshot, &FIELDS[i]));
    }
    for (size_t i = 0; i < SETTABLE_COUNT; i++, place += STATE_NUMBER_SIZE) {
        state_number_put(place, snapshot->values[i]);
    }
    state_seal(bytes, SNAPSHOT_SIZE);
}

bool snapshot_read(Snapshot *snapshot, const unsigned char *bytes, size_t size, Refusal *refusal) {
    if (!state_seal_check(bytes, size, SNAPSHOT_SIZE, refusal)) {
        return false;
    }
    memset(snapshot, 0, sizeof *snapshot);
    const unsigned char *place = bytes + STATE_HEADER_SIZE;
    for (size_t i = 0; i < FIELD_COUNT; i++, place += STATE_NUMBER_SIZE) {
        double number = state_number_get(place);
        if (!field_check(&FIELDS[i], number, refusal)) {
            return false;
        }
        set_field(snapshot, &FIELDS[i], number);
    }
    for (size_t i = 0; i < SETTABLE_COUNT; i++, place += STATE_NUMBER_SIZE) {
        double number = state_number_get(place);
        if (!value_check(&VARIABLES[i], number, refusal)) {
            return false;
        }
        snapshot->values[i] = number;
    }
    return true;
}
