#pragma once

#include <vector>

#include "uncertainty_identification/data/experiment.h"

namespace uncertainty_identification {

/// Samples that suffice for a choice between models: it needs less data than an estimate.
constexpr int kEnoughSamples = 15000;

/// `count` samples of an experiment from sample `first` on, without its per-sample covariates.
Experiment excerpt(const Experiment& whole, int first, int count);

/// About `enough` samples: the head of each experiment, or, of many short ones, some whole
/// experiments.
std::vector<Experiment> thinned(const std::vector<Experiment>& experiments, int enough);

}  // namespace uncertainty_identification
