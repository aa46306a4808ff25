#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace uncertainty_identification {

/// Wrappers that tell TreeReader and TreeWriter how a value is written where its type alone does
/// not.

/// A number, or the word `auto`, which stands for `automatic`.
template <class Value>
struct OrAutomatic {
  Value& value;
  Value automatic;
};

template <class Value>
OrAutomatic<Value> orAutomatic(Value& value, Value automatic) {
  return {value, automatic};
}

/// A value that may be missing: null where there is none.
template <class Value>
struct OrNull {
  std::optional<Value>& value;
};

template <class Value>
OrNull<Value> orNull(std::optional<Value>& value) {
  return {value};
}

/// One of a few words, each for a value.
template <class Value>
struct OneOf {
  Value& value;
  std::vector<std::pair<Value, std::string>> names;
};

template <class Value>
OneOf<Value> oneOf(Value& value, std::vector<std::pair<Value, std::string>> names) {
  return {value, std::move(names)};
}

/// A single value, or a list of them; one value reads and writes without brackets.
template <class Value>
struct OneOrMany {
  std::vector<Value>& values;
};

template <class Value>
OneOrMany<Value> oneOrMany(std::vector<Value>& values) {
  return {values};
}

/// A struct that may be absent: without its key it is, and a key without a value gives it its
/// defaults.
template <class Value>
struct WhenPresent {
  std::optional<Value>& value;
};

template <class Value>
WhenPresent<Value> whenPresent(std::optional<Value>& value) {
  return {value};
}

/// A struct of options inside a record: what an older version left out has its default, an unknown
/// key is an error.
template <class Value>
struct WithDefaults {
  Value& value;
};

template <class Value>
WithDefaults<Value> withDefaults(Value& value) {
  return {value};
}

/// A fixed word that must be there, such as a format's name.
struct Word {
  std::string word;
};

}  // namespace uncertainty_identification
