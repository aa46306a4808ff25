#include "uncertainty_identification/ros/store_diagnostics.h"

namespace uncertainty_identification {

void diagnoseStore(const StoreStatus& store, diagnostic_updater::DiagnosticStatusWrapper& status) {
  constexpr int kMany = 100;
  using Level = diagnostic_msgs::DiagnosticStatus;
  status.summary(Level::OK, "experiments are stored");
  if (store.pending > kMany)
    status.mergeSummaryf(Level::WARN, "%d files wait for the disk, which is slow", store.pending);
  if (store.lost > 0)
    status.mergeSummaryf(Level::ERROR, "%d files were not stored: more waited than fit",
                         store.lost);
  if (store.failing) status.mergeSummary(Level::ERROR, store.message);
  status.add("stored", store.stored);
  status.add("last stored", store.last_id);
  status.add("pending", store.pending);
  status.add("lost", store.lost);
}

}  // namespace uncertainty_identification
