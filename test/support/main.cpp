// Runs the tests of one source file: <program> csv_test [gtest options] runs those of csv_test.cpp,
// and fails where there are none. Without a name all tests of the program run.
#include <gtest/gtest.h>

#include <iostream>
#include <string>

namespace {

/// "Suite.Name:Suite.Name:..." of the tests in files that end in "/<name>.cpp".
std::string testsOf(const std::string& name) {
  const std::string ending = "/" + name + ".cpp";
  const testing::UnitTest& all = *testing::UnitTest::GetInstance();
  std::string filter;
  for (int s = 0; s < all.total_test_suite_count(); ++s) {
    const testing::TestSuite& suite = *all.GetTestSuite(s);
    for (int t = 0; t < suite.total_test_count(); ++t) {
      const testing::TestInfo& test = *suite.GetTestInfo(t);
      const std::string file = test.file();
      if (file.size() < ending.size() ||
          file.compare(file.size() - ending.size(), ending.size(), ending) != 0)
        continue;
      filter += (filter.empty() ? "" : ":") + std::string(suite.name()) + "." + test.name();
    }
  }
  return filter;
}

}  // namespace

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  if (argc > 1) {
    const std::string filter = testsOf(argv[1]);
    if (filter.empty()) {
      std::cerr << "this program holds no test of " << argv[1] << ".cpp\n";
      return 2;
    }
    testing::GTEST_FLAG(filter) = filter;
  }
  return RUN_ALL_TESTS();
}
