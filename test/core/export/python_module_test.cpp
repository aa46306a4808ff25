// The Python module, run by Debian's Python with numpy.
#include <gtest/gtest.h>

#include "export/targets.h"
#include "support/export_setup.h"
#include "support/mentions.h"

namespace uncertainty_identification {
namespace {

using test::exportedAs;
using test::mentions;
using test::python;
using test::WrittenFile;

/// Runs statements that can import the module "motor".
ProcessResult importing(const WrittenFile& module, const std::string& statements) {
  return python({"-c", "import sys; sys.path.insert(0, '" + module.folder() +
                           "')\nimport numpy as np, motor\n" + statements});
}

TEST(PythonModule, ChecksItself) {
  for (const Result& result : test::resultsToExport()) {
    const WrittenFile module("motor.py", pythonModule(exportedAs("motor", result)));
    const ProcessResult run = python({"-W", "error", module.path()});
    EXPECT_EQ(run.status, 0) << run.errors;
    EXPECT_EQ(run.errors, "");
    EXPECT_TRUE(mentions(run.output, "plant: differs by ")) << run.output;
    EXPECT_TRUE(mentions(run.output, "noise: differs by ")) << run.output;
    EXPECT_TRUE(mentions(run.output, "library at 500 frequencies")) << run.output;
    EXPECT_EQ(mentions(run.output, "weight: "), result.bounds.has_value()) << run.output;
    EXPECT_EQ(mentions(run.output, "samples: "), result.estimate.joint_covariance.size() > 0)
        << run.output;
  }
}

TEST(PythonModule, AWrongCoefficientIsFound) {
  const std::string good = pythonModule(exportedAs("motor", test::delayedResult()));
  for (const char* name : {"\nnum = ", "\nnoise_den = np.array([1.0, ",
                           "\nweight_num = ", "\nsamples_den = np.array([\n    [1.0, "}) {
    const WrittenFile module("motor.py", test::tampered(good, name));
    const ProcessResult run = python({module.path()});
    EXPECT_EQ(run.status, 1) << name << run.output;
    EXPECT_TRUE(mentions(run.errors, "the responses differ")) << run.errors;
  }
}

/// Rounding alone costs more than 1e-9 with the slow plant; the check still sees a change that is
/// not rounding.
TEST(PythonModule, AWrongCoefficientOfAnIllConditionedPlantIsFound) {
  const std::string good = pythonModule(exportedAs("motor", test::slowResult()));
  const WrittenFile module("motor.py", test::tampered(good, "\nden = np.array([1.0, "));
  EXPECT_EQ(python({module.path()}).status, 1);
}

TEST(PythonModule, HoldsTheNumbers) {
  const ExportedModel model = exportedAs("motor", test::delayedResult());
  const WrittenFile module("motor.py", pythonModule(model));
  const ProcessResult run = importing(module, R"(
assert motor.sample_time == 0.1 and motor.delay == 4 and motor.offset_y == 3.5
assert motor.num.tolist() == [0, 0, 0, 0, 0.5, 0.3]
assert motor.den.tolist() == [1, -1.2, 0.5, 0, 0, 0]
assert motor.samples_num.shape == (5, 7) == motor.samples_den.shape
assert motor.samples_response.shape == (5, 500) and motor.samples_seed == 1
assert motor.magnitude_lower.shape == (4, 40) == (len(motor.band_levels), len(motor.band_omega))
assert np.all(motor.magnitude_lower <= motor.magnitude_upper)
gain = motor.frequency_response(motor.num, motor.den, [0])
assert abs(gain[0, 0] - 0.8 / 0.3) < 1e-12
print(repr(motor.samples_num[3, 5]))
)");
  EXPECT_EQ(run.status, 0) << run.errors;
  EXPECT_EQ(std::stod(run.output), model.samples->num(3, 5));
  EXPECT_TRUE(mentions(pythonModule(model), "uncertainty_identification 1.2.3"));
}

/// python-control is not in Debian 12. A stand-in makes systems of scipy, which takes its arguments
/// in the same order and with the same powers of z, out of what the module hands over.
TEST(PythonModule, BuildsSystemsOfPythonControl) {
  const WrittenFile module("motor.py", pythonModule(exportedAs("motor", test::delayedResult())));
  const ProcessResult run = importing(module, R"(
import types, warnings, scipy.signal
warnings.simplefilter("ignore")  # scipy drops the leading zeros of powers of z
assert "control" not in sys.modules
sys.modules["control"] = types.SimpleNamespace(
    TransferFunction=lambda num, den, dt: scipy.signal.TransferFunction(num, den, dt=dt))
systems = motor.systems()
assert sorted(systems) == ["noise", "plant", "samples", "weight"]
def check(system, response):
    assert system.dt == 0.1
    _, found = scipy.signal.dfreqresp(system, w=motor.omega * 0.1)
    assert np.max(np.abs(found - response) / (np.abs(response) + 1e-14)) < 1e-9
check(systems["plant"], motor.response)
check(systems["noise"], motor.noise_response)
check(systems["weight"], motor.weight_response)
assert len(systems["samples"]) == 5
for system, response in zip(systems["samples"], motor.samples_response):
    check(system, response)
)");
  EXPECT_EQ(run.status, 0) << run.errors;
}

TEST(PythonModule, ASinglePlantDrawnIsATable) {
  const WrittenFile module("motor.py",
                           pythonModule(exportedModel(test::laguerreResult(), "motor", 1, 1)));
  const ProcessResult run = importing(module, "print(motor.samples_num.shape)");
  EXPECT_EQ(run.output.rfind("(1, ", 0), 0u) << run.output << run.errors;
}

TEST(PythonModule, SaysWhatIsMissing) {
  const std::string text = pythonModule(exportedAs("motor", test::bareResult()));
  EXPECT_TRUE(mentions(text, "\nMissing: bands and weight: the result holds no bounds\n"));
}

}  // namespace
}  // namespace uncertainty_identification
