#pragma once

#include <Eigen/Core>
#include <vector>

#include "inspection/survey.h"

namespace uncertainty_identification {

/// A record of both signals on one grid.
struct CommonRecord {
  Eigen::VectorXd u, y;
};

/// The median period of a channel's records [s]; 0 without two readings in one of them.
double ownPeriod(const Channel& channel);

/// Ten samples a period of the output's bandwidth [Hz], 0: unknown; not shorter than the output's
/// own period, and so short that ten times `lags` samples of the longest record are left [s].
double periodFor(const Channel& output, double output_band, int lags);

/// Both signals, held, every `period` seconds for as long as both were recorded. Without the
/// records of at most 2 `order` samples, and without what is beyond 40,000 samples.
std::vector<CommonRecord> commonRecords(const Channel& input, const Channel& output, double period,
                                        int order);

}  // namespace uncertainty_identification
