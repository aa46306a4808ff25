#pragma once

#include <Eigen/Core>
#include <vector>

namespace uncertainty_identification {

/// For every point of a grid (frequencies or times): the limits between which a share `level` of
/// the plants lies.
struct Band {
  double level = 0;
  Eigen::VectorXd lower, upper;
};

/// The bands of one quantity, in the order of the levels.
struct Bands {
  std::vector<Band> pointwise;     ///< each holds at one point at a time
  std::vector<Band> simultaneous;  ///< each holds at all points together
  /// Standard deviation of a pointwise limit that is due to the finite number of draws, as a share
  /// of the band's width. One entry per level: the mean over every tenth point of the grid.
  std::vector<double> monte_carlo_error;

  bool empty() const { return pointwise.empty(); }
};

enum class Sides { two, upper };  ///< upper: only the upper limit is computed, the lower one is 0

/// Builds the bands from draws of the plant, one point of the grid after the other.
///
/// Pointwise limits are order statistics: a further plant exceeds the k-th smallest of S draws with
/// probability 1 - k/(S + 1), whatever the distribution.
/// A simultaneous band is the pointwise band of the level nearest 0.9, stretched about the median
/// by one factor for all points. The factor is the smallest one for which a share `level` of the
/// draws stays inside everywhere. The band is never narrower than the pointwise band of its own
/// level. So the band of a higher level always contains that of a lower one.
class BandBuilder {
 public:
  /// Differences below `resolution` are treated as zero, so that rounding does not stretch a band
  /// where all plants agree. Throws ConfigurationError when there are too few draws for a level.
  BandBuilder(std::vector<double> levels, int draws, Eigen::Index points, Sides sides,
              float resolution);

  /// Adds the values of all draws at the next point. Values that are not finite count as very
  /// large.
  void add(const Eigen::ArrayXf& values);

  /// The bands of all points. To be called after the last add().
  Bands bands() const;

 private:
  struct Limit {
    int lower, upper;  ///< ranks of the order statistics, counted from 0
  };

  void addError();

  std::vector<double> levels_;
  Sides sides_;
  float resolution_;
  Eigen::Index point_ = 0;
  int draws_;
  std::vector<Limit> limits_;           ///< the ranks of each level's limits
  std::vector<int> ranks_, all_ranks_;  ///< ascending: those of the limits and the median; and
                                        ///< those that monte_carlo_error needs
  Eigen::ArrayXXf lower_, upper_;       ///< levels x points
  Eigen::ArrayXf center_;               ///< median at each point
  std::size_t shape_ = 0;               ///< index of the level whose band gives the shape
  Eigen::ArrayXf stretch_;              ///< factor at which a draw stays inside everywhere
  std::vector<double> error_;
  int error_points_ = 0;
  Eigen::ArrayXf sorted_;
};

}  // namespace uncertainty_identification
