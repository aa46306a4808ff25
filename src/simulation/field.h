#pragma once

#include <Eigen/Core>
#include <cmath>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "math/constants.h"

/// How the parameters of a simulated system are described. Each part of a Truth lists its
/// parameters once, in a function fields(). The check of their values follows from it, and so do
/// their reading and writing as YAML or JSON.
namespace uncertainty_identification {

enum class HeteroDriver;
enum class InputKind;
enum class NoiseStart;
enum class PlantStructure;

/// The numbers that are allowed for a key.
struct Range {
  bool (*contains)(double value);
  const char* text;  ///< the range in words, for error messages

  /// Throws ConfigurationError naming key, value and range unless the range contains the value.
  void check(const std::string& key, double value) const;
};

namespace range {

inline constexpr Range kFinite{[](double value) { return std::isfinite(value); },
                               "a finite number"};
inline constexpr Range kPositive{[](double value) { return value > 0 && std::isfinite(value); },
                                 "a finite number above 0"};
inline constexpr Range kNotNegative{[](double value) { return value >= 0 && std::isfinite(value); },
                                    "a finite number, 0 or above"};
/// A probability, a share, or the radius of a pole.
inline constexpr Range kBelowOne{[](double value) { return value >= 0 && value < 1; },
                                 "at least 0 and below 1"};
inline constexpr Range kBelowHalf{[](double value) { return value >= 0 && value < 0.5; },
                                  "at least 0 and below 0.5"};
inline constexpr Range kAtMostOne{[](double value) { return value <= 1 && std::isfinite(value); },
                                  "a finite number, at most 1"};
inline constexpr Range kAboveTwo{[](double value) { return value > 2 && std::isfinite(value); },
                                 "a finite number above 2"};
/// A real pole of a stable system.
inline constexpr Range kInsideCircle{[](double value) { return std::abs(value) < 1; },
                                     "between -1 and 1, which are excluded"};
/// A frequency in rad/sample.
inline constexpr Range kZeroToPi{[](double value) { return value >= 0 && value <= kPi; },
                                 "0 to 3.14159"};
/// A whole number of samples or tones, and a delay in samples.
inline constexpr Range kOneToMillion{[](double value) { return value >= 1 && value <= 1e6; },
                                     "1 to 1000000"};
inline constexpr Range kDelay{[](double value) { return value >= 0 && value <= 1e5; },
                              "0 to 100000"};

}  // namespace range

/// One parameter of a part of a truth.
struct Field {
  std::string key;  ///< in YAML and JSON
  std::variant<double*, std::optional<double>*, int*, bool*, std::string*, Eigen::VectorXd*,
               HeteroDriver*, InputKind*, PlantStructure*, NoiseStart*>
      value;                       ///< where the parameter is stored
  Range allowed = range::kFinite;  ///< of a number; the entries of a vector must be finite

  /// Throws ConfigurationError naming "<part>.<key>", value and range when the value is not
  /// allowed.
  void check(const std::string& part) const;
};

using Fields = std::vector<Field>;

/// Checks all parameters of a part. It takes a copy because fields() is not const: it also serves
/// the reader of YAML, which changes them.
template <class Part>
void checkFields(const std::string& name, Part part) {
  for (const Field& field : part.fields()) field.check(name);
}

}  // namespace uncertainty_identification
