#pragma once

#include <vector>

#include "uncertainty_identification/data/experiment.h"

namespace uncertainty_identification {

/// Number of samples that is enough to choose between models; this needs less data than estimating
/// one.
constexpr int kEnoughSamples = 15000;

/// `count` samples of an experiment from sample `first` on, without its per-sample covariates.
Experiment excerpt(const Experiment& whole, int first, int count);

/// Samples of the longest of them.
int longestOf(const std::vector<Experiment>& experiments);

/// The experiments with the gaps of their outputs bridged (bridgedOutput()).
std::vector<Experiment> bridged(std::vector<Experiment> experiments);

/// About `enough` samples: the beginning of each experiment, or a subset of whole experiments if
/// there are many short ones.
std::vector<Experiment> fewerSamples(const std::vector<Experiment>& experiments, int enough);

}  // namespace uncertainty_identification
