#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstring>

#include "data/check.h"

namespace uncertainty_identification {
namespace {

/// Fowler, Noll and Vo's hash FNV-1a of 64 bits.
class Fnv1a {
 public:
  void add(const void* data, std::size_t size) {
    const auto* bytes = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < size; ++i) hash_ = (hash_ ^ bytes[i]) * 1099511628211ULL;
  }

  void add(std::uint64_t value) { add(&value, sizeof value); }

  /// -0 counts as 0, because no fit distinguishes them.
  void add(double value) {
    value += 0.0;
    add(&value, sizeof value);
  }

  /// Includes the length, so that no value can move from one field to the next unnoticed.
  void add(const std::string& text) {
    add(static_cast<std::uint64_t>(text.size()));
    add(text.data(), text.size());
  }

  void add(const Eigen::VectorXd& values) {
    add(static_cast<std::uint64_t>(values.size()));
    for (Eigen::Index k = 0; k < values.size(); ++k) add(values(k));
  }

  std::uint64_t hash() const { return hash_; }

 private:
  std::uint64_t hash_ = 14695981039346656037ULL;
};

std::uint64_t hashOf(const Experiment& experiment) {
  Fnv1a fnv;
  fnv.add(experiment.sample_time);
  fnv.add(experiment.u);
  for (int k = 0; k < experiment.samples(); ++k) {
    const bool valid = experiment.isValid(k);
    fnv.add(static_cast<std::uint64_t>(valid));
    if (valid) fnv.add(experiment.y(k));
  }
  for (const auto& [name, value] : experiment.scalars) {
    fnv.add(name);
    fnv.add(value);
  }
  for (const auto& [name, values] : experiment.signals) {
    fnv.add(name);
    fnv.add(values);
  }
  return fnv.hash();
}

}  // namespace

std::string dataFingerprint(const std::vector<Experiment>& experiments) {
  std::vector<std::uint64_t> hashes;
  hashes.reserve(experiments.size());
  for (const Experiment& experiment : experiments) hashes.push_back(hashOf(experiment));
  std::sort(hashes.begin(), hashes.end());
  Fnv1a fnv;
  for (const std::uint64_t hash : hashes) fnv.add(hash);
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(fnv.hash()));
  return text;
}

}  // namespace uncertainty_identification
