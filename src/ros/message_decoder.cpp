#include "ros/message_decoder.h"

#include <algorithm>
#include <cstring>

#include "io/printable.h"
#include "ros/byte_reader.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

double readSeconds(ByteReader& reader, bool is_signed) {
  if (is_signed) {
    const auto seconds = reader.read<std::int32_t>();
    return seconds + 1e-9 * reader.read<std::int32_t>();
  }
  const auto seconds = reader.read<std::uint32_t>();
  return seconds + 1e-9 * reader.read<std::uint32_t>();
}

double readNumber(ByteReader& reader, FieldType type) {
  switch (type) {
    case FieldType::boolean:
      return reader.read<std::uint8_t>() != 0 ? 1 : 0;
    case FieldType::int8:
      return reader.read<std::int8_t>();
    case FieldType::uint8:
      return reader.read<std::uint8_t>();
    case FieldType::int16:
      return reader.read<std::int16_t>();
    case FieldType::uint16:
      return reader.read<std::uint16_t>();
    case FieldType::int32:
      return reader.read<std::int32_t>();
    case FieldType::uint32:
      return reader.read<std::uint32_t>();
    case FieldType::int64:
      return static_cast<double>(reader.read<std::int64_t>());
    case FieldType::uint64:
      return static_cast<double>(reader.read<std::uint64_t>());
    case FieldType::float32:
      return reader.read<float>();
    case FieldType::float64:
      return reader.read<double>();
    case FieldType::time:
      return readSeconds(reader, false);
    case FieldType::duration:
      return readSeconds(reader, true);
    case FieldType::string:
    case FieldType::message:
      break;
  }
  throw DataError("a field that is not numeric was read");
}

void skipField(ByteReader& reader, const MessageDefinition& definition, const MessageField& field);

// Skips `count` elements. Each element of varying size has at least four bytes (a length), so a
// count that exceeds the message fails at the message's end and cannot loop for long.
void skipElements(ByteReader& reader, const MessageDefinition& definition,
                  const MessageField& field, std::uint32_t count) {
  if (const auto size = definition.elementSize(field)) return reader.skip(*size * count);
  for (std::uint32_t i = 0; i < count; ++i) {
    if (field.type == FieldType::string) {
      reader.skip(reader.read<std::uint32_t>());
    } else {
      for (const auto& part : definition.contained(field).fields)
        skipField(reader, definition, part);
    }
  }
}

void skipField(ByteReader& reader, const MessageDefinition& definition, const MessageField& field) {
  if (const auto size = definition.serialisedSize(field)) return reader.skip(*size);
  switch (field.array) {
    case ArrayKind::none:
      return skipElements(reader, definition, field, 1);
    case ArrayKind::fixed:
      return skipElements(reader, definition, field, field.length);
    case ArrayKind::variable:
      return skipElements(reader, definition, field, reader.read<std::uint32_t>());
  }
}

/// A reader in front of a field, made of one at the beginning of the message.
ByteReader atField(ByteReader reader, const MessageDefinition& definition, const MessageType& type,
                   std::size_t field) {
  for (std::size_t i = 0; i < field; ++i) skipField(reader, definition, type.fields[i]);
  return reader;
}

/// The list of texts in front of which the reader is.
std::vector<std::string> readNames(ByteReader reader) {
  const auto count = reader.read<std::uint32_t>();
  std::vector<std::string> names;
  for (std::uint32_t i = 0; i < count; ++i) {
    const SerialisedMessage text = reader.take(reader.read<std::uint32_t>());
    names.emplace_back(reinterpret_cast<const char*>(text.data), text.size);
  }
  return names;
}

constexpr std::size_t kListed = 15;  // number of names that an error message lists

[[noreturn]] void refuseName(const std::string& path, const std::string& element,
                             const std::vector<std::string>& names) {
  std::string list;
  for (std::size_t i = 0; i < std::min(kListed, names.size()); ++i)
    list += (i == 0 ? "'" : ", '") + printable(names[i]) + "'";
  if (names.size() > kListed) list += " and " + std::to_string(names.size() - kListed) + " more";
  throw DataError("field '" + path + "': the message names no '" + element + "'" +
                  (names.empty() ? ", as its list 'name' is empty" : "; its names are " + list));
}

/// The place of the element that the message calls so, of as many as the array has. The reader is
/// in front of the names.
std::uint32_t placeOf(const FieldStep& step, ByteReader reader, std::uint32_t length,
                      const std::string& path) {
  const ByteReader at_names = reader;
  const auto count = reader.read<std::uint32_t>();
  if (count != length)
    throw DataError("field '" + path + "': the message has " + std::to_string(count) +
                    " names for " + std::to_string(length) +
                    " elements, so that none can be told by its name; the publisher must fill "
                    "both lists");
  for (std::uint32_t i = 0; i < count; ++i) {
    const SerialisedMessage text = reader.take(reader.read<std::uint32_t>());
    if (text.size == step.element.size() &&
        std::memcmp(text.data, step.element.data(), text.size) == 0)
      return i;
  }
  refuseName(path, step.element, readNames(at_names));
}

}  // namespace

void requireComplete(const MessageDefinition& definition, SerialisedMessage message) {
  ByteReader reader(message);
  for (const auto& field : definition.root().fields) skipField(reader, definition, field);
}

MessageDecoder::MessageDecoder(std::shared_ptr<const MessageDefinition> definition,
                               const std::string& path, const std::string& topic)
    : definition_(std::move(definition)), path_(resolveFieldPath(*definition_, path, topic)) {}

double MessageDecoder::value(SerialisedMessage message) const {
  ByteReader reader(message);
  const MessageType* type = &definition_->root();
  for (const auto& step : path_.steps) {
    const ByteReader beginning = reader;
    reader = atField(reader, *definition_, *type, step.field);
    const MessageField& field = type->fields[step.field];
    if (field.array != ArrayKind::none) {
      const auto length =
          field.array == ArrayKind::fixed ? field.length : reader.read<std::uint32_t>();
      const std::uint32_t index =
          step.element.empty() ? step.index
                               : placeOf(step, atField(beginning, *definition_, *type, step.names),
                                         length, path_.text);
      if (index >= length)
        throw DataError("field '" + path_.text + "': the message has only " +
                        std::to_string(length) + " elements of '" + field.name + "'");
      skipElements(reader, *definition_, field, index);
    }
    if (field.type != FieldType::message) return readNumber(reader, field.type);
    type = &definition_->contained(field);
  }
  throw DataError("field '" + path_.text + "' is not a number");
}

std::vector<std::string> MessageDecoder::elementNames(SerialisedMessage message) const {
  ByteReader reader(message);
  const MessageType* type = &definition_->root();
  for (const auto& step : path_.steps) {
    const MessageField& field = type->fields[step.field];
    if (const auto names = namesField(*type); names && field.array != ArrayKind::none)
      return readNames(atField(reader, *definition_, *type, *names));
    if (field.type != FieldType::message || field.array != ArrayKind::none) return {};
    reader = atField(reader, *definition_, *type, step.field);
    type = &definition_->contained(field);
  }
  return {};
}

std::uint32_t MessageDecoder::sequence(SerialisedMessage message) const {
  return ByteReader(message).read<std::uint32_t>();
}

double MessageDecoder::stamp(SerialisedMessage message) const {
  ByteReader reader(message);
  reader.skip(4);  // seq
  return readSeconds(reader, false);
}

}  // namespace uncertainty_identification
