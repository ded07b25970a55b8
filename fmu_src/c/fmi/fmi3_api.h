/* The functions of FMI 3.0, and the instances that answer them. */
#pragma once

#include "fmi3Functions.h"
#include "instance.h"

/* A host of FMI 3.0. */
Host fmi3_host(fmi3InstanceEnvironment environment, fmi3LogMessageCallback logger);
