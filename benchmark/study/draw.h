#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace uncertainty_identification::study {

/// Draws from one stream of random numbers. The same seed gives the same draws.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : engine_(seed) {}

  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }

  /// Uniform in the logarithm, for quantities whose order of magnitude is unknown.
  double logUniform(double low, double high) {
    return std::exp(uniform(std::log(low), std::log(high)));
  }

  /// An integer from low to high, both included.
  int integer(int low, int high) { return std::uniform_int_distribution<int>(low, high)(engine_); }

  bool chance(double probability) { return uniform(0, 1) < probability; }

  double normal() { return std::normal_distribution<double>()(engine_); }

  /// Student's t with 3 degrees of freedom, scaled to a variance of 1.
  double heavyTailed() { return std::student_t_distribution<double>(3)(engine_) / std::sqrt(3.0); }

  Eigen::VectorXd normals(Eigen::Index count) {
    return Eigen::VectorXd::NullaryExpr(count, [this]() { return normal(); });
  }

  /// An index, drawn with these probabilities.
  int index(const std::vector<double>& weights) {
    return std::discrete_distribution<int>(weights.begin(), weights.end())(engine_);
  }

 private:
  std::mt19937_64 engine_;
};

/// Seeds of independent streams: one for each purpose of each system.
inline std::uint64_t seedOf(std::uint64_t system, std::uint64_t purpose) {
  std::uint64_t mixed = system * 0x9e3779b97f4a7c15U + purpose * 0xbf58476d1ce4e5b9U + 1;
  mixed = (mixed ^ (mixed >> 30U)) * 0xbf58476d1ce4e5b9U;
  mixed = (mixed ^ (mixed >> 27U)) * 0x94d049bb133111ebU;
  return mixed ^ (mixed >> 31U);
}

}  // namespace uncertainty_identification::study
