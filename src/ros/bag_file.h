#pragma once

#include <cstdint>
#include <fstream>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "ros/bag_record.h"

namespace uncertainty_identification {

/// One publisher of a topic, as the bag recorded it.
struct BagConnection {
  std::string topic;  ///< full name, beginning with '/'
  std::string type, md5sum, definition;
  std::string publisher;  ///< name of the node; empty if the bag does not say
};

/// A message of a bag. The bytes are valid until the next message is read.
struct BagMessage {
  const BagConnection& connection;
  SerialisedMessage bytes;
  double time;  ///< [s] when it was recorded
};

/// An open bag of format 2.0. This class replaces rosbag_storage, which crashes or never returns
/// for one damaged bag in ten. Here every length is checked before it is used.
class BagFile {
 public:
  /// Throws FileError when the file cannot be read, is not a bag, is damaged or encrypted, or
  /// has no index.
  explicit BagFile(const std::string& path);

  const std::string& path() const { return path_; }
  const std::map<std::uint32_t, BagConnection>& connections() const { return connections_; }

  /// The size [bytes] of all chunks after decompression, according to their headers. Throws
  /// FileError when the bag is damaged.
  std::uint64_t unpackedSize();

  /// Calls `receive` for each message of the wanted connections, in order of recording. Throws
  /// FileError when the bag is damaged, and what `receive` throws.
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
  std::vector<std::uint64_t> chunks_;  // [bytes] positions in the file
};

}  // namespace uncertainty_identification
