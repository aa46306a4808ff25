#pragma once

#include <Eigen/Core>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "io/tree_values.h"
#include "uncertainty_identification/enum_names.h"

namespace uncertainty_identification {

/// Writes structs to a tree through the bind() functions that TreeReader reads them with. Numbers
/// that are not finite become null; what is `auto` is written so.
class TreeWriter {
 public:
  static constexpr bool kReads = false;

  template <class Value>
  void operator()(const std::string& key, const Value& value) {
    tree_[key] = write(value);
  }

  template <class Value>
  void operator()(const std::string& key, const WhenPresent<Value>& value) {
    if (value.value) tree_[key] = write(*value.value);
  }

  template <class Body>
  void section(const std::string& key, Body&& body) {
    TreeWriter inner;
    body(inner);
    tree_[key] = inner.tree();
  }

  const nlohmann::json& tree() const { return tree_; }

 private:
  using Json = nlohmann::json;

  static Json write(double value) { return std::isfinite(value) ? Json(value) : Json(); }
  static Json write(const std::string& value) { return value; }
  static Json write(const Word& value) { return value.word; }

  static Json write(const Eigen::VectorXd& value) {
    return write(std::vector<double>(value.data(), value.data() + value.size()));
  }

  static Json write(const Eigen::MatrixXd& value) {
    Json rows = Json::array();
    for (Eigen::Index i = 0; i < value.rows(); ++i)
      rows.push_back(write(Eigen::VectorXd(value.row(i))));
    return rows;
  }

  template <class Value>
  static Json write(const OrAutomatic<Value>& value) {
    return value.value == value.automatic ? Json("auto") : Json(value.value);
  }

  template <class Value>
  static Json write(const std::optional<Value>& value) {
    return value ? write(*value) : Json("auto");
  }

  template <class Value>
  static Json write(const OrNull<Value>& value) {
    return value.value ? write(*value.value) : Json();
  }

  template <class Value>
  static Json write(const OneOf<Value>& value) {
    for (const auto& [candidate, name] : value.names) {
      if (candidate == value.value) return name;
    }
    throw std::invalid_argument("a value without a word for it");
  }

  template <class Value>
  static Json write(const OneOrMany<Value>& value) {
    return value.values.size() == 1 ? write(value.values.front()) : write(value.values);
  }

  template <class Value>
  static Json write(const WithDefaults<Value>& value) {
    return write(value.value);
  }

  template <class Value>
  static Json write(const std::map<std::string, Value>& value) {
    Json object = Json::object();
    for (const auto& [key, entry] : value) object[key] = write(entry);
    return object;
  }

  template <class Value>
  static Json write(const std::vector<Value>& value) {
    Json array = Json::array();
    for (const Value& entry : value) array.push_back(write(entry));
    return array;
  }

  // Whole numbers, truth values, enumerations, and structs with a bind() of their own.
  template <class Value>
  static Json write(const Value& value) {
    if constexpr (std::is_enum_v<Value>) {
      return nameOf(value);
    } else if constexpr (std::is_arithmetic_v<Value>) {
      return value;
    } else {
      TreeWriter inner;
      Value copy = value;  // bind() serves the reader too, so it takes what it may change
      bind(inner, copy);
      return inner.tree();
    }
  }

  nlohmann::json tree_ = nlohmann::json::object();
};

}  // namespace uncertainty_identification
