#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace uncertainty_identification {

/// Types of the fields of a ROS message; `byte` is int8, `char` is uint8.
enum class FieldType {
  boolean,
  int8,
  uint8,
  int16,
  uint16,
  int32,
  uint32,
  int64,
  uint64,
  float32,
  float64,
  time,
  duration,
  string,
  message
};

enum class ArrayKind { none, fixed, variable };

/// Serialised size [bytes] of a builtin type; nothing for string and message.
std::optional<std::uint64_t> builtinSize(FieldType type);

/// One field of a message, as its definition declares it.
struct MessageField {
  std::string name;
  FieldType type = FieldType::message;
  std::string type_name;    ///< as written; of messages with the package
  std::size_t message = 0;  ///< type message: index of its MessageType
  ArrayKind array = ArrayKind::none;
  std::uint32_t length = 0;  ///< array fixed: number of elements

  bool numeric() const { return type != FieldType::string && type != FieldType::message; }
};

/// One message type: its fields in the order of serialisation, constants left out.
struct MessageType {
  std::string name;  ///< package/Type
  std::vector<MessageField> fields;
  std::optional<std::uint64_t>
      serialised_size;  ///< [bytes] where all messages of the type have the same
};

/// A message definition as bags and connections carry it: the text of the type, then that of each
/// type it contains below a line of equals signs and "MSG: package/Type".
class MessageDefinition {
 public:
  /// Parses the text. Throws DataError, naming the type and the line, where it is not a message
  /// definition, is recursive, or names a type that it does not contain.
  MessageDefinition(const std::string& type_name, const std::string& text);

  const MessageType& root() const { return types_.front(); }
  const MessageType& contained(const MessageField& field) const { return types_[field.message]; }

  /// Serialised size [bytes] of one element of the field, where all have the same.
  std::optional<std::uint64_t> elementSize(const MessageField& field) const;

  /// Serialised size [bytes] of the whole field, where all have the same.
  std::optional<std::uint64_t> serialisedSize(const MessageField& field) const;

  /// Whether the message begins with a std_msgs/Header.
  bool hasHeader() const;

  /// Paths of the numeric fields, "pose.position.x", arrays with index 0, "effort[0]". Those of a
  /// std_msgs/Header only on demand.
  std::vector<std::string> numericFields(bool with_headers) const;

 private:
  void parseBlocks(const std::string& text);
  void parseLine(const std::string& line, MessageType& type);
  void resolveTypes();
  std::size_t findType(const std::string& name, const std::string& package) const;
  void measure(std::size_t type, std::vector<int>& state, int depth);
  void listNumericFields(const MessageType& type, const std::string& prefix, bool with_headers,
                         std::vector<std::string>& paths, std::size_t& budget) const;

  std::vector<MessageType> types_;  ///< the root first
};

}  // namespace uncertainty_identification
