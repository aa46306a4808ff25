#pragma once

#include <Eigen/Core>
#include <vector>

namespace uncertainty_identification {

/// Limits at each point of a grid (frequencies, times) between which a share `level` of the plants
/// lies.
struct Band {
  double level = 0;
  Eigen::VectorXd lower, upper;
};

/// The bands of one quantity, in the order of the levels.
struct Bands {
  std::vector<Band> pointwise;     ///< hold at each point for itself
  std::vector<Band> simultaneous;  ///< hold at all points at once
  /// Standard deviation of a pointwise limit that comes from its having been found by drawing, as a
  /// share of the band's width: of each level, the mean over every tenth point.
  std::vector<double> monte_carlo_error;

  bool empty() const { return pointwise.empty(); }
};

enum class Sides { two, upper };  ///< upper: the lower limit is 0

/// Bands from draws, one point of the grid after the other.
///
/// Pointwise limits are order statistics: of S draws the k-th smallest is exceeded by a further
/// plant with probability 1 - k/(S + 1), whatever the distribution. Simultaneous bands have one
/// shape, the pointwise band of the level nearest 0.9, stretched about the median by the same
/// factor at all points until a share `level` of the draws never leaves it, and are nowhere
/// narrower than the pointwise band: so higher levels hold lower ones.
class BandBuilder {
 public:
  /// Differences below `resolution` count as none: rounding must not stretch a band where all
  /// plants agree. Throws ConfigurationError when the draws are too few for a level.
  BandBuilder(std::vector<double> levels, int draws, Eigen::Index points, Sides sides,
              float resolution);

  /// The values of all draws at the next point; those that are not finite count as very large.
  void add(const Eigen::ArrayXf& values);

  /// After all points.
  Bands bands() const;

 private:
  struct Limit {
    int lower, upper;  ///< ranks, from 0
  };

  void addError();

  std::vector<double> levels_;
  Sides sides_;
  float resolution_;
  Eigen::Index point_ = 0;
  int draws_;
  std::vector<Limit> limits_;           ///< of each level
  std::vector<int> ranks_, all_ranks_;  ///< ascending: of the limits and the median; and errors'
  Eigen::ArrayXXf lower_, upper_;       ///< levels x points
  Eigen::ArrayXf center_;               ///< of each point
  std::size_t shape_ = 0;               ///< the level whose band gives the shape
  Eigen::ArrayXf stretch_;              ///< what each draw needs
  std::vector<double> error_;
  int error_points_ = 0;
  Eigen::ArrayXf sorted_;
};

}  // namespace uncertainty_identification
