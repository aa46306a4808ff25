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
  std::string type_name;    ///< as in the definition; for messages with the package's name
  std::size_t message = 0;  ///< for type message: index of its MessageType
  ArrayKind array = ArrayKind::none;
  std::uint32_t length = 0;  ///< for array fixed: number of elements

  bool numeric() const { return type != FieldType::string && type != FieldType::message; }
};

/// One message type: its fields in the order of serialisation, without constants.
struct MessageType {
  std::string name;  ///< package/Type
  std::vector<MessageField> fields;
  /// [bytes]; no value if it differs between messages of the type.
  std::optional<std::uint64_t> serialised_size;
};

/// A message definition as it is stored in bags and sent by publishers: the text of the type,
/// followed by the text of each contained type. Each of these begins with a line of equals signs
/// and a line "MSG: package/Type".
class MessageDefinition {
 public:
  /// Parses the text. Throws DataError, naming the type and the line, when it is not a message
  /// definition, is recursive, or uses a type that it does not define.
  MessageDefinition(const std::string& type_name, const std::string& text);

  const MessageType& root() const { return types_.front(); }
  const MessageType& contained(const MessageField& field) const { return types_[field.message]; }

  /// Serialised size [bytes] of one element of the field; no value if it differs between elements.
  std::optional<std::uint64_t> elementSize(const MessageField& field) const;

  /// Serialised size [bytes] of the whole field; no value if it differs between messages.
  std::optional<std::uint64_t> serialisedSize(const MessageField& field) const;

  /// Whether the message begins with a std_msgs/Header.
  bool hasHeader() const;

  /// Paths of the numeric fields, such as "pose.position.x". Arrays are listed with the index 0,
  /// such as "effort[0]". Fields of a std_msgs/Header are listed only if `with_headers` is true.
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
