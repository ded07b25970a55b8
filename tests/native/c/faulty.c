/* Faults that a sanitizer must report: `faulty KIND` reads beyond a block, overflows, or races. */
#include <limits.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int shared = 0;

static void *write_shared(void *unused) {
    shared++;
    return unused;
}

int main(int count, char **arguments) {
    const char *kind = count > 1 ? arguments[1] : "";
    if (!strcmp(kind, "block")) {
        char *block = calloc((size_t)count, 1);
        if (block) printf("%d\n", block[count]);
    } else if (!strcmp(kind, "overflow")) {
        printf("%d\n", INT_MAX - 2 + count + count);
    } else if (!strcmp(kind, "race")) {
        pthread_t other;
        if (pthread_create(&other, NULL, write_shared, NULL)) return 1;
        write_shared(NULL);
        pthread_join(other, NULL);
    }
    return 0;
}
