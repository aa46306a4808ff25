#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>

#include <optional>
#include <string>

#include "ros/messages.h"
#include "uncertainty_identification/control/robust_margin.h"

namespace uncertainty_identification {

/// The node that computes robust margins. For each identification result and its bounds (topics
/// identification/result and identification/uncertainty_bounds, matched by their sequence number)
/// it computes the margin of the configured controller, and publishes it on the latched topic
/// ~margin (RobustMargin) and in the diagnostics.
class RobustMarginServer {
 public:
  /// Throws ConfigurationError when the options are not valid.
  RobustMarginServer(const ros::NodeHandle& node, const ros::NodeHandle& private_node,
                     const RobustMarginOptions& options);

 private:
  void update();
  void computeMargin();
  void publish(const RobustMargin& margin);
  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) const;

  ros::NodeHandle node_, private_node_;
  RobustMarginOptions options_;
  ros::Publisher publisher_;
  diagnostic_updater::Updater diagnostics_;
  ros::WallTimer diagnostics_timer_;
  ros::Subscriber result_subscriber_, bounds_subscriber_;
  messages::IdentificationResult::ConstPtr result_;  ///< the newest one, or null
  messages::UncertaintyBounds::ConstPtr bounds_;     ///< the newest ones, or null
  std::optional<messages::RobustMargin> last_;
  std::string problem_;  ///< why the newest pair has no margin
};

}  // namespace uncertainty_identification
