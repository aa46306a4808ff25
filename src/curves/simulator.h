#pragma once

#include <Eigen/Core>
#include <vector>

#include "curves/curve_model.h"
#include "curves/simulation_data.h"

namespace uncertainty_identification {

/// A quantity and its derivatives by theta and the initial values.
struct Dual {
  double value = 0;
  Eigen::ArrayXd by;
};

/// Play or rate limit: what it remembers.
struct Memory {
  bool is_set = false;
  Dual held;
};

class Simulator {
 public:
  Simulator(const CurveModel& model, const std::vector<CurveTable>& tables,
            const SimulationWindow& window, bool with_derivatives);
  void begin(const Eigen::VectorXd& initial);
  double step(int k);
  const Eigen::ArrayXd& outputDerivatives() const { return output_.by; }
  double rate() const { return rate_.value; }

 private:
  double curveAt(std::size_t curve, double z);
  /// slope * through + basis of the curve that was looked up last, times factor.
  void addDerivatives(std::size_t curve, double slope, const Eigen::ArrayXd* through, double factor,
                      Eigen::ArrayXd* to) const;
  void add(std::size_t curve, const Dual& through, Dual* to);
  void addProduct(std::size_t curve, const Dual& through, const Dual& factor);
  void distort(std::size_t curve, Dual* signal);
  void multiply(std::size_t curve, double z, const Eigen::ArrayXd* through);
  void play(std::size_t curve, Dual* signal);
  void limitRate(std::size_t curve, Dual* signal);
  void addPlays(std::size_t curve, int k);
  double widthOf(std::size_t curve, double* sign) const;
  void actOnLoop(std::size_t curve);
  void addBySizeOfInput(std::size_t curve);
  void actOnInput(int k);
  void feedBack(int k);
  void actOnOutput();
  void advance();

  const CurveModel& model_;
  const std::vector<CurveTable>& tables_;
  const SimulationWindow& window_;
  const bool derive_;
  // Derivatives of what no curve acts on stay zero.
  bool input_moves_ = false, gain_moves_ = false, state_moves_ = false, reads_rate_ = false;
  const int columns_;
  std::vector<int> first_;
  std::vector<const double*> covariates_;
  std::vector<Memory> memory_;
  Eigen::VectorXd state_;
  Eigen::ArrayXXd by_state_;  ///< columns_ x order
  double level_ = 0, previous_ = 0;
  Eigen::ArrayXd previous_by_;
  Dual x_, input_, gain_, added_, to_state_, rate_, total_, plant_output_, output_, size_, error_;
  int left_ = 0;
  double share_ = 0;
};

}  // namespace uncertainty_identification
