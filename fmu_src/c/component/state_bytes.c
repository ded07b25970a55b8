#include "state_bytes.h"

#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include "model_guid.h"
#include "values.h"

static const unsigned char FORMAT[8] = {'S', 'L', 'I', 'D', 'R', 'E', 'S', 2};

enum {
    HEADER_SIZE = 48,
    SNAPSHOT_SIZE = offsetof(Snapshot, lifecycle) + sizeof(Lifecycle), /* without padding behind the last field */
    CHECKED_SIZE = HEADER_SIZE + SNAPSHOT_SIZE,
    STATE_SIZE = CHECKED_SIZE + sizeof(uint64_t)
};

size_t state_bytes_size(void) {
    return STATE_SIZE;
}

/* FNV-1a: detects every change of a single byte. */
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

void state_bytes_write(const Snapshot *snapshot, unsigned char *bytes) {
    write_header(bytes);
    memcpy(bytes + HEADER_SIZE, snapshot, SNAPSHOT_SIZE);
    uint64_t sum = checksum(bytes);
    memcpy(bytes + CHECKED_SIZE, &sum, sizeof sum);
}

bool state_bytes_read(Snapshot *snapshot, const unsigned char *bytes, size_t size, Refusal *refusal) {
    unsigned char header[HEADER_SIZE];
    uint64_t sum;
    write_header(header);
    if (size < HEADER_SIZE || memcmp(bytes, header, sizeof FORMAT) != 0) {
        return refuse(refusal,
                      "FMU state refused: %lu bytes without the header of a state; must be bytes that a state of this "
                      "build was serialised to",
                      (unsigned long)size);
    }
    if (memcmp(bytes, header, HEADER_SIZE) != 0) {
        return refuse(refusal, "FMU state refused: it is of another build; must be of the build %s", MODEL_GUID);
    }
    if (size != STATE_SIZE) {
        return refuse(refusal, "FMU state refused: it has %lu bytes; must be %d", (unsigned long)size, STATE_SIZE);
    }
    memcpy(&sum, bytes + CHECKED_SIZE, sizeof sum);
    memcpy(snapshot, bytes + HEADER_SIZE, SNAPSHOT_SIZE);
    unsigned lifecycle = (unsigned)snapshot->lifecycle;
    bool possible = lifecycle < LIFECYCLES && FMI.state_names[lifecycle] != NULL;
    for (int i = 0; possible && i < SETTABLE_COUNT; i++) {
        possible = value_check(&VARIABLES[i], snapshot->values[i], refusal);
    }
    return (possible && sum == checksum(bytes)) ||
           refuse(refusal, "FMU state refused: damaged; must be bytes that a state was serialised to");
}
