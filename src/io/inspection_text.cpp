#include "io/inspection_text.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <iterator>
#include <map>
#include <utility>

#include "data/text.h"
#include "inspection/closed_loop.h"
#include "inspection/suggestion.h"
#include "io/inspection_tables.h"
#include "io/printable.h"

namespace uncertainty_identification {
namespace {

const Channel& channelOf(const InspectedData& data, std::size_t place) {
  return data.survey.channels[place];
}

std::string nameIn(const InspectedData& data, std::size_t place) {
  return "'" + printable(channelOf(data, place).name) + "'";
}

std::string twoDigits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f", value);
  return text;
}

/// How much an output answers, in words with the numbers.
std::string answerText(const InspectedData& data, const SignalPair& pair) {
  const Following& following = pair.following;
  const std::string u = nameIn(data, pair.input), y = nameIn(data, pair.output);
  if (!following.measured && following.at_once.matters())
    return y + " moves with " + u + " within the same reading (correlation " +
           twoDigits(following.at_once.correlation) +
           " of what six earlier readings of both do not predict), so that the direction cannot be "
           "seen.";
  if (!following.measured)
    return "Whether " + y + " follows " + u +
           " cannot be told: too few samples, or changes, in common.";
  const std::string numbers = " (correlation " + twoDigits(following.after) +
                              " of what their own past does not predict; unrelated signals reach " +
                              twoDigits(following.chance) + ")";
  if (following.outputFollows() && following.delay == 0)
    return y + " moves with " + u + " within one reading of " + rounded(following.period) + " s" +
           numbers + ", so that the direction cannot be seen.";
  if (following.outputFollows())
    return y + " follows " + u + " after about " + rounded(following.delay) + " s" + numbers + ".";
  return "It is not seen that " + y + " follows " + u + numbers +
         ": noise hides it, the plant is slow, or they do not belong together.";
}

std::string loopText(const InspectedData& data, const SignalPair& pair) {
  const Following& following = pair.following;
  if (!following.measured && !following.moveTogether()) return "";
  const std::string u = nameIn(data, pair.input), y = nameIn(data, pair.output);
  if (const auto warning = closedLoopWarning(following, u, y))
    return (following.before > following.after ? "Careful: " : "Closed loop: perhaps, as ") +
           *warning + ".";
  if (following.moveTogether())
    return "Closed loop: cannot be seen: a controller that computes " + u +
           " from the same reading of " + y + " looks like a plant that answers at once.";
  return "Closed loop: no sign that " + u + " follows " + y +
         "; a controller is not seen where noise is small beside the excitation.";
}

std::string othersText(const InspectedData& data) {
  std::string text;
  for (const SignalPair& pair : data.choice.others)
    text += (text.empty() ? "" : "; ") + nameIn(data, pair.input) + " to " +
            nameIn(data, pair.output) +
            (pair.following.outputFollows()
                 ? " (follows, correlation " + twoDigits(pair.following.after) + ")"
                 : " (not seen to follow)");
  return text;
}

std::string choiceText(const InspectedData& data) {
  std::string text = "Input and output\n\n";
  for (const std::string& sentence : choiceSentences(data)) text += "  " + sentence + "\n";
  return text + "\n";
}

/// A text without its numbers, by which notes of the same kind are recognised.
std::string kindOf(const std::string& note) {
  std::string kind;
  std::copy_if(note.begin(), note.end(), std::back_inserter(kind),
               [](unsigned char c) { return std::isalpha(c) != 0; });
  return kind;
}

/// Each kind of note once, with the number of those like it.
std::string notesText(const std::vector<std::string>& notes) {
  std::map<std::string, long> count;
  for (const std::string& note : notes) ++count[kindOf(note)];
  std::string text;
  for (const std::string& note : notes) {
    const long alike = std::exchange(count[kindOf(note)], 0);
    if (alike == 0) continue;
    text += "  note: " + printable(note) +
            (alike > 1 ? " (and " + std::to_string(alike - 1) + " more like this)" : "") + "\n";
  }
  return text;
}

std::string cutText(const InspectedData& data) {
  std::string text =
      "Experiments (" + printable(cutReason(data.survey, data.configuration)) + ")\n\n";
  if (!data.failure.empty()) text += "  none: " + printable(data.failure) + "\n";
  text += experimentTable(data.loaded);
  for (const RejectedExperiment& rejected : data.loaded.rejected)
    text += "  left out: " + printable(rejected.reason) + "\n";
  return text + notesText(data.loaded.warnings);
}

}  // namespace

std::vector<std::string> choiceSentences(const InspectedData& data) {
  const SignalChoice& choice = data.choice;
  if (data.configuration.experiment.mode == ExperimentMode::message)
    return {"The data hold whole experiments, which state their input and output."};
  if (!choice.chosen) return {"Cannot tell: " + choice.doubt + "."};
  const SignalPair& pair = *choice.chosen;
  std::vector<std::string> sentences;
  if (!choice.doubt.empty())
    sentences.push_back("Cannot tell for sure: " + printable(choice.doubt) +
                        ". The likeliest pair is taken, as a guess:");
  sentences.push_back("Input u: " + nameIn(data, pair.input) + " (" + choice.input_reason + ").");
  sentences.push_back("Output y: " + nameIn(data, pair.output) + " (" + choice.output_reason +
                      ").");
  sentences.push_back(answerText(data, pair));
  if (const std::string loop = loopText(data, pair); !loop.empty()) sentences.push_back(loop);
  if (const std::string others = othersText(data); !others.empty())
    sentences.push_back("Other pairs, the likelier first: " + others + ".");
  return sentences;
}

std::string chosenText(const InspectedData& data) {
  const SignalPair& pair = *data.choice.chosen;
  return "input: " + nameIn(data, pair.input) + " (" + data.choice.input_reason +
         "), output: " + nameIn(data, pair.output) + " (" + data.choice.output_reason +
         "); experiments: " + printable(cutReason(data.survey, data.configuration)) +
         (data.configuration.time.counts()
              ? "; time: no column is known to hold it, and a row is taken for " +
                    text(data.configuration.time.sample_time) +
                    " s, so that times in the result count rows"
              : "") +
         "; --config chooses others";
}

std::string inspectionText(const InspectedData& data) {
  std::string text = streamTables(data.survey);
  for (const std::string& remark : data.survey.remarks) text += "  " + printable(remark) + "\n";
  text += "\nSignals (all files together)\n\n" + signalTable(data.survey, data.measures) + "\n";
  return text + choiceText(data) + cutText(data);
}

}  // namespace uncertainty_identification
