#pragma once

#include <diagnostic_updater/diagnostic_updater.h>

#include "uncertainty_identification/ros/store_writer.h"

namespace uncertainty_identification {

/// How the store is doing. ERROR: the disk refuses, or something was given up; WARN: more than a
/// hundred files wait for a disk that is slow.
void diagnoseStore(const StoreStatus& store, diagnostic_updater::DiagnosticStatusWrapper& status);

}  // namespace uncertainty_identification
