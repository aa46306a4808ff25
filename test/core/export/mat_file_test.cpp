// The MATLAB file, read by scipy and by Octave.
#include <gtest/gtest.h>

#include <sstream>

#include "export/named_array.h"
#include "export/targets.h"
#include "support/export_setup.h"
#include "support/mentions.h"

namespace uncertainty_identification {
namespace {

using test::exportedAs;
using test::mentions;
using test::WrittenFile;

/// Prints every array, column after column with all digits, and the largest difference of responses
/// from num/den, as the Python module computes it.
const char* const kScipyReader = R"(
import sys, numpy as np, scipy.io
m = scipy.io.loadmat(sys.argv[1])
z = np.exp(1j * m["omega"] * m["sample_time"])
for prefix in ("", "noise_", "weight_", "samples_"):
    if prefix + "num" not in m: continue
    num, den, response = (m[prefix + key] for key in ("num", "den", "response"))
    for n, d, r in zip(num, den, response):
        found = np.polyval(n, z) / np.polyval(d, z)
        rounding = (abs(n).sum() + abs(r) * abs(d).sum()) / abs(np.polyval(d, z))
        assert np.max(abs(found - r) / (abs(r) + 1e-5 * rounding)) < 1e-9, prefix
    print("checked", prefix + "num", *num.shape)
for name, values in sorted(m.items()):
    if name.startswith("__") or name == "about": continue
    print(name, *values.shape, *(repr(float(x)) for part in (values.real, values.imag)
                                 for x in part.flatten("F")))
print(m["about"][0])
)";

ProcessResult readByScipy(const WrittenFile& file) {
  return test::python({"-c", kScipyReader, file.path()});
}

void expectSameNumbers(const std::string& printed, const NamedArray& array) {
  const std::size_t at = printed.find("\n" + array.name + " ");
  ASSERT_NE(at, std::string::npos) << array.name;
  std::istringstream words(printed.substr(at + 2 + array.name.size()));
  Eigen::Index rows = 0, columns = 0;
  words >> rows >> columns;
  ASSERT_EQ(rows, array.values.rows()) << array.name;
  ASSERT_EQ(columns, array.values.cols()) << array.name;
  for (const Eigen::MatrixXd& part :
       {Eigen::MatrixXd(array.values.real()), Eigen::MatrixXd(array.values.imag())}) {
    for (Eigen::Index k = 0; k < part.size(); ++k) {
      double value = -1;
      words >> value;
      ASSERT_EQ(value, part.data()[k]) << array.name;
    }
  }
}

TEST(MatFile, ScipyReadsEveryNumber) {
  for (const Result& result : test::resultsToExport()) {
    const ExportedModel model = exportedAs("motor", result);
    const WrittenFile file("motor.mat", matFile(model));
    const ProcessResult run = readByScipy(file);
    ASSERT_EQ(run.status, 0) << run.errors;
    EXPECT_TRUE(mentions(run.output, "checked num")) << run.output;
    EXPECT_EQ(mentions(run.output, "checked samples_num 5 "), model.samples.has_value());
    EXPECT_EQ(mentions(run.output, "checked weight_num"), model.weight.has_value());
    for (const NamedArray& array : namedArrays(model)) expectSameNumbers(run.output, array);
  }
}

TEST(MatFile, OctaveReadsIt) {
  const WrittenFile file("motor.mat", matFile(exportedAs("motor", test::delayedResult())));
  const ProcessResult run = test::octave(file.folder(), R"(
m = load('motor.mat');
assert(m.num, [0, 0, 0, 0, 0.5, 0.3]);
assert(m.den, [1, -1.2, 0.5, 0, 0, 0]);
assert(m.sample_time, 0.1);
assert(iscomplex(m.samples_response) && ischar(m.about));
z = exp(1i * m.omega * m.sample_time);
for k = 1:5
  found = polyval(m.samples_num(k, :), z) ./ polyval(m.samples_den(k, :), z);
  assert(max(abs(found ./ m.samples_response(k, :) - 1)) < 1e-9);
end
assert(max(abs(polyval(m.num, z) ./ polyval(m.den, z) ./ m.response - 1)) < 1e-9);
assert(max(abs(polyval(m.noise_num, z) ./ polyval(m.noise_den, z) ./ m.noise_response - 1)) < 1e-9);
disp(m.about);
)");
  EXPECT_EQ(run.status, 0) << run.errors;
  EXPECT_TRUE(mentions(run.output, "data fingerprint 0123abcd")) << run.output;
}

TEST(MatFile, SaysWhatIsMissing) {
  const WrittenFile file("motor.mat", matFile(exportedAs("motor", test::bareResult())));
  const ProcessResult run = readByScipy(file);
  EXPECT_TRUE(mentions(run.output, "Missing: bands and weight: the result holds no bounds."))
      << run.output << run.errors;
}

/// The layout that the format prescribes, and no time of writing: the same model, the same bytes.
TEST(MatFile, BeginsWithTheHeaderOfVersion5) {
  const ExportedModel model = exportedAs("motor", test::bareResult());
  const std::string bytes = matFile(model);
  EXPECT_EQ(bytes.rfind("MATLAB 5.0 MAT-file", 0), 0u);
  EXPECT_EQ(bytes.substr(116, 12), std::string("\0\0\0\0\0\0\0\0\0\1IM", 12));
  EXPECT_EQ(bytes.size() % 8, 0u);
  EXPECT_EQ(bytes, matFile(exportedAs("motor", test::bareResult())));
}

}  // namespace
}  // namespace uncertainty_identification
