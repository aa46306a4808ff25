#pragma once

#include <vector>

#include "curves/curve_search.h"
#include "curves/preparation.h"

namespace uncertainty_identification::test {

/// The search for curves in whole records: fitted to the first `fitted`, with the others held out.
inline CurveSearchResult searchedIn(const std::vector<Experiment>& all, int fitted) {
  WorkerPool pool(1);
  CurveSearchContext context;
  context.pool = &pool;
  context.going_on = [] { return true; };
  const WindowPlan plan = planWindows(all);
  const SignalScales scales = scalesOf(all);
  const auto first_held = all.begin() + fitted;
  return searchCurves(windowsOf({all.begin(), first_held}, plan, scales, 0),
                      windowsOf({first_held, all.end()}, plan, scales, 0), {}, context);
}

}  // namespace uncertainty_identification::test
