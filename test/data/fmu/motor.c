/* A motor with friction as a functional mock-up unit, for tests: speed' = (constant voltage - damping speed
   - friction tanh(speed / 0.05)) / inertia. One of CO_SIMULATION_2, MODEL_EXCHANGE_2 and CO_SIMULATION_3 says which
   interface it has, FAULT what goes wrong in its second step: 1 crash, 2 hang, 3 NaN, 4 endless allocation, 5 an error,
   6 it prints on the standard output. */
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#ifndef FAULT
#define FAULT 0
#endif

enum { VOLTAGE, SPEED, INERTIA, CONSTANT, DAMPING, FRICTION, VARIABLES };
enum { OK, WARNING, DISCARD, ERROR };

typedef struct {
  double value[VARIABLES];
  double time;
  int steps;
} Motor;

static Motor* newMotor(void) {
  const double start[VARIABLES] = {0, 0, 0.02, 0.5, 0.1, 0.15};
  Motor* motor = calloc(1, sizeof *motor);
  memcpy(motor->value, start, sizeof start);
  return motor;
}

static double slope(const Motor* motor, double speed) {
  const double* v = motor->value;
  return (v[CONSTANT] * v[VOLTAGE] - v[DAMPING] * speed - v[FRICTION] * tanh(speed / 0.05)) / v[INERTIA];
}

/* Whether the step succeeds. */
static bool mishap(Motor* motor) {
  if (++motor->steps < 2) return true;
  if (FAULT == 1) abort();
  for (; FAULT == 2;) pause();
  if (FAULT == 3) motor->value[SPEED] = NAN;
  for (; FAULT == 4;) {
    char* more = malloc(1 << 20);
    if (!more) abort();
    memset(more, 1, 1 << 20);
  }
  if (FAULT == 6) printf("{\"y\": [0]}\n");
  return FAULT != 5;
}

static int set(Motor* motor, const unsigned* reference, size_t count, const double* value) {
  for (size_t k = 0; k < count; ++k) motor->value[reference[k]] = value[k];
  return OK;
}

static int get(const Motor* motor, const unsigned* reference, size_t count, double* value) {
  for (size_t k = 0; k < count; ++k) value[k] = motor->value[reference[k]];
  return OK;
}

#ifndef MODEL_EXCHANGE_2
/* Runge and Kutta's method with ten steps. */
static int advance(Motor* motor, double length) {
  const double step = length / 10;
  double* speed = &motor->value[SPEED];
  for (int k = 0; k < 10; ++k) {
    const double a = slope(motor, *speed), b = slope(motor, *speed + step / 2 * a);
    const double c = slope(motor, *speed + step / 2 * b), d = slope(motor, *speed + step * c);
    *speed += step * (a + 2 * b + 2 * c + d) / 6;
  }
  return mishap(motor) ? OK : ERROR;
}
#endif

#ifdef CO_SIMULATION_3
void* fmi3InstantiateCoSimulation(const char* name, const char* token, const char* resources, bool visible, bool logging,
                                  bool events, bool early, const unsigned* required, size_t count, void* environment,
                                  void (*log)(void*, int, const char*, const char*), void* update) {
  return strcmp(token, "{motor}") == 0 ? newMotor() : NULL;
}
void fmi3FreeInstance(void* motor) { free(motor); }
int fmi3EnterInitializationMode(void* motor, bool a, double b, double c, bool d, double e) { return OK; }
int fmi3ExitInitializationMode(void* motor) { return OK; }
int fmi3SetFloat64(void* motor, const unsigned* reference, size_t count, const double* value, size_t values) {
  return set(motor, reference, count, value);
}
int fmi3GetFloat64(void* motor, const unsigned* reference, size_t count, double* value, size_t values) {
  return get(motor, reference, count, value);
}
int fmi3DoStep(void* motor, double time, double length, bool earlier, bool* event, bool* terminate, bool* early,
               double* last) {
  return advance(motor, length);
}
#else
typedef struct {
  void (*logger)(void*, const char*, int, const char*, const char*, ...);
} Callbacks;

void* fmi2Instantiate(const char* name, int type, const char* guid, const char* resources, const Callbacks* callbacks,
                      int visible, int logging) {
  if (strcmp(guid, "{motor}") == 0 && strncmp(resources, "file:///", 8) == 0) return newMotor();
  callbacks->logger(NULL, name, ERROR, "", "the guid is %s", guid);
  return NULL;
}
void fmi2FreeInstance(void* motor) { free(motor); }
int fmi2SetupExperiment(void* motor, int a, double b, double start, int c, double stop) { return OK; }
int fmi2EnterInitializationMode(void* motor) { return OK; }
int fmi2ExitInitializationMode(void* motor) { return OK; }
int fmi2SetReal(void* motor, const unsigned* reference, size_t count, const double* value) {
  return set(motor, reference, count, value);
}
int fmi2GetReal(void* motor, const unsigned* reference, size_t count, double* value) {
  return get(motor, reference, count, value);
}
#ifdef CO_SIMULATION_2
int fmi2DoStep(void* motor, double time, double length, int earlier) { return advance(motor, length); }
#else
typedef struct {
  int more, terminate, nominals, states, has_time;
  double time;
} EventInfo;

/* With TIME_EVENT the voltage is halved from that time on. */
#ifndef TIME_EVENT
#define TIME_EVENT 1e9
#endif
int fmi2EnterEventMode(void* motor) { return OK; }
int fmi2NewDiscreteStates(void* motor, EventInfo* info) {
  Motor* at = motor;
  const bool is_late = at->time >= TIME_EVENT - 1e-9;
  if (is_late) at->value[CONSTANT] /= 2;
  *info = (EventInfo){0, 0, 0, 0, !is_late, TIME_EVENT};
  return OK;
}
int fmi2EnterContinuousTimeMode(void* motor) { return OK; }
int fmi2CompletedIntegratorStep(void* motor, int earlier, int* events, int* terminate) {
  return mishap(motor) ? OK : ERROR;
}
int fmi2SetTime(void* motor, double time) {
  ((Motor*)motor)->time = time;
  return OK;
}
int fmi2SetContinuousStates(void* motor, const double* states, size_t count) {
  ((Motor*)motor)->value[SPEED] = states[0];
  return OK;
}
int fmi2GetContinuousStates(void* motor, double* states, size_t count) {
  states[0] = ((Motor*)motor)->value[SPEED];
  return OK;
}
int fmi2GetDerivatives(void* motor, double* slopes, size_t count) {
  slopes[0] = slope(motor, ((Motor*)motor)->value[SPEED]);
  return OK;
}
int fmi2GetEventIndicators(void* motor, double* indicators, size_t count) {
  indicators[0] = ((Motor*)motor)->value[SPEED] - 1e6;
  return OK;
}
#endif
#endif
