#include "explanation/split.h"

#include <algorithm>
#include <numeric>
#include <random>
#include <set>

namespace uncertainty_identification {
namespace {

/// Positions of the held-out experiments. std::shuffle is not used because its order differs
/// between standard libraries.
std::set<std::size_t> drawn(const Configuration& configuration, std::size_t count) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::mt19937_64 random(configuration.estimation.seed);
  for (std::size_t k = count - 1; k > 0; --k) std::swap(order[k], order[random() % (k + 1)]);
  const double share = configuration.explanation.validation_share;
  const auto held =
      std::max<std::size_t>(1, static_cast<std::size_t>(share * static_cast<double>(count)));
  return {order.begin(), order.begin() + static_cast<std::ptrdiff_t>(held)};
}

}  // namespace

Split split(const Configuration& configuration, const std::vector<Experiment>& experiments,
            const std::vector<Experiment>& validation) {
  constexpr std::size_t kFewest = 4;
  if (!validation.empty()) return {experiments, validation, false};
  if (experiments.size() < kFewest) return {experiments, experiments, true};
  const std::set<std::size_t> held = drawn(configuration, experiments.size());
  Split parts;
  for (std::size_t k = 0; k < experiments.size(); ++k)
    (held.count(k) > 0 ? parts.held : parts.train).push_back(experiments[k]);
  return parts;
}

}  // namespace uncertainty_identification
