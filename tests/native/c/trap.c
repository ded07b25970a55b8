/* Preloaded into a host: invalid operations and divisions by zero end it, as in hosts that trap them. */
#define _GNU_SOURCE
#include <fenv.h>

__attribute__((constructor)) static void trap(void) {
    feenableexcept(FE_INVALID | FE_DIVBYZERO);
}
