#include "ros/experiment_bag.h"

#include <ros/serialization.h>
#include <rosbag/bag.h>
#include <std_msgs/UInt32.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "io/atomic_file.h"
#include "io/checksum.h"
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

/// Writes messages into a bag, and the sum of their checksums behind them. A sum, because messages
/// are read back in the order of their stamps.
class ChecksummedBag {
 public:
  explicit ChecksummedBag(const std::string& path) : bag_(path, rosbag::bagmode::Write) {}

  template <typename Message>
  void write(const std::string& topic, const Message& message) {
    std::vector<std::uint8_t> bytes(ros::serialization::serializationLength(message));
    ros::serialization::OStream stream(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
    ros::serialization::serialize(stream, message);
    sum_.data += checksumOf(bytes.data(), bytes.size());
    const ros::Time stamp = std::max(message.header.stamp, ros::TIME_MIN);
    last_ = std::max(last_, stamp);
    bag_.write(topic, stamp, message);
  }

  void close() {
    bag_.write(kChecksumTopic, last_, sum_);
    bag_.close();
  }

 private:
  rosbag::Bag bag_;
  std_msgs::UInt32 sum_;
  ros::Time last_ = ros::TIME_MIN;
};

}  // namespace

void writeExperimentBag(const std::string& path, const std::vector<const Experiment*>& experiments,
                        const messages::IdentificationResult* result) {
  const MemoryFile memory;
  try {
    ChecksummedBag bag(memory.path());
    for (const Experiment* experiment : experiments)
      bag.write("/experiment", toMessage(*experiment));
    if (result != nullptr) bag.write("/result", *result);
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
