#include "state_bytes.h"

#include <stdint.h>
#include <string.h>

#include "model_guid.h"

static const unsigned char FORMAT[8] = {'S', 'L', 'I', 'D', 'R', 'E', 'S', 1};

static void put_bits(unsigned char *bytes, uint64_t bits) {
    for (int i = 0; i < STATE_NUMBER_SIZE; i++) {
        bytes[i] = (unsigned char)((bits >> (8 * i)) & 0xff);
    }
}

static uint64_t get_bits(const unsigned char *bytes) {
    uint64_t bits = 0;
    for (int i = 0; i < STATE_NUMBER_SIZE; i++) {
        bits |= (uint64_t)bytes[i] << (8 * i);
    }
    return bits;
}

void state_number_put(unsigned char *bytes, double number) {
    uint64_t bits;
    memcpy(&bits, &number, sizeof bits);
    put_bits(bytes, bits);
}

double state_number_get(const unsigned char *bytes) {
    uint64_t bits = get_bits(bytes);
    double number;
    memcpy(&number, &bits, sizeof number);
    return number;
}

/* FNV-1a: detects every change of a single byte. */
static uint64_t checksum(const unsigned char *bytes, size_t size) {
    uint64_t sum = 14695981039346656037u;
    for (size_t i = 0; i < size; i++) {
        sum = (sum ^ bytes[i]) * 1099511628211u;
    }
    return sum;
}

static void write_header(unsigned char *bytes) {
    memset(bytes, 0, STATE_HEADER_SIZE);
    memcpy(bytes, FORMAT, sizeof FORMAT);
    memcpy(bytes + sizeof FORMAT, MODEL_GUID, sizeof MODEL_GUID);
}

void state_seal(unsigned char *bytes, size_t size) {
    write_header(bytes);
    size_t checked = size - STATE_CHECKSUM_SIZE;
    put_bits(bytes + checked, checksum(bytes, checked));
}

bool state_seal_check(const unsigned char *bytes, size_t size, size_t expected, Refusal *refusal) {
    unsigned char header[STATE_HEADER_SIZE];
    write_header(header);
    if (size < STATE_HEADER_SIZE || memcmp(bytes, header, sizeof FORMAT) != 0) {
        return refuse(refusal,
                      "FMU state refused: %lu bytes without the header of a state; must "
                      "be bytes that a state of this build was serialised to",
                      (unsigned long)size);
    }
    if (memcmp(bytes, header, STATE_HEADER_SIZE) != 0) {
        return refuse(refusal,
                      "FMU state refused: it is of another build; must be of the build "
                      "%s",
                      MODEL_GUID);
    }
    if (size != expected) {
        return refuse(refusal, "FMU state refused: it has %lu bytes; must be %lu", (unsigned long)size,
                      (unsigned long)expected);
    }
    size_t checked = size - STATE_CHECKSUM_SIZE;
    return get_bits(bytes + checked) == checksum(bytes, checked) ||
           refuse(refusal, "FMU state refused: damaged, its bytes do not match their checksum; "
                           "must be bytes that a state was serialised to");
}
