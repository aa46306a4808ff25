#include "ros/experiment_bag.h"

#include <rosbag/bag.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "io/atomic_file.h"
#include "ros/message_conversions.h"
#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/ros/bag_reader.h"

namespace uncertainty_identification {
namespace {

/// A file in memory. Bags are written to memory first, because rosbag::Bag terminates the process
/// when the disk is full, even if its exceptions are caught.
class MemoryFile {
 public:
  MemoryFile() : file_(::memfd_create("experiments.bag", MFD_CLOEXEC)) {
    if (file_ < 0) throw FileError(std::string("no memory for a bag: ") + std::strerror(errno));
  }
  ~MemoryFile() { ::close(file_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  std::string path() const { return "/proc/self/fd/" + std::to_string(file_); }

  void copyTo(const std::string& path) const {
    std::ifstream from(this->path(), std::ios::binary);
    std::ofstream to(path, std::ios::binary);
    to << from.rdbuf();
    to.close();
    if (!from || !to)
      throw FileError("cannot write '" + path + "': " + std::strerror(errno) +
                      "; check that the folder exists, may be written to and has space left");
  }

 private:
  int file_;
};

}  // namespace

void writeExperimentBag(const std::string& path, const std::vector<const Experiment*>& experiments,
                        const messages::IdentificationResult* result) {
  const MemoryFile memory;
  try {
    rosbag::Bag bag(memory.path(), rosbag::bagmode::Write);
    for (const Experiment* experiment : experiments) {
      const messages::Experiment message = toMessage(*experiment);
      bag.write("/experiment", std::max(message.header.stamp, ros::TIME_MIN), message);
    }
    if (result != nullptr)
      bag.write("/result", std::max(result->header.stamp, ros::TIME_MIN), *result);
    bag.close();
  } catch (const rosbag::BagException& error) {
    throw FileError("cannot write bag '" + path + "': " + error.what());
  }
  writeAtomically(path, [&](const std::string& temporary) { memory.copyTo(temporary); });
}

ExperimentFiles experimentBags() {
  return {[](const std::string& path, const std::vector<const Experiment*>& experiments) {
            writeExperimentBag(path, experiments);
          },
          readExperimentBag, unpackedSize};
}

}  // namespace uncertainty_identification
