/* What the serialised state of any component begins with, ends with and is made of. */
#ifndef STATE_BYTES_H
#define STATE_BYTES_H

#include <stdbool.h>
#include <stddef.h>

#include "refusal.h"

/* A header of 8 bytes "SLIDRES" with the version of this layout and 40 bytes GUID, filled up with
 * 0; numbers as IEEE doubles, lowest byte first; at last 8 bytes of checksum over all before. */
enum { STATE_HEADER_SIZE = 48, STATE_NUMBER_SIZE = 8, STATE_CHECKSUM_SIZE = 8 };

void state_number_put(unsigned char *bytes, double number);

double state_number_get(const unsigned char *bytes);

/* Writes header and checksum around what is there of a state of `size` bytes in all. */
void state_seal(unsigned char *bytes, size_t size);

/* Refuses bytes that are not a state of `expected` bytes from this build, or no longer what it
 * wrote. */
bool state_seal_check(const unsigned char *bytes, size_t size, size_t expected, Refusal *refusal);

#endif
