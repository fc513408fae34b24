/* A co-simulation of FMI 2.0 in C, for Linux and Windows: steps LIBRARY GUID RESOURCES END STEP prints where the drive
   stands after every tenth of the run, to the last digit. */
#include <stdio.h>
#include <stdlib.h>

#include <stdarg.h>

#include "bindings/fmi/fmi2.h"

#ifdef _WIN32
#include <windows.h>
#define OPEN(name) ((void*)LoadLibraryA(name))
#define FIND(library, name) ((void*)GetProcAddress((HMODULE)(library), name))
#else
#include <dlfcn.h>
#define OPEN(name) dlopen(name, RTLD_NOW)
#define FIND(library, name) dlsym(library, name)
#endif

static void say(fmi2ComponentEnvironment environment, fmi2String instance, fmi2Status status, fmi2String category,
                fmi2String format, ...) {
  va_list arguments;
  (void)environment;
  printf("%s: status %d (%s): ", instance, (int)status, category);
  va_start(arguments, format);
  vprintf(format, arguments);
  va_end(arguments);
  printf("\n");
}

static void* library;
static void* find(const char* name) {
  void* const found = FIND(library, name);
  if (found) return found;
  printf("no function %s\n", name);
  exit(EXIT_FAILURE);
}
static void check(fmi2Status status) {
  if (status != fmi2OK) exit(EXIT_FAILURE);
}
#define FUNCTION(name) ((__typeof__(&name))find(#name))

int main(int argc, char** argv) {
  const fmi2CallbackFunctions callbacks = {say, calloc, free, NULL, NULL};
  const fmi2ValueReference reals[] = {0, 1, 9, 11}, wholes[] = {20, 21, 23}; /* angle, speed, force, event; mode */
  if (argc != 6) return EXIT_FAILURE;
  library = OPEN(argv[1]);
  if (!library) {
    printf("cannot load %s\n", argv[1]);
    return EXIT_FAILURE;
  }
  const double end = atof(argv[4]), step = atof(argv[5]);
  const fmi2Component drive =
      FUNCTION(fmi2Instantiate)("drive", fmi2CoSimulation, argv[2], argv[3], &callbacks, fmi2False, fmi2True);
  if (!drive) return EXIT_FAILURE;
  check(FUNCTION(fmi2SetupExperiment)(drive, fmi2False, 0.0, 0.0, fmi2True, end));
  check(FUNCTION(fmi2EnterInitializationMode)(drive));
  check(FUNCTION(fmi2ExitInitializationMode)(drive));
  const long steps = (long)(end / step + 0.5);
  for (long k = 0; k < steps; ++k) {
    double real[4];
    int whole[3];
    check(FUNCTION(fmi2DoStep)(drive, (double)k * step, step, fmi2True));
    check(FUNCTION(fmi2GetReal)(drive, reals, 4, real));
    check(FUNCTION(fmi2GetInteger)(drive, wholes, 3, whole));
    if ((k + 1) % (steps / 10) == 0)
      printf("%.17g %.17g %.17g %.17g %d %d %d\n", real[0], real[1], real[2], real[3], whole[0], whole[1], whole[2]);
  }
  check(FUNCTION(fmi2Terminate)(drive));
  FUNCTION(fmi2FreeInstance)(drive);
  return EXIT_SUCCESS;
}
