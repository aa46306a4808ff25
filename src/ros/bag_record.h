#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "ros/byte_reader.h"

/// The records that a bag of format 2.0 consists of (wiki.ros.org/Bags/Format/2.0).
namespace uncertainty_identification {

enum class BagOperation : std::uint8_t {
  message = 0x02,
  file_header = 0x03,
  index = 0x04,
  chunk = 0x05,
  chunk_info = 0x06,
  connection = 0x07
};

/// The fields "name=value" in the header of a record. Refers to the bytes, which must live longer.
class BagHeader {
 public:
  explicit BagHeader(SerialisedMessage bytes) : bytes_(bytes) {}

  /// Throws DataError when the field is missing.
  std::string_view text(std::string_view name) const {
    const auto value = find(name);
    if (value.data() == nullptr)
      throw DataError("a record lacks the field '" + std::string(name) + "'");
    return value;
  }

  std::string_view textOr(std::string_view name, std::string_view otherwise) const {
    const auto value = find(name);
    return value.data() == nullptr ? otherwise : value;
  }

  /// The field as a number of type T. Throws DataError when it is missing or has another size.
  template <typename T>
  T number(std::string_view name) const {
    const auto value = text(name);
    if (value.size() != sizeof(T))
      throw DataError("field '" + std::string(name) + "' of a record has a wrong size");
    return ByteReader({reinterpret_cast<const std::uint8_t*>(value.data()), value.size()})
        .read<T>();
  }

  BagOperation operation() const { return BagOperation{number<std::uint8_t>("op")}; }

 private:
  /// A view whose data() is null when there is no such field.
  std::string_view find(std::string_view name) const {
    ByteReader reader(bytes_);
    while (!reader.atEnd()) {
      const auto bytes = reader.take(reader.read<std::uint32_t>());
      const std::string_view field(reinterpret_cast<const char*>(bytes.data), bytes.size);
      if (field.size() > name.size() && field[name.size()] == '=' &&
          field.compare(0, name.size(), name) == 0)
        return field.substr(name.size() + 1);
    }
    return {};
  }

  SerialisedMessage bytes_;
};

/// One record: its header, and its data.
struct BagRecord {
  BagHeader header;
  SerialisedMessage data;
};

/// Reads the next record. Throws DataError when its lengths exceed the bytes that are left.
inline BagRecord readRecord(ByteReader& reader) {
  const BagHeader header(reader.take(reader.read<std::uint32_t>()));
  return {header, reader.take(reader.read<std::uint32_t>())};
}

}  // namespace uncertainty_identification
