#pragma once

#include "inspection/signal_choice.h"
#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/data/loaded_data.h"

namespace uncertainty_identification {

/// What inspecting data found.
struct InspectedData {
  Survey survey;
  std::vector<SignalMeasures> measures;  ///< of the channels of the survey, in their order
  SignalChoice choice;
  Configuration configuration;  ///< with which the data would be read
  LoadedData loaded;            ///< the experiments that it cuts, those that checks refuse included
  std::string failure;          ///< why nothing could be read with it; empty: it could
};

}  // namespace uncertainty_identification
