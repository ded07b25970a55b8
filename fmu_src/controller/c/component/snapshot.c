/* Layout: the header of state_bytes.h; as numbers the fields in their order, then the values that can be set; the
 * checksum. */
#include "snapshot.h"

#include <math.h>
#include <string.h>

#include "state_bytes.h"
#include "values.h"

enum {
    FIELD_COUNT = 7,
    NUMBER_COUNT = FIELD_COUNT + SETTABLE_COUNT,
    SNAPSHOT_SIZE = STATE_HEADER_SIZE + NUMBER_COUNT * STATE_NUMBER_SIZE + STATE_CHECKSUM_SIZE
};

size_t snapshot_size(void) {
    return SNAPSHOT_SIZE;
}

void snapshot_write(const Snapshot *snapshot, unsigned char *bytes) {
    double numbers[NUMBER_COUNT] = {
        (double)snapshot->lifecycle, snapshot->start_time,       snapshot->time,           snapshot->stop_time,
        snapshot->samples,           snapshot->control.integral, snapshot->control.effort,
    };
    memcpy(numbers + FIELD_COUNT, snapshot->values, sizeof snapshot->values);
    for (int i = 0; i < NUMBER_COUNT; i++) {
        state_number_put(bytes + STATE_HEADER_SIZE + i * STATE_NUMBER_SIZE, numbers[i]);
    }
    state_seal(bytes, SNAPSHOT_SIZE);
}

/* Refuse fields that no controller can have. */
static bool fields_check(const double *numbers, Refusal *refusal) {
    bool known = numbers[0] >= 0.0 && numbers[0] < FMI.states && numbers[0] == floor(numbers[0]);
    bool times = isfinite(numbers[1]) && isfinite(numbers[2]) && numbers[3] >= numbers[1];
    bool sampled = isfinite(numbers[4]) && fabs(numbers[5]) <= 1.0 && fabs(numbers[6]) <= 1.0;
    return (known && times && sampled) || refuse(refusal,
                                                 "FMU state refused: it holds a %s that no controller can have; "
                                                 "must be bytes that a state was serialised to",
                                                 !known   ? "lifecycle"
                                                 : !times ? "time"
                                                          : "sample");
}

bool snapshot_read(Snapshot *snapshot, const unsigned char *bytes, size_t size, Refusal *refusal) {
    double numbers[NUMBER_COUNT];
    if (!state_seal_check(bytes, size, SNAPSHOT_SIZE, refusal)) {
        return false;
    }
    for (int i = 0; i < NUMBER_COUNT; i++) {
        numbers[i] = state_number_get(bytes + STATE_HEADER_SIZE + i * STATE_NUMBER_SIZE);
    }
    if (!fields_check(numbers, refusal)) {
        return false;
    }
    for (int i = 0; i < SETTABLE_COUNT; i++) {
        if (!value_check(&VARIABLES[i], numbers[FIELD_COUNT + i], refusal)) {
            return false;
        }
    }
    *snapshot = (Snapshot){.lifecycle = (Lifecycle)(int)numbers[0],
                           .start_time = numbers[1],
                           .time = numbers[2],
                           .stop_time = numbers[3],
                           .samples = numbers[4],
                           .control = {numbers[5], numbers[6]}};
    memcpy(snapshot->values, numbers + FIELD_COUNT, sizeof snapshot->values);
    return true;
}
