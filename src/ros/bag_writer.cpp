#include "ros/bag_writer.h"

#include <rosbag/bag.h>

#include <functional>
#include <limits>
#include <map>

#include "io/atomic_file.h"
#include "ros/message_conversions.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

constexpr double kNotMeasured = std::numeric_limits<double>::quiet_NaN();

/// Collects messages and writes them in the order of their stamps, like a recording.
class Recorder {
 public:
  explicit Recorder(rosbag::Bag& bag) : bag_(bag) {}

  void addSample(const std::string& topic, double stamp, double value) {
    messages::Sample sample;
    sample.value = value;
    add(topic, stamp, sample);
  }

  void addMarker(double stamp, const std::string& id, bool active) {
    messages::ExperimentMarker marker;
    marker.id = id;
    marker.active = active;
    add("/experiment/active", stamp, marker);
  }

  void write() {
    for (const auto& [stamp, write] : pending_) write(stamp);
    pending_.clear();
  }

 private:
  template <typename Message>
  void add(const std::string& topic, double seconds, Message message) {
    const ros::Time stamp = toStamp(seconds, "topic '" + topic + "'");
    message.header.stamp = stamp;
    pending_.emplace(stamp,
                     [this, topic, message](ros::Time time) { bag_.write(topic, time, message); });
  }

  rosbag::Bag& bag_;
  std::multimap<ros::Time, std::function<void(ros::Time)>> pending_;
};

void writeExperiment(const Experiment& experiment, Recorder& recorder) {
  const double start = experiment.start_time;
  recorder.addMarker(start, experiment.id, true);
  for (const auto& [name, value] : experiment.scalars)
    recorder.addSample("/covariate/" + name, start, value);
  for (int k = 0; k < experiment.samples(); ++k) {
    const double stamp = start + k * experiment.sample_time;
    recorder.addSample("/actuator/command", stamp, experiment.u[k]);
    const double offset = experiment.stamp_offset.size() > 0 ? experiment.stamp_offset[k] : 0;
    const double y = experiment.isValid(k) ? experiment.y[k] : kNotMeasured;
    recorder.addSample("/sensor/measurement", stamp + offset, y);
    for (const auto& [name, signal] : experiment.signals)
      recorder.addSample("/covariate/" + name, stamp, signal[k]);
  }
  recorder.addMarker(start + experiment.samples() * experiment.sample_time, experiment.id, false);
  recorder.write();
}

void requireInOrder(const std::vector<Experiment>& experiments) {
  for (std::size_t i = 1; i < experiments.size(); ++i) {
    const Experiment& before = experiments[i - 1];
    if (experiments[i].start_time >= before.start_time + before.samples() * before.sample_time)
      continue;
    throw DataError("experiment '" + experiments[i].id + "' begins before '" + before.id +
                    "' ends; a bag needs experiments one after the other");
  }
}

}  // namespace

void writeBag(const std::string& path, const std::vector<Experiment>& experiments) {
  requireInOrder(experiments);
  try {
    writeAtomically(path, [&](const std::string& temporary) {
      rosbag::Bag bag(temporary, rosbag::bagmode::Write);
      Recorder recorder(bag);
      for (const auto& experiment : experiments) writeExperiment(experiment, recorder);
      bag.close();
    });
  } catch (const rosbag::BagException& error) {
    throw FileError("cannot write bag '" + path + "': " + error.what());
  }
}

}  // namespace uncertainty_identification
