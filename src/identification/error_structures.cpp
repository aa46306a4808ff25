#include "identification/error_structures.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

#include "math/polynomial.h"
#include "model/continuous_poles.h"
#include "uncertainty_identification/enum_names.h"

namespace uncertainty_identification {
namespace {

constexpr std::size_t kMostVaried = 4;  // parameters that vary together
constexpr const char* kDeadTime = "dead_time";
constexpr const char* kVaryingDeadTime = "parameter_spread of dead_time";

using Names = std::vector<std::string>;

ErrorModelOptions withBasis(ErrorModelOptions options, BasisKind basis, Constraint constraint,
                            int taps) {
  options.basis = basis;
  options.constraint = constraint;
  options.taps = taps;
  return options;
}

std::string joined(const Names& names) {
  std::string text;
  for (std::size_t k = 0; k < names.size(); ++k)
    text += (k == 0 ? "" : k + 1 == names.size() ? " and " : ", ") + names[k];
  return text;
}

/// Whether a numerator is longer than zero-order hold with a whole delay explains.
bool hasFractionOfDelay(const Polynomials& plant) { return plant.b.size() > plant.a.size(); }

/// The continuous structure with the poles of a sampled plant, with its whole delay or with a dead
/// time. None where the sampled plant is faster than the hold, has poles without a continuous
/// counterpart, or too many parameters.
std::optional<NominalModelOptions> continuousStructure(NominalModelOptions options,
                                                       const Polynomials& plant, bool dead_time,
                                                       double sample_time) {
  constexpr int kFurther = 3;  // [samples] by which single plants may be later
  if (plant.delay < 1 || plant.a.size() < 1 || plant.a.size() > 3) return {};
  for (const std::complex<double>& root : listOfRoots(plant.a)) {
    const bool positive = std::abs(root.imag()) > 1e-9 || root.real() > 0.02;
    if (!positive || std::abs(root) > 0.9999) return {};
  }
  const ContinuousPoles poles = continuousPoles(plant.a, sample_time);
  options.structure = Structure::continuous;
  options.time_constants = static_cast<int>(poles.time_constants.size());
  options.resonances = static_cast<int>(poles.pairs.size());
  options.zeros = options.time_constants + 2 * options.resonances - 1;
  const auto longer = static_cast<int>(plant.b.size() - plant.a.size());
  options.dead_time = dead_time;
  options.delay = dead_time ? 1 : plant.delay;
  if (dead_time) options.max_delay = plant.delay - 1 + std::max(longer, 0) + kFurther;
  options.fixed.clear();
  return options;
}

/// Parameters of the continuous structure whose relative variation is meaningful: a zero near the
/// origin has none.
Names physicalParameters(const NominalModelOptions& options) {
  Names names{"gain"};
  for (int k = 1; k <= options.time_constants; ++k) names.push_back("tau" + std::to_string(k));
  for (int k = 1; k <= options.resonances; ++k) {
    names.push_back("omega" + std::to_string(k));
    names.push_back("zeta" + std::to_string(k));
  }
  if (options.dead_time) names.push_back("dead_time");
  return names;
}

/// Parameters of the configured nominal model that Go alone depends on, by their names.
Names ownParameters(const Problem& problem) {
  const NominalModelOptions& options = problem.configuration.nominal_model;
  const bool shared = options.structure == Structure::arx || options.structure == Structure::armax;
  if (problem.nominal_model || shared) return {};  // a user's model, or A is a part of H
  Names names;
  for (const std::string& name : nominalModelOf(problem)->names()) {
    const bool of_noise = name[0] == 'c' || (name[0] == 'd' && name != "dead_time");
    if (!of_noise && name.rfind("zero", 0) != 0) names.push_back(name);
  }
  return names;
}

/// Each parameter alone, each with the first one, all together, and all but a dead time.
std::vector<Names> combinations(const Names& names) {
  std::vector<Names> all;
  if (names.size() > 2 * kMostVaried) return all;
  for (const std::string& name : names) all.push_back({name});
  for (std::size_t k = 1; k < names.size(); ++k) all.push_back({names[0], names[k]});
  const bool delayed = names.size() > 3 && names.back() == "dead_time";
  if (delayed && names.size() - 1 <= kMostVaried) all.emplace_back(names.begin(), names.end() - 1);
  if (names.size() > 2 && names.size() <= kMostVaried) all.push_back(names);
  return all;
}

/// Whether experiments are more than the covariance of several parameters has elements.
bool showCovariance(int experiments, std::size_t parameters) {
  const auto elements = static_cast<int>(parameters * (parameters + 1) / 2);
  return parameters > 1 && parameters <= kMostVaried && experiments > elements;
}

bool isOfNumerator(const std::string& name) { return name[0] == 'b'; }

Names numeratorOf(const Names& names) {
  Names own;
  std::copy_if(names.begin(), names.end(), std::back_inserter(own), isOfNumerator);
  return own;
}

/// Filters in series with Go: with as many taps as the options state or, where these are automatic,
/// with each number up to `max_taps` for which there are two experiments for each tap.
void addFilters(const Configuration& configuration, BasisKind basis, Constraint constraint,
                int experiments, std::vector<ErrorStructure>* structures) {
  const ErrorModelOptions& options = configuration.error_model;
  const bool given = options.basis != BasisKind::automatic && options.taps != kAutomatic;
  const int fewest = constraint == Constraint::zero_static_gain ? 2 : 1;
  const int first = given ? options.taps : fewest;
  const int most = std::max(std::min(options.max_taps, experiments / 2), fewest);
  const int last = given ? options.taps : most;
  for (int taps = first; taps <= last; ++taps) {
    structures->push_back({nameOf(basis) + ", " + std::to_string(taps) +
                               (taps == 1 ? " tap, " : " taps, ") + nameOf(constraint),
                           configuration});
    structures->back().configuration.error_model = withBasis(options, basis, constraint, taps);
  }
}

bool isOfDeadTimeAlone(const Names& names) { return names == Names{kDeadTime}; }

/// Physical parameters that vary. A dead time is a parameter where it is a fraction of a sample, or
/// where one that varies is better than none: near a whole number of samples it has no derivative.
std::vector<ErrorStructure> physicalStructures(const Problem& problem, const Polynomials& plant) {
  std::vector<ErrorStructure> structures;
  const bool fraction = hasFractionOfDelay(plant);
  for (const bool dead_time : {false, true}) {
    if (dead_time ? plant.delay == 1 && !fraction : fraction) continue;
    Configuration varied = problem.configuration;
    const auto physical =
        continuousStructure(varied.nominal_model, plant, dead_time, problem.data.sampleTime());
    if (!physical) continue;
    varied.nominal_model = *physical;
    std::vector<Names> all = combinations(physicalParameters(*physical));
    if (dead_time) {  // first, as the others depend on it
      std::stable_partition(all.begin(), all.end(), isOfDeadTimeAlone);
    }
    for (const Names& some : all) {
      const bool alone = isOfDeadTimeAlone(some);
      const bool of_dead_time = some.back() == kDeadTime;
      structures.push_back(spreadOf(some, varied));
      ErrorStructure& last = structures.back();
      if (dead_time && !fraction && !of_dead_time) last.description += ", with a dead time";
      if (dead_time && !alone && (!fraction || of_dead_time)) last.if_better = kVaryingDeadTime;
    }
  }
  return structures;
}

}  // namespace

ErrorStructure spreadOf(const std::vector<std::string>& parameters, Configuration configuration) {
  ErrorModelOptions& options = configuration.error_model;
  options = withBasis(options, BasisKind::parameter_spread, Constraint::zero_mean,
                      static_cast<int>(parameters.size()));
  options.parameters = parameters;
  return {"parameter_spread of " + joined(parameters), std::move(configuration)};
}

std::vector<ErrorStructure> variedStructures(const Problem& problem, const Polynomials* plant) {
  constexpr int kFewest = 3;  // experiments that show how parameters vary
  std::vector<ErrorStructure> structures;
  if (problem.data.count() < kFewest) return structures;
  if (plant != nullptr) structures = physicalStructures(problem, *plant);
  const Names own = ownParameters(problem);
  std::vector<Names> all;
  if (structures.empty()) all = combinations(own);
  const Names numerator = numeratorOf(own);
  const bool is_new = std::find(all.begin(), all.end(), numerator) == all.end();
  if (is_new && showCovariance(problem.data.count(), numerator.size())) all.push_back(numerator);
  for (const Names& some : all) structures.push_back(spreadOf(some, problem.configuration));
  return structures;
}

bool isSpreadOfNumerator(const ErrorModelOptions& options) {
  const Names& varied = options.parameters;
  return options.basis == BasisKind::parameter_spread && varied.size() > 1 &&
         std::all_of(varied.begin(), varied.end(), isOfNumerator);
}

std::vector<ErrorStructure> errorStructures(const Problem& problem, const Polynomials* plant) {
  const Configuration& configuration = problem.configuration;
  const ErrorModelOptions& options = configuration.error_model;
  const int experiments = problem.data.count();
  std::vector<ErrorStructure> structures;
  if (options.basis != BasisKind::automatic) {
    addFilters(configuration, options.basis, options.constraint, experiments, &structures);
    return structures;
  }
  addFilters(configuration, BasisKind::fir, Constraint::zero_mean, experiments, &structures);
  addFilters(configuration, BasisKind::fir, Constraint::zero_static_gain, experiments, &structures);
  structures.push_back({"none", configuration});
  structures.back().configuration.error_model =
      withBasis(options, BasisKind::fir, Constraint::free, 0);
  structures.back().configuration.error_model.components = 1;
  if (problem.plant) return structures;
  const std::vector<ErrorStructure> varied = variedStructures(problem, plant);
  structures.insert(structures.end(), varied.begin(), varied.end());
  return structures;
}

}  // namespace uncertainty_identification
