/* A serialised state, whatever the component: header, the bytes of a Snapshot, checksum.
 *
 * The header is "SLIDRES", the version of this layout in one byte, and the GUID in 40 bytes, padded with 0. The
 * checksum covers all bytes before it. */
#pragma once

#include "snapshot.h"

/* Number of bytes of any state. */
size_t state_bytes_size(void);

/* Write state_bytes_size() bytes. */
void state_bytes_write(const Snapshot *snapshot, unsigned char *bytes);

/* Read what state_bytes_write wrote. Refuse bytes of another build and damaged ones; `snapshot` is then undefined. */
bool state_bytes_read(Snapshot *snapshot, const unsigned char *bytes, size_t size, Refusal *refusal);
