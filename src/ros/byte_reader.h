#pragma once

#include <cstdint>
#include <cstring>
#include <string>

#include "ros/message_decoder.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {

/// Reads serialised bytes from front to back. Throws DataError instead of reading beyond their end.
class ByteReader {
 public:
  explicit ByteReader(SerialisedMessage bytes) : bytes_(bytes) {}

  bool atEnd() const { return position_ == bytes_.size; }
  std::size_t position() const { return position_; }

  /// Returns the next `count` bytes and moves behind them.
  SerialisedMessage take(std::uint64_t count) {
    if (count > bytes_.size - position_)
      throw DataError("there are only " + std::to_string(bytes_.size) +
                      " bytes, fewer than the lengths in them need");
    const SerialisedMessage taken{bytes_.data + position_, static_cast<std::size_t>(count)};
    position_ += taken.size;
    return taken;
  }

  void skip(std::uint64_t count) { take(count); }

  template <typename T>
  T read() {
    T value;
    std::memcpy(&value, take(sizeof(T)).data, sizeof(T));
    return value;
  }

 private:
  SerialisedMessage bytes_;
  std::size_t position_ = 0;
};

}  // namespace uncertainty_identification
