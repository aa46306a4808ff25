// The function file, called by Octave with its control package.
#include <gtest/gtest.h>

#include "export/targets.h"
#include "support/export_setup.h"
#include "support/mentions.h"

namespace uncertainty_identification {
namespace {

using test::exportedAs;
using test::mentions;
using test::octave;
using test::WrittenFile;

TEST(OctaveFunction, ChecksItselfAndTheSystemsOfTheControlPackage) {
  for (const Result& result : test::resultsToExport()) {
    const WrittenFile file("motor.m", octaveFunction(exportedAs("motor", result)));
    const ProcessResult run = octave(file.folder(), "motor('check');");
    EXPECT_EQ(run.status, 0) << run.errors;
    EXPECT_TRUE(mentions(run.output, "plant: differs by ")) << run.output << run.errors;
    EXPECT_TRUE(mentions(run.output, "noise: differs by ")) << run.output;
    EXPECT_TRUE(mentions(run.output, "library at 500 frequencies, as tf by ")) << run.output;
    EXPECT_EQ(mentions(run.output, "weight: "), result.bounds.has_value()) << run.output;
    EXPECT_EQ(mentions(run.output, "samples: "), result.estimate.joint_covariance.size() > 0)
        << run.output;
  }
}

TEST(OctaveFunction, AWrongCoefficientIsFound) {
  const std::string good = octaveFunction(exportedAs("motor", test::delayedResult()));
  for (const char* name : {"model.num = ", "model.noise_den = [1.0, ",
                           "model.weight_num = ", "model.samples_den = [1.0, "}) {
    const WrittenFile file("motor.m", test::tampered(good, name));
    const ProcessResult run = octave(file.folder(), "motor('check');");
    EXPECT_EQ(run.status, 1) << name << run.output;
    EXPECT_TRUE(mentions(run.errors, "the responses differ")) << run.errors;
  }
}

std::string replacedOnce(std::string text, const std::string& from, const std::string& to) {
  EXPECT_TRUE(mentions(text, from));
  return text.replace(text.find(from), from.size(), to);
}

/// A system that lost its delay has the right magnitudes, but not the right phases.
TEST(OctaveFunction, ASystemWithoutItsDelayIsFound) {
  const WrittenFile file("motor.m",
                         replacedOnce(octaveFunction(exportedAs("motor", test::delayedResult())),
                                      "tf(num(k, :), den(k, :), model",
                                      "tf(num(k, :), den(k, 1:find(den(k, :), 1, 'last')), model"));
  const ProcessResult run = octave(file.folder(), "motor('check');");
  EXPECT_EQ(run.status, 1) << run.output;
  EXPECT_TRUE(mentions(run.errors, "plant: the responses differ")) << run.errors;
}

TEST(OctaveFunction, NeedsNoControlPackageForTheNumbers) {
  const WrittenFile file("motor.m",
                         replacedOnce(octaveFunction(exportedAs("motor", test::delayedResult())),
                                      "found = exist('tf') > 0;", "found = false;"));
  const ProcessResult run = octave(file.folder(), "motor('check');");
  EXPECT_EQ(run.status, 0) << run.errors;
  EXPECT_TRUE(mentions(run.output, "tf is not installed: only the polynomials")) << run.output;
  const ProcessResult refused = octave(file.folder(), "[model, systems] = motor();");
  EXPECT_EQ(refused.status, 1);
  EXPECT_TRUE(mentions(refused.errors, "it is in the control package")) << refused.errors;
}

TEST(OctaveFunction, HoldsTheNumbersAndBuildsSystems) {
  const ExportedModel model = exportedAs("motor", test::delayedResult());
  const WrittenFile file("motor.m", octaveFunction(model));
  const ProcessResult run = octave(file.folder(), R"(
[model, systems] = motor();
assert(model.sample_time == 0.1 && model.delay == 4 && model.offset_u == -0.25);
assert(model.num, [0, 0, 0, 0, 0.5, 0.3]);
assert(model.den, [1, -1.2, 0.5, 0, 0, 0]);
assert(size(model.samples_num), [5, 7]);
assert(size(model.phase_upper), [4, 40]);
assert(isa(systems.plant, 'tf') && isa(systems.noise, 'tf') && isa(systems.weight, 'tf'));
assert(numel(systems.samples), 5);
assert(dcgain(systems.plant), 0.8 / 0.3, 1e-12);
y = step(systems.plant, 1);
assert(y(1:5), zeros(5, 1) + [0; 0; 0; 0; 0.5], 1e-12);
printf('%.17g', model.samples_num(4, 6));
)");
  EXPECT_EQ(run.status, 0) << run.errors;
  EXPECT_EQ(run.output.empty() ? 0 : std::stod(run.output), model.samples->num(3, 5));
}

TEST(OctaveFunction, SaysWhatIsMissingAndHowToUseIt) {
  const std::string text = octaveFunction(exportedAs("motor", test::bareResult()));
  EXPECT_EQ(text.rfind("function [model, systems] = motor(request)\n% motor: ", 0), 0u);
  EXPECT_TRUE(mentions(text, "\n% Missing: bands and weight: the result holds no bounds\n"));
  const WrittenFile file("motor.m", text);
  const ProcessResult run =
      octave(file.folder(), "model = motor(); disp(isfield(model, 'weight_num'))");
  EXPECT_EQ(run.output, "0\n") << run.errors;
}

}  // namespace
}  // namespace uncertainty_identification
