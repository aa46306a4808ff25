#include "uncertainty_identification/ros/store_diagnostics.h"

#include <gtest/gtest.h>

namespace uncertainty_identification {
namespace {

using Level = diagnostic_msgs::DiagnosticStatus;

diagnostic_updater::DiagnosticStatusWrapper diagnosisOf(const StoreStatus& store) {
  diagnostic_updater::DiagnosticStatusWrapper status;
  diagnoseStore(store, status);
  return status;
}

TEST(DiagnoseStore, OkWhereAllIsWritten) {
  StoreStatus store;
  store.stored = 7;
  store.pending = 3;
  EXPECT_EQ(diagnosisOf(store).level, Level::OK);
  EXPECT_EQ(diagnosisOf(store).values.front().value, "7");
}

TEST(DiagnoseStore, ASlowDiskIsAWarning) {
  StoreStatus store;
  store.pending = 101;
  EXPECT_EQ(diagnosisOf(store).level, Level::WARN);
}

TEST(DiagnoseStore, ADiskThatRefusesIsAnErrorAndSoIsWhatIsLost) {
  StoreStatus store;
  store.failing = true;
  store.message = "no space left";
  EXPECT_EQ(diagnosisOf(store).level, Level::ERROR);
  EXPECT_NE(diagnosisOf(store).message.find("no space left"), std::string::npos);
  store.failing = false;
  store.lost = 1;
  EXPECT_EQ(diagnosisOf(store).level, Level::ERROR);
}

}  // namespace
}  // namespace uncertainty_identification
