/* Layout: 8 bytes "SLIDRES" with the version of this layout, 40 bytes GUID, filled up with 0; then
 * every number as an IEEE double, lowest byte first: the fields below in their order, and the
 * values that can be set; at last 8 bytes of checksum over all before, lowest byte first. */
#include "snapshot.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "model_guid.h"
#include "values.h"

static const unsigned char FORMAT[8] = {'S', 'L', 'I', 'D', 'R', 'E', 'S', 1};

enum { GUID_SIZE = 40, NUMBER_BYTES = 8, HEADER_SIZE = sizeof FORMAT + GUID_SIZE };

/* What a number has to be: finite, finite or without end, or an integer that is kept as such. */
typedef enum { FINITE, ENDLESS, INTEGER, FLAG, STATE_OF_LIFE } Kind;

/* `low` and `high` bound integers. */
typedef struct {
    const char *name;
    size_t offset;
    Kind kind;
    int low, high;
} Field;

#define FIELD(name, kind, low, high) {#name, offsetof(Snapshot, name), kind, low, high}

static const Field FIELDS[] = {
    FIELD(lifecycle, STATE_OF_LIFE, 0, LIFECYCLES - 1),
    FIELD(time, FINITE, 0, 0),
    FIELD(stop_time, ENDLESS, 0, 0),
    FIELD(last_event_time, FINITE, 0, 0),
    FIELD(moving, FLAG, 0, 1),
    FIELD(moment.state.velocity, FINITE, 0, 0),
    FIELD(moment.state.displacement, FINITE, 0, 0),
    FIELD(moment.state.rate, FINITE, 0, 0),
    FIELD(moment.position, FINITE, 0, 0),
    FIELD(moment.theta, FINITE, 0, 0),
    FIELD(moment.psi, FINITE, 0, 0),
    FIELD(moment.mode, INTEGER, BACKWARD, LIFTED),
    FIELD(moment.counts.sliding, INTEGER, BACKWARD, FORWARD),
    FIELD(moment.counts.reversals, FINITE, 0, 0),
    FIELD(moment.counts.sticks, FINITE, 0, 0),
    FIELD(moment.event_age, ENDLESS, 0, 0),
    FIELD(moment.means.travel, FINITE, 0, 0),
    FIELD(moment.means.elapsed, FINITE, 0, 0),
    FIELD(moment.means.sticking, FINITE, 0, 0),
    FIELD(moment.means.complete, FLAG, 0, 1),
    FIELD(moment.means.mean_velocity, FINITE, 0, 0),
    FIELD(moment.means.stick_fraction, FINITE, 0, 0),
    FIELD(moment.bristle, FINITE, 0, 0),
};

enum { FIELD_COUNT = sizeof FIELDS / sizeof FIELDS[0] };

enum {
    CHECKED_SIZE = HEADER_SIZE + (FIELD_COUNT + SETTABLE_COUNT) * NUMBER_BYTES,
    SNAPSHOT_SIZE = CHECKED_SIZE + NUMBER_BYTES
};

size_t snapshot_size(void) {
    return SNAPSHOT_SIZE;
}

static void put_bits(unsigned char *bytes, uint64_t bits) {
    for (int i = 0; i < NUMBER_BYTES; i++) {
        bytes[i] = (unsigned char)((bits >> (8 * i)) & 0xff);
    }
}

static uint64_t get_bits(const unsigned char *bytes) {
    uint64_t bits = 0;
    for (int i = 0; i < NUMBER_BYTES; i++) {
        bits |= (uint64_t)bytes[i] << (8 * i);
    }
    return bits;
}

static void put_number(unsigned char *bytes, double number) {
    uint64_t bits;
    memcpy(&bits, &number, sizeof bits);
    put_bits(bytes, bits);
}

static double get_number(const unsigned char *bytes) {
    uint64_t bits = get_bits(bytes);
    double number;
    memcpy(&number, &bits, sizeof number);
    return number;
}

/* FNV-1a: no change of a single byte escapes it. */
static uint64_t checksum(const unsigned char *bytes) {
    uint64_t sum = 14695981039346656037u;
    for (size_t i = 0; i < CHECKED_SIZE; i++) {
        sum = (sum ^ bytes[i]) * 1099511628211u;
    }
    return sum;
}

static void write_header(unsigned char *bytes) {
    memset(bytes, 0, HEADER_SIZE);
    memcpy(bytes, FORMAT, sizeof FORMAT);
    memcpy(bytes + sizeof FORMAT, MODEL_GUID, sizeof MODEL_GUID);
}

static double field_number(const Snapshot *snapshot, const Field *field) {
    const char *place = (const char *)snapshot + field->offset;
    switch (field->kind) {
    case INTEGER:
        return *(const int *)place;
    case FLAG:
        return *(const bool *)place;
    case STATE_OF_LIFE:
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
    case STATE_OF_LIFE:
        *(Lifecycle *)place = (Lifecycle)(int)number;
        break;
    default:
        *(double *)place = number;
    }
}

static bool field_check(const Field *field, double number, Refusal *refusal) {
    char text[NUMBER_SIZE];
    if (field->kind == FINITE || field->kind == ENDLESS) {
        bool endless = field->kind == ENDLESS && number > 0.0;
        return isfinite(number) || (endless && isinf(number))
               || refuse(refusal, "FMU state refused: %s = %s; allowed is a finite number",
                         field->name, number_text(number, text));
    }
    return (number >= field->low && number <= field->high && number == floor(number))
           || refuse(refusal, "FMU state refused: %s = %s; allowed is %d to %d", field->name,
                     number_text(number, text), field->low, field->high);
}

void snapshot_write(const Snapshot *snapshot, unsigned char *bytes) {
    write_header(bytes);
    unsigned char *place = bytes + HEADER_SIZE;
    for (size_t i = 0; i < FIELD_COUNT; i++, place += NUMBER_BYTES) {
        put_number(place, field_number(snapshot, &FIELDS[i]));
    }
    for (size_t i = 0; i < SETTABLE_COUNT; i++, place += NUMBER_BYTES) {
        put_number(place, snapshot->values[i]);
    }
    put_bits(place, checksum(bytes));
}

/* Refuses bytes that are not from a component of this build, or no longer what it wrote. */
static bool header_check(const unsigned char *bytes, size_t size, Refusal *refusal) {
    unsigned char expected[HEADER_SIZE];
    write_header(expected);
    if (size < HEADER_SIZE || memcmp(bytes, expected, sizeof FORMAT) != 0) {
        return refuse(refusal, "FMU state refused: %lu bytes without the head of a state; allowed "
                      "is what fmi2SerializeFMUstate of this build wrote", (unsigned long)size);
    }
    if (memcmp(bytes, expected, HEADER_SIZE) != 0) {
        return refuse(refusal, "FMU state refused: it is of another build; allowed is one of the "
                      "build %s", MODEL_GUID);
    }
    if (size != SNAPSHOT_SIZE) {
        return refuse(refusal, "FMU state refused: it has %lu bytes; allowed is %d",
                      (unsigned long)size, SNAPSHOT_SIZE);
    }
    return get_bits(bytes + CHECKED_SIZE) == checksum(bytes)
           || refuse(refusal, "FMU state refused: damaged, its bytes do not match their checksum; "
                     "allowed is what fmi2SerializeFMUstate wrote");
}

bool snapshot_read(Snapshot *snapshot, const unsigned char *bytes, size_t size, Refusal *refusal) {
    if (!header_check(bytes, size, refusal)) {
        return false;
    }
    memset(snapshot, 0, sizeof *snapshot);
    const unsigned char *place = bytes + HEADER_SIZE;
    for (size_t i = 0; i < FIELD_COUNT; i++, place += NUMBER_BYTES) {
        double number = get_number(place);
        if (!field_check(&FIELDS[i], number, refusal)) {
            return false;
        }
        set_field(snapshot, &FIELDS[i], number);
    }
    for (size_t i = 0; i < SETTABLE_COUNT; i++, place += NUMBER_BYTES) {
        double number = get_number(place);
        if (!value_check(&VARIABLES[i], number, refusal)) {
            return false;
        }
        snapshot->values[i] = number;
    }
    bool needs_motion = snapshot->lifecycle == STEP_COMPLETE || snapshot->lifecycle == TERMINATED;
    return snapshot->moving || !needs_motion
           || refuse(refusal, "FMU state refused: it holds no motion; allowed is one after "
                     "initialization");
}
