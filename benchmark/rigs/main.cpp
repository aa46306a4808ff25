// Explains simulated machines with the default configuration, and counts how often the right cause
// is named.
#include <algorithm>
#include <boost/program_options.hpp>
#include <cstdio>
#include <iostream>
#include <string>
#include <vector>

#include "rigs/rigs.h"
#include "uncertainty_identification/explanation/explanation.h"

namespace uncertainty_identification::rigs {
namespace {

constexpr int kFitted = 20, kHeld = 8, kSamples = 400;

std::string placeOf(const PlaceAndShape& what) { return what.place + "/" + what.shape; }

/// "place/shape" in the list, or "place" alone where any shape is right.
bool isRight(const std::string& named, const std::vector<std::string>& right) {
  return std::any_of(right.begin(), right.end(), [&](const std::string& each) {
    return each == named || each == named.substr(0, named.find('/'));
  });
}

struct Answer {
  double right = 0;  ///< share of the rig's causes; a told tie counts half
  int wrong = 0;     ///< names that are no cause of the rig, nor tied with one
  std::string text;
  double fit_before = 0, fit_after = 0, seconds = 0;
};

/// The share of a right cause that the named one earns, and which it is.
double match(const SimulationCause& named, const Rig& rig, std::vector<bool>* found) {
  for (const double share : {1.0, 0.5}) {
    for (std::size_t k = 0; k < rig.causes.size(); ++k) {
      if ((*found)[k]) continue;
      const auto is_right = [&](const PlaceAndShape& what) {
        return isRight(placeOf(what), rig.causes[k]);
      };
      const bool hit = share == 1 ? is_right(named.what)
                                  : std::any_of(named.ties.begin(), named.ties.end(), is_right);
      if (!hit) continue;
      (*found)[k] = true;
      return share;
    }
  }
  return 0;
}

Answer answerTo(const Rig& rig, std::uint64_t seed) {
  const std::vector<Experiment> all = record(rig, kFitted + kHeld, kSamples, seed);
  const std::vector<Experiment> fitted(all.begin(), all.begin() + kFitted),
      held(all.begin() + kFitted, all.end());
  const Explanation explanation = explain({}, fitted, held);
  Answer answer;
  answer.fit_before = explanation.simulation.fit_before;
  answer.fit_after = explanation.simulation.fit_after;
  answer.seconds = explanation.seconds;
  std::vector<bool> found(rig.causes.size());
  for (const Cause& cause : explanation.causes) {
    answer.text += (answer.text.empty() ? "" : ", ") + cause.name;
    const double earned = cause.simulation ? match(*cause.simulation, rig, &found) : 0;
    const bool is_structural = cause.name.rfind("noise_", 0) != 0 &&
                               cause.name.rfind("exp_", 0) != 0 &&
                               cause.name != "plant_parameter_spread";  // which the rigs have
    if (cause.simulation) answer.text += " (" + placeOf(cause.simulation->what) + ")";
    answer.wrong += earned == 0 && is_structural;
    answer.right += earned / static_cast<double>(rig.causes.size());
  }
  return answer;
}

int run(int first_seed, int seeds, const std::string& only) {
  double right = 0, rigs = 0, clean = 0, silent = 0;
  std::vector<double> seconds;
  for (const Rig& rig : allRigs()) {
    if (rig.name.find(only) == std::string::npos) continue;
    for (int k = 0; k < seeds; ++k) {
      const Answer answer = answerTo(rig, static_cast<std::uint64_t>(first_seed + k));
      const bool is_clean = rig.causes.empty();
      (is_clean ? clean : rigs) += 1;
      (is_clean ? silent : right) += is_clean ? answer.wrong == 0 : answer.right;
      seconds.push_back(answer.seconds);
      const char* word = is_clean              ? (answer.wrong == 0 ? "right" : "FALSE")
                         : answer.right > 0.99 ? "right"
                         : answer.right > 0    ? "half"
                                               : "WRONG";
      std::printf("%-5s %-36s seed %d: fit %5.1f -> %5.1f %%, %4.1f s: %s\n", word,
                  rig.name.c_str(), first_seed + k, answer.fit_before, answer.fit_after,
                  answer.seconds, answer.text.empty() ? "nothing" : answer.text.c_str());
      std::fflush(stdout);
    }
  }
  if (seconds.empty()) return 2;
  std::sort(seconds.begin(), seconds.end());
  std::printf(
      "right %.1f of %.0f (%.0f %%); nothing structural named in %.0f of %.0f without a cause; "
      "median %.1f s, worst %.1f s\n",
      right, rigs, 100 * right / std::max(rigs, 1.0), silent, clean, seconds[seconds.size() / 2],
      seconds.back());
  return 0;
}

}  // namespace
}  // namespace uncertainty_identification::rigs

int main(int count, char** values) {
  namespace options = boost::program_options;
  options::options_description known("options");
  known.add_options()("help", "what this is")("first-seed", options::value<int>()->default_value(1),
                                              "of the first set of each rig")(
      "seeds", options::value<int>()->default_value(1), "sets of each rig")(
      "only", options::value<std::string>()->default_value(""), "rigs whose name contains this");
  options::variables_map given;
  options::store(options::parse_command_line(count, values, known), given);
  if (given.count("help")) {
    std::cout << "Explains simulated machines with the default configuration.\n" << known;
    return 0;
  }
  return uncertainty_identification::rigs::run(
      given["first-seed"].as<int>(), given["seeds"].as<int>(), given["only"].as<std::string>());
}
