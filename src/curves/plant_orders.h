#pragma once

#include <optional>
#include <vector>

#include "curves/search_context.h"
#include "curves/window_fit.h"

namespace uncertainty_identification {

/// A linear model of another size than the present one, fitted with the same curves.
struct PlantChange {
  enum class Kind { order, direct, delay };
  Kind kind = Kind::order;
  WindowFit fit;
};

/// Linear models of all orders, without curves.
struct LinearPlants {
  /// Those that the search begins with: the smallest that leaving windows out cannot tell from a
  /// larger one, and that with one order more. To be chosen, a higher order must lower the root
  /// mean square of what is left out by 30 %: curves are sought on top of it, and higher orders
  /// compete with them.
  std::vector<WindowFit> starts;
  std::vector<WindowFit> of_order;  ///< the best of orders 1, 2, ...
  std::vector<WindowFit> delayed;   ///< of orders 1, 2, ..., all without a direct term
};

LinearPlants fitLinearPlants(const SimulationData& data, int max_order,
                             const CurveSearchContext& context);

/// A plant of up to 8 orders whose modes halve the squared error that the first of the starts
/// leaves, of held-out windows as well; absent where there is none.
std::optional<WindowFit> modalPlant(const SimulationData& data, const SimulationData& held,
                                    const LinearPlants& linear, const CurveSearchContext& context);

/// The model with one order more, with a direct term, and with more dead time. On top of a model
/// without curves also the linear ones of one and two orders more, since a chain of lags looks like
/// dead time.
std::vector<PlantChange> largerPlants(const SimulationData& data, const WindowFit& fit,
                                      const LinearPlants& linear, int max_order,
                                      const CurveSearchContext& context);

/// The model with fewer orders, as long as leaving windows out loses less than 3 %.
WindowFit smallerPlant(const SimulationData& data, WindowFit fit,
                       const CurveSearchContext& context);

}  // namespace uncertainty_identification
