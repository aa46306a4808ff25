#pragma once

#include <optional>
#include <string>
#include <vector>

#include "inspection/following.h"
#include "inspection/signal_measures.h"

namespace uncertainty_identification {

/// Two channels of a survey that may be input and output of a plant.
struct SignalPair {
  std::size_t input = 0, output = 0;  ///< places in Survey::channels
  Following following;
  double score = 0;  ///< the larger, the more speaks for the pair
};

/// Which channels are taken for u and y, and why.
struct SignalChoice {
  std::optional<SignalPair> chosen;         ///< nothing: fewer than two signals move
  std::string input_reason, output_reason;  ///< what speaks for each, in words
  std::string doubt;                        ///< what else it could be; empty: the names settle it
  std::vector<SignalPair> others = {};  ///< the next best ones, best first, without the chosen one
};

/// Channels that are given, by --config for example; the others are chosen.
struct GivenSignals {
  std::optional<std::size_t> input, output;
};

/// `measures` are those of the channels, in their order. The names settle it where exactly one
/// signal that moves is called like an input and exactly one like an output, or where they are
/// called u and y. Otherwise the names and how signals follow each other give the likeliest pair,
/// and `doubt` says that it is a guess.
SignalChoice chooseSignals(const Survey& survey, const std::vector<SignalMeasures>& measures,
                           const GivenSignals& given = {});

/// The shape of a signal in words: "steps between 4 levels".
std::string shapeText(const SignalMeasures& measures);

}  // namespace uncertainty_identification
