/* The functions of FMI 2.0, and the instances that answer them. */
#pragma once

#include "fmi2Functions.h"
#include "instance.h"

/* The header of fmpy leaves out the prefix of FMI 2.0 for static linking. */
#ifdef FMI2_FUNCTION_PREFIX
#undef fmi2FullName
#define fmi2Paste(a, b) a##b
#define fmi2PasteB(a, b) fmi2Paste(a, b)
#define fmi2FullName(name) fmi2PasteB(FMI2_FUNCTION_PREFIX, name)
#endif
