#pragma once

#include <cstdint>
#include <fstream>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "ros/bag_record.h"

namespace uncertainty_identification {

/// A recorded publication of a topic.
struct BagConnection {
  std::string topic;  ///< in the root namespace
  std::string type, md5sum, definition;
  std::string publisher;  ///< empty: not recorded
};

/// A message of a bag. The bytes are valid until the next one is handed out.
struct BagMessage {
  const BagConnection& connection;
  SerialisedMessage bytes;
  double time;  ///< [s] when it was recorded
};

/// An open bag of format 2.0. Written because rosbag_storage crashes or does not return on one
/// damaged bag in ten; here every length is checked before it is used.
class BagFile {
 public:
  /// Throws FileError when the file cannot be read, is no bag, is damaged, encrypted or has no
  /// index.
  explicit BagFile(const std::string& path);

  const std::string& path() const { return path_; }
  const std::map<std::uint32_t, BagConnection>& connections() const { return connections_; }

  /// [bytes] that all chunks unpack to, as their headers say. Throws FileError where the bag is
  /// damaged.
  std::uint64_t unpackedSize();

  /// Hands out the messages of the wanted connections in order of recording. Throws FileError where
  /// the bag is damaged, and what `receive` throws.
  void read(const std::function<bool(const BagConnection&)>& wanted,
            const std::function<void(const BagMessage&)>& receive);

 private:
  struct Entry {
    std::uint64_t time;    // [ns]
    std::uint32_t chunk;   // index into chunks_
    std::uint32_t offset;  // [bytes] of the record in the chunk's content
    std::uint32_t connection;
  };

  std::vector<std::uint8_t> bytesAt(std::uint64_t position, std::uint64_t count);
  std::uint32_t lengthAt(std::uint64_t position);
  std::vector<std::uint8_t> recordAt(std::uint64_t position);
  template <typename Action>
  auto orDamaged(const Action& action);
  std::uint64_t readFileHeader();
  void readIndex(std::uint64_t position);
  void addConnection(const BagRecord& record);
  std::vector<std::uint8_t> chunkContent(std::size_t chunk);
  std::vector<Entry> listEntries(const std::function<bool(const BagConnection&)>& wanted);
  BagMessage messageAt(const Entry& entry, const std::vector<std::uint8_t>& content) const;

  std::string path_;
  std::ifstream file_;
  std::uint64_t size_ = 0;  // [bytes]
  std::map<std::uint32_t, BagConnection> connections_;
  std::vector<std::uint64_t> chunks_;  // positions in the file [bytes]
};

}  // namespace uncertainty_identification
