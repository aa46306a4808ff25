#include "support/hidden_effects/hidden_effect.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "configuration/require.h"
#include "simulation/simulate.h"
#include "support/hidden_effects/draw.h"
#include "support/hidden_effects/effect_size.h"
#include "support/hidden_effects/effect_strength.h"

namespace uncertainty_identification::test {
namespace {

constexpr int kAttempts = 2000;      // number of systems that are drawn before giving up
constexpr double kTolerance = 0.02;  // relative tolerance of the strength

const std::vector<std::string> kStaticInInput = {"act_saturation",   "act_deadzone",
                                                 "act_backlash",     "act_hammerstein",
                                                 "act_quantisation", "noise_hetero"};

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// The strength that an effect is to have.
double wantedStrength(const std::string& name, double strength, std::mt19937_64& random) {
  return name == "exp_feedback" ? uniform(0.06, 0.1, random) : strength;
}

/// Finds the size that gives the wanted strength, by bisection. There is none when even the largest
/// size is too weak or when the strength jumps over the wanted value.
std::optional<double> sizeOf(const SetSize& set, const Truth& base, double wanted,
                             const EffectStrength& strength) {
  const auto at = [&](double size) {
    Truth truth = base;
    set(size, &truth);
    return strength(truth);
  };
  double low = 0, high = 1;
  if (at(high) < wanted) return {};
  for (int step = 0; step < 40; ++step) {
    const double middle = (low + high) / 2, reached = at(middle);
    if (std::abs(reached - wanted) <= kTolerance * wanted) return middle;
    (reached < wanted ? low : high) = middle;
  }
  return {};
}

/// Gives the system all effects of hidden->names, each with the size that has the wanted strength
/// on its own. Returns false when an effect cannot reach it.
bool hideAll(const HiddenEffectOptions& options, std::mt19937_64& random, HiddenEffect* hidden) {
  const Truth base = hidden->truth;
  const SignalScale scale = signalScale(base, hidden->seed);
  for (const std::string& name : hidden->names) {
    Truth alone = base;
    const double wanted = wantedStrength(name, options.strength, random);
    const SetSize set = drawEffect(name, scale, random, &alone);
    hidden->truth.plant = alone.plant;
    const EffectStrength strength(name, alone, hidden->seed);
    const std::optional<double> size = sizeOf(set, alone, wanted, strength);
    if (!size) return false;
    set(*size, &hidden->truth);
    set(*size, &alone);
    hidden->strengths.push_back(strength(alone));
  }
  return true;
}

/// Whether the input of the system is one in which the effects do more than change the gain.
bool canShow(const std::vector<std::string>& names, const Truth& truth) {
  return truth.input.kind != InputKind::prbs ||
         std::none_of(names.begin(), names.end(),
                      [](const std::string& name) { return contains(kStaticInInput, name); });
}

/// Whether the outputs stay finite with all effects together.
bool staysFinite(const Truth& truth, std::uint64_t seed) {
  try {
    simulate(truth, seed);
    return true;
  } catch (const ConfigurationError&) {
    return false;
  }
}

/// Whether experiment r is one of those that are held out, which are spread evenly.
bool isHeldOut(int r, const HiddenEffectOptions& options) {
  const int all = options.base.experiments + options.held_out;
  const auto before = [&](int count) { return count * options.held_out / all; };
  return before(r + 1) > before(r);
}

/// Names of all effects that a truth can have, in the catalogue or in none.
std::vector<std::string> namesOf(bool unnamed) {
  std::vector<std::string> names;
  EffectsTruth().forEach([&](const std::string& name, const auto&) {
    if ((name.rfind("unk_", 0) == 0) == unnamed) names.push_back(name);
  });
  return names;
}

}  // namespace

std::vector<std::string> catalogueEffects() { return namesOf(false); }

std::vector<std::string> unnamedEffects() { return namesOf(true); }

void HiddenEffectOptions::validate() const {
  base.validate();
  require(strength > 0 && std::isfinite(strength), "strength", strength, "a finite number above 0");
  requireRange("held_out", held_out, 0, 1000000);
}

HiddenEffect randomHiddenEffect(const std::vector<std::string>& names,
                                const HiddenEffectOptions& options, std::uint64_t seed) {
  options.validate();
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    std::mt19937_64 random = randomStream(seed, attempt, RandomPurpose::truth);
    HiddenEffect hidden;
    hidden.names = names;
    hidden.seed = random();
    hidden.redraws = attempt;
    RandomTruthOptions base = options.base;
    base.experiments += options.held_out;
    hidden.truth = randomTruth(base, random);
    if (!canShow(names, hidden.truth) || !hideAll(options, random, &hidden)) continue;
    if (!staysFinite(hidden.truth, hidden.seed)) continue;
    hidden.declared = declaredSimulation(hidden.truth);
    return hidden;
  }
  throw ConfigurationError("strength: found " + std::to_string(options.strength) +
                           ", which no drawn system reaches; allowed: a smaller one");
}

HiddenEffectData simulateHidden(const HiddenEffect& hidden, const HiddenEffectOptions& options) {
  HiddenEffectData data;
  std::vector<Experiment> all = simulate(hidden.truth, hidden.seed);
  for (int r = 0; r < hidden.truth.experiments; ++r) {
    auto& part = isHeldOut(r, options) ? data.held_out : data.training;
    part.push_back(std::move(all[static_cast<std::size_t>(r)]));
  }
  return data;
}

std::vector<Experiment> simulateFresh(const HiddenEffect& hidden, int count) {
  Truth truth = hidden.truth;
  const double first = simulateExperiment(truth, hidden.seed, 0).start_time;
  const double last = simulateExperiment(truth, hidden.seed, truth.experiments - 1).start_time;
  truth.experiments = count;
  constexpr std::uint64_t kOther = 0x9E3779B97F4A7C15;  // makes a seed that no other data set uses
  std::vector<Experiment> fresh = simulate(truth, hidden.seed ^ kOther);
  for (int r = 0; r < count; ++r) {
    const double share = count > 1 ? static_cast<double>(r) / (count - 1) : 0.5;
    fresh[static_cast<std::size_t>(r)].start_time = first + share * (last - first);
    fresh[static_cast<std::size_t>(r)].id = "fresh_" + std::to_string(r);
  }
  return fresh;
}

}  // namespace uncertainty_identification::test
