/* The names of FMI 2.0. */
#include "../component/lifecycle.h"

const FmiVersion FMI = {
    .min_reference = 0,
    .reference_offset = 0,
    .state_names = {"instantiated", "initialization mode", "step complete", "terminated"},
    .type_names = {"Real", "Integer", "Boolean", "String"},
    .count_name = "nvr",
    .token = "fmuGUID",
};
