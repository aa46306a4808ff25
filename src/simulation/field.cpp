#include "uncertainty_identification/simulation/field.h"

#include "uncertainty_identification/require.h"

namespace uncertainty_identification {
namespace {

void checkValue(const std::string& key, const Range& allowed, double value) {
  allowed.check(key, value);
}

void checkValue(const std::string& key, const Range& allowed, int value) {
  require(allowed.contains(value), key, value, allowed.text);
}

void checkValue(const std::string& key, const Range& allowed, const std::optional<double>& value) {
  if (value) allowed.check(key, *value);
}

void checkValue(const std::string& key, const Range&, const Eigen::VectorXd& value) {
  require(value.allFinite(), key, value.transpose(), "finite numbers");
}

/// Flags, words and names have no range.
template <class Value>
void checkValue(const std::string&, const Range&, const Value&) {}

}  // namespace

void Range::check(const std::string& key, double value) const {
  require(contains(value), key, value, text);
}

void Field::check(const std::string& part) const {
  std::visit([&](const auto* found) { checkValue(part + "." + key, allowed, *found); }, value);
}

}  // namespace uncertainty_identification
