#include "ros/bag_survey.h"
#include "ros/bag_writer.h"
#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/ros/bag_reader.h"

/// What takes the place of reading and writing bags in a build without ROS: an error that says so.
namespace uncertainty_identification {
namespace {

[[noreturn]] void refuse(const std::string& path) {
  throw FileError("'" + path +
                  "' is a bag, and this program was built without ROS; convert it to CSV (columns "
                  "experiment,t,u,y), or build on a machine with ROS");
}

}  // namespace

LoadedData readBag(const std::string& path, const Configuration& /*configuration*/,
                   const KeepGoing& /*keep_going*/) {
  refuse(path);
}

std::uint64_t unpackedSize(const std::string& path) { refuse(path); }

Survey surveyBag(const std::string& path) { refuse(path); }

void writeBag(const std::string& path, const std::vector<Experiment>& /*experiments*/) {
  refuse(path);
}

}  // namespace uncertainty_identification
