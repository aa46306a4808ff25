#include "simulation/field.h"

#include "configuration/require.h"

namespace uncertainty_identification {

void Range::check(const std::string& key, double value) const {
  require(contains(value), key, value, text);
}

// Flags, words and names have no range.
void Field::check(const std::string& part) const {
  const std::string path = part + "." + key;
  if (const auto whole = std::get_if<int*>(&value))
    require(allowed.contains(**whole), path, **whole, allowed.text);
  if (const auto number = std::get_if<double*>(&value)) allowed.check(path, **number);
  if (const auto optional = std::get_if<std::optional<double>*>(&value); optional && **optional)
    allowed.check(path, (**optional).value());
  if (const auto vector = std::get_if<Eigen::VectorXd*>(&value))
    require((**vector).allFinite(), path, (**vector).transpose(), "finite numbers");
}

}  // namespace uncertainty_identification
