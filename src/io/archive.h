#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "io/tree_values.h"
#include "uncertainty_identification/enum_names.h"

namespace uncertainty_identification {

/// Reads structs from a tree of keys and values, or writes them to one. A struct takes part by a
/// function in its namespace,
///   void bind(Archive& archive, Options& options) { archive("nb", options.nb); ... }
/// which serves both directions, so that each key is stated once. tree_values.h has wrappers for
/// values whose type alone does not say how they are written.
///
/// An archive stands at one node of its tree: enter() and enterEntry() go down to a child, leave()
/// goes back up, and the other virtual functions read or write the node itself.
class Archive {
 public:
  virtual ~Archive() = default;

  /// True when values are filled from the tree, false when they are written to it.
  virtual bool reads() const = 0;

  /// Reading: whether the key is there, whether its value is a list, and whether it is this word.
  /// Writing: none of these.
  virtual bool has(std::string_view key) const = 0;
  virtual bool hasList(std::string_view key) const = 0;
  virtual bool isWord(std::string_view key, const char* word) = 0;

  /// The whole document.
  template <class Value>
  void operator()(Value& value) {
    visit(value);
  }

  /// The value of a key. Reading a configuration leaves `value` as it is when the key is absent.
  template <class Value>
  void operator()(std::string_view key, Value&& value) {
    if (!enter(key, false)) return;
    visit(value);
    leave();
  }

  template <class Value>
  void operator()(std::string_view key, WhenPresent<Value> value) {
    if (!reads() && !value.value) return;
    if (!enter(key, true)) return;
    visit(reads() ? value.value.emplace() : *value.value);
    leave();
  }

  /// A key that records of older versions lack: reading leaves `value` as it is then.
  template <class Value>
  void ifThere(std::string_view key, Value&& value) {
    if (!reads() || has(key)) (*this)(key, std::forward<Value>(value));
  }

  /// Keys that stand one level deeper without a struct of their own.
  template <class Body>
  void section(std::string_view key, Body&& body) {
    if (!enter(key, false)) return;
    beginGroup(false);
    body(*this);
    endGroup();
    leave();
  }

 protected:
  /// Goes to the value of a key; false, staying where it is, when the key is absent. Whether an
  /// absent key is an error depends on the archive, unless the key is optional.
  virtual bool enter(std::string_view key, bool optional) = 0;
  virtual void enterEntry(std::size_t index) = 0;
  virtual void leave() = 0;

  /// A group of keys. `defaults`: absent keys keep their defaults, whatever the rule was so far.
  virtual void beginGroup(bool defaults) = 0;
  virtual void endGroup() = 0;

  /// A list; takes the number of entries to write and returns the number to visit.
  virtual std::size_t beginList(std::size_t size) = 0;

  /// A group whose keys are not known beforehand; returns those found when reading.
  virtual std::vector<std::string> beginMap() = 0;

  // Questions about a value that may be written in two ways. A writer takes the answer and writes
  // `auto` or null; a reader finds the answer in the tree.
  virtual bool isAutomatic(bool automatic) = 0;
  virtual bool isNull(bool null) = 0;
  virtual bool isSingle(bool single) = 0;  ///< a value without brackets instead of a list

  /// One of a few words, by its index.
  virtual std::size_t visitWord(const std::vector<std::string>& words, std::size_t chosen) = 0;

  virtual void visit(double& value) = 0;
  virtual void visit(int& value) = 0;
  virtual void visit(long& value) = 0;
  virtual void visit(std::uint64_t& value) = 0;
  virtual void visit(bool& value) = 0;
  virtual void visit(std::string& value) = 0;
  virtual void visit(Eigen::VectorXd& value) = 0;
  virtual void visit(Eigen::MatrixXd& value) = 0;
  virtual void visit(Word& value) = 0;
  virtual void visit(OrAutomatic<int>& value) = 0;
  virtual void visit(OrAutomatic<double>& value) = 0;

  template <class Value>
  void visit(std::map<std::string, Value>& values) {
    const std::vector<std::string> found = beginMap();
    if (reads()) {
      values.clear();
      for (const std::string& key : found) values.emplace(key, Value());
    }
    for (auto& [key, value] : values) (*this)(key, value);
  }

  template <class Value>
  void visit(std::optional<Value>& value) {
    if (isAutomatic(!value.has_value())) return value.reset();
    visit(reads() ? value.emplace() : *value);
  }

  template <class Value>
  void visit(OrNull<Value>& value) {
    if (isNull(!value.value.has_value())) return value.value.reset();
    visit(reads() ? value.value.emplace() : *value.value);
  }

  template <class Value>
  void visit(OneOf<Value>& value) {
    std::vector<std::string> words;
    std::size_t chosen = value.names.size();
    for (const auto& [candidate, word] : value.names) {
      if (candidate == value.value) chosen = words.size();
      words.push_back(word);
    }
    value.value = value.names[visitWord(words, chosen)].first;
  }

  template <class Value>
  void visit(OneOrMany<Value>& value) {
    if (!isSingle(value.values.size() == 1)) return visit(value.values);
    value.values.resize(1);
    visit(value.values.front());
  }

  template <class Value>
  void visit(WithDefaults<Value>& value) {
    visitGroup(value.value, true);
  }

  template <class Value>
  void visit(std::vector<Value>& values) {
    const std::size_t count = beginList(values.size());
    if (reads()) values.assign(count, Value());
    for (std::size_t i = 0; i < count; ++i) {
      enterEntry(i);
      visit(values[i]);
      leave();
    }
  }

  /// An enumeration, or a struct with a bind() function.
  template <class Value>
  void visit(Value& value) {
    if constexpr (std::is_enum_v<Value>) {
      OneOf<Value> words{value, enumNames(value)};
      visit(words);
    } else {
      visitGroup(value, false);
    }
  }

 private:
  template <class Value>
  void visitGroup(Value& value, bool defaults) {
    beginGroup(defaults);
    bind(*this, value);
    endGroup();
  }
};

}  // namespace uncertainty_identification
