#include "ros/decompress.h"

#include <bzlib.h>
#include <roslz4/lz4s.h>

#include <string>

#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

// [bytes] Chunks have about 1 MB; a larger size than this must be an error or an attack.
constexpr std::uint32_t kLargest = 1U << 30;

/// Both libraries take a char*, although they do not change the data.
char* mutableText(SerialisedMessage data) {
  return const_cast<char*>(reinterpret_cast<const char*>(data.data));
}

bool unpackBz2(SerialisedMessage data, std::vector<std::uint8_t>& content) {
  auto size = static_cast<unsigned int>(content.size());
  const int result =
      BZ2_bzBuffToBuffDecompress(reinterpret_cast<char*>(content.data()), &size, mutableText(data),
                                 static_cast<unsigned int>(data.size), 0, 0);
  return result == BZ_OK && size == content.size();
}

bool unpackLz4(SerialisedMessage data, std::vector<std::uint8_t>& content) {
  auto size = static_cast<unsigned int>(content.size());
  const int result =
      roslz4_buffToBuffDecompress(mutableText(data), static_cast<unsigned int>(data.size),
                                  reinterpret_cast<char*>(content.data()), &size);
  return result == ROSLZ4_OK && size == content.size();
}

}  // namespace

std::vector<std::uint8_t> decompress(std::string_view compression, SerialisedMessage data,
                                     std::uint32_t size) {
  if (compression == "none" && data.size == size) return {data.data, data.data + data.size};
  if (size > kLargest)
    throw DataError("a chunk of " + std::to_string(size) + " bytes is too large");
  std::vector<std::uint8_t> content(size);
  if (compression == "bz2" && unpackBz2(data, content)) return content;
  if (compression == "lz4" && unpackLz4(data, content)) return content;
  throw DataError("a chunk of compression '" + std::string(compression) + "' cannot be unpacked");
}

}  // namespace uncertainty_identification
