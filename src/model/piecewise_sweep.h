#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "model/sweep_kernels.h"
#include "uncertainty_identification/model/block.h"
#include "uncertainty_identification/model/nominal_model.h"

namespace uncertainty_identification {

/// A Box-Jenkins model with FIR error basis at given parameters, prepared for PiecewiseSweep.
struct SweepModel {
  /// `T`: taps x n, of the error model. `offset`: the common one of the outputs.
  SweepModel(const Polynomials& polynomials, const Eigen::MatrixXd& T, double offset);

  Polynomials p;
  Eigen::VectorXd monic_d;                ///< [1; d]
  std::vector<Eigen::VectorXd> taps;      ///< T, a column for each regressor
  std::vector<Eigen::VectorXd> of_input;  ///< B T_i, the numerators of the regressors
  double offset;
  int history;  ///< number of past samples that the filters and the derivatives look back

  int regressors() const { return static_cast<int>(taps.size()); }
};

/// Initial values of [regressors; residual] in a block, as StartColumns orders them: value k of
/// signal s is at [k (n + 1) + s]. Without values all starts from rest.
struct SweepStart {
  int noise = 0, states = 0;
  bool own_offset = false;
  std::vector<Lanes> values;
};

/// Computes residual and regressors of a block without gaps, and their derivatives with respect to
/// [b; a; c; d], a piece of the samples at a time, so that all signals of a piece stay in the
/// cache. Subtracting the effect Z s of initial values s costs nothing, because a filter that
/// starts from them already does so.
class PiecewiseSweep {
 public:
  /// `input_taps`: filters the input that drives the residual, with own taps for each lane; may be
  /// empty. The other arguments must outlive this object.
  PiecewiseSweep(const SweepModel& model, const Block& block, const SweepStart& start,
                 std::vector<Lanes> input_taps = {});

  /// Begins at the first sample again, from what `start` has become.
  void restart();

  /// Computes the next piece, which is empty behind the last sample. Signals of an experiment that
  /// has ended are zero.
  bool next();

  /// Computes the derivatives in this piece, of the residual and, if requested, of the regressors.
  void differentiate(bool regressors);

  int begin() const { return begin_; }
  int samples() const { return samples_; }         ///< of this piece
  const Lanes& active() const { return active_; }  ///< 1 for experiments that have not ended

  /// The regressors, then the residual, in this piece.
  const std::vector<const double*>& values() const { return values_; }

  /// Their derivatives, without signs: that of signal s with respect to coefficient j is at
  /// [s (number of coefficients) + j]. differentiate(false) computes the last of these rows only.
  const std::vector<const double*>& derivatives() const { return derivatives_; }

  /// The sign of these derivatives, for the residual and for the regressors, by kind (b, a, c, d).
  static constexpr double kResidualSigns[4] = {-1, 1, -1, 1};
  static constexpr double kRegressorSigns[4] = {1, -1, -1, 1};

  static constexpr int kPiece = 32;

 private:
  /// The signals of a regressor or of the residual, with D/C the inverse noise model. Signals that
  /// are equal share their memory.
  struct Chain {
    double* driven = nullptr;    ///< x: what the input drives
    double* raw = nullptr;       ///< the regressor or y - x, less the offset
    double* white = nullptr;     ///< D/C raw: the value
    double* to_input = nullptr;  ///< D/(A C) u, filtered as the input is
    double* driven_a = nullptr;  ///< x/A
    double* white_a = nullptr;   ///< D/(A C) x
    double* white_c = nullptr;   ///< white/C
    double* raw_c = nullptr;     ///< raw/C
  };
  Eigen::Index stride() const {
    return static_cast<Eigen::Index>(model_.history + kPiece) * kLanes;
  }
  double* take();
  void layOut();
  void layOut(std::size_t signal);
  void listDerivatives();
  void keepHistory();
  void endExperiments();
  void loadInput();
  /// Signals that one filter turns into others.
  struct Group {
    std::vector<const double*> in;
    std::vector<double*> out;
    void add(const double* from, double* to) {
      if (from == to) return;  // the filter is 1
      in.push_back(from);
      out.push_back(to);
    }
  };
  void filter(const Eigen::VectorXd& numerator, const Eigen::VectorXd& denominator,
              const double* const* in, std::size_t signals, double* const* out) const;
  void filter(const Eigen::VectorXd& numerator, const Eigen::VectorXd& denominator,
              const Group& group) const {
    filter(numerator, denominator, group.in.data(), group.in.size(), group.out.data());
  }
  void filterInjected(const Eigen::VectorXd& numerator, const Eigen::VectorXd& denominator,
                      const double* in, int first, int count, std::size_t signal, double sign,
                      double* out) const;
  Lanes ownOffset(std::size_t signal) const;
  void group(std::size_t first);
  void drive(std::size_t signal);

  const SweepModel& model_;
  const Block& block_;
  const SweepStart& start_;
  std::vector<Lanes> input_taps_;
  const SweepKernels& kernels_;
  int begin_ = 0, samples_ = 0;
  Lanes active_;
  std::unique_ptr<double[]> memory_;
  int signals_ = 0;  ///< laid out in memory_
  double *input_copy_, *filtered_input_, *over_a_, *white_input_;
  bool copies_input_;                         ///< in every piece, because its past is a derivative
  const double* input_ = nullptr;             ///< the delayed input
  const double* residual_input_ = nullptr;    ///< the same filtered by input_taps_
  Group whitened_;                            ///< by D/C, for the values
  Group over_a_of_, whitened_a_, over_c_of_;  ///< by 1/A, D/C and 1/C, for the derivatives
  std::vector<Chain> chains_;                 ///< of the regressors, then of the residual
  std::vector<const double*> values_, derivatives_;
};

}  // namespace uncertainty_identification
