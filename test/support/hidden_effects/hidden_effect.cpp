#include "support/hidden_effects/hidden_effect.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "support/hidden_effects/draw.h"
#include "support/hidden_effects/effect_size.h"
#include "support/hidden_effects/effect_strength.h"
#include "uncertainty_identification/require.h"
#include "uncertainty_identification/simulation/simulate.h"

namespace uncertainty_identification::test {
namespace {

constexpr int kAttempts = 2000;      // systems drawn before giving up
constexpr double kTolerance = 0.02;  // of the strength, relative

const std::vector<std::string> kStaticInInput = {"act_saturation",   "act_deadzone",
                                                 "act_backlash",     "act_hammerstein",
                                                 "act_quantisation", "noise_hetero"};

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// What the strength of an effect shall be.
double wantedStrength(const std::string& name, double strength, std::mt19937_64& random) {
  return name == "exp_feedback" ? uniform(0.06, 0.1, random) : strength;
}

/// The size at which the strength is met, by bisection; none where even the largest is too weak or
/// a jump skips it.
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

/// Hides all names in the base, each with a size that alone has the strength; false where one has
/// none.
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

/// Whether a system can show what is hidden in it at all.
bool canShow(const std::vector<std::string>& names, const Truth& truth) {
  return truth.input.kind != InputKind::prbs ||
         std::none_of(names.begin(), names.end(),
                      [](const std::string& name) { return contains(kStaticInInput, name); });
}

/// Whether all effects together leave finite outputs.
bool staysFinite(const Truth& truth, std::uint64_t seed) {
  try {
    simulate(truth, seed);
    return true;
  } catch (const ConfigurationError&) {
    return false;
  }
}

bool isHeldOut(int r, const HiddenEffectOptions& options) {
  const int all = options.base.experiments + options.held_out;
  const auto before = [&](int count) { return count * options.held_out / all; };
  return before(r + 1) > before(r);
}

}  // namespace

const std::vector<std::string>& catalogueEffects() {
  static const std::vector<std::string> kNames = {
      "act_delay",     "act_saturation",   "act_deadzone",    "act_backlash",
      "act_ratelimit", "act_quantisation", "act_offset",      "act_hammerstein",
      "act_loss",      "plant_pole",       "plant_resonance", "plant_cubic",
      "plant_coulomb", "plant_drift",      "plant_aging",     "plant_temp",
      "plant_init",    "sens_bias",        "sens_drift",      "sens_clip",
      "sens_quant",    "sens_outliers",    "sens_dropout",    "sens_hum",
      "sens_wiener",   "sens_lag",         "noise_colour",    "noise_tails",
      "noise_hetero",  "noise_step",       "exp_feedback",    "exp_mode",
      "exp_input2",    "exp_clock",        "exp_jitter",      "plant_parameter_spread"};
  return kNames;
}

const std::vector<std::string>& unnamedEffects() {
  static const std::vector<std::string> kNames = {"unk_telegraph",     "unk_bilinear",
                                                  "unk_gravity",       "unk_outflow",
                                                  "unk_rectification", "unk_burst"};
  return kNames;
}

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
  constexpr std::uint64_t kOther = 0x9E3779B97F4A7C15;  // a seed that no other data set has
  std::vector<Experiment> fresh = simulate(truth, hidden.seed ^ kOther);
  for (int r = 0; r < count; ++r) {
    const double share = count > 1 ? static_cast<double>(r) / (count - 1) : 0.5;
    fresh[static_cast<std::size_t>(r)].start_time = first + share * (last - first);
    fresh[static_cast<std::size_t>(r)].id = "fresh_" + std::to_string(r);
  }
  return fresh;
}

}  // namespace uncertainty_identification::test
