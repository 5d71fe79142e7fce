// Every case of the corpus in every engine that it asks for: what must hold, holds.

#include "studies/hard_cases/hard_case.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace carom::test {
namespace {

std::vector<std::string> names_of_cases(bool that_take_long) {
  std::vector<std::string> names;
  for (const HardCase& one : hard_case_corpus())
    if (one.takes_long == that_take_long) names.push_back(one.name);
  return names;
}

const HardCase& case_named(const std::string& name) {
  const auto& corpus = hard_case_corpus();
  return *std::find_if(corpus.begin(), corpus.end(), [&](const HardCase& one) { return one.name == name; });
}

void expect_to_hold(const std::string& name) {
  const CaseVerdict verdict = run_hard_case(case_named(name));
  EXPECT_FALSE(verdict.checks.empty());
  for (const CaseCheck& check : verdict.checks)
    EXPECT_TRUE(check.holds) << check.engine << ": " << check.what << " " << check.value << " is not within " << check.bound
                             << ": " << check.remark;
}

class EnginesHardCase : public testing::TestWithParam<std::string> {};
TEST_P(EnginesHardCase, Holds) { expect_to_hold(GetParam()); }

class SlowHardCase : public testing::TestWithParam<std::string> {};
TEST_P(SlowHardCase, Holds) { expect_to_hold(GetParam()); }

std::string test_name(const testing::TestParamInfo<std::string>& info) {
  std::string name = info.param;
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(All, EnginesHardCase, testing::ValuesIn(names_of_cases(false)), test_name);
INSTANTIATE_TEST_SUITE_P(All, SlowHardCase, testing::ValuesIn(names_of_cases(true)), test_name);

TEST(HardCaseCorpus, HoldsAtLeastEightyCasesInEveryFamily) {
  std::set<std::string> families;
  for (const HardCase& one : hard_case_corpus()) families.insert(one.family);
  EXPECT_GE(hard_case_corpus().size(), 80U);
  EXPECT_EQ(families.size(), hard_case_families().size());
}

TEST(HardCaseCorpus, IsWhatLiesInTheRepository) {
  std::set<std::string> files, cases;
  for (const auto& entry : std::filesystem::directory_iterator(CAROM_SOURCE_DIR "/tests/hard_cases"))
    if (entry.path().extension() == ".toml") files.insert(entry.path().stem().string());
  for (const HardCase& one : hard_case_corpus()) cases.insert(one.name);
  EXPECT_EQ(cases, files);
}

TEST(HardCaseCorpus, EveryCaseStatesSomethingAndSaysWhyItIsHardAndWhereItComesFrom) {
  for (const HardCase& one : hard_case_corpus())
    for (const std::string& text : {one.title, one.why, one.source}) EXPECT_GE(text.size(), 6U) << one.name;
}

}  // namespace
}  // namespace carom::test
