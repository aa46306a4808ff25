#include "io/text_table.h"

#include <gtest/gtest.h>

#include <limits>

namespace uncertainty_identification {
namespace {

TEST(TextTable, AlignsColumnsAndLeavesNoTrailingSpaces) {
  EXPECT_EQ(textTable({{"name", "value"}, {"longer", "1"}, {"x"}}),
            "  name    value\n  longer  1\n  x\n");
  EXPECT_EQ(textTable({}), "");
}

TEST(TextTable, Numbers) {
  EXPECT_EQ(numberText(0.1234567), "0.123457");
  EXPECT_EQ(numberText(-1e-12), "-1e-12");
  EXPECT_EQ(numberText(std::numeric_limits<double>::quiet_NaN()), "-");
  EXPECT_EQ(numberText(std::numeric_limits<double>::infinity()), "-");
}

TEST(TextTable, EstimatesToTheSecondDigitOfTheirError) {
  EXPECT_EQ(estimateText(0.310249, 0.00409), "0.3102 +- 0.0041");
  EXPECT_EQ(estimateText(-123.456, 12.4), "-123 +- 12");
  EXPECT_EQ(estimateText(5, 321), "5 +- 321");
  EXPECT_EQ(estimateText(2.5e-9, 1e-10), "2.500e-09 +- 1.0e-10");
  EXPECT_EQ(estimateText(2.5e9, 10), "2.500e+09 +- 1.0e+01");
  EXPECT_EQ(estimateText(1.25, 0), "1.25");
  EXPECT_EQ(estimateText(1.25, std::numeric_limits<double>::quiet_NaN()), "1.25");
  EXPECT_EQ(estimateText(std::numeric_limits<double>::quiet_NaN(), 1), "-");
}

TEST(TextTable, VectorsAndMatrices) {
  EXPECT_EQ(vectorText(Eigen::Vector2d(1, -2)), "(1, -2)");
  EXPECT_EQ(vectorText(Eigen::VectorXd::Constant(1, 3)), "3");
  EXPECT_EQ(matrixText((Eigen::Matrix2d() << 1, 0.5, 0.25, 2).finished()), "[1 0.5; 0.25 2]");
  EXPECT_EQ(matrixText(Eigen::MatrixXd::Constant(1, 1, 3)), "3");
}

TEST(TextTable, Polynomials) {
  EXPECT_EQ(polynomialText(Eigen::Vector3d(1, -0.5, 0.25), 0), "1 - 0.5 q^-1 + 0.25 q^-2");
  EXPECT_EQ(polynomialText(Eigen::Vector2d(-1, -2), 3), "-1 q^-3 - 2 q^-4");
  EXPECT_EQ(polynomialText(Eigen::VectorXd(), 1), "0");
}

}  // namespace
}  // namespace uncertainty_identification
