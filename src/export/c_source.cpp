#include "export/named_array.h"
#include "export/targets.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// @ stands for the model's name; plainText() lets no other one through.
const char* const kCFunctions = R"(
/* States; all zeros are at rest: @_simulator state = {{0}}; */
typedef struct { double past[@_PLANT_ORDER + 1]; } @_simulator;
typedef struct { double past[@_NOISE_ORDER + 1]; } @_whitening;

/* num/den in transposed direct form II; den[0] = 1, and past[order] stays 0. */
static inline double @_filter(const double* num, const double* den, int order, double* past,
                                  double in) {
  const double out = num[0] * in + past[0];
  int i;
  for (i = 0; i < order; ++i) past[i] = past[i + 1] + num[i + 1] * in - den[i + 1] * out;
  return out;
}

/* The output of the nominal plant at the next sample, whose input is u. */
static inline double @_simulate(@_simulator* state, double u) {
  return @_OFFSET_Y + @_filter(@_plant_num, @_plant_den, @_PLANT_ORDER,
                                       state->past, u + @_OFFSET_U);
}

/* The white noise w behind the next residual, which is the measured output less the simulated one. */
static inline double @_whiten(@_whitening* state, double residual) {
  return @_filter(@_noise_den, @_noise_num, @_NOISE_ORDER, state->past, residual);
}
)";

const char* const kCSelfCheck = R"(
static double @_larger(double a, double b) { return a > b ? a : b; }
static double @_size(double a) { return a < 0 ? -a : a; }

int main(void) {
  @_simulator simulator = {{0}};
  @_whitening whitening = {{0}};
  const int samples = (int)(sizeof @_u / sizeof *@_u);
  double y = 0, w = 0, largest_y = 0, largest_w = 0;
  int t;
  for (t = 0; t < samples; ++t) {
    y = @_larger(y, @_size(@_simulate(&simulator, @_u[t]) - @_y[t]));
    w = @_larger(w, @_size(@_whiten(&whitening, @_residual[t]) - @_w[t]));
    largest_y = @_larger(largest_y, @_size(@_y[t]));
    largest_w = @_larger(largest_w, @_size(@_w[t]));
  }
  printf("simulator: differs by %.1e from the library in %d samples\n", y / largest_y, samples);
  printf("whitening: differs by %.1e from the library in %d samples\n", w / largest_w, samples);
  return y <= 1e-9 * largest_y && w <= 1e-9 * largest_w ? 0 : 1;
}
)";

std::string named(const std::string& text, const std::string& name) {
  std::string result;
  for (const char character : text) result += character == '@' ? name : std::string(1, character);
  return result;
}

std::string constant(const std::string& name, const std::string& value) {
  return "#define @_" + name + " " + value + "\n";
}

std::string list(const std::string& name, const VectorXd& values) {
  return "static const double @_" + name + "[] = {" + listText(values) + "};\n";
}

std::string lists(const std::string& name, const ExportedSystems& system) {
  return list(name + "_num", system.num.row(0)) + list(name + "_den", system.den.row(0));
}

std::string heading(const ExportedModel& model) {
  std::string text =
      "/* @: simulator and whitening filter, C99. Include this file where they are used; "
      "compile\n   it with -DSELF_CHECK for a program that compares them with the library.\n";
  for (const std::string& line : model.about) text += "   " + line + "\n";
  return text + "*/\n";
}

}  // namespace

std::string cSource(const ExportedModel& model) {
  std::string text =
      heading(model) + "#ifndef @_INCLUDED\n#define @_INCLUDED\n\n" +
      constant("SAMPLE_TIME", exactText(model.sample_time) + " /* [s] */") +
      constant("OFFSET_U", "(" + exactText(model.offset_u) + ")") +
      constant("OFFSET_Y", "(" + exactText(model.offset_y) + ")") +
      constant("NOISE_VARIANCE", exactText(model.noise_variance) + " /* of w */") +
      constant("PLANT_ORDER", std::to_string(model.plant.num.cols() - 1)) +
      constant("NOISE_ORDER", std::to_string(model.noise.num.cols() - 1)) +
      "\n/* Powers of z^-1; plant_num begins with the zeros of the delay. */\n" +
      lists("plant", model.plant) + lists("noise", model.noise) + kCFunctions +
      "\n#ifdef SELF_CHECK\n#include <stdio.h>\n\n/* Computed by the library, from rest. */\n" +
      list("u", model.reference.u) + list("y", model.reference.y) +
      list("residual", model.reference.residual) + list("w", model.reference.innovation) +
      kCSelfCheck + "#endif\n\n#endif\n";
  return named(text, model.name);
}

}  // namespace uncertainty_identification
