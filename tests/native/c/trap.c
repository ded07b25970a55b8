/* Preloaded into a host: makes invalid operations and divisions by zero end it with SIGFPE. */
#define _GNU_SOURCE
#include <fenv.h>

__attribute__((constructor)) static void trap(void) {
    feenableexcept(FE_INVALID | FE_DIVBYZERO);
}
