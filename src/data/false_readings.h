#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace uncertainty_identification {

/// Places of single values that no working sensor gives, as of a reading that failed (-9999, 1e38):
/// farther from the others than `far` times the range that these spread over, without the outermost
/// 0.5 % at each end. Values that are not finite are passed over. None where there are fewer than
/// 20, where such values follow each other or are more than one in 200 (one below 200), where one
/// is the first or the last, which may be a step, or where the others do not change.
std::vector<std::size_t> falseReadings(const std::vector<double>& values, double far);

/// Replaces false readings, the stamps [s] of which are told: of the input, which may be an
/// impulse, those 1e5 ranges away, by the value before; of the output those 1,000 ranges away, by
/// NaN, which counts as missing. What a user should know, in a sentence; empty where there are
/// none.
std::string replaceFalseReadings(const std::vector<double>& input_stamps,
                                 std::vector<double>* input,
                                 const std::vector<double>& output_stamps,
                                 std::vector<double>* output);

}  // namespace uncertainty_identification
