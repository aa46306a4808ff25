#pragma once

#include <optional>
#include <string>
#include <vector>

#include "curves/rest_before.h"
#include "curves/simulation_data.h"
#include "uncertainty_identification/data/experiment.h"

namespace uncertainty_identification {

constexpr int kFewestWindows = 4;  ///< fewer do not tell causes apart

/// How records become windows. One setting for all data.
struct WindowPlan {
  int thinning = 1;            ///< each so manieth sample is kept, the input averaged in between
  int length = 0;              ///< [samples after thinning] of a window, about
  bool one_of_each = false;    ///< every experiment is one window
  bool own_levels = false;     ///< the output of each window is counted from a level of its own
  RestBefore rest_before{{}};  ///< that is simulated before the records that began at rest
};

/// Thins by the output's bandwidth: 24 samples a period of the frequency below which 99.5 % of the
/// power of the detrended output lies, but at least 2,500 samples in all. Cuts long records into at
/// least 10 windows of 60 to 400 samples.
WindowPlan planWindows(const std::vector<Experiment>& experiments);

/// The plan with windows half as long again or, where records make too few of them, shorter by a
/// third.
WindowPlan withOtherWindows(const WindowPlan& plan, const std::vector<Experiment>& experiments);

/// The plan with windows up to twice as long, as far as these are not too few; none where they are
/// hardly longer. In windows much shorter than a plant's time constants, their initial states stand
/// for what a curve would do.
std::optional<WindowPlan> withLongWindows(const WindowPlan& plan,
                                          const std::vector<Experiment>& experiments);

/// Scales of the signals of `experiments`. Covariates are those that move in some experiment and
/// are known in all, those of `held` as well: a second heater may be off for a whole record. Each
/// covariate is also given behind the lags of covariateScales(), which are multiples of `lag_unit`
/// [s]; with 0 there are no lags.
SignalScales scalesOf(const std::vector<Experiment>& experiments,
                      const std::vector<Experiment>& held = {}, double lag_unit = 0);

/// The windows of `experiments`; those that begin a record of a system that was at rest begin with
/// this rest, in which its initial state settles; at most `most` samples in all, 0: no limit.
SimulationData windowsOf(const std::vector<Experiment>& experiments, const WindowPlan& plan,
                         const SignalScales& scales, int most);

}  // namespace uncertainty_identification
