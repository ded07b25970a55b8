/* The format of a serialised state, whatever the component: header, numbers, checksum. */
#pragma once

#include <stddef.h>

#include "../base/refusal.h"

/* The header is "SLIDRES", the version of this layout in one byte, and the GUID in 40 bytes, padded with 0. Numbers are
 * IEEE doubles, lowest byte first. The checksum covers all bytes before it. */
enum { STATE_HEADER_SIZE = 48, STATE_NUMBER_SIZE = 8, STATE_CHECKSUM_SIZE = 8 };

void state_number_put(unsigned char *bytes, double number);

double state_number_get(const unsigned char *bytes);

/* Write header and checksum of a state of `size` bytes, whose numbers are in place. */
void state_seal(unsigned char *bytes, size_t size);

/* Refuse bytes that are not a state of `expected` bytes from this build, or damaged. */
bool state_seal_check(const unsigned char *bytes, size_t size, size_t expected, Refusal *refusal);
