/* The names of FMI 3.0. */
#include "../component/lifecycle.h"

/* Reference 1 is the time; the variables of the table follow. */
const FmiVersion FMI = {
    .min_reference = 1,
    .reference_offset = 2,
    .state_names = {"instantiated", "initialization mode", "step mode", "terminated", "event mode"},
    .type_names = {"Float64", "Int32", "Boolean", "String", "Float32", "Int8", "UInt8", "Int16", "UInt16", "UInt32",
                   "Int64", "UInt64"},
    .count_name = "nValueReferences",
    .token = "instantiationToken",
};
