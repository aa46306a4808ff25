#include <cstdint>
#include <cstring>

#include "export/named_array.h"
#include "export/targets.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;

// Data types and classes of the format ("MAT-File Level 5 File Format", MathWorks). Everything is
// little-endian, whatever the machine.
enum DataType : std::uint32_t { kInt8 = 1, kUint16 = 4, kInt32 = 5, kUint32 = 6, kDouble = 9 };
constexpr std::uint32_t kMatrix = 14, kCharClass = 4, kDoubleClass = 6, kComplexFlag = 0x800;

template <class Unsigned>
std::string bytesOf(Unsigned value) {
  std::string bytes;
  for (std::size_t k = 0; k < sizeof value; ++k)
    bytes += static_cast<char>(static_cast<unsigned char>(value >> (8 * k)));
  return bytes;
}

std::string bytesOf(double value) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  return bytesOf(bits);
}

/// A tag and the data, filled up to a multiple of 8 bytes.
std::string element(std::uint32_t type, const std::string& data) {
  return bytesOf(type) + bytesOf(static_cast<std::uint32_t>(data.size())) + data +
         std::string((8 - data.size() % 8) % 8, '\0');
}

std::string matrix(const std::string& name, std::uint32_t flags, Index rows, Index columns,
                   const std::string& data) {
  return element(kMatrix, element(kUint32, bytesOf(flags) + bytesOf(std::uint32_t{0})) +
                              element(kInt32, bytesOf(static_cast<std::uint32_t>(rows)) +
                                                  bytesOf(static_cast<std::uint32_t>(columns))) +
                              element(kInt8, name) + data);
}

std::string doubles(const Eigen::MatrixXd& values) {
  std::string data;
  data.reserve(8 * static_cast<std::size_t>(values.size()));
  for (Index k = 0; k < values.size(); ++k) data += bytesOf(values.data()[k]);
  return element(kDouble, data);
}

std::string matrixOf(const NamedArray& array) {
  const std::string data =
      doubles(array.values.real()) + (array.is_complex ? doubles(array.values.imag()) : "");
  return matrix(array.name, kDoubleClass | (array.is_complex ? kComplexFlag : 0),
                array.values.rows(), array.values.cols(), data);
}

std::string matrixOf(const std::string& name, const std::string& text) {
  std::string data;
  for (const char character : text)
    data += bytesOf(static_cast<std::uint16_t>(static_cast<unsigned char>(character)));
  return matrix(name, kCharClass, 1, static_cast<Index>(text.size()), element(kUint16, data));
}

}  // namespace

std::string matFile(const ExportedModel& model) {
  std::string header = "MATLAB 5.0 MAT-file, written by uncertainty_identification";
  header.resize(116, ' ');
  std::string file = header + std::string(8, '\0') + bytesOf(std::uint16_t{0x0100}) + "IM";
  std::string about;
  for (const std::string& line : model.about) about += line + " ";
  for (const std::string& line : model.missing) about += "Missing: " + line + ". ";
  file += matrixOf("about", about);
  for (const NamedArray& array : namedArrays(model)) file += matrixOf(array);
  return file;
}

}  // namespace uncertainty_identification
