#pragma once

#include "curves/explain_simulation.h"
#include "explanation/search_progress.h"
#include "explanation/split.h"
#include "math/worker_pool.h"
#include "uncertainty_identification/configuration.h"

namespace uncertainty_identification {

/// What the free simulation of the data lacks, without curves that are in doubt. It takes up to a
/// third of explanation.time_limit; where it needs more, `progress` is out of time.
SimulationCauses searchSimulation(const Configuration& configuration, const Split& data,
                                  SearchProgress* progress, WorkerPool* pool);

}  // namespace uncertainty_identification
