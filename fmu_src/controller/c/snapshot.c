/* Layout: 40 bytes GUID, filled up with 0; then every number as an IEEE double, lowest byte first:
 * the fields in their order, and the values that can be set; at last 8 bytes of checksum over all
 * before, lowest byte first. */
#include "snapshot.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "model_guid.h"
#include "values.h"

enum {
    GUID_SIZE = 40,
    NUMBER_BYTES = 8,
    FIELD_COUNT = 7,
    NUMBER_COUNT = FIELD_COUNT + SETTABLE_COUNT,
    CHECKED_SIZE = GUID_SIZE + NUMBER_COUNT * NUMBER_BYTES,
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

/* FNV-1a: no change of a single byte escapes it. */
static uint64_t checksum(const unsigned char *bytes) {
    uint64_t sum = 14695981039346656037u;
    for (size_t i = 0; i < CHECKED_SIZE; i++) {
        sum = (sum ^ bytes[i]) * 1099511628211u;
    }
    return sum;
}

static void write_header(unsigned char *bytes) {
    memset(bytes, 0, GUID_SIZE);
    memcpy(bytes, MODEL_GUID, sizeof MODEL_GUID);
}

void snapshot_write(const Snapshot *snapshot, unsigned char *bytes) {
    double numbers[NUMBER_COUNT] = {
        (double)snapshot->lifecycle, snapshot->start_time,       snapshot->time,
        snapshot->stop_time,         snapshot->samples,          snapshot->control.integral,
        snapshot->control.effort,
    };
    memcpy(numbers + FIELD_COUNT, snapshot->values, sizeof snapshot->values);
    write_header(bytes);
    for (int i = 0; i < NUMBER_COUNT; i++) {
        uint64_t bits;
        memcpy(&bits, &numbers[i], sizeof bits);
        put_bits(bytes + GUID_SIZE + i * NUMBER_BYTES, bits);
    }
    put_bits(bytes + CHECKED_SIZE, checksum(bytes));
}

/* Refuses bytes that are not from a controller of this build, or no longer what it wrote. */
static bool bytes_check(const unsigned char *bytes, size_t size, Refusal *refusal) {
    unsigned char expected[GUID_SIZE];
    write_header(expected);
    if (size < GUID_SIZE || memcmp(bytes, expected, GUID_SIZE) != 0) {
        return refuse(refusal, "FMU state refused: %lu bytes without the head of a state; allowed "
                      "is what fmi2SerializeFMUstate of this build wrote", (unsigned long)size);
    }
    if (size != SNAPSHOT_SIZE) {
        return refuse(refusal, "FMU state refused: it has %lu bytes; allowed is %d",
                      (unsigned long)size, SNAPSHOT_SIZE);
    }
    return get_bits(bytes + CHECKED_SIZE) == checksum(bytes)
           || refuse(refusal, "FMU state refused: damaged, its bytes do not match their checksum; "
                     "allowed is what fmi2SerializeFMUstate wrote");
}

/* Refuses fields that no controller can have. */
static bool fields_check(const double *numbers, Refusal *refusal) {
    bool known = numbers[0] >= 0.0 && numbers[0] < LIFECYCLES && numbers[0] == floor(numbers[0]);
    bool times = isfinite(numbers[1]) && isfinite(numbers[2]) && numbers[3] >= numbers[1];
    bool sampled = isfinite(numbers[4]) && fabs(numbers[5]) <= 1.0 && fabs(numbers[6]) <= 1.0;
    return (known && times && sampled)
           || refuse(refusal, "FMU state refused: it holds a %s that no controller can have; "
                     "allowed is what fmi2SerializeFMUstate wrote",
                     !known ? "lifecycle" : !times ? "time" : "sample");
}

bool snapshot_read(Snapshot *snapshot, const unsigned char *bytes, size_t size, Refusal *refusal) {
    double numbers[NUMBER_COUNT];
    if (!bytes_check(bytes, size, refusal)) {
        return false;
    }
    for (int i = 0; i < NUMBER_COUNT; i++) {
        uint64_t bits = get_bits(bytes + GUID_SIZE + i * NUMBER_BYTES);
        memcpy(&numbers[i], &bits, sizeof bits);
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
