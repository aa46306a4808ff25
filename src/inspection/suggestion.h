#pragma once

#include <string>

#include "inspection/signal_choice.h"
#include "uncertainty_identification/configuration.h"

namespace uncertainty_identification {

/// `base` with the chosen signals, the time of the files and, for bags, a way to cut them into
/// experiments: a topic of markers, whole experiments as messages, or else windows of a tenth of
/// the record. Files of columns keep experiment.mode of `base`.
Configuration suggestedConfiguration(const Survey& survey, const SignalChoice& choice,
                                     const Configuration& base);

/// Why the data of a survey are cut so, as a sentence.
std::string cutReason(const Survey& survey, const Configuration& configuration);

/// A type of messages that are whole experiments, or that mark them.
bool isExperimentType(const std::string& type);
bool isMarkerType(const std::string& type);

}  // namespace uncertainty_identification
