#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace uncertainty_identification {

/// Places of single values that no working sensor gives, as of a reading that failed (-9999, 1e38):
/// farther from the others than a thousand times the range that these spread over. None where they
/// follow each other, are more than one in 200, or the others do not change.
std::vector<std::size_t> falseReadings(const std::vector<double>& values);

/// The false readings of a signal that have been replaced.
struct ReplacedReadings {
  int count = 0;
  std::string first;  ///< the first of them: its value and its stamp
};

/// Replaces false readings by the value before (the one behind at the beginning) where the signal
/// is held, as an input is, and by NaN where it is not. One of `stamps` [s] belongs to each value.
ReplacedReadings replaceFalseReadings(const std::vector<double>& stamps, bool is_held,
                                      std::vector<double>* values);

/// What a user should know about them, in a sentence; empty where there are none.
std::string sentenceOf(const ReplacedReadings& input, const ReplacedReadings& output);

}  // namespace uncertainty_identification
