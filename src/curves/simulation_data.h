#pragma once

#include <Eigen/Core>
#include <array>
#include <map>
#include <string>
#include <vector>

namespace uncertainty_identification {

constexpr int kPlays = 4;

/// Half the width of the plays that a hysteresis is made of, in standard deviations of the input.
constexpr std::array<double, kPlays> kPlayWidths{0.15, 0.4, 0.8, 1.3};

/// The input behind each of these plays, which hold its first value at first; T x kPlays.
Eigen::MatrixXd playsOf(const Eigen::VectorXd& u);

/// A stretch of a record, in standard deviations of the signals. It is simulated from an initial
/// state of its own.
struct SimulationWindow {
  int record = 0;           ///< index of the experiment that it was cut from
  double start = 0;         ///< [s] from the beginning of the experiment
  int rest = 0;             ///< first samples in which the system rested before the record began
  Eigen::VectorXd u, y;     ///< T each
  Eigen::ArrayXd measured;  ///< T weights, 1 = y was measured, 0 = missing
  Eigen::VectorXd time;     ///< T, 0 to 1 over the whole experiment
  std::map<std::string, Eigen::VectorXd> covariates;  ///< T each
  Eigen::MatrixXd plays;  ///< T x kPlays, as playsOf(), which began with the record

  int samples() const { return static_cast<int>(u.size()); }

  /// Number of output samples that were measured.
  int measuredSamples() const { return static_cast<int>(measured.tail(samples() - rest).sum()); }
};

/// What turns signals into standard deviations: scaled = (raw - offset) / unit.
struct Scale {
  double offset = 0, unit = 1;

  double zero() const { return offset / unit; }  ///< added to count from the physical zero
};

/// A covariate, itself or behind a lag.
struct CovariateScale : Scale {
  std::string of;  ///< its name
  double lag = 0;  ///< time constant [s]; 0: itself
};

struct SignalScales {
  Scale u, y;
  std::map<std::string, CovariateScale> covariates;
};

/// Offset and unit of a signal with this sum and sum of squares over `count` samples. The unit is
/// its standard deviation. The offset is its mean if `remove_mean` is true or the mean is larger
/// than three deviations, and zero otherwise.
Scale scaleOf(double sum, double squares, double count, bool remove_mean);

/// Windows of all records with one sample time.
struct SimulationData {
  std::vector<SimulationWindow> windows;
  SignalScales scales;
  double sample_time = 0;
  bool own_levels = false;  ///< each window's output is counted from a level of its own
  int longest = 0;          ///< samples of the longest window
  int samples = 0;          ///< measured output samples

  /// Index of the first window of each group of windows that is left out together, and the number
  /// of windows at the end.
  std::vector<int> groups;
};

/// Indices of the windows of each record.
std::vector<std::vector<int>> windowsByRecord(const SimulationData& data);

/// The windows of one record.
SimulationData onlyOf(const SimulationData& data, const std::vector<int>& windows);

/// How often a signal changes its value.
int changesOf(const Eigen::VectorXd& signal);

/// How often the signal turns back, by more than `least` each time.
int reversalsOf(const Eigen::VectorXd& signal, double least);

}  // namespace uncertainty_identification
