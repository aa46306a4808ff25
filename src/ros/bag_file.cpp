#include "ros/bag_file.h"

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "ros/decompress.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

constexpr char kMagic[] = "#ROSBAG V2.0\n";
constexpr std::uint64_t kMagicSize = sizeof(kMagic) - 1;

SerialisedMessage view(const std::vector<std::uint8_t>& bytes) {
  return {bytes.data(), bytes.size()};
}

std::string absoluteTopic(std::string_view topic) {
  return (topic.empty() || topic.front() != '/' ? "/" : "") + std::string(topic);
}

[[noreturn]] void damaged(const std::string& path, const std::string& finding) {
  throw FileError("bag '" + path + "' is damaged: " + finding +
                  "; copy or record it again, or try 'rosbag reindex' and 'rosbag fix'");
}

/// Converts a stamp to nanoseconds. Headers of records hold the seconds in the lower and the
/// nanoseconds in the upper 32 bits.
std::uint64_t nanoseconds(std::uint64_t stamp) {
  return (stamp & 0xffffffffU) * 1000000000U + (stamp >> 32U);
}

}  // namespace

template <typename Action>
auto BagFile::orDamaged(const Action& action) {
  try {
    return action();
  } catch (const DataError& error) {
    damaged(path_, error.what());
  }
}

BagFile::BagFile(const std::string& path) : path_(path) {
  errno = 0;
  file_.open(path, std::ios::binary | std::ios::ate);
  const auto end = file_.tellg();
  file_.seekg(0);
  if (!file_ || end < 0 || (file_.peek() == std::ifstream::traits_type::eof() && errno != 0))
    throw FileError("cannot read bag '" + path + "': " + std::strerror(errno));
  size_ = static_cast<std::uint64_t>(end);
  orDamaged([this] { readIndex(readFileHeader()); });
}

std::vector<std::uint8_t> BagFile::bytesAt(std::uint64_t position, std::uint64_t count) {
  if (position > size_ || count > size_ - position)
    throw DataError("it ends too early; was its recording or copying interrupted?");
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(count));
  file_.clear();
  file_.seekg(static_cast<std::streamoff>(position));
  file_.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(count));
  if (!file_) throw DataError("it cannot be read to its end");
  return bytes;
}

std::uint32_t BagFile::lengthAt(std::uint64_t position) {
  return ByteReader(view(bytesAt(position, 4))).read<std::uint32_t>();
}

std::vector<std::uint8_t> BagFile::recordAt(std::uint64_t position) {
  const std::uint64_t header = 4 + std::uint64_t{lengthAt(position)};
  return bytesAt(position, header + 4 + lengthAt(position + header));
}

/// Checks the beginning of the file and returns the position of the index.
std::uint64_t BagFile::readFileHeader() {
  const std::vector<std::uint8_t> start = bytesAt(0, std::min(size_, kMagicSize));
  if (start.empty()) throw FileError("cannot read bag '" + path_ + "': the file is empty");
  if (std::string(start.begin(), start.end()) != kMagic)
    throw FileError(
        "'" + path_ +
        "' is not a ROS bag of format 2.0; convert bags of older formats by 'rosbag fix'");
  const auto bytes = recordAt(kMagicSize);
  ByteReader reader(view(bytes));
  const BagHeader header = readRecord(reader).header;
  if (!header.textOr("encryptor", "").empty())
    throw FileError("bag '" + path_ + "' is encrypted; decrypt it with 'rosbag decompress' first");
  const auto index = header.number<std::uint64_t>("index_pos");
  if (index == 0)
    throw FileError("bag '" + path_ +
                    "' has no index because its recording was interrupted; run 'rosbag reindex " +
                    path_ + "' first");
  return index;
}

void BagFile::readIndex(std::uint64_t position) {
  const auto bytes = bytesAt(position, position > size_ ? 1 : size_ - position);
  ByteReader reader(view(bytes));
  while (!reader.atEnd()) {
    const BagRecord record = readRecord(reader);
    if (record.header.operation() == BagOperation::connection) addConnection(record);
    if (record.header.operation() == BagOperation::chunk_info)
      chunks_.push_back(record.header.number<std::uint64_t>("chunk_pos"));
  }
}

void BagFile::addConnection(const BagRecord& record) {
  const BagHeader fields(record.data);
  connections_[record.header.number<std::uint32_t>("conn")] = {
      absoluteTopic(record.header.text("topic")), std::string(fields.text("type")),
      std::string(fields.text("md5sum")), std::string(fields.text("message_definition")),
      std::string(fields.textOr("callerid", ""))};
}

std::vector<std::uint8_t> BagFile::chunkContent(std::size_t chunk) {
  const auto bytes = recordAt(chunks_[chunk]);
  ByteReader reader(view(bytes));
  const BagRecord record = readRecord(reader);
  if (record.header.operation() != BagOperation::chunk)
    throw DataError("its index is wrong (no chunk at byte " + std::to_string(chunks_[chunk]) + ")");
  return decompress(record.header.text("compression"), record.data,
                    record.header.number<std::uint32_t>("size"));
}

std::vector<BagFile::Entry> BagFile::listEntries(
    const std::function<bool(const BagConnection&)>& wanted) {
  std::vector<Entry> entries;
  for (std::size_t chunk = 0; chunk < chunks_.size(); ++chunk) {
    const auto content = chunkContent(chunk);
    ByteReader reader(view(content));
    while (!reader.atEnd()) {
      const auto offset = static_cast<std::uint32_t>(reader.position());
      const BagHeader header = readRecord(reader).header;
      if (header.operation() != BagOperation::message) continue;
      const auto connection = connections_.find(header.number<std::uint32_t>("conn"));
      if (connection == connections_.end())
        throw DataError("a message refers to a connection that the bag does not have");
      if (wanted(connection->second))
        entries.push_back({nanoseconds(header.number<std::uint64_t>("time")),
                           static_cast<std::uint32_t>(chunk), offset, connection->first});
    }
  }
  return entries;
}

BagMessage BagFile::messageAt(const Entry& entry, const std::vector<std::uint8_t>& content) const {
  ByteReader reader(view(content));
  reader.skip(entry.offset);
  const BagRecord record = readRecord(reader);
  const auto stamp = record.header.number<std::uint64_t>("time");
  return {connections_.at(entry.connection), record.data,
          static_cast<double>(stamp & 0xffffffffU) + 1e-9 * static_cast<double>(stamp >> 32U)};
}

std::uint64_t BagFile::unpackedSize() {
  return orDamaged([this] {
    std::uint64_t size = 0;
    for (const std::uint64_t position : chunks_) {
      const auto bytes = bytesAt(position + 4, lengthAt(position));
      size += BagHeader(view(bytes)).number<std::uint32_t>("size");
    }
    return size;
  });
}

void BagFile::read(const std::function<bool(const BagConnection&)>& wanted,
                   const std::function<void(const BagMessage&)>& receive) {
  auto entries = orDamaged([&] { return listEntries(wanted); });
  std::stable_sort(entries.begin(), entries.end(),
                   [](const Entry& a, const Entry& b) { return a.time < b.time; });
  std::size_t loaded = chunks_.size();
  std::vector<std::uint8_t> content;
  for (const Entry& entry : entries) {
    const BagMessage message = orDamaged([&] {
      if (entry.chunk != loaded) content = chunkContent(entry.chunk);
      loaded = entry.chunk;
      return messageAt(entry, content);
    });
    receive(message);
  }
}

}  // namespace uncertainty_identification
