// The C file, compiled by the C compiler as strictly as it can.
#include <gtest/gtest.h>

#include <sstream>

#include "export/targets.h"
#include "io/read_file.h"
#include "support/export_setup.h"
#include "support/mentions.h"

namespace uncertainty_identification {
namespace {

using test::exportedAs;
using test::mentions;

class CSource : public testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& content) const {
    std::ofstream(folder_ / name) << content;
    return folder_ / name;
  }

  ProcessResult compile(const std::vector<std::string>& more) const {
    std::vector<std::string> command{"/usr/bin/cc", "-std=c99", "-pedantic",
                                     "-Wall",       "-Wextra",  "-Wconversion",
                                     "-Werror",     "-I",       folder_.path()};
    command.insert(command.end(), more.begin(), more.end());
    return runProcess(command);
  }

  ProcessResult selfCheck(const std::string& source) const {
    const ProcessResult compiled =
        compile({"-DSELF_CHECK", write("motor.c", source), "-o", folder_ / "check"});
    EXPECT_EQ(compiled.status, 0) << compiled.errors;
    return runProcess({folder_ / "check"});
  }

  const TemporaryFolder folder_;
};

TEST_F(CSource, ChecksItself) {
  for (const Result& result : test::resultsToExport()) {
    const ProcessResult run = selfCheck(cSource(exportedAs("motor", result)));
    EXPECT_EQ(run.status, 0) << run.output;
    EXPECT_TRUE(mentions(run.output, "simulator: differs by ")) << run.output;
    EXPECT_TRUE(mentions(run.output, "whitening: differs by ")) << run.output;
  }
}

TEST_F(CSource, AWrongCoefficientIsFound) {
  const std::string good = cSource(exportedAs("motor", test::delayedResult()));
  for (const char* name :
       {"motor_plant_num[] = ", "motor_plant_den[] = {1.0, ", "motor_noise_num[] = {1.0, ",
        "motor_noise_den[] = {1.0, ", "motor_OFFSET_U (", "motor_OFFSET_Y ("})
    EXPECT_EQ(selfCheck(test::tampered(good, name)).status, 1) << name;
}

/// A program of the user, which compares nothing with itself: the first outputs by hand, for a
/// plant with a dead time of four samples.
TEST_F(CSource, IsIncludedByAProgram) {
  write("motor.c", cSource(exportedAs("motor", test::delayedResult())));
  write("user.c", R"(#include "motor.c"
#include "motor.c"
#include <stdio.h>
int main(void) {
  motor_simulator simulator = {{0}}, other = {{0}};
  motor_whitening whitening = {{0}};
  int t;
  for (t = 0; t < 7; ++t) {
    const double y = motor_simulate(&simulator, 0.25 + (t == 0 ? 1.0 : 0.0));
    printf("%.12g %.12g\n", y, motor_whiten(&whitening, t == 0 ? 1.0 : 0.0));
  }
  printf("%.12g\n", motor_simulate(&other, 0.25));
  printf("%g %g\n", motor_SAMPLE_TIME, motor_NOISE_VARIANCE);
  return 0;
}
)");
  const ProcessResult compiled = compile({folder_ / "user.c", "-o", folder_ / "user"});
  ASSERT_EQ(compiled.status, 0) << compiled.errors;
  // B/A = 0.5 + 0.9 q^-1 + 0.83 q^-2 + ..., D/C = 1 - q^-1 + 0.5 q^-2 - 0.15 q^-3 + ...
  EXPECT_EQ(
      runProcess({folder_ / "user"}).output,
      "3.5 1\n3.5 -1\n3.5 0.5\n3.5 -0.15\n4 0.045\n4.4 -0.0135\n4.33 0.00405\n3.5\n0.1 0.1\n");
}

TEST_F(CSource, NeitherAllocatesNorCallsAnything) {
  write("motor.c", cSource(exportedAs("motor", test::delayedResult())));
  write("user.c", R"(#include "motor.c"
double step(motor_simulator* s, motor_whitening* w, double u, double y);
double step(motor_simulator* s, motor_whitening* w, double u, double y) {
  return motor_whiten(w, y - motor_simulate(s, u));
}
)");
  const ProcessResult compiled =
      compile({"-c", "-fno-stack-protector", folder_ / "user.c", "-o", folder_ / "user.o"});
  ASSERT_EQ(compiled.status, 0) << compiled.errors;
  const ProcessResult symbols = runProcess({"/usr/bin/nm", "-u", folder_ / "user.o"});
  EXPECT_EQ(symbols.status, 0) << symbols.errors;
  EXPECT_FALSE(mentions(symbols.output, " U ")) << symbols.output;
}

TEST_F(CSource, TextOfTheResultCannotEndTheComment) {
  Result result = test::delayedResult();
  result.physical.sentence = "*/ int main(void) { return 0; } /* @ \\\n";
  result.estimate.version = "1\n#error";
  EXPECT_EQ(selfCheck(cSource(exportedAs("motor", result))).status, 0);
}

}  // namespace
}  // namespace uncertainty_identification
