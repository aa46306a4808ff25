#include "ros/robust_margin_server.h"

#include <nlohmann/json.hpp>
#include <sstream>

#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/io/result_json.h"

namespace uncertainty_identification {
namespace {

Eigen::VectorXd asVector(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

Estimate estimateOf(const messages::IdentificationResult& result) {
  const auto json = nlohmann::json::parse(result.result_json, nullptr, false);
  if (json.is_discarded()) throw ConfigurationError("its result_json is not JSON");
  return estimateFromJson(json);
}

std::string inWords(const RobustMargin& margin, bool lost) {
  std::ostringstream text;
  if (!margin.nominal_stable) {
    text << "the loop is unstable with the nominal model";
  } else {
    text << (lost ? "the robust margin is lost: " : "robustly stable: ") << "margin "
         << margin.margin << " at " << margin.peak_omega << " rad/s";
  }
  text << ", unstable with " << 100 * margin.unstable_probability << " % of the plants";
  return text.str();
}

messages::RobustMargin toMessage(const RobustMargin& margin, double minimum_margin) {
  messages::RobustMargin message;
  message.lost = !margin.robust() || margin.margin < minimum_margin;
  message.nominal_stable = margin.nominal_stable;
  message.margin = margin.margin;
  message.minimum_margin = minimum_margin;
  message.peak = margin.peak;
  message.peak_omega = margin.peak_omega;
  message.unstable_probability = margin.unstable_probability;
  message.unstable_error = margin.unstable_error;
  message.unstable_upper = margin.unstable_upper;
  message.samples = static_cast<std::uint32_t>(margin.samples);
  message.estimation_errors_included = margin.uncertainty == Uncertainty::total;
  message.message = inWords(margin, message.lost != 0);
  return message;
}

}  // namespace

RobustMarginServer::RobustMarginServer(const ros::NodeHandle& node,
                                       const ros::NodeHandle& private_node,
                                       const RobustMarginOptions& options)
    : node_(node),
      private_node_(private_node),
      options_(options),
      diagnostics_(node, private_node) {
  options_.validate();
  publisher_ = private_node_.advertise<messages::RobustMargin>("margin", 10, true);
  diagnostics_.setHardwareID("none");
  diagnostics_.add("robust margin", [this](diagnostic_updater::DiagnosticStatusWrapper& status) {
    diagnose(status);
  });
  diagnostics_timer_ =
      node_.createWallTimer(ros::WallDuration(diagnostics_.getPeriod()),
                            [this](const ros::WallTimerEvent&) { diagnostics_.force_update(); });
  result_subscriber_ = node_.subscribe<messages::IdentificationResult>(
      "identification/result", 1, [this](const messages::IdentificationResult::ConstPtr& result) {
        result_ = result;
        update();
      });
  bounds_subscriber_ = node_.subscribe<messages::UncertaintyBounds>(
      "identification/uncertainty_bounds", 1,
      [this](const messages::UncertaintyBounds::ConstPtr& bounds) {
        bounds_ = bounds;
        update();
      });
}

/// Computes the margin once result and bounds of the same sequence number have arrived.
void RobustMarginServer::update() {
  if (!result_ || !bounds_ || result_->sequence != bounds_->sequence) return;
  problem_.clear();
  try {
    computeMargin();
  } catch (const std::exception& error) {
    problem_ = "result " + std::to_string(result_->sequence) + " has no margin: " + error.what();
    ROS_WARN_STREAM(problem_);
  }
  diagnostics_.force_update();
}

void RobustMarginServer::computeMargin() {
  if (bounds_->weight_num.empty()) {
    std::string why = "the bounds hold no weight W(z)";
    for (const auto& warning : bounds_->warnings) why += "; " + warning;
    throw DataError(why);
  }
  const RationalFunction weight{asVector(bounds_->weight_num), asVector(bounds_->weight_den)};
  publish(robustMargin(PlantDistribution(estimateOf(*result_)), weight, options_));
}

void RobustMarginServer::publish(const RobustMargin& margin) {
  messages::RobustMargin message = toMessage(margin, options_.minimum_margin);
  message.header.stamp = ros::Time::now();
  message.sequence = result_->sequence;
  message.weight_level = bounds_->weight_level;
  publisher_.publish(message);
  if (message.lost) ROS_WARN_STREAM(message.message);
  last_ = message;
}

void RobustMarginServer::diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) const {
  using Level = diagnostic_msgs::DiagnosticStatus;
  if (!problem_.empty()) {
    status.summary(Level::WARN, problem_);
  } else if (!last_) {
    status.summary(Level::WARN, "no identification result with its bounds yet");
  } else {
    status.summary(last_->lost ? Level::WARN : Level::OK, last_->message);
  }
  if (!last_) return;
  status.add("result sequence", last_->sequence);
  status.add("margin", last_->margin);
  status.add("unstable probability", last_->unstable_probability);
}

}  // namespace uncertainty_identification
