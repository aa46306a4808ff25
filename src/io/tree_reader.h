#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "io/tree.h"
#include "io/tree_values.h"
#include "uncertainty_identification/enum_names.h"

namespace uncertainty_identification {

/// How TreeReader treats what a document leaves out or adds.
enum class ReadingRule {
  configuration,  ///< an absent key keeps its default, an unknown key is an error
  record  ///< an absent key is an error (truncated), an unknown one is ignored (newer), null is NaN
};

/// Fills structs from a tree. A struct takes part by a function, found by its argument's namespace,
///   template <class Archive> void bind(Archive& archive, Options& options) { archive("nb",
///   options.nb); ... }
/// which TreeWriter uses as well, so that each key is stated once. Every error is a
/// ConfigurationError that names the key's path, its line where known, what was found and what is
/// expected.
class TreeReader {
 public:
  static constexpr bool kReads = true;

  TreeReader(const nlohmann::json& node, const std::map<std::string, int>& lines, ReadingRule rule,
             std::string path = "");

  /// Reads the key's value, if it is there, into `value`.
  template <class Value>
  void operator()(const std::string& key, Value&& value) {
    if (const nlohmann::json* node = find(key)) read(*node, pathOf(path_, key), value);
  }

  /// The same for a value that any document may leave out.
  template <class Value>
  void operator()(const std::string& key, WhenPresent<Value> value) {
    keys_.push_back(key);
    const auto found = node_.find(key);
    if (found != node_.end()) read(*found, pathOf(path_, key), value);
  }

  /// Reads keys that stand one level deeper without a struct of their own.
  template <class Body>
  void section(const std::string& key, Body&& body) {
    const nlohmann::json* node = find(key);
    if (node == nullptr) return;
    TreeReader inner(*node, lines_, rule_, pathOf(path_, key));
    body(inner);
    inner.finish();
  }

  /// Throws for the first key that was not asked for, naming the nearest that was (configuration
  /// only).
  void finish() const;

 private:
  using Json = nlohmann::json;

  const Json* find(const std::string& key);
  [[noreturn]] void fail(const Json& node, const std::string& path,
                         const std::string& expected) const;
  void requireList(const Json& node, const std::string& path) const;
  double number(const Json& node, const std::string& path, const std::string& expected) const;
  std::int64_t integer(const Json& node, const std::string& path,
                       const std::string& expected) const;

  void read(const Json& node, const std::string& path, double& value) const;
  void read(const Json& node, const std::string& path, int& value) const;
  void read(const Json& node, const std::string& path, long& value) const;
  void read(const Json& node, const std::string& path, std::uint64_t& value) const;
  void read(const Json& node, const std::string& path, bool& value) const;
  void read(const Json& node, const std::string& path, std::string& value) const;
  void read(const Json& node, const std::string& path, Eigen::VectorXd& value) const;
  void read(const Json& node, const std::string& path, Eigen::MatrixXd& value) const;
  void read(const Json& node, const std::string& path, Word& value) const;

  template <class Value>
  void read(const Json& node, const std::string& path, OrAutomatic<Value>& value) const {
    if (node == Json("auto")) {
      value.value = value.automatic;
      return;
    }
    const std::string expected =
        std::string(std::is_integral<Value>() ? "a whole number" : "a number") + " or auto";
    const double found = std::is_integral<Value>()
                             ? static_cast<double>(integer(node, path, expected))
                             : number(node, path, expected);
    value.value = static_cast<Value>(found);
    if (value.value == value.automatic) fail(node, path, expected);
  }

  template <class Value>
  void read(const Json& node, const std::string& path, std::optional<Value>& value) const {
    value.reset();
    if (node == Json("auto")) return;
    read(node, path, value.emplace());
  }

  template <class Value>
  void read(const Json& node, const std::string& path, OrNull<Value>& value) const {
    value.value.reset();
    if (!node.is_null()) read(node, path, value.value.emplace());
  }

  template <class Value>
  void read(const Json& node, const std::string& path, OneOf<Value>& value) const {
    std::string words;
    for (const auto& [candidate, name] : value.names) {
      if (node == Json(name)) {
        value.value = candidate;
        return;
      }
      words += (words.empty() ? "" : ", ") + name;
    }
    fail(node, path, (value.names.size() > 1 ? "one of " : "") + words);
  }

  template <class Value>
  void read(const Json& node, const std::string& path, OneOrMany<Value>& value) const {
    if (node.is_array()) return read(node, path, value.values);
    value.values.resize(1);
    read(node, path, value.values.front());
  }

  template <class Value>
  void read(const Json& node, const std::string& path, WhenPresent<Value>& value) const {
    read(node, path, value.value.emplace());
  }

  template <class Value>
  void read(const Json& node, const std::string& path, WithDefaults<Value>& value) const {
    TreeReader inner(node, lines_, ReadingRule::configuration, path);
    bind(inner, value.value);
    inner.finish();
  }

  template <class Value>
  void read(const Json& node, const std::string& path, std::vector<Value>& value) const {
    requireList(node, path);
    value.assign(node.size(), Value());
    for (std::size_t i = 0; i < node.size(); ++i) read(node[i], pathOf(path, i), value[i]);
  }

  template <class Value>
  void read(const Json& node, const std::string& path, std::map<std::string, Value>& value) const {
    if (!node.is_object()) fail(node, path, "keys with values");
    value.clear();
    for (const auto& [key, entry] : node.items()) read(entry, pathOf(path, key), value[key]);
  }

  template <class Value>
  void read(const Json& node, const std::string& path, Value& value) const {
    if constexpr (std::is_enum_v<Value>) {
      OneOf<Value> words{value, enumNames(value)};
      read(node, path, words);
    } else {
      TreeReader inner(node, lines_, rule_, path);
      bind(inner, value);
      inner.finish();
    }
  }

  const Json& node_;
  const std::map<std::string, int>& lines_;
  ReadingRule rule_;
  std::string path_;
  std::vector<std::string> keys_;
};

}  // namespace uncertainty_identification
