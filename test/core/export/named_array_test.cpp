// Numbers as text that keeps every bit, and the arrays that the files hold.
#include "export/named_array.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <random>

#include "support/export_setup.h"

namespace uncertainty_identification {
namespace {

using Kind = NamedArray::Kind;

TEST(NamedArray, NumbersKeepEveryBit) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> exponent(-300, 300);
  for (int k = 0; k < 10000; ++k) {
    const double value = std::pow(10, exponent(random)) * (k % 2 == 0 ? 1 : -1);
    ASSERT_EQ(std::stod(exactText(value)), value) << exactText(value);
  }
}

/// YAML 1.1 takes 1e-05 and 1e22 for text, Python and C take 5 for an integer.
TEST(NamedArray, NumbersHaveADecimalPoint) {
  EXPECT_EQ(exactText(5), "5.0");
  EXPECT_EQ(exactText(-0.1), "-0.1");
  EXPECT_EQ(exactText(1e-5), "1.0e-05");
  EXPECT_EQ(exactText(1e22), "1.0e+22");
  EXPECT_EQ(exactText(1.25e-7), "1.25e-07");
}

TEST(NamedArray, NumbersThatAreNotFinite) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(exactText(std::nan("")), "nan");
  EXPECT_EQ(exactText(kInfinity), "inf");
  EXPECT_EQ(exactText(-kInfinity), "-inf");
}

TEST(NamedArray, RowsOfComplexNumbers) {
  Eigen::RowVectorXcd row(3);
  row << std::complex<double>(1, -2), std::complex<double>(0.5, 0.25), -1;
  EXPECT_EQ(rowText(row, true), "1.0-2.0j, 0.5+0.25j, -1.0+0.0j");
  EXPECT_EQ(rowText(row, false), "1.0, 0.5, -1.0");
  EXPECT_EQ(listText(Eigen::Vector2d(1, 2)), "1.0, 2.0");
  EXPECT_EQ(listText(Eigen::VectorXd()), "");
}

std::map<std::string, NamedArray> arraysOf(const Result& result) {
  std::map<std::string, NamedArray> found;
  for (const NamedArray& array : namedArrays(test::exportedAs("m", result))) {
    EXPECT_FALSE(array.meaning.empty()) << array.name;
    EXPECT_EQ(plainText(array.meaning), array.meaning) << array.name;
    EXPECT_TRUE(found.emplace(array.name, array).second) << array.name << " is there twice";
  }
  return found;
}

TEST(NamedArray, AllThatAResultHolds) {
  const auto arrays = arraysOf(test::delayedResult());
  EXPECT_EQ(arrays.at("sample_time").values(0, 0), 0.1);
  EXPECT_EQ(arrays.at("delay").values(0, 0), 4.0);
  EXPECT_EQ(arrays.at("offset_u").values(0, 0), -0.25);
  EXPECT_EQ(arrays.at("offset_y").values(0, 0), 3.5);
  EXPECT_EQ(arrays.at("noise_variance").values(0, 0), 0.1);
  EXPECT_EQ(arrays.at("num").values(0, 4), 0.5);
  EXPECT_EQ(arrays.at("num").kind, Kind::list);
  EXPECT_TRUE(arrays.at("response").is_complex);
  EXPECT_EQ(arrays.at("samples_num").kind, Kind::table);
  EXPECT_EQ(arrays.at("samples_response").values.rows(), 5);
  EXPECT_EQ(arrays.at("samples_seed").values(0, 0), 1.0);
  EXPECT_NE(arrays.at("samples_den").meaning.find("with the errors"), std::string::npos);
  EXPECT_EQ(arrays.at("weight_level").values(0, 0), 0.95);
  EXPECT_EQ(arrays.at("magnitude_lower").values.cols(), 40);
  for (const char* name : {"den", "noise_num", "noise_den", "noise_response", "weight_num",
                           "weight_den", "weight_response", "band_levels", "band_omega",
                           "magnitude_upper", "phase_lower", "phase_upper", "relative_error_upper"})
    EXPECT_EQ(arrays.count(name), 1u) << name;
}

TEST(NamedArray, WhatAResultLacksIsAbsent) {
  const auto arrays = arraysOf(test::bareResult());
  EXPECT_EQ(arrays.count("num"), 1u);
  for (const char* name :
       {"weight_num", "weight_level", "samples_num", "samples_seed", "band_omega"})
    EXPECT_EQ(arrays.count(name), 0u) << name;
}

}  // namespace
}  // namespace uncertainty_identification
