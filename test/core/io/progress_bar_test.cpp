#include "io/progress_bar.h"

#include <gtest/gtest.h>

#include <limits>
#include <sstream>

namespace uncertainty_identification {
namespace {

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

TEST(ProgressBar, ShowsPhaseShareAndLikelihoodAndClearsItself) {
  std::ostringstream out;
  {
    ProgressBar bar(out, true);
    bar.show({"optimising", 0.5, -3092.5331});
    EXPECT_EQ(out.str(),
              "\r\x1b[K[############            ] 50 % optimising, log-likelihood -3092.533");
    out.str("");
    bar.show({"choosing orders", kNotANumber, kNotANumber});
    EXPECT_EQ(out.str(), "\r\x1b[K[                        ] 0 % choosing orders");
    out.str("");
    bar.show({"done", 1.5, kNotANumber});
    EXPECT_EQ(out.str(), "\r\x1b[K[########################] 100 % done");
    out.str("");
  }
  EXPECT_EQ(out.str(), "\r\x1b[K");
}

TEST(ProgressBar, IsSilentWhereThereIsNoTerminal) {
  std::ostringstream out;
  { ProgressBar(out, false).show({"optimising", 0.5, -1}); }
  EXPECT_EQ(out.str(), "");
}

}  // namespace
}  // namespace uncertainty_identification
