/* An FMU's binary, loaded at run time: one function pointer for each function of FMI 2.0. */
#ifndef HOSTS_FMU_LIBRARY_H
#define HOSTS_FMU_LIBRARY_H

#include <stdio.h>
#include <string.h>

#include "fmi2FunctionTypes.h"

#ifdef _WIN32
#include <windows.h>
#else
#include <dlfcn.h>
#endif

#define FMI2_CO_SIMULATION_FUNCTIONS(X) \
    X(GetTypesPlatform) X(GetVersion) X(SetDebugLogging) X(Instantiate) X(FreeInstance) \
    X(SetupExperiment) X(EnterInitializationMode) X(ExitInitializationMode) X(Terminate) X(Reset) \
    X(GetReal) X(GetInteger) X(GetBoolean) X(GetString) \
    X(SetReal) X(SetInteger) X(SetBoolean) X(SetString) \
    X(GetFMUstate) X(SetFMUstate) X(FreeFMUstate) \
    X(SerializedFMUstateSize) X(SerializeFMUstate) X(DeSerializeFMUstate) \
    X(GetDirectionalDerivative) X(SetRealInputDerivatives) X(GetRealOutputDerivatives) \
    X(DoStep) X(CancelStep) \
    X(GetStatus) X(GetRealStatus) X(GetIntegerStatus) X(GetBooleanStatus) X(GetStringStatus)

#define FMI2_MODEL_EXCHANGE_FUNCTIONS(X) \
    X(EnterEventMode) X(NewDiscreteStates) X(EnterContinuousTimeMode) X(CompletedIntegratorStep) \
    X(SetTime) X(SetContinuousStates) X(GetDerivatives) X(GetEventIndicators) \
    X(GetContinuousStates) X(GetNominalsOfContinuousStates)

typedef struct {
#define MEMBER(name) fmi2##name##TYPE *name;
    FMI2_CO_SIMULATION_FUNCTIONS(MEMBER)
    FMI2_MODEL_EXCHANGE_FUNCTIONS(MEMBER)
#undef MEMBER
} FmuLibrary;

static void *open_library(const char *path) {
#ifdef _WIN32
    void *handle = (void *)LoadLibraryA(path);
    if (!handle) fprintf(stderr, "%s: cannot be loaded: error %lu\n", path, GetLastError());
#else
    void *handle = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    if (!handle) fprintf(stderr, "%s\n", dlerror());
#endif
    return handle;
}

/* A pointer to a function is copied bytewise: C99 has no conversion from one to data. */
static int find_function(void *handle, const char *name, void *function, size_t size) {
#ifdef _WIN32
    FARPROC found = GetProcAddress((HMODULE)handle, name);
#else
    void *found = dlsym(handle, name);
#endif
    if (!found) {
        fprintf(stderr, "%s is missing\n", name);
        return 0;
    }
    memcpy(function, &found, size);
    return 1;
}

/* Loads the binary at `path` for good; 0, with a message on stderr, where that fails. */
static int load_fmu_library(FmuLibrary *library, const char *path) {
    void *handle = open_library(path);
    int complete = handle != NULL;
    if (!complete) return 0;
#define FIND(name) \
    complete &= find_function(handle, "fmi2" #name, &library->name, sizeof library->name);
    FMI2_CO_SIMULATION_FUNCTIONS(FIND)
    FMI2_MODEL_EXCHANGE_FUNCTIONS(FIND)
#undef FIND
    return complete;
}

#endif
