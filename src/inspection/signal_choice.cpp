#include "inspection/signal_choice.h"

#include <algorithm>

#include "data/text.h"
#include "inspection/signal_names.h"

namespace uncertainty_identification {
namespace {

constexpr std::size_t kMostInputs = 6, kMostOutputs = 8;  // that are compared with each other
constexpr std::size_t kMostOthers = 4;
constexpr long kFewestSamples = 20;

/// Weights of what speaks for a pair, beside the strengths of the names (0 to 3 each).
constexpr double kFollows = 2, kSameComponent = 2, kLikeCommand = 0.5, kContrary = 2, kUnlikely = 1;

/// The last two parts of a field: "linear.x" of "twist.twist.linear.x".
std::string componentOf(const Channel& channel) {
  const auto last = channel.field.rfind('.');
  if (last == std::string::npos || last == 0) return channel.field;
  return channel.field.substr(channel.field.rfind('.', last - 1) + 1);  // npos + 1 = 0
}

/// Fields that hardly ever are what a plant is identified from.
bool isUnlikely(const Channel& channel) {
  return channel.name.find("orientation") != std::string::npos ||
         channel.name.find("covariance") != std::string::npos;
}

/// Whether a record holds both.
bool shareRecords(const Channel& left, const Channel& right) {
  for (std::size_t r = 0; r < std::min(left.records.size(), right.records.size()); ++r)
    if (!left.records[r].stamps.empty() && !right.records[r].stamps.empty()) return true;
  return false;
}

/// Goes through the channels of one survey.
class PairChooser {
 public:
  PairChooser(const Survey& survey, const std::vector<SignalMeasures>& measures,
              const GivenSignals& given)
      : survey_(survey), measures_(measures), given_(given) {
    for (std::size_t i = 0; i < survey.channels.size(); ++i) {
      hints_.push_back(hintOf(survey.channels[i].name));
      if (measures[i].shape == SignalShape::constant || measures[i].samples < kFewestSamples)
        continue;
      if (hints_[i].role == SignalRole::input) named_inputs_.push_back(i);
      if (hints_[i].role == SignalRole::output) named_outputs_.push_back(i);
      moving_.push_back(i);
    }
  }

  SignalChoice run() {
    SignalChoice choice;
    std::vector<SignalPair> pairs = allPairs();
    if (pairs.empty()) {
      choice.doubt = "no two signals move in the same record";
      return choice;
    }
    choice.chosen = pairs.front();
    pairs.erase(pairs.begin());
    pairs.resize(std::min(pairs.size(), kMostOthers));
    choice.input_reason = reason(choice.chosen->input, SignalRole::input, given_.input);
    choice.output_reason = reason(choice.chosen->output, SignalRole::output, given_.output);
    choice.doubt = doubt();
    if (!choice.doubt.empty()) choice.others = std::move(pairs);
    return choice;
  }

 private:
  /// The only channel of this role; the one called u or y where there are several.
  std::optional<std::size_t> settled(const std::vector<std::size_t>& named) const {
    if (named.size() == 1) return named.front();
    const auto exact = std::find_if(named.begin(), named.end(),
                                    [&](std::size_t i) { return hints_[i].strength == 3; });
    if (exact == named.end()) return std::nullopt;
    return *exact;
  }

  std::vector<std::size_t> candidates(const std::vector<std::size_t>& named,
                                      const std::optional<std::size_t>& given, SignalRole contrary,
                                      std::size_t most) const {
    if (given) return {*given};
    if (const auto only = settled(named)) return {*only};
    std::vector<std::size_t> found = named.empty() ? moving_ : named;
    if (named.empty()) {
      const auto end = std::remove_if(found.begin(), found.end(),
                                      [&](std::size_t i) { return hints_[i].role == contrary; });
      if (end != found.begin()) found.erase(end, found.end());
    }
    std::stable_sort(found.begin(), found.end(), [&](std::size_t left, std::size_t right) {
      const bool unlikely_left = isUnlikely(survey_.channels[left]);
      if (unlikely_left != isUnlikely(survey_.channels[right])) return !unlikely_left;
      return hints_[left].strength > hints_[right].strength;
    });
    found.resize(std::min(found.size(), most));
    return found;
  }

  std::vector<SignalPair> allPairs() const {
    std::vector<SignalPair> pairs;
    for (const std::size_t u :
         candidates(named_inputs_, given_.input, SignalRole::output, kMostInputs))
      for (const std::size_t y :
           candidates(named_outputs_, given_.output, SignalRole::input, kMostOutputs))
        if (u != y && shareRecords(survey_.channels[u], survey_.channels[y]))
          pairs.push_back(pairOf(u, y));
    std::stable_sort(pairs.begin(), pairs.end(),
                     [](const auto& left, const auto& right) { return left.score > right.score; });
    return pairs;
  }

  SignalPair pairOf(std::size_t u, std::size_t y) const {
    const Channel &input = survey_.channels[u], &output = survey_.channels[y];
    SignalPair pair{u, y, followingOf(input, output, measures_[y].band.value_or(0))};
    const Following& following = pair.following;
    pair.score = hints_[u].strength + hints_[y].strength;
    if (following.outputFollows()) pair.score += kFollows * (0.5 + following.after);
    if (following.inputFollows() && following.before > following.after) pair.score -= kContrary;
    if (!input.field.empty() && componentOf(input) == componentOf(output))
      pair.score += kSameComponent;
    pair.score -= kUnlikely * (isUnlikely(input) + isUnlikely(output));
    const SignalShape shape = measures_[u].shape;
    if (shape == SignalShape::steps || shape == SignalShape::two_levels) pair.score += kLikeCommand;
    return pair;
  }

  std::string reason(std::size_t i, SignalRole role,
                     const std::optional<std::size_t>& given) const {
    if (given) return "the configuration says so";
    const NameHint& hint = hints_[i];
    std::string why;
    if (hint.role == role)
      why = hint.strength == 3 ? "it is called so" : "its name says '" + hint.word + "'";
    const bool steps = measures_[i].shape != SignalShape::continuous;
    if (role == SignalRole::input && steps)
      why += (why.empty() ? "" : "; ") + shapeText(measures_[i]) + ", as commands do";
    return why.empty() ? "nothing in its name" : why;
  }

  std::string list(const std::vector<std::size_t>& named) const {
    std::string text;
    for (std::size_t k = 0; k < std::min<std::size_t>(named.size(), 6); ++k)
      text += (k == 0 ? "'" : ", '") + survey_.channels[named[k]].name + "'";
    if (named.size() > 6) text += " and " + std::to_string(named.size() - 6) + " more";
    return text;
  }

  std::string doubtOf(const std::vector<std::size_t>& named,
                      const std::optional<std::size_t>& given, const std::string& role) const {
    if (given || settled(named)) return "";
    if (named.empty()) return "no signal that moves is called like an " + role;
    return "the " + role + " could be any of " + list(named);
  }

  std::string doubt() const {
    const std::string of_input = doubtOf(named_inputs_, given_.input, "input");
    const std::string of_output = doubtOf(named_outputs_, given_.output, "output");
    return of_input + (of_input.empty() || of_output.empty() ? "" : "; ") + of_output;
  }

  const Survey& survey_;
  const std::vector<SignalMeasures>& measures_;
  const GivenSignals& given_;
  std::vector<NameHint> hints_;
  std::vector<std::size_t> moving_, named_inputs_, named_outputs_;
};

}  // namespace

SignalChoice chooseSignals(const Survey& survey, const std::vector<SignalMeasures>& measures,
                           const GivenSignals& given) {
  return PairChooser(survey, measures, given).run();
}

std::string shapeText(const SignalMeasures& measures) {
  switch (measures.shape) {
    case SignalShape::constant:
      return "constant";
    case SignalShape::two_levels:
      return "switches between " + rounded(measures.smallest) + " and " + rounded(measures.largest);
    case SignalShape::steps:
      return "steps between " + std::to_string(measures.levels) + " levels";
    case SignalShape::continuous:
      break;
  }
  return "moves continuously";
}

}  // namespace uncertainty_identification
